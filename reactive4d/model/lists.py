"""The list of changes of an object, its own and the inherited ones, as one sequence in the order of places."""

from collections.abc import Iterable, Iterator, MutableSequence
from typing import TYPE_CHECKING, Any, TypeVar, overload

from reactive4d.engine import engine
from reactive4d.errors import Reactive4dError, hint
from reactive4d.model import places
from reactive4d.model.changes import LANES, Change
from reactive4d.model.lanes import Own, entry_of, item
from reactive4d.model.places import Entry, Place
from reactive4d.signals.facade import Signal

if TYPE_CHECKING:
    from reactive4d.model.objects import Object

__all__ = ["Changes"]

C = TypeVar("C", bound=Change)


class Changes(MutableSequence[Change]):
    """The changes that an object obeys, its own and those of its prototypes, by their places.

    One inserts, removes, moves and replaces its own; what is inherited is edited in the list of its owner. `append`
    puts a change at the end of the global order, `insert(i, …)` right after the one before.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere()
    >>> turn = ball.rotate(90)
    >>> ball.changes.insert(0, r4.Translate((1, 0, 0)))
    >>> [type(change).__name__ for change in ball.changes]
    ['Translate', 'Rotate']
    """

    __slots__ = ("obj",)

    def __init__(self, obj: "Object") -> None:
        self.obj = obj

    # -- reading ---------------------------------------------------------------------------------------------------

    @property
    def entries(self) -> tuple[Entry, ...]:
        """The entries with their owners, enabled or not.

        Raises:
            Reactive4dError: the prototype varies; then the list is asked for a time, `changes.at(t)`.
        """
        found: list[Entry] = []
        obj: Any = self.obj
        while obj is not None:
            found.extend(obj.own_entries())
            content = obj.prototype_content
            if isinstance(content, Signal):
                error = Reactive4dError(f"{self.obj.name}.changes: the prototype of {obj.name} varies")
                raise hint(error, "ask for the list at a time: obj.changes.at(t)")
            obj = content
        return tuple(sorted(found, key=lambda entry: entry.place))

    def at(self, t: float, /, **parameters: Any) -> tuple[Change, ...]:
        """The changes that act at a time, in their order."""
        return tuple([e.change for e in self.obj.acting.at(t, **parameters)])

    def owner(self, change: Change) -> "Object":
        """The object in whose list a change stands: this one, or a prototype."""
        return self._entry(change).owner

    def __len__(self) -> int:
        return len(self.entries)

    def __iter__(self) -> Iterator[Change]:
        return iter([entry.change for entry in self.entries])

    def __contains__(self, change: object) -> bool:
        return any(entry.change is change for entry in self.entries)

    @overload
    def __getitem__(self, index: int) -> Any: ...
    @overload
    def __getitem__(self, index: slice) -> list[Any]: ...
    def __getitem__(self, index: int | slice) -> Any:
        """A change, or a list of some."""
        entries = self.entries
        if isinstance(index, slice):
            return [entry.change for entry in entries[index]]
        return entries[index].change

    def index(self, value: Any, start: int = 0, stop: int | None = None) -> int:
        """Where a change stands.

        Raises:
            ValueError: it stands nowhere in the list.
        """
        for i, entry in enumerate(self.entries):
            if entry.change is value and i >= start and (stop is None or i < stop):
                return i
        raise ValueError(f"{value!r} does not stand in {self.obj.name}.changes")

    # -- editing ---------------------------------------------------------------------------------------------------

    def insert(self, index: int, value: Change) -> None:
        """Insert a change right after the one before `index`; at 0 right after the oldest prototype was made."""
        _refuse_no_change(value)
        with engine.transaction():
            entries = self.entries
            index = max(0, index + len(entries)) if index < 0 else index
            self._put(value, places.last() if index >= len(entries) else self._after(entries, index - 1))

    def append(self, value: Change) -> None:
        """Add a change at the end of the global order."""
        _refuse_no_change(value)
        with engine.transaction():
            self._put(value, places.last())

    def extend(self, values: Iterable[Change]) -> None:
        """Add several changes at the end."""
        values = list(values)
        with engine.transaction():
            for value in values:
                self.append(value)

    def __setitem__(self, index: int | slice, value: Any) -> None:
        """Replace a change by another one at the same place."""
        if isinstance(index, slice):
            raise TypeError(f"{self.obj.name}.changes: replace changes one by one")
        _refuse_no_change(value)
        with engine.transaction():
            entry = self._owned(self.entries[index])
            self._take(entry)
            self._put(value, entry.place)

    def __delitem__(self, index: int | slice) -> None:
        with engine.transaction():
            entries = self.entries
            for entry in entries[index] if isinstance(index, slice) else (entries[index],):
                self._take(self._owned(entry))

    def clear(self) -> None:
        """Take all changes out of the list, if all are its own."""
        del self[:]

    def reverse(self) -> None:
        """Put all changes into the opposite order, if all are its own."""
        with engine.transaction():
            super().reverse()

    def remove(self, value: Change) -> None:
        """Take a change out of the list.

        Raises:
            ValueError: it does not stand in it.
        """
        with engine.transaction():
            self._take(self._owned(self._entry(value)))

    def move(self, change: Change, *, before: Change | None = None, after: Change | None = None) -> None:
        """Move a change of one's own right before or right after another one of this list, which may be inherited.

        After the last one it comes to the end of the global order.

        Raises:
            ValueError: one of them does not stand in the list.
        """
        if (before is None) == (after is None):
            raise TypeError("move: expected one of before= and after=")
        with engine.transaction():
            entry = self._owned(self._entry(change))
            if change is before or change is after:
                return
            self._take(entry)
            entries = self.entries
            other = self._entry(before if before is not None else after)
            i = next(i for i, e in enumerate(entries) if e is other)
            is_last = after is not None and i == len(entries) - 1
            self._put(change, places.last() if is_last else self._after(entries, i if after is not None else i - 1))

    # -- how -------------------------------------------------------------------------------------------------------

    def _after(self, entries: tuple[Entry, ...], index: int) -> Place:
        return places.following(entries[index].place if index >= 0 else self.obj.oldest.born)

    def _entry(self, change: Any) -> Entry:
        """The first entry of a change: one's own, if there is one."""
        for entry in sorted(self.obj.own_entries(), key=lambda entry: entry.place):
            if entry.change is change:
                return entry
        for entry in self.entries:
            if entry.change is change:
                return entry
        raise ValueError(f"{change!r} does not stand in {self.obj.name}.changes")

    def _owned(self, entry: Entry) -> Entry:
        if entry.owner is not self.obj:
            error = Reactive4dError(f"{entry.change!r} is inherited: it stands in the list of {entry.owner.name}")
            raise hint(error, f"edit {entry.owner.name}.changes; all that extend it follow")
        return entry

    def _put(self, change: Change, place: Place) -> None:
        entry = Entry(change, self.obj, place)
        own: Own = self.obj.own(change.lane)
        change.enter(own)
        items = own.content
        i = len(items)
        while i and items[i - 1].place > place:
            i -= 1
        own.put((*items[:i], item(entry), *items[i:]))

    def _take(self, entry: Entry) -> None:
        own: Own = self.obj.own(entry.change.lane)
        own.put(tuple([x for x in own.content if entry_of(x) is not entry]))

    def __repr__(self) -> str:
        try:
            return f"Changes([{', '.join(map(repr, self))}])"
        except Reactive4dError as error:
            return f"<Changes: {error}>"


def _refuse_no_change(value: Any) -> None:
    if not isinstance(value, Change) or getattr(type(value), "lane", None) not in LANES:
        error = TypeError(f"expected a change, got {value!r}")
        raise hint(error, "such as Translate((1, 0, 0)) or Bend(60)")
