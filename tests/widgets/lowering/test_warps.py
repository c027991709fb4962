"""Warps: the same signal at other times, by fixed maps and by maps that follow signals."""

import numpy as np
import pytest

import reactive4d as r4
from reactive4d.signals import warps
from reactive4d_widgets.lowering import lower

from .conftest import around

T = r4.time
KEYS = r4.keys({0: 0.0, 1: 2.0, 3: -1.0}, interpolation="catmull_rom")
SLOW = r4.Parameter("slow", 2.0)
BORDERS = (-2.0, -0.5, 0.0, 0.25, 0.5, 1.0, 1.5, 1.75, 2.0, 2.5, 3.0)
AWKWARD = [*around(BORDERS), *np.linspace(-4.0, 7.0, 45).tolist(), -77.3, 1e3]

FIXED = {
    "delay": lambda x: x.delay(0.75),
    "stretch": lambda x: x.stretch(1.7, about=0.5),
    "backwards": lambda x: x.stretch(-0.5),
    "reverse": lambda x: x.reverse(0.0, 3.0),
    "repeat": lambda x: x.repeat(1.3, start=-0.5),
    "hold": lambda x: x.hold(0.25, 2.5),
    "hold before": lambda x: x.hold(before=0.25),
    "hold after": lambda x: x.hold(after=2.5),
    "creep": lambda x: warps.creep(x, 0, 2, speed=3.0),
    "slow in": lambda x: warps.slow_in_out(x, 0, 3, slow_in=1.5, slow_out=4.0),
    "discrete": lambda x: warps.discrete(x, 10),
    "frames": lambda x: warps.discrete(x, 29.97),
    "twice": lambda x: x.repeat(1.5).delay(0.3).stretch(2.0),
    "warp": lambda x: x.warp(np.sin(T) * 2),
}
FOLLOWED = {
    "delay": lambda x: x.delay(SLOW * 0.25 + 0.1 * T),
    "stretch": lambda x: warps.stretch(x, SLOW, about=T * 0.5),
    "reverse": lambda x: warps.reverse(x, 0.0, SLOW),
    "repeat": lambda x: warps.repeat(x, SLOW, start=0.5),
    "hold": lambda x: warps.hold(x, None, SLOW),
    "creep": lambda x: warps.creep(x, 0.0, SLOW, speed=1.5),
    "slow in": lambda x: warps.slow_in_out(x, 0.0, SLOW, slow_in=2.0, slow_out=SLOW),
    "discrete": lambda x: warps.discrete(x, SLOW * 5),
    "warp": lambda x: warps.warp(x, SLOW * np.cos(T)),
}


@pytest.mark.parametrize("name", FIXED)
def test_fixed_warps_agree(agree, name):
    """At the borders of the map and next to them."""
    agree(FIXED[name](KEYS), AWKWARD, tolerance=1e-8)
    agree(FIXED[name](np.sin(3 * T)), AWKWARD, tolerance=1e-8)


@pytest.mark.parametrize("name", FOLLOWED)
def test_warps_that_follow_signals_agree(agree, name):
    """Their parameters are asked at the asked time."""
    for slow in (2.0, 1.3):
        agree(FOLLOWED[name](KEYS), [t for t in AWKWARD if abs(t) < 100], tolerance=1e-8, slow=slow)


def test_held_values_are_read_at_other_times(agree):
    """A warp moves what is held as well."""
    agree(r4.keys({0: "a", 1: "b"}).repeat(2.0), AWKWARD)
    assert lower(r4.Variable("a").delay(3)) == {"kind": "const", "value": "a"}


def test_a_map_of_one_s_own_is_not_lowered():
    """Nobody knows where it reads."""
    from reactive4d.engine import Affine
    from reactive4d.signals.warps import Follow

    assert lower(Follow(KEYS, lambda x: Affine(2.0, x), T, name="mine")) is None
