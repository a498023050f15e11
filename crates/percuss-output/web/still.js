"use strict";

// The page of an equilibrium, of a path of them, or of shapes: the scene, pictures beside each other, the curve of a path.

// Frames that shapes are in stand behind those of configurations.
function motionsOf({ scene, frames }, details) {
  const shapes = new Set(details.panels.map((p) => p.shape).filter((k) => k != null));
  const still = takeFrames(frames, [...frames.time.keys()].filter((k) => !shapes.has(k)));
  const main = details.kind === "path" ? new PathMotion(scene, still, details.chart.kept) : new RestingMotion(scene, still);
  const panel = (p) =>
    p.shape != null ? new ShapeMotion(scene, frames, p.shape, p.about) : new RestingMotion(scene, takeFrames(frames, [p.frame]));
  return { main, panels: details.panels.map((p) => ({ title: p.title, motion: panel(p) })) };
}

// Drawings for paper: in the page's light colours, shapes farthest out.
function wirePrint(parts, apply, dark) {
  const print = (on) => {
    if (on) parts.panels.pause();
    apply(!on && dark());
    for (const panel of parts.panels.panels) panel.paper.innerHTML = on ? panel.svg(FULL) : "";
    for (const [part, canvas] of parts.single) {
      let paper = canvas.nextElementSibling;
      if (!paper?.classList.contains("paper")) {
        paper = document.createElement("div");
        paper.className = "paper";
        canvas.after(paper);
      }
      paper.innerHTML = on ? part.svg() : "";
    }
  };
  addEventListener("beforeprint", () => print(true));
  addEventListener("afterprint", () => print(false));
  matchMedia("print").addEventListener("change", (event) => print(event.matches));
}

async function openStill() {
  const index = JSON.parse(document.getElementById("percuss-index").textContent);
  const columns = await unpack(index, document.getElementById("percuss-data").textContent);
  const { details } = index;
  const [{ scene, frames }] = index.scenes;
  const unpacked = Object.fromEntries(Object.entries(frames).map(([key, k]) => [key, columns[k]]));
  const { main, panels } = motionsOf({ scene, frames: unpacked }, details);
  const section = document.getElementById("scene");
  const player = section && new Player(section, main);
  const chart = player && details.chart ? new PathChart(document.getElementById("chart"), details.chart, player) : null;
  const factor = player ? Number(player.control("exaggeration").value) : 1;
  const shown = (motion) => {
    const swings = motion instanceof ShapeMotion;
    return () => ({ ghost: true, loads: true, forces: !swings, bodies: !swings, obstacles: motion.obstacles, exaggeration: swings ? 1 : factor });
  };
  const list = document.getElementById("panels");
  const all = new Panels(list, panels.map(({ title, motion }) => new Panel(list.querySelector(".figures"), title, motion, shown(motion))));
  const root = document.documentElement;
  const button = document.getElementById("theme");
  const system = matchMedia("(prefers-color-scheme: dark)");
  let chosen = null; // by the reader; null follows the system
  const dark = () => chosen ?? system.matches;
  const apply = (on) => {
    root.dataset.theme = on ? "dark" : "light";
    button.setAttribute("aria-pressed", String(on));
    player?.theme();
    all.theme();
    chart?.show();
  };
  button.addEventListener("click", () => apply((chosen = !dark())));
  system.addEventListener("change", () => apply(dark()));
  wirePrint({ panels: all, single: [[player, player?.canvas], [chart, chart?.canvas]].filter(([part]) => part) }, apply, dark);
  addEventListener("resize", () => apply(!matchMedia("print").matches && dark()));
  apply(dark());
  wireTables(document);
  player?.seek(main.end);
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) all.play();
  root.dataset.open = "true";
}

if (typeof document !== "undefined") {
  openStill().catch((error) => {
    const fault = document.getElementById("fault");
    fault.hidden = false;
    fault.textContent = error.message;
    console.error(error);
  });
}
