"""Bringing a cell up to date: look it up, check what it remembers, else run its rule, and remember the answer.

    bring   the whole of it, with a stack of its own for cells that declare their inputs
    peek    a clean answer, if there is one
    gather  a formula's inputs at the point
    recall  whether a remembered content still stands: its dependencies, in the order of reading, have their old stamps
    run     the rule, without the lock
    store   the answer into the table: clipped, cut off if equal, merged with its neighbour

The lock is held everywhere here but while rules run. What an edit on another thread does meanwhile is found out by the
count of edits (`epoch`): whoever read something that was touched starts again.
"""

from bisect import bisect_right
from math import nextafter
from time import perf_counter
from typing import TYPE_CHECKING, Any

from reactive4d.engine.failures import Failure, failure, raised, same_failure
from reactive4d.engine.frames import (
    CHANGED,
    DEPTH,
    LOCK,
    NEVER,
    WATCH,
    Cancelled,
    CycleFound,
    Hit,
    Me,
    Suspended,
    Task,
    here,
)
from reactive4d.engine.links import link, unlink
from reactive4d.engine.segments import EMPTY, Content, MappedReads, Segment, Table, content, covering, split
from reactive4d.engine.shelves import Shelves
from reactive4d.engine.stamps import piece
from reactive4d.errors import DepthError, EvaluationError, ParameterError, hint

if TYPE_CHECKING:
    from reactive4d.engine.cells import Axis, Cell
    from reactive4d.engine.engines import Engine
    from reactive4d.engine.points import Point

__all__ = ["ask", "bring", "peek", "read", "recheck"]

INF = float("inf")
SOURCE, AXIS, FORMULA, COMPUTED = 0, 1, 2, 3
AGAIN: Any = ()  # instead of a need: take the same task up again
PATIENCE = 3  # restarts after which edits wait
KEPT = 7  # older contents of a segment, so that with the present one there are as many as a source remembers


def ask(cell: "Cell", t: float, point: "Point | None") -> Hit:
    """Bring a cell up to date from outside of any evaluation; the hit may hold a `Failure`."""
    engine = cell.engine
    me = here.me
    with LOCK:
        WATCH[0] += 1
        try:
            hit = bring(engine, cell, t, point, me)
        except CycleFound as found:
            raise cycle_error(found.path) from None
        except RecursionError:
            raise _too_deep(cell) from None
        finally:
            WATCH[0] -= 1
            if WATCH[0] == len(engine.logs) and (engine.bytes > engine.limit or engine.unpaid):
                engine.trim()
    return hit


def read(cell: "Cell", frame: Task, t: float, point: "Point | None") -> Hit:
    """Bring a cell up to date for a rule that reads it; the rule's thread does not hold the lock."""
    engine = cell.engine
    if frame.cell.engine is not engine:
        raise EvaluationError(f"{frame.cell.name} reads {cell.name}, which belongs to another engine")
    me = frame.me
    with LOCK:
        if engine.epoch != frame.epoch:
            recheck(engine, frame)
        hit = None if engine.closed_to(me) else peek(engine, cell, t, point)
        if hit is None:
            if me.depth >= DEPTH:
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
    return hit


def recheck(engine: "Engine", task: Task) -> None:
    """Start again if an edit has touched what this evaluation has read; otherwise go on, as of now."""
    for entry, stamp in task.deps.items():
        if type(entry) is tuple:
            cell, t, point = engine.elsewhere(entry, task.t, task.point)
            hit = peek(engine, cell, t, point)
        else:
            hit = peek(engine, entry, task.t, task.point)
        if hit is None or hit[3] != stamp:
            raise Cancelled
    task.epoch = engine.epoch


def peek(engine: "Engine", cell: "Cell", t: float, point: "Point | None") -> Hit | None:
    """A clean answer, if the cell has one here; published so that the next ask needs no search."""
    kind = cell.kind
    if kind == SOURCE:
        try:
            lo, hi, value = cell.sample(t)
        except Exception as error:  # noqa: BLE001  a source's own error is an answer as well
            # What it says elsewhere is not known.
            lo, hi, value = t, nextafter(t, INF), failure(error, cell.name, t)
        a, b, stamp = piece(cell.stamps, t)
        hit = (lo if lo > a else a, hi if hi < b else b, value, stamp, None, None)
        if type(value) is not Failure and engine.owner is None:
            cell.hit = hit
        return hit
    if kind == AXIS:
        if point is None:
            return cell.hit
        return -INF, INF, point.shown(cell), 0, point, (cell,)
    segments = cell.segments
    if segments:
        i = bisect_right(cell.starts, t) - 1
        if i >= 0:
            segment = segments[i]
            if segment.clean and t < segment.hi:
                return _publish(engine, cell, segment, None, None)
    if cell.shelves is not None:
        for shelf in cell.shelves.shelves:
            table = cell.shelves.table(shelf, point)
            if table is not None:
                segment = covering(table, t)
                if segment is not None and segment.clean:
                    return _publish(engine, cell, segment, point, shelf.axes)
    return None


def _publish(engine: "Engine", cell: "Cell", segment: Segment, point: "Point | None", axes: Any) -> Hit:
    segment.touched = engine.clock
    hit = (segment.lo, segment.hi, segment.value, segment.stamp, point, axes)
    # While a transaction is open, what its owner sees is not to be seen by others.
    if type(segment.value) is not Failure and engine.owner is None:
        cell.hit = hit
    return hit


def bring(engine: "Engine", cell: "Cell", t: float, point: "Point | None", me: Me) -> Hit:
    """Bring one cell up to date at one point, and with it whatever it needs."""
    me.depth += 1
    stack: list[Task] = []
    want: Cell | None = cell
    parent: Task | None = me.frame
    try:
        while True:
            if engine.owner is not None and engine.owner is not me:
                wait_for_transaction(engine, me)
            if want is not None:
                hit = peek(engine, want, t, point)
                if hit is not None:
                    if engine.logs:
                        engine.emit("reused", want, hit[0], hit[1])
                    if not stack:
                        return hit
                else:
                    busy = want.busy
                    if busy is not None and _occupied(engine, busy, t, point, me, parent, want):
                        continue
                    task = Task(want, t, point, me, parent)
                    task.below = busy
                    want.busy = task
                    stack.append(task)
                want = None
            task = stack[-1]
            kind = task.cell.kind
            if kind == FORMULA:
                need = _formula(engine, task)
            elif kind < FORMULA:
                need = None  # it was computed, and has been set to a constant meanwhile
            else:
                try:
                    need = _computed(engine, task)
                except Suspended as deep:
                    if me.depth > 1:
                        raise
                    task.epoch = -1
                    task.candidates = None
                    need = (deep.cell, deep.t, deep.point)
            if need is AGAIN:
                if engine.owner is not None and engine.owner is not me:
                    wait_for_transaction(engine, me)
                continue
            if need is not None:
                want, t, point = need
                parent = task
                continue
            stack.pop()
            _release(engine, task)
            if stack:
                continue
            t, point = task.t, task.point
            hit = peek(engine, task.cell, t, point)
            if hit is not None:
                return hit
            want, parent = task.cell, task.parent
    except BaseException:
        for task in reversed(stack):
            _release(engine, task)
        raise
    finally:
        me.depth -= 1


def _occupied(
    engine: "Engine", busy: Task | None, t: float, point: "Point | None", me: Me, parent: Task | None, cell: "Cell"
) -> bool:
    """Whether another thread is at the same cell and point and was waited for; a cycle if this thread itself is."""
    while busy is not None:
        if busy.t == t and (busy.point is point or (busy.point and point and busy.point.given == point.given)):
            if busy.me is me:
                raise CycleFound(_path(parent, busy))
            if engine.owner is not me and not _closes_a_ring(busy, me):
                _wait_for(engine, busy, me)
                return True
        busy = busy.below
    return False


def _path(task: Task | None, head: Task) -> list[tuple[str, float]]:
    path = [(head.cell.name, head.t)]
    while task is not None and task is not head:
        path.append((task.cell.name, task.t))
        task = task.parent
    path.append((head.cell.name, head.t))
    path.reverse()
    return path


def cycle_error(path: list[tuple[str, float]]) -> Exception:
    from reactive4d.errors import CycleError

    names = [name for name, _ in path]
    if len(names) > 14:
        names[7:-7] = ["…"]
    error = CycleError(f"{names[0]} reads itself at t = {path[0][1]:g}: {' -> '.join(names)}")
    return hint(error, "let one of them read another time, as x.delay(0.1), or a constant, as attribute.source")


def _too_deep(cell: "Cell") -> Exception:
    error = DepthError(f"{cell.name}: the interpreter's stack is full")
    return hint(error, "ask from a shallower place, or build the chain from algebra or lift(f), which need no stack")


def _closes_a_ring(busy: Task, me: Me) -> bool:
    other: Me | None = busy.me
    seen: set[int] = set()
    while other is not None and id(other) not in seen:
        if other is me:
            return True
        seen.add(id(other))
        other = other.waiting.me if other.waiting is not None else None
    return False


def _wait_for(engine: "Engine", busy: Task, me: Me) -> None:
    me.waiting = busy
    engine.waiting += 1
    try:
        while not busy.done and not engine.closed_to(me):
            CHANGED.wait()
    finally:
        engine.waiting -= 1
        me.waiting = None


def wait_for_transaction(engine: "Engine", me: Me) -> None:
    engine.waiting += 1
    try:
        while engine.closed_to(me):
            CHANGED.wait()
    finally:
        engine.waiting -= 1


def _release(engine: "Engine", task: Task) -> None:
    """Give up the claim of a task on its cell and point."""
    task.done = True
    cell = task.cell
    if cell.busy is task:
        cell.busy = task.below
    else:
        other = cell.busy
        while other is not None and other.below is not task:
            other = other.below
        if other is not None:
            other.below = task.below
    if task.patient:
        engine.patience -= 1
    if engine.waiting:
        CHANGED.notify_all()


def _formula(engine: "Engine", task: Task) -> "tuple[Cell, float, Point | None] | None":
    """Answer a cell that declares its inputs; returns the input that has to be brought up to date first, if any."""
    cell = task.cell
    inputs = cell.inputs
    t, point = task.t, task.point
    if task.epoch != engine.epoch:
        task.begin(engine.epoch)
    lo, hi = task.lo, task.hi
    values, stamps = task.values, task.stamps
    mapped = type(inputs) is MappedReads
    logs = engine.logs
    bad: Failure | None = None
    for i in range(task.index, len(inputs)):
        source = inputs[i]
        if mapped and type(source) is tuple:
            entry = source
            source, at, there = engine.elsewhere(entry, t, point)
            hit = peek(engine, source, at, there)
            if hit is None:
                task.index, task.lo, task.hi = i, lo, hi
                return source, at, there
            hit = engine.brought_back(entry, hit, at, t)
        else:
            hit = source.hit
            if not (hit[0] <= t < hit[1] and (hit[5] is None or hit[4] is point)):
                hit = peek(engine, source, t, point)
                if hit is None:
                    task.index, task.lo, task.hi = i, lo, hi
                    return source, t, point
        if hit[0] > lo:
            lo = hit[0]
        if hit[1] < hi:
            hi = hit[1]
        values.append(hit[2])
        stamps.append(hit[3])
        if logs:
            engine.emit("reused", source, hit[0], hit[1])
        if hit[5] is not None:
            problem = add_axes(task, hit[5])
            if problem is not None:
                bad = failure(problem, cell.name, t)
                break
        if type(hit[2]) is Failure:
            bad = failure(hit[2].error, cell.name, t, hit[2])
            break
    task.lo, task.hi = lo, hi
    reads = inputs if bad is None else _prefix(inputs, len(stamps))
    these = tuple(stamps)
    table = cell if task.axes is None else _table(cell, task.axes, point)
    segment = covering(table, t)
    if segment is not None and not segment.clean:
        if segment.stamps == these and segment.reads == reads:
            _stand(engine, cell, table, segment, task, None)
            return None
        if segment.older and engine.revivals > segment.retired:
            for old in segment.older:
                if old[3] == these and old[2] == reads:
                    _stand(engine, cell, table, segment, task, old)
                    return None
    if bad is not None:
        value: Any = bad
    else:
        runs = cell.runs
        timed = not runs & 15
        LOCK.release()
        try:
            started = perf_counter() if timed else 0.0
            value = cell.function(*values)
            if type(value) is not float:
                value = engine.freeze(value)
            if timed:
                engine.timed(cell, perf_counter() - started)
        except RecursionError as error:
            value = failure(error, cell.name, t)
        except Exception as error:  # noqa: BLE001  an exception is an answer
            value = failure(error, cell.name, t)
        finally:
            LOCK.acquire()
        cell.runs = runs + 1
        if task.epoch != engine.epoch and not _unmoved(engine, task, reads, these):
            _again(engine, task)
            return AGAIN
    _store(engine, cell, table, task, value, reads, these)
    return None


def _prefix(inputs: tuple[Any, ...], n: int) -> tuple[Any, ...]:
    return inputs if n == len(inputs) else type(inputs)(inputs[:n])


def add_axes(task: Task, axes: "tuple[Axis, ...]") -> Exception | None:
    """Note that the answer depends on these parameters; an error if two different ones have one name."""
    known = task.axes
    if known is None:
        known = task.axes = {}
    for axis in axes:
        other = known.setdefault(axis.name, axis)
        if other is not axis:
            error = ParameterError(f"{task.cell.name} reads two different parameters that are both called {axis.name!r}")
            return hint(error, "make one Parameter and use it twice, or give them different names")
    return None


def _table(cell: "Cell", axes: "dict[str, Axis]", point: "Point | None") -> Table:
    shelves = cell.shelves
    if shelves is None:
        shelves = cell.shelves = Shelves()
    names = tuple([axes[name] for name in sorted(axes)]) if len(axes) > 1 else tuple(axes.values())
    table = shelves.table(shelves.shelf(names), point, make=True)
    assert table is not None
    return table


def _unmoved(engine: "Engine", task: Task, reads: tuple[Any, ...], stamps: tuple[int, ...]) -> bool:
    """Whether everything that was read is still clean and as it was."""
    for entry, stamp in zip(reads, stamps, strict=True):
        if type(entry) is tuple:
            cell, t, point = engine.elsewhere(entry, task.t, task.point)
            hit = peek(engine, cell, t, point)
        else:
            hit = peek(engine, entry, task.t, task.point)
        if hit is None or hit[3] != stamp:
            return False
    return True


def _again(engine: "Engine", task: Task) -> None:
    """Let a task start again; after a few times edits wait for it."""
    task.epoch = -1
    task.candidates = None
    task.restarts += 1
    if task.restarts > PATIENCE and not task.patient:
        task.patient = True
        engine.patience += 1


def _computed(engine: "Engine", task: Task) -> "tuple[Cell, float, Point | None] | None":
    """Answer a cell whose rule is opaque; returns the dependency that has to be brought up to date first, if any."""
    cell, t, point = task.cell, task.t, task.point
    if task.candidates is None or task.epoch != engine.epoch:
        task.begin(engine.epoch)
        task.candidates = _candidates(engine, cell, t, point)
    while task.candidates:
        segment, old, table = task.candidates[-1]
        outcome = _recall(engine, task, segment.reads if old is None else old[2], segment.stamps if old is None else old[3])
        if type(outcome) is tuple:
            return outcome
        # Everything stands; but only where the table is filed under all the parameters that are read by now.
        if outcome and _filed(cell, table, task.axes) and covering(table, t) is segment and not segment.clean:
            _stand(engine, cell, table, segment, task, old)
            return None
        task.candidates.pop()
        task.begin(engine.epoch)
    return _run(engine, task)


def _candidates(engine: "Engine", cell: "Cell", t: float, point: "Point | None") -> list[Any]:
    """The remembered contents that may still stand at a point: (segment, older content or None, table)."""
    found: list[Any] = []
    tables: list[Table] = [cell]
    if cell.shelves is not None:
        for shelf in cell.shelves.shelves:
            table = cell.shelves.table(shelf, point)
            if table is not None:
                tables.append(table)
    for table in reversed(tables):
        segment = covering(table, t)
        if segment is None:
            continue
        if segment.older and engine.revivals > segment.retired:
            found.extend((segment, old, table) for old in reversed(segment.older))
        found.append((segment, None, table))
    return found


def _filed(cell: "Cell", table: Table, axes: "dict[str, Axis] | None") -> bool:
    if axes is None:
        return True
    if table is cell:
        return False
    for shelf in cell.shelves.shelves:
        if any(other is table for other in shelf.tables.values()):
            return all(axis in shelf.axes for axis in axes.values())
    return False


def _recall(engine: "Engine", task: Task, reads: tuple[Any, ...], stamps: tuple[int, ...]) -> Any:
    """Walk remembered dependencies in the order of reading: True if all stand, False at the first that does not.

    In order, and no further than the first change: a later dependency may exist only because of an earlier one's value.
    """
    t, point = task.t, task.point
    for i in range(task.index, len(reads)):
        source = reads[i]
        if type(source) is tuple:
            entry = source
            source, at, there = engine.elsewhere(entry, t, point)
            hit = peek(engine, source, at, there)
            if hit is None:
                task.index = i
                return source, at, there
            hit = engine.brought_back(entry, hit, at, t)
        else:
            hit = source.hit
            if not (hit[0] <= t < hit[1] and (hit[5] is None or hit[4] is point)):
                hit = peek(engine, source, t, point)
                if hit is None:
                    task.index = i
                    return source, t, point
        if hit[3] != stamps[i]:
            return False
        if hit[0] > task.lo:
            task.lo = hit[0]
        if hit[1] < task.hi:
            task.hi = hit[1]
        if hit[5] is not None and add_axes(task, hit[5]) is not None:
            return False
    return True


def _run(engine: "Engine", task: Task) -> "tuple[Cell, float, Point | None] | None":
    """Run an opaque rule, without the lock, and store its answer."""
    cell, me = task.cell, task.me
    outer = me.frame
    me.frame = task
    runs = cell.runs
    timed = not runs & 15
    task.nested = 0.0 if timed else -1.0
    value: Any = None
    LOCK.release()
    try:
        started = perf_counter() if timed else 0.0
        value = cell.rule()
        if type(value) is not float:
            value = engine.freeze(value)
        if timed:
            engine.timed(cell, perf_counter() - started - task.nested)
    except Cancelled:
        value = Cancelled
    except RecursionError as error:
        if me.depth > 1:
            # The stack is full because of where this rule stands: begin again from below.
            raise Suspended(cell, task.t, task.point) from None
        value = failure(error, cell.name, task.t)
    except Exception as error:  # noqa: BLE001  an exception is an answer
        passed = task.raised
        source = passed[1] if passed is not None and passed[0] is error else None
        value = failure(error, cell.name, task.t, source)
    finally:
        me.frame = outer
        LOCK.acquire()
    cell.runs = runs + 1
    if value is not Cancelled and task.epoch != engine.epoch:
        try:
            recheck(engine, task)
        except Cancelled:
            value = Cancelled
    if value is Cancelled:
        _again(engine, task)
        return AGAIN
    deps = task.deps
    reads = MappedReads(deps) if task.mapped else tuple(deps)
    table = cell if task.axes is None else _table(cell, task.axes, task.point)
    _store(engine, cell, table, task, value, reads, tuple(deps.values()))
    return None


def _stand(
    engine: "Engine", cell: "Cell", table: Table, segment: Segment, task: Task, old: Content | None
) -> None:
    """Find a segment in check as it was (or as an older content says) over the interval that its dependencies allow."""
    lo, hi = max(task.lo, segment.lo), min(task.hi, segment.hi)
    if lo > segment.lo or hi < segment.hi:
        split(table, segment, lo, hi)
    if old is not None:
        rest = tuple([other for other in segment.older if other is not old])
        segment.older = (content(segment), *rest)
        segment.retired = engine.revivals - 1
        segment.value, segment.stamp, segment.reads, segment.stamps = old
        link(cell, segment.reads)
        cell.linked = segment.reads
    elif segment.reads is not cell.linked:
        link(cell, segment.reads)
        cell.linked = segment.reads
    segment.clean = True
    segment.touched = engine.clock
    if table is not cell:
        cell.shelves.cover = None
    if engine.logs:
        engine.emit("validated" if old is None else "restored", cell, lo, hi)
    _merge(table, segment)
    _publish(
        engine,
        cell,
        segment,
        None if table is cell else task.point,
        None if table is cell or task.axes is None else _axes_of(cell, table),
    )


def _axes_of(cell: "Cell", table: Table) -> "tuple[Axis, ...] | None":
    if table is cell:
        return None
    for shelf in cell.shelves.shelves:
        if any(other is table for other in shelf.tables.values()):
            return shelf.axes
    return None


def _alike(these: tuple[Content, ...], those: tuple[Content, ...]) -> bool:
    """Whether two segments said the same before: an older content holds only where it was found."""
    return len(these) == len(those) and all(
        a[1] == b[1] and a[3] == b[3] and a[2] == b[2] for a, b in zip(these, those, strict=True)
    )


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


def _store(
    engine: "Engine",
    cell: "Cell",
    table: Table,
    task: Task,
    value: Any,
    reads: tuple[Any, ...],
    stamps: tuple[int, ...],
) -> None:
    """Remember an answer: clip it to the gap, or to the segment in check that it replaces; cut off if it is the same."""
    t, lo, hi = task.t, task.lo, task.hi
    old_reads: tuple[Any, ...] | None = None
    if reads != cell.linked:
        old_reads = cell.linked
        link(cell, reads)
        cell.linked = reads
    else:
        reads = cell.linked
    engine.clock += 1
    segments = table.segments
    if len(segments) == 1 and segments[0].lo <= t < segments[0].hi:
        i, segment = 0, segments[0]
    elif segments:
        i = bisect_right(table.starts, t) - 1
        segment = segments[i] if i >= 0 and t < segments[i].hi else None
    else:
        table.starts, table.segments = [], []
        segments, i, segment = table.segments, -1, None
    if segment is None:
        if i >= 0 and segments[i].hi > lo:
            lo = segments[i].hi
        if i + 1 < len(segments) and segments[i + 1].lo < hi:
            hi = segments[i + 1].lo
        stamp = engine.stamp()
        segment = Segment(lo, hi, value, stamp, reads, stamps, engine.clock)
        if i >= 0 and segments[i].hi == lo and segments[i].clean and segments[i].stamps == stamps:
            _adopt(engine, segment, segments[i])
        elif i + 1 < len(segments) and segments[i + 1].lo == hi and segments[i + 1].clean:
            _adopt(engine, segment, segments[i + 1])
        table.starts.insert(i + 1, lo)
        segments.insert(i + 1, segment)
        engine.remembered(cell, segment)
        _merge(table, segment)
        if engine.logs:
            engine.emit("evaluated", cell, lo, hi)
    elif segment.clean:
        # Another thread was quicker, or this one came by here on another way.
        if engine.logs:
            engine.emit("evaluated", cell, lo, hi)
    else:
        if lo < segment.lo:
            lo = segment.lo
        if hi > segment.hi:
            hi = segment.hi
        if lo > segment.lo or hi < segment.hi:
            split(table, segment, lo, hi)
        before = segment.value
        if (
            before is value
            or (type(value) is float and type(before) is float and value == before and value != 0.0)
            or _equal(engine, before, value)
        ):
            equal = True
        else:
            equal = False
        older = segment.older
        segment.older = ((before, segment.stamp, segment.reads, segment.stamps), *older[: KEPT - 1])
        segment.retired = engine.revivals
        if not equal:
            segment.value = value
            segment.stamp = engine.stamp()
            engine.grown(cell, value)
        segment.reads = reads
        segment.stamps = stamps
        segment.clean = True
        segment.touched = engine.clock
        if engine.logs:
            engine.emit("evaluated", cell, lo, hi)
            if equal:
                engine.emit("cut off", cell, lo, hi)
        if len(segments) > 1:
            _merge(table, segment)
    if old_reads and cell.shelves is None and len(cell.segments) == 1:
        # No other segment is left which could still list what this one no longer reads.
        unlink(cell, old_reads, segment.reads)
    if table is cell:
        _publish(engine, cell, segment, None, None)
    else:
        cell.shelves.cover = None
        _publish(engine, cell, segment, task.point, _axes_of(cell, table))


def _adopt(engine: "Engine", segment: Segment, neighbour: Segment) -> None:
    """Give a new segment its neighbour's stamp where it says the same for the same reasons."""
    if (
        neighbour.stamps == segment.stamps
        and neighbour.reads == segment.reads
        and _equal(engine, neighbour.value, segment.value)
    ):
        segment.value, segment.stamp, segment.stamps = neighbour.value, neighbour.stamp, neighbour.stamps


def _equal(engine: "Engine", a: Any, b: Any) -> bool:
    if type(a) is Failure or type(b) is Failure:
        return type(a) is type(b) and same_failure(a, b, same=engine.same)
    return a is b or engine.same(a, b)


