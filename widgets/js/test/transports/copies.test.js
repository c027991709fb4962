/** Private copies as a transport: a script goes first, again after each break; an end is an end. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { socket } from "../../src/transports/socket.js";

const turn = () => new Promise((resolve) => { setTimeout(resolve, 0); });

/** A server of copies: says what it hears, and answers what the test wants. */
class Server {
  /** @type {any[]} */ heard = [];
  /** @type {any[]} */ sockets = [];
  /** @type {any[]} */ problems = [];
  /** @type {string[]} */ ended = [];
  line = socket("ws://test/copy/it", {
    connect: () => this.#socket(),
    later: (act) => { setTimeout(act, 0); },
    onEnded: (reason) => { this.ended.push(reason); },
  });

  #socket() {
    /** @type {any} */
    const made = {
      send: (/** @type {string} */ text) => {
        const message = JSON.parse(text);
        this.heard.push(message);
        setTimeout(() => made.onmessage?.({ data: JSON.stringify(this.#reply(message)) }), 0);
      },
      close: () => undefined,
      end: (/** @type {number} */ code, /** @type {string} */ reason) => made.onclose({ code, reason }),
    };
    this.sockets.push(made);
    setTimeout(() => made.onopen(), 0);
    return made;
  }

  /** @param {any} message */
  #reply({ id, type }) {
    if (type === "script" && this.problems.length) return { id, type: "problems", problems: this.problems };
    if (type === "script") return { id, type: "edited" };
    return { id, type: "manifest", manifest: { revision: 1, nodes: [], values: [], parameters: [], handles: [] } };
  }

  get types() {
    return this.heard.map(({ type }) => type);
  }
}

test("a script is sent before anything is asked, and again when the connection is a new one", async () => {
  const server = new Server();
  assert.deepEqual(await server.line.edit("one"), []);
  await server.line.open();
  assert.deepEqual(server.types, ["script", "open"]);
  server.sockets[0].end(1006, "");
  await server.line.open();
  assert.deepEqual(server.heard.slice(2, 3).map(({ type, text }) => [type, text]), [["script", "one"]]);
  assert.equal(server.sockets.length, 2);
});

test("a script with a mistake is not the one that is sent again", async () => {
  const server = new Server();
  await server.line.edit("one");
  server.problems = [{ line: 2, column: 3, text: "wrong" }, { line: "2", column: null, text: 7 }];
  assert.deepEqual(await server.line.edit("two"),
    [{ line: 2, column: 3, text: "wrong" }, { line: null, column: null, text: "7" }]);
  server.problems = [];
  server.sockets[0].end(1006, "");
  await server.line.open();
  assert.deepEqual(server.heard.filter(({ type }) => type === "script").map(({ text }) => text), ["one", "two", "one"]);
});

for (const [code, reason] of /** @type {[number, string][]} */ ([[4001, "it broke"], [4002, "all are taken"]])) {
  test(`after ${code} nobody is called again, and whoever asked is told why`, async () => {
    const server = new Server();
    await server.line.edit("one");
    const asked = server.line.open();
    server.sockets[0].end(code, reason);
    await assert.rejects(asked, { message: reason });
    await turn();
    await turn();
    assert.deepEqual(server.ended, [reason]);
    assert.equal(server.sockets.length, 1);
    await assert.rejects(server.line.open(), /closed/);
  });
}

test("news of a script that are none are an error of whoever asked", async () => {
  const server = new Server();
  server.problems = /** @type {any} */ ([null]);
  await assert.rejects(server.line.edit("one"), /problems\[0\]/);
});
