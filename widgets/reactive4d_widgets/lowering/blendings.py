"""Keys whose values are signals, as terms: over each piece a sum of these, with polynomials of time as weights."""

from collections.abc import Callable
from typing import Any

import numpy as np

from reactive4d.signals.colors import color, srgb_to_blended
from reactive4d.signals.curves.curve import Curve
from reactive4d.signals.curves.mixtures import Known, Mixture, Mixtures
from reactive4d.signals.curves.pieces import Piece
from reactive4d.signals.curves.spaces import Colors, Held, Numbers, Rotations, Space, Vectors
from reactive4d_widgets.lowering.bits import bits_of, joined
from reactive4d_widgets.lowering.foldings import passed
from reactive4d_widgets.lowering.paces import tree_of
from reactive4d_widgets.lowering.terms import (
    NUMBER,
    ROTATION,
    NotExactError,
    Term,
    applied,
    cases,
    constant,
    of_track,
    polynomials,
    track_of,
    written,
)

__all__ = ["blended_curve", "in_space"]

Lower = Callable[[Any], Term]


def blended_curve(curve: Curve, of: Lower) -> Term:
    """A curve some of whose values are signals.

    Args:
        curve: which one.
        of: lowers one of these signals.

    Raises:
        NotExactError: a signal that is not lowered; a curve that repeats itself; rotations with anything between them.
    """
    space = curve.space
    assert isinstance(space, Mixtures)
    inner = space.inner if space.inner is not None else _found(curve, of)
    count = len(curve.breaks)
    terms = [_outside(curve, 0, inner, of)]
    terms += [_inside(curve.piece(i), inner, of) for i in range(1, count)]
    terms.append(_outside(curve, count, inner, of))
    made = cases(curve.breaks, terms)
    if isinstance(inner, Colors):
        return of_track({"kind": "oklab", "track": track_of(made)}, (4,), made)
    return made


def _found(curve: Curve, of: Lower) -> Space:
    """The space that all of the signals' values live in."""
    shapes = {of(key.value).shape for key in curve.keys}
    if len(shapes) > 1:
        raise NotExactError("keys of signals of several shapes")
    shape = shapes.pop()
    if isinstance(shape, tuple):
        return Vectors(shape) if shape else Numbers()
    if shape == ROTATION:
        return Rotations()
    raise NotExactError("keys of signals of held values")


def in_space(term: Term, space: Space) -> Term:
    """A signal's values as points of a space.

    Raises:
        NotExactError: they do not belong there, or no track says where they are.
    """
    if isinstance(space, Colors):
        return _blended(term)
    if isinstance(space, Held):
        return term
    wanted = ROTATION if isinstance(space, Rotations) else space.shape if isinstance(space, Vectors) else NUMBER
    if term.shape != wanted:
        raise NotExactError(f"a value of shape {term.shape} among {space.kind}s")
    return term


def _blended(term: Term) -> Term:
    """A colour as a point of the space in which colours are blended."""
    if term.is_constant:
        return constant(srgb_to_blended(color(term.value)))
    track = track_of(term)
    if track["kind"] == "oklab":
        inner = track["track"]
        tree = inner["tree"] if inner["kind"] == "expr" else ["track", inner]
        return Term(tree, (4,), term.nodes, term.depth)
    if track["kind"] == "stepped":
        points = [srgb_to_blended(color(value)).tolist() for value in track["values"]]
        return of_track({**track, "values": points}, (4,))
    raise NotExactError("a colour that is no mixture of colours")


def _value(term: Any, space: Space, of: Lower) -> Term:
    if isinstance(term, Known):
        return constant(term.point)
    return in_space(of(term), space)


def _sum(parts: list[tuple[Term, Term]], space: Space) -> Term:
    """Values times their weights."""
    if len(parts) == 1 and parts[0][1].is_constant and parts[0][1].value == 1.0:
        return parts[0][0]
    if isinstance(space, Rotations | Held):
        raise NotExactError(f"{space.kind}s of which some are signals, with something between them")
    total: Term | None = None
    for value, weight in parts:
        scaled = applied("*", weight, value, shape=value.shape)
        total = scaled if total is None else applied("+", total, scaled, shape=value.shape)
    if total is None:
        raise NotExactError("a mixture of nothing")
    return total


def _inside(piece: Piece, space: Space, of: Lower) -> Term:
    """A piece between two breaks."""
    met: dict[Any, None] = {}
    for control in piece.controls:
        met.update(dict.fromkeys(control.terms))
    parts: list[tuple[Term, Term]] = []
    for term in met:
        weights = tuple([control.terms.get(term, 0.0) for control in piece.controls])
        parts.append((_value(term, space, of), _weight(piece._replace(controls=weights))))
    return _sum(parts, space)


def _weight(piece: Piece) -> Term:
    """How much a term counts, over one piece."""
    if len(set(piece.controls)) == 1:
        return constant(piece.controls[0])
    bits = bits_of(piece)
    if bits is not None:
        return joined(bits, shape=NUMBER)
    assert piece.ease is not None
    share = polynomials([piece.lo, piece.hi], np.array([[0.0, 1.0 / (piece.hi - piece.lo)]]))
    eased = applied("at", written(tree_of(piece.ease), NUMBER), share, shape=NUMBER)
    unit = bits_of(Piece(0.0, 1.0, piece.controls))
    assert unit is not None
    powers = unit[0].powers[:, 0].tolist()
    tree: Any = powers[-1]
    for power in powers[-2::-1]:
        tree = ["+", power, ["*", tree, ["time"]]]
    return applied("at", written(tree, NUMBER), eased, shape=NUMBER)


def _outside(curve: Curve, i: int, space: Space, of: Lower) -> Term:
    """Before the first break, or after the last."""
    piece = curve.piece(i)
    if not piece.controls:
        raise NotExactError("keys of signals that repeat themselves")
    end: Mixture = piece.controls[0]
    velocity: Mixture = piece.controls[1] if len(piece.controls) > 1 else Mixture({})
    seconds = passed(curve.times[0 if i == 0 else -1])
    parts: list[tuple[Term, Term]] = []
    for term in {**end.terms, **velocity.terms}:
        weight = constant(end.terms.get(term, 0.0))
        if term in velocity.terms:
            moving = applied("*", constant(velocity.terms[term]), seconds, shape=NUMBER)
            weight = applied("+", weight, moving, shape=NUMBER)
        parts.append((_value(term, space, of), weight))
    return _sum(parts, space)
