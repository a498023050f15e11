"use strict";

// A figure as a file: its numbers as CSV, what is shown of it as SVG or PNG.

function fileName(figure, ending) {
  return figure.id.replace(/[^\w.-]+/g, "-") + "." + ending;
}

function saveAs(name, href) {
  const link = document.createElement("a");
  link.download = name;
  link.href = href;
  link.click();
}

function save({ figure, data, plot }, kind) {
  const text = (type, content) => `data:${type};charset=utf-8,${encodeURIComponent(content)}`;
  if (kind === "csv") return saveAs(fileName(figure, "csv"), URL.createObjectURL(new Blob([csvOf(figure, data)], { type: "text/csv" })));
  if (kind === "svg") return saveAs(fileName(figure, "svg"), text("image/svg+xml", svgOf(plot, figure)));
  const source = plot.ctx.canvas;
  const canvas = document.createElement("canvas");
  canvas.width = source.width;
  canvas.height = source.height;
  const context = canvas.getContext("2d");
  context.fillStyle = colour("--page");
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(source, 0, 0);
  saveAs(fileName(figure, "png"), canvas.toDataURL("image/png"));
}

// A cell that no program takes for a formula.
function csvCell(text) {
  const plain = /^[=+\-@\t\r]/.test(text) ? `'${text}` : text;
  return `"${plain.replaceAll('"', '""')}"`;
}

// One row an abscissa, a column a curve, in the units of the figure; empty where a curve has no value.
function csvOf(figure, data) {
  const series = figure.tables.flatMap((t) => t.series);
  const unit = figure.y.unit ? ` [${figure.y.unit}]` : "";
  const own = (k) => series[k].own ?? data[k + 1];
  const header = [figure.x.caption, ...series.map((s) => s.label + unit)].map(csvCell).join(",");
  const cell = (v) => (v == null ? "" : String(v));
  const rows = Array.from(data[0], (x, i) => [x, ...series.map((_, k) => own(k)[i])].map(cell).join(","));
  return `${header}\n${rows.join("\n")}\n`;
}

// What the plot shows, drawn again with the pen for paper.
function svgOf(plot, figure) {
  const series = figure.tables.flatMap((t) => t.series);
  const shown = series.map((s, k) => [s, k + 1]).filter(([, k]) => plot.series[k].show);
  const ratio = devicePixelRatio || 1;
  const box = { left: plot.bbox.left / ratio, top: 26 + plot.bbox.top / ratio, width: plot.bbox.width / ratio, height: plot.bbox.height / ratio };
  const legend = 18 * Math.ceil(shown.length / 2);
  const pen = new SvgPen(plot.width, box.top + box.height + 48 + legend);
  const [text, soft, grid] = [colour("--text"), colour("--soft"), colour("--grid")];
  const px = (v) => box.left + plot.valToPos(v, "x");
  const py = (v) => box.top + Math.min(box.height, Math.max(0, plot.valToPos(v, "y")));
  pen.begin(colour("--page"));
  ticksOf(plot, 0).forEach(([v, label]) => {
    pen.path([[px(v), box.top], [px(v), box.top + box.height]], { stroke: grid });
    pen.text([px(v), box.top + box.height + 12], label, { fill: text, size: 11, align: "center" });
  });
  ticksOf(plot, 1).forEach(([v, label]) => {
    pen.path([[box.left, py(v)], [box.left + box.width, py(v)]], { stroke: grid });
    pen.text([box.left - 6, py(v)], label, { fill: text, size: 11, align: "right" });
  });
  pen.text([8, 10], figure.title, { fill: text, size: 13 });
  pen.text([8, 26], figure.y.caption, { fill: soft, size: 12 });
  pen.text([box.left + box.width, box.top + box.height + 28], figure.x.caption, { fill: soft, size: 12, align: "right" });
  let below = null;
  for (const [s, k] of shown) {
    const points = visible(plot, k).map((i) => [px(plot.data[0][i]), py(plot.data[k][i])]);
    const style = { stroke: colour("--c" + s.style), width: 1.5 * s.weight, dash: dashOf(s) };
    if (s.shape === "area") {
      const base = below ?? points.map(([x]) => [x, py(0)]);
      pen.path([...points, ...base.toReversed()], { fill: style.stroke, opacity: 0.55, closed: true });
      below = points;
    } else if (s.shape === "band") {
      for (const [from, to] of s.spans) {
        const [a, b] = [from, to].map((v) => Math.min(box.left + box.width, Math.max(box.left, px(v))));
        if (b > a) pen.path([[a, box.top], [b, box.top], [b, box.top + box.height], [a, box.top + box.height]], { fill: style.stroke, opacity: 0.25, closed: true });
      }
    } else if (s.shape === "stem") {
      for (const [x, y] of points) pen.path([[x, py(0)], [x, y]], style);
    } else if (s.shape === "dots") {
      for (const at of points) pen.circle(at, 2, { fill: style.stroke });
    } else {
      pen.path(s.shape === "steps" ? points.flatMap(([x, y], i) => (i ? [[x, points[i - 1][1]], [x, y]] : [[x, y]])) : points, style);
    }
  }
  shown.forEach(([s], i) => {
    const at = [box.left + (i % 2) * (box.width / 2), box.top + box.height + 46 + 18 * Math.floor(i / 2)];
    pen.path([at, [at[0] + 24, at[1]]], { stroke: colour("--c" + s.style), width: s.shape === "area" || s.shape === "band" ? 7 : 2, dash: dashOf(s) });
    pen.text([at[0] + 30, at[1]], s.label, { fill: text, size: 12 });
  });
  return pen.finish();
}

// Places and labels of an axis as they are drawn.
function ticksOf(plot, axis) {
  const { min, max } = plot.scales[axis ? "y" : "x"];
  const splits = plot.axes[axis]._splits ?? [];
  return splits.filter((v) => v != null && v >= min && v <= max).map((v) => [v, significant(v, 7)]);
}

// Rows of a curve within what is shown.
function visible(plot, k) {
  const [x, y] = [plot.data[0], plot.data[k]];
  const { min, max } = plot.scales.x;
  const rows = [];
  for (let i = 0; i < x.length; i++) if (y[i] != null && x[i] >= min && x[i] <= max) rows.push(i);
  return rows;
}
