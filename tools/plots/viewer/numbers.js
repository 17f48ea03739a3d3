"use strict";

// What the page holds of the run, as arrays of numbers.

const view = JSON.parse(document.getElementById("view").textContent);

function unpack(text, Kind) {
  const letters = atob(text), bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; ++i) bytes[i] = letters.charCodeAt(i);
  return new Kind(bytes.buffer);
}

const nFrames = view.times.length, nFibers = view.points.length;
const firstPoint = view.points.map((_, fiber) => view.points.slice(0, fiber).reduce((sum, n) => sum + n, 0));
const nPoints = firstPoint[nFibers - 1] + view.points[nFibers - 1];

const placeSteps = unpack(view.places.steps, Uint16Array);  // [frames][points][3]
const middles = unpack(view.places.middles, Float32Array);  // [frames][3]

/// Quantities along the fibers: value(frame, point) from 0 to 1 in the range that is shown, NaN where there is none.
class Quantity {
  constructor(packed) {
    this.steps = unpack(packed.steps, Uint16Array);
    this.low = packed.low;
    this.high = packed.high;
    this.isSigned = packed.signed;
    [this.shownLow, this.shownHigh] = packed.shown;  // a few kinks may be beyond
  }
  share(frame, point) {
    const step = this.steps[frame * nPoints + point];
    if (step === 65535) return NaN;
    const value = this.low + (step / 65534) * (this.high - this.low);
    return Math.min(1, Math.max(0, (value - this.shownLow) / (this.shownHigh - this.shownLow)));
  }
}

const curvature = new Quantity(view.curvature);
const tension = new Quantity(view.tension);
const regimeCodes = view.regimes && unpack(view.regimes.codes, Uint8Array);  // [frames][fibers]

const palettes = {
  rising: unpack(view.palettes.rising, Uint8Array),        // 256 colours, from low to high
  diverging: unpack(view.palettes.diverging, Uint8Array),  // the middle is zero
  distinct: unpack(view.palettes.distinct, Uint8Array),    // for fibers and regimes
};
const absent = [176, 176, 176];

function colourOf(quantity, share) {
  if (!(share >= 0)) return absent;
  const at = 3 * Math.min(255, Math.floor(256 * share));
  const palette = quantity.isSigned ? palettes.diverging : palettes.rising;
  return [palette[at], palette[at + 1], palette[at + 2]];
}

function distinctColour(number) {
  const at = 3 * (number % (palettes.distinct.length / 3));
  return palettes.distinct.subarray(at, at + 3);
}

/// The frame before a time, and how far it is to the next.
function findMoment(time) {
  let low = 0, high = nFrames - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (view.times[middle] <= time) low = middle; else high = middle;
  }
  if (nFrames === 1 || time >= view.times[nFrames - 1]) return { frame: nFrames - 1, share: 0 };
  return { frame: low, share: Math.max(0, (time - view.times[low]) / (view.times[high] - view.times[low])) };
}

/// Where all points are at a moment, between two frames on a straight line.
function fillPlaces(moment, places) {
  const { frame, share } = moment, next = Math.min(frame + 1, nFrames - 1);
  const half = view.places.half, scale = (2 * half) / 65535;
  for (let i = 0; i < 3 * nPoints; ++i) {
    const c = i % 3;
    const here = placeSteps[frame * 3 * nPoints + i] * scale - half + middles[3 * frame + c];
    const there = placeSteps[next * 3 * nPoints + i] * scale - half + middles[3 * next + c];
    places[i] = here + share * (there - here);
  }
}

function middleAt(moment) {
  const { frame, share } = moment, next = Math.min(frame + 1, nFrames - 1);
  return [0, 1, 2].map((c) => middles[3 * frame + c] + share * (middles[3 * next + c] - middles[3 * frame + c]));
}

/// The box of all frames.
function wholeExtent() {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let frame = 0; frame < nFrames; ++frame)
    for (let c = 0; c < 3; ++c) {
      low[c] = Math.min(low[c], middles[3 * frame + c]);
      high[c] = Math.max(high[c], middles[3 * frame + c]);
    }
  return { low, high, half: view.places.half };
}
