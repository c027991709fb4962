"""The graphs by which signal libraries are usually measured, written from their definitions.

Each is a function of a library and of sizes; it builds the graph and returns its step: make the i-th edit, look at
what is watched, and return the sum of what was seen, so that all contenders can be held against each other. Values
are floats, whole ones, so that sums are exact.
"""

import random
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from .libraries import Library
from .operations import (
    DIFFERENCE,
    GATHER,
    HEAD_OR_TAIL,
    INCREMENT,
    MIX,
    NEGATE,
    PICK,
    SAME,
    TOTAL,
    TWICE,
    ZERO,
    item,
    plus,
)

__all__ = ["GRAPHS", "Graph", "ladder"]

Step = Callable[[int], Any]


def chain(lib: Library, *, length: int) -> Step:
    """A chain: head --> +1 --> +1 --> ... --> viewer."""
    head = last = lib.source(-1.0)
    for _ in range(length):
        last = lib.cell(INCREMENT, last)
    return _step(lib, [head], [last])


def fan(lib: Library, *, width: int) -> Step:
    """A fan: head --> width cells, each with a viewer."""
    head = lib.source(-1.0)
    return _step(lib, [head], [lib.cell(plus(index), head) for index in range(width)])


def diamond(lib: Library, *, width: int) -> Step:
    """A diamond: head --> width cells --> their sum --> viewer."""
    head = lib.source(-1.0)
    middle = [lib.cell(plus(index), head) for index in range(width)]
    return _step(lib, [head], [lib.cell(TOTAL, *middle)])


def broad(lib: Library, *, width: int) -> Step:
    """Broad: head --> width cells --> a child each --> viewers."""
    head = lib.source(-1.0)
    return _step(lib, [head], [lib.cell(INCREMENT, lib.cell(plus(index), head)) for index in range(width)])


def triangle(lib: Library, *, width: int) -> Step:
    """A chain whose members are all summed."""
    current = head = lib.source(-1.0)
    members = []
    for _ in range(width):
        members.append(current)
        current = lib.cell(INCREMENT, current)
    return _step(lib, [head], [lib.cell(TOTAL, *members)])


def mux(lib: Library, *, width: int, batch: int) -> Step:
    """A multiplexer: width heads --> one tuple of them all --> its members, one cell each --> +1 --> viewers."""
    heads = [lib.source(-1.0) for _ in range(width)]
    gathered = lib.cell(GATHER, *heads)
    members = [lib.cell(INCREMENT, lib.cell(item(index), gathered)) for index in range(width)]
    return _step(lib, heads, members, batch=batch)


def avoidable(lib: Library, *, length: int) -> Step:
    """Avoidable work: head --> same --> 0 --> a chain that need never run again --> viewer."""
    head = lib.source(1.0)
    last = lib.cell(ZERO, lib.cell(SAME, head))
    for _ in range(length):
        last = lib.cell(INCREMENT, last)
    return _step(lib, [head], [last])


def unstable(lib: Library) -> Step:
    """Unstable: head --> twice, negated; a cell reads head and one of them, another one at every edit, twenty times."""
    head = lib.source(-1.0)
    return _step(lib, [head], [lib.cell(HEAD_OR_TAIL, head, lib.cell(TWICE, head), lib.cell(NEGATE, head))])


def repeated(lib: Library, *, times: int) -> Step:
    """A cell that reads head over and over."""
    head = lib.source(-1.0)
    return _step(lib, [head], [lib.cell(TOTAL, *[head] * times)])


def layered(
    lib: Library, *, width: int, layers: int, inputs: int, dynamic: float = 0.0, spread: int = 2, batch: int = 1
) -> Step:
    """Layers of width cells, the first of sources; each cell reads a few of the layer before, near it or anywhere.

    Args:
        lib: who computes.
        width: cells in a layer.
        layers: how many, the sources included.
        inputs: how many each cell reads.
        dynamic: the part of the cells that now and then leave out one of their inputs.
        spread: the inputs lie within `spread * inputs` neighbours; 0: anywhere.
        batch: how many sources are written before somebody looks.
    """
    draw = random.Random(width * 1000 + layers)
    sources = row = [lib.source(-1.0 - index) for index in range(width)]
    reach = min(width, spread * inputs) if spread else width
    for _ in range(layers - 1):
        row = [
            lib.cell(
                PICK if draw.random() < dynamic else MIX,
                *[row[(place + near) % width] for near in draw.sample(range(reach), min(inputs, reach))],
            )
            for place in range(width)
        ]
    return _step(lib, sources, row, batch=batch)


def ladder(lib: Library, *, layers: int) -> Step:
    """Two cells on each layer, both read both of the layer before; on every layer a viewer."""
    left = right = head = lib.source(-1.0)
    watched = []
    for _ in range(layers):
        left, right = lib.cell(MIX, left, right), lib.cell(DIFFERENCE, lib.cell(TWICE, left), right)
        watched.append(lib.cell(MIX, left, right))
    return _step(lib, [head], watched)


def _step(lib: Library, sources: list[Any], watched: list[Any], *, batch: int = 1) -> Step:
    writes = [lib.writer(source) for source in sources]
    looks = [lib.viewer(cell) for cell in watched]
    count = len(writes)

    if batch == 1 and len(looks) == 1:
        look = looks[0]

        def step(i: int) -> Any:
            writes[i % count](float(i))
            return look()

    elif batch == 1:

        def step(i: int) -> Any:
            writes[i % count](float(i))
            return sum([look() for look in looks])

    else:

        def step(i: int) -> Any:
            with lib.batch():
                for place in range(i * batch, (i + 1) * batch):
                    writes[place % count](float(place))
            return sum([look() for look in looks])

    return step


@dataclass(frozen=True)
class Graph:
    """A workload: what builds it, at the full size and at a tiny one for the tests."""

    name: str
    build: Callable[..., Step]
    size: dict[str, Any] = field(default_factory=dict[str, Any])
    tiny: dict[str, Any] = field(default_factory=dict[str, Any])
    per_cell: int = 0  # So many cells are computed anew at every step, where all of them are.


GRAPHS = (
    Graph("chain 1000", chain, {"length": 1000}, {"length": 12}, per_cell=1000),
    Graph("fan 1000", fan, {"width": 1000}, {"width": 7}, per_cell=1000),
    Graph("diamond 1000", diamond, {"width": 1000}, {"width": 7}, per_cell=1001),
    Graph("broad 50", broad, {"width": 50}, {"width": 5}, per_cell=100),
    Graph("deep 50", chain, {"length": 50}, {"length": 6}, per_cell=50),
    Graph("diamond 5", diamond, {"width": 5}, {"width": 3}, per_cell=6),
    Graph("triangle 10", triangle, {"width": 10}, {"width": 4}, per_cell=10),
    Graph("mux 100", mux, {"width": 100, "batch": 10}, {"width": 6, "batch": 2}),
    Graph("avoidable", avoidable, {"length": 4}, {"length": 4}),
    Graph("unstable", unstable),
    Graph("repeated 30", repeated, {"times": 30}, {"times": 5}, per_cell=1),
    Graph("10x5", layered, {"width": 10, "layers": 5, "inputs": 2}, {"width": 4, "layers": 3, "inputs": 2}),
    Graph(
        "10x10 dynamic",
        layered,
        {"width": 10, "layers": 10, "inputs": 6, "dynamic": 0.25},
        {"width": 5, "layers": 4, "inputs": 3, "dynamic": 0.5},
    ),
    Graph(
        "5x500 deep",
        layered,
        {"width": 5, "layers": 500, "inputs": 3},
        {"width": 3, "layers": 8, "inputs": 2},
    ),
    Graph(
        "100x15 dynamic",
        layered,
        {"width": 100, "layers": 15, "inputs": 6, "dynamic": 0.5},
        {"width": 6, "layers": 4, "inputs": 3, "dynamic": 0.5},
    ),
    Graph(
        "100x8 anywhere",
        layered,
        {"width": 100, "layers": 8, "inputs": 4, "spread": 0},
        {"width": 5, "layers": 3, "inputs": 2, "spread": 0},
    ),
    Graph(
        "1000x5 dense",
        layered,
        {"width": 1000, "layers": 5, "inputs": 25},
        {"width": 8, "layers": 3, "inputs": 5},
    ),
    Graph("1000x12", layered, {"width": 1000, "layers": 12, "inputs": 4}, {"width": 8, "layers": 4, "inputs": 2}),
    Graph(
        "1000x12 batch",
        layered,
        {"width": 1000, "layers": 12, "inputs": 4, "batch": 20},
        {"width": 8, "layers": 4, "inputs": 2, "batch": 3},
    ),
)
