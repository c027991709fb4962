"""The laws of free-form deformation: rest, affine precision, corners, locality."""

from itertools import product
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from reactive4d.errors import ShapeError
from reactive4d.geometry.lattices import FreeForm, lattice
from reactive4d.geometry.transforms import compose, rotation, scaling, shearing, transform_points, translation

Array = NDArray[Any]

LOWER, UPPER = (-1.0, 0.0, 2.0), (1.0, 3.0, 2.5)
NONE = (0.0, 0.0)
shapes = st.tuples(*[st.integers(2, 6)] * 3)


def cloud(count: int = 200) -> Array:
    """Points of the box, float32."""
    draw = np.random.default_rng(0)
    return draw.uniform(LOWER, UPPER, (count, 3)).astype(np.float32)


def form(points: Array) -> FreeForm:
    """The deformation of the box by these control points."""
    return FreeForm(points, LOWER, UPPER)


@given(shapes)
def test_a_resting_lattice_moves_nothing(shape: tuple[int, int, int]):
    """Where all control points rest, every point stays, bit for bit."""
    points = cloud()
    assert np.array_equal(form(lattice(LOWER, UPPER, shape)).map(points, NONE), points)


@given(shapes, st.floats(-3.0, 3.0), st.floats(0.5, 2.0))
def test_a_lattice_under_an_affine_map_is_that_map(shape: tuple[int, int, int], angle: float, size: float):
    """Control points that are moved by an affine map move all points by it, as exactly as their type can say."""
    matrix = compose([scaling((size, 1.0, 2.0)), shearing((0.5, 0, 0), "y"), rotation(angle), translation((1, 2, 3))])
    control = lattice(LOWER, UPPER, shape)
    step = form(transform_points(matrix, control.reshape(-1, 3)).reshape(control.shape))
    points = cloud()
    exact = points.astype(np.float64)
    assert np.allclose(step.map(points, NONE), transform_points(matrix, points), rtol=0.0, atol=2e-5)
    assert np.allclose(step.map(exact, NONE), transform_points(matrix, exact), rtol=0.0, atol=1e-12)
    assert np.allclose(step.jacobian(exact, NONE), matrix[:3, :3], atol=1e-10)


@given(shapes, st.integers(0, 100))
def test_corners_go_where_their_control_points_are(shape: tuple[int, int, int], seed: int):
    """The eight corners of the box follow the eight control points there, whatever the others do."""
    control = lattice(LOWER, UPPER, shape) + np.random.default_rng(seed).normal(size=(*shape, 3))
    corners = np.array(list(product(*zip(LOWER, UPPER, strict=True))))
    expected = [control[i, j, k] for i, j, k in product((0, -1), repeat=3)]
    assert np.allclose(form(control).map(corners, NONE), expected, atol=1e-12)
    assert np.allclose(form(control).map(corners.astype(np.float32), NONE), expected, atol=1e-5)


@given(shapes, st.integers(0, 100))
def test_it_is_the_sum_of_the_bernstein_polynomials(shape: tuple[int, int, int], seed: int):
    """A point goes to the mean of the control points by the Bernstein polynomials of its place in the box."""
    from scipy.special import comb

    control = lattice(LOWER, UPPER, shape) + np.random.default_rng(seed).normal(size=(*shape, 3))
    points = cloud(20).astype(np.float64)
    shares = (points - LOWER) / np.subtract(UPPER, LOWER)
    bases = [
        np.array([comb(n - 1, i) * u**i * (1.0 - u) ** (n - 1 - i) for i in range(n)])
        for u, n in zip(shares.T, shape, strict=True)
    ]
    expected = np.einsum("iv,jv,kv,ijkc->vc", *bases, control)
    assert np.allclose(form(control).map(points, NONE), expected, atol=1e-12)


def test_what_lies_outside_stays():
    """Points outside of the box stay to the bit, those on its faces move; float32 corners count as corners."""
    control = lattice(LOWER, UPPER, (3, 3, 3)) + 1.0
    points = np.float32([(-1.001, 1, 2.2), (0, 1, 2.2), (0, 3.001, 2.2), (1, 3, 2.5), (0, 0, 1.9)])
    answer = form(control).map(points, NONE)
    assert np.array_equal(answer[[0, 2, 4]], points[[0, 2, 4]])
    assert np.allclose(answer[[1, 3]], points[[1, 3]] + 1.0)
    third = FreeForm(lattice((0, 0, 0), (0.1, 0.1, 0.7), (2, 2, 2)) + 1.0, (0, 0, 0), (0.1, 0.1, 0.7))
    assert np.allclose(third.map(np.float32([(0.1, 0.1, 0.7)]), NONE), ((1.1, 1.1, 1.7),))


def test_many_control_points_along_one_axis_are_exact_enough():
    """With 64 control points along an axis float32 still agrees with float64."""
    control = lattice(LOWER, UPPER, (64, 2, 2)) + np.random.default_rng(1).normal(scale=0.1, size=(64, 2, 2, 3))
    points = cloud()
    rounded, exact = (form(control).map(p, NONE) for p in (points, points.astype(np.float64)))
    assert np.allclose(rounded, exact, atol=2e-6)


def test_control_points_are_copied_and_frozen():
    """The value does not change when the array it was made from does."""
    control = lattice(LOWER, UPPER, (2, 2, 2)).copy()
    step = form(control)
    control += 1.0
    assert np.array_equal(step.points, lattice(LOWER, UPPER, (2, 2, 2)))
    assert not step.points.flags.writeable
    assert step == form(lattice(LOWER, UPPER, (2, 2, 2)))
    assert step != form(control)


def test_bad_lattices_are_named():
    """A lattice has two control points along each axis at least, three numbers each, and a box."""
    with pytest.raises(ShapeError, match=r"expected \(L, M, N, 3\), got an array of shape \(2, 2, 2\)"):
        form(np.zeros((2, 2, 2)))
    with pytest.raises(ShapeError, match=r"from 2 to 64, got \(2, 1, 2\)"):
        form(np.zeros((2, 1, 2, 3)))
    with pytest.raises(ShapeError, match="there is no box"):
        lattice((0, 0, 0), (1, 0, 1), (2, 2, 2))
    with pytest.raises(ShapeError, match="from 2 to 64"):
        lattice((0, 0, 0), (1, 1, 1), (2, 2, 65))
