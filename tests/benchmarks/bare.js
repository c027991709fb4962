// A bare page: three.js draws buffers that it was given, and nothing else. What our page is held against.
import { stage } from "./bare_stage.js";

/** @param {string} text @param {typeof Float32Array | typeof Uint32Array} kind */
function unpacked(text, kind) {
  return new kind(Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer);
}

/**
 * @param {{points: string[], faces: string, origin: string | null, view: any, color: number[]}} data
 * @param {HTMLCanvasElement} canvas
 */
function begin(data, canvas) {
  const frames = data.points.map((text) => /** @type {Float32Array} */ (unpacked(text, Float32Array)));
  const faces = /** @type {Uint32Array} */ (unpacked(data.faces, Uint32Array));
  const { color, view } = data;
  const { array, draw } = stage({ faces, count: frames[0].length / 3, color, view }, canvas);
  return (/** @type {number} */ k) => {
    array.set(frames[k]);
    draw();
  };
}

globalThis.begin = begin;
