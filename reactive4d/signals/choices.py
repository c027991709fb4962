"""Choosing between signals: only the chosen one is read, and the answer holds while the choice does."""

from typing import Any

import numpy as np

from reactive4d.arrays import ARRAY
from reactive4d.errors import ShapeError, hint
from reactive4d.signals.algebra import operand, shown
from reactive4d.signals.facade import Signal
from reactive4d.signals.kernels import SEQUENCE, repeated, stacked

__all__ = ["Choice", "where"]


class Choice(Signal[Any]):
    """One of two signals, as a condition says; see `where`."""

    __slots__ = ("condition", "no", "yes")

    def __init__(self, condition: Signal[Any], yes: Any, no: Any) -> None:
        self.condition = condition
        self.yes = yes
        self.no = no
        super().__init__(name="", engine=condition.engine)

    @property
    def name(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """What it chooses between, as far as that is short."""
        return shown(self)

    @name.setter
    def name(self, value: str) -> None:
        pass

    def rule(self) -> Any:
        """Read the condition, then only what it chooses."""
        condition = self.condition.now()
        if isinstance(condition, ARRAY):
            yes, no = _now(self.yes), _now(self.no)
            return np.where(condition, yes, no)  # pyright: ignore[reportUnknownVariableType]
        return _now(self.yes if condition else self.no)

    def many(self, ts: Any, ask: Any) -> Any:
        """Each of the two, asked only at the times where it is chosen."""
        condition = ask(self.condition, ts)
        if not isinstance(condition, ARRAY) or condition.ndim != 1:
            raise ShapeError(f"where: expected one truth value for each time, got {condition!r}")
        chosen = condition.astype(bool)
        if chosen.all():
            return _all(self.yes, ts, ask)
        if not chosen.any():
            return _all(self.no, ts, ask)
        parts = [_all(self.yes, ts[chosen], ask), _all(self.no, ts[~chosen], ask)]
        if any(isinstance(part, tuple) for part in parts) or parts[0].shape[1:] != parts[1].shape[1:]:
            rows = [iter(part.tolist() if isinstance(part, ARRAY) and part.ndim == 1 else part) for part in parts]
            return stacked([next(rows[0] if is_yes else rows[1]) for is_yes in chosen])
        answer = np.empty((len(ts), *parts[0].shape[1:]), dtype=np.result_type(*parts))
        answer[chosen], answer[~chosen] = parts
        return answer


def _now(x: Any) -> Any:
    return x.now() if isinstance(x, Signal) else x  # pyright: ignore[reportUnknownVariableType]


def _all(x: Any, ts: Any, ask: Any) -> Any:
    if isinstance(x, Signal):
        return ask(x, ts)
    return repeated(x, len(ts))


def where(condition: Signal[Any], yes: Any, no: Any) -> Signal[Any]:
    """`yes` while the condition is true, else `no`: signals or constants, of which only the chosen one is read.

    >>> import reactive4d as r4
    >>> step = where(r4.time < 3, 1.0, 2.0)
    >>> step.at(0.0), step.at(3.0), step.valid(0.0)
    (1.0, 2.0, (-inf, 3))
    """
    if not isinstance(condition, Signal):  # pyright: ignore[reportUnnecessaryIsInstance]
        error = TypeError(f"where: expected a signal as condition, got {condition!r}")
        raise hint(error, "comparisons of signals are signals; what never changes is chosen by `yes if c else no`")
    return Choice(condition, _branch(yes), _branch(no))


def _branch(x: Any) -> Any:
    """A signal or a constant; a list or tuple that is no vector is held as it is."""
    if isinstance(x, SEQUENCE) and not all(isinstance(part, int | float | np.number | Signal) for part in x):
        return x
    return operand(x)
