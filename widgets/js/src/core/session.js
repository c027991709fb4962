/**
 * One reader's view of one figure: where they are, what is shown, and who is asked for what is not known.
 *
 * A wish is a point that somebody wants to see. It is committed when everything in view is known there, all at once, as
 * an immutable snapshot; until then the last one stays. At most two asks are under way; the wish that waits is always
 * the newest, so a drag ends where it ended, whatever the transport takes.
 */
import { readAnswer, readChunks } from "./answers.js";
import { BlobStore } from "./blobs.js";
import { READERS } from "./channels.js";
import { decode } from "./chunks.js";
import { Emitter } from "./emitters.js";
import { WireError } from "./errors.js";
import { readManifest, readStale } from "./manifests.js";
import { changed } from "./parameters.js";
import { Revisions } from "./revisions.js";
import { Sample } from "./samples.js";
import { canonical } from "./segments.js";
import { spansOf } from "./spans.js";
import { ChannelStore } from "./store.js";
import { Watch } from "./watches.js";

/**
 * @typedef {import("./types.js").Manifest} Manifest
 * @typedef {import("./types.js").Parameters} Parameters
 * @typedef {import("./types.js").Snapshot} Snapshot
 * @typedef {import("./types.js").Transport} Transport
 * @typedef {import("./types.js").Problem} Problem
 * @typedef {import("./types.js").Stale} Stale
 * @typedef {import("./types.js").Span} Span
 *
 * @typedef {Readonly<{time: number, parameters: Parameters}>} Place
 *
 * @typedef {object} Wish
 * @property {number} seq
 * @property {Place} place
 * @property {string} key the place as a text
 * @property {boolean} isAsked whether an ask for it is under way
 * @property {number} tries
 * @property {boolean} isLost it was asked for, and that went wrong
 */

const MOST_ASKS = 2;
const MOST_TRIES = 16; // asks for one wish: more are a transport that goes round in circles

/**
 * Events: "point" when the reader is elsewhere, "commit" with what is to be shown, "stale" with the spans that were
 * cut, "wait" whether the picture is behind the point, "problem" with what went wrong beside the channels themselves.
 * @extends {Emitter<{point: Place, commit: Snapshot, stale: Stale["spans"], wait: boolean, problem: Problem}>}
 */
export class Session extends Emitter {
  /** @type {Manifest|null} */
  #manifest = null;
  /** @type {Watch|null} */
  #watch = null;
  /** @type {Wish|null} */
  #wish = null;
  /** @type {Snapshot|null} */
  #snapshot = null;
  #revisions = new Revisions(0);
  /** What was asked for at a place and not answered, by the place. @type {Map<string, Set<string>>} */
  #refused = new Map();
  /** @type {Set<string>} */
  #lost = new Set();
  /** @type {Map<number, number>} seq → time */
  #asks = new Map();
  /** @type {{key: string, parameters: Parameters, made: Span[]}|null} */
  #spans = null;
  #seq = 0;
  #wishes = 0;
  #committed = 0;
  #isWaiting = false;
  #isClosed = false;

  /**
   * @param {Transport} transport
   * @param {{store?: ChannelStore, blobs?: BlobStore}} [options]
   */
  constructor(transport, { store = new ChannelStore(), blobs = new BlobStore() } = {}) {
    super();
    this.transport = transport;
    this.store = store;
    this.blobs = blobs;
  }

  /** Read the manifest, and begin to ask. The first commit comes after this has resolved.
   * @returns {Promise<Manifest>} */
  async open() {
    const manifest = readManifest(await this.transport.open());
    if (this.#isClosed) return manifest;
    this.#manifest = manifest;
    this.#revisions = new Revisions(manifest.revision);
    this.store.stops = new Map(manifest.parameters.flatMap(({ name, stops }) => {
      const numbers = (stops ?? []).filter((stop) => typeof stop === "number");
      return numbers.length > 0 ? [[name, numbers]] : [];
    }));
    this.#watch = new Watch(manifest, this.store, this.blobs);
    this.transport.onStale((stale) => this.#cut(stale));
    const { time, parameters } = manifest.point;
    this.#wish = this.#wishFor(Object.freeze({ time, parameters }));
    setTimeout(() => this.#pump(), 0);
    return manifest;
  }

  get manifest() {
    if (this.#manifest === null) throw new Error("the session is not open: await session.open()");
    return this.#manifest;
  }

  /** Where the reader is. @returns {Place} */
  get point() {
    return this.#wish === null ? this.manifest.point : this.#wish.place;
  }

  /** What was committed last; null before the first time. */
  get snapshot() {
    return this.#snapshot;
  }

  get revision() {
    return this.#revisions.current;
  }

  /** Whether the picture is behind the point. */
  get isWaiting() {
    return this.#isWaiting;
  }

  /** Go elsewhere. Times and values are brought to the nearest that there are; what cannot be meant changes nothing.
   * @param {{time?: number, parameters?: Readonly<Record<string, any>>}} patch */
  set({ time, parameters = {} }) {
    const { times, parameters: all } = this.manifest;
    const before = this.point;
    const unknown = Object.keys(parameters).find((key) => !all.some(({ name }) => name === key));
    if (unknown !== undefined) throw new RangeError(`there is no parameter ${JSON.stringify(unknown)}`);
    if (time !== undefined && Number.isNaN(time)) throw new RangeError("time: expected a number, got NaN");
    const place = Object.freeze({
      time: time === undefined ? before.time : Math.min(Math.max(time, times.start), times.stop),
      parameters: isEmpty(parameters) ? before.parameters : changed(all, before.parameters, parameters),
    });
    if (place.time === before.time && place.parameters === before.parameters) return;
    this.#wish = this.#wishFor(place);
    this.emit("point", place);
    this.#pump();
  }

  /** A channel at any point, from what is known; null if it is not known, or has no value there, or is an array.
   * @param {string} channel @param {number} t @param {Parameters} [parameters] those of the point if left out */
  evaluate(channel, t, parameters = {}) {
    const all = Object.assign(Object.create(null), this.point.parameters, parameters);
    const found = this.store.find(channel, t, all);
    if (found === null || found.error !== null) return null;
    const kind = channel.slice(channel.lastIndexOf("#") + 1);
    try {
      const value = found.play(t, all);
      const read = Object.hasOwn(READERS, kind) ? READERS[kind](value) : value;
      return read instanceof Sample ? null : read;
    } catch (error) {
      if (error instanceof WireError) return null;
      throw error;
    }
  }

  /** What is known over an interval, for the parameters of the point. @param {number} start @param {number} stop
   * @returns {Span[]} */
  spans(start, stop) {
    if (this.#watch === null) return [];
    const { rate } = this.manifest.times;
    const asked = [...this.#asks.values()].join();
    const key = `${start} ${stop} ${this.store.version} ${asked}`;
    const known = this.#spans;
    if (known !== null && known.key === key && known.parameters === this.point.parameters) return known.made;
    const ticks = [...this.#asks.values()].map((time) => {
      const tick = Math.floor(time * rate + 1e-9);
      return /** @type {const} */ ([tick / rate, (tick + 1) / rate]);
    });
    const { parameters } = this.point;
    const made = spansOf(this.store, this.#watch.channels, [start, stop], parameters, ticks);
    this.#spans = { key, parameters, made };
    return made;
  }

  /** Ask nobody any more. */
  close() {
    if (this.#isClosed) return;
    this.#isClosed = true;
    this.transport.close();
    this.clear();
  }

  /** @param {Place} place @returns {Wish} */
  #wishFor(place) {
    const key = `${place.time}|${canonical(place.parameters)}`;
    return { seq: ++this.#wishes, place, key, isAsked: false, tries: 0, isLost: false };
  }

  /** See to it that the newest wish is committed, or asked for. */
  #pump() {
    const wish = this.#wish;
    if (wish === null || this.#isClosed || this.#committed >= wish.seq) return;
    const lack = this.#lack(wish);
    if (lack === null) {
      this.#commit(wish);
      return;
    }
    const { missing, wanted } = lack;
    // Arrays may come with the answers that are under way.
    const canAsk = missing.length > 0 ? this.#asks.size < MOST_ASKS : this.#asks.size === 0;
    if (canAsk && !wish.isAsked && !wish.isLost) {
      if (++wish.tries > MOST_TRIES) this.#lose(wish, `No answer after ${MOST_TRIES} asks.`);
      else this.#ask(wish, missing, wanted);
    }
    this.#wait(!wish.isLost);
  }

  /** What has to be asked for before a wish can be committed; null if nothing. @param {Wish} wish */
  #lack({ place: { time, parameters }, key }) {
    const refused = this.#refused.get(key);
    const scope = {
      isRefused: (/** @type {string} */ channel) => refused !== undefined && refused.has(channel),
      isLost: (/** @type {string} */ ref) => this.#lost.has(ref),
      missing: /** @type {string[]} */ ([]),
      wanted: /** @type {Set<string>} */ (new Set()),
    };
    return /** @type {Watch} */ (this.#watch).update(scope, time, parameters) ? null : scope;
  }

  /** @param {Wish} wish one that lacks nothing, and was looked at last */
  #commit(wish) {
    const { time, parameters } = wish.place;
    this.#committed = wish.seq;
    this.#snapshot = /** @type {Watch} */ (this.#watch).snapshot(this.revision, time, parameters);
    if (wish === this.#wish) this.#wait(false);
    this.emit("commit", this.#snapshot);
  }

  /** @param {boolean} isWaiting */
  #wait(isWaiting) {
    if (isWaiting === this.#isWaiting) return;
    this.#isWaiting = isWaiting;
    this.emit("wait", isWaiting);
  }

  /** Ask for channels, or if none is missing, for arrays.
   * @param {Wish} wish @param {string[]} missing @param {Set<string>} wanted */
  async #ask(wish, missing, wanted) {
    const seq = ++this.#seq;
    const { time, parameters } = wish.place;
    wish.isAsked = true;
    this.#asks.set(seq, time);
    try {
      if (missing.length > 0) {
        const ask = { seq, revision: this.revision, parameters, times: [time], channels: missing };
        await this.#take(await this.transport.ask(ask), seq, wish, missing);
      } else {
        const refs = [...wanted];
        await this.#keep(readChunks(await this.transport.need(refs), "chunks"));
        for (const ref of refs) if (!this.blobs.has(ref)) this.#lost.add(ref);
      }
    } catch (error) {
      this.#lose(wish, error instanceof Error ? error.message : String(error));
    }
    wish.isAsked = false;
    this.#asks.delete(seq);
    if (this.#isClosed) return;
    this.#pump();
    // Meanwhile the reader may be elsewhere, and that not be known yet: what was asked for is shown on the way.
    if (this.#committed < wish.seq && wish !== this.#wish && this.#lack(wish) === null) this.#commit(wish);
    // Only now is it known which of the arrays that came are in view.
    const gone = this.blobs.evict(() => /** @type {Watch} */ (this.#watch).refs);
    if (gone.length > 0) this.transport.dropped(gone);
  }

  /** @param {any} message @param {number} seq @param {Wish} wish @param {string[]} channels */
  async #take(message, seq, wish, channels) {
    const answer = readAnswer(message, seq);
    const { revision } = answer;
    await this.#keep(answer.blobs);
    if (this.#isClosed) return;
    if (revision > this.revision) {
      this.#revisions.leap(revision);
      this.store.cutAll(revision);
      this.#refused.clear();
    }
    const isLate = revision < this.revision;
    if (isLate && !this.#revisions.isKnown(revision)) return;
    this.store.put(answer.segments, revision, "answer.segments", isLate
      ? (segment) => this.#revisions.left(revision, segment)
      : undefined);
    if (isLate) return;
    const { time, parameters } = wish.place;
    this.#refuse(wish.key, channels.filter((channel) => this.store.find(channel, time, parameters) === null));
  }

  /** Unpack arrays and keep them, all or none. @param {any[]} chunks */
  async #keep(chunks) {
    const made = await Promise.all(chunks.map((chunk, i) => decode(chunk, `blobs[${i}]`)));
    const blobs = made.flatMap((one) => [...one.values()]);
    for (const { ref } of blobs) this.#lost.delete(ref);
    this.blobs.put(blobs);
  }

  /** @param {string} key @param {string[]} channels */
  #refuse(key, channels) {
    if (channels.length === 0) return;
    if (this.#refused.size > 1_000) this.#refused.clear();
    const known = this.#refused.get(key) ?? new Set();
    for (const channel of channels) known.add(channel);
    this.#refused.set(key, known);
  }

  /** @param {Wish} wish @param {string} text */
  #lose(wish, text) {
    wish.isLost = true;
    if (this.#isClosed) return;
    if (wish === this.#wish) this.#wait(false);
    this.emit("problem", Object.freeze({ channel: "", text }));
  }

  /** @param {any} message */
  #cut(message) {
    if (this.#isClosed) return;
    try {
      const { revision, spans } = readStale(message);
      this.#revisions.cut(revision, this.store.cut(spans, revision));
      this.#refused.clear();
      this.#lost.clear();
      this.#wish = this.#wishFor(this.point);
      this.emit("stale", spans);
    } catch (error) {
      if (!(error instanceof WireError)) throw error;
      this.emit("problem", Object.freeze({ channel: "", text: error.message }));
    }
    this.#pump();
  }
}

/** @param {object} value */
function isEmpty(value) {
  for (const key in value) if (Object.hasOwn(value, key)) return false;
  return true;
}
