/** A figure that is bound to an application: each is told of the other, and nothing goes round in a ring. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { bound } from "../../src/adapters/vue.js";

/** @param {Record<string, any>} parameters */
function tied(parameters = { length: 1 }) {
  const application = { time: /** @type {any} */ (undefined), parameters: /** @type {Record<string, any>} */ ({}) };
  /** @type {any[]} */ const told = [];
  /** @type {(() => void)[]} */ const later = [];
  const point = { time: 0, parameters: { ...parameters }, camera: null };
  const reader = {
    point,
    change: (/** @type {any} */ patch) => {
      Object.assign(point, patch.time === undefined ? {} : { time: patch.time });
      Object.assign(point.parameters, patch.parameters ?? {});
    },
  };
  const figure = /** @type {any} */ ({ reader });
  const given = { time: () => application.time, parameters: () => application.parameters };
  const tell = (/** @type {string} */ name, /** @type {any} */ value) => {
    told.push([name, value]);
    if (name === "update:time") application.time = value;
    else Object.assign(application.parameters, value);
  };
  const tie = bound(figure, given, tell, (act) => { later.push(act); });
  return { application, told, later, point, tie, figure };
}

test("what is not bound is told to nobody", () => {
  const { told, later, point, tie } = tied();
  point.time = 3;
  tie.moved();
  later.splice(0).forEach((act) => act());
  assert.deepEqual(told, []);
});

test("the application's values go before those of the figure; what it does not know it is told", () => {
  const { application, told, point, tie } = tied({ length: 1, count: 3 });
  application.time = null;
  application.parameters = { length: 2, count: null };
  tie.take();
  assert.deepEqual([point.parameters.length, told], [2, [["update:time", 0], ["update:parameters", { count: 3 }]]]);
});

test("many moves are one word, with the last of them", () => {
  const { application, told, later, point, tie } = tied();
  application.parameters = { length: 1 };
  for (const length of [1.1, 1.2, 1.3]) {
    point.parameters.length = length;
    tie.moved();
  }
  assert.equal(later.length, 1);
  later.splice(0).forEach((act) => act());
  assert.deepEqual(told, [["update:parameters", { length: 1.3 }]]);
  tie.take(); // the word comes back
  assert.equal(told.length, 1);
});

test("a value that is not allowed comes back as the one that is", () => {
  const { application, told, point, tie, figure } = tied();
  figure.reader.change = () => { point.parameters.length = 2; };
  application.parameters = { length: 9 };
  tie.take();
  assert.deepEqual(told, [["update:parameters", { length: 2 }]]);
});

test("before it lives and after it died a figure is told nothing", () => {
  const { application, told, tie, figure } = tied();
  figure.reader = null;
  application.time = 1;
  tie.take();
  assert.deepEqual(told, []);
});
