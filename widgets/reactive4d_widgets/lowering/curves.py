"""Keys of known values as terms: numbers, vectors, colours; rotations and held values have modules of their own.

What is a polynomial of degree 3 at most, ease included, goes as one. Other named eases go as a tree: the time runs
through the keys at the pace that the ease tells, and what lies between them is a polynomial of that time.
"""

from collections.abc import Sequence
from itertools import groupby, pairwise
from typing import Any, Final

import numpy as np

from reactive4d.signals.curves.curve import Curve
from reactive4d.signals.curves.pieces import Piece
from reactive4d.signals.curves.spaces import Colors
from reactive4d_widgets.lowering.bits import bits_of, is_low, joined, powers_of
from reactive4d_widgets.lowering.foldings import extended, passed
from reactive4d_widgets.lowering.holding import held_curve
from reactive4d_widgets.lowering.paces import overshoots, tree_of
from reactive4d_widgets.lowering.terms import (
    NUMBER,
    Shape,
    Term,
    applied,
    cases,
    constant,
    of_track,
    polynomials,
    track_of,
    written,
)
from reactive4d_widgets.lowering.turnings import turning_curve

__all__ = ["curve_term", "flowing", "paced_time"]

_TIME: Final = ["time"]


def curve_term(curve: Curve) -> Term:
    """A curve whose values are all known.

    Raises:
        NotExactError: time runs as handles tell, the ease is a function of Python's, or the degree is above 3.

    >>> curve_term(Curve({0: 0.0, 2: 3.0})).tree[1]["coefficients"]
    [0.0, 1.5]
    """
    if curve.space.kind == "held":
        return held_curve(curve)
    if curve.space.kind == "rotation":
        return turning_curve(curve)
    if isinstance(curve.space, Colors):
        return _color_curve(curve)
    shape: Shape = NUMBER if curve.space.kind == "number" else np.shape(curve.values[0])
    return _extended(curve, flowing(curve, shape), shape)


def _extended(curve: Curve, inner: Term, shape: Shape) -> Term:
    def ray(controls: Sequence[Any], origin: float) -> Term:
        end, velocity = (_flat(x) for x in controls)
        return applied("+", end, applied("*", velocity, passed(origin), shape=shape), shape=shape)

    def climb(term: Term, cycles: Term) -> Term:
        return applied("+", term, applied("*", _flat(curve.cycle_offset()), cycles, shape=shape), shape=shape)

    return extended(curve, inner, ray, climb)


def _flat(value: Any) -> Term:
    return constant(np.asarray(value) if np.ndim(value) else float(value))


def _color_curve(curve: Curve) -> Term:
    if len(curve.times) == 1:
        return constant(curve.answer(curve.values[0]))
    if all(curve.piece(i).is_held for i in range(1, len(curve.breaks))):
        return held_curve(curve)
    blended = extended(curve, flowing(curve, (4,)), lambda controls, origin: constant(0.0), None)
    return of_track({"kind": "oklab", "track": track_of(blended)}, (4,), blended)


def flowing(curve: Curve, shape: Shape) -> Term:
    """A curve of numbers between its keys, as points of its space; outside it holds what it is there."""
    end = curve.values[-1]
    if len(curve.times) == 1:
        return constant(end)
    pieces = [curve.piece(i) for i in range(1, len(curve.breaks))]
    kinds = [_kind_of(piece) for piece in pieces]
    runs = [(kind, [piece for _, piece in group]) for kind, group in _grouped(kinds, pieces)]
    if len(runs) == 1 and runs[0][0] is None:
        return _polynomial(pieces, shape, end)
    parts = [_polynomial(run, shape, None) if kind is None else _paced(run, shape) for kind, run in runs]
    first = constant(curve.values[0])
    return cases([runs[0][1][0].lo, *[run[-1].hi for _, run in runs]], [first, *parts, constant(end)])


def _grouped(kinds: list[Any], pieces: list[Piece]) -> Any:
    pairs = list(zip(kinds, pieces, strict=True))
    return [(key, list(group)) for key, group in groupby(pairs, key=lambda pair: pair[0])]


def _kind_of(piece: Piece) -> str | None:
    """None where a piece is a polynomial of a low degree, else the name of its ease."""
    if is_low(piece):
        return None
    assert piece.ease is not None
    return piece.ease.name


def _polynomial(pieces: list[Piece], shape: Shape, end: Any) -> Term:
    return joined([bit for piece in pieces for bit in bits_of(piece) or ()], shape=shape, end=end)


def _paced(pieces: list[Piece], shape: Shape) -> Term:
    """Pieces that share an ease which no polynomial of a low degree says."""
    degree = max(len(piece.controls) for piece in pieces) - 1
    table = np.zeros((len(pieces), degree + 1, powers_of(pieces[0].controls).shape[1]))
    for row, piece in zip(table, pieces, strict=True):
        powers = powers_of(piece.controls)
        row[: len(powers)] = powers
    assert pieces[0].ease is not None
    if overshoots(pieces[0].ease):
        return _horner(pieces, table, shape)
    counted = polynomials([float(k) for k in range(len(pieces) + 1)], table, shape=shape)
    return applied("at", counted, paced_time(pieces), shape=shape)


def paced_time(pieces: Sequence[Piece]) -> Term:
    """The number of the piece, and the eased share of it that has passed; between 0 and how many there are."""
    ease = pieces[0].ease
    assert ease is not None
    pace = written(["+", ["floor", _TIME], ["at", tree_of(ease), ["%", _TIME, 1]]], NUMBER)
    return applied("at", pace, _shares(pieces, counted=True), shape=NUMBER)


def _shares(pieces: Sequence[Piece], *, counted: bool) -> Term:
    """The share of its piece that has passed, plus the number of the piece if that is wanted."""
    times = [*[piece.lo for piece in pieces], pieces[-1].hi]
    rows = [[float(k if counted else 0), 1.0 / (b - a)] for k, (a, b) in enumerate(pairwise(times))]
    return polynomials(times, np.array(rows))


def _horner(pieces: list[Piece], table: Any, shape: Shape) -> Term:
    """The polynomial of an eased share that leaves its piece: the factors are constants over each piece."""
    ease = pieces[0].ease
    assert ease is not None
    times = [*[piece.lo for piece in pieces], pieces[-1].hi]
    share = applied("at", written(tree_of(ease), NUMBER), _shares(pieces, counted=False), shape=NUMBER)
    factors = [polynomials(times, table[:, j : j + 1], shape=shape) for j in range(table.shape[1])]
    total = factors[-1]
    for factor in factors[-2::-1]:
        total = applied("+", factor, applied("*", total, share, shape=shape), shape=shape)
    return total
