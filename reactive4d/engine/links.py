"""Links from what was read back to who reads it, along which an edit marks what may be stale.

They are weak, one cached weak reference per cell, so that a source does not keep alive readers which nobody else holds.
A link carries the maps through which the reader reads: None for "at the reader's own time", a tuple of maps, or
`ANYWHERE` once there are more than a few. A cell that cannot change (`time`, a parameter) keeps no links at all.
"""

import weakref
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from reactive4d.engine.maps import Affine, Fixed, TimeMap
from reactive4d.engine.segments import ELSEWHERE, MappedReads

if TYPE_CHECKING:
    from reactive4d.engine.cells import Cell

__all__ = ["ANYWHERE", "CellRef", "add_link", "link", "readers_of", "reference", "unlink"]

INF = float("inf")
MOST_MAPS = 8
ANYWHERE = Affine(1.0, 0.0)  # compared by identity: a reader that reads at times which the link does not know

CellRef = weakref.ref


class Readers(dict[Any, Any]):
    """{weak reference to a reader: its maps}, and the size at which the dead are next swept out."""

    __slots__ = ("limit",)

    def __init__(self) -> None:
        super().__init__()
        self.limit = 16


def reference(cell: "Cell") -> Any:
    """The cell's one weak reference."""
    ref = cell.ref
    if ref is None:
        ref = cell.ref = CellRef(cell)
    return ref


def _joined(old: Any, new: TimeMap | None) -> Any:
    """The maps of a link, with one more: None stands for the identity alone."""
    if old is ANYWHERE or new is ANYWHERE:
        return ANYWHERE
    if old is None and new is None:
        return old
    maps: tuple[Any, ...] = (None,) if old is None else old
    if new in maps:
        return old
    return (*maps, new) if len(maps) < MOST_MAPS else ANYWHERE


def add_link(cell: "Cell", source: "Cell", time_map: TimeMap | None) -> None:
    """Let one cell know that another reads it."""
    _add(source, reference(cell), time_map)


def _add(source: "Cell", ref: Any, time_map: TimeMap | None) -> None:
    readers = source.readers
    if readers is None and time_map is None:
        source.readers = ref
        return
    if type(readers) is not Readers:
        source.readers = table = Readers()
        # Held while its reference is hashed for the first time, which needs it alive.
        reader = readers() if readers is not None else None
        if reader is not None:
            table[readers] = None
        readers = table
    if ref in readers:
        readers[ref] = _joined(readers[ref], time_map)
        return
    readers[ref] = time_map if time_map is None or time_map is ANYWHERE else (time_map,)
    if len(readers) > readers.limit:
        for dead in [other for other in readers if other() is None]:
            del readers[dead]
        readers.limit = 2 * len(readers) + 16


def link(cell: "Cell", reads: tuple[Any, ...]) -> None:
    """Let everything in `reads` know that `cell` reads it."""
    ref = cell.ref
    if ref is None:
        ref = cell.ref = CellRef(cell)
    if type(reads) is MappedReads:
        for entry in reads:
            source, time_map = (entry[0], entry[1]) if type(entry) is ELSEWHERE else (entry, None)
            if not source.unchanging:
                _add(source, ref, time_map)
        return
    for source in reads:
        readers = source.readers
        if readers is ref or source.unchanging:
            continue
        if readers is None:
            source.readers = ref
        else:
            _add(source, ref, None)


def unlink(cell: "Cell", old: tuple[Any, ...], new: tuple[Any, ...]) -> None:
    """Drop the links from what `old` names and `new` does not."""
    ref = cell.ref
    kept = {entry[0] if type(entry) is ELSEWHERE else entry for entry in new}
    for entry in old:
        source = entry[0] if type(entry) is ELSEWHERE else entry
        if source in kept:
            continue
        readers = source.readers
        if readers is ref:
            source.readers = None
        elif type(readers) is Readers:
            readers.pop(ref, None)


def readers_of(cell: "Cell") -> Iterator[tuple["Cell", Any]]:
    """The living readers of a cell, each with its maps."""
    readers = cell.readers
    if readers is None:
        return
    if type(readers) is not Readers:
        reader = readers()
        if reader is not None:
            yield reader, None
        return
    for ref, maps in list(readers.items()):
        reader = ref()
        if reader is None:
            readers.pop(ref, None)
        else:
            yield reader, maps


def preimages(maps: Any, lo: float, hi: float) -> list[tuple[float, float]]:
    """Where a reader with these maps depends on what is read in [lo, hi)."""
    if maps is None:
        return [(lo, hi)]
    if maps is ANYWHERE:
        return [(-INF, INF)]
    spans: list[tuple[float, float]] = []
    for time_map in maps:
        if time_map is None:
            spans.append((lo, hi))
        elif type(time_map) is Fixed:
            if lo <= time_map.time < hi:
                return [(-INF, INF)]
        else:
            spans.extend(time_map.preimage(lo, hi))
    return spans
