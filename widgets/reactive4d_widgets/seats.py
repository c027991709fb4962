"""Seats: the nodes of a scene by name, and who sits there.

A **seat** is a node's name with whoever sits there: mostly one object for ever, but the members of a group may vary
with time, and then a seat is empty for a while, or taken by another object. A **channel** is one thing about a seat
that travels, as a signal of its own: `car/tyre0#matrix`.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from reactive4d.model.forms import Base
from reactive4d.model.kinds.aggregates import Group, members_of
from reactive4d.model.objects import Object
from reactive4d.signals.facade import Signal

__all__ = ["HELD", "Channel", "Seat", "members", "opens"]

HELD = frozenset({"drawn", "visible", "text", "light_type", "shadows", "reach"})  # not blended with anything


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


def members(obj: Object) -> Signal[Any]:
    """The members of a group that are drawn one by one, as a signal of names and objects."""

    def answer(o: Object) -> Any:
        return members_of(o, o.kind.now() if o.kind.now().is_group else Group) if opens(o) else ()

    return obj.channel("seats", answer)


def opens(obj: Object) -> bool:
    """Whether a group's members are drawn one by one; inside of an evaluation."""
    return obj.kind.now().is_group and isinstance(obj.form.now(), Base)
