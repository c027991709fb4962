"""Arithmetic with terms of space, in which what is known is worked out and what adds nothing is left out."""

from typing import Any

import numpy as np

from reactive4d_widgets.lowering.elementary import vector
from reactive4d_widgets.lowering.terms import NUMBER, ROTATION, NotExactError, Term, applied, component, constant

__all__ = ["carried", "cross", "dot", "is_zero", "minus", "orienting", "plus", "rotating", "times"]

SPACE = (3,)


def is_zero(term: Term) -> bool:
    """Whether a term is surely zero."""
    return term.is_constant and not np.any(term.value)


def _shape(a: Term, b: Term) -> Any:
    return a.shape if a.shape != NUMBER else b.shape


def plus(a: Term, b: Term) -> Term:
    """A sum."""
    if a.is_constant and b.is_constant:
        return constant(np.add(a.value, b.value))
    return b if is_zero(a) else a if is_zero(b) else applied("+", a, b, shape=_shape(a, b))


def minus(a: Term, b: Term) -> Term:
    """A difference."""
    if a.is_constant and b.is_constant:
        return constant(np.subtract(a.value, b.value))
    return a if is_zero(b) else applied("-", a, b, shape=_shape(a, b))


def times(a: Term, b: Term) -> Term:
    """A product, number by number."""
    if a.is_constant and b.is_constant:
        return constant(np.multiply(a.value, b.value))
    for one, other in ((a, b), (b, a)):
        if is_zero(one):
            return constant(np.zeros(_shape(a, b))) if _shape(a, b) else constant(0.0)
        if one.is_constant and np.all(np.equal(one.value, 1.0)) and one.shape in (NUMBER, other.shape):
            return other
    return applied("*", a, b, shape=_shape(a, b))


def cross(a: Term, b: Term) -> Term:
    """The vector product."""
    if a.is_constant and b.is_constant:
        return constant(np.cross(a.value, b.value))
    return constant(np.zeros(3)) if is_zero(a) or is_zero(b) else applied("cross", a, b, shape=SPACE)


def dot(a: Term, b: Term) -> Term:
    """The scalar product."""
    if a.is_constant and b.is_constant:
        return constant(float(np.dot(a.value, b.value)))
    return constant(0.0) if is_zero(a) or is_zero(b) else applied("dot", a, b, shape=NUMBER)


def carried(matrix: Any, point: Term) -> Term:
    """A point carried along by a known matrix (4, 4)."""
    linear, offset = np.asarray(matrix)[:3, :3], np.asarray(matrix)[:3, 3]
    if point.is_constant:
        return constant(linear @ point.value + offset)
    rows = [plus(dot(constant(row), point), constant(float(x))) for row, x in zip(linear, offset, strict=True)]
    return vector(rows)


def rotating(angle: Term, axis: Any, arm: Term) -> Term:
    """An arm turned by degrees about a known unit axis."""
    if is_zero(arm):
        return arm
    n = constant(np.asarray(axis, dtype=np.float64))
    half = applied("radians", angle, shape=NUMBER)
    cosine, sine = applied("cos", half, shape=NUMBER), applied("sin", half, shape=NUMBER)
    along = times(dot(n, arm), n)
    across = minus(arm, along)
    turned = plus(times(cosine, across), times(sine, cross(n, arm)))
    return plus(turned, along)


def orienting(rotation: Term, arm: Term) -> Term:
    """An arm turned by a unit quaternion."""
    if is_zero(arm):
        return arm
    if rotation.shape != ROTATION:
        raise NotExactError("a rotation that is none")
    if rotation.is_constant:
        return carried(np.pad(rotation.value.as_matrix(), (0, 1)), arm)
    w = component(rotation, 0)
    q = vector([component(rotation, i) for i in (1, 2, 3)])
    once = cross(q, arm)
    return plus(arm, times(constant(2.0), plus(times(w, once), cross(q, once))))
