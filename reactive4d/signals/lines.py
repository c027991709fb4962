"""Where a signal of numbers runs steadily: over an interval it only rises or only falls, by a function one can try.

Whoever compares such a signal with a number can find out for how long the comparison holds, without an answer for every
instant. `line` knows time and the straight pieces of keys, and what arithmetic with held numbers, `abs`, minimum and
maximum make of them.
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from reactive4d.engine import moment
from reactive4d.signals.algebra import Operation
from reactive4d.signals.crossings import end, start
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
_BENDS = (np.minimum, np.maximum, np.fmin, np.fmax, np.clip)
_KNOWN = (*_LINEAR, *_BENDS, np.absolute)


def could_be_line(x: Any) -> bool:
    """Whether a signal can be more than one instant steady, by how it is built; cheap, and may be wrong."""
    for _ in range(8):
        if isinstance(x, Time) or hasattr(x, "straight"):
            return True
        if not isinstance(x, Operation) or x.operator.symbol not in _KNOWN:
            return False
        moving: list[Any] = [y for y in x.operands if isinstance(y, Signal)]
        lines: list[Any] = [y for y in moving if isinstance(y, Time | Operation) or hasattr(y, "straight")]
        if len(lines) != 1:
            return False
        x = lines[0]
    return False


def line(x: Operand) -> Line | None:
    """How a signal runs round the asked time; only inside of an evaluation. What it depends on is noted."""
    if not isinstance(x, Signal):
        return _constant(x)
    return _constant(x.now()) if not could_be_line(x) else _running(x)


def _running(x: Any) -> Line | None:
    if isinstance(x, Time):
        return Line(-INF, INF, _same, 0.0, 1.0, 0.0)
    straight: Any = getattr(x, "straight", None)
    if straight is not None:
        return straight(moment())
    return _operated(x)


def _constant(x: Any) -> Line | None:
    """A number as a line; one that was read narrows the answer to where it holds."""
    if type(x) is not float and type(x) is not int:
        return None
    number: float | int = x
    try:
        offset = float(number)
    except OverflowError:  # a whole number beyond all floats
        return None

    def at(t: float) -> Any:
        return number

    return Line(-INF, INF, at, 0.0, 0.0, offset)


def _same(t: float) -> float:
    return t


def _operated(x: Operation[Any]) -> Line | None:
    parts = [line(y) for y in x.operands]
    found = [part for part in parts if part is not None]
    moving = [part for part in found if part.slope]
    if len(found) < len(parts) or len(moving) > 1:
        return None  # each is steady, but their rounding is not one function's
    one, symbol = x.operator.one, x.operator.symbol
    ats = [part.at for part in found]
    lo, hi = max(part.lo for part in found), min(part.hi for part in found)

    def at(t: float) -> Any:
        return one(*[f(t) for f in ats])

    if not moving:
        held = _constant(at(moment()))
        return None if held is None else held._replace(lo=lo, hi=hi)
    run = Line(lo, hi, at, moving[0].error, moving[0].slope, moving[0].offset)
    if symbol is np.absolute:
        return _reflected(run, moving[0].at)
    if symbol in _BENDS:
        return _bent(run, moving[0].at)
    return _moved(run, symbol, found)


def _moved(run: Line, symbol: Any, parts: list[Line]) -> Line | None:
    """The operand that moves, after arithmetic with a number that does not."""
    slope, offset, scale = run.slope, run.offset, 1.0
    if len(parts) == 1:
        scale = -1.0 if symbol is np.negative else 1.0
    else:
        first, other = (parts[0].slope != 0.0), parts[1].offset if parts[0].slope else parts[0].offset
        if symbol is np.add:
            offset += other
        elif symbol is np.subtract:
            scale = 1.0 if first else -1.0
            offset -= other
        elif symbol is np.multiply:
            scale = other
        elif first and other:
            scale = 1.0 / other
        else:
            return None
    slope, offset = slope * scale, offset * scale
    if not (math.isfinite(slope) and math.isfinite(offset) and slope):
        return None
    return run._replace(slope=slope, offset=offset, error=run.error * abs(scale) * 2)


def _reflected(run: Line, inner: Callable[[float], Any]) -> Line:
    """The absolute value, as far as the operand keeps its sign."""
    t = moment()
    is_negative = inner(t) < 0.0
    crossing = (-run.offset / run.slope,)

    def stays(s: float) -> bool:
        return (inner(s) < 0.0) == is_negative

    sign = -1.0 if is_negative else 1.0
    lo, hi = start(stays, t, run.lo, crossing), end(stays, t, run.hi, crossing)
    return run._replace(lo=lo, hi=hi, slope=sign * run.slope, offset=sign * run.offset)


def _bent(run: Line, inner: Callable[[float], Any]) -> Line | None:
    """Minimum, maximum or clip: as far as it is the operand that moves, or as far as it is another."""
    t = moment()
    value = run.at(t)
    is_moving = value == inner(t)

    def stays(s: float) -> bool:
        return run.at(s) == (inner(s) if is_moving else value)

    lo, hi = start(stays, t, run.lo, ()), end(stays, t, run.hi, ())
    if is_moving:
        return run._replace(lo=lo, hi=hi)
    held = _constant(value)
    return None if held is None else held._replace(lo=lo, hi=hi)
