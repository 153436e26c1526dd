// Makes the pictures of docs/operator.md and README.md anew, each of a page that was just opened.
// usage: pictures.mjs FOLDER BIN OUT   FOLDER has node_modules; pictures go to OUT
import path from "node:path";
import { launch } from "./browser.mjs";
import { motionIs, openLive, press, standUp, state } from "./live_page.mjs";
import { LiveRobot, eventually, pause } from "./live_robot.mjs";

const [folder, bin, out] = process.argv.slice(2);
const settle_ms = 6_000; // as sharp as there is time for; a few steps
const trot_s = 6; // of the log: it trots
const keep = async (page, name) => {
  await pause(settle_ms);
  await page.screenshot({ path: path.join(out, name) });
  console.log(`pictures: ${name}`);
};

async function walking(browser, url, size, work) {
  const page = await openLive(browser, url, size);
  await press(page, "walk", { forward_m_s: 0.15 });
  await motionIs(page, "walking");
  await page.locator("form details").evaluateAll((all) => all.forEach((each) => { each.open = false; }));
  await work(page);
  await press(page, "stop");
  await motionIs(page, "standing");
  await page.close();
}

async function byKeyboard(browser, url) {
  const page = await openLive(browser, url);
  await page.locator("#source").selectOption("keyboard");
  await page.locator("#source").evaluate((select) => select.blur());
  await eventually("the keyboard is ready", async () => (await page.locator("#sticks").textContent()) === "ready");
  await page.keyboard.down("w");
  await motionIs(page, "walking");
  await keep(page, "console_keyboard.png");
  await page.keyboard.up("w");
  await motionIs(page, "standing");
  await page.close();
}

/** @return its path */
async function logOfATrot(browser, url) {
  const page = await openLive(browser, url);
  await press(page, "clear"); // the stop
  await eventually("it may stand", async () => (await state(page)).safety.state === "operational");
  await standUp(page);
  const recording = await robot.record("trot.lcm", ".*");
  await press(page, "walk", { forward_m_s: 0.15 });
  await motionIs(page, "walking");
  await pause(1000 * trot_s);
  const log = await recording.end();
  await page.close();
  return log;
}

async function stopped(browser, url) {
  const page = await openLive(browser, url);
  await page.keyboard.press("Space");
  await eventually("it is confirmed", async () => (await page.locator("#estop-state").textContent()).includes("no drive has power"));
  await keep(page, "console_estop.png");
  await page.close();
}

const robot = await LiveRobot.up(bin, "pegasus", ["fl", "fr", "hl", "hr"]);
const browser = await launch(folder);
try {
  const url = await robot.console();
  const first = await openLive(browser, url);
  await standUp(first);
  await first.close();
  await walking(browser, url, {}, (page) => keep(page, "console.png"));
  await walking(browser, url, { width: 1600, height: 1000 }, (page) => keep(page, "console_plots.png"));
  await walking(browser, url, { width: 820, height: 1180 }, (page) => keep(page, "console_tablet.png"));
  await byKeyboard(browser, url);
  await stopped(browser, url);
  robot.do("play", await logOfATrot(browser, url), "--png", path.join(out, "play.png"), "--at", String(trot_s));
  console.log("pictures: play.png");
} finally {
  await browser.close();
  await robot.down();
}
