// Opens an MCAP file in Foxglove Studio, goes to the middle of it, and compares what is shown there with the log's own numbers.
// usage: open.mjs FOLDER FILE.mcap FILE.csv PICTURE.png FIELD...   FOLDER has the files and node_modules; exit status 1: they differ
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { serve } from "./serve.mjs";

const [folder, file, table, picture, ...fields] = process.argv.slice(2);
const { chromium } = createRequire(path.resolve(folder) + "/")("playwright-core");
const here = path.dirname(fileURLToPath(import.meta.url));
const timeout_ms = 300_000; // Studio is 22 MB of JavaScript, and machines are busy
const pause_ms = 3000;
const window = { width: 1500, height: 850 };

/** What the page shows: the number of the message at the time shown, and the value of each field. undefined: not yet. */
function read(text) {
  const lines = text.split("\n").map((line) => line.trim()).filter(Boolean);
  const after = (index) => (index < 0 ? NaN : Number(lines[index + 1] ?? NaN));
  const found = [after(lines.findIndex((line) => / @ \d+\.\d+ sec$/.test(line))), ...fields.map((field) => after(lines.indexOf(field)))];
  return found.some(Number.isNaN) ? undefined : found;
}

/** What the page shows in the middle of the log, once it does not change any more. */
async function shownInTheMiddle(page) {
  for (let last = "", begin = Date.now(); Date.now() - begin < timeout_ms; ) {
    await page.mouse.click(window.width / 2, window.height - 57); // on the line of time, as soon as it is there
    await page.waitForTimeout(pause_ms);
    const found = read(await page.innerText("body"));
    if (found && last === JSON.stringify(found)) return found;
    last = JSON.stringify(found);
  }
  throw new Error(`Studio shows no value of ${fields.join(", ")} in ${file}; it shows\n${await page.innerText("body")}`);
}

/** What `sprung log csv` says of the message with this number. */
function expected(seq) {
  const [heading, ...rows] = readFileSync(path.join(folder, table), "utf8").trim().split("\n").map((line) => line.split(","));
  const row = rows.find((each) => Number(each[heading.indexOf("cycle")]) === seq);
  return fields.map((field) => Number(row?.[heading.findIndex((name) => name.split(" (")[0] === field)]));
}

const server = await serve([here, path.join(folder, "node_modules"), folder]);
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
try {
  const page = await browser.newPage({ viewport: window });
  const query = new URLSearchParams([["layoutId", "sprung"], ["file", file], ...fields.map((field) => ["field", field])]);
  await page.goto(`${server.address}/page.html?${query}`, { waitUntil: "commit", timeout: timeout_ms });
  const [seq, ...values] = await shownInTheMiddle(page);
  await page.screenshot({ path: picture });
  const right = expected(seq);
  fields.forEach((field, i) => console.log(`foxglove: ${file}: message ${seq}: ${field} = ${values[i]}, in the log ${right[i]}`));
  if (!values.every((value, i) => value === right[i])) process.exitCode = 1;
} finally {
  await browser.close();
  server.close();
}
