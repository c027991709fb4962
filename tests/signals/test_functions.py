"""Python functions as signals: with the time or without, what they read and how long their answers hold."""

import functools
import math
import sys
from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d.engine import engine
from reactive4d.errors import CycleError, EvaluationError

t = r4.time


def test_without_an_argument_it_holds_where_what_it_read_does() -> None:
    """`now()` is the asker's own point: an identity link."""
    k = r4.keys({0: 1.0, 2: 2.0, 6: 3.0}, interpolation="step")

    @r4.signal
    def double() -> float:
        return 2 * k.now()

    assert double.name == "double"
    assert (double.at(3), double.valid(3).start, double.valid(3).stop) == (4, 2, 6)
    with r4.log() as events:
        k.points[6] = 9.0
    assert not [event for event in events if event.name == "double"]
    assert (double.at(3), double.at(7)) == (4, 18)


def test_with_an_argument_it_holds_for_the_instant() -> None:
    """`at(t)` with that very `t` is an identity link: an edit elsewhere is none of its business."""
    k = r4.keys({0: 1.0, 2: 2.0, 6: 3.0}, interpolation="step")

    @r4.signal
    def swing(at: float) -> float:
        return at + k.at(at)

    assert (swing.at(3), swing.valid(3).is_instant) == (5, True)
    before = engine.stats([swing])["evaluations"]
    k.points[6] = 9.0
    assert swing.at(3) == 5
    assert engine.stats([swing])["evaluations"] == before
    assert swing.at(7) == 16


def test_a_time_of_its_own_is_a_fixed_one() -> None:
    """It holds as long as what it read there is not edited."""
    k = r4.keys({0: 1.0, 2: 2.0})
    start = r4.signal(lambda: k.at(1.0))
    assert (start.at(100), start.valid(100).start) == (1.5, -math.inf)
    k.points[2] = 4.0
    assert start.at(100) == 2.5


def test_its_own_past_is_legal_and_its_present_is_not() -> None:
    """However long ago it began."""

    @r4.signal
    def count(at: float) -> int:
        return 0 if at < 0 else count.at(at - 1) + 1

    @r4.signal
    def ring() -> float:
        return ring.now() + 1

    assert count.at(3000.0) == 3001
    for times in (0.0, [0.0, 1.0]):
        with pytest.raises(CycleError, match="ring reads itself"):
            ring.at(times)


def test_parameters_are_the_askers() -> None:
    """Those not named in `.at` are handed through."""
    a, b = r4.Parameter("fa", 1.0), r4.Parameter("fb", 10.0)
    both = r4.signal(lambda: a.now() + b.at(0.0, fb=5.0))
    assert (both.at(0), both.at(0, fa=2.0), both.at(0, fb=7.0)) == (6, 7, 6)


def test_reads_must_be_inside_of_an_evaluation() -> None:
    """Outside, nobody asks."""
    with pytest.raises(EvaluationError, match="outside of an evaluation") as caught:
        t.now()
    assert "at(t)" in caught.value.__notes__[0]


def test_a_rule_edits_nothing() -> None:
    """Neither a variable nor by a transaction, neither in a function of values nor for many times."""
    x = r4.Variable(1.0, name="x")

    def meddle(*_: Any) -> None:
        x.value = 3.0

    def transact() -> None:
        with r4.transaction():
            pass

    for signal in (r4.signal(meddle), r4.lift(meddle)(t), r4.signal(transact)):
        with pytest.raises(EvaluationError, match="inside of the evaluation"):
            signal.at(0.0)
    with pytest.raises(EvaluationError, match="x is set inside"):
        r4.lift(meddle)(t).at([1.0, 2.0])
    assert x.at(0) == 1.0


def test_what_can_be_a_rule() -> None:
    """Functions, lambdas, partial functions, methods of objects, builtins; defaults are no arguments."""

    class Clock:
        speed = 2.0

        def angle(self, at: float) -> float:
            return self.speed * at

    assert r4.signal(functools.partial(pow, 2)).at(3.0) == 8
    assert r4.signal(Clock().angle).at(3.0) == 6
    assert r4.signal(math.sin).at(0.0) == 0
    assert r4.signal(lambda x=5: x).at(0) == 5
    assert r4.signal(lambda *rest: len(rest)).at(0) == 0


async def _later() -> float:
    return 1.0


def _bit_by_bit() -> Any:
    yield 1.0


def _method(self: Any) -> float:
    return self


@pytest.mark.parametrize(
    ("function", "what"),
    [
        (3, "expected a function"), (t, "expected a function"), (lambda a, b: 0, "takes a, b"),
        (lambda *, k: k, "takes k"), (functools.partial(lambda a, b, c: 0, 1), "takes b, c"), (int, "int"),
        (_later, "asynchronous"), (_bit_by_bit, "generator"), (_method, "is a method"),
    ],
)  # fmt: skip
def test_what_cannot_is_refused_at_once(function: Any, what: str) -> None:
    """And not when somebody asks."""
    with pytest.raises(TypeError, match=what):
        r4.signal(function)


@pytest.mark.parametrize(
    "rule", [lambda: t + 1, lambda: (x for x in [1]), lambda: t], ids=["signal", "generator", "time"]
)
def test_an_answer_that_is_no_value_is_an_error(rule: Any) -> None:
    """A signal that was not read is a mistake, in both evaluators."""
    made = r4.signal(rule)
    with pytest.raises(TypeError, match="the answer is a"):
        made.at(0.0)
    with pytest.raises(TypeError, match="the answer is a"):
        engine.naive(made, 0.0)


class _PickyError(Exception):
    def __init__(self, first: int, second: int) -> None:
        super().__init__()
        self.first = first


class _MuteError(Exception):
    def __str__(self) -> str:
        raise ValueError("nothing to say")


class _NewError(Exception):
    def __new__(cls, *arguments: Any) -> Any:
        if not arguments:
            raise TypeError("needs an argument")
        return super().__new__(cls, *arguments)

    def __init__(self, _: int) -> None:
        super().__init__()


@pytest.mark.parametrize(
    "error",
    [_PickyError(1, 2), _MuteError(1), _NewError(1), OSError(2, "no", "file"), KeyError("k"), StopIteration(3),
     UnicodeDecodeError("utf8", b"a", 0, 1, "reason"), ExceptionGroup("group", [ValueError(1)]), AssertionError()],
    ids=lambda error: type(error).__name__,
)  # fmt: skip
def test_any_exception_is_an_answer(error: Exception) -> None:
    """Of its own class, with the way that it came; and the next edit forgets it."""
    x = r4.Variable(1.0)

    @r4.signal
    def fails() -> float:
        if x.now() < 3:
            raise error
        return 0.0

    above = fails + 1
    for value in (1.0, 2.0):
        x.value = value
        for _ in range(2):
            with pytest.raises(type(error)) as caught:
                above.at(0.0)
            assert caught.value.__notes__[-2:] == ["while evaluating fails at t = 0", "asked by (fails + 1)"]
    assert "fails" in r4.explain(fails, 0.0)
    x.value = 3.0
    assert above.at(0.0) == 1.0


@pytest.mark.parametrize("error", [KeyboardInterrupt, SystemExit, GeneratorExit, MemoryError])
@pytest.mark.parametrize("times", [0.0, [0.0, 1.0]], ids=["once", "often"])
def test_an_interrupt_is_no_answer(error: type[BaseException], times: Any) -> None:
    """Asking again tries again."""
    tries: list[int] = []

    @r4.signal
    def interrupted() -> float:
        tries.append(1)
        if len(tries) == 1:
            raise error
        return 1.0

    with pytest.raises(error):
        (interrupted * 2).at(times)
    assert np.all((interrupted * 2).at(times) == 2.0)


def test_endless_recursion_inside_of_a_rule_harms_nobody() -> None:
    """It is an error like any other, and the interpreter's limit is what it was."""
    limit = sys.getrecursionlimit()

    def endless() -> float:
        return endless()

    with pytest.raises(RecursionError):
        r4.signal(endless).at(0.0)
    assert sys.getrecursionlimit() == limit
    assert (t + 1).at(1.0) == 2.0
