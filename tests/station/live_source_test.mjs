// What the live page's plots are drawn from. usage: live_source_test.mjs   node's own test runner
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";

const script = new URL("../../tools/station/page/console/live_source.js", import.meta.url);
const { LiveSource } = await import(`data:text/javascript,${encodeURIComponent(readFileSync(script, "utf8"))}`);

const layout = { fields: [{ name: "torque" }, { name: "nobody says" }] };
const heard = (frames, begin_s = 0) => {
  const source = new LiveSource(layout);
  for (let i = 0; i < frames; ++i) source.take(begin_s + i / 50, [i, NaN]);
  return source;
};

test("a field that was heard has its values with their times, another has none", () => {
  const source = heard(3, 7);
  const { time_s, low, high } = source.series(0);
  assert.deepEqual([...time_s], [7, 7.02, 7.04]);
  assert.deepEqual([...low], [0, 1, 2]);
  assert.equal(low, high);
  assert.equal(source.series(1), null);
});

test("the last 20 s stay, however long it goes on", () => {
  const frames = 50 * 3600;
  const source = heard(frames);
  const [from_s, to_s] = source.range();
  assert.equal(to_s, (frames - 1) / 50);
  assert.equal(to_s - from_s, 20);
  const { time_s, low } = source.series(0);
  assert.ok(time_s[0] <= from_s + 0.02 && time_s.length <= 2000, `${time_s.length} from ${time_s[0]} s`);
  assert.equal(low.at(-1), frames - 1);
  assert.ok(time_s.every((t, i) => i === 0 || t > time_s[i - 1]));
});

test("time that goes back is another run: it begins anew", () => {
  const source = heard(100, 500);
  source.take(1, [NaN, 4]);
  assert.equal(source.series(0), null);
  assert.deepEqual([...source.series(1).low], [4]);
});
