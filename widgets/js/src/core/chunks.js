/**
 * Chunks: arrays of one type and shape, packed together as they travel, and unpacked here.
 *
 * `raw` is byte-shuffled: all first bytes, all second bytes, and so on. `u16` has whole numbers from 0 to 65535 between
 * `lo` and `hi` of each column, in the order array, column, row; of each array the differences to the one before (of
 * the first: to the row before), all low bytes and then all high ones. `u16s` is for surfaces that deform: of each
 * array the differences to where it would be if it moved on as before, and of these to the row before, small ones of
 * either sign as small numbers. All are deflated (RFC 1951), in base 64. `plain` is what a live kernel sends: the
 * arrays one after another, as they are. Where a message can carry bytes beside itself, `data` may be these.
 */
import { list, object, oneOf, own, ref, refuse, row, whole } from "./checks.js";
import { WireError } from "./errors.js";
import { bytes } from "./numbers.js";

/** @typedef {import("./types.js").Blob} Blob */

/** No chunk unpacks to more bytes than this. */
export const MOST_BYTES = 512 * 2 ** 20;

const DTYPES = /** @type {const} */ (["f32", "u32"]);
const ENCODINGS = /** @type {const} */ (["raw", "u16", "u16s", "plain"]);

/**
 * @param {any} value a chunk as it travelled
 * @param {string} [path]
 * @returns {Promise<Map<string, Blob>>} by reference; each array has a buffer of its own
 */
export async function decode(value, path = "chunk") {
  const chunk = object(value, path);
  const refs = list(own(chunk, "refs"), `${path}.refs`).map((one, i) => ref(one, `${path}.refs[${i}]`));
  const dtype = oneOf(own(chunk, "dtype"), `${path}.dtype`, DTYPES);
  const encoding = oneOf(own(chunk, "encoding"), `${path}.encoding`, ENCODINGS);
  const shape = Object.freeze(list(own(chunk, "shape"), `${path}.shape`, 2, 1).map((n, i) => (
    whole(n, `${path}.shape[${i}]`, i, 2 ** 31) // no columns are no array
  )));
  const size = shape[0] * (shape[1] ?? 1);
  const count = refs.length * size;
  if (count * 4 > MOST_BYTES) throw new WireError(path, `expected at most ${MOST_BYTES} bytes, got ${count * 4}`);
  const coarse = encoding !== "raw" && encoding !== "plain";
  if (coarse && dtype !== "f32") refuse(`${path}.encoding`, "raw for u32", encoding);
  const width = coarse ? 2 : 4;
  const ranges = coarse ? rangesOf(chunk, path, shape[1] ?? 1) : [];
  const data = own(chunk, "data");
  const sent = data instanceof Uint8Array ? data : bytes(data, `${path}.data`, MOST_BYTES);
  const packed = /** @type {Uint8Array<ArrayBuffer>} */ (sent);
  const planes = encoding === "plain"
    ? asLong(packed, `${path}.data`, count * width)
    : await inflate(packed, `${path}.data`, count * width);
  const arrays = coarse
    ? spread(planes, shape, refs.length, ranges, encoding === "u16s")
    : refs.map((_, i) => (encoding === "plain" ? cut : unshuffled)(planes, dtype, i * size, size));
  /** @type {Map<string, Blob>} */
  const made = new Map();
  refs.forEach((one, i) => {
    const array = arrays[i];
    if (array instanceof Float32Array) requireFinite(array, path);
    made.set(one, Object.freeze({ ref: one, array, shape, top: topOf(array) }));
  });
  return made;
}

/** Exactly so many bytes, or an error; never unpacks more. @param {Uint8Array<ArrayBuffer>} packed @param {string} path
 * @param {number} count */
export async function inflate(packed, path, count) {
  const parts = [];
  let filled = 0;
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  const reader = stream.getReader();
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      if (filled + value.length > count) throw new WireError(path, `expected ${count} bytes, got more`);
      parts.push(value);
      filled += value.length;
    }
  } catch (error) {
    reader.cancel().catch(() => undefined); // it has failed already
    throw error instanceof WireError ? error : new WireError(path, "expected deflated bytes");
  }
  if (filled !== count) throw new WireError(path, `expected ${count} bytes, got ${filled}`);
  const made = new Uint8Array(count);
  let at = 0;
  for (const part of parts) {
    made.set(part, at);
    at += part.length;
  }
  return made;
}

/** @param {Uint8Array<ArrayBuffer>} data @param {string} path @param {number} count */
function asLong(data, path, count) {
  if (data.length !== count) throw new WireError(path, `expected ${count} bytes, got ${data.length}`);
  return data;
}

/** So many items from one on, of bytes that may lie anywhere. @param {Uint8Array<ArrayBuffer>} data
 * @param {"f32"|"u32"} dtype @param {number} start @param {number} size */
function cut(data, dtype, start, size) {
  const items = data.slice(4 * start, 4 * (start + size));
  return dtype === "f32" ? new Float32Array(items.buffer) : new Uint32Array(items.buffer);
}

/** So many items from one on. @param {Uint8Array} planes @param {"f32"|"u32"} dtype @param {number} start
 * @param {number} size */
function unshuffled(planes, dtype, start, size) {
  const count = planes.length / 4;
  const items = new Uint8Array(4 * size);
  for (let plane = 0; plane < 4; plane++) {
    for (let i = 0, from = plane * count + start, to = plane; i < size; i++, to += 4) items[to] = planes[from + i];
  }
  return dtype === "f32" ? new Float32Array(items.buffer) : new Uint32Array(items.buffer);
}

/** @param {Uint8Array} planes @param {readonly number[]} shape @param {number} count of arrays
 * @param {number[][]} ranges of the columns @param {boolean} smooth whether neighbours move alike */
function spread(planes, shape, count, [lo, hi], smooth) {
  const [rows, columns = 1] = shape;
  const size = rows * columns;
  const half = count * size;
  const steps = new Uint16Array(size);
  const speeds = new Uint16Array(size);
  const arrays = [];
  for (let one = 0, i = 0; one < count; one++) {
    const made = new Float32Array(size);
    arrays.push(made);
    for (let column = 0, at = 0; column < columns; column++) {
      const low = lo[column];
      const range = hi[column] - low;
      let last = 0;
      for (let r = 0, to = column; r < rows; r++, at++, i++, to += columns) {
        const delta = planes[i] | (planes[half + i] << 8);
        last = smooth ? last + ((delta >>> 1) ^ -(delta & 1)) : (one === 0 ? last : steps[at]) + delta;
        if (smooth && one > 0) speeds[at] += last;
        steps[at] = smooth && one > 0 ? steps[at] + speeds[at] : last; // modulo 65536, as these arrays are
        made[to] = low + (steps[at] / 65535) * range;
      }
    }
  }
  return arrays;
}

/** @param {Record<string, any>} chunk @param {string} path @param {number} columns */
function rangesOf(chunk, path, columns) {
  const lo = row(own(chunk, "lo"), `${path}.lo`, columns);
  const hi = row(own(chunk, "hi"), `${path}.hi`, columns);
  lo.forEach((low, i) => {
    if (low > hi[i]) throw new WireError(`${path}.lo[${i}]`, `expected at most ${hi[i]}, got ${low}`);
  });
  return [lo, hi];
}

/** @param {Float32Array} array @param {string} path */
function requireFinite(array, path) {
  for (let i = 0; i < array.length; i++) {
    if (!Number.isFinite(array[i])) throw new WireError(path, `expected finite numbers, got ${array[i]} at ${i}`);
  }
}

/** The largest index. @param {Float32Array|Uint32Array} array */
function topOf(array) {
  let top = -1;
  if (array instanceof Uint32Array) for (let i = 0; i < array.length; i++) if (array[i] > top) top = array[i];
  return top;
}
