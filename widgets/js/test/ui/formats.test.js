import assert from "node:assert/strict";
import { test } from "node:test";
import { decimals, format, parse, positionText, timeText, withUnit } from "../../src/ui/formats.js";

test("numbers are written as Python's format() writes them, but for the minus", () => {
  const cases = /** @type {[number, string, string][]} */ ([
    [1, ".2f", "1.00"], [1.005, ".1f", "1.0"], [-0.5, ".2f", "−0.50"], [-0.001, ".2f", "0.00"], [3, "+.1f", "+3.0"],
    [1234567.891, ",.2f", "1,234,567.89"], [42, "d", "42"], [42, "05d", "00042"], [0.25, ".0%", "25%"],
    [12345.678, ".3g", "1.23e+04"], [0.0001234, "g", "0.0001234"], [1e-7, "g", "1e-07"], [100000, "g", "100000"],
    [1500, ".2e", "1.50e+03"], [0.1 + 0.2, "", "0.3"], [2, ".3", "2"],
  ]);
  for (const [value, spec, expected] of cases) assert.equal(format(value, spec), expected, `${value} as ${spec}`);
});

test("what is no finite number is still something to read", () => {
  assert.equal(format(NaN), "–");
  assert.equal(format(-Infinity), "−∞");
  assert.equal(format(true), "yes");
  assert.equal(format(null), "–");
  assert.equal(format([0.5, 1], ".1f"), "(0.5, 1.0)");
  assert.equal(format("crimson", ".2f"), "crimson");
});

test("as many decimals are shown as a step needs", () => {
  assert.deepEqual([0.05, 0.1, 1, 5, 0.125, 1e-3].map(decimals), [2, 1, 0, 0, 3, 3]);
});

test("units stand behind a thin space, degrees without one", () => {
  assert.equal(withUnit("20", "deg"), "20°");
  assert.equal(withUnit("1.50", "m"), "1.50\u202fm");
  assert.equal(timeText(1.273), "1.27\u202fs");
  assert.equal(withUnit("3", ""), "3");
});

test("readers may type a comma, any minus and a unit, and nothing that is no number", () => {
  assert.equal(parse(" 1,5 m "), 1.5);
  assert.equal(parse("−20°"), -20);
  assert.equal(parse("1e-3"), 0.001);
  assert.equal(parse(".5"), 0.5);
  assert.equal(parse("1.2.3"), null);
  assert.equal(parse("twelve"), null);
  assert.equal(parse(""), null);
});

test("what is shown can be typed again", () => {
  for (const x of [-1234.5, 0, 3.25, -0.004]) assert.equal(parse(format(x, ".6f")), x);
});

test("a position is short", () => {
  assert.equal(positionText([0.123, -1, 250]), "(0.12, −1.00, 250.0)");
});
