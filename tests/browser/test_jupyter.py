"""A figure in a cell of a real JupyterLab and a real Notebook 7: driven, edited, run again, saved, without a kernel."""

import re
from collections.abc import Iterator
from typing import Any

import pytest

pytest.importorskip("anywidget")
pytest.importorskip("jupyterlab")
pytest.importorskip("notebook")

import labs
from labs import FIGURES, Notebook

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
    """
import ipywidgets
hand, told = ipywidgets.FloatSlider(max=10, step=0.5), ipywidgets.FloatText()
ipywidgets.jslink((hand, "value"), (w, "time"))
ipywidgets.link((w, "time"), (told, "value"))
hand
""",
    "hand.value = 2.5",
    "print('told', told.value)",
    "Pendulum(length=0.5).show(save=True)",
]
# What the notebook kept of the figure in its last cell; it wakes when no kernel answers and somebody looks at it.
LOOK = """[...document.querySelectorAll("[data-r4d-poster]")].at(-1)?.scrollIntoView()"""
KEPT = """() => [...document.querySelectorAll("[data-r4d-poster] .r4d-cell")]
  .map((cell) => cell.shadowRoot.querySelector("r4d-figure"))
  .find((figure) => figure?.snapshot?.parameters.length === 0.5)"""


@pytest.fixture(scope="module", params=["jupyterlab", "notebook"])
def opened(
    request: pytest.FixtureRequest, browser: Any, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Notebook]:
    """The notebook, with its first two cells run."""
    with labs.opened(browser, request.param, tmp_path_factory.mktemp(request.param), CELLS) as made:
        yield made


def test_a_figure_lives_in_a_cell_and_its_poster_steps_back(opened: Notebook) -> None:
    """Nothing is fetched from anywhere but the kernel."""
    assert opened.figure("(f) => [...f.snapshot.nodes.keys()]") == ["bob", "cloth"]
    kept = opened.page.locator("[data-r4d-poster]")
    assert kept.count() == 1
    assert not kept.is_visible()
    assert opened.strangers == []


def test_a_drag_ends_on_its_last_value_on_both_sides(opened: Notebook) -> None:
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


def test_an_edit_in_the_next_cell_moves_the_picture(opened: Notebook) -> None:
    """And what is set in Python is where the reader is."""
    before = opened.figure("(f) => f.snapshot.nodes.get('bob').points.a.ref")
    opened.run(2)
    opened.wait("(f, before) => f.snapshot.nodes.get('bob').points.a.ref !== before", before)
    assert opened.figure("(f) => Math.max(...f.snapshot.nodes.get('bob').points.a.array)") == pytest.approx(0.5)
    opened.run(4)
    opened.wait("(f) => f.snapshot.parameters.length === 1.75 && f.reader.point.parameters.length === 1.75")


def test_other_widgets_can_be_linked(opened: Notebook) -> None:
    """In the page by `jslink`, in the kernel by `link`: time is a trait."""
    opened.run(6)
    opened.run(7)
    opened.wait("(f) => f.snapshot.time === 2.5")
    opened.figure("(f) => f.reader.change({ time: 4.5 })")
    opened.wait("(f) => f.snapshot.time === 4.5")
    while "told 4.5" not in opened.output(8):
        opened.run(8)
    assert opened.cell(6).locator(".widget-readout").inner_text() == "4.50"


def test_running_a_cell_again_and_again_leaves_one_figure_and_one_viewer(opened: Notebook) -> None:
    """Neither views nor bundles are left behind."""
    for _ in range(20):
        opened.run(1)
    opened.wait("(f) => f.snapshot !== null")
    viewers = opened.page.evaluate("() => globalThis[Symbol.for('reactive4d.viewers')].size")
    assert (opened.figures(), viewers) == (1, 1)
    opened.run(3)
    assert "views 1" in opened.output(3)


def test_the_last_line_of_a_cell_is_shown(opened: Notebook) -> None:
    """As by show()."""
    opened.run(5)
    opened.page.wait_for_function(
        f"() => {{ {FIGURES} return figures().length === 2 && figures().every((f) => f.snapshot); }}"
    )


def test_what_a_saved_notebook_keeps_is_seen_and_scrubs_without_a_kernel(opened: Notebook) -> None:
    """Opened again where no kernel can be had: the pictures, and of a figure that was kept whole, all its times."""
    opened.run(9)
    outputs: list[Any] = []
    while not outputs or "data-r4d-table" not in "".join(outputs[0].get("data", {}).get("text/html", "")):
        opened.save()
        opened.page.wait_for_timeout(100)
        outputs = opened.saved()[9]["outputs"]
    assert "crimson sphere" in "".join(outputs[0]["data"]["text/plain"])
    page = opened.page.context.new_page()
    for what in ("sessions", "kernels"):
        page.route(re.compile(f"/api/{what}"), lambda route: route.abort())
    other = Notebook(page, opened.program, opened.address, is_idle=False)
    page.locator("[data-r4d-poster] img[alt*='crimson sphere']").first.wait_for(state="attached")
    page.wait_for_function(f"() => {{ {LOOK}; return ({KEPT})(); }}", polling=500)
    first = page.evaluate(f"() => [...({KEPT})().snapshot.nodes.get('cloth').points.a.array]")
    page.evaluate(f"() => ({KEPT})().reader.change({{ time: 4.5 }})")
    page.wait_for_function(f"() => ({KEPT})().snapshot.time === 4.5")
    assert page.evaluate(f"() => [...({KEPT})().snapshot.nodes.get('cloth').points.a.array]") != first
    assert page.evaluate(f"() => ({KEPT})().snapshot.nodes.get('bob').matrix[11]") == pytest.approx(-0.5)
    assert other.strangers == []
    page.close()
