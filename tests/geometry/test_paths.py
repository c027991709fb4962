"""Frames along a path: rotations that follow it and turn as little as they can."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive4d.errors import ShapeError
from reactive4d.geometry import paths

small = settings(max_examples=25)
points = st.lists(st.tuples(*[st.floats(-5, 5)] * 3), min_size=3, max_size=12)


def ring(count, radius=1.0):
    """A closed circle in the plane of x and y; the last point is the first."""
    angle = np.arange(count) * 2 * math.pi / count
    x = np.stack([radius * np.cos(angle), radius * np.sin(angle), 0 * angle], axis=1)
    return np.concatenate([x, x[:1]])


@small
@given(points, st.booleans())
def test_frames_are_rotations_along_the_tangents(points, closed):
    """Orthonormal, right-handed, the third column is the tangent; a closed path ends with the frame it began with."""
    x = np.array([*points, points[0]] if closed else points)
    if np.ptp(x, axis=0).max() < 1e-3:
        return
    t = paths.chord_tangents(x, closed=closed)
    f = paths.frames(x, t, closed=closed)
    np.testing.assert_allclose(f @ f.transpose(0, 2, 1), np.broadcast_to(np.eye(3), f.shape), atol=1e-9)
    np.testing.assert_allclose(np.linalg.det(f), 1, atol=1e-9)
    np.testing.assert_allclose(f[:, :, 2], t, atol=1e-12)
    if closed:
        assert f[0].tobytes() == f[-1].tobytes()


def test_a_planar_path_keeps_its_binormal():
    """In a plane nothing turns about the path: the direction across the plane stays."""
    x = ring(24)[:-4]
    f = paths.frames(x, normal=(0, 0, 1))
    np.testing.assert_allclose(f[:, :, 0], np.broadcast_to((0, 0, 1), x.shape), atol=1e-12)


def test_along_z_the_frame_is_the_world_s():
    """So a section swept straight up is a prism that is not turned; straight down it is turned over about x."""
    up = np.array([(0, 0, z) for z in range(4)])
    np.testing.assert_array_equal(paths.frames(up), np.broadcast_to(np.eye(3), (4, 3, 3)))
    np.testing.assert_array_equal(paths.frames(up[::-1]), np.broadcast_to(np.diag([1.0, -1, -1]), (4, 3, 3)))


@small
@given(points, st.tuples(*[st.floats(-1, 1)] * 3), st.floats(0, 6))
def test_a_rigid_motion_of_the_path_moves_the_frames_with_it(points, axis, angle):
    """Given the turned normal, the frames of the turned path are the turned frames."""
    x = np.array(points)
    axis = np.array(axis)
    if np.linalg.norm(axis) < 0.1 or np.linalg.norm(np.diff(x, axis=0), axis=1).min() < 0.1:
        return
    t = paths.chord_tangents(x)
    if np.einsum("ij,ij->i", t[1:], t[:-1]).min() < -0.9:
        return  # a path that turns back has no least turn
    k = axis / np.linalg.norm(axis)
    cross = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    turn = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    f = paths.frames(x, t)
    g = paths.frames(x @ turn.T + 1, t @ turn.T, normal=turn @ f[0, :, 0])
    np.testing.assert_allclose(g, turn @ f, atol=1e-6)


def test_a_helix_s_frames_turn_by_its_torsion():
    """Against the Frenet frame they turn back by torsion times length, to the fourth order of the step."""
    a, b = 1.0, 0.4
    errors = []
    for count in (41, 81):
        s = np.linspace(0, 3, count)
        x = np.stack([a * np.cos(s), a * np.sin(s), b * s], axis=1)
        t = np.stack([-a * np.sin(s), a * np.cos(s), 0 * s + b], axis=1) / math.hypot(a, b)
        frenet = np.stack([-np.cos(s), -np.sin(s), 0 * s], axis=1)
        f = paths.frames(x, t, normal=frenet[0])
        across = np.cross(t, frenet)
        turned = math.atan2(f[-1, :, 0] @ across[-1], f[-1, :, 0] @ frenet[-1])
        torsion_times_length = b / (a * a + b * b) * 3 * math.hypot(a, b)
        errors.append(abs(turned + torsion_times_length))
    assert errors[0] < 1e-5
    assert errors[1] < errors[0] / 12


def test_points_that_coincide_turn_the_frame_and_nothing_else():
    """A path that stands still for a while goes on with the same frame."""
    x = [(0, 0, 0), (0, 0, 1), (0, 0, 1), (0, 0, 1), (0, 0, 2)]
    np.testing.assert_allclose(paths.frames(x), np.broadcast_to(np.eye(3), (5, 3, 3)), atol=1e-12)
    t = [(0, 0, 1), (0, 0, 1), (0, 1, 0), (1, 0, 0), (1, 0, 0)]
    f = paths.frames(x, t)
    np.testing.assert_allclose(np.linalg.det(f), 1)
    np.testing.assert_allclose(f[:, :, 2], t, atol=1e-12)


def test_chord_tangents_of_closed_chains_look_over_the_seam():
    """At the first point of a ring the mean of the last chord and the first is across the radius."""
    x = ring(7)
    t = paths.chord_tangents(x, closed=True)
    np.testing.assert_allclose(np.einsum("ij,ij->i", t, x), 0, atol=1e-12)
    assert t[0].tobytes() == t[-1].tobytes()


def test_lengths_grow_by_the_chords():
    """A ring of n points of radius 1 is 2 n sin(pi / n) long."""
    assert paths.lengths(ring(9))[-1] == pytest.approx(18 * math.sin(math.pi / 9))


def test_what_has_no_direction_is_refused():
    """Paths of one place, tangents of no length, normals along the path and wrong shapes are named."""
    with pytest.raises(ShapeError, match="a path of one point has no direction"):
        paths.frames([(1, 1, 1)] * 3)
    with pytest.raises(ShapeError, match="at least 2, got 1"):
        paths.frames([(1, 1, 1)])
    with pytest.raises(ShapeError, match="the one of point 1 has no direction"):
        paths.frames([(0, 0, 0), (0, 0, 1)], [(0, 0, 1), (0, 0, 0)])
    with pytest.raises(ShapeError, match="no part across the path"):
        paths.frames([(0, 0, 0), (0, 0, 1)], normal=(0, 0, -2))
    with pytest.raises(ShapeError, match="normal: expected 3 finite numbers"):
        paths.frames([(0, 0, 0), (0, 0, 1)], normal=(0, math.nan, 1))
    with pytest.raises(ShapeError, match=r"points: expected shape \(N, 3\)"):
        paths.frames([(0, 0), (0, 1)])
    with pytest.raises(ShapeError, match=r"tangents: expected shape \(2, 3\)"):
        paths.frames([(0, 0, 0), (0, 0, 1)], [(0, 0, 1)])
    with pytest.raises(ShapeError, match="points: expected finite numbers"):
        paths.frames([(0, 0, 0), (0, 0, math.inf)])
