"""Formulas: gather the inputs; if they are as they were the answer stands, else the function runs."""

from time import perf_counter
from typing import TYPE_CHECKING, Any

from reactive4d.engine.answers import add_axes, stand, store, table_for
from reactive4d.engine.failures import Failure, failure
from reactive4d.engine.frames import LOCK, Claim, Need
from reactive4d.engine.peeks import peek, unmoved
from reactive4d.engine.segments import ELSEWHERE, MappedReads, covering

if TYPE_CHECKING:
    from reactive4d.engine.cells import Axis, Cell
    from reactive4d.engine.engines import Engine
    from reactive4d.engine.points import Point

__all__ = ["formula"]

INF = float("inf")
FEW = 4  # inputs that are cheaper looked at again than remembered

acquire, release = LOCK.acquire, LOCK.release


def formula(engine: "Engine", cell: "Cell", t: float, point: "Point | None", claim: Claim) -> Need:
    """Answer a cell that declares its inputs: None when done, [what is missing], or True to try again."""
    lo: float
    hi: float
    values: list[Any]
    stamps: list[int]
    axes: dict[str, Axis] | None
    inputs = cell.inputs
    kept = claim.kept.pop(cell, None) if claim.kept is not None else None
    if kept is not None and kept[0] == engine.epoch:
        _, lo, hi, values, stamps, axes = kept
        rest = inputs[len(stamps) :]
    else:
        lo, hi, values, stamps, axes = -INF, INF, [], [], None
        rest = inputs
    mapped = type(inputs) is MappedReads
    logs = engine.logs
    bad: Failure | None = None
    for source in rest:
        if mapped and type(source) is ELSEWHERE:
            entry = source
            source, at, there = engine.elsewhere(entry, t, point)
            hit = peek(engine, source, at, there)
            if hit is None:
                return [(source, at, there)]
            hit = engine.brought_back(entry, hit, at, t)
        else:
            hit = source.hit
            if not (hit[0] <= t < hit[1] and (hit[5] is None or hit[4] is point)):
                hit = peek(engine, source, t, point)
                if hit is None:
                    if len(inputs) > FEW:
                        # Go on from here, else a wide formula would look at its inputs once for each of them.
                        claim.keep(cell, (engine.epoch, lo, hi, values, stamps, axes))
                    return [source]
        a, b, value, stamp, _, its = hit
        if a > lo:
            lo = a
        if b < hi:
            hi = b
        values.append(value)
        stamps.append(stamp)
        if logs:
            engine.emit("reused", source, a, b)
        if its is not None:
            axes, problem = add_axes(cell, axes, its)
            if problem is not None:
                bad = failure(problem, cell.name, t)
                break
        if type(value) is Failure:
            bad = failure(value.error, cell.name, t, value)
            break
    reads = inputs if bad is None or len(stamps) == len(inputs) else type(inputs)(inputs[: len(stamps)])
    these = tuple(stamps)
    segments = cell.segments
    if axes is None and len(segments) == 1:
        table = cell
        segment = segments[0]
        if not segment.lo <= t < segment.hi:
            segment = None
    else:
        table = cell if axes is None else table_for(cell, axes, point)
        segment = covering(table, t)
    if segment is not None and not segment.clean:
        if segment.stamps == these and segment.reads == reads:
            stand(engine, cell, table, segment, lo, hi, point, None)
            return None
        if segment.older and engine.revivals > segment.retired:
            for old in reversed(segment.older):
                if old[3] == these and old[2] == reads:
                    stand(engine, cell, table, segment, lo, hi, point, old)
                    return None
    if bad is not None:
        store(engine, cell, table, t, lo, hi, point, bad, reads, these)
        return None
    runs = cell.runs
    epoch = engine.epoch
    release()
    try:
        if runs & 15 and runs > 2:
            value = cell.function(*values)
        else:
            started = perf_counter()
            value = cell.function(*values)
            engine.timed(cell, perf_counter() - started)
        if type(value) is not float:
            value = engine.freeze(value)
    except MemoryError:
        raise  # not an answer: there may be room again
    except Exception as error:  # noqa: BLE001  an exception is an answer
        value = failure(error, cell.name, t)
    finally:
        acquire()
    cell.runs = runs + 1
    if epoch != engine.epoch:
        span = unmoved(engine, t, point, reads, these)
        if span is None:
            return True
        lo, hi = max(lo, span[0]), min(hi, span[1])
    store(engine, cell, table, t, lo, hi, point, value, reads, these)
    return None
