"""Derivatives and integrals of keys as terms, and derivatives of what nothing is known of but its values."""

import math
from itertools import pairwise
from typing import Any, Final

import numpy as np

from reactive4d.signals.curves.curve import Curve
from reactive4d.signals.curves.pieces import Piece
from reactive4d_widgets.lowering.bits import Bit, bits_of, joined
from reactive4d_widgets.lowering.foldings import passed
from reactive4d_widgets.lowering.numerals import Array
from reactive4d_widgets.lowering.terms import (
    NUMBER,
    NotExactError,
    Shape,
    Term,
    applied,
    cases,
    constant,
    polynomials,
    written,
)

__all__ = ["area", "difference", "slope"]

_TIME: Final = ["time"]
_STEP: Final = 2.0**-10  # as `signals.numerical` has it
_MOST_DEGREE: Final = 3


def slope(curve: Curve, order: int) -> Term:
    """The derivative of keys of numbers or vectors, of some order.

    Raises:
        NotExactError: an ease that is no polynomial of a low degree; keys that run to and fro.
    """
    shape, pieces = _checked(curve)
    if len(curve.times) == 1:
        return _zero(curve)
    if order > 1 and any(piece.ease is not None for piece in pieces):
        raise NotExactError("a derivative of a higher order with an ease")
    bits = [Bit(bit.lo, bit.hi, _derived(bit.powers, order)) for bit in _bits(pieces)]
    inner = joined(bits, shape=shape)
    first, last = curve.times[0], curve.times[-1]
    modes = {"<": curve.before, ">=": curve.after}
    for mode, i in ((curve.before, 0), (curve.after, len(curve.breaks))):
        if mode == "oscillate" and not curve.piece(i).controls:
            raise NotExactError("the derivative of keys that run to and fro")
    folds = {side: mode for side, mode in modes.items() if mode in ("cycle", "cycle_offset")}
    if folds:
        fold = ["min", ["+", first, ["%", ["-", _TIME, first], last - first]], math.nextafter(last, -math.inf)]
        tree: Any = _TIME
        for side in folds:
            tree = ["where", [side, _TIME, first if side == "<" else last], fold, tree]
        inner = applied("at", inner, written(tree, NUMBER), shape=shape)
    before = None if "<" in folds else _outer_slope(curve, 0, order)
    after = None if ">=" in folds else _outer_slope(curve, len(curve.breaks), order)
    borders = [t for t, term in ((first, before), (last, after)) if term is not None]
    return cases(borders, [term for term in (before, inner, after) if term is not None])


def _checked(curve: Curve) -> tuple[Shape, list[Piece]]:
    if curve.is_live or curve.space.kind not in ("number", "vector"):
        raise NotExactError(f"the derivative of keys of kind {curve.space.kind}")
    shape: Shape = NUMBER if curve.space.kind == "number" else np.shape(curve.values[0])
    return shape, [curve.piece(i) for i in range(1, len(curve.breaks))]


def _bits(pieces: list[Piece]) -> list[Bit]:
    found: list[Bit] = []
    for piece in pieces:
        bits = bits_of(piece)
        if bits is None:
            raise NotExactError("the derivative or the integral of an ease")
        found += bits
    return found


def _zero(curve: Curve) -> Term:
    return constant(np.zeros_like(curve.values[0]) if curve.space.kind == "vector" else 0.0)


def _derived(powers: Array, order: int) -> Array:
    for _ in range(order):
        powers = powers[1:] * np.arange(1, len(powers))[:, None] if len(powers) > 1 else powers * 0.0
    return powers


def _outer_slope(curve: Curve, i: int, order: int) -> Term:
    piece = curve.piece(i)
    if piece.is_held or order > 1:
        return _zero(curve)
    velocity = piece.controls[1]
    return constant(np.asarray(velocity) if np.ndim(velocity) else float(velocity))


def area(curve: Curve, start: float) -> Term:
    """The integral of keys of numbers or vectors from a start.

    Raises:
        NotExactError: an ease that is no polynomial of a low degree; keys that repeat themselves.
    """
    from reactive4d.signals.curves.areas import Area

    shape, pieces = _checked(curve)
    known = Area(curve, start)
    first, last, count = curve.times[0], curve.times[-1], len(curve.breaks)
    outer = [curve.piece(0), curve.piece(count)]
    if any(not piece.controls for piece in outer):
        raise NotExactError("the integral of keys that repeat themselves")
    width = 1 if shape == NUMBER else int(np.prod(np.shape(curve.values[0])))
    total = np.reshape(known.sums[0] - known.base, width).astype(np.float64)
    bits: list[Bit] = []
    for bit in _bits(pieces):
        powers = np.vstack([total, bit.powers / np.arange(1, len(bit.powers) + 1)[:, None]])
        bits.append(Bit(bit.lo, bit.hi, powers))
        total = sum(row * (bit.hi - bit.lo) ** j for j, row in enumerate(powers))
    parts = [_outer_area(outer[0], first, known.sums[0] - known.base, shape)]
    parts += [_high(bits, shape)] if bits else []
    parts.append(_outer_area(outer[1], last, known.sums[-1] - known.base, shape))
    return cases([first, last] if bits else [first], parts)


def _outer_area(piece: Piece, origin: float, so_far: Any, shape: Shape) -> Term:
    """A straight ray, or the parabola above one."""
    seconds = passed(origin)
    height = _value(piece.controls[0])
    if not piece.is_held:
        rise = applied("*", _value(np.multiply(0.5, piece.controls[1])), seconds, shape=shape)
        height = applied("+", height, rise, shape=shape)
    return applied("+", _value(so_far), applied("*", height, seconds, shape=shape), shape=shape)


def _value(x: Any) -> Term:
    return constant(np.asarray(x) if np.ndim(x) else float(x))


def _high(bits: list[Bit], shape: Shape) -> Term:
    """Polynomials of any degree: the low powers, and the fourth power times the high ones."""
    if max(len(bit.powers) for bit in bits) <= _MOST_DEGREE + 1:
        return joined(bits, shape=shape)
    low = joined([Bit(bit.lo, bit.hi, bit.powers[:4]) for bit in bits], shape=shape)
    nothing = np.zeros((1, bits[0].powers.shape[1]))
    high = _high([Bit(bit.lo, bit.hi, bit.powers[4:] if len(bit.powers) > 4 else nothing) for bit in bits], shape)
    times = [*[bit.lo for bit in bits], bits[-1].hi]
    seconds = polynomials(times, np.array([[0.0, 1.0] for _ in pairwise(times)]))
    fourth = applied("**", seconds, constant(4.0), shape=NUMBER)
    return applied("+", low, applied("*", fourth, high, shape=shape), shape=shape)


def difference(term: Term) -> Term:
    """The derivative by the five-point stencil that the engine itself takes of what it does not know better."""
    if not isinstance(term.shape, tuple):
        raise NotExactError("the derivative of what is no number")
    shape = term.shape
    if term.is_constant:
        return _value(np.multiply(0.0, term.value))

    def at(offset: float) -> Term:
        return applied("at", term, written(["+", _TIME, offset], NUMBER), shape=shape)

    near = applied("*", constant(8.0), applied("-", at(_STEP), at(-_STEP), shape=shape), shape=shape)
    far = applied("-", at(2.0 * _STEP), at(-2.0 * _STEP), shape=shape)
    return applied("/", applied("-", near, far, shape=shape), constant(12.0 * _STEP), shape=shape)
