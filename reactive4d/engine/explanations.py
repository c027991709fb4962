"""What was computed and what was reused to answer one question, and why."""

import sys
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from reactive4d.engine.failures import Failure
from reactive4d.engine.frames import LOCK
from reactive4d.engine.segments import ELSEWHERE, Segment, Table, covering

if TYPE_CHECKING:
    from reactive4d.engine.cells import Cell
    from reactive4d.engine.engines import Engine

__all__ = ["explain", "is_in_check"]

MOST_LINES = 200


def explain(engine: "Engine", cell: "Cell", t: float, parameters: Mapping[str, Any]) -> str:
    """Answer the question, and tell what had to be done for it."""
    from reactive4d.engine.checks import reached

    t = min(float(t), sys.float_info.max)
    point = engine.point(parameters) if parameters else None
    with LOCK:
        before = {other: other.runs for other in reached([cell])}
        stale = {other: _standing(other, t, point) for other in before}
    cell._hit_at(t, dict(parameters))  # pyright: ignore[reportPrivateUsage]
    found: list[tuple[Any, ...]] = []
    seen: set[Any] = set()
    todo: list[tuple[Any, float, Any, int, str]] = [(cell, t, point, 0, "")]
    with LOCK:
        while todo and len(found) < MOST_LINES:
            current, at, where, depth, how = todo.pop()
            again = (current, at, where) in seen
            seen.add((current, at, where))
            clean = [segment for segment in _remembered(current, at, where) if segment.clean]
            segment = clean[0] if clean else None
            found.append((depth, current, at, segment, how, again))
            if again or segment is None:
                continue
            for entry in reversed(segment.reads):
                if type(entry) is ELSEWHERE:
                    below, there, its = engine.elsewhere(entry, at, where)
                    notes = [f"at t = {there:g}"] if entry[1] is not None else []
                    notes += [f"with {name} = {value!r}" for name, value in entry[2] or ()]
                    todo.append((below, there, its, depth + 1, " " + " ".join(notes)))
                else:
                    todo.append((entry, at, where, depth + 1, ""))
    # What the user's own `repr` does is none of the lock's business.
    lines = [
        "  " * depth + _line(current, at, segment, how, before, stale, again=again)
        for depth, current, at, segment, how, again in found
    ]
    return "\n".join([*lines, "…"] if todo else lines)


def _standing(cell: "Cell", t: float, point: Any) -> str:
    remembered = _remembered(cell, t, point)
    if not remembered:
        return "nothing was remembered here"
    return "" if any(segment.clean for segment in remembered) else "what it read was edited"


def is_in_check(cell: "Cell", t: float, point: Any) -> bool:
    """Whether something below was edited since a cell was asked at a point, and nobody has looked; the lock is held."""
    remembered = _remembered(cell, t, point)
    return bool(remembered) and not any(segment.clean for segment in remembered)


def _remembered(cell: "Cell", t: float, point: Any) -> list[Segment]:
    """What a cell remembers at a point, clean or not: of the answers that read no parameter, and of those that did."""
    tables: list[Table | None] = [cell]
    if cell.shelves is not None:
        tables.extend(cell.shelves.table(shelf, point) for shelf in cell.shelves.shelves)
    return [segment for table in tables if table is not None and (segment := covering(table, t)) is not None]


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
