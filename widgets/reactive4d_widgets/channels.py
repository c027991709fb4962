"""Channels: each thing that travels of a scene as a signal of its own.

`node_of` gathers all that a viewer needs of an object, so it holds only while all of it does. Here each part stands
alone: the colour of a thing that moves is asked once.
"""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from reactive4d.model.drawings import strokes
from reactive4d.model.forms import Base, Made
from reactive4d.model.objects import Object
from reactive4d.model.palettes import pieces_of
from reactive4d.model.stacks import base_of
from reactive4d.model.surfaces import paints_of, surface_part
from reactive4d.signals.facade import Signal
from reactive4d.signals.functions import Function
from reactive4d.signals.sources import Parameter
from reactive4d_widgets.seats import Channel, Seat, opens

__all__ = ["at_rest", "furnish", "painted", "values_of"]

# By what is drawn: which channels a viewer wants besides `visible`, `drawn`, `matrix` and `color`.
SETTINGS: Mapping[str, tuple[str, ...]] = {
    "label": ("text", "height"),
    "light": ("light_type", "intensity", "angle", "reach", "shadows"),
    "camera": ("fov", "near", "far", "target"),
}
ARRAYS: Mapping[str, tuple[str, ...]] = {
    "mesh": ("points", "topology", "paints"),
    "lines": ("points", "topology", "paints"),
    "points": ("points", "paints"),
}


def furnish(seat: Seat) -> None:
    """Give a seat its channels."""
    wanted = ["visible", "drawn", "matrix"]
    if seat.primitives - {"none", "camera"}:
        wanted.append("color")
    for primitive in sorted(seat.primitives):
        wanted += [*ARRAYS.get(primitive, ()), *SETTINGS.get(primitive, ())]
    for what in dict.fromkeys(wanted):
        signal, source = _signal(seat, what)
        seat.channels[what] = Channel(f"{seat.name}#{what}", what, signal, seat, source)


def _signal(seat: Seat, what: str) -> tuple[Signal[Any], Signal[Any] | None]:
    """Who answers a channel of a seat, and who else says the same."""
    own = _OWN.get(what)
    cell: Callable[[Object], Signal[Any]] = own if own is not None else lambda obj: _setting(obj, what)
    obj = seat.object
    name = f"{seat.name}#{what}"
    if what == "visible":
        return Function(lambda: _visible(seat), name=name), None
    if what == "matrix" and (seat.above is not None or obj is None):
        return Function(lambda: _matrix(seat), name=name), None
    if what == "color" and (seat.above is not None or obj is None):
        return Function(lambda: _color(seat), name=name), None
    if what == "target":
        return Function(lambda: _target(seat), name=name), _untouched(seat)
    if obj is None:
        return Function(lambda: _of(seat.find(), cell), name=name), None
    if what == "points" and seat.is_plain and seat.primitives <= ARRAYS.keys():
        return obj.points, None
    signal = cell(obj)
    return signal, (obj.attribute(what) if seat.is_of_class and own is None else None)


def _of(obj: Object | None, cell: Callable[[Object], Signal[Any]]) -> Any:
    return None if obj is None else cell(obj).now()


def _visible(seat: Seat) -> bool:
    obj = seat.find()
    if obj is None or not obj.visible.now():
        return False
    above = seat.above
    return above is None or (above.channels["visible"].signal.now() and _opens_at(above))


def _opens_at(seat: Seat) -> bool:
    obj = seat.find()
    return obj is not None and opens(obj)


def _matrix(seat: Seat) -> Any:
    obj = seat.find()
    own = np.eye(4) if obj is None else obj.matrix.now()
    return own if seat.above is None else seat.above.channels["matrix"].signal.now() @ own


def _color(seat: Seat) -> Any:
    obj = seat.find()
    own = np.ones(4) if obj is None else obj.paint.now()
    opacity = 1.0
    above = seat.above
    while above is not None:
        group = above.find()
        opacity *= 1.0 if group is None else float(group.paint.now()[3])
        above = above.above
    return own if opacity == 1.0 else own * (1.0, 1.0, 1.0, opacity)


def _target(seat: Seat) -> Any:
    """What a camera looks at, in the world: as far ahead of it as its target was before the changes."""
    obj = seat.find()
    kind = None if obj is None else obj.kind.now()
    if obj is None or kind is None or "target" not in kind.settings:
        return None
    eye, target = (obj.parameter(kind, name).now() for name in ("eye", "target"))
    matrix = seat.channels["matrix"].signal.now()
    return matrix[:3, 3] - matrix[:3, 2] * float(np.linalg.norm(target - eye))


def _untouched(seat: Seat) -> Signal[Any] | None:
    """The setting itself, of a camera that nothing was done to."""
    obj = seat.object
    if obj is None or not seat.is_of_class or seat.above is not None or obj.has_prototype or obj.own_entries():
        return None
    return obj.attribute("target")


def _drawn(obj: Object) -> str:
    kind, form = obj.kind.now(), obj.form.now()
    if kind.is_group and isinstance(form, Base):
        return "none"
    if form.part("faces") is not None:
        if len(obj.topology.now()):
            return "mesh"
        return "points" if len(obj.points.now()) else "none"
    return "lines" if form.part("points") is not None else kind.primitive


def _points(obj: Object) -> Any:
    points = obj.form.now().part("points")
    return None if points is None else points.now()


def _topology(obj: Object) -> Any:
    """(faces, weld, materials) of a surface, (lines,) of lines."""
    form = obj.form.now()
    if form.part("faces") is not None:
        base = base_of(obj, obj.kind.now())
        groups = pieces_of(obj) if base.part("colors") is not None else None
        return surface_part(obj, "faces"), surface_part(obj, "weld"), groups
    lines = form.part("lines")
    points = form.part("points")
    return (None if lines is None or points is None else strokes(lines.now(), len(points.now())),)


def _paints(obj: Object) -> Any:
    """The colours of the faces or of the points, (F, 4) and None, or None and (V, 4); or None."""
    form = obj.form.now()
    if base_of(obj, obj.kind.now()).part("colors") is None or form.part("points") is None:
        return None
    faces = 0 if form.part("faces") is None else len(obj.topology.now())
    found = paints_of(obj, len(obj.points.now()), faces)
    return None if found[0] is None and found[1] is None else found


def _setting(obj: Object, name: str) -> Signal[Any]:
    """A setting, as whatever kind it is by then understands it."""

    def answer(o: Object) -> Any:
        kind = o.kind.now()
        return o.parameter(kind, name).now() if name in kind.settings else None

    return obj.channel(f"setting.{name}", answer)


_OWN: Mapping[str, Callable[[Object], Signal[Any]]] = {
    "drawn": lambda obj: obj.channel("drawn", _drawn),
    "matrix": lambda obj: obj.matrix,
    "color": lambda obj: obj.paint,
    "points": lambda obj: obj.channel("drawn.points", _points),
    "topology": lambda obj: obj.channel("drawn.topology", _topology),
    "paints": lambda obj: obj.channel("drawn.paints", _paints),
}


def _undeformed(obj: Object) -> Signal[Any]:
    """(V, 3), the points before all deformations, if there are as many as after them, else None."""

    def answer(o: Object) -> Any:
        form: Any = o.form.now()
        while isinstance(form, Made) and form.entry.change.lane == "shape":
            form = form.below
        points = form.part("points")
        return None if points is None else points.now()

    return obj.channel("undeformed", answer)


def values_of(signals: Mapping[str, Any]) -> list[Channel]:
    """The channels of a scene's named values; parameters are no values, they are driven.

    >>> import reactive4d as r4
    >>> [channel.name for channel in values_of({"height": 2 * r4.time, "length": r4.Parameter("length", 1.0)})]
    ['#values.height']
    """
    found: list[Channel] = []
    for name, signal in signals.items():
        if isinstance(signal, Signal) and not isinstance(signal, Parameter):
            found.append(Channel(f"#values.{name}", f"values.{name}", signal, None, signal))  # pyright: ignore
    return found


def painted(value: Any, keep: Callable[[Any], str]) -> dict[str, str]:
    """What a channel of paints says, as it travels.

    Args:
        value: (F, 4) and None, or None and (V, 4).
        keep: puts an array where it is kept, and says its reference.
    """
    sides = zip(("faces", "points"), value, strict=True)
    return {side: keep(np.ascontiguousarray(part, dtype=np.float32)) for side, part in sides if part is not None}


def at_rest(channel: Channel, count: int, ask: Callable[[Signal[Any]], Any]) -> Any:
    """The points from which creases are found: before all deformations, if there are enough, else as they are.

    Args:
        channel: of the surface.
        count: how many points its faces need.
        ask: answers a signal with a `value` or an `error`.

    Returns:
        (V, 3), V at least `count`; None if nothing answers so many.
    """
    seat = channel.seat
    assert seat is not None
    signals = [seat.channels["points"].signal]
    if seat.object is not None:
        signals.insert(0, _undeformed(seat.object))
    for signal in signals:
        found = ask(signal)
        if found.error is None and found.value is not None and len(found.value) >= count:
            return found.value
    return None
