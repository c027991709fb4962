/** Lists of numbers as they travel: written out, or as base64 of their little-endian bytes. */
import { list, MOST, object, own, refuse, text } from "./checks.js";
import { WireError } from "./errors.js";

/** The bytes that base64 says. @param {any} value @param {string} path @param {number} most bytes */
export function bytes(value, path, most) {
  const encoded = text(value, path, Math.ceil(most / 3) * 4 + 4);
  let binary;
  try {
    binary = atob(encoded);
  } catch {
    throw new WireError(path, "expected base64");
  }
  const made = new Uint8Array(binary.length);
  for (let i = 0; i < made.length; i++) made[i] = binary.charCodeAt(i);
  return made;
}

/**
 * @param {any} value `[1, 2.5]`, `{f64: "…"}` or `{f32: "…"}`; NaN is refused
 * @param {string} path
 * @param {{count?: number, least?: number, borders?: boolean}} [expected] borders: the first may be -∞, the last ∞
 *   (null in a list)
 */
export function numbers(value, path, { count, least = 0, borders = false } = {}) {
  const made = Array.isArray(value) ? fromList(value, path, borders) : fromBytes(object(value, path), path);
  const last = made.length - 1;
  for (let i = 0; i <= last; i++) {
    const x = made[i];
    if (Number.isFinite(x) || (borders && ((i === 0 && x === -Infinity) || (i === last && x === Infinity)))) continue;
    refuse(`${path}[${i}]`, "a finite number", x);
  }
  if (made.length < least || (count !== undefined && made.length !== count)) {
    throw new WireError(path, `expected ${count ?? `at least ${least}`} numbers, got ${made.length}`);
  }
  return made;
}

/** @param {any[]} value @param {string} path @param {boolean} borders */
function fromList(value, path, borders) {
  list(value, path, MOST.numbers);
  const made = new Float64Array(value.length);
  for (let i = 0; i < value.length; i++) {
    if (typeof value[i] === "number") made[i] = value[i];
    else if (borders && value[i] === null && i === 0) made[i] = -Infinity;
    else if (borders && value[i] === null && i === value.length - 1) made[i] = Infinity;
    else refuse(`${path}[${i}]`, "a number", value[i]);
  }
  return made;
}

/** @param {Record<string, any>} value @param {string} path */
function fromBytes(value, path) {
  const isWide = own(value, "f64") !== undefined;
  const size = isWide ? 8 : 4;
  const raw = bytes(own(value, isWide ? "f64" : "f32"), `${path}.${isWide ? "f64" : "f32"}`, MOST.numbers * size);
  if (raw.length % size) throw new WireError(path, `expected a multiple of ${size} bytes, got ${raw.length}`);
  // Little-endian, as every machine that runs browsers.
  return isWide ? new Float64Array(raw.buffer) : Float64Array.from(new Float32Array(raw.buffer));
}

/** Times that do not decrease.
 * @param {any} value @param {string} path @param {Parameters<typeof numbers>[2]} [expected] */
export function ascending(value, path, expected) {
  const made = numbers(value, path, expected);
  for (let i = 1; i < made.length; i++) {
    if (made[i] < made[i - 1]) {
      throw new WireError(`${path}[${i}]`, `expected ascending times, got ${made[i]} after ${made[i - 1]}`);
    }
  }
  return made;
}

/** How many of the ascending times are at or before t. @param {ArrayLike<number>} times @param {number} t */
export function bisect(times, t) {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle + 1;
    else high = middle;
  }
  return low;
}
