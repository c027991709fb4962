"""Spline patches: what they pass through, and where they are welded."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive4d.errors import ShapeError
from reactive4d.geometry import curves, meshes, patches
from reactive4d.geometry.solids import from_mesh

small = settings(max_examples=20)


def net(rows, columns, seed=0):
    """A bumpy net over a square grid."""
    y, x = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    return np.stack([x, y, np.random.default_rng(seed).normal(size=x.shape)], axis=-1).astype(float)


@pytest.mark.parametrize("kind", curves.KINDS)
def test_a_patch_passes_through_the_corners_of_its_net(kind):
    """Its edges are the curves of the net's edges."""
    controls = net(4, 7)
    grid = patches.points(controls, segments=(6, 12), kind=kind).reshape(7, 13, 3)
    corners = grid[[0, 0, -1, -1], [0, -1, 0, -1]]
    np.testing.assert_allclose(corners, controls[[0, 0, -1, -1], [0, -1, 0, -1]], atol=1e-6)
    np.testing.assert_allclose(grid[0], curves.polyline(controls[0], 12, kind=kind), atol=1e-6)
    np.testing.assert_allclose(grid[:, -1], curves.polyline(controls[:, -1], 6, kind=kind), atol=1e-6)


@small
@given(st.sampled_from(curves.KINDS), st.floats(0, 1), st.floats(0, 1))
def test_a_patch_is_a_curve_of_curves(kind, u, v):
    """The point at (u, v) is the point v of the curve whose control points are the rows' points at u."""
    controls = net(4, 7, seed=1)
    column = np.array([curves.position(row, u, kind=kind) for row in controls])
    expected = curves.position(column, v, kind=kind)
    np.testing.assert_allclose(patches.position(controls, [u], [v], kind=kind)[0], expected, atol=1e-12)


def test_normals_are_across_both_parameters():
    """Exact normals agree with those of a fine mesh."""
    controls = net(5, 6, seed=2)
    surface = patches.mesh(controls, segments=(80, 80), kind="bspline")
    exact = patches.normals(controls, segments=(80, 80), kind="bspline")
    np.testing.assert_allclose(np.linalg.norm(exact, axis=1), 1, atol=1e-6)
    assert np.einsum("ij,ij->i", exact, meshes.normals(surface)).min() > 0.995
    assert exact[:, 2].min() > 0  # u, v and the normal are right-handed


def test_a_patch_of_equal_steps_is_flat():
    """The area of a flat patch is that of its net, for each kind."""
    for kind in curves.KINDS:
        flat = patches.mesh(net(4, 4) * [1, 1, 0], segments=(3, 3), kind=kind)
        assert meshes.area(flat) == pytest.approx(9)


def test_a_net_closed_both_ways_is_a_torus():
    """A closed 2-manifold of genus 1 whose volume tends to that of the B-spline's circles."""
    a, b = np.arange(8) * math.tau / 8, np.arange(12) * math.tau / 12
    radius = 3 + np.cos(a)[:, None]
    controls = np.stack([radius * np.cos(b), radius * np.sin(b), np.sin(a)[:, None] + 0 * b], axis=-1)
    for kind in ("bspline", "catmull_rom", "linear"):
        torus = patches.mesh(controls, segments=(16, 24), kind=kind, closed=(True, True))
        assert meshes.is_closed(torus)
        assert meshes.volume(torus) > 0
        assert from_mesh(torus).manifold.genus() == 1


def test_edges_of_one_point_are_welded():
    """A net closed one way whose first and last rows are points is a closed surface like a sphere."""
    a, b = np.linspace(-math.pi / 2, math.pi / 2, 7), np.arange(8) * math.tau / 8
    radius = np.cos(a)[:, None] * [[0], [1], [1], [1], [1], [1], [0]]
    controls = np.stack([radius * np.cos(b), radius * np.sin(b), np.sin(a)[:, None] + 0 * b], axis=-1)
    for kind in ("bspline", "catmull_rom", "linear"):
        ball = patches.mesh(controls, segments=(12, 16), kind=kind, closed=(False, True))
        assert meshes.is_closed(ball)
        assert from_mesh(ball).manifold.genus() == 0
        assert ball.points[ball.attributes["weld"]].tobytes() == ball.points.tobytes()


def test_what_is_no_net_is_refused():
    """Shapes, counts and finiteness are named."""
    with pytest.raises(ShapeError, match=r"shape \(R, C, 3\), got shape \(4, 3\)"):
        patches.mesh([(0, 0, 0)] * 4)
    with pytest.raises(ShapeError, match="segments: expected two numbers"):
        patches.mesh(net(4, 4), segments=(0, 4))
    with pytest.raises(ShapeError, match="expected finite numbers"):
        patches.mesh(net(4, 4) * math.nan)
    with pytest.raises(ShapeError, match="no whole number"):
        patches.mesh(net(4, 6))
