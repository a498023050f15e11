// The scene of a result as a notebook shows it: PAGE is a file with what two results show. Run by python/tests/test_browser.py.

import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";

const { PAGE, BROWSER, PLAYWRIGHT } = process.env;
const { chromium } = createRequire(import.meta.url)(PLAYWRIGHT);
const browser = await chromium.launch({ executablePath: BROWSER, args: [...(process.getuid?.() === 0 ? ["--no-sandbox"] : []), "--disable-gpu"] });
try {
  const context = await browser.newContext({ viewport: { width: 900, height: 1500 }, offline: true });
  const page = await context.newPage();
  const errors = [];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("request", (request) => request.url().startsWith("http") && errors.push(request.url()));
  await page.goto(pathToFileURL(PAGE).href);
  const frames = page.frames().slice(1);
  assert.equal(frames.length, 2);
  for (const frame of frames) {
    await frame.waitForFunction(() => document.querySelector("[data-scene=time]").textContent);
    const inked = await frame.evaluate(() => {
      const canvas = document.querySelector("canvas");
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let i = 4; i < data.length; i += 4) count += data[i] !== data[0] || data[i + 1] !== data[1] || data[i + 2] !== data[2];
      return count;
    });
    assert.ok(inked > 300, `${inked} pixels`);
    const [needed, room] = await frame.evaluate(() => [document.documentElement.scrollHeight, innerHeight]);
    assert.ok(needed <= room, `${needed} pixels in ${room}`);
    const before = await frame.textContent("[data-scene=time]");
    await frame.click("[data-scene=play]");
    await frame.waitForFunction((before) => document.querySelector("[data-scene=time]").textContent !== before, before);
    await frame.click("[data-scene=play]");
    const saved = page.waitForEvent("download");
    await frame.click("[data-scene=svg]");
    assert.equal((await saved).suggestedFilename(), "scene.svg");
  }
  assert.deepEqual(errors, []);
} finally {
  await browser.close();
}
