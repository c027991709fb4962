"""Remembering an answer: clipped to where nothing is known yet, cut off if it is the same, merged with neighbours."""

from bisect import bisect_right
from typing import TYPE_CHECKING, Any

from reactive4d.engine.evictions import CONTENT
from reactive4d.engine.failures import Failure, same_failure
from reactive4d.engine.frames import Hit
from reactive4d.engine.links import link, unlink
from reactive4d.engine.segments import Content, Segment, Table, content, split
from reactive4d.engine.shelves import Shelves
from reactive4d.errors import ParameterError, hint

if TYPE_CHECKING:
    from reactive4d.engine.cells import Axis, Cell
    from reactive4d.engine.engines import Engine
    from reactive4d.engine.points import Point

__all__ = ["add_axes", "publish", "renew", "stand", "store", "table_for"]

KEPT = 7  # older contents of a segment, so that with the present one there are as many as a source remembers


def publish(engine: "Engine", cell: "Cell", segment: Segment, point: "Point | None", axes: Any) -> Hit:
    """Let the next ask find an answer without a search."""
    segment.touched = engine.clock
    hit = (segment.lo, segment.hi, segment.value, segment.stamp, point, axes)
    # While a transaction is open, what its owner sees is not to be seen by others.
    if engine.owner is None and type(segment.value) is not Failure:
        cell.hit = hit
    return hit


def store(
    engine: "Engine",
    cell: "Cell",
    table: Any,  # the cell itself, or one of the tables on its shelves
    t: float,
    lo: float,
    hi: float,
    point: "Point | None",
    value: Any,
    reads: tuple[Any, ...],
    stamps: tuple[int, ...],
) -> None:
    """Remember an answer: clip it to the gap, or to the segment in check that it replaces; cut off if it is equal."""
    segments: list[Segment] = table.segments
    linked: Any = cell.linked
    if len(segments) == 1 and table is cell and not engine.logs:
        # The commonest of cases, at once: the one segment gets a new answer from the same cells.
        segment = segments[0]
        start, stop = segment.lo, segment.hi
        if not segment.clean and lo <= start <= t < stop <= hi and (reads is linked or reads == linked):
            engine.clock = segment.touched = engine.clock + 1
            renew(engine, segment, value, segment.reads if reads == segment.reads else reads, stamps)
            if engine.owner is None and type(value) is not Failure:
                cell.hit = (start, stop, segment.value, segment.stamp, None, None)
            return
    table.sole = None
    if reads is not linked:
        if reads == linked:
            reads = linked
        else:
            link(cell, reads)
            cell.linked = reads
    engine.clock += 1
    logs = engine.logs
    if len(segments) == 1 and segments[0].lo <= t < segments[0].hi:
        segment = segments[0]
    else:
        i = bisect_right(table.starts, t) - 1 if segments else -1
        segment = segments[i] if i >= 0 and t < segments[i].hi else None
        if segment is None:
            segment = _insert(engine, cell, table, i + 1, lo, hi, value, reads, stamps)
            lo, hi = segment.lo, segment.hi
    if segment.clean:
        # It is new; or another thread was quicker, or this one came by here on another way.
        if logs:
            engine.emit("evaluated", cell, lo, hi)
    else:
        if lo <= segment.lo and segment.hi <= hi:
            lo, hi = segment.lo, segment.hi
            if linked is not cell.linked and linked and len(segments) == 1 and cell.shelves is None:
                unlink(cell, linked, reads)
        else:
            lo, hi = max(lo, segment.lo), min(hi, segment.hi)
            split(table, segment, lo, hi)
        cut_off = renew(engine, segment, value, reads, stamps)
        if logs:
            engine.emit("evaluated", cell, lo, hi)
            if cut_off:
                engine.emit("cut off", cell, lo, hi)
        if len(segments) > 1:
            _merge(table, segment)
    if table is cell:
        publish(engine, cell, segment, None, None)
    else:
        cell.shelves.cover = None  # pyright: ignore[reportOptionalMemberAccess]
        publish(engine, cell, segment, point, table.axes)


def renew(engine: "Engine", segment: Segment, value: Any, reads: tuple[Any, ...], stamps: tuple[int, ...]) -> bool:
    """Give a segment in check its new answer, and keep the old one for undoing; True if they are the same."""
    before = segment.value
    older = segment.older
    if older:
        older.append((before, segment.stamp, segment.reads, segment.stamps))
        if len(older) > KEPT:
            del older[0]
    else:
        segment.older = [(before, segment.stamp, segment.reads, segment.stamps)]
    segment.retired = engine.revivals
    segment.reads = reads
    segment.stamps = stamps
    segment.clean = True
    if type(value) is float and type(before) is float and value != before and value == value:
        engine.bytes += CONTENT + 24
    elif before is value or _equal(engine, before, value):
        return True
    else:
        engine.bytes += CONTENT + (24 if type(value) is float else engine.measure(value))
    segment.value = value
    segment.stamp = engine.stamp()
    return False


def _insert(
    engine: "Engine",
    cell: "Cell",
    table: Table,
    i: int,
    lo: float,
    hi: float,
    value: Any,
    reads: tuple[Any, ...],
    stamps: tuple[int, ...],
) -> Segment:
    """A new segment in the gap before the i-th, as part of its neighbour where that says the same."""
    segments = table.segments
    if not segments:
        segment = Segment(lo, hi, value, engine.stamp(), reads, stamps, engine.clock)
        table.starts, table.segments = [lo], [segment]
        engine.remembered(cell, segment)
        return segment
    if i > 0 and segments[i - 1].hi > lo:
        lo = segments[i - 1].hi
    if i < len(segments) and segments[i].lo < hi:
        hi = segments[i].lo
    segment = Segment(lo, hi, value, 0, reads, stamps, engine.clock)
    for neighbour in segments[max(i - 1, 0) : i + 1]:
        if (
            neighbour.clean
            and (neighbour.hi == lo or neighbour.lo == hi)
            and neighbour.stamps == stamps
            and neighbour.reads == reads
            and _equal(engine, neighbour.value, value)
        ):
            segment.value, segment.stamp, segment.stamps = neighbour.value, neighbour.stamp, neighbour.stamps
            break
    if not segment.stamp:
        segment.stamp = engine.stamp()
    table.starts.insert(i, lo)
    segments.insert(i, segment)
    engine.remembered(cell, segment)
    _merge(table, segment)
    return segment


def stand(
    engine: "Engine",
    cell: "Cell",
    table: Any,  # the cell itself, or one of the tables on its shelves
    segment: Segment,
    lo: float,
    hi: float,
    point: "Point | None",
    old: Content | None,
) -> None:
    """Find a segment in check as it was (or as an older content says) over the interval that its dependencies allow."""
    table.sole = None
    lo, hi = max(lo, segment.lo), min(hi, segment.hi)
    if lo > segment.lo or hi < segment.hi:
        split(table, segment, lo, hi)
    if old is not None:
        segment.older = [*(other for other in segment.older if other is not old), content(segment)]
        segment.retired = engine.revivals - 1
        segment.value, segment.stamp, segment.reads, segment.stamps = old
    if segment.reads is not cell.linked:
        link(cell, segment.reads)
        cell.linked = segment.reads
    segment.clean = True
    if engine.logs:
        engine.emit("validated" if old is None else "restored", cell, lo, hi)
    _merge(table, segment)
    if table is cell:
        publish(engine, cell, segment, None, None)
    else:
        cell.shelves.cover = None  # pyright: ignore[reportOptionalMemberAccess]
        publish(engine, cell, segment, point, table.axes)


def _merge(table: Table, segment: Segment) -> None:
    """Make one of a segment and a clean neighbour that says the same for the same reasons."""
    segments = table.segments
    if len(segments) == 1:
        return
    i = bisect_right(table.starts, segment.lo) - 1
    for j in (i + 1, i):
        if 0 < j < len(segments):
            left, right = segments[j - 1], segments[j]
            if (
                left.hi == right.lo
                and left.clean
                and right.clean
                and left.stamp == right.stamp
                and left.stamps == right.stamps
                and left.reads == right.reads
                and (left.older is right.older or _alike(left.older, right.older))
            ):
                left.hi = right.hi
                left.retired = right.retired = min(left.retired, right.retired)
                if right is segment:
                    # Keep the object that others hold in hand.
                    segment.lo, segment.hi = left.lo, right.hi
                    segments[j - 1] = segment
                del segments[j]
                del table.starts[j]


def _alike(these: list[Content], those: list[Content]) -> bool:
    """Whether two segments said the same before: an older content holds only where it was found."""
    return len(these) == len(those) and all(
        a[1] == b[1] and a[3] == b[3] and a[2] == b[2] for a, b in zip(these, those, strict=True)
    )


def _equal(engine: "Engine", a: Any, b: Any) -> bool:
    if type(a) is float and type(b) is float and a != b:
        return a != a and b != b
    if type(a) is Failure or type(b) is Failure:
        return type(a) is type(b) and same_failure(a, b, same=engine.same)
    return engine.same(a, b)


def table_for(cell: "Cell", axes: "dict[str, Axis]", point: "Point | None") -> Table:
    """The table of the answers that read just these parameters, at the values that they have at a point."""
    shelves = cell.shelves
    if shelves is None:
        shelves = cell.shelves = Shelves()
        cell.sole = None
    names = tuple([axes[name] for name in sorted(axes)]) if len(axes) > 1 else tuple(axes.values())
    table = shelves.table(shelves.shelf(names), point, make=True)
    assert table is not None
    return table


def add_axes(
    cell: "Cell", known: "dict[str, Axis] | None", axes: "tuple[Axis, ...]"
) -> "tuple[dict[str, Axis], Exception | None]":
    """Note that an answer depends on these parameters; an error if two different ones have one name."""
    if known is None:
        known = {}
    for axis in axes:
        if known.setdefault(axis.name, axis) is not axis:
            error = ParameterError(f"{cell.name} reads two different parameters that are both called {axis.name!r}")
            return known, hint(error, "make one Parameter and use it twice, or give them different names")
    return known, None
