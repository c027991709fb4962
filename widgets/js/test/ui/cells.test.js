import assert from "node:assert/strict";
import { test } from "node:test";
import { recordOf, told, WORDS } from "../../src/ui/cells.js";

const box = (/** @type {string} */ name) => ({ name, at: [0.5, 0] });
/** @type {import("../../src/core/types.js").Cells} */
const chart = {
  boxes: ["way", "eye", "chair"].map(box), arrows: [], moves: [["x"], ["z"], ["x", "z"], ["x", "y", "z"]],
};
const moment = (/** @type {Record<string, any>} */ parameters, time = 0) => ({ time, parameters, cells: [] });

test("what was recorded along time is shown until a parameter moves, and where nothing was recorded of it", () => {
  assert.equal(recordOf(chart, moment({ x: 1 }), null), 0);
  assert.equal(recordOf(chart, moment({ x: 1 }, 2), moment({ x: 1 })), 0);
  assert.equal(recordOf(chart, moment({ w: 2 }), moment({ w: 1 })), 0);
});

test("a drag is shown by the record of the parameters that it moved", () => {
  const here = moment({ x: 1, y: 1, z: [1, 2] });
  assert.equal(recordOf(chart, moment({ x: 2, y: 1, z: [1, 2] }), here), 1);
  assert.equal(recordOf(chart, moment({ x: 1, y: 1, z: [1, 3] }), here), 2);
  assert.equal(recordOf(chart, moment({ x: 2, y: 1, z: [1, 3] }), here), 3);
  assert.equal(recordOf(chart, moment({ x: 2, y: 2, z: [1, 2] }), here), 4);
});

test("a live figure has one record, of this very ask", () => {
  assert.equal(recordOf({ ...chart, moves: null }, moment({ x: 2 }), moment({ x: 1 })), 0);
});

test("what was done can be read aloud, and no two things are called alike", () => {
  assert.equal(told(chart, "ccr"), "Reused: chair. Cut off: way, eye.");
  assert.equal(told(chart, ""), "");
  assert.equal(new Set(Object.values(WORDS).map(([, word]) => word)).size, Object.keys(WORDS).length);
});
