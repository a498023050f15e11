// The page's numbers come back as they were packed: `node --test web/`.

import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { test } from "node:test";
import { deflateRawSync } from "node:zlib";

const { unpack, significant, withUnit, spansOf, bandValue, wholeOf } = createRequire(import.meta.url)("./report.js");

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
  assert.equal(significant(2.5e-12, 3), "2.50e-12");
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
