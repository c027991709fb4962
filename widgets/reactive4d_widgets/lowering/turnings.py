"""Keys of rotations as terms: turns from key to key on the shortest way, at the pace that their eases tell."""

from collections.abc import Sequence
from itertools import groupby
from typing import Any, Final

import numpy as np

from reactive4d.signals.curves.curve import Curve
from reactive4d.signals.curves.pieces import Piece
from reactive4d.signals.rotations import Rotation, multiply_quaternions
from reactive4d_widgets.lowering.foldings import extended, passed
from reactive4d_widgets.lowering.numerals import Array, fine
from reactive4d_widgets.lowering.paces import arches, overshoots, tree_of
from reactive4d_widgets.lowering.terms import (
    NUMBER,
    ROTATION,
    NotExactError,
    Term,
    Track,
    applied,
    cases,
    constant,
    of_track,
    polynomials,
    written,
)

__all__ = ["turning_curve"]

_LINEAR: Final = (0.0, 1.0)


def turning_curve(curve: Curve) -> Term:
    """A curve of rotations whose pieces are arcs.

    Raises:
        NotExactError: a piece is no arc, or its ease is a function of Python's.
    """
    values = curve.values
    if len(values) == 1:
        return constant(values[0])
    pieces = [curve.piece(i) for i in range(1, len(curve.breaks))]
    if any(len(piece.controls) > 2 or piece.clock is not None for piece in pieces):
        raise NotExactError("a smooth curve of rotations")
    groups = [(key, list(group)) for key, group in groupby(pieces, key=_kind_of)]
    if len(groups) == 1 and groups[0][0] == "":
        return _extended(curve, _arcs(pieces, values[-1]))
    borders: list[float] = [pieces[0].lo]
    terms: list[Term] = [constant(values[0])]
    for kind, group in groups:
        for bunch in [group] if kind == "" else [[piece] for piece in group]:
            found = [(bunch[-1].hi, _arcs(bunch, None))] if kind == "" else _single(bunch[0])
            borders += [hi for hi, _ in found]
            terms += [term for _, term in found]
    return _extended(curve, cases(borders, [*terms, constant(values[-1])]))


def _extended(curve: Curve, inner: Term) -> Term:
    return extended(curve, inner, _ray, None)


def _kind_of(piece: Piece) -> str:
    """Empty where the share of the arc is one cubic, else the name of the ease."""
    return "" if piece.ease is None or _fraction(piece) is not None else piece.ease.name


def _fraction(piece: Piece) -> tuple[float, ...] | None:
    found = _LINEAR if piece.ease is None else None
    if piece.ease is not None:
        arched = arches(piece.ease)
        if arched is not None and len(arched) == 1 and len(arched[0].powers) <= 4:
            found = arched[0].powers
    if found is None:
        return None
    length = piece.hi - piece.lo
    return tuple(power / length**j for j, power in enumerate(found))


def _arcs(pieces: Sequence[Piece], end: Rotation | None) -> Term:
    """Neighbouring arcs as one track."""
    last = pieces[-1].controls[-1] if end is None else end
    fractions = [_fraction(piece) or _LINEAR for piece in pieces]
    is_plain = all(piece.ease is None and not piece.is_held for piece in pieces)
    # What is held does not turn, wherever the next piece begins.
    rows = [
        [0.0] * 4 if piece.is_held else [*row, *[0.0] * (4 - len(row))]
        for piece, row in zip(pieces, fractions, strict=True)
    ]
    times = [*[piece.lo for piece in pieces], pieces[-1].hi]
    turns = [*[piece.controls[0] for piece in pieces], last]
    return _slerp(times, turns, None if is_plain else rows)


def _slerp(times: Sequence[float], turns: Sequence[Rotation], fractions: Any) -> Term:
    track: Track = {
        "kind": "slerp",
        "times": fine(times),
        "rotations": fine(np.array([turn.as_quaternion() for turn in turns])),
        "fractions": None if fractions is None else fine(np.array(fractions)),
    }
    return of_track(track, ROTATION)


def _single(piece: Piece) -> list[tuple[float, Term]]:
    """An arc whose ease is no cubic: until when, and as what."""
    ease, length = piece.ease, piece.hi - piece.lo
    assert ease is not None
    arched = arches(ease)
    if arched is not None and all(len(arch.powers) <= 4 for arch in arched):
        found: list[tuple[float, Term]] = []
        for arch in arched:
            row = [power / length**j for j, power in enumerate(arch.powers)]
            hi = piece.hi if arch.stop == 1.0 else piece.lo + length * arch.stop
            term = _slerp([piece.lo, piece.hi], piece.controls, [[*row, *[0.0] * (4 - len(row))]])
            found.append((hi, term))
        return found
    share = polynomials([piece.lo, piece.hi], np.array([[0.0, 1.0 / length]]))
    eased = applied("at", written(tree_of(ease), NUMBER), share, shape=NUMBER)
    # Where the share leaves the arc, so does the turn: the track reaches from -1 to 2.
    wide = [-1.0, 2.0] if overshoots(ease) else [0.0, 1.0]
    fractions = [[-1.0, 1.0, 0.0, 0.0]] if overshoots(ease) else None
    return [(piece.hi, applied("at", _slerp(wide, piece.controls, fractions), eased, shape=ROTATION))]


def _ray(controls: Sequence[Any], origin: float) -> Term:
    """Turning on about a fixed axis: cos(h) q + sin(h) (axis q), where h is half the angle."""
    end: Array = controls[0].as_quaternion()
    velocity: Array = controls[1]
    rate = float(np.linalg.norm(velocity))
    across = multiply_quaternions(np.array([0.0, *(velocity / rate)]), end)
    half = applied("*", constant(0.5 * rate), passed(origin), shape=NUMBER)
    parts = [
        applied("*", constant(q), applied(name, half, shape=NUMBER), shape=(4,))
        for name, q in (("cos", end), ("sin", across))
    ]
    return applied("+", *parts, shape=ROTATION)
