"""The byte budget: which answers are forgotten first. Forgetting never changes an answer.

An answer pays by the seconds that it saves, for the time over which it holds, per byte; less the longer nobody asked.
Every cell keeps its latest answer. Under pressure those go first that pay least; while the pressure lasts, a new answer
that pays no more than what went is kept only until the cell has its next one, so that a model replayed again and again
keeps one part of its answers instead of always losing the next one needed.

When an answer is forgotten, its readers' answers need not be: what it had read is spliced in its place into theirs.
"""

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from reactive4d.engine.failures import Failure
from reactive4d.engine.frames import NEVER
from reactive4d.engine.hits import COLD, COOL
from reactive4d.engine.links import link, readers_of, reference
from reactive4d.engine.marks import mark, push
from reactive4d.engine.segments import EMPTY, MappedReads, Segment, Table

if TYPE_CHECKING:
    from reactive4d.engine.cells import Cell
    from reactive4d.engine.engines import Engine

__all__ = ["CONTENT", "SEGMENT", "enlist", "forget", "keep", "stats", "tables", "trim", "weigh"]

INF = float("inf")
SEGMENT = 300  # bytes of a segment with its times, stamps and dependencies, besides the answer
CONTENT = 180  # bytes of an older content that is kept for undoing
FRAMES = 60.0  # an instant counts as this part of a second
LONGEST = 3600.0 * FRAMES
MOST_SPLICED = 12
SAMPLE = 512
OLD = 2.0  # turns of the memo after which an answer that nobody asked for begins to count less


def keep(engine: "Engine", cell: "Cell", segment: Segment) -> None:
    """Take note of a new answer; under pressure the cell's last one goes, if it does not pay."""
    if not cell.enlisted:
        enlist(engine, cell)
    elif engine.threshold > 0.0:
        last = cell.hit
        if last is not NEVER and last[5] is None:
            engine.unpaid.append((cell.ref, last[0]))


def enlist(engine: "Engine", cell: "Cell") -> None:
    """Remember that this cell remembers something."""
    cell.enlisted = True
    keepers = engine.keepers
    keepers.append(reference(cell))
    if len(keepers) > engine.crowd:
        engine.keepers = [ref for ref in keepers if ref() is not None]
        engine.crowd = 2 * len(engine.keepers) + 1024


def tables(cell: "Cell") -> list[Table]:
    """All tables of a cell, with all marks applied; the lock is held."""
    tables: list[Table] = [cell]
    if cell.shelves is not None:
        for shelf in cell.shelves.shelves:
            for table in shelf.tables.values():
                cell.shelves.settle(table)
                tables.append(table)
    return tables


def _size(engine: "Engine", value: Any) -> int:
    return 24 if type(value) is float else engine.measure(value)


def weigh(engine: "Engine", cell: "Cell") -> int:
    """Bytes of what a cell remembers, counting a shared value once."""
    total = 0
    for table in tables(cell):
        seen: set[int] = set()
        for segment in table.segments:
            total += SEGMENT
            if id(segment.value) not in seen:
                seen.add(id(segment.value))
                total += _size(engine, segment.value)
            for old in segment.older:
                if id(old) not in seen:
                    seen.add(id(old))
                    total += CONTENT
                    if id(old[0]) not in seen:
                        seen.add(id(old[0]))
                        total += _size(engine, old[0])
    if cell.shelves is not None:
        total += sum(_weigh_batch(engine, key, batch) for key, batch in cell.shelves.batches.items())
    return total


def _weigh_batch(engine: "Engine", key: Any, batch: Any) -> int:
    return SEGMENT + engine.measure(batch.value) + len(key[0])


def _pay(engine: "Engine", cell: "Cell", segment: Segment, turn: float) -> float:
    """What an answer is worth: seconds saved x frames over which it holds / bytes, halved for every turn unasked."""
    frames = min(1.0 + (segment.hi - segment.lo) * FRAMES, LONGEST)
    worth = (cell.cost + 1e-6) * frames / (SEGMENT + _size(engine, segment.value))
    if _is_covered(cell, segment):
        worth *= 0.01
    age = (engine.clock - segment.touched) / turn
    return worth if age <= OLD else worth * 0.5 ** min(age - OLD, 60.0)


def _is_covered(cell: "Cell", segment: Segment) -> bool:
    """Whether the answer's one reader has an answer that holds as long: then nobody will ask for this one."""
    reader: Cell | None = None
    for other, maps in readers_of(cell):
        if reader is not None or maps is not None:
            return False
        reader = other
    if reader is None:
        return False
    from reactive4d.engine.segments import covering

    above = covering(reader, segment.lo)
    return above is not None and above.clean and above.lo <= segment.lo and segment.hi <= above.hi


def _latest(cell: "Cell") -> Segment | None:
    latest: Segment | None = None
    for table in tables(cell):
        for segment in table.segments:
            if latest is None or segment.touched >= latest.touched:
                latest = segment
    return latest


def trim(engine: "Engine") -> None:
    """Forget what pays least, until the budget is kept."""
    if engine.unpaid:
        _drop_unpaid(engine)
    if engine.bytes <= engine.budget:
        if engine.bytes < 0.8 * engine.budget:
            engine.threshold = 0.0
        return
    engine.bytes = _count(engine)
    engine.limit = engine.budget
    goal = engine.budget - engine.budget // 32
    if engine.bytes <= engine.budget:
        return
    for turn in range(4):
        # The last turn looks at everybody: a sample may miss the one cell that has much to forget.
        _sweep(engine, engine.bytes - goal, batches=turn < 2, is_whole=turn == 3)
        if engine.bytes <= goal:
            return
    # Only latest answers are left, which stay. Do not look again before a good deal has come on top.
    engine.limit = engine.bytes + engine.bytes // 16


def _count(engine: "Engine") -> int:
    engine.keepers = [ref for ref in engine.keepers if ref() is not None]
    engine.crowd = 2 * len(engine.keepers) + 1024
    return sum(weigh(engine, cell) for ref in engine.keepers if (cell := ref()) is not None)


def _evictable(cell: "Cell") -> list[tuple[Table, Segment]]:
    latest = _latest(cell)
    return [(table, segment) for table in tables(cell) for segment in table.segments if segment is not latest]


def _sweep(engine: "Engine", need: int, *, batches: int = 1, is_whole: bool = False) -> None:
    """One turn of the hand: free `need` bytes from what pays least, judged by a sample; few batches are kept."""
    keepers = engine.keepers
    if not keepers:
        return
    answers = max(64, engine.bytes // (SEGMENT + 100))
    sample: list[tuple[float, int]] = []
    stride = 1 if is_whole else max(1, len(keepers) // 128)
    for ref in keepers[engine.hand % stride :: stride]:
        cell = ref()
        if cell is None:
            continue
        found = _evictable(cell)
        for _, segment in found[:: max(1, len(found) // 8)]:
            sample.append((_pay(engine, cell, segment, answers), SEGMENT + _size(engine, segment.value)))
    sample.sort()
    total = sum(size for _, size in sample)
    share, sum_so_far, limit = need / max(1, engine.bytes), 0, 0.0
    for worth, size in sample:
        limit = worth
        sum_so_far += size
        if sum_so_far >= share * total:
            break
    engine.threshold = max(limit, 1e-30)
    goal = engine.bytes - need
    for _ in range(len(keepers)):
        if engine.bytes <= goal:
            return
        engine.hand = (engine.hand + 1) % len(keepers)
        cell = keepers[engine.hand]()
        if cell is None or cell.busy is not None:
            continue
        _drop_older(engine, cell)
        _drop_batches(engine, cell, batches)
        for table, segment in _evictable(cell):
            if _pay(engine, cell, segment, answers) <= limit:
                _evict(engine, cell, table, segment)
                if engine.bytes <= goal:
                    break
        _drop_emptytables(cell)


def _drop_older(engine: "Engine", cell: "Cell") -> None:
    for table in tables(cell):
        for segment in table.segments:
            for old in segment.older:
                engine.bytes -= CONTENT + _size(engine, old[0])
            segment.older = EMPTY


def _drop_batches(engine: "Engine", cell: "Cell", kept: int) -> None:
    """Forget a cell's answers at arrays of times, but for the last ones."""
    if cell.shelves is None:
        return
    batches = cell.shelves.batches
    for key in list(batches)[: max(0, len(batches) - kept)]:
        batch = batches.pop(key)
        engine.bytes -= _weigh_batch(engine, key, batch)
        engine.evicted += 1
        if engine.logs:
            engine.emit("evicted", cell, batch.lo, batch.hi)


def _drop_emptytables(cell: "Cell") -> None:
    if cell.shelves is not None:
        for shelf in cell.shelves.shelves:
            for key in [key for key, table in shelf.tables.items() if not table.segments]:
                del shelf.tables[key]


def _drop_unpaid(engine: "Engine") -> None:
    """Forget the answers that were a cell's latest, and pay less than what has gone already."""
    unpaid, engine.unpaid = engine.unpaid, []
    answers = max(64, engine.bytes // (SEGMENT + 100))
    for ref, start in unpaid:
        cell = ref()
        if cell is None or cell.busy is not None or engine.bytes < 0.95 * engine.budget:
            continue
        latest = _latest(cell)
        for segment in cell.segments:
            if segment.lo == start and segment is not latest:
                if _pay(engine, cell, segment, answers) <= engine.threshold:
                    _evict(engine, cell, cell, segment)
                    engine.refused += 1
                break
    if engine.refused > answers:
        # Look again at what was kept: perhaps nobody asks for it any more.
        engine.refused = 0
        _sweep(engine, engine.budget // 64)


def _evict(engine: "Engine", cell: "Cell", table: Table, segment: Segment) -> None:
    """Forget one answer; its readers' answers stay if what it read can be put in its place."""
    i = table.segments.index(segment)
    del table.segments[i]
    del table.starts[i]
    table.sole = None
    if cell.hit[0] < segment.hi and segment.lo < cell.hit[1]:
        cell.hit = NEVER
    cell.hot = COLD
    cell.warm = COOL
    engine.bytes -= SEGMENT + _size(engine, segment.value)
    for old in segment.older:
        engine.bytes -= CONTENT + _size(engine, old[0])
    engine.evicted += 1
    if engine.logs:
        engine.emit("evicted", cell, segment.lo, segment.hi)
    if segment.clean:
        _let_go(engine, cell, table, segment)


def _let_go(engine: "Engine", cell: "Cell", table: Table, segment: Segment) -> None:
    for reader, maps in readers_of(cell):
        if maps is not None or table is not cell or reader.shelves is not None or type(segment.value) is Failure:
            _question(engine, cell, reader, maps, segment)
            continue
        for above in [s for s in reader.segments if s.lo < segment.hi and segment.lo < s.hi and cell in s.reads]:
            inside = segment.lo <= above.lo and above.hi <= segment.hi
            spliced = _spliced(above, cell, segment) if inside and above.clean else None
            if spliced is None:
                _question(engine, cell, reader, None, segment)
                break
            above.reads, above.stamps = spliced
            link(reader, above.reads)
            reader.linked = reader.sole = None


def _spliced(above: Segment, cell: "Cell", segment: Segment) -> tuple[tuple[Any, ...], tuple[int, ...]] | None:
    """What a reader's answer depends on, with what `cell` had read in the place of `cell`."""
    if len(above.reads) + len(segment.reads) > MOST_SPLICED:
        return None
    deps: dict[Any, int] = {}
    for entry, stamp in zip(above.reads, above.stamps, strict=True):
        if entry is not cell:
            if deps.setdefault(entry, stamp) != stamp:
                return None
            continue
        if stamp != segment.stamp:
            return None
        for inner, its in zip(segment.reads, segment.stamps, strict=True):
            if deps.setdefault(inner, its) != its:
                return None
    mapped = any(type(entry) is tuple for entry in deps)
    return (MappedReads(deps) if mapped else tuple(deps)), tuple(deps.values())


def _question(engine: "Engine", cell: "Cell", reader: "Cell", maps: Any, segment: Segment) -> None:
    from reactive4d.engine.links import preimages

    for lo, hi in preimages(maps, segment.lo, segment.hi):
        changed = mark(engine, reader, lo, hi)
        if changed is not None:
            push(engine, reader, *changed)


def forget(engine: "Engine", cells: "Iterable[Cell] | None") -> None:
    """Forget all remembered answers of some cells, or of all that remember more than one."""
    chosen = [cell for ref in engine.keepers if (cell := ref()) is not None] if cells is None else list(cells)
    for cell in chosen:
        if cell.busy is not None:
            continue
        if cell.kind >= 2:
            cell.hit, cell.hot, cell.warm = NEVER, COLD, COOL
        for table in tables(cell):
            table.starts, table.segments, table.sole = EMPTY, EMPTY, None
        cell.shelves = None
        push(engine, cell, -INF, INF)
    engine.bytes = _count(engine)


def stats(engine: "Engine", cells: "Iterable[Cell] | None") -> dict[str, Any]:
    """What the memo holds, in all and by cell; cells of one name are told together."""
    chosen = [cell for ref in engine.keepers if (cell := ref()) is not None] if cells is None else list(cells)
    by_cell: dict[str, dict[str, Any]] = {}
    for cell in chosen:
        answers = sum(len(table.segments) for table in tables(cell))
        told = {
            "evaluations": cell.runs,
            "seconds": cell.runs * cell.cost,
            "answers": answers,
            "bytes": weigh(engine, cell),
            "hits": cell.hits,
            "seconds_saved": cell.hits * cell.cost,
        }
        namesake = by_cell.get(cell.name)
        by_cell[cell.name] = told if namesake is None else {key: told[key] + namesake[key] for key in told}
    return {
        "bytes": sum(entry["bytes"] for entry in by_cell.values()),
        "budget": engine.budget,
        "evicted": engine.evicted,
        "evaluations": sum(entry["evaluations"] for entry in by_cell.values()),
        "hits": sum(entry["hits"] for entry in by_cell.values()),
        "cells": by_cell,
    }
