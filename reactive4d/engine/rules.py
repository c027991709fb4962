"""Opaque rules: what they read last time is checked in the order of reading; if it does not stand, the rule runs."""

from time import perf_counter
from typing import TYPE_CHECKING, Any

from reactive4d.engine.answers import add_axes, stand, store, table_for
from reactive4d.engine.failures import failure
from reactive4d.engine.frames import LOCK, Cancelled, Claim, Need, Suspended, Task
from reactive4d.engine.peeks import peek, recheck
from reactive4d.engine.segments import ELSEWHERE, Content, MappedReads, Segment, Table, covering

if TYPE_CHECKING:
    from reactive4d.engine.cells import Axis, Cell
    from reactive4d.engine.engines import Engine
    from reactive4d.engine.points import Point

__all__ = ["rule"]

INF = float("inf")
FEW = 4  # dependencies that are cheaper looked at again than remembered

acquire, release = LOCK.acquire, LOCK.release

# Where a walk along remembered dependencies stands: candidates refuted, dependencies seen, lo, hi, parameters.
_Progress = tuple[int, int, float, float, "dict[str, Axis] | None"]
_START: _Progress = (0, 0, -INF, INF, None)


def rule(engine: "Engine", cell: "Cell", t: float, point: "Point | None", claim: Claim) -> Need:
    """Answer a cell whose rule is opaque: None when done, [what is missing], or True to try again."""
    segments = cell.segments
    if cell.shelves is None and len(segments) == 1 and claim.kept is None:
        segment = segments[0]
        reads = segment.reads
        if len(reads) <= FEW and type(reads) is tuple and (not segment.older or engine.revivals <= segment.retired):
            return _simple(engine, cell, t, point, claim, segment)
    progress = _START
    if claim.kept is not None:
        kept = claim.kept.pop(cell, None)
        if kept is not None and kept[0] == engine.epoch:
            progress = kept[1]
    refuted, index, lo, hi, axes = progress
    candidates = _candidates(engine, cell, t, point)
    while refuted < len(candidates):
        segment, old, table = candidates[refuted]
        reads, stamps = (segment.reads, segment.stamps) if old is None else (old[2], old[3])
        # In order, and no further than the first change: a later dependency may exist only because of an earlier value.
        for place in range(index, len(reads)):
            source = reads[place]
            if type(source) is ELSEWHERE:
                entry = source
                source, at, there = engine.elsewhere(entry, t, point)
                hit = peek(engine, source, at, there)
                if hit is None:
                    claim.keep(cell, (engine.epoch, (refuted, place, lo, hi, axes)))
                    return [(source, at, there)]
                hit = engine.brought_back(entry, hit, at, t)
            else:
                hit = source.hit
                if not (hit[0] <= t < hit[1] and (hit[5] is None or hit[4] is point)):
                    hit = peek(engine, source, t, point)
                    if hit is None:
                        if place or refuted:
                            claim.keep(cell, (engine.epoch, (refuted, place, lo, hi, axes)))
                        return [source]
            if hit[3] != stamps[place]:
                break
            if hit[0] > lo:
                lo = hit[0]
            if hit[1] < hi:
                hi = hit[1]
            if hit[5] is not None:
                axes, problem = add_axes(cell, axes, hit[5])  # pyright: ignore[reportArgumentType]
                if problem is not None:
                    break
        else:
            # Everything stands; but only where the table is filed under all the parameters that are read by now.
            if (axes is None or (table is not cell and all(axis in table.axes for axis in axes.values()))) and (
                not segment.clean and covering(table, t) is segment
            ):
                stand(engine, cell, table, segment, lo, hi, point, old)
                return None
        refuted += 1
        index, lo, hi, axes = 0, -INF, INF, None
    return _run(engine, Task(cell, t, point, claim.me, engine.epoch))


def _simple(engine: "Engine", cell: "Cell", t: float, point: "Point | None", claim: Claim, segment: Segment) -> Need:
    """The same for a cell that remembers one answer, which read a few cells at its own time: the commonest of cases."""
    if segment.lo <= t < segment.hi:
        lo, hi = segment.lo, segment.hi
        for source, stamp in zip(segment.reads, segment.stamps, strict=True):
            hit = source.hit
            if not (hit[0] <= t < hit[1] and hit[5] is None):
                hit = peek(engine, source, t, point)
                if hit is None:
                    return [source]
            if hit[3] != stamp or hit[5] is not None:
                break
            if hit[0] > lo:
                lo = hit[0]
            if hit[1] < hi:
                hi = hit[1]
        else:
            if not segment.clean:
                stand(engine, cell, cell, segment, lo, hi, point, None)
                return None
    return _run(engine, Task(cell, t, point, claim.me, engine.epoch))


def _candidates(
    engine: "Engine", cell: "Cell", t: float, point: "Point | None"
) -> "list[tuple[Segment, Content | None, Any]]":
    """The remembered contents that may still stand at a point, the likeliest first: (segment, older content, table)."""
    segments = cell.segments
    if cell.shelves is None and len(segments) == 1:
        segment = segments[0]
        if not segment.lo <= t < segment.hi:
            return []
        if engine.revivals <= segment.retired or not segment.older:
            return [(segment, None, cell)]
    tables: list[Table] = [cell]
    if cell.shelves is not None:
        for shelf in cell.shelves.shelves:
            table = cell.shelves.table(shelf, point)
            if table is not None:
                tables.append(table)
    found: list[tuple[Segment, Content | None, Any]] = []
    for table in tables:
        segment = covering(table, t)
        if segment is not None:
            found.append((segment, None, table))
            if segment.older and engine.revivals > segment.retired:
                found.extend([(segment, old, table) for old in reversed(segment.older)])
    return found


def _run(engine: "Engine", task: Task) -> Need:
    """Run an opaque rule, without the lock, and store its answer: None when done, or True to try again."""
    cell, me = task.cell, task.me
    outer = me.frame
    me.frame = task
    runs = cell.runs
    value: Any = None
    release()
    try:
        if runs & 15 and runs > 2:
            task.nested = -1.0
            value = cell.rule()
        else:
            task.nested = 0.0
            started = perf_counter()
            value = cell.rule()
            engine.timed(cell, perf_counter() - started - task.nested)
        if type(value) is not float:
            value = engine.freeze(value)
    except Cancelled:
        value = Cancelled
    except RecursionError as error:
        if len(me.stacks) > 1:
            # The stack is full because of where this rule stands: begin again from below.
            raise Suspended(cell, task.t, task.point) from None
        value = failure(error, cell.name, task.t)
    except MemoryError:
        raise  # not an answer: there may be room again
    except Exception as error:  # noqa: BLE001  an exception is an answer
        passed = task.raised
        value = failure(error, cell.name, task.t, passed[1] if passed is not None and passed[0] is error else None)
    finally:
        me.frame = outer
        acquire()
    cell.runs = runs + 1
    deps = task.deps
    if task.epoch != engine.epoch and value is not Cancelled:
        try:
            recheck(engine, task)
        except Cancelled:
            value = Cancelled
    if value is Cancelled:
        return True
    reads = MappedReads(deps) if task.mapped else tuple(deps)
    table = cell if task.axes is None else table_for(cell, task.axes, task.point)
    store(engine, cell, table, task.t, task.lo, task.hi, task.point, value, reads, tuple(deps.values()))
    return None
