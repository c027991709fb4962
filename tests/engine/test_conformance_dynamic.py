"""Dependencies that come and go, cut-offs, nested evaluation; on both evaluators, and then in time."""

import math
from typing import Any

import pytest
from models import INF, Case, Clock, evaluated

from reactive4d.engine import Affine, moment, narrow


def test_only_the_branch_that_is_taken_is_read(case: Case) -> None:
    """
    The other branch is not computed, nor does its edit matter.

        which --> x
        a ------> x      a where which is true
        b ------> x      b elsewhere
    """
    which, s, r = case.source(True, "which"), case.source(1.0), case.source(2.0)
    a, b = case.formula("a", lambda v: v, s), case.formula("b", lambda v: v, r)
    x = case.rule("x", lambda: a.now() if which.now() else b.now())
    assert case.ask(x) == 1.0
    case.expect(a=1, x=1)
    r.set_content(20.0)
    assert case.ask(x) == 1.0
    case.expect()
    which.set_content(False)
    assert case.ask(x) == 20.0
    case.expect(b=1, x=1)
    s.set_content(10.0)
    assert case.ask(x) == 20.0
    case.expect()
    which.set_content(True)
    assert case.ask(x) == 10.0
    case.expect(a=1, x=1)


def test_a_condition_is_looked_at_before_what_is_behind_it(case: Case) -> None:
    """
    What was read only because of an old condition is not computed once the condition has changed.

        s --> safe --> x
        s --> risky -> x      only where safe says so; it raises elsewhere
    """
    s = case.source(1.0)
    safe = case.formula("safe", lambda v: v != 0.0, s)
    risky = case.formula("risky", lambda v: 1.0 / v, s)
    x = case.rule("x", lambda: risky.now() if safe.now() else math.inf)
    assert case.ask(x) == 1.0
    case.expect(safe=1, risky=1, x=1)
    s.set_content(0.0)
    assert case.ask(x) == math.inf
    case.expect(safe=1, x=1)
    s.set_content(4.0)
    assert case.ask(x) == 0.25
    case.expect(safe=1, risky=1, x=1)


def test_links_change_places(case: Case) -> None:
    """
    The two ends of a list are swapped over and over: order of reading is part of what is remembered.

        a, b, order --> x
    """
    a, b, order = case.source("a", "a"), case.source("b", "b"), case.source((0, 1), "order")
    cells = (a, b)
    x = case.rule("x", lambda: "".join(cells[i].now() for i in order.now()))
    for content, text in (((0, 1), "ab"), ((1, 0), "ba"), ((0,), "a"), ((1, 1, 0), "bba"), ((), "")):
        order.set_content(content)
        assert case.ask(x) == text
        case.expect(x=1)
    a.set_content("A")
    b.set_content("B")
    assert case.ask(x) == ""
    case.expect()
    order.set_content((0, 1))
    assert case.ask(x) == "AB"


def test_a_dependency_that_is_dropped_is_no_longer_listened_to(cached: Case) -> None:
    """Nothing is marked by the edit of what is not read any more."""
    which, a, b = cached.source(True, "which"), cached.source(1.0, "a"), cached.source(2.0, "b")
    x = cached.rule("x", lambda: a.now() if which.now() else b.now())
    cached.ask(x)
    which.set_content(False)
    cached.ask(x)
    with cached.engine.log() as log:
        a.set_content(5.0)
        assert [str(event) for event in log] == ["edited a [-inf, inf)"]


def test_an_equal_answer_stops_there(case: Case) -> None:
    """
    A clamp in the middle: what lies behind it does not run as long as it says the same.

        s --> clamp --> y --> z
    """
    s = case.source(5.0)
    clamp = case.formula("clamp", lambda v: min(v, 3.0), s)
    y = case.rule("y", lambda: clamp.now() + 1.0)
    z = case.formula("z", lambda v: v + 1.0, y)
    assert case.ask(z) == 5.0
    case.expect(clamp=1, y=1, z=1)
    s.set_content(6.0)
    assert case.ask(z) == 5.0
    case.expect(clamp=1)
    s.set_content(1.0)
    assert case.ask(z) == 3.0
    case.expect(clamp=1, y=1, z=1)


def test_one_of_two_arms_that_stops_does_not_stop_the_other(case: Case) -> None:
    r"""
    One arm of a diamond is cut off, the other is not.

          s
         / \
     sign   double
         \ /
          x
    """
    s = case.source(5.0)
    sign = case.formula("sign", lambda v: math.copysign(1.0, v), s)
    double = case.formula("double", lambda v: v * 2.0, s)
    x = case.formula("x", lambda a, b: a * b, sign, double)
    assert case.ask(x) == 10.0
    case.expect(sign=1, double=1, x=1)
    s.set_content(6.0)
    assert case.ask(x) == 12.0
    case.expect(sign=1, double=1, x=1)


@pytest.mark.parametrize(
    ("old", "new"),
    [(0.0, -0.0), (1, 1.0), (1, True), (1.0, True), ("1", 1), ((1,), [1]), ((1, 2.0), (1, 2))],
)
def test_what_can_be_told_apart_is_not_equal(case: Case, old: Any, new: Any) -> None:
    """Type and bytes decide, not ==: these pairs are different answers."""
    s = case.source(old)
    same = case.rule("same", s.now)
    x = case.rule("x", lambda: repr(same.now()))
    assert case.ask(x) == repr(old)
    s.set_content(new)
    assert case.ask(x) == repr(new)


def test_nan_is_equal_to_nan(case: Case) -> None:
    """A cell that goes on saying NaN stops there."""
    s = case.source(1.0)
    lost = case.formula("lost", lambda v: v * math.nan, s)
    x = case.formula("x", lambda v: v, lost)
    assert math.isnan(case.ask(x))
    s.set_content(2.0)
    case.ran()
    assert math.isnan(case.ask(x))
    case.expect(lost=1)


def test_cells_may_be_made_while_a_rule_runs(case: Case) -> None:
    """
    A rule makes a cell, asks it, and throws it away; or keeps it for the next time.

        s --> (made anew) --> x
        s --> (kept) -------> y
    """
    s = case.source(1.0)
    kept: list[Any] = []

    def make() -> Any:
        return case.formula("made", lambda v: v + 1.0, s)

    def keep() -> Any:
        if not kept:
            kept.append(make())
        return kept[0].now()

    x, y = case.rule("x", lambda: make().now()), case.rule("y", keep)
    for value in (1.0, 2.0, 3.0):
        s.set_content(value)
        assert (case.ask(x), case.ask(y)) == (value + 1.0, value + 1.0)


def test_a_rule_may_ask_at_a_time_that_another_answer_tells(case: Case) -> None:
    """
    A warp that is itself animated: it is looked at before what it leads to.

        where --> x
        s ------> x      at the time that `where` tells
    """
    where = case.steps({0.0: 1.0, 2.0: 5.0}, "where")
    s = case.steps({0.0: 10.0, 2.0: 20.0, 4.0: 30.0})
    x = case.rule("x", lambda: s.at(where.now()))
    assert [case.ask(x, t) for t in (0.0, 1.9, 2.0, 9.0)] == [10.0, 10.0, 30.0, 30.0]
    case.expect(x=2)
    where.put(0.0, 3.0)
    assert [case.ask(x, t) for t in (0.0, 2.0)] == [20.0, 30.0]
    case.expect(x=1)
    s.put(0.0, 11.0)
    assert [case.ask(x, t) for t in (0.0, 2.0)] == [20.0, 30.0]
    case.expect()


def test_branches_come_and_go_with_time(case: Case) -> None:
    """
    The condition is keyed: each branch is read, and heard of, over its own span.

        which: a [-inf, 2)   b [2, 4)   a [4, inf)
    """
    which = case.steps({0.0: True, 2.0: False, 4.0: True}, "which")
    a, b = case.source(1.0, "a"), case.source(2.0, "b")
    x = case.rule("x", lambda: a.now() if which.now() else b.now())
    times = (1.0, 3.0, 5.0)
    assert [case.ask(x, t) for t in times] == [1.0, 2.0, 1.0]
    case.expect(x=3)
    b.set_content(20.0)
    assert [case.ask(x, t) for t in times] == [1.0, 20.0, 1.0]
    case.expect(x=1)
    a.set_content(10.0)
    assert [case.ask(x, t) for t in times] == [10.0, 20.0, 10.0]
    case.expect(x=2)
    which.put(2.0, True)
    assert [case.ask(x, t) for t in times] == [10.0, 10.0, 10.0]
    case.expect(x=1)


def test_an_equal_answer_stops_there_over_each_span(case: Case) -> None:
    """
    The middle key goes from 5 to 6 behind a clamp at 3: one cell runs, over one span.

        s --> clamp --> y
    """
    s = case.steps({0.0: 1.0, 2.0: 5.0, 4.0: 2.0})
    clamp = case.formula("clamp", lambda v: min(v, 3.0), s)
    y = case.formula("y", lambda v: v + 1.0, clamp)
    assert [case.ask(y, t) for t in (1.0, 3.0, 5.0)] == [2.0, 4.0, 3.0]
    case.ran()
    s.put(2.0, 6.0)
    assert [case.ask(y, t) for t in (1.0, 3.0, 5.0)] == [2.0, 4.0, 3.0]
    case.expect(clamp=1)


def test_a_delay_is_heard_of_later(cached: Case) -> None:
    """
    An edit over [2, 4) is an edit of the delayed over [3, 5), and of the reversed over (6, 8].

        s --1 s later--> late --> view
        s --10 - t-----> back
    """
    s = cached.steps({0.0: 1.0, 2.0: 2.0, 4.0: 3.0})
    late = cached.formula("late", lambda v: v, s, maps=(Affine(1.0, -1.0),))
    view = cached.formula("view", lambda v: v, late)
    back = cached.rule("back", lambda: s.through(Affine(-1.0, 10.0)))
    cells = {view: (0.0, 3.5, 7.0), back: (0.0, 7.0, 9.0)}
    before = {cell: [cached.ask(cell, t) for t in times] for cell, times in cells.items()}
    assert before == {view: [1.0, 2.0, 3.0], back: [3.0, 2.0, 1.0]}
    cached.ran()
    with cached.engine.log() as log:
        s.put(2.0, 9.0)
        spans = {event.name: (round(event.lo, 9), round(event.hi, 9)) for event in log if event.kind == "marked"}
        assert spans == {"late": (3.0, 5.0), "view": (3.0, 5.0), "back": (6.0, 8.0)}
        log.clear()
        assert [cached.ask(view, t) for t in cells[view]] == [1.0, 9.0, 3.0]
        assert [cached.ask(back, t) for t in cells[back]] == [3.0, 9.0, 1.0]
        assert evaluated(log) == ["late", "view", "back"]


def test_reading_the_past_is_legal(case: Case) -> None:
    """
    A sum over its own past, one second at a time.

        s --> x <-- x one second ago
    """
    s = case.steps({0.0: 1.0, 3.0: 2.0})

    def past() -> float:
        if moment() < 0.0:
            narrow(-INF, 0.0)
            return 0.0
        narrow(0.0, INF)
        return s.now() + x.through(Affine(1.0, -1.0))

    x = case.rule("x", past)
    assert [case.ask(x, t) for t in (4.5, 0.5, -1.0, 2.5)] == [7.0, 1.0, 0.0, 3.0]
    s.put(3.0, 10.0)
    case.ran()
    assert [case.ask(x, t) for t in (0.5, 2.5)] == [1.0, 3.0]
    case.expect()
    assert case.ask(x, 4.5) == 23.0
    case.expect(x=2)


def test_a_wave_runs_through_delays_and_comes_together_again(case: Case) -> None:
    r"""
    A diamond in time: both arms show the same edit, at different times.

           s
          / \
     -1 s/   \-2 s
         \   /
           x
    """
    s = case.steps({0.0: 0.0, 10.0: 1.0, 11.0: 0.0})
    x = case.formula("x", lambda a, b: a + 10.0 * b, s, s, maps=(Affine(1.0, -1.0), Affine(1.0, -2.0)))
    times = [n / 2.0 for n in range(18, 30)]
    assert [case.ask(x, t) for t in times] == [0, 0, 0, 0, 1, 1, 10, 10, 0, 0, 0, 0]
    s.put(10.0, 2.0)
    case.ran()
    assert [case.ask(x, t) for t in times] == [0, 0, 0, 0, 2, 2, 20, 20, 0, 0, 0, 0]
    if case.remembers:
        assert case.ran()["x"] <= 4


def test_the_time_itself_makes_an_instant(case: Case) -> None:
    """
    What reads the clock holds for one instant; what reads what does not move holds for ever.

        time --> f --> round --> view
    """
    time = Clock(engine=case.engine)
    f = case.formula("f", lambda t: t * 2.0, time)
    view = case.rule("view", lambda: float(round(f.now())))
    assert [case.ask(view, t) for t in (0.0, 0.1, 0.1, 3.0)] == [0.0, 0.0, 0.0, 6.0]
    case.expect(f=3, view=3)
    interval = view.valid(0.1)
    assert (interval.start, interval.stop) == (0.1, math.nextafter(0.1, INF))
