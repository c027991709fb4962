"""Orders: which dimension is the outermost loop, and which the innermost.

A cell that remembers its latest answer is evaluated again whenever something changes that it reads: as often as there
are combinations of what the loops down to the innermost dimension that it reads run through. So those dimensions belong
inside that only few or cheap cells read, and the best order is the one in which all evaluations together take the
least. What the memo has room for beyond the latest answer comes on top of that.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import permutations

from reactive4d.engine import Cell
from reactive4d.engine.kinds import AXIS, SOURCE
from reactive4d.sweeping.readings import below

__all__ = ["Reader", "best_order", "cost", "readers_of"]

INF = float("inf")
MOST_TRIED = 7  # dimensions of which all orders are tried
_CHEAP = 1e-5  # seconds; what takes less is not told apart, nor is what was never timed
_BETTER = 0.9  # by how much another order must be better than the one that was given


@dataclass(frozen=True)
class Reader:
    """What one cell reads, directly or through others, and what it costs to evaluate it."""

    dimensions: frozenset[int]
    seconds: float


def cost(order: Sequence[int], shape: Sequence[int], readers: Mapping[frozenset[int], float]) -> float:
    """Seconds that all evaluations take if each cell remembers its latest answer.

    >>> cost((0, 1), (10, 5), {frozenset({0}): 1.0, frozenset({0, 1}): 0.1})
    15.0
    """
    total = 0.0
    for dimensions, seconds in readers.items():
        times, left = 1, len(dimensions)
        for dimension in order:
            if not left:
                break
            times *= shape[dimension]
            left -= dimension in dimensions
        total += seconds * times
    return total


def best_order(shape: Sequence[int], readers: Iterable[Reader], *, time: int | None = None) -> tuple[int, ...]:
    """The order in which the evaluations take the least; if none is much better, the one given, with time innermost.

    >>> heavy, light = Reader(frozenset({1}), 1.0), Reader(frozenset({0, 1}), 1e-3)
    >>> best_order((10, 5), [heavy, light])
    (1, 0)
    """
    merged: dict[frozenset[int], float] = {}
    for reader in readers:
        merged[reader.dimensions] = merged.get(reader.dimensions, 0.0) + reader.seconds
    first = tuple([d for d in range(len(shape)) if d != time] + ([] if time is None else [time]))
    if len(shape) > MOST_TRIED:
        # Too many to try: what costs most per value goes outside.
        weight = [sum(s for dimensions, s in merged.items() if d in dimensions) for d in range(len(shape))]
        return tuple(sorted(first, key=lambda d: -weight[d]))
    given = cost(first, shape, merged)
    seconds, best = min(((cost(order, shape, merged), order) for order in permutations(first)), key=lambda x: x[0])
    return best if seconds < _BETTER * given else first


def readers_of(cells: Iterable[Cell], dimensions: Mapping[str, int], *, time: int | None) -> list[Reader]:
    """What the cells below some signals read, as far as they were asked; each with what its rule takes.

    Args:
        cells: the signals.
        dimensions: which dimension moves a parameter, by its name.
        time: the dimension that moves time, if any.
    """
    found = below(cells)
    reads: dict[Cell, frozenset[int]] = {}
    for cell in _upwards(found):
        own = _own(cell, dimensions, time)
        reads[cell] = own.union(*[reads.get(other, frozenset()) for other in found[cell]])
    return [Reader(reads[c], max(c.cost, _CHEAP)) for c in found if c.kind not in (SOURCE, AXIS)]


def _own(cell: Cell, dimensions: Mapping[str, int], time: int | None) -> frozenset[int]:
    """The dimensions that a cell depends on by itself; what it reads comes on top of that."""
    if cell.kind == AXIS:
        return frozenset([dimensions[cell.name]]) if cell.name in dimensions else frozenset()
    if time is None:
        return frozenset()
    lo, hi = cell.sample(0.0)[:2] if cell.kind == SOURCE else cell.hit[:2]
    # An answer that does not hold for ever depends on time; one of a cell that was never asked is empty.
    return frozenset([time]) if lo <= hi and (lo > -INF or hi < INF) else frozenset()


def _upwards(found: Mapping[Cell, Sequence[Cell]]) -> list[Cell]:
    """The cells, what is read before who reads it; where there is a ring, in any order."""
    done: dict[Cell, None] = {}
    for root in found:
        todo: list[tuple[Cell, bool]] = [(root, False)]
        opened: set[Cell] = set()
        while todo:
            cell, is_ready = todo.pop()
            if is_ready:
                done[cell] = None
            elif cell not in done and cell not in opened:
                opened.add(cell)
                todo.append((cell, True))
                todo.extend((other, False) for other in found[cell])
    return list(done)
