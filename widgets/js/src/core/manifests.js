/** A manifest: what a figure is, before anything is asked. Read once, complete and frozen afterwards. */
import { finite, frozen, interval, list, name, object, oneOf, own, row, text, truth, whole } from "./checks.js";
import { WireError } from "./errors.js";
import { compileTree } from "./expressions.js";
import { ascending } from "./numbers.js";
import { changed } from "./parameters.js";
import { plain } from "./segments.js";

/**
 * @typedef {import("./types.js").Manifest} Manifest
 * @typedef {import("./types.js").Parameter} Parameter
 * @typedef {import("./types.js").Parameters} Parameters
 * @typedef {import("./types.js").Eye} Eye
 * @typedef {import("./types.js").Value} Value
 */

const MOST = { nodes: 200_000, parameters: 1_000, values: 10_000, handles: 1_000, cells: 100 };
const KINDS = /** @type {const} */ (["number", "integer", "boolean", "select", "color", "range", "xy"]);
const PICTURES = /** @type {const} */ (["never", "instead", "always"]);
const GRADES = /** @type {const} */ (["free", "stops", "fixed"]);

/** @param {any} value as it travelled @param {string} [path] @returns {Manifest} */
export function readManifest(value, path = "manifest") {
  const given = object(value, path);
  oneOf(own(given, "format"), `${path}.format`, ["reactive4d/1"]);
  const at = (/** @type {string} */ key) => own(given, key);
  const nodes = list(at("nodes") ?? [], `${path}.nodes`, MOST.nodes)
    .map((one, i) => readNode(one, `${path}.nodes[${i}]`));
  requireDistinct(nodes.map((one) => one.name), `${path}.nodes`);
  const parameters = list(at("parameters") ?? [], `${path}.parameters`, MOST.parameters)
    .map((one, i) => readParameter(one, `${path}.parameters[${i}]`));
  requireDistinct(parameters.map((one) => one.name), `${path}.parameters`);
  const times = readTimes(at("times"), `${path}.times`);
  return frozenAll({
    format: "reactive4d/1",
    name: name(at("name"), `${path}.name`),
    title: text(at("title") ?? "", `${path}.title`),
    doc: text(at("doc") ?? "", `${path}.doc`),
    revision: whole(at("revision") ?? 0, `${path}.revision`, 0, Number.MAX_SAFE_INTEGER),
    times,
    parameters,
    handles: list(at("handles") ?? [], `${path}.handles`, MOST.handles)
      .map((one, i) => readHandle(one, `${path}.handles[${i}]`)),
    view: readView(at("view"), `${path}.view`),
    bounds: readBounds(at("bounds") ?? [[-1, -1, -1], [1, 1, 1]], `${path}.bounds`),
    nodes,
    values: list(at("values") ?? [], `${path}.values`, MOST.values)
      .map((one, i) => readValue(one, `${path}.values[${i}]`)),
    point: readPoint(at("point") ?? {}, parameters, times, `${path}.point`),
    options: readOptions(at("options") ?? {}, `${path}.options`),
    pictures: oneOf(at("pictures") ?? "never", `${path}.pictures`, PICTURES),
    cells: at("cells") === undefined ? null : readCells(at("cells"), `${path}.cells`),
  });
}

/** @template T @param {T} value @returns {T} */
function frozenAll(value) {
  if (typeof value === "object" && value !== null && !Object.isFrozen(value)) {
    for (const part of Object.values(value)) frozenAll(part);
    Object.freeze(value);
  }
  return value;
}

/** @param {readonly string[]} names @param {string} path */
function requireDistinct(names, path) {
  const seen = new Set();
  for (const one of names) {
    if (seen.has(one)) throw new WireError(path, `expected different names, got ${JSON.stringify(one)} twice`);
    seen.add(one);
  }
}

/** @param {any} value @param {string} path */
function readNode(value, path) {
  const given = object(value, path);
  return { name: name(own(given, "name"), `${path}.name`), kind: name(own(given, "kind") ?? "", `${path}.kind`) };
}

/** @param {any} value @param {string} path */
function readValue(value, path) {
  const given = object(value, path);
  return {
    name: name(own(given, "name"), `${path}.name`),
    unit: name(own(given, "unit") ?? "", `${path}.unit`),
    format: name(own(given, "format") ?? "", `${path}.format`),
  };
}

/** @param {any} value @param {string} path */
function readTimes(value, path) {
  const given = object(value, path);
  const start = finite(own(given, "start"), `${path}.start`);
  const stop = finite(own(given, "stop"), `${path}.stop`);
  if (stop < start) throw new WireError(path, `expected a stop after the start, got ${start} and ${stop}`);
  const rate = finite(own(given, "rate") ?? 30, `${path}.rate`);
  if (!(rate > 0)) throw new WireError(`${path}.rate`, `expected a positive number, got ${rate}`);
  const marks = Array.from(ascending(own(given, "marks") ?? [], `${path}.marks`));
  return { start, stop, rate, marks, still: truth(own(given, "still") ?? false, `${path}.still`) };
}

/** @param {any} value @param {string} path @returns {Parameter} */
function readParameter(value, path) {
  const given = object(value, path);
  const at = (/** @type {string} */ key) => own(given, key) ?? null;
  const parameter = name(at("name"), `${path}.name`);
  const values = (/** @type {string} */ key) => (
    at(key) === null ? null : list(at(key), `${path}.${key}`, 10_000)
      .map((one, i) => plain(one, `${path}.${key}[${i}]`))
  );
  const kind = oneOf(at("kind"), `${path}.kind`, KINDS);
  const stops = values("stops");
  if (stops !== null && stops.every((x) => typeof x === "number")) stops.sort((a, b) => Number(a) - Number(b));
  return {
    name: parameter,
    kind,
    label: text(at("label") ?? parameter, `${path}.label`),
    doc: text(at("doc") ?? "", `${path}.doc`),
    unit: name(at("unit") ?? "", `${path}.unit`),
    default: plain(at("default"), `${path}.default`),
    bounds: readSides(at("bounds"), `${path}.bounds`),
    step: at("step") === null ? null : finite(at("step"), `${path}.step`),
    options: values("options"),
    labels: at("labels") === null ? null : list(at("labels"), `${path}.labels`, 10_000)
      .map((one, i) => text(one, `${path}.labels[${i}]`)),
    stops,
    grade: oneOf(at("grade") ?? "free", `${path}.grade`, GRADES),
    why: text(at("why") ?? "", `${path}.why`),
    hidden: truth(at("hidden") ?? false, `${path}.hidden`),
    optional: truth(at("optional") ?? false, `${path}.optional`),
    soft: readSides(at("soft"), `${path}.soft`),
    depends: readDepends(at("depends"), `${path}.depends`),
  };
}

/** @param {any} value @param {string} path @returns {[number|null, number|null]|null} */
function readSides(value, path) {
  if (value === null) return null;
  const [low, high] = list(value, path, 2, 2);
  if (low !== null) finite(low, `${path}[0]`);
  if (high !== null) finite(high, `${path}[1]`);
  if (low !== null && high !== null && low > high) throw new WireError(path, `expected ${low} to be at most ${high}`);
  return [low, high];
}

/** @param {any} value @param {string} path @returns {Parameter["depends"]} */
function readDepends(value, path) {
  if (value === null) return null;
  const given = object(value, path);
  const bounds = own(given, "bounds") ?? undefined;
  const constant = own(given, "constant") ?? undefined;
  if (bounds !== undefined) {
    list(bounds, `${path}.bounds`, 2, 2).forEach((tree, i) => {
      if (tree !== null) compileTree(tree, `${path}.bounds[${i}]`);
    });
  }
  if (constant !== undefined) compileTree(constant, `${path}.constant`);
  /** @type {Parameter["depends"]} */
  const read = {};
  if (bounds !== undefined) read.bounds = frozen(bounds, path);
  if (constant !== undefined) read.constant = frozen(constant, path);
  return read;
}

/** @param {any} value @param {string} path @returns {import("./types.js").Handle} */
function readHandle(value, path) {
  const given = object(value, path);
  const names = (/** @type {string} */ key) => list(own(given, key) ?? [], `${path}.${key}`, 3)
    .map((one, i) => name(one, `${path}.${key}[${i}]`));
  return {
    node: name(own(given, "node"), `${path}.node`),
    parameters: names("parameters"),
    label: text(own(given, "label") ?? "", `${path}.label`),
    kind: oneOf(own(given, "kind"), `${path}.kind`, /** @type {const} */ (["axis", "plane", "circle"])),
    axes: names("axes"),
  };
}

/** @param {any} value @param {string} path @returns {Manifest["cells"]} */
function readCells(value, path) {
  const given = object(value, path);
  const boxes = list(own(given, "boxes"), `${path}.boxes`, MOST.cells).map((one, i) => {
    const at = `${path}.boxes[${i}]`;
    const box = object(one, at);
    return { name: name(own(box, "name"), at), at: row(own(box, "at"), at, 2) };
  });
  const arrows = list(own(given, "arrows"), `${path}.arrows`, MOST.cells ** 2).map((one, i) => {
    const at = `${path}.arrows[${i}]`;
    const [from, to, ...via] = list(one, at, MOST.cells + 2, 2);
    for (const end of [from, to]) whole(end, at, 0, boxes.length - 1);
    return { from, to, via: via.map((point) => row(point, at, 2)) };
  });
  const moves = own(given, "moves") === undefined ? null : list(own(given, "moves"), `${path}.moves`, MOST.parameters)
    .map((one) => list(one, `${path}.moves`, MOST.parameters).map((each) => name(each, `${path}.moves`)));
  return { boxes, arrows, moves };
}

/** @param {any} value @param {string} path @returns {Required<Eye>} */
function readView(value, path) {
  const given = object(value ?? {}, path);
  const at = (/** @type {string} */ key) => own(given, key);
  const near = finite(at("near") ?? 0.01, `${path}.near`);
  const far = finite(at("far") ?? 1000, `${path}.far`);
  if (!(near > 0 && far > near)) throw new WireError(path, `expected 0 < near < far, got ${near} and ${far}`);
  return {
    position: row(at("position") ?? [4, -7, 4], `${path}.position`, 3),
    target: row(at("target") ?? [0, 0, 0], `${path}.target`, 3),
    up: row(at("up") ?? [0, 0, 1], `${path}.up`, 3),
    fov: finite(at("fov") ?? 30, `${path}.fov`),
    near,
    far,
  };
}

/** @param {any} value @param {string} path @returns {[number[], number[]]} */
function readBounds(value, path) {
  const [low, high] = list(value, path, 2, 2);
  return [row(low, `${path}[0]`, 3), row(high, `${path}[1]`, 3)];
}

/** @param {any} value @param {readonly Parameter[]} parameters @param {Manifest["times"]} times @param {string} path
 * @returns {import("./types.js").Point} */
function readPoint(value, parameters, times, path) {
  const given = object(value, path);
  const wishes = object(own(given, "parameters") ?? {}, `${path}.parameters`);
  /** @type {Record<string, Value>} */
  const before = Object.create(null);
  for (const one of parameters) {
    const wish = own(wishes, one.name);
    const isOwn = wish !== undefined && one.grade === "fixed"; // it stays what the page was made for
    before[one.name] = isOwn ? plain(wish, `${path}.parameters.${one.name}`) : one.default;
  }
  const time = finite(own(given, "time") ?? times.start, `${path}.time`);
  const camera = own(given, "camera") ?? null;
  return {
    time: Math.min(Math.max(time, times.start), times.stop),
    parameters: changed(parameters, Object.freeze(before), wishes),
    camera: camera === null ? null : readEye(camera, `${path}.camera`),
  };
}

/** @param {any} value @param {string} path @returns {Eye} */
function readEye(value, path) {
  const given = object(value, path);
  return {
    position: row(own(given, "position"), `${path}.position`, 3),
    target: row(own(given, "target"), `${path}.target`, 3),
  };
}

/** @param {any} value @param {string} path @returns {import("./types.js").Options} */
function readOptions(value, path) {
  const given = object(value, path);
  const at = (/** @type {string} */ key) => own(given, key);
  const flag = (/** @type {string} */ key, /** @type {boolean} */ otherwise) => (
    truth(at(key) ?? otherwise, `${path}.${key}`)
  );
  return {
    theme: oneOf(at("theme") ?? "auto", `${path}.theme`, /** @type {const} */ (["auto", "light", "dark"])),
    height: at("height") === undefined || at("height") === null ? null : finite(at("height"), `${path}.height`),
    loop: flag("loop", false),
    autoplay: flag("autoplay", false),
    edges: flag("edges", true),
    shading: oneOf(at("shading") ?? "smooth", `${path}.shading`, /** @type {const} */ (["smooth", "flat", "wire"])),
    ground: flag("ground", false),
    axes: flag("axes", false),
    grid: flag("grid", false),
    shadows: flag("shadows", true),
    playing: name(at("playing") ?? "time", `${path}.playing`),
  };
}

/** A stale message, checked. @param {any} value @param {string} [path] @returns {import("./types.js").Stale} */
export function readStale(value, path = "stale") {
  const given = object(value, path);
  const revision = whole(own(given, "revision"), `${path}.revision`, 0, Number.MAX_SAFE_INTEGER);
  const spans = list(own(given, "spans"), `${path}.spans`);
  spans.forEach((span, i) => {
    const [channel, start, stop] = list(span, `${path}.spans[${i}]`, 3, 3);
    name(channel, `${path}.spans[${i}][0]`);
    interval([start, stop], `${path}.spans[${i}]`);
  });
  return { revision, spans };
}
