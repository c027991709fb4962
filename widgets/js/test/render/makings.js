/** States and snapshots for the tests of the pictures. */

/** @typedef {import("../../src/core/types.js").NodeState} NodeState */
/** @typedef {import("../../src/core/types.js").Snapshot} Snapshot */
/** @typedef {import("../../src/core/types.js").Manifest} Manifest */

let refs = 0;

/** @param {Float32Array} array (n, columns) @param {number} [columns] */
export const floats = (array, columns = 3) => ({
  ref: String((refs += 1)).padStart(32, "0"),
  array,
  shape: [array.length / columns, columns],
});

/** @param {Uint32Array} array @param {number} columns */
export const indices = (array, columns) => ({
  ref: String((refs += 1)).padStart(32, "0"),
  array,
  shape: [array.length / columns, columns],
  top: array.reduce((a, b) => Math.max(a, b), -1),
});

/** @param {import("../fixtures/shapes.mjs").Shape} shape */
export function geometry({ points, faces, origin, edges }) {
  return {
    points: { a: floats(points), b: null, mix: 0 },
    topology: {
      faces: indices(faces, 3),
      origin: origin && indices(origin, 1),
      edges: edges && indices(edges, 2),
      lines: null,
    },
  };
}

/** @param {number} x @param {number} y @param {number} z */
export const at = (x, y, z) => Float64Array.of(1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1);

const NOTHING = {
  text: null,
  height: null,
  light_type: null,
  intensity: null,
  angle: null,
  reach: null,
  shadows: null,
  fov: null,
  near: null,
  far: null,
  target: null,
};

/** @param {string} name @param {Partial<NodeState>} [more] @returns {NodeState} */
export const node = (name, more = {}) => ({
  name,
  kind: "thing",
  drawn: "mesh",
  visible: true,
  color: [0.5, 0.5, 0.5, 1],
  matrix: at(0, 0, 0),
  points: null,
  topology: null,
  paints: null,
  settings: NOTHING,
  ...more,
});

/** @param {string} name @param {NodeState["drawn"]} drawn @param {Partial<NodeState["settings"]>} settings
 * @param {Partial<NodeState>} [more] */
export const other = (name, drawn, settings, more = {}) =>
  node(name, { drawn, settings: { ...NOTHING, ...settings }, ...more });

/** @param {NodeState[]} states @returns {Snapshot} */
export const snapshot = (...states) => ({
  revision: 0,
  time: 0,
  parameters: {},
  nodes: new Map(states.map((state) => [state.name, state])),
  values: new Map(),
  problems: [],
  cells: [],
});

/** @param {Partial<Manifest["options"]>} [options] @returns {Manifest} */
export const manifest = (options = {}) => ({
  pictures: "never",
  cells: null,
  format: "reactive4d/1",
  name: "figure",
  title: "",
  doc: "",
  revision: 0,
  times: { start: 0, stop: 1, rate: 30, marks: [], still: false },
  parameters: [],
  handles: [],
  view: { position: [0, -10, 0], target: [0, 0, 0], up: [0, 0, 1], fov: 40, near: 0.01, far: 1000 },
  bounds: [[-1, -1, -1], [1, 1, 1]],
  nodes: [],
  values: [],
  point: { time: 0, parameters: {}, camera: null },
  options: {
    theme: "light",
    height: null,
    loop: false,
    autoplay: false,
    edges: true,
    shading: "smooth",
    ground: false,
    axes: false,
    grid: false,
    shadows: true,
    playing: "time",
    ...options,
  },
});
