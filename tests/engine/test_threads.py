"""Asks and edits from several threads: nothing waits but for what it needs, and no answer mixes two states.

Every step is forced by events; nothing here depends on how fast a thread is.
"""

import threading
from typing import Any

import pytest
from models import INF, Background, Case, Gate

from reactive4d.engine import Affine
from reactive4d.errors import CycleError


def slow(case: Case, gate: Gate, source: Any, name: str = "slow") -> Any:
    """A formula that waits at a gate."""

    def function(value: Any) -> Any:
        gate.pass_through()
        return value

    return case.formula(name, function, source)


def test_a_cached_ask_does_not_wait_for_a_long_evaluation(cached: Case) -> None:
    """
    While one thread evaluates, what is remembered is handed out, and what is not is computed.

        s --> slow          r --> quick --> view
    """
    s, r = cached.source(1.0), cached.source(2.0, "r")
    gate = Gate()
    long = slow(cached, gate, s)
    quick = cached.formula("quick", lambda v: v + 1.0, r)
    view = cached.rule("view", lambda: quick.now() * 2.0)
    assert cached.ask(view) == 6.0
    other = Background(lambda: cached.ask(long))
    gate.wait()
    assert (cached.ask(view), cached.ask(quick, 5.0), cached.ask(r)) == (6.0, 3.0, 2.0)
    r.set_content(3.0)
    assert cached.ask(view) == 8.0
    with cached.engine.transaction():
        r.set_content(4.0)
        assert cached.ask(view) == 10.0
    gate.open()
    assert other.result() == 1.0
    assert cached.ran() == {"slow": 1, "quick": 3, "view": 3}


@pytest.mark.parametrize("kind", ["formula", "rule"])
def test_a_cell_that_two_threads_want_is_evaluated_once(cached: Case, kind: str) -> None:
    """
    Five threads ask for the same; one runs the rule, four wait for it and for nothing else.

        s --> slow --> view
    """
    s = cached.source(1.0)
    gate = Gate()
    long = slow(cached, gate, s)
    if kind == "formula":
        view = cached.formula("view", lambda v: v + 1.0, long)
    else:
        view = cached.rule("view", lambda: long.now() + 1.0)
    first = Background(lambda: cached.ask(view))
    gate.wait()
    others = [Background(lambda: cached.ask(view)) for _ in range(4)]
    others[-1].wait_until(lambda: cached.engine.waiting == 4)
    gate.open()
    assert [thread.result() for thread in (first, *others)] == [2.0] * 5
    cached.expect(slow=1, view=1)


def test_another_point_of_the_same_cell_does_not_wait(cached: Case) -> None:
    """One thread is at 1 s of a cell, another asks for 3 s."""
    s = cached.steps({0.0: 1.0, 2.0: 2.0})
    gate = Gate()

    def function(value: float) -> float:
        if value == 1.0:
            gate.pass_through()
        return value

    x = cached.formula("x", function, s)
    other = Background(lambda: cached.ask(x, 1.0))
    gate.wait()
    assert cached.ask(x, 3.0) == 2.0
    gate.open()
    assert other.result() == 1.0
    cached.expect(x=2)
    assert [cached.ask(x, t) for t in (1.0, 3.0)] == [1.0, 2.0]
    cached.expect()


def test_an_edit_of_what_was_read_starts_the_evaluation_again(cached: Case) -> None:
    """
    The rule has read a and stands before b when a is edited: it never sees the old a together with the new b.

        a, b --> x
    """
    a, b = cached.source(1.0, "a"), cached.source(1.0, "b")
    gate = Gate()
    seen: list[tuple[float, float]] = []

    def rule() -> float:
        first = a.now()
        gate.pass_through()
        second = b.now()
        seen.append((first, second))
        return first + second

    x = cached.rule("x", rule)
    other = Background(lambda: cached.ask(x))
    gate.wait()
    with cached.engine.transaction():
        a.set_content(2.0)
        b.set_content(2.0)
    gate.open()
    assert other.result() == 4.0
    assert seen[-1] == (2.0, 2.0)
    assert (1.0, 2.0) not in seen
    assert cached.ran() == {"x": 2}
    cached.engine.check([x])


def test_an_edit_of_a_formula_s_input_starts_it_again(cached: Case) -> None:
    """The function runs on the old value when the edit comes; its answer is thrown away."""
    s = cached.source(1.0)
    gate = Gate()
    long = slow(cached, gate, s)
    view = cached.formula("view", lambda v: v, long)
    other = Background(lambda: cached.ask(view))
    gate.wait()
    s.set_content(2.0)
    gate.open()
    assert other.result() == 2.0
    assert cached.ran() == {"slow": 2, "view": 1}
    assert cached.ask(view) == 2.0
    cached.expect()


def test_an_edit_elsewhere_lets_an_evaluation_go_on(cached: Case) -> None:
    """
    An edit of another source, or of another span of the same, or one that comes to nothing: one evaluation.

        s, r --> x      a formula between, that is cut off
    """
    s, r = cached.steps({0.0: 1.0, 5.0: 2.0}), cached.source(1.0, "r")
    unrelated = cached.source(0.0, "unrelated")
    gate = Gate()

    def rule() -> float:
        value = s.now()
        gate.pass_through()
        return value + r.now()

    x = cached.rule("x", rule)
    other = Background(lambda: cached.ask(x, 1.0))
    gate.wait()
    unrelated.set_content(1.0)
    s.put(5.0, 3.0)
    r.set_content(2.0)
    gate.open()
    assert other.result() == 3.0
    assert cached.ran() == {"x": 1}
    assert (x.valid(1.0).start, x.valid(1.0).stop) == (-INF, 5.0)
    cached.engine.check([x])


def test_a_cancelled_evaluation_cannot_be_caught_by_a_rule(cached: Case) -> None:
    """`except Exception` does not stop what starts an evaluation again."""
    a, b = cached.source(1.0, "a"), cached.source(1.0, "b")
    gate = Gate()
    caught: list[Exception] = []

    def rule() -> Any:
        try:
            first = a.now()
            gate.pass_through()
            return first, b.at(0.0)
        except Exception as error:  # noqa: BLE001  that is what is tried
            caught.append(error)
            return None

    x = cached.rule("x", rule)
    other = Background(lambda: cached.ask(x))
    gate.wait()
    a.set_content(2.0)
    gate.open()
    assert other.result() == (2.0, 1.0)
    assert not caught


def test_after_a_few_restarts_edits_wait(cached: Case) -> None:
    """
    A thread that edits without a pause does not starve one that evaluates.

        s --> x      every evaluation of x is met by an edit of s
    """
    s = cached.source(0.0)
    runs: list[float] = []
    edits: list[Background] = []

    def rule() -> float:
        value = s.now()
        runs.append(value)
        edit = Background(lambda: s.set_content(value + 1.0))
        edits.append(edit)
        for _ in range(60_000):
            if edit.done or cached.engine.waiting:
                break
            edit.thread.join(0.001)
        return s.now()

    x = cached.rule("x", rule)
    assert cached.ask(x) == runs[-1]
    assert 2 <= len(runs) <= 6
    for edit in edits:
        edit.result()
    assert cached.engine.patience == 0
    assert s.content == runs[-1] + 1.0


def test_a_ring_of_threads_round_a_cycle_ends_in_an_error(cached: Case) -> None:
    """
    Each thread is in one cell of a cycle and wants the next: nobody waits for ever.

        x0 --> x1 --> x2 --> x0
    """
    gates = [Gate() for _ in range(3)]
    cells: list[Any] = []

    def rule(i: int) -> float:
        gates[i].pass_through()
        return cells[(i + 1) % 3].now()

    cells.extend(cached.rule(f"x{i}", lambda i=i: rule(i)) for i in range(3))
    threads = [Background(lambda cell=cell: cached.ask(cell)) for cell in cells]
    for gate in gates:
        gate.wait()
    for gate in gates:
        gate.open()
    for thread in threads:
        with pytest.raises(CycleError):
            thread.result()
    cached.engine.check(cells)
    assert cached.engine.waiting == 0


def test_threads_that_meet_in_a_diamond_do_not_wait_for_ever(cached: Case) -> None:
    """
    Two threads come from both ends: each is in what the other will need later.

        s --> a --> left, right --> b
    """
    s = cached.source(1.0)
    gate_a, gate_b = Gate(), Gate()
    a = slow(cached, gate_a, s, "a")
    b = slow(cached, gate_b, s, "b")
    left = cached.rule("left", lambda: a.now() + b.now())
    right = cached.rule("right", lambda: b.now() - a.now())
    threads = [Background(lambda: cached.ask(left)), Background(lambda: cached.ask(right))]
    gate_a.wait()
    gate_b.wait()
    gate_a.open()
    gate_b.open()
    assert [thread.result() for thread in threads] == [2.0, 0.0]
    cached.expect(a=1, b=1, left=1, right=1)


def test_an_interrupted_thread_leaves_the_work_to_who_waits(cached: Case) -> None:
    """The thread that had claimed the cell is interrupted; the one that waits for it computes it."""
    s = cached.source(1.0)
    gate = Gate()
    interrupts = [True]

    def function(value: float) -> float:
        gate.pass_through()
        if interrupts and interrupts.pop():
            raise KeyboardInterrupt
        return value

    x = cached.formula("x", function, s)
    first = Background(lambda: cached.ask(x))
    gate.wait()
    second = Background(lambda: cached.ask(x))
    second.wait_until(lambda: cached.engine.waiting == 1)
    gate.open()
    with pytest.raises(KeyboardInterrupt):
        first.result()
    assert second.result() == 1.0
    assert cached.ran() == {"x": 2}
    cached.engine.check([x])


def test_an_error_comes_to_everybody_who_waited(cached: Case) -> None:
    """Each thread gets an exception of its own, with the same message and path."""
    gate = Gate()

    def function(value: float) -> float:
        gate.pass_through()
        raise ValueError("no")

    x = cached.formula("x", function, cached.source(1.0))
    threads = [Background(lambda: cached.ask(x)) for _ in range(3)]
    gate.wait()
    threads[0].wait_until(lambda: cached.engine.waiting == 2)
    gate.open()
    errors: list[Exception] = []
    for thread in threads:
        with pytest.raises(ValueError, match="no") as caught:
            thread.result()
        errors.append(caught.value)
    assert len({id(error) for error in errors}) == 3
    assert {tuple(error.__notes__) for error in errors} == {("while evaluating x at t = 0",)}
    cached.expect(x=1)


def test_outside_of_a_transaction_hits_answer_the_old_state_and_misses_wait(cached: Case) -> None:
    """
    What the owner has not touched is handed out; what it has touched is answered when it is done.

        a --> x          b --> y
    """
    a, b = cached.source(1.0, "a"), cached.source(1.0, "b")
    x, y = cached.formula("x", lambda v: v, a), cached.formula("y", lambda v: v, b)
    assert (cached.ask(x), cached.ask(y)) == (1.0, 1.0)
    with cached.engine.transaction():
        a.set_content(2.0)
        assert Background(lambda: cached.ask(y)).result() == 1.0
        assert Background(lambda: cached.ask(b)).result() == 1.0
        assert cached.ask(x) == 2.0
        waiting = [Background(lambda: cached.ask(x)), Background(lambda: cached.ask(a))]
        waiting[0].wait_until(lambda: cached.engine.waiting == 2)
        a.set_content(3.0)
        assert (cached.ask(x), cached.ask(a)) == (3.0, 3.0)
        assert not any(thread.done for thread in waiting)
    assert [thread.result() for thread in waiting] == [3.0, 3.0]


def test_nothing_of_a_failed_transaction_is_seen_by_others(cached: Case) -> None:
    """Who waited gets the answer of before."""
    a = cached.source(1.0, "a")
    x = cached.rule("x", lambda: a.now())
    cached.ask(x)
    waiting: list[Background] = []
    with pytest.raises(ZeroDivisionError), cached.engine.transaction():  # noqa: PT012
        a.set_content(2.0)
        cached.ask(x)
        waiting.append(Background(lambda: cached.ask(x)))
        waiting[0].wait_until(lambda: cached.engine.waiting)
        raise ZeroDivisionError
    assert waiting[0].result() == 1.0
    assert cached.ask(x) == 1.0


def test_other_edits_wait_for_the_end_of_a_transaction(cached: Case) -> None:
    """Neither an edit nor another transaction comes in between."""
    a = cached.source(0, "a")

    def add() -> None:
        with cached.engine.transaction():
            a.set_content(a.content + 1)

    with cached.engine.transaction():
        a.set_content(10)
        threads = [Background(add), Background(lambda: a.set_content(5)), Background(add)]
        threads[0].wait_until(lambda: cached.engine.waiting == 3)
        assert (a.content, cached.ask(a)) == (10, 10)
        a.set_content(20)
    for thread in threads:
        thread.result()
    assert a.content in (5, 6, 7)


def test_the_owner_of_a_transaction_never_waits(cached: Case) -> None:
    """
    Another thread is in the very cell that the owner wants: the owner computes it itself.

        s --> slow
    """
    s = cached.source(1.0)
    gate = Gate()
    mine = threading.get_ident()

    def function(value: float) -> float:
        if threading.get_ident() != mine:
            gate.pass_through()
        return value

    x = cached.formula("x", function, s)
    other = Background(lambda: cached.ask(x))
    gate.wait()
    with cached.engine.transaction():
        assert cached.ask(x) == 1.0
        s.set_content(2.0)
        assert cached.ask(x) == 2.0
    gate.open()
    assert other.result() == 2.0
    cached.engine.check([x])


def test_an_evaluation_under_way_waits_for_an_open_transaction(cached: Case) -> None:
    """
    A rule that has read a goes on to b, which is set in a transaction meanwhile: it gets both from after it.

        a, b --> x
    """
    a, b = cached.source(1.0, "a"), cached.source(1.0, "b")
    gate = Gate()

    def rule() -> Any:
        first = a.now()
        gate.pass_through()
        return first, b.now(), b.through(Affine(1.0, 1.0)), b.note()

    x = cached.rule("x", rule)
    other = Background(lambda: cached.ask(x))
    gate.wait()
    with cached.engine.transaction():
        b.set_content(2.0)
        gate.open()
        other.wait_until(lambda: cached.engine.waiting)
        b.set_content(3.0)
    assert other.result() == (1.0, 3.0, 3.0, 3.0)
    assert cached.ask(x) == (1.0, 3.0, 3.0, 3.0)


def test_transactions_of_several_threads_do_not_mix(cached: Case) -> None:
    """Two sources that add up to zero after every transaction do so in every answer."""
    a, b = cached.source(0, "a"), cached.source(0, "b")
    total = cached.formula("total", lambda u, v: u + v, a, cached.rule("b2", b.now))
    stop = threading.Event()
    start = threading.Barrier(4)

    def edit(sign: int) -> None:
        start.wait(60)
        for i in range(100):
            with cached.engine.transaction():
                a.set_content(sign * i)
                b.set_content(-sign * i)

    def look() -> set[Any]:
        start.wait(60)
        seen: set[Any] = set()
        while not stop.is_set():
            seen.add(cached.ask(total))
        return seen

    editors = [Background(lambda: edit(1)), Background(lambda: edit(-1))]
    viewer = Background(look)
    start.wait(60)
    for editor in editors:
        editor.result()
    stop.set()
    assert viewer.result() <= {0}
    cached.engine.check([total])


def test_many_threads_on_one_model_evaluate_nothing_twice(cached: Case) -> None:
    """Eight threads ask for the same hundred answers in different orders."""
    s = cached.steps({float(i): float(i) for i in range(100)})
    x = cached.formula("x", lambda v: v + 1.0, s)
    y = cached.rule("y", lambda: x.now() * 2.0)
    start = threading.Barrier(8)

    def look(stride: int) -> bool:
        start.wait(60)
        return all(cached.ask(y, i * stride % 100 + 0.5) == 2.0 * (i * stride % 100) + 2.0 for i in range(100))

    threads = [Background(lambda stride=stride: look(stride)) for stride in (1, 3, 7, 9, 11, 13, 17, 99)]
    assert all(thread.result() for thread in threads)
    cached.expect(x=100, y=100)


def test_cells_may_be_made_and_dropped_on_any_thread(cached: Case) -> None:
    """Readers come and go on four threads while a fifth edits what they read."""
    s = cached.source(0.0)
    start = threading.Barrier(5)

    def come_and_go() -> bool:
        start.wait(60)
        for _ in range(200):
            engine_case = Case.__new__(Case)
            engine_case.remembers, engine_case.engine, engine_case.counters = True, cached.engine, {}
            x = engine_case.formula("x", lambda v: v, s)
            y = engine_case.rule("y", lambda x=x: x.now())
            first, second = y.at(0.0), y.at(0.0)
            assert second >= first
        return True

    def edit() -> bool:
        start.wait(60)
        for i in range(200):
            s.set_content(float(i + 1))
        return True

    threads = [*(Background(come_and_go) for _ in range(4)), Background(edit)]
    assert all(thread.result() for thread in threads)


@pytest.mark.parametrize("kind", ["formula", "rule", "mapped"])
def test_an_edit_nearby_shrinks_the_answer_under_evaluation(cached: Case, kind: str) -> None:
    """
    While x is evaluated at 1 s, a key is put at 2 s: the answer stands, but only up to there.

        s --> x --> view
    """
    s = cached.steps({0.0: 1.0})
    gate = Gate()
    x: Any
    if kind == "rule":

        def rule() -> float:
            value = s.now()
            gate.pass_through()
            return value

        x = cached.rule("x", rule)
    else:

        def function(value: float) -> float:
            gate.pass_through()
            return value

        x = cached.formula("x", function, s, maps=(Affine(1.0, 0.0) if kind == "mapped" else None,))
    view = cached.formula("view", lambda v: v, x)
    other = Background(lambda: cached.ask(view, 1.0))
    gate.wait()
    s.put(2.0, 5.0)
    gate.open()
    assert other.result() == 1.0
    cached.engine.check([view])
    assert cached.ask(view, 3.0) == 5.0
    assert cached.ask(view, 1.0) == 1.0
