"use strict";

// The scene drawn with a pen: beams to scale, supports, loads and contacts by the usual symbols. Axes are always equal.

const SYMBOL = 11; // half the size of a symbol [pixels]
const UNITS = { stress: "Pa", velocity: "m/s", axial: "N", shear: "N", moment: "N m" };
const DIAGRAMS = { axial: "N", shear: "V", moment: "M" };

// Cividis, a map that reads the same to the colour-blind, at nine places.
const MAP = [[0, 34, 78], [18, 53, 112], [59, 73, 108], [87, 93, 109], [112, 113, 115], [138, 134, 120], [165, 156, 116], [195, 179, 105], [225, 204, 85], [254, 232, 56]];

function mapColour(share) {
  const x = Math.min(0.9999, Math.max(0, share)) * (MAP.length - 1);
  const [k, y] = [Math.floor(x), x % 1];
  return `rgb(${[0, 1, 2].map((i) => Math.round(MAP[k][i] + y * (MAP[k + 1][i] - MAP[k][i]))).join(",")})`;
}

// Colour of the run of this number.
function runColour(palette, k) {
  return palette.runs[k % palette.runs.length];
}

class Drawing {
  // `others` are motions of other runs, drawn over the first one as outlines.
  constructor(motion, palette, others = []) {
    this.motion = motion;
    this.others = others;
    this.palette = palette; // text, soft, beam, ghost, hatch, load, contact, body, page: colours
    this.known = new Map();
    this.bounds = this.boundsAt(1);
  }

  // Bounds of all motions with displacements enlarged.
  boundsAt(factor) {
    if (!this.known.has(factor)) {
      const bounds = boundsOf(this.motion, factor);
      for (const { low, high } of this.others.map((other) => boundsOf(other, factor))) {
        bounds.low = bounds.low.map((v, i) => Math.min(v, low[i]));
        bounds.high = bounds.high.map((v, i) => Math.max(v, high[i]));
      }
      this.known.set(factor, bounds);
    }
    return this.known.get(factor);
  }

  // Draws time t. Options: exaggeration, colour (none, stress, velocity, moment, axial), diagram (none, axial, shear, moment), forces,
  // loads, ghost, bodies (with the stops that wait for them), obstacles,
  // flash: impulses up to so long ago are shown [s].
  draw(pen, t, view, options) {
    this.pen = pen;
    this.view = view;
    this.options = options;
    this.state = this.motion.at(t);
    this.e = options.exaggeration ?? 1;
    pen.begin(this.palette.page);
    if (options.obstacles !== false) this.motion.scene.obstacles.forEach((o) => this.obstacle(o));
    if (options.ghost) this.ghost();
    this.springs();
    this.foundations();
    this.motion.scene.beams.forEach((_, i) => this.beam(i));
    this.supports();
    if (options.diagram && options.diagram !== "none") this.diagrams(options.diagram);
    this.joints();
    this.masses();
    if (options.bodies !== false) this.bodies();
    if (options.loads) this.loads();
    this.others.forEach((other, k) => this.other(other, t, runColour(this.palette, k + 1)));
    if (options.forces) this.forces(options.flash ?? 0);
    this.furniture(t);
  }

  obstacle(o) {
    const { pen, view, palette } = this;
    const moved = o.body == null ? [0, 0] : (() => {
      const { place } = this.motion.body(o.body, this.state.u);
      const { position } = this.motion.scene.bodies[o.body];
      return [place[0] - position[0], place[1] - position[1]];
    })();
    const to = ([x, y]) => view.to([x + moved[0], y + moved[1]]);
    if (o.kind === "disc") {
      pen.circle(to(o.centre), o.radius * view.scale, { fill: palette.wall, stroke: palette.hatch, width: 1.5 });
    } else if (o.kind === "walls") {
      for (const [a, b] of o.ends) {
        const width = Math.max(o.thickness * view.scale, 3);
        pen.path([to(a), to(b)], { stroke: palette.hatch, width });
      }
    } else {
      const n = [o.normal[0], -o.normal[1]];
      const along = [-n[1], n[0]];
      const p = to(o.point);
      const reach = view.width + view.height;
      // The part of the line nearest to the middle of the picture.
      const middle = [view.width / 2 - p[0], view.height / 2 - p[1]];
      const at = middle[0] * along[0] + middle[1] * along[1];
      const end = (side) => [p[0] + (at + side * reach) * along[0], p[1] + (at + side * reach) * along[1]];
      const deep = (q) => [q[0] - reach * n[0], q[1] - reach * n[1]];
      pen.path([end(-1), end(1), deep(end(1)), deep(end(-1))], { fill: palette.wall, closed: true });
      pen.path([end(-1), end(1)], { stroke: palette.hatch, width: 1.5 });
      this.hatch(end(-1), end(1), [-n[0], -n[1]], 9);
    }
  }

  // Strokes behind a line, on the side of `into`.
  hatch(a, b, into, size) {
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    const d = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
    for (let x = size / 2; x < length; x += size) {
      const p = [a[0] + x * d[0], a[1] + x * d[1]];
      if (p[0] < -20 || p[1] < -20 || p[0] > this.view.width + 20 || p[1] > this.view.height + 20) continue;
      const q = [p[0] + size * (into[0] - 0.6 * d[0]), p[1] + size * (into[1] - 0.6 * d[1])];
      this.pen.path([p, q], { stroke: this.palette.hatch, width: 1 });
    }
  }

  ghost() {
    const rest = new Float32Array(4 * this.motion.nodes);
    this.motion.scene.beams.forEach((_, i) => {
      for (const part of this.motion.curve(i, rest)) {
        this.pen.path(part.map((p) => this.view.to(p.place)), { stroke: this.palette.ghost, width: 1.2, dash: [5, 4] });
      }
    });
  }

  // Beams and bodies of another run at the same time, as outlines of one colour.
  other(motion, t, outline) {
    const own = { motion: this.motion, state: this.state, palette: this.palette, options: this.options };
    const palette = { ...this.palette, outline, beam: undefined, body: undefined };
    Object.assign(this, { motion, state: motion.at(t), palette, options: { ...this.options, colour: "none" } });
    motion.scene.beams.forEach((_, i) => this.beam(i));
    this.bodies();
    Object.assign(this, own);
  }

  beam(i) {
    const { pen, view, palette, options } = this;
    const by = options.colour ?? "none";
    for (const part of this.motion.curve(i, this.state.u, this.e, this.state.time)) {
      const thick = part.every((p) => p.half_depth != null && p.half_depth * view.scale >= 1.2);
      const side = (p, sign) => view.to([0, 1].map((k) => p.place[k] + sign * (p.reach ?? 0) * p.normal[k]));
      if (by !== "none") {
        for (let k = 0; k + 1 < part.length; k++) {
          const [a, b] = [part[k], part[k + 1]];
          const fill = this.colourAt(i, a, b, by);
          if (thick) pen.path([side(a, 1), side(b, 1), side(b, -1), side(a, -1)], { fill, stroke: fill, width: 0.6, closed: true });
          else pen.path([view.to(a.place), view.to(b.place)], { stroke: fill, width: 4 });
        }
      }
      if (thick) {
        const outline = [...part.map((p) => side(p, 1)), ...part.toReversed().map((p) => side(p, -1))];
        pen.path(outline, { fill: by === "none" ? palette.beam : undefined, stroke: palette.outline, width: 1, closed: true });
      } else if (by === "none") {
        pen.path(part.map((p) => view.to(p.place)), { stroke: palette.outline, width: 3 });
      }
    }
  }

  colourAt(beam, a, b, by) {
    const value = (p) => this.motion.quantity(by, this.state.index, beam, p);
    if (value(a) == null || value(b) == null) return this.palette.beam;
    return mapColour(Math.max(value(a), value(b)) / (this.colourTop(by) || 1));
  }

  // Largest value over the run of what colours show.
  colourTop(by) {
    if (by in FORCES) return this.motion.size.sections[FORCES[by]];
    this.tops ??= {};
    // Of beams with stresses the run knows the largest; of one that has them in part the frames tell.
    const stressed = this.motion.scene.beams.filter((b) => b.inertia.some((value) => value != null));
    const whole = stressed.every((b) => b.inertia.every((value) => value != null));
    if (by === "stress" && whole) this.tops[by] ??= this.motion.largestOf("stress", stressed);
    if (this.tops[by] == null) {
      this.tops[by] = 0;
      const rest = new Float32Array(4 * this.motion.nodes);
      const curves = this.motion.scene.beams.map((_, i) => this.motion.curve(i, rest).flat().filter((p) => p.share === 0 || p.share === 1));
      for (let f = 0; f < this.motion.count; f++) {
        curves.forEach((points, i) => {
          for (const p of points) this.tops[by] = Math.max(this.tops[by], this.motion.quantity(by, f, i, p) ?? 0);
        });
      }
    }
    return this.tops[by];
  }

  diagrams(which) {
    const { pen, view, palette } = this;
    const k = FORCES[which];
    const top = this.motion.size.sections[k];
    if (!(top > 0)) return;
    this.motion.scene.beams.forEach((_, i) => {
      for (const part of this.motion.curve(i, this.state.u, this.e, this.state.time, this.state.index)) {
        const base = part.map((p) => view.to(p.place));
        const ends = part.flatMap((p, j) => {
          const [behind, ahead] = this.motion.sides(this.state.index, p).map((forces) => forces[k]);
          return (ahead === behind ? [ahead] : [behind, ahead]).map((force) => {
            // The moment is drawn on the side in tension: below where it is sagging.
            const value = (force / top) * 46 * (which === "moment" ? -1 : 1);
            return [base[j][0] + value * p.normal[0], base[j][1] - value * p.normal[1]];
          });
        });
        pen.path([...base, ...ends.toReversed()], { fill: palette.diagram, opacity: 0.25, closed: true });
        pen.path(ends, { stroke: palette.diagram, width: 1.5 });
      }
    });
  }

  bodies() {
    const { pen, view, palette } = this;
    const { bodies } = this.motion.scene;
    bodies.forEach((body, i) => {
      const { place, angle } = this.motion.body(i, this.state.u);
      if (body.kind === "disc") {
        const at = view.to(place);
        const r = Math.max(body.radius * view.scale, 3);
        pen.circle(at, r, { fill: palette.body, stroke: palette.outline, width: 1 });
        const spoke = [at[0] + r * Math.cos(angle), at[1] - r * Math.sin(angle)];
        pen.path([at, spoke], { stroke: palette.outline, width: 1.2 });
      } else if (body.kind === "guided") {
        this.guided(body, place, bodies[i + 1]?.kind === "rear" ? this.motion.body(i + 1, this.state.u).place : null);
      }
    });
  }

  // A mass on its line of motion, behind its spring if it has one. The gap to the beam's surface is the true one.
  guided(body, place, rear) {
    const { pen, view, palette, motion } = this;
    const [d1, d2] = body.direction;
    const target = motion.on(body.strikes, this.state.u, this.e);
    const moved = motion.on(body.strikes, this.state.u);
    const reference = motion.on(body.strikes, new Float32Array(4 * motion.nodes));
    const advance = (a, b) => (b[0] - a[0]) * d1 + (b[1] - a[1]) * d2;
    const gap = body.standoff + advance(reference.place, moved.place) - advance(body.position, place);
    const off = target.half_depth + Math.max(gap, 0);
    const d = [d1, -d2];
    const surface = view.to([target.place[0] - off * d1, target.place[1] - off * d2]);
    const free = body.elastic ? SPRING : 0;
    const pressed = body.elastic ? Math.min(24, Math.max(-gap, 0) * view.scale) : 0;
    const front = [surface[0] - (free - pressed) * d[0], surface[1] - (free - pressed) * d[1]];
    if (body.elastic) this.coil(front, surface, 5);
    this.block(front, d, 11);
    if (rear) {
      const behind = Math.max(14, 40 + ((rear[0] - place[0]) * d1 + (rear[1] - place[1]) * d2) * -view.scale);
      const at = [front[0] - (22 + behind - 14) * d[0], front[1] - (22 + behind - 14) * d[1]];
      this.coil([at[0], at[1]], [front[0] - 22 * d[0], front[1] - 22 * d[1]], 4);
      this.block(at, d, 11);
    }
  }

  // A square whose front is at a point.
  block(front, d, half) {
    const n = [-d[1], d[0]];
    const corner = (a, b) => [front[0] + a * d[0] + b * n[0], front[1] + a * d[1] + b * n[1]];
    const points = [corner(0, half), corner(0, -half), corner(-2 * half, -half), corner(-2 * half, half)];
    this.pen.path(points, { fill: this.palette.body, stroke: this.palette.outline, width: 1, closed: true });
  }

  // A spring as a zigzag of a given half width.
  coil(a, b, half, style) {
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
    const d = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
    const turns = 10;
    const points = [a];
    for (let k = 1; k < turns; k++) {
      const side = (k % 2 ? 1 : -1) * half;
      const x = (k / turns) * length;
      points.push([a[0] + x * d[0] - side * d[1], a[1] + x * d[1] + side * d[0]]);
    }
    this.pen.path([...points, b], style ?? { stroke: this.palette.outline, width: 1.4 });
  }

  springs() {
    for (const spring of this.motion.scene.springs) {
      if (spring.until != null && spring.until <= this.state.time) continue;
      const [a, b] = spring.between.map((end) =>
        this.view.to(
          end.position ?? (end.body == null ? this.motion.on(end, this.state.u, this.e) : this.motion.body(end.body, this.state.u)).place,
        ),
      );
      if (spring.springs) this.coil(a, b, 5, { stroke: this.palette.symbol, width: 1.4 });
      else this.pen.path([a, b], { stroke: this.palette.symbol, width: 3, dash: [2, 3] });
      spring.between.forEach((end, k) => {
        if (end.position) this.pen.circle(k ? b : a, 3, { fill: this.palette.symbol });
      });
    }
  }

  masses() {
    for (const mass of this.motion.scene.masses) {
      const { place } = this.motion.on(mass.at, this.state.u, this.e);
      this.pen.circle(this.view.to(place), 6, { fill: this.palette.body, stroke: this.palette.outline, width: 1 });
    }
  }

  joints() {
    for (const joint of this.motion.scene.joints.filter((j) => j.turns)) {
      if (joint.until != null && joint.until <= this.state.time) continue;
      const { place } = this.motion.on(joint.at, this.state.u, this.e);
      this.pen.circle(this.view.to(place), 4, { fill: this.palette.page, stroke: this.palette.outline, width: 1.5 });
    }
  }

  forces(flash) {
    const { motion, view, palette, state } = this;
    const now = motion.contacts(state.index).filter((c) => !c.impulsive);
    const impulses = motion.impulses(state.time - flash, state.time);
    for (const [list, top, width] of [[now, motion.size.force, 2.2], [impulses, motion.size.impulse, 3]]) {
      for (const c of list.map((one) => motion.pressing(one))) {
        const size = Math.hypot(...c.force);
        if (!(size > 0.004 * top)) continue;
        const length = 12 + 50 * (size / top);
        const d = [c.force[0] / size, -c.force[1] / size];
        const tip = view.to(c.position);
        this.arrow([tip[0] - length * d[0], tip[1] - length * d[1]], tip, { stroke: palette.contact, width });
      }
    }
  }

  arrow(from, tip, style) {
    const length = Math.hypot(tip[0] - from[0], tip[1] - from[1]) || 1;
    const d = [(tip[0] - from[0]) / length, (tip[1] - from[1]) / length];
    const head = Math.min(9, length);
    const wing = (side) => [tip[0] - head * d[0] - side * 0.45 * head * d[1], tip[1] - head * d[1] + side * 0.45 * head * d[0]];
    this.pen.path([from, [tip[0] - 0.7 * head * d[0], tip[1] - 0.7 * head * d[1]]], style);
    this.pen.path([tip, wing(1), wing(-1)], { fill: style.stroke, closed: true });
  }

  // Time, scale bar, axes, what the colours mean.
  furniture(t) {
    const { pen, view, palette, options } = this;
    const target = 90 / view.scale;
    const power = 10 ** Math.floor(Math.log10(target));
    const length = [5, 2, 1].map((m) => m * power).find((l) => l <= target) ?? power;
    const y = view.height - 14;
    const x = 54;
    pen.path([[x, y - 4], [x, y], [x + length * view.scale, y], [x + length * view.scale, y - 4]], { stroke: palette.soft, width: 1.2 });
    pen.text([x + length * view.scale + 6, y], engineering(length, "m"), { fill: palette.soft, size: 11 });
    const o = [12, view.height - 12];
    this.arrow(o, [o[0] + 22, o[1]], { stroke: palette.soft, width: 1.2 });
    this.arrow(o, [o[0], o[1] - 22], { stroke: palette.soft, width: 1.2 });
    pen.text([o[0] + 20, o[1] - 9], "x", { fill: palette.soft, size: 11 });
    pen.text([o[0] + 5, o[1] - 24], "y", { fill: palette.soft, size: 11 });
    const notes = [this.motion.label(t)].filter((note) => note);
    if (this.e !== 1) notes.push(`deformation scale ${this.e}`);
    else if (this.motion.rests && this.motion.size.displacement > 0 && !this.motion.swing) notes.push("deformation scale 1");
    const lines = [[notes.join(",  "), palette.text]];
    // A line of its own: beside the time it would run into the legend of narrow pictures.
    if (options.diagram in FORCES) lines.push([this.largest(options.diagram), palette.text]);
    if (this.others.length) lines.push(...[this.motion, ...this.others].map((run, k) => [run.name, runColour(palette, k)]));
    lines.filter(([text]) => text).forEach(([text, fill], k) => {
      pen.text([10, k ? 16 + 16 * k : 14], text, { fill, size: k ? 12 : 13, halo: palette.page });
    });
    if (options.colour && options.colour !== "none") this.legend(options.colour);
  }

  // The largest of a section force in the frame that is drawn, and that of all frames, which the diagram is scaled by.
  largest(by) {
    const [now, top] = [this.motion.sectionTop(this.state.index, FORCES[by]), this.motion.size.sections[FORCES[by]]];
    const [shown, ofAll] = [now, top].map((value) => engineering(value, UNITS[by]));
    return `${DIAGRAMS[by]} up to ${shown}` + (shown === ofAll ? "" : ` (maximum over time ${ofAll})`);
  }

  legend(by) {
    const { pen, view, palette } = this;
    const [x, y, width] = [view.width - 212, 10, 200];
    // Arrows of forces may be here; the scale has to be readable all the same.
    const plate = [[x - 8, 0], [view.width, 0], [view.width, y + 28], [x - 8, y + 28]];
    pen.path(plate, { fill: palette.page, opacity: 0.85, closed: true });
    for (let k = 0; k < 32; k++) {
      const a = x + (k * width) / 32;
      pen.path([[a, y], [a + width / 32 + 0.5, y], [a + width / 32 + 0.5, y + 8], [a, y + 8]], { fill: mapColour(k / 31), closed: true });
    }
    pen.text([x, y + 18], "0", { fill: palette.soft, size: 11 });
    const name = { stress: this.motion.yields ? "stress, elastic beams" : "largest stress", velocity: "speed" }[by] ?? `|${by}|`;
    pen.text([x + width, y + 18], `${name} ${engineering(this.colourTop(by), UNITS[by])}`, { fill: palette.soft, size: 11, align: "right" });
  }
}

if (typeof module !== "undefined") module.exports = { Drawing, mapColour };
