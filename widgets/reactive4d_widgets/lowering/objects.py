"""What objects answer, as terms: their matrix as a product of factors, their position, their paint, whether they show.

The list of changes must be the same at all times, or at least from one time to the next; then each of these times has
its own product.
"""

from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np

from reactive4d.geometry.transforms import direction
from reactive4d.model.colorings import Color, Opacity, Shade, Texture
from reactive4d.model.lanes import Gated, Item, entry_of
from reactive4d.model.objects import Object
from reactive4d.signals.facade import Signal
from reactive4d_widgets.lowering.elementary import choose
from reactive4d_widgets.lowering.playing import play
from reactive4d_widgets.lowering.products import Factor, factors_of, product_track
from reactive4d_widgets.lowering.signals import ChannelRule, Lowering
from reactive4d_widgets.lowering.standings import Standing, standings
from reactive4d_widgets.lowering.terms import (
    NUMBER,
    NotExactError,
    Term,
    applied,
    cases,
    component,
    constant,
    of_track,
)
from reactive4d_widgets.lowering.vectors import carried, is_zero, minus, orienting, plus, rotating, times

__all__ = ["CHANNELS", "composed", "lists", "matrix_term", "paint_term", "position_term", "visible_term"]

_COLORINGS: Final[dict[type, str]] = {Color: "value", Opacity: "value", Shade: "surface_color"}
MATRIX: Final = (4, 4)
SPACE: Final = (3,)
# From an object and its run to its factors.
Compose = Callable[[Any, Any], list[Factor]]


def lists(obj: Object, lowering: Lowering) -> list[Standing]:
    """The runs of transforms after the last deformation of an object, each with the times over which it acts."""
    found = standings(obj.run, lowering.parameters)
    return [one._replace(value=None if one.value is None else one.value.run) for one in found]


def exact_factors(obj: Object, run: Signal[Any] | None, lowering: Lowering) -> list[Factor]:
    """The factors of a run, all of them exact."""

    def opaque(signal: Signal[Any]) -> Factor:
        term = lowering.of(signal)
        if term.shape != MATRIX:
            raise NotExactError(f"{signal.name}: no matrix")
        return Factor("matrix", {"matrix": term})

    def linked(other: Object) -> list[Factor]:
        found = lists(other, lowering)
        if len(found) > 1:
            raise NotExactError(f"{other.name}: transforms that act for a while only")
        return exact_factors(other, found[0].value, lowering)

    return factors_of(
        run,
        table=table_of(obj, lowering),
        leaf=lambda setting, content, measure: lowering.content(setting, content),
        opaque=opaque,
        linked=linked,
    )


def table_of(obj: Object, lowering: Lowering) -> Any:
    """How the object's kind understands transforms."""
    forms = standings(obj.form, lowering.parameters)
    tables = {id(one.value.base.kind): one.value.base.kind.kind_table for one in forms}
    if len(tables) > 1:
        raise NotExactError(f"{obj.name}: several kinds")
    return next(iter(tables.values()))


def composed(factors: Sequence[Factor]) -> Term:
    """Factors as one matrix."""
    track = product_track(factors)
    if all(factor.is_constant for factor in factors):
        return constant(np.reshape(play(track, 0.0), MATRIX))
    return of_track(track, MATRIX, *[part for factor in factors for part in factor.parts])


def matrix_term(obj: Object, lowering: Lowering, above: Sequence[Object] = ()) -> Term:
    """The matrix of an object within the groups above it, the innermost first.

    Raises:
        NotExactError: a setting of a transform that is not lowered, or lists that vary in a way that nobody can tell.
    """
    members = (obj, *above)
    return over_times(
        [lists(one, lowering) for one in members],
        lambda runs: composed(
            flattened([exact_factors(one, run, lowering) for one, run in zip(members, runs, strict=True)])
        ),
    )


def over_times(found: Sequence[list[Standing]], make: Callable[[list[Any]], Term]) -> Term:
    """One term for each span over which all of several things stand still, one after the other."""
    borders = sorted({one.start for standing in found for one in standing[1:]})
    terms: list[Term] = []
    for start in (-np.inf, *borders):
        values = [next(one.value for one in reversed(standing) if one.start <= start) for standing in found]
        terms.append(make(values))
    return cases(borders, terms)


def flattened(lists_of_factors: Sequence[list[Factor]]) -> list[Factor]:
    """The factors of an object and of the groups it is in, as one list."""
    first, *groups = lists_of_factors
    found = list(first)
    for group in groups:
        # What looks somewhere asks where it has come to so far: in its own list.
        if any(factor.operation == "aim" for factor in group):
            found.append(Factor("matrix", {}, inner=tuple(group)))
        else:
            found.extend(group)
    return found


def position_term(obj: Object, lowering: Lowering) -> Term:
    """Where the origin of an object is.

    Raises:
        NotExactError: it is not moved by transforms that are known, or a deformation carries it along.
    """
    forms = standings(obj.form, lowering.parameters)
    origins = {id(one.value.part("origin")): one.value.part("origin") for one in forms}
    if len(origins) > 1:
        raise NotExactError(f"{obj.name}: deformations that act for a while only")
    origin = next(iter(origins.values()))
    start = constant(np.zeros(3)) if origin is None else lowering.of(origin)

    def moved(runs: list[Any]) -> Term:
        point = start
        for factor in exact_factors(obj, runs[0], lowering):
            point = _through(factor, point)
        return point

    return over_times([lists(obj, lowering)], moved)


def _through(factor: Factor, point: Term) -> Term:
    """A point carried along by a factor."""
    if factor.inner is not None:
        if any(inner.operation == "aim" for inner in factor.inner):
            raise NotExactError("a point moved by what looks somewhere")
        for inner in factor.inner:
            point = _through(inner, point)
        return point
    operation, terms = factor.operation, factor.terms
    if operation == "aim":
        return point  # it turns about this very point
    if operation == "translate":
        return plus(point, terms["offset"])
    if operation == "look" and is_zero(point):
        return terms["eye"]
    if operation == "matrix" and terms["matrix"].is_constant:
        return carried(terms["matrix"].value, point)
    if operation not in ("rotate", "orient", "scale"):
        raise NotExactError(f"a point moved by {operation}")
    center = terms["center"]
    arm = minus(point, center)
    if is_zero(arm):
        return point
    if operation == "scale":
        return plus(center, times(terms["factor"], arm))
    if operation == "orient":
        return plus(center, orienting(terms["rotation"], arm))
    if not terms["axis"].is_constant:
        raise NotExactError("a point turned about an axis that moves")
    return plus(center, rotating(terms["angle"], direction(terms["axis"].value), arm))


def visible_term(obj: Object, lowering: Lowering, above: Sequence[Object] = ()) -> Term:
    """Whether an object is drawn, and all groups above it."""
    parts = [lowering.of(one.visible) for one in (obj, *above)]
    if any(part.is_constant and not part.value for part in parts):
        return constant(False)
    moving = [part for part in parts if not part.is_constant]
    term = moving[0] if moving else constant(True)
    for part in moving[1:]:
        term = applied("and", term, part, shape=NUMBER)
    return term


def paint_term(obj: Object, lowering: Lowering, above: Sequence[Object] = ()) -> Term:
    """The colour of an object and how opaque it is: its settings, the changes on top, and the groups above it.

    Raises:
        NotExactError: a user's own change of colour, or a setting that is not lowered.
    """
    members = (obj, *above)

    def painted(lanes: list[Any]) -> Term:
        color, opaque = _painted(obj, lanes[0], lowering)
        for group, lane in zip(above, lanes[1:], strict=True):
            tint, share = _painted(group, lane, lowering)
            opaque = times(opaque, times(component(tint, 3), share))
        return _faded(color, opaque)

    return over_times([standings(one.lane("paint"), lowering.parameters) for one in members], painted)


def _faded(color: Term, opaque: Term) -> Term:
    """A colour whose alpha is multiplied by a share."""
    if opaque.is_constant and opaque.value == 1.0:
        return color
    if not color.is_constant:
        scale = applied("vec", *[constant(1.0)] * 3, opaque, shape=(4,))
        return applied("*", color, scale, shape=(4,))
    parts = [component(color, i) for i in range(4)]
    alpha = times(parts[3], opaque)
    if alpha.is_constant:
        return constant(np.array([part.value for part in (*parts[:3], alpha)]))
    return applied("vec", *parts[:3], alpha, shape=(4,))


def _painted(obj: Object, items: Sequence[Item], lowering: Lowering) -> tuple[Term, Term]:
    """The colour of an object, and by how much its alpha is multiplied."""
    color = lowering.of(obj.color)
    opacity: Term = constant(1.0)
    for item in items:
        change = entry_of(item).change
        attribute = _COLORINGS.get(type(change))
        if attribute is None:
            if isinstance(change, Texture):
                continue
            raise NotExactError(f"{obj.name}: {change.name} is a user's own")
        value = lowering.of(change.attribute(attribute))
        if value.is_constant and value.value is None:
            continue
        before = opacity if isinstance(change, Opacity) else color
        if isinstance(item, Gated):
            value = choose(lowering.of(item[1]), value, before)
        if isinstance(change, Opacity):
            opacity = value
        else:
            color = value
    return color, times(lowering.of(obj.opacity), opacity)


CHANNELS: Final[dict[str, ChannelRule]] = {
    "matrix": matrix_term,
    "position": position_term,
    "paint": paint_term,
}
