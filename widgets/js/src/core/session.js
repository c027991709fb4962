/**
 * One reader's view of one figure: where they are, what is shown, and what has to be asked for.
 *
 * A wish is a point that somebody wants to see. It is committed when everything in view is known there, all at once, as
 * an immutable snapshot; until then the last one stays. At most two asks are under way; the wish that waits is always
 * the newest, so a drag ends where it ended, whatever the transport takes. While time plays, one of the two is for what
 * comes next.
 */
import { Ahead } from "./aheads.js";
import { BlobStore } from "./blobs.js";
import { READERS } from "./channels.js";
import { Courier, keyOfPlace } from "./couriers.js";
import { Emitter } from "./emitters.js";
import { WireError } from "./errors.js";
import { readManifest } from "./manifests.js";
import { changed } from "./parameters.js";
import { Sample } from "./samples.js";
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
 * @typedef {import("./couriers.js").Place} Place
 * @typedef {import("./aheads.js").Hand} Hand
 * @typedef {import("./aheads.js").Plan} Plan
 * @typedef {{time?: number, parameters?: Readonly<Record<string, any>>}} Patch
 *
 * @typedef {object} Wish
 * @property {number} seq
 * @property {Place} place
 * @property {string} key of the place
 * @property {boolean} isAsked whether an ask for it is under way
 * @property {number} tries
 * @property {boolean} isLost it was asked for, and that went wrong
 *
 * @typedef {{place: Place, channels: string[], done: () => void}} Lesson
 */

const MOST_TRIES = 16; // asks for one wish: more are a transport that goes round in circles
const MOST_LESSONS = 64; // that wait

/**
 * Events: "point" when the reader is elsewhere, "commit" with what is to be shown, "stale" with the spans that were
 * cut, "wait" whether the picture is behind the point, "problem" with what went wrong beside the channels themselves.
 * @extends {Emitter<{point: Place, commit: Snapshot, stale: Stale["spans"], wait: boolean, problem: Problem}>}
 */
export class Session extends Emitter {
  /** All that there is once the manifest is.
   * @type {{manifest: Manifest, watch: Watch, courier: Courier, ahead: Ahead}|null} */
  #parts = null;
  /** @type {Wish|null} */
  #wish = null;
  /** @type {Snapshot|null} */
  #snapshot = null;
  /** What is wanted for later, if nobody waits. @type {Lesson[]} */
  #lessons = [];
  /** What moves the reader on, while it does. @type {Hand|null} */
  #hand = null;
  /** What was asked before it is due. @type {Plan|null} */
  #plan = null;
  #dues = 0; // asks under way for a wish
  #isBlind = false; // what was asked ahead went wrong
  /** @type {{key: string, parameters: Parameters, made: Span[]}|null} */
  #spans = null;
  #wishes = 0;
  #committed = 0;
  #isWaiting = false;
  #isClosed = false;

  /**
   * @param {Transport} transport
   * @param {{store?: ChannelStore, blobs?: BlobStore, now?: () => number}} [options] now: milliseconds
   */
  constructor(transport, { store = new ChannelStore(), blobs = new BlobStore(), now = () => performance.now() } = {}) {
    super();
    this.now = now;
    this.transport = transport;
    this.store = store;
    this.blobs = blobs;
  }

  /** Read the manifest, and begin to ask. The first commit comes after this has resolved.
   * @returns {Promise<Manifest>} */
  async open() {
    const manifest = readManifest(await this.transport.open());
    if (this.#isClosed) return manifest;
    this.store.stops = new Map(manifest.parameters.flatMap(({ name, stops }) => {
      const numbers = (stops ?? []).filter((stop) => typeof stop === "number");
      return numbers.length > 0 ? [[name, numbers]] : [];
    }));
    const watch = new Watch(manifest, this.store, this.blobs);
    const courier = new Courier(this.transport, this.store, this.blobs, manifest.revision);
    this.#parts = { manifest, watch, courier, ahead: new Ahead(manifest, this.store, watch.scene) };
    this.transport.onStale((stale) => this.#cut(stale));
    const { time, parameters } = manifest.point;
    this.#wish = this.#wishFor(Object.freeze({ time, parameters }));
    setTimeout(() => this.#pump(), 0);
    return manifest;
  }

  get #open() {
    if (this.#parts === null) throw new Error("the session is not open: await session.open()");
    return this.#parts;
  }

  get manifest() {
    return this.#open.manifest;
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
    return this.#open.courier.revision;
  }

  /** Whether the picture is behind the point. */
  get isWaiting() {
    return this.#isWaiting;
  }

  /** What moves the reader on, while time plays. */
  get hand() {
    return this.#hand;
  }

  /** Go elsewhere. Times and values are brought to the nearest that there are; what cannot be meant changes nothing.
   * @param {Patch} patch @param {Hand|null} [hand] what goes there and further on, if it is not the reader */
  set(patch, hand = null) {
    const before = this.point;
    const place = this.#placeFor(patch);
    if (place.time === before.time && place.parameters === before.parameters) return;
    this.#wish = this.#wishFor(place);
    this.#hand = hand;
    if (hand === null) { // what was asked ahead may come or not
      this.#plan = null;
      this.#isBlind = false;
    }
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
      const value = found.play(t, all) ?? null;
      const read = value !== null && Object.hasOwn(READERS, kind) ? READERS[kind](value) : value;
      return read instanceof Sample ? null : read;
    } catch (error) {
      if (error instanceof WireError) return null;
      throw error;
    }
  }

  /** Ask for channels at other points, so that `evaluate` knows them. What is in view goes first; nothing is committed,
   * nobody is told, and what cannot be had is left out.
   * @param {string[]} channels @param {readonly Patch[]} points @returns {Promise<void>} */
  async learn(channels, points) {
    const lessons = points.map((patch) => this.#placeFor(patch)).map((place) => (
      new Promise((/** @type {(value: void) => void} */ done) => {
        this.#lessons.push({ place, channels, done });
      })
    ));
    for (const { done } of this.#lessons.splice(0, this.#lessons.length - MOST_LESSONS)) done();
    this.#pump();
    await Promise.all(lessons);
  }

  /** What is known over an interval, for the parameters of the point. @param {number} start @param {number} stop
   * @returns {Span[]} */
  spans(start, stop) {
    if (this.#parts === null) return [];
    const { manifest: { times: { rate } }, courier, watch } = this.#parts;
    const { parameters } = this.point;
    const times = courier.times(parameters);
    const key = `${start} ${stop} ${this.store.version} ${times.join()}`;
    if (this.#spans?.key === key && this.#spans.parameters === parameters) return this.#spans.made;
    const ticks = times.map((time) => {
      const tick = Math.floor(time * rate + 1e-9);
      return /** @type {const} */ ([tick / rate, (tick + 1) / rate]);
    });
    const made = spansOf(this.store, watch.channels, [start, stop], parameters, ticks);
    this.#spans = { key, parameters, made };
    return made;
  }

  /** Ask nobody any more. */
  close() {
    if (this.#isClosed) return;
    this.#isClosed = true;
    if (this.#parts !== null) this.#parts.courier.isClosed = true;
    for (const { done } of this.#lessons.splice(0)) done();
    this.transport.close();
    this.clear();
  }

  /** @param {Patch} patch @returns {Place} */
  #placeFor({ time, parameters = {} }) {
    const { times, parameters: all } = this.manifest;
    const before = this.point;
    const unknown = Object.keys(parameters).find((key) => !all.some(({ name }) => name === key));
    if (unknown !== undefined) throw new RangeError(`there is no parameter ${JSON.stringify(unknown)}`);
    if (time !== undefined && Number.isNaN(time)) throw new RangeError("time: expected a number, got NaN");
    return Object.freeze({
      time: time === undefined ? before.time : Math.min(Math.max(time, times.start), times.stop),
      parameters: isEmpty(parameters) ? before.parameters : changed(all, before.parameters, parameters),
    });
  }

  /** @param {Place} place @returns {Wish} */
  #wishFor(place) {
    return { seq: ++this.#wishes, place, key: keyOfPlace(place), isAsked: false, tries: 0, isLost: false };
  }

  /** See to it that the newest wish is committed, or asked for; then there is time for lessons. */
  #pump() {
    const wish = this.#wish;
    if (wish === null || this.#isClosed) return;
    const lack = this.#committed < wish.seq ? this.#lack(wish) : null;
    if (this.#committed < wish.seq && lack === null) this.#commit(wish);
    if (lack !== null) {
      const { courier } = this.#open;
      // Arrays may come with the answers that are under way.
      // While time plays, one ask is for what is due, and that only if nothing was asked ahead.
      const isFree = !courier.isBusy && (this.#hand === null || (this.#plan === null && this.#dues === 0));
      const canAsk = lack.missing.length > 0 ? isFree : courier.count === 0;
      if (canAsk && !wish.isAsked && !wish.isLost) {
        if (++wish.tries > MOST_TRIES) this.#lose(wish, `No answer after ${MOST_TRIES} asks.`);
        else this.#ask(wish, lack.missing, lack.wanted);
      }
      this.#wait(!wish.isLost);
    }
    this.#foresee();
    if (lack === null || wish.isLost) this.#teach();
  }

  /** Ask for what is due soon, if time plays, and what is here now was shown. */
  #foresee() {
    const { ahead, courier } = this.#open;
    const { parameters } = this.point;
    if (this.#hand === null || this.#plan !== null || this.#isBlind) return;
    // What was asked ahead for another point may be under way still: the other ask is for what the reader wants.
    if (courier.count > (this.#dues && 1)) return;
    if (this.#snapshot?.parameters !== parameters || this.#snapshot.revision !== this.revision) return;
    const plan = ahead.plan(parameters, this.#hand);
    if (plan === null) return;
    this.#plan = plan;
    const begun = this.now();
    courier.askAhead(parameters, plan).then(
      (bytes) => ahead.learn(plan, (this.now() - begun) / 1_000, bytes),
      () => { this.#isBlind = this.#plan === plan; }, // whoever asks for what is due is told why
    ).then(() => {
      if (this.#plan === plan) this.#plan = null;
      if (this.#isClosed) return;
      this.#pump();
      courier.tidy(() => this.#open.watch.refs);
    });
  }

  /** What has to be asked for before a wish can be committed; null if nothing. @param {Wish} wish */
  #lack({ place: { time, parameters }, key }) {
    const { courier, watch } = this.#open;
    const scope = {
      isRefused: (/** @type {string} */ channel) => courier.isRefused(key, channel),
      isLost: (/** @type {string} */ ref) => courier.isLost(ref),
      missing: /** @type {string[]} */ ([]),
      wanted: /** @type {Set<string>} */ (new Set()),
    };
    return watch.update(scope, time, parameters) ? null : scope;
  }

  /** @param {Wish} wish one that lacks nothing, and was looked at last */
  #commit(wish) {
    const { time, parameters } = wish.place;
    this.#committed = wish.seq;
    this.#snapshot = this.#open.watch.snapshot(this.revision, time, parameters);
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
    const { courier, watch } = this.#open;
    wish.isAsked = true;
    this.#dues++;
    try {
      if (missing.length > 0) await courier.ask(wish.place, missing, this.#hand !== null);
      else await courier.need([...wanted]);
    } catch (error) {
      this.#lose(wish, error instanceof Error ? error.message : String(error));
    }
    wish.isAsked = false;
    this.#dues--;
    if (this.#isClosed) return;
    this.#pump();
    // Meanwhile the reader may be elsewhere, and that not be known yet: what was asked for is shown on the way.
    if (this.#committed < wish.seq && wish !== this.#wish && this.#lack(wish) === null) this.#commit(wish);
    // Only now is it known which of the arrays that came are in view.
    courier.tidy(() => watch.refs);
  }

  /** @param {Wish} wish @param {string} text */
  #lose(wish, text) {
    wish.isLost = true;
    if (this.#isClosed) return;
    if (wish === this.#wish) this.#wait(false);
    this.#complain(text);
  }

  /** @param {string} text */
  #complain(text) {
    this.emit("problem", Object.freeze({ channel: "", text }));
  }

  /** Ask for what is wanted for later. */
  #teach() {
    const { courier } = this.#open;
    while (this.#lessons.length > 0 && !courier.isBusy) {
      const { place, channels, done } = /** @type {Lesson} */ (this.#lessons.shift());
      const missing = channels.filter((channel) => this.store.find(channel, place.time, place.parameters) === null);
      if (missing.length === 0) {
        done();
        continue;
      }
      courier.ask(place, missing).catch(() => undefined).then(() => { // it is known without, or it is not
        done();
        this.#pump();
      });
    }
  }

  /** @param {any} message */
  #cut(message) {
    if (this.#isClosed) return;
    try {
      const { ahead, courier } = this.#open;
      const spans = courier.cut(message);
      ahead.forget();
      this.#plan = null;
      this.#isBlind = false;
      this.#wish = this.#wishFor(this.point);
      this.emit("stale", spans);
    } catch (error) {
      if (!(error instanceof WireError)) throw error;
      this.#complain(error.message);
    }
    this.#pump();
  }
}

/** @param {object} value */
function isEmpty(value) {
  for (const key in value) if (Object.hasOwn(value, key)) return false;
  return true;
}
