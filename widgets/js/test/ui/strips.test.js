import assert from "node:assert/strict";
import { test } from "node:test";
import { blocks, told } from "../../src/ui/strips.js";

test("spans are cut to the whole, and neighbours of one state are one", () => {
  const found = blocks([
    { start: -5, stop: 2, state: "remembered" }, { start: 2, stop: 4, state: "remembered" },
    { start: 4, stop: 5, state: "stale" }, { start: 5, stop: 50, state: "missing" },
  ], 0, 10);
  assert.deepEqual(found.map((b) => [b.state, b.from, b.to]), [
    ["remembered", 0, 0.4], ["stale", 0.4, 0.5], ["missing", 0.5, 1],
  ]);
});

test("the strip can be read aloud", () => {
  assert.equal(told(blocks([{ start: 0, stop: 3, state: "computing" }], 0, 10), 0.01),
    "being computed 0.00 to 3.00\u202fs");
  assert.equal(told([], 1), "nothing remembered yet");
});
