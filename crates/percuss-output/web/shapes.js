"use strict";

// Structures at rest, along a path of equilibria, and swinging in a shape: motions that the drawing takes like that of a run.

// Some of the frames, as frames of their own.
function takeFrames(frames, list) {
  const n = frames.time.length;
  const rows = (all) => {
    const width = n ? all.length / n : 0;
    return Float32Array.from(list.flatMap((k) => Array.from(all.slice(k * width, (k + 1) * width))));
  };
  // Lists of which every frame has as many rows as it needs.
  const lists = (all, counts, width) => {
    const from = [0];
    for (const count of counts) from.push(from[from.length - 1] + width * count);
    return Float32Array.from(list.flatMap((k) => Array.from(all.slice(from[k], from[k + 1]))));
  };
  const points = frames.point_count ?? new Float32Array(n);
  return {
    time: Float64Array.from(list, (k) => frames.time[k]),
    displacement: rows(frames.displacement),
    velocity: new Float32Array(0),
    sections: rows(frames.sections),
    loads: rows(frames.loads),
    points: lists(frames.points ?? new Float32Array(0), points, 5),
    point_count: Float32Array.from(list, (k) => points[k]),
    contacts: lists(frames.contacts, frames.contact_count, 6),
    contact_count: Float32Array.from(list, (k) => frames.contact_count[k]),
  };
}

// Equilibria that do not move with time.
class RestingMotion extends Motion {
  instantText() {
    return "";
  }

  label() {
    return "";
  }

  get rests() {
    return true;
  }
}

// Equilibria along a path, one a unit of time; `factors` are those on the loads.
class PathMotion extends RestingMotion {
  constructor(scene, frames, factors) {
    super(scene, { ...frames, time: Float64Array.from(factors, (_, k) => k) });
    this.factors = factors;
  }

  factor(t) {
    const k = Math.min(this.count - 2, Math.max(0, Math.floor(t)));
    if (this.count < 2) return this.factors[0];
    const share = Math.min(1, Math.max(0, t - k));
    return share === 1 ? this.factors[k + 1] : (1 - share) * this.factors[k] + share * this.factors[k + 1];
  }

  instantText(t) {
    return `load factor ${significant(this.factor(t), 5)}`;
  }

  label(t) {
    return this.instantText(t);
  }
}

const SWING = 0.1; // largest displacement of a shape, as a share of the structure's size
const LEAST = 0.25; // share of that which obstacles must leave
const BENT = 0.5; // largest strain of the faces of a shape: at one they would fold
const TURNED = 0.5; // largest rotation of shear-flexible sections in a shape [rad]

// The factor on displacements at which bending strains the faces of beams by `BENT`, or shear-flexible sections rotate by `TURNED`.
function factorOfSections(motion, swing) {
  let most = 0;
  motion.scene.beams.forEach((b, i) => {
    for (const { k } of motion.beams[i].spans) {
      const node = 4 * (motion.beams[i].first + k);
      const turn = Math.hypot(swing[node + 6] - swing[node + 2], swing[node + 7] - swing[node + 3]);
      const depth = Math.max(b.half_depth[k] ?? 0, b.half_depth[k + 1] ?? 0);
      most = Math.max(most, (turn * depth) / (b.s[k + 1] - b.s[k]) / BENT);
      const ends = b.shear_flexible ? [node, node + 4] : [];
      for (const end of ends) most = Math.max(most, Math.hypot(swing[end + 2], swing[end + 3]) / TURNED);
    }
  });
  return most > 0 ? 1 / most : Infinity;
}

// A shape about a configuration (the reference without one), a period in a unit of time, no farther than nothing overlaps.
class ShapeMotion extends RestingMotion {
  constructor(scene, frames, shape, about) {
    const one = takeFrames(frames, [about ?? shape]);
    const base = about == null ? new Float32Array(one.displacement.length) : one.displacement;
    const swing = takeFrames(frames, [shape]).displacement;
    const at = (factor) => swing.map((v, i) => base[i] + factor * v);
    const still = new Motion(scene, { ...one, displacement: base });
    // Obstacles that nothing presses on are ignored: they are left out where they would leave next to nothing to see.
    const most = Math.min(SWING * new Clearance(still).size, factorOfSections(still, swing));
    const room = (obstacles) => {
      const clearance = new Clearance(still, { bodies: false, obstacles });
      return Math.min(clearance.share(base, at(most)), clearance.share(base, at(-most)));
    };
    const beside = room(true);
    const obstacles = beside > LEAST || one.contact_count[0] > 0;
    const amplitude = most * (obstacles ? beside : room(false));
    const thrice = (list) => Float32Array.from([...list, ...list, ...list]);
    super(scene, {
      ...one, time: Float64Array.of(0, 0.25, 0.75), displacement: Float32Array.from([...base, ...at(amplitude), ...at(-amplitude)]),
      sections: thrice(one.sections), points: thrice(one.points), point_count: thrice(one.point_count), loads: thrice(one.loads), contacts: thrice(one.contacts), contact_count: thrice(one.contact_count),
    });
    Object.assign(this, { base, swing, amplitude, obstacles });
  }

  at(t) {
    const factor = this.amplitude * Math.sin(2 * Math.PI * t);
    return { time: 0, u: this.swing.map((v, i) => this.base[i] + factor * v), index: 0 };
  }
}
