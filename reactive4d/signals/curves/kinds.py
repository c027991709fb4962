"""Which kind of values a curve has, told or found out from all of its keys together."""

from collections.abc import Sequence
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np

from reactive4d.errors import ShapeError, hint, unknown
from reactive4d.signals.colors import is_color_name
from reactive4d.signals.curves.spaces import Colors, Held, Numbers, Rotations, Space, Vectors
from reactive4d.signals.rotations import Rotation

__all__ = ["KINDS", "Kind", "space_of"]

Kind: TypeAlias = Literal["number", "vector", "rotation", "color", "held"]
KINDS: Final[tuple[str, ...]] = get_args(Kind)


def space_of(times: Sequence[float], values: Sequence[Any], *, kind: str | None = None) -> Space:
    """The space that all of these values live in.

    Without `kind`: numbers are numbers, regular sequences of numbers are vectors, `Rotation` is a rotation, strings are
    colours if all of them name one, and anything else is held.

    Raises:
        UnknownNameError: there is no such kind.
        ShapeError: the values are of several kinds, or vectors of several shapes.

    >>> space_of([0, 1], ["red", "gold"]).kind, space_of([0, 1], ["red", "ready"]).kind
    ('color', 'held')
    """
    if kind is None:
        kind = _common(times, values)
    elif kind not in KINDS:
        raise unknown(kind, KINDS, what="kind of values")
    if kind == "vector":
        shapes = [np.shape(value) for value in values if _classify(value) == "vector"]
        return Vectors(shapes[0] if shapes else (3,))
    if kind == "color":
        return Colors()
    return {"number": Numbers, "rotation": Rotations, "held": Held}[kind]()


def _common(times: Sequence[float], values: Sequence[Any]) -> str:
    found = [_classify(value) for value in values]
    if "text" in found:
        named = all(kind != "text" or is_color_name(value) for kind, value in zip(found, values, strict=True))
        text = "color" if named and set(found) == {"text"} else "held"
        found = [text if kind == "text" else kind for kind in found]
    for t, kind, value in zip(times, found, values, strict=True):
        if kind != found[0]:
            error = ShapeError(
                f"the keys are of several kinds: {values[0]!r} at {times[0]!r} s is {_ARTICLE[found[0]]}, "
                f"{value!r} at {t!r} s is {_ARTICLE[kind]}"
            )
            raise hint(error, "kind='color' reads names and triples alike; kind='held' takes anything and steps")
    return found[0]


_ARTICLE = {
    "number": "a number",
    "vector": "a vector",
    "rotation": "a rotation",
    "color": "a colour",
    "held": "neither a number nor a vector, rotation or colour",
}


def _classify(value: Any) -> str:
    if isinstance(value, str):
        return "text"
    if isinstance(value, Rotation):
        return "rotation"
    if isinstance(value, bool | np.bool_):
        return "held"
    if isinstance(value, int | float | np.integer | np.floating):
        return "number"
    if isinstance(value, tuple | list | np.ndarray):
        try:
            array = np.asarray(value)  # pyright: ignore[reportUnknownArgumentType, reportUnknownVariableType]
        except ValueError:
            return "held"
        if array.dtype.kind in "iuf" and array.size:  # pyright: ignore[reportUnknownMemberType]
            return "vector" if array.ndim else "number"
    return "held"
