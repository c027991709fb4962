"""Pushing staleness: an edit marks what may depend on it, along the links and over the touched interval, no further.

Nothing is computed. The walk stops where everything is marked already, so that repeated edits before the next ask cost
next to nothing. It has a stack of its own: no depth of links is too deep.
"""

from typing import TYPE_CHECKING, Any

from reactive4d.engine.frames import NEVER
from reactive4d.engine.hits import COLD, COOL
from reactive4d.engine.links import Readers, preimages
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
    logs = engine.logs
    while stack:
        cell, lo, hi = stack.pop()
        readers = cell.readers
        if readers is None:
            continue
        dead: list[Any] = []
        for ref, maps in readers.items() if type(readers) is Readers else ((readers, None),):
            reader = ref()
            if reader is None:
                dead.append(ref)
                continue
            if maps is not None:
                for a, b in preimages(maps, lo, hi):
                    _push_elsewhere(engine, reader, a, b, walks, stack)
                continue
            # Along a chain, where each has one reader, at once to its end.
            a, b = lo, hi
            while reader is not None:
                sole = reader.sole
                if sole is None:
                    _push_here(engine, reader, a, b, stack)
                    break
                segment = sole[0]
                if not segment.clean:
                    break
                start, stop = sole[1], sole[2]
                if start < a or b < stop or logs:
                    _push_here(engine, reader, a, b, stack)
                    break
                segment.clean = False
                reader.hit, reader.hot, reader.warm = NEVER, COLD, COOL
                above = reader.readers
                if above is None:
                    break
                a, b = start, stop
                if type(above) is Readers:
                    stack.append((reader, a, b))
                    break
                reader = above()
        for ref in dead:
            if type(readers) is Readers:
                readers.pop(ref, None)
            else:
                cell.readers = None


def _push_here(
    engine: "Engine", reader: "Cell", lo: float, hi: float, stack: "list[tuple[Cell, float, float]]"
) -> None:
    changed = mark(engine, reader, lo, hi)
    if changed is not None:
        stack.append((reader, *changed))


def _push_elsewhere(
    engine: "Engine",
    reader: "Cell",
    lo: float,
    hi: float,
    walks: "dict[Cell, tuple[int, float]]",
    stack: "list[tuple[Cell, float, float]]",
) -> None:
    """Mark a reader that reads elsewhere in time, perhaps its own past: such a walk must come to an end."""
    steps, before = walks.get(reader, (0, lo))
    walks[reader] = steps + 1, lo
    if steps > 2 * MOST_STEPS:
        lo, hi = -INF, INF
    elif steps > MOST_STEPS:
        # It reads its own past (or future): everything after (or before) will be reached.
        lo, hi = (lo, INF) if lo > before else (-INF, hi)
    changed = mark(engine, reader, lo, hi)
    if changed is not None:
        stack.append((reader, *changed))
