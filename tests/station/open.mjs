// Opens the pages that `run` has made and looks at them as a user would.
// usage: open.mjs FOLDER PAGES   FOLDER has node_modules and keeps pictures; exit status 1: something is not as it should be
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { launch, open } from "./browser.mjs";

const [folder, pages] = process.argv.slice(2);
const axe = createRequire(path.resolve(folder) + "/").resolve("axe-core/axe.min.js");
const at = (name) => path.join(pages, name);
const checks = [];
const check = (name, work) => checks.push({ name, work });

const stage = (page) => page.locator("#stage").screenshot();
const seek = (page, time_s) => page.evaluate((t) => window.sprung.timeline.seek(t), time_s);
const drawn = (page) => page.waitForFunction(() => !window.sprung.view?.dirty);

async function accessible(page, what) {
  await page.addScriptTag({ path: axe });
  const { violations } = await page.evaluate(() => window.axe.run());
  assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes[0].html}`), [], `axe-core, ${what}`);
}

/** Rows of `sprung log csv`: time in s, then the value. */
function csv(name) {
  const [heading, ...rows] = readFileSync(at(name), "utf8").trim().split("\n").map((line) => line.split(","));
  const time = heading.findIndex((title) => title.startsWith("time"));
  return rows.map((row) => ({ time_s: Number(row[time]), value: Number(row.at(-1)) }));
}

check("a log opens, and its numbers are the log's", async (browser) => {
  const page = await open(browser, at("jump.html"));
  const rows = csv("knee.csv");
  const peak = rows.reduce((best, row) => (Math.abs(row.value) > Math.abs(best.value) ? row : best));
  for (const row of [peak, rows[Math.floor(rows.length / 2)], rows.at(-1)]) {
    await seek(page, row.time_s + 1e-6);
    const shown = await page.evaluate(() => {
      const app = window.sprung;
      return app.source.row(app.timeline.time_s)[app.fields.get("joints.knee.gear_output_torque_Nm")];
    });
    assert.ok(Math.abs(shown - row.value) <= 1e-4 * Math.abs(row.value) + 1e-6, `${shown} at ${row.time_s} s, in the log ${row.value}`);
  }
  await page.screenshot({ path: path.join(folder, "jump.png") });
  assert.deepEqual(page.complaints, []);
  await page.close();
});

check("the slider moves the robot, events are jumped to, play goes on and ends", async (browser) => {
  const page = await open(browser, at("jump.html"));
  const pictures = [];
  for (const share of [3000, 5800, 6500]) { // standing, in flight, landing
    await page.locator("#slider").fill(String(share));
    await drawn(page);
    pictures.push((await stage(page)).toString("base64"));
  }
  assert.equal(new Set(pictures).size, 3, "the picture does not follow the slider");
  const flight = await page.locator("#events option", { hasText: "flight" }).first().getAttribute("value");
  await page.locator("#events").selectOption(flight);
  assert.equal(await page.locator("#phase").textContent(), "flight");
  const before = await page.evaluate(() => window.sprung.timeline.time_s);
  await page.locator("#speed").selectOption("10");
  await page.locator("#play").click();
  await page.waitForFunction((t) => window.sprung.timeline.time_s > t, before);
  await page.waitForFunction(() => !window.sprung.timeline.playing); // at the end, without loop
  assert.equal(await page.evaluate(() => window.sprung.timeline.time_s === window.sprung.timeline.last_s), true);
  await page.locator("#loop").check();
  await page.locator("#play").click();
  await page.waitForFunction(() => window.sprung.timeline.playing && window.sprung.timeline.time_s > 0.5);
  assert.deepEqual(page.complaints, []);
  await page.close();
});

check("what is drawn can be switched off, a plot chosen, zoomed and taken away", async (browser) => {
  const page = await open(browser, at("jump.html"), { hash: "#at=4.75" });
  await drawn(page);
  const all = (await stage(page)).toString("base64");
  await page.locator("[data-layer=forces]").uncheck();
  await drawn(page);
  assert.notEqual((await stage(page)).toString("base64"), all);
  await page.locator(".plot select").first().selectOption({ label: "Joint position, estimated" });
  assert.match(await page.locator(".plot .key").first().textContent(), /hip .*knee/);
  const area = await page.locator(".u-over").first().boundingBox();
  await page.mouse.move(area.x + 0.4 * area.width, area.y + 30);
  await page.mouse.down();
  await page.mouse.move(area.x + 0.6 * area.width, area.y + 30, { steps: 4 });
  await page.mouse.up();
  const [from_s, to_s] = await page.evaluate(() => window.sprung.plots.span());
  const [first_s, last_s] = await page.evaluate(() => window.sprung.source.range());
  assert.ok(to_s - from_s < 0.3 * (last_s - first_s), "a drag zooms");
  assert.equal(await page.evaluate(() => window.sprung.timeline.time_s), 4.75, "a drag leaves the time alone");
  await page.mouse.click(area.x + 0.5 * area.width, area.y + 30);
  const clicked_s = await page.evaluate(() => window.sprung.timeline.time_s);
  assert.ok(Math.abs(clicked_s - (from_s + to_s) / 2) < 0.1 * (to_s - from_s), `a click goes to ${clicked_s} s`);
  const plots = await page.locator(".plot").count();
  await page.getByRole("button", { name: "Take this plot away" }).first().click();
  assert.equal(await page.locator(".plot").count(), plots - 1);
  assert.deepEqual(page.complaints, []);
  await page.close();
});

check("a picture of a moment is a picture of the page", async (browser) => {
  const png = readFileSync(path.join(folder, "picture.png"));
  assert.deepEqual([png.readUInt32BE(16), png.readUInt32BE(20)], [900, 620]);
  const page = await browser.newPage();
  const colours = await page.evaluate(async (base64) => {
    const image = new Image();
    image.src = `data:image/png;base64,${base64}`;
    await image.decode();
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 60, 400, 460); // where the robot stands
    const found = new Set();
    for (let i = 0; i < data.length; i += 4) found.add(`${data[i] >> 3},${data[i + 1] >> 3},${data[i + 2] >> 3}`);
    return found.size;
  }, png.toString("base64"));
  assert.ok(colours > 60, `${colours} colours where the robot stands`);
  await page.close();
});

for (const [theme, width, height] of [["light", 1280, 720], ["dark", 1280, 720], ["light", 820, 1180], ["dark", 1180, 820]]) {
  check(`everybody can use it: ${theme}, ${width} x ${height}`, async (browser) => {
    const page = await open(browser, at("jump.html"), { theme, width, height, hash: "#at=4.75" });
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), theme);
    await accessible(page, theme);
    const [inner, outer] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
    assert.ok(inner <= outer, "nothing is wider than the screen");
    const canvas = await page.locator("#view").boundingBox();
    assert.ok(canvas.width > 300 && canvas.height > 200, `the robot has ${canvas.width} x ${canvas.height}`);
    await page.screenshot({ path: path.join(folder, `jump-${theme}-${width}.png`) });
    assert.deepEqual(page.complaints, []);
    await page.close();
  });
}

check("of a log that was cut in the middle what was written is shown, and that it was cut is said", async (browser) => {
  const page = await open(browser, at("cut.html"));
  assert.match(await page.locator("#notes").textContent(), /damaged|cut off/);
  const whole_s = csv("knee.csv").at(-1).time_s;
  const last_s = await page.evaluate(() => window.sprung.timeline.last_s);
  assert.ok(last_s > 0.3 * whole_s && last_s < 0.6 * whole_s, `${last_s} s`);
  assert.deepEqual(page.complaints, []);
  await page.close();
});

check("without the simulation's truth the trunk stands on its feet, and the page says so", async (browser) => {
  const page = await open(browser, at("untrue.html"), { hash: "#at=3" });
  assert.match(await page.locator("#notes").textContent(), /Nothing measures the trunk/);
  assert.match(await page.locator("#badges").textContent(), /trunk by: legs/);
  assert.equal(await page.locator("#legend .truth").isVisible(), false);
  assert.deepEqual(page.complaints, []);
  await page.close();
});

check("without a model plots and time are there, and why there is no robot", async (browser) => {
  const page = await open(browser, at("no-model.html"), { hash: "#at=4.75" });
  assert.match(await page.locator("#stage-note").textContent(), /No model of this robot is here/);
  assert.equal(await page.locator("#phase").textContent(), "landing");
  assert.ok((await page.locator(".plot canvas").count()) > 0);
  await accessible(page, "no model");
  assert.deepEqual(page.complaints, []);
  await page.close();
});

check("of joint states of another version no pose is drawn, and who made the log is named", async (browser) => {
  const page = await open(browser, at("other.html"), { hash: "#at=4.75" });
  assert.match(await page.locator("#stage-note").textContent(), /not drawn.*JOINT_STATE is of another version/);
  assert.match(await page.locator("#notes").textContent(), /its values are missing; use the sprung that made the log: \d/);
  assert.equal(await page.locator("#view").isVisible(), false);
  assert.equal(await page.locator("#phase").textContent(), "landing", "times are there all the same");
  assert.deepEqual(await page.locator("#joints b").allTextContents(), ["-", "-"]);
  await page.screenshot({ path: path.join(folder, "other-version.png") });
  await accessible(page, "another version");
  assert.deepEqual(page.complaints, []);
  await page.close();
});

check("what drives and a battery say once a second can be plotted", async (browser) => {
  const page = await open(browser, at("jump.html"));
  const titles = await page.evaluate(async () => {
    const { plot_choices } = await import("plots");
    const fields = ["actuators.m.measured_temperature_degC", "auxiliary.battery_voltage_V"].map((name) => ({ name, unit: "" }));
    return plot_choices({ joints: [], legs: [], actuators: ["m"], fields }).map(({ title }) => title);
  });
  assert.deepEqual(titles, ["Drive temperature, measured", "Battery voltage"]);
  await page.close();
});

check("a browser without WebGL shows plots and time, and says what is missing", async () => {
  const browser = await launch(folder, ["--disable-3d-apis"]);
  const page = await open(browser, at("jump.html"), { hash: "#at=4.75" });
  assert.match(await page.locator("#stage-note").textContent(), /has no WebGL/);
  assert.equal(await page.locator("#phase").textContent(), "landing");
  assert.ok((await page.locator(".plot canvas").count()) > 0);
  await browser.close();
});

const browser = await launch(folder);
for (const { name, work } of checks) {
  try {
    await work(browser);
    console.log(`station: ok: ${name}`);
  } catch (error) {
    console.log(`station: FAILED: ${name}: ${error.message}`);
    process.exitCode = 1;
  }
}
await browser.close();
