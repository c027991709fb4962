/** Which revision of the model the answers are of, and what was cut since: so that a late answer can be trimmed. */
import { subtract } from "./intervals.js";

/** @typedef {import("./types.js").Interval} Interval */

const MOST = 20_000; // cuts that are remembered; answers older than the oldest of them are not believed

export class Revisions {
  /** @type {{revision: number, channel: string, when: Interval}[]} */
  #cuts = [];
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
    for (const { channel, when } of spans) this.#cuts.push({ revision, channel, when });
    const surplus = this.#cuts.length - MOST;
    if (surplus > 0) for (const old of this.#cuts.splice(0, surplus)) this.#since = Math.max(this.#since, old.revision);
  }

  /** To a revision of which nobody said what it changed. @param {number} revision */
  leap(revision) {
    this.current = revision;
    this.#since = revision;
    this.#cuts = [];
  }

  /** Whether it is known what changed since a revision. @param {number} revision */
  isKnown(revision) {
    return revision >= this.#since;
  }

  /** What of an answer of that revision still holds.
   * @param {number} revision @param {{channel: string, start: number, stop: number}} segment @returns {Interval[]} */
  left(revision, { channel, start, stop }) {
    const cuts = this.#cuts.filter((cut) => cut.revision > revision && cut.channel === channel);
    return subtract([[start, stop]], cuts.map(({ when }) => when));
  }
}
