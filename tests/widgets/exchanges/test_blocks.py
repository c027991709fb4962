"""Scenes become PyVista's own data: with names, places and colours."""

from typing import Any

import numpy as np
import param
import pytest
import pyvista as pv
from hypothesis import given
from hypothesis import strategies as st

import reactive4d as r4


class Slider(r4.Illustration):
    """A ball that slides."""

    length = param.Number(2.0, bounds=(1.0, 5.0))
    space = param.Number(1.0, bounds=(0.5, 2.0))

    def build(self) -> r4.Scene:
        """One ball."""
        ball = r4.Sphere(self.signals.space)
        ball.translate(r4.vec(self.signals.length * r4.time, 0, 0))
        return r4.Scene(ball=ball)


def everything() -> r4.Scene:
    """One of each that can be drawn, and some that are not."""
    return r4.Scene(
        ball=r4.Sphere(color="red", opacity=0.5),
        part=r4.Box(color="blue") - r4.Sphere(0.6, color="lime"),
        way=r4.Path([(0, 0, 0), (1, 0, 0), (1, 1, 0)], samples=8, color="black"),
        ring=r4.Circle(segments=12),
        dot=r4.Point((1, 2, 3)),
        word=r4.Label("hello", at=(0, 0, 2)),
        eye=r4.Camera(),
        lamp=r4.Light(),
        hidden=r4.Box(visible=False),
        empty=r4.Model(),
        pair=r4.Group(a=r4.Box(), inner=r4.Group(b=r4.Torus())),
    )


def test_every_name_of_a_scene_is_a_block_and_what_is_not_drawn_is_none():
    """Names keep their order; groups are blocks within blocks."""
    found = everything().to_pyvista()
    assert found.keys() == list(everything())
    assert [name for name in found.keys() if found[name] is None] == ["eye", "lamp", "hidden", "empty"]  # noqa: SIM118
    assert found["pair"].keys() == ["a", "inner"]
    assert found["pair"]["inner"].keys() == ["b"]
    counts = {
        name: (found[name].regular_faces.size, found[name].n_lines, found[name].n_verts) for name in ("way", "dot")
    }
    assert counts == {"way": (0, 1, 0), "dot": (0, 0, 1)}
    assert found["ring"].n_lines == 12
    assert (found["word"].n_cells, found["word"]["text"].tolist()) == (0, ["hello"])
    assert found["word"].points.tolist() == [[0, 0, 2]]


def test_colours_are_arrays_of_points_or_where_faces_differ_of_cells():
    """Red, green, blue and alpha, 0 to 255, as PyVista takes them with `rgb=True`."""
    found = everything().to_pyvista()
    assert np.unique(found["ball"].point_data["colors"], axis=0).tolist() == [[255, 0, 0, 128]]
    assert np.unique(found["part"].cell_data["colors"], axis=0).tolist() == [[0, 0, 255, 255], [0, 255, 0, 255]]
    assert found["way"].point_data["colors"][0].tolist() == [0, 0, 0, 255]
    assert found["ball"].active_scalars_name == "colors"


def test_the_points_are_those_of_the_world_or_with_their_matrix_those_of_the_object():
    """The matrix takes one to the other, groups above it included."""
    ball = r4.Sphere()
    ball.apply(r4.Bend(1.0))
    ball.translate((1, 2, 3))
    group = r4.Group(ball=ball)
    group.rotate(r4.time)
    scene = r4.Scene(group=group)
    world, local = (scene.to_pyvista(30.0, space=space)["group"]["ball"] for space in ("world", "local"))
    matrix = np.array(local.field_data["matrix"])
    assert matrix.shape == (4, 4)
    assert np.allclose(local.points @ matrix[:3, :3].T + matrix[:3, 3], world.points, atol=1e-6)
    assert "matrix" not in world.field_data
    assert np.allclose(world.points, scene.at(30.0)["group/ball"].mesh.points)


@pytest.mark.parametrize("space", ["world", "local"])
def test_a_mirror_leaves_the_outside_outside(space: str):
    """VTK reckons a volume from the order of the corners."""
    box = r4.Box(size=(1, 2, 3))
    box.apply(r4.Mirror((1, 0, 0)))
    found = r4.Scene(box=box).to_pyvista(space=space)["box"]
    assert found.volume == pytest.approx(6.0)


def test_an_illustration_is_given_at_its_readers_point():
    """Its time and its values, unless others are given; names that are taken go into `parameters`."""
    slider = Slider(length=3.0)
    slider.point = r4.Bookmark(2.0)
    assert slider.to_pyvista()["ball"].center[0] == pytest.approx(6.0)
    assert slider.to_pyvista(1.0)["ball"].center[0] == pytest.approx(3.0)
    assert slider.to_pyvista(1.0, length=5)["ball"].center[0] == pytest.approx(5.0)
    assert slider.to_pyvista(1.0, parameters={"space": 2.0})["ball"].length == pytest.approx(
        2 * slider.to_pyvista()["ball"].length, rel=1e-3
    )
    assert slider.length == 3.0


def test_what_is_asked_for_and_not_there_is_refused():
    """At the border, with what there is."""
    with pytest.raises(r4.UnknownNameError, match="unknown space 'word'") as caught:
        everything().to_pyvista(space="word")
    assert "did you mean 'world'?" in str(caught.value.__notes__)
    with pytest.raises(r4.UnknownNameError, match="lenght"):
        Slider().to_pyvista(lenght=2.0)


@given(
    corners=st.lists(st.tuples(*[st.floats(-10, 10, width=32)] * 3), min_size=3, max_size=9),
    values=st.data(),
)
def test_meshes_keep_their_bits(corners: list[Any], values: Any):
    """Points, faces, textures' coordinates and arrays of one's own come out as they went in."""
    count = len(corners)
    faces = values.draw(st.lists(st.tuples(*[st.integers(0, count - 1)] * 3), min_size=count + 1, max_size=count + 4))
    mesh = r4.Mesh(corners, faces, {"uv": np.array(corners)[:, :2], "weld": np.zeros(count, int)})
    data = r4.Scene(it=r4.Model(mesh)).to_pyvista()["it"]
    assert isinstance(data, pv.PolyData)
    assert np.array_equal(data.points, mesh.points)
    assert np.array_equal(data.regular_faces, mesh.faces)
    assert np.array_equal(data.active_texture_coordinates, mesh.attributes["uv"])


def test_pyvista_is_not_imported_before_it_is_wanted(run_python: Any):
    """`import reactive4d` stays light."""
    said = run_python(
        "import sys, reactive4d as r4; s = r4.Scene(b=r4.Box()); s.at(0.0); print('pyvista' in sys.modules)"
    )
    assert said == "False"
