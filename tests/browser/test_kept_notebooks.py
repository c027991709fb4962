"""What a notebook keeps of a figure: the page that the real nbconvert makes of it, opened from the disk."""

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("anywidget")
pytest.importorskip("nbconvert")

from labs import environment, written
from readers import PATIENCE

CELLS = [
    """
import numpy as np, param
import reactive4d as r4

class Swing(r4.Illustration):
    length = param.Number(1.0, bounds=(0.2, 2.0))

    def build(self):
        bob = r4.Sphere(radius=0.2, color="crimson")
        bob.translate(r4.vec(0, 0, -self.signals.length))
        cloth = r4.Box(size=(1, 1, 0.2))
        cloth.apply(r4.Bend(30 * np.sin(r4.time), axis="x"))
        return r4.Scene(bob=bob, cloth=cloth)

swing = Swing()
""",
    "swing.show(save=True, height=300)",
    "swing.show(save=False)",
    "swing.show(save=1000)",
]


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The notebook, run and converted by nbconvert as it comes."""
    folder = tmp_path_factory.mktemp("kept")
    written(folder / "x.ipynb", CELLS)
    command = [sys.executable, "-m", "nbconvert", "--to", "html", "--execute", "x.ipynb"]
    subprocess.run(command, cwd=folder, env=environment(folder), check=True, capture_output=True, timeout=300)
    return folder / "x.html"


class Kept:
    """The page in a browser without a network."""

    def __init__(self, browser: Any, path: Path, *, scripts: bool = True) -> None:
        self.context = browser.new_context(
            viewport={"width": 1000, "height": 1000}, offline=True, java_script_enabled=scripts
        )
        self.page: Any = self.context.new_page()
        self.page.set_default_timeout(PATIENCE)
        self.uncaught: list[str] = []
        self.page.on("pageerror", lambda error: self.uncaught.append(str(error)))
        self.page.goto(path.resolve().as_uri())
        self.places = self.page.locator("[data-r4d-poster]")

    def figure(self, script: str) -> Any:
        """What a function says of the first figure that is kept."""
        return self.page.evaluate(f"() => {{ {FIRST} return ({script})(figure); }}")

    def until(self, script: str) -> None:
        """Until it says yes."""
        self.page.wait_for_function(f"() => {{ {FIRST} return figure?.snapshot && ({script})(figure); }}")


FIRST = """
const cell = document.querySelector("[data-r4d-poster] .r4d-cell");
const figure = cell?.shadowRoot.querySelector("r4d-figure");
"""


@pytest.fixture
def opened(browser: Any, page: Path) -> Iterator[Kept]:
    """The page, opened."""
    made = Kept(browser, page)
    yield made
    made.context.close()


def test_a_kept_figure_scrubs_without_a_kernel_and_without_a_network(opened: Kept) -> None:
    """What moves is there at any time; what follows a parameter exactly follows it here, too."""
    opened.until("(f) => f.snapshot.time === 0")
    opened.figure("(f) => { f.reader.change({ time: 1.5, parameters: { length: 1.7 } }); }")
    opened.until("(f) => f.snapshot.time === 1.5 && f.snapshot.parameters.length === 1.7")
    assert opened.figure("(f) => f.snapshot.nodes.get('bob').matrix[11]") == pytest.approx(-1.7)
    first = opened.figure("(f) => [...f.snapshot.nodes.get('cloth').points.a.array]")
    opened.figure("(f) => { f.reader.change({ time: 4.5 }); }")
    opened.until("(f) => f.snapshot.time === 4.5")
    assert opened.figure("(f) => [...f.snapshot.nodes.get('cloth').points.a.array]") != first
    assert opened.uncaught == []


def test_what_is_not_kept_is_a_picture_and_says_why(opened: Kept) -> None:
    """Who wanted a picture is told nothing; who wanted more than fits is told how much it takes."""
    opened.until("() => true")
    assert opened.places.count() == 3
    images = [opened.places.nth(i).locator("img") for i in (1, 2)]
    assert all("crimson sphere" in image.get_attribute("alt") for image in images)
    assert all(image.evaluate("(image) => image.naturalWidth") == 960 for image in images)
    assert opened.places.nth(1).inner_text() == ""
    assert "more than 0.001 MB; show(save=" in opened.places.nth(2).inner_text()


def test_where_no_script_runs_the_pictures_are_seen(browser: Any, page: Path) -> None:
    """As on a site that shows notebooks without their scripts."""
    kept = Kept(browser, page, scripts=False)
    assert [kept.places.nth(i).locator("img").is_visible() for i in range(3)] == [True] * 3
    kept.context.close()
