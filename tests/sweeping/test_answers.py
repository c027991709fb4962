"""A sweep answers what asking every point by itself would answer."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import reactive4d as r4
from reactive4d.engine import engine
from reactive4d.sweeping import SweepWarning, jobs, random

t = r4.time
a, b = r4.Parameter("swept_a", 1.0), r4.Parameter("swept_b", 2.0)
mode = r4.Parameter("swept_mode", "slow")


@r4.signal
def branching() -> float:
    """Reads b, or time, or neither, as a says."""
    x = a.now()
    return b.now() if x > 1 else (2 * t).now() if x > 0 else x


@r4.signal
def sway(time: float) -> float:
    """Holds for the instant, and reads another signal at it and before."""
    return (a * t).at(time) + (b * t).at(0.25)


# Of everything that a measure can be made of, a few.
LEAVES: list[Any] = [
    t,
    a,
    b,
    a + 0 * t,
    r4.keys({0: 0.0, 0.5: 2.0, 0.75: 2.0}),
    r4.keys({0: 0.0, 1: a}),
    r4.keys({0: 1.0, 0.4: 5.0}, interpolation="step"),
    branching,
    sway,
    r4.Variable(3.0),
    r4.Variable(a * t),
    r4.lift(lambda x: x * x)(a),
    r4.lift(lambda x, y: x - 2 * y)(t, b),
    r4.equal(mode, "fast") * 1.0,
]
UNARY: list[Callable[[Any], Any]] = [
    np.sin,
    lambda x: x.delay(0.3),
    lambda x: x.derivative(),
    lambda x: x.repeat(0.4),
    lambda x: x.warp(t * a),
    lambda x: x.stretch(2.0),
    lambda x: r4.lift(lambda v: float(v) + 1)(x),
    lambda x: x // 1,
    lambda x: -x,
]
BINARY: list[Callable[[Any, Any], Any]] = [
    lambda x, y: x + y,
    lambda x, y: x * y,
    np.minimum,
    lambda x, y: r4.where(x > y, x, y * 2),
    lambda x, y: r4.where(a > 0.5, x, y),
    lambda x, y: r4.lift(lambda v, w: float(v - w))(x, y),
    lambda x, y: r4.vec(x, y, 1)[0] + r4.vec(x, y, 1)[1],
]
SIGNALS = st.recursive(
    st.sampled_from(LEAVES),
    lambda below: (
        st.builds(lambda f, x: f(x), st.sampled_from(UNARY), below)
        | st.builds(lambda f, x, y: f(x, y), st.sampled_from(BINARY), below, below)
    ),
    max_leaves=5,
)
OVER: dict[str, Any] = {
    "swept_a": [-1.0, 0.75, 2.0],
    "swept_b": [1.0, 3.0],
    "time": [0.0, 0.6, 0.2, 1.0],
    "swept_mode": ["slow", "fast"],
}


@settings(deadline=None)
@given(SIGNALS, st.permutations(list(OVER)), st.sampled_from([1, 3, 7, 10**6]), st.booleans())
def test_a_sweep_answers_as_asking_every_point_does(signal: Any, order: list[str], limit: int, masked: bool) -> None:
    """For signals of all kinds, in any order of dimensions, in tiles of any size, with and without `where`."""
    where = (lambda swept_a, swept_b: swept_a + swept_b > 1.5) if masked else None
    engine.forget()
    most, jobs.MOST_ROWS = jobs.MOST_ROWS, limit
    try:
        found = r4.sweep(
            r4.Scene(), over={name: OVER[name] for name in order}, measure={"m": signal}, where=where, progress=False
        )
    finally:
        jobs.MOST_ROWS = most
    assert found["m"].dims == tuple(order)
    for index in np.ndindex(*found["m"].shape):
        values = {name: OVER[name][i] for name, i in zip(order, index, strict=True)}
        got = found["m"].values[index]
        if masked and not values["swept_a"] + values["swept_b"] > 1.5:
            assert np.isnan(got)
        else:
            assert got == pytest.approx(signal.at(values.pop("time"), **values), rel=1e-9, abs=1e-9, nan_ok=True)


def test_time_may_go_along_with_a_parameter() -> None:
    """In a design time is a column as any other."""
    points = random(20, time=(0, 1), swept_a=(-1, 2), swept_b=[1.0, 3.0])
    signal = r4.lift(lambda x, y: x - y)(np.sin(t * a), r4.keys({0: 0.0, 0.5: 1.0, 0.6: 1.0})) + branching
    found = r4.sweep(r4.Scene(), over={"n": points, "swept_mode": ["slow"]}, measure={"m": signal}, progress=False)
    for i in range(20):
        place = {name: found[name].values[i] for name in ("swept_a", "swept_b")}
        assert found["m"].values[i, 0] == pytest.approx(signal.at(found["time"].values[i], **place))


def test_one_point_is_a_sweep_too() -> None:
    """Single values stand still: there are no dimensions."""
    found = r4.sweep(r4.Scene(), over={"swept_a": 3.0, "time": 2.0}, measure={"m": a * t}, progress=False)
    assert (found["m"].item(), found["m"].dims, found["swept_a"].item(), found["time"].item()) == (6.0, (), 3.0, 2.0)


def test_two_parameters_of_one_name_below_one_measure_are_an_error() -> None:
    """As they are for whoever asks."""
    other = r4.Parameter("swept_a", 1.0)
    measure = r4.lift(abs)(a) + other * t
    with pytest.warns(SweepWarning, match="swept_a"):
        found = r4.sweep(r4.Scene(), over={"swept_a": [1.0, 2.0]}, measure={"m": measure}, progress=False)
    assert found["error"].values.tolist()[0].startswith("m: ParameterError")
