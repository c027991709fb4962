import assert from "node:assert/strict";
import { test } from "node:test";
import { nextMark, ticks } from "../../src/ui/ticks.js";

test("marks are where their values lie, sorted and once each", () => {
  assert.deepEqual(ticks([5, 0, 5, 10, 12], 0, 10), [
    { value: 0, at: 0 }, { value: 5, at: 0.5 }, { value: 10, at: 1 },
  ]);
});

test("crowded marks are thinned out, the ends stay", () => {
  const many = Array.from({ length: 1001 }, (_, i) => i / 100);
  const kept = ticks(many, 0, 10, 0.05);
  assert.ok(kept.length <= 21);
  assert.equal(kept[0].value, 0);
  assert.equal(kept.at(-1)?.value, 10);
});

test("an empty range has no ticks", () => assert.deepEqual(ticks([1], 1, 1), []));

test("a step goes to the mark after or before, never to the one where it stands", () => {
  assert.equal(nextMark([0, 1, 2.5], 1, 1), 2.5);
  assert.equal(nextMark([0, 1, 2.5], 1, -1), 0);
  assert.equal(nextMark([0, 1, 2.5], 2.5, 1), null);
});
