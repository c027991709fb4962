"""Answers at many times at once: `signal.at(array)`.

Vectorisable parts (sources, arithmetic, NumPy's functions, choices, warps) are evaluated for all times together; others
are asked one by one, skipping times in an interval that is known to hold. The answers agree with those asked one by one
to 1e-12 of their scale. They are remembered in a table of their own, by the content of the array of times and by the
parameters that were read, and an edit forgets those whose span it touches.
"""

from typing import Any

import numpy as np

from reactive4d.arrays import ARRAY, freeze, measure
from reactive4d.engine import Cell
from reactive4d.engine.evictions import SEGMENT, enlist
from reactive4d.engine.failures import Failure, raised
from reactive4d.engine.frames import LOCK, here
from reactive4d.engine.kinds import AXIS, SOURCE
from reactive4d.engine.links import ANYWHERE, add_link
from reactive4d.engine.points import Point
from reactive4d.engine.segments import MappedReads
from reactive4d.engine.shelves import Shelves
from reactive4d.errors import TimeError
from reactive4d.signals.facade import Signal
from reactive4d.signals.settables import Settable

__all__ = ["batch"]

RESTARTS = 3


class Remembered:
    """The answers at an array of times, and the span that they lie in."""

    __slots__ = ("axes", "hi", "key", "lo", "value")

    def __init__(self, value: Any, lo: float, hi: float, axes: tuple[Any, ...], key: tuple[Any, ...]) -> None:
        self.value = value
        self.lo = lo
        self.hi = hi
        self.axes = axes
        self.key = key


class _NotTogetherError(Exception):
    """Some part went wrong for some time: ask one by one, so that the error names it."""


def as_times(times: Any, name: str) -> Any:
    """(N,) float64 times."""
    try:
        ts = np.asarray(times, dtype=np.float64)
    except (TypeError, ValueError):
        raise TimeError(f"{name} asked at t = {times!r}: expected numbers of seconds") from None
    if ts.ndim != 1:
        raise TimeError(f"{name} asked at times of shape {ts.shape}: expected (N,)")
    with np.errstate(all="ignore"):
        total = np.dot(ts, ts)
    if total != total and np.isnan(ts).any():
        raise TimeError(f"{name} asked at t = nan")
    return ts


def batch(signal: Signal[Any], times: Any, parameters: dict[str, Any]) -> Any:
    """The answers of a signal at (N,) times, from outside of any evaluation."""
    ts = as_times(times, signal.name)
    engine = signal.engine
    if signal.kind == SOURCE and hasattr(signal, "sample_many") and engine.owner is None:
        return freeze(signal.sample_many(ts))  # pyright: ignore
    point = engine.point(parameters) if parameters else None
    digest = ts.tobytes()
    found = _recalled(signal, digest, point)
    if found is not None:
        return found.value
    for _ in range(RESTARTS):
        epoch = engine.epoch
        walk = _Walk(ts, point)
        try:
            value = walk.ask(signal, ts)
        except (_NotTogetherError, RecursionError):
            walk = _Walk(ts, point)
            value = _one_by_one(signal, ts, point, walk)
        value = freeze(value) if isinstance(value, ARRAY) else value
        with LOCK:
            if engine.epoch == epoch and (engine.owner is None or engine.owner is here.me):
                _remember(signal, digest, ts, point, walk, value)
                return value
    return _stacked([signal._hit_at(float(t), parameters)[2] for t in ts])  # pyright: ignore[reportPrivateUsage]


def _recalled(cell: Cell, digest: bytes, point: Point | None) -> Remembered | None:
    shelves = cell.shelves
    if shelves is None or cell.engine.owner is not None:
        return None
    for (known, axes, key), found in list(shelves.batches.items()):
        if known == digest and key == _key(axes, point):
            return found
    return None


def _key(axes: tuple[Any, ...], point: Point | None) -> tuple[Any, ...]:
    return tuple([axis.default if point is None else point.value(axis) for axis in axes])


def _remember(cell: Cell, digest: bytes, ts: Any, point: Point | None, walk: "_Walk", value: Any) -> None:
    engine = cell.engine
    cell.runs += len(ts)
    if engine.owner is not None or not len(ts):
        return
    if cell.shelves is None:
        cell.shelves = Shelves()
    axes = tuple(sorted(walk.axes, key=lambda axis: axis.name))
    key = _key(axes, point)
    kept = Remembered(value, float(ts.min()), float(ts.max()), axes, key)
    cell.shelves.batches[digest, axes, key] = kept
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

    def leaf(self, cell: Any, ts: Any) -> None:
        self.leaves[cell] = self.leaves.get(cell, False) or ts is not self.ts

    def ask(self, root: Any, ts: Any) -> Any:
        """The answers of a signal at times: formulas by a stack of our own, the others by what they know."""
        done: dict[Any, Any] = {}
        todo: list[Any] = [root]
        while todo:
            cell = todo[-1]
            if cell in done:
                todo.pop()
                continue
            if hasattr(cell, "vectorised") and cell.kind != SOURCE and type(cell.inputs) is not MappedReads:
                missing = [x for x in cell.inputs if x not in done]
                if missing:
                    todo.extend(missing)
                    continue
                done[cell] = self._formula(cell, [done[x] for x in cell.inputs])
                if isinstance(cell, Settable):
                    self.leaf(cell, ts)
            else:
                done[cell] = self._other(cell, ts)
            todo.pop()
        return done[root]

    def _formula(self, cell: Any, values: list[Any]) -> Any:
        try:
            return cell.vectorised(*values)
        except Exception as error:
            raise _NotTogetherError from error

    def _other(self, cell: Any, ts: Any) -> Any:
        if cell.kind == AXIS:
            self.axes[cell] = None
            value = cell.hit[2] if self.point is None else self.point.shown(cell)
            return _repeated(value, len(ts))
        self.leaf(cell, ts)
        if cell.kind == SOURCE:
            if hasattr(cell, "sample_many"):
                return cell.sample_many(ts)
            return _stacked([cell.sample(float(t))[2] for t in ts])
        if hasattr(cell, "many"):
            try:
                return cell.many(ts, self.ask)
            except _NotTogetherError:
                raise
            except Exception as error:
                raise _NotTogetherError from error
        return _one_by_one(cell, ts, self.point, self)


def _one_by_one(cell: Any, ts: Any, point: Point | None, walk: _Walk) -> Any:
    """Answers asked one by one; a time inside of an interval that is known to hold is not asked."""
    walk.leaf(cell, ts)
    answers: list[Any] = [None] * len(ts)
    lo, hi, value = 1.0, 0.0, None
    for i in np.argsort(ts, kind="stable").tolist():
        t = float(ts[i])
        if not lo <= t < hi:
            hit = cell._hit_at(t, point.given if point is not None else {})
            lo, hi, value = hit[0], hit[1], hit[2]
            if hit[5] is not None:
                walk.axes.update(dict.fromkeys(hit[5]))
            if type(value) is Failure:
                raise raised(value)
        answers[i] = value
    return _stacked(answers)


def _repeated(value: Any, n: int) -> Any:
    if isinstance(value, bool | int | float):
        return np.full(n, value)
    return np.broadcast_to(value, (n, *value.shape)) if isinstance(value, ARRAY) else (value,) * n


def _stacked(answers: list[Any]) -> Any:
    """Numbers and arrays of one shape as one array, everything else as a tuple."""
    kinds: set[Any] = {type(x) for x in answers}
    if kinds <= {float, int} or kinds == {bool}:
        return np.array(answers)
    if kinds == {np.ndarray} and len({(x.shape, x.dtype) for x in answers}) == 1:
        return np.stack(answers)
    return tuple(answers)
