"""Derivatives and integrals of signals over time.

Exact, but for rounding, where the form of a signal is known; otherwise numerical, as `numerical` tells with its errors.

| signal | derivative | integral |
|---|---|---|
| constant, parameter, `time` | exact | exact |
| keys of numbers and vectors | exact; a user's ease to 1e-9 | exact; spans with an ease to 1e-10 |
| sum, difference, times and divided by a constant, `vec`, component | exact | exact |
| product, quotient, power, NumPy's elementary functions, `where`, `%`, maximum | exact, almost everywhere | numerical |
| polynomials of time; sin, cos, exp, sinh, cosh of a · time + b | exact | exact |
| delay, stretch, reverse | exact | exact |
| repeat, hold, frames, warp, delay by a signal | exact, almost everywhere | numerical |
| keys with signals among their values, creep, Python functions, everything else | numerical | numerical |

"Almost everywhere": at a jump or a corner the derivative is that of what follows or of one side, never infinite.
A signal that one sets (`Variable`) is followed to what it is set to.
"""

import math
from typing import Any

from reactive4d.errors import TimeError
from reactive4d.signals.derivatives import differentiated
from reactive4d.signals.facade import Signal
from reactive4d.signals.integrals import integrated
from reactive4d.signals.trees import constant_or

__all__ = ["derivative", "integral"]


def derivative(signal: Signal[Any]) -> Signal[Any]:
    """The change of a signal per second, as a signal.

    Raises:
        ShapeError: it has no derivative: keys of rotations, colours or objects; others say so when they are asked.

    >>> import numpy as np
    >>> import reactive4d as r4
    >>> derivative(np.sin(2 * r4.time)).at(0.0)
    2.0
    """
    return constant_or(differentiated(signal), f"{signal.name}.derivative()")


def integral(signal: Signal[Any], start: float = 0.0) -> Signal[Any]:
    """The integral of a signal over time from `start`, as a signal; negative before it where the signal is positive.

    Raises:
        TimeError: `start` is not finite.
        ShapeError: it has no integral: keys of rotations, colours or objects; others say so when they are asked.

    >>> import numpy as np
    >>> import reactive4d as r4
    >>> integral(np.cos(2 * r4.time)).at(np.pi / 4)
    0.5
    """
    if not isinstance(start, int | float) or not math.isfinite(start):  # pyright: ignore[reportUnnecessaryIsInstance]
        raise TimeError(f"{signal.name}.integral: expected a finite start, got {start!r}")
    return constant_or(integrated(signal, float(start)), f"{signal.name}.integral()")
