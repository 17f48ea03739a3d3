"use strict";

// The moment that is shown, and what shows it.

const element = (id) => document.getElementById(id);
const wholeSeconds = 20;  // in which a run is played at speed 1

class Player {
  constructor() {
    this.extent = wholeExtent();
    this.time = view.times[0];
    this.isPlaying = false;
    this.places = new Float32Array(3 * nPoints);
    this.stage = new Stage(element("stage"));
    this.tubes = new Tubes();
    this.stage.scene.add(this.tubes.mesh);
    this.arrows = view.flow ? new Arrows(view.flow) : null;
    if (this.arrows) this.stage.scene.add(this.arrows.mesh);
    this.panels = ["angle", "kymograph", "energy"].map(
      (id) => new Panel(element(id), element(id).dataset.title, (time) => this.goTo(time)));
    this.fillChoices();
    const asked = new URLSearchParams(location.hash.slice(1));  // page.html#t=5.44&camera=oblique
    for (const name of ["colour", "fiber", "camera", "speed"])
      if ([...element(name).options].some((option) => option.value === asked.get(name))) element(name).value = asked.get(name);
    element("follow").checked = asked.get("follow") !== "no";
    this.listen();
    this.showLegend();
    this.paintPanels();
    this.goTo(Math.min(view.times[nFrames - 1], Math.max(view.times[0], +asked.get("t") || 0)));
    this.lookFrom(element("camera").value);
  }

  fillChoices() {
    const add = (id, value, words) => element(id).add(new Option(words, value));
    add("colour", "curvature", view.curvature.signed ? "curvature, signed" : "curvature");
    add("colour", "tension", "tension / EA");
    if (regimeCodes) add("colour", "regime", "regime");
    add("colour", "fiber", "fiber");
    for (let fiber = 0; fiber < nFibers; ++fiber) add("fiber", fiber, `fiber ${fiber}`);
    for (const [place, { words }] of Object.entries(cameraPlaces)) add("camera", place, words);
    element("scrub").max = nFrames - 1;
    element("arrows").parentElement.hidden = !this.arrows;
    element("fiber").parentElement.hidden = nFibers === 1;
    element("colour").value = nFibers > 1 ? "fiber" : "curvature";
  }

  listen() {
    element("play").onclick = () => (this.isPlaying ? this.pause() : this.play());
    element("scrub").oninput = (event) => { this.pause(); this.goTo(view.times[+event.target.value]); };
    element("colour").onchange = () => { this.showLegend(); this.goTo(this.time); };
    element("fiber").onchange = () => { this.paintPanels(); this.goTo(this.time); };
    element("camera").onchange = (event) => this.lookFrom(event.target.value);
    element("arrows").onchange = () => this.goTo(this.time);
    element("follow").onchange = () => this.lookFrom(element("camera").value);
    window.addEventListener("resize", () => { this.stage.resize(); this.paintPanels(); this.goTo(this.time); });
    window.addEventListener("keydown", (event) => {
      if (/INPUT|SELECT|TEXTAREA/.test(event.target.tagName) && event.target.type !== "range") return;
      if (event.key === " ") { event.preventDefault(); element("play").click(); }
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (step) { this.pause(); this.goTo(view.times[Math.min(nFrames - 1, Math.max(0, findMoment(this.time).frame + step))]); }
    });
  }

  lookFrom(place) {
    const { low, high, half } = this.extent;
    const { stage } = this, thickest = Math.max(...view.radius);
    if (element("follow").checked) {  // what is there at this moment fills the view; one fiber may turn and stays in it
      const middle = middleAt(findMoment(this.time));
      const now = this.places.reduce((size, c, i) => Math.max(size, Math.abs(c - middle[i % 3])), thickest);
      const distance = nFibers > 1 ? stage.distanceOfPoints(place, middle, this.places) + 4 * thickest : stage.distanceOfBall(now);
      return stage.lookFrom(place, middle, distance);
    }
    const drift = Math.max(...low.map((c, i) => 0.5 * (high[i] - c)));
    stage.lookFrom(place, low.map((c, i) => 0.5 * (c + high[i])), stage.distanceOfBall(half + drift));
  }

  paintPanels() {
    const fiber = +element("fiber").value || 0;
    paintCurve(this.panels[0], view.curves.angle, fiber);
    paintKymograph(this.panels[1], fiber);
    paintCurve(this.panels[2], view.curves.energy, fiber);
  }

  colours(frame) {
    const kind = element("colour").value;
    if (kind === "fiber") return (fiber) => distinctColour(fiber);
    if (kind === "regime") return (fiber) => distinctColour(regimeCodes[frame * nFibers + fiber]);
    const quantity = kind === "tension" ? tension : curvature;
    return (_, point) => colourOf(quantity, quantity.share(frame, point));
  }

  showLegend() {
    const kind = element("colour").value, legend = element("legend");
    legend.textContent = "";
    const addPatch = (colour, words) => {
      const patch = document.createElement("span");
      patch.className = "patch";
      patch.style.background = `rgb(${[...colour].join(",")})`;
      legend.append(patch, ` ${words} `);
    };
    if (kind === "regime") for (const [code, word] of Object.entries(view.regimes.words)) addPatch(distinctColour(+code), word);
    if (kind !== "curvature" && kind !== "tension") return;
    const quantity = kind === "tension" ? tension : curvature, bar = document.createElement("span");
    const stops = Array.from({ length: 9 }, (_, i) => `rgb(${colourOf(quantity, Math.min(0.999, i / 8)).join(",")})`);
    bar.className = "bar";
    bar.style.background = `linear-gradient(to right, ${stops.join(",")})`;
    legend.append(`${roundNumber(quantity.shownLow)} `, bar, ` ${roundNumber(quantity.shownHigh)}`);
  }

  goTo(time) {
    this.time = time;
    const moment = findMoment(time), nearest = Math.min(nFrames - 1, moment.frame + (moment.share > 0.5 ? 1 : 0));
    fillPlaces(moment, this.places);
    this.tubes.update(this.places, this.colours(nearest));
    if (this.arrows) {
      this.arrows.mesh.visible = element("arrows").checked;
      this.arrows.update(time);
    }
    if (element("follow").checked) this.stage.follow(middleAt(moment));
    this.stage.render();
    for (const panel of this.panels) panel.showMoment(time);
    element("scrub").value = nearest;
    element("time").textContent = `t = ${time.toPrecision(4)}`;
    document.body.dataset.frame = nearest;
  }

  play() {
    if (this.time >= view.times[nFrames - 1]) this.time = view.times[0];
    this.isPlaying = true;
    element("play").textContent = "Pause";
    let before = performance.now();
    const advance = (now) => {
      if (!this.isPlaying) return;
      this.moveOn(Math.max(0, now - before) / 1000);
      before = now;
      if (this.isPlaying) requestAnimationFrame(advance);
    };
    requestAnimationFrame(advance);
  }

  /// By so many seconds of playing; at the end of the run it pauses.
  moveOn(seconds) {
    const last = view.times[nFrames - 1], span = last - view.times[0];
    document.body.dataset.played = 1 + (+document.body.dataset.played || 0);
    this.goTo(Math.min(last, this.time + (seconds * +element("speed").value * span) / wholeSeconds));
    if (this.time >= last) this.pause();
  }

  pause() {
    this.isPlaying = false;
    element("play").textContent = "Play";
  }
}

function begin() {
  const start = performance.now();
  try {
    window.player = new Player();  // also for the console
  } catch (error) {
    element("stage").textContent = `The fibers cannot be drawn in this browser: ${error.message}`;
    throw error;
  }
  document.body.dataset.seconds = (1e-3 * (performance.now() - start)).toFixed(2);
  if (location.hash === "#check") check(window.player);
}

/// For tests: how many pixels the fibers cover, and the whole run played eight times as fast.
function check(player) {
  const gl = player.stage.renderer.getContext(), pixels = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
  if (player.arrows) player.arrows.mesh.visible = false;
  player.stage.render();
  gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  let coloured = 0;
  for (let i = 0; i < pixels.length; i += 4) coloured += pixels[i] < 240 || pixels[i + 2] < 240;
  document.body.dataset.coloured = coloured;
  element("speed").value = "8";
  player.play();
  while (player.isPlaying) player.moveOn(0.1);  // not by frames of the screen, of which a headless browser draws few
}

begin();
