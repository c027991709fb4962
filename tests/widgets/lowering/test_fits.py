"""Fitting: as few asks as will do, pieces as long as they can be, and never across a jump."""

import math

import numpy as np
import pytest

import reactive4d as r4
from reactive4d_widgets.lowering import fit, fit_matrix, fit_rotation, play, sized
from reactive4d_widgets.lowering.measures import Turns
from reactive4d_widgets.lowering.polar import parts_of

CHANCE = np.random.default_rng(8)


class Counted:
    """A function of times that remembers when it was asked."""

    def __init__(self, function):
        self.function = function
        self.times = []

    def __call__(self, times):
        self.times.extend(times.tolist())
        return self.function(times)


def fitted(function, start=0.0, stop=10.0, *, tolerance=1e-4, breaks=()):
    """A fit, with what is claimed of every fit asserted."""
    sample = Counted(function)
    made = fit(sample, start, stop, tolerance=tolerance, breaks=breaks)
    assert made is not None
    assert len(sample.times) == len(set(sample.times)) == made.asks
    assert min(sample.times) == start
    assert max(sample.times) <= stop
    assert sized(made.track) <= 120 + 200 * made.pieces
    return made


def worst(made, function, start=0.0, stop=10.0):
    """How far a fit is off at most, at random times."""
    times = CHANCE.uniform(start, stop, size=500)
    return max(np.abs(np.subtract(play(made.track, t), np.asarray(function(np.array([t])))[0])).max() for t in times)


SMOOTH = {
    "sine": np.sin,
    "vector": lambda t: np.stack([np.sin(t), np.cos(3 * t), t * t / 9], axis=1),
    "decay": lambda t: np.exp(-t) * np.cos(5 * t),
    "far away": lambda t: 1e6 + np.sin(t),
}


@pytest.mark.parametrize("name", SMOOTH)
@pytest.mark.parametrize("tolerance", [1e-2, 1e-4, 1e-6])
def test_smooth_motion_keeps_to_its_tolerance(name, tolerance):
    """Between the asked times, too."""
    function = SMOOTH[name]
    made = fitted(function, tolerance=tolerance)

    assert worst(made, function) <= tolerance
    assert made.error <= 0.5 * tolerance + 1e-12


def test_a_sine_takes_two_pieces_a_second():
    """Each of them fewer than forty bytes, and nothing per frame."""
    made = fitted(np.sin)

    assert made.pieces <= 25
    assert made.asks <= 170
    assert sized(made.track) <= 40 * made.pieces


def test_a_cubic_is_one_piece():
    """However long it lasts."""
    made = fitted(lambda t: t**3 - 4 * t, tolerance=1e-3)

    assert made.pieces == 1
    assert made.asks == 81


def test_what_stands_still_is_a_constant():
    """Of one number or several."""
    assert fitted(lambda t: 2.0 + 0 * t).track == {"kind": "const", "value": 2.0}
    assert fitted(lambda t: np.ones((len(t), 3))).track == {"kind": "const", "value": [1.0, 1.0, 1.0]}


def test_a_jump_is_found_to_the_last_float():
    """And no piece goes across it."""

    def function(t):
        return np.where(t < math.pi, np.sin(t), 5.0 + t)

    made = fitted(function)
    assert worst(made, function) <= 1e-4
    before, after = math.nextafter(math.pi, 0.0), math.pi
    assert play(made.track, before) == pytest.approx(0.0, abs=1e-4)
    assert play(made.track, after) == pytest.approx(5.0 + math.pi, abs=1e-4)
    assert made.asks <= 250


def test_several_jumps_are_found():
    """Each by bisection."""

    def function(t):
        return np.floor(1.1 * t) + 0.1 * np.sin(t)

    made = fitted(function)
    assert worst(made, function) <= 1e-4
    assert made.pieces <= 30


def test_known_borders_are_not_looked_for():
    """A bouncing ball whose bounces are known takes half the asks."""

    def function(t):
        return np.abs(np.sin(2.4 * t))

    bounces = [k * math.pi / 2.4 for k in range(1, 8)]
    known, unknown = fitted(function, breaks=bounces), fitted(function)

    assert worst(known, function) <= 1e-4
    assert worst(unknown, function) <= 1e-4
    assert known.asks < 0.6 * unknown.asks


def test_a_kink_is_met_without_a_border():
    """It costs some pieces."""
    made = fitted(lambda t: np.abs(t - math.e))

    assert worst(made, lambda t: np.abs(t - math.e)) <= 1e-4
    assert made.pieces <= 20


def test_the_very_end_may_be_another():
    """The time at which a fit ends belongs to it."""

    def function(t):
        return np.where(t < 10.0, t, -1.0)

    made = fitted(function, breaks=(10.0,))
    assert play(made.track, 10.0) == -1.0


@pytest.mark.parametrize(
    "function",
    [lambda t: np.sin(300 * t), lambda t: np.modf(1e4 * np.sin(1e4 * t))[0]],
    ids=["fast", "noise"],
)
def test_what_is_too_rough_is_not_fitted(function):
    """It is noticed early: samples at ticks would be cheaper."""
    sample = Counted(function)

    assert fit(sample, 0.0, 10.0, tolerance=1e-4) is None
    assert len(sample.times) <= 4000


def test_borders_may_become_known_on_the_way():
    """As boxes tell of them when they are asked."""
    known = []

    def function(t):
        if (t > 3.0).any() and not known:
            known.append(3.0)
        return np.where(t < 3.0, 0.0, 1.0 + t)

    made = fitted(function, breaks=lambda lo, hi: [t for t in known if lo < t < hi])
    assert made.asks <= 120
    assert play(made.track, math.nextafter(3.0, 0.0)) == 0.0
    assert play(made.track, 3.0) == 4.0


def test_what_is_not_finite_is_not_fitted():
    """No such number travels."""
    assert fit(lambda t: np.where(t > 3.0, np.nan, t), 0.0, 10.0, tolerance=1e-4) is None
    assert fit(lambda t: np.full(len(t), np.inf), 0.0, 10.0, tolerance=1e-4) is None
    assert fit_matrix(lambda t: np.full((len(t), 4, 4), np.inf), 0.0, 1.0, size=1.0) is None
    assert fit_matrix(lambda t: np.zeros((len(t), 3, 3)), 0.0, 1.0, size=1.0) is None


def test_an_instant_is_a_constant():
    """A span may be a single time."""
    made = fit(np.cos, 2.0, 2.0, tolerance=1e-4)

    assert made is not None
    assert made.track == {"kind": "const", "value": math.cos(2.0)}


def quaternions(rotations):
    """(n, 4) of rotations."""
    return np.array([rotation.as_quaternion() for rotation in rotations])


def test_turns_are_fitted_to_a_thousandth_of_a_radian():
    """Through all signs that their quaternions may have."""

    def function(t):
        return quaternions(
            [
                r4.Rotation.from_axis_angle("z", 120 * s) * r4.Rotation.from_axis_angle((1, 2, 0), 80 * math.sin(s))
                for s in t
            ]
        )

    made = fit_rotation(function, 0.0, 6.0)
    assert made is not None
    times = np.linspace(0.0, 6.0, 301)
    played = np.array([play(made.track, t) for t in times])
    assert Turns(1e-3).error(played, function(times)) <= 1e-3
    assert sized(made.track) <= 120 + 100 * made.pieces
    assert made.pieces <= 40


def matrices(t):
    """(n, 4, 4) that turn, shear, and move."""
    found = []
    for s in t:
        matrix = np.eye(4)
        shear = np.array([[1, 0.5 * math.sin(s), 0], [0, 1, 0], [0, 0.2, 1.0]])
        matrix[:3, :3] = r4.Rotation.from_axis_angle((1, 1, 0), 90 * s).as_matrix() @ shear
        matrix[:3, 3] = (s, math.cos(s), 0)
        found.append(matrix)
    return np.array(found)


def test_shear_survives():
    """A matrix is a translation, a rotation and a symmetric stretch."""
    made = fit_matrix(matrices, 0.0, 5.0, size=3.0)

    assert made is not None
    times = np.linspace(0.0, 5.0, 201)
    played = np.array([play(made.track, t) for t in times]).reshape(-1, 4, 4)
    assert np.abs(played - matrices(times)).max() <= 3e-3


def test_a_rigid_motion_has_no_stretch():
    """Nor does a mirrored one lose its side."""

    def rigid(t):
        return np.array(
            [
                np.block([[r4.Rotation.from_axis_angle("z", 50 * s).as_matrix(), np.full((3, 1), s)], [0, 0, 0, 1]])
                for s in t
            ]
        )

    def mirrored(t):
        return rigid(t) @ np.diag([1.0, 1.0, -1.0, 1.0])

    first, second = (fit_matrix(f, 0.0, 5.0, size=3.0) for f in (rigid, mirrored))
    assert first is not None
    assert second is not None
    assert first.track["factors"][0]["stretch"] is None
    for t in (0.3, 2.7, 5.0):
        found = play(second.track, t).reshape(4, 4)
        assert np.abs(found - mirrored(np.array([t]))[0]).max() <= 2e-3


def test_what_is_flattened_keeps_the_rotation_that_it_had():
    """A scale of zero tells none."""
    turn = r4.Rotation.from_axis_angle("z", 40).as_matrix()
    series = np.array([np.pad(turn * s, (0, 1)) for s in (0.0, 1.0, 0.0, 2.0)])
    parts = parts_of(series)

    assert np.allclose(parts.rotation, quaternions([r4.Rotation.from_axis_angle("z", 40)] * 4))
    assert np.allclose(parts.stretch[0], 0.0)
    assert np.allclose(parts_of(np.zeros((1, 4, 4))).rotation, [[1, 0, 0, 0]])


@pytest.mark.parametrize("seed", range(20))
def test_a_matrix_is_the_product_of_its_parts(seed):
    """T · R · S, with a rotation that never mirrors."""
    matrix = np.eye(4)
    matrix[:3] = np.random.default_rng(seed).normal(size=(3, 4))
    parts = parts_of(matrix[None])
    track = {
        "kind": "product",
        "factors": [
            {
                "op": "trs",
                **{
                    name: {"kind": "const", "value": getattr(parts, name)[0].tolist()}
                    for name in ("translation", "rotation", "stretch")
                },
            }
        ],
    }

    np.testing.assert_allclose(play(track, 0.0).reshape(4, 4), matrix, atol=1e-12)
