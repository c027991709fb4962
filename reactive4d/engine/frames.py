"""Who is asking: the evaluation that a thread is in, where it waits, and the ways in which an evaluation is unwound.

A `Claim` says which thread is bringing cells up to date, and at which point: while it stands on a cell, other threads
wait for the answer instead of computing it too. A `Task` is an opaque rule that runs: it is the thread's `frame`, every
read adds what was read to `deps` and narrows the interval over which the answer will hold. `Me` is a thread; the thread
local `here` finds it.
"""

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from reactive4d.errors import EvaluationError, hint

if TYPE_CHECKING:
    from reactive4d.engine.cells import Cell
    from reactive4d.engine.engines import Engine
    from reactive4d.engine.points import Point

__all__ = ["CHANGED", "CLAIM", "LOCK", "NEVER", "Cancelled", "Claim", "Crowd", "CycleFound", "Hit", "Me", "Need"]
__all__ += ["Suspended", "Task", "entered_twice", "here", "is_held", "leave"]

INF = float("inf")
CLAIM = 4  # as a cell's kind

# (lo, hi, value, stamp, point, axes): where an answer holds, the answer, its stamp, the point that it was asked at
# (None where the default point will do) and the parameters that it read (None where it read none).
Hit = tuple[float, float, Any, int, "Point | None", "tuple[Any, ...] | None"]

# What is missing before a cell can be answered, a cell or (cell, t, point), as a list of one; True to try again.
Need = list[Any] | bool | None

# The hit of a cell that has nothing to hand out: no time lies in it.
NEVER: Hit = (INF, -INF, None, 0, None, None)

# One lock guards the bookkeeping of all engines; rules run without it.
# The thread that has it can take it again, so that a finalizer, which may run anywhere, does not wait for itself for
# ever: whoever would use the engine there finds `is_held`, and is refused.
LOCK = threading.RLock()
CHANGED = threading.Condition(LOCK)

# How many opaque rules may run inside of one another before the evaluation is unwound and begun again from below:
# each takes five interpreter frames, of which a thousand is the usual limit.
DEPTH = 60


class Cancelled(BaseException):
    """What this evaluation has read was edited meanwhile: it starts again. Never an answer."""


class Suspended(BaseException):
    """This evaluation lies too deep: the outermost one brings `cell` up to date first, then starts again."""

    def __init__(self, cell: "Cell", t: float, point: "Point | None") -> None:
        super().__init__(cell, t, point)
        self.cell, self.t, self.point = cell, t, point


class CycleFound(BaseException):
    """A cell reads itself at one point. No rule can catch it, so that every way into a cycle gives the same answer."""

    def __init__(self, path: "list[tuple[str, float]]") -> None:
        super().__init__(path)
        self.path = path


class Me:
    """A thread: the task whose rule it runs, the walks that it has under way, one in another, and whom it waits for.

    `spares` and `claims` are used again, since making objects is a good part of what a recomputed cell costs.
    """

    __slots__ = ("claims", "frame", "spares", "stacks", "waiting")

    def __init__(self) -> None:
        self.frame: Task | None = None
        self.stacks: list[list[Any]] = []
        self.waiting: Claim | None = None
        self.spares: list[Task] = []
        self.claims: list[Claim] = []


class _Here(threading.local):
    def __init__(self) -> None:
        self.me = Me()


here = _Here()


class Claim:
    """One thread bringing cells up to date at one point."""

    __slots__ = ("kept", "me", "point", "restarts", "t")

    kind = CLAIM
    busy = None

    def __init__(self, t: float, point: "Point | None", me: Me) -> None:
        self.t = t
        self.point = point
        self.me = me
        self.kept: dict[Cell, Any] | None = None  # how far cells with many inputs have come
        self.restarts = 0

    def keep(self, cell: "Cell", progress: Any) -> None:
        """Remember how far a cell has come."""
        if self.kept is None:
            self.kept = {}
        self.kept[cell] = progress


class Crowd(list[Claim]):
    """Several claims on one cell: by several threads, or at several points."""

    __slots__ = ()


class Task:
    """An opaque rule that runs at one point, and what it has read so far."""

    __slots__ = (
        "axes",  # {name: Axis} that were read so far, or None
        "cell",
        "deps",  # {cell or (cell, map, overrides): stamp} in the order of reading
        "epoch",  # the engine's count of edits when reading began
        "handed",  # the very `t` object that a rule with an argument was given
        "hi",
        "lo",  # nan where no remembered answer may be read
        "mapped",  # whether some dependency was read elsewhere in time
        "me",
        "naive",  # set in the frames of the naive evaluator, and where no read is allowed
        "nested",  # seconds spent in evaluations inside of this one; negative: not measured
        "parent",  # in the naive evaluator, the task that wants this one
        "point",
        "raised",  # (the exception that was raised at a read, the failure that it stands for)
        "t",
    )

    parent: "Task | None"

    def __init__(self, cell: "Cell", t: float, point: "Point | None", me: Me, epoch: int) -> None:
        self.cell = cell
        self.t = t
        self.point = point
        self.me = me
        self.epoch = epoch
        self.lo = -INF
        self.hi = INF
        self.deps: dict[Any, int] = {}
        self.axes: dict[str, Any] | None = None
        self.mapped = False
        self.raised: tuple[BaseException, Any] | None = None
        self.handed: Any = None
        self.naive: Any = None


# Whether this thread has the lock already: then only a finalizer, or a source's own `sample`, can have got here.
is_held: Callable[[], bool] = LOCK._is_owned  # type: ignore[attr-defined]  # pyright: ignore


def entered_twice(name: str) -> EvaluationError:
    """The error for using the engine in the middle of its own bookkeeping."""
    error = EvaluationError(f"{name} is used in the middle of the engine's own work")
    return hint(error, "neither a finalizer (__del__) nor the sample() of a source may ask or edit")


def leave(engine: "Engine", cell: "Cell", claim: Claim) -> None:
    """Take a claim off a cell; the lock is held."""
    busy = cell.busy
    if busy is claim:
        cell.busy = None
    elif type(busy) is Crowd and claim in busy:
        busy.remove(claim)
        if len(busy) == 1:
            cell.busy = busy[0]
    if engine.waiting:
        CHANGED.notify_all()
