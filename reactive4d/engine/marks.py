"""Pushing staleness: an edit marks what may depend on it, along the links and over the touched interval, and no further.

Nothing is computed. The walk stops where everything is marked already, so that repeated edits before the next ask cost
next to nothing. It has a stack of its own: no depth of links is too deep.
"""

from typing import TYPE_CHECKING

from reactive4d.engine.frames import NEVER
from reactive4d.engine.hits import COLD, COOL
from reactive4d.engine.links import Readers, preimages, readers_of
from reactive4d.engine.segments import flip

if TYPE_CHECKING:
    from reactive4d.engine.cells import Cell
    from reactive4d.engine.engines import Engine

__all__ = ["mark", "push"]

INF = float("inf")
MOST_STEPS = 256  # marks of one reader along one walk, after which the walk goes to the end of time at once


def mark(engine: "Engine", cell: "Cell", lo: float, hi: float) -> tuple[float, float] | None:
    """Put what a cell remembers over [lo, hi) in check; returns where something was clean, or None."""
    hit = cell.hit
    if hit[0] < hi and lo < hit[1]:
        cell.hit = NEVER
    hot = cell.hot
    if hot[0] < hi and lo < hot[1]:
        cell.hot = COLD
    cell.warm = COOL
    changed = flip(cell, lo, hi)
    if cell.shelves is not None and cell.shelves.mark(lo, hi):
        changed = (lo, hi)
    if changed is not None and engine.logs:
        engine.emit("marked", cell, changed[0], changed[1])
    return changed


def push(engine: "Engine", cell: "Cell", lo: float, hi: float) -> None:
    """Mark everything that reads a cell over [lo, hi), directly or through others."""
    stack = [(cell, lo, hi)]
    walks: dict[Cell, tuple[int, float]] = {}
    while stack:
        cell, lo, hi = stack.pop()
        readers = cell.readers
        if readers is None:
            continue
        while type(readers) is not Readers and readers is not None:
            # A chain: each has one reader.
            reader = readers()
            if reader is None:
                cell.readers = readers = None
                break
            segments = reader.segments
            if len(segments) == 1 and reader.shelves is None and not engine.logs:
                segment = segments[0]
                if not segment.clean:
                    readers = None
                    break
                if lo <= segment.lo and segment.hi <= hi:
                    segment.clean = False
                    lo, hi = segment.lo, segment.hi
                    reader.hit, reader.hot, reader.warm = NEVER, COLD, COOL
                    cell = reader
                    readers = cell.readers
                    continue
            changed = mark(engine, reader, lo, hi)
            if changed is None:
                readers = None
                break
            cell, (lo, hi) = reader, changed
            readers = cell.readers
        if readers is None:
            continue
        for reader, maps in readers_of(cell):
            for a, b in preimages(maps, lo, hi):
                if maps is not None:
                    steps, before = walks.get(reader, (0, a))
                    walks[reader] = steps + 1, a
                    if steps > MOST_STEPS:
                        # It reads its own past (or future): everything after (or before) will be reached.
                        if steps > 2 * MOST_STEPS:
                            a, b = -INF, INF
                        else:
                            a, b = (a, INF) if a > before else (-INF, b)
                changed = mark(engine, reader, a, b)
                if changed is not None:
                    stack.append((reader, *changed))
