/** Which labels are shown when there are too many: the more important first, and none upon another. */

/**
 * @typedef {object} Placed
 * @property {number} x of the middle, CSS pixels
 * @property {number} y
 * @property {number} width
 * @property {number} height
 * @property {number} priority higher is more important
 * @property {boolean} shown whether it was shown before: it then goes first among its equals, so that nothing flickers
 */

const GAP = 3;

/**
 * The labels to show, in the order of their importance.
 * @template {Placed} L
 * @param {readonly L[]} labels
 * @returns {L[]}
 */
export function thin(labels) {
  const order = [...labels].sort((a, b) => b.priority - a.priority || Number(b.shown) - Number(a.shown));
  /** @type {L[]} */
  const kept = [];
  for (const label of order) if (!kept.some((other) => overlap(label, other))) kept.push(label);
  return kept;
}

/** @type {(a: Placed, b: Placed) => boolean} */
function overlap(a, b) {
  return (
    Math.abs(a.x - b.x) < (a.width + b.width) / 2 + GAP && Math.abs(a.y - b.y) < (a.height + b.height) / 2 - 1
  );
}
