import assert from "node:assert/strict";
import { test } from "node:test";
import { Clock } from "../../src/core/clock.js";
import { Reader } from "../../src/ui/readers.js";
import { FakeSession, frames, manifest, parameter } from "./makings.js";

/** @param {import("../../src/core/types.js").Parameter[]} [parameters] @param {any} [more] */
function reading(parameters = [parameter("length")], more = {}) {
  const of = manifest(parameters, more);
  const display = frames();
  const session = new FakeSession(of);
  return { session, display, reader: new Reader(of, session, new Clock(display.host)) };
}

test("undo returns to where the reader was, camera and all, and redo goes there again", () => {
  const { reader } = reading();
  /** @type {any} */
  let eye = null;
  reader.watch({ own: () => eye, look: (wish) => { eye = wish; } });
  reader.change({ time: 3 });
  reader.change({ camera: { position: [1, 2, 3], target: [0, 0, 0] } });
  reader.undo();
  assert.equal(eye, null);
  assert.equal(reader.point.time, 3);
  reader.undo();
  assert.equal(reader.point.time, 0);
  reader.redo();
  reader.redo();
  assert.deepEqual(reader.point.camera, { position: [1, 2, 3], target: [0, 0, 0] });
});

test("a drag of a hundred moves is one step of undo", () => {
  const { reader } = reading();
  const gesture = reader.gestures.begin("length");
  for (let i = 1; i <= 100; i++) reader.change({ parameters: { length: i / 100 } }, { gesture });
  reader.undo();
  assert.equal(reader.point.parameters.length, 1);
  assert.equal(reader.canUndo, false);
});

test("wishes are brought to what is allowed before anybody is asked", () => {
  const { reader, session } = reading([parameter("length", { grade: "stops", stops: [0.5, 1, 1.5] })]);
  reader.change({ parameters: { length: 1.4, unknown: 3 } });
  assert.deepEqual(session.sets.at(-1).parameters, { length: 1.5 });
});

test("time plays, and goes on from where the reader scrubs to", () => {
  const { reader, display } = reading();
  reader.play();
  display.pass(0.1);
  assert.ok(Math.abs(reader.point.time - 0.1) < 1e-9);
  reader.change({ time: 5 });
  display.pass(0.2);
  assert.ok(Math.abs(reader.point.time - 5.2) < 1e-9);
  assert.equal(reader.isPlaying("time"), true);
});

test("a parameter plays as time does, and time stands still", () => {
  const { reader, display } = reading();
  reader.toggle("length");
  display.pass(0.1);
  assert.equal(reader.point.time, 0);
  assert.ok(Math.abs(Number(reader.point.parameters.length) - (1 + 0.1 * (2 / 6))) < 1e-9);
  assert.equal(reader.isPlaying("time"), false);
  reader.toggle("length");
  assert.equal(reader.isPlaying(), false);
});

test("what says pause pauses, whatever it is that plays", () => {
  const { reader } = reading();
  reader.toggle("length");
  reader.turn("time");
  assert.equal(reader.isPlaying(), false);
  reader.turn("time");
  assert.equal(reader.isPlaying("time"), true);
});

test("a baked parameter that plays goes from stop to stop", () => {
  const { reader, display, session } = reading([parameter("length", { grade: "stops", stops: [0, 1, 2], default: 0 })]);
  reader.toggle("length");
  for (let i = 0; i < 60; i++) display.pass(0.1);
  assert.deepEqual(session.sets.map((point) => point.parameters.length), [1, 2]);
});

test("what has played to the end begins anew", () => {
  const { reader } = reading();
  reader.change({ time: 10 });
  reader.play();
  assert.equal(reader.clock.value, 0);
});

test("undo while it plays stops it, and goes back to before the reader acted", () => {
  const { reader, display } = reading();
  reader.play();
  display.pass(0.2);
  reader.change({ parameters: { length: 2 } });
  display.pass(0.2);
  reader.undo();
  assert.equal(reader.isPlaying(), false);
  assert.equal(reader.point.parameters.length, 1);
  assert.ok(Math.abs(reader.point.time - 0.2) < 1e-9);
});

test("a follower shares time and what both know, in both directions, and keeps the rest to itself", () => {
  const leader = reading([parameter("length"), parameter("mass")]);
  const other = reading([parameter("length"), parameter("hue")]);
  leader.reader.change({ time: 2, parameters: { length: 0.5, mass: 2 } });
  other.reader.follow(leader.reader);
  assert.deepEqual(other.reader.point.parameters, { length: 0.5, hue: 1 });
  other.reader.change({ time: 4, parameters: { length: 1.5, hue: 0 } });
  assert.equal(leader.reader.point.time, 4);
  assert.deepEqual(leader.reader.point.parameters, { length: 1.5, mass: 2 });
  other.reader.toggle();
  leader.display.pass(0.1);
  assert.ok(Math.abs(other.reader.point.time - 4.1) < 1e-9);
  assert.equal(other.reader.isPlaying(), true);
});

test("an address is no step of undo, a reset is one", () => {
  const { reader } = reading();
  reader.jump({ time: 7 });
  assert.equal(reader.canUndo, false);
  reader.reset();
  assert.equal(reader.point.time, 0);
  reader.undo();
  assert.equal(reader.point.time, 7);
});

test("those who listen hear what the reader did, not what the clock does", () => {
  const { reader, display } = reading();
  /** @type {string[]} */
  const heard = [];
  reader.on("acted", (word) => heard.push(word));
  reader.play();
  display.pass(0.1);
  reader.change({ time: 1 });
  reader.undo();
  reader.jump({ time: 2 });
  assert.deepEqual(heard, ["moved", "undone", "jumped"]);
});
