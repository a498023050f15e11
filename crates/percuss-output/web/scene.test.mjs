// The scene stands where the solver has it, and what is drawn of it is what was asked for: `node --test crates/percuss-output/web/`.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import vm from "node:vm";

// The page runs them as one script.
const parts = ["pens.js", "figures.js", "scene.js", "clearance.js", "view.js", "drawing.js", "symbols.js", "player.js", "shapes.js", "chart.js"];
const text = parts.map((name) => readFileSync(new URL(name, import.meta.url), "utf8")).join("\n");
const names = "{ SvgPen, escapeXml, Motion, engineering, Drawing, boundsOf, viewOf, heightFor, widthFor, Player, canExaggerate, mapColour, contactSpan, exaggerations, visibleFactor, hindrance, ShapeMotion, PathMotion, RestingMotion, roundTicks, crossings }";
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

test("a shear-flexible beam is a parabola across which its sections turn evenly", () => {
  // The right end rises by 1 m over 2 m: with level normals a straight line, with one of slope 1 there a parabola of slopes 0 and 1.
  for (const [turn, rise, slope] of [[0, 0.25, 0], [1, 0.0625, 0.25]]) {
    const { scene, frames } = motion({ beams: [beam({ shear_flexible: true })] });
    frames.displacement[8 + 7] = turn;
    const m = new page.Motion(scene, frames);
    const { place, tangent } = m.point(0, 0, 0.25, m.at(1).u, 1);
    assert.ok(Math.abs(place[0] - 0.5) < 1e-9 && Math.abs(place[1] - rise) < 1e-6, `${place}`);
    assert.ok(Math.abs(tangent[1] / tangent[0] - slope) < 1e-6, `${tangent}`);
  }
});

// What is drawn of a scene at an instant, as SVG, with a view of it.
function drawn(m, t = 0) {
  const drawing = new page.Drawing(m, new Proxy({}, { get: (_, name) => `#${String(name)}` }));
  const view = page.viewOf(drawing.bounds, 600, 400);
  const pen = new page.SvgPen(600, 400);
  drawing.draw(pen, t, view, {});
  return { svg: pen.finish(), view };
}

test("springs are drawn until they fail, and supports before beams", () => {
  const springs = [{ name: "tie", between: [{ beam: 0, s: 2 }, { position: [2, 1.5] }], springs: true, until: 0.5 }];
  const supports = [{ name: "left", kind: "pin", at: { beam: 0, s: 0 }, until: null }];
  const m = motion({ springs, supports });
  const count = (t) => drawn(m, t).svg.split("#symbol").length - 1;
  assert.ok(count(0.4) > count(0.6) && count(0.6) > 0);
  const { svg } = drawn(m, 0.6);
  assert.ok(svg.indexOf("#symbol") > svg.indexOf("#outline"), "the beam hides its support");
});

test("springs of a foundation of compression alone stay behind where the beam lifts off", () => {
  const foundation = { name: "bed", beam: 0, stretch: [0, 2], direction: [0, 1] };
  const tops = (lifts) => {
    const { svg, view } = drawn(motion({ foundations: [{ ...foundation, lifts }] }), 1);
    // A zigzag begins at its top.
    const all = [...svg.matchAll(/M(\S+?) (\S+?)L[^"]*"[^>]*stroke-width="1\.1"/g)];
    return [all.map(([, , y]) => Number(y)), view.to([0, -0.1])[1]];
  };
  const [kept, face] = tops(true);
  assert.ok(kept.length > 2 && kept.every((y) => Math.abs(y - face) < 0.5), `${kept} ${face}`);
  const [drawnAlong] = tops(false);
  assert.ok(drawnAlong.length === kept.length && drawnAlong.every((y) => y < face - 1));
});

test("a round end is drawn as half a circle from face to face", () => {
  const m = new page.Motion({ ...motion().scene, beams: [beam({ roundings: [0, 0.1] })] }, motion().frames);
  const [part] = m.curve(0, m.at(0).u);
  assert.ok(Math.abs(part[0].reach - 0.1) < 1e-12, "the start is straight across");
  const arc = part.filter((p) => p.place[0] >= 1.9 - 1e-12);
  assert.ok(arc.length > 10);
  for (const p of arc) assert.ok(Math.abs(Math.hypot(p.place[0] - 1.9, p.reach) - 0.1) < 1e-9, `${p.place} ${p.reach}`);
  // Stress goes with the section, not with what is left of it in the picture.
  assert.ok(part.every((p) => Math.abs(p.half_depth - 0.1) < 1e-12));
  const hasCorner = (motion) => {
    const drawing = new page.Drawing(motion, new Proxy({}, { get: () => "#000000" }));
    const view = page.viewOf(drawing.bounds, 600, 400);
    const pen = new page.SvgPen(600, 400);
    drawing.draw(pen, 0, view, {});
    const [x, y] = view.to([2, 0.1]);
    return [...pen.finish().matchAll(/[ML](\S+?) ([^LZ"]+)/g)].some(([, a, b]) => Math.hypot(a - x, b - y) < 0.5);
  };
  assert.ok(hasCorner(motion()) && !hasCorner(m));
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

test("a beam that can yield has no stress by its forces, and no colour of it", () => {
  const m = new page.Motion({ ...motion().scene, beams: [beam({ inertia: [null, null] })] }, motion().frames);
  const [point] = m.curve(0, m.at(1).u).flat();
  assert.equal(m.stress(1, 0, point), null);
  assert.equal(motion().yields, false);
  const drawing = new page.Drawing(m, new Proxy({}, { get: (_, name) => (name === "beam" ? "#abcdef" : "#000000") }));
  assert.equal(drawing.colourTop("stress"), 0);
  const pen = new page.SvgPen(600, 400);
  drawing.draw(pen, 1, page.viewOf(drawing.bounds, 600, 400), { colour: "stress" });
  const svg = pen.finish();
  assert.match(svg, /stress, elastic beams/);
  assert.match(svg, /#abcdef/);
});

test("a scene fills its frame in width and in height, with room for what stands behind along its own axis alone", () => {
  const strikes = { beam: 0, s: 2 };
  const body = { name: "p", kind: "guided", elastic: true, position: [2, 0], direction: [1, 0], standoff: 0, strikes };
  const bounds = page.boundsOf(motion({ bodies: [body] }));
  assert.ok(bounds.margin[0] >= 34 + 22 && bounds.margin[1] < 40, `${bounds.margin}`);
  const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-9, `${a} is not ${b}`);
  const fills = (width, height) => {
    const view = page.viewOf(bounds, width, height);
    const [[left, bottom], [right, top]] = [bounds.low, bounds.high].map(view.to);
    near(left, bounds.margin[0]);
    near(right, width - bounds.margin[0]);
    near(top, bounds.margin[1]);
    near(bottom, height - 18 - bounds.margin[1]);
  };
  fills(900, page.heightFor(bounds, 900));
  fills(page.widthFor(bounds, 500), 500);
});

test("the label of the scene says time, contacts with their forces and the largest displacement", () => {
  const contacts = [{ name: "hammer", between: ["b", "p"] }, { name: "stop", between: ["b", "w"] }];
  // Two points of one contact: 3 N and 4 N at right angles are 5 N; the other is an impulse.
  const rows = Float32Array.of(0, 0, 0, 3, 0, 0, 0, 0, 0, 0, 4, 0, 1, 0, 0, 0, 2000, 1);
  const m = motion({ contacts }, { contacts: rows, contact_count: Float32Array.of(0, 3) });
  const labelOf = (motion, time) => {
    let label = "";
    page.Player.prototype.describe.call({ motion, time, canvas: { setAttribute: (_, text) => (label = text) } });
    return label;
  };
  assert.equal(labelOf(m, 0), "Scene, t = 0 s; no contact; largest displacement of beams 0 m");
  assert.equal(labelOf(m, 1), "Scene, t = 1 s; in contact: 'hammer' 5 N, 'stop' 2000 N s; largest displacement of beams 1 m");
  assert.equal(labelOf(new page.RestingMotion(m.scene, m.frames), 1), "Scene, largest displacement of beams 1 m");
});

test("a contact at rest that transmits an impact has a force and an impulse, which are not added", () => {
  const contacts = [{ name: "foot", between: ["b", "w"] }, { name: "hammer", between: ["b", "p"] }];
  const rows = Float32Array.of(0, 0, 0, 0, 20, 0, 0, 0, 0, 0, 3, 1, 1, 0, 0, 0, 3, 1);
  const m = motion({ contacts }, { contacts: rows, contact_count: Float32Array.of(0, 3) });
  const plain = (list) => JSON.parse(JSON.stringify(list));
  assert.deepEqual(plain(m.resultants(1)), [
    { contact: 0, impulsive: false, size: 20 }, { contact: 0, impulsive: true, size: 3 }, { contact: 1, impulsive: true, size: 3 },
  ]);
  assert.deepEqual([m.size.force, m.size.impulse, m.size.peak], [20, 3, 1]);
  let label = "";
  page.Player.prototype.describe.call({ motion: m, time: 1, canvas: { setAttribute: (_, text) => (label = text) } });
  assert.match(label, /in contact: 'foot' 20 N, 'foot' 3 N s, 'hammer' 3 N s;/);
});

test("the instant of an impact is shown where its impulse is", () => {
  const contacts = [{ name: "hammer", between: ["b", "p"] }];
  // The rows before and after an impact at 0.5 s, half its interval away.
  const displacement = new Float32Array(4 * 8);
  const frames = { time: Float64Array.of(0, 0.5 - 1e-9, 0.5 + 1e-9, 1), displacement, sections: new Float32Array(24) };
  const rows = Float32Array.of(0, 0, 0, 0, 7, 1);
  const m = motion({ contacts }, { ...frames, contacts: rows, contact_count: Float32Array.of(0, 0, 1, 0) });
  assert.equal(m.instantShown(0.5), 0.5 + 1e-9);
  // In time-stepping it is that of the row before the step; a frame that has impulses is shown as it is.
  assert.deepEqual([0.5 - 1e-9, 0.5 + 1e-9].map((t) => m.instantShown(t)), [0.5 + 1e-9, 0.5 + 1e-9]);
  assert.deepEqual([0, 0.2, 0.7, 1, 9].map((t) => m.instantShown(t)), [0, 0.2, 0.7, 1, 9]);
  assert.equal(m.impulses(0.49, m.instantShown(0.5)).length, 1);
  assert.equal(motion().instantShown(0.3), 0.3);
});

test("a guided projectile at the edge has room for its symbols", () => {
  const strikes = { beam: 0, s: 2 };
  const guided = (more) => ({ name: "p", kind: "guided", position: [2, 0], direction: [0, 1], standoff: 0, strikes, ...more });
  const margin = (...bodies) => Math.max(...page.boundsOf(motion({ bodies })).margin);
  const bare = Math.max(...page.boundsOf(motion()).margin);
  assert.ok(margin(guided({ elastic: false })) >= 22);
  assert.ok(margin(guided({ elastic: true })) >= 34 + 22, "spring and mass");
  assert.ok(margin(guided({ elastic: true }), { name: "rear", kind: "rear", position: [2, 0] }) > margin(guided({ elastic: true })) && bare < 40);
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

test("the caption tells the largest moment of the instant, and that of all instants where it is another", () => {
  const frames = { sections: Float32Array.of(0, 0, 2, 0, 0, -1, 3, 4, 6, 3, 4, -6) };
  const drawing = new page.Drawing(motion({}, frames), new Proxy({}, { get: () => "#000000" }));
  const caption = (t) => {
    const pen = new page.SvgPen(600, 400);
    drawing.draw(pen, t, page.viewOf(drawing.bounds, 600, 400), { diagram: "moment" });
    return pen.finish();
  };
  assert.match(caption(0), /M up to 2 N m \(maximum over time 6 N m\)</);
  assert.match(caption(1), /M up to 6 N m</);
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

test("arrows do not cover the scale of colours", () => {
  const scene = { bodies: [{ name: "ball", position: [2, 1], kind: "disc", radius: 0.2 }], contacts: [{ name: "c", between: ["b", "ball"] }] };
  const m = motion(scene, { contacts: Float32Array.of(0, 2, 0.1, 0, 50, 0), contact_count: Float32Array.of(0, 1) });
  const palette = { page: "#ffffff", contact: "#d55e00", soft: "#777777", text: "#000000", body: "#8fb8d8", outline: "#3d4955" };
  const pen = new page.SvgPen(600, 400);
  const drawing = new page.Drawing(m, palette);
  drawing.draw(pen, 1, page.viewOf(drawing.bounds, 600, 400), { colour: "moment", forces: true });
  const svg = pen.finish();
  const plate = svg.lastIndexOf('fill="#ffffff" opacity');
  assert.ok(svg.includes("#d55e00") && plate > svg.lastIndexOf("#d55e00"), "a plate behind the scale, before the arrows");
  assert.ok(svg.indexOf("|moment|") > plate);
});

test("the time shown of an impact is that in which anything touches", () => {
  const time = Float64Array.from({ length: 101 }, (_, k) => k / 100);
  const contact_count = Float32Array.from(time, (t) => Number(t >= 0.3 && t <= 0.4));
  const count = contact_count.reduce((a, b) => a + b);
  const frames = { time, contact_count, contacts: new Float32Array(6 * count), displacement: new Float32Array(101 * 8), sections: new Float32Array(101 * 6) };
  const [from, to] = page.contactSpan(motion({}, frames));
  assert.ok(from < 0.3 && from > 0.2 && to > 0.4 && to < 0.5, `${from} to ${to}`);
  assert.equal(page.contactSpan(motion()), null);
  // With room it would be next to the whole run: the contact itself is left.
  const closed = (last) => {
    const touching = Float32Array.from(time, (t) => Number(t <= last));
    return page.contactSpan(motion({}, { ...frames, contact_count: touching, contacts: new Float32Array(6 * 101) }));
  };
  assert.deepEqual([...closed(0.69)], [0, 0.69]);
  assert.deepEqual([...closed(0.99)], [0, 0.99]);
  assert.equal(closed(1), null);
});

test("diagrams go through the jumps and corners inside an interval, and their top is that of the run", () => {
  // A force at a quarter of the way: the shear force jumps from 3 to -1, the moment has its corner of 6 there.
  const sections = Float32Array.of(0, 0, 0, 0, 0, 0, 0, 3, 0, 0, -1, 0);
  const frames = { sections, points: Float32Array.of(0, 0.25, 0, 3, 6, 0, 0.25, 0, -1, 6), point_count: Float32Array.of(0, 2) };
  const m = motion({}, frames);
  const at = (share) => m.sides(1, { interval: 0, share });
  assert.deepEqual([...at(0.25)[0]], [0, 3, 6]);
  assert.deepEqual([...at(0.25)[1]], [0, -1, 6]);
  assert.deepEqual([...m.section(1, { interval: 0, share: 0.625 })], [0, -1, 3]);
  assert.deepEqual([...m.section(0, { interval: 0, share: 0.25 })], [0, 0, 0]);
  assert.equal(m.sectionTop(1, 2), 6);
  assert.deepEqual([...m.size.sections], [0, 3, 6]);
  // The curve that a diagram is drawn along has the place of the jump, in this frame and not in the other.
  const has = (index) => m.curve(0, m.at(1).u, 1, 1, index).flat().some((p) => p.share === 0.25);
  assert.ok(has(1));
  // Where the scene notes the largest of the run that is the top, though no frame has it.
  const largest = { axial: 0.5, shear: 3.5, moment: 7.25, stress: 1e6 };
  const noted = motion({ beams: [beam({ largest })] }, frames);
  assert.deepEqual([...noted.size.sections], [0.5, 3.5, 7.25]);
  const drawing = new page.Drawing(noted, new Proxy({}, { get: () => "#000000" }));
  assert.equal(drawing.colourTop("stress"), 1e6);
  const pen = new page.SvgPen(600, 400);
  drawing.draw(pen, 1, page.viewOf(drawing.bounds, 600, 400), { diagram: "moment" });
  assert.match(pen.finish(), /M up to 6 N m \(maximum over time 7.25 N m\)/);
});

test("a picture for paper has what the canvas shows, and names cannot break out of it", () => {
  const m = motion({ supports: [{ name: "s", kind: "clamp", at: { beam: 0, s: 0 }, until: null }], loads: [{ name: "l", kind: "point", at: { beam: 0, s: 2 }, force: [0, -5], moment: 0, follower: false }] }, { loads: Float32Array.of(1, 1) });
  const palette = new Proxy({}, { get: () => "#000000" });
  const drawing = new page.Drawing(m, palette);
  const pen = new page.SvgPen(600, 400);
  drawing.draw(pen, 1, page.viewOf(drawing.bounds, 600, 400), { exaggeration: 5, colour: "moment", diagram: "moment", forces: true, loads: true, ghost: true });
  const svg = pen.finish();
  assert.match(svg, /^<svg xmlns/);
  assert.match(svg, /deformation scale 5/);
  assert.ok(!svg.includes("NaN") && !svg.includes("undefined"), svg);
  assert.equal(page.escapeXml("<script>&\"'"), "&lt;script&gt;&amp;&quot;&#39;");
});

// A beam whose right end goes down by 40 mm, 100 mm above a floor; 4 mm deep, so that its axis may go down by 98 mm.
const floor = { name: "floor", body: null, kind: "half-plane", point: [0, -0.1], normal: [0, 1] };
function sagging(scene = {}) {
  const displacement = new Float32Array(8);
  displacement[5] = -0.04;
  const frames = {
    time: Float64Array.of(0), displacement, sections: new Float32Array(6), contacts: new Float32Array(0), contact_count: Float32Array.of(0),
    loads: new Float32Array(0), velocity: new Float32Array(0),
  };
  return [{ beams: [beam({ half_depth: [0.002, 0.002] })], ...nothing, ...scene }, frames];
}

test("displacements are enlarged only as far as bodies stay apart", () => {
  const free = new page.RestingMotion(...sagging());
  assert.deepEqual([...page.exaggerations(free)], [1, 2, 5, 10, 20]);
  assert.equal(page.visibleFactor(free, page.exaggerations(free)), 5, "a tenth of two metres");
  // 80 mm leave the floor 18 mm below, 200 mm would not.
  const above = new page.RestingMotion(...sagging({ obstacles: [floor] }));
  assert.deepEqual([...page.exaggerations(above)], [1, 2]);
  const wall = { name: "wall", body: null, kind: "walls", ends: [[[1.9, -0.3], [2.5, -0.3]]], thickness: 0.01 };
  assert.deepEqual([...page.exaggerations(new page.RestingMotion(...sagging({ obstacles: [wall] })))], [1, 2, 5]);
  // Thin and so near that a coarse look would find the beam beyond it.
  const near = { ...wall, ends: [[[1.9, -0.0422], [2.5, -0.0422]]], thickness: 0 };
  assert.deepEqual([...page.exaggerations(new page.RestingMotion(...sagging({ obstacles: [near] })))], [1]);
  const stop = { name: "stop", kind: "stop", at: { beam: 0, s: 2 }, direction: [0, -1], gap: 0.05, two_sided: false, until: null };
  assert.deepEqual([...page.exaggerations(new page.RestingMotion(...sagging({ supports: [stop] })))], [1]);
  const ball = { name: "ball", position: [2, -0.2], kind: "disc", radius: 0.05 };
  const [scene, frames] = sagging({ bodies: [ball] });
  const beside = new page.RestingMotion(scene, { ...frames, displacement: Float32Array.of(...frames.displacement, 0, 0, 0, 0) });
  assert.deepEqual([...page.exaggerations(beside)], [1, 2], "the ball begins 150 mm below");
});

test("displacements are enlarged only as far as beams do not come to cross", () => {
  const [scene, frames] = sagging();
  const other = beam({ name: "other", half_depth: [null, null], x: [1, 3], y: [-0.3, -0.3] });
  const two = { ...scene, beams: [beam({ half_depth: [null, null] }), other] };
  const more = { ...frames, displacement: Float32Array.of(...frames.displacement, ...new Array(8).fill(0)), sections: new Float32Array(12) };
  assert.deepEqual([...page.exaggerations(new page.RestingMotion(two, more))], [1, 2, 5]);
  const segment = (a, b) => [a, b, 0];
  const corner = [segment([0, 0], [1, 0]), segment([1, 0], [1, 1])];
  assert.equal(page.crossings(corner, corner), 0, "neighbours meet");
  assert.equal(page.crossings(corner, [segment([0.5, -1], [0.5, 1])]), 1);
});

test("what hinders larger displacements is named: two that touch, or how much room there is", () => {
  const contacts = [{ name: "c", between: ["b", "floor"] }];
  const [scene, frames] = sagging({ obstacles: [floor], contacts });
  const free = new page.Motion(scene, frames);
  // 40 mm down and 98 mm of room: nothing touches, so twice as much may be shown, and not ten times.
  assert.equal(page.hindrance(free, 2), null);
  const { most } = page.hindrance(free, 10);
  assert.ok(most > 2.3 && most < 2.5, `${most}`);
  const touching = new page.Motion(scene, { ...frames, contacts: Float32Array.of(0, 1, 0, 0, 5, 0), contact_count: Float32Array.of(1) });
  assert.deepEqual({ ...page.hindrance(touching, 2) }, { contact: "c", between: ["b", "floor"] });
  assert.equal(page.hindrance(touching, 1), null);
  assert.equal(page.hindrance(motion(), 1000), null, "nothing that could touch");
});

test("a shape swings about its configuration, no farther than there is room", () => {
  const [scene, one] = sagging();
  const frames = { ...one, time: Float64Array.of(0, 0), displacement: Float32Array.of(...one.displacement, 0, 0, 0, 0, 0, 1, 0, 0), sections: new Float32Array(12), contact_count: Float32Array.of(0, 0) };
  const swing = new page.ShapeMotion(scene, frames, 1, 0);
  const tip = (m, t) => m.on({ beam: 0, s: 2 }, m.at(t).u).place[1];
  assert.ok(Math.abs(tip(swing, 0) + 0.04) < 1e-7 && Math.abs(tip(swing, 0.25) - 0.1604) < 1e-6 && Math.abs(tip(swing, 0.75) + 0.2404) < 1e-6);
  // A tenth of the size, 2.004 m with the depth. Without a configuration about the reference; all that it passes through is in view.
  const { low, high } = page.boundsOf(new page.ShapeMotion(scene, frames, 1, null));
  assert.ok(Math.abs(low[1] + 0.2024) < 1e-6 && Math.abs(high[1] - 0.2024) < 1e-6, `${low} ${high}`);
  // 58 mm of room to the floor, less half a thousandth of the size.
  const above = new page.ShapeMotion({ ...scene, obstacles: [floor] }, frames, 1, 0);
  assert.ok(above.obstacles && above.amplitude < 0.058 && above.amplitude > 0.05, `${above.amplitude}`);
  // Where next to nothing would be seen an obstacle that nothing presses on is left out.
  const near = new page.ShapeMotion({ ...scene, obstacles: [{ ...floor, point: [0, -0.045] }] }, frames, 1, 0);
  assert.ok(!near.obstacles && Math.abs(near.amplitude - 0.2004) < 1e-6);
});

test("a shape folds no faces and turns no shear-flexible section far", () => {
  const of = (extra, turn) => {
    const displacement = Float32Array.of(...new Array(8).fill(0), 0, 0, 0, 0, 0, 1, 0, turn);
    const frames = { time: Float64Array.of(0, 0), displacement, sections: new Float32Array(12), contacts: new Float32Array(0), contact_count: Float32Array.of(0, 0), loads: new Float32Array(0) };
    return new page.ShapeMotion({ beams: [beam(extra)], ...nothing }, frames, 1, 0).amplitude;
  };
  // Faces 0.1 m from an axis of 2 m are strained by a twentieth of the rotation between its ends.
  assert.ok(Math.abs(of({}, 100) - 0.5 / 5) < 1e-6);
  assert.ok(Math.abs(of({ shear_flexible: true }, 100) - 0.005) < 1e-6);
  // A slender beam by a tenth of its size at most.
  assert.ok(Math.abs(of({ half_depth: [null, null] }, 100) - 0.2) < 1e-6);
});

test("a place on a path is named by its load factor", () => {
  const [scene, one] = sagging();
  const frames = { ...one, displacement: Float32Array.of(...new Array(8).fill(0), ...one.displacement), sections: new Float32Array(12), contact_count: Float32Array.of(0, 0) };
  const path = new page.PathMotion(scene, frames, [0, 0.16]);
  assert.equal(path.label(1), "load factor 0.16");
  assert.equal(path.instantText(0.25), "load factor 0.04");
  assert.ok(Math.abs(path.on({ beam: 0, s: 2 }, path.at(0.5).u).place[1] + 0.02) < 1e-7);
  assert.deepEqual([...page.roundTicks(-0.5, 1, 6)].map((v) => Number(v.toFixed(9))), [-0.5, 0, 0.5, 1]);
});

test("velocities are the rates of the same cubic, and colours stand for their size", () => {
  const velocity = new Float32Array(16);
  velocity.set([3, 4, 0, 0, 3, 4, 0, 0], 0);
  velocity[8 + 5] = 2; // the right end rises at 2 m/s, flat at both ends
  const m = motion({}, { velocity });
  const at = (index, k, share) => m.speed(index, 0, { k, share });
  assert.ok(Math.abs(at(0, 0, 0.3) - 5) < 1e-12);
  assert.ok(Math.abs(at(1, 0, 0.5) - 1) < 1e-6 && Math.abs(at(1, 0, 0.25) - 2 * 0.0625 * 2.5) < 1e-6);
  const drawing = new page.Drawing(m, new Proxy({}, { get: () => "#000000" }));
  assert.equal(drawing.colourTop("velocity"), 5);
  const pen = new page.SvgPen(600, 400);
  drawing.draw(pen, 0, page.viewOf(drawing.bounds, 600, 400), { colour: "velocity" });
  assert.match(pen.finish(), /speed 5 m\/s/);
  assert.equal(motion().hasVelocity, false);
});

test("numbers carry prefixes of thousands", () => {
  assert.equal(page.engineering(0.0123, "m"), "12.3 mm");
  assert.equal(page.engineering(-176632, "N"), "-176.63 kN");
  assert.equal(page.engineering(0, "s"), "0 s");
  // The same as in the tables of the page.
  const cases = JSON.parse(readFileSync(new URL("../tests/quantities.json", import.meta.url), "utf8"));
  for (const [value, unit, shown] of cases) assert.equal(page.engineering(value, unit.replace("*", " ").replace("^2", "\u00b2")), shown);
  assert.equal(page.engineering(0.0587, "Pa"), "0.0587 Pa");
  assert.equal(page.engineering(-0.05, "m/s"), "-0.05 m/s");
});
