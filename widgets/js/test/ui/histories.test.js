import assert from "node:assert/strict";
import { test } from "node:test";
import { Gestures, History } from "../../src/ui/histories.js";

test("undo goes where the reader was, redo where they had gone", () => {
  const history = /** @type {History<string>} */ (new History());
  history.act("a");
  history.act("b");
  assert.equal(history.undo("c"), "b");
  assert.equal(history.undo("b"), "a");
  assert.equal(history.undo("a"), null);
  assert.equal(history.redo("a"), "b");
  assert.equal(history.redo("b"), "c");
  assert.equal(history.canRedo, false);
});

test("a drag is one step", () => {
  const history = /** @type {History<number>} */ (new History());
  for (let x = 0; x < 50; x++) history.act(x, "drag 1");
  history.act(50, "drag 2");
  assert.equal(history.undo(60), 50);
  assert.equal(history.undo(50), 0);
  assert.equal(history.canUndo, false);
});

test("whoever acts after an undo has no future", () => {
  const history = /** @type {History<string>} */ (new History());
  history.act("a");
  history.undo("b");
  history.act("a");
  assert.equal(history.canRedo, false);
});

test("only so many steps are kept", () => {
  const history = /** @type {History<number>} */ (new History({ limit: 3 }));
  for (let x = 0; x < 9; x++) history.act(x);
  assert.deepEqual([history.undo(9), history.undo(8), history.undo(7), history.undo(6)], [8, 7, 6, null]);
});

test("keys that follow each other within a second are one gesture, drags never", () => {
  let now = 0;
  const gestures = new Gestures(() => now);
  const first = gestures.again("length");
  now = 900;
  assert.equal(gestures.again("length"), first);
  now = 2500;
  assert.notEqual(gestures.again("length"), first);
  assert.notEqual(gestures.begin("length"), gestures.begin("length"));
});
