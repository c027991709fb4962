"""Finalizers run anywhere, also in the middle of the engine's own work: they must neither block nor break it."""

import gc
import threading
from typing import Any

import pytest
from models import Case

from reactive4d.engine import Source
from reactive4d.errors import EvaluationError


def _in_time(work: Any) -> None:
    """Do something on another thread; fail if it waits for ever."""
    errors: list[BaseException] = []

    def run() -> None:
        try:
            work()
        except BaseException as error:  # noqa: BLE001  handed over to the test
            errors.append(error)

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    thread.join(60)
    assert not thread.is_alive(), "it waits for ever"
    if errors:
        raise errors[0]


def test_a_finalizer_that_asks_does_not_wait_for_its_own_thread(cached: Case) -> None:
    """Answers that ask when they are thrown away: refused in the middle of the engine's work, answered elsewhere."""
    source, other = cached.source(1.0, "s"), cached.source(5.0, "other")
    heard: list[Any] = []

    class Asks:
        def __del__(self) -> None:
            try:
                heard.append(cached.formula("late", lambda x: x, other).at(0.0))
            except EvaluationError as error:
                heard.append(error)

    cell = cached.formula("cell", lambda _: Asks(), source)

    def work() -> None:
        for n in range(30):
            source.set_content(float(n))
            cell.at(0.0)
        cached.engine.forget([cell])

    _in_time(work)
    gc.collect()
    assert heard
    assert {type(x) for x in heard} <= {float, EvaluationError}
    assert all("in the middle of the engine's own work" in str(x) for x in heard if not isinstance(x, float))
    cached.engine.check([cell])


def test_a_finalizer_that_edits_does_not_wait_for_its_own_thread(cached: Case) -> None:
    """An edit in the middle of the engine's work is refused and changes nothing."""
    source, other = cached.source(1.0, "s"), cached.source(5.0, "other")
    refused: list[EvaluationError] = []

    class Edits:
        def __del__(self) -> None:
            try:
                other.set_content(other.content + 1.0)
            except EvaluationError as error:
                refused.append(error)

    cell = cached.formula("cell", lambda x, _: Edits(), source, other)

    def work() -> None:
        for n in range(30):
            source.set_content(float(n))
            cell.at(0.0)

    _in_time(work)
    cached.engine.check([cell])


def test_a_log_that_nobody_closed_is_closed_when_it_is_thrown_away(cached: Case) -> None:
    """Also where the collector comes by in the middle of an ask."""
    source = cached.source(1.0, "s")
    cell = cached.formula("cell", lambda x: x, source)

    def work() -> None:
        for n in range(50):
            log = cached.engine.log()
            log.__enter__()
            holder: list[Any] = [log]
            holder.append(holder)
            del log, holder
            source.set_content(float(n))
            cell.at(0.0)
        gc.collect()

    _in_time(work)
    assert not cached.engine.logs
    assert cell.at(0.0) == 49.0


def test_a_source_that_asks_while_it_answers_is_an_error(cached: Case) -> None:
    """`sample` is a pure function of the content: what it would read could not be known."""
    other = cached.source(5.0, "other")
    late = cached.formula("late", lambda x: x, other)

    class Asking(Source):
        def sample(self, t: float) -> tuple[float, float, Any]:
            return t, t + 1.0, late.at(t)

    source = Asking(None, name="asking", engine=cached.engine)
    with pytest.raises(EvaluationError, match="in the middle of the engine's own work"):
        source.at(0.0)
