// usage: measure.mjs FOLDER PAGE.html   FOLDER has node_modules
import { launch, open } from "./browser.mjs";

const [folder, file] = process.argv.slice(2);
const seconds = 5;
const browser = await launch(folder);
for (let i = 0; i < 3; ++i) {
  const page = await open(browser, file);
  const session = await page.context().newCDPSession(page);
  const opened_ms = await page.evaluate(() => performance.getEntriesByName("sprung-ready")[0].startTime);
  await session.send("Performance.enable", { timeDomain: "threadTicks" });
  const { metrics } = await session.send("Performance.getMetrics");
  const processor_s = metrics.find(({ name }) => name === "ProcessTime").value;
  const pictures = await page.evaluate(async (seconds) => {
    const app = window.sprung;
    app.timeline.seek((app.timeline.first_s + app.timeline.last_s) / 2);
    app.timeline.set_playing(true);
    const before = app.pictures;
    const begin_ms = performance.now();
    await new Promise((resolve) => setTimeout(resolve, 1000 * seconds));
    return ((app.pictures - before) * 1000) / (performance.now() - begin_ms);
  }, seconds);
  console.log(`measure: open after ${(opened_ms / 1000).toFixed(2)} s (${processor_s.toFixed(2)} s of the page's processor time); ` +
    `${pictures.toFixed(1)} pictures a second`);
  await page.close();
}
await browser.close();
