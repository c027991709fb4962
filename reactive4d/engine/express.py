"""The commonest of cases, in one go: cells that remember one answer, in check, and read others at their own time.

What is done here is what `walks`, `formulas`, `rules` and `answers` do in general, without their calls: most of what a
recomputed cell costs in Python is calls. Whatever is not quite so is left to them, so this file could be deleted, and
nothing but the speed would change.

No interval is computed: where everything that was read holds as long as the remembered answer, the new one does too.
"""

# The checker follows what lies on the stack round the loop, and loses it.
# pyright: reportUnknownVariableType=false, reportUnknownMemberType=false, reportUnknownArgumentType=false

from time import perf_counter
from typing import TYPE_CHECKING, Any

from reactive4d.engine.answers import KEPT, renew, store, table_for
from reactive4d.engine.evictions import CONTENT
from reactive4d.engine.failures import Failure, failure
from reactive4d.engine.frames import LOCK, Cancelled, Claim, Hit, Me, Task, leave
from reactive4d.engine.kinds import FORMULA
from reactive4d.engine.peeks import peek
from reactive4d.engine.segments import EMPTY, MappedReads, Sole

if TYPE_CHECKING:
    from reactive4d.engine.cells import Cell
    from reactive4d.engine.engines import Engine

__all__ = ["express", "refresh"]

FEW = 4  # inputs that are cheaper looked at again than remembered
NUMBER = CONTENT + 24  # bytes of an older content that is a number

acquire, release = LOCK.acquire, LOCK.release

# How far a cell on the stack has come: the cell, which one it waits for, the stamp that that one had, those that come
# then with their stamps, the values and the stamps so far, and whether one of these is not what it was.
Begun = tuple["Cell", "Cell", int, Any, list[Any], list[int], bool]


def refresh(engine: "Engine", cell: "Cell", t: float, me: Me) -> bool:
    """Bring a cell up to date that nobody has claimed, if it is simple; the lock is held, nothing listens or edits."""
    claims = me.claims
    if claims:
        claim = claims.pop()
        claim.t = t
    else:
        claim = Claim(t, None, me)
    cell.busy = claim
    stack: list[Any] = [cell]
    me.stacks.append(stack)
    try:
        return express(engine, stack, t, claim, me)
    finally:
        me.stacks.pop()
        if stack:
            for left in stack:
                leave(engine, left, claim)
        if claim.kept is None and not engine.waiting:
            claims.append(claim)  # nobody else can have it in hand


def express(engine: "Engine", stack: list[Any], t: float, claim: Claim, me: Me) -> bool:
    """Answer the cell on top of the stack, and what it needs, as far as all are of the common kind.

    The lock is held, no log and no transaction is open, and the cells on the stack bear the claim.

    Returns:
        True: it is answered, and taken from the stack. False: the general way is to go on at the top of the stack.
    """
    value: Any
    hit: Hit | None
    these: tuple[int, ...]
    rest: Any
    known: int
    values: list[Any] = EMPTY
    stamps: list[int]
    runs: int
    cell: Cell
    source: Cell
    alone: Cell | None
    below: Sole | None
    stamp = 0
    begun: list[Begun] = []
    epoch, revivals, new_stamp, spares = engine.epoch, engine.revivals, engine.stamp, me.spares
    cell = stack[-1]
    root = cell
    sole = cell.sole or _sole(cell)
    if sole is None or sole[0].clean or not sole[1] <= t < sole[2]:
        return False
    while sole is not None:
        # Look at what the cell on top reads; what is in check comes on top of it.
        segment, start, stop, alone, reads, is_formula = sole
        if segment.retired != revivals and segment.older:
            break  # perhaps it is as it once was
        if alone is not None:
            lo, hi, value, stamp, _, axes = alone.hit
            if start < lo or hi < stop or axes is not None:
                below = alone.sole or _sole(alone)
                if below is not None and alone.busy is None and not below[0].clean and below[1] <= t < below[2]:
                    cell, sole = alone, below
                    cell.busy = claim
                    stack.append(cell)
                    continue
                hit = _found(engine, alone, t, start, stop)
                if hit is None:
                    break
                value, stamp = hit[2], hit[3]
            changed = stamp != segment.stamps[0]
            these = (stamp,)
        else:
            below = None
            if begun and begun[-1][0] is cell:
                _, source, known, rest, values, stamps, changed = begun[-1]
                lo, hi, value, stamp, _, axes = source.hit
                if start < lo or hi < stop or axes is not None:
                    hit = _found(engine, source, t, start, stop)
                    if hit is None:
                        break
                    value, stamp = hit[2], hit[3]
                begun.pop()
                values.append(value)
                stamps.append(stamp)
                changed = changed or stamp != known
            else:
                rest, values, stamps = zip(reads, segment.stamps, strict=True), [], []
                changed = False
            if is_formula or not changed:
                for source, known in rest:
                    lo, hi, value, stamp, _, axes = source.hit
                    if start < lo or hi < stop or axes is not None:
                        below = source.sole or _sole(source)
                        if (
                            below is not None
                            and source.busy is None
                            and not below[0].clean
                            and below[1] <= t < below[2]
                        ):
                            begun.append((cell, source, known, rest, values, stamps, changed))
                            cell, sole = source, below
                            cell.busy = claim
                            stack.append(cell)
                            break
                        below = None
                        hit = _found(engine, source, t, start, stop)
                        if hit is None:
                            begun.append((cell, source, known, rest, values, stamps, changed))
                            _hand_over(engine, claim, begun)
                            return False
                        value, stamp = hit[2], hit[3]
                    values.append(value)
                    stamps.append(stamp)
                    if stamp != known:
                        changed = True
                        if not is_formula:
                            break  # what is read next may be read only because of what this one said
                if below is not None:
                    continue
            value, these = None, tuple(stamps)
        # Answer it, and then the cells below it on the stack, as far as they read nothing else.
        while True:
            is_usual = True
            if changed:
                runs = cell.runs = cell.runs + 1
                if is_formula:
                    function = cell.function
                    release()
                    try:
                        if runs & 63 and runs > 3:
                            value = function(value) if alone is not None else function(*values)
                        else:
                            started = perf_counter()
                            value = function(value) if alone is not None else function(*values)
                            engine.timed(cell, perf_counter() - started)
                        if type(value) is not float:
                            value = engine.freeze(value)
                    except RecursionError:
                        return False  # perhaps there is more room where the general way calls it
                    except MemoryError:
                        raise  # not an answer: there may be room again
                    except Exception as error:  # noqa: BLE001  an exception is an answer
                        value = failure(error, cell.name, t)
                    finally:
                        acquire()
                    if engine.epoch != epoch:
                        return False
                else:
                    rule = cell.rule
                    if spares:
                        frame = spares.pop()
                        frame.cell, frame.t, frame.epoch = cell, t, epoch
                    else:
                        frame = Task(cell, t, None, me, epoch)
                    # Only what holds shorter than the remembered answer narrows the new one.
                    frame.lo, frame.hi = start, stop
                    outer = me.frame
                    me.frame = frame
                    release()
                    try:
                        if runs & 63 and runs > 3:
                            frame.nested = -1.0
                            value = rule()
                        else:
                            frame.nested = 0.0
                            started = perf_counter()
                            value = rule()
                            engine.timed(cell, perf_counter() - started - frame.nested)
                        if type(value) is not float:
                            value = engine.freeze(value)
                    except (Cancelled, RecursionError):
                        return False
                    except MemoryError:
                        raise  # not an answer: there may be room again
                    except Exception as error:  # noqa: BLE001  an exception is an answer
                        passed = frame.raised
                        read = passed[1] if passed is not None and passed[0] is error else None
                        value = failure(error, cell.name, t, read)
                    finally:
                        acquire()
                        me.frame = outer
                    if engine.epoch != epoch:
                        return False
                    deps = frame.deps
                    if frame.lo != start or frame.hi != stop or frame.axes is not None or frame.mapped or not deps:
                        is_usual = False
                    elif alone is not None:
                        source, stamp = deps.popitem()
                        if source is not alone or deps:
                            deps[source] = stamp
                            is_usual = False
                        these = (stamp,)
                    elif tuple(deps) == reads:
                        these = tuple(deps.values())
                        deps.clear()
                    else:
                        is_usual = False
                    if is_usual:
                        frame.raised = frame.handed = None
                        del frame.cell  # else the thread would keep it alive
                        spares.append(frame)
                    else:
                        new = MappedReads(deps) if frame.mapped else tuple(deps)
                        table = cell if frame.axes is None else table_for(cell, frame.axes, None)
                        store(engine, cell, table, t, frame.lo, frame.hi, None, value, new, tuple(deps.values()))
                before = segment.value
                if not is_usual:
                    pass
                elif segment.clean or cell.sole is not sole:
                    # Something was done to it on another thread, at another time.
                    is_usual = False
                    store(engine, cell, cell, t, start, stop, None, value, reads, these)
                elif type(value) is float and type(before) is float and (value < before or before < value):
                    engine.clock = segment.touched = engine.clock + 1
                    older = segment.older
                    if not older:
                        segment.older = [(before, segment.stamp, reads, segment.stamps)]
                        engine.bytes += NUMBER
                    else:
                        older.append((before, segment.stamp, reads, segment.stamps))
                        if len(older) > KEPT:
                            del older[0]
                        else:
                            engine.bytes += NUMBER
                    segment.retired = revivals
                    segment.stamps = these
                    segment.clean = True
                    segment.value = value
                    segment.stamp = stamp = new_stamp()
                    cell.hit = (start, stop, value, stamp, None, None)
                else:
                    engine.clock = segment.touched = engine.clock + 1
                    renew(engine, segment, value, reads, these)
                    value, stamp = segment.value, segment.stamp
                    if type(value) is Failure:
                        is_usual = False
                    else:
                        cell.hit = (start, stop, value, stamp, None, None)
            else:
                segment.clean = True
                segment.touched = engine.clock
                value, stamp = segment.value, segment.stamp
                if type(value) is Failure:
                    is_usual = False
                else:
                    cell.hit = (start, stop, value, stamp, None, None)
            if engine.waiting or cell.busy is not claim:
                leave(engine, cell, claim)
            else:
                cell.busy = None
            stack.pop()
            if cell is root:
                return True
            cell = stack[-1]
            sole = cell.sole
            if sole is None or sole[3] is None or not is_usual:
                break
            lo, hi = start, stop
            segment, start, stop, alone, reads, is_formula = sole
            if start < lo or hi < stop:
                break
            changed = stamp != segment.stamps[0]
            these = (stamp,)
    _hand_over(engine, claim, begun)
    return False


def _sole(cell: "Cell") -> Sole | None:
    """What is to be known of the one answer that a cell remembers, if it is of the common kind."""
    segments = cell.segments
    if len(segments) != 1 or cell.shelves is not None or cell.kind < FORMULA:
        return None
    segment = segments[0]
    reads = segment.reads
    is_formula = cell.kind == FORMULA
    if not reads or type(reads) is not tuple or reads is not (cell.inputs if is_formula else cell.linked):
        return None
    sole = cell.sole = (segment, segment.lo, segment.hi, reads[0] if len(reads) == 1 else None, reads, is_formula)
    return sole


def _found(engine: "Engine", source: "Cell", t: float, start: float, stop: float) -> Hit | None:
    """A clean answer without parameters that holds at least over [start, stop)."""
    hit = source.hit
    if not hit[0] <= t < hit[1]:
        hit = peek(engine, source, t, None)
    if hit is None or start < hit[0] or hit[1] < stop or hit[5] is not None or type(hit[2]) is Failure:
        return None
    return hit


def _hand_over(engine: "Engine", claim: Claim, begun: list[Begun]) -> None:
    """Let the general way go on from where cells with many inputs have come."""
    for cell, _, _, _, values, stamps, _ in begun:
        sole = cell.sole
        if sole is None or len(stamps) <= FEW:
            continue
        _, start, stop, _, _, is_formula = sole
        if is_formula:
            claim.keep(cell, (engine.epoch, start, stop, values, stamps, None))
        else:
            claim.keep(cell, (engine.epoch, (0, len(stamps), start, stop, None)))
