// The live page of a robot on another computer: the gateway between them, then no gateway.
// usage: console_elsewhere.mjs FOLDER BIN   FOLDER has node_modules and keeps a picture; exit status 1: something is not as it should be
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import path from "node:path";
import { launch } from "./browser.mjs";
import { closeLive, openLive, press, standUp, state } from "./live_page.mjs";
import { LiveRobot, eventually } from "./live_robot.mjs";

const [folder, bin] = process.argv.slice(2);
const browser = await launch(folder, ["--disable-3d-apis"]);
const robot = await LiveRobot.up(bin, "pegasus", ["fl", "fr", "hl", "hr"]);
const programs = { gateway: null, console: null };

/** @return the address in what it says. */
async function says(program, words, env, pattern) {
  const child = spawn(path.join(bin, program), words, { env, stdio: ["ignore", "pipe", "pipe"] });
  let text = "";
  for (const stream of [child.stdout, child.stderr]) stream.on("data", (part) => { text += part; });
  const found = await eventually(`${program} says ${pattern}`, () => {
    assert.equal(child.exitCode, null, text);
    return text.match(pattern);
  });
  return { child, found };
}

try {
  const key = path.join(robot.folder, "alice.key");
  robot.do("home");
  robot.do("operator", "key", "new", "alice", "--role", "maintain", "--out", key);
  const gateway = await says("sprung-operator-gateway", ["--listen", "127.0.0.1:0"], robot.env, /UDP port (\d+)/);
  programs.gateway = gateway.child;
  // Nothing of the robot's own folders is known to the other computer.
  const { SPRUNG_RUN_DIR, SPRUNG_STATE_DIR, ...elsewhere } = robot.env;
  const host = `127.0.0.1:${gateway.found[1]}`;
  const server = await says("sprung", ["--via", host, "--key", key, "console", "--port", "0"], elsewhere, /http:\S+/);
  programs.console = server.child;
  const page = await openLive(browser, server.found[0]);
  await standUp(page);
  await page.locator("#via", { hasText: /as alice \(maintain\); alice drives/ }).waitFor({ timeout: 10_000 });
  await press(page, "walk", { forward_m_s: 0.2 });
  await eventually("it walks", async () => (await state(page)).motion.state === "walking");
  await page.screenshot({ path: path.join(folder, "console-elsewhere.png") });
  gateway.child.kill("SIGKILL");
  await page.locator("#banner", { hasText: /LOST for .* stops and stands/ }).waitFor({ timeout: 10_000 });
  assert.equal(await page.locator("#link").textContent(), "link lost");
  await page.screenshot({ path: path.join(folder, "console-elsewhere-lost.png") });
  await closeLive(page);
  console.log("ok    the page of a robot on another computer commands it, and says that the link is lost");
} catch (error) {
  console.log(`FAIL  the page of a robot on another computer\n${error.stack}`);
  for (const context of browser.contexts()) for (const page of context.pages()) await page.screenshot({ path: path.join(folder, "console-elsewhere-failed.png") });
  process.exitCode = 1;
} finally {
  for (const child of Object.values(programs)) child?.kill("SIGKILL");
  await robot.down();
  await browser.close();
}
