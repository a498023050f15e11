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

// Figures.

const HEIGHT = 330;
const SMALL_HEIGHT = 200;
const DASHES = [[], [], [9, 4], [2, 3], [9, 3, 2, 3], [14, 5], [5, 2], [1, 2], [12, 3, 2, 3, 2, 3]];

function heightOf(figure) {
  return figure.small ? SMALL_HEIGHT : HEIGHT;
}

function dashOf(series) {
  return series.dashed ? DASHES[series.style] : [];
}

function significant(value, digits) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e9) return value.toExponential(digits - 1);
  return String(Number(value.toPrecision(digits)));
}

function withUnit(value, unit) {
  if (value == null) return "";
  return significant(value, 6) + (unit ? (unit.startsWith("10") ? " \u00b7 " : " ") + unit : "");
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
  return `${withUnit(span[2], figure.y.unit)}, ${significant(span[0], 6)} to ${withUnit(span[1], figure.x.unit)}`;
}

function tables(figure, columns) {
  for (const t of figure.tables) {
    for (const s of t.series) if (s.shape === "band") s.spans = spansOf(columns[t.x], columns[s.y]);
  }
  const parts = figure.tables.map((t) => [columns[t.x], ...t.series.map((s) => columns[s.y])]);
  return parts.length === 1 ? parts[0] : uPlot.join(parts);
}

function seriesOptions(figure, series) {
  const options = {
    label: series.label,
    stroke: colour("--c" + series.style),
    width: (series.style === 0 ? 1.75 : 1.5) * series.weight,
    dash: dashOf(series),
    spanGaps: figure.tables.length > 1,
    points: { show: false },
    value: (u, value) => withUnit(value, figure.y.unit),
  };
  if (series.shape === "stem") options.paths = stems;
  if (series.shape === "dots") {
    options.paths = () => null;
    options.points = { show: true, size: 4, width: 0, fill: options.stroke };
  }
  if (series.shape === "steps") {
    options.paths = uPlot.paths.stepped({ align: 1 });
    options.fill = options.stroke + "2e";
  }
  if (series.shape === "band") {
    options.scale = "band"; // a band's value is no height
    options.fill = options.stroke + "40";
    options.paths = (u) => bands(u, series.spans);
    options.value = (u, value, seriesIndex, i) => bandValue(figure, series.spans, i == null ? null : u.data[0][i]);
  }
  return options;
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
    values: (u, splits) => splits.map((v) => (v == null ? "" : significant(v, 6))),
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
  const hasZero = figure.from_zero || series.some((s) => s.shape === "stem");
  const yRange = figure.range ?? (hasZero ? rangeWithZero : range);
  return {
    width,
    height: heightOf(figure),
    series: [
      { label: figure.own ? figure.x.caption.replace(/ \[.*/, "") : "time", value: (u, v) => withUnit(v, figure.x.unit) },
      ...series.map((s) => seriesOptions(figure, s)),
    ],
    scales: { x: { time: false }, y: { range: yRange }, band: { range: [0, 1] } },
    axes: [axis(figure.x.caption, { labelSize: 22, size: 32 }), axis(figure.y.caption, { labelSize: 22, size: axisSize })],
    cursor: {
      drag: { x: true, y: false },
      ...(figure.own ? {} : { sync: { key: "percuss", setSeries: false, filters: { pub: (type) => type === "mousemove" || type === "mouseleave" } } }),
      points: { size: 6 },
    },
    bands: figure.filled ? [{ series: [1, 2], fill: colour("--c1") + "2e" }] : [],
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
    const width = s.shape === "band" ? 8 : s.shape === "dots" ? 4 : 1 + s.weight;
    const opacity = s.shape === "band" ? 0.25 : 1;
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

class Report {
  constructor(figures, columns) {
    this.entries = figures
      .map((figure) => ({
        figure,
        element: [...document.querySelectorAll("figure[data-figure]")].find((e) => e.dataset.figure === figure.id),
        data: tables(figure, columns),
        plot: null,
      }))
      .filter((entry) => entry.element);
    for (const entry of this.entries) if (entry.figure.own) entry.range = entry.whole = wholeOf([entry]);
    this.whole = wholeOf(this.entries.filter((entry) => !entry.figure.own));
    this.range = this.whole;
    this.zooming = false;
  }

  draw() {
    for (const entry of this.entries) {
      const place = entry.element.querySelector(".plot");
      const hidden = entry.plot ? entry.plot.series.map((s) => !s.show) : [];
      if (entry.plot) entry.plot.destroy();
      this.zooming = true;
      const plot = new uPlot(options(entry.figure, place.clientWidth, (u) => this.zoom(u, entry)), entry.data, place);
      hidden.forEach((hide, k) => hide && plot.setSeries(k, { show: false }));
      const shown = entry.range ?? this.range;
      plot.setScale("x", { min: shown[0], max: shown[1] });
      plot.ctx.canvas.setAttribute("role", "img");
      plot.ctx.canvas.setAttribute("aria-label", `${entry.figure.title}: ${entry.figure.y.caption} over ${entry.figure.x.caption}`);
      plot.over.addEventListener("dblclick", () => this.reset(entry));
      finishLegend(plot, entry.figure);
      entry.plot = plot;
    }
    queueMicrotask(() => (this.zooming = false));
    this.onDraw?.();
  }

  // A figure over its own abscissa is zoomed alone.
  zoom(source, entry) {
    if (this.zooming || source.scales.x.min == null) return;
    if (entry.figure.own) {
      entry.range = [source.scales.x.min, source.scales.x.max];
      return;
    }
    this.show([source.scales.x.min, source.scales.x.max], source);
  }

  show(range, except) {
    this.range = range;
    this.zooming = true;
    for (const { plot, figure } of this.entries) {
      if (plot !== except && !figure.own) plot.setScale("x", { min: range[0], max: range[1] });
    }
    queueMicrotask(() => (this.zooming = false)); // uPlot commits scales in a microtask of its own
  }

  reset(entry) {
    if (!entry) this.entries.filter((one) => one.figure.own).forEach((one) => this.reset(one));
    if (!entry || !entry.figure.own) return this.show(this.whole, null);
    entry.plot.setScale("x", { min: entry.whole[0], max: entry.whole[1] });
  }

  resize() {
    for (const { element, plot } of this.entries) {
      const width = element.querySelector(".plot").clientWidth;
      if (plot && width !== plot.width) plot.setSize({ width, height: plot.height });
    }
  }
}

function save(entry) {
  const source = entry.plot.ctx.canvas;
  const canvas = document.createElement("canvas");
  canvas.width = source.width;
  canvas.height = source.height;
  const context = canvas.getContext("2d");
  context.fillStyle = colour("--page");
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(source, 0, 0);
  const link = document.createElement("a");
  link.download = entry.figure.id.replace(/[^\w.-]+/g, "-") + ".png";
  link.href = canvas.toDataURL("image/png");
  link.click();
}

// Figures follow the scene's time, and a click into a figure takes the scene there.
function tie(player, report) {
  let due = 0;
  const follow = () => {
    due = 0;
    for (const { plot, figure, element } of report.entries) {
      const box = element.getBoundingClientRect();
      if (!plot || figure.own || box.bottom < 0 || box.top > innerHeight) continue;
      const left = plot.valToPos(player.time, "x");
      plot.setCursor({ left: left >= 0 && left <= plot.over.clientWidth ? left : -10, top: plot.over.clientHeight / 2 }, false);
    }
  };
  player.onTime(() => {
    if (!due) due = setTimeout(follow, player.playing ? 60 : 0);
  });
  report.onDraw = () => {
    for (const { plot, figure } of report.entries) {
      if (figure.own) continue;
      plot.over.addEventListener("click", (event) => {
        player.pause();
        player.seek(plot.posToVal(event.offsetX, "x"));
      });
    }
  };
}

function openScene(index, columns) {
  const section = document.getElementById("scene");
  if (!index.scene || !section) return null;
  const frames = Object.fromEntries(Object.entries(index.scene.frames).map(([name, k]) => [name, columns[k]]));
  return new Player(section, new Motion(index.scene.scene, frames));
}

function watchTheme(report, player) {
  const root = document.documentElement;
  const button = document.getElementById("theme");
  const system = matchMedia("(prefers-color-scheme: dark)");
  let chosen = null; // by the reader; null follows the system
  const apply = (dark) => {
    root.dataset.theme = dark ? "dark" : "light";
    button.setAttribute("aria-pressed", String(dark));
    report.draw();
    player?.theme();
  };
  const current = () => chosen ?? system.matches;
  button.addEventListener("click", () => apply((chosen = !current())));
  system.addEventListener("change", () => apply(current()));
  matchMedia("print").addEventListener("change", (print) => apply(!print.matches && current()));
  apply(current());
}

async function main() {
  const index = JSON.parse(document.getElementById("percuss-index").textContent);
  const columns = await unpack(index, document.getElementById("percuss-data").textContent);
  const report = new Report(index.figures, columns);
  const player = openScene(index, columns);
  if (player) tie(player, report);
  watchTheme(report, player);
  player?.seek(player.time);
  document.getElementById("reset").addEventListener("click", () => report.reset());
  for (const entry of report.entries) {
    entry.element.querySelector(".save").addEventListener("click", () => save(entry));
  }
  let pending = 0;
  addEventListener("resize", () => {
    clearTimeout(pending);
    pending = setTimeout(() => {
      report.resize();
      player?.draw();
    }, 80);
  });
}

if (typeof document !== "undefined") {
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  main().catch((error) => {
    const fault = document.getElementById("fault");
    fault.hidden = false;
    fault.textContent = error.message;
    console.error(error);
  });
} else if (typeof module !== "undefined") {
  module.exports = { bytesFromBase64, inflate, column, unpack, significant, withUnit, spansOf, bandValue, wholeOf };
}
