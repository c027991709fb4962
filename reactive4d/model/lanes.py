"""The entries of one lane of one object: a source, so that an edit of the list tells exactly whom it concerns.

Its content is a tuple of items in the order of their places. An item is an `Entry` whose change acts always, a `Gated`
one, whose change acts for a while only, or an `Idle` one, whose change is disabled. Idle items concern nobody, so
enabling a change again brings an earlier content back, and with it all that was remembered.
"""

from bisect import bisect_left
from typing import TYPE_CHECKING
from weakref import WeakValueDictionary

from reactive4d.engine import Source
from reactive4d.engine.frames import LOCK
from reactive4d.model.gates import Gate, open_spans
from reactive4d.model.places import Entry, Place
from reactive4d.signals.facade import Signal

if TYPE_CHECKING:
    from reactive4d.model.changes import Lane
    from reactive4d.model.objects import Object

__all__ = ["Entries", "Gated", "Idle", "Item", "Own", "acting", "before", "entry_of", "item", "merged"]

INF = float("inf")


class Gated(tuple[Entry, Gate]):
    """An entry whose change acts while its gate is open."""

    __slots__ = ()

    @property
    def place(self) -> Place:
        """The entry's."""
        return self[0].place


class Idle(tuple[Entry]):
    """An entry whose change is disabled."""

    __slots__ = ()

    @property
    def place(self) -> Place:
        """The entry's."""
        return self[0].place


Item = Entry | Gated | Idle
Items = tuple[Item, ...]


def item(entry: Entry) -> Item:
    """An entry as its change is by now: acting, gated or idle."""
    gating = entry.change.gating
    return entry if gating is True else Idle((entry,)) if gating is False else Gated((entry, gating))


def entry_of(item: Item) -> Entry:
    """The entry of an item."""
    return item if isinstance(item, Entry) else item[0]


class Entries(Signal[Items], Source):
    """Some entries of one object."""

    __slots__ = ("lane", "object")

    def __init__(self, obj: "Object", lane: "Lane", content: Items) -> None:
        self.object = obj
        self.lane = lane
        super().__init__(content, name="")

    @property
    def name(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """The object's name and the lane's: `ball.changes.transform`."""
        return f"{self.object.name}.changes.{self.lane}"

    @name.setter
    def name(self, value: str) -> None:
        pass

    def refers(self, content: Items) -> bool:
        """What is idle is no news to readers, but has to be kept."""
        return True

    def difference(self, old: Items, new: Items) -> list[tuple[float, float]]:
        """Where the entries that differ may act; everywhere if the order of others differs."""
        if old is new:
            return []
        was = [x for x in old if type(x) is not Idle]
        now = [x for x in new if type(x) is not Idle]
        if was == now:
            return []
        before, after = set(was), set(now)
        if [x for x in was if x in after] != [x for x in now if x in before]:
            return [(-INF, INF)]
        spans: list[tuple[float, float]] = []
        for x in before ^ after:
            spans.extend(open_spans(x[1]) if isinstance(x, Gated) else [(-INF, INF)])
        return spans


class Own(Entries):
    """The entries of one lane that stand in an object's own list."""

    __slots__ = ("bounded",)

    def __init__(self, obj: "Object", lane: "Lane") -> None:
        self.bounded: WeakValueDictionary[Place, Entries] | None = None
        super().__init__(obj, lane, ())

    def put(self, items: Items) -> None:
        """Set what stands in the list; within a transaction."""
        self.set_content(items)
        if self.bounded is not None:
            for place, entries in list(self.bounded.items()):
                entries.set_content(before(items, place))

    def refresh(self) -> None:
        """Tell the readers which changes act by now; within a transaction."""
        self.put(tuple([item(entry_of(x)) for x in self.content]))

    def before(self, place: Place) -> "Entries | None":
        """The entries before a place, as a source that does not hear of edits after it; None while edits are under way."""
        with LOCK:
            if self.engine.owner is not None:
                return None
            if self.bounded is None:
                self.bounded = WeakValueDictionary()
            entries = self.bounded.get(place)
            if entries is None:
                entries = self.bounded[place] = Entries(self.object, self.lane, before(self.content, place))
            return entries


def before(items: Items, place: Place) -> Items:
    """The items before a place."""
    return items[: bisect_left(items, place, key=_place)]


def merged(own: Items, inherited: Items) -> Items:
    """The items of two lists by their places."""
    if not own:
        return inherited
    if not inherited:
        return own
    if inherited[-1].place < own[0].place:
        return (*inherited, *own)
    return tuple(sorted((*inherited, *own), key=_place))


def _place(item: Item) -> Place:
    return item.place


def acting(items: Items) -> tuple[Entry, ...]:
    """The entries whose changes act at the asker's point; only inside of an evaluation."""
    entries: list[Entry] = []
    for x in items:
        if type(x) is Entry:
            entries.append(x)
        elif isinstance(x, Gated) and x[1].now():
            entries.append(x[0])
    return tuple(entries)
