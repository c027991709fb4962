"""Grids: the topology that several surfaces share."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive4d.errors import ShapeError
from reactive4d.geometry import grids, meshes
from reactive4d.geometry.meshes import Mesh

small = settings(max_examples=30)


@small
@given(st.integers(3, 7), st.integers(3, 7), st.booleans(), st.booleans(), st.booleans(), st.booleans())
def test_a_strip_gives_each_side_its_two_points(rows, columns, row_ring, column_ring, row_smooth, column_smooth):
    """Of every square of the grid the four points are those of neighbouring rows and columns."""
    a = grids.strip(rows, is_closed=row_ring, is_smooth=row_smooth)
    b = grids.strip(columns, is_closed=column_ring, is_smooth=column_smooth)
    triangles = grids.faces(a, b)
    squares = (rows - (not row_ring)) * (columns - (not column_ring))
    assert len(triangles) == 2 * squares
    point = (a.point[:, None] * columns + b.point[None, :]).ravel()
    weld = grids.weld(a, b)
    np.testing.assert_array_equal(point[weld], point)
    assert len(np.unique(weld)) == rows * columns
    assert (weld <= np.arange(len(weld))).all()
    texture = grids.uv(a, b)
    assert texture.shape == (len(point), 2)
    assert texture.min() == 0
    assert texture.max() == 1
    grid = np.random.default_rng(0).normal(size=(rows, columns, 3))
    assert grids.vertices(grid, a, b)[weld].tobytes() == grids.vertices(grid, a, b).tobytes()


@small
@given(st.integers(3, 8), st.integers(3, 8), st.booleans())
def test_two_rings_make_a_closed_surface(rows, columns, smooth):
    """A torus of any counts is a closed 2-manifold after welding, creased or not."""
    a = grids.strip(rows, is_closed=True, is_smooth=smooth)
    b = grids.strip(columns, is_closed=True, is_smooth=smooth)
    turn, round_ = np.arange(rows) * 2 * np.pi / rows, np.arange(columns) * 2 * np.pi / columns
    radius = 2 + np.cos(turn)
    grid = np.stack(
        [radius[:, None] * np.cos(round_), radius[:, None] * np.sin(round_), np.sin(turn)[:, None] + 0 * round_],
        axis=-1,
    )
    torus = Mesh(grids.vertices(grid, a, b), grids.faces(a, b), {"weld": grids.weld(a, b)})
    assert meshes.is_closed(torus)
    assert meshes.is_manifold(torus)
    assert meshes.volume(torus) > 0


def test_topology_is_remembered():
    """Asked again with the same counts it is the same array."""
    assert grids.faces(grids.strip(4), grids.strip(5)) is grids.faces(grids.strip(4), grids.strip(5))


def test_rows_at_one_place_are_welded():
    """Of rows of numbers the equal ones are found, where -0.0 is 0.0."""
    rows = np.array([(0.0, 1.0), (2.0, 3.0), (-0.0, 1.0), (2.0, 3.5)])
    assert grids.by_place(rows).tolist() == [0, 1, 0, 3]
    assert grids.by_place(rows[:0]).tolist() == []


def test_rings_need_three_points():
    """Two points are a chain, but no ring."""
    assert len(grids.strip(2).sides) == 1
    with pytest.raises(ShapeError, match="at least 3 points of a ring, got 2"):
        grids.strip(2, is_closed=True)
    with pytest.raises(ShapeError, match="at least 2 points, got 1"):
        grids.strip(1)
