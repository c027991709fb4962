"""The tube is a cylinder without another one."""

import numpy as np
import pytest

from reactive4d.errors import ShapeError
from reactive4d.geometry import cylinders, tubes


def test_its_content_is_what_is_left_of_the_cylinder():
    """Volume and inertia add up."""
    assert tubes.volume(1.0, 0.4, 2.0) + cylinders.volume(0.4, 2.0) == pytest.approx(cylinders.volume(1.0, 2.0))
    assert tubes.inertia(1.0, 0.4, 2.0) + cylinders.inertia(0.4, 2.0) == pytest.approx(cylinders.inertia(1.0, 2.0))


def test_a_ray_across_meets_four_walls_in_turn():
    """The outer ones from outside, the inner ones from the hole."""
    starts = [(x, 0.0, 0.0) for x in (-2.0, -0.6, 0.0, 0.6, 1.5)]
    distance, normal = tubes.intersect(starts, [(1.0, 0.0, 0.0)] * 5, radius=1.0, inner=0.5, height=1.0)
    assert distance.tolist() == pytest.approx([1.0, 0.1, 0.5, 0.4, np.inf])
    assert normal.tolist() == [[-1, 0, 0], [1, 0, 0], [-1, 0, 0], [1, 0, 0], [0, 0, 0]]


def test_without_a_hole_it_is_a_cylinder():
    """Also for rays along the axis, which a hole of no width would let through."""
    draw = np.random.default_rng(1)
    origins = np.concatenate([draw.normal(size=(500, 3)), [(0, 0, 3)]])
    directions = np.concatenate([draw.normal(size=(500, 3)), [(0, 0, -1)]])
    tube = tubes.intersect(origins, directions, radius=0.7, inner=0.0, height=1.2)
    cylinder = cylinders.intersect(origins, directions, radius=0.7, height=1.2)
    assert np.array_equal(tube[0], cylinder[0])
    assert tube[0][-1] == pytest.approx(2.4)


def test_a_hole_wider_than_the_tube_is_refused():
    """With the outer radius."""
    with pytest.raises(ShapeError, match=r"inner: expected a radius of at most 0.5, the outer one, got 0.6"):
        tubes.volume(0.5, 0.6)
