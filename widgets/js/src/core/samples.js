/**
 * What is said of arrays: one (`ref`), or one for each tick (`samples`).
 *
 * The answer is a Sample: which array, and towards which other one on how much of the way. The arrays themselves are
 * somebody else's.
 *
 * @typedef {import("./playables.js").Playable} Playable
 * @typedef {import("./types.js").Interval} Interval
 */
import { finite, list, own, ref, refuse, truth } from "./checks.js";
import { always, NEVER, playable } from "./playables.js";

export class Sample {
  /** @param {string} a @param {string|null} b @param {number} mix from 0 (a) to 1 (b) */
  constructor(a, b = null, mix = 0) {
    this.a = a;
    this.b = b;
    this.mix = mix;
    Object.freeze(this);
  }
}

/** @param {Record<string, any>} track @param {string} path @returns {Playable} */
export function reference(track, path) {
  const sample = new Sample(ref(own(track, "ref"), `${path}.ref`));
  return playable(() => sample, always);
}

/** @param {Record<string, any>} track @param {string} path @returns {Playable} */
export function samples(track, path) {
  const start = finite(own(track, "start"), `${path}.start`);
  const step = finite(own(track, "step"), `${path}.step`);
  if (!(step > 0)) refuse(`${path}.step`, "a positive number", step);
  const refs = list(own(track, "refs"), `${path}.refs`, undefined, 1);
  const whole = refs.map((one, k) => new Sample(ref(one, `${path}.refs[${k}]`)));
  const blends = truth(own(track, "blend") ?? false, `${path}.blend`);
  const last = whole.length - 1;

  /** @param {number} k */
  const tick = (k) => start + k * step;
  /** The tick at or before t; exactly at one, that one, whatever the division was rounded to. @param {number} t */
  const before = (t) => {
    let k = Math.floor((t - start) / step);
    if (!(k >= 0)) return t >= tick(0) ? 0 : -1;
    if (k >= last) k = last;
    else if (t >= tick(k + 1)) k++;
    return k > 0 && t < tick(k) ? k - 1 : k;
  };
  /** @param {number} k */
  const moves = (k) => blends && k >= 0 && k < last && whole[k].a !== whole[k + 1].a;

  /** @param {number} t */
  const play = (t) => {
    const k = before(t);
    if (!moves(k)) return whole[Math.max(k, 0)];
    const mix = (t - tick(k)) / step;
    return mix <= 0 ? whole[k] : new Sample(whole[k].a, whole[k + 1].a, Math.min(mix, 1));
  };
  if (last === 0) return playable(() => whole[0], always);
  return playable(play, (t) => {
    const k = before(t);
    if (moves(k)) return NEVER;
    return [k < 0 ? -Infinity : tick(k), k === last ? Infinity : tick(k + 1)];
  });
}
