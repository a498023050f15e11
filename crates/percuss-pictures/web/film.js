"use strict";

// The scene as a sequence of pictures without a page, drawn by the scripts of the page.

let pageColours = {};

// On the page this function reads the style sheet.
function colour(name) {
  return pageColours[name];
}

const LAID_OUT = 800; // width of the layout; wider pictures are enlarged, including lines and letters [pixels]
const TITLE = 30; // height of the strip with the title [pixels]

// `look`: width [pixels], title, colour, diagram, exaggeration, as the options of a drawing.
class Film {
  constructor(scene, frames, colours, look) {
    pageColours = colours;
    this.motion = new Motion(scene, frames);
    this.drawing = new Drawing(this.motion, palette());
    this.look = look;
    this.whole = [this.motion.start, this.motion.end];
    this.impact = contactSpan(this.motion);
    this.scale = Math.max(1, look.width / LAID_OUT);
    this.width = look.width / this.scale;
    this.strip = look.title ? TITLE : 0;
    const { low, high } = this.drawing.bounds;
    const aspect = (high[1] - low[1]) / Math.max(high[0] - low[0], 1e-9);
    const wanted = (this.width - 2 * MARGIN) * aspect + 2 * MARGIN + 90;
    this.height = Math.round(Math.min(Math.max(0.3 * this.width, 160, wanted), 1.25 * this.width));
    this.view = viewOf(this.drawing.bounds, this.width, this.height);
  }

  // Intervals of time, and the size in even numbers of pixels, which films need.
  about() {
    const even = (x) => 2 * Math.max(1, Math.floor(x / 2 + 1e-6));
    return {
      whole: this.whole,
      impact: this.impact,
      hindrance: hindrance(this.motion, this.look.exaggeration ?? 1),
      seconds: SECONDS,
      size: [even(this.scale * this.width), even(this.scale * (this.height + this.strip))],
    };
  }

  // Time t as SVG; impulses of the preceding time `flash` are shown [s].
  picture(t, flash) {
    const { colour, diagram, exaggeration } = this.look;
    const pen = new SvgPen(this.width, this.height);
    this.drawing.draw(pen, t, this.view, { colour, diagram, exaggeration, forces: true, loads: true, ghost: true, flash });
    const scene = pen.finish();
    if (!this.strip) return scene;
    const whole = new SvgPen(this.width, this.height + this.strip);
    whole.begin(this.drawing.palette.page);
    const most = Math.max(4, Math.floor((this.width - 20) / 9)); // letters that fit
    const { title } = this.look;
    const text = title.length > most ? `${title.slice(0, most - 1)}\u2026` : title;
    whole.text([this.width / 2, TITLE / 2 + 1], text, { fill: this.drawing.palette.text, size: 15, align: "center" });
    whole.parts.push(scene.replace("<svg ", `<svg y="${this.strip}" `));
    return whole.finish();
  }
}

let film = null;

function openFilm(scene, frames, colours, look) {
  film = new Film(JSON.parse(scene), frames, JSON.parse(colours), JSON.parse(look));
  return JSON.stringify(film.about());
}

function drawFilm(t, flash) {
  return film.picture(t, flash);
}
