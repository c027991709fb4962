"""What the engine did, in the order in which it did it, for tests to read and viewers to draw."""

from collections.abc import Iterable, Iterator, Sequence
from threading import get_ident
from typing import TYPE_CHECKING, NamedTuple, overload

if TYPE_CHECKING:
    from reactive4d.engine.cells import Cell

__all__ = ["Event", "Log"]


class Event(NamedTuple):
    """One thing that the engine did to one cell.

    `kind` is "evaluated" (its rule ran), "reused" (a remembered answer was handed out), "validated" (a remembered
    answer was checked and stands), "restored" (an older answer holds again), "cut off" (it was evaluated, and the
    answer is what it was), "marked" (an edit made it questionable), "edited" or "evicted"; over [lo, hi) in time.

    >>> str(Event("marked", "ball.position", 1.0, 3.0))
    'marked ball.position [1, 3)'
    """

    kind: str
    name: str
    lo: float
    hi: float

    def __str__(self) -> str:
        return f"{self.kind} {self.name} [{self.lo:g}, {self.hi:g})"


# What is noted while a log is open; it becomes an event when somebody reads it.
Note = tuple[str, "Cell", float, float]


class Sieve(list[Note]):
    """The notes of some cells, made by the thread that made the sieve."""

    def __init__(self, cells: "Iterable[Cell]") -> None:
        self.cells = frozenset(cells)
        self.thread = get_ident()

    def append(self, note: Note, /) -> None:
        """Keep a note, or let it pass."""
        if note[1] in self.cells and get_ident() == self.thread:
            super().append(note)


class Log(Sequence[Event]):
    """The events since the log was opened, as a sequence that grows while it is open.

    It keeps the cells that it tells of, so close it and let it go.

    Args:
        cells: tell of these alone, and of what the thread does that opens it; of all cells and threads if left out.
    """

    __slots__ = ("counted", "notes")

    def __init__(self, cells: "Iterable[Cell] | None" = None) -> None:
        self.notes: list[Note] = [] if cells is None else Sieve(cells)
        self.counted = 0

    @property
    def is_narrow(self) -> bool:
        """Whether it tells of some cells alone."""
        return type(self.notes) is Sieve

    def clear(self) -> None:
        """Forget the events so far."""
        self.count_hits()
        self.notes.clear()
        self.counted = 0

    def count_hits(self) -> None:
        """Add the hits since the last count to those of their cells."""
        for kind, cell, _, _ in self.notes[self.counted :]:
            if kind == "reused":
                cell.hits += 1
        self.counted = len(self.notes)

    def __len__(self) -> int:
        return len(self.notes)

    @overload
    def __getitem__(self, index: int) -> Event: ...
    @overload
    def __getitem__(self, index: slice) -> list[Event]: ...
    def __getitem__(self, index: int | slice) -> Event | list[Event]:
        if isinstance(index, slice):
            return [_event(note) for note in self.notes[index]]
        return _event(self.notes[index])

    def __iter__(self) -> Iterator[Event]:
        return map(_event, self.notes)

    def __eq__(self, other: object) -> bool:
        return list(self) == other if isinstance(other, list) else self is other

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return repr([str(event) for event in self])


def _event(note: Note) -> Event:
    kind, cell, lo, hi = note
    return Event(kind, cell.name, lo, hi)
