"use strict";

// The page: all figures over one time, tied to the scene, zoomed together.

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
      plot.ctx.canvas.setAttribute("aria-label", describeFigure(entry.figure));
      plot.over.addEventListener("dblclick", () => this.reset(entry));
      finishLegend(plot, entry.figure);
      reach(plot, () => entry.whole ?? this.whole);
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

// What a figure shows, for those who do not see it: title, axes, curves.
function describeFigure(figure) {
  const curves = figure.tables.flatMap((t) => t.series.map((s) => s.label));
  const title = figure.group ? `${figure.group}, ${figure.title}` : figure.title;
  return `${title}: ${figure.y.caption} over ${figure.x.caption}; ${curves.length > 1 ? "curves" : "curve"} ${curves.join(", ")}`;
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
  if (!index.scenes?.length || !section) return null;
  const motions = index.scenes.map(({ name, scene, frames }) => {
    const unpacked = Object.fromEntries(Object.entries(frames).map(([key, k]) => [key, columns[k]]));
    return Object.assign(new Motion(scene, unpacked), { name });
  });
  return new Player(section, motions[0], motions.slice(1));
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
  wireLog(document);
  wireTables(document);
  if (player) {
    player.mayStandBeside = true;
    tie(player, report);
  }
  watchTheme(report, player);
  player?.open();
  document.getElementById("reset").addEventListener("click", () => report.reset());
  for (const entry of report.entries) {
    for (const button of entry.element.querySelectorAll("[data-save]")) {
      button.addEventListener("click", () => save(entry, button.dataset.save));
    }
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
}
