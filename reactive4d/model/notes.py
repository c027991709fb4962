"""Notes: what a list of changes stores beside what it does, and what an object has sent to others."""

from typing import TYPE_CHECKING, Any, TypeVar

from reactive4d.engine import engine
from reactive4d.errors import ShapeError
from reactive4d.model.changes import Change, Note
from reactive4d.model.lanes import acting
from reactive4d.model.settings import Held, Reference
from reactive4d.model.stacks import entries
from reactive4d.model.steps import step

if TYPE_CHECKING:
    from reactive4d.model.objects import Object

__all__ = ["Sent", "Store", "notes_of", "send", "withdraw"]

C = TypeVar("C", bound=Change)


class Store(Note):
    """Anything, kept in the list; a signal of anything, too.

    >>> import reactive4d as r4
    >>> vase = r4.Cylinder()
    >>> _ = vase.apply(Store(("made by", "Euphronios")))
    >>> vase.notes.at(0.0)
    (('made by', 'Euphronios'),)
    """

    __slots__ = ()

    value = Held(doc="what is stored")

    @staticmethod
    def note(value: Any) -> Any:
        """What is stored."""
        return value


def _change(value: Any) -> Change:
    if not isinstance(value, Change):
        raise ShapeError(f"Sent.change: expected a change, got {value!r}")
    return value


class Sent(Note):
    """That a change was sent to another object: who remembers it can edit it, or take it back.

    >>> import reactive4d as r4
    >>> lamp, flower = r4.Light("point"), r4.Cone()
    >>> turn = lamp.send(r4.Rotate(30), to=flower)
    >>> next(note for note in lamp.changes if isinstance(note, r4.Sent)).source("to") is flower
    True
    """

    __slots__ = ()

    positional = 2
    to = Reference(doc="the object in whose list the change stands")
    change = Held(accept=_change, doc="the change")

    @staticmethod
    def note(to: Any, change: Any) -> tuple[Any, Change]:
        """The object and the change."""
        return to, change


def notes_of(obj: "Object") -> tuple[Any, ...]:
    """What the notes that act store, in their order; only inside of an evaluation."""
    found: list[Any] = []
    for entry in acting(entries(obj, "note")):
        act, _ = step(type(entry.change))
        found.append(act(entry.change.values.now(), {}))
    return tuple(found)


def send(sender: "Object", change: C, to: "Object") -> C:
    """Put a change in the list of another object, and a note of it in one's own: one edit."""
    if not hasattr(to, "changes"):
        raise ShapeError(f"{sender.name}.send: expected an object to send it to, got {to!r}")
    with engine.transaction():
        to.changes.append(change)
        sender.changes.append(Sent(to, change))
    return change


def withdraw(sender: "Object", change: Change) -> None:
    """Take back what was sent, and the note of it.

    Raises:
        ValueError: it was not sent by this object.
    """
    for entry in sender.own_entries():
        note = entry.change
        if isinstance(note, Sent) and note.source("change") is change:
            with engine.transaction():
                note.source("to").changes.remove(change)
                sender.changes.remove(note)
            return
    raise ValueError(f"{change!r} was not sent by {sender.name}")
