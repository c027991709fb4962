"""What trimesh has becomes objects."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

import reactive4d as r4


def drawn(obj: r4.Object) -> Any:
    """What is drawn of an object."""
    return r4.Scene(it=obj).at(0.0)["it"].drawn


def test_a_trimesh_becomes_a_solid():
    """It is combined and deformed like any other one."""
    ring = r4.from_trimesh(trimesh.creation.annulus(0.5, 1.0, 2.0), color="gold")
    assert ring.volume.at(0.0) == pytest.approx(trimesh.creation.annulus(0.5, 1.0, 2.0).volume, rel=1e-4)
    ring.apply(r4.Twist(90 * r4.time))
    assert (ring & r4.Box(size=(9, 9, 1))).volume.at(0.0) == pytest.approx(ring.volume.at(0.0) / 2, rel=1e-3)


def test_colours_of_faces_and_of_points_are_kept():
    """A picture becomes colours of points; a colour that is given takes their place."""
    box = trimesh.creation.box()
    assert "colors" not in drawn(r4.from_trimesh(box)).attributes
    box.visual.face_colors = np.tile([255, 0, 51, 255], (12, 1)).astype(np.uint8)
    assert drawn(r4.from_trimesh(box)).attributes["colors"][0].tolist() == pytest.approx([1, 0, 0.2, 1])
    assert "colors" not in drawn(r4.from_trimesh(box, color="red")).attributes
    ball = trimesh.creation.icosphere(1)
    ball.visual.vertex_colors = np.tile([0, 255, 0, 255], (len(ball.vertices), 1)).astype(np.uint8)
    assert len(drawn(r4.from_trimesh(ball)).attributes["colors"]) == len(ball.vertices)
    picture = Image.new("RGB", (2, 2), (0, 0, 255))
    uv = np.random.default_rng(0).random((len(ball.vertices), 2))
    ball.visual = trimesh.visual.TextureVisuals(uv=uv, image=picture)
    found = drawn(r4.from_trimesh(ball))
    assert np.unique(found.attributes["colors"], axis=0).tolist() == [[0, 0, 1, 1]]
    assert np.allclose(found.attributes["uv"], uv)


def test_a_scene_becomes_a_group_in_which_everything_stands_where_it_stood():
    """Nodes share geometries; empty ones are left out."""
    scene = trimesh.Scene()
    wheel = trimesh.creation.cylinder(0.3, 0.1)
    for x in (-1.0, 1.0):
        scene.add_geometry(
            wheel,
            node_name=f"wheel/{x:g}",
            geom_name="wheel",
            transform=trimesh.transformations.translation_matrix((x, 0, 0)),
        )
    car = r4.Scene(car=r4.from_trimesh(scene))
    frame = car.at(0.0)
    assert list(frame) == ["car", "car/wheel--1", "car/wheel-1"]
    assert frame["car/wheel-1"].matrix[:3, 3].tolist() == [1, 0, 0]
    assert frame["car/wheel-1"].versions["points"] == frame["car/wheel--1"].versions["points"]
    assert np.allclose(car["car"].bounds.at(0.0), scene.bounds, atol=1e-6)


def test_clouds_and_paths_become_points_and_lines():
    """With the colours of the points."""
    cloud = trimesh.PointCloud(np.eye(3), colors=np.full((3, 4), 255, np.uint8))
    assert drawn(r4.from_trimesh(cloud)).colors.tolist() == [[1, 1, 1, 1]] * 3
    path = trimesh.load_path(np.array([[(0, 0, 0), (1, 0, 0)], [(5, 0, 0), (5, 1, 0)]], float))
    found = drawn(r4.from_trimesh(path))
    assert isinstance(found, r4.Lines)
    assert np.allclose(np.linalg.norm(np.diff(found.points[found.lines], axis=1), axis=2), 1.0)
    assert r4.from_trimesh(trimesh.path.creation.circle(radius=2.0)).bounds.at(0.0)[:, 2].tolist() == [0, 0]


def odd() -> Any:
    """A scene with what has no points at all."""
    scene: Any = trimesh.Scene()
    scene.geometry["odd"] = SimpleNamespace()
    scene.graph.update("odd", geometry="odd")
    return scene


BAD = {
    "no geometry": ("box.stl", "expected a geometry of trimesh"),
    "no faces": (trimesh.Trimesh(), "no points"),
    "a point at infinity": (
        trimesh.Trimesh([(0, 0, 0), (1, 0, 0), (0, np.nan, 0)], [(0, 1, 2)], process=False),
        r"vertices\[2\]",
    ),
    "a point too many": (trimesh.Trimesh(np.eye(3), [(0, 1, 3)], process=False), "names the point 3"),
    "an empty scene": (trimesh.Scene(), "nothing to draw"),
    "a point far away": (
        trimesh.Trimesh(np.eye(3) * 1e300, [(0, 1, 2)], process=False),
        r"geometry.vertices\[0\]: expected numbers that float32 holds",
    ),
    "a path without an entity": (trimesh.path.Path3D(vertices=np.eye(3), process=False), "a path without entities"),
    "a scene with what is no mesh": (odd(), r"geometry\['odd'\]: expected a geometry of trimesh"),
}


@pytest.mark.parametrize(("bad", "said"), BAD.values(), ids=BAD)
def test_bad_geometries_are_refused(bad: Any, said: str):
    """At the border."""
    with pytest.raises(r4.ShapeError, match=said):
        r4.from_trimesh(bad)


@settings(max_examples=50, deadline=None)
@given(data=st.data(), count=st.integers(3, 12))
def test_meshes_keep_their_bits(data: Any, count: int):
    """Points as float32, faces as they are."""
    points = data.draw(st.lists(st.tuples(*[st.floats(-9, 9, width=32)] * 3), min_size=count, max_size=count))
    faces = data.draw(st.lists(st.tuples(*[st.integers(0, count - 1)] * 3), min_size=1, max_size=9))
    found = drawn(r4.from_trimesh(trimesh.Trimesh(points, faces, process=False)))
    assert np.array_equal(found.points, np.array(points, np.float32))
    assert np.array_equal(found.faces, faces)
