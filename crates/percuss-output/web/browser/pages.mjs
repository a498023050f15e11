// Report pages in a real browser, from files and without a network: PAGES is a directory with a page of each scenario,
// STILL one of results of `static`, `static --path` and `modes`, SHOTS one for pictures of them, BROWSER the program, PLAYWRIGHT the library that drives it, AXE axe-core, which checks accessibility. See scripts/check-browser.

import assert from "node:assert/strict";
import { mkdirSync, readFileSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";

const { PAGES, SHOTS, BROWSER, PLAYWRIGHT, COMPARISON, STILL, AXE } = process.env;
const { chromium } = createRequire(import.meta.url)(PLAYWRIGHT);
const quiet = ["--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"];
const root = process.getuid?.() === 0;
let browser;

before(async () => {
  mkdirSync(SHOTS, { recursive: true });
  browser = await chromium.launch({ executablePath: BROWSER, args: root ? ["--no-sandbox", ...quiet] : quiet });
});
after(() => browser.close());

const drawn = () => document.querySelector("[data-scene=time]")?.textContent;
// Where motion is unwanted the scene does not play by itself, so that tests know what it shows.
const calm = { reducedMotion: "reduce" };
const open = (name, width, height) => openFile(join(PAGES, name, "report.html"), width, height, drawn, calm);

async function openFile(file, width, height, ready = drawn, preferences = {}) {
  const context = await browser.newContext({ viewport: { width, height }, offline: true, acceptDownloads: true, ...preferences });
  const page = await context.newPage();
  const errors = [];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("request", (request) => request.url().startsWith("http") && errors.push(request.url()));
  await page.goto(pathToFileURL(file).href);
  await page.waitForFunction(ready);
  return { page, errors, close: () => context.close() };
}

const time = (page) => page.textContent("[data-scene=time]");

// How many pixels of the canvas differ from its first one.
const inked = (page) =>
  page.evaluate(() => {
    const canvas = document.querySelector("#scene canvas");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    for (let i = 4; i < data.length; i += 4) count += data[i] !== data[0] || data[i + 1] !== data[1] || data[i + 2] !== data[2];
    return count;
  });

const scrub = (page, share) =>
  page.evaluate((share) => {
    const slider = document.querySelector("#scene input[type=range]");
    slider.value = String(10000 * share);
    slider.dispatchEvent(new Event("input"));
  }, share);

for (const name of readdirSync(PAGES)) {
  test(`${name}: the first screen shows the scene, which plays, scrubs, zooms and exports`, async () => {
    const { page, errors, close } = await open(name, 1400, 900);
    const box = await page.locator("#scene canvas").boundingBox();
    assert.ok(box.y + box.height <= 900, `the scene ends at ${box.y + box.height}`);
    assert.ok((await page.textContent(".story")).length > 20);
    assert.ok((await inked(page)) > 300);
    await page.screenshot({ path: join(SHOTS, `${name}.png`) });

    await page.focus("#scene canvas");
    await page.keyboard.press("Home");
    assert.equal(await time(page), "0 s");
    await page.keyboard.press(" ");
    await page.waitForFunction(() => document.querySelector("[data-scene=time]").textContent !== "0 s");
    await page.keyboard.press(" ");
    const paused = await time(page);
    await page.waitForTimeout(100);
    assert.equal(await time(page), paused);

    await page.keyboard.press("End");
    const end = await page.evaluate(() => document.querySelector("[data-scene=time]").textContent);
    await scrub(page, 0.5);
    const half = await time(page);
    assert.notEqual(half, end);
    if (await page.isVisible("[data-scene=impact]")) {
      await page.click("[data-scene=impact]");
      assert.equal(await page.getAttribute("[data-scene=impact]", "aria-pressed"), "true");
      await page.click("[data-scene=impact]");
    }
    for (const colour of ["stress", "velocity", "moment"]) {
      await page.selectOption("[data-scene=colour]", colour);
      assert.ok((await inked(page)) > 300);
    }
    await page.selectOption("[data-scene=diagram]", "moment");
    await page.focus("#scene canvas");
    for (const key of ["+", "+", "-", "0"]) await page.keyboard.press(key);
    for (const [button, file] of [["svg", "scene.svg"], ["png", "scene.png"]]) {
      const [download] = await Promise.all([page.waitForEvent("download"), page.click(`[data-scene=${button}]`)]);
      assert.equal(download.suggestedFilename(), file);
    }
    await page.click("#theme");
    assert.ok((await inked(page)) > 300);
    await page.screenshot({ path: join(SHOTS, `${name}-dark.png`) });
    assert.deepEqual(errors, []);
    await close();
  });

  test(`${name}: on a telephone the scene is on the first screen and nothing hangs over`, async () => {
    const { page, errors, close } = await open(name, 400, 800);
    const box = await page.locator("#scene canvas").boundingBox();
    assert.ok(box.y + box.height <= 800, `the scene ends at ${box.y + box.height}`);
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 400);
    await page.evaluate(() => document.querySelectorAll("details").forEach((one) => (one.open = true)));
    const cut = () => [...document.querySelectorAll(".table")].filter((t) => t.scrollWidth > t.clientWidth + 1).map((t) => t.textContent.slice(0, 60));
    assert.deepEqual(await page.evaluate(cut), [], "tables wider than the screen");
    await page.screenshot({ path: join(SHOTS, `${name}-400.png`) });
    assert.deepEqual(errors, []);
    await close();
  });
}

// Parts of a page that a finger cannot hit: smaller than 40 pixels, a label being part of its box.
const small = () => {
  const parts = [...document.querySelectorAll("button, select, summary, input, [role=button]")].filter((e) => e.checkVisibility());
  const sized = parts.map((e) => [e, (e.type === "checkbox" ? e.closest("label") : e).getBoundingClientRect()]);
  return sized.filter(([, box]) => Math.min(box.width, box.height) < 39.5).map(([e]) => e.outerHTML.slice(0, 80));
};

async function checkAccessibility(page) {
  await page.evaluate(readFileSync(AXE, "utf8"));
  const { violations } = await page.evaluate(() => axe.run(document));
  assert.deepEqual(violations.map((v) => `${v.id}, ${v.help}: ${v.nodes.map((n) => n.html.slice(0, 100)).join(" | ")}`), []);
  assert.deepEqual(await page.evaluate(small), []);
}

for (const [width, scheme] of [[1400, "light"], [400, "dark"]]) {
  test(`all kinds of pages are accessible, ${width} pixels wide, ${scheme}`, async () => {
    const files = ["gapped-pipe", "struck-column", "tapping-cantilever"].map((name) => join(PAGES, name, "report.html"));
    const resting = ["static/static.html", "modes/modes.html", "path/path.html"].map((name) => join(STILL, name));
    for (const file of [...files, COMPARISON, ...resting]) {
      const ready = resting.includes(file) ? () => document.documentElement.dataset.open : drawn;
      const { page, errors, close } = await openFile(file, width, 900, ready, { ...calm, colorScheme: scheme });
      await page.evaluate(() => document.querySelectorAll("details").forEach((one) => (one.open = true)));
      await checkAccessibility(page);
      assert.deepEqual(errors, [], file);
      await close();
    }
  });
}

test("the scene plays once when the page opens, then shows the instant of greatest interest and says so", async () => {
  // What yields stays bent: the end is shown.
  const { page, errors, close } = await openFile(join(PAGES, "struck-column", "report.html"), 1400, 900);
  assert.equal(await page.textContent("[data-scene=play]"), "Pause");
  await page.waitForFunction(() => document.querySelector("[data-scene=play]").textContent === "Play", null, { timeout: 15000 });
  assert.equal(await time(page), "400 ms");
  assert.match(await page.getAttribute("#scene canvas", "aria-label"), /^Scene, t = 400 ms; .*largest displacement \d/);
  assert.match(await page.textContent(".status"), /^Completed, t = 400.ms, (no|\d+) warnings?$/);
  assert.deepEqual(errors, []);
  await close();
  // An elastic one is shown at the largest contact force, at once where motion is unwanted.
  const other = await open("gapped-pipe", 1400, 900);
  assert.equal(await other.page.textContent("[data-scene=play]"), "Play");
  assert.match(await other.page.getAttribute("#scene canvas", "aria-label"), /in contact: '.+' [\d.]+ k?N/);
  await other.close();
});

test("whoever takes the scene in hand stops what plays by itself", async () => {
  const { page, errors, close } = await openFile(join(PAGES, "struck-column", "report.html"), 1400, 900);
  await page.focus("#scene canvas");
  await page.keyboard.press("Home");
  assert.equal(await time(page), "0 s");
  await page.waitForTimeout(150);
  assert.equal(await time(page), "0 s");
  assert.deepEqual(errors, []);
  await close();
});

test("a click into a figure takes the scene to its time, and figures follow the scene", async () => {
  const { page, errors, close } = await open(readdirSync(PAGES)[0], 1400, 900);
  const over = page.locator("figure[data-figure] .u-over").first();
  await over.scrollIntoViewIfNeeded();
  const before = await time(page);
  const box = await over.boundingBox();
  await page.mouse.click(box.x + 0.73 * box.width, box.y + 0.5 * box.height);
  assert.notEqual(await time(page), before);
  await scrub(page, 0.25);
  const told = () => page.evaluate(() => document.querySelector("figure[data-figure] .u-legend .u-value").textContent);
  await page.waitForFunction(() => !document.querySelector("figure[data-figure] .u-legend .u-value").textContent.startsWith("--"));
  const quarter = await told();
  await scrub(page, 0.75);
  await page.waitForTimeout(200);
  assert.notEqual(await told(), quarter);
  assert.deepEqual(errors, []);
  await close();
});

async function downloaded(page, click) {
  const [download] = await Promise.all([page.waitForEvent("download"), click()]);
  return { name: download.suggestedFilename(), text: readFileSync(await download.path(), "utf8") };
}

test("a figure is exported as numbers and as a drawing, and zoomed by the keyboard", async () => {
  const { page, errors, close } = await open("crossing-beams", 1400, 900);
  const figure = page.locator('figure[data-figure="energy"]');
  const csv = await downloaded(page, () => figure.locator("[data-save=csv]").click());
  assert.equal(csv.name, "energy.csv");
  const [header, ...rows] = csv.text.trim().split("\n");
  assert.ok(header.startsWith('"time ['), header);
  assert.ok(rows.length > 100 && rows.every((row) => row.split(",").length === header.split(",").length));
  const svg = await downloaded(page, () => figure.locator("[data-save=svg]").click());
  assert.ok(svg.text.startsWith("<svg") && svg.text.includes("kinetic"));
  const paths = svg.text.match(/<path/g).length;
  const over = figure.locator(".u-over");
  await over.focus();
  for (let k = 0; k < 12; k++) await page.keyboard.press("+");
  const zoomed = await downloaded(page, () => figure.locator("[data-save=svg]").click());
  assert.notEqual(zoomed.text, svg.text, "what is shown has changed");
  assert.ok(paths > 3);
  await over.focus();
  await page.keyboard.press("0");
  const whole = await downloaded(page, () => figure.locator("[data-save=svg]").click());
  assert.equal(whole.text, svg.text);
  assert.deepEqual(errors, []);
  await close();
});

test("two fingers zoom a figure, all figures over time with it", async () => {
  const context = await browser.newContext({ viewport: { width: 400, height: 800 }, hasTouch: true, offline: true });
  const page = await context.newPage();
  await page.goto(pathToFileURL(join(PAGES, "crossing-beams", "report.html")).href);
  await page.waitForFunction(() => document.querySelector("figure[data-figure] .u-over"));
  const ticks = () => page.evaluate(() => document.querySelector('figure[data-figure="energy"] canvas').toDataURL());
  const before = await ticks();
  await page.evaluate(() => {
    const over = document.querySelector('figure[data-figure="energy"] .u-over');
    const box = over.getBoundingClientRect();
    const finger = (type, id, x) =>
      over.dispatchEvent(new PointerEvent(type, { pointerId: id, pointerType: "touch", clientX: box.left + x, clientY: box.top + 20, bubbles: true }));
    finger("pointerdown", 1, 100);
    finger("pointerdown", 2, 140);
    finger("pointermove", 1, 60);
    finger("pointermove", 2, 220);
    finger("pointerup", 1, 60);
    finger("pointerup", 2, 220);
  });
  await page.waitForTimeout(200);
  assert.notEqual(await ticks(), before);
  await context.close();
});

test("the log folds chatter and sorts by impulse", async () => {
  const { page, errors, close } = await open("tapping-cantilever", 1400, 900);
  const fold = page.locator(".log .fold").first();
  const touches = page.locator(".log tr.touch:not([hidden])");
  assert.equal(await touches.count(), 0);
  await fold.click();
  assert.ok((await touches.count()) > 3);
  await fold.click();
  assert.equal(await touches.count(), 0);
  await page.click("[data-sort=impulse]");
  const impulses = await page.evaluate(() => [...document.querySelectorAll(".log tr[data-impulse]")].map((r) => Number(r.dataset.impulse)));
  assert.ok(impulses.length > 2 && impulses.every((v, i) => !i || v <= impulses[i - 1]));
  assert.deepEqual(errors, []);
  await close();
});

test("runs over each other play together", async () => {
  const { page, errors, close } = await openFile(COMPARISON, 1400, 900, drawn, calm);
  assert.ok((await inked(page)) > 300);
  assert.ok((await page.textContent("main")).includes("difference"));
  await page.screenshot({ path: join(SHOTS, "comparison.png") });
  await scrub(page, 0.7);
  const curves = await page.evaluate(() => document.querySelector('figure[data-figure] .u-legend').textContent);
  assert.ok(curves.includes("gapped-pipe") && curves.includes("finer"), curves);
  assert.deepEqual(errors, []);
  await close();
});

const still = (name, width, height) => openFile(join(STILL, name), width, height, () => document.documentElement.dataset.open);

// The pixels of a canvas, as one number each picture has of its own.
const print = (page, selector) => page.evaluate((selector) => document.querySelector(selector).toDataURL(), selector);

test("a static page draws the loaded structure enlarged, and its buckling mode swings", async () => {
  const { page, errors, close } = await still("static/static.html", 1400, 900);
  assert.ok((await inked(page)) > 300);
  assert.equal(await page.isVisible("[data-scene=play]"), false, "nothing to play");
  assert.match(await page.inputValue("[data-scene=exaggeration]"), /^[125]0*$/);
  const svg = await downloaded(page, () => page.click("[data-scene=svg]"));
  assert.match(svg.text, /deformation scale [125]0/);
  await page.selectOption("[data-scene=exaggeration]", "1");
  assert.match((await downloaded(page, () => page.click("[data-scene=svg]"))).text, /deformation scale 1</);
  await page.selectOption("[data-scene=diagram]", "moment");
  assert.match((await downloaded(page, () => page.click("[data-scene=svg]"))).text, /M up to 61\.189 kN m/);
  const panel = "#panels canvas";
  await page.locator(panel).scrollIntoViewIfNeeded();
  const before = await print(page, panel);
  await page.waitForTimeout(300);
  assert.notEqual(await print(page, panel), before, "it swings");
  await page.click("[data-panels=play]");
  const paused = await print(page, panel);
  await page.waitForTimeout(200);
  assert.equal(await print(page, panel), paused);
  await page.screenshot({ path: join(SHOTS, "static.png"), fullPage: true });
  await page.emulateMedia({ media: "print" });
  await page.waitForSelector(".paper svg", { state: "attached" });
  assert.equal(await page.locator(".paper svg").count(), 2, "drawings for paper");
  assert.ok(!(await page.content()).includes("NaN"));
  assert.deepEqual(errors, []);
  await close();
});

test("a page of modes swings them, a period each, and fits a telephone", async () => {
  const { page, errors, close } = await still("modes/modes.html", 400, 800);
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 400);
  assert.equal(await page.locator("#panels figure").count(), 10);
  const before = await print(page, "#panels canvas");
  await page.waitForTimeout(300);
  assert.notEqual(await print(page, "#panels canvas"), before);
  await page.click("#theme");
  await page.screenshot({ path: join(SHOTS, "modes-400.png"), fullPage: true });
  await page.emulateMedia({ media: "print" });
  await page.waitForSelector(".paper svg", { state: "attached" });
  assert.equal(await page.locator(".paper svg").count(), 10);
  assert.deepEqual(errors, []);
  await close();
});

test("a path is followed with its load factor, and a click into the curve takes the structure there", async () => {
  const { page, errors, close } = await still("path/path.html", 1400, 900);
  assert.equal(await time(page), "load factor 1");
  const titles = await page.locator("#panels h3").allTextContents();
  assert.ok(titles.some((t) => t.startsWith("limit point at load factor")) && titles.some((t) => t.startsWith("end, at")), titles.join());
  const chart = await print(page, "#chart canvas");
  await scrub(page, 0.3);
  assert.match(await time(page), /^load factor 0\.\d+$/);
  assert.notEqual(await print(page, "#chart canvas"), chart, "the mark moves along the curve");
  const box = await page.locator("#chart canvas").boundingBox();
  await page.mouse.click(box.x + 0.97 * box.width, box.y + 0.65 * box.height);
  assert.equal(await time(page), "load factor 0");
  await page.screenshot({ path: join(SHOTS, "path.png"), fullPage: true });
  assert.deepEqual(errors, []);
  await close();
});
