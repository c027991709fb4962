"""Keys of known values: exactly at the keys, and to rounding everywhere, outside of the keys as well."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import reactive4d as r4
from reactive4d.signals.easings import EASINGS
from reactive4d_widgets.lowering import lower, play, sized

from .conftest import around

TIMES = (-1.0, 0.1, 0.75, 2.0, 3.5)
NUMBERS = dict(zip(TIMES, (0.3, 2.0, -1.0, -1.0, 4.7), strict=True))
VECTORS = dict(zip(TIMES, ((0.1, 0, 1), (2, 0.7, 1), (3, 2, 0), (3, 2, 0), (0, 0, 0.9)), strict=True))
COLORS = dict(zip(TIMES, ("red", "gold", "#00f8", "#00f8", "transparent"), strict=True))
TURNS = dict(
    zip(
        TIMES,
        [r4.Rotation.from_axis_angle(axis, angle) for axis, angle in (("x", 0), ("x", 100), ((1, 2, 3), 50))]
        + [r4.Rotation.from_axis_angle("z", angle) for angle in (-170, 170)],
        strict=True,
    )
)
AWKWARD = [*around(TIMES), *np.linspace(-1.0, 3.5, 41).tolist(), -5.3, -1e6, 6.1, 1e6, -0.0]
MEETING = ("step", "linear", "catmull_rom", "catmull_rom_uniform", "catmull_rom_centripetal", "tcb", "hermite")
SMOOTH = (*MEETING, "bspline")
OUTSIDE = ("hold", "linear", "cycle", "cycle_offset", "oscillate")


@pytest.mark.parametrize("interpolation", [*MEETING, "bezier", "catmull_rom_chordal"])
@pytest.mark.parametrize("points", [NUMBERS, VECTORS], ids=["numbers", "vectors"])
def test_a_key_is_met_exactly(agree, points, interpolation):
    """What is cubic in time goes as it is: at the keys nothing is lost, between them nothing but rounding."""
    track = agree(r4.keys(points, interpolation=interpolation), AWKWARD, exactly_at=TIMES, tolerance=1e-12)

    assert track["kind"] == "poly"
    assert track["degree"] == {"step": 0, "linear": 1}.get(interpolation, 3)


@pytest.mark.parametrize("degree", [1, 2, 3])
def test_splines_up_to_the_third_degree_are_exact(agree, degree):
    """Their pieces lie between knots, which are no keys."""
    signal = r4.keys(NUMBERS, interpolation="bspline", degree=degree)

    agree(signal, [*AWKWARD, *around(signal.curve.breaks)], exactly_at=(TIMES[0], TIMES[-1]), tolerance=1e-12)


@pytest.mark.parametrize("interpolation", ["step", "linear", "catmull_rom", "tcb", "bspline"])
def test_colours_are_mixed_where_the_signals_mix_them(agree, interpolation):
    """In OKLab weighted by alpha; the viewer turns the mixture into sRGB."""
    agree(r4.keys(COLORS, interpolation=interpolation), AWKWARD, tolerance=1e-9)


def test_colours_that_stand_are_exact(agree):
    """Where nothing is mixed nothing is rounded."""
    agree(r4.keys(COLORS, interpolation="step"), AWKWARD, exactly_at=AWKWARD)


@pytest.mark.parametrize("interpolation", ["step", "slerp", "linear"])
def test_turns_are_met_exactly(agree, interpolation):
    """Arcs from rotation to rotation, on the shortest way."""
    track = agree(r4.keys(TURNS, interpolation=interpolation), AWKWARD, exactly_at=TIMES, tolerance=1e-12)

    assert track["kind"] == "slerp" or interpolation == "step"


@pytest.mark.parametrize("values", [("a", "b", "a", "c", "d"), (True, False, True, True, False), range(5)])
def test_held_values_are_exact(agree, values):
    """Strings and truth values stand until the next key."""
    signal = r4.keys(dict(zip(TIMES, values, strict=True)), kind="held")

    agree(signal, AWKWARD, exactly_at=AWKWARD if not isinstance(values[0], str) else ())


def near(ease):
    """How near a track comes: a circle is upright at its end, where the last bit of the time is felt."""
    return 1e-7 if ease.endswith("circ") else 1e-11


@pytest.mark.parametrize("ease", EASINGS)
@pytest.mark.parametrize("interpolation", ["linear", "catmull_rom"])
def test_every_named_ease_is_exact(agree, ease, interpolation):
    """What is a cubic of time goes as one, the others as the tree that they are."""
    tolerance = near(ease)

    agree(r4.keys(NUMBERS, ease=ease, interpolation=interpolation), AWKWARD, exactly_at=TIMES, tolerance=tolerance)


@pytest.mark.parametrize("ease", EASINGS)
def test_every_named_ease_of_vectors_and_turns_is_exact(agree, ease):
    """The same for several numbers, rotations and colours."""
    tolerance = near(ease)

    agree(r4.keys(VECTORS, ease=ease), AWKWARD, exactly_at=TIMES, tolerance=tolerance)
    agree(r4.keys(TURNS, ease=ease), AWKWARD, exactly_at=TIMES, tolerance=tolerance)
    agree(r4.keys(COLORS, ease=ease), AWKWARD, tolerance=max(tolerance, 1e-9))


def test_each_key_may_have_its_own_ease(agree):
    """Neighbours with one ease go together; the others follow one another."""
    eases = ("in_sine", "in_sine", "in_out", "out_elastic", None)
    points = {t: r4.Key(v, ease=ease) for (t, v), ease in zip(NUMBERS.items(), eases, strict=True)}

    agree(r4.keys(points), AWKWARD, exactly_at=TIMES, tolerance=1e-11)
    turns = {t: r4.Key(v, ease=ease) for (t, v), ease in zip(TURNS.items(), eases, strict=True)}
    agree(r4.keys(turns), AWKWARD, exactly_at=TIMES, tolerance=1e-11)


@pytest.mark.parametrize("before", OUTSIDE)
@pytest.mark.parametrize("after", OUTSIDE)
def test_every_extrapolation_is_exact(agree, before, after):
    """Rays, cycles, cycles that climb, to and fro; at the last key itself as well as right after it."""
    outside = {"before": before, "after": after}
    length = TIMES[-1] - TIMES[0]
    borders = [TIMES[0] + k * length + (t - TIMES[0]) for k in (-3, -2, -1, 1, 2) for t in TIMES]
    times = [*AWKWARD[:-1], *around([TIMES[0], TIMES[-1]]), *borders, -41.7, 39.2]

    agree(r4.keys(NUMBERS, **outside), times, exactly_at=TIMES, tolerance=1e-8)
    agree(r4.keys(VECTORS, ease="in_out_sine", **outside), times, exactly_at=TIMES, tolerance=1e-8)
    if "cycle_offset" not in (before, after):
        agree(r4.keys(TURNS, **outside), times, exactly_at=TIMES, tolerance=1e-8)
    if {before, after} <= {"hold", "cycle", "oscillate"}:
        agree(r4.keys(COLORS, **outside), times, tolerance=1e-8)
        agree(r4.keys(dict(zip(TIMES, "abcde", strict=True)), **outside), AWKWARD)


def test_a_single_key_is_a_constant(agree):
    """It holds for ever."""
    for value in (2.5, (1, 2, 3), "red", r4.Rotation.from_axis_angle("x", 30), "ready"):
        track = agree(r4.keys({1: value}, after="cycle"), (-5.0, 1.0, 9.0))
        assert track["kind"] == "const"


def test_handles_make_tangents(agree):
    """Of Hermite curves; of Bezier curves only those that leave time alone."""
    points = {0: r4.Key(0.0, right=(1, 3.0)), 3: r4.Key(2.0, left=(-1, 1.0))}

    agree(r4.keys(points, interpolation="hermite"), np.linspace(-1, 4, 31), exactly_at=(0, 3))
    agree(r4.keys(points, interpolation="bezier"), np.linspace(-1, 4, 31), exactly_at=(0, 3))
    bent = {0: r4.Key(0.0, right=(2.5, 3.0)), 3: r4.Key(2.0, left=(-1, 1.0))}
    assert lower(r4.keys(bent, interpolation="bezier")) is None


@pytest.mark.parametrize(
    "signal",
    [
        r4.keys(NUMBERS, ease=lambda u: u**4),
        r4.keys(NUMBERS, interpolation="bspline", degree=4),
        r4.keys(TURNS, interpolation="catmull_rom"),
        r4.keys({0: 1.0, 1: math.inf}, interpolation="step"),
        r4.keys({0: r4.Sphere(), 1: r4.Sphere()}, kind="held"),
        r4.keys(TURNS, after="cycle_offset"),
    ],
    ids=["a function", "degree 4", "smooth turns", "infinite", "objects", "turns that climb"],
)
def test_what_no_track_says_exactly_is_not_lowered(signal):
    """It is for others to fit it, or to sample it."""
    assert lower(signal) is None


values = st.floats(-1e3, 1e3).map(lambda x: round(x, 6))


@given(
    points=st.dictionaries(st.floats(-20, 20).map(lambda t: round(t, 3)), values, min_size=1, max_size=8),
    interpolation=st.sampled_from(SMOOTH),
    before=st.sampled_from(OUTSIDE),
    after=st.sampled_from(OUTSIDE),
    times=st.lists(st.floats(-60, 60), max_size=10),
)
def test_random_keys_agree(agree, points, interpolation, before, after, times):
    """Any keys under any interpolation and extrapolation."""
    signal = r4.keys(points, interpolation=interpolation, before=before, after=after)
    keys = sorted(points)
    inner = () if interpolation == "bspline" else keys

    agree(signal, [*times, *around(keys)], exactly_at=inner, tolerance=1e-7)


@pytest.mark.parametrize("interpolation", ["linear", "catmull_rom", "step"])
@pytest.mark.parametrize("ease", ["linear", "in_out", "in_out_sine", "out_bounce"])
def test_keyed_motion_takes_two_hundred_bytes_a_key(interpolation, ease):
    """Of three numbers each; nothing per frame."""
    if interpolation == "step":
        ease = "linear"
    chance = np.random.default_rng(5)
    points = {t: tuple(chance.normal(size=3)) for t in np.cumsum(chance.uniform(0.1, 1.0, size=200)).tolist()}
    track = lower(r4.keys(points, interpolation=interpolation, ease=ease))
    per_arch = 4 if ease == "out_bounce" else 1

    assert track is not None
    assert sized(track) / len(points) <= 200 * per_arch


def test_turns_take_two_hundred_bytes_a_key():
    """With and without an ease."""
    points = {float(t): r4.Rotation.from_axis_angle((1, t, 2), 37 * t) for t in range(200)}

    for ease in ("linear", "in_out"):
        track = lower(r4.keys(points, ease=ease))
        assert track is not None
        assert sized(track) / len(points) <= 200


def test_a_played_track_needs_no_signal():
    """What travels is JSON alone."""
    import json

    track = json.loads(json.dumps(lower(r4.keys(VECTORS, ease="in_out", after="oscillate")), allow_nan=False))

    assert play(track, 2.75).tolist() == pytest.approx(r4.keys(VECTORS, ease="in_out").at(2.75).tolist())
