"""Derivatives and integrals, where their trees are lowered."""

import numpy as np
import pytest

import reactive4d as r4
from reactive4d_widgets.lowering import lower

from .conftest import around

TIMES = (-1.0, 0.5, 2.0, 3.0)
POINTS = dict(zip(TIMES, (0.5, 2.0, -1.0, 1.5), strict=True))
PLACES = dict(zip(TIMES, ((0, 1, 2), (2, 0, 1), (1, 1, 1), (0, 0, 3)), strict=True))
AWKWARD = [*around(TIMES), *np.linspace(-3.0, 6.0, 55).tolist()]
T = r4.time


@pytest.mark.parametrize("interpolation", ["linear", "catmull_rom", "tcb", "bspline", "step"])
@pytest.mark.parametrize("order", [1, 2, 3])
def test_derivatives_of_keys_are_exact(agree, interpolation, order):
    """Of any order; at a key it is that of what follows."""
    signal = r4.keys(POINTS, interpolation=interpolation)
    for _ in range(order):
        signal = signal.derivative()

    agree(signal, AWKWARD, tolerance=1e-8)


@pytest.mark.parametrize("before", ["hold", "linear", "cycle"])
@pytest.mark.parametrize("after", ["hold", "linear", "cycle", "cycle_offset"])
def test_derivatives_outside_of_the_keys_are_exact(agree, before, after):
    """Zero where a value holds, steady where it runs on, and again and again."""
    agree(r4.keys(PLACES, before=before, after=after, interpolation="catmull_rom").derivative(), AWKWARD)


def test_derivatives_of_eased_keys_are_exact_where_the_ease_is_a_low_polynomial(agree):
    """Else they are left to be fitted."""
    agree(r4.keys(POINTS, ease="in_out").derivative(), AWKWARD, tolerance=1e-8)
    assert lower(r4.keys(POINTS, ease="in_sine").derivative()) is None
    assert lower(r4.keys(POINTS, ease="in_out").derivative().derivative()) is None
    assert lower(r4.keys(POINTS, after="oscillate").derivative()) is None


@pytest.mark.parametrize("interpolation", ["linear", "catmull_rom", "step"])
@pytest.mark.parametrize("after", ["hold", "linear"])
def test_integrals_of_keys_are_exact(agree, interpolation, after):
    """From any start; the area under a cubic is of the fourth degree."""
    agree(r4.keys(POINTS, interpolation=interpolation, after=after, before=after).integral(0.25), AWKWARD)
    agree(r4.keys(PLACES, interpolation=interpolation, after=after).integral(), AWKWARD)


def test_integrals_of_what_repeats_itself_are_left_to_be_fitted():
    """The same holds of eases that are no low polynomials, and of numerical integrals."""
    for signal in (r4.keys(POINTS, after="cycle"), r4.keys(POINTS, ease="in_sine"), np.sin(T * T)):
        assert lower(signal.integral()) is None


def test_rules_of_calculus_make_trees(agree):
    """Products, quotients, elementary functions, warps."""
    for signal in (
        (np.sin(2 * T) * T).derivative(),
        (1 / (1 + T * T)).derivative(),
        np.sin(2 * T).integral(1.0),
        (3 * T * T - T).integral(),
        r4.keys(POINTS).delay(1.0).derivative(),
        r4.vec(np.sin(T), T, 1).derivative(),
        r4.Variable(np.sin(T)).derivative(),
        r4.Variable(r4.keys(POINTS)).integral(),
    ):
        agree(signal, np.linspace(-2.0, 3.0, 23), tolerance=1e-8)


def test_numerical_derivatives_are_the_same_stencil(agree):
    """Where the engine takes differences, the tree takes the same ones."""
    live = r4.keys({0: np.sin(T), 2: T})

    agree(live.derivative(), np.linspace(-2.0, 3.0, 23), tolerance=1e-8)


def test_the_velocity_of_what_is_moved_is_lowered(agree):
    """Of objects, too."""
    ball = r4.Sphere()
    ball.translate(r4.vec(np.sin(T), T * T, 1))
    ball.rotate(30 * T)

    agree(ball.velocity, np.linspace(-2.0, 3.0, 23), tolerance=1e-8)
    agree(ball.acceleration, np.linspace(-1.0, 1.0, 5), tolerance=1e-4)
