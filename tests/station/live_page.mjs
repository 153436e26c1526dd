// The live page in a browser, and what it complains of.
import assert from "node:assert/strict";
import { eventually } from "./live_robot.mjs";

/** A second page that draws takes the processor from the one that is looked at, whose holds then come too late. */
const noCanvas = () => { HTMLCanvasElement.prototype.getContext = () => null; };

/** @return the page, live; `complaints` are errors and warnings of its console. */
export async function openLive(browser, url, { width = 1280, height = 720, theme = "light", script, drawsNothing = false } = {}) {
  const page = await browser.newPage({ viewport: { width, height }, colorScheme: theme });
  page.complaints = [];
  page.on("console", (message) => {
    // Reading pixels back, by software; what a browser that draws nothing says of that.
    const drivers = message.text().includes("GPU stall") || ((!browser.draws || drawsNothing) && message.text().includes("WebGL"));
    if (["error", "warning"].includes(message.type()) && !drivers) page.complaints.push(message.text());
  });
  page.on("pageerror", (error) => page.complaints.push(error.message));
  if (script) await page.addInitScript(script);
  if (drawsNothing) await page.addInitScript(noCanvas);
  await page.goto(url);
  await page.waitForFunction(() => window.sprung?.link.ready && window.sprung.state?.session.driver > 0, null, { timeout: 60_000 });
  return page;
}

/** Closes it; it must have complained of nothing but what is expected. */
export async function closeLive(page, expected = /^$/) {
  assert.deepEqual(page.complaints.filter((line) => !expected.test(line)), []);
  await page.close();
}

export const state = (page) => page.evaluate(() => window.sprung.state);

export const motionIs = (page, wanted, timeout_ms = 30_000) =>
  eventually(`motion is ${wanted}`, async () => (await state(page)).motion.state === wanted, timeout_ms);

/** Presses a command's button. @param values of its form's fields. */
export async function press(page, command, values = {}) {
  const button = page.locator(`button[data-command=${command}]`);
  const form = page.locator("form", { has: button });
  if (Object.keys(values).length > 0) await form.locator("details").evaluate((details) => { details.open = true; });
  for (const [name, value] of Object.entries(values)) {
    const field = form.locator(`[name=${name}]`);
    if ((await field.evaluate((each) => each.tagName)) === "SELECT") await field.selectOption(value);
    else await field.fill(String(value));
  }
  await button.click();
}

/** The newest line of what came of commands that has these words. */
export const news = (page, words, timeout_ms = 30_000) =>
  eventually(`news of ${words}`, async () => (await page.locator("#news li").allTextContents()).find((line) => line.includes(words)), timeout_ms);

/** A quadruped that lies on the floor comes to its stand. */
export async function standUp(page) {
  if ((await state(page)).joints.some((joint) => joint.status === "not referenced")) {
    await press(page, "home", { from: "link" });
    await page.locator("#confirm button[value=yes]").click();
    await news(page, "home: done");
  }
  await press(page, "stand");
  await motionIs(page, "standing", 60_000);
}
