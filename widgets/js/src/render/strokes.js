/**
 * Lines as thin strips of two triangles per piece, so that they have a width in pixels on every machine. Each piece has
 * four corners; a corner knows its own end, the other end, and on which side of the line it lies.
 */

/** The pieces of a polyline: (0, 1), (1, 2) … @type {(count: number) => Uint32Array} */
export function consecutive(count) {
  const pairs = new Uint32Array(2 * Math.max(0, count - 1));
  for (let i = 0; i + 1 < count; i += 1) {
    pairs[2 * i] = i;
    pairs[2 * i + 1] = i + 1;
  }
  return pairs;
}

/** The arrays of a bundle of lines. */
export class Strokes {
  /** @param {Uint32Array} pairs (K, 2) of points */
  constructor(pairs) {
    const count = pairs.length / 2;
    this.pairs = pairs;
    this.starts = new Float32Array(12 * count);
    this.ends = new Float32Array(12 * count);
    this.sides = new Int8Array(4 * count);
    this.faces = new Uint32Array(6 * count);
    for (let i = 0; i < count; i += 1) {
      this.sides.set([1, -1, 2, -2], 4 * i); // 2: the other end, from which left is right
      const c = 4 * i;
      this.faces.set([c, c + 1, c + 2, c, c + 2, c + 3], 6 * i);
    }
  }

  /** Which point a corner lies at. @param {number} corner @returns {number} */
  point(corner) {
    return this.pairs[2 * (corner >> 2) + ((corner >> 1) & 1)];
  }

  /**
   * Move the points.
   * @param {Float32Array} points (N, 3)
   */
  fill(points) {
    const { pairs, starts, ends } = this;
    for (let i = 0, o = 0; i < pairs.length; i += 2, o += 12) {
      const a = 3 * pairs[i];
      const b = 3 * pairs[i + 1];
      for (let k = 0; k < 3; k += 1) {
        const from = points[a + k];
        const to = points[b + k];
        starts[o + k] = from;
        starts[o + 3 + k] = from;
        starts[o + 6 + k] = to;
        starts[o + 9 + k] = to;
        ends[o + k] = to;
        ends[o + 3 + k] = to;
        ends[o + 6 + k] = from;
        ends[o + 9 + k] = from;
      }
    }
  }
}
