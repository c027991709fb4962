"""Looking for a clean answer, and looking again at what was read, without computing anything."""

from bisect import bisect_right
from math import nextafter
from typing import TYPE_CHECKING, Any

from reactive4d.engine.answers import publish
from reactive4d.engine.failures import Failure, failure
from reactive4d.engine.frames import Cancelled, Hit, Task
from reactive4d.engine.kinds import AXIS, SOURCE
from reactive4d.engine.segments import ELSEWHERE, covering
from reactive4d.engine.stamps import piece

if TYPE_CHECKING:
    from reactive4d.engine.cells import Cell
    from reactive4d.engine.engines import Engine
    from reactive4d.engine.points import Point

__all__ = ["peek", "recheck", "unmoved"]

INF = float("inf")


def peek(engine: "Engine", cell: "Cell", t: float, point: "Point | None") -> Hit | None:
    """A clean answer, if the cell has one here; published so that the next ask needs no search."""
    kind = cell.kind
    if kind == SOURCE:
        try:
            lo, hi, value = cell.sample(t)
        except Exception as error:  # noqa: BLE001  a source's own error is an answer as well
            # What it says elsewhere is not known.
            lo, hi, value = t, nextafter(t, INF), failure(error, cell.name, t)
        stamps = cell.stamps
        if type(stamps) is int:
            hit = (lo, hi, value, stamps, None, None)
        else:
            a, b, stamp = piece(stamps, t)
            hit = (lo if lo > a else a, hi if hi < b else b, value, stamp, None, None)
        if engine.owner is None and type(value) is not Failure:
            cell.hit = hit
        return hit
    if kind == AXIS:
        if point is None:
            return cell.hit
        return -INF, INF, point.shown(cell), 0, point, (cell,)  # pyright: ignore[reportArgumentType]
    segments = cell.segments
    if segments:
        i = bisect_right(cell.starts, t) - 1 if len(segments) > 1 else 0
        if i >= 0:
            segment = segments[i]
            if segment.clean and segment.lo <= t < segment.hi:
                return publish(engine, cell, segment, None, None)
    if cell.shelves is not None:
        for shelf in cell.shelves.shelves:
            table = cell.shelves.table(shelf, point)
            if table is not None:
                segment = covering(table, t)
                if segment is not None and segment.clean:
                    return publish(engine, cell, segment, point, shelf.axes)
    return None


def unmoved(
    engine: "Engine", t: float, point: "Point | None", reads: tuple[Any, ...], stamps: tuple[int, ...]
) -> tuple[float, float] | None:
    """Where, round `t`, everything that was read is clean and as it was; None if something is not."""
    lo, hi = -INF, INF
    for entry, stamp in zip(reads, stamps, strict=True):
        cell, at, there = engine.elsewhere(entry, t, point) if type(entry) is ELSEWHERE else (entry, t, point)
        hit = peek(engine, cell, at, there)
        if hit is None or hit[3] != stamp:
            return None
        if type(entry) is ELSEWHERE:
            hit = engine.brought_back(entry, hit, at, t)
        lo, hi = max(lo, hit[0]), min(hi, hit[1])
    return lo, hi


def recheck(engine: "Engine", task: Task) -> None:
    """Start again if an edit has touched what this evaluation has read; otherwise go on, as of now."""
    span = unmoved(engine, task.t, task.point, tuple(task.deps), tuple(task.deps.values()))
    if span is None:
        raise Cancelled
    # What was read may hold over less by now, though it is the same here.
    task.lo, task.hi = max(task.lo, span[0]), min(task.hi, span[1])
    task.epoch = engine.epoch
