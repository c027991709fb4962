"""The simplest of what trees are made of: number by number, several numbers as an array, some of them, one of two.

Arrays are flat in trees, so the shapes that NumPy would take are worked out here, and what it would broadcast otherwise
than number by number is refused.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from reactive4d_widgets.lowering.terms import NUMBER, NotExactError, Shape, Term, applied, component, constant

__all__ = ["choose", "common", "gather", "number_by_number", "vector"]


def number_by_number(operator: str, *parts: Term) -> Term:
    """An operator of trees that works on each number of an array alone."""
    return applied(operator, *parts, shape=common(parts))


def common(parts: Sequence[Term]) -> Shape:
    """The shape of what is made number by number."""
    shapes = {part.shape for part in parts if part.shape != NUMBER}
    if any(isinstance(shape, str) for shape in shapes) or len(shapes) > 1:
        raise NotExactError(f"shapes {shapes} together")
    return shapes.pop() if shapes else NUMBER


def vector(parts: Sequence[Term]) -> Term:
    """Numbers as an array."""
    if all(part.is_constant for part in parts):
        return constant(np.array([part.value for part in parts], dtype=np.float64))
    if any(part.shape != NUMBER for part in parts):
        raise NotExactError("vec of what is no number")
    return applied("vec", *parts, shape=(len(parts),))


def gather(part: Term, index: Any) -> Term:
    """A component, or several, as NumPy's indexing takes them."""
    if part.is_constant:
        return constant(part.value[index])
    if not part.is_array:
        raise NotExactError("a component of what is no array")
    try:
        places: Any = _numbered(part)[index]
    except IndexError:
        raise NotExactError(f"no component {index!r}") from None
    if np.ndim(places) == 0:
        return component(part, int(places))
    if places.shape == part.shape and (places.ravel() == np.arange(part.width)).all():
        return part
    made = vector([component(part, int(i)) for i in places.ravel()])
    return Term(made.tree, places.shape, made.nodes, made.depth, made.value)


def _numbered(part: Term) -> Any:
    """The places of its numbers in the flat array."""
    places: Any = np.arange(part.width)
    return places.reshape(part.shape)


def choose(condition: Term, yes: Term, no: Term) -> Term:
    """One of two, as a condition says."""
    if condition.is_constant and condition.shape == NUMBER:
        return yes if condition.value else no
    if condition.shape != NUMBER:
        return applied("where", condition, yes, no, shape=common((condition, yes, no)))
    if yes.shape != no.shape:
        raise NotExactError("where of different shapes")
    return applied("where", condition, yes, no, shape=yes.shape)
