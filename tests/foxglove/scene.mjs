// Opens an MCAP file in Foxglove Studio with the layout that is shipped, goes to its middle, and looks whether the robot stands there.
// usage: scene.mjs FOLDER FILE.mcap LAYOUT.json PICTURE.png   FOLDER has the files and node_modules; exit status 1: nothing is drawn
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { serve } from "./serve.mjs";

const [folder, file, layout, picture] = process.argv.slice(2);
const { chromium } = createRequire(path.resolve(folder) + "/")("playwright-core");
const here = path.dirname(fileURLToPath(import.meta.url));
const timeout_ms = 300_000; // Studio is 22 MB of JavaScript, and machines are busy
const pause_ms = 3000;
const window = { width: 1500, height: 850 };
const software = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const panel = { x: 425, y: 90, width: 620, height: 640 }; // beside Studio's list of topics
const wanted = { force: 40, robot: 500 }; // pixels at least

/** Pixels of the estimated forces' arrows (vermilion) and of the accent (green) and grey of the leg. */
function count(image) {
  return new Promise((resolve) => {
    const picture = new Image();
    picture.onload = () => {
      const canvas = new OffscreenCanvas(picture.width, picture.height);
      const context = canvas.getContext("2d");
      context.drawImage(picture, 0, 0);
      const { data } = context.getImageData(0, 0, picture.width, picture.height);
      const found = { force: 0, robot: 0 };
      for (let i = 0; i < data.length; i += 4) {
        const [r, g, b] = data.subarray(i, i + 3);
        if (r > 1.6 * g && g > 1.5 * b && r > 120) ++found.force;
        else if (g > 1.5 * r && g > 1.1 * b) ++found.robot;
      }
      resolve(found);
    };
    picture.src = "data:image/png;base64," + image;
  });
}

const server = await serve([here, path.join(folder, "node_modules"), folder]);
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox", ...software] });
try {
  const page = await browser.newPage({ viewport: window });
  const query = new URLSearchParams([["layoutId", "sprung"], ["file", file], ["layout", layout]]);
  await page.goto(`${server.address}/page.html?${query}`, { waitUntil: "commit", timeout: timeout_ms });
  let found = {};
  for (const begin = Date.now(); Date.now() - begin < timeout_ms; ) {
    await page.mouse.click(window.width / 2, window.height - 57); // on the line of time, as soon as it is there
    await page.waitForTimeout(pause_ms);
    const image = await page.screenshot({ path: picture, timeout: timeout_ms, clip: panel });
    found = await page.evaluate(count, image.toString("base64"));
    if (found.force >= wanted.force && found.robot >= wanted.robot) break;
  }
  await page.screenshot({ path: picture, timeout: timeout_ms });
  console.log(`foxglove: 3-D panel of ${file}: ${found.force} pixels of forces, ${found.robot} of the robot's housing`);
  if (!(found.force >= wanted.force && found.robot >= wanted.robot)) process.exitCode = 1;
} finally {
  await browser.close();
  server.close();
}
