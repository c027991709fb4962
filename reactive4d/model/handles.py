"""Handles: what of an object a reader may take hold of, and which parameters it then moves.

A handle is a description that a scene keeps. A viewer turns a drag into values of the parameters. Which parameters
there are, and whether they are numbers, is known when the scene is shown.
"""

from dataclasses import dataclass
from numbers import Real
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from reactive4d.engine import Axis
from reactive4d.errors import ShapeError, hint
from reactive4d.model.kinds.aggregates import Group
from reactive4d.model.objects import Object

if TYPE_CHECKING:
    from reactive4d.model.scenes import Scene

__all__ = ["Handle", "handle", "node_name"]


@dataclass(frozen=True, slots=True)
class Handle:
    """What a reader takes hold of.

    Attributes:
        object: what is taken hold of.
        kind: "axis", moved along a line; "plane", moved in a plane; "circle", turned.
        parameters: the names of the parameters: one for each axis, or one that has as many numbers.
        axes: of the world, "x", "y" or "z", in the order of the parameters; none where it is turned.
        label: what is told of it.

    >>> import reactive4d as r4
    >>> height = r4.Parameter("height", 1.0, bounds=(0.0, 3.0))
    >>> ball = r4.Sphere(0.2)
    >>> _ = ball.translate((0, 0, height))
    >>> scene = r4.Scene(ball=ball)
    >>> handle = scene.handle(ball, z="height")
    >>> handle.kind, handle.parameters, handle.axes, handle.label
    ('axis', ('height',), ('z',), 'ball')
    """

    object: Object
    kind: Literal["axis", "plane", "circle"]
    parameters: tuple[str, ...]
    axes: tuple[str, ...]
    label: str


def handle(scene: "Scene", obj: Any, /, *, label: str = "", **bound: Any) -> Handle:
    """A handle of an object in a scene.

    Args:
        scene: which names the object, or a group that it is in.
        obj: what is taken hold of.
        label: what is told of it; its name if nothing is given.
        **bound: x, y, z, xy and angle: names of parameters, the parameters themselves, or None.

    Raises:
        ShapeError: it is no object, none of the scene's, the parameters do not make a line, a plane or a circle, or
            the label is no text. Whether parameters that were given by name are there is known when the scene is shown.
    """
    if not isinstance(obj, Object):
        raise ShapeError(f"handle: expected an object, got {obj!r}")
    if not isinstance(label, str):  # pyright: ignore[reportUnnecessaryIsInstance]
        raise hint(ShapeError(f"handle: label: expected a text, got {label!r}"), 'label="the kite"')
    name = node_name(scene, obj)
    if name is None:
        raise hint(ShapeError(f"handle: {obj.name} is not in the scene"), "name it there first, or the group it is in")
    given = {key: _named(key, value) for key, value in bound.items() if value is not None}
    lines = tuple([key for key in given if key in ("x", "y", "z")])
    others = [key for key in given if key not in lines]
    if len(lines) + 3 * len(others) not in (1, 2, 3) or len(lines) == 3:
        told = ", ".join(given) or "nothing"
        error = ShapeError(f"handle of {name}: {told} makes neither a line nor a plane nor a circle")
        raise hint(error, 'one or two of x, y, z; or xy="place"; or angle="turn": names of parameters')
    if len(set(given.values())) != len(given):
        raise ShapeError(f"handle of {name}: {given[lines[0]]!r} was given twice")
    parameters = tuple(given.values())
    if others == ["angle"]:
        return Handle(obj, "circle", parameters, (), label or name)
    axes = ("x", "y") if others else lines
    return Handle(obj, "plane" if len(axes) == 2 else "axis", parameters, axes, label or name)


def _named(key: str, value: Any) -> str:
    """The name of a parameter that was given by name, or itself."""
    if isinstance(value, Axis):
        _refuse_other_kinds(key, value)
        return value.name
    if not isinstance(value, str) or not value.isidentifier():
        error = ShapeError(f"handle: {key}: expected the name of a parameter, got {value!r}")
        raise hint(error, f'{key}="height", or the parameter itself; what else there is to move follows from it')
    return value


def _refuse_other_kinds(key: str, axis: Axis) -> None:
    """One number for a line or a turn, two for a plane; a parameter that begins with None may be either."""
    default: Any = axis.default
    parts: Any = default if isinstance(default, tuple | list) else (default,)  # pyright: ignore
    if default is None:
        return
    numbers = all(isinstance(part, Real) and not isinstance(part, bool | np.bool_) for part in parts)
    wanted = 2 if key == "xy" else 1
    if not numbers or len(parts) != wanted or (wanted == 1 and parts is default):
        told = "two numbers" if wanted == 2 else "a number"
        error = ShapeError(f"handle: {key}: expected a parameter that is {told}, got {axis.name}, which is {default!r}")
        raise hint(error, "x=, y=, z= and angle= take a number each, xy= takes XYCoordinates: two numbers in one")


def node_name(scene: "Scene", obj: Object) -> str | None:
    """How the node of an object is called in the scene's frames; None if it has none.

    >>> import reactive4d as r4
    >>> tyre = r4.Cylinder()
    >>> node_name(r4.Scene(car=r4.Group(tyre=tyre)), tyre)
    'car/tyre'
    """
    todo: list[tuple[str, Object]] = list(scene.items())
    while todo:
        name, found = todo.pop(0)
        if found is obj:
            return name
        if isinstance(found, Group):
            members: Any = found.members.at(0.0)
            todo.extend((f"{name}/{below}", member) for below, member in members)
    return None
