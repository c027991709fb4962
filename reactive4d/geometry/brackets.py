"""Roots between two places where a function has two signs: Newton steps that never leave the bracket."""

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

__all__ = ["root"]

Floats: TypeAlias = NDArray[np.float64]


def root(
    function: Callable[[Floats, Any], tuple[Floats, Floats]], low: Floats, high: Floats, *, scale: float = 1.0
) -> Floats:
    """One root in each bracket, (N,).

    Args:
        function: of places (M,) and the indices (M,) of their brackets, giving values and slopes.
        low: (N,), where the value is of another sign than at `high`; 0 counts as negative.
        high: (N,), not less than `low`.
        scale: roots are found to 2e-16 of it, or to the last digit.

    >>> half = root(lambda x, which: (x * x - 0.25, 2.0 * x), np.zeros(1), np.ones(1))
    >>> half.tolist()
    [0.5]
    """
    low, high = low.copy(), high.copy()
    place = 0.5 * (low + high)
    left = function(low, np.arange(len(low)))[0] <= 0.0
    open_ = np.arange(len(low))
    for turn in range(120):
        if not len(open_):
            break
        at = place[open_]
        value, slope = function(at, open_)
        below = (value <= 0.0) == left[open_]
        low[open_] = np.where(below, at, low[open_])
        high[open_] = np.where(below, high[open_], at)
        a, b = low[open_], high[open_]
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            after = at - value / slope
        # Every fourth step halves: then the bracket shrinks also where the slope misleads.
        after = np.where((after > a) & (after < b) & (turn % 4 != 3), after, 0.5 * (a + b))
        done = (value == 0.0) | (b - a <= 2e-16 * scale) | (np.abs(after - at) <= 2e-16 * scale)
        place[open_] = np.where(value == 0.0, at, after)
        open_ = open_[~done]
    return place
