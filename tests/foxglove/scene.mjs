// Opens an MCAP file in Foxglove Studio with the layout that is shipped, goes to its middle, and looks whether the robot stands there.
// usage: scene.mjs FOLDER FILE.mcap LAYOUT.json PICTURE.png   FOLDER has the files and node_modules; exit status 1: nothing is drawn
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { robotStands, software, window } from "./robot_pixels.mjs";
import { serve } from "./serve.mjs";

const [folder, file, layout, picture] = process.argv.slice(2);
const { chromium } = createRequire(path.resolve(folder) + "/")("playwright-core");
const here = path.dirname(fileURLToPath(import.meta.url));
const timeout_ms = 300_000;
const server = await serve([here, path.join(folder, "node_modules"), folder]);
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox", ...software] });
try {
  const page = await browser.newPage({ viewport: window });
  const query = new URLSearchParams([["layoutId", "sprung"], ["file", file], ["layout", layout]]);
  await page.goto(`${server.address}/page.html?${query}`, { waitUntil: "commit", timeout: timeout_ms });
  const found = await robotStands(page, picture, () => page.mouse.click(window.width / 2, window.height - 57)); // on the line of time
  console.log(`foxglove: 3-D panel of ${file}: ${found.force} pixels of forces, ${found.robot} of the robot's housing`);
  if (!found.there) process.exitCode = 1;
} finally {
  await browser.close();
  server.close();
}
