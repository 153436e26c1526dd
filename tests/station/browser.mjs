// A page in Debian's Chromium, and what it complains of.
import { createRequire } from "node:module";
import path from "node:path";

// As Chromium does where there is no GPU: the page is put together by the processor, and SwiftShader draws WebGL.
// With --use-angle=swiftshader SwiftShader would put the page together as well, which costs three times as much.
const software = ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update",
  "--disable-sync", "--disable-gpu", "--enable-unsafe-swiftshader"];

/** @param folder that has node_modules. @param more arguments for Chromium */
export async function launch(folder, more = []) {
  const { chromium } = createRequire(path.resolve(folder) + "/")("playwright-core");
  const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: [...software, ...more] });
  browser.draws = !more.includes("--disable-3d-apis");
  return browser;
}

/** Seconds of processor time that Chromium's processes have used, by what they do: browser, renderer, GPU. */
export async function processorTimes_s(browser) {
  const session = await browser.newBrowserCDPSession();
  const { processInfo } = await session.send("SystemInfo.getProcessInfo");
  await session.detach();
  const times = { browser: 0, renderer: 0, GPU: 0 };
  for (const { type, cpuTime } of processInfo) if (type in times) times[type] += cpuTime;
  return times;
}

/** @return the opened page; its `complaints` are errors and warnings of the console, and whatever it asked of a network. */
export async function open(browser, file, { width = 1280, height = 720, theme = "light", hash = "" } = {}) {
  const page = await browser.newPage({ viewport: { width, height }, colorScheme: theme });
  page.complaints = [];
  page.on("console", (message) => {
    const drivers = message.text().includes("GPU stall"); // reading pixels back, by software
    if (["error", "warning"].includes(message.type()) && !drivers) page.complaints.push(message.text());
  });
  page.on("pageerror", (error) => page.complaints.push(error.message));
  page.on("request", (request) => {
    if (/^(https?|wss?):/.test(request.url())) page.complaints.push(`asks for ${request.url()}`);
  });
  await page.goto(`file://${file}${hash}`);
  await page.waitForFunction(() => document.documentElement.dataset.ready, null, { timeout: 120_000 });
  return page;
}
