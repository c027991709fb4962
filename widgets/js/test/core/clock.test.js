import assert from "node:assert/strict";
import { test } from "node:test";
import { Clock } from "../../src/core/clock.js";

/** A clock whose frames come when the test says so. */
function manual() {
  let now = 0;
  let frame = 0;
  /** @type {Map<number, () => void>} */
  const frames = new Map();
  const clock = new Clock({
    now: () => now,
    request: (callback) => {
      frames.set(++frame, callback);
      return frame;
    },
    cancel: (id) => {
      frames.delete(id);
    },
  });
  /** @type {number[]} */
  const ticks = [];
  clock.on("tick", (value) => ticks.push(value));
  const pass = (/** @type {number} */ seconds) => {
    now += seconds;
    const [[id, callback] = [0, () => undefined]] = [...frames];
    frames.delete(id);
    callback();
  };
  clock.configure({ playing: "time", start: 0, stop: 1, marks: [0.25, 0.5], value: 0, rate: 1 });
  return { clock, ticks, pass, frames };
}

const rounded = (/** @type {number[]} */ values) => values.map((x) => Math.round(x * 1e9) / 1e9);

test("it runs by the seconds that pass, times rate and speed, and stops at the end", () => {
  const { clock, ticks, pass, frames } = manual();
  clock.speed = 2;
  clock.play();
  for (let k = 0; k < 7; k++) pass(0.1);
  assert.deepEqual(rounded(ticks), [0.2, 0.4, 0.6, 0.8, 1]);
  assert.deepEqual([clock.paused, frames.size], [true, 0]);
});

test("at the end, play begins again", () => {
  const { clock, ticks, pass } = manual();
  clock.seek(1);
  clock.play();
  pass(0.1);
  assert.deepEqual(rounded(ticks), [0, 0.1]);
});

test("a loop goes round, without losing what was past the end", () => {
  const { clock, ticks, pass } = manual();
  clock.loop = true;
  clock.seek(0.9);
  clock.play();
  pass(0.2);
  pass(0.2);
  assert.deepEqual(rounded(ticks), [0.1, 0.3]);
});

test("it knows where it will be, as long as it runs", () => {
  const { clock, pass } = manual();
  clock.speed = 2;
  assert.equal(clock.after(0.1), null);
  clock.play();
  assert.deepEqual([clock.pace, ...rounded([0.1, 0.4, 0.6].map((s) => Number(clock.after(s))))], [2, 0.2, 0.8, 1]);
  clock.loop = true;
  assert.deepEqual(rounded([0.1, 0.4, 0.6].map((s) => Number(clock.after(s)))), [0.2, 0.8, 0.2]);
  pass(0.1);
  clock.pause();
  assert.equal(clock.after(0.1), null);
});

test("it runs backwards as well", () => {
  const { clock, ticks, pass } = manual();
  clock.speed = -1;
  clock.seek(0.2);
  clock.play();
  pass(0.1);
  pass(0.2);
  assert.deepEqual(rounded(ticks), [0.1, 0]);
  assert.equal(clock.paused, true);
});

test("no frame counts for more than a quarter of a second: a page that was hidden goes on from where it was", () => {
  const { clock, ticks, pass } = manual();
  clock.play();
  pass(3600);
  assert.deepEqual(ticks, [0.25]);
});

test("pause asks for no more frames", () => {
  const { clock, ticks, pass, frames } = manual();
  clock.play();
  pass(0.1);
  clock.pause();
  assert.equal(frames.size, 0);
  pass(0.1);
  assert.equal(ticks.length, 1);
});

test("whoever listens may pause it", () => {
  const { clock, pass, frames } = manual();
  clock.on("tick", () => clock.pause());
  clock.play();
  pass(0.1);
  assert.deepEqual([frames.size, clock.paused], [0, true]);
});

test("it steps from mark to mark, to the ends, and stops there", () => {
  const { clock, ticks } = manual();
  clock.play();
  for (let k = 0; k < 4; k++) clock.next();
  for (let k = 0; k < 3; k++) clock.previous();
  assert.deepEqual(ticks, [0.25, 0.5, 1, 1, 0.5, 0.25, 0]);
  assert.equal(clock.paused, true);
});

test("to seek tells nobody, and stays inside", () => {
  const { clock, ticks } = manual();
  clock.seek(7);
  clock.seek(NaN);
  assert.deepEqual([clock.value, ticks], [1, []]);
});

test("another axis may play", () => {
  const { clock, ticks, pass } = manual();
  let states = 0;
  clock.on("state", () => states++);
  clock.configure({ playing: "length", start: 5, stop: 8, marks: [], value: 5, rate: 3 });
  clock.play();
  pass(0.2);
  assert.deepEqual(rounded(ticks), [5.6]);
  assert.equal(states, 2);
});
