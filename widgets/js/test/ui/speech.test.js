import assert from "node:assert/strict";
import { test } from "node:test";
import { Announcer, pictureText, valueText } from "../../src/ui/speech.js";
import { problemTexts } from "../../src/ui/picture.js";
import { manifest, parameter } from "./makings.js";

const of = manifest([parameter("length", { unit: "m" }), parameter("secret", { hidden: true })]);

test("a picture says when and what it shows, in the scene's words if there are any", () => {
  const moment = { time: 1.27, parameters: { length: 1.5, secret: 2 } };
  assert.equal(pictureText(of, moment), "At 1.27\u202fs: A pendulum, length 1.50\u202fm.");
  assert.equal(pictureText(of, { ...moment, alt: "a bob on a rod." }), "At 1.27\u202fs: a bob on a rod.");
  assert.equal(pictureText(of, { ...moment, alt: "At 1.27 s: a bob." }), "At 1.27 s: a bob.");
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
