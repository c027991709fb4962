"""Errors are answers, and cycles are errors; on both evaluators."""

import contextlib
import gc
import math
import weakref
from typing import Any

import pytest
from models import INF, Case

from reactive4d.engine import Affine, moment, narrow
from reactive4d.errors import CycleError, EvaluationError, TimeError


def reciprocal(value: float) -> float:
    """1 / value; where that does not exist, an error that says so."""
    if value == 0.0:
        raise ValueError("nothing to divide by")
    return 1.0 / value


def test_an_error_comes_to_whoever_asks_and_goes_with_its_cause(case: Case) -> None:
    """
    Two cells away from where it arises, and gone after the next edit.

        s --> a --> b --> c
    """
    s = case.source(0.0)
    a = case.formula("a", reciprocal, s)
    b = case.rule("b", lambda: a.now() + 1.0)
    c = case.formula("c", lambda v: v + 1.0, b)
    for _ in range(3):
        with pytest.raises(ValueError, match="nothing to divide by"):
            case.ask(c)
    case.expect(a=1, b=1)
    s.set_content(2.0)
    assert case.ask(c) == 2.5
    case.expect(a=1, b=1, c=1)
    s.set_content(0.0)
    with pytest.raises(ValueError, match="nothing to divide by"):
        case.ask(c)


def test_an_equal_error_is_an_equal_answer(case: Case) -> None:
    """
    Another cause of the same error stops where it arises.

        s --> a --> b
    """
    s = case.source(0.0)
    a = case.formula("a", lambda v: reciprocal(max(v, 0.0)), s)
    b = case.rule("b", lambda: a.now())
    for value in (0.0, -1.0):
        s.set_content(value)
        with pytest.raises(ValueError, match="nothing"):
            case.ask(b)
    case.expect(a=2, b=1)


def test_a_rule_may_expect_an_error(case: Case) -> None:
    """
    Who catches an error depends on it like on any other answer.

        s --> a --> b (catches)
    """
    s = case.source(0.0)
    a = case.formula("a", reciprocal, s)

    def patient() -> float:
        try:
            return a.now()
        except ValueError:
            return math.inf

    b = case.rule("b", patient)
    for value, expected in ((0.0, math.inf), (4.0, 0.25), (0.0, math.inf)):
        s.set_content(value)
        assert case.ask(b) == expected


def test_an_error_holds_over_the_span_of_its_cause(case: Case) -> None:
    """
    Keys: only the middle span cannot be answered, and only it is evaluated again.

        s: 1 [-inf, 2)   0 [2, 4)   4 [4, inf)
    """
    s = case.steps({0.0: 1.0, 2.0: 0.0, 4.0: 4.0})
    a = case.formula("a", reciprocal, s)
    b = case.rule("b", lambda: a.now())
    assert [case.ask(b, t) for t in (1.0, 5.0)] == [1.0, 0.25]
    for t in (2.0, 3.0, 3.9):
        with pytest.raises(ValueError, match="nothing"):
            case.ask(b, t)
    case.expect(a=3, b=3)
    s.put(2.0, 2.0)
    assert [case.ask(b, t) for t in (1.0, 3.0, 5.0)] == [1.0, 0.5, 0.25]
    case.expect(a=1, b=1)


def test_the_first_error_of_a_formula_s_inputs_is_its_answer(case: Case) -> None:
    """
    Inputs are read in order, so the first that fails decides, whatever the others say.

        s --> a --> x
        r --> b --> x
    """
    s, r = case.source(0.0, "s"), case.source(0.0, "r")
    a, b = case.formula("a", reciprocal, s), case.formula("b", lambda v: 1.0 / v, r)
    x = case.formula("x", lambda u, v: u + v, a, b)
    with pytest.raises(ValueError, match="nothing"):
        case.ask(x)
    s.set_content(1.0)
    with pytest.raises(ZeroDivisionError):
        case.ask(x)
    r.set_content(1.0)
    assert case.ask(x) == 2.0


def test_what_a_rule_raises_itself_is_told_from_what_it_passes_on(case: Case) -> None:
    """An error raised out of another one keeps its cause."""
    a = case.formula("a", reciprocal, case.source(0.0))

    def wrapped() -> Any:
        try:
            return a.now()
        except ValueError as error:
            raise RuntimeError("no way") from error

    with pytest.raises(RuntimeError, match="no way") as caught:
        case.ask(case.rule("b", wrapped))
    assert isinstance(caught.value.__cause__, ValueError)


@pytest.mark.parametrize("length", [1, 2, 3, 100])
def test_a_static_cycle_is_an_error_that_names_the_path(case: Case, length: int) -> None:
    """
    Every cell of the ring says so, as often as it is asked; the way into it does too.

        x0 --> x1 --> ... --> x0      x0 --> way in
    """
    ring: list[Any] = []
    for i in range(length):
        ring.append(case.rule(f"x{i}", lambda i=i: ring[(i + 1) % length].now()))
    way_in = case.rule("way_in", lambda: ring[0].now())
    for cell in (*ring[:3], way_in, ring[0]):
        with pytest.raises(CycleError, match=r"x\d+ reads itself at t = 0: x\d+ -> ") as caught:
            case.ask(cell)
        assert length > 3 or all(other.name in str(caught.value) for other in ring)
        assert any("hint" in note for note in caught.value.__notes__)


def test_a_cycle_goes_when_a_link_goes(case: Case) -> None:
    """
    A dynamic cycle: y reads x only where the switch says so.

        switch, s --> y <--> x
    """
    switch, s = case.source(False, "switch"), case.source(1.0)
    y = case.rule("y", lambda: x.now() if switch.now() else s.now())
    x = case.rule("x", lambda: y.now() + 1.0)
    for _ in range(2):
        switch.set_content(False)
        assert case.ask(x) == 2.0
        switch.set_content(True)
        for cell in (x, y):
            with pytest.raises(CycleError, match="reads itself"):
                case.ask(cell)
    switch.set_content(False)
    s.set_content(5.0)
    assert (case.ask(x), case.ask(y)) == (6.0, 5.0)


def test_no_rule_can_catch_a_cycle(case: Case) -> None:
    """From every way in the same answer: catching it inside would make it depend on where one came from."""

    def hopeful() -> float:
        try:
            return y.now()
        except CycleError:
            return 0.0

    x = case.rule("x", hopeful)
    y = case.rule("y", lambda: x.now())
    for cell in (x, y, x):
        with pytest.raises(CycleError):
            case.ask(cell)


def test_formulas_may_be_in_a_cycle_with_rules(case: Case) -> None:
    """
    The engine's own stack meets the interpreter's.

        f --> x --> g --> f
    """
    cells: dict[str, Any] = {}
    cells["x"] = case.rule("x", lambda: cells["g"].now())
    cells["f"] = case.formula("f", lambda v: v, cells["x"])
    cells["g"] = case.formula("g", lambda v: v, cells["f"])
    for cell in cells.values():
        with pytest.raises(CycleError, match="f"):
            case.ask(cell)


def test_a_ring_through_time_is_no_cycle(case: Case) -> None:
    """
    Two cells read each other one second ago, down to 0 s.

        x <--1 s ago--> y
    """
    earlier = Affine(1.0, -1.0)

    def back(other: str, base: float) -> float:
        if moment() < 0.0:
            narrow(-INF, 0.0)
            return base
        narrow(0.0, INF)
        return cells[other].through(earlier) + 1.0

    cells: dict[str, Any] = {
        "x": case.rule("x", lambda: back("y", 0.0)),
        "y": case.rule("y", lambda: back("x", 100.0)),
    }
    assert [case.ask(cells["x"], t) for t in (-1.0, 0.5, 1.5, 2.5)] == [0.0, 101.0, 2.0, 103.0]


def test_a_cycle_at_a_fixed_time_is_a_cycle_for_everybody(case: Case) -> None:
    """
    What reads itself at 1 s cannot be answered anywhere.

        x <--at 1 s-- x
    """
    x = case.rule("x", lambda: x.at(1.0))
    for t in (1.0, 2.0):
        with pytest.raises(CycleError):
            case.ask(x, t)


def test_editing_while_evaluating_is_an_error_and_changes_nothing(case: Case) -> None:
    """A rule only reads."""
    s = case.source(1.0)

    def edits() -> float:
        s.set_content(2.0)
        return 0.0

    def opens() -> float:
        with case.engine.transaction():
            return 0.0

    for rule in (edits, opens):
        with pytest.raises(EvaluationError, match="inside of the evaluation"):
            case.ask(case.rule(rule.__name__, rule))
    assert s.content == 1.0


def test_what_belongs_inside_of_an_evaluation_says_so_outside(cached: Case) -> None:
    """What `now`, `through`, `note`, `moment` and `narrow` ask for has no point there."""
    s = cached.source(1.0)
    asks = [s.now, s.note, moment, lambda: narrow(0.0, 1.0), lambda: s.through(Affine(1.0, 1.0))]
    for ask in asks:
        with pytest.raises(EvaluationError, match="outside of an evaluation"):
            ask()


@pytest.mark.parametrize("t", [math.nan, "3", None, (1.0,)])
def test_what_is_no_time_is_refused_at_the_border(cached: Case, t: Any) -> None:
    """The message says what was given; nothing is remembered."""
    x = cached.rule("x", lambda: 1.0)
    with pytest.raises(TimeError, match="x asked at t = "):
        x.at(t)
    with pytest.raises(TimeError, match="x asked at t = "):
        cached.rule("y", lambda: x.at(t)).at(0.0)
    assert cached.ran() == {"y": 1}


def test_an_interrupt_is_not_an_answer(case: Case) -> None:
    """The user stops a long evaluation; asked again, it runs again, and nothing is left claimed."""
    s = case.source(1.0)
    stop = [True]

    def interrupted(value: float) -> float:
        if stop[0]:
            raise KeyboardInterrupt
        return value

    a = case.formula("a", interrupted, s)
    b = case.rule("b", lambda: a.now())
    c = case.formula("c", lambda v: v, b)
    for _ in range(2):
        with pytest.raises(KeyboardInterrupt):
            case.ask(c)
    stop[0] = False
    assert case.ask(c) == 1.0
    case.engine.check([c])
    s.set_content(2.0)
    assert case.ask(c) == 2.0


def test_an_error_keeps_no_frames_alive(cached: Case) -> None:
    """What a rule had in hand when it failed is freed, though the error is remembered."""

    class Large:
        pass

    held: list[weakref.ref[Large]] = []

    def fail() -> float:
        large = Large()
        held.append(weakref.ref(large))
        raise ValueError("too large")

    a = cached.rule("a", fail)
    b = cached.formula("b", lambda v: v, a)
    for cell in (b, a, b):
        with contextlib.suppress(ValueError):
            cell.at(0.0)
    gc.collect()
    assert held
    assert [ref() for ref in held] == [None] * len(held)
    assert cached.ran() == {"a": 1}
