/** Answers as they come: their outlines are checked here, what is in them by those who keep it. */
import { list, object, own, whole } from "./checks.js";
import { WireError } from "./errors.js";

/** No message unpacks to more bytes than this. */
const MOST_BYTES = 2 ** 31;

/** @param {any} value @param {number} seq of the ask */
export function readAnswer(value, seq) {
  const answer = object(value, "answer");
  if (own(answer, "seq") !== seq) throw new WireError("answer.seq", `expected ${seq}, got another one`);
  return {
    revision: whole(own(answer, "revision"), "answer.revision", 0, Number.MAX_SAFE_INTEGER),
    segments: list(own(answer, "segments"), "answer.segments"),
    blobs: readChunks(own(answer, "blobs"), "answer.blobs"),
  };
}

/** @param {any} value @param {string} path */
export function readChunks(value, path) {
  const chunks = list(value, path, 100_000);
  let bytes = 0;
  for (const chunk of chunks) {
    const refs = own(object(chunk, path), "refs");
    const shape = own(chunk, "shape");
    if (!Array.isArray(refs) || !Array.isArray(shape)) continue; // is refused when it is unpacked
    bytes += 4 * refs.length * shape.slice(0, 2).reduce((size, n) => size * (Number.isInteger(n) ? n : 1), 1);
  }
  if (bytes > MOST_BYTES) throw new WireError(path, `expected at most ${MOST_BYTES} bytes, got ${bytes}`);
  return chunks;
}
