"""Pieces: comparisons, steps and bends of what runs steadily know how long they hold, to the last float."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import reactive4d as r4
from reactive4d.arrays import same
from reactive4d.engine import engine
from reactive4d.signals.crossings import end, start

INF = math.inf
t = r4.time
NUMBERS = st.one_of(
    st.integers(-6, 6).map(float),
    st.floats(-50, 50),
    st.floats(allow_nan=False, allow_infinity=False),
    st.sampled_from([1e-320, -1e-300, 1e300, 0.1, 1 / 3]),
)
TIMES = st.one_of(st.integers(-8, 8).map(lambda n: n / 2), NUMBERS, st.sampled_from([INF, -INF, -0.0]))
KEYED = r4.keys({0: 0.0, 2: 5.0, 4: 5.0, 7: -3.0}, before="linear", after="hold")
FALLING = r4.keys({-3: 4.0, 5: -4.0}, before="linear", after="linear")


def _line(draw: Any) -> Any:
    """A signal that runs steadily: time or keys, after some arithmetic with numbers."""
    signal = draw(st.sampled_from([t, t, KEYED, FALLING]))
    for _ in range(draw(st.integers(0, 3))):
        x = draw(NUMBERS)
        kind = draw(st.sampled_from(["+", "-", "r-", "*", "/", "neg", "abs", "min", "max", "clip", "held"]))
        if kind == "+":
            signal = signal + x
        elif kind == "-":
            signal = signal - x
        elif kind == "r-":
            signal = x - signal
        elif kind == "*":
            signal = signal * x
        elif kind == "/":
            signal = signal / (x or 1.0)
        elif kind == "neg":
            signal = -signal
        elif kind == "abs":
            signal = abs(signal)
        elif kind == "min":
            signal = np.minimum(signal, x)
        elif kind == "max":
            signal = np.maximum(x, signal)
        elif kind == "clip":
            signal = np.clip(signal, min(x, 1.0), max(x, 1.0))
        else:
            signal = signal + r4.Variable(x)
    return signal


@st.composite
def stepping(draw: Any, of: Any = None) -> Any:
    """A comparison, step or bend of such a signal."""
    signal, x = _line(draw) if of is None else draw(of), draw(NUMBERS)
    digits = draw(st.integers(0, 3))
    unit = draw(st.sampled_from([0.1, 1.0, -2.0, 3.0, 1e-3, 1e20]))
    choices = {
        "<": lambda: signal < x, "<=": lambda: signal <= x, ">": lambda: signal > x, ">=": lambda: signal >= x,
        "r<": lambda: x < signal, "floor": lambda: np.floor(signal), "ceil": lambda: np.ceil(signal),
        "rint": lambda: round(signal), "trunc": lambda: np.trunc(signal), "sign": lambda: np.sign(signal),
        "signbit": lambda: np.signbit(signal), "heaviside": lambda: np.heaviside(signal, 0.5),
        "//": lambda: signal // unit, "r//": lambda: x // signal, "round": lambda: round(signal, digits),
        "minimum": lambda: np.minimum(signal, x), "maximum": lambda: np.maximum(x, signal),
        "fmin": lambda: np.fmin(x, signal), "clip": lambda: np.clip(signal, min(x, 0.0), max(x, 0.0)),
        "where": lambda: r4.where(signal < x, "yes", "no"),
    }  # fmt: skip
    return choices[draw(st.sampled_from(sorted(choices)))]()


def _near(x: float) -> list[float]:
    below, above = math.nextafter(x, -INF), math.nextafter(x, INF)
    return [math.nextafter(below, -INF), below, x, above, math.nextafter(above, INF)]


@given(stepping(), TIMES, st.lists(TIMES, max_size=5))
def test_every_claimed_interval_holds(signal: Any, at: float, others: list[float]) -> None:
    """At its ends, within one float of them, in its middle, at any other time in it; answers are the naive ones."""
    engine.forget([signal])
    value = signal.at(at)
    assert same(value, engine.naive(signal, at))
    span = signal.valid(at)
    lo, hi = span.start, span.stop
    middle = [max(lo, -1e308) * (1 - w) + min(hi, 1e308) * w for w in (0.1, 0.5, 0.9)]
    for x in [*_near(lo), *_near(hi), *_near(0.0), *middle, *others]:
        if lo <= x < hi:
            assert same(engine.naive(signal, x), value), x


@given(stepping(of=st.builds(lambda a, b: a * t + b, st.floats(-9, 9).filter(bool), st.floats(-9, 9))), TIMES)
def test_the_ends_of_steps_are_tight(signal: Any, at: float) -> None:
    """One float before and after a piece of more than an instant the answer is another."""
    engine.forget([signal])
    value, span = signal.at(at), signal.valid(at)
    if span.is_instant:
        return
    for x in (math.nextafter(span.start, -INF), span.stop):
        if abs(x) < 1e300 and x == x:
            assert not same(engine.naive(signal, x), value)


@pytest.mark.parametrize(
    ("signal", "at", "span"),
    [
        (t < 3, 0.0, (-INF, 3.0)),
        (t <= 3, 0.0, (-INF, math.nextafter(3.0, INF))),
        (t > 3, 3.0, (-INF, math.nextafter(3.0, INF))),
        (t <= 3, 4.0, (math.nextafter(3.0, INF), INF)),
        (2 * t + 1 < 7, 0.0, (-INF, 3.0)),
        (1 - t < 0, 0.0, (-INF, math.nextafter(1.0, INF))),
        (np.floor(t), 2.5, (2.0, 3.0)),
        (np.ceil(t), 2.5, (math.nextafter(2.0, INF), math.nextafter(3.0, INF))),
        (np.floor(-t), 1.5, (math.nextafter(1.0, INF), math.nextafter(2.0, INF))),
        (np.sign(t), 5.0, (math.nextafter(0.0, INF), INF)),
        (np.rint(t), 2.0, (1.5, math.nextafter(2.5, INF))),
        (round(t, 1), 2.0, (1.95, 2.05)),
        (abs(t - 5) < 2, 6.0, (5.0, 7.0)),
        (t // 2, 5.0, (4.0, 6.0)),
        (t // -2, 5.0, (math.nextafter(4.0, INF), math.nextafter(6.0, INF))),
        (np.minimum(t, 3), 9.0, (3.0, INF)),
        (np.maximum(t, 3), 1.0, (-INF, math.nextafter(3.0, INF))),
        (np.clip(t, 0, 1), 5.0, (1.0, INF)),
        (KEYED > 2.5, 0.5, (0.0, math.nextafter(1.0, INF))),
        (KEYED > 2.5, 3.0, (2.0, 4.0)),
        (r4.where(t < 3, 1.0, 2.0), 0.0, (-INF, 3.0)),
        (r4.where((t * 2 - 4) < 2, "a", "b"), 3.0, (3.0, INF)),
    ],
)
def test_pieces_that_one_can_tell(signal: Any, at: float, span: tuple[float, float]) -> None:
    """Exactly up to where the answer changes, or to where a line turns."""
    engine.forget([signal])
    found = signal.valid(at)
    if "round" in signal.name:
        assert np.allclose((found.start, found.stop), span)
    else:
        assert (found.start, found.stop) == span


def test_a_choice_between_constants_is_evaluated_twice() -> None:
    """Once before and once from 3 seconds on, whatever is asked in between."""
    step = r4.where(t < 3, "before", "after")
    for x in np.linspace(-5, 15, 100).tolist():
        assert step.at(x) == ("before" if x < 3 else "after")
    assert engine.stats([step])["evaluations"] == 2


def test_a_line_that_is_edited_moves_its_pieces() -> None:
    """What keys and variables say is depended on."""
    k, limit = r4.keys({0: 0.0, 4: 4.0}), r4.Variable(1.0)
    high = k > limit
    assert high.valid(3.0).start == math.nextafter(1.0, INF)
    limit.value = 2.0
    assert high.valid(3.0).start == math.nextafter(2.0, INF)
    k.points[4] = 8.0
    engine.forget([high])  # `valid` may be clipped to what was known before
    assert high.valid(3.0).start == math.nextafter(1.0, INF)
    assert high.at(1.5)
    assert not high.at(0.5)


@pytest.mark.parametrize(
    "signal",
    [t * 1e-200 * 1e-200 > 0, t + INF > 3, t * INF > 3, 0 // t, INF // t, t // INF, t < 10**400, t // 1e-320,
     np.sign(t * -0.0), t - INF < 0, (t * 1e300) // 1e-300],
)  # fmt: skip
@pytest.mark.parametrize("at", [1.0, -1.0, 0.0, 1e300, -1e300, INF, -INF])
def test_what_leaves_the_numbers_claims_nothing_wrong(signal: Any, at: float) -> None:
    """Constants that vanish, overflow or are infinite."""
    engine.forget([signal])
    value, span = signal.at(at), signal.valid(at)
    for x in (-INF, -1e308, -1e300, -1.0, -5e-324, 0.0, 5e-324, 1.0, 1e200, 1e300, INF):
        if span.start <= min(x, 1.7e308) < span.stop:
            assert same(engine.naive(signal, x), value), x


def test_two_lines_are_compared_instant_by_instant() -> None:
    """Their rounding is not one function's."""
    assert (t < 2 * t).valid(1.0).is_instant


@given(TIMES.filter(math.isfinite), NUMBERS, NUMBERS)
@example(0.0, -1e-320, 1e-320)
@example(1.0, 0.0, 0.0)
def test_the_ends_are_found_with_or_without_a_guess(at: float, a: float, b: float) -> None:
    """A wrong guess costs steps, and nothing else."""
    at = at + 0.0
    lo, hi = min(a, b), max(a, b)
    if not lo <= at < hi:
        return

    def stays(x: float) -> bool:
        return lo <= x < hi

    for guesses in ((), (lo, hi), (at, 0.0, hi - 1.0, lo + 1.0)):
        assert (start(stays, at, -INF, guesses), end(stays, at, INF, guesses)) == (lo, hi)
