"""Keys whose values are signals: sums of these, with weights that are polynomials of time."""

import numpy as np
import pytest

import reactive4d as r4
from reactive4d_widgets.lowering import lower

from .conftest import around

TIMES = (0.0, 1.0, 2.5, 4.0)
AWKWARD = [*around(TIMES), *np.linspace(-1.0, 5.0, 37).tolist(), 1e3]
T = r4.time
WAVES = (np.sin(T), 2.0, T * T, np.cos(3 * T))
PLACES = (r4.vec(T, 0, 1), (1, 2, 3), r4.vec(np.sin(T), T, 2), r4.vec(0, T, T))


@pytest.mark.parametrize("interpolation", ["step", "linear", "catmull_rom", "catmull_rom_uniform", "tcb", "bspline"])
@pytest.mark.parametrize("values", [WAVES, PLACES], ids=["numbers", "vectors"])
def test_signals_are_mixed_as_the_keys_mix_them(agree, values, interpolation):
    """Each counts by a polynomial of time; at its key it alone counts."""
    signal = r4.keys(dict(zip(TIMES, values, strict=True)), interpolation=interpolation)

    agree(signal, AWKWARD, exactly_at=() if interpolation == "bspline" else TIMES, tolerance=1e-9)


@pytest.mark.parametrize("ease", ["in_out", "in_sine", "out_elastic", "in_out_bounce", "in_quint"])
def test_eases_bend_the_weights(agree, ease):
    """Of whatever kind they are."""
    signal = r4.keys(dict(zip(TIMES, WAVES, strict=True)), ease=ease)

    agree(signal, AWKWARD, exactly_at=TIMES, tolerance=1e-9)
    agree(r4.keys(dict(zip(TIMES, PLACES, strict=True)), ease=ease, interpolation="catmull_rom"), AWKWARD)


def test_signals_alone_are_of_a_kind_that_is_found_out(agree):
    """From their shapes."""
    agree(r4.keys({0: np.sin(T), 2: T}), AWKWARD, exactly_at=(0.0, 2.0))
    agree(r4.keys({0: r4.vec(T, 1, 2), 2: r4.vec(1, 2, T)}), AWKWARD, exactly_at=(0.0, 2.0))


def test_outside_of_the_keys_signals_go_on(agree):
    """They hold to the last signal, which itself moves on; or run on straight."""
    agree(r4.keys({0: np.sin(T), 2: T}, after="linear", before="linear"), AWKWARD)
    assert lower(r4.keys({0: np.sin(T), 2: T}, after="cycle")) is None


def test_colours_are_mixed_with_colours_of_keys(agree):
    """A colour that is itself a mixture is found in the space in which colours are mixed."""
    changing = r4.keys({0: "red", 3: "blue"})
    stepping = r4.keys({0: "red", 1: "blue"}, interpolation="step")

    agree(r4.keys({0: "gold", 2: changing, 4: "black"}), AWKWARD)
    agree(r4.keys({0: "gold", 2: stepping, 4: "black"}), AWKWARD)
    assert lower(r4.keys({0: "gold", 2: r4.vec(T, T, T, 1)}, kind="color")) is None


def test_held_signals_follow_one_another(agree):
    """Strings that are chosen, and then others."""
    mode = r4.where(T < 1, "hare", "wolf")

    agree(r4.keys({0: "snail", 0.5: mode, 3: "snail"}, kind="held"), AWKWARD)


def test_turns_between_signals_are_not_lowered():
    """Trees have no arcs."""
    turning = r4.keys({0: r4.Rotation(), 1: r4.Rotation.from_axis_angle("x", 90)})

    assert lower(r4.keys({0: r4.Rotation(), 2: turning})) is None
    assert lower(r4.keys({0: r4.Rotation(), 2: turning}, interpolation="step")) is not None


def test_one_opaque_value_is_enough():
    """What is not lowered is not mixed."""
    assert lower(r4.keys({0: 1.0, 2: r4.signal(lambda t: t * t)})) is None
