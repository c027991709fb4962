"""Bringing a cell up to date, and with it whatever it needs, with a stack of its own.

On the stack lie cells to bring up to date, all at the point of the present claim, and claims to go back to when what
lies above them was read at another point. A cell bears the claim from when its inputs are first looked at, so whoever
meets a cell with the present claim on it has come round a cycle. Only opaque rules that read what was never asked for
nest, and where they nest too deep they are unwound, and what was missing is brought up to date first.

The lock is held everywhere here but while rules run. What an edit on another thread does meanwhile is found out by the
count of edits (`epoch`): whoever read something that was touched starts again.
"""

from typing import TYPE_CHECKING, Any

from reactive4d.engine.express import express
from reactive4d.engine.formulas import formula
from reactive4d.engine.frames import CHANGED, CLAIM, Claim, Crowd, CycleFound, Hit, Me, Need, Suspended, leave
from reactive4d.engine.kinds import COMPUTED, FORMULA
from reactive4d.engine.peeks import peek
from reactive4d.engine.rules import rule
from reactive4d.engine.segments import ELSEWHERE
from reactive4d.errors import CycleError, hint

if TYPE_CHECKING:
    from reactive4d.engine.cells import Cell
    from reactive4d.engine.engines import Engine
    from reactive4d.engine.points import Point

__all__ = ["bring", "cycle_error", "wait_for_transaction"]

PATIENCE = 3  # restarts after which edits wait


def bring(engine: "Engine", root: "Cell", root_t: float, root_point: "Point | None", me: Me) -> Hit:
    """Bring one cell that has no clean answer up to date at one point, and with it whatever it needs."""
    t: float
    at: float
    point: Point | None
    there: Point | None
    claim: Claim
    need: Need
    wanted: Any
    t, point = root_t, root_point
    claim = first = Claim(t, point, me)
    others: list[Claim] = []
    stack: list[Any] = [root]
    fresh: Any = root  # what was looked up just now, in vain
    me.stacks.append(stack)
    try:
        while True:
            while stack:
                if engine.owner is not None and engine.owner is not me:
                    # Nothing of what another thread's transaction has set so far is to be read.
                    wait_for_transaction(engine, me)
                    fresh = None
                cell = stack[-1]
                busy = cell.busy
                if busy is None and cell is fresh:
                    cell.busy = claim
                elif busy is not claim:
                    if cell.kind == CLAIM:
                        claim = stack.pop()
                        t, point = claim.t, claim.point
                        continue
                    if type(busy) is not Crowd or claim not in busy:
                        if cell is not fresh and peek(engine, cell, t, point) is not None:
                            stack.pop()
                            continue
                        fresh = None
                        if busy is None:
                            cell.busy = claim
                        elif _occupied(engine, cell, claim):
                            continue
                fresh = None
                try:
                    if (
                        point is None
                        and engine.owner is None
                        and not engine.logs
                        and (claim.kept is None or cell not in claim.kept)
                    ):
                        if express(engine, stack, t, claim, me):
                            continue
                        if engine.owner is not None and engine.owner is not me:
                            continue  # a transaction began while a function ran
                        cell = stack[-1]
                    kind = cell.kind
                    if kind == FORMULA:
                        need = formula(engine, cell, t, point, claim)
                    elif kind == COMPUTED:
                        need = rule(engine, cell, t, point, claim)
                    else:
                        need = None  # it has been set to a constant meanwhile
                except Suspended as deep:
                    if len(me.stacks) > 1:
                        raise
                    need = [(deep.cell, deep.t, deep.point)]
                if need is None:
                    if cell.busy is claim and not engine.waiting:
                        cell.busy = None
                    else:
                        leave(engine, cell, claim)
                    stack.pop()
                elif type(need) is list:
                    wanted = need[0]
                    if type(wanted) is ELSEWHERE:
                        wanted, at, there = wanted
                        if at != t or there is not point:
                            stack.append(claim)
                            claim = Claim(at, there, me)
                            others.append(claim)
                            t, point = at, there
                    busy = wanted.busy
                    if busy is not None and (busy is claim or (type(busy) is Crowd and claim in busy)):
                        raise CycleFound(_path(me, wanted, t))
                    stack.append(wanted)
                    fresh = wanted
                else:
                    claim.restarts += 1
                    if claim.restarts == PATIENCE + 1:
                        engine.patience += 1
            hit = root.hit
            if not (hit[0] <= root_t < hit[1] and (hit[5] is None or hit[4] is root_point)):
                hit = peek(engine, root, root_t, root_point)
            if hit is not None:
                return hit
            stack.append(root)
            t, point, claim = root_t, root_point, first
    except BaseException:
        for cell in stack:
            if cell.kind != CLAIM:
                for claim in (first, *others):
                    leave(engine, cell, claim)
        raise
    finally:
        me.stacks.pop()
        if engine.patience:
            for claim in (first, *others):
                if claim.restarts > PATIENCE:
                    engine.patience -= 1
                    CHANGED.notify_all()


def _occupied(engine: "Engine", cell: "Cell", claim: Claim) -> bool:
    """Add a claim to others; or wait for another thread at the same point, then True; a cycle if it is this thread."""
    busy = cell.busy
    others: list[Any] = list(busy) if type(busy) is Crowd else [busy]
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
            found = found or entry is head
            if found and entry.busy is not None and (not names or names[-1][0] != entry.name):
                names.append((entry.name, t))
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
