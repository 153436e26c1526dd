// How soon a page of `sprung play` can be used, how large it is, and what its pictures cost. The rows are those of
// docs/measured.md.
// usage: measure.mjs FOLDER PAGE.html   FOLDER has node_modules; exit status 1: a row is not as wanted
import { statSync } from "node:fs";
import path from "node:path";
import { launch, open, processorTimes_s } from "./browser.mjs";
import { median, row, rowOfLoad } from "./report.mjs";

const [folder, file] = process.argv.slice(2);
const openings = 3;
const settle_ms = 5_000;
const pictures_ms = 10_000;

row("play.page", statSync(file).size / 1e6, "MB", { most: 25 });
const opened_s = [];
for (let i = 0; i < openings; ++i) {
  const browser = await launch(folder); // a new one each time: nothing of the page before is in its processes
  const before = await processorTimes_s(browser);
  const page = await open(browser, path.resolve(file));
  opened_s.push((await page.evaluate(() => performance.getEntriesByName("sprung-ready")[0].startTime)) / 1000);
  const after = await processorTimes_s(browser);
  row("play.open, until it can be used", opened_s.at(-1), "s");
  row("play.open, processor of the page", after.renderer - before.renderer, "s");
  await browser.close();
}
row(`play.open, median of ${openings}`, median(opened_s), "s", { most: 2 });

const browser = await launch(folder);
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
rowOfLoad();
await browser.close();
