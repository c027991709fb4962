"""Logs of some cells alone, as who watches a figure at work opens them: nobody else is told anything, or disturbed."""

import threading

import pytest
from models import Background, Case, Gate

from reactive4d.engine.graphs import between


@pytest.fixture
def case() -> Case:
    """A graph of its own."""
    return Case()


def test_a_narrow_log_tells_of_its_cells_and_of_no_others(case: Case) -> None:
    """What lies between them is not told of."""
    s = case.source(1.0)
    x = case.formula("x", lambda v: v + 1.0, s)
    view = case.formula("view", lambda v: v * 2.0, x)
    with case.engine.log([x]) as narrow, case.engine.log() as wide:
        assert case.ask(view) == 4.0
    assert [str(event) for event in narrow] == ["evaluated x [-inf, inf)", "reused x [-inf, inf)"]
    assert {event.name for event in wide} == {"s", "x", "view"}


def test_a_narrow_log_tells_what_its_own_thread_does(case: Case) -> None:
    """Another thread evaluates the same cell meanwhile, elsewhere."""
    s = case.steps({0.0: 1.0, 2.0: 2.0})
    gate = Gate()

    def function(value: float) -> float:
        if threading.current_thread() is not threading.main_thread():
            gate.pass_through()
        return value

    x = case.formula("x", function, s)
    with case.engine.log([x]) as log:
        other = Background(lambda: case.ask(x, 1.0))
        gate.wait()
        assert case.ask(x, 3.0) == 2.0
        gate.open()
        assert other.result() == 1.0
    assert [str(event) for event in log] == ["evaluated x [2, inf)"]


def test_a_narrow_log_starts_no_epoch(case: Case) -> None:
    """Whoever looks whether there was an edit finds none; a log of everything makes all rules look up."""
    x = case.formula("x", lambda v: v, case.source(1.0))
    before = case.engine.epoch
    with case.engine.log([x]):
        case.ask(x)
    assert case.engine.epoch == before
    with case.engine.log():
        pass
    assert case.engine.epoch > before


def test_hits_are_counted_once_while_both_kinds_of_logs_are_open(case: Case) -> None:
    """By the log that tells of all, whichever was opened first."""
    x, y = (case.formula(name, lambda v: v, case.source(1.0)) for name in "xy")
    with case.engine.log([x]), case.engine.log():
        for _ in range(2):
            case.ask(x)
            case.ask(y)
    told = case.engine.stats([x, y])["cells"]
    assert {name: entry["hits"] for name, entry in told.items()} == {"x": 1, "y": 1}


def test_arrows_lead_through_what_is_not_named_and_end_at_what_is(case: Case) -> None:
    """
    Of s, c and view: view reads s through b alone, and s through c as well.

        s --> a --> c --> view
        s --> b --------> view
    """
    s = case.source(1.0)
    a = case.formula("a", lambda v: v, s)
    b = case.rule("b", lambda: s.at(3.0))
    c = case.formula("c", lambda v: v, a)
    view = case.formula("view", lambda x, y: x + y, b, c)
    assert between([s, c, view]) == ((1, 0), (2, 1))
    case.ask(view)
    assert between([s, c, view]) == ((1, 0), (2, 0), (2, 1))
    assert between([s, a, b, c, view]) == ((1, 0), (2, 0), (3, 1), (4, 2), (4, 3))
    assert between([view, s]) == ((0, 1),)
