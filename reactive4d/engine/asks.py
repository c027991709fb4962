"""Bringing a cell up to date: look it up, check what it remembers, else run its rule, and remember the answer.

    bring    the whole of it, with a stack of its own: only opaque rules that read what was never asked for nest
    peek     a clean answer, if there is one
    formula  gather the inputs; if they are as they were the answer stands, else the function runs
    task     an opaque rule: its remembered dependencies are checked in the order of reading, else it runs
    store    the answer into the table: clipped, cut off if equal, merged with its neighbour

The lock is held everywhere here but while rules run. What an edit on another thread does meanwhile is found out by the
count of edits (`epoch`): whoever read something that was touched starts again.

On the stack lie cells to bring up to date, all at the point of the present claim; tasks; and claims to go back to when
what lies above them was read at another point. A cell bears the claim from when its inputs were first looked at, so
whoever meets a cell with the present claim on it has come round a cycle.
"""

from bisect import bisect_right
from math import nextafter
from time import perf_counter
from typing import TYPE_CHECKING, Any

from reactive4d.engine.evictions import CONTENT
from reactive4d.engine.failures import Failure, failure, same_failure
from reactive4d.engine.frames import (
    CHANGED,
    CLAIM,
    DEPTH,
    LOCK,
    TASK,
    Cancelled,
    Claim,
    Crowd,
    CycleFound,
    Hit,
    Me,
    Suspended,
    Task,
    here,
)
from reactive4d.engine.hits import watch
from reactive4d.engine.links import link, unlink
from reactive4d.engine.segments import Content, MappedReads, Segment, Table, content, covering, split
from reactive4d.engine.shelves import Shelves
from reactive4d.engine.stamps import piece
from reactive4d.errors import CycleError, DepthError, EvaluationError, ParameterError, hint

if TYPE_CHECKING:
    from reactive4d.engine.cells import Axis, Cell
    from reactive4d.engine.engines import Engine
    from reactive4d.engine.points import Point

__all__ = ["AXIS", "COMPUTED", "FORMULA", "SOURCE", "add_axes", "ask", "bring", "peek", "read", "recheck"]

INF = float("inf")
SOURCE, AXIS, FORMULA, COMPUTED = 0, 1, 2, 3
FEW = 4  # inputs that are cheaper looked at again than remembered
PATIENCE = 3  # restarts after which edits wait
KEPT = 7  # older contents of a segment, so that with the present one there are as many as a source remembers

acquire, release = LOCK.acquire, LOCK.release


def ask(cell: "Cell", t: float, point: "Point | None") -> Hit:
    """Bring a cell up to date from outside of any evaluation; the hit may hold a `Failure`."""
    engine = cell.engine
    with LOCK:
        watch(1)
        try:
            hit = bring(engine, cell, t, point, here.me)
            if point is None and engine.owner is None and type(hit[2]) is not Failure:
                cell.hot = hit[:3]
        except CycleFound as found:
            raise cycle_error(found.path) from None
        except RecursionError:
            error = DepthError(f"{cell.name}: the interpreter's stack is full")
            raise hint(error, "ask from a shallower place; algebra and lift(f) need no stack, opaque rules do") from None
        finally:
            if not watch(-1) and (engine.bytes > engine.limit or engine.unpaid):
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
        hit = None if engine.owner is not None and engine.owner is not me else peek(engine, cell, t, point)
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
    if not _unmoved(engine, task.t, task.point, tuple(task.deps), tuple(task.deps.values())):
        raise Cancelled
    task.epoch = engine.epoch


def _unmoved(
    engine: "Engine", t: float, point: "Point | None", reads: tuple[Any, ...], stamps: tuple[int, ...]
) -> bool:
    """Whether everything that was read is still clean and as it was."""
    for entry, stamp in zip(reads, stamps, strict=True):
        cell, at, there = engine.elsewhere(entry, t, point) if type(entry) is tuple else (entry, t, point)
        hit = peek(engine, cell, at, there)
        if hit is None or hit[3] != stamp:
            return False
    return True


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
        return -INF, INF, point.shown(cell), 0, point, (cell,)
    segments = cell.segments
    if segments:
        i = bisect_right(cell.starts, t) - 1 if len(segments) > 1 else 0
        if i >= 0:
            segment = segments[i]
            if segment.clean and segment.lo <= t < segment.hi:
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
    if engine.owner is None and type(segment.value) is not Failure:
        cell.hit = hit
    return hit


def bring(engine: "Engine", root: "Cell", root_t: float, root_point: "Point | None", me: Me) -> Hit:
    """Bring one cell up to date at one point, and with it whatever it needs."""
    hit = peek(engine, root, root_t, root_point) if engine.owner is None or engine.owner is me else None
    if hit is not None:
        if engine.logs:
            engine.emit("reused", root, hit[0], hit[1])
        return hit
    t, point = root_t, root_point
    claim = Claim(t, point, me)
    claims = [claim]
    stack: list[Any] = [root]
    fresh: Any = root  # what was looked up just now, in vain
    me.depth += 1
    me.stacks.append(stack)
    try:
        while True:
            if engine.owner is not None and engine.owner is not me:
                # Nothing of what another thread's transaction has set so far is to be read.
                wait_for_transaction(engine, me)
                fresh = None
            if not stack:
                hit = root.hit
                if not (hit[0] <= root_t < hit[1] and (hit[5] is None or hit[4] is root_point)):
                    hit = peek(engine, root, root_t, root_point)
                    if hit is None:
                        stack.append(root)
                        t, point, claim, fresh = root_t, root_point, claims[0], root
                        continue
                return hit
            entry = stack[-1]
            kind = entry.kind
            if kind == CLAIM:
                claim = stack.pop()
                t, point = claim.t, claim.point
                continue
            if kind == TASK:
                cell = entry.cell
                if cell.kind < FORMULA:  # it has been set to a constant meanwhile
                    _leave(engine, cell, claim)
                    stack.pop()
                    continue
            else:
                cell = entry
                if kind < FORMULA:
                    stack.pop()
                    continue
                busy = cell.busy
                if busy is not claim and not (type(busy) is Crowd and claim in busy):
                    if cell is not fresh and peek(engine, cell, t, point) is not None:
                        stack.pop()
                        continue
                    fresh = None
                    if busy is None:
                        cell.busy = claim
                    elif _occupied(engine, cell, claim):
                        continue
                if kind == COMPUTED:
                    entry = stack[-1] = Task(cell, t, point, me)
                    kind = TASK
            if kind == TASK:
                try:
                    need = _task(engine, entry, claim)
                except Suspended as deep:
                    if me.depth > 1:
                        raise
                    entry.candidates = None
                    need = [(deep.cell, deep.t, deep.point)]
            else:
                need = _formula(engine, cell, t, point, claim)
            if need is None:
                if cell.busy is claim and not engine.waiting:
                    cell.busy = None
                else:
                    _leave(engine, cell, claim)
                stack.pop()
            elif type(need) is list:
                wanted = need[0]
                if type(wanted) is tuple:
                    wanted, at, there = wanted
                    if at != t or there is not point:
                        stack.append(claim)
                        claim = Claim(at, there, me)
                        claims.append(claim)
                        t, point = at, there
                busy = wanted.busy
                if busy is not None and (busy is claim or (type(busy) is Crowd and claim in busy)):
                    raise CycleFound(_path(me, wanted, t))
                stack.append(wanted)
                fresh = wanted
            else:
                claim.restarts += 1
                if claim.restarts > PATIENCE and not claim.patient:
                    claim.patient = True
                    engine.patience += 1
    except BaseException:
        for entry in stack:
            if entry.kind != CLAIM:
                for other in claims:
                    _leave(engine, entry.cell if entry.kind == TASK else entry, other)
        raise
    finally:
        me.depth -= 1
        me.stacks.pop()
        for other in claims:
            if other.patient:
                engine.patience -= 1
                CHANGED.notify_all()


def _occupied(engine: "Engine", cell: "Cell", claim: Claim) -> bool:
    """Add a claim to others; or wait for another thread at the same point, then True; a cycle if it is this thread."""
    busy = cell.busy
    others = list(busy) if type(busy) is Crowd else [busy]
    for other in others:
        if other.t == claim.t and _same_point(other.point, claim.point):
            if other.me is claim.me:
                raise CycleFound(_path(claim.me, cell, claim.t))
            if engine.owner is not claim.me and not _closes_a_ring(other, claim.me):
                _wait_for(engine, cell, other, claim.me)
                return True
    cell.busy = Crowd([*others, claim])
    return False


def _same_point(a: "Point | None", b: "Point | None") -> bool:
    return a is b or (a is not None and b is not None and a.given == b.given)


def _path(me: Me, head: "Cell", t: float) -> list[tuple[str, float]]:
    """The cells under way on this thread, from `head` round to `head`."""
    names: list[tuple[str, float]] = []
    found = False
    for stack in me.stacks:
        for entry in stack:
            if entry.kind == CLAIM:
                continue
            cell = entry.cell if entry.kind == TASK else entry
            found = found or cell is head
            if found and cell.busy is not None and (not names or names[-1][0] != cell.name):
                names.append((cell.name, t))
    if len(names) > 1 and names[-1][0] == head.name:
        names.pop()  # it was about to be looked at once more
    return [*(names or [(head.name, t)]), (head.name, t)]


def cycle_error(path: list[tuple[str, float]]) -> Exception:
    """The error for a cell that reads itself, with the way round."""
    names = [name for name, _ in path]
    if len(names) > 14:
        names[7:-7] = ["…"]
    error = CycleError(f"{names[0]} reads itself at t = {path[0][1]:g}: {' -> '.join(names)}")
    return hint(error, "let one of them read another time, as x.delay(0.1), or a constant, as attribute.source")


def _closes_a_ring(claim: Claim, me: Me) -> bool:
    other: Me | None = claim.me
    seen: set[int] = set()
    while other is not None and id(other) not in seen:
        if other is me:
            return True
        seen.add(id(other))
        other = other.waiting.me if other.waiting is not None else None
    return False


def _wait_for(engine: "Engine", cell: "Cell", claim: Claim, me: Me) -> None:
    me.waiting = claim
    engine.waiting += 1
    try:
        while cell.busy is claim or (type(cell.busy) is Crowd and claim in cell.busy):
            if engine.owner is not None and engine.owner is not me:
                break
            CHANGED.wait()
    finally:
        engine.waiting -= 1
        me.waiting = None


def wait_for_transaction(engine: "Engine", me: Me) -> None:
    """Wait until no other thread has a transaction open."""
    engine.waiting += 1
    try:
        while engine.owner is not None and engine.owner is not me:
            CHANGED.wait()
    finally:
        engine.waiting -= 1


def _leave(engine: "Engine", cell: "Cell", claim: Claim) -> None:
    """Take a claim off a cell."""
    busy = cell.busy
    if busy is claim:
        cell.busy = None
    elif type(busy) is Crowd and claim in busy:
        busy.remove(claim)
        if len(busy) == 1:
            cell.busy = busy[0]
    if engine.waiting:
        CHANGED.notify_all()


def _formula(engine: "Engine", cell: "Cell", t: float, point: "Point | None", claim: Claim) -> Any:
    """Answer a cell that declares its inputs: None when done, [what is missing], or True to try again."""
    inputs = cell.inputs
    kept = claim.kept.pop(cell, None) if claim.kept else None
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
        if mapped and type(source) is tuple:
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
                        claim.kept[cell] = engine.epoch, lo, hi, values, stamps, axes
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
        table = cell if axes is None else _table(cell, axes, point)
        segment = covering(table, t)
    if segment is not None and not segment.clean:
        if segment.stamps == these and segment.reads == reads:
            _stand(engine, cell, table, segment, lo, hi, point, None)
            return None
        if segment.older and engine.revivals > segment.retired:
            for old in segment.older:
                if old[3] == these and old[2] == reads:
                    _stand(engine, cell, table, segment, lo, hi, point, old)
                    return None
    if bad is not None:
        _store(engine, cell, table, t, lo, hi, point, bad, reads, these)
        return None
    runs = cell.runs
    epoch = engine.epoch
    release()
    try:
        if runs & 15:
            value = cell.function(*values)
        else:
            started = perf_counter()
            value = cell.function(*values)
            engine.timed(cell, perf_counter() - started)
        if type(value) is not float:
            value = engine.freeze(value)
    except Exception as error:  # noqa: BLE001  an exception is an answer
        value = failure(error, cell.name, t)
    finally:
        acquire()
    cell.runs = runs + 1
    if epoch != engine.epoch and not _unmoved(engine, t, point, reads, these):
        return True
    if (
        table is cell
        and segment is not None
        and len(segments) == 1
        and segments[0] is segment
        and not segment.clean
        and lo <= segment.lo
        and segment.hi <= hi
        and cell.linked is inputs
        and not logs
    ):
        # What `_store` would do, for the commonest of cases.
        engine.clock += 1
        _renew(engine, segment, value, inputs, these)
        _publish(engine, cell, segment, None, None)
        return None
    _store(engine, cell, table, t, lo, hi, point, value, reads, these)
    return None


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


def _table(cell: "Cell", axes: "dict[str, Axis]", point: "Point | None") -> Table:
    shelves = cell.shelves
    if shelves is None:
        shelves = cell.shelves = Shelves()
    names = tuple([axes[name] for name in sorted(axes)]) if len(axes) > 1 else tuple(axes.values())
    table = shelves.table(shelves.shelf(names), point, make=True)
    assert table is not None
    return table


def _task(engine: "Engine", task: Task, claim: Claim) -> Any:
    """Answer a cell whose rule is opaque: None when done, [what is missing], or True to try again."""
    cell, t, point = task.cell, task.t, task.point
    if task.candidates is None or task.epoch != engine.epoch:
        task.begin(engine.epoch)
        task.candidates = _candidates(engine, cell, t, point)
    while task.candidates:
        segment, old, table = task.candidates[-1]
        reads, stamps = (segment.reads, segment.stamps) if old is None else (old[2], old[3])
        outcome = _recall(engine, task, reads, stamps)
        if type(outcome) is list:
            return outcome
        # Everything stands; but only where the table is filed under all the parameters that are read by now.
        if outcome and (task.axes is None or _is_filed(cell, table, task.axes)):
            if not segment.clean and covering(table, t) is segment:
                _stand(engine, cell, table, segment, task.lo, task.hi, point, old)
                return None
        task.candidates.pop()
        task.begin(engine.epoch)
    return _run(engine, task)


def _candidates(engine: "Engine", cell: "Cell", t: float, point: "Point | None") -> list[Any]:
    """The remembered contents that may still stand at a point: (segment, older content or None, table)."""
    found: list[Any] = []
    if cell.shelves is not None:
        for shelf in reversed(cell.shelves.shelves):
            table = cell.shelves.table(shelf, point)
            if table is not None:
                _add_candidates(engine, table, t, found)
    if cell.segments:
        _add_candidates(engine, cell, t, found)
    return found


def _add_candidates(engine: "Engine", table: Table, t: float, found: list[Any]) -> None:
    segment = covering(table, t)
    if segment is not None:
        if segment.older and engine.revivals > segment.retired:
            found.extend([(segment, old, table) for old in reversed(segment.older)])
        found.append((segment, None, table))


def _is_filed(cell: "Cell", table: Table, axes: "dict[str, Axis]") -> bool:
    filed = _axes_of(cell, table)
    return filed is not None and all(axis in filed for axis in axes.values())


def _axes_of(cell: "Cell", table: Table) -> "tuple[Axis, ...] | None":
    if table is cell:
        return None
    for shelf in cell.shelves.shelves:
        for other in shelf.tables.values():
            if other is table:
                return shelf.axes
    return None


def _recall(engine: "Engine", task: Task, reads: tuple[Any, ...], stamps: tuple[int, ...]) -> Any:
    """Walk remembered dependencies in the order of reading: True if all stand, False at the first that does not.

    In order, and no further than the first change: a later dependency may exist only because of an earlier one's value.
    """
    t, point = task.t, task.point
    i = task.index
    for i in range(i, len(reads)):
        source = reads[i]
        if type(source) is tuple:
            entry = source
            source, at, there = engine.elsewhere(entry, t, point)
            hit = peek(engine, source, at, there)
            if hit is None:
                task.index = i
                return [(source, at, there)]
            hit = engine.brought_back(entry, hit, at, t)
        else:
            hit = source.hit
            if not (hit[0] <= t < hit[1] and (hit[5] is None or hit[4] is point)):
                hit = peek(engine, source, t, point)
                if hit is None:
                    task.index = i
                    return [source]
        if hit[3] != stamps[i]:
            return False
        if hit[0] > task.lo:
            task.lo = hit[0]
        if hit[1] < task.hi:
            task.hi = hit[1]
        if hit[5] is not None:
            task.axes, problem = add_axes(task.cell, task.axes, hit[5])
            if problem is not None:
                return False
    return True


def _run(engine: "Engine", task: Task) -> Any:
    """Run an opaque rule, without the lock, and store its answer: None when done, or True to try again."""
    cell, me = task.cell, task.me
    task.run(engine.epoch)
    outer = me.frame
    me.frame = task
    runs = cell.runs
    value: Any = None
    release()
    try:
        if runs & 15:
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
        if me.depth > 1:
            # The stack is full because of where this rule stands: begin again from below.
            raise Suspended(cell, task.t, task.point) from None
        value = failure(error, cell.name, task.t)
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
        task.candidates = None
        return True
    reads = MappedReads(deps) if task.mapped else tuple(deps)
    table = cell if task.axes is None else _table(cell, task.axes, task.point)
    _store(engine, cell, table, task.t, task.lo, task.hi, task.point, value, reads, tuple(deps.values()))
    return None


def _stand(
    engine: "Engine",
    cell: "Cell",
    table: Table,
    segment: Segment,
    lo: float,
    hi: float,
    point: "Point | None",
    old: Content | None,
) -> None:
    """Find a segment in check as it was (or as an older content says) over the interval that its dependencies allow."""
    lo, hi = max(lo, segment.lo), min(hi, segment.hi)
    if lo > segment.lo or hi < segment.hi:
        split(table, segment, lo, hi)
    if old is not None:
        rest = tuple([other for other in segment.older if other is not old])
        segment.older = (content(segment), *rest)
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
        _publish(engine, cell, segment, None, None)
    else:
        cell.shelves.cover = None
        _publish(engine, cell, segment, point, _axes_of(cell, table))


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


def _alike(these: tuple[Content, ...], those: tuple[Content, ...]) -> bool:
    """Whether two segments said the same before: an older content holds only where it was found."""
    return len(these) == len(those) and all(
        a[1] == b[1] and a[3] == b[3] and a[2] == b[2] for a, b in zip(these, those, strict=True)
    )


def _store(
    engine: "Engine",
    cell: "Cell",
    table: Table,
    t: float,
    lo: float,
    hi: float,
    point: "Point | None",
    value: Any,
    reads: tuple[Any, ...],
    stamps: tuple[int, ...],
) -> None:
    """Remember an answer: clip it to the gap, or to the segment in check that it replaces; cut off if it is the same."""
    linked = cell.linked
    if reads is not linked:
        if reads == linked:
            reads = linked
        else:
            link(cell, reads)
            cell.linked = reads
    engine.clock += 1
    segments = table.segments
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
        cut_off = _renew(engine, segment, value, reads, stamps)
        if logs:
            engine.emit("evaluated", cell, lo, hi)
            if cut_off:
                engine.emit("cut off", cell, lo, hi)
        if len(segments) > 1:
            _merge(table, segment)
    if table is cell:
        _publish(engine, cell, segment, None, None)
    else:
        cell.shelves.cover = None
        _publish(engine, cell, segment, point, _axes_of(cell, table))


def _renew(engine: "Engine", segment: Segment, value: Any, reads: tuple[Any, ...], stamps: tuple[int, ...]) -> bool:
    """Give a segment in check its new answer, and keep the old one for undoing; True if they are the same."""
    before = segment.value
    segment.older = ((before, segment.stamp, segment.reads, segment.stamps), *segment.older[: KEPT - 1])
    segment.retired = engine.revivals
    segment.reads = reads
    segment.stamps = stamps
    segment.clean = True
    if before is value or _equal(engine, before, value):
        return True
    segment.value = value
    segment.stamp = engine.stamp()
    engine.bytes += CONTENT + (24 if type(value) is float else engine.measure(value))
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


def _equal(engine: "Engine", a: Any, b: Any) -> bool:
    if type(a) is float and type(b) is float and a != b:
        return a != a and b != b
    if type(a) is Failure or type(b) is Failure:
        return type(a) is type(b) and same_failure(a, b, same=engine.same)
    return engine.same(a, b)
