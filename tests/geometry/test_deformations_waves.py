"""The laws of waves and ripples: heights, periods, decay, and round fronts."""

import math
from typing import Any

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from reactive4d.geometry.deformations.waves import Ripple, Wave

Array = NDArray[Any]

lengths = st.floats(0.2, 5.0)
phases = st.floats(-10.0, 10.0)
decays = st.floats(0.0, 2.0)
NONE = (0.0, 0.0)


def cloud() -> Array:
    """Points about the origin."""
    return np.random.default_rng(0).uniform(-2.0, 2.0, (100, 3))


def lifts(step: Any, points: Array) -> Array:
    """By how much points are lifted; they must not move sidewards."""
    moved = step.map(points, NONE) - points
    assert not moved[:, :2].any()
    return moved[:, 2]


@given(lengths, phases, decays)
def test_a_wave_is_a_damped_sine(wavelength: float, phase: float, decay: float):
    """The height is amplitude · exp(-decay · |x|) · sin(2π x / wavelength - phase), the same all along y and z."""
    points = cloud()
    x = points[:, 0]
    expected = 0.3 * np.exp(-decay * np.abs(x)) * np.sin(2.0 * np.pi * x / wavelength - phase)
    assert np.allclose(lifts(Wave(0.3, wavelength, phase, decay=decay), points), expected, atol=1e-12)


@given(lengths, phases)
def test_a_wave_repeats_and_runs_forward(wavelength: float, phase: float):
    """A wavelength farther on, and 2π later, the wave is the same; a later phase is the wave moved forward."""
    points = cloud()
    height = lifts(Wave(0.3, wavelength, phase), points)
    assert np.allclose(lifts(Wave(0.3, wavelength, phase), points + (wavelength, 0, 0)), height, atol=1e-12)
    assert np.allclose(lifts(Wave(0.3, wavelength, phase + 2.0 * math.pi), points), height, atol=1e-12)
    later = lifts(Wave(0.3, wavelength, phase + 0.5), points + (0.5 * wavelength / (2.0 * math.pi), 0, 0))
    assert np.allclose(later, height, atol=1e-12)


@given(lengths, phases, st.floats(0.1, 2.0))
def test_a_wave_decays_by_its_distance(wavelength: float, phase: float, decay: float):
    """A wavelength farther out the height is less by exp(-decay · wavelength)."""
    points = np.abs(cloud())
    for family, way in ((Wave, (wavelength, 0.0, 0.0)), (Ripple, None)):
        step = family(0.3, wavelength, phase, decay=decay)
        if way is None:
            points[:, 1] = 0.0
            way = (wavelength, 0.0, 0.0)
        farther = lifts(step, points + way)
        assert np.allclose(farther, lifts(step, points) * math.exp(-decay * wavelength), atol=1e-12)


def test_two_waves_cross():
    """The second wave runs along local y, and is added."""
    points = cloud()
    both = lifts(Wave(0.3, 1.5, 0.2, second=-0.2, decay=0.1), points)
    first = lifts(Wave(0.3, 1.5, 0.2, decay=0.1), points)
    second = lifts(Wave(-0.2, 1.5, 0.2, decay=0.1), points[:, (1, 0, 2)])
    assert np.allclose(both, first + second)


def test_a_phase_of_hours_keeps_its_digits():
    """After a long time the phase is as exact in float32 as at first: whole turns are taken off it before."""
    points = cloud().astype(np.float32)
    early = Wave(0.3, 1.5, 0.25).map(points, NONE)
    late = Wave(0.3, 1.5, 0.25 + 2.0 * math.pi * 1_000_000).map(points, NONE)
    assert np.allclose(early, late, atol=1e-6)


@given(lengths, phases, decays, st.floats(-7.0, 7.0))
def test_a_ripple_is_round(wavelength: float, phase: float, decay: float, turn: float):
    """All points at the same distance from the axis are lifted alike: by the damped sine of that distance."""
    points = cloud()
    step = Ripple(0.3, wavelength, phase, decay=decay)
    height = lifts(step, points)
    r = np.hypot(points[:, 0], points[:, 1])
    assert np.allclose(height, 0.3 * np.exp(-decay * r) * np.sin(2.0 * np.pi * r / wavelength - phase), atol=1e-12)
    c, s = math.cos(turn), math.sin(turn)
    assert np.allclose(lifts(step, points @ np.array(((c, s, 0), (-s, c, 0), (0, 0, 1)))), height, atol=1e-11)


@given(lengths, phases)
def test_a_ripple_of_two_amplitudes_has_each_on_its_axis(wavelength: float, phase: float):
    """Along x it is as high as the first, along y as the second, half-way as their mean, which it has on the axis."""
    step, mean = Ripple(0.3, wavelength, phase, second=0.1), Ripple(0.2, wavelength, phase)
    for radius in (0.2, 1.7):
        x, y, both = (np.array([way]) * radius for way in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.6**0.5, 0.4**0.5, 0)))
        assert np.allclose(lifts(step, x), lifts(Ripple(0.3, wavelength, phase), x))
        assert np.allclose(lifts(step, y), lifts(Ripple(0.1, wavelength, phase), y))
        assert np.allclose(lifts(step, both), lifts(Ripple(0.3 * 0.6 + 0.1 * 0.4, wavelength, phase), both))
    axis = np.zeros((1, 3))
    assert np.allclose(lifts(step, axis), lifts(mean, axis))
    assert np.isfinite(step.jacobian(axis, NONE)).all()
