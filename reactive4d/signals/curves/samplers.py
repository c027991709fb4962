"""Pieces prepared for asking: a function of time that does as little as can be done for one answer."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from reactive4d.signals.curves import clocks
from reactive4d.signals.curves.bernstein import Array
from reactive4d.signals.curves.extrapolations import fold, unfold
from reactive4d.signals.curves.pieces import Piece, Sample
from reactive4d.signals.curves.spaces import Numbers, Vectors

if TYPE_CHECKING:
    from reactive4d.signals.curves.curve import Curve

__all__ = ["Sampler", "sampler"]

INF = math.inf
FEW = 4  # numbers go faster one by one than through NumPy's calls
_nextafter = math.nextafter

Sampler: TypeAlias = Callable[[float], Sample]


def sampler(curve: "Curve", i: int) -> Sampler:
    """A function that answers in piece i of a curve, which is not held, and how long that holds."""
    piece = curve.piece(i)
    if i in (0, len(curve.breaks)):
        if piece.controls:
            return _ray(curve, piece, curve.times[0 if i == 0 else -1])
        return _folded(curve, curve.before if i == 0 else curve.after)
    if piece.ease is None and piece.clock is None and len(piece.controls) == 2:
        if isinstance(curve.space, Numbers):
            return _line(piece) or _bent(curve, piece)
        if isinstance(curve.space, Vectors):
            return _line_of_vectors(piece) or _bent(curve, piece)
    return _bent(curve, piece)


def _line(piece: Piece) -> Sampler | None:
    """A straight line of numbers: one product, one sum. None where the slope is too steep for a float."""
    lo, a = piece.lo, piece.controls[0]
    slope = (piece.controls[1] - a) / (piece.hi - lo)
    if not math.isfinite(slope):
        return None
    return lambda t: (t, _nextafter(t, INF), a + slope * (t - lo))


def _line_of_vectors(piece: Piece) -> Sampler | None:
    lo, start = piece.lo, piece.controls[0]
    with np.errstate(over="ignore"):
        slopes: Array = (piece.controls[1] - start) / (piece.hi - lo)
    if not np.isfinite(slopes).all():
        return None
    if start.ndim == 1 and len(start) <= FEW:
        pairs: list[tuple[float, float]] = list(zip(start.tolist(), slopes.tolist(), strict=True))

        def few(t: float) -> Sample:
            passed = t - lo
            value = np.array([a + slope * passed for a, slope in pairs])
            value.flags.writeable = False
            return t, _nextafter(t, INF), value

        return few

    def many(t: float) -> Sample:
        value = slopes * (t - lo)
        value += start
        value.flags.writeable = False
        return t, _nextafter(t, INF), value

    return many


def _bent(curve: "Curve", piece: Piece) -> Sampler:
    """A polynomial, run through as its ease or its clock says."""
    lo, length = piece.lo, piece.hi - piece.lo
    between, start = curve.space.between(piece.controls), curve.answer(piece.controls[0])
    bend: Callable[[float], float] | None = None if piece.ease is None else piece.ease.scalar
    if piece.clock is not None:
        clock = piece.clock
        bend = lambda u: clocks.parameter(clock, u)  # noqa: E731

    def sample(t: float) -> Sample:
        if t == lo:
            return t, _nextafter(t, INF), start
        u = (t - lo) / length
        return t, _nextafter(t, INF), between(u if bend is None else bend(u))

    return sample


def _ray(curve: "Curve", piece: Piece, origin: float) -> Sampler:
    """Straight on from the first or last key."""
    end, velocity = piece.controls
    answer, advance = curve.space.answer, curve.space.advance

    def sample(t: float) -> Sample:
        if t == origin:
            return t, _nextafter(t, INF), answer(end)
        return t, _nextafter(t, INF), answer(advance(end, _along(velocity, t - origin)))

    return sample


def _along(velocity: Any, seconds: float) -> Any:
    """How far a velocity leads; what does not move gets nowhere, however long it takes."""
    if math.isinf(seconds) and isinstance(velocity, np.ndarray):
        with np.errstate(invalid="ignore"):
            return np.where(velocity == 0.0, 0.0, velocity * seconds)
    return velocity * seconds


def _folded(curve: "Curve", mode: str) -> Sampler:
    """As at some time between the keys."""
    first, last = curve.times[0], curve.times[-1]
    mirrored = mode == "oscillate"
    offset = curve.cycle_offset() if mode == "cycle_offset" else None
    end = curve.answer(curve.values[-1])
    answer, advance, inside = curve.space.answer, curve.space.advance, curve.sample

    def sample(t: float) -> Sample:
        if t == last:
            return t, _nextafter(t, INF), end
        inner, cycle = fold(t, first, last, mirrored=mirrored)
        lo, hi, value = (last, last, end) if inner == last else inside(inner)
        if offset is not None and cycle:
            value = answer(advance(value, offset * cycle))
        if hi <= _nextafter(inner, INF):
            return t, _nextafter(t, INF), value
        start, stop = unfold((lo, hi), t, first, last, mirrored=mirrored)
        # The last key itself is met at its own time only, though a cycle begins there.
        return _nextafter(last, INF) if start <= last < stop else start, stop, value

    return sample
