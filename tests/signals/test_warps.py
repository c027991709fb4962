"""Warps: the same signal at other times, with what holds and what an edit touches."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive4d.engine import Affine, TimeMap, engine
from reactive4d.errors import TimeError
from reactive4d.signals.facade import Signal
from reactive4d.signals.keys import Keys, keys
from reactive4d.signals.maps import Creep, Discrete, Hold, Repeat, SlowInOut, forward_each
from reactive4d.signals.sources import Variable, time
from reactive4d.signals.warps import creep, delay, discrete, hold, repeat, reverse, slow_in_out, stretch, warp

INF = math.inf
ENDS = st.one_of(st.integers(-12, 12).map(lambda n: n / 3), st.floats(-20, 20))
LENGTHS = st.one_of(st.integers(1, 12).map(lambda n: n / 7), st.floats(1e-3, 30))
MAPS = st.one_of(
    st.builds(lambda s: Affine(1.0, s), ENDS),
    st.builds(lambda f, o: Affine(f, o), st.sampled_from([2.0, 1 / 3, -1.0, -0.7, 0.1]), ENDS),
    st.builds(Repeat, LENGTHS, ENDS),
    st.builds(lambda a, d: Hold(a, a + d), ENDS, LENGTHS),
    st.builds(lambda a, d, s: Creep(a, a + d, s), ENDS, LENGTHS, st.sampled_from([0.3, 0.5, 1.0, 2.0, 3.7])),
    st.builds(lambda a, d, s, u: SlowInOut(a, a + d, s, u), ENDS, LENGTHS, st.floats(0.4, 4), st.floats(0.4, 4)),
    st.builds(Discrete, st.sampled_from([10.0, 24.0, 30.0, 29.97, 0.3])),
)


def _near(t: float) -> list[float]:
    """A time and its neighbours among the floats."""
    below, above = math.nextafter(t, -INF), math.nextafter(t, INF)
    return [math.nextafter(below, -INF), below, t, above, math.nextafter(above, INF)]


def _between(lo: float, hi: float) -> list[float]:
    low, high = max(lo, -60.0), min(hi, 60.0)
    return [low + (high - low) * k / 16 for k in range(17)]


@given(MAPS, ENDS, LENGTHS, st.floats(-40, 40), st.booleans())
def test_what_is_pulled_back_holds(time_map: TimeMap, lo: float, length: float, t: float, is_tight: bool) -> None:
    """Every time of the interval that is claimed reads inside of the interval that was given."""
    if is_tight:
        lo = time_map.forward(t)
    elif not lo <= time_map.forward(t) < lo + length:
        lo = time_map.forward(t) - length / 2
    hi = lo + length
    start, stop = time_map.pull(lo, hi, t)
    assert start <= t < stop
    for x in [*_near(start), *_near(stop), *_between(start, stop)]:
        if start <= x < stop:
            assert lo <= time_map.forward(x) < hi, x


@given(MAPS, ENDS, LENGTHS, st.lists(st.floats(-40, 40), max_size=6))
def test_no_reader_is_missed(time_map: TimeMap, lo: float, length: float, times: list[float]) -> None:
    """Whoever reads inside of an interval is in the preimage that is told."""
    hi = lo + length
    spans = time_map.preimage(lo, hi)
    edges = [x for span in spans for end in span if abs(end) < INF for x in _near(end)]
    for x in [*edges, *times, *_near(lo), *_near(hi), *_between(lo - 30, hi + 30)]:
        if lo <= time_map.forward(x) < hi:
            assert any(a <= x < b for a, b in spans), x


@given(MAPS, st.lists(st.floats(-40, 40), max_size=9))
def test_many_times_are_mapped_as_one(time_map: TimeMap, times: list[float]) -> None:
    """To the last bit."""
    assert forward_each(time_map, np.array(times)).tolist() == [time_map.forward(t) for t in times]


WARPS: dict[str, Callable[[Signal[Any]], Signal[Any]]] = {
    "delay": lambda x: delay(x, 1.3),
    "stretch": lambda x: stretch(x, 2.5, about=1),
    "backwards": lambda x: stretch(x, -0.5),
    "reverse": lambda x: reverse(x, 0, 5),
    "repeat": lambda x: repeat(x, 3.1, start=0.7),
    "hold": lambda x: hold(x, 1, 4),
    "creep": lambda x: creep(x, 0, 6, speed=2.2),
    "slow_in_out": lambda x: slow_in_out(x, 0, 6, slow_in=1.5),
    "discrete": lambda x: discrete(x, 2.4),
    "delay by a signal": lambda x: delay(x, keys({0: 1.0, 2: 3.0}, interpolation="step")),
    "stretch by a signal": lambda x: stretch(x, keys({0: 1.0, 2: 3.0})),
    "warp": lambda x: warp(x, keys({0: 5.0, 2: 1.0, 3: 1.0, 6: 4.0})),
}
VALUES = st.sampled_from([0.0, 1.0, 2.0])


@pytest.mark.parametrize("name", WARPS)
@given(
    st.dictionaries(st.integers(0, 12).map(lambda n: n / 2), VALUES, min_size=1, max_size=7),
    st.lists(st.tuples(st.integers(0, 12).map(lambda n: n / 2), VALUES), max_size=4),
    st.lists(st.floats(-10, 16), min_size=1, max_size=8),
)
def test_warped_steps_are_right_through_edits(
    name: str, points: dict[float, float], edits: list[tuple[float, float]], times: list[float]
) -> None:
    """
    Claimed intervals are never wrong, and no edit is missed.

        keys --[map]--> warped --> doubled
    """
    steps: Keys[float] = keys(points, interpolation="step")
    warped = WARPS[name](steps)
    doubled = 2 * warped
    asked = sorted({*times, *np.linspace(-8, 14, 23).tolist()})
    for edit in [None, *edits]:
        if edit is not None:
            steps.points[edit[0]] = edit[1]
        for t in asked:
            value = doubled.at(t)
            assert value == 2 * engine.naive(warped, t)
            span = doubled.valid(t)
            for x in (span.start, math.nextafter(span.stop, -INF), (max(span.start, -99) + min(span.stop, 99)) / 2):
                if span.start <= x < span.stop and abs(x) < INF:
                    assert 2 * engine.naive(warped, x) == value, x
        assert (2 * np.array([warped.at(t) for t in asked])).tolist() == doubled.at(np.array(asked)).tolist()
    engine.check([steps, warped, doubled])


@pytest.mark.parametrize(
    ("name", "t", "span"),
    [
        ("delay", 3.0, (2.3, 3.3)),
        ("stretch", 2.0, (1.0, 3.5)),
        ("reverse", 3.5, (3.0, 4.0)),
        ("repeat", 4.5, (4.1, 5.1)),
        ("hold", 9.0, (3.0, INF)),
        ("discrete", 1.3, (2.5 / 2.4, 5 / 2.4)),
    ],
)
def test_a_held_span_stays_held(name: str, t: float, span: tuple[float, float]) -> None:
    """As long as it lasts, only elsewhere."""
    steps = keys({0: 0.0, 1: 1.0, 2: 2.0, 3: 3.0}, interpolation="step")
    interval = WARPS[name](steps).valid(t)
    assert (interval.start, interval.stop) == pytest.approx(span, abs=0.5 if name == "discrete" else 1e-12)


def test_frames_hold_whole() -> None:
    """Whatever moves, a frame is one picture; neighbours that begin in one held span are one."""
    moving = discrete(time, 4)
    assert (moving.at(0.6), moving.valid(0.6).start, moving.valid(0.6).stop) == (0.5, 0.5, 0.75)
    held = discrete(keys({0: 0.0, 1: 1.0}, interpolation="step"), 4)
    assert (held.valid(0.3).start, held.valid(0.3).stop) == (-INF, 1.0)


def test_the_time_of_a_frame_lies_in_it() -> None:
    """However k / fps was rounded."""
    for fps in (24.0, 25.0, 29.97, 30.0, 60.0):
        assert [Discrete(fps).frame(k / fps) for k in range(1000)] == list(range(1000))


def test_an_edit_outside_of_what_is_repeated_touches_nothing() -> None:
    """Only [start, start + period) is read."""
    steps = keys({0: 0.0, 1: 1.0, 9: 2.0}, interpolation="step", name="steps")
    again = repeat(steps, 2)
    again.at(5.0)
    with engine.log() as log:
        steps.points[9] = 3.0
    assert list(map(str, log)) == ["edited steps [9, inf)"]


def test_an_edit_is_felt_where_the_warp_takes_it() -> None:
    """
    Keys from 2 to 3 are read 10 s later.

        keys --[t - 10]--> later
    """
    steps = keys({0: 0.0, 2: 1.0, 3: 2.0}, interpolation="step", name="steps")
    later = delay(steps, 10)
    calls: list[float] = []
    seen = later.map(lambda x: calls.append(x) or x)
    for t in (5.0, 12.5, 14.0):
        seen.at(t)
    calls.clear()
    steps.points[2] = 7.0
    assert [seen.at(t) for t in (5.0, 12.5, 14.0)] == [0.0, 7.0, 2.0]
    assert calls == [7.0]


def test_a_live_delay_is_asked_first() -> None:
    """Its edit changes what is read, and what it does not change is not computed again."""
    seconds = Variable(1.0)
    later = delay(time, seconds)
    assert later.at(5.0) == 4.0
    seconds.value = 2.0
    assert later.at(5.0) == 3.0
    seconds.value = time / 2
    assert later.at(5.0) == 2.5
    assert later.at(np.array([2.0, 5.0])).tolist() == [1.0, 2.5]


def test_warps_of_warps() -> None:
    """One after the other, from the inside out."""
    assert reverse(delay(time, 1), 0, 4).at(1.0) == 2.0
    assert delay(reverse(time, 0, 4), 1).at(1.0) == 4.0


@pytest.mark.parametrize(
    "make",
    [
        lambda: delay(time, math.nan),
        lambda: delay(time, "1"),
        lambda: stretch(time, 0),
        lambda: stretch(time, 1e-320),
        lambda: repeat(time, 0),
        lambda: repeat(time, 1e-9, start=1e9),
        lambda: hold(time, 3, 1),
        lambda: creep(time, 3, 1),
        lambda: creep(time, 0, 1, speed=0),
        lambda: slow_in_out(time, 0, 1, slow_in=-1),
        lambda: discrete(time, 0),
        lambda: warp(time, 3),  # pyright: ignore[reportArgumentType]
        lambda: delay(time, Variable(math.inf)).at(0.0),
    ],
)
def test_bad_parameters_are_refused(make: Callable[[], Any]) -> None:
    """When the warp is made; a live one, when it is asked."""
    with pytest.raises(TimeError):
        make()
