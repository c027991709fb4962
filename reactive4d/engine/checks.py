"""The invariants, verified: for tests, before and after every step."""

from collections.abc import Iterable
from sys import float_info
from typing import TYPE_CHECKING, Any

from reactive4d.engine.evictions import tables
from reactive4d.engine.kinds import FORMULA
from reactive4d.engine.links import Readers
from reactive4d.engine.segments import ELSEWHERE, covering
from reactive4d.engine.shelves import ShelfTable
from reactive4d.engine.stamps import piece

if TYPE_CHECKING:
    from reactive4d.engine.cells import Cell
    from reactive4d.engine.engines import Engine
    from reactive4d.engine.segments import Segment

__all__ = ["check", "reached"]


def reached(cells: "Iterable[Cell]") -> "list[Cell]":
    """The cells and everything that they declare or are remembered to have read."""
    found: dict[Cell, None] = {}
    todo = list(cells)
    while todo:
        cell = todo.pop()
        if cell in found:
            continue
        found[cell] = None
        entries: list[Any] = list(cell.inputs)
        for table in tables(cell):
            for segment in table.segments:
                entries.extend(segment.reads)
        todo.extend(entry[0] if type(entry) is ELSEWHERE else entry for entry in entries)
    return list(found)


def check(engine: "Engine", cells: "Iterable[Cell]") -> None:
    """Raise AssertionError where an invariant does not hold; the lock is held."""
    for cell in reached(cells):
        _check_hit(cell)
        if cell.sole is not None:
            segment, lo, hi, _, reads, is_formula = cell.sole
            assert cell.segments == [segment], f"{cell.name} remembers more than {segment}"
            assert cell.shelves is None, f"{cell.name} has answers by parameters"
            assert (segment.lo, segment.hi) == (lo, hi), f"{cell.name}: {segment} is not [{lo}, {hi})"
            assert segment.reads is reads, f"{cell.name}: {segment} read something else"
            assert is_formula is (cell.kind == FORMULA), f"{cell.name} is something else by now"
            assert reads is (cell.inputs if is_formula else cell.linked), f"{cell.name}: what it read is not linked"
        for table in tables(cell):
            if cell.shelves is not None and isinstance(table, ShelfTable):
                cell.shelves.settle(table)
            assert len(table.starts) == len(table.segments), f"{cell.name}: starts and segments differ in number"
            end = -float("inf")
            for start, segment in zip(table.starts, table.segments, strict=True):
                assert start == segment.lo < segment.hi, f"{cell.name}: {segment} starts at {start}"
                assert end <= segment.lo, f"{cell.name}: {segment} overlaps what ends at {end}"
                end = segment.hi
                assert len(segment.reads) == len(segment.stamps), f"{cell.name}: {segment}"
                if segment.clean:
                    _check_clean(engine, cell, segment, is_main=table is cell)
        assert cell.busy is None, f"{cell.name} is claimed by nobody's evaluation"


def _check_hit(cell: "Cell") -> None:
    lo, hi, _, stamp, _, axes = cell.hit
    if lo >= hi or cell.kind == 1:
        return
    if cell.kind == 0:
        assert piece(cell.stamps, lo)[2] == stamp, f"{cell.name}: what it hands out is stale"  # type: ignore[attr-defined]
        return
    if axes is None:
        segment = covering(cell, lo)
        assert segment is not None, f"{cell.name}: hands out what it does not remember"
        assert segment.clean, f"{cell.name}: hands out what is in check"
        assert segment.stamp == stamp, f"{cell.name}: hands out what is stale"


def _check_clean(engine: "Engine", cell: "Cell", segment: "Segment", *, is_main: bool) -> None:
    for entry, stamp in zip(segment.reads, segment.stamps, strict=True):
        source = entry[0] if type(entry) is ELSEWHERE else entry
        if not source.unchanging:
            readers = source.readers
            known = readers is cell.ref or (type(readers) is Readers and cell.ref in readers)
            assert cell.ref is not None, f"{cell.name} reads {source.name}, and nothing can refer to it"
            assert known, f"{cell.name} reads {source.name}, which does not know"
        if type(entry) is ELSEWHERE and entry[2] is not None:
            continue
        time_map = entry[1] if type(entry) is ELSEWHERE else None
        for t in _probes(segment):
            at = t if time_map is None else min(time_map.forward(t), float_info.max)
            if source.kind == 0:
                found = piece(source.stamps, at)[2]
                assert found == stamp, f"{cell.name} {segment} read {source.name} at {at} with {stamp}, it has {found}"
            elif source.kind != 1 and is_main:
                below = covering(source, at)
                assert below is not None, f"{cell.name} {segment} is clean, {source.name} remembers nothing at {at}"
                assert below.clean, f"{cell.name} {segment} is clean, {source.name} is not at {at}"
                assert below.stamp == stamp, (
                    f"{cell.name} {segment} read {source.name} with {stamp}, it has {below.stamp}"
                )


def _probes(segment: "Segment") -> list[float]:
    from math import inf, isinf, nextafter

    lo, hi = segment.lo, segment.hi
    last = nextafter(hi, -inf)
    middle = 0.0 if isinf(lo) and isinf(hi) else hi - 1.0 if isinf(lo) else lo + 1.0 if isinf(hi) else (lo + hi) / 2
    return [t for t in (lo, middle, last) if lo <= t < hi]
