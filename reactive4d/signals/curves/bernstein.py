"""Polynomials over one span in Bernstein form: the ends are exact, and nothing leaves the hull of the controls.

`controls` are p + 1 numbers, or one array (p + 1, ...), for degree p; `u` runs from 0 at the start of the span to 1 at
its end. Beyond 0 and 1, where an ease overshoots, the polynomial goes on.
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

__all__ = ["Array", "at", "at_each", "differentiated", "integrated", "weights"]

Array: TypeAlias = NDArray[np.float64]


def at(controls: tuple[float, ...], u: float) -> float:
    """The value of a number's polynomial at `u`.

    >>> at((0.0, 0.0, 1.0, 1.0), 0.5)
    0.5
    """
    n = len(controls)
    v = 1.0 - u
    if n == 2:
        # Not a + (b - a) * u: the difference of two large numbers may be infinite.
        a, b = controls
        return v * a + u * b
    if n == 4:
        a, b, c, d = controls
        return v * v * (v * a + 3.0 * u * b) + u * u * (3.0 * v * c + u * d)
    line = list(controls)
    for k in range(n - 1, 0, -1):
        for i in range(k):
            line[i] = v * line[i] + u * line[i + 1]
    return line[0]


def weights(degree: int, u: float) -> Array:
    """(p + 1,) how much each control counts at `u`; their sum is 1.

    >>> weights(2, 0.5).tolist()
    [0.25, 0.5, 0.25]
    """
    v = 1.0 - u
    if degree == 3:
        return np.array((v * v * v, 3.0 * u * v * v, 3.0 * u * u * v, u * u * u))
    if degree == 1:
        return np.array((v, u))
    row = [1.0]
    for _ in range(degree):
        row = [v * a + u * b for a, b in zip([*row, 0.0], [0.0, *row], strict=True)]
    return np.array(row)


def at_each(controls: Array, u: Array) -> Array:
    """(N, ...) the values of N polynomials, each at its own `u`.

    Args:
        controls: (p + 1, N, ...).
        u: (N,).
    """
    if len(controls) == 1:
        return controls[0].copy()
    several: Any = controls
    shares: Any = u.reshape(u.shape + (1,) * (controls.ndim - 2))
    found: Any = at(several, shares)
    return found


def integrated(controls: Array, length: float) -> Array:
    """The controls of the integral from the start of the span, (p + 2, ...), over a span of `length` seconds.

    >>> integrated(np.array([1.0, 3.0]), 2.0).tolist()
    [0.0, 1.0, 4.0]
    """
    sums = np.cumsum(controls, axis=0) * (length / len(controls))
    return np.concatenate((np.zeros_like(sums[:1]), sums))


def differentiated(controls: Sequence[Any], length: float) -> list[Any]:
    """The controls of the derivative per second, one fewer, over a span of `length` seconds.

    >>> differentiated((0.0, 2.0), 4.0)
    [0.5]
    """
    p = len(controls) - 1
    return [p * (b - a) / length for a, b in pairwise(controls)]
