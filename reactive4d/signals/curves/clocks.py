"""How time runs through a Bezier span: the parameter u at which x(u) = t, where x is a cubic with handles in time.

The span's time is scaled to 0..1; `a` and `b`, both in 0..1, are where the handles stand. So x never runs backwards,
and there is exactly one answer.
"""

from typing import Any

import numpy as np

from reactive4d.signals.curves.bernstein import Array

__all__ = ["EVEN", "elapsed", "parameter", "parameters", "rate"]

# Handles a third of the way: time runs evenly, u = t.
EVEN = (1.0 / 3.0, 2.0 / 3.0)


def elapsed(clock: tuple[float, float], u: Any) -> Any:
    """x(u), the share of the span's time that has passed at `u`.

    >>> elapsed((0.0, 1.0), 0.25)
    0.15625
    """
    a, b = clock
    v = 1.0 - u
    return u * (3.0 * v * (v * a + u * b) + u * u)


def rate(clock: tuple[float, float], u: Any) -> Any:
    """How fast time passes at `u`, dx / du."""
    a, b = clock
    v = 1.0 - u
    return 3.0 * (v * v * a + 2.0 * u * v * (b - a) + u * u * (1.0 - b))


def parameter(clock: tuple[float, float], x: float) -> float:
    """The u at which the share x of the span's time has passed: Newton's steps, halved where they leave the bracket.

    >>> round(parameter((0.0, 1.0), 0.15625), 12)
    0.25
    """
    if clock == EVEN or x <= 0.0 or x >= 1.0:
        return x
    low, high, u = 0.0, 1.0, x
    for _ in range(_STEPS):
        off = elapsed(clock, u) - x
        if off > 0.0:
            high = u
        elif off < 0.0:
            low = u
        else:
            break
        slope = rate(clock, u)
        new = u - off / slope if slope > 0.0 else low
        if not low < new < high:
            new = 0.5 * (low + high)
        if new in (u, low, high):
            break
        u = new
    return u


def parameters(clock: tuple[Array, Array], x: Array) -> Array:
    """(N,) the same for many at once, each with its own clock; step by step the same arithmetic.

    Args:
        clock: two arrays (N,).
        x: (N,).
    """
    a, b = clock
    u = x.copy()
    open_ = np.flatnonzero((x > 0.0) & (x < 1.0) & ~((a == EVEN[0]) & (b == EVEN[1])))
    low, high = np.zeros_like(x), np.ones_like(x)
    for _ in range(_STEPS):
        if not open_.size:
            break
        w = u[open_]
        mine = (a[open_], b[open_])
        off = elapsed(mine, w) - x[open_]  # pyright: ignore[reportArgumentType]
        high[open_] = np.where(off > 0.0, w, high[open_])
        low[open_] = np.where(off < 0.0, w, low[open_])
        bottom, top = low[open_], high[open_]
        slope = rate(mine, w)  # pyright: ignore[reportArgumentType]
        with np.errstate(divide="ignore", invalid="ignore"):
            new = np.where(slope > 0.0, w - off / slope, bottom)
        new = np.where((bottom < new) & (new < top), new, 0.5 * (bottom + top))
        done = (off == 0.0) | (new == w) | (new == bottom) | (new == top)
        u[open_] = np.where(done, w, new)
        open_ = open_[~done]
    return u


# Newton needs five; a bracket that is only ever halved reaches the last bit of u in less than 64, of small ones later.
_STEPS = 100
