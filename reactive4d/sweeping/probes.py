"""Probes: a look at the first points, to find out what the measures answer and read, and what they cost."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from time import perf_counter
from typing import Any

from reactive4d.arrays import measure
from reactive4d.engine import Cell
from reactive4d.engine.failures import Failure
from reactive4d.sweeping.asking import asked
from reactive4d.sweeping.grids import Grid
from reactive4d.sweeping.levers import TIME
from reactive4d.sweeping.orders import best_order, readers_of
from reactive4d.sweeping.plans import Plan, plan_of
from reactive4d.sweeping.values import Kind, encode

__all__ = ["Probe", "probe"]

MOST_BLOCK_SECONDS = 2.0  # of work in a block that is stored as one piece
MOST_BLOCK_BYTES = 1 << 22
MOST_BLOCKS = 4096
MOST_LOOKED = 4096  # points at which `where` is asked before one is found


@dataclass(frozen=True)
class Probe:
    """What was found out.

    Attributes:
        plan: in which order to visit the points.
        kinds: what the measures answer, as far as that is known.
        row: bytes of the answers at one point.
    """

    plan: Plan
    kinds: dict[str, Kind]
    row: int


def probe(
    grid: Grid,
    signals: Mapping[str, Cell],
    values: Mapping[str, Any],
    *,
    drawn: Collection[str] = (),
    is_stored: bool = False,
) -> Probe:
    """Ask the measures at a point or two.

    Args:
        grid: the points.
        signals: the measures.
        values: where the parameters stand that are not moved.
        drawn: the measures that are pictures.
        is_stored: whether there are blocks that are stored as one piece, which must not take too long.
    """
    natural = plan_of(grid.shape, tuple(range(len(grid.shape))), grid.size)
    first = _visited(grid, natural)
    if first is None:
        return Probe(natural, {}, 8)
    kinds, row, seconds = _asked(grid, signals, values, drawn, natural.index(first))
    clock = next((i for i, dimension in enumerate(grid.dimensions) if dimension.is_time), None)
    moved = {name: i for i, d in enumerate(grid.dimensions) for name in d.columns if name != TIME}
    mixed = next((i for i, d in enumerate(grid.dimensions) if TIME in d.columns), None)
    order = best_order(grid.shape, readers_of(signals.values(), moved, time=mixed), time=clock)
    plan = plan_of(grid.shape, order, grid.size)
    if not is_stored:
        return Probe(plan, kinds, row)
    second = _visited(grid, plan, after=plan.place(natural.index(first)) + 1)
    if second is not None:
        # What the first answer took has to do with all that had to be made for it.
        seconds = min(seconds, _asked(grid, signals, values, drawn, plan.index(second))[2])
    most = min(MOST_BLOCK_SECONDS / max(seconds, 1e-7), MOST_BLOCK_BYTES / max(row, 1))
    most = max(1, int(most), -(-grid.size // MOST_BLOCKS) if seconds < 1e-3 else 1)
    return Probe(plan_of(grid.shape, order, most), kinds, row)


def _visited(grid: Grid, plan: Plan, *, after: int = 0) -> int | None:
    """The first place that is visited, if it is found soon."""
    for place in range(after, min(plan.size, after + MOST_LOOKED)):
        mask = grid.mask(plan.tile(place, place + 1, 1)[0])
        if mask is None or mask.all():
            return place
    return None


def _asked(
    grid: Grid, signals: Mapping[str, Cell], values: Mapping[str, Any], drawn: Collection[str], index: tuple[int, ...]
) -> tuple[dict[str, Kind], int, float]:
    """What the measures answer at a point, the bytes of that, and the seconds it took."""
    t, given = grid.point(index)
    given = {**values, **given}
    begun = perf_counter()
    answers: dict[str, Any] = {name: asked(signal, t, given) for name, signal in signals.items()}
    seconds = perf_counter() - begun
    kinds: dict[str, Kind] = {}
    row = 0
    for name, answer in answers.items():
        if name in drawn:
            kinds[name] = Kind("picture")
            row += kinds[name].nbytes
            continue
        row += measure(answer)
        if type(answer) is Failure:
            continue
        encoded = encode([answer], name=name)
        for error in encoded.failed.values():
            raise error
        if encoded.kind is not None:
            kinds[name] = encoded.kind
    return kinds, row, seconds
