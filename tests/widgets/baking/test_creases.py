"""A renderer gets the vertices that it needs to show creases, and no others."""

import math
from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d_widgets.creases import Split, split


def of(obj: r4.Object, **options: Any) -> tuple[Split, r4.Mesh]:
    """The split of an object's mesh."""
    mesh = obj.mesh.at(0.0)
    return split(mesh.points, mesh.faces, weld=mesh.attributes.get("weld"), **options), mesh


def test_a_box_has_three_vertices_at_each_corner_and_twelve_edges() -> None:
    """Its points may be divided as one likes: the flat sides have no creases."""
    for segments in ((1, 1, 1), (3, 2, 4)):
        found, mesh = of(r4.Box(segments=segments))
        assert found.origin is not None
        lengths = np.linalg.norm(mesh.points[found.edges[:, 0]] - mesh.points[found.edges[:, 1]], axis=1)
        assert lengths.sum() == pytest.approx(12)
        corners = (np.abs(mesh.points[found.origin]) > 0.49).all(axis=1)
        assert corners.sum() == 24


def test_a_ball_has_no_edges_and_one_vertex_for_each_place() -> None:
    """The seam of its texture coordinates is no crease."""
    found, mesh = of(r4.Sphere())
    assert len(found.edges) == 0
    assert found.origin is not None
    places = np.unique(mesh.attributes["weld"])
    assert sorted(found.origin.tolist()) == places.tolist()


def test_the_rims_of_a_cylinder_are_creases() -> None:
    """The side is smooth, the caps are flat."""
    found, mesh = of(r4.Cylinder(radius=1.0, height=2.0))
    assert (np.abs(mesh.points[found.edges][..., 2]) == 1.0).all()
    lengths = np.linalg.norm(mesh.points[found.edges[:, 0]] - mesh.points[found.edges[:, 1]], axis=1)
    assert lengths.sum() == pytest.approx(2 * 2 * math.pi, rel=0.02)


@pytest.mark.parametrize("kind", [r4.Sphere, r4.Box, r4.Cylinder, r4.Torus, r4.Cone, r4.Teapot, r4.Superquadric])
def test_faces_are_where_they_were(kind: type[r4.Object]) -> None:
    """Each corner's render vertex lies where the corner's point does, and no render vertex is left over."""
    found, mesh = of(kind())
    origin = np.arange(len(mesh.points)) if found.origin is None else found.origin
    assert (mesh.points[origin[found.faces]] == mesh.points[mesh.faces]).all()
    assert np.unique(found.faces).tolist() == list(range(len(origin)))


def test_points_that_are_all_used_once_need_no_map() -> None:
    """A smooth sheet: its vertices are its points, its edges its border."""
    points = np.float32([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0.1)])
    found = split(points, np.int32([(0, 1, 2), (0, 2, 3)]))
    assert found.origin is None
    assert sorted(map(tuple, found.edges.tolist())) == [(0, 1), (0, 3), (1, 2), (2, 3)]


def test_materials_meet_at_a_crease() -> None:
    """Two halves of a flat sheet of two colours have vertices of their own."""
    points = np.float32([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
    found = split(points, np.int32([(0, 1, 2), (0, 2, 3)]), groups=np.array([0, 1]))
    assert found.origin is not None
    assert found.origin.tolist() == [0, 0, 1, 2, 2, 3]
    assert (0, 2) in set(map(tuple, found.edges.tolist()))


@pytest.mark.parametrize(("angle", "edges"), [(20.0, 1), (44.0, 1), (46.0, 0), (180.0, 0)])
def test_the_angle_says_what_a_crease_is(angle: float, edges: int) -> None:
    """Two squares that meet at 45 degrees."""
    points = np.float32([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (1, -0.7, 0.7), (0, -0.7, 0.7)])
    faces = np.int32([(0, 1, 2), (0, 2, 3), (1, 0, 5), (1, 5, 4)])
    found = split(points, faces, angle=angle)
    assert sum(edge == [0, 1] for edge in found.edges.tolist()) == edges


def test_faces_without_area_are_no_reason_for_an_edge() -> None:
    """A sliver between two halves of a flat sheet."""
    points = np.float32([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 0)])
    found = split(points, np.int32([(0, 1, 2), (0, 2, 4), (0, 4, 3), (4, 2, 3)]))
    assert len(found.edges) == 4


def test_nothing_is_split_into_nothing() -> None:
    """A solid that was drilled away."""
    found = split(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32))
    assert (found.faces.shape, found.origin, found.edges.shape) == ((0, 3), None, (0, 2))
