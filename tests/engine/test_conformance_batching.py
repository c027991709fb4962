"""Many edits as one, transactions that fail, and evaluation inside of evaluation; on both evaluators."""

import pytest
from models import Case, marked

from reactive4d.errors import EvaluationError


class HalfwayError(Exception):
    """What makes a transaction fail."""


def test_edits_of_one_transaction_are_seen_at_once(case: Case) -> None:
    """
    A sum of two that always comes to ten: no ask sees another one.

        a, b --> sum
    """
    a, b = case.source(4.0, "a"), case.source(6.0, "b")
    total = case.formula("sum", lambda x, y: x + y, a, b)
    assert case.ask(total) == 10.0
    with case.engine.transaction():
        a.set_content(1.0)
        b.set_content(9.0)
    case.ran()
    assert case.ask(total) == 10.0
    case.expect(sum=1)


def test_inside_of_a_transaction_its_owner_sees_what_it_set(case: Case) -> None:
    """Edits mark at once for whoever made them."""
    a = case.source(1.0, "a")
    x = case.rule("x", lambda: a.now() * 2.0)
    with case.engine.transaction():
        assert case.ask(x) == 2.0
        a.set_content(5.0)
        assert case.ask(x) == 10.0
        a.set_content(6.0)
        assert case.ask(x) == 12.0
    assert case.ask(x) == 12.0
    case.expect(x=3)


def test_a_failed_transaction_changed_nothing(case: Case) -> None:
    """The sources are as before; what was remembered before holds again, and nothing that was computed inside does."""
    a, s = case.source(1.0, "a"), case.steps({0.0: 1.0, 2.0: 2.0}, "s")
    x = case.rule("x", lambda: (a.now(), s.now()))
    before = [case.ask(x, t) for t in (1.0, 3.0)]
    with pytest.raises(HalfwayError), case.engine.transaction():  # noqa: PT012
        a.set_content(5.0)
        s.put(2.0, 7.0)
        s.put(4.0, 8.0)
        assert [case.ask(x, t) for t in (1.0, 3.0, 5.0)] == [(5.0, 1.0), (5.0, 7.0), (5.0, 8.0)]
        raise HalfwayError
    assert (a.content, s.content) == (1.0, ((0.0, 1.0), (2.0, 2.0)))
    case.ran()
    assert [case.ask(x, t) for t in (1.0, 3.0, 5.0)] == [*before, (1.0, 2.0)]
    if case.remembers:
        assert case.ran() in ({}, {"x": 1})


def test_an_inner_transaction_is_part_of_the_outer_one(case: Case) -> None:
    """What fails inside is undone alone where the outer one goes on, and with it where that fails too."""
    a, b = case.source(1.0, "a"), case.source(1.0, "b")
    x = case.formula("x", lambda u, v: (u, v), a, b)
    with case.engine.transaction():
        a.set_content(2.0)
        with pytest.raises(HalfwayError), case.engine.transaction():  # noqa: PT012
            a.set_content(3.0)
            b.set_content(3.0)
            assert case.ask(x) == (3.0, 3.0)
            raise HalfwayError
        assert case.ask(x) == (2.0, 1.0)
    assert case.ask(x) == (2.0, 1.0)
    with pytest.raises(HalfwayError), case.engine.transaction():  # noqa: PT012
        with case.engine.transaction():
            a.set_content(4.0)
        assert case.ask(x) == (4.0, 1.0)
        raise HalfwayError
    assert case.ask(x) == (2.0, 1.0)


def test_an_interrupt_undoes_a_transaction_as_well(case: Case) -> None:
    """Whatever leaves the block by an exception."""
    a = case.source(1.0, "a")
    with pytest.raises(KeyboardInterrupt), case.engine.transaction():  # noqa: PT012
        a.set_content(2.0)
        raise KeyboardInterrupt
    assert case.ask(a) == 1.0
    a.set_content(3.0)
    assert case.ask(a) == 3.0


def test_a_transaction_that_comes_back_to_where_it_was_runs_nothing(case: Case) -> None:
    """Set to something else and back before anybody asks: the old stamp is back, and with it every answer."""
    a = case.source(1.0, "a")
    x = case.rule("x", lambda: a.now() * 2.0)
    y = case.formula("y", lambda v: v + 1.0, x)
    case.ask(y)
    case.ran()
    with case.engine.transaction():
        a.set_content(2.0)
        a.set_content(1.0)
    assert case.ask(y) == 3.0
    case.expect()


def test_a_transaction_in_time_marks_only_its_spans(cached: Case) -> None:
    """
    Two keys of one source and one of another, at once.

        s, r --> x
    """
    s = cached.steps({0.0: 1.0, 1.0: 2.0, 2.0: 3.0, 3.0: 4.0}, "s")
    r = cached.steps({0.0: 1.0, 5.0: 2.0}, "r")
    x = cached.formula("x", lambda u, v: u + v, s, r)
    times = (0.5, 1.5, 2.5, 4.0, 6.0)
    for t in times:
        cached.ask(x, t)
    cached.ran()
    with cached.engine.log() as log:
        with cached.engine.transaction():
            s.put(1.0, 20.0)
            r.put(5.0, 20.0)
        assert marked(log) == ["x [1, 2)", "x [5, inf)"]
    assert [cached.ask(x, t) for t in times] == [2.0, 21.0, 4.0, 5.0, 24.0]
    cached.expect(x=2)


def test_edits_fail_before_they_change_anything(case: Case) -> None:
    """A content that cannot even be compared is refused, and the old one stands."""
    s = case.steps({0.0: 1.0})
    x = case.formula("x", lambda v: v, s)
    case.ask(x)
    with pytest.raises(TypeError):
        s.set_content(3)  # no keys
    assert (s.content, case.ask(x)) == (((0.0, 1.0),), 1.0)
    s.put(0.0, 2.0)
    assert case.ask(x) == 2.0


def test_asking_from_a_rule_is_reading(case: Case) -> None:
    """
    `at` inside of an evaluation is a read, however deep the function is that calls it.

        s --> a --> b
    """
    s = case.source(1.0)
    a = case.rule("a", lambda: s.at(0.0) + 1.0)

    def somewhere() -> float:
        return a.at(3.0) + a.at(4.0)

    b = case.rule("b", somewhere)
    assert case.ask(b) == 4.0
    s.set_content(2.0)
    assert case.ask(b) == 6.0


def test_two_engines_do_not_mix() -> None:
    """A cell of one engine that reads one of another could never be told of its edits: an error."""
    one, other = Case(), Case()
    s = one.source(1.0)
    with pytest.raises(EvaluationError, match="another engine"):
        other.formula("x", lambda v: v, s)
    with pytest.raises(EvaluationError, match="another engine"):
        other.ask(other.rule("y", lambda: s.now() + s.at(1.0)))
