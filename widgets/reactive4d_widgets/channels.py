"""Channels: what travels of a scene, each thing as a signal of its own.

`node_of` gathers all that a viewer needs of an object, so it holds only while all of it does. Here each part stands
alone: the colour of a thing that moves is asked once. A **seat** is a node's name with whoever sits there: mostly one
object for ever, but the members of a group may vary with time, and then a seat is empty for a while, or taken by
another object. A **channel** is one thing about a seat: `car/tyre0#matrix`.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from reactive4d.model.drawings import strokes
from reactive4d.model.forms import Base, Form, Made
from reactive4d.model.kinds.aggregates import Group, members_of
from reactive4d.model.objects import Object
from reactive4d.model.palettes import sources_of
from reactive4d.model.stacks import base_of
from reactive4d.model.surfaces import surface_part
from reactive4d.signals.facade import Signal
from reactive4d.signals.functions import Function
from reactive4d.signals.sources import Parameter

__all__ = ["ARRAYS", "HELD", "SETTINGS", "Channel", "Seat", "channels_of", "undeformed", "values_of"]

# By what is drawn: which channels a viewer wants besides `visible`, `drawn`, `matrix` and `color`.
SETTINGS: Mapping[str, tuple[str, ...]] = {
    "label": ("text", "height"),
    "light": ("light_type", "intensity", "angle", "reach", "shadows"),
    "camera": ("fov", "near", "far", "target"),
}
ARRAYS: Mapping[str, tuple[str, ...]] = {
    "mesh": ("points", "topology", "paints"),
    "lines": ("points", "topology"),
    "points": ("points",),
}
HELD = frozenset({"drawn", "visible", "text", "light_type", "shadows", "reach"})  # not blended with anything

Asked = Callable[[Signal[Any]], list[Any]]


@dataclass(eq=False)
class Seat:
    """A node's name, and who sits there.

    Attributes:
        name: `car/tyre0`.
        kind: the script name of the kind at the beginning.
        object: who sits there all the time; None where that varies.
        find: answers who sits there, an object or None; inside of an evaluation.
        above: the seat of the group that it is in.
        primitives: all that is ever drawn here: "mesh", "lines" and so on.
        is_plain: its kind is the same for ever, and so is that of all groups above.
        is_of_class: it is the kind of the object's class, too.
    """

    name: str
    kind: str
    object: Object | None
    find: Callable[[], Object | None]
    above: "Seat | None" = None
    primitives: set[str] = field(default_factory=set[str])
    is_plain: bool = True
    is_of_class: bool = False
    channels: dict[str, "Channel"] = field(default_factory=dict[str, "Channel"])

    @property
    def groups(self) -> tuple[Object, ...]:
        """The groups that it is in, the innermost first."""
        seat, found = self.above, list[Object]()
        while seat is not None and seat.object is not None:
            found.append(seat.object)
            seat = seat.above
        return tuple(found)

    def __repr__(self) -> str:
        return f"<Seat {self.name}>"


@dataclass(eq=False)
class Channel:
    """One thing about a seat, as a signal.

    Attributes:
        name: `car/tyre0#matrix`; of the scene itself `#values.height`.
        what: `matrix`.
        signal: who answers it: as it travels, but for arrays, and for matrices (4, 4).
        seat: whose it is; None for the scene's own.
        source: a signal that says the same and of which more may be known; None where there is none.
    """

    name: str
    what: str
    signal: Signal[Any]
    seat: Seat | None
    source: Signal[Any] | None = None

    @property
    def is_array(self) -> bool:
        """Whether its answers are too large to be written where they are used."""
        return self.what in ("points", "topology", "paints")

    @property
    def is_held(self) -> bool:
        """Whether there is nothing between two of its answers."""
        return self.what in HELD

    def __repr__(self) -> str:
        return f"<Channel {self.name}>"


def channels_of(items: Mapping[str, Object], asked: Asked) -> list[Seat]:
    """The seats of a scene, in the order in which a frame names them, with their channels.

    Args:
        items: the objects of a scene by name.
        asked: everything that a held signal ever says, over all times and parameter values that count.

    >>> import reactive4d as r4
    >>> wheel = r4.Cylinder()
    >>> car = r4.Group(body=r4.Box(), wheel=wheel)
    >>> seats = channels_of({"car": car}, lambda signal: [signal.at(0.0)])
    >>> [seat.name for seat in seats]
    ['car', 'car/body', 'car/wheel']
    >>> sorted(seats[1].channels)
    ['color', 'drawn', 'matrix', 'paints', 'points', 'topology', 'visible']
    """
    seats: list[Seat] = []
    for name, obj in items.items():
        seats.extend(_seats(Seat(name, "", obj, lambda obj=obj: obj), [obj], asked))
    return seats


def _seats(seat: Seat, objects: list[Object], asked: Asked) -> Iterator[Seat]:
    """A seat, on which some objects sit one after the other, and those of its members."""
    kinds = [kind for obj in objects for kind in asked(obj.kind)]
    if not seat.kind:
        seat.kind = kinds[0].script if kinds else "object"
    forms = [form for obj in objects for form in asked(obj.form)]
    seat.is_plain = seat.is_plain and len(set(kinds)) == 1 and seat.object is not None
    seat.is_of_class = seat.is_plain and kinds[0] is type(seat.object)
    grouping = [obj for obj in objects if any(kind.is_group for kind in asked(obj.kind))]
    if grouping and (len(set(kinds)) > 1 or len(set(forms)) > 1):
        seat.is_plain = False
    for kind in kinds:
        for form in forms:
            seat.primitives.update(_primitives(kind, form))
    _furnish(seat)
    yield seat
    names: dict[str, list[Object]] = {}
    steady = seat.is_plain
    for obj in grouping:
        versions = asked(_members(obj))
        steady = steady and len(versions) == 1
        for members in versions:
            for name, member in members:
                found = names.setdefault(name, [])
                if all(member is not other for other in found):
                    found.append(member)
    for name, members in names.items():
        only = members[0] if len(members) == 1 and seat.object is not None else None
        below = Seat(f"{seat.name}/{name}", "", only, _finder(seat, name), seat, is_plain=steady)
        yield from _seats(below, members, asked)


def _primitives(kind: type[Object], form: Form) -> tuple[str, ...]:
    if kind.is_group and isinstance(form, Base):
        return ("none",)
    if form.part("faces") is not None:
        return ("mesh",)
    return ("lines",) if form.part("points") is not None else (kind.primitive,)


def _members(obj: Object) -> Signal[Any]:
    def answer(o: Object) -> Any:
        return members_of(o, o.kind.now() if o.kind.now().is_group else Group) if _opens(o) else ()

    return obj.channel("seats", answer)


def _opens(obj: Object) -> bool:
    """Whether a group's members are drawn one by one; inside of an evaluation."""
    return obj.kind.now().is_group and isinstance(obj.form.now(), Base)


def _finder(seat: Seat, name: str) -> Callable[[], Object | None]:
    def find() -> Object | None:
        group = seat.find()
        return None if group is None else dict(_members(group).now()).get(name)

    return find


# -- the channels of a seat ------------------------------------------------------------------------------------------


def _furnish(seat: Seat) -> None:
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
    return obj is not None and _opens(obj)


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
        groups = sources_of(obj) if base.part("colors") is not None else None
        return surface_part(obj, "faces"), surface_part(obj, "weld"), groups
    lines = form.part("lines")
    points = form.part("points")
    return (None if lines is None or points is None else strokes(lines.now(), len(points.now())),)


def _paints(obj: Object) -> Any:
    """(F, 4), the faces' own colours, or None."""
    colors = base_of(obj, obj.kind.now()).part("colors")
    if colors is None:
        return None
    found = colors.now()
    return found if len(found) == len(obj.topology.now()) and len(found) else None


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


def undeformed(obj: Object) -> Signal[Any]:
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
