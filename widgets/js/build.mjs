// Bundles src/index.js into one ES module, which is committed beside the Python package and compared in CI; and writes
// the styles of a page beside it.
import { createHash } from "node:crypto";
import { mkdir, writeFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";
import { slim, tighten } from "./slimming.mjs";
import { pageStyles } from "./src/ui/styles.js";

const LIMITS = { raw: 700_000, gzipped: 200_000 }; // bytes
const folder = new URL("../reactive4d_widgets/static/", import.meta.url);

const made = await build({
  absWorkingDir: fileURLToPath(new URL(".", import.meta.url)),
  entryPoints: ["src/index.js"],
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  charset: "utf8",
  legalComments: "eof",
  plugins: [slim()],
  write: false,
});
const bundle = made.outputFiles[0].contents;
const sizes = { raw: bundle.length, gzipped: gzipSync(bundle, { level: 9 }).length };
const sha256 = createHash("sha256").update(bundle).digest("hex");

await mkdir(folder, { recursive: true });
await writeFile(new URL("r4d.mjs", folder), bundle);
await writeFile(new URL("r4d.mjs.sha256", folder), `${sha256}  r4d.mjs\n`);
await writeFile(new URL("page.css", folder), `${tighten(pageStyles)}\n`);
console.log(`r4d.mjs: ${sizes.raw} bytes, ${sizes.gzipped} gzipped`);
if (sizes.raw > LIMITS.raw || sizes.gzipped > LIMITS.gzipped) {
  console.error(`expected at most ${LIMITS.raw} bytes, ${LIMITS.gzipped} gzipped`);
  process.exitCode = 1;
}
