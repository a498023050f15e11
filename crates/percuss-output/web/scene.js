"use strict";

// The parts of a run and how they move: from scene.json and the frames to points in the plane.
// Beams are the solver's own curves: Hermite cubics through the stations. Between stations of shear-flexible beams the axis is a parabola and
// the normals of sections are straight lines: the nodal vectors are these normals, and not the slopes of the axis.

const PIECES = 400; // chords of all beams together, about
const ARC = 12; // chords of a quarter of a round end
const FORCES = { axial: 0, shear: 1, moment: 2 };

class Motion {
  // `scene` is scene.json; `frames` has time (n), displacement (n x nodes x 4), sections (n x intervals x 6), loads (n x loads),
  // contacts (all frames' rows of six, one behind the other) and contact_count (n), points (section forces inside intervals: all frames'
  // rows of five, one behind the other) and point_count (n).
  constructor(scene, frames) {
    this.scene = scene;
    this.frames = frames;
    this.count = frames.time.length;
    this.stations = scene.beams.reduce((n, b) => n + b.s.length, 0);
    this.nodes = this.stations + scene.bodies.length;
    this.beams = [];
    let node = 0;
    let interval = 0;
    for (const beam of scene.beams) {
      const spans = [];
      for (let k = 0; k + 1 < beam.s.length; k++) {
        if (beam.s[k + 1] > beam.s[k]) spans.push({ k, interval: interval++ });
      }
      this.beams.push({ first: node, spans });
      node += beam.s.length;
    }
    this.intervals = interval;
    this.pieces = Math.min(12, Math.max(1, Math.floor(PIECES / Math.max(1, interval))));
    const offsets = (counts) => {
      const all = [0];
      for (const n of counts) all.push(all[all.length - 1] + n);
      return all;
    };
    this.offsets = offsets(frames.contact_count);
    this.pointOffsets = offsets(frames.point_count ?? new Float32Array(this.count));
    this.size = this.measure();
  }

  get start() {
    return this.count ? this.frames.time[0] : 0;
  }

  get end() {
    return this.count ? this.frames.time[this.count - 1] : 0;
  }

  // A time in words, and as a drawing shows it.
  instantText(t) {
    return engineering(t, "s") || "0 s";
  }

  label(t) {
    return `t = ${this.instantText(t)}`;
  }

  // Whether velocities were kept.
  get hasVelocity() {
    return this.count > 0 && (this.frames.velocity?.length ?? 0) >= 4 * this.nodes * this.count;
  }

  // The last frame not after t.
  before(t) {
    const time = this.frames.time;
    let [low, high] = [0, this.count - 1];
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (time[middle] <= t) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  // The instant at which the scene shows what happens at time t: impulses are in the frame after an impact, half its interval later, or a
  // step later in time-stepping.
  instantShown(t) {
    if (!this.count) return t;
    const last = this.before(t);
    const strikes = (f) => f < this.count && this.contacts(f).some((c) => c.impulsive);
    return strikes(last + 1) && !(this.frames.time[last] === t && strikes(last)) ? this.frames.time[last + 1] : t;
  }

  // Largest displacement of a station in a frame [m].
  largestAt(index) {
    let most = 0;
    const n = 4 * this.nodes;
    for (let k = 0; k < this.stations && this.count; k++) {
      const node = index * n + 4 * k;
      most = Math.max(most, Math.hypot(this.frames.displacement[node], this.frames.displacement[node + 1]));
    }
    return most;
  }

  // The configuration at time t: displacements between frames are straight lines, forces those of the nearer frame.
  at(t) {
    if (!this.count) return { time: 0, u: new Float32Array(4 * this.nodes), forces: 0, index: 0 };
    const a = this.before(t);
    const b = Math.min(a + 1, this.count - 1);
    const [ta, tb] = [this.frames.time[a], this.frames.time[b]];
    const share = tb > ta ? Math.min(1, Math.max(0, (t - ta) / (tb - ta))) : 0;
    const n = 4 * this.nodes;
    const u = new Float32Array(n);
    const all = this.frames.displacement;
    for (let i = 0; i < n; i++) u[i] = (1 - share) * all[a * n + i] + share * all[b * n + i];
    return { time: t, u, index: share > 0.5 ? b : a };
  }

  // Contact forces of a frame: contact, position, force on the second partner, whether it is an impulse.
  contacts(index) {
    const out = [];
    const all = this.frames.contacts;
    for (let k = this.offsets[index]; k < this.offsets[index + 1]; k++) {
      const [contact, x, y, f, g, impulsive] = all.slice(6 * k, 6 * k + 6);
      out.push({ contact, position: [x, y], force: [f, g], impulsive: impulsive > 0.5 });
    }
    return out;
  }

  // Resultants of every contact in a frame: a contact may have a force and an impulse, which are not added.
  resultants(index) {
    const sums = new Map();
    for (const { contact, force, impulsive } of this.contacts(index)) {
      const key = 2 * contact + (impulsive ? 1 : 0);
      const sum = sums.get(key) ?? { contact, impulsive, force: [0, 0] };
      sum.force = sum.force.map((f, i) => f + force[i]);
      sums.set(key, sum);
    }
    return [...sums.values()].map(({ force, ...sum }) => ({ ...sum, size: Math.hypot(...force) }));
  }

  // The same as forces on the partner that is drawn to yield: the beam, where a body presses on one.
  pressing(c) {
    const { between } = this.scene.contacts[c.contact];
    const isBody = (name) => this.scene.bodies.some((b) => b.name === name) || this.scene.obstacles.some((o) => o.name === name);
    const flip = isBody(between[1]) && !isBody(between[0]);
    return { ...c, force: flip ? c.force.map((f) => -f) : c.force };
  }

  // Impulses of the frames between two times.
  impulses(from, to) {
    const out = [];
    for (let i = Math.max(0, this.before(from)); i < this.count && this.frames.time[i] <= to; i++) {
      if (this.frames.time[i] >= from) out.push(...this.contacts(i).filter((c) => c.impulsive));
    }
    return out;
  }

  // The field between stations k and k + 1 of a beam: nodal values of the cubic of its axis, and what its sections turn beyond the mean of
  // both ends, times 6 x (1 - x). Those of a slender beam are its places and slopes. The slopes of a shear-flexible beam differ from the
  // normals of its sections by the shear; `bent` is the share of bending.
  field(beam, k, [a, slope, b, other], length) {
    const { shear_flexible, bent } = this.scene.beams[beam];
    if (!shear_flexible) return { axis: [a, slope, b, other], turned: 0 };
    const difference = (b - a) / length - (slope + other) / 2;
    const turned = (bent?.[k] ?? 0) * difference;
    const shear = difference - turned;
    return { axis: [a, slope + shear, b, other + shear], turned };
  }

  // Position and unit normal on a beam between stations k and k + 1 at a share of the way.
  point(beam, k, share, u, exaggeration) {
    const b = this.scene.beams[beam];
    const node = 4 * (this.beams[beam].first + k);
    const length = b.s[k + 1] - b.s[k];
    const [x, y] = [share, 1 - share];
    const h = [y * y * (1 + 2 * x), length * x * y * y, x * x * (1 + 2 * y), -length * x * x * y];
    const d = [(6 * x * x - 6 * x) / length, 1 - 4 * x + 3 * x * x, (6 * x - 6 * x * x) / length, 3 * x * x - 2 * x];
    const moved = (i) => {
      const place = i ? b.y : b.x;
      const slope = i ? b.ty : b.tx;
      const e = exaggeration;
      return [
        place[k] + e * u[node + i],
        slope[k] + e * u[node + 2 + i],
        place[k + 1] + e * u[node + 4 + i],
        slope[k + 1] + e * u[node + 6 + i],
      ];
    };
    const sum = (n, v) => n[0] * v[0] + n[1] * v[1] + n[2] * v[2] + n[3] * v[3];
    const [v1, v2] = [moved(0), moved(1)];
    const [f1, f2] = [v1, v2].map((v) => this.field(beam, k, v, length));
    const along = (v, f) => (b.shear_flexible ? y * v[1] + x * v[3] + 6 * x * y * f.turned : sum(d, v));
    const [g1, g2] = [along(v1, f1), along(v2, f2)];
    const size = Math.hypot(g1, g2) || 1;
    const [p1, p2] = [f1, f2].map((f) => sum(h, f.axis));
    return { place: [p1, p2], tangent: [g1 / size, g2 / size], normal: [-g2 / size, g1 / size] };
  }

  // A place on a beam by arc length.
  on({ beam, s }, u, exaggeration = 1) {
    const b = this.scene.beams[beam];
    const spans = this.beams[beam].spans;
    const span = spans.find(({ k }) => s <= b.s[k + 1]) ?? spans[spans.length - 1];
    const share = (s - b.s[span.k]) / (b.s[span.k + 1] - b.s[span.k]);
    const out = this.point(beam, span.k, Math.min(1, Math.max(0, share)), u, exaggeration);
    const depths = [b.half_depth[span.k], b.half_depth[span.k + 1]];
    const depth = depths[0] == null || depths[1] == null ? 0 : depths[0] + share * (depths[1] - depths[0]);
    return { ...out, half_depth: depth };
  }

  // Whether a beam has parted between stations k and k + 1 by time t.
  isParted(beam, k, t) {
    const { s } = this.scene.beams[beam];
    return (this.scene.parted ?? []).some(({ beam: own, stretch: [from, to], time }) => {
      const overlap = Math.min(to, s[k + 1]) - Math.max(from, s[k]);
      return own === beam && time <= t && overlap > 1e-9 * (to - from);
    });
  }

  // Whether a station belongs to no piece of its beam at time t: all that it bounds has parted.
  isLoose(beam, k, t) {
    if (!this.scene.parted?.length) return false;
    const beside = this.beams[beam].spans.filter((span) => span.k === k || span.k === k - 1);
    return beside.every((span) => this.isParted(beam, span.k, t));
  }

  // By how much arcs towards round ends cut off either face at an arc length.
  cut(b, s) {
    const away = [s - b.s[0], b.s[b.s.length - 1] - s];
    return Math.max(...(b.roundings ?? [0, 0]).map((r, i) => (away[i] < r ? r - Math.sqrt(away[i] * (2 * r - away[i])) : 0)));
  }

  // Shares of the interval after station k at which a beam is drawn: evenly, at vertices of a diagram, and at even angles of the arcs of
  // round ends.
  shares(b, k, vertices = []) {
    const [from, to] = [b.s[k], b.s[k + 1]];
    const even = Array.from({ length: this.pieces + 1 }, (_, p) => p / this.pieces);
    const out = [...new Set([...even, ...vertices.map(([share]) => share)])];
    (b.roundings ?? []).forEach((r, i) => {
      for (let p = 1; r > 0 && p <= ARC; p++) {
        const away = r * (1 - Math.cos((p / ARC) * (Math.PI / 2)));
        const s = i ? b.s[b.s.length - 1] - away : b.s[0] + away;
        if (from < s && s < to) out.push((s - from) / (to - from));
      }
    });
    return out.sort((x, y) => x - y);
  }

  // A beam as parts without corner, nor what has parted by time t: rows of points with normal, half depth, how far the outline is from the
  // axis there, and the interval they belong to; through the vertices of the section forces of a frame, if it is given.
  curve(beam, u, exaggeration = 1, t = -Infinity, index = null) {
    const b = this.scene.beams[beam];
    const parts = [];
    let last = -2;
    for (const { k, interval } of this.beams[beam].spans) {
      if (this.isParted(beam, k, t)) continue;
      if (k !== last + 1) parts.push([]);
      last = k;
      const part = parts[parts.length - 1];
      const vertices = index == null ? [] : this.vertices(index, interval);
      // With a diagram both ends of an interval are drawn: section forces may jump there.
      for (const share of this.shares(b, k, vertices).slice(part.length && index == null ? 1 : 0)) {
        const point = this.point(beam, k, share, u, exaggeration);
        const depths = [b.half_depth[k], b.half_depth[k + 1]];
        point.half_depth = depths[0] == null || depths[1] == null ? null : depths[0] + share * (depths[1] - depths[0]);
        point.reach = point.half_depth == null ? null : point.half_depth - this.cut(b, b.s[k] + share * (b.s[k + 1] - b.s[k]));
        point.interval = interval;
        point.share = share;
        point.k = k;
        part.push(point);
      }
    }
    return parts;
  }

  body(index, u) {
    const node = 4 * (this.stations + index);
    const { position } = this.scene.bodies[index];
    return { place: [position[0] + u[node], position[1] + u[node + 1]], angle: u[node + 2] };
  }

  // Section forces along an interval in the frame of this number, as vertices of straight lines: share of the way, then axial force, shear
  // force and moment. Where they jump two vertices are at one place.
  vertices(index, interval) {
    if (this.inside?.index !== index) {
      this.inside = { index, of: new Map() };
      for (let k = this.pointOffsets[index]; k < this.pointOffsets[index + 1]; k++) {
        const [own, ...vertex] = this.frames.points.slice(5 * k, 5 * k + 5);
        if (!this.inside.of.has(own)) this.inside.of.set(own, []);
        this.inside.of.get(own).push(vertex);
      }
    }
    const at = 6 * (index * this.intervals + interval);
    const end = (k) => [k, ...this.frames.sections.slice(at + 3 * k, at + 3 * k + 3)];
    return [end(0), ...(this.inside.of.get(interval) ?? []), end(1)];
  }

  // Axial force, shear force and moment at a point of a curve, in the frame of this number: behind it and ahead of it.
  sides(index, point) {
    const all = this.vertices(index, point.interval);
    const x = point.share;
    const mix = (a, b) => {
      const y = b[0] > a[0] ? (x - a[0]) / (b[0] - a[0]) : 0;
      return [1, 2, 3].map((i) => (1 - y) * a[i] + y * b[i]);
    };
    const to = Math.max(1, all.findIndex((v) => v[0] >= x)); // the first not before the point
    const after = all.findIndex((v) => v[0] > x);
    const behind = mix(all[to - 1], all[to]);
    return [behind, after > 0 ? mix(all[after - 1], all[after]) : behind];
  }

  section(index, point) {
    return this.sides(index, point)[1];
  }

  // Largest of the axial forces, shear forces or moments of all beams in a frame.
  sectionTop(index, which) {
    let top = 0;
    const size = 6 * this.intervals;
    for (let i = index * size + which; i < (index + 1) * size; i += 3) top = Math.max(top, Math.abs(this.frames.sections[i]));
    for (let k = this.pointOffsets[index]; k < this.pointOffsets[index + 1]; k++) top = Math.max(top, Math.abs(this.frames.points[5 * k + 2 + which]));
    return top;
  }

  // The largest of a run that was noted in the scene for all beams (axial, shear, moment, stress), which may be between two frames; null if
  // none was.
  largestOf(what, beams = this.scene.beams) {
    const all = beams.map((b) => b.largest?.[what]);
    return all.length && all.every(Number.isFinite) ? Math.max(...all) : null;
  }

  // Largest stress of the fibres [Pa], by the section at the point; null without a depth, and where the section can yield.
  stress(index, beam, point) {
    const b = this.scene.beams[beam];
    if (point.half_depth == null || b.inertia[point.k] == null) return null;
    const mix = (row) => row[point.k] + point.share * (row[point.k + 1] - row[point.k]);
    const [axial, , moment] = this.section(index, point);
    return Math.abs(axial) / mix(b.area) + (Math.abs(moment) * point.half_depth) / mix(b.inertia);
  }

  // Size of the velocity at a point of a curve [m/s], the rate of the same cubic.
  speed(index, beam, point) {
    const b = this.scene.beams[beam];
    const at = 4 * (index * this.nodes + this.beams[beam].first + point.k);
    const all = this.frames.velocity;
    const length = b.s[point.k + 1] - b.s[point.k];
    const [x, y] = [point.share, 1 - point.share];
    const h = [y * y * (1 + 2 * x), length * x * y * y, x * x * (1 + 2 * y), -length * x * x * y];
    const along = (i) => {
      const { axis: v } = this.field(beam, point.k, [all[at + i], all[at + 2 + i], all[at + 4 + i], all[at + 6 + i]], length);
      return h[0] * v[0] + h[1] * v[1] + h[2] * v[2] + h[3] * v[3];
    };
    return Math.hypot(along(0), along(1));
  }

  // Whether a beam has no stress by its forces: it can yield.
  get yields() {
    return this.scene.beams.some((b) => b.inertia.some((value) => value == null));
  }

  // What colours show at a point of a curve: largest stress of the fibres, speed, or the size of a section force; null where it is
  // not known.
  quantity(by, index, beam, point) {
    if (by === "stress") return this.stress(index, beam, point);
    if (by === "velocity") return this.hasVelocity ? this.speed(index, beam, point) : 0;
    return Math.abs(this.section(index, point)[FORCES[by]]);
  }

  // Extremes over all frames, found once: bounds of the beams and of all, largest displacement and forces.
  measure() {
    const none = () => ({ low: [Infinity, Infinity], high: [-Infinity, -Infinity] });
    const grow = (box, [x, y], r = 0) => {
      box.low = [Math.min(box.low[0], x - r), Math.min(box.low[1], y - r)];
      box.high = [Math.max(box.high[0], x + r), Math.max(box.high[1], y + r)];
    };
    const rest = none();
    let displacement = 0;
    const n = 4 * this.nodes;
    const stride = Math.max(1, Math.floor((this.count * this.nodes) / 2e5));
    const stations = []; // each where it rests, with the bounds of its displacements
    this.scene.beams.forEach((b, i) => {
      for (let k = 0; k < b.s.length; k++) {
        const r = b.half_depth[k] ?? 0;
        grow(rest, [b.x[k], b.y[k]], r);
        const node = 4 * (this.beams[i].first + k);
        const moved = none();
        grow(moved, [0, 0]);
        for (let f = 0; f < this.count; f += f + stride < this.count || f === this.count - 1 ? stride : this.count - 1 - f) {
          if (this.isLoose(i, k, this.frames.time[f])) continue;
          const [u1, u2] = [this.frames.displacement[f * n + node], this.frames.displacement[f * n + node + 1]];
          displacement = Math.max(displacement, Math.hypot(u1, u2));
          grow(moved, [u1, u2]);
        }
        stations.push({ place: [b.x[k], b.y[k]], r, moved });
      }
    });
    // All that the beams pass through with displacements enlarged.
    const box = (factor = 1) => {
      const out = none();
      for (const { place, r, moved } of stations) {
        for (const u of [moved.low, moved.high]) grow(out, [place[0] + factor * u[0], place[1] + factor * u[1]], r);
      }
      return out;
    };
    const arrows = { force: 0, impulse: 0 }; // of one pair
    const resultants = { force: [0, null], impulse: [0, null] }; // of a contact: largest, and when
    for (let f = 0; f < this.count; f++) {
      for (const c of this.contacts(f)) {
        const kind = c.impulsive ? "impulse" : "force";
        arrows[kind] = Math.max(arrows[kind], Math.hypot(...c.force));
      }
      for (const { impulsive, size } of this.resultants(f)) {
        const kind = impulsive ? "impulse" : "force";
        if (size > resultants[kind][0]) resultants[kind] = [size, this.frames.time[f]];
      }
    }
    const peak = resultants.force[1] ?? resultants.impulse[1];
    const sections = Object.entries(FORCES).map(([what, i]) => {
      const ofFrames = () => this.frames.time.reduce((top, _, f) => Math.max(top, this.sectionTop(f, i)), 0);
      return this.largestOf(what) ?? ofFrames();
    });
    let loads = 1; // largest factor
    for (const factor of this.frames.loads) loads = Math.max(loads, Math.abs(factor));
    return { box, rest, displacement, ...arrows, peak, sections, loads };
  }
}

// Five digits as an engineer writes them, as in the tables of the page (report/quantity.rs): no prefix from 1 to 10 000, above and below it
// a prefix of thousands. Velocities have none, nor have stresses and forces or stiffnesses per length below 1.
function engineering(value, unit) {
  if (!Number.isFinite(value)) return "";
  // The prefix is that of the number as it is shown.
  const size = Math.abs(Number(value.toPrecision(5)));
  const steps = [[1e12, "T"], [1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "\u00b5"], [1e-9, "n"], [1e-12, "p"]];
  if (size < 1e-12) return `0 ${unit}`;
  const large = ["Pa", "N/m", "N/m\u00b2"].includes(unit) && size >= 1;
  const plain = !(large || ["s", "m", "N", "N s", "J", "N m"].includes(unit)) || (size >= 1 && size < 1e4);
  const [by, prefix] = plain ? [1, ""] : steps.find(([by]) => size >= by);
  return `${fiveDigits(value / by)} ${prefix}${unit}`;
}

// Plain where that is short, else with an exponent.
function fiveDigits(value) {
  const exponent = value === 0 ? 0 : Math.floor(Math.log10(Math.abs(value)));
  if (exponent >= -4 && exponent < 9) return `${Number(value.toPrecision(5))}`;
  const [digits, power] = value.toExponential(3).split("e");
  return `${Number(digits)}e${Number(power)}`;
}

if (typeof module !== "undefined") module.exports = { Motion, engineering };
