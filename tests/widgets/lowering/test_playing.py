"""The reference interpreter: what each kind of track means."""

import math

import numpy as np
import pytest

from reactive4d_widgets.lowering import play, sized
from reactive4d_widgets.lowering.numerals import array_of, coarse, fine

RAMP = {"kind": "poly", "times": [1, 2, 4], "coefficients": [0, 1, 1, -0.5], "degree": 1, "shape": []}


def test_a_polynomial_is_told_by_seconds_since_its_border():
    """Piece k holds over [times[k], times[k + 1])."""
    assert [play(RAMP, t) for t in (1.0, 1.5, 2.0, 3.0)] == [0.0, 0.5, 1.0, 0.5]


def test_a_polynomial_holds_outside_of_its_borders():
    """Before the first and after the last one it is what the end piece is there."""
    assert (play(RAMP, -1e6), play(RAMP, 4.0), play(RAMP, 1e6)) == (0.0, 0.0, 0.0)


def test_the_end_of_a_polynomial_is_said():
    """From the last border on it is what `end` says, to the last bit."""
    track = RAMP | {"end": [0.1]}

    assert (play(track, 4.0), play(track, 9.0), play(track, math.nextafter(4.0, 0.0))) == (0.1, 0.1, pytest.approx(0.0))


def test_several_numbers_are_an_array():
    """The coefficients stand by piece, power, component."""
    track = {"kind": "poly", "times": [0, 1], "coefficients": [1, 2, 10, 20], "degree": 1, "shape": [2]}

    assert play(track, 0.5).tolist() == [6.0, 12.0]


def test_turns_go_the_shortest_way():
    """Of two quaternions that mean one rotation the nearer one is the goal; the answer is canonical."""
    track = {"kind": "slerp", "times": [0, 2], "rotations": [1, 0, 0, 0, -math.sqrt(0.5), 0, 0, -math.sqrt(0.5)]}

    assert play(track, 1.0) == pytest.approx([math.cos(math.pi / 8), 0, 0, math.sin(math.pi / 8)])
    assert play(track, 2.0) == pytest.approx([math.sqrt(0.5), 0, 0, math.sqrt(0.5)])


def test_cases_follow_one_another():
    """Each border belongs to what comes after it; the outermost reach for ever."""
    tracks = [{"kind": "const", "value": i} for i in range(3)]
    track = {"kind": "cases", "times": [None, 0, 1, None], "tracks": tracks}

    assert [play(track, t) for t in (-1e6, 0.0, 0.5, 1.0, 1e6)] == [0, 1, 1, 2, 2]


def test_what_repeats_itself_may_climb():
    """A cycle adds its offset to the next, before the first one as well."""
    ramp = {"kind": "poly", "times": [0, 2], "coefficients": [0, 1], "degree": 1, "shape": []}
    track = {"kind": "repeat", "period": 2, "start": 0, "offset": [10], "track": ramp}

    assert [play(track, t) for t in (1.0, 2.0, 5.0, -0.5)] == [1.0, 10.0, 21.0, -8.5]


def test_held_values_stand_until_the_next():
    """They may be anything that JSON says; before the first time the first one stands."""
    track = {"kind": "stepped", "times": [0, 1], "values": ["mesh", [1, 2]]}

    assert play(track, -5.0) == "mesh"
    assert play(track, 1.0).tolist() == [1.0, 2.0]


def test_samples_are_held_or_blended():
    """Between two ticks lies what is between, if their shapes are equal."""
    arrays = {"a": np.zeros((2, 3)), "b": np.ones((2, 3)), "c": np.ones((5, 3))}
    track = {"kind": "samples", "start": 0, "step": 0.5, "refs": ["a", "b", "c"], "blend": True}

    assert play(track, 0.125, resolve=arrays.__getitem__).tolist() == np.full((2, 3), 0.25).tolist()
    assert play(track, 0.75, resolve=arrays.__getitem__) is arrays["b"]
    assert play(track | {"blend": False}, 0.125, resolve=arrays.__getitem__) is arrays["a"]
    assert play(track, 9.0) == "c"


def test_a_tree_may_be_read_at_another_time():
    """`at` moves the time of all that stands in its first operand, tracks included."""
    tree = ["at", ["+", ["track", RAMP], ["time"]], ["*", ["time"], 0.5]]

    assert play({"kind": "expr", "tree": tree}, 3.0) == 2.0


def test_the_first_factor_acts_first():
    """Each later factor multiplies from the left."""
    factors = [
        {"op": "translate", "offset": {"kind": "const", "value": [1, 0, 0]}},
        {"op": "scale", "factor": {"kind": "const", "value": 3}},
    ]

    assert play({"kind": "product", "factors": factors}, 0.0)[3] == 3.0


@pytest.mark.parametrize("track", [{"kind": "spline"}, {"kind": "expr", "tree": ["eval", 1]}])
def test_what_nobody_knows_is_refused(track):
    """A kind or an operator without a meaning."""
    with pytest.raises(ValueError, match="is no"):
        play(track, 0.0)


def test_a_factor_that_nobody_knows_is_refused():
    """So is a factor."""
    with pytest.raises(ValueError, match="'bend' is no factor"):
        play({"kind": "product", "factors": [{"op": "bend"}]}, 0.0)


@pytest.mark.parametrize("values", [[], [0.1], [1.0, -0.0, 1e300], list(np.linspace(0.0, 1.0, 99))])
def test_numbers_travel_to_the_last_bit(values):
    """Written out or packed, whichever is the shorter."""
    sent = fine(values)

    assert array_of(sent).tolist() == values
    assert np.signbit(array_of(sent)).tolist() == np.signbit(values).tolist()
    assert sized(sent) <= 11 * len(values) + 20


def test_coarse_numbers_have_seven_digits():
    """Half as many bytes; what is too large for that travels whole."""
    values = np.linspace(0.0, 1.0, 99)

    assert np.abs(array_of(coarse(values)) - values).max() < 1e-7
    assert sized(coarse(values)) < 0.55 * sized(fine(values))
    assert array_of(coarse(np.array([1e300]))).tolist() == [1e300]


def test_numbers_of_an_unknown_form_are_refused():
    """Only two forms are packed."""
    with pytest.raises(ValueError, match="expected f64 or f32"):
        array_of({"i8": "AA=="})
