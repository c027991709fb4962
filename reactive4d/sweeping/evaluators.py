"""Evaluating signals at many points at once, each along just those dimensions that it depends on.

Arithmetic, NumPy's functions, keys and warps are evaluated for all points together; whatever runs a Python function is
asked of the engine, which evaluates it once for each box. What a part answers is kept from one context to the next if
it reads less than what reads it: so nothing is evaluated again because something else has moved.
"""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from reactive4d.arrays import freeze
from reactive4d.engine import Cell, engine
from reactive4d.engine.frames import CHANGED, LOCK, here
from reactive4d.engine.kinds import AXIS, SOURCE
from reactive4d.engine.segments import MappedReads
from reactive4d.engine.walks import wait_for_transaction
from reactive4d.signals.algebra import Operation
from reactive4d.signals.kernels import Constant, repeated, stacked
from reactive4d.sweeping.asking import ApartError, TooLongError, ask
from reactive4d.sweeping.columns import Column, joined, permuted, spread
from reactive4d.sweeping.contexts import TIME, Context, Reads
from reactive4d.sweeping.memories import Memory

__all__ = ["Evaluator"]

NOTHING: Reads = frozenset()
RESTARTS = 3  # where somebody edits the model meanwhile


class _Mark:
    __slots__ = ()


_PENDING = _Mark()  # the answer of a formula whose inputs stand still: it is asked for if somebody needs it
_BROKEN = Column(_Mark(), (), NOTHING)  # a part that cannot be evaluated for all points together


class Evaluator:
    """Evaluates signals in one context after another, and keeps what will be wanted again.

    Attributes:
        rows: answers that were computed for many points together, so far.
        last: what a cell read when it was asked the last time.
    """

    def __init__(self, memory: Memory) -> None:
        self.memory = memory
        self.rows = 0
        self.last: dict[Cell, Reads] = {}

    def evaluate(self, roots: Iterable[Cell], context: Context, *, deadline: float | None = None) -> dict[Cell, Column]:
        """The answers of some signals; where there is an error at a point, `Failed` stands in its place.

        Raises:
            TooLongError: the deadline, a time of `perf_counter`, has passed.
        """
        wanted = tuple(dict.fromkeys(roots))
        found: dict[Cell, Column] = {}
        for turn in range(RESTARTS + 1):
            with LOCK:
                if engine.closed_to(here.me):
                    wait_for_transaction(engine, here.me)
                epoch = engine.epoch
                engine.patience += turn == RESTARTS  # then edits wait
            try:
                found = self._evaluated(wanted, _Walk(self, context, deadline))
            finally:
                with LOCK:
                    engine.patience -= turn == RESTARTS
                    CHANGED.notify_all()
            if engine.epoch == epoch:
                break  # nobody has edited the model meanwhile
        return found

    def _evaluated(self, wanted: Sequence[Cell], walk: "_Walk") -> dict[Cell, Column]:
        try:
            found = walk.columns(wanted)
        except RecursionError:
            found = dict.fromkeys(wanted, _BROKEN)
        return {root: walk.whole(root, column) for root, column in found.items()}


class _Walk:
    """One evaluation in one context."""

    def __init__(self, evaluator: Evaluator, context: Context, deadline: float | None) -> None:
        self.evaluator = evaluator
        self.memory = evaluator.memory
        self.context = context
        self.deadline = deadline

    def columns(self, roots: Sequence[Cell]) -> dict[Cell, Column]:
        """The answers of some signals, as far as they can be had for all points together."""
        order, uses = self._order(roots)
        done: dict[Cell, Column] = {}
        for cell, inputs in order:
            if inputs is None:
                done[cell] = self.memory.recall(cell, self.context) or self._leaf(cell)
            elif any(x not in done for x in inputs):
                done[cell] = _BROKEN  # a ring: asking one by one tells the way round
            else:
                done[cell] = self._formula(cell, inputs, [done[x] for x in inputs])
                for x in inputs:
                    uses[x] -= 1
                    if not uses[x]:
                        del done[x]  # nobody else wants it
        for root in roots:
            if done[root].dimensions:
                self.memory.keep(root, done[root], self.context)
        return {root: done[root] for root in roots}

    def whole(self, root: Cell, column: Column) -> Column:
        """The answers of a signal, asked one by one if they cannot be had together."""
        if column.value is _PENDING:
            try:
                return self.asked(root)
            except ApartError:
                column = _BROKEN
        return self.asked(root, takes_errors=True) if column is _BROKEN else column

    def asked(self, cell: Cell, *, takes_errors: bool = False) -> Column:
        """The answers as the engine gives them one by one.

        Raises:
            ApartError: there is an error among them, and errors are not taken.
            TooLongError: the deadline has passed.
        """
        expected = self.evaluator.last.get(cell, NOTHING)
        column = ask(cell, self.context, expected, takes_errors=takes_errors, deadline=self.deadline)
        self.evaluator.last[cell] = column.reads
        return column

    def _order(self, roots: Sequence[Cell]) -> tuple[list[tuple[Cell, tuple[Cell, ...] | None]], dict[Cell, int]]:
        """The cells to evaluate, what is read before who reads it; and how often each is read.

        Each comes with its inputs, or None if it is no formula or its answer is known.
        """
        order: list[tuple[Cell, tuple[Cell, ...] | None]] = []
        uses: dict[Cell, int] = dict.fromkeys(roots, 1)
        seen: set[Cell] = set()
        todo: list[tuple[Cell, tuple[Cell, ...] | None]] = [(root, None) for root in reversed(roots)]
        while todo:
            cell, inputs = todo.pop()
            if inputs is not None:
                order.append((cell, inputs))
            elif cell not in seen:
                seen.add(cell)
                declared = _declared(cell)
                if declared is None or self.memory.recall(cell, self.context) is not None:
                    order.append((cell, None))
                    continue
                todo.append((cell, declared))
                for x in declared:
                    uses[x] = uses.get(x, 0) + 1
                    todo.append((x, None))
        return order, uses

    def _formula(self, cell: Any, inputs: Sequence[Cell], columns: Sequence[Column]) -> Column:
        if any(column is _BROKEN for column in columns):
            return _BROKEN
        reads = NOTHING.union(*[column.reads for column in columns])
        if len({None if axis is None else axis.name for axis in reads}) < len(reads):
            return _BROKEN  # two parameters of one name: asking one by one tells that it is an error
        dimensions = tuple(sorted({d for column in columns for d in column.dimensions}))
        if not dimensions:
            return Column(_PENDING, (), reads)
        try:
            value = _vectorised(cell, [self._row(x, c, dimensions) for x, c in zip(inputs, columns, strict=True)])
        except ApartError:
            return _BROKEN
        self.evaluator.rows += self.context.count(dimensions)
        for x, column in zip(inputs, columns, strict=True):
            if column.reads != reads and column.dimensions:
                self.memory.keep(x, column, self.context)
        return Column(freeze(value), dimensions, reads, all(column.is_whole for column in columns))

    def _row(self, cell: Cell, column: Column, dimensions: tuple[int, ...]) -> Any:
        """An input's answers along the dimensions of its reader."""
        if column.dimensions:
            return spread(column, dimensions, self.context.shape)
        return Constant(self.asked(cell).value if column.value is _PENDING else column.value)

    # -- what is at the end of the tree --------------------------------------------------------------------------------

    def _leaf(self, cell: Any) -> Column:
        try:
            if cell.kind == AXIS:
                return self._axis(cell)
            if cell.kind == SOURCE:
                return self._source(cell)
            if hasattr(cell, "many") and self.context.is_timed and self.context.is_always:
                return self._through(cell)
            return self.asked(cell)
        except ApartError:
            return _BROKEN

    def _axis(self, axis: Any) -> Column:
        value, dimensions = self.context.along(axis)
        return Column(value, dimensions, frozenset([axis]))

    def _source(self, source: Any) -> Column:
        context = self.context
        first, last = context.span
        lo, hi, value = source.sample(first)
        if lo <= first and last < hi:
            return Column(freeze(value), (), NOTHING if lo == -np.inf and hi == np.inf else TIME)
        if hasattr(source, "sample_many"):
            many = source.sample_many(context.times)
        else:
            many = stacked([source.sample(t)[2] for t in context.times.tolist()])
        assert context.clock is not None
        return Column(freeze(many), (context.clock,), TIME)

    def _through(self, cell: Any) -> Column:
        """The answers of a cell that asks others at many times, at one combination of the parameters after another."""
        context = self.context
        clock = context.clock
        assert clock is not None
        reads = self.evaluator.last.get(cell, TIME)
        while True:
            outer = context.of(reads)
            found: list[Any] = []
            for index in context.indices(outer).tolist():
                if index and index[0] < 0:
                    found.append(None)
                    continue
                value, read = self._at_times(cell, index)
                found.append(value)
                reads |= read
                if context.of(reads) != outer:
                    break
            else:
                break
        self.evaluator.last[cell] = reads
        is_whole = all(part is not None for part in found)
        filler = next(part for part in found if part is not None)
        rows = joined([filler if part is None else part for part in found])
        dimensions = tuple(sorted((*outer, clock)))
        return Column(permuted(rows, (*outer, clock), dimensions, context.shape), dimensions, reads, is_whole)

    def _at_times(self, cell: Any, index: Sequence[int]) -> tuple[Any, Reads]:
        inner = _Inner(self.evaluator, self.context.alone(index, self.context.times), self.deadline)
        value = _many(cell, inner)
        self.evaluator.rows += len(self.context.times)
        return freeze(value), inner.reads | TIME


class _Inner:
    """How a cell that is evaluated at many times asks others: at times of its own."""

    def __init__(self, evaluator: Evaluator, context: Context, deadline: float | None) -> None:
        self.evaluator = evaluator
        self.context = context
        self.deadline = deadline
        self.reads: Reads = NOTHING

    def ask(self, cell: Any, times: Any) -> Any:
        """The answers at (N,) times, as an array or as a tuple."""
        context = self.context if times is self.context.times else self.context.alone((0,), times)
        walk = _Walk(self.evaluator, context, self.deadline)
        column = walk.columns([cell])[cell]
        if column is _BROKEN:
            raise ApartError
        if column.value is _PENDING:
            column = walk.asked(cell)
        self.reads |= column.reads
        return column.value if column.dimensions else repeated(column.value, len(times))


def _declared(cell: Any) -> tuple[Cell, ...] | None:
    """The inputs of a formula that can be evaluated for many points together; None if it is something else."""
    if cell.kind == SOURCE or not hasattr(cell, "vectorised"):
        return None
    inputs = cell.inputs
    if type(inputs) is MappedReads or not inputs:
        return None
    # A Python function is the engine's: it runs once for each box, not for each point.
    operator = cell.operator if isinstance(cell, Operation) else None
    return None if operator is not None and operator._many is None else tuple(inputs)  # pyright: ignore[reportPrivateUsage]


def _vectorised(cell: Any, rows: list[Any]) -> Any:
    try:
        return cell.vectorised(*rows)
    except Exception as error:
        raise ApartError from error


def _many(cell: Any, inner: _Inner) -> Any:
    try:
        return cell.many(inner.context.times, inner.ask)
    except (ApartError, TooLongError, RecursionError):
        raise
    except Exception as error:
        raise ApartError from error
