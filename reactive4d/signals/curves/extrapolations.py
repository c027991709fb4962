"""What a curve does before its first and after its last key: time folded back into the keys, or a straight ray."""

import math
from typing import Final, Literal, TypeAlias, get_args

import numpy as np
from numpy.typing import NDArray

__all__ = ["EXTRAPOLATIONS", "FOLDS", "Extrapolation", "fold", "fold_each", "unfold"]

Extrapolation: TypeAlias = Literal["hold", "linear", "cycle", "cycle_offset", "oscillate"]
EXTRAPOLATIONS: Final[tuple[str, ...]] = get_args(Extrapolation)
# Those that answer as some time between the keys does.
FOLDS: Final = frozenset({"cycle", "cycle_offset", "oscillate"})

INF = math.inf


def fold(t: float, first: float, last: float, *, mirrored: bool) -> tuple[float, float]:
    """The time in [first, last] that stands for `t`, and the number of the cycle that `t` lies in.

    Cycle 0 is [first, last). Every other cycle of mirrored ones runs backwards. Within one cycle the folded time never
    runs against its direction, rounding included. An infinite time stands at the nearer end.

    >>> fold(7.5, 0.0, 2.0, mirrored=False), fold(7.5, 0.0, 2.0, mirrored=True)
    ((1.5, 3.0), (0.5, 3.0))
    """
    if math.isinf(t):
        return (last, 0.0) if t > 0 else (first, 0.0)
    cycle, rest = divmod(t - first, last - first)
    inner = last - rest if mirrored and cycle % 2.0 else first + rest
    return min(max(inner, first), last), cycle


def fold_each(
    t: NDArray[np.float64], first: float, last: float, *, mirrored: bool
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The same for many times, with the same arithmetic: two arrays (N,)."""
    finite = np.where(np.isinf(t), first, t)
    cycle, rest = np.divmod(finite - first, last - first)
    inner = np.where(cycle % 2.0 != 0.0, last - rest, first + rest) if mirrored else first + rest
    inner = np.where(np.isinf(t), np.where(t > 0, last, first), inner)
    return np.clip(inner, first, last), cycle


def unfold(span: tuple[float, float], t: float, first: float, last: float, *, mirrored: bool) -> tuple[float, float]:
    """An interval round `t` whose every time folds into `span`, where `t` itself does; never too large.

    Folding is monotonic within one cycle, so that it is enough to try both ends; they give way until they are inside.
    """
    if math.isinf(t):
        return t, math.nextafter(t, INF)
    lo, hi = max(span[0], first), min(span[1], last)
    inner, cycle = fold(t, first, last, mirrored=mirrored)
    before, after = inner - lo, hi - inner
    if mirrored and cycle % 2.0:
        before, after = after, before

    def inside(x: float) -> bool:
        folded, number = fold(x, first, last, mirrored=mirrored)
        return number == cycle and lo <= folded < hi

    slack = 2.0 * math.ulp(max(abs(t), abs(first), abs(last)))
    start, stop = t, math.nextafter(t, INF)
    for give in (0.0, 1.0, 4.0):
        if inside(t - before + give * slack) and t - before + give * slack <= t:
            start = t - before + give * slack
            break
    for give in (0.0, 1.0, 4.0):
        end = t + after - give * slack
        if end > t and inside(math.nextafter(end, -INF)):
            stop = end
            break
    return start, stop
