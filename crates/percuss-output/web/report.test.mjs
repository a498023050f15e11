// The page's numbers come back as they were packed: `node --test crates/percuss-output/web/`.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import vm from "node:vm";
import { deflateRawSync } from "node:zlib";

// The page runs them as one script.
const parts = ["pens.js", "columns.js", "figures.js", "zoom.js", "exports.js"];
const text = parts.map((name) => readFileSync(new URL(name, import.meta.url), "utf8")).join("\n");
const names = "{ unpack, significant, withUnit, spansOf, bandValue, wholeOf, tables, extremesByColumn, turnsOf, zoomed, moved, csvOf }";
const page = vm.runInThisContext(`(() => {${text}\nreturn ${names};})()`);
const { unpack, significant, withUnit, spansOf, bandValue, wholeOf, tables, extremesByColumn, turnsOf, zoomed, moved, csvOf } = page;

function shuffled(values) {
  const plain = Buffer.from(values.buffer);
  const width = values.BYTES_PER_ELEMENT;
  const out = Buffer.alloc(plain.length);
  for (let i = 0; i < values.length; i++) {
    for (let k = 0; k < width; k++) out[k * values.length + i] = plain[i * width + k];
  }
  return out;
}

const time = Float64Array.from([0, 0.1, 1 / 3, 1e300]);
const force = Float32Array.from([0, -1.5, 3.4e5]);
const gappy = Float32Array.from([1, NaN, Infinity]);
const columns = [[8, 4], [4, 3], [4, 3]];
const bytes = Buffer.concat([time, force, gappy].map(shuffled));

for (const [encoding, packed] of [["plain", bytes], ["deflate", deflateRawSync(bytes)]]) {
  test(`columns come back from ${encoding} bytes, gaps as null`, async () => {
    const back = await unpack({ columns, encoding }, packed.toString("base64"));
    assert.deepEqual(back[0], time);
    assert.deepEqual(back[1], force);
    assert.deepEqual(back[2], [1, null, null]);
  });
}

test("values read as an engineer writes them", () => {
  assert.equal(significant(337784.605, 6), "337785");
  assert.equal(significant(0.1 + 0.2, 6), "0.3");
  assert.equal(significant(2.5e-12, 3), "2.5e-12");
  assert.equal(withUnit(12.5, "kN"), "12.5 kN");
  assert.equal(withUnit(null, "kN"), "");
});

test("a band tells the impulse of the span under the cursor", () => {
  const figure = { x: { unit: "ms" }, y: { unit: "kN s" } };
  const spans = spansOf([1, 2, 2, 3.5], [7, 7, 9, 9]);
  assert.deepEqual(spans, [[1, 2, 7], [2, 3.5, 9]]);
  assert.equal(bandValue(figure, spans, 3), "9 kN s, 2 to 3.5 ms");
  assert.equal(bandValue(figure, spans, 0.5), "");
  assert.equal(bandValue(figure, spans, null), "");
});

test("figures over time share their span, an empty one has some", () => {
  const entry = (...x) => ({ data: [x] });
  const [low, high] = wholeOf([entry(0, 2), entry(1, 5), entry()]);
  assert.equal(low, 0);
  assert.ok(high > 5 && high < 5.001);
  assert.deepEqual(wholeOf([entry()]), [0, 1]);
  assert.deepEqual(wholeOf([entry(3)]), [3, 4]);
});

test("what is round-off beside its scale is nothing", () => {
  assert.equal(withUnit(3e-14, "kN", 1), "0 kN");
  assert.equal(withUnit(3e-11, "kN", 1), "0 kN");
  assert.equal(withUnit(3e-8, "kN", 1), "3e-8 kN");
  assert.equal(withUnit(123456.7, ""), "123460");
});

test("areas lie on each other and keep their own values", () => {
  const series = [{ shape: "area", y: 1, label: "a" }, { shape: "area", y: 2, label: "b" }, { shape: "line", y: 3, label: "all" }];
  const figure = { tables: [{ x: 0, series }], x: { caption: "time [s]" }, y: { unit: "J" } };
  const data = tables(figure, [[0, 1], [1, 2], [10, 20], [11, 22.5]]);
  assert.deepEqual(data.map((c) => [...c]), [[0, 1], [1, 2], [11, 22], [11, 22.5]]);
  assert.equal(csvOf(figure, data), '"time [s]","a [J]","b [J]","all [J]"\n0,1,10,11\n1,2,20,22.5\n');
});

test("a cell is no formula", () => {
  const figure = { tables: [{ x: 0, series: [{ shape: "line", label: '=HYPERLINK("x")' }] }], x: { caption: "time" }, y: { unit: "" } };
  assert.equal(csvOf(figure, [[0], [null]]), '"time","\'=HYPERLINK(""x"")"\n0,\n');
});

test("a band has the extremes of each column of pixels", () => {
  const y = [0, 1, -1, 5, null, 4];
  const found = extremesByColumn(2, 0, 5, (i) => i / 3, (i) => y[i]);
  assert.deepEqual(JSON.parse(JSON.stringify(found)), [{ column: 0, low: -1, high: 1 }, { column: 1, low: 4, high: 5 }]);
});

test("zooming stays within the whole", () => {
  const list = (range) => Array.from(range);
  assert.deepEqual(list(zoomed([0, 10], 2, 5, [0, 10])), [2.5, 7.5]);
  assert.deepEqual(list(zoomed([2, 4], 0.1, 3, [0, 10])), [0, 10]);
  assert.deepEqual(list(moved([2, 4], -5, [0, 10])), [0, 2]);
  assert.deepEqual(list(moved([2, 4], 50, [0, 10])), [8, 10]);
});

test("turning points are counted, round-off is none", () => {
  const y = Array.from({ length: 1001 }, (_, i) => Math.sin((2 * Math.PI * i) / 100));
  assert.equal(turnsOf(y, 0, 1000), 20);
  assert.equal(turnsOf(y.map((v, i) => i + 1e-3 * v), 0, 1000), 0);
  assert.equal(turnsOf([1, null, 2, 3], 0, 3), 0);
});
