"""Records: what was answered, as it travels, so that readers share it; and what an edit leaves of it."""

import math
import threading
from bisect import bisect_right, insort
from collections import deque
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from reactive4d_widgets.live.witnesses import Witness

__all__ = ["Record", "Records"]

INF = math.inf
MOST = 50_000
BACK = 4  # records that begin earlier and may reach further


@dataclass(eq=False, slots=True)
class Record:
    """A segment that was answered.

    Attributes:
        channel: its name.
        lo, hi: from when to when, without `hi`.
        where: the parameters that were read, as they travel.
        wire: the segment as it travels.
        refs: the arrays in it.
        witnesses: what it follows from; a track that was read off has none, but a ground.
        is_sampled: whether it says something between ticks that was not asked there.
        is_held: whether it says between ticks what was so at the tick before: good enough while a figure plays only.
        is_stale: whether an edit has overtaken it.
    """

    channel: str
    lo: float
    hi: float
    where: Mapping[str, Any]
    wire: dict[str, Any]
    refs: tuple[str, ...] = ()
    witnesses: tuple[Witness, ...] = ()
    is_sampled: bool = False
    is_held: bool = False
    is_stale: bool = False

    def __lt__(self, other: "Record") -> bool:
        return self.lo < other.lo

    def holds(self) -> bool:
        """Whether all that it follows from is as it was; the engine's lock is held."""
        return all(witness.holds() for witness in self.witnesses)


@dataclass(slots=True)
class _Shelf:
    """The records of one channel that have these parameters in `where`."""

    names: tuple[str, ...]
    tables: dict[Any, list[Record]] = field(default_factory=dict[Any, list[Record]])


class Records:
    """The records of a model, by channel, parameters and time; of too many, the oldest go."""

    def __init__(self, most: int = MOST) -> None:
        self.most = most
        self._shelves: dict[str, list[_Shelf]] = {}
        self._order: deque[Record] = deque()
        self._lock = threading.Lock()

    def __len__(self) -> int:
        return len(self._order)

    def find(self, channel: str, t: float, wires: Mapping[str, Any], *, sampled: bool, held: bool) -> Record | None:
        """A record that answers a point.

        Args:
            channel: its name.
            t: seconds.
            wires: all parameters, as they travel.
            sampled: whether one will do that goes from tick to tick.
            held: whether one will do that says what was so at the tick before.
        """
        with self._lock:
            for shelf in self._shelves.get(channel, ()):
                table = shelf.tables.get(tuple([_key(wires.get(name)) for name in shelf.names]))
                if not table:
                    continue
                i = bisect_right(table, t, key=_start)
                for record in reversed(table[max(i - BACK, 0) : i]):
                    if t < record.hi and (sampled or not record.is_sampled) and (held or not record.is_held):
                        return record
        return None

    def put(self, record: Record) -> None:
        """Remember one."""
        names = tuple(sorted(record.where))
        with self._lock:
            shelves = self._shelves.setdefault(record.channel, [])
            shelf = next((one for one in shelves if one.names == names), None)
            if shelf is None:
                shelves.append(shelf := _Shelf(names))
            insort(shelf.tables.setdefault(tuple([_key(record.where[name]) for name in names]), []), record)
            self._order.append(record)
            while len(self._order) > self.most:
                self._drop(self._order.popleft())

    def all(self) -> list[Record]:
        """All of them, the oldest first."""
        with self._lock:
            return list(self._order)

    def remove(self, records: Iterable[Record]) -> None:
        """Forget some."""
        gone = {id(record): record for record in records}
        if not gone:
            return
        with self._lock:
            for record in gone.values():
                self._drop(record)
            self._order = deque([record for record in self._order if id(record) not in gone])

    def _drop(self, record: Record) -> None:
        names = tuple(sorted(record.where))
        for shelf in self._shelves.get(record.channel, ()):
            if shelf.names != names:
                continue
            key = tuple([_key(record.where[name]) for name in names])
            table = [other for other in shelf.tables.get(key, ()) if other is not record]
            if table:
                shelf.tables[key] = table
            else:
                shelf.tables.pop(key, None)


def _start(record: Record) -> float:
    return record.lo


def _key(wire: Any) -> Any:
    """What makes two values of a parameter one: 1 and 1.0 are, 1 and True are not."""
    if isinstance(wire, bool):
        return ("true" if wire else "false",)
    pair: Any = wire
    return tuple(pair) if isinstance(wire, list) else pair
