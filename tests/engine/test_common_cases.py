"""Cached ≡ uncached where the engine takes the short way: wide and narrow cells over sources, asked at one time."""

import random
from collections.abc import Callable
from typing import Any

import pytest

from reactive4d.arrays import freeze, measure, same
from reactive4d.engine import Axis, Cell, Computed, Engine, Formula, Source

STEPS = 40
SEEDS = 400
VALUES = [0.0, -0.0, 1.0, 2.0, 3.0, float("nan"), 41.0, 87.0]
INPUTS = [1, 1, 1, 2, 2, 3, 4, 6, 9]


def number(value: Any) -> float:
    """Any of these graphs' answers as a number."""
    return value if isinstance(value, float) else float(sum(value))


FUNCTIONS: list[Callable[..., Any]] = [
    lambda *values: sum(map(number, values)),
    lambda *values: number(values[0]),
    lambda *values: max(-2.0, min(2.0, sum(map(number, values)))),
    lambda *values: 0.0 * number(values[-1]),
    lambda *values: tuple(map(number, values)),
    lambda *values: 1.0 / number(values[0]),
]


def choosing(function: Callable[..., Any], inputs: list[Cell]) -> Callable[[], Any]:
    """A rule whose first answer says what else is read, and in which order it counts."""

    def rule() -> Any:
        head = number(inputs[0].now())
        tail = inputs[1:] or inputs
        one = tail[int(head) % len(tail) if abs(head) < 1e9 else 0]
        try:
            value = number(one.now())
        except ZeroDivisionError:
            value = -1.0
        return function(head, value) if head > 0.0 else function(value, head)

    return rule


class Graph:
    """Cells over a few sources and perhaps a parameter, most of them over what was made just before."""

    def __init__(self, draw: random.Random) -> None:
        self.draw = draw
        self.engine = Engine(same=same, measure=measure, freeze=freeze, budget=draw.choice([1 << 30, 4000]))
        self.sources = [Source(draw.choice(VALUES), engine=self.engine) for _ in range(1 + draw.randrange(4))]
        self.cells: list[Cell] = []
        parameters = [Axis("w", 1.0, engine=self.engine)] if draw.random() < 0.3 else []
        self.has_parameter = bool(parameters)
        readable: list[Cell] = [*self.sources, *parameters]
        for i in range(3 + draw.randrange(15)):
            inputs = [draw.choice(readable[-8:]) for _ in range(draw.choice(INPUTS))]
            self.cells.append(self.made(f"x{i}", inputs))
            readable.append(self.cells[-1])

    def made(self, name: str, inputs: list[Cell]) -> Cell:
        """A formula, a rule that reads everything, or one that reads now this and now that."""
        function, how = self.draw.choice(FUNCTIONS), self.draw.random()
        if how < 0.45:
            return Formula(function, *inputs, name=name, engine=self.engine)
        if how < 0.75:
            return Computed(lambda: function(*[x.now() for x in inputs]), name=name, engine=self.engine)
        return Computed(choosing(function, inputs), name=name, engine=self.engine)

    def edit(self) -> None:
        """Set a source; or several in a transaction, which may fail; or forget a cell's answers."""
        how = self.draw.random()
        if how < 0.75:
            self.draw.choice(self.sources).set_content(self.draw.choice(VALUES))
        elif how < 0.8:
            self.engine.forget([self.draw.choice(self.cells)])
        else:
            try:
                with self.engine.transaction():
                    for _ in range(3):
                        self.draw.choice(self.sources).set_content(self.draw.choice(VALUES))
                        self.look(self.draw.choice(self.cells))
                    if self.draw.random() < 0.4:
                        raise KeyError
            except KeyError:
                pass

    def look(self, cell: Cell) -> None:
        """The remembered answer, or the error, is the naive one."""
        given = {"w": float(self.draw.randrange(3))} if self.has_parameter and self.draw.random() < 0.3 else {}
        if self.draw.random() < 0.1:
            with self.engine.log():
                found = outcome(lambda: cell.at(0.0, **given))
        else:
            found = outcome(lambda: cell.at(0.0, **given))
        wanted = outcome(lambda: self.engine.naive(cell, 0.0, **given))
        assert same(found, wanted), f"{cell.name}: {found!r}, naively {wanted!r}"


def outcome(ask: Callable[[], Any]) -> Any:
    """The answer, or what is said about why there is none."""
    try:
        return ask()
    except ArithmeticError as error:
        return type(error).__name__, str(error)


@pytest.mark.parametrize("part", range(4))
def test_the_short_way_answers_as_the_naive_one_does(part: int) -> None:
    """Whatever was edited, forgotten, undone or listened to in between; and the invariants hold after every step."""
    for seed in range(part * SEEDS // 4, (part + 1) * SEEDS // 4):
        draw = random.Random(seed)
        graph = Graph(draw)
        for _ in range(STEPS):
            graph.edit()
            for cell in draw.sample(graph.cells, min(len(graph.cells), draw.randrange(4))):
                graph.look(cell)
            graph.engine.check(graph.cells)
