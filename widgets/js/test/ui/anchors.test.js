import assert from "node:assert/strict";
import { test } from "node:test";
import { anchorOf, carried, extentsOf, ORIGIN } from "../../src/ui/anchors.js";

/** A turn about z by so many degrees, then a shift along x. @param {number} degrees @param {number} [x] */
function turned(degrees, x = 0) {
  const [c, s] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
  return [c, -s, 0, x, s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
}

test("what moves is taken at its origin", () => {
  assert.equal(anchorOf(turned(0, 1), turned(0, 1.01), [1, 1, 1]), ORIGIN);
});

test("a dial that turns in its place is taken at its rim, never at its axis", () => {
  assert.deepEqual(anchorOf(turned(0), turned(1), [2, 2, 9]), [2, 0, 0]);
  assert.deepEqual(anchorOf(turned(0), turned(1), [0, 3, 9]), [0, 3, 0]);
});

test("what does not move at all is taken at its origin", () => {
  assert.equal(anchorOf(turned(0), turned(0), [1, 1, 1]), ORIGIN);
});

test("places are carried by the matrix, and extents are those of the points", () => {
  carried(turned(90, 5), [1, 0, 2]).forEach((x, i) => assert.ok(Math.abs(x - [5, 1, 2][i]) < 1e-12));
  assert.deepEqual(extentsOf([1, -2, 0, -3, 1, 0.5]), [3, 2, 0.5]);
});
