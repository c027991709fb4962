"""Who is asking: the evaluation that a thread is in, where it waits, and the ways in which an evaluation is unwound.

A `Task` is one cell being brought up to date at one point. While its rule runs it is the thread's `frame`: every read
adds what was read to `deps` and narrows the interval over which the answer will hold. `Me` is a thread; the thread
local `here` finds it. `WATCH[0]` counts the evaluations under way and the open logs of the process: where it is zero,
a remembered answer may be handed out without asking who asks.
"""

import threading
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from reactive4d.engine.cells import Cell
    from reactive4d.engine.points import Point
    from reactive4d.engine.segments import Segment

__all__ = ["LOCK", "NEVER", "WATCH", "Cancelled", "CycleFound", "Hit", "Me", "Suspended", "Task", "here"]

INF = float("inf")

# (lo, hi, value, stamp, point, axes): where an answer holds, the answer, its stamp, the point that it was asked at (None
# where the default point will do) and the parameters that it read (None where it read none).
Hit = tuple[float, float, Any, int, "Point | None", "tuple[Any, ...] | None"]

# The hit of a cell that has nothing to hand out: no time lies in it.
NEVER: Hit = (INF, -INF, None, 0, None, None)

# One lock guards the bookkeeping of all engines; rules run without it.
LOCK = threading.Lock()
CHANGED = threading.Condition(LOCK)
WATCH = [0]

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
    """A thread: the task whose rule it runs, how deep it is, and the task of another thread that it waits for."""

    __slots__ = ("depth", "frame", "waiting")

    def __init__(self) -> None:
        self.frame: Task | None = None
        self.depth = 0
        self.waiting: Task | None = None


class _Here(threading.local):
    def __init__(self) -> None:
        self.me = Me()


here = _Here()


class Task:
    """One cell being brought up to date at one point, by one thread."""

    __slots__ = (
        "axes",  # {name: Axis} that were read so far, or None
        "below",  # the next task on the same cell, at another point or by another thread
        "candidates",  # remembered contents that may still stand, the likeliest last
        "cell",
        "deps",  # {cell or (cell, map, overrides): stamp} in the order of reading
        "done",
        "epoch",  # the engine's count of edits when reading began
        "handed",  # the very `t` object that a rule with an argument was given
        "hi",
        "index",  # how far the inputs, or the dependencies of a candidate, have been walked
        "lo",
        "mapped",  # whether some dependency was read elsewhere in time
        "me",
        "naive",  # set in the frames of the naive evaluator, and where no read is allowed
        "nested",  # seconds spent in evaluations inside of this one
        "parent",  # the task that wants this one
        "patient",  # whether edits wait for this task
        "point",
        "raised",  # (the exception that was raised at a read, the failure that it stands for)
        "restarts",
        "stamps",
        "t",
        "values",
    )

    def __init__(self, cell: "Cell", t: float, point: "Point | None", me: Me, parent: "Task | None") -> None:
        self.cell = cell
        self.t = t
        self.point = point
        self.me = me
        self.parent = parent
        self.below: Task | None = None
        self.done = False
        self.patient = False
        self.restarts = 0
        self.naive: Any = None
        self.candidates: list[tuple[Segment | None, tuple[Any, ...]]] | None = None
        self.epoch = -1
        self.nested = 0.0

    def begin(self, epoch: int) -> None:
        """Forget what was read so far: reading begins, in a state of the model that `epoch` names."""
        self.epoch = epoch
        self.lo = -INF
        self.hi = INF
        self.deps: dict[Any, int] = {}
        self.axes: dict[str, Any] | None = None
        self.mapped = False
        self.raised: tuple[BaseException, Any] | None = None
        self.handed: Any = None
        self.index = 0
        self.values: list[Any] = []
        self.stamps: list[int] = []
