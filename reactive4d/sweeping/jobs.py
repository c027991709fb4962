"""Jobs: a sweep as something that can be done piece by piece, here or in another process."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from time import perf_counter, process_time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.engine import Cell, engine
from reactive4d.engine.kinds import AXIS, SOURCE
from reactive4d.sweeping.asking import Failed, TooLongError, asked
from reactive4d.sweeping.columns import Column
from reactive4d.sweeping.contexts import Context, Varying
from reactive4d.sweeping.evaluators import Evaluator
from reactive4d.sweeping.grids import Grid
from reactive4d.sweeping.levers import TIME
from reactive4d.sweeping.measures import signals_of
from reactive4d.sweeping.memories import Memory
from reactive4d.sweeping.pictures import Picture
from reactive4d.sweeping.plans import Plan, Ranges
from reactive4d.sweeping.readings import below
from reactive4d.sweeping.subjects import Recipe, Subject
from reactive4d.sweeping.values import Encoded, Kind, encode

__all__ = ["Counter", "Job", "Part", "Visitor"]

MOST_ROWS = 1 << 16  # points that are evaluated together
MOST_BYTES = 1 << 26  # that the answers at them may take
LONGEST = 1.0  # seconds after which what was evaluated together is cut into parts
_MEMORY = 0.25  # of the engine's budget


@dataclass(frozen=True)
class Job:
    """What there is to do: everything that another process needs to know."""

    recipe: Recipe | None
    measure: Mapping[str, Any]
    grid: Grid
    plan: Plan
    values: Mapping[str, Any]
    kinds: Mapping[str, Kind] = field(default_factory=dict[str, Kind])
    row: int = 8  # bytes of the answers at one point


@dataclass(frozen=True)
class Part:
    """The answers in one tile.

    Attributes:
        ranges: which points these are, along each dimension of the grid.
        start, stop: the places at which the tile begins and ends.
        answers: by measure; their data have the dimensions of the grid, 1 where the answers are the same all along.
        mask: which points were visited; None for all.
        evaluated: how many answers of cells were computed.
        needed: how many were needed.
        seconds: of the processor.
    """

    ranges: Ranges
    start: int
    stop: int
    answers: dict[str, Encoded]
    mask: NDArray[np.bool_] | None
    evaluated: int
    needed: int
    seconds: float


class Visitor:
    """Visits the points of a job with one model."""

    def __init__(self, job: Job, subject: Subject | None = None, counter: "Counter | None" = None) -> None:
        if subject is None:
            assert job.recipe is not None
            subject = job.recipe.subject()
            job = replace(job, grid=job.grid.with_levers(subject.levers))
        self.job = job
        self.subject = subject
        self.signals = signals_of(job.measure, subject.scene)
        loops: dict[str | None, int] = {}
        for loop, dimension in enumerate(job.plan.order):
            for name in job.grid.dimensions[dimension].columns:
                loops[None if name == TIME else name] = loop
        self.evaluator = Evaluator(Memory(loops, budget=int(_MEMORY * engine.budget)))
        self.limit = max(1, min(MOST_ROWS, MOST_BYTES // max(1, job.row)))
        self.most = self.limit
        self.counter = counter if counter is not None else Counter()

    def visit(self, start: int, stop: int, seconds: float) -> Iterator[Part]:
        """Visit the points from one place to another; begin no other tile once so many seconds are over."""
        begun, cpu, first = perf_counter(), process_time(), start
        while start < stop and (not seconds or start == first or perf_counter() - begun < seconds):
            ranges, end = self.job.plan.tile(start, stop, self.limit)
            now = perf_counter()
            try:
                part = self._part(ranges, start, end, None if end - start == 1 else now + LONGEST)
            except TooLongError as late:
                # What was asked is remembered, and will be there for the smaller tile.
                self.limit = max(1, min(end - start - 1, int((end - start) * late.share / 2)))
                continue
            if perf_counter() - now < LONGEST / 4:
                self.limit = min(self.most, 4 * self.limit)
            start = end
            yield replace(part, seconds=process_time() - cpu)
            cpu = process_time()

    def _part(self, ranges: Ranges, start: int, end: int, deadline: float | None) -> Part:
        grid = self.job.grid
        mask = grid.mask(ranges)
        answers: dict[str, Encoded] = {}
        if mask is None or mask.any():
            context = self.context(ranges, mask)
            if not self.counter.cells:
                self._look(context)
            columns = self.evaluator.evaluate(self.signals.values(), context, deadline=deadline)
            for name, signal in self.signals.items():
                answers[name] = self._encoded(name, columns[signal], ranges, context)
        visited = end - start if mask is None else int(mask.sum())
        evaluated, needed = self.counter.count(self.evaluator.rows, visited)
        return Part(ranges, start, end, answers, mask, evaluated, needed, 0.0)

    def _look(self, context: Context) -> None:
        """Ask at one point, to see what is read."""
        t, given = context.at(context.indices(())[0].tolist())
        for signal in self.signals.values():
            asked(signal, t, given)
        self.counter.look(self.signals.values())

    def context(self, ranges: Ranges, mask: NDArray[np.bool_] | None) -> Context:
        """A part of the grid as what is asked about together: its dimensions are the loops."""
        job = self.job
        moved: dict[str, Varying] = {}
        times, clock = np.array([job.grid.time]), None
        for loop, dimension in enumerate(job.plan.order):
            lo, hi = ranges[dimension]
            for name, column in job.grid.dimensions[dimension].columns.items():
                if name == TIME:
                    times, clock = np.array(column[lo:hi], dtype=np.float64), loop
                else:
                    moved[name] = Varying(loop, column[lo:hi], (lo, hi))
        shape = tuple([ranges[d][1] - ranges[d][0] for d in job.plan.order])
        if mask is not None:
            mask = None if mask.all() else np.transpose(mask, job.plan.order)
        return Context(shape, moved, {**job.values, **job.grid.fixed}, times, clock, mask)

    def _drawn(self, picture: Picture, frames: Sequence[Any], column: Column, context: Context) -> list[Any]:
        """Pictures of frames; the same frame is drawn once."""
        known: dict[int, Any] = {}
        drawn: list[Any] = []
        for frame, index in zip(frames, context.indices(column.dimensions).tolist(), strict=True):
            if type(frame) is Failed:
                drawn.append(frame)
            elif index and index[0] < 0:
                drawn.append(None)
            else:
                if id(frame) not in known:
                    known[id(frame)] = _picture(picture, self.subject, *context.at(index))
                drawn.append(known[id(frame)])
        return drawn

    def _encoded(self, name: str, column: Column, ranges: Ranges, context: Context) -> Encoded:
        """Answers with the dimensions of the grid."""
        rows = column.value if column.dimensions else [column.value]
        given = self.job.measure[name]
        if isinstance(given, Picture):
            rows = self._drawn(given, rows, column, context)
        encoded = encode(rows, self.job.kinds.get(name), name=name)
        order = self.job.plan.order
        sizes = [ranges[d][1] - ranges[d][0] if loop in column.dimensions else 1 for loop, d in enumerate(order)]
        tail = encoded.data.shape[1:]
        places = [order.index(d) for d in range(len(order))]
        data = encoded.data.reshape((*sizes, *tail))
        data = data.transpose([*places, *range(len(order), data.ndim)])
        failed: dict[int, Exception] = {}
        if encoded.failed:
            moved = np.arange(len(encoded.data)).reshape(sizes).transpose(places).reshape(-1).tolist()
            failed = {i: encoded.failed[old] for i, old in enumerate(moved) if old in encoded.failed}
        return Encoded(encoded.kind, data, failed, encoded.files)


def _picture(picture: Picture, subject: Subject, t: float, given: Mapping[str, Any]) -> Any:
    """A picture at a point, or the error in its place."""
    try:
        return picture.draw(subject.thing, t, given)
    except Exception as error:  # noqa: BLE001  whatever the device raises
        return Failed(error)


class Counter:
    """How many answers were needed, and how many had to be computed."""

    def __init__(self) -> None:
        self.cells = 0
        self.clock = engine.clock
        self.rows = 0

    def look(self, signals: Iterable[Cell]) -> None:
        """Find out how many cells answer for every point; the signals have been asked at one."""
        self.cells = sum(cell.kind not in (SOURCE, AXIS) for cell in below(signals))

    def count(self, rows: int, visited: int) -> tuple[int, int]:
        """Answers that were computed and that were needed since the last time."""
        clock = engine.clock  # answers that the engine has stored
        evaluated = clock - self.clock + rows - self.rows
        self.clock, self.rows = clock, rows
        return evaluated, visited * self.cells
