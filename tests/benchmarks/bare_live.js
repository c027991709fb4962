// A bare page that asks a server: three.js draws the points that it is answered, and nothing else.
import { stage } from "./bare_stage.js";

/** A message of the server's: the length of its JSON, the JSON, and the arrays of its chunks. @param {any} data */
function unpacked(data) {
  if (typeof data === "string") return { message: JSON.parse(data), arrays: new Map() };
  const length = new DataView(data).getUint32(0, true);
  const message = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
  const arrays = new Map();
  let at = 4 + length;
  const parts = message.buffers.map((/** @type {number} */ size) => {
    at += size;
    return data.slice(at - size, at);
  });
  for (const { refs, dtype, data: { buffer } } of message.blobs) {
    arrays.set(refs[0], new (dtype === "f32" ? Float32Array : Uint32Array)(parts[buffer]));
  }
  return { message, arrays };
}

/**
 * @param {{address: string, node: string, parameter: string, value: number, color: number[]}} what
 * @param {HTMLCanvasElement} canvas
 * @param {HTMLInputElement} slider that is moved with the value
 * @param {HTMLElement} number that says it
 * @returns {Promise<(value: number) => Promise<void>>} draws the node with the parameter at another value
 */
async function begin({ address, node, parameter, value, color }, canvas, slider, number) {
  const socket = new WebSocket(address);
  socket.binaryType = "arraybuffer";
  /** @type {Map<number, (reply: any) => void>} */
  const waiting = new Map();
  socket.onmessage = ({ data }) => {
    const found = unpacked(data);
    waiting.get(found.message.id)?.(found);
    waiting.delete(found.message.id);
  };
  await new Promise((done) => { socket.onopen = done; });
  let ids = 0;
  const ask = (/** @type {any} */ message) => new Promise((done) => {
    waiting.set(++ids, done);
    socket.send(JSON.stringify({ id: ids, ...message }));
  });
  const { message: { manifest } } = await ask({ type: "open" });
  const asked = (/** @type {number} */ wish, /** @type {string[]} */ channels) => ask({
    type: "ask", seq: 1, revision: manifest.revision, times: [0], channels,
    parameters: { ...manifest.point.parameters, [parameter]: wish },
  });
  const first = await asked(value, [`${node}#points`, `${node}#topology`]);
  const track = (/** @type {any} */ { message: { segments } }, /** @type {string} */ channel) => (
    segments.find((/** @type {any} */ segment) => segment.channel === channel).track
  );
  const topology = track(first, `${node}#topology`).value;
  const origin = topology.origin === null ? null : first.arrays.get(topology.origin);
  const points = first.arrays.get(track(first, `${node}#points`).ref);
  const faces = first.arrays.get(topology.faces);
  const count = origin?.length ?? points.length / 3;
  const drawn = stage({ faces, count, color, view: manifest.view }, canvas);
  const draw = (/** @type {Float32Array} */ array) => {
    if (origin === null) drawn.array.set(array);
    else {
      for (let i = 0; i < origin.length; i++) {
        for (let k = 0; k < 3; k++) drawn.array[3 * i + k] = array[3 * origin[i] + k];
      }
    }
    drawn.draw();
  };
  draw(points);
  return async (wish) => {
    slider.valueAsNumber = wish;
    number.textContent = wish.toFixed(2);
    const reply = await asked(wish, [`${node}#points`]);
    draw(reply.arrays.get(track(reply, `${node}#points`).ref));
  };
}

globalThis.begin = begin;
