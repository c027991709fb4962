"""What was computed and what was reused to answer one question, and why."""

import sys
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from reactive4d.engine.evictions import tables
from reactive4d.engine.failures import Failure
from reactive4d.engine.segments import Segment, covering

if TYPE_CHECKING:
    from reactive4d.engine.cells import Cell
    from reactive4d.engine.engines import Engine

__all__ = ["explain"]

MOST_LINES = 200


def explain(engine: "Engine", cell: "Cell", t: float, parameters: Mapping[str, Any]) -> str:
    """Answer the question, and tell what had to be done for it."""
    from reactive4d.engine.checks import reached

    t = min(float(t), sys.float_info.max)
    point = engine.point(parameters) if parameters else None
    before = {other: _runs(other) for other in reached([cell])}
    stale = {other: _standing(other, t) for other in before}
    cell._hit_at(float(t), dict(parameters))  # pyright: ignore[reportPrivateUsage]
    lines: list[str] = []
    seen: set[Any] = set()
    todo: list[tuple[Any, float, int, str]] = [(cell, float(t), 0, "")]
    while todo and len(lines) < MOST_LINES:
        current, at, depth, how = todo.pop()
        again = (current, at) in seen
        seen.add((current, at))
        segment = _found(engine, current, at, point)
        lines.append("  " * depth + _line(current, at, segment, how, before, stale, again=again))
        if again or segment is None:
            continue
        for entry in reversed(segment.reads):
            if type(entry) is tuple:
                below, there, _ = engine.elsewhere(entry, at, point)
                todo.append((below, there, depth + 1, f" at t = {there:g}"))
            else:
                todo.append((entry, at, depth + 1, ""))
    if todo:
        lines.append("…")
    return "\n".join(lines)


def _runs(cell: "Cell") -> int:
    return cell.runs


def _standing(cell: "Cell", t: float) -> str:
    segment = covering(cell, t)
    if segment is None:
        return "nothing was remembered here"
    return "" if segment.clean else "what it read was edited"


def _found(engine: "Engine", cell: "Cell", t: float, point: Any) -> Segment | None:
    for table in tables(cell):
        if cell.shelves is not None and table is not cell:
            for shelf in cell.shelves.shelves:
                if shelf.tables.get(shelf.key(point)) is table:
                    segment = covering(table, t)
                    if segment is not None:
                        return segment
        else:
            segment = covering(table, t)
            if segment is not None and segment.clean:
                return segment
    return None


def _line(cell: "Cell", t: float, segment: Segment | None, how: str, before: Any, stale: Any, *, again: bool) -> str:
    if cell.kind < 2:
        return f"{cell.name}{how}: {'parameter' if cell.kind else 'source'}"
    if segment is None:
        return f"{cell.name}{how}: not needed"
    value = segment.value
    shown = repr(value) if isinstance(value, Failure) or len(repr(value)) < 60 else f"<{type(value).__name__}>"
    where = f"holds over [{segment.lo:g}, {segment.hi:g})"
    if again:
        return f"{cell.name}{how}: see above"
    if cell.runs > before.get(cell, 0):
        why = stale.get(cell, "nothing was remembered here") or "another point was asked"
        return f"{cell.name}{how} = {shown}: computed, since {why}; {where}"
    why = "reused" if not stale.get(cell, "") else "checked and reused: everything it read is as it was"
    return f"{cell.name}{how} = {shown}: {why}; {where}"
