"""Cells: the signals of a scene that readers see at work, by what stands on their boxes."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from reactive4d.errors import ShapeError, hint
from reactive4d.model.nodes import node_of
from reactive4d.model.objects import Object
from reactive4d.signals.facade import Signal

__all__ = ["MOST", "as_cells"]

MOST = 40  # that anybody could look at
LONGEST = 24  # letters on a box


def as_cells(value: Any) -> Mapping[str, Signal[Any]]:
    """Named signals, in their order; in the place of an object stands all that a viewer needs of it.

    Raises:
        ShapeError: it is no mapping, there are too many, a name is none or too long for a box, something is neither a
            signal nor an object, or one has two names.

    >>> import reactive4d as r4
    >>> list(as_cells({"time": r4.time, "ball": r4.Sphere()}))
    ['time', 'ball']
    """
    if not isinstance(value, Mapping):
        error = ShapeError(f"cells: expected signals by name, got {value!r}")
        raise hint(error, 'scene.cells = {"place": ball.position, "picture": scene.frame}')
    given: dict[Any, Any] = dict(value)  # pyright: ignore[reportUnknownArgumentType]
    if len(given) > MOST:
        raise hint(ShapeError(f"cells: {len(given)} are too many, at most {MOST}"), "those that the text tells of")
    names: dict[Signal[Any], str] = {}
    for name, thing in given.items():
        signal = node_of(thing) if isinstance(thing, Object) else thing
        if not isinstance(name, str) or not 0 < len(name) <= LONGEST:
            error = ShapeError(f"cells: {name!r} does not go on a box")
            raise hint(error, f"a text of 1 to {LONGEST} letters")
        if not isinstance(signal, Signal):
            error = ShapeError(f"cells: {name}: expected a signal or an object, got {signal!r}")
            raise hint(error, "ball, ball.position, ball.color; or scene.frame, which is the picture")
        if signal in names:
            raise ShapeError(f"cells: {names[signal]} and {name} are one and the same signal")
        names[signal] = name
    return MappingProxyType({name: signal for signal, name in names.items()})
