"""Memories: what parts of a measure answered, kept from one context to the next.

Kept is what reads less than the sweep moves. The contexts come in nested loops, so what depends on the value of an
outer loop is of no use once that has moved on: then it is dropped.
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from reactive4d.arrays import measure
from reactive4d.engine import Cell, engine
from reactive4d.sweeping.contexts import Context, Reads

if TYPE_CHECKING:
    from reactive4d.sweeping.columns import Column

__all__ = ["Memory"]


class Memory:
    """The columns that will be wanted again.

    Args:
        loops: by parameter the loop that moves it, the outermost being 0; None stands for time.
        budget: bytes that they may take; what comes when it is full is not kept.
    """

    def __init__(self, loops: Mapping[str | None, int], *, budget: int) -> None:
        self.loops = loops
        self.budget = budget
        self.bytes = 0
        self._all = frozenset(loops)
        self._shelves: dict[Cell, dict[Reads, _Shelf]] = {}
        self._epoch = engine.epoch

    def recall(self, cell: Cell, context: Context) -> "Column | None":
        """What a cell answered in such a context, if that is known."""
        if self._epoch != engine.epoch:
            self.clear()
        for reads, shelf in self._shelves.get(cell, {}).items():
            found = shelf.columns.get(context.mark(reads))
            if found is not None:
                return found
        return None

    def keep(self, cell: Cell, column: "Column", context: Context) -> None:
        """Keep what a cell answered, if there will be other contexts in which it answers the same."""
        names = {None if axis is None else axis.name for axis in column.reads}
        if names >= self._all or not column.is_whole:
            return
        mark = context.mark(column.reads)
        shelf = self._shelves.setdefault(cell, {}).setdefault(column.reads, _Shelf())
        if mark in shelf.columns:
            return
        outer = self._outer(names)
        now = context.mark(frozenset([a for a in column.reads if (None if a is None else a.name) in outer]))
        if now != shelf.outer:
            self.bytes -= shelf.bytes
            shelf.outer, shelf.bytes, shelf.columns = now, 0, {}
        size = measure(column.value)
        if self.bytes + size <= self.budget:
            shelf.columns[mark] = column
            shelf.bytes += size
            self.bytes += size

    def _outer(self, names: set[str | None]) -> set[str | None]:
        """Those of some parameters that are moved by the outermost loops, as far as each loop moves one of them."""
        mine = {self.loops[name] for name in names if name in self.loops}
        depth = 0
        while depth in mine:
            depth += 1
        return {name for name in names if self.loops.get(name, depth) < depth}

    def clear(self) -> None:
        """Forget everything, as when the model was edited."""
        self._shelves.clear()
        self.bytes = 0
        self._epoch = engine.epoch


class _Shelf:
    """What one cell answered where it read certain parameters, at the present values of the outer loops."""

    __slots__ = ("bytes", "columns", "outer")

    def __init__(self) -> None:
        self.outer: frozenset[Any] | None = None
        self.bytes = 0
        self.columns: dict[frozenset[Any], Column] = {}
