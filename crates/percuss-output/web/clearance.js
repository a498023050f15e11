"use strict";

// How far displacements may be enlarged: no further than bodies stay apart that are apart, and beams uncrossed that do not cross.

const LOOKED_AT = 150; // points of all beams together, about
const CLEAR = 5e-4; // overlaps below this share of the structure's size are none to the eye
const LOOK = 0.02; // largest way between two looks, as a share of the size
const MOST_LOOKS = 400;
const ROUND_OFF = 1e-7; // gaps below this share of the size are none: displacements are of single precision

class Clearance {
  // Without `bodies` discs and stops are not looked at, without `obstacles` these.
  constructor(motion, { bodies = true, obstacles = true } = {}) {
    const { scene } = motion;
    this.motion = motion;
    this.bodies = bodies ? scene.bodies.map((b, i) => [b, i]).filter(([b]) => b.kind === "disc") : [];
    this.obstacles = obstacles ? scene.obstacles : [];
    this.stops = bodies ? scene.supports.filter((s) => s.kind === "stop") : [];
    const { low, high } = motion.size.rest;
    this.size = Math.max(high[0] - low[0], high[1] - low[1], 1e-9) || 1;
    const points = motion.intervals * (motion.pieces + 1);
    this.every = Math.max(1, Math.ceil(points / LOOKED_AT));
  }

  // Segments [a, b, half depth] of each beam.
  beams(u) {
    return this.motion.scene.beams.map((_, i) => {
      const out = [];
      for (const part of this.motion.curve(i, u, 1, Infinity)) {
        const kept = part.filter((_, k) => k % this.every === 0 || k === part.length - 1);
        for (let k = 0; k + 1 < kept.length; k++) {
          out.push([kept[k].place, kept[k + 1].place, Math.max(kept[k].half_depth ?? 0, kept[k + 1].half_depth ?? 0)]);
        }
      }
      return out;
    });
  }

  // Gaps of all pairs, and how often the lines of beams cross, with beams displaced by `u` and bodies where they are at `at`.
  measure(u, at) {
    const beams = this.beams(u);
    const [gaps, crossed] = [[], []];
    beams.forEach((beam, i) => {
      crossed.push(crossings(beam, beam));
      for (let j = 0; j < i; j++) {
        gaps.push(gapBetween(beam, beams[j], this.size));
        crossed.push(crossings(beam, beams[j]));
      }
      for (const [disc, k] of this.bodies) {
        const { place } = this.motion.body(k, at);
        gaps.push(gapBetween(beam, [[place, place, disc.radius]], this.size));
      }
      for (const o of this.obstacles) {
        gaps.push(this.gapTo(beam, o, at));
        if (o.kind === "walls") crossed.push(crossings(beam, this.walls(o, at)));
      }
    });
    for (const stop of this.stops) {
      const [now, rest] = [u, new Float32Array(u.length)].map((v) => this.motion.on(stop.at, v).place);
      const way = (now[0] - rest[0]) * stop.direction[0] + (now[1] - rest[1]) * stop.direction[1];
      gaps.push(stop.gap - (stop.two_sided ? Math.abs(way) : way));
    }
    return { gaps, crossed };
  }

  // A place of an obstacle, which may move.
  moved(o, [x, y], at) {
    if (o.body == null) return [x, y];
    const { place } = this.motion.body(o.body, at);
    const { position } = this.motion.scene.bodies[o.body];
    return [x + place[0] - position[0], y + place[1] - position[1]];
  }

  walls(o, at) {
    return o.ends.map(([a, b]) => [this.moved(o, a, at), this.moved(o, b, at), o.thickness / 2]);
  }

  gapTo(beam, o, at) {
    const moved = (place) => this.moved(o, place, at);
    if (o.kind === "disc") return gapBetween(beam, [[moved(o.centre), moved(o.centre), o.radius]], this.size);
    if (o.kind === "walls") return gapBetween(beam, this.walls(o, at), this.size);
    const p = moved(o.point);
    const out = ([x, y]) => (x - p[0]) * o.normal[0] + (y - p[1]) * o.normal[1];
    return Math.min(...beam.map(([a, b, r]) => Math.min(out(a), out(b)) - r));
  }

  // The share of the way from displacements `from` to `to` up to which nothing overlaps that does not at `from`. Between two looks
  // nothing moves farther than the least gap, what touches hardly at all, so that nothing slips through anything else.
  share(from, to, at = from) {
    const mix = (x) => from.map((v, i) => v + x * (to[i] - v));
    let way = 0;
    for (let n = 0; n < this.motion.stations; n++) way = Math.max(way, Math.hypot(to[4 * n] - from[4 * n], to[4 * n + 1] - from[4 * n + 1]));
    if (!(way > 0)) return 1;
    const none = CLEAR * this.size;
    const start = this.measure(from, at);
    const apart = start.gaps.map((gap) => gap > ROUND_OFF * this.size);
    const least = start.gaps.map((gap, i) => (apart[i] ? Math.min(none, 0.1 * gap) : Math.min(gap, 0) - none));
    const allowed = ({ gaps, crossed }) => gaps.every((gap, i) => gap >= least[i]) && crossed.every((n, i) => n <= start.crossed[i]);
    const room = (gap, i) => (apart[i] ? gap : start.gaps[i] > -none ? Math.max(gap, none) : LOOK * this.size);
    let [share, now] = [0, start];
    for (let k = 0; k < MOST_LOOKS; k++) {
      const free = now.gaps.reduce((free, gap, i) => Math.min(free, room(gap, i)), LOOK * this.size);
      const next = Math.min(1, share + (0.9 * free) / way);
      now = this.measure(mix(next), at);
      if (!allowed(now)) return share;
      share = next;
      if (share === 1) return 1;
    }
    return share;
  }
}

// Least distance of segments less their half depths; what is farther apart than `far` is not looked at closely.
function gapBetween(some, others, far) {
  let least = far;
  for (const [a, b, r] of some) {
    for (const [c, d, q] of others) {
      const apart = (i) => Math.max(Math.min(a[i], b[i]) - Math.max(c[i], d[i]), Math.min(c[i], d[i]) - Math.max(a[i], b[i]));
      if (Math.max(apart(0), apart(1)) - r - q >= least) continue;
      least = Math.min(least, distance(a, b, c, d) - r - q);
    }
  }
  return least;
}

function distance(a, b, c, d) {
  if (cross(a, b, c, d)) return 0;
  const to = (p, q, r) => {
    const [x, y] = [r[0] - q[0], r[1] - q[1]];
    const along = x * x + y * y;
    const share = along > 0 ? Math.min(1, Math.max(0, ((p[0] - q[0]) * x + (p[1] - q[1]) * y) / along)) : 0;
    return Math.hypot(p[0] - q[0] - share * x, p[1] - q[1] - share * y);
  };
  return Math.min(to(a, c, d), to(b, c, d), to(c, a, b), to(d, a, b));
}

// Whether two segments cross between their ends; those that meet at an end do not.
function cross(a, b, c, d) {
  const [x, y, z, w] = [b[0] - a[0], b[1] - a[1], d[0] - c[0], d[1] - c[1]];
  const turn = x * w - y * z;
  if (turn === 0) return false;
  const s = ((c[0] - a[0]) * w - (c[1] - a[1]) * z) / turn;
  const t = ((c[0] - a[0]) * y - (c[1] - a[1]) * x) / turn;
  const inside = (v) => v > 1e-4 && v < 1 - 1e-4;
  return inside(s) && inside(t);
}

function crossings(some, others) {
  let count = 0;
  some.forEach(([a, b], i) => others.forEach(([c, d], j) => (count += (some !== others || j > i + 1) && cross(a, b, c, d))));
  return count;
}

const FRAMES_LOOKED_AT = 8;

// Factors by which displacements may be drawn, 1 first: 2, 5, 10, ... up to where they fill half the structure or bodies would overlap.
function exaggerations(motion) {
  const most = motion.size.displacement;
  const clearance = new Clearance(motion);
  if (!(most > 0) || !motion.stations) return [1];
  const factors = [1];
  for (let power = 1; power < 1e9; power *= 10) factors.push(2 * power, 5 * power, 10 * power);
  const wanted = factors.filter((f) => f * most <= 0.5 * clearance.size);
  const limit = roomUpTo(motion, clearance, wanted.length ? wanted[wanted.length - 1] : 1, FRAMES_LOOKED_AT);
  return factors.filter((f) => f === 1 || f <= limit * (1 + 1e-9));
}

// The factor up to `limit` that leaves bodies apart in so many frames.
function roomUpTo(motion, clearance, limit, frames) {
  const stride = Math.max(1, Math.ceil(motion.count / frames));
  for (let k = 0; k < motion.count && limit > 1; k = k + stride < motion.count || k === motion.count - 1 ? k + stride : motion.count - 1) {
    const { u } = motion.at(motion.frames.time[k]);
    limit = 1 + (limit - 1) * clearance.share(u, u.map((v) => limit * v));
  }
  return limit;
}

const FRAMES_OF_A_FILM = 60;

// Why displacements may not be drawn so many times as large as they are: two bodies that touch, or how much larger they may be; null
// if nothing is in the way.
function hindrance(motion, factor) {
  if (factor === 1 || canExaggerate(motion)) return null;
  const guided = new Set(motion.scene.bodies.filter((b) => b.kind === "guided" || b.kind === "rear").map((b) => b.name));
  for (let f = 0; f < motion.count; f++) {
    for (const { contact } of motion.contacts(f)) {
      const { name, between } = motion.scene.contacts[contact];
      if (!between.some((partner) => guided.has(partner))) return { contact: name, between };
    }
  }
  const most = roomUpTo(motion, new Clearance(motion), factor, FRAMES_OF_A_FILM);
  return most < factor * (1 - 1e-9) ? { most } : null;
}

const VISIBLE = 0.1; // displacements that are seen well, as a share of the structure's size

// The largest of the factors at which displacements are no more than well visible.
function visibleFactor(motion, factors) {
  const { low, high } = motion.size.rest;
  const size = Math.max(high[0] - low[0], high[1] - low[1]);
  return factors.reduce((best, f) => (f * motion.size.displacement <= VISIBLE * size ? f : best), 1);
}
