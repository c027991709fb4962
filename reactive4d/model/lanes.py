"""The entries of one lane of one object: a source, so that an edit of the list tells exactly whom it concerns.

Its content is a tuple of items in the order of their places. An item is an `Entry` whose change acts always, a `Gated`
one, whose change acts for a while only, or an `Idle` one, whose change is disabled. Idle items concern nobody, so
enabling a change again brings an earlier content back, and with it all that was remembered.

What it says at a time are the entries that act then, and the gated ones of which that is not known. Where steps say
when a change acts, the item has their spans: nobody has to read its gate, so whatever edits the steps refreshes the
items.
"""

from bisect import bisect_left
from itertools import pairwise
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


class Gated(tuple[Entry, Gate, "Spans | None"]):
    """An entry whose change acts while its gate is open; and the spans where that is, or None if they are not known."""

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
Spans = tuple[tuple[float, float], ...]
EVERYWHERE: Spans = ((-INF, INF),)


def item(entry: Entry) -> Item:
    """An entry as its change is by now: acting, gated or idle."""
    gating = entry.change.gating
    if gating is True:
        return entry
    return Idle((entry,)) if gating is False else Gated((entry, gating, open_spans(gating)))


def entry_of(item: Item) -> Entry:
    """The entry of an item."""
    return item if isinstance(item, Entry) else item[0]


class Entries(Signal[Items], Source):
    """Some entries of one object."""

    __slots__ = ("is_plain", "lane", "object")

    lane: "Lane"

    def __init__(self, obj: "Object", lane: "Lane", content: Items) -> None:
        self.object = obj
        self.lane = lane
        super().__init__(content, name="")
        self.adopt()

    @property
    def name(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """The object's name and the lane's: `ball.changes.transform`."""
        return f"{self.object.name}.changes.{self.lane}"

    @name.setter
    def name(self, value: str) -> None:
        pass

    def adopt(self) -> None:
        """Know whether all entries act always."""
        self.is_plain = all(type(x) is Entry for x in self.content)

    def sample(self, t: float) -> tuple[float, float, Items]:
        """The entries that act, and those of which their gates will tell."""
        if self.is_plain:
            return -INF, INF, self.content
        lo, hi = -INF, INF
        found: list[Item] = []
        for x in self.content:
            spans = _acts(x)
            if spans is None:
                found.append(x)
                continue
            for start, stop in spans:
                if t < start:
                    hi = min(hi, start)
                    break
                if t < stop:
                    lo, hi = max(lo, start), min(hi, stop)
                    found.append(entry_of(x))
                    break
                lo = max(lo, stop)
        return lo, hi, tuple(found)

    def refers(self, content: Items) -> bool:
        """What is idle is no news to readers, but has to be kept."""
        return True

    def difference(self, old: Items, new: Items) -> list[tuple[float, float]]:
        """Where an entry acts in one of them and not in the other."""
        if old is new:
            return []
        start = 0
        for x, y in zip(old, new, strict=False):
            if x is not y:
                break
            start += 1
        was, now = {entry_of(x): x for x in old[start:]}, {entry_of(x): x for x in new[start:]}
        spans: list[tuple[float, float]] = []
        for entry in {**was, **now}:
            before, after = was.get(entry), now.get(entry)
            if before is not after and before != after:
                apart = _apart(before, after)
                if apart is EVERYWHERE:
                    return [*EVERYWHERE]
                spans.extend(apart)
        return spans


def _apart(before: Item | None, after: Item | None) -> Spans:
    """Where an entry acts either before or after an edit; everywhere if its gate says where."""
    a, b = _acts(before), _acts(after)
    if a is None or b is None or {a, b} == _ALL_OR_NOTHING:
        return EVERYWHERE
    ends = sorted({t for span in (*a, *b) for t in span})
    return tuple([(lo, hi) for lo, hi in pairwise(ends) if _within(lo, a) != _within(lo, b)])


_ALL_OR_NOTHING: set[Spans] = {(), EVERYWHERE}


def _acts(item: Item | None) -> Spans | None:
    if item is None or type(item) is Idle:
        return ()
    return item[2] if isinstance(item, Gated) else EVERYWHERE


def _within(t: float, spans: Spans) -> bool:
    return any(lo <= t < hi for lo, hi in spans)


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
        """The entries before a place, as a source that hears of no edits after it; None while edits are under way."""
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
