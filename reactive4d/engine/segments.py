"""The table of what was computed already: disjoint intervals, each with the answer that holds over it.

Invariants, which `checks.check` verifies:

- `starts[i] == segments[i].lo`, sorted, and `segments[i].hi <= segments[i + 1].lo`;
- a clean segment's dependencies are clean over the whole of it, at the times where it reads them (this is why marking
  may stop at what is not clean);
- a clean segment's remembered stamps are its dependencies' present ones.
"""

from bisect import bisect_right
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from reactive4d.engine.cells import Cell

__all__ = [
    "ELSEWHERE",
    "EMPTY",
    "Content",
    "MappedReads",
    "Segment",
    "Sole",
    "Table",
    "content",
    "covering",
    "flip",
    "split",
]

INF = float("inf")
EMPTY: Any = ()

# The type of an entry that was read elsewhere, (cell, map, overrides); cells themselves are the other entries.
ELSEWHERE: Any = tuple

# The one answer that a cell remembers, where that read cells at its own time, and no parameter:
# (segment, lo, hi, the cell that it read if it is one, all that it read, whether the cell is a formula).
Sole = tuple["Segment", float, float, "Cell | None", tuple[Any, ...], bool]

# value, stamp, reads, stamps of the reads
Content = tuple[Any, int, tuple[Any, ...], tuple[int, ...]]


class MappedReads(tuple[Any, ...]):
    """What an answer read, where some of it was read elsewhere in time: entries are cells or (cell, map, overrides)."""

    __slots__ = ()


class Segment:
    """An answer, where it holds, what it read, and whether that is known to stand as it was."""

    __slots__ = ("clean", "hi", "lo", "older", "reads", "retired", "stamp", "stamps", "touched", "value")

    def __init__(
        self,
        lo: float,
        hi: float,
        value: Any,
        stamp: int,
        reads: tuple[Any, ...],
        stamps: tuple[int, ...],
        touched: int,
    ) -> None:
        self.lo = lo
        self.hi = hi
        self.value = value
        self.stamp = stamp
        self.clean = True
        self.reads = reads
        self.stamps = stamps
        self.older: list[Content] = EMPTY  # the last one last
        self.retired = 0
        self.touched = touched

    def part(self, lo: float, hi: float) -> "Segment":
        """The same answer over a part of the interval."""
        segment = Segment(lo, hi, self.value, self.stamp, self.reads, self.stamps, self.touched)
        segment.clean = self.clean
        segment.older = list(self.older) if self.older else EMPTY
        segment.retired = self.retired
        return segment

    def __repr__(self) -> str:
        return f"[{self.lo:g}, {self.hi:g}) {'clean' if self.clean else 'check'} {self.value!r}"


class Table:
    """Segments sorted by start. A cell is the table of its answers that read no parameter."""

    __slots__ = ("segments", "sole", "starts")

    def __init__(self) -> None:
        self.starts: list[float] = EMPTY
        self.segments: list[Segment] = EMPTY
        self.sole: Sole | None = None  # of a cell; None where nobody has looked as well


def content(segment: Segment) -> Content:
    """What a segment says and why, without where."""
    return segment.value, segment.stamp, segment.reads, segment.stamps


def covering(table: Table, t: float) -> Segment | None:
    """The segment in which `t` lies, clean or not."""
    segments = table.segments
    if not segments:
        return None
    i = bisect_right(table.starts, t) - 1
    if i < 0:
        return None
    segment = segments[i]
    return segment if t < segment.hi else None


def split(table: Table, segment: Segment, lo: float, hi: float) -> None:
    """Cut a segment so that it covers just [lo, hi); what it covered besides stays, in segments of their own."""
    table.sole = None
    i = bisect_right(table.starts, segment.lo) - 1
    starts: list[float] = []
    parts: list[Segment] = []
    if segment.lo < lo:
        starts.append(segment.lo)
        parts.append(segment.part(segment.lo, lo))
    starts.append(lo)
    parts.append(segment)
    if hi < segment.hi:
        starts.append(hi)
        parts.append(segment.part(hi, segment.hi))
    segment.lo, segment.hi = lo, hi
    table.starts[i : i + 1] = starts
    table.segments[i : i + 1] = parts


def flip(table: Table, lo: float, hi: float) -> tuple[float, float] | None:
    """Put what is clean in [lo, hi) in check; returns the hull of what was clean there, or None."""
    segments = table.segments
    if not segments:
        return None
    if len(segments) == 1:
        segment = segments[0]
        a, b = segment.lo, segment.hi
        if not segment.clean or b <= lo or hi <= a:
            return None
        if lo > a or hi < b:
            a, b = max(a, lo), min(b, hi)
            split(table, segment, a, b)
        segment.clean = False
        return a, b
    i = bisect_right(table.starts, lo) - 1
    if i < 0 or segments[i].hi <= lo:
        i += 1
    first, last = INF, -INF
    while i < len(segments):
        segment = segments[i]
        if segment.lo >= hi:
            break
        if segment.clean:
            a, b = max(segment.lo, lo), min(segment.hi, hi)
            if a > segment.lo or b < segment.hi:
                split(table, segment, a, b)
                i = bisect_right(table.starts, a) - 1
            segment.clean = False
            first, last = min(first, a), b
        i += 1
    return (first, last) if first < last else None
