"use strict";

// The scene on the page: play, pause, scrub, step, speed, the impact alone or the whole run, what is shown; mouse and keyboard.

const SECONDS = 6; // what the shown span takes at normal speed
const NARROW = 600; // least width of a scene beside its text, that of its controls [pixels]
const WIDE = 1000; // width from which a scene may be beside its text [pixels]
const LOW = 200; // least height of a scene that has to end on the first screen [pixels]
const ROW = 54; // height of the row of controls that has to end there, too [pixels]
const STILL_MARGIN = 0.35; // room around the contact when the impact alone is shown, as a share of it

function palette() {
  const of = (name) => colour(name);
  return {
    page: of("--page"), text: of("--text"), soft: of("--soft"), outline: of("--scene-outline"), beam: of("--scene-beam"),
    ghost: of("--c7"), hatch: of("--c7"), wall: of("--grid"), symbol: of("--soft"), load: of("--c3"), contact: of("--c2"),
    body: of("--scene-body"), diagram: of("--c4"), runs: [0, 1, 2, 3, 4, 5, 6, 8].map((k) => of(`--c${k}`)),
  };
}

// From the first to the last frame in which anything touches, with some room unless that is next to the whole run; null if nothing does, or
// if something does from the first frame to the last.
function contactSpan(motion) {
  let [from, to] = [null, null];
  for (let f = 0; f < motion.count; f++) {
    if (motion.frames.contact_count[f] > 0) {
      from ??= motion.frames.time[f];
      to = motion.frames.time[f];
    }
  }
  if (from == null || (from <= motion.start && to >= motion.end)) return null;
  const whole = motion.end - motion.start;
  const room = Math.max(STILL_MARGIN * (to - from), 0.01 * whole);
  const span = [Math.max(motion.start, from - room), Math.min(motion.end, to + room)];
  return span[1] - span[0] < 0.9 * whole ? span : [from, to];
}

class Player {
  // `others` are motions of other runs, shown over the first one.
  constructor(section, motion, others = []) {
    this.section = section;
    this.motion = motion;
    this.others = others;
    this.canvas = section.querySelector("canvas");
    this.slider = section.querySelector("input[type=range]");
    this.playing = false;
    this.whole = [motion.start, Math.max(motion.end, ...others.map((m) => m.end))];
    this.impact = motion.rests ? null : contactSpan(motion);
    this.span = this.whole;
    // The instant of greatest interest, which the page names, or that of the largest contact force.
    const named = section.dataset.instant ? Number(section.dataset.instant) : motion.size.peak;
    this.rest = Math.min(this.whole[1], Math.max(this.whole[0], motion.instantShown(named ?? motion.start)));
    this.time = this.rest;
    this.opening = false; // whether it plays because the page was opened
    this.camera = { zoom: 1, shift: [0, 0] };
    this.listeners = [];
    this.control = (name) => section.querySelector(`[data-scene=${name}]`);
    this.control("impact").hidden = !this.impact;
    this.offerExaggerations();
    if (!motion.hasVelocity) this.control("colour").querySelector("[value=velocity]").remove();
    if (motion.count < 2) {
      section.querySelector(".transport").hidden = true;
      this.control("loop").parentElement.hidden = true;
    }
    this.wire();
  }

  // Of a run in which anything but guided projectiles touches none are offered: a few looks cannot vouch for every instant.
  offerExaggerations() {
    const select = this.control("exaggeration");
    const { motion } = this;
    const factors = motion.rests || canExaggerate(motion) ? exaggerations(motion) : [1];
    const chosen = motion.rests ? visibleFactor(motion, factors) : 1;
    const offered = factors.filter((f, k) => k === 0 || f === chosen || k >= factors.length - 5);
    select.replaceChildren(...offered.map((f) => new Option(String(f), String(f), false, f === chosen)));
    select.parentElement.hidden = factors.length < 2;
  }

  onTime(listener) {
    this.listeners.push(listener);
  }

  theme() {
    this.drawing = new Drawing(this.motion, palette(), this.others);
    this.draw();
  }

  options() {
    const box = (name) => this.control(name).checked;
    return {
      exaggeration: Number(this.control("exaggeration").value),
      colour: this.control("colour").value,
      diagram: this.control("diagram").value,
      forces: box("forces"),
      loads: box("loads"),
      ghost: box("ghost"),
      flash: 0.02 * (this.span[1] - this.span[0]),
    };
  }

  get bounds() {
    return this.drawing.boundsAt(Number(this.control("exaggeration").value));
  }

  // As high as the scene needs at the width there is, within the first screen. A scene that is higher than wide is beside its text,
  // as wide as it needs.
  fit() {
    const { section, canvas } = this;
    const needed = Math.max(NARROW, widthFor(this.bounds, 0.6 * innerHeight));
    const beside = this.mayBeBeside && section.clientWidth >= WIDE && needed <= 0.6 * section.clientWidth;
    section.classList.toggle("beside-text", beside);
    if (beside) section.style.setProperty("--stage", `${Math.round(needed)}px`);
    const wanted = Math.round(Math.max(260, heightFor(this.bounds, canvas.clientWidth)));
    const controls = this.allInView ? canvas.parentElement.clientHeight - canvas.clientHeight + 12 : ROW;
    const below = Math.round(innerHeight - (canvas.getBoundingClientRect().top + scrollY) - controls);
    canvas.style.height = `min(var(--scene-most), ${wanted}px, ${Math.max(LOW, below)}px)`;
  }

  draw() {
    if (!this.drawing || !this.canvas.clientWidth) return;
    this.fit();
    const ratio = devicePixelRatio || 1;
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    this.shown = [width, height]; // what is printed is as large, though the canvas is hidden then
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
    }
    const context = this.canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    const view = viewOf(this.bounds, width, height, this.camera);
    this.drawing.draw(new CanvasPen(context, width, height), this.time, view, this.options());
  }

  svg() {
    const [width, height] = this.shown;
    const pen = new SvgPen(width, height);
    this.drawing.draw(pen, this.time, viewOf(this.bounds, width, height, this.camera), this.options());
    return pen.finish();
  }

  seek(time, quiet) {
    this.time = Math.min(this.whole[1], Math.max(this.whole[0], time));
    const [from, to] = this.span;
    this.slider.value = String(Math.round(10000 * Math.min(1, Math.max(0, (this.time - from) / (to - from || 1)))));
    this.slider.setAttribute("aria-valuetext", this.motion.instantText(this.time));
    this.control("time").textContent = this.motion.instantText(this.time);
    this.draw();
    if (!this.playing) this.describe();
    if (!quiet) this.listeners.forEach((listener) => listener(this.time));
  }

  // Time and state in words, for those who do not see the scene.
  describe() {
    const { motion } = this;
    const { index } = motion.at(this.time);
    const sums = motion.count ? motion.resultants(index) : [];
    const closed = sums.map(({ contact, impulsive, size }) => `'${motion.scene.contacts[contact].name}' ${engineering(size, impulsive ? "N s" : "N")}`);
    const contacts = closed.length ? `in contact: ${closed.slice(0, 4).join(", ")}${closed.length > 4 ? ` and ${closed.length - 4} more` : ""}` : "no contact";
    const moved = `largest displacement of beams ${engineering(motion.largestAt(index), "m")}`;
    const parts = [motion.label(this.time), ...(motion.rests ? [] : [contacts]), moved];
    this.canvas.setAttribute("aria-label", `Scene, ${parts.filter(Boolean).join("; ")}`);
  }

  // Plays once from start to end, then shows the instant of greatest interest; that at once where motion is unwanted.
  open() {
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (still || this.motion.rests || this.motion.count < 2) return this.seek(this.rest);
    this.seek(this.whole[0]);
    this.play();
    this.opening = true;
  }

  // One frame on or back.
  step(by) {
    this.pause();
    const { time } = this.motion.frames;
    let k = this.motion.before(this.time);
    if (by < 0 && time[k] < this.time) k += 1;
    do k += by;
    while (k > 0 && k < this.motion.count - 1 && time[k] === this.time);
    this.seek(time[Math.min(this.motion.count - 1, Math.max(0, k))]);
  }

  show(span) {
    this.opening = false;
    this.span = span;
    this.control("impact").setAttribute("aria-pressed", String(span === this.impact));
    if (this.time < span[0] || this.time > span[1]) this.time = span[0];
    this.seek(this.time);
  }

  play() {
    this.playing = true;
    if (this.time >= this.span[1]) this.time = this.span[0];
    this.label();
    let before = performance.now();
    const tick = (now) => {
      if (!this.playing) return;
      const rate = ((this.span[1] - this.span[0]) / SECONDS) * Number(this.control("speed").value);
      let time = this.time + (rate * Math.min(now - before, 100)) / 1000;
      before = now;
      if (time >= this.span[1]) {
        if (this.opening) {
          this.pause();
          return this.seek(this.rest);
        }
        if (this.span === this.impact || this.control("loop").checked) time = this.span[0];
        else {
          this.seek(this.span[1]);
          return this.pause();
        }
      }
      this.seek(time);
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  pause() {
    this.playing = false;
    this.opening = false;
    this.label();
    this.describe();
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  label() {
    const button = this.control("play");
    button.textContent = this.playing ? "Pause" : "Play";
    button.setAttribute("aria-pressed", String(this.playing));
  }

  wire() {
    this.control("play").addEventListener("click", () => this.toggle());
    this.control("back").addEventListener("click", () => this.step(-1));
    this.control("on").addEventListener("click", () => this.step(1));
    this.control("impact").addEventListener("click", () => this.show(this.span === this.impact ? this.whole : this.impact));
    this.control("fit").addEventListener("click", () => this.look({ zoom: 1, shift: [0, 0] }));
    this.control("svg").addEventListener("click", () => saveAs("scene.svg", `data:image/svg+xml;charset=utf-8,${encodeURIComponent(this.svg())}`));
    this.control("png").addEventListener("click", () => saveAs("scene.png", this.canvas.toDataURL("image/png")));
    for (const name of ["colour", "diagram", "exaggeration", "forces", "loads", "ghost"]) {
      this.control(name).addEventListener("change", () => this.draw());
    }
    this.slider.addEventListener("input", () => {
      this.pause();
      this.seek(this.span[0] + (Number(this.slider.value) / 10000) * (this.span[1] - this.span[0]));
    });
    const keys = { " ": () => this.toggle(), ArrowLeft: () => this.step(-1), ArrowRight: () => this.step(1), Home: () => this.seek(this.span[0]), End: () => this.seek(this.span[1]), "+": () => this.zoom(1.25), "-": () => this.zoom(0.8), "0": () => this.look({ zoom: 1, shift: [0, 0] }) };
    this.canvas.addEventListener("keydown", (event) => {
      if (!keys[event.key] || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      if (this.opening && event.key !== " ") this.pause();
      keys[event.key]();
    });
    this.canvas.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && document.activeElement !== this.canvas) return; // the page scrolls
      event.preventDefault();
      this.zoom(Math.exp(-0.0015 * event.deltaY), [event.offsetX, event.offsetY]);
    }, { passive: false });
    this.canvas.addEventListener("dblclick", () => this.look({ zoom: 1, shift: [0, 0] }));
    let from = null;
    this.canvas.addEventListener("pointerdown", (event) => {
      from = [event.clientX - this.camera.shift[0], event.clientY - this.camera.shift[1]];
      this.canvas.setPointerCapture(event.pointerId);
    });
    this.canvas.addEventListener("pointermove", (event) => {
      if (from) this.look({ ...this.camera, shift: [event.clientX - from[0], event.clientY - from[1]] });
    });
    for (const end of ["pointerup", "pointercancel"]) this.canvas.addEventListener(end, () => (from = null));
  }

  look(camera) {
    this.camera = camera;
    this.draw();
  }

  // About a pixel, the middle unless given.
  zoom(factor, at) {
    const middle = [this.canvas.clientWidth / 2, (this.canvas.clientHeight - FOOT) / 2];
    const [x, y] = at ?? middle;
    const zoom = Math.min(400, Math.max(0.2, this.camera.zoom * factor));
    const by = zoom / this.camera.zoom;
    const shift = [x, y].map((p, i) => p - middle[i] - by * (p - middle[i] - this.camera.shift[i]));
    this.look({ zoom, shift });
  }
}

if (typeof module !== "undefined") module.exports = { contactSpan };
