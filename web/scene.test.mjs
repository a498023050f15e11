// The scene stands where the solver has it, and what is drawn of it is what was asked for: `node --test web/`.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import vm from "node:vm";

// The page runs them as one script.
const parts = ["pens.js", "scene.js", "drawing.js", "symbols.js", "player.js"];
const text = parts.map((name) => readFileSync(new URL(name, import.meta.url), "utf8")).join("\n");
const names = "{ SvgPen, escapeXml, Motion, engineering, Drawing, boundsOf, viewOf, canExaggerate, mapColour, contactSpan }";
const page = vm.runInNewContext(`${text}\n;(${names})`, { Float32Array, Math, Number, Map, Set });

const nothing = { bodies: [], obstacles: [], supports: [], joints: [], springs: [], masses: [], loads: [], contacts: [] };
const beam = (extra) => ({
  name: "b", s: [0, 2], x: [0, 2], y: [0, 0], tx: [1, 1], ty: [0, 0], half_depth: [0.1, 0.1], area: [0.02, 0.02], inertia: [2e-5, 2e-5], ...extra,
});

// A beam of one interval whose right end rises by 1 m from t = 0 to 1, flat at both ends, and what else there is.
function motion(scene = {}, frames = {}) {
  const n = 2 + (scene.bodies?.length ?? 0);
  const displacement = new Float32Array(2 * 4 * n);
  displacement[4 * n + 5] = 1;
  const given = {
    time: Float64Array.of(0, 1), displacement, sections: Float32Array.of(0, 0, 0, 0, 0, 0, 3, 4, 6, 3, 4, -6),
    contacts: new Float32Array(0), contact_count: Float32Array.of(0, 0), loads: new Float32Array(0), ...frames,
  };
  return new page.Motion({ beams: [beam()], ...nothing, ...scene }, given);
}

test("between stations a beam is the cubic of its displacements and slopes", () => {
  const m = motion();
  const { u } = m.at(1);
  for (const share of [0, 0.25, 0.5, 1]) {
    const { place } = m.point(0, 0, share, u, 1);
    assert.ok(Math.abs(place[0] - 2 * share) < 1e-12);
    assert.ok(Math.abs(place[1] - share * share * (3 - 2 * share)) < 1e-6, `${share}`);
  }
  const middle = m.on({ beam: 0, s: 1 }, u);
  assert.ok(Math.abs(middle.place[1] - 0.5) < 1e-6 && Math.abs(middle.tangent[1] / middle.tangent[0] - 0.75) < 1e-6);
  assert.equal(middle.half_depth, 0.1);
});

test("between frames displacements are straight lines in time", () => {
  const m = motion();
  assert.ok(Math.abs(m.on({ beam: 0, s: 2 }, m.at(0.25).u).place[1] - 0.25) < 1e-7);
  assert.equal(m.at(0.4).index, 0);
  assert.equal(m.at(0.6).index, 1);
  assert.ok(Math.abs(m.on({ beam: 0, s: 2 }, m.at(7).u).place[1] - 1) < 1e-7);
});

test("stress is that of axial force and moment on the section", () => {
  const m = motion();
  const [point] = m.curve(0, m.at(1).u).flat();
  const expected = 3 / 0.02 + (6 * 0.1) / 2e-5;
  assert.ok(Math.abs(m.stress(1, 0, point) - expected) < 1e-6 * expected);
});

test("axes are equal and the whole motion is in view", () => {
  const m = motion();
  const bounds = page.boundsOf(m);
  const view = page.viewOf(bounds, 900, 500);
  const [a, b, c] = [[0, 0], [1, 0], [0, 1]].map(view.to);
  assert.ok(Math.abs(b[0] - a[0] - (a[1] - c[1])) < 1e-9);
  for (const corner of [bounds.low, bounds.high].map(view.to)) {
    assert.ok(corner[0] >= 0 && corner[0] <= 900 && corner[1] >= 0 && corner[1] <= 500, `${corner}`);
  }
  const back = view.from(view.to([0.3, 0.7]));
  assert.ok(Math.abs(back[0] - 0.3) < 1e-12 && Math.abs(back[1] - 0.7) < 1e-12);
});

test("forces are shown on the beam that a body presses on", () => {
  const scene = { bodies: [{ name: "ball", position: [1, 1], kind: "disc", radius: 0.2 }], contacts: [{ name: "c", between: ["b", "ball"] }] };
  const m = motion(scene, { contacts: Float32Array.of(0, 1, 0.1, 0, 50, 0), contact_count: Float32Array.of(0, 1) });
  const [force] = m.contacts(1).map((c) => m.pressing(c));
  assert.equal(force.force[1], -50);
  assert.equal(m.size.peak, 1);
  assert.equal(page.canExaggerate(m), false);
  assert.equal(page.canExaggerate(motion()), true);
});

test("the time shown of an impact is that in which anything touches", () => {
  const time = Float64Array.from({ length: 101 }, (_, k) => k / 100);
  const contact_count = Float32Array.from(time, (t) => Number(t >= 0.3 && t <= 0.4));
  const count = contact_count.reduce((a, b) => a + b);
  const frames = { time, contact_count, contacts: new Float32Array(6 * count), displacement: new Float32Array(101 * 8), sections: new Float32Array(101 * 6) };
  const [from, to] = page.contactSpan(motion({}, frames));
  assert.ok(from < 0.3 && from > 0.2 && to > 0.4 && to < 0.5, `${from} to ${to}`);
  assert.equal(page.contactSpan(motion()), null);
});

test("a picture for paper has what the canvas shows, and names cannot break out of it", () => {
  const m = motion({ supports: [{ name: "s", kind: "clamp", at: { beam: 0, s: 0 }, until: null }], loads: [{ name: "l", kind: "point", at: { beam: 0, s: 2 }, force: [0, -5], moment: 0, follower: false }] }, { loads: Float32Array.of(1, 1) });
  const palette = new Proxy({}, { get: () => "#000000" });
  const drawing = new page.Drawing(m, palette);
  const pen = new page.SvgPen(600, 400);
  drawing.draw(pen, 1, page.viewOf(drawing.bounds, 600, 400), { exaggeration: 5, colour: "moment", diagram: "moment", forces: true, loads: true, ghost: true });
  const svg = pen.finish();
  assert.match(svg, /^<svg xmlns/);
  assert.match(svg, /displacements \u00d7 5/);
  assert.ok(!svg.includes("NaN") && !svg.includes("undefined"), svg);
  assert.equal(page.escapeXml("<script>&\"'"), "&lt;script&gt;&amp;&quot;&#39;");
});

test("numbers carry prefixes of thousands", () => {
  assert.equal(page.engineering(0.0123, "m"), "12.3 mm");
  assert.equal(page.engineering(-176632, "N"), "-176.6 kN");
  assert.equal(page.engineering(0, "s"), "0 s");
});
