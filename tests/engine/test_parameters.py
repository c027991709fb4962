"""A reader's parameters: an answer is filed under just those that were read to compute it."""

import gc
import math
from typing import Any

import pytest
from models import INF, Case

from reactive4d.engine import Affine, Axis, Event, moment, narrow
from reactive4d.errors import ParameterError, UnknownNameError


@pytest.fixture
def a(case: Case) -> Axis:
    """The parameter a, 1.0 by default."""
    return Axis("a", 1.0, engine=case.engine)


@pytest.fixture
def b(case: Case) -> Axis:
    """The parameter b, 10.0 by default."""
    return Axis("b", 10.0, engine=case.engine)


def test_a_parameter_answers_what_the_reader_gave_else_its_default(case: Case, a: Axis) -> None:
    """Outside of an evaluation the default stands for what was not given."""
    x = case.formula("x", lambda v: v * 2.0, a)
    assert (case.ask(a), case.ask(a, 0.0, a=5.0)) == (1.0, 5.0)
    assert (case.ask(x), case.ask(x, 0.0, a=5.0), case.ask(x, 0.0, a=1.0)) == (2.0, 10.0, 2.0)
    case.expect(x=2)


def test_only_what_read_a_parameter_is_computed_for_it(case: Case, a: Axis, b: Axis) -> None:
    """
    The box rule: neither shares b's answers nor b's reader moves a's.

        s --> neither --> both        a --> of_a --> both
        b --> of_b -----> both
    """
    s = case.source(100.0)
    neither = case.formula("neither", lambda v: v, s)
    of_a = case.rule("of_a", lambda: a.now() + neither.now())
    of_b = case.formula("of_b", lambda v: v, b)
    both = case.formula("both", lambda u, v: u + v, of_a, of_b)
    assert case.ask(both) == 111.0
    case.expect(neither=1, of_a=1, of_b=1, both=1)
    assert case.ask(both, 0.0, a=2.0) == 112.0
    case.expect(of_a=1, both=1)
    assert case.ask(both, 0.0, a=2.0, b=20.0) == 122.0
    case.expect(of_b=1, both=1)
    assert case.ask(both, 0.0, b=20.0) == 121.0
    case.expect(both=1)


def test_going_back_is_a_hit(case: Case, a: Axis) -> None:
    """A slider is moved there and back: the way back computes nothing."""
    x = case.rule("x", lambda: a.now() ** 2)
    there = [case.ask(x, 0.0, a=float(i)) for i in range(20)]
    case.expect(x=20)
    back = [case.ask(x, 0.0, a=float(i)) for i in reversed(range(20))]
    assert back == there[::-1]
    case.expect()


def test_two_readers_share_what_did_not_read_the_parameter(case: Case, a: Axis) -> None:
    """
    The second reader at other values computes just the last cell.

        s --> heavy --> view <-- a
    """
    heavy = case.formula("heavy", lambda v: v, case.source(1.0))
    view = case.rule("view", lambda: heavy.now() * a.now())
    for t in (0.0, 1.0):
        for value in (2.0, 3.0):
            assert case.ask(view, t, a=value) == value
    case.expect(heavy=1, view=2)


def test_an_answer_that_took_the_branch_without_the_parameter_is_found_everywhere(case: Case, a: Axis) -> None:
    """
    Before 2 s the parameter is not read: one answer for every reader.

        which --> x <-- a
    """
    which = case.steps({0.0: False, 2.0: True}, "which")
    x = case.rule("x", lambda: a.now() if which.now() else 0.0)
    assert [case.ask(x, 1.0, a=float(i)) for i in range(5)] == [0.0] * 5
    case.expect(x=1)
    assert [case.ask(x, 3.0, a=float(i)) for i in range(5)] == [0.0, 1.0, 2.0, 3.0, 4.0]
    case.expect(x=5)


def test_an_edit_touches_the_answers_at_all_values(case: Case, a: Axis) -> None:
    """
    Ten values, two spans; an edit over one span runs that span again, at each value that is asked.

        s, a --> x --> y
    """
    s = case.steps({0.0: 1.0, 2.0: 2.0})
    x = case.formula("x", lambda u, v: u * 10.0 + v, s, a)
    y = case.rule("y", lambda: -x.now())
    for value in range(10):
        assert [case.ask(y, t, a=float(value)) for t in (1.0, 3.0)] == [-10.0 - value, -20.0 - value]
    case.ran()
    s.put(2.0, 3.0)
    for value in range(10):
        assert [case.ask(y, t, a=float(value)) for t in (1.0, 3.0)] == [-10.0 - value, -30.0 - value]
    case.expect(x=10, y=10)
    s.put(2.0, 2.0)
    for value in range(10):
        assert case.ask(y, 3.0, a=float(value)) == -20.0 - value
    case.expect()


def test_a_constant_that_is_edited_to_read_a_parameter(case: Case, a: Axis) -> None:
    """
    Trap 12, "50 where 60 was right": the constant equals what it reads at a = 1, but not elsewhere.

        which --> c --> view        c is 5, then 5 * a
    """
    which = case.source(False, "which")
    c = case.rule("c", lambda: 5.0 * a.now() if which.now() else 5.0)
    view = case.rule("view", lambda: c.now() * 10.0)
    assert (case.ask(view), case.ask(view, 0.0, a=1.2)) == (50.0, 50.0)
    which.set_content(True)
    assert case.ask(view) == 50.0
    assert case.ask(view, 0.0, a=1.2) == 60.0
    which.set_content(False)
    assert (case.ask(view, 0.0, a=1.2), case.ask(view)) == (50.0, 50.0)
    which.set_content(True)
    assert (case.ask(view, 0.0, a=1.2), case.ask(view)) == (60.0, 50.0)


def test_a_constant_that_is_edited_to_read_a_parameter_below_a_formula(case: Case, a: Axis) -> None:
    """The same where the reader declares its inputs, and where the other value is asked first."""
    which = case.source(False, "which")
    c = case.rule("c", lambda: 5.0 * a.now() if which.now() else 5.0)
    view = case.formula("view", lambda v: v * 10.0, c)
    assert case.ask(view, 0.0, a=1.2) == 50.0
    which.set_content(True)
    assert [case.ask(view, 0.0, a=value) for value in (1.0, 1.2, 1.0)] == [50.0, 60.0, 50.0]
    which.set_content(False)
    assert [case.ask(view, 0.0, a=value) for value in (1.2, 1.0)] == [50.0, 50.0]


def test_a_rule_may_give_parameters_itself(case: Case, a: Axis, b: Axis) -> None:
    """
    What it gave it does not depend on; what it left to the asker it does.

        a, b --> x --(a = 3)--> y
    """
    x = case.formula("x", lambda u, v: u * 100.0 + v, a, b)
    y = case.rule("y", lambda: x.at(0.0, a=3.0))
    assert [case.ask(y, 0.0, a=value) for value in (1.0, 2.0)] == [310.0, 310.0]
    case.expect(x=1, y=1)
    assert [case.ask(y, 0.0, b=value) for value in (20.0, 10.0)] == [320.0, 310.0]
    case.expect(x=1, y=1)


def test_parameters_not_named_are_the_asker_s_inside_of_an_evaluation(case: Case, a: Axis) -> None:
    """
    A read at a fixed time is at the asker's values.

        a --> x --at 5 s--> y
    """
    x = case.formula("x", lambda v: v, a)
    y = case.rule("y", lambda: x.at(5.0) + x.through(Affine(1.0, 1.0)))
    assert (case.ask(y), case.ask(y, 0.0, a=4.0)) == (2.0, 8.0)


def test_a_rule_may_sweep_a_parameter(case: Case, a: Axis) -> None:
    """
    One rule reads another cell at many values: an edit of its source reaches it once.

        s, a --> x --(a = 0 ... 9)--> total
    """
    s = case.source(1.0)
    x = case.formula("x", lambda u, v: u * v, s, a)
    total = case.rule("total", lambda: math.fsum(x.at(0.0, a=float(i)) for i in range(10)))
    assert case.ask(total, 0.0, a=99.0) == 45.0
    case.expect(x=10, total=1)
    s.set_content(2.0)
    assert case.ask(total) == 90.0
    case.expect(x=10, total=1)


def test_a_parameter_tells_where_to_read(case: Case, a: Axis) -> None:
    """
    A delay that the reader drives.

        s --(a seconds ago)--> x
    """
    s = case.steps({float(i): float(i) for i in range(10)})

    def delayed() -> Any:
        t = moment()
        narrow(t, math.nextafter(t, INF))
        return s.at(t - a.now())

    x = case.rule("x", delayed)
    assert [case.ask(x, 8.5, a=value) for value in (0.0, 2.0, 5.0, 2.0)] == [8.0, 6.0, 3.0, 6.0]
    s.put(6.0, 60.0)
    assert [case.ask(x, 8.5, a=value) for value in (0.0, 2.0, 5.0)] == [8.0, 60.0, 3.0]


def test_time_and_parameters_are_axes_of_one_box(case: Case, a: Axis) -> None:
    """
    Twenty times by five values of what moves with one of them alone: each is computed the least number of times.

        s --> x --> grid        a --> y --> grid
    """
    s = case.steps({float(i): float(i) for i in range(4)})
    x, y = case.formula("x", lambda v: v, s), case.formula("y", lambda v: v, a)
    grid = case.formula("grid", lambda u, v: (u, v), x, y)
    for i in range(20):
        for value in range(5):
            assert case.ask(grid, i / 5.0, a=float(value)) == (float(i // 5), float(value))
    case.expect(x=4, y=5, grid=20)


def test_two_parameters_of_one_name_below_one_cell_are_an_error(case: Case, a: Axis) -> None:
    """
    Apart they may be; together nobody could tell which one is meant.

        a --> x --> both <-- y <-- another a
    """
    other = Axis("a", 2.0, engine=case.engine)
    x, y = case.formula("x", lambda v: v, a), case.rule("y", other.now)
    assert (case.ask(x), case.ask(y)) == (1.0, 2.0)
    for both in (case.formula("both", lambda u, v: u + v, x, y), case.rule("both", lambda: x.now() + y.now())):
        for given in ({}, {"a": 3.0}):
            with pytest.raises(ParameterError, match="both reads two different parameters that are both called 'a'"):
                case.ask(both, 0.0, **given)


def test_a_name_that_nobody_knows_is_refused_with_the_nearest_one(case: Case, a: Axis) -> None:
    """At the border, and inside of a rule."""
    width = Axis("width", 1.0, engine=case.engine)
    x = case.rule("x", lambda: width.now() + a.now())
    with pytest.raises(UnknownNameError, match="unknown parameter 'widht'") as caught:
        case.ask(x, 0.0, widht=2.0)
    assert caught.value.__notes__ == ["hint: did you mean 'width'?"]
    with pytest.raises(UnknownNameError, match="unknown parameter 'widht'"):
        case.ask(case.rule("y", lambda: x.at(0.0, widht=2.0)))


def test_a_value_that_is_none_is_refused(case: Case, a: Axis) -> None:
    """NaN, which equals nothing, and what cannot be hashed; nothing is remembered by it."""
    x = case.formula("x", lambda v: v, a)
    for value in (math.nan, [1.0], {}):
        with pytest.raises(ParameterError, match="a: "):
            case.ask(x, 0.0, a=value)
    assert case.ask(x) == 1.0


def test_minus_zero_and_zero_are_one_value(case: Case, a: Axis) -> None:
    """Equal values are one value, whichever comes first."""
    x = case.formula("x", lambda v: math.copysign(1.0, v), a)
    assert [case.ask(x, 0.0, a=value) for value in (-0.0, 0.0, -0.0)] == [1.0, 1.0, 1.0]
    case.expect(x=1)


def test_parameters_that_a_cell_does_not_read_do_not_matter(cached: Case, log: list[Event]) -> None:
    """They are the reader's, not the cell's: one answer for all."""
    Axis("other", 1.0, engine=cached.engine)
    held = [Axis("held", 1.0, engine=cached.engine)]
    gc.collect()
    x = cached.formula("x", lambda v: v, cached.source(1.0))
    assert [cached.ask(x, 0.0, held=float(i)) for i in range(10)] == [1.0] * 10
    cached.expect(x=1)
    assert held


def test_errors_are_filed_under_parameters_too(case: Case, a: Axis) -> None:
    """
    At a = 0 there is no answer; elsewhere there is.

        a --> x --> y
    """
    x = case.formula("x", lambda v: 1.0 / v, a)
    y = case.rule("y", lambda: x.now() + 1.0)
    for _ in range(2):
        with pytest.raises(ZeroDivisionError):
            case.ask(y, 0.0, a=0.0)
        assert case.ask(y, 0.0, a=2.0) == 1.5
    case.expect(x=2, y=2)
