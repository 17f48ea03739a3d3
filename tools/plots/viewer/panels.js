"use strict";

// Curves beside the fibers, all over the same time, with a line where the fibers are now; a click goes there.

const panelLeft = 52, panelRight = 10, panelTop = 20, panelBottom = 22;

function roundNumber(value) {
  const size = Math.abs(value);
  return size !== 0 && (size < 1e-3 || size >= 1e5) ? value.toExponential(1) : String(+value.toPrecision(3));
}

/// A few round numbers between two.
function chooseTicks(low, high, n) {
  const rough = (high - low) / n, unit = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((m) => m * unit).find((s) => s >= rough) || 10 * unit, ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) ticks.push(i * step);
  return ticks;
}

class Panel {
  /// @param goTo  called with a time
  constructor(canvas, title, goTo) {
    this.canvas = canvas;
    this.title = title;
    this.line = canvas.parentElement.appendChild(document.createElement("div"));  // of the moment; moves without painting
    this.line.className = "moment";
    const seek = (event) => {
      const x = event.offsetX - panelLeft, width = canvas.clientWidth - panelLeft - panelRight;
      const [low, high] = [view.times[0], view.times[nFrames - 1]];
      goTo(low + Math.min(1, Math.max(0, x / width)) * (high - low));
    };
    canvas.addEventListener("pointerdown", (event) => { canvas.setPointerCapture(event.pointerId); seek(event); });
    canvas.addEventListener("pointermove", (event) => { if (event.buttons & 1) seek(event); });
  }

  /// @param low, high  of the vertical axis  @param draw  (context, x of a time, y of a value, inner box)
  paint(low, high, draw) {
    const ratio = window.devicePixelRatio || 1, { clientWidth: width, clientHeight: height } = this.canvas;
    this.canvas.width = Math.max(1, Math.round(width * ratio));
    this.canvas.height = Math.max(1, Math.round(height * ratio));
    const context = this.canvas.getContext("2d");
    context.scale(ratio, ratio);
    const box = { left: panelLeft, top: panelTop, width: width - panelLeft - panelRight, height: height - panelTop - panelBottom };
    const [start, end] = [view.times[0], view.times[nFrames - 1]];
    this.xOf = (time) => box.left + (end > start ? (time - start) / (end - start) : 0) * box.width;
    const yOf = (value) => box.top + box.height - ((value - low) / (high - low || 1)) * box.height;
    context.font = "11px sans-serif";
    context.fillStyle = "#333";
    context.fillText(this.title, box.left, 13);
    context.save();
    context.beginPath();
    context.rect(box.left, box.top, box.width, box.height);
    context.clip();
    draw(context, this.xOf, yOf, box);
    context.restore();
    context.strokeStyle = "#bbb";
    context.strokeRect(box.left, box.top, box.width, box.height);
    context.textAlign = "center";
    if (end > start)
      for (const time of chooseTicks(start, end, 5)) context.fillText(roundNumber(time), this.xOf(time), height - 7);
    context.textAlign = "right";
    if (high > low)
      for (const value of chooseTicks(low, high, 4)) context.fillText(roundNumber(value), box.left - 5, yOf(value) + 4);
    this.line.style.top = `${box.top}px`;
    this.line.style.height = `${box.height}px`;
  }

  say(words) {
    this.paint(0, 0, (context, xOf, yOf, box) => {
      context.fillStyle = "#888";
      context.fillText(words, box.left + 8, box.top + box.height / 2);
    });
  }

  showMoment(time) {
    this.line.style.transform = `translateX(${this.xOf(time) - 0.75}px)`;
  }
}

/// One fiber's curve among the others'.
function paintCurve(panel, curve, fiber) {
  if (!curve) return panel.say("not measured: 'skein analyze' does that");
  if (fiber >= curve.fibers) return panel.say(`only of the first ${curve.fibers} fibers`);
  const times = unpack(curve.times, Float32Array), all = unpack(curve.values, Float32Array);
  const values = all.subarray(fiber * times.length, (fiber + 1) * times.length);
  let low = Infinity, high = -Infinity;
  for (const value of values)
    if (Number.isFinite(value)) [low, high] = [Math.min(low, value), Math.max(high, value)];
  if (!(high >= low)) return panel.say("not a number");
  if (high === low) [low, high] = [low - 0.5 * (Math.abs(low) || 1), high + 0.5 * (Math.abs(high) || 1)];
  const margin = 0.05 * (high - low);
  panel.paint(low - margin, high + margin, (context, xOf, yOf) => {
    context.strokeStyle = "#1f77b4";
    context.lineWidth = 1.4;
    context.beginPath();
    values.forEach((value, i) => { if (Number.isFinite(value)) context.lineTo(xOf(times[i]), yOf(value)); });
    context.stroke();
  });
}

/// A fiber's curvature over time and arclength, in the colours of the tubes.
function paintKymograph(panel, fiber) {
  const n = view.points[fiber], first = firstPoint[fiber], image = document.createElement("canvas");
  image.width = nFrames;
  image.height = n;
  const context = image.getContext("2d"), pixels = context.createImageData(nFrames, n);
  for (let frame = 0; frame < nFrames; ++frame)
    for (let i = 0; i < n; ++i) {
      const at = 4 * ((n - 1 - i) * nFrames + frame);
      pixels.data.set(colourOf(curvature, curvature.share(frame, first + i)), at);
      pixels.data[at + 3] = 255;
    }
  context.putImageData(pixels, 0, 0);
  panel.paint(0, view.lengths[fiber] || 1, (target, xOf, yOf, box) => {
    target.imageSmoothingEnabled = false;
    for (let frame = 0; frame < nFrames; ++frame) {  // each to halfway to its neighbours: frames need not be even in time
      const middle = (other) => 0.5 * (view.times[frame] + view.times[Math.min(nFrames - 1, Math.max(0, other))]);
      const from = xOf(middle(frame - 1)), to = xOf(middle(frame + 1));
      target.drawImage(image, frame, 0, 1, n, from, box.top, Math.max(0.5, to - from + 0.5), box.height);
    }
  });
}
