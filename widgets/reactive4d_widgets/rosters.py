"""Rosters: all seats of a scene, down to the members of groups, over all times and parameter values that count."""

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from reactive4d.model.forms import Base, Form
from reactive4d.model.objects import Object
from reactive4d.signals.facade import Signal
from reactive4d_widgets.channels import furnish
from reactive4d_widgets.seats import Seat, members

__all__ = ["roster"]

Asked = Callable[[Signal[Any]], list[Any]]


def roster(items: Mapping[str, Object], asked: Asked) -> list[Seat]:
    """The seats of a scene, in the order in which a frame names them, with their channels.

    Args:
        items: the objects of a scene by name.
        asked: everything that a held signal ever says, over all times and parameter values that count.

    >>> import reactive4d as r4
    >>> wheel = r4.Cylinder()
    >>> car = r4.Group(body=r4.Box(), wheel=wheel)
    >>> seats = roster({"car": car}, lambda signal: [signal.at(0.0)])
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
    furnish(seat)
    yield seat
    names: dict[str, list[Object]] = {}
    steady = seat.is_plain
    for obj in grouping:
        versions = asked(members(obj))
        steady = steady and len(versions) == 1
        for version in versions:
            for name, member in version:
                known = names.setdefault(name, [])
                if all(member is not other for other in known):
                    known.append(member)
    for name, found in names.items():
        only = found[0] if len(found) == 1 and seat.object is not None else None
        below = Seat(f"{seat.name}/{name}", "", only, _finder(seat, name), seat, is_plain=steady)
        yield from _seats(below, found, asked)


def _primitives(kind: type[Object], form: Form) -> tuple[str, ...]:
    if kind.is_group and isinstance(form, Base):
        return ("none",)
    if form.part("faces") is not None:
        return ("mesh",)
    return ("lines",) if form.part("points") is not None else (kind.primitive,)


def _finder(seat: Seat, name: str) -> Callable[[], Object | None]:
    def find() -> Object | None:
        group = seat.find()
        return None if group is None else dict(members(group).now()).get(name)

    return find
