"""A table asks each cell the least number of times."""

import itertools
import math
from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d.errors import TimeError
from reactive4d_widgets.spans import Span, span_of
from reactive4d_widgets.sweeps import Asker, Strip

SPAN = Span(0.0, 4.0, 8)


def asked(signal: r4.Signal[Any], **stops: tuple[Any, ...]) -> tuple[list[Strip], int]:
    """The strips of a signal, and how many asks they took."""
    asker = Asker(SPAN, {name: values[0] for name, values in stops.items()}, stops)
    return asker.sweep(signal), asker.asks


def test_what_holds_for_ever_is_asked_once() -> None:
    """However long the span."""
    strips, asks = asked(r4.Variable(3.0))
    assert asks == 1
    (box,) = strips[0].boxes
    assert (box.lo, box.hi, box.value) == (-math.inf, math.inf, 3.0)


def test_what_is_held_is_asked_once_per_interval() -> None:
    """Also between two ticks."""
    strips, asks = asked(r4.keys({0: "a", 1.1: "b", 3: "c"}))
    assert asks == 3
    assert [(box.lo, box.value) for box in strips[0].boxes] == [(-math.inf, "a"), (1.1, "b"), (3.0, "c")]


def test_what_never_holds_is_asked_once_per_tick() -> None:
    """The last tick is the end."""
    strips, asks = asked(r4.time * 2)
    assert asks == 9
    assert [box.value for box in strips[0].boxes] == [2 * t for t in SPAN]


def test_what_moves_and_then_rests_is_asked_until_it_rests() -> None:
    """Keys from 1 s to 2 s: held, five ticks, held."""
    strips, asks = asked(r4.keys({1: 0.0, 2: 1.0}))
    assert asks == 4
    assert [(box.asked, box.is_instant) for box in strips[0].boxes] == [
        (0.0, False), (1.0, True), (1.5, True), (2.0, False)
    ]  # fmt: skip


def test_only_combinations_that_are_read_are_asked() -> None:
    """
    Either one parameter is read or the other: 2 + 3 + 4 cells, and not 2 * 3 * 4.

        which --> chosen <-- (left or right)
    """
    which, left, right = (r4.Parameter(f"sweep_{name}", 0.0) for name in ("which", "left", "right"))
    unread = r4.Parameter("sweep_unread", 0.0)
    chosen = r4.signal(lambda: left.now() if which.now() > 0 else right.now())
    runs: list[int] = []
    counted = r4.signal(lambda: (runs.append(1), chosen.now())[1])
    strips, _ = asked(
        counted,
        sweep_which=(0.0, 1.0),
        sweep_left=(0.0, 1.0, 2.0),
        sweep_right=(0.0, 1.0, 2.0, 3.0),
        sweep_unread=(0.0, 1.0),
    )
    assert len(runs) == 3 + 4
    assert len(strips) == 3 + 4
    assert {tuple(strip.where) for strip in strips} == {("sweep_left", "sweep_which"), ("sweep_right", "sweep_which")}
    assert unread.name == "sweep_unread"


def test_a_parameter_that_is_read_later_divides_only_what_comes_later() -> None:
    """Before 2 s one answer serves all."""
    p = r4.Parameter("sweep_late", 1.0)
    late = r4.keys({0: 0.0, 2: 1.0}, interpolation="step")
    signal = r4.signal(lambda: p.now() if late.now() else 0.0)
    strips, asks = asked(signal, sweep_late=(1.0, 2.0, 3.0))
    assert asks == 1 + 3
    assert sorted((len(strip.where), len(strip.boxes)) for strip in strips) == [(0, 1), (1, 1), (1, 1), (1, 1)]


def test_a_parameter_without_baked_values_stays_at_its_base_and_is_named() -> None:
    """Whoever reads the table must know that it was read."""
    p = r4.Parameter("sweep_fixed", 1.0)
    asker = Asker(SPAN, {"sweep_fixed": 5.0}, {})
    (strip,) = asker.sweep(2 * p)
    assert strip.where == {"sweep_fixed": 5.0}
    assert strip.boxes[0].value == 10.0


def test_errors_are_boxes() -> None:
    """They hold as answers do."""

    def fail() -> float:
        if late.now():
            raise ValueError("too late")
        return 0.0

    late = r4.keys({0: 0.0, 2: 1.0}, interpolation="step")
    strips, asks = asked(r4.signal(fail))
    assert asks == 2
    assert [(box.lo, str(box.error)) for box in strips[0].boxes] == [(-math.inf, "None"), (2.0, "too late")]


def test_a_cycle_is_an_error_like_any_other() -> None:
    """It is told tick by tick, since it is never remembered."""
    x = r4.Variable(0.0, name="x")
    x.value = r4.signal(lambda: x.now())
    strips, _ = asked(x)
    assert {type(box.error) for box in strips[0].boxes} == {r4.CycleError}


def test_nothing_is_asked_where_nobody_wants_to_know() -> None:
    """The gate is closed until 3 s."""
    strips = Asker(SPAN, {}, {}).sweep(r4.time, lambda t: t >= 3.0)
    assert [box.asked for box in strips[0].boxes] == [3.0, 3.5, 4.0]


@pytest.mark.parametrize(
    ("times", "wanted"),
    [
        (None, Span(1.0, 3.0, 60)),
        ((0, 2), Span(0.0, 2.0, 60)),
        ([0, 0.05], Span(0.0, 0.05, 2)),
        (np.linspace(-1, 1, 5), Span(-1.0, 1.0, 4)),
        (np.arange(0, 1.0, 0.1), Span(0.0, 0.9, 9)),
        ((2, 2), Span(2.0, 2.0, 0)),
    ],
)
def test_times_are_a_span_or_ticks(times: Any, wanted: Span) -> None:
    """Or the default."""
    found = span_of(times, (1.0, 3.0))
    assert (found.start, found.count) == (wanted.start, wanted.count)
    assert found.stop == pytest.approx(wanted.stop)


@pytest.mark.parametrize(
    ("times", "message"),
    [
        ("0 1", "numbers of seconds"),
        (3.0, "two numbers or more"),
        ([0], "two numbers or more"),
        ((1, 0), "0 is before 1"),
        ((0, math.inf), "finite"),
        ((0, math.nan), "finite"),
        ([0, 1, 3], "evenly spaced times: 1 s at first, 2 s from 1, 3"),
        ([0, 1, 1], "later than the one before"),
        ([[0, 1], [2, 3]], "two numbers or more"),
        ((0, 1e6), "too many"),
    ],
)
def test_other_times_are_refused(times: Any, message: str) -> None:
    """With what was meant to be."""
    with pytest.raises(TimeError, match=message) as caught:
        span_of(times, (0.0, 1.0))
    assert caught.value.__notes__


def test_ticks_cover_the_span_without_a_gap() -> None:
    """From any time to the next tick."""
    span = Span(0.1, 1.3, 36)
    ticks = list(span)
    assert (ticks[0], ticks[-1], len(ticks)) == (0.1, 1.3, 37)
    for a, b in itertools.pairwise(ticks):
        assert span.after(a) == b
        assert span.after((a + b) / 2) == b
        assert span.after(math.nextafter(b, 0.0)) == b
    assert span.after(-5.0) == 0.1
    assert span.after(1.3) == math.inf
