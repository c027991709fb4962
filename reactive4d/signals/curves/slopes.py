"""How fast a curve changes: its derivative per second, as another function of time.

Exact for numbers and vectors under every interpolation, where the ease is a named one; for an ease that is the user's
own function the ease's slope is a central difference, good to about 1e-9 of the ease's own scale. At a key the
derivative is that of what follows. Where a Bezier span stands upright in time, the slope is that of a point a little
further inside.
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
    """The derivative of a curve of numbers or vectors, per second.

    >>> slope = Slope(Curve({0: 0.0, 2: 6.0}))
    >>> slope.sample(0.5), slope.sample(5.0)
    ((0.0, 2.0, 3.0), (2.0, inf, 0.0))
    """

    def __init__(self, curve: Curve) -> None:
        self.curve = plain(curve, "derivative")
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
                return max(lo, piece.lo), min(hi, piece.hi), self.zero
            if piece.controls:
                return piece.lo, piece.hi, piece.controls[1]
            return self._folded(t, curve.before if i == 0 else curve.after)
        return self._inner(i, t)

    def _inner(self, i: int, t: float) -> Sample:
        known = self.polynomial(i)
        if known.is_held:
            return known.lo, known.hi, known.controls[0]
        u = (t - known.lo) / (known.hi - known.lo)
        value = self._bent(self.curve.piece(i), known, u)
        value = freeze(value)
        return t, math.nextafter(t, INF), value

    def polynomial(self, i: int) -> Piece:
        """The derivative of piece i by its own parameter, over the span's seconds."""
        known = self._known.get(i)
        if known is None:
            piece = self.curve.piece(i)
            if piece.is_held:
                known = Piece(piece.lo, piece.hi, (self.zero,))
            else:
                length = piece.hi - piece.lo
                slopes = [self.curve.space.point(c) for c in bernstein.differentiated(piece.controls, length)]
                # What is constant but bent by an ease or a clock is no constant.
                is_even = piece.ease is None and piece.clock is None
                controls = tuple(slopes if is_even or len(slopes) > 1 else slopes * 2)
                known = Piece(piece.lo, piece.hi, controls, piece.ease, piece.clock)
            self._known[i] = known
        return known

    def _bent(self, piece: Piece, known: Piece, u: float) -> Any:
        between = self.curve.space.between
        if piece.clock is not None:
            u = clocks.parameter(piece.clock, u)
            rate = clocks.rate(piece.clock, u)
            if rate < _INSIDE:
                u = min(max(u, _INSIDE), 1.0 - _INSIDE)
                rate = max(clocks.rate(piece.clock, u), _INSIDE * _INSIDE)
            return between(known.controls)(u) / rate
        if piece.ease is not None:
            return between(known.controls)(piece.ease.scalar(u)) * ease_slope(piece.ease, u)
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
        if back:
            value = freeze(-value)
        if hi <= math.nextafter(inner, INF):
            return t, math.nextafter(t, INF), value
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
        values[back] = -values[back]
        for where, i, end in ((ts < first, 0, ends[0]), (ts >= last, count, ends[1])):
            if curve.piece(i).controls:
                values[where] = end
        values.flags.writeable = False
        return values
