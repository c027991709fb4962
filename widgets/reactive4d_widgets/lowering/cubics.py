"""One cubic through samples: it meets the first and the last one, and comes as near as it can to those between."""

from typing import Any, NamedTuple

import numpy as np

from reactive4d_widgets.lowering.measures import Measure
from reactive4d_widgets.lowering.numerals import Array

__all__ = ["ENOUGH", "Cubic", "cubic", "merged"]

ENOUGH = 0.5  # of the tolerance: between the samples it may be worse


class Cubic(NamedTuple):
    """A cubic over [lo, hi), the samples that it was made of, and how far it is from them at most.

    Attributes:
        powers: (4, c), factors of the powers of t - lo.
        times: (n,), of the samples.
        values: (n, c), the samples.
    """

    lo: float
    hi: float
    powers: Array
    times: Array
    values: Array
    error: float

    def at(self, times: Array) -> Array:
        """(n, c) its values."""
        s = (times - self.lo)[:, None]
        a, b, c, d = self.powers
        return a + s * (b + s * (c + s * d))


def cubic(lo: float, hi: float, times: Array, *, values: Array, measure: Measure) -> Cubic:
    """The cubic over [lo, hi) through samples whose first one is at lo and whose last one is at hi, or just before.

    >>> from reactive4d_widgets.lowering.measures import Numbers
    >>> ts = np.linspace(0.0, 2.0, 9)
    >>> made = cubic(0.0, 2.0, ts, values=ts[:, None] ** 3, measure=Numbers(1e-6))
    >>> (made.powers.round(9) + 0.0).ravel().tolist(), made.error < 1e-12
    ([0.0, 0.0, 0.0, 1.0], True)
    """
    values = measure.aligned(values)
    length = hi - lo
    u = ((times - lo) / length)[:, None]
    first, last = values[0], values[-1]
    base = (1.0 - u) * first + u * last
    bow = u * (1.0 - u)
    basis = np.concatenate([bow, bow * u], axis=1)
    inner = slice(1, -1)
    solve: Any = np.linalg.lstsq
    a, b = solve(basis[inner], (values - base)[inner], rcond=None)[0]
    powers = np.stack([first, last - first + a, b - a, -b]) / length ** np.arange(4)[:, None]
    made = Cubic(lo, hi, powers, times, values, 0.0)
    return made._replace(error=measure.error(made.at(times), values))


def merged(cubics: list[Cubic], measure: Measure, borders: set[float]) -> list[Cubic]:
    """Fewer cubics that are as near to all samples: neighbours become one where one is enough.

    Args:
        cubics: in the order of time, each beginning where the one before ends.
        measure: of the values.
        borders: times at which the values may jump: no cubic goes across.
    """
    found: list[Cubic] = []
    for one in cubics:
        if found and found[-1].hi == one.lo and one.lo not in borders:
            together = _together(found[-1], one, measure)
            if together.error <= ENOUGH * measure.tolerance:
                found[-1] = together
                continue
        found.append(one)
    return found


def _together(a: Cubic, b: Cubic, measure: Measure) -> Cubic:
    times = np.concatenate([a.times[:-1], b.times])
    values = np.concatenate([a.values[:-1], b.values])
    return cubic(a.lo, b.hi, times, values=values, measure=measure)
