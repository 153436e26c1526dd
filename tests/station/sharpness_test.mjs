// When a page draws with fewer pixels, and when with more. usage: sharpness_test.mjs   node's own test runner
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";

const script = new URL("../../tools/station/page/sharpness.js", import.meta.url);
const { Sharpness, PictureClock, kRatios } = await import(`data:text/javascript,${encodeURIComponent(readFileSync(script, "utf8"))}`);

const pictures = (sharpness, count, ms) => {
  for (let i = 0; i < count; ++i) sharpness.took(ms);
};

test("three slow pictures in a row take pixels away, down to the least", () => {
  const sharpness = new Sharpness();
  assert.equal(sharpness.ratio, 1);
  pictures(sharpness, 2, 41);
  sharpness.took(39);
  pictures(sharpness, 2, 41);
  assert.equal(sharpness.ratio, 1, "one that is slow now and then changes nothing");
  sharpness.took(41);
  assert.equal(sharpness.ratio, 0.75);
  pictures(sharpness, 100, 500);
  assert.equal(sharpness.ratio, kRatios[0]);
});

test("where pictures are quick edges are smoothed by more pixels", () => {
  const sharpness = new Sharpness();
  pictures(sharpness, 29, 17);
  assert.equal(sharpness.ratio, 1);
  sharpness.took(17);
  assert.equal(sharpness.ratio, 2);
  pictures(sharpness, 100, 17);
  assert.equal(sharpness.ratio, 2);
});

test("what was too slow once is not tried again", () => {
  const sharpness = new Sharpness();
  pictures(sharpness, 30, 17);
  pictures(sharpness, 3, 50);
  assert.equal(sharpness.ratio, 1);
  pictures(sharpness, 300, 17);
  assert.equal(sharpness.ratio, 1);
});

test("a picture that stands still is sharp", () => {
  const sharpness = new Sharpness();
  pictures(sharpness, 100, 500);
  assert.equal(sharpness.still_ratio(100), kRatios[0]);
  assert.equal(sharpness.still_ratio(1000), 1);
});

test("a picture's time ends when the drawing is done, or the drawing is lost", () => {
  let signaled = 0, lost = false;
  const gl = { SIGNALED: 1, fenceSync: () => ({}), flush() {}, deleteSync() {}, getSyncParameter: () => signaled, isContextLost: () => lost };
  const clock = new PictureClock(gl);
  clock.begin(100);
  assert.equal(clock.done(101), null);
  clock.asked();
  assert.equal(clock.done(120), null);
  assert.ok(clock.busy);
  signaled = 1;
  assert.equal(clock.done(150), 50);
  assert.ok(!clock.busy);
  [signaled, lost] = [0, true];
  clock.begin(200);
  clock.asked();
  assert.equal(clock.done(210), 10);
});
