/** Which revision of the model the answers are of, and what was cut since: so that a late answer can be trimmed. */
import { subtract } from "./intervals.js";

/** @typedef {import("./types.js").Interval} Interval */

const MOST = 20_000; // cuts that are remembered; beyond, no answer of an older revision is believed

export class Revisions {
  /** By channel. @type {Map<string, {revision: number, when: Interval}[]>} */
  #cuts = new Map();
  #count = 0;
  /** Cuts of later revisions than this one are all known. */
  #since;

  /** @param {number} current */
  constructor(current) {
    this.current = current;
    this.#since = current;
  }

  /** @param {number} revision @param {{channel: string, when: Interval}[]} spans */
  cut(revision, spans) {
    this.current = Math.max(this.current, revision);
    this.#count += spans.length;
    if (this.#count > MOST) {
      this.leap(this.current);
      return;
    }
    for (const { channel, when } of spans) {
      const known = this.#cuts.get(channel);
      if (known === undefined) this.#cuts.set(channel, [{ revision, when }]);
      else known.push({ revision, when });
    }
  }

  /** To a revision of which nobody said what it changed. @param {number} revision */
  leap(revision) {
    this.current = revision;
    this.#since = revision;
    this.#cuts = new Map();
    this.#count = 0;
  }

  /** Whether it is known what changed since a revision. @param {number} revision */
  isKnown(revision) {
    return revision >= this.#since;
  }

  /** What of an answer of that revision still holds.
   * @param {number} revision @param {{channel: string, start: number, stop: number}} segment @returns {Interval[]} */
  left(revision, { channel, start, stop }) {
    const cuts = (this.#cuts.get(channel) ?? []).filter((cut) => cut.revision > revision);
    return subtract([[start, stop]], cuts.map(({ when }) => when));
  }
}
