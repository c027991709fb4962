"""How fast a curve changes: its derivative per second, as another function of time.

Exact for numbers and vectors under every interpolation, where the ease is a named one; for an ease that is the user's
own function the ease's slope is a central difference, good to about 1e-9 of the ease's own scale. At a key the
derivative is that of what follows. Where a Bezier span stands upright in time, the slope is that of a point a little
further inside. A derivative of higher order is exact where the first one is a polynomial of time; where an ease or
handles in time bend it, it is a central difference over 1/5000 of the span.
"""

import math
from bisect import bisect_right
from typing import Any, Final, final

import numpy as np

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError, hint
from reactive4d.signals.curves import bernstein, clocks
from reactive4d.signals.curves.bernstein import Array
from reactive4d.signals.curves.curve import Curve
from reactive4d.signals.curves.extrapolations import fold, fold_each, unfold
from reactive4d.signals.curves.pieces import Piece, Sample
from reactive4d.signals.easings import Easing

__all__ = ["Slope", "ease_slope", "plain"]

INF = math.inf
_INSIDE: Final = 1e-7  # of a span
_EDGE: Final = 1e-4  # of a span, for a derivative of higher order
_STEP: Final = 1e-5  # of a span, for a user's ease


def plain(curve: Curve, what: str) -> Curve:
    """The curve, if it can be calculated with.

    Raises:
        ShapeError: its values are neither numbers nor vectors.
    """
    if curve.space.kind in ("number", "vector"):
        return curve
    error = ShapeError(f"values of kind {curve.space.kind!r} have no {what}")
    raise hint(error, "numbers and vectors have one; signal.map(...) makes numbers of other values")


def ease_slope(ease: Easing, u: float) -> float:
    """The derivative of an ease, by a central difference where the ease does not know it."""
    if ease.slope is not None:
        return ease.slope(u)
    low, high = max(u - _STEP, 0.0), min(u + _STEP, 1.0)
    return (ease.scalar(high) - ease.scalar(low)) / (high - low)


@final
class Slope:
    """The derivative of a curve of numbers or vectors, per second; of some order.

    >>> slope = Slope(Curve({0: 0.0, 2: 6.0}))
    >>> slope.sample(0.5), slope.sample(5.0)
    ((0.0, 2.0, 3.0), (2.0, inf, 0.0))
    """

    def __init__(self, curve: Curve, *, order: int = 1) -> None:
        self.curve = plain(curve, "derivative")
        self.order = order
        self.lower = Slope(curve, order=order - 1) if order > 1 else None
        self.zero: Any = 0.0 if curve.space.kind == "number" else curve.space.point(np.zeros_like(curve.values[0]))
        self._known: dict[int, Piece] = {}

    def sample(self, t: float) -> Sample:
        """Where the derivative at `t` holds, and the derivative."""
        curve = self.curve
        breaks = curve.breaks
        i = bisect_right(breaks, t)
        piece = curve.piece(i)
        if i in (0, len(breaks)):
            if piece.is_held:
                lo, hi, _ = curve.sample(t)
                return lo, hi, self.zero
            if piece.controls:
                return piece.lo, piece.hi, piece.controls[1] if self.order == 1 else self.zero
            return self._folded(t, curve.before if i == 0 else curve.after)
        return self._inner(i, t)

    def _inner(self, i: int, t: float) -> Sample:
        known = self.polynomial(i)
        if known.is_held:
            return known.lo, known.hi, known.controls[0]
        u = (t - known.lo) / (known.hi - known.lo)
        if self.lower is not None and (known.ease is not None or known.clock is not None):
            value = self._difference(i, u, self.lower)
        else:
            value = self._bent(known, u)
        return t, math.nextafter(t, INF), freeze(value)

    def _difference(self, i: int, u: float, lower: "Slope") -> Any:
        """A central difference of the derivative of the order below, inside of the piece."""
        piece = self.curve.piece(i)
        length = piece.hi - piece.lo
        low, high = (piece.lo + length * min(max(u + side, _EDGE), 1.0 - _EDGE) for side in (-_EDGE, _EDGE))
        return (lower.sample(high)[2] - lower.sample(low)[2]) / (high - low)

    def polynomial(self, i: int) -> Piece:
        """The derivative of piece i by its own parameter, over the span's seconds."""
        known = self._known.get(i)
        if known is None:
            piece = self.curve.piece(i)
            if piece.is_held:
                known = Piece(piece.lo, piece.hi, (self.zero,))
            else:
                length = piece.hi - piece.lo
                is_even = piece.ease is None and piece.clock is None
                slopes = list(piece.controls)
                for _ in range(self.order if is_even else 1):
                    slopes = bernstein.differentiated(slopes, length) or [self.zero]
                # What is constant but bent by an ease or a clock is no constant.
                controls = tuple(slopes if is_even or len(slopes) > 1 else slopes * 2)
                controls = tuple(self.curve.space.point(c) for c in controls)
                known = Piece(piece.lo, piece.hi, controls, piece.ease, piece.clock)
            self._known[i] = known
        return known

    def _bent(self, known: Piece, u: float) -> Any:
        between = self.curve.space.between
        if known.clock is not None:
            u = clocks.parameter(known.clock, u)
            rate = clocks.rate(known.clock, u)
            if rate < _INSIDE:
                u = min(max(u, _INSIDE), 1.0 - _INSIDE)
                rate = max(clocks.rate(known.clock, u), _INSIDE * _INSIDE)
            return between(known.controls)(u) / rate
        if known.ease is not None:
            return between(known.controls)(known.ease.scalar(u)) * ease_slope(known.ease, u)
        return between(known.controls)(u)

    def _folded(self, t: float, mode: str) -> Sample:
        curve = self.curve
        first, last = curve.times[0], curve.times[-1]
        mirrored = mode == "oscillate"
        inner, cycle = fold(t, first, last, mirrored=mirrored)
        back = mirrored and cycle % 2.0 == 1.0
        # What lies after a time in a cycle that runs backwards lies before it in the keys.
        inner = min(max(math.nextafter(inner, -INF) if back else inner, first), math.nextafter(last, -INF))
        lo, hi, value = self._inner(bisect_right(curve.breaks, inner), inner)
        if back and self.order % 2:
            value = freeze(-value)
        if hi <= math.nextafter(inner, INF):
            return t, math.nextafter(t, INF), value
        if back:  # folded times were taken one float earlier
            lo, hi = math.nextafter(lo, INF), math.nextafter(hi, INF)
        start, stop = unfold((lo, hi), t, first, last, mirrored=mirrored)
        return start, stop, value

    def sample_many(self, ts: Array) -> Array:
        """(N,) or (N, ...) derivatives; all at once where no span is bent, otherwise one by one."""
        curve = self.curve
        count = len(curve.breaks)
        known = [self.polynomial(i) for i in range(1, count)]
        folds = any(not curve.piece(i).controls for i in (0, count))
        if not known or any(piece.ease is not None or piece.clock is not None for piece in known):
            return np.array([self.sample(t)[2] for t in ts.tolist()]).reshape(ts.shape + np.shape(self.zero))
        ends = [
            piece.controls[1] if len(piece.controls) > 1 else self.zero
            for piece in (curve.piece(0), curve.piece(count))
        ]
        degree = max(len(piece.controls) for piece in known)
        table = np.array(
            [piece.controls if len(piece.controls) == degree else piece.controls * degree for piece in known]
        )
        breaks = np.array(curve.breaks)
        first, last = curve.times[0], curve.times[-1]
        inner, back = np.clip(ts, first, last), np.zeros(ts.shape, dtype=bool)
        if folds:
            for where, mode, i in ((ts < first, curve.before, 0), (ts >= last, curve.after, count)):
                if not curve.piece(i).controls:
                    folded, cycles = fold_each(ts[where], first, last, mirrored=mode == "oscillate")
                    turned = (cycles % 2.0 == 1.0) & (mode == "oscillate")
                    inner[where] = np.where(turned, np.nextafter(folded, -INF), folded)
                    back[where] = turned
        inner = np.clip(inner, first, np.nextafter(last, -INF))
        index = np.searchsorted(breaks, inner, side="right") - 1
        u = (inner - breaks[index]) / np.diff(breaks)[index]
        values = bernstein.at_each(np.moveaxis(table[index], 1, 0), u)
        held = np.array([piece.is_held for piece in known])[index]
        values[held] = table[index[held], 0]
        if self.order % 2:
            values[back] = -values[back]
        for where, i, end in ((ts < first, 0, ends[0]), (ts >= last, count, ends[1])):
            if curve.piece(i).controls:
                values[where] = end
        values.flags.writeable = False
        return values
