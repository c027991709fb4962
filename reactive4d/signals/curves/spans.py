"""A curve cut into pieces: the polynomial of each span, and what lies outside of the keys."""

import math
from bisect import bisect_right
from typing import TYPE_CHECKING, Any

import numpy as np

from reactive4d.signals.curves import bsplines
from reactive4d.signals.curves.pieces import STEADY, Piece
from reactive4d.signals.easings import easing

if TYPE_CHECKING:
    from reactive4d.signals.curves.curve import Curve

__all__ = ["inner_piece", "outer_piece"]

INF = math.inf


def inner_piece(curve: "Curve", i: int) -> Piece:
    """Piece i, from break i - 1 to break i."""
    lo, hi = curve.breaks[i - 1], curve.breaks[i]
    alike, span = curve.space.same, curve.rule.span
    if span is None:
        controls = _bspline_controls(curve, i)
        ease, clock = STEADY, None
    else:
        controls, clock = span(curve.line, i - 1)
        told = curve.keys[i - 1].ease
        ease = curve.ease if told is None else easing(told)
    if all(alike(controls[0], point) for point in controls[1:]):
        return Piece(lo, hi, controls[:1])
    return Piece(lo, hi, controls, None if ease is STEADY else ease, clock)


def _bspline_controls(curve: "Curve", i: int) -> tuple[Any, ...]:
    assert curve.knots is not None
    degree = curve.bspline_degree
    j = bisect_right(curve.knots, curve.breaks[i - 1]) - 1
    near = curve.values[j - degree : j + 1]
    if all(curve.space.same(near[0], value) for value in near):
        return near  # exactly: the controls would be rounded means of these
    controls = bsplines.piece_controls(curve.values, curve.knots, j, degree=degree)
    return (curve.values[0], *controls[1:]) if i == 1 else tuple(controls)


def outer_piece(curve: "Curve", i: int) -> Piece:
    """Piece 0, before the first break, or the one after the last."""
    is_first = i == 0
    lo, hi = (-INF, curve.breaks[0]) if is_first else (curve.breaks[-1], INF)
    mode = curve.before if is_first else curve.after
    end = curve.values[0 if is_first else -1]
    if mode == "hold" or len(curve.times) == 1:
        return Piece(lo, hi, (end,))
    if mode == "linear":
        velocity = _end_velocity(curve, is_first=is_first)
        is_moving = velocity.any() if isinstance(velocity, np.ndarray) else bool(velocity)
        return Piece(lo, hi, (end, velocity) if is_moving else (end,))
    # Keys that all stand still in one place repeat themselves everywhere.
    alike = curve.space.same
    inner = (curve.piece(k) for k in range(1, len(curve.breaks)))
    if alike(curve.values[0], curve.values[-1]) and all(p.is_held and alike(p.controls[0], end) for p in inner):
        return Piece(lo, hi, (end,))
    return Piece(lo, hi, ())


def _end_velocity(curve: "Curve", *, is_first: bool) -> Any:
    """Per second, at the first or last key, without ease."""
    piece = curve.piece(1 if is_first else len(curve.breaks) - 1)
    if piece.is_held:
        return 0.0
    controls = piece.controls if is_first else piece.controls[::-1]
    share = 1.0 / (len(controls) - 1)
    if piece.clock is not None:
        share = piece.clock[0] if is_first else 1.0 - piece.clock[1]
        if share == 0.0:  # no handle: straight to the other end
            controls, share = (controls[0], controls[-1]), 1.0
    vector = curve.space.difference(controls[0], controls[1])
    return (vector if is_first else -vector) / (share * (piece.hi - piece.lo))
