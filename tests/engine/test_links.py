"""Links: who hears of an edit, over which of its own times; told by the log, not by the tables."""

import gc

import pytest
from models import INF, Case, Clock, marked

from reactive4d.engine import Affine, Computed, Event, Fixed, Formula


def spans(log: list[Event], name: str) -> list[tuple[float, float]]:
    """Where a cell was marked, to nine digits, in order of time; the log is emptied."""
    found = sorted((round(e.lo, 9), round(e.hi, 9)) for e in log if e.kind == "marked" and e.name == name)
    log.clear()
    return found


def test_a_reader_at_a_fixed_time_hears_only_of_that_time(cached: Case, log: list[Event]) -> None:
    """
    An edit elsewhere marks nothing; one there marks the reader everywhere.

        s --at 1 s--> x
    """
    s = cached.steps({0.0: 1.0, 2.0: 2.0})
    x = cached.rule("x", lambda: s.at(1.0))
    assert cached.ask(x, 5.0) == 1.0
    log.clear()
    s.put(2.0, 3.0)
    assert marked(log) == []
    s.put(0.0, 3.0)
    assert spans(log, "x") == [(-INF, INF)]


def test_a_reader_through_two_maps_hears_through_both(cached: Case, log: list[Event]) -> None:
    """
    Its own time, a second ago, and mirrored: an edit over [2, 3) is heard three times.

        s ==> x
    """
    s = cached.steps({float(i): float(i) for i in range(10)})
    x = cached.formula("x", lambda u, v, w: u + v + w, s, s, s, maps=(None, Affine(1.0, -1.0), Affine(-1.0, 10.0)))
    for i in range(20):
        cached.ask(x, i / 2.0)
    log.clear()
    s.put(2.0, 20.0)
    assert spans(log, "x") == [(2.0, 3.0), (3.0, 4.0), (7.0, 8.0)]


@pytest.mark.parametrize("count", [1, 8, 9, 40])
def test_a_reader_at_many_times_hears_of_all_of_them(cached: Case, log: list[Event], count: int) -> None:
    """However many maps a link has, none is missed; beyond a few the link says "anywhere"."""
    s = cached.steps({float(i): float(i) for i in range(50)})
    x = cached.rule("x", lambda: sum(s.at(float(i)) for i in range(count)))
    for i in range(count):
        before = cached.ask(x)
        log.clear()
        s.put(float(i), 100.0 + i)
        assert spans(log, "x") == [(-INF, INF)]
        assert cached.ask(x) == before + 100.0


def test_a_link_that_does_not_know_says_anywhere_but_answers_stay_narrow(cached: Case) -> None:
    """
    Twenty delays: an edit marks the reader everywhere; what it did not touch is checked, not run.

        s ==> x
    """
    s = cached.steps({float(i): float(i) for i in range(40)})
    delays = tuple(Affine(1.0, -float(i)) for i in range(20))
    x = cached.formula("x", lambda *values: sum(values), *[s] * 20, maps=delays)
    for i in range(40):
        cached.ask(x, i + 0.5)
    cached.ran()
    s.put(30.0, 0.0)
    for i in range(30):
        cached.ask(x, i + 0.5)
    cached.expect()
    assert cached.ask(x, 30.5) == sum(range(11, 30))
    cached.expect(x=1)


def test_what_cannot_change_keeps_no_links() -> None:
    """The clock would else know everybody."""
    case = Case()
    clock = Clock(engine=case.engine)
    for i in range(100):
        assert case.ask(case.formula(f"x{i}", lambda t: t, clock), 1.0) == 1.0
    assert clock.readers is None


def test_the_dead_are_swept_out_while_others_come(cached: Case) -> None:
    """A source that is read by ten thousand passing cells, and never edited, knows a few."""
    s = cached.source(1.0)
    kept = cached.formula("kept", lambda v: v, s)
    cached.ask(kept)
    for _ in range(10_000):
        Formula(lambda v: v, s).at(0.0)
        Computed(lambda: s.through(Affine(1.0, 1.0)), engine=cached.engine).at(0.0)
    gc.collect()
    assert len(s.readers) < 100
    with cached.engine.log() as log:
        s.set_content(2.0)
        assert marked(log) == ["kept [-inf, inf)"]


def test_links_of_a_map_that_is_no_longer_used_are_dropped(cached: Case, log: list[Event]) -> None:
    """
    A rule that read at 1 s reads at 5 s from now on: what happens at 1 s is none of its business.

        where, s --> x
    """
    where = cached.source(1.0, "where")
    s = cached.steps({0.0: 0.0, 4.0: 4.0})
    x = cached.rule("x", lambda: s.at(where.now()))
    assert cached.ask(x) == 0.0
    where.set_content(5.0)
    assert cached.ask(x) == 4.0
    s.put(0.0, 1.0)
    cached.ran()
    assert cached.ask(x) == 4.0
    cached.expect()
    s.put(4.0, 5.0)
    assert cached.ask(x) == 5.0


def test_a_formula_through_a_fixed_time_is_one_answer(cached: Case) -> None:
    """
    Whenever it is asked.

        s --at 2 s--> x
    """
    s = cached.steps({0.0: 1.0, 2.0: 2.0})
    x = cached.formula("x", lambda v: v, s, maps=(Fixed(2.0),))
    assert [cached.ask(x, t) for t in (-INF, 0.0, 5.0, INF)] == [2.0] * 4
    cached.expect(x=1)
