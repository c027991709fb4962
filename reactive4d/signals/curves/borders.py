"""The border of curves: what is refused before it is part of one, with what was expected and what to do."""

from collections.abc import Iterable, Mapping
from itertools import pairwise
from typing import Any, Final, cast

import numpy as np

from reactive4d.errors import ShapeError, TimeError, hint, unknown
from reactive4d.signals.curves.controls import Key, key_time
from reactive4d.signals.curves.extrapolations import EXTRAPOLATIONS
from reactive4d.signals.curves.interpolations import INTERPOLATIONS, Interpolation
from reactive4d.signals.curves.mixtures import Mixture, Mixtures
from reactive4d.signals.curves.pieces import STEADY
from reactive4d.signals.curves.spaces import Numbers, Space, Vectors, settled
from reactive4d.signals.easings import easing

__all__ = ["EASED", "check_key", "check_together", "in_order", "kept", "point_of_key"]

EASED: Final = "linear, slerp, hermite, catmull_rom and tcb take an ease; bezier has handles for that"
_NOT_OUTSIDE: Final = {"held": ("linear", "cycle_offset"), "color": ("linear", "cycle_offset")}


def in_order(points: Mapping[Any, Any] | Iterable[tuple[Any, Any]]) -> tuple[list[float], list[Key]]:
    """Times and keys in the order of time.

    Raises:
        TimeError: there are none; a time is NaN, infinite or no number, or there twice.
        ShapeError: this is no mapping of times to values.
    """
    try:
        line = cast(Any, points.items() if isinstance(points, Mapping) else points)
        pairs: list[tuple[Any, Any]] = [(t, value) for t, value in line]
    except (TypeError, ValueError):
        error = ShapeError(f"expected a mapping of times to values, got {points!r}")
        raise hint(error, "keys({0: a, 1.5: b})") from None
    if not pairs:
        raise hint(TimeError("a curve needs at least one key"), "keys({0: value}) holds one value forever")
    pairs = sorted(((key_time(t), value) for t, value in pairs), key=lambda pair: pair[0])
    for (t, _), (u, _) in pairwise(pairs):
        if t == u:
            raise hint(TimeError(f"there are two keys at {t!r} s"), "a jump needs two times: a little before, and then")
    return [t for t, _ in pairs], [value if isinstance(value, Key) else Key(value) for _, value in pairs]


def kept(key: Key) -> Key:
    """A key whose value cannot be changed by whoever gave it."""
    value = settled(key.value)
    return key if value is key.value else key.with_value(value)


def check_together(space: Space, rule: Interpolation, outside: tuple[str, str]) -> None:
    """Refuse what this kind of values cannot do.

    Raises:
        ShapeError: the interpolation or an extrapolation is not for these values.
        UnknownNameError: an extrapolation that nobody knows.
    """
    kind, name = space.kind, rule.name
    usable = [other for other in INTERPOLATIONS.values() if kind in other.kinds]
    refused = _NOT_OUTSIDE.get(kind, ())
    if isinstance(space, Mixtures):
        usable = [other for other in usable if not other.measures and not (kind == "rotation" and other.reach)]
        refused = ("linear", "cycle_offset") if kind == "rotation" else refused
    alive = ", some of them alive" if isinstance(space, Mixtures) else ""
    if rule not in usable:
        error = ShapeError(f"interpolation {name!r} is not for values of kind {kind!r}{alive}")
        raise hint(error, f"these are: {', '.join(sorted(other.name for other in usable))}")
    for extrapolation in outside:
        if extrapolation not in EXTRAPOLATIONS:
            raise unknown(extrapolation, EXTRAPOLATIONS, what="extrapolation")
        if extrapolation in refused:
            error = ShapeError(f"extrapolation {extrapolation!r} is not for values of kind {kind!r}{alive}")
            raise hint(error, "hold, cycle and oscillate are")


def point_of_key(space: Space, rule: Interpolation, t: float, *, value: Any) -> Any:
    """The value of the key at `t` as a point of the curve's space.

    Raises:
        ShapeError: it does not belong there; it is NaN, or infinite where something lies between keys.
    """
    try:
        point = space.point(value)
    except ShapeError as error:
        raise _at(error, t) from None
    if rule.name != "step" and isinstance(space, Numbers | Vectors) and not np.isfinite(point).all():
        error = ShapeError(f"the key at {t!r} s: {value!r} is not finite")
        raise hint(error, "only interpolation='step' takes infinite values")
    return point


def check_key(space: Space, rule: Interpolation, t: float, *, key: Key) -> None:
    """Refuse what a key says and its curve does not hear.

    Raises:
        ShapeError: an ease, handles or tension that have no effect; a handle of another shape, or without a slope.
    """
    name = rule.name
    if key.is_bare:
        return
    if key.ease is not None and not rule.eased and easing(key.ease) is not STEADY:
        raise hint(_at(ShapeError(f"an ease has no effect on {name!r}"), t), EASED)
    if not rule.tensions and (key.tension or key.continuity or key.bias):
        error = _at(ShapeError(f"tension, continuity and bias have no effect on {name!r}"), t)
        raise hint(error, "interpolation='tcb' has them")
    for side, handle in (("left", key.left), ("right", key.right)):
        if handle is None:
            continue
        if not rule.handles:
            error = _at(ShapeError(f"handles have no effect on {name!r}"), t)
            raise hint(error, "interpolation='bezier' and 'hermite' have them")
        try:
            offset = space.offset(handle[1])
        except ShapeError as error:
            raise _at(error, t, f"the {side} handle") from None
        parts = [term.point for term in offset.terms] if isinstance(offset, Mixture) else [offset]
        if not all(np.isfinite(part).all() for part in parts) or (name == "hermite" and handle[0] == 0.0):
            error = _at(ShapeError(f"the {side} handle {handle!r} has no finite slope dv / dt"), t)
            raise hint(error, "a Hermite tangent is the handle's dv / dt")


def _at(error: ShapeError, t: float, what: str = "") -> ShapeError:
    located = ShapeError(f"the key at {t!r} s{', ' + what if what else ''}: {error}")
    for note in getattr(error, "__notes__", ()):
        located.add_note(note)
    return located
