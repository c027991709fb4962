"""A plotter of PyVista becomes a scene; PyVista finds us at its own plug-in points."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
import pyvista as pv
from matplotlib import colormaps

import reactive4d as r4
from reactive4d_widgets.backends import Cell, bar_html, handle
from reactive4d_widgets.plotters import staged
from reactive4d_widgets.renderers import Bar

pytestmark = pytest.mark.usefixtures("opengl")


@pytest.fixture
def plotter() -> Iterator[Any]:
    """A plotter that draws nowhere."""
    made = pv.Plotter(off_screen=True)
    yield made
    made.close()


def frame_of(plotter: Any) -> r4.Frame:
    """What stands in the only subplot."""
    (found,) = staged(plotter)
    return found.scene.at(0.0)


def ball() -> Any:
    """A ball with numbers at its points and at its cells."""
    made = pv.Sphere(theta_resolution=12, phi_resolution=12)
    made.point_data["h"] = made.points[:, 2].astype(float)
    made.cell_data["n"] = np.arange(made.n_cells) * 1.0
    return made


def test_numbers_have_the_colours_that_vtk_gives_them(plotter: Any):
    """Of points and of cells; by logarithms too, and grey where they are none."""
    made = ball()
    made.point_data["h"][5] = np.nan
    plotter.add_mesh(made, scalars="h", cmap="plasma", clim=(-0.5, 0.25), name="h")
    plotter.add_mesh(made, scalars="n", log_scale=True, clim=(1, 100), name="n", copy_mesh=True)
    frame = frame_of(plotter)
    colors = frame["h"].drawn.attributes["colors"]
    wanted = colormaps["plasma"](np.clip((made["h"] + 0.5) / 0.75, 0, 1))
    known = np.isfinite(made["h"])
    assert np.abs(colors[known] - wanted[known]).max() < 0.02
    assert np.allclose(colors[5], pv.Color("darkgray").float_rgba, atol=0.01)
    cells = frame["n"].drawn.attributes["colors"]
    assert len(cells) == made.n_cells
    assert np.allclose(cells[10], colormaps["viridis"](0.5), atol=0.02)


def test_looks_and_places_are_those_of_the_actors(plotter: Any):
    """Colour, opacity, position, edges, wires, points; what is hidden is left out."""
    actor = plotter.add_mesh(pv.Cube(), color="tan", opacity=0.5, name="box", show_edges=True, edge_color="red")
    actor.position = (1, 2, 3)
    plotter.add_mesh(pv.Cube(), style="wireframe", color="blue", name="wire")
    plotter.add_mesh(pv.Cube(), style="points", color="lime", name="dots")
    plotter.add_mesh(pv.Line(), color="black", name="line")
    plotter.add_mesh(pv.Cube(), name="hidden").SetVisibility(False)
    plotter.add_mesh(pv.MultiBlock({"a": pv.Sphere(), "b": pv.Cone()}), color="orange", name="blocks")
    frame = frame_of(plotter)
    assert [(name, node.primitive) for name, node in frame.items()] == [
        ("box", "none"),
        ("box/surface", "mesh"),
        ("box/edges", "lines"),
        ("wire", "lines"),
        ("dots", "points"),
        ("line", "lines"),
        ("blocks", "none"),
        ("blocks/a", "mesh"),
        ("blocks/b", "mesh"),
        ("camera", "camera"),
    ]
    assert frame["box/surface"].matrix[:3, 3].tolist() == [1, 2, 3]
    assert frame["box/surface"].color.tolist() == pytest.approx([*pv.Color("tan").float_rgb, 0.5])
    assert frame["box/edges"].color[:3].tolist() == [1, 0, 0]
    assert len(frame["wire"].drawn.lines) == 12
    assert frame["dots"].color.tolist() == [0, 1, 0, 1]


def test_the_camera_is_the_plotters(plotter: Any):
    """Where rays are parallel, one stands far away and sees as much."""
    plotter.add_mesh(pv.Cube(), name="box")
    plotter.camera_position = [(0, -8, 2), (0, 0, 1), (0, 0, 1)]
    plotter.camera.view_angle = 20
    node = frame_of(plotter)["camera"]
    assert node.matrix[:3, 3].tolist() == [0, -8, 2]
    assert node.drawn["fov"] == 20
    plotter.enable_parallel_projection()
    plotter.camera.parallel_scale = 2.0
    node = frame_of(plotter)["camera"]
    distance = np.linalg.norm(node.matrix[:3, 3] - (0, 0, 1))
    assert distance * np.tan(np.radians(node.drawn["fov"] / 2)) == pytest.approx(2.0)


def test_lights_of_the_scene_stay_and_those_that_go_round_with_the_eye_are_ours():
    """A spot with its cone; without any of its own a plotter is lit by our studio."""
    plotter = pv.Plotter(off_screen=True, lighting="none")
    plotter.add_light(pv.Light(position=(0, 0, 5), color="red", positional=True, cone_angle=20, intensity=0.7))
    node = frame_of(plotter)["light1"]
    assert (node.drawn["light_type"], node.drawn["angle"], node.drawn["intensity"]) == ("spot", 40, 0.7)
    assert node.color[:3].tolist() == [1, 0, 0]
    assert np.allclose(-node.matrix[:3, 2], (0, 0, -1))
    plotter.close()
    plotter = pv.Plotter(off_screen=True)
    plotter.add_mesh(pv.Cube())
    assert not [node for node in frame_of(plotter).values() if node.primitive == "light"]
    plotter.close()


def test_what_a_scene_cannot_have_is_said(plotter: Any):
    """Texts are left out with a warning; volumes make PyVista draw the picture."""
    plotter.add_mesh(ball(), scalars="h")
    plotter.add_text("hello")
    with pytest.warns(UserWarning, match="reactive4d does not show texts and labels"):
        assert isinstance(handle(plotter), Cell)
    plotter.add_volume(pv.ImageData(dimensions=(4, 4, 4)).point_data_to_cell_data(), scalars=np.arange(27.0))
    with pytest.warns(UserWarning, match="volumes cannot be shown"):
        assert type(handle(plotter)).__module__.startswith("PIL")
    with pytest.raises(r4.Reactive4dError, match="colour: no option"):
        handle(plotter, colour="red")


def test_every_subplot_is_a_scene_of_its_own():
    """With its own camera; PyVista's accessor gives the active one."""
    plotter = pv.Plotter(off_screen=True, shape=(1, 2))
    plotter.add_mesh(pv.Cube(), name="box")
    plotter.subplot(0, 1)
    plotter.add_mesh(pv.Sphere(), name="ball")
    assert [list(part.scene) for part in staged(plotter)] == [["box", "camera"], ["ball", "camera"]]
    assert list(plotter.reactive4d.scene) == ["ball", "camera"]
    plotter.close()


def test_pyvista_finds_us_by_itself(run_python: Any):
    """Nothing of ours was imported; and `import pyvista` imports nothing of ours."""
    said = run_python("""
import sys, pyvista as pv
before = any(name.startswith("reactive4d") for name in sys.modules)
pv.set_jupyter_backend("reactive4d")
print(before, pv.global_theme.jupyter_backend, type(pv.Sphere().reactive4d.object(color="red")).__name__)
""")
    assert said == "False reactive4d Model"


def test_a_plotter_writes_a_page(plotter: Any, tmp_path: Any):
    """By its accessor, as it stands."""
    plotter.add_mesh(ball(), scalars="h", name="ball")
    report = plotter.reactive4d.bake(tmp_path / "plot.html", times=(0, 0), progress=False)
    assert report.path.read_text(encoding="utf-8").startswith("<!doctype html>")


def test_titles_are_text_in_html():
    """Whatever stands in them."""
    assert "<script>" not in bar_html(Bar("<script>", np.zeros((2, 3), np.uint8), 0.0, 1.0))
