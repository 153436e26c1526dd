// What an operator does with the live page, and what goes wrong with pages.
// usage: console.mjs FOLDER BIN [WORDS]   WORDS: checks with these in their names alone, and what makes it stand; FOLDER has node_modules and keeps pictures; exit status 1: something is not as it should be
import assert from "node:assert/strict";
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import http from "node:http";
import { createRequire } from "node:module";
import os from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { batteryOn } from "./battery_node.mjs";
import { launch } from "./browser.mjs";
import { closeLive, motionIs, news, openLive, press, standUp, state } from "./live_page.mjs";
import { LiveRobot, eventually, pause } from "./live_robot.mjs";

const [folder, bin, words = ""] = process.argv.slice(2);
const axe = createRequire(path.resolve(folder) + "/").resolve("axe-core/axe.min.js");
const checks = [];
const check = (name, work) => checks.push({ name, work });
const picture = (page, name) => page.screenshot({ path: path.join(folder, name) });

async function accessible(page, what) {
  // Scripts from elsewhere are refused by the page's own rule; this one comes by the debugger.
  await page.evaluate(readFileSync(axe, "utf8"));
  const { violations } = await page.evaluate(() => window.axe.run());
  assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes[0].html}`), [], `axe-core, ${what}`);
}

/** A gamepad that the test holds in its hand. */
const scriptedGamepad = () => {
  window.pad = { index: 0, id: "scripted", connected: true, axes: [0, -1, 0, 0], buttons: Array.from({ length: 16 }, () => ({ pressed: false })) };
  window.padThere = true;
  navigator.getGamepads = () => (window.padThere ? [window.pad] : []);
};
const pad = (page, axes, deadMan) => page.evaluate(([a, held]) => { window.pad.axes = a; window.pad.buttons[5].pressed = held; }, [axes, deadMan]);

function request(url, headers) {
  return new Promise((resolve) => http.get(url, { headers, agent: false }, (answer) => {
    let text = "";
    answer.on("data", (part) => { text += part; });
    answer.on("end", () => resolve({ status: answer.statusCode, text, headers: answer.headers }));
  }));
}
/** What becomes of a request to become a WebSocket. */
function upgrade(url, headers) {
  return new Promise((resolve) => {
    const asked = http.get(url + "live", { agent: false, headers: { Connection: "Upgrade", Upgrade: "websocket", "Sec-WebSocket-Version": "13",
      "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==", "Sec-WebSocket-Protocol": "sprung.v1", ...headers } });
    asked.on("upgrade", (answer, socket) => { socket.destroy(); resolve(101); });
    asked.on("response", (answer) => { answer.resume(); resolve(answer.statusCode); });
    asked.on("error", () => resolve(0));
  });
}

check("a refused command shows its reason; stand by button", async ({ browser, url }) => {
  const page = await openLive(browser, url);
  await press(page, "walk");
  await news(page, "walk: refused: not standing");
  await press(page, "walk", { forward_m_s: 9 });
  await news(page, "forward must be");
  await standUp(page);
  await closeLive(page);
});

check("axe-core has nothing to say, light and dark, at 1280 x 720 and on a tablet; nothing is wider than the page", async ({ drawing, url }) => {
  for (const [width, height, theme] of [[1280, 720, "light"], [1280, 720, "dark"], [820, 1180, "light"]]) {
    const page = await openLive(drawing, url, { width, height, theme });
    await accessible(page, `${theme} at ${width} x ${height}`);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wide <= 0, `${wide} px too wide at ${width}`);
    assert.ok(await page.locator("#estop").isVisible());
    await page.evaluate(() => scrollTo(0, 10_000));
    const box = await page.locator("#estop").boundingBox();
    assert.ok(box.y >= 0 && box.y + box.height <= height, "the emergency stop scrolls away");
    await picture(page, `console-${theme}-${width}.png`);
    await closeLive(page);
  }
});

/** What the page shows of the robot's state with other values in it; the robot's next state undoes them. */
const shown = (page, values) => page.evaluate((others) => {
  const { link, state } = window.sprung;
  link.dispatchEvent(new CustomEvent("state", { detail: { ...state, ...others } }));
  const battery = document.getElementById("battery");
  const table = document.querySelector("#drives table");
  const texts = (row) => [...row.cells].map((cell) => cell.textContent);
  return { battery: battery.hidden ? null : battery.textContent, low: battery.classList.contains("low"),
           heading: texts(table.tHead.rows[0]), first: texts(table.tBodies[0].rows[0]) };
}, values);

check("battery and temperatures of a robot that has none are hidden; a low battery says what to do", async ({ browser, url }) => {
  const page = await openLive(browser, url);
  const none = await shown(page, {});
  assert.deepEqual([none.battery, none.heading], [null, ["drive", "power", "A", "V"]], "pegasus as it is shipped has none");
  const battery = { voltage_V: 47.46, charge_share: 0.12, temperature_degC: null, low: true };
  const some = await shown(page, { auxiliary: { temperatures_degC: {}, battery } });
  assert.equal(some.battery, "Battery 12 %, 47.5 V, – °C. LOW: let the robot sit, then charge");
  assert.ok(some.low);
  await closeLive(page);
});

check("walk by keyboard: from the key's press to its release; the server sends at least 20 frames a second", async ({ browser, url }) => {
  const page = await openLive(browser, url);
  await page.locator("#source").selectOption("keyboard");
  await eventually("keys are seen at rest", async () => (await state(page)).session.sticks.state === "ready");
  await page.keyboard.down("w");
  await motionIs(page, "walking");
  const before = await page.evaluate(() => [performance.now(), window.sprung.view.frames]);
  await pause(2500);
  const after = await page.evaluate(() => [performance.now(), window.sprung.view.frames]);
  assert.equal((await state(page)).motion.state, "walking", "it goes on while the key is held");
  await page.keyboard.up("w");
  await motionIs(page, "standing");
  const rate_Hz = 1000 * (after[1] - before[1]) / (after[0] - before[0]);
  assert.ok(rate_Hz >= 20, `${rate_Hz} frames a second`);
  await closeLive(page);
});

check("the robot is drawn, and its picture changes as it walks", async ({ browser, drawing, url }) => {
  const page = await openLive(drawing, url);
  await pause(1000);
  await picture(page, "console.png");
  const driver = await openLive(browser, url);
  const view = async () => (await page.locator("#canvas").screenshot()).toString("base64");
  const standing = await view();
  await driver.locator("#take-over").click();
  await press(driver, "walk", { forward_m_s: 0.1, turning_rad_s: 0.3 });
  await motionIs(driver, "walking");
  await pause(3000);
  assert.notEqual(await view(), standing);
  const fps = await page.evaluate(() => window.sprung.view.fps);
  console.log(`console: ${fps} pictures a second while pegasus walks at 500 Hz, drawn by software`);
  await picture(page, "console-walking.png");
  await press(driver, "stop");
  await motionIs(driver, "standing");
  await closeLive(page);
  await closeLive(driver);
});

check("a gamepad is locked until its sticks were at rest, and again when it is gone", async ({ browser, url }) => {
  const page = await openLive(browser, url, { script: scriptedGamepad });
  await eventually("the gamepad is listed", () => page.evaluate(() => document.getElementById("source").options.length === 3));
  await pad(page, [0, -1, 0, 0], true);
  await page.locator("#source").selectOption("pad0");
  await pause(500);
  assert.equal((await state(page)).session.sticks.state, "locked", "it was pushed when it was chosen");
  assert.equal((await state(page)).motion.state, "standing");
  await pad(page, [0, 0, 0, 0], false);
  await eventually("it was seen at rest", async () => (await state(page)).session.sticks.state === "ready");
  await pad(page, [0, -0.8, 0.4, 0], true);
  await motionIs(page, "walking");
  await page.evaluate(() => { window.padThere = false; }); // pulled out, dead-man held
  await motionIs(page, "standing", 5000);
  await page.evaluate(() => { window.padThere = true; });
  await pause(500);
  assert.equal((await state(page)).session.sticks.state, "locked");
  assert.equal((await state(page)).motion.state, "standing");
  await closeLive(page);
});

check("parameters: a page shows them, sets one, and sees what a terminal set", async ({ browser, url, robot }) => {
  const page = await openLive(browser, url);
  await page.locator("summary", { hasText: "Parameters" }).click();
  const field = page.locator('input[name="compliance.stiffness.z"]');
  await eventually("robot.yaml's value", async () => (await field.inputValue()) === "3000");
  await field.fill("3500");
  await field.press("Enter");
  await news(page, "set parameter: accepted");
  assert.equal(robot.do("param", "get", "compliance.stiffness.z").trim(), "3500 N/m");
  await page.locator(".parameter.changed").first().waitFor();
  await field.fill("99999");
  await field.press("Enter");
  await news(page, "set parameter: refused: beyond its range");
  robot.do("param", "set", "compliance.stiffness.z", "file");
  await eventually("what the terminal set", async () => (await field.inputValue()) === "3000");
  await picture(page, "console-parameters.png");
  await closeLive(page);
});

check("two pages: one drives, the other watches, and taking over is explicit", async ({ browser, url }) => {
  const first = await openLive(browser, url);
  const second = await openLive(browser, url);
  assert.equal(await second.locator("#role").textContent(), "another page drives");
  assert.ok(await second.locator("button[data-command=stand]").isDisabled());
  await second.evaluate(() => window.sprung.link.request("sit", {}));
  await news(second, "this page watches and does not drive");
  assert.ok(await second.locator("#estop").isEnabled());
  await second.locator("#take-over").click();
  await eventually("the first page knows", async () => (await first.locator("#role").textContent()) === "another page drives");
  assert.equal(await second.locator("#role").textContent(), "you drive");
  await closeLive(first);
  await closeLive(second);
});

check("a page that is closed while the robot walks: it stands within 3 s", async ({ browser, url }) => {
  const page = await openLive(browser, url);
  const other = await openLive(browser, url, { drawsNothing: true });
  await press(page, "walk", { forward_m_s: 0.1 });
  await motionIs(other, "walking");
  await pause(1500);
  assert.equal((await state(other)).motion.state, "walking", "it goes on while the page is there");
  await closeLive(page);
  await motionIs(other, "standing", 3000);
  await eventually("nobody drives", async () => (await state(other)).session.driver === -1);
  await closeLive(other);
});

check("a page that sleeps: the robot stands, nobody drives, and it says so when it wakes", async ({ browser, url }) => {
  const page = await openLive(browser, url);
  const other = await openLive(browser, url, { drawsNothing: true });
  await press(page, "walk", { forward_m_s: 0.1 });
  await motionIs(other, "walking");
  await page.evaluate(() => { const end = Date.now() + 7000; while (Date.now() < end); }); // its thread stands still
  assert.notEqual((await state(other)).motion.state, "walking");
  await eventually("the page knows that it does not drive", async () => (await page.locator("#role").textContent()) === "nobody drives");
  await closeLive(page);
  await closeLive(other);
});

check("a tab that is hidden: what it held ends in a stand within 3 s, and it still drives", async ({ browser, url }) => {
  const page = await openLive(browser, url);
  const other = await openLive(browser, url, { drawsNothing: true });
  await press(page, "walk", { forward_m_s: 0.1 });
  await motionIs(other, "walking");
  await pause(1500);
  assert.equal((await state(other)).motion.state, "walking", "it goes on while the tab is in front");
  await page.evaluate(() => { // Chromium without a screen hides no tab
    Object.defineProperty(document, "visibilityState", { get: () => "hidden" });
    document.dispatchEvent(new Event("visibilitychange"));
  });
  await motionIs(other, "standing", 3000);
  assert.equal(await page.locator("#role").textContent(), "you drive");
  await closeLive(page);
  await closeLive(other);
});

check("bad messages: an error, then the door; an oversized one ends the connection; the robot stands on", async ({ browser, url }) => {
  const page = await openLive(browser, url);
  const outcome = await page.evaluate(async () => {
    const live = new URL("live", location.href).href.replace(/^http/, "ws");
    const send = (texts) => new Promise((resolve) => {
      const socket = new WebSocket(live, "sprung.v1"), errors = [];
      let greeted = false; // what a server still had to say when it closes takes its reason with it
      socket.onmessage = ({ data }) => {
        if (!greeted && data.includes?.('"parameters","values"')) {
          greeted = true;
          for (const text of texts) socket.send(text);
        }
        if (typeof data === "string" && data.includes('"error"')) errors.push(data);
      };
      socket.onclose = ({ code }) => resolve({ code, errors: errors.length });
    });
    return { bad: await send(Array.from({ length: 20 }, () => "{")), big: await send(["x".repeat(5000)]) };
  });
  assert.equal(outcome.bad.code, 1008);
  assert.ok(outcome.bad.errors >= 19, `${outcome.bad.errors} errors`);
  assert.equal(outcome.big.code, 1009);
  assert.equal((await state(page)).motion.state, "standing");
  await closeLive(page);
});

check("foreign Host, foreign Origin and a missing token are refused, for pages and for WebSockets", async ({ url }) => {
  const { host, origin } = new URL(url);
  assert.equal((await request(url, {})).status, 200);
  const rebound = await request(url, { Host: "evil.com" });
  assert.equal(rebound.status, 403);
  assert.match(rebound.text, /Host header/);
  assert.equal((await request(url, { Origin: "http://evil.com" })).status, 403);
  assert.equal((await request(`${origin}/`, {})).status, 403);
  assert.equal((await request(`${url}nothing.js`, {})).status, 404);
  assert.equal(await upgrade(url, { Origin: origin }), 101);
  for (const headers of [{ Host: "evil.com" }, { Origin: "http://evil.com" }, { Host: "evil.com", Origin: "http://evil.com" }])
    assert.notEqual(await upgrade(url, headers), 101, JSON.stringify(headers));
  assert.notEqual(await upgrade(`http://${host}/`, { Origin: origin }), 101);
  assert.match((await request(url, {})).headers["content-security-policy"], /frame-ancestors 'none'/);
});

check("a browser without WebGL shows everything else, and says so", async ({ browser, url }) => {
  const page = await openLive(browser, url);
  await page.locator("#view", { hasText: "no WebGL" }).waitFor({ timeout: 60_000 });
  await eventually("it is live", async () => (await state(page))?.motion.state === "standing");
  await closeLive(page);
});

check("drive-by gamepad: recorded events are locked at first, walk while the dead-man is held, and end in a stand", async ({ browser, url, robot }) => {
  const EV_KEY = 1, EV_ABS = 3, ABS_Y = 1, BTN_TR = 0x137;
  const file = path.join(robot.folder, "events");
  const events = [ // s, type, code, value
    [0, EV_KEY, BTN_TR, 1], [0, EV_ABS, ABS_Y, -32768], // held and pushed when it begins
    [1, EV_KEY, BTN_TR, 0], [1, EV_ABS, ABS_Y, 0],
    [1.5, EV_KEY, BTN_TR, 1], [1.5, EV_ABS, ABS_Y, -20000], [4.5, EV_KEY, BTN_TR, 0], [7, EV_ABS, ABS_Y, 0]];
  writeFileSync(file, Buffer.concat(events.map(([time_s, type, code, value]) => {
    const event = Buffer.alloc(24); // struct input_event of a 64-bit Linux
    event.writeBigInt64LE(BigInt(1_700_000_000 + Math.floor(time_s)), 0);
    event.writeBigInt64LE(BigInt(Math.round(1e6 * (time_s % 1))), 8);
    event.writeUInt16LE(type, 16);
    event.writeUInt16LE(code, 18);
    event.writeInt32LE(value, 20);
    return event;
  })));
  const page = await openLive(browser, url);
  const driving = robot.start("drive-by.txt", ["drive-by", "gamepad", "--device", file]);
  await robot.says("drive-by.txt", "driving");
  await motionIs(page, "walking");
  assert.ok(robot.said("drive-by.txt").indexOf("locked") < robot.said("drive-by.txt").indexOf("ready"), robot.said("drive-by.txt"));
  await motionIs(page, "standing");
  await robot.says("drive-by.txt", "the gamepad is gone; the robot stands");
  await eventually("it has ended", () => driving.status !== undefined);
  assert.equal(driving.status, 1);
  await closeLive(page);
});

check("a viewer that speaks Foxglove's protocol gets channels, and the robot as it stands; it commands nothing", async ({ browser, url }) => {
  const page = await openLive(browser, url);
  const wanted = ["JOINT_STATE", "/tf", "/robot", "/forces", "/joint_states", "/wrenches", "/imu"];
  const seen = await page.evaluate((topics) => new Promise((resolve, reject) => {
    const socket = new WebSocket(new URL("live", location.href).href.replace(/^http/, "ws"), ["foxglove.sdk.v1", "foxglove.websocket.v1"]);
    const out = { protocol: "", channels: {}, messages: {}, counts: {}, opcodes: [], status: "" };
    const names = [];
    socket.binaryType = "arraybuffer";
    setTimeout(() => reject(new Error(`only ${JSON.stringify(Object.keys(out.messages))}`)), 20_000);
    socket.onmessage = ({ data }) => {
      if (typeof data !== "string") {
        const view = new DataView(data), topic = names[view.getUint32(1, true)];
        out.opcodes.push(view.getUint8(0));
        out.messages[topic] = new TextDecoder("latin1").decode(data.slice(13));
        out.counts[topic] = (out.counts[topic] ?? 0) + 1;
        if (topics.every((each) => each in out.messages) && out.counts["/tf"] > 20 && out.status) resolve(out);
        return;
      }
      const message = JSON.parse(data);
      if (message.op === "status") out.status = message.message;
      if (message.op !== "advertise") return;
      out.protocol = socket.protocol;
      for (const channel of message.channels) {
        names[channel.id] = channel.topic;
        out.channels[channel.topic] = channel;
      }
      socket.send(JSON.stringify({ op: "subscribe", subscriptions: message.channels.map(({ id }) => ({ id, channelId: id })) }));
      socket.send(JSON.stringify({ op: "setParameters", parameters: [] }));
    };
  }), wanted);
  assert.equal(seen.protocol, "foxglove.sdk.v1");
  assert.ok(seen.opcodes.every((opcode) => opcode === 1));
  assert.match(seen.status, /only shows/);
  const types = { "/tf": "foxglove.FrameTransforms", "/robot": "foxglove.SceneUpdate", "/forces": "foxglove.SceneUpdate",
    "/joint_states": "foxglove.JointStates", "/wrenches": "sprung.Wrenches", "/imu": "sprung.Imu", JOINT_STATE: "sprung_msgs.joint_state_t" };
  for (const [topic, type] of Object.entries(types)) {
    const { schemaName, schemaEncoding, encoding, schema } = seen.channels[topic];
    assert.deepEqual([schemaName, schemaEncoding, encoding], [type, "protobuf", "protobuf"], topic);
    assert.ok(atob(schema).includes(type.split(".")[1]), `${topic}'s schema`);
  }
  for (const [topic, words] of [["/tf", ["world", "base", "fl_shank"]], ["/robot", ["world", "fl_shank"]], ["/forces", ["force fl", "world"]],
                                ["/joint_states", ["fl_knee"]], ["/wrenches", ["fl", "world"]], ["/imu", ["base"]]])
    for (const word of words) assert.ok(seen.messages[topic].includes(word), `${topic} has ${word}`);
  assert.ok(seen.messages.JOINT_STATE.length > 1000);
  assert.equal(seen.counts["/robot"], 1, "what it looks like comes once");
  await closeLive(page);
});

check("the space bar stops whatever has the focus; the page says why and what to do, and clear and stand bring it back", async ({ browser, url, robot }) => {
  const page = await openLive(browser, url);
  await press(page, "walk", { forward_m_s: 0.1 });
  await motionIs(page, "walking");
  await page.locator("[name=forward_m_s]").focus();
  await page.keyboard.press("Space");
  await page.locator("#estop-state", { hasText: "no drive has power" }).waitFor();
  await eventually("safety says so", async () => (await page.locator("#safety-cause").textContent()).includes("emergency stop"));
  assert.match(await page.locator("#safety-next").textContent(), /clear, then stand/);
  await eventually("sprung status says so too", async () => robot.status().safety?.cause === "emergency stop");
  for (const drive of (await state(page)).actuators) assert.notEqual(drive.power, "operation enabled");
  await picture(page, "console-estop.png");
  await pause(1000); // legs have come to rest
  await press(page, "clear");
  await news(page, "clear: done");
  await standUp(page);
  await closeLive(page);
});

check("the emergency stop is in reach while a question waits for its answer, by pointer and by space bar, also on a tablet", async ({ browser, url }) => {
  for (const [width, height, stop] of [[1280, 720, (page) => page.locator("#estop").click()], [820, 1180, (page) => page.locator("#estop").click()],
                                       [1280, 720, (page) => page.keyboard.press("Space")]]) {
    const page = await openLive(browser, url, { width, height });
    const dialog = page.locator("#confirm");
    await press(page, "home");
    await dialog.waitFor();
    assert.equal(await page.evaluate(() => document.activeElement.value), "no", "Enter says no");
    await page.keyboard.press("Escape");
    await dialog.waitFor({ state: "hidden" });
    // A dialog says that it is closed a moment after it is hidden.
    await eventually("the focus comes back", () => page.evaluate(() => document.activeElement.dataset.command === "home"));
    await press(page, "home");
    await dialog.waitFor();
    await accessible(page, `with a question, at ${width}`);
    await stop(page); // Playwright refuses to click what something else covers
    await page.locator("#estop-state", { hasText: "no drive has power" }).waitFor();
    await dialog.waitFor({ state: "hidden" });
    assert.ok(!(await page.locator("#news").textContent()).includes("home"), "nothing was said yes to");
    await press(page, "clear");
    await news(page, "clear: done");
    await closeLive(page);
  }
});

check("a robot that goes down says goodbye", async ({ browser, url, robot }) => {
  const page = await openLive(browser, url);
  robot.process.kill("SIGINT");
  await page.locator("#banner", { hasText: "the robot is down" }).waitFor();
  await eventually("the command has ended", () => robot.server.status === 0);
  await closeLive(page, /WebSocket connection to .* failed/);
});

/** A folder with the leg in it, whose drives tell a temperature (their rated current, for want of another object), and which has a battery. */
function legWithBattery(folder) {
  const copy = path.join(folder, "leg_with_battery");
  cpSync(path.join(path.dirname(fileURLToPath(import.meta.url)), "../../robots/single_leg"), copy, { recursive: true });
  const file = path.join(copy, "robot.yaml");
  const temperature = "    temperature: {object: 0x6075, sub: 0, type: u32, scale: 0.006 degC, max: 85 degC}\n";
  const text = readFileSync(file, "utf8").replaceAll(/^ {2}- name: \w+_motor\n/gm, (line) => line + temperature);
  writeFileSync(file, `${text}\nbattery: {bus: leg, node: 20, min_charge: 0.15}\n`);
  return copy;
}

/** Objects of CiA 418: voltage in V / 1024, charge in %, temperature in degC / 8. */
const battery = { 0x6060: [48_640, 4], 0x6081: [12, 1], 0x6010: [204, 2] };

async function leg(browser, drawing) {
  const copies = mkdtempSync(path.join(os.tmpdir(), "sprung-leg-"));
  const folder = legWithBattery(copies);
  const robot = await LiveRobot.up(bin, folder, ["leg"]);
  const unplug = await batteryOn(robot.ports.leg, battery);
  try {
    const url = await robot.console();
    await run("single_leg jumps by button", () => jumps(browser, url));
    await run("temperatures and battery that the bridge reads of the bus are shown", () => auxiliaries(browser, url, unplug));
    robot.server.kill("SIGTERM");
    rmSync(path.join(folder, "model.xml"));
    const bare = await robot.console();
    await run("a robot whose model is missing is not drawn, and the page says so", () => notDrawn(drawing, bare));
  } finally {
    unplug();
    await robot.down();
    rmSync(copies, { recursive: true, force: true });
  }
}

async function jumps(browser, url) {
  const page = await openLive(browser, url);
  await standUp(page);
  await press(page, "jump", { height_mm: 150, count: 2 });
  await news(page, "jump: done");
  await closeLive(page);
}

async function auxiliaries(browser, url, unplug) {
  const page = await openLive(browser, url);
  const now = () => shown(page, {});
  await eventually("the battery is shown", async () => (await now()).battery?.startsWith("Battery 12 %, 47.5 V, 25.5 °C. LOW"));
  const { heading, first, low } = await now();
  assert.deepEqual([heading.at(-1), first.at(-1), low], ["drive °C", "42.0", true]);
  unplug();
  await eventually("a battery that is silent has dashes", async () => (await now()).battery === "Battery – %, – V, – °C");
  await closeLive(page);
}

async function notDrawn(drawing, url) {
  const page = await openLive(drawing, url);
  await page.locator("#view", { hasText: "The robot cannot be drawn:" }).waitFor();
  await eventually("all else works", async () => (await state(page)).joints.length === 2 && (await page.locator("#joints .row").count()) === 2);
  await closeLive(page);
}

// Drawing by software takes all of a processor, so most of it is done in a browser that draws nothing: a page
// that cannot keep up lets the robot stand.
const drawing = await launch(folder);
const browser = await launch(folder, ["--disable-3d-apis"]);
const robot = await LiveRobot.up(bin, "pegasus", ["fl", "fr", "hl", "hr"]);
let failed = 0;
let first = true;
async function run(name, work) {
  if (!first && !name.includes(words)) return;
  first = false;
  try {
    await work();
    console.log(`ok    ${name}`);
  } catch (error) {
    ++failed;
    console.log(`FAIL  ${name}\n${error.stack}`);
    for (const context of [...browser.contexts(), ...drawing.contexts()]) for (const page of context.pages()) await page.close();
  }
}
try {
  const url = await robot.console();
  for (const { name, work } of checks) await run(name, () => work({ browser, drawing, url, robot }));
} finally {
  await robot.down();
}
await leg(browser, drawing);
await browser.close();
await drawing.close();
process.exitCode = failed === 0 ? 0 : 1;
