"""The process's one engine, as functions: transactions, the log, explanations, the graph, statistics, the budget."""

from collections.abc import Iterable
from contextlib import AbstractContextManager
from types import ModuleType
from typing import Any

from reactive4d.engine import Graph, engine
from reactive4d.engine.cells import as_time
from reactive4d.engine.events import Log
from reactive4d.errors import hint
from reactive4d.signals.facade import Signal

__all__ = ["Budgeted", "explain", "graph", "log", "stats", "transaction"]


def transaction() -> AbstractContextManager[None]:
    """All edits of the block are published at once, or none if it raises.

    Inside, this thread sees what it set; other threads go on with what they remember, or wait for the end.

    >>> import reactive4d as r4
    >>> x, y = r4.Variable(1.0), r4.Variable(2.0)
    >>> total = x + y
    >>> with transaction():
    ...     x.value = 10.0
    ...     y.value = 20.0
    >>> total.at(0.0)
    30.0
    """
    return engine.transaction()


def log() -> AbstractContextManager[Log]:
    """What the engine does while the block runs, as a sequence of events that grows.

    >>> import reactive4d as r4
    >>> x = r4.Variable(1.0, name="x")
    >>> double = r4.lift(lambda value: 2 * value)(x)
    >>> with log() as events:
    ...     _ = double.at(0.0), double.at(5.0)
    >>> [event.kind for event in events]
    ['reused', 'evaluated', 'reused']
    """
    return engine.log()


def explain(signal: Signal[Any], t: float, /, **parameters: Any) -> str:
    """What was computed and what was reused to answer at one point, and why, as an indented text.

    >>> import reactive4d as r4
    >>> print(explain(r4.Variable(1.0, name="x") * 2, 0.0))
    x * 2 = 2.0: computed, since nothing was remembered here; holds over [-inf, inf)
      x: source
    """
    return _asked(signal, "explain").engine.explain(signal, as_time(t, signal), **parameters)


def graph(*signals: Signal[Any]) -> Graph:
    """The signals and everything that they read, as data, as text and as DOT.

    >>> import reactive4d as r4
    >>> print(graph(r4.Variable(1.0, name="x") * 2).text())
    x * 2 (formula, never asked) <- x
    x (source, up to date)
    """
    return engine.graph([_asked(x, "graph") for x in signals])


def stats(signals: Signal[Any] | Iterable[Signal[Any]] | None = None) -> dict[str, Any]:
    """Bytes, budget, evictions; by signal its evaluations, seconds, answers, bytes, hits and the seconds they saved.

    Hits are counted only while a log is open; seconds are estimated from the first evaluations and every sixteenth.

    >>> sorted(stats([]))
    ['budget', 'bytes', 'cells', 'evaluations', 'evicted', 'hits']
    """
    if signals is None:
        return engine.stats()
    chosen: list[Any] = [signals] if isinstance(signals, Signal) else list(signals)
    return engine.stats([_asked(x, "stats") for x in chosen])


def _asked(signal: Signal[Any], what: str) -> Signal[Any]:
    """A signal; anything else is refused."""
    if not isinstance(signal, Signal):  # pyright: ignore[reportUnnecessaryIsInstance]
        error = TypeError(f"{what}: expected a signal, got {signal!r}")
        raise hint(error, "the signal itself, not its answer; several of them one by one, graph(a, b)")
    return signal


class Budgeted(ModuleType):
    """The package as a module with one settable attribute: `reactive4d.budget`."""

    @property
    def budget(self) -> int:
        """Bytes that remembered answers may take. Every signal keeps its latest answer all the same."""
        return engine.budget

    @budget.setter
    def budget(self, value: int) -> None:
        if not isinstance(value, int | float) or isinstance(value, bool) or not value >= 0 or value != value // 1:  # pyright: ignore
            raise ValueError(f"budget: expected a whole number of bytes, got {value!r}")
        engine.budget = int(value)
