"use strict";

// Pictures of the scene beside each other: equilibria as they are, shapes as they swing, a period each.

const PERIOD = 2.4; // of every shape [s]
const FULL = 0.25; // where in its period a shape is farthest out

// A pen on a canvas, at the screen's resolution.
function penOn(canvas, width, height) {
  const ratio = devicePixelRatio || 1;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return new CanvasPen(context, width, height);
}

class Panel {
  constructor(list, title, motion, options) {
    Object.assign(this, { title, motion, options, swings: motion instanceof ShapeMotion });
    this.figure = list.appendChild(document.createElement("figure"));
    const caption = this.figure.appendChild(document.createElement("figcaption"));
    caption.appendChild(document.createElement("h3")).textContent = title;
    const button = caption.appendChild(document.createElement("button"));
    Object.assign(button, { type: "button", className: "save", textContent: "SVG", ariaLabel: `Save ${title} as SVG` });
    button.addEventListener("click", () => saveAs(`${title.replace(/[^\w.-]+/g, "-")}.svg`, `data:image/svg+xml;charset=utf-8,${encodeURIComponent(this.svg())}`));
    this.canvas = this.figure.appendChild(document.createElement("canvas"));
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", title);
    this.paper = this.figure.appendChild(document.createElement("div"));
    this.paper.className = "paper";
    this.phase = FULL;
  }

  theme() {
    this.drawing = new Drawing(this.motion, palette());
    if (!this.canvas.clientWidth) return;
    const wanted = heightFor(this.bounds, this.canvas.clientWidth);
    this.canvas.style.height = `${Math.round(Math.min(420, Math.max(170, wanted)))}px`;
    this.draw();
  }

  get bounds() {
    return this.drawing.boundsAt(this.options().exaggeration);
  }

  get visible() {
    const { top, bottom } = this.canvas.getBoundingClientRect();
    return bottom > 0 && top < innerHeight;
  }

  draw() {
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    if (!width || !this.drawing) return;
    this.shown = [width, height]; // what is printed is as large, though the canvas is hidden then
    this.drawing.draw(penOn(this.canvas, width, height), this.phase, viewOf(this.bounds, width, height), this.options());
  }

  svg(phase = this.phase) {
    const [width, height] = this.shown ?? [380, 200];
    const pen = new SvgPen(width, height);
    this.drawing.draw(pen, phase, viewOf(this.bounds, width, height), this.options());
    return pen.finish();
  }
}

// All panels, with the button that lets those swing that do.
class Panels {
  constructor(section, panels) {
    this.panels = panels;
    this.playing = false;
    this.button = section.querySelector("[data-panels=play]");
    section.hidden = !panels.length;
    this.button.hidden = !panels.some((panel) => panel.swings);
    this.button.addEventListener("click", () => (this.playing ? this.pause() : this.play()));
    this.label();
  }

  theme() {
    this.panels.forEach((panel) => panel.theme());
  }

  play() {
    if (this.playing || this.button.hidden) return;
    this.playing = true;
    this.label();
    let before = performance.now();
    const tick = (now) => {
      if (!this.playing) return;
      const step = Math.min(now - before, 100) / 1000 / PERIOD;
      before = now;
      for (const panel of this.panels.filter((panel) => panel.swings)) {
        panel.phase = (panel.phase + step) % 1;
        if (panel.visible) panel.draw();
      }
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  pause() {
    this.playing = false;
    this.label();
  }

  label() {
    this.button.textContent = this.playing ? "Pause" : "Play";
    this.button.setAttribute("aria-pressed", String(this.playing));
  }
}
