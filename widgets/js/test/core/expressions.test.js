import assert from "node:assert/strict";
import { test } from "node:test";
import { compileTree, evaluate } from "../../src/core/expressions.js";

/** @param {any} tree @param {any} [parameters] */
const value = (tree, parameters = {}) => evaluate(tree, { time: 2, parameters });

const RAMP = { kind: "poly", times: [0, 9], coefficients: [0, 1], degree: 1, shape: [] };

const same = /** @type {[any, any][]} */ ([
  [["+", 1, 2], 3],
  [["%", -1, 3], 2],
  [["%", 1, -3], -2],
  [["%", 5, 0], NaN],
  [["//", 1, 0.1], 9],
  [["//", -7, 2], -4],
  [["//", 1, 0], Infinity],
  [["/", -1, 0], -Infinity],
  [["**", 0, 0], 1],
  [["**", 1, ["/", 0, 0]], 1],
  [["**", -1, ["/", 1, 0]], 1],
  [["**", -8, 0.5], NaN],
  [["round", 0.5], 0],
  [["round", 1.5], 2],
  [["round", -2.5], -2],
  [["sign", -3], -1],
  [["min", 1, ["/", 0, 0]], NaN],
  [["clip", 5, 0, 2], 2],
  [["where", ["<", ["time"], 3], 10, 20], 10],
  [["and", 1, 0], false],
  [["not", 0], true],
  [["+", true, true], 2],
  [["vec", 1, ["time"], 3], [1, 2, 3]],
  [["*", 2, ["vec", 1, 2]], [2, 4]],
  [["index", ["vec", 4, 5], 1], 5],
  [["norm", ["vec", 3, 4]], 5],
  [["dot", ["vec", 1, 2], ["vec", 3, 4]], 11],
  [["cross", ["vec", 1, 0, 0], ["vec", 0, 1, 0]], [0, 0, 1]],
  [["where", ["<", ["vec", 1, 5], 3], ["vec", 7, 7], 0], [7, 0]],
  [["at", ["*", ["time"], 10], 5], 50],
  [["at", ["track", RAMP], ["+", ["time"], 1]], 3],
  [["==", ["param", "mode"], "fast"], true],
  [["*", 2, ["param", "length"]], 3],
  [["index", ["param", "where"], 1], 8],
  [["rgba", "#0f3"], [0, 1, 0.2, 1]],
  [["rgba", "#00FF3366"], [0, 1, 0.2, 0.4]],
  [["rgba", "red"], [NaN, NaN, NaN, NaN]],
  [["rgba", 7], [NaN, NaN, NaN, NaN]],
]);
for (const [tree, expected] of same) {
  test(`${JSON.stringify(tree).slice(0, 70)} is ${JSON.stringify(expected)}`, () => {
    assert.deepEqual(value(tree, { mode: "fast", length: 1.5, where: [7, 8] }), expected);
  });
}

test("arithmetic without numbers is NaN, and nothing worse", () => {
  const uneven = ["+", ["vec", 1, 2], ["vec", 1, 2, 3]];
  for (const tree of [["+", "a", 1], ["sin", "1"], ["index", 3, 0], uneven, ["norm", "x"]]) {
    assert.ok([value(tree)].flat().every(Number.isNaN), JSON.stringify(tree));
  }
});

test("a parameter is its own entry, whatever every object has", () => {
  assert.ok(Number.isNaN(value(["param", "constructor"])));
  assert.ok(Number.isNaN(value(["param", "__proto__"], JSON.parse('{"__proto__x": 1}'))));
  const parameters = Object.create(null);
  parameters.__proto__ = 4; // eslint-disable-line no-proto
  assert.equal(value(["param", "__proto__"], parameters), 4);
});

test("what reads the time moves, what does not stays", () => {
  assert.deepEqual(compileTree(["+", ["param", "a"], 1]).still(0), [-Infinity, Infinity]);
  assert.ok(compileTree(["time"]).still(0)[0] > 0);
});

test("trees that nobody knows are refused, with the place", () => {
  assert.throws(() => value(["eval", "1"]), /tree\[0\]: expected an operator, got "eval"/);
  assert.throws(() => value(["+", 1]), /tree: expected 2 after \+, got 1/);
  assert.throws(() => value(["+", 1, ["toString"]]), /tree\[2\]\[0\]/);
  assert.throws(() => value([]), /at least 1 items/);
  assert.throws(() => value(["+", 1, [NaN]]), /operator/);
  assert.throws(() => value(["index", ["vec", 1], -1]), /whole number/);
});

test("a tree has at most 64 levels and 10,000 nodes", () => {
  /** @type {any} */
  let deep = 1;
  for (let i = 0; i < 64; i++) deep = ["neg", deep];
  assert.throws(() => value(deep), /at most 64 levels/);
  const row = ["vec", ...Array(1000).fill(1)];
  const wide = Array(10).fill(row).reduce((a, b) => ["+", a, b]);
  assert.throws(() => value(["+", wide, row]), /at most 10000/);
});

test("a tree is read once, however often it is asked", () => {
  const tree = ["+", ["param", "a"], 1];
  assert.equal(evaluate(tree, { parameters: { a: 1 } }), 2);
  tree[0] = "*"; // would be seen if it were read again
  assert.equal(evaluate(tree, { parameters: { a: 5 } }), 6);
});
