"""The dependency graph, as data, as text and as DOT."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from reactive4d.engine.checks import reached
from reactive4d.engine.evictions import tables
from reactive4d.engine.segments import ELSEWHERE

if TYPE_CHECKING:
    from reactive4d.engine.cells import Cell

__all__ = ["Graph", "between", "graph"]

KINDS = {0: "source", 1: "parameter", 2: "formula", 3: "computed"}


@dataclass(frozen=True)
class Graph:
    """Cells and links. `cells` maps an id to (name, kind, state); `links` are (reader id, id of what it reads).

    >>> import reactive4d as r4
    >>> graph = r4.graph(r4.Variable(1.0, name="x") * 2)
    >>> graph.cells, graph.links
    ({0: ('x * 2', 'formula', 'never asked'), 1: ('x', 'source', 'up to date')}, ((0, 1),))
    >>> print(graph.dot())
    digraph {
      rankdir=LR;
      n0 [label="x * 2", shape=ellipse, style=dashed];
      n1 [label="x", shape=box];
      n1 -> n0;
    }
    """

    cells: dict[int, tuple[str, str, str]]
    links: tuple[tuple[int, int], ...]

    def text(self) -> str:
        """One line per cell: its name, kind and state, and what it reads."""
        lines: list[str] = []
        for key, (name, kind, state) in self.cells.items():
            reads = ", ".join(self.cells[below][0] for above, below in self.links if above == key)
            lines.append(f"{name} ({kind}, {state})" + (f" <- {reads}" if reads else ""))
        return "\n".join(lines)

    def dot(self) -> str:
        """The graph in the language of Graphviz; arrows point from what is read to who reads it."""
        shapes = {"source": "box", "parameter": "diamond", "formula": "ellipse", "computed": "ellipse"}
        lines = ["digraph {", "  rankdir=LR;"]
        for key, (name, kind, state) in self.cells.items():
            style = "" if state == "up to date" else ", style=dashed"
            label = name.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
            lines.append(f'  n{key} [label="{label}", shape={shapes[kind]}{style}];')
        lines.extend(f"  n{below} -> n{above};" for above, below in self.links)
        return "\n".join([*lines, "}"])


def _state(cell: "Cell") -> str:
    if cell.kind < 2:
        return "up to date"
    clean = [segment.clean for table in tables(cell) for segment in table.segments]
    return "never asked" if not clean else "up to date" if all(clean) else "to check"


def graph(cells: "Iterable[Cell]") -> Graph:
    """The cells and everything that they read, in a stable order: what is read comes after who reads it."""
    found = reached(cells)
    number = {cell: i for i, cell in enumerate(found)}
    links: dict[tuple[int, int], None] = {}
    for cell in found:
        for below in _reads(cell):
            links[number[cell], number[below]] = None
    return Graph({i: (cell.name, KINDS[cell.kind], _state(cell)) for cell, i in number.items()}, tuple(links))


def between(cells: "Sequence[Cell]") -> tuple[tuple[int, int], ...]:
    """Who of some cells reads whom, directly or through others that are none of them: (reader, what it reads)."""
    number = {cell: i for i, cell in enumerate(cells)}
    links: dict[tuple[int, int], None] = {}
    for cell, i in number.items():
        seen: set[Cell] = set()
        todo = list(_reads(cell))
        while todo:
            below = todo.pop()
            if below in number:
                links[i, number[below]] = None
            elif below not in seen:
                seen.add(below)
                todo.extend(_reads(below))
    return tuple(sorted(links))


def _reads(cell: "Cell") -> "Iterator[Cell]":
    """What a cell declares, or is remembered to have read."""
    entries: list[Any] = list(cell.inputs)
    for table in tables(cell):
        for segment in table.segments:
            entries.extend(segment.reads)
    for entry in entries:
        yield entry[0] if type(entry) is ELSEWHERE else entry
