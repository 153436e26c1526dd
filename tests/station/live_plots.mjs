// What the live page has of a log's page: layers, legend, plots of the last seconds.
// usage: live_plots.mjs FOLDER BIN   FOLDER has node_modules and keeps a picture; exit status 1: not as it should be
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { launch } from "./browser.mjs";
import { openLive } from "./live_page.mjs";
import { LiveRobot, eventually, pause } from "./live_robot.mjs";

const [folder, bin] = process.argv.slice(2);
const axe = createRequire(path.resolve(folder) + "/").resolve("axe-core/axe.min.js");
const span = (page) => page.evaluate(() => window.sprung.plots.plots.span());

async function layersAndLegend(page) {
  await page.locator(".layers input").first().waitFor();
  assert.deepEqual(await page.locator(".layers input").evaluateAll((all) => all.map((box) => box.dataset.layer)),
                   ["ghost", "forces", "cones", "torques", "follow"]);
  await page.locator("[data-layer=forces]").uncheck();
  assert.equal(await page.evaluate(() => window.sprung.view.view.shown.forces), false);
  assert.match(await page.locator(".legend").textContent(), /torque at the gear.*foot force, estimated/);
  assert.ok(await page.locator(".legend .truth").isVisible(), "the simulation says its forces");
}

async function plotsFollow(page) {
  assert.equal(await page.locator(".plot").count(), 0, "closed ones are not drawn");
  await page.locator(".live-plots summary").click();
  await page.locator(".plot canvas").first().waitFor();
  const [from_s, to_s] = await span(page);
  assert.equal(to_s - from_s, 20);
  await eventually("time goes on", async () => (await span(page))[1] > to_s + 1);
  await page.locator(".plot select").first().selectOption({ label: "Joint position, estimated" });
  await eventually("its values follow", async () => /hip -?\d.*knee -?\d/.test(await page.locator(".plot .key").first().textContent()));
  await page.locator(".plot select").first().selectOption({ label: "Gear temperature, estimated" });
  assert.match(await page.locator(".plot").first().textContent(), /Nothing of this has been heard yet|hip/);
}

async function readable(page) {
  await page.evaluate(readFileSync(axe, "utf8"));
  const { violations } = await page.evaluate(() => window.axe.run());
  assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes[0].html}`), [], "axe-core");
  const canvas = await page.locator("#canvas").boundingBox();
  assert.ok(canvas.height > 250, `the robot has ${canvas.height} px beside its plots`);
}

async function closedOnesRest(page) {
  await page.locator(".live-plots summary").click();
  await pause(500);
  const before_s = await page.evaluate(() => window.sprung.plots.plots.time_s);
  await pause(1000);
  assert.equal(await page.evaluate(() => window.sprung.plots.plots.time_s), before_s, "closed plots are drawn all the same");
}

const robot = await LiveRobot.up(bin, "single_leg", ["leg"]);
const browser = await launch(folder);
try {
  const page = await openLive(browser, await robot.console());
  for (const check of [layersAndLegend, plotsFollow, readable, closedOnesRest]) {
    await check(page);
    console.log(`station: ok: live page: ${check.name}`);
    if (check === readable) await page.screenshot({ path: path.join(folder, "live-plots.png") });
  }
  assert.deepEqual(page.complaints, []);
} catch (error) {
  console.log(`station: FAILED: live page, plots: ${error.message}`);
  process.exitCode = 1;
} finally {
  await browser.close();
  await robot.down();
}
