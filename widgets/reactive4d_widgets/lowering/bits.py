"""Pieces of curves as polynomials of seconds: what a track of kind `poly` is made of."""

from collections.abc import Sequence
from functools import cache
from itertools import pairwise
from math import comb
from typing import Any, NamedTuple

import numpy as np

from reactive4d.signals.curves import clocks
from reactive4d.signals.curves.pieces import Piece
from reactive4d.signals.easings import Easing
from reactive4d_widgets.lowering.numerals import Array
from reactive4d_widgets.lowering.paces import arches
from reactive4d_widgets.lowering.terms import NotExactError, Shape, Term, polynomials

__all__ = ["Bit", "bits_of", "is_low", "joined", "powers_of"]

MOST_DEGREE = 3
_EVEN = 1e-15  # how far handles in time may be from those that leave it alone


class Bit(NamedTuple):
    """A polynomial over [lo, hi): `powers` (degree + 1, c) are the factors of the powers of t - lo."""

    lo: float
    hi: float
    powers: Array


def powers_of(controls: Sequence[Any]) -> Array:
    """(p + 1, c) the factors of the powers of u of a polynomial in Bernstein form.

    >>> powers_of([1.0, 1.0, 4.0]).ravel().tolist()
    [1.0, 0.0, 3.0]
    """
    table: Array = np.array(controls, dtype=np.float64).reshape(len(controls), -1)
    with np.errstate(over="ignore", invalid="ignore"):
        powers: Array = _from_bernstein(len(controls) - 1) @ table
    powers[0] = table[0]
    return powers


@cache
def _from_bernstein(p: int) -> Array:
    """(p + 1, p + 1) the matrix that makes powers of controls."""
    return np.array([[(-1.0) ** (j - i) * comb(p, j) * comb(j, i) for i in range(p + 1)] for j in range(p + 1)])


def is_low(piece: Piece) -> bool:
    """Whether a piece is made of polynomials of degree 3 at most, its ease included.

    Raises:
        NotExactError: time runs through it as handles tell, or it is of a higher degree.
    """
    if piece.clock is not None and max(abs(a - b) for a, b in zip(piece.clock, clocks.EVEN, strict=True)) > _EVEN:
        raise NotExactError("handles in time")
    if len(piece.controls) > MOST_DEGREE + 1:
        raise NotExactError("a B-spline of a high degree")
    if piece.ease is None:
        return True
    found = arches(piece.ease)
    degree = len(piece.controls) - 1
    return found is not None and all(degree * (len(arch.powers) - 1) <= MOST_DEGREE for arch in found)


def bits_of(piece: Piece) -> list[Bit] | None:
    """A piece as polynomials of degree 3 at most; None where its ease makes it more than that.

    Raises:
        NotExactError: as `is_low`.
    """
    if not is_low(piece):
        return None
    length = piece.hi - piece.lo
    powers = powers_of(piece.controls)
    if piece.ease is None:
        return [Bit(piece.lo, piece.hi, _slowed(powers, length))]
    bits: list[Bit] = []
    for start, stop, matrix in _eased(piece.ease, len(powers) - 1):
        lo = piece.lo if start == 0.0 else piece.lo + length * start
        hi = piece.hi if stop == 1.0 else piece.lo + length * stop
        bits.append(Bit(lo, hi, _slowed(matrix @ powers, length)))
    # At its start a piece is its first control, to the last bit.
    bits[0].powers[0] = powers[0]
    return bits


@cache
def _eased(ease: Easing, degree: int) -> tuple[tuple[float, float, Array], ...]:
    """For each arch of an ease its span, and the matrix that makes powers, counted from its start, of powers of it."""
    found: list[tuple[float, float, Array]] = []
    for arch in arches(ease) or ():
        moved: Any = np.polynomial.Polynomial([arch.start, 1.0])
        eased: Any = np.polynomial.Polynomial(arch.powers)(moved)
        columns = [(eased**j).coef for j in range(degree + 1)]
        width = (len(arch.powers) - 1) * degree + 1
        matrix = np.array([np.pad(column, (0, width - len(column))) for column in columns], dtype=np.float64).T
        found.append((arch.start, arch.stop, matrix))
    return tuple(found)


def _slowed(powers: Array, length: float) -> Array:
    """From powers of the share to powers of seconds."""
    with np.errstate(over="ignore", invalid="ignore"):
        return powers / (length ** np.arange(len(powers)))[:, None]


def joined(bits: Sequence[Bit], *, shape: Shape, end: Any = None) -> Term:
    """Neighbouring polynomials as one term.

    Args:
        bits: each begins where the one before ends.
        shape: of the values.
        end: what it is at the last border.
    """
    assert all(a.hi == b.lo for a, b in pairwise(bits))
    degree = max(_degree(bit.powers) for bit in bits)
    width = bits[0].powers.shape[1]
    table = np.zeros((len(bits), degree + 1, width))
    for row, bit in zip(table, bits, strict=True):
        used = min(len(bit.powers), degree + 1)
        row[:used] = bit.powers[:used]
    return polynomials([*[bit.lo for bit in bits], bits[-1].hi], table, end=end, shape=shape)


def _degree(powers: Array) -> int:
    """The highest power that counts."""
    return max([j for j, row in enumerate(powers) if row.any()], default=0)
