"""Depth and width: chains longer than the interpreter's stack, wide fans; the user's limits are left alone."""

import contextlib
import sys
import threading
from collections.abc import Iterator
from typing import Any

import pytest
from models import INF, Background, Case

from reactive4d.engine import Affine, Computed, Event, Formula
from reactive4d.errors import CycleError, DepthError

FORMULAS = 100_000
RULES = 10_000


@pytest.fixture(autouse=True)
def _limits_left_alone(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Whoever touches the interpreter's limits fails."""

    def refuse(limit: int) -> None:
        raise AssertionError(f"the limit was set to {limit}")

    before, stack = sys.getrecursionlimit(), threading.stack_size()
    monkeypatch.setattr(sys, "setrecursionlimit", refuse)
    yield
    monkeypatch.undo()
    assert (sys.getrecursionlimit(), threading.stack_size()) == (before, stack)


def formulas(case: Case, below: Any, count: int) -> Any:
    """A chain of formulas, each one more than the one before."""
    for i in range(count):
        below = Formula(_one_more, below, name=f"f{i}")
    return below


def _one_more(value: float) -> float:
    return value + 1.0


def rules(case: Case, below: Any, count: int) -> Any:
    """A chain of opaque rules, each one more than the one before."""
    for i in range(count):
        below = Computed(lambda below=below: below.now() + 1.0, name=f"x{i}", engine=case.engine)
    return below


def test_a_hundred_thousand_formulas_evaluate_go_stale_and_update(cached: Case) -> None:
    """
    Algebra declares its inputs, so the engine walks it with a stack of its own.

        s --> f0 --> ... --> f99999
    """
    s = cached.source(0.0)
    top = formulas(cached, s, FORMULAS)
    assert cached.ask(top) == FORMULAS
    s.set_content(1.0)
    assert cached.ask(top) == FORMULAS + 1.0
    s.set_content(0.0)
    assert cached.ask(top, 7.0) == FORMULAS
    assert cached.engine.stats([top])["evaluations"] == 2


def test_a_deep_chain_is_stale_over_one_span_only(cached: Case) -> None:
    """
    The same over step keys: nothing but the touched span runs again.

        s --> f0 --> ... --> f9999
    """
    s = cached.steps({0.0: 0.0, 1.0: 1.0})
    top = formulas(cached, s, 10_000)
    assert [cached.ask(top, t) for t in (0.5, 1.5)] == [10_000.0, 10_001.0]
    s.put(1.0, 2.0)
    assert [cached.ask(top, t) for t in (0.5, 1.5)] == [10_000.0, 10_002.0]
    assert cached.engine.stats([top])["evaluations"] == 3


def test_a_deep_chain_carries_an_error(cached: Case) -> None:
    """The path in the notes is cut in its middle; the error goes when its cause goes."""
    s = cached.source(0.0)
    bottom = Formula(lambda v: 1.0 / v, s, name="bottom")
    top = formulas(cached, bottom, 10_000)
    with pytest.raises(ZeroDivisionError) as caught:
        cached.ask(top)
    assert caught.value.__notes__[0] == "while evaluating bottom at t = 0"
    assert len(caught.value.__notes__) < 50
    s.set_content(1.0)
    assert cached.ask(top) == 10_001.0


def test_ten_thousand_opaque_rules_evaluate_go_stale_and_update(cached: Case) -> None:
    """
    A rule that reads what was never asked for nests; where that is too deep it is unwound, and begun again from below.

        s --> x0 --> ... --> x9999
    """
    s = cached.source(0.0)
    top = rules(cached, s, RULES)
    assert cached.ask(top) == RULES
    s.set_content(1.0)
    assert cached.ask(top) == RULES + 1.0
    s.set_content(0.0)
    assert cached.ask(top) == RULES


def test_a_deep_chain_of_both_kinds(cached: Case) -> None:
    """
    A hundred formulas, a hundred rules, and so on; asked on another thread, with a small stack, as well.

        s --> f... --> x... --> f... --> x...
    """
    s = cached.source(0.0)
    top: Any = s
    for _ in range(20):
        top = rules(cached, formulas(cached, top, 100), 100)
    assert cached.ask(top) == 4_000.0
    s.set_content(1.0)
    assert Background(lambda: cached.ask(top)).result() == 4_001.0


def test_a_deep_chain_asked_from_deep_within_the_user_s_own_stack(cached: Case) -> None:
    """Little is left of the interpreter's stack when the ask comes: it works or says what to do, and works later."""
    s = cached.source(0.0)
    top = rules(cached, s, 1_000)

    def dig(depth: int) -> Any:
        return dig(depth - 1) if depth else cached.ask(top)

    with contextlib.suppress(DepthError):
        assert dig(sys.getrecursionlimit() - 150) == 1_000.0
    assert cached.ask(top) == 1_000.0
    cached.engine.check([top])


def test_rules_that_nest_through_time_are_as_deep_as_they_like(cached: Case) -> None:
    """
    A cell that reads its own past, two thousand steps long.

        x <-- x one step ago
    """
    from reactive4d.engine import moment, narrow

    s = cached.source(1.0)

    def past() -> float:
        if moment() < 0.0:
            narrow(-INF, 0.0)
            return 0.0
        narrow(0.0, INF)
        return s.now() + x.through(Affine(1.0, -1.0))

    x = cached.rule("x", past)
    assert cached.ask(x, 1_999.5) == 2_000.0
    s.set_content(2.0)
    assert cached.ask(x, 1_999.5) == 4_000.0
    assert cached.ask(x, 10.5) == 22.0
    cached.expect(x=cached.counters[x].count)


def test_a_cycle_of_ten_thousand_is_found(cached: Case) -> None:
    """
    Opaque all the way round; the message is cut in its middle.

        x0 --> x9999 --> ... --> x0
    """
    ring: list[Any] = []
    first = Computed(lambda: ring[-1].now(), name="x", engine=cached.engine)
    ring.append(first)
    ring.append(rules(cached, first, RULES))
    with pytest.raises(CycleError, match="reads itself") as caught:
        cached.ask(first)
    assert len(str(caught.value)) < 1_000
    cached.engine.check([first])


def test_a_cycle_of_formulas_closed_by_a_rule_is_found(cached: Case) -> None:
    """
    Ten thousand formulas and one rule.

        x --> f9999 --> ... --> f0 --> x
    """
    ring: list[Any] = []
    first = Computed(lambda: ring[-1].now(), name="x", engine=cached.engine)
    ring.append(formulas(cached, first, 10_000))
    for cell in (first, ring[0], first):
        with pytest.raises(CycleError, match="reads itself"):
            cached.ask(cell)
    cached.engine.check([first])


@pytest.mark.parametrize("kind", ["formula", "rule"])
def test_a_wide_fan_costs_its_width(cached: Case, log: list[Event], kind: str) -> None:
    """
    Five thousand cells between one source and one sum: an edit marks each once, the next ask runs each once.

        s --> f0, f1, ... f4999 --> sum
    """
    s = cached.source(1.0)
    leaves = [Formula(_one_more, s, name=f"f{i}") for i in range(5_000)]
    if kind == "formula":
        total = cached.formula("sum", lambda *values: sum(values), *leaves)
    else:
        total = cached.rule("sum", lambda: sum(leaf.now() for leaf in leaves))
    assert cached.ask(total) == 10_000.0
    log.clear()
    s.set_content(2.0)
    assert len([event for event in log if event.kind == "marked"]) == 5_001
    assert cached.ask(total) == 15_000.0
    assert cached.engine.stats(leaves)["evaluations"] == 10_000
    cached.expect(sum=2)


def test_one_of_many_inputs_costs_one(cached: Case, log: list[Event]) -> None:
    """
    A wide sum over sources of its own: one edit runs one leaf and the sum.

        s0 --> f0 --> sum, ... s999 --> f999 --> sum
    """
    sources = [cached.source(float(i), f"s{i}") for i in range(1_000)]
    leaves = [cached.formula(f"f{i}", _one_more, source) for i, source in enumerate(sources)]
    total = cached.formula("sum", lambda *values: sum(values), *leaves)
    cached.ask(total)
    cached.ran()
    sources[500].set_content(0.0)
    assert cached.ask(total) == sum(range(1_000)) + 1_000 - 500
    cached.expect(f500=1, sum=1)
