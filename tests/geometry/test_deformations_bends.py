"""The laws of bending: arcs, lengths, and straight continuation."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from reactive4d.geometry.deformations.bends import Bend
from reactive4d.geometry.deformations.stacks import deform

Array = NDArray[Any]

angles = st.floats(0.01, 6.0).flatmap(lambda size: st.sampled_from((size, -size)))
heights = st.floats(0.1, 20.0)


def line(height: float, *, count: int = 1_001, lower: float = 0.0) -> Array:
    """Points of the centre line, float64."""
    points = np.zeros((count, 3))
    points[:, 2] = np.linspace(lower, lower + height, count)
    return points


def bent(step: Bend, points: Array) -> Array:
    """Points bent over their own extent."""
    return step.map(points, step.extent(points))


@given(angles, heights)
def test_the_center_line_becomes_an_arc(angle: float, height: float):
    """An extent h becomes an arc of radius h / angle, in the plane of bending, as seen from the arc's centre."""
    points = bent(Bend(angle), line(height))
    radius = height / angle
    assert np.allclose(np.hypot(points[:, 0] - radius, points[:, 2]), abs(radius), rtol=1e-9)
    assert not points[:, 1].any()
    assert math.isclose(points[-1, 0], radius * (1.0 - math.cos(angle)), rel_tol=1e-9, abs_tol=1e-12)
    assert math.isclose(points[-1, 2], radius * math.sin(angle), rel_tol=1e-9, abs_tol=1e-9)


@given(angles, heights, st.floats(-1.0, 1.0), st.floats(0.0, 1.0))
def test_the_center_line_keeps_its_length(angle: float, height: float, lower: float, share: float):
    """However it is bent, within limits or without, the centre line is as long as before, piece by piece."""
    points = line(height, lower=lower * height)
    limited = Bend(angle, lower=lower * height, upper=(lower + share + 0.01) * height)
    for step, part in ((Bend(angle), 1.0), (limited, share + 0.01)):
        pieces = np.linalg.norm(np.diff(bent(step, points), axis=0), axis=1) / (height / 1_000)
        # A chord is shorter than its arc by the square of its angle over 24, and never longer.
        assert pieces.max() < 1.0 + 1e-9
        assert pieces.min() > 1.0 - (angle / 1_000 / part) ** 2 / 23.9 - 1e-9


@given(angles)
def test_a_bend_changes_lengths_across_nowhere(angle: float):
    """Sections across the axis are moved rigidly: distances within a section are kept."""
    points = np.random.default_rng(0).uniform(-1.0, 1.0, (40, 3))
    points[:20, 2], points[20:, 2] = -1.0, 0.7
    answer = bent(Bend(angle), points)
    for section in (slice(0, 20), slice(20, 40)):
        before = np.linalg.norm(points[section, None] - points[None, section], axis=-1)
        after = np.linalg.norm(answer[section, None] - answer[None, section], axis=-1)
        assert np.allclose(after, before, atol=1e-9)


@given(angles, st.floats(-1.0, 0.4), st.floats(0.5, 1.0))
def test_beyond_the_limits_all_is_rigid_and_tangent(angle: float, lower: float, upper: float):
    """Beyond each limit space is carried by one rigid motion, which meets the arc without a step or a kink."""
    bend = Bend(angle, lower=lower, upper=upper)
    for limit, way in ((lower, -1.0), (upper, 1.0)):
        points = np.random.default_rng(1).uniform(-1.0, 1.0, (30, 3))
        points[:, 2] = limit + way * np.abs(points[:, 2])
        answer = bend.map(points, (0.0, 0.0))
        slopes = bend.jacobian(points, (0.0, 0.0))
        assert np.allclose(slopes, slopes[0], atol=1e-9)
        assert np.allclose(slopes[0] @ slopes[0].T, np.eye(3), atol=1e-9)
        assert np.allclose(answer - answer[0], (points - points[0]) @ slopes[0].T, atol=1e-9)
        at, beside = np.array(((0.3, 0.2, limit),)), np.array(((0.3, 0.2, limit - way * 1e-9),))
        assert np.allclose(bend.map(at, (0.0, 0.0)), bend.map(beside, (0.0, 0.0)), atol=1e-8 * (1 + abs(angle) * 10))
        middle = np.array(((0.0, 0.0, limit - way * 1e-9),))
        assert np.allclose(bend.jacobian(middle, (0.0, 0.0))[0], slopes[0], atol=1e-6)


@given(angles)
def test_limits_at_the_ends_change_nothing_between_them(angle: float):
    """Limits where the points end bend as no limits do."""
    points = np.random.default_rng(2).uniform(-1.0, 1.0, (50, 3))
    lower, upper = points[:, 2].min(), points[:, 2].max()
    assert np.allclose(bent(Bend(angle, lower=lower, upper=upper), points), bent(Bend(angle), points), atol=1e-10)


def test_the_center_stays_and_is_not_turned():
    """The centre of bending stays, with its section; outside of the limits the nearest limit does."""
    points = np.array(((0.0, 0.0, 3.0), (0.5, 0.2, 3.0), (0.5, 0.2, 9.0)))
    assert np.allclose(Bend(1.0, center=(0, 0, 3)).map(points, (-1.0, 5.0))[:2], points[:2])
    above = Bend(1.0, lower=4.0, upper=6.0).map(points, (0.0, 0.0))
    assert np.allclose(above[:2], points[:2])
    assert not np.allclose(above[2], points[2])


@pytest.mark.parametrize(("axis", "towards"), [("z", "x"), ("x", "y"), ("y", "z")])
def test_a_bend_goes_towards_the_next_axis(axis: str, towards: str):
    """A bar along z bends to +x, along x to +y, along y to +z; a direction of a quarter turn to the one after."""
    places = {"x": 0, "y": 1, "z": 2}
    tip = np.zeros((1, 3), np.float32)
    tip[0, places[axis]] = 1.0
    answer = Bend(math.pi / 2, axis=axis).map(tip, (0.0, 1.0))[0]
    expected = np.zeros(3)
    expected[places[axis]] = expected[places[towards]] = 2.0 / math.pi
    assert np.allclose(answer, expected, atol=1e-6)
    turned = Bend(math.pi / 2, math.pi / 2, axis).map(tip, (0.0, 1.0))[0]
    assert math.isclose(turned[(places[towards] + 1) % 3], 2.0 / math.pi, rel_tol=1e-6)


def test_a_flat_arc_keeps_the_digits_of_float32():
    """A bend by a hundredth of a degree is as exact in float32 as a large one: nothing is lost by its great radius."""
    points = np.random.default_rng(3).uniform(-1.0, 1.0, (1_000, 3)).astype(np.float32)
    for angle in (1e-7, 1e-4, 1e-2, 1.0):
        bend = Bend(angle)
        exact = bend.map(points.astype(np.float64), (-1.0, 1.0))
        assert np.abs(bend.map(points, (-1.0, 1.0)) - exact).max() < 4e-7
        x, _, z = points.astype(np.float64).T
        rate = angle / 2.0
        wanted = x * np.cos(rate * z) + 2.0 * np.sin(rate * z / 2.0) ** 2 / rate
        assert np.allclose(exact[:, 0], wanted, rtol=0.0, atol=1e-12)


def test_a_ring_closes():
    """A long tube that is bent by a whole turn becomes a torus: its ends meet, and its volume is Pappus'."""
    around, along = 48, 400
    a, z = np.meshgrid(np.arange(around) * 2.0 * math.pi / around, np.linspace(-5.0, 5.0, along + 1), indexing="ij")
    tube = np.stack([0.5 * np.cos(a), 0.5 * np.sin(a), z], axis=-1).reshape(-1, 3).astype(np.float32)
    ring = deform(tube, [Bend(2.0 * math.pi)]).reshape(around, along + 1, 3).astype(np.float64)
    assert np.allclose(ring[:, 0], ring[:, -1], atol=1e-5)
    p, q = ring[:, :-1], np.roll(ring, -1, axis=0)[:, :-1]
    r, s = np.roll(ring, -1, axis=0)[:, 1:], ring[:, 1:]
    volume = sum(float(np.sum(np.cross(b, c) * d)) for b, c, d in ((p, q, r), (p, r, s))) / 6.0
    area = around / 2.0 * 0.25 * math.sin(2.0 * math.pi / around)
    assert math.isclose(abs(volume), area * 10.0, rel_tol=1e-3)


def test_limits_do_not_show_in_the_neighbours():
    """What lies between the limits is bent alike to the bit, whether the rest of its block lies there too or not."""
    points = np.random.default_rng(2).uniform(-1.0, 1.0, (4_000, 3)).astype(np.float32)
    points[:20, ::2] = np.array([[0.0, 0.0], [-0.0, 0.0], [0.0, -0.0], [-0.0, -0.0]] * 5)
    inside = np.abs(points[:, 2]) < 0.5
    for angle in (1.3, -1.3):
        bend = Bend(angle, 0.3, lower=-0.5, upper=0.5)
        among, alone = bend.map(points, (0.0, 0.0))[inside], bend.map(points[inside], (0.0, 0.0))
        assert among.tobytes() == alone.tobytes()
