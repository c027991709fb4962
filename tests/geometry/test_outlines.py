"""Flat shapes: their areas, their orientation, and what fills them."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive4d.errors import ShapeError
from reactive4d.geometry import outlines
from reactive4d.geometry.outlines import area, centroid, circle, helix, line, oriented, polygon, rectangle, star

small = settings(max_examples=30)


@small
@given(st.floats(0.01, 10), st.integers(3, 100))
def test_a_regular_polygon_has_its_area(radius, sides):
    """N r² sin(2π / n) / 2; and a circle is a polygon."""
    exact = sides * radius**2 * math.sin(2 * math.pi / sides) / 2
    assert area(polygon(radius, sides=sides)) == pytest.approx(exact)
    np.testing.assert_array_equal(circle(radius, segments=sides), polygon(radius, sides=sides))
    np.testing.assert_allclose(centroid(circle(radius, segments=sides)), 0, atol=1e-12 * radius)


@small
@given(st.floats(0.1, 5), st.floats(0.1, 5), st.integers(3, 12))
def test_a_star_is_made_of_triangles(radius, inner, tips):
    """Its area is tips · radius · inner · sin(π / tips)."""
    assert area(star(radius, inner, tips=tips)) == pytest.approx(tips * radius * inner * math.sin(math.pi / tips))


def test_rectangles_lines_and_helices_are_what_they_say():
    """A rectangle has sides, a line even steps, and a helix the length of its unrolled triangle."""
    assert area(rectangle((3, 4))) == 12
    np.testing.assert_array_equal(np.diff(line((0, 0, 0), (4, 0, 8), segments=4), axis=0), [(1, 0, 2)] * 4)
    x = helix(2, 3, turns=2, segments=2000)
    length = np.linalg.norm(np.diff(x, axis=0), axis=1).sum()
    assert length == pytest.approx(math.hypot(2 * math.pi * 2 * 2, 3), rel=1e-5)
    np.testing.assert_allclose(np.hypot(x[:, 0], x[:, 1]), 2)
    np.testing.assert_allclose(helix(2, 3, turns=-2, segments=2000) * [1, -1, 1], x, atol=1e-12)


def test_contours_are_oriented_by_how_deep_they_lie():
    """Outer, hole, island: whichever way they are given they run counter-clockwise, clockwise, counter-clockwise."""
    rings = [rectangle((6, 6)), rectangle((4, 4)), rectangle((2, 2)), rectangle((1, 1)) + 10.0]
    for turned in range(16):
        given = [ring[::-1] if turned >> i & 1 else ring for i, ring in enumerate(rings)]
        assert area(given) == 36 - 16 + 4 + 1
        assert [np.sign(area([ring])) for ring in oriented(given)] == [1, 1, 1, 1]
        for before, after in zip(rings, oriented(given), strict=True):
            assert set(map(tuple, before)) == set(map(tuple, after))


@small
@given(st.integers(3, 40), st.integers(0, 2**32 - 1), st.booleans())
def test_triangles_fill_concave_outlines_with_holes(count, seed, hollow):
    """Their areas sum up, and each edge of a contour is an edge of exactly one triangle, in its direction."""
    rng = np.random.default_rng(seed)
    angle = 2 * math.pi * np.arange(count) / count
    ring = (1 + 3 * rng.random(count))[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    if count < 5:
        hollow = False  # a coarse ring need not hold the hole
    rings = oriented([ring, circle(0.5, segments=7)] if hollow else ring)
    filled = outlines.triangles(rings)
    points = np.concatenate(rings)
    a, b, c = points[filled].transpose(1, 0, 2)
    u, v = b - a, c - a
    areas = (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2
    assert areas.sum() == pytest.approx(area(rings), rel=1e-9)
    edges = np.concatenate([filled[:, [0, 1]], filled[:, [1, 2]], filled[:, [2, 0]]]).tolist()
    first = 0
    for one in rings:
        for i in range(len(one)):
            assert edges.count([first + i, first + (i + 1) % len(one)]) == 1
        first += len(one)


def test_the_centroid_of_a_ring_with_a_hole_moves_away_from_the_hole():
    """By the law of levers: A c = A1 c1 - A2 c2."""
    outer, hole = rectangle((4, 4)), rectangle((1, 1)) + [1.0, 0.5]
    np.testing.assert_allclose(centroid([outer, hole]), [-1 / 15, -0.5 / 15])
    assert centroid([(0, 0), (1, 1), (2, 2)]).tolist() == [1, 1]


@small
@given(st.integers(3, 30), st.integers(3, 60))
def test_a_resampled_ring_has_equal_sides_measured_along_the_old_one(count, again):
    """On a circle of many points all new sides are nearly equal; the first point stays."""
    ring = circle(1, segments=count)
    new = outlines.resampled(ring, again)
    assert len(new) == again
    np.testing.assert_allclose(new[0], ring[0])
    assert area(new) <= area(ring) + 1e-12
    assert outlines.resampled(ring, count).tobytes() == ring.tobytes()


def test_a_repeated_first_point_is_left_out():
    """Rings close by themselves, but files and people repeat the first point."""
    ring = [(0, 0), (1, 0), (0, 1), (0, 0)]
    assert len(outlines.contours(ring)[0]) == 3
    assert len(outlines.contours(np.array([ring, ring]))) == 2
    assert outlines.contours([]) == ()
    assert outlines.triangles([]).shape == (0, 3)


def test_what_is_no_outline_is_refused():
    """Too few points, wrong shapes, negative sizes and what is not finite are named."""
    with pytest.raises(ShapeError, match="contour 1: expected at least 3 points, got 2"):
        area([circle(), [(0, 0), (1, 1)]])
    with pytest.raises(ShapeError, match=r"contour 0: expected points of shape \(N, 2\)"):
        area([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
    with pytest.raises(ShapeError, match="contour 0: expected finite numbers, point 2"):
        area([(0, 0), (1, 0), (0, math.inf)])
    with pytest.raises(ShapeError, match="radius: expected a finite number of at least 0, got -1"):
        circle(-1)
    with pytest.raises(ShapeError, match="inner"):
        star(1, math.nan)
    with pytest.raises(ShapeError, match="sides: expected a whole number of at least 3, got 2"):
        polygon(1, sides=2)
    with pytest.raises(ShapeError, match="size: expected 2 numbers, got 3"):
        rectangle((1, 2, 3))
    with pytest.raises(ShapeError, match="height"):
        helix(1, math.inf)
    with pytest.raises(ShapeError, match="line: expected two points"):
        line((0, 0), (1, 1))
    with pytest.raises(ShapeError, match="count"):
        outlines.resampled(circle(), 2)
