"""Operations whose answers stay the same for a while although what they read does not: comparisons, floor, sign.

Where the operand runs steadily (`lines`), the ends of the piece are found exactly: first where the line should cross
the threshold, else by bisecting the floating point numbers themselves.
"""

import math
from typing import Any, final

import numpy as np

from reactive4d.arrays import same
from reactive4d.engine import moment, narrow
from reactive4d.engine.kinds import COMPUTED, FORMULA
from reactive4d.signals.algebra import Operation
from reactive4d.signals.crossings import end, start
from reactive4d.signals.facade import Signal
from reactive4d.signals.kernels import Operator
from reactive4d.signals.lines import Line, could_be_line, line

__all__ = ["Bending", "Pieced", "Stepping"]

INF = math.inf


class Pieced(Operation[Any]):
    """An operation that may answer the same over whole pieces, and knows them where that is cheap."""

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
        if len(moving) > 1 or value != value:  # what is no number lies on both sides of what is one
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
            lo, hi = start(stays, t, lo, crossings), end(stays, t, hi, crossings)
        narrow(lo, hi)
        return value


@final
class Stepping(Pieced):
    """An operation that is the same over each of its pieces: a comparison, floor, sign."""

    __slots__ = ()


@final
class Bending(Pieced):
    """An operation that is the same over some of its pieces: minimum, maximum, clip."""

    __slots__ = ()


def _is_steady(operands: tuple[Any, ...]) -> bool:
    live: list[Any] = [x for x in operands if isinstance(x, Signal)]
    if any(not isinstance(x, Signal) and type(x) not in (float, int) for x in operands):
        return False
    return sum(could_be_line(x) for x in live) == 1


def _unit(operator: Operator, others: list[float]) -> float:
    """How long the steps are, of operators that say it."""
    if operator.symbol is np.floor_divide:
        return others[0]
    if operator.symbol is np.round and others and abs(others[0]) < 300:
        return 10.0 ** -others[0]
    return 0.0


def _crossings(operator: Operator, lines: list[Line], i: int, t: float) -> list[float]:
    """Times about which the answer is likely to change."""
    moving = lines[i]
    x = moving.at(t)
    others = [other.offset for j, other in enumerate(lines) if j != i]
    unit = _unit(operator, others) if i == 0 else 0.0
    if unit and math.isfinite(x / unit):
        below = math.floor(x / unit)
        thresholds = [n * unit for n in (below - 0.5, below, below + 0.5, below + 1.0, below + 1.5)]
    elif others:
        thresholds = others
    elif not math.isfinite(x):
        thresholds = []
    else:
        below = math.floor(x)
        thresholds = [0.0, below - 1.0, below - 0.5, float(below), below + 0.5, below + 1.0, below + 1.5]
    return [crossing for y in thresholds if math.isfinite(crossing := (y - moving.offset) / moving.slope)]
