/**
 * A page's own table as a transport: all that was asked when the page was written, and nothing else.
 *
 * A channel is answered with all its segments that match the parameters, at all times, so it is asked once for each
 * combination of stops; its arrays are sent along. Where the page holds nothing, it says so, as an error.
 */
import { interval, list, MOST, name, object, own, whole } from "../core/checks.js";
import { inflate, MOST_BYTES } from "../core/chunks.js";
import { WireError } from "../core/errors.js";
import { bytes } from "../core/numbers.js";
import { canonical } from "../core/segments.js";

/**
 * @typedef {import("../core/types.js").Ask} Ask
 * @typedef {import("../core/types.js").PageData} PageData
 * @typedef {import("../core/types.js").PackedPage} PackedPage
 * @typedef {import("../core/types.js").Transport} Transport
 * @typedef {import("../core/types.js").WireChunk} WireChunk
 * @typedef {import("../core/types.js").WireSegment} WireSegment
 * @typedef {import("../core/types.js").Parameters} Parameters
 */

const NOTHING = "This page holds no answer here.";

/** @param {PageData|PackedPage} data as it stands in the page @returns {Transport} */
export function baked(data) {
  const page = object(data, "page");
  const manifest = own(page, "manifest");
  const chunks = list(own(page, "chunks"), "page.chunks");
  const given = own(page, "segments");
  /** @type {Map<string, WireSegment[]>} */
  let channels = Array.isArray(given) ? byChannel(list(given, "page.segments")) : new Map();
  const unpacked = Array.isArray(given) ? null : unpackedOf(object(given, "page.segments"));
  const holders = byRef(chunks);
  const stops = stopsOf(manifest);
  /** @type {Set<WireSegment>} */
  const sent = new Set();
  /** @type {Set<number>} */
  const packed = new Set();

  /** @param {Iterable<string>} refs @returns {WireChunk[]} */
  const chunksOf = (refs) => {
    const found = new Set([...refs].flatMap((ref) => holders.get(ref) ?? []));
    for (const i of found) packed.add(i);
    return [...found].map((i) => chunks[i]);
  };

  /** @param {string} channel @param {number} time @param {Parameters} parameters @returns {WireSegment[]} */
  const answer = (channel, time, parameters) => {
    const all = channels.get(channel) ?? [];
    const matching = all.filter((segment) => matches(segment, parameters, stops));
    const isHere = matching.some((segment) => holds(segment, time));
    // What was sent before and is asked for again was forgotten meanwhile.
    const found = matching.filter((segment) => !sent.has(segment) || holds(segment, time));
    for (const segment of found) sent.add(segment);
    return isHere ? found : [...found, nothing(channel, all, matching, time, parameters)];
  };

  return {
    open: async () => {
      if (unpacked !== null) channels = byChannel(await unpacked());
      return /** @type {any} */ (manifest);
    },
    ask: async ({ seq, parameters, times, channels: asked }) => {
      const segments = asked.flatMap((channel) => times.flatMap((time) => answer(channel, time, parameters)));
      /** @type {Set<string>} */
      const refs = new Set();
      for (const segment of segments) collectRefs(segment.track, refs);
      const isNew = (/** @type {string} */ ref) => (holders.get(ref) ?? []).every((i) => !packed.has(i));
      return { seq, revision: manifest.revision ?? 0, segments, blobs: chunksOf([...refs].filter(isNew)) };
    },
    onStale: () => undefined,
    dropped: (refs) => {
      for (const ref of refs) for (const i of holders.get(ref) ?? []) packed.delete(i);
    },
    need: async (refs) => chunksOf(refs),
    close: () => undefined,
  };
}

/** Segments that are deflated, unpacked when they are wanted. @param {Record<string, any>} packed */
function unpackedOf(packed) {
  const path = "page.segments";
  const size = whole(own(packed, "bytes"), `${path}.bytes`, 0, MOST_BYTES);
  const data = bytes(own(packed, "data"), `${path}.data`, MOST_BYTES);
  return async () => {
    const text = new TextDecoder().decode(await inflate(data, `${path}.data`, size));
    try {
      return list(JSON.parse(text), path);
    } catch (error) {
      throw error instanceof WireError ? error : new WireError(path, "expected JSON");
    }
  };
}

/** @param {any[]} segments @returns {Map<string, WireSegment[]>} */
function byChannel(segments) {
  const channels = new Map();
  segments.forEach((segment, i) => {
    const path = `page.segments[${i}]`;
    const channel = name(own(object(segment, path), "channel"), `${path}.channel`);
    interval(own(segment, "when"), `${path}.when`);
    object(own(segment, "where") ?? {}, `${path}.where`);
    const known = channels.get(channel);
    if (known === undefined) channels.set(channel, [segment]);
    else known.push(segment);
  });
  return channels;
}

/** Which chunks hold an array. @param {any[]} chunks @returns {Map<string, number[]>} */
function byRef(chunks) {
  const holders = new Map();
  chunks.forEach((chunk, i) => {
    const path = `page.chunks[${i}]`;
    for (const ref of list(own(object(chunk, path), "refs"), `${path}.refs`)) holders.set(ref, [i]);
  });
  return holders;
}

/** @param {any} manifest @returns {Map<string, number[]>} */
function stopsOf(manifest) {
  const parameters = list(own(object(manifest, "page.manifest"), "parameters") ?? [], "page.manifest.parameters");
  return new Map(parameters.flatMap((one) => {
    const stops = own(object(one, "page.manifest.parameters"), "stops") ?? [];
    const numbers = list(stops, "stops").filter((stop) => typeof stop === "number");
    return numbers.length > 0 ? [[one.name, numbers.sort((a, b) => a - b)]] : [];
  }));
}

/** Whether a segment answers these parameters, or helps to: it lies at the next stop of one that is blended.
 * @param {WireSegment} segment @param {Parameters} parameters @param {Map<string, number[]>} stops */
function matches({ where, blend }, parameters, stops) {
  return Object.entries(where ?? {}).every(([parameter, value]) => {
    const wish = parameters[parameter];
    if (canonical(value) === canonical(wish)) return true;
    if (!Array.isArray(blend) || !blend.includes(parameter)) return false;
    const known = stops.get(parameter) ?? [];
    if (typeof wish !== "number" || typeof value !== "number" || known.includes(wish)) return false;
    const above = known.findIndex((stop) => stop > wish);
    return above > 0 && (known[above] === value || known[above - 1] === value);
  });
}

/** @param {WireSegment} segment @param {number} time */
function holds({ when }, time) {
  return Array.isArray(when) && (when[0] ?? -Infinity) <= time && time < (when[1] ?? Infinity);
}

/** That there is no answer, from the one before to the one after.
 * @param {string} channel @param {WireSegment[]} all @param {WireSegment[]} matching @param {number} time
 * @param {Parameters} parameters @returns {WireSegment} */
function nothing(channel, all, matching, time, parameters) {
  const stops = matching.map(({ when }) => when[1] ?? Infinity).filter((stop) => stop <= time);
  const starts = matching.map(({ when }) => when[0] ?? -Infinity).filter((start) => start > time);
  const [start, stop] = [Math.max(...stops), Math.min(...starts)];
  const where = Object.create(null);
  for (const segment of all) {
    for (const parameter of Object.keys(segment.where ?? {})) where[parameter] = parameters[parameter] ?? null;
  }
  const end = (/** @type {number} */ t) => (Number.isFinite(t) ? t : null);
  return { channel, where, when: [end(start), end(stop)], error: NOTHING };
}

const REF = /^[0-9a-f]{32}$/;

/** All references in a track. @param {any} value @param {Set<string>} into @param {number} [depth] */
function collectRefs(value, into, depth = 2 * MOST.depth) {
  if (typeof value === "string") {
    if (REF.test(value)) into.add(value);
  } else if (typeof value === "object" && value !== null && typeof value[0] !== "number" && depth > 0) {
    for (const part of Object.values(value)) collectRefs(part, into, depth - 1);
  }
}
