"""A cell of a notebook that is run again and again: what it leaves behind, in the kernel and in the page.

It needs Chromium, Playwright and JupyterLab. The cell makes everything anew each time: class, model, figure, widget.
"""

import json
import sys
import tempfile
from pathlib import Path
from typing import Any

from reactive4d_apps.browsers import launched, missing

from .reports import Section, Target
from .runs import Run

__all__ = ["CELLS", "Trace", "rerunning", "traced"]

TIMES = 200
WARM = 20
MB = 1e6
CELLS = [
    """
import gc, json
import numpy as np, param
import reactive4d as r4
""",
    """
class Sheet(r4.Illustration):
    amplitude = param.Number(0.1, bounds=(0, 0.5))

    def build(self):
        ball = r4.Sphere(1.0, segments=49, rings=49, color="steelblue")
        ball.apply(r4.Wave(self.signals.amplitude, wavelength=0.5, phase=300 * r4.time, decay=0.4))
        return r4.Scene(ball=ball)

fig = Sheet()
w = fig.show(height=300)
""",
    """
for _ in range(3):
    gc.collect()
all = [type(one).__name__ for one in gc.get_objects()]
counts = {name: all.count(name) for name in ("FigureWidget", "Model", "Reader", "Sheet", "Scene")}
with open("/proc/self/status") as file:
    rss = int(file.read().partition("VmRSS:")[2].split()[0]) * 1024
print(json.dumps({"rss": rss, "views": w.views, **counts}))
""",
]
PAGE = """() => {
  const cells = [...document.querySelectorAll(".r4d-cell")];
  return {
    figures: cells.length,
    viewers: globalThis[Symbol.for("reactive4d.viewers")].size,
    nodes: document.querySelectorAll("*").length,
  };
}"""


class Trace:
    """What there is after a number of runs.

    Attributes:
        kernel: bytes of memory, and how many objects of some classes live.
        page: bytes of heap after a collection, and how many figures there are.
    """

    def __init__(self, kernel: dict[str, int], page: dict[str, int]) -> None:
        self.kernel = kernel
        self.page = page


def rerunning(run: Run) -> Section:
    """What two hundred runs of a cell leave behind."""
    section = Section("rerunning", "A cell that is run again", ("what", "before", "after", "more"))
    if missing() is not None:
        section.notes.append("Without Chromium and Playwright nothing was run.")
        return section
    times = 20 if run.quick else TIMES
    with launched() as browser:
        before, after = traced(browser, [5 if run.quick else WARM, times])
    for what, old, new in (
        ("kernel, memory", before.kernel["rss"], after.kernel["rss"]),
        ("page, heap after a collection", before.page["heap"], after.page["heap"]),
    ):
        more = (new - old) / MB
        section.rows.append((f"{what}, {times} runs", f"{old / MB:.1f} MB", f"{new / MB:.1f} MB", f"{more:.1f} MB"))
        section.targets.append(Target(f"{times} runs of a cell, {what}, more", 20.0, more, "MB"))
    for side, old, new in (("kernel", before.kernel, after.kernel), ("page", before.page, after.page)):
        for name in sorted(set(new) - {"rss", "heap"}):
            section.rows.append((f"{side}, {name}", f"{old[name]}", f"{new[name]}", f"{new[name] - old[name]}"))
    return section


def traced(browser: Any, runs: list[int]) -> list[Trace]:
    """Run the cell so many times, and look; again for each number."""
    sys.path.insert(0, str(Path(__file__).parents[1] / "browser"))
    from labs import Notebook, served

    found: list[Trace] = []
    with tempfile.TemporaryDirectory() as name, served("jupyterlab", Path(name), CELLS) as address:
        page = browser.new_page(viewport={"width": 1280, "height": 1000})
        notebook = Notebook(page, "jupyterlab", address)
        tools = page.context.new_cdp_session(page)
        notebook.run(0)
        for count in runs:
            for _ in range(count):
                notebook.run(1)
                notebook.wait("(f) => true")
            notebook.run(2)
            found.append(Trace(json.loads(notebook.output(2)), _page(page, tools)))
        page.close()
    return found


def _page(page: Any, tools: Any) -> dict[str, int]:
    for _ in range(3):
        tools.send("HeapProfiler.collectGarbage")
        page.wait_for_timeout(300)
    heap = tools.send("Runtime.getHeapUsage")
    size = sum(int(heap.get(name, 0)) for name in ("usedSize", "embedderHeapUsedSize", "backingStorageSize"))
    return {"heap": size, **page.evaluate(PAGE)}
