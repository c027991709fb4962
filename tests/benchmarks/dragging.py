"""A live slider: from the reader's wish to the committed frame, beside a bare page of three.js at the same socket.

Both pages ask the server of one model, each over a web socket of its own, for values that nobody asked for before; both
get the same bytes, draw as many points, and move a slider and a number with them. It needs Chromium, Playwright, trame,
and the packages of widgets/js.
"""

import statistics
import tempfile
from pathlib import Path
from typing import Any

import param

import reactive4d as r4
from reactive4d_apps.browsers import launched, missing

from .paging import BY_HAND, STEADY, bundled
from .reports import Section, Target, duration, ratio
from .runs import Run

__all__ = ["Ball", "dragging"]

SIZES = (100, 316)  # squared, they are the numbers of points
SIZE = (736, 459)  # CSS pixels of a picture
OURS = """async ([first, step, count]) => {
  const pixel = new Uint8Array(4);
  const figure = document.querySelector("r4d-figure");
  const draw = () => {
    drawn();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  };
  const found = [];
  for (let k = 0; k < count; k++) {
    const phase = first + k * step;
    draw(); // what was still to be drawn of the time before
    const before = performance.now();
    await new Promise((done) => {
      const heard = () => {
        if (figure.snapshot.parameters.phase !== phase) return;
        figure.removeEventListener("r4d-commit", heard);
        done();
      };
      figure.addEventListener("r4d-commit", heard);
      figure.reader.change({ parameters: { phase } }, { gesture: "drag" });
    });
    draw();
    found.push(performance.now() - before);
  }
  return found;
}"""
BARE = """async ([first, step, count]) => {
  const found = [];
  for (let k = 0; k < count; k++) {
    const before = performance.now();
    await move(first + k * step);
    found.push(performance.now() - before);
  }
  return found;
}"""


BODY = """([width, height]) => {
  const [canvas, slider, number] = ["canvas", "input", "output"].map((name) => document.createElement(name));
  Object.assign(canvas, { width, height });
  Object.assign(slider, { type: "range", min: 0, max: 1000, step: "any" });
  canvas.style.display = "block";
  document.body.replaceChildren(canvas, slider, number);
}"""


class Ball(r4.Illustration):
    """A ball that trembles as its slider says."""

    phase = param.Number(0.0, bounds=(0.0, 1000.0))
    segments = 100
    times = (0.0, 1.0)

    def build(self) -> r4.Scene:
        """One ball, all of whose points move."""
        ball = r4.Sphere(1.0, segments=self.segments, rings=self.segments, color="steelblue")
        ball.apply(r4.Wave(0.06, wavelength=0.5, phase=self.signals.phase, decay=0.4))
        return r4.Scene(ball=ball)


def dragging(run: Run) -> Section:
    """What it takes to follow a slider."""
    section = Section("dragging", "A live slider, from the wish to the frame", ("points", "ours", "three.js", "ratio"))
    if missing() is not None:
        section.notes.append("Without Chromium and Playwright nothing was opened.")
        return section
    with tempfile.TemporaryDirectory() as name:
        code = bundled("bare_live.js", Path(name))
        if code is None:
            section.notes.append("Without the packages of widgets/js there is no bare page to compare with.")
            return section
        with launched() as browser:
            for segments in SIZES:
                _measure(run, section, browser, segments, code)
    return section


def _measure(run: Run, section: Section, browser: Any, segments: int, code: str) -> None:
    kind: Any = type("Ball", (Ball,), {"segments": segments, "__doc__": Ball.__doc__})
    fig = kind()
    points = len(fig.scene.at(0.0)["ball"].mesh.points)
    turns = 10 if run.quick else 40
    with fig.serve(block=False) as server:
        ours, bare = _ours(browser, server.address), _bare(browser, server.address, code)
        mine: list[float] = []
        theirs: list[float] = []
        for k in range(turns):  # by short turns: what else runs on the machine comes and goes
            one = ours.evaluate(OURS, [k + 1.0, 0.1, 3])
            other = bare.evaluate(BARE, [k + 1.05, 0.1, 3])
            if k >= 2:  # the first are to warm up
                mine += one
                theirs += other
        ours.close()
        bare.close()
    here, there = statistics.median(mine) / 1e3, statistics.median(theirs) / 1e3
    section.rows.append((f"{points:,}", duration(here), duration(there), ratio(here / there)))
    claim = f"live slider, {points:,} points, against a bare page of three.js"
    section.targets.append(Target(claim, 1.5, here / there, "times"))


def _ours(browser: Any, address: str) -> Any:
    window = browser.new_page(viewport={"width": 1000, "height": 900})
    window.add_init_script(BY_HAND)
    window.goto(address)
    window.wait_for_function("() => { drawn(); return document.querySelector('r4d-figure')?.snapshot }", polling=50)
    window.wait_for_timeout(1000)
    window.evaluate(STEADY)
    return window


def _bare(browser: Any, address: str, code: str) -> Any:
    """A page of the server's own, since it lets no others ask: a style sheet, in which there is nothing yet."""
    window = browser.new_page(viewport={"width": 1000, "height": 900})
    window.goto(f"{address}page.css")
    window.evaluate(BODY, list(SIZE))
    window.evaluate(code)
    what = {
        "address": f"{address}live/ball".replace("http", "ws", 1),
        "node": "ball",
        "parameter": "phase",
        "value": 0.0,
        "color": [0.061, 0.223, 0.456],
    }
    window.evaluate("async (what) => { window.move = await begin(what, ...document.body.children) }", what)
    return window
