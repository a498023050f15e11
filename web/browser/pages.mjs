// Report pages in a real browser, from files and without a network: PAGES is a directory with a page of each scenario,
// SHOTS one for pictures of them, BROWSER the program, PLAYWRIGHT the library that drives it. See scripts/check-browser.

import assert from "node:assert/strict";
import { mkdirSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";

const { PAGES, SHOTS, BROWSER, PLAYWRIGHT } = process.env;
const { chromium } = createRequire(import.meta.url)(PLAYWRIGHT);
const quiet = ["--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"];
const root = process.getuid?.() === 0;
let browser;

before(async () => {
  mkdirSync(SHOTS, { recursive: true });
  browser = await chromium.launch({ executablePath: BROWSER, args: root ? ["--no-sandbox", ...quiet] : quiet });
});
after(() => browser.close());

async function open(name, width, height) {
  const context = await browser.newContext({ viewport: { width, height }, offline: true, acceptDownloads: true });
  const page = await context.newPage();
  const errors = [];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("request", (request) => request.url().startsWith("http") && errors.push(request.url()));
  await page.goto(pathToFileURL(join(PAGES, name, "report.html")).href);
  await page.waitForFunction(() => document.querySelector("[data-scene=time]")?.textContent);
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
    for (const colour of ["stress", "moment"]) {
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
    await page.screenshot({ path: join(SHOTS, `${name}-400.png`) });
    assert.deepEqual(errors, []);
    await close();
  });
}

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
