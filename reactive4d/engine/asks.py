"""Asking: from outside of any evaluation, and from inside of a rule.

ask      from outside: bring the cell up to date, then, if the memo is too large, forget what pays least
read     from inside of a rule, which runs without the lock
"""

from time import perf_counter
from typing import TYPE_CHECKING

from reactive4d.engine import hits
from reactive4d.engine.express import refresh
from reactive4d.engine.frames import DEPTH, LOCK, CycleFound, Hit, Suspended, Task, entered_twice, here, is_held
from reactive4d.engine.peeks import peek, recheck
from reactive4d.engine.walks import bring, cycle_error
from reactive4d.errors import DepthError, EvaluationError, hint

if TYPE_CHECKING:
    from reactive4d.engine.cells import Cell
    from reactive4d.engine.points import Point

__all__ = ["ask", "read"]

acquire, release = LOCK.acquire, LOCK.release


def ask(cell: "Cell", t: float, point: "Point | None") -> Hit:
    """Bring a cell up to date from outside of any evaluation, the lock held; the hit may hold a `Failure`."""
    engine = cell.engine
    hits.attended += 1
    try:
        return bring(engine, cell, t, point, here.me)
    except CycleFound as found:
        raise cycle_error(found.path) from None
    except RecursionError:
        error = DepthError(f"{cell.name}: the interpreter's stack is full")
        raise hint(error, "ask from a shallower place; algebra and lift(f) need no stack, opaque rules do") from None
    finally:
        hits.attended -= 1


def read(cell: "Cell", frame: Task, t: float, point: "Point | None") -> Hit:
    """Bring a cell up to date for a rule that reads it; the rule's thread does not hold the lock."""
    engine = cell.engine
    if frame.cell.engine is not engine:
        raise EvaluationError(f"{frame.cell.name} reads {cell.name}, which belongs to another engine")
    if is_held():
        raise entered_twice(cell.name)
    me = frame.me
    acquire()
    try:
        if engine.epoch != frame.epoch:
            recheck(engine, frame)
        if frame.nested < 0.0 and len(me.stacks) < DEPTH:
            sole = cell.sole
            is_simple = sole is not None and not sole[0].clean and point is None and cell.busy is None
            if is_simple and engine.owner is None and not engine.logs and refresh(engine, cell, t, me):
                hit = cell.hit
                if engine.epoch != frame.epoch:
                    recheck(engine, frame)
                elif hit[0] <= t < hit[1] and hit[5] is None:
                    return hit
        hit = None if engine.owner is not None and engine.owner is not me else peek(engine, cell, t, point)
        if hit is None:
            if len(me.stacks) >= DEPTH:
                raise Suspended(cell, t, point)
            if frame.nested < 0.0:
                hit = bring(engine, cell, t, point, me)
            else:
                started = perf_counter()
                hit = bring(engine, cell, t, point, me)
                frame.nested += perf_counter() - started
            if engine.epoch != frame.epoch:
                recheck(engine, frame)
        elif engine.logs:
            engine.emit("reused", cell, hit[0], hit[1])
    finally:
        release()
    return hit
