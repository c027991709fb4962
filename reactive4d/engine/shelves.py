"""Answers that depend on a reader's parameters, and answers for whole arrays of times.

An answer is filed under exactly the parameters that its evaluation read, with their values: a shelf is one set of
parameters, and on it stands one table per combination of values. An edit marks all tables, but lazily: the marks are
kept, and applied to a table when somebody next looks into it.
"""

from typing import TYPE_CHECKING, Any

from reactive4d.engine.segments import Table, flip

if TYPE_CHECKING:
    from reactive4d.engine.cells import Axis
    from reactive4d.engine.points import Point

__all__ = ["Shelf", "ShelfTable", "Shelves"]

INF = float("inf")
MOST_MARKS = 32


class ShelfTable(Table):
    """The answers at one combination of parameter values, and how many marks were applied to them."""

    __slots__ = ("axes", "seen")

    def __init__(self, axes: "tuple[Axis, ...]", seen: int) -> None:
        super().__init__()
        self.axes = axes
        self.seen = seen


class Shelf:
    """The tables of the answers that read exactly these parameters."""

    __slots__ = ("axes", "tables")

    def __init__(self, axes: "tuple[Axis, ...]") -> None:
        self.axes = axes
        self.tables: dict[tuple[Any, ...], ShelfTable] = {}

    def key(self, point: "Point | None") -> tuple[Any, ...]:
        """The values of this shelf's parameters at a point."""
        if point is None:
            return tuple([axis.default for axis in self.axes])
        return tuple([point.value(axis) for axis in self.axes])


class Shelves:
    """What a cell remembers besides the answers that read no parameter; the set of parameters seen last comes first."""

    __slots__ = ("batches", "count", "cover", "hull", "marks", "shelves")

    def __init__(self) -> None:
        self.shelves: list[Shelf] = []
        self.batches: dict[Any, Any] = {}
        self.marks: list[tuple[float, float]] = []
        self.count = 0  # marks that there ever were
        self.hull = (INF, -INF)  # of the marks that are no longer listed one by one
        self.cover: tuple[float, float] | None = (-INF, INF)  # what is marked in all tables; None: something is clean

    def mark(self, lo: float, hi: float) -> bool:
        """Note that [lo, hi) is to be checked in all tables; False if that was known already."""
        stale = [key for key, batch in self.batches.items() if batch.lo < hi and lo <= batch.hi]
        for key in stale:
            del self.batches[key]
        if not self.shelves:
            return bool(stale)
        cover = self.cover
        if cover is not None and cover[0] <= lo and hi <= cover[1]:
            return bool(stale)
        if cover is not None and lo <= cover[1] and cover[0] <= hi:
            self.cover = (min(lo, cover[0]), max(hi, cover[1]))
        else:
            self.cover = (lo, hi)
        self.marks.append((lo, hi))
        self.count += 1
        if len(self.marks) > MOST_MARKS:
            old = self.marks[: MOST_MARKS // 2]
            del self.marks[: MOST_MARKS // 2]
            self.hull = (min(self.hull[0], *(a for a, _ in old)), max(self.hull[1], *(b for _, b in old)))
        return True

    def table(self, shelf: Shelf, point: "Point | None", *, make: bool = False) -> ShelfTable | None:
        """The table at a point, with all marks applied; made if there is none and `make` says so."""
        key = shelf.key(point)
        table = shelf.tables.get(key)
        if table is None:
            if make:
                table = shelf.tables[key] = ShelfTable(shelf.axes, self.count)
            return table
        self.settle(table)
        return table

    def settle(self, table: ShelfTable) -> None:
        """Apply the marks that a table has not seen."""
        missed = self.count - table.seen
        if missed:
            if missed > len(self.marks):
                flip(table, *self.hull)
                missed = len(self.marks)
            for lo, hi in self.marks[len(self.marks) - missed :]:
                flip(table, lo, hi)
            table.seen = self.count

    def shelf(self, axes: "tuple[Axis, ...]") -> Shelf:
        """The shelf of one set of parameters, brought to the front."""
        shelves = self.shelves
        for i, shelf in enumerate(shelves):
            if shelf.axes == axes:
                if i:
                    shelves.insert(0, shelves.pop(i))
                return shelf
        shelf = Shelf(axes)
        shelves.insert(0, shelf)
        return shelf
