"""B-splines whose control points are the keys: where the pieces join, and the Bernstein controls of one piece.

The curve is clamped: it begins at the first key and ends at the last, and in between only comes near the keys. Its
knots are the means of `degree` neighbouring key times (de Boor 1978, XIII.10), so that each key acts round its own
time, and moving one key in time moves at most `degree` knots.
"""

from collections.abc import Sequence
from typing import Any

__all__ = ["knots", "piece_controls"]


def knots(times: Sequence[float], degree: int) -> list[float]:
    """(n + degree + 1,) the clamped knots for n keys; `degree` < n.

    >>> knots([0.0, 1.0, 2.0, 3.0, 4.0], 3)
    [0.0, 0.0, 0.0, 0.0, 2.0, 4.0, 4.0, 4.0, 4.0]
    """
    n = len(times)
    # From the first time, so that a mean of times far from zero stays between its neighbours.
    inner = [times[j] + sum(t - times[j] for t in times[j + 1 : j + degree]) / degree for j in range(1, n - degree)]
    return [times[0]] * (degree + 1) + inner + [times[-1]] * (degree + 1)


def piece_controls(values: Sequence[Any], line: Sequence[float], j: int, *, degree: int) -> list[Any]:
    """The Bernstein controls of the piece between knots j and j + 1, by blossoming.

    Args:
        values: one control point per key; floats or arrays.
        line: the knots.
        j: index of the knot at which the piece starts; line[j] < line[j + 1].
        degree: of the curve.

    Returns:
        degree + 1 values.

    Ramshaw 1989: control k is the polynomial's blossom at the start taken degree - k times and the end k times.

    >>> piece_controls([0.0, 0.0, 6.0, 0.0, 0.0], knots([0.0, 1.0, 2.0, 3.0, 4.0], 3), 3, degree=3)
    [0.0, 0.0, 3.0, 3.0]
    """
    a, b = line[j], line[j + 1]
    return [_blossom(values, line, j, [a] * (degree - k) + [b] * k) for k in range(degree + 1)]


def _blossom(values: Sequence[Any], line: Sequence[float], j: int, arguments: list[float]) -> Any:
    p = len(arguments)
    row = [values[i] for i in range(j - p, j + 1)]
    for r, x in enumerate(arguments, start=1):
        for i in range(j, j - p + r - 1, -1):
            left, right = line[i], line[i + p - r + 1]
            share = (x - left) / (right - left)
            at = i - (j - p)
            row[at] = (1.0 - share) * row[at - 1] + share * row[at]
    return row[p]
