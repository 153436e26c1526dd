// A simulated leg that stands, live in Foxglove Studio by its WebSocket protocol, with the layout that is shipped.
// usage: live.mjs FOLDER BIN LAYOUT.json PICTURE.png   FOLDER has node_modules and the layout; exit status 1: nothing is drawn
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { LiveRobot } from "../station/live_robot.mjs";
import { robotStands, software, window } from "./robot_pixels.mjs";
import { serve } from "./serve.mjs";

const [folder, bin, layout, picture] = process.argv.slice(2);
const { chromium } = createRequire(path.resolve(folder) + "/")("playwright-core");
const here = path.dirname(fileURLToPath(import.meta.url));
const timeout_ms = 300_000;

const server = await serve([here, path.join(folder, "node_modules"), folder]);
const robot = await LiveRobot.up(bin, "single_leg", ["leg"]);
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox", ...software] });
try {
  const stood = robot.sprung("stand");
  if (stood.status !== 0) throw new Error(stood.text);
  const url = await robot.console(["--allow-origin", server.address]);
  const page = await browser.newPage({ viewport: window });
  const query = new URLSearchParams([["layoutId", "sprung"], ["live", url.replace(/^http/, "ws") + "live"], ["layout", layout]]);
  await page.goto(`${server.address}/page.html?${query}`, { waitUntil: "commit", timeout: timeout_ms });
  const found = await robotStands(page, picture);
  console.log(`foxglove: 3-D panel, live: ${found.force} pixels of forces, ${found.robot} of the robot's housing`);
  if (!found.there) process.exitCode = 1;
} finally {
  await browser.close();
  await robot.down();
  server.close();
}
