// What of three.js the viewer does not use stays out of the bundle, and so does the white space of programs and styles:
// a plugin for esbuild.
//
// three.js keeps all its programs in tables, so no bundler can tell which of them are unused. We can: surfaces are
// MeshPhongMaterial, everything else brings its own program, and there is no headset and no environment map.
import { readFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";

const SOURCES = fileURLToPath(new URL("node_modules/three/src/", import.meta.url));

/** Parts of programs that only unused materials have. */
const CHUNKS = [
  "batching_pars_vertex",
  "batching_vertex",
  "bumpmap_pars_fragment",
  "clearcoat_normal_fragment_begin",
  "clearcoat_normal_fragment_maps",
  "clearcoat_pars_fragment",
  "envmap_fragment",
  "envmap_pars_fragment",
  "envmap_pars_vertex",
  "envmap_physical_pars_fragment",
  "envmap_vertex",
  "gradientmap_pars_fragment",
  "iridescence_fragment",
  "iridescence_pars_fragment",
  "lightprobes_pars_fragment",
  "lights_physical_fragment",
  "lights_physical_pars_fragment",
  "lights_toon_fragment",
  "lights_toon_pars_fragment",
  "metalnessmap_fragment",
  "metalnessmap_pars_fragment",
  "morphcolor_vertex",
  "morphinstance_vertex",
  "morphnormal_vertex",
  "morphtarget_pars_vertex",
  "morphtarget_vertex",
  "roughnessmap_fragment",
  "roughnessmap_pars_fragment",
  "skinbase_vertex",
  "skinning_pars_vertex",
  "skinning_vertex",
  "skinnormal_vertex",
  "transmission_fragment",
  "transmission_pars_fragment",
];

/** Programs of materials that are not used. */
const PROGRAMS = [
  "background",
  "backgroundCube",
  "cube",
  "equirect",
  "linedashed",
  "meshmatcap",
  "meshnormal",
  "meshphysical",
  "meshtoon",
  "sprite",
];

/**
 * What stands where a whole module is not wanted: as much as the renderer touches of it.
 * @type {Map<string, string>}
 */
const MODULES = new Map([
  [
    "renderers/webxr/WebXRManager.js",
    `export class WebXRManager {
      enabled = false; isPresenting = false;
      addEventListener() {} removeEventListener() {} setAnimationLoop() {} dispose() {}
      getEnvironmentBlendMode() {}
    }`,
  ],
  [
    "extras/PMREMGenerator.js",
    "export class PMREMGenerator { dispose() {} }",
  ],
]);
for (const name of CHUNKS) MODULES.set(`renderers/shaders/ShaderChunk/${name}.glsl.js`, 'export default "";');
for (const name of PROGRAMS) {
  MODULES.set(`renderers/shaders/ShaderLib/${name}.glsl.js`, 'export const vertex = "", fragment = "";');
}

/** Programs without comments and indentation. Lines stay: `#` directives end with theirs. @param {string} text */
export function shorten(text) {
  return text.replace(/(\/\* glsl \*\/ ?`)([^`]*)`/g, (_, /** @type {string} */ start, /** @type {string} */ program) => {
    const lines = program
      .replace(/\/\*[\s\S]*?\*\//g, "")
      .split("\n")
      .map((line) => line.replace(/\/\/.*$/, "").trim().replace(/\s+/g, " "))
      .map((line) => (line.startsWith("#") ? line : line.replace(/ ?([*/=<>(){},;:?]) ?/g, "$1")))
      .filter((line) => line !== "");
    return `${start}\n${lines.join("\n")}\n\``;
  });
}

/** Style sheets without comments and indentation, in the templates of a module or bare. @param {string} text */
export function tighten(text) {
  return text.replace(/\/\*[^]*?\*\//g, "").replace(/\s+/g, " ").replace(/ ?([{};,]) ?/g, "$1")
    .replace(/: /g, ":").replace(/;}/g, "}").trim();
}

/** The plugin. @returns {import("esbuild").Plugin} */
export function slim() {
  return {
    name: "slim",
    setup(build) {
      build.onResolve({ filter: /^three$/ }, () => ({ path: `${SOURCES}Three.js`, sideEffects: false }));
      build.onLoad({ filter: /[\\/]three[\\/]src[\\/].*\.js$/ }, async ({ path }) => {
        const name = path.slice(SOURCES.length).replaceAll("\\", "/");
        return { contents: MODULES.get(name) ?? shorten(await readFile(path, "utf8")) };
      });
      build.onLoad({ filter: /[\\/]src[\\/]render[\\/].*\.js$/ }, async ({ path }) => ({
        contents: shorten(await readFile(path, "utf8")),
      }));
      build.onLoad({ filter: /[\\/]src[\\/]ui[\\/][a-z-]*styles\.js$/ }, async ({ path }) => ({
        contents: (await readFile(path, "utf8")).replace(/`[^`]*`/g, tighten),
      }));
    },
  };
}
