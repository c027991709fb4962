"""Pages: what they weigh, how soon they can be used, and how fast they are scrubbed beside a bare page of three.js.

It needs Chromium and Playwright; the comparison needs the packages of widgets/js as well (npm ci).
"""

import base64
import gzip
import json
import os
import re
import statistics
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

import reactive4d as r4
from reactive4d_apps.browsers import launched, missing
from reactive4d_widgets.creases import split
from reactive4d_widgets.packings import unpacked

from .reports import Section, Target, duration, ratio
from .runs import Run

__all__ = ["BY_HAND", "blob", "bundled", "data_of", "keyed", "paging"]

ROOT = Path(__file__).parent.parent.parent
STATIC = ROOT / "widgets" / "reactive4d_widgets" / "static"
PACKAGES = ROOT / "widgets" / "js" / "node_modules"
TICKS = 60
KB = 1e3
# Frames are drawn when the measurement says so: else both pages would wait for the screen most of the time. A frame is
# over when a pixel of the context that it was drawn with can be read, in both pages.
BY_HAND = """
  window.waiting = [];
  window.requestAnimationFrame = (f) => waiting.push(f);
  window.cancelAnimationFrame = (id) => { waiting[id - 1] = () => {} };
  window.drawn = () => { const now = performance.now(); for (const f of waiting.splice(0)) f(now) };
  const get = OffscreenCanvas.prototype.getContext;
  OffscreenCanvas.prototype.getContext = function (kind, ...rest) {
    const context = get.call(this, kind, ...rest);
    if (kind.startsWith("webgl")) window.gl = context;
    return context;
  };
"""
# As many pixels as the screen has, as the bare page: where there is time, a moving figure is drawn more finely.
STEADY = """() => {
  const { view } = document.querySelector("r4d-figure").life;
  view.pace = { step: { ...view.pace.step, scale: 1, shadows: false }, rest: 1, learn() {}, rested() {} };
}"""
USABLE = """
  document.addEventListener("r4d-commit", () => {
    requestAnimationFrame(() => requestAnimationFrame(() => { window.usable ??= performance.now() }));
  });
"""
SCRUB = """async ([ticks, from, count]) => {
  const pixel = new Uint8Array(4);
  const figure = document.querySelector("r4d-figure");
  const { start, rate } = figure.life.manifest.times;
  const found = [];
  for (let i = 0; i < count; i++) {
    const before = performance.now();
    figure.reader.change({ time: start + ((from + 7 * i) % ticks) / rate });
    while (figure.snapshot.time !== figure.reader.session.point.time) await new Promise((f) => setTimeout(f));
    drawn();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    found.push(performance.now() - before);
  }
  return found;
}"""
BARE = """([ticks, from, count]) => {
  const found = [];
  for (let i = 0; i < count; i++) {
    const before = performance.now();
    draw((from + 7 * i) % ticks);
    found.push(performance.now() - before);
  }
  return found;
}"""
TURN = 10  # frames


def paging(run: Run) -> Section:
    """What pages cost."""
    section = Section("pages", "Pages without a server", ("what", "measured", "against", "ratio"))
    _bundle(section)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        scene, page = _blob_page(section, folder)
        _motion(section, folder)
        if missing() is not None:
            section.notes.append("Without Chromium and Playwright nothing was opened.")
            return section
        with launched() as browser:
            _opening(run, section, browser, page)
            _scrubbing(run, section, browser, scene, page, folder)
            _crowds(section, browser, folder)
    return section


def blob(segments: int = 99) -> r4.Scene:
    """A ball of 10,000 points that twists, bends and trembles, so that no point moves as another does."""
    ball = r4.Sphere(1.0, segments=segments, rings=segments, color="steelblue")
    ball.apply(r4.Twist(60.0 * r4.time))
    ball.apply(r4.Bend(25.0 * np.sin(2.0 * r4.time)))
    ball.apply(r4.Wave(0.06, wavelength=0.5, phase=300.0 * r4.time, decay=0.4))
    return r4.Scene(ball=ball)


def keyed(count: int) -> r4.Scene:
    """A box that goes through so many keys, one a second, without any order."""
    chance = np.random.default_rng(4)
    box = r4.Box(color="teal")
    box.translate(r4.keys({i: tuple(chance.uniform(-9.0, 9.0, 3).tolist()) for i in range(count)}))
    return r4.Scene(box=box)


@r4.signal
def swaying(t: float) -> float:
    """A function of Python's, of which nothing is known: it can only be asked."""
    return 40.0 * float(np.sin(t) * np.cos(1.7 * t) + 0.3 * np.sin(5.1 * t))


def data_of(page: Path) -> dict[str, Any]:
    """What a page carries of its first figure."""
    text = page.read_text(encoding="utf-8")
    found = re.search(r'<script type="application/json" id="r4d-data-[^"]*">(.*?)</script>', text, re.DOTALL)
    assert found is not None
    data = json.loads(found.group(1))
    return {**data, "segments": unpacked(data["segments"])}


def _bundle(section: Section) -> None:
    code = (STATIC / "r4d.mjs").read_bytes()
    small = len(gzip.compress(code, 9))
    section.rows.append(("the viewer", f"{len(code) / KB:.0f} KB", f"{small / KB:.0f} KB gzipped", ""))
    section.targets.append(Target("the viewer", 700.0, len(code) / KB, "KB"))
    section.targets.append(Target("the viewer, gzipped", 200.0, small / KB, "KB"))


def _blob_page(section: Section, folder: Path) -> tuple[r4.Scene, Path]:
    scene, page = blob(), folder / "blob.html"
    before = time.perf_counter()
    report = scene.bake(page, times=(0.0, TICKS / 30.0), progress=False)
    seconds = time.perf_counter() - before
    points = len(scene.at(0.0)["ball"].mesh.points)
    what = f"a page of {points:,} deforming points at {TICKS} ticks"
    section.rows.append((what, f"{report.size / KB:.0f} KB", f"baked in {duration(seconds)}", ""))
    section.targets.append(Target(what, 1200.0, report.size / KB, "KB"))
    return scene, page


def _size(scene: r4.Scene, page: Path, stop: float) -> tuple[int, dict[str, Any]]:
    """Bytes of the segments of what moves, and all the data."""
    scene.bake(page, times=(0.0, stop), progress=False)
    data = data_of(page)
    moving = [segment for segment in data["segments"] if segment["channel"].endswith("#matrix")]
    return len(json.dumps(moving, separators=(",", ":"))), data


def _motion(section: Section, folder: Path) -> None:
    few, _ = _size(keyed(10), folder / "few.html", 9.0)
    many, _ = _size(keyed(210), folder / "many.html", 209.0)
    per_key = (many - few) / 200.0
    section.rows.append(("keyed motion, for each key", f"{per_key:.0f} bytes", "", ""))
    section.targets.append(Target("keyed motion, for each key", 200.0, per_key, "bytes"))

    box = r4.Box(color="teal")
    box.rotate(swaying, axis="x")
    short, data = _size(r4.Scene(box=box), folder / "short.html", 8.0)
    pieces = _pieces(data["segments"])
    per_piece = short / max(1, pieces)
    told = f"fitted motion, for each of {pieces} pieces"
    section.rows.append((told, f"{per_piece:.0f} bytes", "", ""))
    section.targets.append(Target("fitted motion, for each piece", 200.0, per_piece, "bytes"))

    still, _ = _size(keyed(2), folder / "still.html", 2.0)
    later, _ = _size(keyed(2), folder / "later.html", 200.0)
    section.rows.append(("two keys, over 200 s instead of 2", f"{later - still} bytes more", "", ""))
    section.targets.append(
        Target("the same motion over a hundred times the frames, more", 16.0, later - still, "bytes")
    )


def _pieces(tree: Any) -> int:
    """How many pieces the polynomials of some tracks have."""
    if isinstance(tree, dict):
        own = 0
        if tree.get("kind") == "poly":
            times = tree["times"]
            own = (len(times) if isinstance(times, list) else len(base64.b64decode(_text(times))) // _width(times)) - 1
        return own + sum(_pieces(part) for part in tree.values())
    return sum(_pieces(part) for part in tree) if isinstance(tree, list) else 0


def _text(numbers: dict[str, str]) -> str:
    return next(iter(numbers.values()))


def _width(numbers: dict[str, str]) -> int:
    return 4 if "f32" in numbers else 8


def _window(browser: Any, before: str) -> Any:
    window = browser.new_page(viewport={"width": 1000, "height": 900}, offline=True)
    window.add_init_script(before)
    return window


def _opening(run: Run, section: Section, browser: Any, page: Path) -> None:
    found: list[float] = []
    for _ in range(run.rounds):
        window = _window(browser, USABLE)
        window.goto(page.as_uri())
        window.wait_for_function("() => window.usable")
        found.append(window.evaluate("() => window.usable") / 1e3)
        window.close()
    seconds = statistics.median(found)
    section.rows.append(("the same page, from the click until it is drawn", duration(seconds), "", ""))
    section.targets.append(Target("the page of deforming points can be used after", 1.0, seconds, "s"))


def _scrubbing(run: Run, section: Section, browser: Any, scene: r4.Scene, page: Path, folder: Path) -> None:
    bare = _bare_page(scene, page, folder)
    if bare is None:
        section.notes.append("Without the packages of widgets/js there is no bare page to compare with.")
        return
    turns = 12 if run.quick else 60
    ours_window = _window(browser, BY_HAND)
    ours_window.goto(page.as_uri())
    ours_window.wait_for_function("() => { drawn(); return document.querySelector('r4d-figure').snapshot }", polling=50)
    ours_window.wait_for_timeout(1000)
    ours_window.evaluate(STEADY)
    bare_window = _window(browser, "")
    bare_window.goto(bare.as_uri())
    width, height = ours_window.evaluate(
        "() => { const c = document.querySelector('r4d-figure').shadowRoot.querySelector('canvas');"
        " return [c.clientWidth, c.clientHeight] }"
    )
    bare_window.evaluate("([w, h]) => start(w, h)", [width, height])
    ours: list[float] = []
    theirs: list[float] = []
    pairs = [(ours_window, SCRUB, ours), (bare_window, BARE, theirs)]
    for window, program, _ in pairs:
        window.evaluate(program, [TICKS, 0, TICKS])  # the first visit
    for turn in range(turns):  # short turns: what else runs on the machine comes and goes, and meets both alike
        for window, program, found in pairs if turn % 2 == 0 else pairs[::-1]:
            found.append(statistics.median(window.evaluate(program, [TICKS, turn, TURN])))
    ours_window.close()
    bare_window.close()
    mine, other = statistics.median(ours) / 1e3, statistics.median(theirs) / 1e3
    times = statistics.median(a / b for a, b in zip(ours, theirs, strict=True))
    what = f"scrub to another tick, {width} × {height} pixels"
    section.rows.append((what, duration(mine), f"{duration(other)}, three.js alone", ratio(times)))
    section.targets.append(Target("scrub, against a bare page of three.js", 1.5, times, "times"))


def _bare_page(scene: r4.Scene, page: Path, folder: Path) -> Path | None:
    """A page that holds the same buffers, ready to be drawn."""
    code = bundled("bare.js", folder)
    if code is None:
        return None
    mesh = scene.at(0.0)["ball"].drawn
    cut = split(mesh.points, mesh.faces, weld=mesh.attributes.get("weld"))
    origin = np.arange(len(mesh.points)) if cut.origin is None else cut.origin
    points = [scene.at(k / 30.0)["ball"].drawn.points[origin] for k in range(TICKS)]
    data = {
        "points": [_packed(frame.astype("<f4")) for frame in points],
        "faces": _packed(cut.faces.astype("<u4")),
        "view": data_of(page)["manifest"]["view"],
        "color": [0.061, 0.223, 0.456],
    }
    start = (
        "function start(width, height) { const canvas = document.querySelector('canvas');"
        " canvas.width = width; canvas.height = height; window.draw = begin(data, canvas) }"
    )
    path = folder / "bare.html"
    path.write_text(
        f"<!doctype html><title>bare</title><link rel=icon href=data:,><canvas></canvas><script>{code}</script>"
        f"<script>const data = {json.dumps(data)};\n{start}</script>",
        encoding="utf-8",
    )
    return path


def bundled(name: str, folder: Path) -> str | None:
    """A program of this folder with the packages that it imports, as a script; None where they are not there."""
    esbuild = PACKAGES / ".bin" / "esbuild"
    if not esbuild.exists():
        return None
    out = folder / name
    source = Path(__file__).parent / name
    options = ["--bundle", "--minify", "--format=iife", f"--outfile={out}", "--log-level=error"]
    subprocess.run([str(esbuild), str(source), *options], check=True, env={**os.environ, "NODE_PATH": str(PACKAGES)})
    return out.read_text(encoding="utf-8").replace("</script", "<\\/script")


def _packed(array: Any) -> str:
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode("ascii")


def _crowds(section: Section, browser: Any, folder: Path) -> None:
    scenes = {f"figure{i}": r4.Scene({f"ball{i}": r4.Sphere(color="gold")}) for i in range(24)}
    text = "\n\n".join([f"![Figure {i}.](figure{i})" for i in range(24)])
    r4.Page(text, **scenes).bake(folder / "crowd.html", times=(0, 1), limit=4e7, progress=False)
    lost = """() => { window.lost = 0;
      addEventListener("webglcontextlost", () => { window.lost++ }, true) }"""
    window = _window(browser, f"({lost})()")
    window.goto((folder / "crowd.html").as_uri())
    figures = window.locator("r4d-figure")
    for i in range(24):
        figures.nth(i).scroll_into_view_if_needed()
        figures.nth(i).locator("canvas").first.wait_for(state="visible")
    dark = figures.evaluate_all("(all) => all.filter((f) => !f.shadowRoot.querySelector('[data-live]')).length")
    section.rows.append(("24 figures on a page, without a picture", f"{dark}", "", ""))
    section.targets.append(Target("24 figures on a page, without a picture", 0.0, dark))
    window.close()

    rivet = r4.Cylinder(radius=0.1, height=0.1)
    rivets = {f"rivet{i}": rivet.extend() for i in range(1000)}
    for i, copy in enumerate(rivets.values()):
        copy.translate((i % 40, i // 40, 0))
    r4.Scene(rivets).bake(folder / "rivets.html", times=(0, 1), progress=False)
    window = _window(browser, "")
    window.goto((folder / "rivets.html").as_uri())
    window.locator("r4d-figure canvas").first.wait_for(state="visible")
    batches = window.evaluate("() => document.querySelector('r4d-figure').life.view.batches")
    section.rows.append(("a thousand rivets, batches on the card", f"{batches}", "", ""))
    section.targets.append(Target("a thousand rivets, batches", 1.0, batches))
    window.close()
