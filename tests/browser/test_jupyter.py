"""A real JupyterLab in a real browser: a figure in a cell, driven, edited, run again, saved, and without a kernel."""

import json
import os
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.request import urlopen

import pytest

pytest.importorskip("anywidget")
pytest.importorskip("jupyterlab")
nbformat = pytest.importorskip("nbformat")

CELLS = [
    """
import numpy as np, param
import reactive4d as r4

class Pendulum(r4.Illustration):
    length = param.Number(1.0, bounds=(0.2, 2.0))

    def build(self):
        bob = r4.Sphere(radius=0.2, color="crimson")
        bob.translate(r4.vec(0, 0, -self.signals.length))
        cloth = r4.Box(size=(1, 1, 0.2))
        cloth.apply(r4.Bend(30 * np.sin(r4.time) * self.signals.length, axis="x"))
        return r4.Scene(bob=bob, cloth=cloth)

fig = Pendulum()
""",
    "w = fig.show(grid=True)",
    "fig.scene['bob'].radius = 0.5",
    "print('length', fig.length, 'views', w.views)",
    "fig.length = 1.75",
    "fig",
]
FLAGS = ["--no-sandbox", "--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist", "--no-first-run"]
FLAGS += ["--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-quic"]


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, Path]]:
    """A JupyterLab of our own, with a notebook."""
    folder = tmp_path_factory.mktemp("lab")
    for name in ("config", "data", "runtime", "ipython", "work"):
        (folder / name).mkdir()
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell.strip()) for cell in CELLS])
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
    nbformat.write(notebook, folder / "work" / "x.ipynb")
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        port = found.getsockname()[1]
    root = Path(__file__).parents[2]
    environment = {
        **os.environ,
        "JUPYTER_CONFIG_DIR": str(folder / "config"),
        "JUPYTER_DATA_DIR": str(folder / "data"),
        "JUPYTER_RUNTIME_DIR": str(folder / "runtime"),
        "IPYTHONDIR": str(folder / "ipython"),
        "PYTHONPATH": os.pathsep.join([str(root), str(root / "widgets"), str(root / "apps")]),
    }
    options = [
        "--no-browser",
        f"--port={port}",
        "--ServerApp.ip=127.0.0.1",
        "--IdentityProvider.token=",
        "--allow-root",
    ]
    server = subprocess.Popen(
        [sys.executable, "-m", "jupyterlab", *options],
        cwd=folder / "work",
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    address = f"http://127.0.0.1:{port}"
    try:
        for _ in range(240):
            try:
                with urlopen(f"{address}/api", timeout=2):
                    break
            except OSError:
                time.sleep(0.25)
        yield address, folder / "work" / "x.ipynb"
    finally:
        server.terminate()
        server.wait(30)


class Lab:
    """A page of JupyterLab."""

    def __init__(self, page: Any, address: str) -> None:
        self.page = page
        self.strangers: list[str] = []
        page.on("request", self._note)
        page.goto(f"{address}/lab/workspaces/t{time.monotonic_ns()}/tree/x.ipynb?reset")
        page.wait_for_selector(".jp-Notebook .jp-CodeCell", timeout=60_000)
        page.wait_for_function("() => /\\| Idle/.test(document.body.innerText)", timeout=60_000)

    def _note(self, request: Any) -> None:
        if not request.url.startswith(("http://127.0.0.1", "ws://127.0.0.1", "data:", "blob:")):
            self.strangers.append(request.url)

    def run(self, i: int) -> None:
        """Run a cell, and wait for its end."""
        cell = self.page.locator(".jp-Notebook .jp-CodeCell").nth(i)
        cell.scroll_into_view_if_needed()
        cell.locator(".jp-InputPrompt").click()
        before = cell.locator(".jp-InputPrompt").inner_text()
        self.page.keyboard.press("Control+Enter")
        self.page.wait_for_function(
            "([i, before]) => { const p = document.querySelectorAll('.jp-Notebook .jp-CodeCell')[i]"
            ".querySelector('.jp-InputPrompt').innerText; return p !== before && /\\d/.test(p); }",
            arg=[i, before],
            timeout=60_000,
        )

    def output(self, i: int) -> str:
        """What a cell printed."""
        return self.page.locator(".jp-Notebook .jp-CodeCell").nth(i).locator(".jp-OutputArea").inner_text()

    def figure(self, script: str, arg: Any = None) -> Any:
        """What a function says of the first figure that lives."""
        return self.page.evaluate(f"(arg) => {{ {FIGURES} return ({script})(figures()[0], arg); }}", arg)

    def wait(self, script: str, arg: Any = None) -> None:
        """Until a function says yes of the first figure."""
        self.page.wait_for_function(
            f"(arg) => {{ {FIGURES} const f = figures()[0]; return f?.snapshot && ({script})(f, arg); }}",
            arg=arg,
            timeout=60_000,
        )


FIGURES = """
const figures = () => [...document.querySelectorAll(".r4d-cell")]
  .flatMap((cell) => [...cell.shadowRoot.querySelectorAll("r4d-figure")]);
"""


@pytest.fixture(scope="module")
def opened(lab: tuple[str, Path], browser: Any) -> Iterator[Lab]:
    """The notebook, with its first two cells run."""
    context = browser.new_context(viewport={"width": 1280, "height": 1000})
    page = context.new_page()
    made = Lab(page, lab[0])
    made.run(0)
    made.run(1)
    made.wait("(f) => f.snapshot !== null")
    yield made
    context.close()


def test_a_figure_lives_in_a_cell_and_its_poster_steps_back(opened: Lab) -> None:
    """Nothing is fetched from anywhere but the kernel."""
    assert opened.figure("(f) => [...f.snapshot.nodes.keys()]") == ["bob", "cloth"]
    assert opened.page.locator("img[data-r4d-poster]").count() == 1
    assert not opened.page.locator("img[data-r4d-poster]").is_visible()
    assert opened.strangers == []


def test_a_drag_ends_on_its_last_value_on_both_sides(opened: Lab) -> None:
    """In the picture and in Python."""
    opened.figure(
        """async (f) => { for (let k = 0; k <= 60; k++) {
          f.reader.change({ parameters: { length: 0.5 + k / 100 } }, { gesture: "drag" });
          await new Promise((done) => requestAnimationFrame(done)); } }"""
    )
    opened.wait("(f) => f.snapshot.parameters.length === 1.1")
    matrix = opened.figure("(f) => f.snapshot.nodes.get('bob').matrix[11]")
    assert matrix == pytest.approx(-1.1)
    opened.page.wait_for_timeout(500)
    opened.run(3)
    assert "length 1.1 views 1" in opened.output(3)


def test_an_edit_in_the_next_cell_moves_the_picture(opened: Lab) -> None:
    """And what is set in Python is where the reader is."""
    before = opened.figure("(f) => f.snapshot.nodes.get('bob').points.a.ref")
    opened.run(2)
    opened.wait("(f, before) => f.snapshot.nodes.get('bob').points.a.ref !== before", before)
    assert opened.figure("(f) => Math.max(...f.snapshot.nodes.get('bob').points.a.array)") == pytest.approx(0.5)
    opened.run(4)
    opened.wait("(f) => f.snapshot.parameters.length === 1.75 && f.reader.point.parameters.length === 1.75")


def test_running_a_cell_again_and_again_leaves_one_figure_and_one_viewer(opened: Lab) -> None:
    """Neither views nor bundles are left behind."""
    for _ in range(20):
        opened.run(1)
    opened.wait("(f) => f.snapshot !== null")
    count = opened.page.evaluate(f"() => {{ {FIGURES} return figures().length; }}")
    viewers = opened.page.evaluate("() => globalThis[Symbol.for('reactive4d.viewers')].size")
    assert (count, viewers) == (1, 1)
    opened.run(3)
    assert "views 1" in opened.output(3)


def test_the_last_line_of_a_cell_is_shown(opened: Lab) -> None:
    """As by show()."""
    opened.run(5)
    opened.page.wait_for_function(
        f"() => {{ {FIGURES} return figures().length === 2 && figures().every((f) => f.snapshot); }}", timeout=60_000
    )


def test_a_saved_notebook_shows_its_poster_without_a_kernel(opened: Lab, lab: tuple[str, Path]) -> None:
    """In JupyterLab, and in the page that nbconvert makes of it."""
    opened.page.keyboard.press("Control+s")
    path = lab[1]
    for _ in range(100):
        opened.page.wait_for_timeout(100)
        outputs = json.loads(path.read_text())["cells"][1]["outputs"]
        if len(outputs) >= 2:
            break
    assert "image/png" in outputs[0]["data"]
    assert "crimson sphere" in "".join(outputs[0]["data"]["text/plain"])
    html = subprocess.run(
        [sys.executable, "-m", "nbconvert", "--to", "html", "--stdout", str(path)], capture_output=True, check=True
    ).stdout.decode()
    assert "data-r4d-poster" in html
    assert "crimson sphere" in html
    other = opened.page.context.new_page()
    other.goto(f"{lab[0]}/doc/workspaces/t{time.monotonic_ns()}/tree/x.ipynb?reset")
    other.wait_for_selector(".jp-Notebook .jp-CodeCell", timeout=60_000)
    picture = other.locator(".jp-OutputArea img[alt*='crimson sphere']").first
    picture.wait_for(state="attached", timeout=60_000)
    other.close()
