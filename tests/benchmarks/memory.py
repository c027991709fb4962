"""How many bytes a computed cell takes that remembers one answer, by the interpreter's own count."""

import gc
import tracemalloc
from collections.abc import Callable
from typing import Any

from .contenders import contenders
from .graph_speed import deep_recursion
from .libraries import Library
from .operations import INCREMENT, Operation
from .reports import Section, Target
from .runs import Run

__all__ = ["memory"]


def memory(run: Run) -> Section:
    """Cells in a row, each reading the one before it: so each has one reader and one answer."""
    count = 500 if run.quick else 2_000
    section = Section("memory", "Bytes of a computed cell with one remembered answer", ("library", "bytes", "at most"))
    for library in contenders():
        if library.name == "effects":
            continue
        each = _bytes_per_cell(library, count)
        ours = library.name in ("ours", "declared")
        section.rows.append((library.title, f"{each:.0f}", "1024" if ours else ""))
        section.figures[library.name] = each
        if ours:
            section.targets.append(Target(f"memory: a cell with one answer, {library.name}", 1024, each, "bytes"))
    section.notes.append(
        f"{count} cells in a row; with the answer, the links and the engine's lists, without the rule, which is the "
        "user's."
    )
    return section


def _bytes_per_cell(library: type[Library], count: int) -> float:
    lib = library()
    cells: list[Any] = [None] * (count + 1)
    cells[0] = lib.source(1.0)
    reads: list[Any] = [None] * count
    # The rules are made before the count begins; what they read with is put into `reads`, and counted apart.
    operations = [Operation(INCREMENT.values, _reading(reads, place)) for place in range(count)]
    with deep_recursion():
        gc.collect()
        tracemalloc.start()
        try:
            start = tracemalloc.get_traced_memory()[0]
            spare = [lib.reader(cells[0]) for _ in range(count)]
            reader = (tracemalloc.get_traced_memory()[0] - start) / count
            before = tracemalloc.get_traced_memory()[0]
            for place in range(count):
                cells[place + 1] = lib.cell(operations[place], cells[place])
                lib.viewer(cells[place + 1])()
            gc.collect()
            after = tracemalloc.get_traced_memory()[0]
        finally:
            tracemalloc.stop()
    del spare
    lib.close()
    return (after - before) / count - reader


def _reading(reads: list[Any], place: int) -> Callable[..., Callable[[], Any]]:
    def rule() -> Any:
        return reads[place]() + 1.0

    def with_reader(read: Callable[[], Any]) -> Callable[[], Any]:
        reads[place] = read
        return rule

    return with_reader
