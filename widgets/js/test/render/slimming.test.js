import assert from "node:assert/strict";
import { test } from "node:test";
import { build } from "esbuild";
import { shorten, slim, tighten } from "../../slimming.mjs";
import { ball, box } from "../fixtures/shapes.mjs";
import { FakeCard, FakeElement, page } from "./cards.js";
import { floats, geometry, manifest, node, other, snapshot } from "./makings.js";

test("programs lose comments and indentation, and keep their lines", () => {
  const program = "const a = /* glsl */`\n  // why\n  #define A ( 1 )\n  float x = a - - b; /* so */ y = x ;\n`;";
  assert.equal(shorten(program), "const a = /* glsl */`\n#define A ( 1 )\nfloat x=a - - b;y=x;\n`;");
  assert.equal(shorten("const b = ` a // b `;"), "const b = ` a // b `;");
});

test("style sheets lose comments and indentation, and say the same", () => {
  const sheet = "\n/* A box */\n.box :is(a, b) > i {\n  margin: 0 -1px; color: var(--ink);\n}\n"
    + "@media (width > 1px) { a { b: c } }\n";
  assert.equal(tighten(sheet), ".box :is(a,b) > i{margin:0 -1px;color:var(--ink)}@media (width > 1px){a{b:c}}");
});

test("what is left of three.js draws everything that there is to draw", async () => {
  const contents = 'export { Stage } from "./src/render/stages.js"; export { View } from "./src/render/views.js";';
  const made = await build({
    stdin: { contents, resolveDir: new URL("../..", import.meta.url).pathname },
    bundle: true,
    minify: true,
    format: "esm",
    write: false,
    plugins: [slim()],
  });
  const [{ text }] = made.outputFiles;
  assert.ok(text.length < 520_000, `${text.length} characters`);
  const beat = page();
  const { Stage, View } = await import(`data:text/javascript;base64,${Buffer.from(text).toString("base64")}`);
  const stage = new Stage({ canvas: new FakeCard() });
  const canvas = new FakeElement();
  new FakeElement().append(canvas);
  const view = new View(stage, canvas, manifest({ axes: true, grid: true, ground: true }));
  const cube = geometry(box(1));
  const line = { a: floats(Float32Array.of(0, 0, 0, 1, 0, 0)), b: null, mix: 0 };
  view.show(snapshot(
    node("cube", cube),
    node("painted", { ...cube, paints: { faces: floats(new Float32Array(48).fill(1), 4), points: null } }),
    node("glass", { ...geometry(ball(0.5)), color: [0, 0, 1, 0.4] }),
    node("way", { drawn: "lines", points: line }),
    node("dots", { drawn: "points", points: line }),
    ...["directional", "point", "spot"].map((kind) => other(kind, "light", { light_type: kind, shadows: true })),
  ));
  for (const shading of ["smooth", "flat", "wire"]) {
    view.options = { shading };
    view.highlight("cube");
    assert.equal(view.render(), true);
  }
  view.show(snapshot(node("cube", cube)));
  beat();
  assert.equal(view.render(), true);
  view.dispose();
  stage.dispose();
});
