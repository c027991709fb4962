/**
 * Who goes and asks: at most two asks are under way, and what they bring is checked, unpacked and put where it belongs.
 *
 * The courier knows of which revision the answers are. What an edit cut is forgotten; an answer that is older than what
 * is known by now is kept as far as no edit touched it, and one that overtook the news of its own revision makes
 * everything before it doubtful.
 */
import { readAnswer, readChunks } from "./answers.js";
import { decode } from "./chunks.js";
import { readStale } from "./manifests.js";
import { Revisions } from "./revisions.js";
import { canonical } from "./segments.js";

/**
 * @typedef {import("./types.js").Parameters} Parameters
 * @typedef {import("./types.js").Transport} Transport
 * @typedef {import("./types.js").Stale} Stale
 * @typedef {Readonly<{time: number, parameters: Parameters}>} Place
 */

const MOST_ASKS = 2;
const MOST_PLACES = 1_000; // of which it is remembered that something was not answered there

/** A place as a text. @param {Place} place */
export function keyOfPlace({ time, parameters }) {
  return `${time}|${canonical(parameters)}`;
}

export class Courier {
  #revisions;
  /** What was asked for at a place and not answered, by the place. @type {Map<string, Set<string>>} */
  #refused = new Map();
  /** Arrays that were asked for, and did not come. @type {Set<string>} */
  #lost = new Set();
  /** @type {Map<number, {parameters: Parameters, times: readonly number[]}|null>} */
  #asks = new Map();
  #seq = 0;
  isClosed = false;

  /**
   * @param {Transport} transport
   * @param {import("./store.js").ChannelStore} store
   * @param {import("./blobs.js").BlobStore} blobs
   * @param {number} revision of the manifest
   */
  constructor(transport, store, blobs, revision) {
    this.transport = transport;
    this.store = store;
    this.blobs = blobs;
    this.#revisions = new Revisions(revision);
  }

  get revision() {
    return this.#revisions.current;
  }

  /** How many asks are under way. */
  get count() {
    return this.#asks.size;
  }

  get isBusy() {
    return this.#asks.size >= MOST_ASKS;
  }

  /** The times that are being asked for, with these parameters. @param {Parameters} parameters */
  times(parameters) {
    return [...this.#asks.values()].flatMap((ask) => (ask?.parameters === parameters ? ask.times : []));
  }

  /** Whether a channel was asked for at a place, and there was no answer.
   * @param {string} key of the place @param {string} channel */
  isRefused(key, channel) {
    return this.#refused.get(key)?.has(channel) ?? false;
  }

  /** @param {string} ref */
  isLost(ref) {
    return this.#lost.has(ref);
  }

  /** Ask for channels at a place. Raises what went wrong. @param {Place} place @param {string[]} channels
   * @param {boolean} [plays] whether time runs */
  async ask(place, channels, plays = false) {
    const { time, parameters } = place;
    const { isNew } = await this.#go(parameters, [time], channels, plays);
    if (!isNew) return;
    const silent = channels.filter((channel) => this.store.find(channel, time, parameters) === null);
    this.#refuse(keyOfPlace(place), silent);
  }

  /** Ask for channels at instants at which time will be. Raises what went wrong. @param {Parameters} parameters
   * @param {import("./aheads.js").Plan} plan @returns {Promise<number>} how many bytes of arrays came */
  async askAhead(parameters, { times, channels }) {
    return (await this.#go(parameters, times, channels, true)).bytes;
  }

  /** @param {Parameters} parameters @param {number[]} times @param {string[]} channels @param {boolean} plays
   * @returns {Promise<{isNew: boolean, bytes: number}>} whether it is of the revision that is known */
  async #go(parameters, times, channels, plays) {
    const seq = ++this.#seq;
    this.#asks.set(seq, { parameters, times });
    try {
      const ask = { seq, revision: this.revision, parameters, times, channels, ...plays && { plays } };
      const { revision, segments, blobs } = readAnswer(await this.transport.ask(ask), seq);
      const bytes = await this.#unpack(blobs);
      return { isNew: !this.isClosed && this.#keep(revision, segments), bytes };
    } finally {
      this.#asks.delete(seq);
    }
  }

  /** Ask for arrays that went. Raises what went wrong. @param {string[]} refs */
  async need(refs) {
    const seq = ++this.#seq;
    this.#asks.set(seq, null);
    try {
      await this.#unpack(readChunks(await this.transport.need(refs), "chunks"));
      for (const ref of refs) if (!this.blobs.has(ref)) this.#lost.add(ref);
    } finally {
      this.#asks.delete(seq);
    }
  }

  /** Forget what an edit touched. @param {any} message @returns {Stale["spans"]} */
  cut(message) {
    const { revision, spans } = readStale(message);
    this.#revisions.cut(revision, this.store.cut(spans, revision));
    this.#refused.clear();
    this.#lost.clear();
    return spans;
  }

  /** Let go of arrays, if there are too many. @param {() => ReadonlySet<string>} inUse */
  tidy(inUse) {
    const gone = this.blobs.evict(inUse);
    if (gone.length > 0) this.transport.dropped(gone);
  }

  /** Put segments into the store, as far as they hold. @param {number} revision @param {any[]} segments
   * @returns {boolean} whether they are of the revision that is known */
  #keep(revision, segments) {
    if (revision > this.revision) {
      this.#revisions.leap(revision);
      this.store.cutAll(revision);
      this.#refused.clear();
    }
    const isLate = revision < this.revision;
    if (isLate && !this.#revisions.isKnown(revision)) return false;
    const left = isLate
      ? (/** @type {import("./segments.js").Segment} */ segment) => this.#revisions.left(revision, segment)
      : undefined;
    this.store.put(segments, revision, "answer.segments", left);
    return !isLate;
  }

  /** Unpack arrays and keep them, all or none. @param {any[]} chunks @returns {Promise<number>} bytes */
  async #unpack(chunks) {
    const made = await Promise.all(chunks.map((chunk, i) => decode(chunk, `blobs[${i}]`)));
    const blobs = made.flatMap((one) => [...one.values()]);
    for (const { ref } of blobs) this.#lost.delete(ref);
    this.blobs.put(blobs);
    return blobs.reduce((bytes, { array }) => bytes + array.byteLength, 0);
  }

  /** @param {string} key @param {string[]} channels */
  #refuse(key, channels) {
    if (channels.length === 0) return;
    if (this.#refused.size >= MOST_PLACES) this.#refused.clear();
    const known = this.#refused.get(key) ?? new Set();
    for (const channel of channels) known.add(channel);
    this.#refused.set(key, known);
  }
}
