/** Between the stops of parameters: the weighted mean of the values at the stops round a point. */
import { Sample } from "./samples.js";

/** Several samples of arrays, each with a weight; the weights add up to 1. */
export class Mixture {
  /** @param {readonly Sample[]} samples @param {readonly number[]} weights */
  constructor(samples, weights) {
    this.samples = samples;
    this.weights = weights;
    Object.freeze(this);
  }
}

/** The mean of numbers, of lists of them, or of arrays; what cannot be mixed has to be equal, else undefined.
 * @param {readonly any[]} values @param {readonly number[]} weights @returns {any} */
export function mixed(values, weights) {
  const [first] = values;
  if (values.every((value) => value === first)) return first;
  if (values.every((value) => typeof value === "number")) return mean(values, weights);
  if (values.every((value) => value instanceof Sample)) return new Mixture(values, weights);
  const isRow = (/** @type {any} */ value) => (
    (Array.isArray(value) || value instanceof Float64Array) && value.length === first.length &&
    value.every((x) => typeof x === "number")
  );
  if (values.every(isRow)) {
    return Array.from(first, (_, i) => mean(values.map((value) => value[i]), weights));
  }
  const text = JSON.stringify(first);
  return values.every((value) => JSON.stringify(value) === text) ? first : undefined;
}

/** @param {readonly number[]} values @param {readonly number[]} weights */
function mean(values, weights) {
  let sum = 0;
  for (let i = 0; i < values.length; i++) sum += values[i] * weights[i];
  return sum;
}

/**
 * @typedef {import("./types.js").FloatBlob} FloatBlob
 * @typedef {import("./types.js").Points} Points
 */

/** Makes the arrays of mixtures, and keeps those that it made last: while time plays, they are asked for again. */
export class Mixer {
  /** @type {Map<string, FloatBlob>} */
  #made = new Map();
  #bytes = 0;

  /** @param {{budget?: number}} [options] bytes */
  constructor({ budget = 64 * 2 ** 20 } = {}) {
    this.budget = budget;
  }

  /** Where arrays differ in shape, the heaviest counts alone. @param {Mixture} mixture
   * @param {(ref: string) => FloatBlob} blob @returns {Points} */
  points({ samples, weights }, blob) {
    const [{ b, mix }] = samples;
    const isEven = samples.every((sample) => sample.mix === mix && (sample.b === null) === (b === null));
    if (isEven) {
      const from = this.#mean(samples.map((sample) => blob(sample.a)), weights);
      if (b === null) return { a: from, b: null, mix: 0 };
      const to = this.#mean(samples.map((sample) => blob(/** @type {string} */ (sample.b))), weights);
      return isAlike(from, to) ? { a: from, b: to, mix } : { a: from, b: null, mix: 0 };
    }
    const parts = samples.flatMap((sample, i) => (
      sample.b === null
        ? [{ blob: blob(sample.a), weight: weights[i] }]
        : [{ blob: blob(sample.a), weight: weights[i] * (1 - sample.mix) },
          { blob: blob(sample.b), weight: weights[i] * sample.mix }]
    ));
    return { a: this.#mean(parts.map((part) => part.blob), parts.map((part) => part.weight)), b: null, mix: 0 };
  }

  /** @param {readonly FloatBlob[]} blobs @param {readonly number[]} weights @returns {FloatBlob} */
  #mean(blobs, weights) {
    const heaviest = blobs[weights.indexOf(Math.max(...weights))];
    if (blobs.every((one) => one === heaviest) || !blobs.every((one) => isAlike(one, heaviest))) return heaviest;
    const ref = blobs.map((one, i) => `${one.ref}*${weights[i]}`).join("+");
    const known = this.#made.get(ref);
    if (known !== undefined) return known;
    const array = new Float32Array(heaviest.array.length);
    for (let i = 0; i < array.length; i++) {
      let sum = 0;
      for (let k = 0; k < blobs.length; k++) sum += blobs[k].array[i] * weights[k];
      array[i] = sum;
    }
    const made = Object.freeze({ ref, array, shape: heaviest.shape });
    this.#made.set(ref, made);
    this.#bytes += array.byteLength;
    for (const [old, blob] of this.#made) {
      if (this.#bytes <= this.budget || old === ref) break;
      this.#made.delete(old);
      this.#bytes -= blob.array.byteLength;
    }
    return made;
  }
}

/** @param {FloatBlob} a @param {FloatBlob} b */
function isAlike(a, b) {
  return a === b || (a.shape.length === b.shape.length && a.shape.every((n, i) => n === b.shape[i]));
}
