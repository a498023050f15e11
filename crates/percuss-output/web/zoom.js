"use strict";

// A figure within reach of fingers and of the keyboard: two fingers zoom, one moves what is zoomed; plus, minus, arrows, zero.

const ZOOM_KEY = 1.5; // what a press of a key enlarges
const PAN_KEY = 0.15; // how far an arrow key moves, as a share of what is shown
const DEEPEST = 1e-7; // smallest share of the whole that is shown

// [from, to] enlarged by a factor about a place, within the whole.
function zoomed([from, to], factor, at, whole) {
  const least = DEEPEST * (whole[1] - whole[0]);
  const width = Math.min(whole[1] - whole[0], Math.max(least, (to - from) / factor));
  const share = to > from ? (at - from) / (to - from) : 0.5;
  return moved([at - share * width, at + (1 - share) * width], 0, whole);
}

// [from, to] moved along, within the whole.
function moved([from, to], by, whole) {
  const width = Math.min(to - from, whole[1] - whole[0]);
  const start = Math.min(Math.max(from + by, whole[0]), whole[1] - width);
  return [start, start + width];
}

// `whole` gives the range that the figure can show at most, `name` says what it shows.
function reach(plot, whole, name) {
  const shown = () => [plot.scales.x.min, plot.scales.x.max];
  const show = ([min, max]) => plot.setScale("x", { min, max });
  const over = plot.over;
  over.tabIndex = 0;
  over.setAttribute("role", "group");
  over.setAttribute("aria-label", `${name}. Plus and minus zoom, arrow keys move, zero shows all.`);
  over.style.touchAction = "pan-y";
  over.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const [from, to] = shown();
    const at = plot.cursor.left >= 0 ? plot.posToVal(plot.cursor.left, "x") : (from + to) / 2;
    const step = PAN_KEY * (to - from);
    const keys = {
      "+": () => zoomed([from, to], ZOOM_KEY, at, whole()),
      "=": () => zoomed([from, to], ZOOM_KEY, at, whole()),
      "-": () => zoomed([from, to], 1 / ZOOM_KEY, at, whole()),
      ArrowLeft: () => moved([from, to], -step, whole()),
      ArrowRight: () => moved([from, to], step, whole()),
      "0": whole,
    };
    if (!keys[event.key]) return;
    event.preventDefault();
    show(keys[event.key]());
  });
  const fingers = new Map(); // where each is [pixels from the left]
  over.addEventListener("pointerdown", (event) => event.pointerType === "touch" && fingers.set(event.pointerId, event.offsetX));
  over.addEventListener("pointermove", (event) => {
    if (!fingers.has(event.pointerId)) return;
    const before = [...fingers.values()];
    fingers.set(event.pointerId, event.offsetX);
    const now = [...fingers.values()];
    const value = (pixel) => plot.posToVal(pixel, "x");
    const middle = (list) => list.reduce((sum, v) => sum + v, 0) / list.length;
    const slid = moved(shown(), value(middle(before)) - value(middle(now)), whole());
    if (fingers.size === 1) return show(slid);
    const apart = (list) => Math.max(8, Math.abs(list[0] - list[1]));
    show(zoomed(slid, apart(now) / apart(before), value(middle(now)), whole()));
  });
  for (const end of ["pointerup", "pointercancel", "pointerleave"]) over.addEventListener(end, (event) => fingers.delete(event.pointerId));
}
