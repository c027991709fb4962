/** For the strip below a figure: over which times its answers are remembered, stale, being computed, or not known. */
import { intersect, subtract, union } from "./intervals.js";

/**
 * @typedef {import("./types.js").Interval} Interval
 * @typedef {import("./types.js").Parameters} Parameters
 * @typedef {import("./types.js").Span} Span
 */

/**
 * @param {import("./store.js").ChannelStore} store
 * @param {readonly string[]} channels in view
 * @param {Interval} when
 * @param {Parameters} parameters
 * @param {readonly Interval[]} asked the times that are being asked for
 * @returns {Span[]} one after the other, without gaps
 */
export function spansOf(store, channels, when, parameters, asked) {
  if (!(when[0] < when[1])) return [];
  /** @type {Interval[]} */
  let known = [when];
  for (const channel of channels) {
    if (known.length === 0) break;
    const gaps = store.gaps(channel, when, parameters);
    if (gaps.length > 0) known = subtract(known, gaps);
  }
  const unknown = subtract([when], known);
  const computing = intersect(unknown, union(asked));
  const rest = subtract(unknown, computing);
  const stale = intersect(rest, store.cuts);
  return [
    ...spans(known, "remembered"),
    ...spans(computing, "computing"),
    ...spans(stale, "stale"),
    ...spans(subtract(rest, stale), "missing"),
  ].sort((a, b) => a.start - b.start);
}

/** @param {readonly Interval[]} intervals @param {Span["state"]} state @returns {Span[]} */
function spans(intervals, state) {
  return intervals.map(([start, stop]) => ({ start, stop, state }));
}
