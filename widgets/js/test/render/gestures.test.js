import assert from "node:assert/strict";
import { test } from "node:test";
import { Gestures } from "../../src/render/gestures.js";
import { FakeElement, page } from "./cards.js";

page();

/** A canvas with hands that write down what they do. */
function hands() {
  /** @type {any[][]} */
  const log = [];
  const names = ["orbit", "pan", "dolly", "turn", "shift", "zoom", "home", "hover", "leave", "rest"];
  const actions = Object.fromEntries(names.map((name) => [name, (/** @type {number[]} */ ...rest) => {
    log.push([name, ...rest.map((x) => Math.round(x * 100) / 100)]);
  }]));
  const canvas = new FakeElement();
  const gestures = new Gestures(/** @type {any} */ (canvas), /** @type {any} */ (actions));
  /** @param {string} type @param {object} [more] @returns {boolean} whether the page keeps the event */
  const send = (type, more = {}) => {
    const base = { pointerId: 1, pointerType: "mouse", button: 0, offsetX: 0, offsetY: 0, deltaMode: 0 };
    return canvas.dispatchEvent(Object.assign(new Event(type, { cancelable: true }), base, more));
  };
  /** @param {number[][]} places @param {object} [more] */
  const stroke = (places, more = {}) => {
    places.forEach(([offsetX, offsetY], i) => {
      send(i === 0 ? "pointerdown" : "pointermove", { offsetX, offsetY, ...more });
    });
    send("pointerup", more);
    return log.splice(0).filter(([name]) => name !== "leave" && name !== "rest");
  };
  const focus = () => Object.assign(document, { activeElement: canvas });
  const blur = () => Object.assign(document, { activeElement: null });
  return { canvas, gestures, log, send, stroke, focus, blur };
}

test("a drag goes round, a click that trembles does not", () => {
  const { stroke } = hands();
  assert.deepEqual(stroke([[10, 10], [11, 11]]), []);
  assert.deepEqual(stroke([[10, 10], [20, 10], [25, 12]]), [["orbit", 5, 2]]);
});

test("a drag with the right button, or with Shift, shifts", () => {
  const { stroke } = hands();
  assert.deepEqual(stroke([[0, 0], [9, 0], [9, 4]], { button: 2 }), [["pan", 0, 4]]);
  assert.deepEqual(stroke([[0, 0], [9, 0], [9, 4]], { shiftKey: true }), [["pan", 0, 4]]);
});

test("one finger upwards or downwards belongs to the page, sideways to the figure", () => {
  const { stroke, focus, blur } = hands();
  const touch = { pointerType: "touch" };
  assert.deepEqual(stroke([[0, 0], [2, 12], [3, 40]], touch), []);
  assert.deepEqual(stroke([[0, 0], [12, 2], [30, 5]], touch), [["orbit", 18, 3]]);
  focus();
  assert.deepEqual(stroke([[0, 0], [2, 12], [3, 40]], touch), [["orbit", 1, 28]]);
  blur();
});

test("two fingers come nearer and shift", () => {
  const { send, log } = hands();
  const touch = { pointerType: "touch" };
  send("pointerdown", { ...touch, pointerId: 1, offsetX: 100, offsetY: 100 });
  send("pointerdown", { ...touch, pointerId: 2, offsetX: 200, offsetY: 100 });
  log.length = 0;
  send("pointermove", { ...touch, pointerId: 2, offsetX: 300, offsetY: 100 });
  assert.deepEqual(log, [["pan", 50, 0], ["dolly", 0.5, 200, 100]]);
  send("pointercancel", { pointerId: 1 });
  send("pointercancel", { pointerId: 2 });
  assert.deepEqual(log.at(-1), ["rest"]);
});

test("the wheel scrolls the page until the figure has the focus, or Ctrl is held", () => {
  const { send, log, focus, blur } = hands();
  assert.equal(send("wheel", { deltaY: 100 }), true);
  assert.deepEqual(log, []);
  assert.equal(send("wheel", { deltaY: 10, ctrlKey: true }), false);
  focus();
  assert.equal(send("wheel", { deltaY: -100, offsetX: 7, offsetY: 8 }), false);
  assert.deepEqual(log, [["dolly", 1.06, 0, 0], ["dolly", 0.89, 7, 8]]);
  blur();
});

test("keys turn, shift, come nearer and go home; all others are the page's", () => {
  const { send, log } = hands();
  for (const key of ["ArrowLeft", "ArrowUp", "+", "-", "0"]) assert.equal(send("keydown", { key }), false);
  send("keydown", { key: "ArrowRight", shiftKey: true });
  assert.deepEqual(log.map(([name]) => name), ["turn", "turn", "zoom", "zoom", "home", "shift"]);
  assert.deepEqual(log[0], ["turn", -0.09, 0]);
  for (const more of [{ key: " " }, { key: "a" }, { key: "ArrowLeft", altKey: true }, { key: "0", ctrlKey: true }]) {
    assert.equal(send("keydown", more), true);
  }
  assert.equal(log.length, 6);
});

test("a mouse that hovers is told, a finger is not; after the end nothing is", () => {
  const { gestures, send, log } = hands();
  send("pointermove", { offsetX: 3, offsetY: 4 });
  send("pointermove", { offsetX: 3, offsetY: 4, pointerType: "touch" });
  send("pointerleave");
  assert.deepEqual(log, [["hover", 3, 4], ["leave"]]);
  gestures.dispose();
  send("pointermove", { offsetX: 3, offsetY: 4 });
  assert.equal(log.length, 2);
});

test("a pointer that somebody else took is left alone", () => {
  const { gestures, canvas, send } = hands();
  const event = Object.assign(new Event("pointerdown", { cancelable: true }), { pointerId: 5, button: 0 });
  event.preventDefault();
  canvas.dispatchEvent(event);
  assert.equal(gestures.busy, false);
  send("pointerdown");
  assert.equal(gestures.busy, true);
});
