"""Operations whose answers stay the same for a while although what they read does not: comparisons, floor, sign.

Where the operand runs steadily (`lines`), the ends of the piece are found exactly: first where the line should cross
the threshold, else by bisecting the floating point numbers themselves.
"""

import math
import struct
from collections.abc import Callable
from typing import Any

import numpy as np

from reactive4d.arrays import same
from reactive4d.engine import moment, narrow
from reactive4d.engine.kinds import COMPUTED, FORMULA
from reactive4d.signals.algebra import Operation
from reactive4d.signals.facade import Signal
from reactive4d.signals.kernels import Operator
from reactive4d.signals.lines import Line, could_be_line, line

__all__ = ["Stepping"]

INF = math.inf
_LARGEST = math.nextafter(INF, 0.0)


class Stepping(Operation[Any]):
    """An operation that answers the same over whole pieces, and knows them where that is cheap."""

    __slots__ = ("kind",)

    def __init__(self, operator: Operator, operands: tuple[Any, ...]) -> None:
        self.kind = COMPUTED if _is_steady(operands) else FORMULA
        super().__init__(operator, operands)

    def rule(self) -> Any:
        """The answer, and how long it holds."""
        lines = [line(x) for x in self.operands]
        if any(x is None for x in lines):
            return self.operator.one(*[x.now() if isinstance(x, Signal) else x for x in self.operands])
        found = [x for x in lines if x is not None]
        t = moment()
        one = self.operator.one
        value = one(*[x.at(t) for x in found])
        moving = [i for i, x in enumerate(found) if x.slope]
        lo, hi = max(x.lo for x in found), min(x.hi for x in found)
        if len(moving) > 1:
            narrow(t, math.nextafter(t, INF))
            return value
        if moving:
            i = moving[0]
            rest = [x.at(t) for x in found]
            error = found[i].error

            def stays(s: float) -> bool:
                x = found[i].at(s)
                for nearby in (x - error, x + error) if error else (x,):
                    rest[i] = nearby
                    if not same(one(*rest), value):
                        return False
                return True

            crossings = _crossings(self.operator, found, i, t)
            lo, hi = _start(stays, t, lo, crossings), _end(stays, t, hi, crossings)
        narrow(lo, hi)
        return value


def _is_steady(operands: tuple[Any, ...]) -> bool:
    live: list[Any] = [x for x in operands if isinstance(x, Signal)]
    if any(not isinstance(x, Signal) and type(x) not in (float, int) for x in operands):
        return False
    return sum(could_be_line(x) for x in live) == 1


def _crossings(operator: Operator, lines: list[Line], i: int, t: float) -> list[float]:
    """Times about which the answer is likely to change."""
    moving = lines[i]
    x = moving.at(t)
    others = [other.offset for j, other in enumerate(lines) if j != i]
    if operator.symbol is np.floor_divide and i == 0 and others[0] and math.isfinite(x):
        step = math.floor(x / others[0])
        thresholds = [step * others[0], (step + 1) * others[0]]
    elif others:
        thresholds = others
    elif not math.isfinite(x):
        thresholds = []
    else:
        below = math.floor(x)
        thresholds = [0.0, below - 1.0, below - 0.5, float(below), below + 0.5, below + 1.0, below + 1.5]
    return [crossing for y in thresholds if math.isfinite(crossing := (y - moving.offset) / moving.slope)]


def _key(x: float) -> int:
    """Floats in their order, as whole numbers without gaps."""
    (n,) = struct.unpack("<q", struct.pack("<d", x))
    return n if n >= 0 else -(n & 0x7FFFFFFFFFFFFFFF)


def _float(n: int) -> float:
    (x,) = struct.unpack("<d", struct.pack("<q", n if n >= 0 else -n | -0x8000000000000000))
    return x


def _end(stays: Callable[[float], bool], t: float, hi: float, crossings: list[float]) -> float:
    """The first time after `t` at which the answer changes, at most `hi`."""
    after = math.nextafter(t, INF)
    if after >= hi or not stays(after):
        return min(after, hi)
    last = math.nextafter(hi, -INF) if hi < INF else _LARGEST
    for crossing in sorted(crossings):
        if t < crossing < last:
            good = _near(stays, crossing, t, last)
            if good is not None:
                return good
    if stays(last):
        return hi
    good, bad = _key(after), _key(last)
    while bad - good > 1:
        middle = (good + bad) // 2
        if stays(_float(middle)):
            good = middle
        else:
            bad = middle
    return _float(bad)


def _near(stays: Callable[[float], bool], crossing: float, t: float, last: float) -> float | None:
    """The change, if it lies within a few floats of where it should: the first time at which the answer is another."""
    key = _key(crossing)
    low = max(_float(key - 3), math.nextafter(t, INF))
    if low > last or not stays(low):
        return None
    for n in range(_key(low) + 1, key + 4):
        at = _float(n)
        if at > last:
            return None
        if not stays(at):
            return at
    return None


def _start(stays: Callable[[float], bool], t: float, lo: float, crossings: list[float]) -> float:
    """The earliest time, at least `lo`, from which the answer is what it is at `t`."""
    before = math.nextafter(t, -INF)
    if before < lo or not stays(before):
        return max(t, lo)
    first = lo if lo > -INF else -_LARGEST
    for crossing in sorted(crossings, reverse=True):
        if first < crossing < t:
            key = _key(crossing)
            high = min(_float(key + 3), before)
            if high < first or not stays(high):
                continue
            for n in range(_key(high) - 1, key - 4, -1):
                if _float(n) < first:
                    break
                if not stays(_float(n)):
                    return _float(n + 1)
    if stays(first):
        return lo
    bad, good = _key(first), _key(before)
    while good - bad > 1:
        middle = (good + bad) // 2
        if stays(_float(middle)):
            good = middle
        else:
            bad = middle
    return _float(good)
