"""Pieces of curves as polynomials of seconds: what a track of kind `poly` is made of."""

from collections.abc import Sequence
from itertools import pairwise
from math import comb
from typing import Any, NamedTuple

import numpy as np

from reactive4d.signals.curves import clocks
from reactive4d.signals.curves.pieces import Piece
from reactive4d_widgets.lowering.numerals import Array
from reactive4d_widgets.lowering.paces import arches
from reactive4d_widgets.lowering.terms import NotExactError, Shape, Term, polynomials

__all__ = ["Bit", "bits_of", "joined", "powers_of"]

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
    p = len(controls) - 1
    rows: list[Array] = []
    with np.errstate(over="ignore", invalid="ignore"):
        for j in range(p + 1):
            row = sum((-1.0) ** (j - i) * comb(j, i) * table[i] for i in range(j + 1))
            rows.append(comb(p, j) * np.asarray(row))
    return np.array(rows)


def bits_of(piece: Piece) -> list[Bit] | None:
    """A piece as polynomials of degree 3 at most; None where its ease makes it more than that.

    Raises:
        NotExactError: time runs through it as handles tell, or it is of a higher degree.
    """
    if piece.clock is not None and max(abs(a - b) for a, b in zip(piece.clock, clocks.EVEN, strict=True)) > _EVEN:
        raise NotExactError("handles in time")
    if len(piece.controls) > MOST_DEGREE + 1:
        raise NotExactError("a B-spline of a high degree")
    length = piece.hi - piece.lo
    powers = powers_of(piece.controls)
    if piece.ease is None:
        return [Bit(piece.lo, piece.hi, _slowed(powers, length))]
    found = arches(piece.ease)
    if found is None or any((len(powers) - 1) * (len(arch.powers) - 1) > MOST_DEGREE for arch in found):
        return None
    bits: list[Bit] = []
    for arch in found:
        start = np.polynomial.Polynomial([arch.start, 1.0])
        eased = np.polynomial.Polynomial(arch.powers)(start)
        columns = [np.polynomial.Polynomial(column)(eased).coef for column in powers.T]
        width = max(len(column) for column in columns)
        table: Array = np.array([np.pad(column, (0, width - len(column))) for column in columns], dtype=np.float64).T
        lo = piece.lo if arch.start == 0.0 else piece.lo + length * arch.start
        hi = piece.hi if arch.stop == 1.0 else piece.lo + length * arch.stop
        bits.append(Bit(lo, hi, _slowed(table, length)))
    # At its start a piece is its first control, to the last bit.
    bits[0].powers[0] = powers[0]
    return bits


def _slowed(powers: Array, length: float) -> Array:
    """From powers of the share to powers of seconds."""
    with np.errstate(over="ignore", invalid="ignore"):
        return np.array([row / length**j for j, row in enumerate(powers)])


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
