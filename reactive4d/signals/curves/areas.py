"""The area under a curve: its integral over time, as another function of time.

Exact for numbers and vectors under every interpolation and extrapolation, but for spans with an ease: those are
integrated numerically, to 1e-10 of the span's own scale.
"""

import math
from bisect import bisect_right
from itertools import accumulate
from typing import Any, Final, final

import numpy as np

from reactive4d.arrays import freeze
from reactive4d.signals.curves import bernstein, clocks
from reactive4d.signals.curves.bernstein import Array
from reactive4d.signals.curves.curve import Curve
from reactive4d.signals.curves.extrapolations import fold
from reactive4d.signals.curves.pieces import Piece, Sample
from reactive4d.signals.curves.slopes import plain

__all__ = ["Area"]

INF = math.inf
_TOLERANCE: Final = 1e-11


@final
class Area:
    """The integral of a curve of numbers or vectors, from a start.

    Args:
        curve: what is integrated.
        start: where the integral is 0; seconds.

    >>> Area(Curve({0: 0.0, 2: 6.0})).sample(2.0)[2], Area(Curve({0: 0.0, 2: 6.0})).sample(3.0)[2]
    (6.0, 12.0)
    """

    def __init__(self, curve: Curve, start: float = 0.0) -> None:
        self.curve = plain(curve, "integral")
        self.start = start
        zero: Any = 0.0 if curve.space.kind == "number" else np.zeros_like(curve.values[0])
        count = len(curve.breaks)
        wholes = (self._whole(curve.piece(i)) for i in range(1, count))
        # From the first break to each of the others.
        self.sums: list[Any] = list(accumulate(wholes, initial=zero))
        self.base = self._from_first(start)

    def sample(self, t: float) -> Sample:
        """Where the integral at `t` holds, and the integral: it stands still where the curve holds zero."""
        value = freeze(self._from_first(t) - self.base)
        lo, hi, height = self.curve.sample(t)
        if not np.any(height) and not (math.isinf(t) or self._offsets(t)):
            return lo, hi, value
        return t, math.nextafter(t, INF), value

    def sample_many(self, ts: Array) -> Array:
        """(N,) or (N, ...) integrals, one by one."""
        values = np.array([self.sample(t)[2] for t in ts.tolist()]).reshape(ts.shape + np.shape(self.sums[0]))
        values.flags.writeable = False
        return values

    def _offsets(self, t: float) -> bool:
        """Whether the curve adds something every cycle here, so that a zero is a sum whose integral is rounded."""
        first, last = self.curve.times[0], self.curve.times[-1]
        return (t < first and self.curve.before == "cycle_offset") or (t >= last and self.curve.after == "cycle_offset")

    def _from_first(self, t: float) -> Any:
        """The integral from the first key to `t`."""
        curve = self.curve
        first, last = curve.times[0], curve.times[-1]
        i = bisect_right(curve.breaks, t)
        piece = curve.piece(i)
        if 0 < i < len(curve.breaks):
            return self.sums[i - 1] + self._part(piece, (t - piece.lo) / (piece.hi - piece.lo))
        if piece.controls:
            origin, so_far = (first, self.sums[0]) if i == 0 else (last, self.sums[-1])
            passed = t - origin
            value = so_far + _times(piece.controls[0], passed)
            return value if piece.is_held else value + 0.5 * passed * _times(piece.controls[1], passed)
        mode = curve.before if i == 0 else curve.after
        inner, cycle = fold(t, first, last, mirrored=mode == "oscillate")
        total = self.sums[-1]
        # The folded time may round up to the last key itself.
        part = total if inner >= last else self._from_first(inner)
        if mode == "oscillate" and cycle % 2.0 == 1.0:
            part = total - part
        value = _times(total, cycle) + part
        if mode == "cycle_offset":
            step, period = curve.cycle_offset(), last - first
            value = value + step * (period * cycle * (cycle - 1.0) / 2.0 + cycle * (inner - first))
        return value

    def _whole(self, piece: Piece) -> Any:
        return self._part(piece, 1.0)

    def _part(self, piece: Piece, x: float) -> Any:
        """The integral over the first share x of a piece's time."""
        length = piece.hi - piece.lo
        if piece.is_held:
            return piece.controls[0] * (length * x)
        controls = np.array(piece.controls)
        if piece.ease is not None:
            return self._quadrature(piece, x)
        if piece.clock is not None:
            controls = _product(controls, 3.0 * np.array(_rates(piece.clock)))
            x = clocks.parameter(piece.clock, x)
        sums = bernstein.integrated(controls, length)
        if x == 1.0:
            return _scalar(sums[-1])
        weights = bernstein.weights(len(sums) - 1, x)
        return _scalar(np.tensordot(weights, sums, axes=1))

    def _quadrature(self, piece: Piece, x: float) -> Any:
        from scipy import integrate  # pyright: ignore[reportMissingTypeStubs]

        assert piece.ease is not None
        between, ease = self.curve.space.between(piece.controls), piece.ease.scalar
        scale = max(1.0, float(np.abs(piece.controls).max()))

        def height(u: float) -> Array:
            return np.asarray(between(ease(u)))

        quad_vec: Any = integrate.quad_vec  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]
        found: Array = quad_vec(height, 0.0, x, epsabs=_TOLERANCE * scale, epsrel=_TOLERANCE, limit=2000)[0]
        return _scalar(found * (piece.hi - piece.lo))


def _rates(clock: tuple[float, float]) -> tuple[float, float, float]:
    """The Bernstein controls of a third of dx / du."""
    a, b = clock
    return a, b - a, 1.0 - b


def _product(a: Array, b: Array) -> Array:
    """The Bernstein controls of the product of two polynomials, (p + 1, ...) and (q + 1,)."""
    p, q = len(a) - 1, len(b) - 1
    controls = np.zeros((p + q + 1, *a.shape[1:]))
    for i in range(p + 1):
        for j in range(q + 1):
            controls[i + j] += a[i] * (b[j] * math.comb(p, i) * math.comb(q, j) / math.comb(p + q, i + j))
    return controls


def _scalar(value: Any) -> Any:
    return float(value) if np.ndim(value) == 0 else value


def _times(value: Any, factor: float) -> Any:
    """A product in which not moving stays so, however long."""
    if math.isinf(factor):
        with np.errstate(invalid="ignore"):
            return _scalar(np.where(np.equal(value, 0.0), 0.0, np.multiply(value, factor)))
    return value * factor
