"""The commonest of cases, in one go: one remembered answer is in check, what it read is at hand, and something changed.

What is done here is what `formulas`, `rules` and `answers` do in general, without their calls: most of what a
recomputed cell costs in Python is calls. Whatever is not quite so is left to them, so this file could be deleted, and
nothing but the speed would change.
"""

from time import perf_counter
from typing import TYPE_CHECKING, Any

from reactive4d.engine import hits
from reactive4d.engine.answers import renew, store, table_for
from reactive4d.engine.failures import Failure, failure
from reactive4d.engine.frames import LOCK, Cancelled, Claim, Me, Suspended, Task, leave
from reactive4d.engine.kinds import FORMULA, SOURCE
from reactive4d.engine.peeks import peek
from reactive4d.engine.segments import MappedReads

if TYPE_CHECKING:
    from reactive4d.engine.cells import Cell
    from reactive4d.engine.engines import Engine

__all__ = ["express"]

INF = float("inf")
FEW = 8  # more are gathered bit by bit

acquire, release = LOCK.acquire, LOCK.release


def express(engine: "Engine", cell: "Cell", t: float, claim: Claim | None, me: Me) -> bool:
    """Answer a cell by its function or rule, if this is the commonest of cases; the lock is held.

    The cell bears the claim, if one is given, and nobody's otherwise. False if it is not, and nothing was remembered.
    """
    segments = cell.segments
    if len(segments) != 1 or cell.shelves is not None or engine.logs:
        return False
    segment = segments[0]
    start, stop = segment.lo, segment.hi
    if segment.clean or not start <= t < stop or (segment.older and engine.revivals > segment.retired):
        return False
    kind = cell.kind
    if kind == SOURCE:
        return False  # it was computed once, and was set since: what is remembered of it is no longer asked
    reads = segment.reads
    if len(reads) > FEW or type(reads) is not tuple or reads is not (cell.inputs if kind == FORMULA else cell.linked):
        return False
    is_rule = kind != FORMULA
    lo, hi = -INF, INF
    values: list[Any] = []
    stamps: list[int] = []
    for source in reads:
        hit = source.hit
        if not hit[0] <= t < hit[1]:
            if source.kind != SOURCE:
                return False
            hit = peek(engine, source, t, None)
            if hit is None or type(hit[2]) is Failure:
                return False
        a, b, value, stamp, _, axes = hit
        if axes is not None:
            return False
        if a > lo:
            lo = a
        if b < hi:
            hi = b
        values.append(value)
        stamps.append(stamp)
    these = tuple(stamps)
    if these == segment.stamps or (not is_rule and (lo > start or hi < stop)):
        return False
    own = claim is None
    if claim is None:
        cell.busy = claim = Claim(t, None, me)
        me.stacks.append([cell])
        hits.attended += 1
    epoch = engine.epoch
    runs = cell.runs
    cell.runs = runs + 1
    started = 0.0 if runs & 15 and runs > 2 else perf_counter()
    outer = me.frame
    if is_rule:
        frame = me.frame = Task(cell, t, None, me, epoch)
        frame.nested = 0.0 if started else -1.0
    else:
        frame = None
    release()
    try:
        value = cell.function(*values) if frame is None else cell.rule()
        if type(value) is not float:
            value = engine.freeze(value)
        if started:
            engine.timed(cell, perf_counter() - started - (0.0 if frame is None else frame.nested))
    except (Cancelled, Suspended, RecursionError):
        return False
    except MemoryError:
        raise  # not an answer: there may be room again
    except Exception as error:  # noqa: BLE001  an exception is an answer
        passed = None if frame is None else frame.raised
        value = failure(error, cell.name, t, passed[1] if passed is not None and passed[0] is error else None)
    finally:
        acquire()
        me.frame = outer
        if own:
            hits.attended -= 1
            me.stacks.pop()
            if cell.busy is claim and not engine.waiting:
                cell.busy = None
            else:
                leave(engine, cell, claim)
    if epoch != engine.epoch:
        return False
    if frame is not None:
        deps = frame.deps
        lo, hi = frame.lo, frame.hi
        if frame.axes is not None or frame.mapped or lo > start or hi < stop or tuple(deps) != reads:
            new = MappedReads(deps) if frame.mapped else tuple(deps)
            table = cell if frame.axes is None else table_for(cell, frame.axes, None)
            store(engine, cell, table, t, lo, hi, None, value, new, tuple(deps.values()))
            return True
    if cell.segments is not segments or len(segments) != 1 or segments[0] is not segment or segment.clean:
        store(engine, cell, cell, t, lo, hi, None, value, reads, these)
        return True
    engine.clock = segment.touched = engine.clock + 1
    renew(engine, segment, value, reads, these)
    if engine.owner is None and type(value) is not Failure:
        cell.hit = (start, stop, segment.value, segment.stamp, None, None)
    return True
