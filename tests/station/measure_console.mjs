// How soon an emergency stop by the space bar acts, how many pictures the live page draws, and what it costs the
// robot's computer. The rows are those of docs/measured.md; one command for each, none takes six minutes.
// usage: measure_console.mjs FOLDER BIN pictures [SECONDS]
//        measure_console.mjs FOLDER BIN estop [STOPS]
//        measure_console.mjs FOLDER BIN cost [SECONDS_A_ROUND [ROUNDS]]
// FOLDER has node_modules; exit status 1: a row is not as wanted; 2: wrong use
import { spawn } from "node:child_process";
import { randomBytes } from "node:crypto";
import { readFileSync } from "node:fs";
import http from "node:http";
import path from "node:path";
import { launch, processorTimes_s } from "./browser.mjs";
import { openLive, press, standUp, state } from "./live_page.mjs";
import { LiveRobot, eventually, pause } from "./live_robot.mjs";
import { median, row, rowOfLoad, share, sortedOf } from "./report.mjs";

const [folder, bin, what, ...numbers] = process.argv.slice(2);
const busy_loops = 2;
const settle_ms = 5_000;
const clock_ticks_s = 100;
const walk_longer_s = 60; // than it is watched
const pegasus = () => LiveRobot.up(bin, "pegasus", ["fl", "fr", "hl", "hr"]);

function standPegasus(robot) {
  robot.do("home", "--from", "link");
  robot.do("stand");
}

/** A page that was silent for too long, on a machine that has too much to do, no longer drives. */
async function takeControls(page) {
  if (await page.locator("#take-over").isVisible()) await page.locator("#take-over").click();
  await eventually("this page drives", () => page.evaluate(() => window.sprung.state.session.driver === window.sprung.link.page));
}

/** Until nothing stops the robot any more, and it rises. */
async function riseAgain(page) {
  await eventually("it is cleared", async () => {
    await takeControls(page);
    await press(page, "clear"); // refused as long as a drive has not come to rest
    await pause(150);
    return ["none", "starting"].includes((await state(page)).safety.cause);
  });
  await eventually("it is armed", async () => (await state(page)).safety.state === "operational");
  await eventually("it rises", async () => {
    await takeControls(page);
    if ((await state(page)).motion.state === "idle") await press(page, "stand");
    await pause(150);
    return ["rising", "standing"].includes((await state(page)).motion.state);
  });
}

/** Run in the page. */
const notePresses = () => {
  window.times_ms = [];
  window.drives_ms = [];
  addEventListener("keydown", (event) => { if (event.key === " ") window.pressed_ms = event.timeStamp; }, { capture: true });
};
const noteConfirmations = () => window.sprung.link.addEventListener("estop", ({ detail }) => {
  if (detail.state !== "confirmed") return;
  if (window.pressed_ms) {
    window.times_ms.push(performance.now() - window.pressed_ms);
    window.drives_ms.push(1000 * detail.time_s - (performance.timeOrigin + window.pressed_ms)); // and the session's begin
  }
  window.pressed_ms = 0;
});

/** By Date.now(), when the session's time began: that is CLOCK_MONOTONIC since an epoch. */
function sessionBegin_ms(robot) {
  const { epoch_us } = JSON.parse(readFileSync(path.join(robot.folder, "default.json"), "utf8"));
  return performance.timeOrigin + performance.now() - Number(process.hrtime.bigint() / 1000n - BigInt(epoch_us)) / 1000;
}

/** Times from the key's event in the page: `drives` to the DRIVE_STATE in which none has power, `page` to the page
    hearing of it. */
async function estopTimes_ms(browser, stops) {
  const robot = await LiveRobot.up(bin, "single_leg", ["leg"]);
  const load = Array.from({ length: busy_loops }, () => spawn(process.execPath, ["-e", "for (;;);"]));
  try {
    const page = await openLive(browser, await robot.console(), { script: notePresses });
    await page.evaluate(noteConfirmations);
    await standUp(page);
    for (let i = 0; i < stops; ++i) {
      await eventually("the drives have power", async () => (await state(page)).actuators.every(({ power }) => power === "operation enabled"));
      await page.keyboard.press("Space");
      await eventually("it is confirmed", () => page.evaluate((count) => window.times_ms.length > count, i));
      await riseAgain(page);
    }
    const times = await page.evaluate(() => ({ page: window.times_ms, drives: window.drives_ms }));
    const begin_ms = sessionBegin_ms(robot);
    return { page: times.page, drives: times.drives.map((since_ms) => since_ms + begin_ms) };
  } finally {
    for (const loop of load) loop.kill("SIGKILL");
    await robot.down();
  }
}

async function estop(stops = 200) {
  const browser = await launch(folder, ["--disable-3d-apis"]); // else it draws with all of the processor
  try {
    const times_ms = await estopTimes_ms(browser, stops);
    const drives_ms = sortedOf(times_ms.drives), page_ms = sortedOf(times_ms.page);
    row(`console.estop, space bar to no power, ${drives_ms.length} times under load, p50`, share(drives_ms, 0.5), "ms", { most: 50 });
    row("console.estop, p99", share(drives_ms, 0.99), "ms", { most: 100 });
    row("console.estop, longest", drives_ms.at(-1), "ms");
    row("console.estop, until the page says so, p50", share(page_ms, 0.5), "ms");
    row("console.estop, until the page says so, p99", share(page_ms, 0.99), "ms");
  } finally {
    await browser.close();
  }
}

/** A page without a browser, which is on another computer: hears everything, says that it is there. @return ends it. */
function listen(url) {
  return new Promise((resolve, reject) => {
    const asked = http.get(`${url}live`, { headers: { Connection: "Upgrade", Upgrade: "websocket", "Sec-WebSocket-Version": "13",
      "Sec-WebSocket-Key": randomBytes(16).toString("base64"), "Sec-WebSocket-Protocol": "sprung.v1", Origin: new URL(url).origin } });
    asked.on("error", reject);
    asked.on("response", ({ statusCode }) => reject(new Error(`the page's WebSocket is refused: ${statusCode}`)));
    asked.on("upgrade", (answer, socket) => {
      const text = Buffer.from('{"type":"alive"}');
      let heard = 0;
      socket.on("data", (part) => { heard += part.length; });
      // A mask of zeros leaves the text as it is.
      const alive = setInterval(() => socket.write(Buffer.concat([Buffer.from([0x81, 0x80 | text.length, 0, 0, 0, 0]), text])), 300);
      resolve(() => { clearInterval(alive); socket.destroy(); return heard; });
    });
  });
}

function processor_s(pid) {
  const fields = readFileSync(`/proc/${pid}/stat`, "utf8").split(") ")[1].split(" ");
  return (Number(fields[11]) + Number(fields[12])) / clock_ticks_s;
}

/** A round with or without a page: share of a core that the server takes, bytes to the page, and a log of CAN_TRACE. */
async function costOfRound(robot, url, name, seconds, open) {
  const end = open ? await listen(url) : () => 0;
  const recording = await robot.record(`${name}.lcm`, "CAN_TRACE");
  const before_s = processor_s(robot.server.pid), begin_ms = Date.now();
  await pause(1000 * seconds);
  const took_s = (Date.now() - begin_ms) / 1000;
  const used = (processor_s(robot.server.pid) - before_s) / took_s;
  const log = await recording.end();
  const bytes_s = end() / took_s;
  const said = robot.sprung("bench", "chain", log, "--json");
  if (said.status !== 0) throw new Error(`sprung bench chain: ${said.text}`);
  const find = (quantile) => Number(said.text.match(new RegExp(`"chain\\.${name}\\.${quantile}"[^}]*?"value":\\s*([0-9.e+-]+)`))[1]);
  return { used, bytes_s, p50_us: find("p50"), p99_us: find("p99") };
}

function rowsOfChain(rounds, without, quantile) {
  const of = (each) => each.map((round) => round[`${quantile}_us`]);
  const spread = (each) => `${Math.min(...each).toFixed(0)} to ${Math.max(...each).toFixed(0)}`;
  row(`console.chain, SYNC to last set-point, ${quantile}, no page (${spread(of(without))})`, median(of(without)), "us");
  row(`console.chain, ${quantile}, one page (${spread(of(rounds))})`, median(of(rounds)), "us");
  return median(of(rounds)) / median(of(without));
}

async function cost(seconds = 25, rounds = 5) {
  const robot = await pegasus();
  try {
    const url = await robot.console();
    standPegasus(robot);
    const without = [], with_page = [];
    for (let i = 0; i < rounds; ++i) {
      without.push(await costOfRound(robot, url, `without-${i}`, seconds, false));
      with_page.push(await costOfRound(robot, url, `with-${i}`, seconds, true));
    }
    const percent = (each) => 100 * median(each.map(({ used }) => used));
    row("console.processor, no page open, pegasus standing at 500 Hz", percent(without), "% of a core");
    row("console.processor, one page open", percent(with_page), "% of a core", { most: 3 });
    row("console.bytes to one page", median(with_page.map(({ bytes_s }) => bytes_s)) / 1000, "kB/s");
    row("console.chain, p99, ratio", rowsOfChain(with_page, without, "p99"), "");
    row("console.chain, p50, ratio", rowsOfChain(with_page, without, "p50"), "", { most: 1.02 });
  } finally {
    await robot.down();
  }
}

/** Pictures a second of pegasus, walking, live at 500 Hz, at 1280 x 720 by software; and what one of them costs. */
async function pictures(seconds = 30) {
  const robot = await pegasus();
  const drawing = await launch(folder);
  try {
    standPegasus(robot);
    const page = await openLive(drawing, await robot.console());
    // Not by the page: one that lost its hold on a busy machine would end the walk.
    robot.do("walk", "--speed", "0.1", "--for", String(seconds + walk_longer_s), "--no-wait");
    const walks = async () => (await state(page)).motion.state === "walking";
    await eventually("pegasus walks", walks);
    await pause(settle_ms); // as many pixels as there is time for
    const seen = () => page.evaluate(() => ({ ms: performance.now(), pictures: window.sprung.view.pictures, pixels: window.sprung.view.view.ratio }));
    const before = await seen(), used = await processorTimes_s(drawing);
    await pause(1000 * seconds);
    const after = await seen(), now = await processorTimes_s(drawing);
    if (!(await walks())) throw new Error("pegasus does not walk any more: what was drawn is not what was asked for");
    const count = after.pictures - before.pictures;
    row("console.pictures a second, pegasus at 500 Hz, by software", (1000 * count) / (after.ms - before.ms), "/s", { least: 20 });
    row("console.picture, processor of Chromium's drawing process", (1000 * (now.GPU - used.GPU)) / count, "ms");
    row("console.picture, processor of the page", (1000 * (now.renderer - used.renderer)) / count, "ms");
    row("console.picture, pixels for each of the page's, along an axis", after.pixels, "");
  } finally {
    await drawing.close();
    await robot.down();
  }
}

const commands = { pictures, estop, cost };
if (!(what in commands) || numbers.some((number) => !(Number(number) > 0))) {
  console.error(`usage: ${path.basename(process.argv[1])} FOLDER BIN pictures [SECONDS] | estop [STOPS] | cost [SECONDS_A_ROUND [ROUNDS]]`);
  process.exit(2);
}
await commands[what](...numbers.map(Number));
rowOfLoad();
