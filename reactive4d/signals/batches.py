"""Answers at many times at once: `signal.at(array)`.

Vectorisable parts (sources, arithmetic, NumPy's functions, choices, warps) are evaluated for all times together; others
are asked one by one, skipping times in an interval that is known to hold. The answers agree with those asked one by one
to 1e-12 of their scale. They are remembered in a table of their own, by the content of the array of times and by the
parameters that were read, and an edit forgets those whose span it touches.
"""

from collections.abc import Generator
from contextlib import contextmanager
from typing import Any

import numpy as np

from reactive4d.arrays import ARRAY, freeze, measure
from reactive4d.engine import Cell, Engine, hits
from reactive4d.engine.cells import as_time
from reactive4d.engine.engines import LATEST
from reactive4d.engine.evictions import SEGMENT, enlist
from reactive4d.engine.failures import Failure, raised
from reactive4d.engine.frames import CHANGED, LOCK, here
from reactive4d.engine.kinds import AXIS, SOURCE
from reactive4d.engine.links import ANYWHERE, add_link
from reactive4d.engine.points import Point
from reactive4d.engine.segments import MappedReads
from reactive4d.engine.shelves import Shelves
from reactive4d.engine.walks import wait_for_transaction
from reactive4d.errors import TimeError
from reactive4d.signals.facade import Signal
from reactive4d.signals.kernels import repeated, stacked
from reactive4d.signals.settables import Settable

__all__ = ["as_times", "batch"]

PAIR: Any = tuple
RESTARTS = 3  # after which edits wait


class Remembered:
    """The answers at an array of times, and the span that they lie in."""

    __slots__ = ("axes", "followed", "hi", "key", "lo", "value")

    def __init__(self, value: Any, lo: float, hi: float, axes: tuple[Any, ...], key: tuple[Any, ...]) -> None:
        self.value = value
        self.followed: list[tuple[Settable[Any], Any]] = []  # to what they were set
        self.lo = lo
        self.hi = hi
        self.axes = axes
        self.key = key


class _NotTogetherError(Exception):
    """Some part went wrong for some time: ask one by one, so that the error names it."""


def as_times(times: Any, signal: Cell) -> Any:
    """(N,) float64 times of the engine's own, in which `inf` is the largest float and -0.0 is 0.0, as for one time."""
    try:
        array = np.asarray(times)
    except (TypeError, ValueError):
        raise TimeError(f"{signal.name} asked at t = {times!r}: expected numbers of seconds") from None
    if array.ndim != 1:
        raise TimeError(f"{signal.name} asked at times of shape {array.shape}: expected (N,)")
    if array.dtype.kind not in "fiu":
        if array.dtype.kind != "O" and array.size:
            raise TimeError(f"{signal.name} asked at t = {times!r}: expected numbers of seconds")
        array = np.array([as_time(t, signal) for t in array], dtype=np.float64)
    ts = np.minimum(array, LATEST, dtype=np.float64) + 0.0
    with np.errstate(all="ignore"):
        total = np.dot(ts, ts)
    if total != total:
        raise TimeError(f"{signal.name} asked at t = nan, the {int(np.isnan(ts).argmax()) + 1}. of {len(ts)} times")
    return ts


def batch(signal: Signal[Any], times: Any, parameters: dict[str, Any]) -> Any:
    """The answers of a signal at (N,) times, from outside of any evaluation."""
    ts = as_times(times, signal)
    engine = signal.engine
    point = engine.point(parameters) if parameters else None
    digest = ts.tobytes()
    found = _recalled(signal, digest, point)
    if found is not None:
        if engine.logs:
            engine.emit("reused", signal, found.lo, found.hi)
        return found.value
    with _under_way(engine):
        for _ in range(RESTARTS):
            done, value = _attempt(signal, ts, point, digest)
            if done:
                return value
        with _undisturbed(engine):
            return _attempt(signal, ts, point, digest)[1]


def _attempt(signal: Signal[Any], ts: Any, point: Point | None, digest: bytes) -> tuple[bool, Any]:
    """The answers, and whether nothing was edited on another thread meanwhile."""
    engine = signal.engine
    with LOCK:
        if engine.closed_to(here.me):
            wait_for_transaction(engine, here.me)
        epoch = engine.epoch
    walk = _Walk(ts, point)
    try:
        value = walk.ask(signal, ts)
    except (_NotTogetherError, RecursionError):
        walk = _Walk(ts, point)
        value = _one_by_one(signal, ts, point, walk)
    value = freeze(value)
    with LOCK:
        if engine.epoch != epoch or engine.closed_to(here.me):
            return False, None
        _remember(signal, digest, ts, point, walk, value)
    return True, value


@contextmanager
def _under_way(engine: Engine) -> Generator[None]:
    """Nothing is evicted before all is done: what was asked one by one must still be there to hear of edits."""
    with LOCK:
        hits.attended += 1
    try:
        yield
    finally:
        with LOCK:
            hits.attended -= 1
            if (engine.bytes > engine.limit or engine.unpaid) and hits.attended == hits.logging:
                engine.trim()


@contextmanager
def _undisturbed(engine: Engine) -> Generator[None]:
    """Edits on other threads wait."""
    with LOCK:
        if engine.closed_to(here.me):
            wait_for_transaction(engine, here.me)
        engine.patience += 1
    try:
        yield
    finally:
        with LOCK:
            engine.patience -= 1
            CHANGED.notify_all()


def _recalled(cell: Cell, digest: bytes, point: Point | None) -> Remembered | None:
    shelves = cell.shelves
    if shelves is None:
        return None
    for (known, axes, key), found in list(shelves.batches.items()):
        if known == digest and key == _key(axes, point):
            # Other keys that say the same at these times are no edit of them, but are edited in their own ways.
            return found if all(x.content is content for x, content in found.followed) else None
    return None


def _key(axes: tuple[Any, ...], point: Point | None) -> tuple[Any, ...]:
    return tuple([axis.default if point is None else point.value(axis) for axis in axes])


def _remember(cell: Cell, digest: bytes, ts: Any, point: Point | None, walk: "_Walk", value: Any) -> None:
    engine = cell.engine
    if cell.kind in (SOURCE, AXIS):
        return
    cell.runs += len(ts)
    if engine.owner is not None or not len(ts):
        return
    if cell.shelves is None:
        cell.shelves = Shelves()
        cell.sole = None
    axes = tuple(sorted(walk.axes, key=lambda axis: axis.name))
    key = _key(axes, point)
    kept = Remembered(value, float(ts.min()), float(ts.max()), axes, key)
    cell.shelves.batches[digest, axes, key] = kept
    kept.followed = [(x, x.content) for x in walk.leaves if isinstance(x, Settable) and hasattr(x.content, "curve")]
    for source, is_mapped in walk.leaves.items():
        if source is not cell and not source.unchanging:
            add_link(cell, source, ANYWHERE if is_mapped else None)
    engine.bytes += SEGMENT + measure(value) + len(digest)
    if not cell.enlisted:
        enlist(engine, cell)
    if engine.logs:
        engine.emit("evaluated", cell, kept.lo, kept.hi)


class _Walk:
    """One evaluation of a tree at many times: what it read at the end, and where."""

    def __init__(self, ts: Any, point: Point | None) -> None:
        self.ts = ts
        self.point = point
        self.leaves: dict[Cell, bool] = {}
        self.axes: dict[Any, None] = {}
        self.names: dict[str, Any] = {}
        # What is read through others, at the same or at other times: so that shared parts are evaluated once.
        self.known: dict[tuple[Any, bytes], Any] = {}
        self.digests: dict[int, tuple[Any, bytes]] = {}

    def leaf(self, cell: Any, ts: Any) -> None:
        """Note that the answers depend on a cell, at these times."""
        self.leaves[cell] = self.leaves.get(cell, False) or ts is not self.ts

    def axis(self, axis: Any) -> None:
        """Note that the answers depend on a parameter."""
        if self.names.setdefault(axis.name, axis) is not axis:
            raise _NotTogetherError  # perhaps it is an error: asking one by one will tell
        self.axes[axis] = None

    def ask(self, root: Any, ts: Any) -> Any:
        """The answers of a signal at times: formulas by a stack of our own, the others by what they know."""
        order, uses = _order(root)
        done: dict[Any, Any] = {}
        for cell, inputs in order:
            if inputs is not None:
                if any(x not in done for x in inputs):
                    raise _NotTogetherError  # a ring: asking one by one tells the way round
                done[cell] = self._formula(cell, [done[x] for x in inputs])
                if isinstance(cell, Settable):
                    self.leaf(cell, ts)
                for x in inputs:
                    uses[x] -= 1
                    if not uses[x]:
                        del done[x]  # nobody else wants it
            else:
                done[cell] = self._other(cell, ts)
        return done[root]

    def _formula(self, cell: Any, values: list[Any]) -> Any:
        try:
            value = cell.vectorised(*values)
        except Exception as error:
            raise _NotTogetherError from error
        if isinstance(value, ARRAY):
            value.setflags(write=False)
        return value

    def _other(self, cell: Any, ts: Any) -> Any:
        if cell.kind == AXIS:
            self.axis(cell)
            return repeated(cell.hit[2] if self.point is None else self.point.shown(cell), len(ts))
        self.leaf(cell, ts)
        if cell.kind == SOURCE:
            if hasattr(cell, "sample_many"):
                return freeze(cell.sample_many(ts))
            return _sampled(cell, ts)
        key = (cell, self._digest(ts))
        if key in self.known:
            return self.known[key]
        if hasattr(cell, "many"):
            try:
                value = cell.many(ts, self.ask)
            except _NotTogetherError:
                raise
            except Exception as error:
                raise _NotTogetherError from error
        else:
            value = _one_by_one(cell, ts, self.point, self)
        value = self.known[key] = freeze(value)
        return value

    def _digest(self, ts: Any) -> bytes:
        found = self.digests.get(id(ts))
        if found is None:
            found = self.digests[id(ts)] = (ts, ts.tobytes())  # held, so that no other array gets its id
        return found[1]


def _order(root: Any) -> tuple[list[tuple[Any, Any]], dict[Any, int]]:
    """The cells down to those that are no formulas, what is read before who reads it; and how often each is read.

    Each comes with its inputs, or None if it is no formula.
    """
    order: list[tuple[Any, Any]] = []
    uses: dict[Any, int] = {root: 1}
    seen: set[Any] = set()
    todo: list[Any] = [root]
    while todo:
        cell: Any = todo.pop()
        if type(cell) is PAIR:
            order.append(cell)
        elif cell not in seen:
            seen.add(cell)
            inputs: Any = cell.inputs if cell.kind != SOURCE and hasattr(cell, "vectorised") else None
            if inputs is None or type(inputs) is MappedReads:
                order.append((cell, None))
                continue
            todo.append((cell, inputs))
            for x in inputs:
                uses[x] = uses.get(x, 0) + 1
            todo.extend(inputs)
    return order, uses


def _sampled(source: Any, ts: Any) -> Any:
    """What a source says at many times; a time inside of an interval that is known to hold is not looked up."""
    lo, hi, value = source.sample(float(ts[0])) if len(ts) else (0.0, 0.0, 0.0)
    if len(ts) and lo <= ts.min() and ts.max() < hi:
        return repeated(value, len(ts))
    return stacked([source.sample(t)[2] for t in ts.tolist()])


def _one_by_one(cell: Any, ts: Any, point: Point | None, walk: _Walk) -> Any:
    """Answers asked one by one; a time inside of an interval that is known to hold is not asked."""
    walk.leaf(cell, ts)
    answers: list[Any] = [None] * len(ts)
    given = point.given if point is not None else {}
    lo, hi, value = 1.0, 0.0, None
    for i in np.argsort(ts, kind="stable").tolist():
        t = float(ts[i])
        if not lo <= t < hi:
            hit = cell._hit_at(t, given)
            lo, hi, value = hit[0], hit[1], hit[2]
            if hit[5] is not None:
                walk.axes.update(dict.fromkeys(hit[5]))
            if type(value) is Failure:
                raise raised(value)
        answers[i] = value
    return stacked(answers)
