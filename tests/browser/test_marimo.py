"""A figure in a cell of a real marimo notebook: it lives, it is driven, and Python and the reader see the same."""

import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("anywidget")
pytest.importorskip("marimo")

from labs import NEAR, PATIENCE, ROOT, free_port, started

NOTEBOOK = """
import marimo

app = marimo.App()


@app.cell
def _():
    import param
    import reactive4d as r4

    class Pendulum(r4.Illustration):
        length = param.Number(1.0, bounds=(0.2, 2.0))

        def build(self):
            bob = r4.Sphere(radius=0.2, color="crimson")
            bob.translate(r4.vec(0, 0, -self.signals.length))
            return r4.Scene(bob=bob)

    fig = Pendulum()
    fig.param.watch(lambda event: print(event.new, file=open("seen.txt", "a"), flush=True), "length")
    return fig, r4


@app.cell
def _(fig):
    fig.show(grid=True)
    return


@app.cell
def _(fig, r4):
    fig.scene["bob"].radius = 0.5
    fig
    return
"""
FIGURES = """
const found = [];
const look = (root) => {
  for (const one of root.querySelectorAll("*")) {
    if (one.localName === "r4d-figure") found.push(one);
    if (one.shadowRoot) look(one.shadowRoot);
  }
};
look(document);
"""


class Page:
    """The page of the notebook."""

    def __init__(self, page: Any, address: str, folder: Path) -> None:
        self.page = page
        self.folder = folder
        self.strangers: list[str] = []
        page.set_default_timeout(PATIENCE)
        page.on("request", lambda request: None if request.url.startswith(NEAR) else self.strangers.append(request.url))
        page.goto(address)

    def wait(self, script: str, arg: Any = None) -> None:
        """Until a function says yes of the figures, in their order."""
        self.page.wait_for_function(f"(arg) => {{ {FIGURES} return ({script})(found, arg); }}", arg=arg)

    def seen(self) -> list[float]:
        """The lengths that Python saw."""
        path = self.folder / "seen.txt"
        return [float(line) for line in path.read_text().split()] if path.exists() else []


@pytest.fixture(scope="module")
def notebook(browser: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    """The notebook, whose cells run when it is opened."""
    folder = tmp_path_factory.mktemp("marimo")
    (folder / "x.py").write_text(NOTEBOOK)
    (folder / "marimo").mkdir()
    (folder / "marimo" / "marimo.toml").write_text("[runtime]\nauto_instantiate = true\n")
    homes = ("HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME")
    variables = {
        **os.environ,
        **{name: str(folder) for name in homes},
        "PYTHONPATH": os.pathsep.join([str(ROOT), str(ROOT / "widgets"), str(ROOT / "apps")]),
    }
    address = f"http://127.0.0.1:{(port := free_port())}"
    words = ["marimo", "-q", "edit", "x.py", "--headless", "--no-token", "--skip-update-check", "--no-sandbox"]
    with started([*words, "--port", str(port)], folder, variables, f"{address}/health"):
        context = browser.new_context(viewport={"width": 1280, "height": 1000})
        page = Page(context.new_page(), address, folder)
        page.wait("(all) => all.length === 2 && all.every((f) => f.snapshot)")
        yield page
        context.close()


def test_a_figure_lives_in_a_cell_and_at_its_end(notebook: Page) -> None:
    """By `show()` and by itself; an edit of a later cell is seen in both, and nobody but the kernel is asked."""
    notebook.wait("""(all) => all.every(
        (f) => Math.abs(Math.max(...f.snapshot.nodes.get("bob").points.a.array) - 0.5) < 1e-6)""")
    assert notebook.strangers == []


def test_a_drag_of_the_slider_is_seen_in_the_figure_and_in_python(notebook: Page) -> None:
    """With the mouse, to the right end: its last value is that of both sides, and of the other figure."""
    slider = notebook.page.get_by_role("slider", name=re.compile("length", re.IGNORECASE)).first
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    assert box is not None
    middle = box["y"] + box["height"] / 2
    mouse = notebook.page.mouse
    mouse.move(box["x"] + box["width"] / 2, middle)
    mouse.down()
    mouse.move(box["x"] + box["width"] + 40, middle, steps=20)
    mouse.up()
    notebook.wait("""(all) => all.every((f) => f.snapshot.parameters.length === 2
        && Math.abs(f.snapshot.nodes.get("bob").matrix[11] + 2) < 1e-6)""")
    for _ in range(PATIENCE // 50):
        if notebook.seen()[-1:] == [2.0]:
            break
        notebook.page.wait_for_timeout(50)
    assert notebook.seen()[-1:] == [2.0]
