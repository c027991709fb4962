"""The torus obeys Pappus, and its rays the quartic, also where it is thin, thick, or grazed."""

import math

import numpy as np
import pytest

from reactive4d.errors import ShapeError
from reactive4d.geometry import tori


@pytest.mark.parametrize(("radius", "tube"), [(1.0, 0.3), (0.5, 0.5), (2.0, 1e-3)])
def test_pappus(radius, tube):
    """Volume and area are section and rim times the way of their centre."""
    way = 2 * math.pi * radius
    assert tori.volume(radius, tube) == pytest.approx(math.pi * tube**2 * way)
    assert tori.area(radius, tube) == pytest.approx(2 * math.pi * tube * way)


@pytest.mark.parametrize(("radius", "tube"), [(1.0, 0.3), (0.5, 0.5), (2.0, 1e-3), (1e-3, 5e-4), (1e4, 1e3)])
def test_hits_lie_on_the_tube_to_the_last_digits(radius, tube):
    """The distance from the tube's middle is its radius, to 1e-9 of it even for a tube like a wire."""
    draw = np.random.default_rng(2)
    angle = draw.uniform(0, 2 * math.pi, 20_000)
    aims = radius * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1) + 0.7 * tube * draw.normal(
        size=(20_000, 3)
    )
    origins = draw.normal(size=(20_000, 3)) * 2 * radius
    distance, _ = tori.intersect(origins, aims - origins, radius=radius, tube=tube)
    met = np.isfinite(distance)
    assert met.mean() > 0.5
    x, y, z = (origins[met] + distance[met, None] * (aims - origins)[met]).T
    assert np.hypot(np.hypot(x, y) - radius, z) == pytest.approx(tube, rel=1e-9)


def test_a_ray_through_all_four_walls_meets_them_in_turn():
    """Along the x axis of a torus with radii 1 and 0.25 from -2, the walls lie at -1.25, -0.75, 0.75 and 1.25."""
    starts = [(x, 0.0, 0.0) for x in (-2.0, -1.0, 0.0, 1.0, 1.5)]
    distance, normal = tori.intersect(starts, [(1.0, 0.0, 0.0)] * 5, radius=1.0, tube=0.25)
    assert distance.tolist() == pytest.approx([0.75, 0.25, 0.75, 0.25, math.inf], rel=1e-14)
    assert normal[:, 0].round(12).tolist() == [-1, 1, -1, 1, 0]


def test_rays_that_graze_from_just_inside_are_met():
    """A ray parallel to the axis 1e-6 within the outer rim, and one 1e-6 beyond it."""
    distance, _ = tori.intersect([(1.25 - 1e-6, 0, 1), (1.25 + 1e-6, 0, 1)], [(0, 0, -1)] * 2, radius=1.0, tube=0.25)
    assert np.isfinite(distance).tolist() == [True, False]
    assert distance[0] == pytest.approx(1 - math.sqrt(0.25**2 - (0.25 - 1e-6) ** 2), rel=1e-9)


def test_a_tube_that_meets_itself_is_refused():
    """Its volume would count some space twice."""
    with pytest.raises(ShapeError, match=r"tube: expected a radius of at most 0.5, to the tube's middle, got 0.6"):
        tori.points(0.5, 0.6)
