"use strict";

// A figure of the report as uPlot draws it: its series, axes and legend.

const HEIGHT = 330;
const SMALL_HEIGHT = 200;
const DASHES = [[], [], [9, 4], [2, 3], [9, 3, 2, 3], [14, 5], [5, 2], [1, 2], [12, 3, 2, 3, 2, 3], [4, 4], [16, 3, 4, 3], [7, 2, 2, 2], [10, 2, 4, 2]];

function heightOf(figure) {
  return figure.small ? SMALL_HEIGHT : HEIGHT;
}

function dashOf(series) {
  return series.dashed ? DASHES[series.style] : [];
}

function significant(value, digits) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e9) return String(Number(value.toExponential(digits - 1)));
  return String(Number(value.toPrecision(digits)));
}

// Five digits; what is below 1e-9 of the scale is round-off (round_off.rs), and nothing.
function withUnit(value, unit, scale = 0) {
  if (value == null) return "";
  const plain = Math.abs(value) <= 1e-9 * scale ? 0 : value;
  return significant(plain, 5) + (unit ? (unit.startsWith("10") ? " \u00b7 " : " ") + unit : "");
}

// Five digits, and more where so little is shown that these would not distinguish its places.
function digitsIn({ min, max }) {
  const size = Math.max(Math.abs(min), Math.abs(max));
  const share = (max - min) / size;
  return share > 0 && Number.isFinite(share) ? Math.min(12, 5 + Math.max(0, Math.floor(-Math.log10(share)))) : 5;
}

function largestOf(columns) {
  let most = 0;
  for (const column of columns) for (const v of column) if (v != null && Math.abs(v) > most) most = Math.abs(v);
  return most;
}

function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

// One vertical line a value, with a dot at its end.
function stems(u, seriesIndex, from, to) {
  const stroke = new Path2D();
  const [x, y] = [u.data[0], u.data[seriesIndex]];
  const zero = u.valToPos(0, "y", true);
  const radius = 3 * devicePixelRatio;
  for (let i = from; i <= to; i++) {
    if (y[i] == null) continue;
    const px = Math.round(u.valToPos(x[i], "x", true));
    const py = Math.round(u.valToPos(y[i], "y", true));
    stroke.moveTo(px, zero);
    stroke.lineTo(px, py);
    stroke.moveTo(px + radius, py);
    stroke.arc(px, py, radius, 0, 2 * Math.PI);
  }
  return { stroke, fill: null, clip: null };
}

// Spans of the abscissa, [from, to, value] each.
function spansOf(x, y) {
  const spans = [];
  for (let i = 0; i + 1 < x.length; i += 2) spans.push([x[i], x[i + 1], y[i]]);
  return spans;
}

// One shaded rectangle a span, as high as the figure.
function bands(u, spans) {
  const fill = new Path2D();
  for (const [from, to] of spans) {
    const low = u.valToPos(Math.max(from, u.scales.x.min), "x", true);
    const high = u.valToPos(Math.min(to, u.scales.x.max), "x", true);
    if (high >= low) fill.rect(low, u.bbox.top, Math.max(high - low, 1), u.bbox.height);
  }
  return { stroke: null, fill, clip: null };
}

function bandValue(figure, spans, x) {
  const span = x == null ? null : spans.find(([from, to]) => from <= x && x <= to);
  if (!span) return "";
  return `${withUnit(span[2], figure.y.unit)}, ${significant(span[0], 5)} to ${withUnit(span[1], figure.x.unit)}`;
}

// Abscissa and ordinates as uPlot takes them. Areas lie on each other; their own values stay in `own`.
function tables(figure, columns) {
  figure.scale = largestOf(figure.tables.flatMap((t) => t.series.map((s) => columns[s.y])));
  for (const t of figure.tables) {
    let below = null;
    for (const s of t.series) {
      if (s.shape === "band") s.spans = spansOf(columns[t.x], columns[s.y]);
      s.values = columns[s.y];
      if (s.shape !== "area") continue;
      s.own = columns[s.y];
      const under = below;
      s.values = below = Array.from(s.own, (v, i) => (v == null ? null : v + (under ? (under[i] ?? 0) : 0)));
    }
  }
  const parts = figure.tables.map((t) => [columns[t.x], ...t.series.map((s) => s.values)]);
  return parts.length === 1 ? parts[0] : uPlot.join(parts);
}

const COLUMN = 2; // pixels of the canvas that a column of a band takes
const DENSE = 3; // values a column from which a curve may be a band
const TURNS = 0.7; // turning points a column from which its oscillations cannot be distinguished

// A line; where a column of pixels holds more oscillations than can be distinguished, the band that they fill.
function lineOrBand(u, seriesIndex, from, to) {
  const line = () => ({ ...uPlot.paths.linear()(u, seriesIndex, from, to), fill: null });
  const columns = Math.max(1, Math.ceil(u.bbox.width / COLUMN));
  if (to - from < DENSE * columns || turnsOf(u.data[seriesIndex], from, to) < TURNS * columns) return line();
  const [x, y] = [u.data[0], u.data[seriesIndex]];
  const edges = extremesByColumn(columns, from, to, (i) => (u.valToPos(x[i], "x", true) - u.bbox.left) / COLUMN, (i) => y[i]);
  const tops = edges.map(({ column, low, high }) => [u.bbox.left + COLUMN * (column + 0.5), u.valToPos(high, "y", true), u.valToPos(low, "y", true)]);
  const [stroke, fill] = [new Path2D(), new Path2D()];
  for (const k of [1, 2]) tops.forEach((t, i) => (i ? stroke.lineTo(t[0], t[k]) : stroke.moveTo(t[0], t[k])));
  tops.forEach((t, i) => (i ? fill.lineTo(t[0], t[1]) : fill.moveTo(t[0], t[1])));
  tops.toReversed().forEach((t) => fill.lineTo(t[0], t[2]));
  return { stroke, fill, clip: null };
}

// How often a curve turns from rising to falling or back, by more than a thousandth of what it spans.
function turnsOf(y, from, to) {
  let [low, high] = [Infinity, -Infinity];
  for (let i = from; i <= to; i++) if (y[i] != null) [low, high] = [Math.min(low, y[i]), Math.max(high, y[i])];
  const least = 1e-3 * (high - low);
  let [turns, direction, extreme] = [0, 0, null];
  for (let i = from; i <= to; i++) {
    const v = y[i];
    if (v == null) continue;
    extreme ??= v;
    if (direction * (v - extreme) >= 0 && direction) extreme = v;
    else if (Math.abs(v - extreme) > least) {
      if (direction) turns += 1;
      direction = Math.sign(v - extreme);
      extreme = v;
    }
  }
  return turns;
}

// Smallest and largest value in each column that has any.
function extremesByColumn(columns, from, to, columnOf, valueOf) {
  const found = [];
  let last = null;
  for (let i = from; i <= to; i++) {
    const value = valueOf(i);
    if (value == null) continue;
    const column = Math.min(columns - 1, Math.max(0, Math.floor(columnOf(i))));
    if (last?.column !== column) found.push((last = { column, low: value, high: value }));
    last.low = Math.min(last.low, value);
    last.high = Math.max(last.high, value);
  }
  return found;
}

function seriesOptions(figure, series) {
  const options = {
    label: series.label,
    stroke: colour("--c" + series.style),
    width: (series.style === 0 ? 1.75 : 1.5) * series.weight,
    dash: dashOf(series),
    spanGaps: figure.tables.length > 1,
    points: { show: false },
    value: (u, value) => withUnit(value, figure.y.unit, figure.scale),
  };
  if (series.shape === "line" && !figure.filled) {
    options.fill = options.stroke + "4d";
    options.paths = lineOrBand;
  }
  if (series.shape === "stem") options.paths = stems;
  if (series.shape === "dots") {
    options.paths = () => null;
    options.points = { show: true, size: 4, width: 0, fill: options.stroke };
  }
  if (series.shape === "steps") {
    options.paths = uPlot.paths.stepped({ align: 1 });
    options.fill = options.stroke + "2e";
  }
  if (series.shape === "area") {
    options.width = 0;
    options.value = (u, value, k, i) => withUnit(i == null ? null : series.own[i], figure.y.unit, figure.scale);
  }
  if (series.shape === "band") {
    options.scale = "band"; // a band's value is no height
    options.fill = options.stroke + "40";
    options.paths = (u) => bands(u, series.spans);
    options.value = (u, value, seriesIndex, i) => bandValue(figure, series.spans, i == null ? null : u.data[0][i]);
  }
  return options;
}

const STACKED = "8c"; // opacity of areas that lie on each other

// What uPlot fills between two series: each area down to the one below it, or between the first two curves.
function fills(figure, series) {
  if (figure.filled) return [{ series: [1, 2], fill: colour("--c1") + "2e" }];
  const areas = series.map((s, k) => [s, k + 1]).filter(([s]) => s.shape === "area");
  return areas.slice(1).map(([s, k], i) => ({ series: [k, areas[i][1]], fill: colour("--c" + s.style) + STACKED }));
}

// Values that differ by next to nothing are not worth enlarging.
function range(u, low, high) {
  if (low == null) return [-1, 1];
  const size = Math.max(Math.abs(low), Math.abs(high));
  if (size === 0) return [-1, 1];
  if (high - low <= 1e-5 * size) return [low - 0.1 * size, high + 0.1 * size];
  return uPlot.rangeNum(low, high, 0.1, true);
}

function rangeWithZero(u, low, high) {
  if (low == null) return [0, 1];
  return uPlot.rangeNum(Math.min(0, low), Math.max(0, high), 0.1, true);
}

function axis(caption, extra) {
  return {
    label: caption,
    labelFont: "13px system-ui, sans-serif",
    font: "12px system-ui, sans-serif",
    stroke: colour("--text"),
    grid: { stroke: colour("--grid"), width: 1 },
    ticks: { stroke: colour("--line"), width: 1, size: 6 },
    values: (u, splits) => splits.map((v) => (v == null ? "" : significant(v, 7))),
    ...extra,
  };
}

// As wide as its widest label.
function axisSize(u, values, axisIndex) {
  const longest = (values ?? [""]).reduce((a, b) => (b.length > a.length ? b : a), "");
  u.ctx.save();
  u.ctx.font = u.axes[axisIndex].font[0];
  const width = u.ctx.measureText(longest).width / devicePixelRatio;
  u.ctx.restore();
  return Math.ceil(width) + 14;
}

function options(figure, width, onZoom) {
  const series = figure.tables.flatMap((t) => t.series);
  const hasZero = figure.from_zero || series.some((s) => s.shape === "stem" || s.shape === "area");
  const yRange = figure.range ?? (hasZero ? rangeWithZero : range);
  return {
    width,
    height: heightOf(figure),
    series: [
      { label: figure.own ? figure.x.caption.replace(/ \[.*/, "") : "time", value: (u, v) => (v == null ? "" : `${significant(v, digitsIn(u.scales.x))} ${figure.x.unit}`) },
      ...series.map((s, k) => {
        const options = seriesOptions(figure, s);
        // The lowest area is filled down to zero, the others to the one below.
        if (s.shape === "area" && !series.slice(0, k).some((t) => t.shape === "area")) options.fill = options.stroke + STACKED;
        return options;
      }),
    ],
    scales: { x: { time: false }, y: { range: yRange }, band: { range: [0, 1] } },
    axes: [axis(figure.x.caption, { labelSize: 22, size: 32 }), axis(figure.y.caption, { labelSize: 22, size: axisSize })],
    cursor: {
      drag: { x: true, y: false },
      ...(figure.own ? {} : { sync: { key: "percuss", setSeries: false, filters: { pub: (type) => type === "mousemove" || type === "mouseleave" } } }),
      points: { size: 6 },
    },
    bands: fills(figure, series),
    legend: { live: true },
    hooks: { setScale: [(u, key) => key === "x" && onZoom(u)] },
  };
}

// The dash pattern beside its name, and the name within reach of the keyboard.
function finishLegend(u, figure) {
  const series = figure.tables.flatMap((t) => t.series);
  const rows = u.root.querySelectorAll(".u-legend .u-series");
  series.forEach((s, k) => {
    const label = rows[k + 1].querySelector("th");
    const dash = s.shape === "dots" ? "4 9" : dashOf(s).join(" ");
    const patch = s.shape === "band" || s.shape === "area";
    const width = patch ? 8 : s.shape === "dots" ? 4 : 1 + s.weight;
    const opacity = { band: 0.25, area: 0.55 }[s.shape] ?? 1;
    const line = `<svg width="30" height="8" aria-hidden="true"><path d="M0 4H30" stroke="${colour("--c" + s.style)}" stroke-width="${width}" stroke-opacity="${opacity}" stroke-dasharray="${dash}"/></svg>`;
    label.insertAdjacentHTML("afterbegin", line);
    label.tabIndex = 0;
    label.setAttribute("role", "button");
    label.setAttribute("aria-pressed", "true");
    const pressed = () => label.setAttribute("aria-pressed", String(u.series[k + 1].show));
    label.addEventListener("click", () => setTimeout(pressed));
    label.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      label.click();
    });
  });
}

// First and last abscissa of all of them.
function wholeOf(entries) {
  const ends = entries.filter((e) => e.data[0].length).map((e) => [e.data[0][0], e.data[0][e.data[0].length - 1]]);
  const whole = [Math.min(...ends.map((e) => e[0])), Math.max(...ends.map((e) => e[1]))];
  const low = Number.isFinite(whole[0]) ? whole[0] : 0;
  if (!(whole[1] > whole[0])) return [low, low + 1];
  whole[1] += 1e-6 * (whole[1] - whole[0]); // so that the last tick is there
  return whole;
}
