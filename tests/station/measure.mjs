// How soon a page of `sprung play` can be used, and what its pictures cost. The rows are those of docs/measured.md.
// usage: measure.mjs FOLDER PAGE.html   FOLDER has node_modules
import os from "node:os";
import path from "node:path";
import { launch, open, processorTimes_s } from "./browser.mjs";

const [folder, file] = process.argv.slice(2);
const openings = 3;
const settle_ms = 5_000;
const pictures_ms = 10_000;
const row = (name, value, unit) => console.log(`${name.padEnd(58)} ${value.toFixed(3)} ${unit}`);

const browser = await launch(folder);
for (let i = 0; i < openings; ++i) {
  const before = await processorTimes_s(browser);
  const page = await open(browser, path.resolve(file));
  const ready_ms = await page.evaluate(() => performance.getEntriesByName("sprung-ready")[0].startTime);
  const after = await processorTimes_s(browser);
  row("play.open, until it can be used", ready_ms / 1000, "s");
  row("play.open, processor of the page", after.renderer - before.renderer, "s");
  await page.close();
}
const page = await open(browser, path.resolve(file));
await page.evaluate(() => {
  window.sprung.timeline.loop = true;
  window.sprung.timeline.set_playing(true);
});
await page.waitForTimeout(settle_ms); // as many pixels as there is time for
const seen = () => page.evaluate(() => ({ ms: performance.now(), pictures: window.sprung.pictures }));
const before = await seen(), used = await processorTimes_s(browser);
await page.waitForTimeout(pictures_ms);
const after = await seen(), now = await processorTimes_s(browser);
const count = after.pictures - before.pictures;
row("play.pictures a second, by software", (1000 * count) / (after.ms - before.ms), "/s");
row("play.picture, processor of Chromium's drawing process", (1000 * (now.GPU - used.GPU)) / count, "ms");
row("play.picture, processor of the page", (1000 * (now.renderer - used.renderer)) / count, "ms");
row("load of the machine", os.loadavg()[0], "");
await browser.close();
