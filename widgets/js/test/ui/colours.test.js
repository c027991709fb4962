import assert from "node:assert/strict";
import { test } from "node:test";
import { fromHex, toHex } from "../../src/ui/colours.js";

test("colours go into the field and come back in the form that they had", () => {
  assert.deepEqual(toHex("#f80"), { hex: "#ff8800", opacity: null });
  assert.deepEqual(toHex("#FF880080"), { hex: "#ff8800", opacity: 0.5 });
  assert.deepEqual(toHex([1, 0.5, 0, 0.25]), { hex: "#ff8000", opacity: 0.25 });
  assert.equal(fromHex("#00ff00", "#ff0000"), "#00ff00");
  assert.equal(fromHex("#00ff00", "#ff000080", 1), "#00ff00ff");
  assert.deepEqual(fromHex("#ff0000", [0, 0, 0]), [1, 0, 0]);
  assert.deepEqual(fromHex("#ff0000", [0, 0, 0, 0.5]), [1, 0, 0, 0.5]);
});
