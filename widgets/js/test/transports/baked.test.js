import assert from "node:assert/strict";
import { test } from "node:test";
import { deflateRawSync } from "node:zlib";
import { WireError } from "../../src/core/errors.js";
import { Session } from "../../src/core/session.js";
import { baked } from "../../src/transports/baked.js";
import { page } from "../fixtures/build.mjs";

/** @param {string} text */
const squeezed = (text) => ({
  bytes: Buffer.byteLength(text),
  data: deflateRawSync(text).toString("base64"),
});

/** A page whose segments are deflated. @param {string} [text] */
function tight(text) {
  const data = page();
  return { ...data, segments: squeezed(text ?? JSON.stringify(data.segments)) };
}

/** @param {Parameters<typeof baked>[0]} data @returns {Promise<any>} what is shown first */
async function first(data) {
  const session = new Session(baked(data));
  await session.open();
  const snapshot = await new Promise((done) => session.on("commit", done));
  session.close();
  return snapshot;
}

test("segments that are deflated say what they said", async () => {
  const [plain, packed] = [await first(page()), await first(tight())];
  const told = (/** @type {any} */ { nodes, values }) => [
    [...nodes].map(([name, { drawn, color, matrix }]) => [name, drawn, color, [...matrix]]), [...values],
  ];
  assert.deepEqual(told(packed), told(plain));
  assert.ok(tight().segments.data.length < JSON.stringify(page().segments).length / 5);
});

test("a page that is opened twice is unpacked twice, and says the same", async () => {
  const data = tight();
  assert.deepEqual([...(await first(data)).values], [...(await first(data)).values]);
});

test("segments that are damaged are refused, with what is wrong", async () => {
  const { segments } = tight();
  /** @type {[any, RegExp][]} */
  const wrong = [
    [{ ...segments, bytes: segments.bytes - 1 }, /page\.segments\.data: expected \d+ bytes, got more/],
    [{ ...segments, bytes: segments.bytes + 1 }, /page\.segments\.data: expected \d+ bytes, got \d+/],
    [{ ...segments, bytes: 2 ** 40 }, /page\.segments\.bytes: expected a whole number from 0/],
    [{ ...segments, data: "AAAA" }, /page\.segments\.data: expected/],
    [{ ...segments, data: "%" }, /page\.segments\.data: expected base64/],
    [squeezed("[1"), /page\.segments: expected JSON/],
    [squeezed("{}"), /page\.segments: expected a list/],
    [squeezed("[1]"), /page\.segments\[0\]: expected an object/],
    ["segments", /page\.segments: expected an object/],
  ];
  for (const [one, message] of wrong) {
    const open = async () => baked(/** @type {any} */ ({ ...page(), segments: one })).open();
    await assert.rejects(open, (error) => error instanceof WireError && message.test(error.message), String(message));
  }
});
