import assert from "node:assert/strict";
import { test } from "node:test";
import { colorWord } from "../../src/ui/descriptions.js";
import { Announcer, pictureText, valueText } from "../../src/ui/speech.js";
import { problemTexts } from "../../src/ui/picture.js";
import { manifest, parameter } from "./makings.js";

const of = manifest([parameter("length", { unit: "m" }), parameter("secret", { hidden: true })]);

/** @param {string} name @param {any} more */
function node(name, more) {
  const matrix = new Float64Array([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
  matrix.set(more.at ?? [0], 3);
  const color = [0.86, 0.08, 0.24, 1];
  const shown = { kind: "sphere", drawn: "mesh", visible: true, color, matrix, points: null, settings: {} };
  return [name, { name, ...shown, ...more }];
}

test("a picture says when and what it shows, as it stands at that time", () => {
  const moment = { time: 1.27, parameters: { length: 1.5, secret: 2 } };
  assert.equal(pictureText(of, moment), "At 1.27\u202fs: A pendulum, length 1.50\u202fm.");
  const ends = { a: { ref: "", array: new Float32Array([0, 0, 0, 1, 1, 1]) },
    b: { ref: "", array: new Float32Array([0, 0, 0, 3, 1, 1]) }, mix: 0.5 };
  const nodes = /** @type {any} */ (new Map(/** @type {any} */ ([
    node("car", { kind: "group", drawn: "none" }), node("car/bob", { at: [0.34] }), node("hidden", { visible: false }),
    node("rod", { kind: "csg", color: [0.5, 0.5, 0.5, 1], points: ends }), node("lamp", { drawn: "light" }),
    node("tag", { kind: "label", drawn: "label", settings: { text: "here" } }),
  ])));
  assert.equal(
    pictureText(of, { ...moment, nodes, values: new Map(/** @type {any} */ ([["height", 0.5], ["gone", null]])) }),
    "At 1.27\u202fs: A crimson sphere (bob) at (0.34, 0.00, 0.00), a gray solid (rod) at (1.00, 0.50, 0.50), "
      + "the label “here”, lit by a light; height 0.5.",
  );
  const many = /** @type {any} */ (new Map(/** @type {any} */ ([0, 1, 2].map((i) => node(`b${i}`, { at: [i] })))));
  assert.equal(pictureText(of, { ...moment, nodes: many, values: new Map() }),
    "At 1.27\u202fs: 3 crimson spheres between (0.00, 0.00, 0.00) and (2.00, 0.00, 0.00).");
  assert.equal(pictureText(of, { ...moment, nodes: new Map(), values: new Map() }),
    "At 1.27\u202fs: Nothing is to be seen.");
});

test("colours have everyday names", () => {
  const words = ["#dc143c", "#8fbc8f", "#a9a9a9", "#0000cd", "#ffffff"].map((code) => {
    return colorWord([1, 3, 5].map((i) => parseInt(code.slice(i, i + 2), 16) / 255));
  });
  assert.deepEqual(words, ["crimson", "gray green", "light gray", "blue", "white"]);
});

test("values read as their kind does", () => {
  const kinds = /** @type {[any, any, string][]} */ ([
    [{ kind: "boolean" }, true, "on"],
    [{ kind: "select", options: [1, 2], labels: ["one", "two"] }, 2, "two"],
    [{ kind: "color" }, "#ff0000", "#ff0000"],
    [{ kind: "range", bounds: [0, 10] }, [2, 3.5], "2.0 – 3.5"],
    [{ kind: "xy", bounds: [0, 1], unit: "m" }, [0.25, 1], "0.25, 1.00\u202fm"],
    [{ kind: "number", bounds: [-90, 90], unit: "deg" }, -20, "−20°"],
  ]);
  for (const [more, value, text] of kinds) assert.equal(valueText(parameter("p", more), value), text);
  assert.equal(valueText(parameter("p"), 1, ".1f"), "1.0");
});

test("an error is told with where it is and why", () => {
  assert.deepEqual(problemTexts([{ channel: "car/tyre0#matrix", text: "ZeroDivisionError: division by zero" }]), [
    "car/tyre0 is not shown: its matrix cannot be computed here. ZeroDivisionError: division by zero",
  ]);
  assert.deepEqual(problemTexts([{ channel: "#values.height", text: "no." }]), [
    "height is not known: it cannot be computed here. no.",
  ]);
});

test("many changes are spoken once, as the last of them stands", async () => {
  /** @type {string[]} */
  const spoken = [];
  const announcer = new Announcer((text) => spoken.push(text), { every: 0, now: () => 0 });
  for (let i = 0; i < 20; i++) announcer.say(() => `step ${i}`);
  assert.deepEqual(spoken, []);
  await new Promise((resolve) => { setTimeout(resolve, 500); });
  assert.deepEqual(spoken, ["step 19"]);
});
