"use strict";

// The load factor over displacements along a path, which may turn back in both: drawn with a pen, with limit points and where the scene is.

const CHART_MARGIN = { left: 62, right: 16, bottom: 46 };
const CHART_LINE = 16; // height of a name above the curves

// Round values between two, about so many.
function roundTicks(low, high, count) {
  const rough = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((m) => m * power >= rough * (1 - 1e-9));
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) ticks.push(k * step);
  return ticks;
}

// Where the curves end, with zero and some room.
function chartRange(values) {
  let [low, high] = [0, 0];
  for (const list of values) for (const v of list) [low, high] = [Math.min(low, v), Math.max(high, v)];
  if (!(high > low)) return [-1, 1];
  return [low - (low < 0 ? 0.05 : 0) * (high - low), high + (high > 0 ? 0.05 : 0) * (high - low)];
}

class PathChart {
  // `chart` has unit, factors and curves (label, style, x) of the points; kept (factors, and of each curve) and limits of the scene.
  constructor(figure, chart, player) {
    Object.assign(this, { figure, chart, player, canvas: figure.querySelector("canvas") });
    figure.hidden = !chart.curves.length;
    this.top = 14 + (chart.curves.length > 1 ? CHART_LINE * chart.curves.length : 0);
    this.x = chartRange(chart.curves.map((c) => c.x));
    this.y = chartRange([chart.factors]);
    player.onTime(() => this.show());
    this.canvas.addEventListener("click", (event) => player.seek(this.nearest([event.offsetX, event.offsetY])));
    figure.querySelector("[data-chart=svg]").addEventListener("click", () => saveAs("path.svg", `data:image/svg+xml;charset=utf-8,${encodeURIComponent(this.svg())}`));
  }

  frame(width, height) {
    const { left, right, bottom } = CHART_MARGIN;
    const { top } = this;
    const share = (v, [low, high]) => (v - low) / (high - low);
    return { width, height, to: (x, y) => [left + share(x, this.x) * (width - left - right), height - bottom - share(y, this.y) * (height - top - bottom)] };
  }

  // The kept equilibrium whose point is nearest to a pixel.
  nearest([px, py]) {
    const { to } = this.frame(this.canvas.clientWidth, this.canvas.clientHeight);
    let best = [Infinity, 0];
    this.chart.kept.forEach((factor, k) => {
      for (const curve of this.chart.curves) {
        const [x, y] = to(curve.kept[k], factor);
        const away = Math.hypot(x - px, y - py);
        if (away < best[0]) best = [away, k];
      }
    });
    return best[1];
  }

  draw(pen, colours) {
    const { chart } = this;
    const { to, width, height } = this.frame(pen.width, pen.height);
    const { left, right, bottom } = CHART_MARGIN;
    const { top } = this;
    pen.begin(colours("--page"));
    for (const x of roundTicks(...this.x, Math.max(2, Math.floor(width / 110)))) {
      const [px] = to(x, 0);
      pen.path([[px, top], [px, height - bottom]], { stroke: colours("--grid") });
      pen.text([px, height - bottom + 12], significant(x, 5), { fill: colours("--text"), size: 12, align: "center" });
    }
    for (const y of roundTicks(...this.y, 6)) {
      const [, py] = to(0, y);
      pen.path([[left, py], [width - right, py]], { stroke: colours("--grid") });
      pen.text([left - 6, py], significant(y, 5), { fill: colours("--text"), size: 12, align: "right" });
    }
    const only = chart.curves.length === 1 ? ` of ${chart.curves[0].label}` : "";
    pen.text([(left + width - right) / 2, height - 12], `displacement${only} [${chart.unit}]`, { fill: colours("--text"), size: 13, align: "center" });
    chart.curves.forEach((curve, k) => {
      const style = { stroke: colours(`--c${curve.style}`), width: 1.6, dash: DASHES[curve.style] };
      pen.path(curve.x.map((x, i) => to(x, chart.factors[i])), style);
      if (chart.curves.length > 1) {
        const y = 10 + CHART_LINE * k;
        pen.path([[left + 8, y], [left + 34, y]], style);
        pen.text([left + 40, y], curve.label, { fill: colours("--text"), size: 12, halo: colours("--page") });
      }
      const mark = (index, style) => pen.circle(to(curve.kept[index], chart.kept[index]), 4.5, style);
      for (const index of chart.limits) mark(index, { fill: colours("--page"), stroke: colours(`--c${curve.style}`), width: 1.6 });
      mark(chart.kept.length - 1, { fill: colours(`--c${curve.style}`) });
      const now = this.player.time;
      const [a, b] = [Math.floor(now), Math.ceil(now)];
      const between = (list) => (a === b ? list[a] : list[a] + (now - a) * (list[b] - list[a]));
      pen.circle(to(between(curve.kept), between(chart.kept)), 5, { fill: colours("--c2"), stroke: colours("--page"), width: 1.5 });
    });
  }

  show() {
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    if (!width) return;
    this.shown = [width, height];
    this.draw(penOn(this.canvas, width, height), colour);
  }

  svg() {
    const pen = new SvgPen(...(this.shown ?? [560, 380]));
    this.draw(pen, colour);
    return pen.finish();
  }
}
