/** A server's socket: it breaks and comes back, and the reader stays where they are. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { Session } from "../../src/core/session.js";
import { unpacked } from "../../src/transports/socket.js";
import { rested } from "../core/puppets.mjs";
import { still } from "../fixtures/build.mjs";
import { FakeServer, framed } from "./servers.mjs";

const turn = () => new Promise((resolve) => { setTimeout(resolve, 0); });
const turns = async (/** @type {number} */ count) => { for (let k = 0; k < count; k++) await turn(); };

async function opened() {
  const server = new FakeServer(still());
  const session = new Session(server.transport());
  await session.open();
  await rested(session);
  const asked = () => server.heard.filter(({ type }) => type === "ask");
  return { server, session, asked };
}

test("nothing is connected before it is asked for, and one figure has one connection", async () => {
  const server = new FakeServer(still());
  const transport = server.transport();
  assert.equal(server.sockets.length, 0);
  await Promise.all([transport.open(), transport.open(), transport.need([])]);
  assert.deepEqual([server.sockets.length, server.last.address, server.last.binaryType],
    [1, "ws://test/live/it", "arraybuffer"]);
  transport.close();
});

test("a connection that breaks at rest is opened again, and nothing is asked if nothing changed", async () => {
  const { server, session, asked } = await opened();
  const before = asked().length;
  const shown = session.snapshot;
  server.last.cut();
  await turns(10);
  assert.equal(server.sockets.length, 2);
  assert.equal(asked().length, before);
  assert.equal(session.snapshot, shown);
  session.close();
});

test("what was edited while nobody could say so is asked for again, at the reader's point", async () => {
  const { server, session, asked } = await opened();
  session.set({ time: 0.5 });
  await rested(session);
  const before = asked().length;
  server.revision += 3;
  server.last.cut();
  await turns(20);
  await rested(session);
  assert.ok(asked().length > before);
  assert.equal(asked().at(-1).times[0], 0.5);
  assert.deepEqual([session.snapshot?.time, session.snapshot?.revision], [0.5, server.revision]);
  session.close();
});

test("what was asked when it broke is asked again, and answered once", async () => {
  const server = new FakeServer(still());
  const transport = server.transport();
  const { revision } = await transport.open();
  server.isMute = true;
  const ask = { seq: 9, revision, parameters: {}, times: [0], channels: ["box#drawn"] };
  const answer = transport.ask(ask);
  await turns(3);
  server.isMute = false;
  server.last.cut();
  assert.equal((await answer).seq, 9);
  assert.deepEqual(server.heard.filter(({ type }) => type === "ask").map(({ seq }) => seq), [9, 9]);
  transport.close();
});

test("who asks while nobody answers is told after some attempts, and hears when somebody answers again", async () => {
  const { server, session } = await opened();
  /** @type {any[]} */
  const problems = [];
  session.on("problem", ({ text }) => problems.push(text));
  const transport = /** @type {import("../../src/core/types.js").Transport} */ (session.transport);
  server.isDown = true;
  server.last.cut();
  const ask = { seq: 1, revision: 1, parameters: {}, times: [0], channels: ["box#drawn"] };
  await assert.rejects(transport.ask(ask), /does not answer/);
  server.isDown = false;
  await turns(20);
  assert.equal((await transport.ask(ask)).seq, 1);
  assert.deepEqual(problems, []);
  session.close();
});

test("an error is told to who asked, and to nobody else", async () => {
  const server = new FakeServer(still());
  const transport = server.transport();
  const opening = transport.open();
  await turn();
  server.isMute = true;
  const needs = [transport.need(["a"]), transport.need(["b"])];
  await opening;
  const [one, other] = server.heard.filter(({ type }) => type === "need");
  server.tell({ id: one.id, type: "error", text: "refused: not you" });
  server.tell({ id: other.id, type: "blobs", blobs: [] });
  await assert.rejects(needs[0], /refused: not you/);
  assert.deepEqual(await needs[1], []);
  transport.close();
});

test("if there are other objects, whoever holds the figure opens it again", async () => {
  for (const happens of ["told", "missed"]) {
    const server = new FakeServer(still());
    let reopened = 0;
    const transport = server.transport({ onReopen: () => { reopened++; } });
    await transport.open();
    if (happens === "told") server.tell({ type: "reopen" });
    else {
      server.data.manifest.nodes = [];
      server.last.cut();
    }
    await turns(10);
    assert.equal(reopened, 1, happens);
    await assert.rejects(transport.open(), /closed/);
  }
});

test("after it was closed nothing is connected, and who waits is told", async () => {
  const server = new FakeServer(still());
  const transport = server.transport();
  await transport.open();
  server.isMute = true;
  const need = transport.need(["a"]);
  transport.close();
  await assert.rejects(need, /closed/);
  await turns(5);
  assert.equal(server.sockets.length, 1);
});

test("a frame's parts are where its JSON says, and nowhere else", () => {
  const bytes = new Uint8Array([1, 2, 3]);
  const message = { blobs: [{ data: { buffer: 1 } }, { data: { buffer: 0 } }] };
  const made = unpacked(framed(message, [bytes, new Uint8Array(0)]));
  assert.deepEqual(made.blobs.map((/** @type {any} */ { data }) => [...data]), [[], [1, 2, 3]]);
  const whole = framed(message, [bytes, new Uint8Array(0)]);
  const hostile = [
    new ArrayBuffer(0), new ArrayBuffer(3), new Uint8Array([255, 255, 255, 255, 0]).buffer, whole.slice(0, -1),
    framed({ blobs: [{ data: { buffer: 2 } }] }, [bytes]), framed({ blobs: [{ data: { buffer: -1 } }] }, [bytes]),
    framed({ blobs: [{ data: { buffer: "0" } }] }, [bytes]), framed({ blobs: 3 }, [bytes]), "[]", "null", "{",
  ];
  for (const data of hostile) assert.throws(() => unpacked(data));
});
