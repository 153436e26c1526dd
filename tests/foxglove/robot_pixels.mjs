// Whether a robot stands in Foxglove Studio's 3-D panel, by the colours of its pixels.

export const window = { width: 1500, height: 850 };
export const software = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const timeout_ms = 300_000; // Studio is 22 MB of JavaScript, and machines are busy
const pause_ms = 3000;
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

/** Looks until it stands there. @param before each look @return {there, force, robot}: pixels */
export async function robotStands(page, picture, before = async () => {}) {
  let found = {}, there = false;
  for (const begin = Date.now(); !there && Date.now() - begin < timeout_ms; ) {
    await before();
    await page.waitForTimeout(pause_ms);
    const image = await page.screenshot({ path: picture, timeout: timeout_ms, clip: panel });
    found = await page.evaluate(count, image.toString("base64"));
    there = found.force >= wanted.force && found.robot >= wanted.robot;
  }
  await page.screenshot({ path: picture, timeout: timeout_ms });
  return { there, ...found };
}
