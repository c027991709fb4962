"""The shapes by which reactive graphs are usually tried, each drawn, on both evaluators; then fed by step keys."""

import math
from collections.abc import Callable
from typing import Any

import pytest
from models import Case

from reactive4d.engine import Cell

Build = Callable[[Case, Cell], Cell]


def chain(case: Case, s: Cell) -> Cell:
    r"""
    A chain.

        s --> a --> b --> c
    """
    a = case.formula("a", lambda x: x + 1.0, s)
    b = case.formula("b", lambda x: x * 2.0, a)
    return case.rule("c", lambda: b.now() - 1.0)


def diamond(case: Case, s: Cell) -> Cell:
    r"""
    A diamond.

          s
         / \
        a   b
         \ /
          c
    """
    a = case.formula("a", lambda x: x + 1.0, s)
    b = case.formula("b", lambda x: x * 3.0, s)
    return case.formula("c", lambda x, y: x - y, a, b)


def opaque_diamond(case: Case, s: Cell) -> Cell:
    r"""
    A diamond of opaque rules.

          s
         / \
        a   b
         \ /
          c
    """
    a = case.rule("a", lambda: s.now() + 1.0)
    b = case.rule("b", lambda: s.now() * 3.0)
    return case.rule("c", lambda: a.now() - b.now())


def jagged_diamond(case: Case, s: Cell) -> Cell:
    r"""
    A diamond with one arm longer than the other.

          s
         / \
        a   b
        |   |
        c   |
         \ /
          d
    """
    a = case.formula("a", lambda x: x + 1.0, s)
    b = case.formula("b", lambda x: x * 3.0, s)
    c = case.rule("c", lambda: a.now() * 10.0)
    return case.formula("d", lambda x, y: (x, y), c, b)


def tail(case: Case, s: Cell) -> Cell:
    r"""
    A diamond with a tail.

          s
         / \
        a   b
         \ /
          c
          |
          d
    """
    c = diamond(case, s)
    return case.rule("d", lambda: -c.now())


def skip(case: Case, s: Cell) -> Cell:
    r"""
    Connections that skip a layer.

        s --> a --> b --> c
        s ----------^
              a ----------^
    """
    a = case.formula("a", lambda x: x + 1.0, s)
    b = case.formula("b", lambda x, y: x + y, s, a)
    return case.rule("c", lambda: a.now() + b.now())


def ladder(case: Case, s: Cell) -> Cell:
    r"""
    A ladder of crossing layers: each reads both cells of the one before, so there are 2 ** 7 paths.

            s
           / \
         l0   r0
          | X |
         l1   r1
          | X |
           ...
    """
    left = case.formula("l0", lambda x: x + 1.0, s)
    right = case.rule("r0", lambda: s.now() - 1.0)
    for i in range(1, 7):
        left, right = (
            case.formula(f"l{i}", lambda x, y: x + y, left, right),
            _sum_of(case, f"r{i}", left, right),
        )
    return case.formula("top", lambda x, y: x - y, left, right)


def _sum_of(case: Case, name: str, left: Cell, right: Cell) -> Cell:
    return case.rule(name, lambda: left.now() + 2.0 * right.now())


def fan(case: Case, s: Cell) -> Cell:
    r"""
    A fan, gathered again.

              s
          / /   \ \
        f0 f1 ... f9
          \ \   / /
             sum
    """
    leaves = [case.formula(f"f{i}", lambda x, i=i: x + i, s) for i in range(10)]
    return case.formula("sum", lambda *xs: math.fsum(xs), *leaves)


def triangle(case: Case, s: Cell) -> Cell:
    r"""
    A chain whose every cell is read by the last one.

        s --> a --> b --> c --> d
              |     |     |     |
              +-----+-----+-----+--> sum
    """
    cells: list[Cell] = [s]
    for name in "abcd":
        cells.append(case.formula(name, lambda x: x + 1.0, cells[-1]))
    return case.rule("sum", lambda: math.fsum(cell.now() for cell in cells[1:]))


def repeated(case: Case, s: Cell) -> Cell:
    r"""
    A source that is read many times over, by a formula and by a rule.

        s ==> a ==> c
        s ==> b --> c
    """
    a = case.formula("a", lambda *xs: math.fsum(xs), s, s, s)
    b = case.rule("b", lambda: math.fsum(s.now() for _ in range(30)))
    return case.formula("c", lambda x, y, z: (x, y, z), a, b, a)


def unstable(case: Case, s: Cell) -> Cell:
    r"""
    A cell whose order of reading depends on what it reads.

          s
         / \
        e   o
         \ /
          c
    """
    e = case.formula("e", lambda x: x * 2.0, s)
    o = case.formula("o", lambda x: -x, s)
    return case.rule("c", lambda: e.now() + o.now() if s.now() > 100.0 else e.now() + 1.0 + o.now())


SHAPES: list[Build] = [
    chain,
    diamond,
    opaque_diamond,
    jagged_diamond,
    tail,
    skip,
    ladder,
    fan,
    triangle,
    repeated,
    unstable,
]
each_shape = pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.__name__)


def once(case: Case) -> dict[str, int]:
    """Every rule of a case exactly once."""
    return {cell.name: 1 for cell in case.counters}


def expected(shape: Build, value: float) -> Any:
    """What a shape comes to over a constant, in a world without history."""
    case = Case(remembers=False)
    return case.ask(shape(case, case.source(value)))


@each_shape
def test_every_cell_runs_once(case: Case, shape: Build) -> None:
    """However many ways lead to a cell, the first ask runs it once, and the second not at all."""
    top = shape(case, case.source(1.0))
    assert case.ask(top) == expected(shape, 1.0)
    case.expect(**once(case))
    assert case.ask(top, 5.0) == expected(shape, 1.0)
    case.expect()


@each_shape
def test_an_edit_runs_nothing_and_the_next_ask_everything_once(case: Case, shape: Build) -> None:
    """Edits are lazy, and a hundred of them cost the next ask what one does."""
    s = case.source(1.0)
    top = shape(case, s)
    case.ask(top)
    case.ran()
    for i in range(100):
        s.set_content(2.0 + i)
    case.expect()
    assert case.ask(top) == expected(shape, 101.0)
    case.expect(**once(case))


@each_shape
def test_an_equal_edit_is_no_edit(cached: Case, shape: Build) -> None:
    """Content that cannot be told apart from what is there marks nothing and runs nothing."""
    s = cached.source(1.0)
    top = shape(cached, s)
    cached.ask(top)
    cached.ran()
    with cached.engine.log() as log:
        s.set_content(1.0)
        assert log == []
    cached.ask(top)
    cached.expect()


@each_shape
def test_undoing_an_edit_runs_nothing(cached: Case, shape: Build) -> None:
    """After 1, 2, 1 the answers for 1 hold again; and after 2 once more, those for 2."""
    s = cached.source(1.0)
    top = shape(cached, s)
    for value in (1.0, 2.0):
        s.set_content(value)
        cached.ask(top)
    cached.ran()
    for value in (1.0, 2.0, 1.0, 2.0):
        s.set_content(value)
        assert cached.ask(top) == expected(shape, value)
    cached.expect()


@each_shape
def test_keys_over_one_span_run_everything_once_there_and_nothing_elsewhere(case: Case, shape: Build) -> None:
    """
    The shape is fed by step keys; the middle one changes.

        s: 1.0 [-inf, 2)   2.0 [2, 4)   3.0 [4, inf)
    """
    s = case.steps({0.0: 1.0, 2.0: 2.0, 4.0: 3.0})
    top = shape(case, s)
    for t, value in ((1.0, 1.0), (3.0, 2.0), (5.0, 3.0)):
        assert case.ask(top, t) == expected(shape, value)
        case.expect(**once(case))
    s.put(2.0, 9.0)
    assert [case.ask(top, t) for t in (1.0, -7.0, 5.0, 4.0, 1e9)] == [expected(shape, v) for v in (1, 1, 3, 3, 3)]
    case.expect()
    assert [case.ask(top, t) for t in (3.0, 2.0, 3.999)] == [expected(shape, 9.0)] * 3
    case.expect(**once(case))


@each_shape
def test_an_edit_of_one_span_marks_every_cell_once_and_there_alone(cached: Case, shape: Build) -> None:
    """The log names each cell once, over the touched span."""
    s = cached.steps({0.0: 1.0, 2.0: 2.0, 4.0: 3.0})
    top = shape(cached, s)
    for t in (1.0, 3.0, 5.0):
        cached.ask(top, t)
    with cached.engine.log() as log:
        s.put(2.0, 9.0)
        assert sorted(str(event) for event in log if event.kind == "marked") == sorted(
            f"marked {cell.name} [2, 4)" for cell in cached.counters
        )


@each_shape
def test_moving_a_key_touches_the_time_between_its_places(case: Case, shape: Build) -> None:
    """A border between two spans moves from 2 s to 3 s: only what lies between is evaluated again."""
    s = case.steps({0.0: 1.0, 2.0: 2.0, 4.0: 3.0})
    top = shape(case, s)
    for t in (1.0, 3.5, 5.0):
        case.ask(top, t)
    case.ran()
    s.move(2.0, 3.0)
    assert [case.ask(top, t) for t in (1.0, 3.0, 3.5, 5.0)] == [expected(shape, v) for v in (1, 2, 2, 3)]
    case.expect()
    assert case.ask(top, 2.5) == expected(shape, 1.0)
    if case.remembers:
        assert set(case.ran().values()) <= {1}


@each_shape
def test_forwards_backwards_and_at_random_give_the_same(case: Case, shape: Build) -> None:
    """Random access: the order of asking does not show."""
    keys = {float(i): float(i * i % 7) for i in range(12)}
    answers: list[list[Any]] = []
    for order in (range(24), range(23, -1, -1), [i * 7 % 24 for i in range(24)]):
        fresh = Case(remembers=case.remembers)
        top = shape(fresh, fresh.steps(keys))
        found = {i: fresh.ask(top, i / 2.0) for i in order}
        answers.append([found[i] for i in range(24)])
    assert answers[0] == answers[1] == answers[2]
