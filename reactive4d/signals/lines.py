"""Where a signal of numbers runs steadily: over an interval it only rises or only falls, by a function one can try.

Whoever compares such a signal with a number can find out for how long the comparison holds, without an answer for every
instant. `line` knows time, what arithmetic with held numbers makes of it, and the straight pieces of keys.
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from reactive4d.engine import moment
from reactive4d.signals.algebra import Operation
from reactive4d.signals.facade import Operand, Signal
from reactive4d.signals.sources import Time

__all__ = ["Line", "could_be_line", "line"]

INF = math.inf


class Line(NamedTuple):
    """`at(t)` over [lo, hi): it never turns there, but for rounding by `error`; about slope * t + offset."""

    lo: float
    hi: float
    at: Callable[[float], Any]
    error: float
    slope: float
    offset: float


_LINEAR = (np.add, np.subtract, np.multiply, np.true_divide, np.negative, np.positive)


def could_be_line(x: Any) -> bool:
    """Whether a signal can be more than one instant steady, by how it is built; cheap, and may be wrong."""
    for _ in range(8):
        if isinstance(x, Time) or hasattr(x, "straight"):
            return True
        if not isinstance(x, Operation) or x.operator.symbol not in _LINEAR:
            return False
        moving: list[Any] = [y for y in x.operands if isinstance(y, Signal)]
        lines: list[Any] = [y for y in moving if isinstance(y, Time | Operation) or hasattr(y, "straight")]
        if len(lines) != 1:
            return False
        x = lines[0]
    return False


def _held(x: Operand) -> tuple[float, float, float] | None:
    """A number that holds round the asked time: (lo, hi, value); what is read narrows the answer."""
    if isinstance(x, Signal):
        x = x.now()
    if type(x) is float or type(x) is int:
        return -INF, INF, x
    return None


def line(x: Operand) -> Line | None:
    """How a signal runs round the asked time; only inside of an evaluation. What it depends on is noted."""
    if isinstance(x, Signal):
        if isinstance(x, Time):
            return Line(-INF, INF, _same, 0.0, 1.0, 0.0)
        straight = getattr(x, "straight", None)
        if straight is not None:
            return straight(moment())
        if isinstance(x, Operation) and could_be_line(x):
            return _operated(x)
    held = _held(x)
    if held is None:
        return None
    value = held[2]

    def at(t: float) -> float:
        return value

    return Line(-INF, INF, at, 0.0, 0.0, float(value))


def _same(t: float) -> float:
    return t


def _operated(x: Operation[Any]) -> Line | None:
    parts = [line(y) for y in x.operands]
    if any(part is None for part in parts):
        return None
    one, symbol = x.operator.one, x.operator.symbol
    if len(parts) == 1:
        (a,) = parts
        assert a is not None
        sign = -1.0 if symbol is np.negative else 1.0
        inner = a.at

        def outer(t: float) -> Any:
            return one(inner(t))

        return Line(a.lo, a.hi, outer, a.error, sign * a.slope, sign * a.offset)
    a, b = parts
    assert a is not None
    assert b is not None
    lo, hi = max(a.lo, b.lo), min(a.hi, b.hi)
    f, g = a.at, b.at

    def at(t: float) -> Any:
        return one(f(t), g(t))

    if symbol in (np.add, np.subtract):
        if a.slope and b.slope:
            return None  # each is steady, but their rounding is not one function's
        sign = 1.0 if symbol is np.add else -1.0
        return Line(lo, hi, at, a.error + b.error, a.slope + sign * b.slope, a.offset + sign * b.offset)
    if symbol is np.multiply and not (a.slope and b.slope):
        moving, factor = (a, b.offset) if not b.slope else (b, a.offset)
        if not factor:
            return None
        return Line(lo, hi, at, moving.error * abs(factor) * 2, moving.slope * factor, moving.offset * factor)
    if symbol is np.true_divide and not b.slope and b.offset:
        return Line(lo, hi, at, a.error / abs(b.offset) * 2, a.slope / b.offset, a.offset / b.offset)
    return None
