"use strict";

// Numbers: columns as bytes, byte 0 of all values first, then byte 1, ..., perhaps deflated, in base64.

function bytesFromBase64(text) {
  const binary = atob(text.trim());
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

async function inflate(bytes) {
  if (typeof DecompressionStream === "undefined") {
    throw new Error("This browser is too old to unpack the figures; `percuss report DIR --figures` writes them as pictures.");
  }
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function column(bytes, offset, width, length) {
  const plain = new Uint8Array(width * length);
  for (let k = 0; k < width; k++) {
    for (let i = 0; i < length; i++) plain[i * width + k] = bytes[offset + k * length + i];
  }
  const values = width === 8 ? new Float64Array(plain.buffer) : new Float32Array(plain.buffer);
  // uPlot leaves a gap where a value is null, and only there
  return values.every(Number.isFinite) ? values : Array.from(values, (v) => (Number.isFinite(v) ? v : null));
}

async function unpack(index, text) {
  let bytes = bytesFromBase64(text);
  if (index.encoding === "deflate") bytes = await inflate(bytes);
  let offset = 0;
  return index.columns.map(([width, length]) => {
    const values = column(bytes, offset, width, length);
    offset += width * length;
    return values;
  });
}

if (typeof module !== "undefined") module.exports = { bytesFromBase64, inflate, column, unpack };
