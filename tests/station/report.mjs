// Rows of what was measured, and whether what was wanted is reached. A row that is not makes the exit status 1.
import os from "node:os";

/** Of sorted values. */
export const share = (sorted, part) => sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))];
export const sortedOf = (values) => [...values].sort((a, b) => a - b);
export const median = (values) => share(sortedOf(values), 0.5);

/** @param wanted { most } or { least }; {}: nothing is. */
export function row(name, value, unit, { most = Infinity, least = -Infinity } = {}) {
  const reached = value <= most && value >= least;
  const bound = most < Infinity ? `at most ${most}` : `at least ${least}`;
  const verdict = most === Infinity && least === -Infinity ? "" : `   wanted ${bound}: ${reached ? "reached" : "NOT REACHED"}`;
  console.log(`${name.padEnd(62)} ${value.toFixed(3)} ${unit}${verdict}`);
  if (!reached) process.exitCode = 1;
}

/** What else the machine had to do: figures of a busy one are upper bounds. */
export const rowOfLoad = () => row("load of the machine, last minute", os.loadavg()[0], "");
