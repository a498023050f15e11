"use strict";

// Symbols of supports and loads, as engineers draw them; part of the drawing.

Object.assign(Drawing.prototype, {
  supports() {
    for (const support of this.motion.scene.supports) {
      if (support.until != null && this.state.time > support.until) continue;
      if (support.kind === "stop" && this.options.bodies === false) continue;
      const at = this.motion.on(support.at, this.state.u, this.e);
      const rest = this.motion.on(support.at, new Float32Array(4 * this.motion.nodes));
      const draw = { clamp: "clamp", pin: "pin", roller: "roller", guide: "clamp", elastic: "elastic", stop: "stop" }[support.kind];
      this[draw](support, at, rest);
    }
  },

  // A hatched wall across the beam, behind its end; to one side of a beam that goes on.
  clamp(support, at) {
    const { spans } = this.motion.beams[support.at.beam];
    const beam = this.motion.scene.beams[support.at.beam];
    const last = beam.s[spans[spans.length - 1].k + 1];
    const into = support.at.s > 0.5 * last ? 1 : -1;
    const half = Math.max(SYMBOL + 3, at.half_depth * this.view.scale + 5);
    const p = this.view.to(at.place);
    const n = [at.normal[0], -at.normal[1]];
    const t = [into * at.tangent[0], -into * at.tangent[1]];
    const end = (side) => [p[0] + side * half * n[0], p[1] + side * half * n[1]];
    this.pen.path([end(1), end(-1)], { stroke: this.palette.symbol, width: 2 });
    this.hatch(end(1), end(-1), t, 7);
  },

  // A triangle with its tip at the point, its base `down`.
  triangle(p, down, size) {
    const across = [-down[1], down[0]];
    const base = (side) => [p[0] + size * down[0] * 1.4 + side * size * across[0] * 0.8, p[1] + size * down[1] * 1.4 + side * size * across[1] * 0.8];
    this.pen.path([p, base(1), base(-1)], { fill: this.palette.page, stroke: this.palette.symbol, width: 1.5, closed: true });
    return [base(1), base(-1)];
  },

  // The support keeps its orientation, however the beam turns in it.
  pin(support, at, rest) {
    const p = this.view.to(at.place);
    const down = Math.abs(rest.tangent[1]) > 0.8 ? [-Math.sign(rest.normal[0] || 1), 0] : [0, 1];
    const [a, b] = this.triangle(p, down, SYMBOL);
    this.hatch(a, b, down, 6);
  },

  roller(support, at) {
    const p = this.view.to(at.place);
    const along = [support.direction[0], -support.direction[1]];
    let down = [-along[1], along[0]];
    if (down[1] < 0 || (down[1] === 0 && down[0] > 0)) down = [-down[0], -down[1]];
    const [a, b] = this.triangle(p, down, SYMBOL);
    const off = ([x, y]) => [x + 5 * down[0], y + 5 * down[1]];
    this.pen.path([off(a), off(b)], { stroke: this.palette.symbol, width: 1.5 });
  },

  // A spring to a hatched line.
  elastic(support, at, rest) {
    const p = this.view.to(at.place);
    const q = this.view.to(rest.place);
    let d = [support.direction[0], -support.direction[1]];
    if (d[1] < 0 || (d[1] === 0 && d[0] > 0)) d = [-d[0], -d[1]];
    const foot = [q[0] + 26 * d[0], q[1] + 26 * d[1]];
    this.coil(p, foot, 5, { stroke: this.palette.symbol, width: 1.4 });
    const across = [-d[1], d[0]];
    const end = (side) => [foot[0] + side * SYMBOL * across[0], foot[1] + side * SYMBOL * across[1]];
    this.pen.path([end(-1), end(1)], { stroke: this.palette.symbol, width: 1.5 });
    this.hatch(end(-1), end(1), d, 6);
  },

  // Springs from the beam to a hatched line on the side away from which a foundation pushes. Those of compression alone stay behind where the
  // beam lifts off.
  foundations() {
    const still = new Float32Array(4 * this.motion.nodes);
    for (const { beam, stretch, direction, lifts } of this.motion.scene.foundations ?? []) {
      const length = (stretch[1] - stretch[0]) * this.view.scale;
      const pieces = Math.min(24, Math.max(1, Math.round(length / 36)));
      const at = (share) => {
        const place = { beam, s: stretch[0] + (stretch[1] - stretch[0]) * share };
        const rest = this.motion.on(place, still);
        const push = direction ?? rest.normal;
        const down = [-push[0], push[1]];
        const below = (p, way) => [p[0] + way * down[0], p[1] + way * down[1]];
        const surface = rest.half_depth * this.view.scale;
        const foot = below(this.view.to(rest.place), surface + 22);
        return { place, rest, push, down, foot, face: (p) => below(this.view.to(p), surface) };
      };
      for (let k = 0; k < pieces; k++) {
        const [from, middle, to] = [k, k + 0.5, k + 1].map((n) => at(n / pieces));
        const { place } = this.motion.on(middle.place, this.state.u, this.e);
        const rise = [0, 1].reduce((sum, i) => sum + (place[i] - middle.rest.place[i]) * middle.push[i], 0);
        const top = lifts && rise > 0 ? middle.face(middle.rest.place) : this.view.to(place);
        this.coil(top, middle.foot, 4, { stroke: this.palette.symbol, width: 1.1 });
        this.pen.path([from.foot, to.foot], { stroke: this.palette.symbol, width: 1.5 });
        this.hatch(from.foot, to.foot, middle.down, 5);
      }
    }
  },

  // A plate where the way ends, on a spring to ground.
  stop(support, at, rest) {
    const sides = support.two_sided ? [1, -1] : [1];
    for (const side of sides) {
      const d = [side * support.direction[0], -side * support.direction[1]];
      const surface = rest.half_depth * this.view.scale;
      const q = this.view.to(rest.place);
      const moved = this.view.to(at.place);
      const way = Math.max(support.gap * this.view.scale, (moved[0] - q[0]) * d[0] + (moved[1] - q[1]) * d[1]);
      const plate = [q[0] + (way + surface) * d[0], q[1] + (way + surface) * d[1]];
      const foot = [q[0] + (support.gap * this.view.scale + surface + 24) * d[0], q[1] + (support.gap * this.view.scale + surface + 24) * d[1]];
      const across = [-d[1], d[0]];
      const end = (p, s) => [p[0] + s * SYMBOL * across[0], p[1] + s * SYMBOL * across[1]];
      this.pen.path([end(plate, -1), end(plate, 1)], { stroke: this.palette.symbol, width: 2 });
      this.coil(plate, foot, 4, { stroke: this.palette.symbol, width: 1.2 });
      this.pen.path([end(foot, -1), end(foot, 1)], { stroke: this.palette.symbol, width: 1.5 });
      this.hatch(end(foot, -1), end(foot, 1), d, 6);
    }
  },

  // Arrows as long as the load is strong beside the strongest of its kind, now beside ever.
  loads() {
    const { scene, frames } = this.motion;
    const count = scene.loads.length;
    if (!count) return;
    const top = (kind, of) => Math.max(...scene.loads.filter((l) => l.kind === kind).flatMap(of), 0);
    const most = {
      point: top("point", (l) => [Math.hypot(...l.force)]),
      distributed: top("distributed", (l) => l.force.map((f) => Math.hypot(...f))),
    };
    scene.loads.forEach((load, k) => {
      const factor = (frames.loads[this.state.index * count + k] ?? 0) / this.motion.size.loads;
      if (load.kind === "gravity") this.acceleration(load, factor, "g", 22);
      if (load.kind === "base") this.acceleration(load, factor, "a", 70);
      if (factor === 0) return;
      if (load.kind === "point") this.pointLoad(load, factor, most.point);
      if (load.kind === "strain") this.strainedStretch(load);
      if (load.kind === "distributed") this.distributedLoad(load, factor, most.distributed);
    });
  },

  // A dashed line along a stretch that heat or another given strain would lengthen or bend.
  strainedStretch({ beam, stretch }) {
    const points = [];
    for (let k = 0; k <= 24; k++) {
      const place = { beam, s: stretch[0] + ((stretch[1] - stretch[0]) * k) / 24 };
      points.push(this.view.to(this.motion.on(place, this.state.u, this.e).place));
    }
    this.pen.path(points, { stroke: this.palette.load, width: 1.5, dash: [3, 3] });
  },

  // Gravity, or the acceleration of the base, so many pixels from the right edge.
  acceleration(load, factor, name, aside) {
    const size = Math.hypot(...load.acceleration) * Math.sign(factor);
    if (!size) return;
    const d = [load.acceleration[0] / size, -load.acceleration[1] / size];
    const from = [this.view.width - aside - 12 * d[0], this.view.height - 34 - 12 * d[1]];
    this.arrow(from, [from[0] + 26 * d[0], from[1] + 26 * d[1]], { stroke: this.palette.load, width: 1.5 });
    this.pen.text([from[0] - 12, from[1] + 4], name, { fill: this.palette.load, size: 12 });
  },

  // A force as pixels: along e1, e2, or with the tangent.
  loadDirection(load, force, at) {
    const [f, g] = force;
    const [t, n] = [at.tangent, at.normal];
    const v = load.follower ? [f * t[0] + g * n[0], f * t[1] + g * n[1]] : force;
    return [v[0], -v[1]];
  },

  pointLoad(load, factor, most) {
    const at = this.motion.on(load.at, this.state.u, this.e);
    const tip = this.view.to(at.place);
    const v = this.loadDirection(load, load.force, at);
    const size = Math.hypot(...v);
    if (size > 0) {
      const length = Math.sign(factor) * (10 + 34 * Math.min(1, Math.abs(factor)) * (size / most));
      this.arrow([tip[0] - (length * v[0]) / size, tip[1] - (length * v[1]) / size], tip, { stroke: this.palette.load, width: 2 });
    }
    if (load.moment) {
      const turn = Math.sign(load.moment * factor);
      const points = [];
      for (let k = 0; k <= 20; k++) {
        const a = turn * (-0.6 + (k / 20) * 4.2);
        points.push([tip[0] + 15 * Math.cos(a), tip[1] - 15 * Math.sin(a)]);
      }
      this.pen.path(points.slice(0, -1), { stroke: this.palette.load, width: 2 });
      this.arrow(points[17], points[20], { stroke: this.palette.load, width: 2 });
    }
  },

  distributedLoad(load, factor, most) {
    const { view } = this;
    const [from, to] = load.stretch;
    const a = view.to(this.motion.on({ beam: load.beam, s: from }, this.state.u, this.e).place);
    const b = view.to(this.motion.on({ beam: load.beam, s: to }, this.state.u, this.e).place);
    const count = Math.min(16, Math.max(2, Math.round(Math.hypot(b[0] - a[0], b[1] - a[1]) / 28)));
    const tails = [];
    for (let k = 0; k <= count; k++) {
      const share = k / count;
      const force = [0, 1].map((i) => (1 - share) * load.force[0][i] + share * load.force[1][i]);
      const at = this.motion.on({ beam: load.beam, s: from + share * (to - from) }, this.state.u, this.e);
      const v = this.loadDirection(load, force, at).map((x) => x * Math.sign(factor));
      const size = Math.hypot(...v);
      const p = view.to(at.place);
      const length = size > 0 ? 6 + 18 * Math.min(1, Math.abs(factor)) * (size / most) : 0;
      const depth = at.half_depth * view.scale;
      const d = size > 0 ? [v[0] / size, v[1] / size] : [0, 0];
      const tip = [p[0] - depth * d[0], p[1] - depth * d[1]];
      const tail = [tip[0] - length * d[0], tip[1] - length * d[1]];
      tails.push(tail);
      if (length > 6.5) this.arrow(tail, tip, { stroke: this.palette.load, width: 1.2 });
    }
    this.pen.path(tails, { stroke: this.palette.load, width: 1.2 });
  },
});
