"""Readings: what cells read, as far as they declare it or are remembered to have read it.

Only a few remembered answers of each cell are looked at: after a large sweep there are many, and they read the same.
"""

from collections.abc import Iterable
from itertools import islice
from typing import Any, Final

from reactive4d.engine import Cell
from reactive4d.engine.frames import LOCK
from reactive4d.engine.segments import ELSEWHERE, Table

__all__ = ["below"]

MOST_TABLES: Final = 8
MOST_ANSWERS: Final = 8


def below(cells: Iterable[Cell]) -> dict[Cell, list[Cell]]:
    """The cells and all below them, each with what it reads directly.

    >>> import reactive4d as r4
    >>> x = r4.Variable(1.0, name="x")
    >>> [cell.name for cell in below([2 * x])]
    ['2 * x', 'x']
    """
    found: dict[Cell, list[Cell]] = {}
    todo = list(cells)
    with LOCK:
        while todo:
            cell = todo.pop()
            if cell not in found:
                found[cell] = _read_by(cell)
                todo.extend(found[cell])
    return found


def _read_by(cell: Cell) -> list[Cell]:
    entries: list[Any] = [*cell.inputs]
    tables: list[Table] = [cell]
    if cell.shelves is not None:
        for shelf in cell.shelves.shelves:
            tables.extend(islice(shelf.tables.values(), MOST_TABLES))
    for table in tables:
        for segment in islice(table.segments, MOST_ANSWERS):
            entries.extend(segment.reads)
    return list(dict.fromkeys([entry[0] if type(entry) is ELSEWHERE else entry for entry in entries]))
