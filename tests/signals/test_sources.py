"""Time, variables and parameters: what one sets, and what a reader drives."""

import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import reactive4d as r4
from reactive4d.engine import engine
from reactive4d.errors import CycleError, ParameterError, Reactive4dError, ShapeError, UnknownNameError

t = r4.time
NUMBER = r4.Parameter("s_number", 1.0, bounds=(-2, 2))
WHOLE = r4.Parameter("s_whole", 3)
FLAG = r4.Parameter("s_flag", True)
TEXT = r4.Parameter("s_text", "red")
TRIPLE = r4.Parameter("s_triple", (1, 2, 3), bounds=(-9, 9))


def evaluations(*signals: Any) -> int:
    """How often these signals were evaluated so far."""
    return engine.stats(signals)["evaluations"]


def test_time_answers_with_the_instant() -> None:
    """And holds for that instant; -0.0 is 0.0."""
    assert (t.at(2), t.valid(2).is_instant, math.copysign(1, t.at(-0.0))) == (2.0, True, 1.0)


# -- variables -----------------------------------------------------------------------------------------------------


def test_a_variable_is_set_and_followed() -> None:
    """To a constant, to a signal, and back; `value` and `source` tell what was set."""
    x = r4.Variable(2.0, name="x")
    y = x * 10
    assert (y.at(0), y.valid(0).start) == (20, -math.inf)
    x.value = t
    assert (y.at(3), x.value, x.source) == (30, t, t)
    x.value = 5
    assert (y.at(3), x.value, x.source) == (50, 5, 5)


def test_undo_costs_no_evaluation() -> None:
    """An edit and its reversal: what was remembered holds again, also when it was linked elsewhere meanwhile."""
    x = r4.Variable(2.0)
    y = r4.lift(lambda value: value * 10)(x)
    y.at(0)
    x.value = 3.0
    y.at(0)
    x.value = t
    y.at(1.0)
    count = evaluations(y)
    x.value = 2.0
    assert y.at(0) == 20
    assert evaluations(y) == count


def test_setting_what_was_set_is_no_edit() -> None:
    """Nobody is told; but 1, 1.0 and True differ, and so do 0.0 and -0.0."""
    x = r4.Variable(1.0)
    y = r4.lift(repr)(x)
    assert y.at(0) == "1.0"
    with r4.log() as events:
        x.value = 1.0
    assert not list(events)
    for value in (1, True, 0.0, -0.0):
        x.value = value
        assert y.at(0) == repr(value)


def test_setting_many_times_before_the_next_ask_evaluates_once() -> None:
    """A drag."""
    x = r4.Variable(0.0)
    y = r4.lift(lambda value: value + 1)(x)
    y.at(0)
    for i in range(100):
        x.value = float(i)
    assert (y.at(0), evaluations(y)) == (100, 2)


@pytest.mark.parametrize(
    ("value", "answer"),
    [
        (np.float32(0.5), 0.5), (np.int8(3), 3), (np.bool_(True), True), ("red", "red"), (None, None), (1j, 1j),
        ((1, "a", (2, (3, "b"))), (1, "a", (2, (3, "b")))), ((1, (2, 3)), (1, (2, 3))), (np.array(3.0), 3.0),
        (math.inf, math.inf), (len, len),
    ],
)  # fmt: skip
def test_any_value_can_be_held(value: Any, answer: Any) -> None:
    """NumPy's numbers become Python's; tuples nest without limit."""
    found = r4.Variable(value).at(0)
    assert type(found) is type(answer)
    assert found == answer


@pytest.mark.parametrize("value", [[1, 2, 3], (1, 2, 3), np.array([1, 2, 3]), np.array([1, 2, 3], dtype=np.float32)])
def test_numbers_in_a_row_are_a_vector(value: Any) -> None:
    """A frozen copy of float64: changing what was passed in changes nothing."""
    x = r4.Variable(value)
    if not isinstance(value, tuple):
        value[0] = 100
    assert x.at(0).tolist() == [1, 2, 3]
    assert x.at(0).dtype == np.float64
    with pytest.raises(ValueError, match="read-only"):
        x.at(0)[0] = 7


@pytest.mark.parametrize(
    "value",
    [math.nan, np.nan, [1, math.nan], (1.0, math.nan), ["1", "2"], ["a"], [[1, 2], [3]], np.array(["1"]), [t, 1],
     (t, 1), np.array([1j]), [None], [{}]],
    ids=str,
)  # fmt: skip
def test_a_value_that_cannot_be_is_refused_and_changes_nothing(value: Any) -> None:
    """With the name of the variable and the value."""
    x = r4.Variable(1.0, name="x")
    with pytest.raises(ShapeError, match="x: "):
        x.value = value
    assert x.at(0) == 1.0
    with pytest.raises(ShapeError, match="variable: "):
        r4.Variable(value)


def test_reading_oneself_is_refused() -> None:
    """At once, where declared inputs tell; the hint says how to build on what was there."""
    count = r4.Variable(1.0, name="count")
    other = r4.Variable(count)
    for content in (count, count + 1, other * 2):
        with pytest.raises(Reactive4dError, match="count would read itself") as caught:
            count.value = content
        assert "count.source" in caught.value.__notes__[0]
    count.value = count.source + 1
    assert other.at(0) == 2.0


def test_a_ring_through_a_choice_is_found_when_asked() -> None:
    """With the way round; and setting a constant mends it."""
    a = r4.Variable(1.0, name="a")
    b = r4.Variable(a, name="b")
    a.value = r4.where(b > 1, b, 2.0)
    with pytest.raises(CycleError, match=r"a -> where\(\(b > 1\), b, 2\) -> \(b > 1\) -> b -> a"):
        a.at(0)
    a.value = 5.0
    assert b.at(0) == 5.0


def test_a_hundred_thousand_links() -> None:
    """Asked, edited, asked for many times at once, and freed again without the interpreter's stack."""
    first = r4.Variable(1.0)
    last: Any = first
    for _ in range(100_000):
        last = r4.Variable(last)
    assert last.at(0) == 1.0
    first.value = 2.0
    assert last.at(0) == 2.0
    assert last.at([0.0, 1.0]).tolist() == [2.0, 2.0]
    assert len(r4.explain(last, 0.0).splitlines()) <= 201


# -- parameters ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("parameter", "given", "answer"),
    [
        (NUMBER, 1, 1.0), (NUMBER, True, 1.0), (NUMBER, np.float32(0.5), 0.5), (NUMBER, Fraction(1, 4), 0.25),
        (NUMBER, -0.0, 0.0), (NUMBER, 2, 2.0), (WHOLE, 4.0, 4), (WHOLE, np.int64(5), 5), (FLAG, 0, False),
        (FLAG, np.bool_(False), False), (TEXT, np.str_("blue"), "blue"),
    ],
)  # fmt: skip
def test_a_parameter_takes_what_can_be_taken_for_its_type(parameter: Any, given: Any, answer: Any) -> None:
    """Its type is that of the default, and so is the answer's."""
    found = parameter.at(0, **{parameter.name: given})
    assert type(found) is type(answer)
    assert (found, math.copysign(1, found or 0) if found == 0 else 1) == (answer, 1)


@pytest.mark.parametrize("given", [(4, 5, 6), [4, 5, 6], np.array([4.0, 5, 6]), (np.float32(4), 5, 6)])
def test_a_tuple_of_numbers_is_answered_as_an_array(given: Any) -> None:
    """Frozen."""
    found = TRIPLE.at(0, s_triple=given)
    assert (found.tolist(), found.flags.writeable) == ([4, 5, 6], False)


@pytest.mark.parametrize(
    ("parameter", "given", "what"),
    [
        (NUMBER, "a", "expected a number, got 'a'"), (NUMBER, None, "expected a number"),
        (NUMBER, 3, "not within -2 and 2"),
        (NUMBER, math.nan, "nan is not a value"), (NUMBER, (1.0,), "expected a number"),
        (NUMBER, t, "expected a number"),
        (NUMBER, 10**400, "too large"), (WHOLE, 2.5, "expected a whole number, got 2.5"),
        (WHOLE, math.inf, "whole number"),
        (WHOLE, "3", "whole number"), (FLAG, 2, "True or False"), (FLAG, "yes", "True or False"), (TEXT, 3, "a string"),
        (TRIPLE, (1, 2), "expected 3 numbers"), (TRIPLE, 3, "expected 3 numbers"),
        (TRIPLE, (1, 2, math.nan), "holds nan"),
        (TRIPLE, ("1", "2", "3"), "expected 3 numbers"), (TRIPLE, [[1], [2], [3]], "expected 3 numbers"),
        (TRIPLE, (1, 2, 30), "not within"),
    ],
)  # fmt: skip
def test_any_other_value_is_refused(parameter: Any, given: Any, what: str) -> None:
    """With the name, what was expected, and the value."""
    with pytest.raises(ParameterError, match=what) as caught:
        (parameter + parameter).at(0, **{parameter.name: given})
    assert str(caught.value).startswith(parameter.name)


@pytest.mark.parametrize("name", ["t", "class", "a b", "", "1a", "a-b", 3, None])
def test_a_name_must_be_usable_as_a_keyword(name: Any) -> None:
    """Else nobody could drive it."""
    with pytest.raises(ParameterError, match="not a name for a parameter"):
        r4.Parameter(name, 1.0)


def test_names_are_what_python_makes_of_them() -> None:
    """Python turns the micro sign of a keyboard into a Greek letter, in every keyword."""
    friction = r4.Parameter("µ", 1.0)
    assert eval("friction.at(0, µ=3.0)", {"friction": friction}) == 3.0
    assert r4.Parameter("größe", 1.0).at(0, größe=2.0) == 2.0


@pytest.mark.parametrize("default", [None, {}, t, object(), [[1, 2], [3, 4]], math.nan, (1, math.nan), 1j, [t, 1]])
def test_a_default_must_be_plain(default: Any) -> None:
    """Numbers, truth values, strings, and tuples of numbers."""
    with pytest.raises(ParameterError):
        r4.Parameter("s_default", default)


@pytest.mark.parametrize("bounds", [5, (2, 1), (0,), (0, math.nan), (0, None), ("a", "b"), "ab", (0, 1, 2), t])
def test_bounds_must_be_two_numbers_in_order(bounds: Any) -> None:
    """Both of them are allowed values."""
    with pytest.raises(ParameterError, match="bounds"):
        r4.Parameter("s_bounds", 1.0, bounds=bounds)
    with pytest.raises(ParameterError, match="bounds"):
        r4.Parameter("s_bounds", "red", bounds=(0, 1))


def test_a_name_that_nobody_knows() -> None:
    """The nearest one that somebody does is suggested."""
    with pytest.raises(UnknownNameError) as caught:
        NUMBER.at(0, s_numbre=1.0)
    assert "s_number" in caught.value.__notes__[0]


def test_two_parameters_of_one_name() -> None:
    """Are an error below one signal, and none below two."""
    a, b = r4.Parameter("s_same", 1.0), r4.Parameter("s_same", "text")
    with pytest.raises(ParameterError, match="two different parameters"):
        r4.lift(lambda x, y: 0)(a, b).at(0)
    assert ((a * 2).at(0, s_same=4.0), (b + "!").at(0, s_same="x")) == (8.0, "x!")


@given(st.lists(st.tuples(st.floats(-2, 2), st.integers(-3, 3)), min_size=1, max_size=6))
def test_sliding_back_costs_nothing(points: list[tuple[float, int]]) -> None:
    """Each combination is evaluated once, and what reads one parameter once for each of its values."""
    one, both = r4.lift(lambda x: -x)(NUMBER), r4.lift(lambda x, y: x * y)(NUMBER, WHOLE)
    for _ in range(2):
        for x, n in points:
            assert both.at(0, s_number=x, s_whole=n) == x * n
            assert one.at(0, s_number=x, s_whole=n) == -x
    assert evaluations(both) == len({(x + 0.0, n) for x, n in points})
    assert evaluations(one) == len({x + 0.0 for x, _ in points})


def test_a_value_is_refused_in_the_words_of_the_newest_parameter_of_that_name() -> None:
    """Whoever made one a moment ago means that one, though an older one of the name is still about."""
    older = r4.Parameter("s_namesake", 3)
    newer = r4.Parameter("s_namesake", 0.5, bounds=(0, 1))
    with pytest.raises(ParameterError, match="not within 0 and 1"):
        newer.at(0, s_namesake=1.5)
    assert older.at(0, s_namesake=2) == 2
