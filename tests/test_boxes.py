"""An answer comes with the box in which it holds."""

import math
from typing import Any

import pytest

import reactive4d as r4
from reactive4d.boxes import answer
from reactive4d.errors import EvaluationError, ParameterError, TimeError, UnknownNameError
from reactive4d.intervals import FOREVER, Interval


def test_what_reads_nothing_holds_for_ever() -> None:
    """Neither a time nor a parameter has a say."""
    found = answer(r4.Variable(3.0), 1.0)
    assert (found.value, found.error, found.interval, dict(found.parameters)) == (3.0, None, FOREVER, {})


def test_only_the_parameters_that_were_read_are_named_with_the_values_that_they_had() -> None:
    """The one that was not named has its default; the one that was not read is not told."""
    a, b, c = (r4.Parameter(f"boxes_{name}", 1.0) for name in "abc")
    found = answer(a + b, 0.0, boxes_a=2, boxes_c=5.0)
    assert dict(found.parameters) == {"boxes_a": 2.0, "boxes_b": 1.0}
    assert set(found.axes) == {a, b}
    assert c not in found.axes


def test_which_parameters_are_read_may_depend_on_the_point() -> None:
    """
    A rule reads what it needs.

        which --> chosen <-- (left or right)
    """
    which, left, right = (r4.Parameter(f"boxes_{name}", 0.0) for name in ("which", "left", "right"))
    chosen = r4.signal(lambda: left.now() if which.now() > 0 else right.now())
    assert set(answer(chosen, 0.0).parameters) == {"boxes_which", "boxes_right"}
    assert set(answer(chosen, 0.0, boxes_which=1.0).parameters) == {"boxes_which", "boxes_left"}


def test_an_error_is_an_answer_with_a_box() -> None:
    """It is told, not raised, with the path to it."""

    def fail() -> Any:
        if late.now() > 0:
            raise ValueError("too late")
        return 0.0

    late = r4.keys({0: 0.0, 2: 1.0}, interpolation="step")
    failing = r4.signal(fail)
    assert answer(failing, 0.0).interval == Interval(-math.inf, 2.0)
    found = answer(failing, 5.0)
    assert found.value is None
    assert str(found.error) == "too late"
    assert found.interval == Interval(2.0, math.inf)


def test_asking_twice_evaluates_once() -> None:
    """What is remembered answers as it does for `at`."""
    runs: list[float] = []
    x = r4.Variable(1.0)
    y = r4.signal(lambda: runs.append(x.now()))
    answer(y, 0.0)
    answer(y, 9.0)
    assert runs == [1.0]


def test_bad_points_are_refused() -> None:
    """As `at` refuses them."""
    share = r4.Parameter("boxes_share", 0.5, bounds=(0.0, 1.0))
    with pytest.raises(ParameterError, match="not within"):
        answer(share, 0.0, boxes_share=2.0)
    with pytest.raises(UnknownNameError):
        answer(share, 0.0, boxes_sahre=2.0)
    with pytest.raises(TimeError):
        answer(share, math.nan)
    with pytest.raises(TypeError, match="expected a signal"):
        answer(3.0, 0.0)  # pyright: ignore[reportArgumentType]


def test_inside_of_an_evaluation_there_is_no_asking_where_an_answer_holds() -> None:
    """Else the answer would depend on what is remembered."""
    inner = r4.signal(lambda: answer(r4.time, 0.0).value)
    with pytest.raises(EvaluationError, match="inside of the evaluation"):
        inner.at(0.0)
