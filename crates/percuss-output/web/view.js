"use strict";

// What of a scene is shown, and where a point of it stands on the screen.

const MARGIN = 34; // pixels around the structure
const ARROW_MARGIN = 52; // where arrows of forces stand around it
const FOOT = 18; // of the axes and the scale below it
const [SPRING, BLOCK, REAR] = [34, 22, 54]; // lengths of a guided projectile's symbols: spring, mass, and what stands behind [pixels]

// What is shown: everything the beams pass through, displacements enlarged by a factor, and bodies as far as they stay near.
function boundsOf(motion, factor = 1) {
  let { low, high } = motion.size.box(factor);
  if (!(high[0] >= low[0])) [low, high] = [[Infinity, Infinity], [-Infinity, -Infinity]];
  const hasBeams = Number.isFinite(low[0]);
  const size = hasBeams ? Math.max(high[0] - low[0], high[1] - low[1]) : Infinity;
  const reach = hasBeams ? 0.35 * size : Infinity;
  const least = motion.scene.loads.some((load) => load.kind === "point") ? ARROW_MARGIN : MARGIN;
  const margin = [0, 1].map((i) => Math.max(least, room(motion.scene.bodies, i)));
  const out = { low: [...low], high: [...high], margin };
  const grow = ([x, y], r) => {
    if (hasBeams && (x < low[0] - reach || x > high[0] + reach || y < low[1] - reach || y > high[1] + reach)) return;
    out.low = [Math.min(out.low[0], x - r), Math.min(out.low[1], y - r)];
    out.high = [Math.max(out.high[0], x + r), Math.max(out.high[1], y + r)];
  };
  motion.scene.bodies.forEach((body, i) => {
    if (body.kind === "obstacle") return;
    const stride = Math.max(1, Math.floor(motion.count / 200));
    for (let f = 0; f < motion.count; f += stride) {
      const node = 4 * (f * motion.nodes + motion.stations + i);
      const all = motion.frames.displacement;
      grow([body.position[0] + all[node], body.position[1] + all[node + 1]], body.radius ?? 0);
    }
  });
  for (const o of motion.scene.obstacles) {
    if (o.kind === "disc") grow(o.centre, o.radius);
    if (o.kind === "walls") o.ends.flat().forEach((end) => grow(end, o.thickness / 2));
  }
  for (const s of motion.scene.springs) for (const end of s.between) if (end.position) grow(end.position, 0);
  if (!Number.isFinite(out.low[0])) return { low: [-1, -1], high: [1, 1], margin };
  return out;
}

// Room that guided projectiles take behind their points along an axis [pixels].
function room(bodies, axis) {
  const behind = (body, i) => (body.elastic ? SPRING : 0) + BLOCK + 6 + (bodies[i + 1]?.kind === "rear" ? REAR : 0);
  const guided = bodies.map((body, i) => (body.kind === "guided" ? behind(body, i) * Math.abs(body.direction?.[axis] ?? 1) : 0));
  return Math.max(0, ...guided);
}

// Height at which a scene fills a width, and width at which it fills a height [pixels].
function heightFor({ low, high, margin }, width) {
  const aspect = (high[1] - low[1]) / Math.max(high[0] - low[0], 1e-9);
  return Math.max(0, width - 2 * margin[0]) * aspect + 2 * margin[1] + FOOT;
}

function widthFor({ low, high, margin }, height) {
  const aspect = (high[0] - low[0]) / Math.max(high[1] - low[1], 1e-9);
  return Math.max(0, height - 2 * margin[1] - FOOT) * aspect + 2 * margin[0];
}

// World to pixels, y upwards to y downwards; `zoom` and `shift` are the reader's.
function viewOf(bounds, width, height, { zoom = 1, shift = [0, 0] } = {}) {
  const extent = [0, 1].map((i) => Math.max(bounds.high[i] - bounds.low[i], 0));
  const largest = Math.max(extent[0], extent[1], 1e-9);
  const margin = bounds.margin ?? [MARGIN, MARGIN];
  const room = [width - 2 * margin[0], height - 2 * margin[1] - FOOT];
  const scale = zoom * Math.min(room[0] / Math.max(extent[0], 1e-3 * largest), room[1] / Math.max(extent[1], 1e-3 * largest));
  const middle = [0, 1].map((i) => (bounds.low[i] + bounds.high[i]) / 2);
  const centre = [width / 2 + shift[0], (height - FOOT) / 2 + shift[1]];
  const to = ([x, y]) => [centre[0] + scale * (x - middle[0]), centre[1] - scale * (y - middle[1])];
  const from = ([px, py]) => [middle[0] + (px - centre[0]) / scale, middle[1] - (py - centre[1]) / scale];
  return { scale, to, from, width, height };
}

// Whether displacements may be drawn larger than they are: not where that could make bodies overlap that do not.
function canExaggerate(motion) {
  const guided = new Set(motion.scene.bodies.filter((b) => b.kind === "guided" || b.kind === "rear").map((b) => b.name));
  return motion.scene.contacts.every((c) => c.between.some((name) => guided.has(name)));
}

if (typeof module !== "undefined") module.exports = { boundsOf, viewOf, heightFor, widthFor, canExaggerate };
