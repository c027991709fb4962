"""Derivatives and integrals of signals of which nothing is known but their answers."""

import math
from collections.abc import Callable
from typing import Any, Final, final

import numpy as np
from numpy.typing import NDArray

from reactive4d.engine import Affine
from reactive4d.errors import ShapeError, TimeError, hint
from reactive4d.signals.facade import Signal

__all__ = ["Difference", "Quadrature"]

INF = math.inf
Array = NDArray[np.float64]
_STEP: Final = 2.0**-10  # seconds; a power of two, so that steps are exact
_OFFSETS: Final = (-2.0 * _STEP, -_STEP, _STEP, 2.0 * _STEP)
_MAPS: Final = tuple(Affine(1.0, offset) for offset in _OFFSETS)
_WIDEST: Final = 20  # levels of panels: a million seconds
_TOLERANCE: Final = 1e-10


def _stencil(a: Any, b: Any, c: Any, d: Any) -> Any:
    return (8.0 * (c - b) - (d - a)) / (12.0 * _STEP)


def _number(value: Any, what: str) -> Any:
    if type(value) in (float, int, bool):
        return float(value)
    if type(value) is np.ndarray and value.dtype.kind in "iufb":
        return value.astype(np.float64)
    error = ShapeError(f"{what}: expected numbers, got {value!r}")
    raise hint(error, "signal.map(...) makes numbers of other values")


@final
class Difference(Signal[Any]):
    """The derivative by the five-point stencil of 1/1024 s.

    Its error is h⁴/30 times the fifth derivative, here 3e-14 of it, and some 4e-13 of the signal itself by rounding; a
    jump or a corner is felt 2 ms away. Where the signal holds, its derivative is 0 and holds as well.
    """

    __slots__ = ("original",)

    def __init__(self, original: Signal[Any]) -> None:
        super().__init__(name=f"{original.name}.derivative()", engine=original.engine)
        self.original = original

    def rule(self) -> Any:
        """Four answers round the asked time."""
        return _stencil(*[_number(self.original.through(time_map), self.name) for time_map in _MAPS])

    def many(self, ts: Array, ask: Callable[[Any, Array], Any]) -> Any:
        """The same at many times."""
        return _stencil(*[_number(ask(self.original, ts + offset), self.name) for offset in _OFFSETS])


@final
class Quadrature(Signal[Any]):
    """The integral by adaptive Gauss-Kronrod quadrature, in panels of a second that are remembered.

    Its error is below 1e-10 of the largest value met, for each second; what lasts less than some 1/20 s between two
    times at which the signal is the same may be overlooked. A time more than a million seconds away is refused.
    """

    __slots__ = ("original", "panels", "start")

    def __init__(self, original: Signal[Any], start: float) -> None:
        super().__init__(name=f"{original.name}.integral()", engine=original.engine)
        self.original = original
        self.start = start
        self.panels: dict[tuple[int, int], Panel] = {}

    def rule(self) -> Any:
        """Whole panels, and what is left at both ends."""
        from reactive4d.engine import moment, narrow

        t = moment()
        narrow(t, math.nextafter(t, INF))
        low, high = min(self.start, t), max(self.start, t)
        if high - low > 2.0**_WIDEST:
            error = TimeError(f"{self.name} asked at t = {t!r}: farther than a million seconds from its start")
            raise hint(error, "choose a nearer start=")
        first, last = math.ceil(low), math.floor(high)
        if first > last:
            total = self.area(low, high)
        else:
            total = self.area(low, float(first)) + self.area(float(last), high)
            for level, k in _dyadic(first, last):
                total = total + self.panel(level, k).now()
        return total if t >= self.start else -total

    def panel(self, level: int, k: int) -> "Panel":
        """The integral over [k, k + 1) · 2 ** level seconds."""
        found = self.panels.get((level, k))
        if found is None:
            found = self.panels.setdefault((level, k), Panel(self, level, k))
        return found

    def area(self, low: float, high: float) -> Any:
        """The integral between two times, inside of an evaluation."""
        if low == high:
            return _number(self.original.at(low), self.name) * 0.0
        from scipy import integrate  # pyright: ignore[reportMissingTypeStubs]

        met: dict[float, Any] = {}
        is_scalar = False

        def height(t: float) -> Array:
            nonlocal is_scalar
            t = float(t)
            if t not in met:
                value = _number(self.original.at(t), self.name)
                is_scalar = isinstance(value, float)
                met[t] = np.atleast_1d(value)
            return met[t]

        scale = max(1e-300, *(float(np.abs(height(t)).max()) for t in np.linspace(low, high, 5)))
        quad_vec: Any = integrate.quad_vec  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]
        found: Array = quad_vec(
            height, low, high, epsabs=_TOLERANCE * scale * (high - low), epsrel=1e-12, norm="max", limit=400
        )[0]
        return float(found[0]) if is_scalar else found


@final
class Panel(Signal[Any]):
    """The integral over a span of whole seconds: it holds forever, until the signal is edited there."""

    __slots__ = ("k", "level", "whole")

    def __init__(self, whole: Quadrature, level: int, k: int) -> None:
        length = 2**level
        super().__init__(name=f"{whole.name}[{k * length}, {(k + 1) * length})", engine=whole.engine)
        self.whole = whole
        self.level = level
        self.k = k

    def rule(self) -> Any:
        """Two halves; at the bottom one quadrature."""
        if self.level:
            halves = [self.whole.panel(self.level - 1, 2 * self.k + half) for half in (0, 1)]
            return halves[0].now() + halves[1].now()
        return self.whole.area(float(self.k), float(self.k + 1))


def _dyadic(first: int, last: int) -> list[tuple[int, int]]:
    """The fewest spans of powers of two, at their own multiples, that fill [first, last)."""
    spans: list[tuple[int, int]] = []
    while first < last:
        level = (first & -first).bit_length() - 1 if first else _WIDEST
        while first + 2**level > last:
            level -= 1
        spans.append((level, first >> level))
        first += 2**level
    return spans
