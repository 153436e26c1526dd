// How soon an emergency stop by the space bar acts, and what the live page costs the robot's computer. The rows
// are those of docs/measured.md.
// usage: measure_console.mjs FOLDER BIN [STOPS]   FOLDER has node_modules; exit status 1: beyond a bound
import { spawn } from "node:child_process";
import { randomBytes } from "node:crypto";
import { readFileSync } from "node:fs";
import http from "node:http";
import path from "node:path";
import os from "node:os";
import { launch, processorTimes_s } from "./browser.mjs";
import { openLive, press, standUp, state } from "./live_page.mjs";
import { LiveRobot, eventually, pause } from "./live_robot.mjs";

const [folder, bin, stops = "200"] = process.argv.slice(2);
const busy_loops = 2;
const rounds = 3; // of the chain, with and without a page
const round_ms = 8_000;
const settle_ms = 5_000;
const pictures_ms = 10_000; // of walking
const clock_ticks_s = 100;

const share = (sorted, part) => sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))];
const row = (name, value, unit) => console.log(`${name.padEnd(58)} ${value.toFixed(3)} ${unit}`);

/** Times from the key's event in the page to the page hearing that no drive has power: the way back is in it. */
async function estopTimes(browser) {
  const robot = await LiveRobot.up(bin, "single_leg", ["leg"]);
  const load = Array.from({ length: busy_loops }, () => spawn(process.execPath, ["-e", "for (;;);"]));
  try {
    const script = () => {
      addEventListener("keydown", (event) => { if (event.key === " ") window.pressed_ms = event.timeStamp; }, { capture: true });
    };
    const page = await openLive(browser, await robot.console(), { script });
    await page.evaluate(() => {
      window.times_ms = [];
      window.sprung.link.addEventListener("estop", ({ detail }) => {
        if (detail.state === "confirmed" && window.pressed_ms) window.times_ms.push(performance.now() - window.pressed_ms);
        if (detail.state === "confirmed") window.pressed_ms = 0;
      });
    });
    await standUp(page);
    for (let i = 0; i < Number(stops); ++i) {
      await eventually("the drives have power", async () => (await state(page)).actuators.every(({ power }) => power === "operation enabled"));
      await page.keyboard.press("Space");
      await eventually("it is confirmed", () => page.evaluate((count) => window.times_ms.length > count, i));
      await eventually("it is cleared", async () => {
        await press(page, "clear"); // refused as long as a drive has not come to rest
        await pause(150);
        return ["none", "starting"].includes((await state(page)).safety.cause);
      });
      await eventually("it is armed", async () => (await state(page)).safety.state === "operational");
      await eventually("it rises", async () => {
        if ((await state(page)).motion.state === "idle") await press(page, "stand");
        await pause(150);
        return ["rising", "standing"].includes((await state(page)).motion.state);
      });
    }
    return (await page.evaluate(() => window.times_ms)).sort((a, b) => a - b);
  } finally {
    for (const loop of load) loop.kill("SIGKILL");
    await robot.down();
  }
}

/** A page without a browser: hears everything, says that it is there. @return ends it. */
function listen(url) {
  return new Promise((resolve, reject) => {
    const asked = http.get(`${url}live`, { headers: { Connection: "Upgrade", Upgrade: "websocket", "Sec-WebSocket-Version": "13",
      "Sec-WebSocket-Key": randomBytes(16).toString("base64"), "Sec-WebSocket-Protocol": "sprung.v1", Origin: new URL(url).origin } });
    asked.on("error", reject);
    asked.on("upgrade", (answer, socket) => {
      const text = Buffer.from('{"type":"alive"}');
      let heard = 0;
      socket.on("data", (part) => { heard += part.length; });
      // A mask of zeros leaves the text as it is.
      const alive = setInterval(() => socket.write(Buffer.concat([Buffer.from([0x81, 0x80 | text.length, 0, 0, 0, 0]), text])), 300);
      resolve({ end: () => { clearInterval(alive); socket.destroy(); return heard; } });
    });
  });
}

function processor_s(pid) {
  const fields = readFileSync(`/proc/${pid}/stat`, "utf8").split(") ")[1].split(" ");
  return (Number(fields[11]) + Number(fields[12])) / clock_ticks_s;
}

/** Age of DRIVE_STATE when the estimator takes it, and of JOINT_STATE when the leg controller does, together, us. */
async function chain_us(robot) {
  const ages_us = [];
  for (const end = Date.now() + round_ms; Date.now() < end; await pause(100)) {
    const { processes } = robot.status();
    const age_us = (name) => 1000 * processes.find((process) => process.name === name).input_age_ms;
    ages_us.push(age_us("sprung-torque-estimator") + age_us("sprung-leg-controller"));
  }
  return share(ages_us.sort((a, b) => a - b), 0.5);
}

async function cost() {
  const robot = await LiveRobot.up(bin, "pegasus", ["fl", "fr", "hl", "hr"]);
  try {
    const url = await robot.console();
    const without = [], with_page = [];
    let idle_s = 0, used_s = 0, heard = 0, without_ms = 0, with_ms = 0;
    for (let i = 0; i < rounds; ++i) {
      let before = processor_s(robot.server.pid), begin_ms = Date.now();
      without.push(await chain_us(robot));
      idle_s += processor_s(robot.server.pid) - before;
      without_ms += Date.now() - begin_ms;
      const page = await listen(url);
      before = processor_s(robot.server.pid);
      begin_ms = Date.now();
      with_page.push(await chain_us(robot));
      used_s += processor_s(robot.server.pid) - before;
      with_ms += Date.now() - begin_ms;
      heard += page.end();
    }
    const median = (values) => share([...values].sort((a, b) => a - b), 0.5);
    return { idle: 1000 * idle_s / without_ms, used: 1000 * used_s / with_ms, bytes_s: 1000 * heard / with_ms, ratio: median(with_page) / median(without),
             without: median(without), with_page: median(with_page) };
  } finally {
    await robot.down();
  }
}

/** Pictures a second of pegasus, walking, live at 500 Hz, at 1280 x 720 by software; and what one of them costs. */
async function pictures() {
  const robot = await LiveRobot.up(bin, "pegasus", ["fl", "fr", "hl", "hr"]);
  const drawing = await launch(folder);
  try {
    const page = await openLive(drawing, await robot.console());
    await standUp(page);
    await press(page, "walk", { forward_m_s: 0.1 });
    await pause(settle_ms); // as many pixels as there is time for
    const seen = () => page.evaluate(() => ({ ms: performance.now(), pictures: window.sprung.view.pictures, pixels: window.sprung.view.view.ratio }));
    const before = await seen(), used = await processorTimes_s(drawing);
    await pause(pictures_ms);
    const after = await seen(), now = await processorTimes_s(drawing);
    const count = after.pictures - before.pictures;
    const each_ms = (type) => (1000 * (now[type] - used[type])) / count;
    return { rate: (1000 * count) / (after.ms - before.ms), gpu_ms: each_ms("GPU"), page_ms: each_ms("renderer"), ratio: after.pixels,
             load: os.loadavg()[0], walks: (await state(page)).motion.state };
  } finally {
    await drawing.close();
    await robot.down();
  }
}

const only = process.env.SPRUNG_MEASURE ?? "pictures estop cost"; // which of them
if (only.includes("pictures")) {
  const { rate, gpu_ms, page_ms, ratio, load, walks } = await pictures();
  row("console.pictures a second, pegasus at 500 Hz, by software", rate, "/s");
  row("console.picture, processor of Chromium's drawing process", gpu_ms, "ms");
  row("console.picture, processor of the page", page_ms, "ms");
  row("console.picture, pixels for each of the page's, along an axis", ratio, "");
  row(`load of the machine (pegasus: ${walks})`, load, "");
}
if (!only.includes("estop")) process.exit();

const browser = await launch(folder, ["--disable-3d-apis"]); // else it draws with all of the processor
const times = await estopTimes(browser);
await browser.close();
row(`console.estop, space bar to no power, ${times.length} times, p50`, share(times, 0.5), "ms");
row("console.estop, p99", share(times, 0.99), "ms");
row("console.estop, longest", times.at(-1), "ms");
const { idle, used, bytes_s, ratio, without, with_page } = await cost();
row("console.processor, no page open, pegasus at 500 Hz", 100 * idle, "% of a core");
row("console.processor, one page open", 100 * used, "% of a core");
row("console.bytes to one page", bytes_s / 1000, "kB/s");
row("console.chain, ages of inputs in the chain, no page", without, "us");
row("console.chain, one page", with_page, "us");
row("console.chain, ratio", ratio, "");
const good = used <= 0.03 && ratio <= 1.02 && share(times, 0.5) <= 50 && share(times, 0.99) <= 100;
if (!good) console.log("measure: beyond a bound: 3 % of a core, a ratio of 1.02, 50 ms, 100 ms");
process.exitCode = good ? 0 : 1;
