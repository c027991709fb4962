/** Answers as they come: their outlines are checked here, what is in them by those who keep it. */
import { list, object, own, whole } from "./checks.js";
import { WireError } from "./errors.js";

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
  return list(value, path, 100_000);
}
