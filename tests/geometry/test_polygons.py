"""Polygons as triangles: the area stays, and so does the side they look to."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive4d.errors import ShapeError
from reactive4d.geometry.polygons import triangulated


@settings(max_examples=40)
@given(st.integers(3, 12), st.integers(0, 2**32 - 1))
def test_a_star_shaped_polygon_keeps_its_vector_area(count, seed):
    """Concave or not, in any plane: the triangles' vector areas sum up, and none looks the other way."""
    rng = np.random.default_rng(seed)
    angle = 2 * math.pi * np.arange(count) / count
    flat = rng.uniform(0.3, 2, count)[:, None] * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    points = flat @ turn.T + 1.0
    faces, owner = triangulated(points, np.array([count]), np.arange(count))
    assert len(faces) == count - 2
    assert owner.tolist() == [0] * (count - 2)
    a, b, c = points[faces].transpose(1, 0, 2)
    parts = np.cross(b - a, c - a) / 2
    whole = np.cross(points - 1, np.roll(points, -1, axis=0) - 1).sum(axis=0) / 2
    np.testing.assert_allclose(parts.sum(axis=0), whole, atol=1e-9)
    assert (parts @ whole).min() >= -1e-9


def test_triangles_come_in_the_order_of_their_polygons():
    """Of mixed sizes each triangle tells its polygon; lines and points vanish."""
    points = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.2, 0)])
    sizes = np.array([4, 2, 3, 1, 4])
    corners = np.array([0, 1, 2, 3, 0, 1, 0, 1, 2, 4, 0, 1, 4, 3])
    faces, owner = triangulated(points, sizes, corners)
    assert owner.tolist() == [0, 0, 2, 4, 4]
    assert faces[2].tolist() == [0, 1, 2]


def test_a_corner_that_is_no_point_is_refused():
    """The face and the index are named."""
    with pytest.raises(ShapeError, match="face 1: 9 is no point; there are 3"):
        triangulated(np.zeros((3, 3)), np.array([3, 3]), np.array([0, 1, 2, 0, 1, 9]))
