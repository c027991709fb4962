import assert from "node:assert/strict";
import { test } from "node:test";
import { Session } from "../../src/core/session.js";
import { comm } from "../../src/transports/comm.js";
import { page } from "../fixtures/build.mjs";
import { kernel } from "./kernels.mjs";
import { rested } from "./puppets.mjs";

const data = () => JSON.parse(JSON.stringify(page({ rivets: 2, ticks: 5 })));
const pause = (/** @type {number} */ ms) => new Promise((done) => { setTimeout(done, ms); });

test("two views of one widget hear what is theirs", async () => {
  const port = kernel(data());
  const views = [comm(port), comm(port)];
  await Promise.all(views.map((view) => view.open()));
  const names = port.sent.map(({ view }) => view);
  assert.equal(new Set(names).size, 2);
  /** @type {any[]} */
  const heard = [[], []];
  views.forEach((view, i) => view.onStale((stale) => heard[i].push(stale)));
  port.say({ type: "stale", view: names[1], revision: 2, spans: [] });
  port.say({ type: "stale", revision: 3, spans: [] });
  await pause(10);
  assert.deepEqual(heard.map((/** @type {any[]} */ all) => all.length), [0, 1]);
});

test("an edit is asked for again, over the time where it was", async () => {
  const port = kernel(data());
  const session = new Session(comm(port));
  await session.open();
  await rested(session);
  const before = port.sent.length;
  port.say({ type: "stale", view: port.sent[0].view, revision: 2, spans: [["box#matrix", null, null]] });
  await pause(20);
  const asked = port.sent.slice(before).filter(({ type }) => type === "ask");
  assert.deepEqual(asked.map(({ channels }) => channels).slice(0, 1), [["box#matrix"]]);
  session.close();
});

test("an error is told to who asked, and so is silence", async () => {
  const port = kernel(data());
  const transport = comm({ ...port, send: (message) => port.send({ ...message, type: "what" }) });
  await assert.rejects(transport.open(), /no what/);
  const silent = comm({ send: () => undefined, listen: () => () => undefined }, { patience: 5 });
  await assert.rejects(silent.open(), /The kernel does not answer/);
});

test("who closes says so once, and hears no more", async () => {
  const port = kernel(data());
  const transport = comm(port);
  await transport.open();
  const waiting = transport.need(["0".repeat(32)]);
  transport.close();
  transport.close();
  await assert.rejects(waiting, /closed/);
  assert.deepEqual(port.sent.map(({ type }) => type), ["open", "need", "close"]);
  await assert.rejects(transport.need([]), /closed/);
});

test("other nodes are another figure", async () => {
  const port = kernel(data());
  let count = 0;
  await comm(port, { onReopen: () => { count++; } }).open();
  port.say({ type: "reopen", view: port.sent[0].view });
  await pause(10);
  assert.equal(count, 1);
});

test("a transport that was closed opens anew", async () => {
  // A notebook takes figures out of its page and puts them in again.
  let listeners = 0;
  const port = kernel(data());
  const transport = comm({
    send: (message) => port.send(message),
    listen: (listener) => {
      const off = port.listen(listener);
      listeners++;
      return () => { listeners--; off(); };
    },
  });
  for (let k = 0; k < 3; k++) {
    await transport.open();
    assert.equal(listeners, 1);
    transport.close();
    assert.equal(listeners, 0);
    await assert.rejects(transport.need([]), /closed/);
  }
  assert.deepEqual(port.sent.map(({ type }) => type), Array(3).fill(["open", "close"]).flat());
});
