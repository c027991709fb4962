"""A plain plotter of PyVista in a cell of a real JupyterLab, shown by our viewer."""

from collections.abc import Iterator
from typing import Any

import pytest

pytest.importorskip("anywidget")
pytest.importorskip("jupyterlab")

import labs
from labs import Notebook

CELLS = [
    """
import numpy as np
import pyvista as pv

pv.set_jupyter_backend("reactive4d")

def plotter():
    made = pv.Plotter(notebook=True, window_size=(900, 400))
    ball = pv.Sphere()
    made.add_mesh(ball, scalars=ball.points[:, 2], cmap="coolwarm", smooth_shading=True, name="ball",
                  scalar_bar_args={"title": "height"})
    made.add_mesh(pv.Cube(center=(1.5, 0, 0)), color="tan", show_edges=True, name="box")
    made.add_points(np.random.default_rng(0).random((50, 3)) + (-2, 0, 0), color="crimson", name="cloud")
    made.camera_position = [(0.5, -6, 2), (0, 0, 0), (0, 0, 1)]
    return made
""",
    "plotter().show()",
    "plotter().show(jupyter_kwargs={'live': False, 'theme': 'dark'})",
    "pv.Cone().plot(color='tomato', return_viewer=True)",
]


@pytest.fixture(scope="module")
def opened(browser: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Notebook]:
    """The notebook, with its first two cells run."""
    with labs.opened(browser, "jupyterlab", tmp_path_factory.mktemp("pyvista"), CELLS) as made:
        yield made


def test_the_meshes_of_a_plotter_are_the_nodes_of_a_figure(opened: Notebook) -> None:
    """With the names that they were given, the colours that VTK gave them, and the plotter's camera."""
    assert opened.figure("(f) => [...f.snapshot.nodes].map(([name, node]) => [name, node.drawn])") == [
        ["ball", "mesh"],
        ["box", "none"],
        ["box/surface", "mesh"],
        ["box/edges", "lines"],
        ["cloud", "points"],
        ["camera", "camera"],
    ]
    colors = opened.figure("(f) => [...f.snapshot.nodes.get('ball').paints.points.array].slice(0, 8)")
    blue, red = (59 / 255, 76 / 255, 192 / 255, 1.0), (180 / 255, 4 / 255, 38 / 255, 1.0)
    assert colors == pytest.approx([*red, *blue], abs=0.01)  # the poles are the first points of the ball
    matrix = opened.figure("(f) => [...f.snapshot.nodes.get('camera').matrix]")
    assert [matrix[3], matrix[7], matrix[11]] == pytest.approx([0.5, -6, 2])
    assert opened.strangers == []


def test_its_scalar_bar_stands_below(opened: Notebook) -> None:
    """With its title and its limits."""
    assert opened.output(1).split()[-4:] == ["height", "-0.5", "0", "0.5"]


def test_a_plotter_may_be_baked_into_its_cell(opened: Notebook) -> None:
    """Then it needs no kernel."""
    opened.run(2)
    frame = opened.page.frame_locator("iframe[srcdoc]")
    frame.locator("r4d-figure").wait_for()
    handle = opened.page.query_selector("iframe[srcdoc]").content_frame()
    handle.wait_for_function("() => document.querySelector('r4d-figure')?.snapshot")
    names = handle.evaluate("() => [...document.querySelector('r4d-figure').snapshot.nodes.keys()]")
    assert names[0] == "ball"


def test_a_viewer_that_is_returned_is_shown_as_the_last_line(opened: Notebook) -> None:
    """`return_viewer=True` is PyVista's way to have it as a value."""
    opened.run(3)
    opened.page.wait_for_function(
        "() => [...document.querySelectorAll('.r4d-cell')].some((cell) => cell.shadowRoot &&"
        " [...cell.shadowRoot.querySelectorAll('r4d-figure')].some((f) => f.snapshot?.nodes.size === 2))"
    )
