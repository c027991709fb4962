"""Random worlds: a graph of every kind of cell, edits of it, and asks that compare the engine with the naive evaluator.

A world is driven by choices, so that Hypothesis (which shrinks them) and a seeded generator (which is quick) can both
drive it.
"""

import contextlib
import math
import random
from collections.abc import Callable, Sequence
from typing import Any, Protocol

import numpy as np
from models import (
    INF,
    Clock,
    LinearSource,
    StepSource,
    answer,
    make_engine,
    naive_answer,
    same_answer,
)

from reactive4d.engine import Affine, Axis, Cell, Computed, Fixed, Formula, Source, moment, narrow

__all__ = ["Choices", "MismatchError", "Seeded", "World", "fuzz", "revisit"]


class MismatchError(AssertionError):
    """The engine says something else than the naive evaluator, or than it promised."""


class RunawayError(BaseException):
    """A rule ran so often for one question that it will run for ever; no rule may catch it."""


class Choices(Protocol):
    """Where decisions come from."""

    def number(self, below: int) -> int:
        """A number from 0 up to, but not including, `below`."""
        ...


class Seeded:
    """Decisions from a seed."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)

    def number(self, below: int) -> int:
        return self.random.randrange(below)


GRID = [n / 2 for n in range(-4, 13)]
VALUES: list[Any] = [0.0, 1.0, 2.0, 3.0, -1.0, -0.0, 0.5, 7.0, math.nan]
PARAMETERS = [0.0, 1.0, 2.0, -1.0]
MAPS = [
    Affine(1.0, -1.0),
    Affine(1.0, 0.5),
    Affine(-1.0, 4.0),
    Affine(2.0, 0.0),
    Affine(2.0, -2.0),
    Affine(0.5, 1.0),
    Affine(-0.5, 2.0),
    Affine(0.1, 0.3),
    Affine(-3.0, 0.1),
    Affine(1.0, 0.1),
    Affine(1e-3, 1e3),
    Fixed(1.0),
    Fixed(-INF),
    Fixed(2.5),
    Fixed(INF),
]
BUDGETS = [0, 1_000, 4_000, 10_000, 1 << 30]


def number(value: Any) -> float:
    """Any answer as a float."""
    if isinstance(value, float):
        return value
    return float(sum(np.ravel(value).tolist()))


def _add(*values: Any) -> Any:
    return math.fsum(v for v in map(number, values) if math.isfinite(v))


def _first(*values: Any) -> Any:
    return values[0]


def _clamp(*values: Any) -> Any:
    return max(0.0, min(1.0, number(values[-1])))


def _sign(*values: Any) -> Any:
    return 1.0 if number(values[0]) > 1.0 else 0.0


def _vector(*values: Any) -> Any:
    return np.array([number(v) for v in values])


def _pair(*values: Any) -> Any:
    return tuple(number(v) for v in values)


def _picky(*values: Any) -> Any:
    total = number(values[0])
    if total > 2.0:
        raise ValueError(f"too large: {total}")
    return total


def _product(*values: Any) -> Any:
    return math.prod(number(v) for v in values[:2])


FUNCTIONS: list[Callable[..., Any]] = [_add, _first, _clamp, _sign, _vector, _pair, _picky, _product]


class World:
    """A graph, its history, and what may be done with it."""

    def __init__(self, choices: Choices, *, cells: int = 7, budget: int | None = None) -> None:
        self.choices = choices
        self.engine = make_engine(budget=self.pick(BUDGETS) if budget is None else budget)
        self.clock = Clock(engine=self.engine)
        self.a = Axis("a", 1.0, engine=self.engine)
        self.b = Axis("b", 0.0, engine=self.engine)
        self.steps = [StepSource(self.keys(), name=f"step{i}", engine=self.engine) for i in range(2)]
        self.lines = [LinearSource(self.keys(finite=True), name="line", engine=self.engine)]
        self.plain = [Source(self.pick(VALUES), name=f"plain{i}", engine=self.engine) for i in range(2)]
        self.switch = Source(0, name="switch", engine=self.engine)
        self.cells: list[Cell] = [*self.steps, *self.lines, *self.plain, self.a, self.b, self.clock]
        self.readable = list(self.cells)
        self.rules: list[Cell] = []
        self.contents: list[tuple[Source, Any]] = []
        self.logs = contextlib.ExitStack()
        self.limit = math.inf  # evaluations that one step may take
        self.spent = 0
        for i in range(2 + self.pick(range(cells))):
            cell = self.make(f"x{i}")
            self.rules.append(cell)
            self.readable.append(cell)

    # -- choices ---------------------------------------------------------------------------------------------------

    def pick(self, values: Sequence[Any]) -> Any:
        """One of some values."""
        return values[self.choices.number(len(values))]

    def chance(self, one_in: int) -> bool:
        """True once in so many times."""
        return self.choices.number(one_in) == one_in - 1

    def time(self) -> float:
        """A time on the grid, its neighbour, in between, or infinite."""
        t = self.pick(GRID)
        how = self.choices.number(8)
        if how == 4:
            return math.nextafter(t, INF)
        if how == 5:
            return math.nextafter(t, -INF)
        if how == 6:
            return t + self.pick([0.1, 0.25, 0.3])
        if how == 7:
            return self.pick([t, INF, -INF, 1e6, -1e-9])
        return t

    def value(self, *, finite: bool = False) -> Any:
        """A content's value."""
        value = self.pick(VALUES)
        return 4.0 if finite and not math.isfinite(value) else value

    def keys(self, *, finite: bool = False) -> Any:
        """Some keys."""
        times = {self.pick(GRID) for _ in range(1 + self.choices.number(4))}
        return tuple((t, self.value(finite=finite)) for t in sorted(times))

    def parameters(self) -> dict[str, Any]:
        """Some parameter values."""
        how = self.choices.number(4)
        given = {"a": self.pick(PARAMETERS)} if how & 1 else {}
        return {**given, "b": self.pick(PARAMETERS)} if how & 2 else given

    # -- cells -----------------------------------------------------------------------------------------------------

    def make(self, name: str, *, mine: bool = True) -> Cell:
        """A formula or an opaque rule over what there is; only the world's own ones may read their past."""
        recent = [*self.readable, *self.rules, *self.rules]
        inputs = [self.pick(recent) for _ in range(1 + self.choices.number(3))]
        how = self.choices.number(5)
        if how == 0:
            return Formula(self.counted(self.pick(FUNCTIONS)), *inputs, name=name, engine=self.engine)
        if how == 1:
            maps = tuple(self.pick(MAPS) if self.chance(2) else None for _ in inputs)
            return Formula(self.counted(self.pick(FUNCTIONS)), *inputs, maps=maps, name=name, engine=self.engine)
        return Computed(self.counted(self.rule(inputs, recent, past=mine)), name=name, engine=self.engine)

    def counted(self, function: Callable[..., Any]) -> Callable[..., Any]:
        """The same function, which gives up where an engine runs it for ever."""

        def run(*values: Any) -> Any:
            self.spent += 1
            if self.spent > self.limit:
                raise RunawayError
            return function(*values)

        return run

    def read(self, cell: Cell) -> Callable[[], Any]:
        """One way of reading a cell."""
        how = self.choices.number(10)
        if how == 0:
            time_map = self.pick(MAPS)
            return lambda: cell.through(time_map)
        if how == 1:
            t = self.pick([*GRID, INF, -INF])
            return lambda: cell.at(t)
        if how == 2:
            t, given = self.pick(GRID), self.parameters()
            return lambda: cell.at(t, **given)
        if how == 3 and isinstance(cell, StepSource):
            return lambda: self._noted(cell)
        if how == 4:
            given = self.parameters()
            return lambda: self._at_moment(cell, given)
        return cell.now

    @staticmethod
    def _at_moment(cell: Cell, given: dict[str, Any]) -> Any:
        t = moment()
        narrow(t, math.nextafter(t, INF))
        return cell.at(t, **given)

    @staticmethod
    def _noted(cell: StepSource) -> Any:
        keys = cell.note()
        t = moment()
        times = [key for key, _ in keys]
        before = [key for key in times[1:] if key <= t]
        after = [key for key in times[1:] if key > t]
        narrow(before[-1] if before else -INF, after[0] if after else INF)
        return dict(keys)[before[-1] if before else times[0]]

    def rule(self, inputs: list[Cell], recent: list[Cell], *, past: bool) -> Callable[[], Any]:
        """An opaque rule."""
        reads = [self.read(cell) for cell in inputs]
        function = self.pick(FUNCTIONS)
        how = self.choices.number(8)
        if how == 0:
            return self._choice(reads[0], self.read(self.pick(recent)), self.read(self.pick(recent)))
        if how == 1:
            others = [self.read(self.pick(recent)) for _ in range(3)]
            return lambda: others[int(self.switch.now()) % 3]()
        if how == 2:
            return self._patient(reads, function)
        if how == 3:
            return self._pieces(reads[0], self.read(self.pick(recent)), self.pick(GRID))
        if how == 4:
            return self._twice(reads[0], inputs[0])
        if how == 5 and past:
            return self._past(reads[0], self.pick([0.5, 1.0, 1.5]))
        if how == 6:
            return self._wandering(reads[0], inputs[-1])
        return lambda: function(*[read() for read in reads])

    @staticmethod
    def _choice(condition: Callable[[], Any], this: Callable[[], Any], that: Callable[[], Any]) -> Callable[[], Any]:
        return lambda: this() if number(condition()) > 0.5 else that()

    @staticmethod
    def _patient(reads: list[Callable[[], Any]], function: Callable[..., Any]) -> Callable[[], Any]:
        def patient() -> Any:
            values: list[Any] = []
            for read in reads:
                try:
                    values.append(read())
                except ValueError:
                    values.append(-9.0)
            return function(*values)

        return patient

    @staticmethod
    def _pieces(before: Callable[[], Any], after: Callable[[], Any], border: float) -> Callable[[], Any]:
        def pieces() -> Any:
            if moment() < border:
                narrow(-INF, border)
                return before()
            narrow(border, INF)
            return after()

        return pieces

    @staticmethod
    def _twice(read: Callable[[], Any], cell: Cell) -> Callable[[], Any]:
        return lambda: number(read()) + number(cell.now()) + number(cell.now())

    def _past(self, read: Callable[[], Any], step: float) -> Callable[[], Any]:
        """The sum of what was, from the start, in steps: reads itself at an earlier time."""
        me: list[Cell] = []
        index = len(self.rules)

        def past() -> Any:
            t = moment()
            if t < 0.0:
                narrow(-INF, 0.0)
                return 0.0
            if t >= 4.0:
                narrow(4.0, INF)
                return read()
            narrow(0.0, 4.0)
            if not me:
                me.append(self.rules[index])
            return number(read()) + number(me[0].through(Affine(1.0, -step)))

        return past

    def _wandering(self, where: Callable[[], Any], cell: Cell) -> Callable[[], Any]:
        """Reads at a time that another answer tells."""

        def wandering() -> Any:
            t = number(where())
            return cell.at(t if math.isfinite(t) else 0.0)

        return wandering

    # -- what happens ----------------------------------------------------------------------------------------------

    def edit(self) -> str:
        """Set something; returns what was done."""
        how = self.choices.number(6)
        source: Any
        if how == 0:
            source = self.pick(self.plain)
            content: Any = self.value()
        elif how == 1:
            source, content = self.switch, self.choices.number(3)
        elif how == 2 and self.contents:
            source, content = self.pick(self.contents[-6:])
        else:
            source = self.pick([*self.steps, *self.lines])
            content = self.moved_keys(source)
        self.contents.append((source, source.content))
        source.set_content(content)
        return f"{source.name} = {content}"

    def moved_keys(self, source: Any) -> Any:
        """The keys of a source with one set, inserted, moved or deleted; or all others."""
        finite = isinstance(source, LinearSource)
        keys = dict(source.content)
        how = self.choices.number(4)
        if how == 0:
            keys[self.pick(GRID)] = self.value(finite=finite)
        elif how == 1 and len(keys) > 1:
            del keys[self.pick(sorted(keys))]
        elif how == 2:
            keys[self.pick(GRID)] = keys.pop(self.pick(sorted(keys)))
        elif how == 3 and self.chance(3):
            return self.keys(finite=finite)
        else:
            keys[self.pick(sorted(keys))] = self.value(finite=finite)
        return tuple(sorted(keys.items()))

    def ask(self, cell: Cell | None = None, *, intervals: bool = True) -> str:
        """Ask somewhere; raises `MismatchError` if the answer, or the interval that it claims, is wrong."""
        cell = self.pick(self.rules) if cell is None else cell
        t, given = self.time(), self.parameters()
        self.compare(cell, t, given)
        if intervals:
            self.compare_interval(cell, t, given)
        return f"{cell.name} at {t!r} {given}"

    def compare(self, cell: Cell, t: float, given: dict[str, Any]) -> None:
        """Cached and uncached must say the same."""
        got, expected = answer(cell, t, **given), naive_answer(cell, t, **given)
        if not same_answer(got, expected):
            raise MismatchError(f"{cell.name} at {t!r} {given}: got {got}, expected {expected}")

    def compare_interval(self, cell: Cell, t: float, given: dict[str, Any]) -> None:
        """Wherever an answer is said to hold, it is the naive answer."""
        interval = cell.valid(t, **given)
        lo, hi = interval.start, interval.stop
        if not (lo <= t < hi or t == hi == INF):
            raise MismatchError(f"{cell.name} at {t!r}: said to hold over {interval}")
        expected = naive_answer(cell, t, **given)
        inner = [s for s in GRID if lo < s < hi]
        samples = [lo, INF if hi == INF else math.nextafter(hi, -INF)]
        # Drawn always: the interval depends on what was evicted, and that on how long things took.
        first, second = self.choices.number(64), self.choices.number(64)
        if inner:
            samples += [inner[first % len(inner)], inner[second % len(inner)] + 0.25]
        for s in samples:
            if lo <= s < hi:
                found = naive_answer(cell, s, **given)
                if not same_answer(found, expected):
                    said = f"{expected} over {interval}"
                    raise MismatchError(f"{cell.name} at {t!r} {given} is {said}, but {found} at {s!r}")

    def transact(self, depth: int = 0) -> str:
        """Several edits and asks at once, which may fail half-way."""
        done: list[str] = []
        try:
            with self.engine.transaction():
                for _ in range(1 + self.choices.number(3)):
                    how = self.choices.number(5)
                    if how == 4 and depth < 2:
                        done.append(self.transact(depth + 1))
                    elif how == 3:
                        done.append(self.ask())
                    else:
                        done.append(self.edit())
                if self.chance(3):
                    raise ZeroDivisionError
        except ZeroDivisionError:
            done.append("failed")
        return f"transaction({', '.join(done)})"

    def pass_by(self) -> str:
        """A cell that nobody holds: it is asked, and gone."""
        cell = self.make("passing", mine=False)
        self.compare(cell, self.time(), self.parameters())
        return "a cell came and went"

    def rebudget(self) -> str:
        """Another budget."""
        self.engine.budget = self.pick(BUDGETS)
        return f"budget = {self.engine.budget}"

    def forget(self) -> str:
        """Forget some answers."""
        cell = self.pick(self.rules)
        self.engine.forget([cell])
        return f"forget {cell.name}"

    def step(self) -> str:
        """Anything."""
        self.spent = 0
        how = self.choices.number(20)
        if how < 11:
            return self.ask()
        if how < 17:
            return self.edit()
        if how == 17:
            return self.transact()
        if how == 18:
            return self.pass_by()
        return self.rebudget() if self.chance(2) else self.forget()

    def check(self) -> None:
        """The engine's own invariants."""
        self.engine.check(self.cells + self.rules)


def fuzz(
    seeds: Sequence[int],
    *,
    steps: int = 40,
    check: bool = True,
    cells: int = 7,
    prepare: Callable[[World], None] | None = None,
) -> None:
    """Worlds from seeds, each for some steps; raises what the first mismatch raises, with its seed."""
    for seed in seeds:
        world = World(Seeded(seed), cells=cells)
        if prepare is not None:
            prepare(world)
        done: list[str] = []
        try:
            for _ in range(steps):
                done.append(world.step())
                if check:
                    world.check()
        except Exception as error:
            error.add_note(f"seed {seed}, after {done}")
            raise
        except RunawayError:
            raise MismatchError(f"seed {seed}, after {done}: a rule is run for ever") from None
        finally:
            world.logs.close()


def revisit(seeds: Sequence[int], *, steps: int = 40) -> None:
    """
    Few contents that come back over and over, asked at few times: what was remembered several edits ago holds again.

        s --> f --> g        s --1 s later--> h
    """
    for seed in seeds:
        draw = random.Random(seed)
        engine = make_engine()
        contents = [tuple((t, float(draw.randrange(3))) for t in (0.0, 1.0, 2.0, 3.0)) for _ in range(3)]
        contents.append(((0.0, 1.0),))
        s = StepSource(contents[0], name="s", engine=engine)
        f = Formula(_first, s, name="f")
        g = Computed(lambda f=f: _clamp(f.now()), name="g", engine=engine)
        h = Formula(_add, s, g, maps=(Affine(1.0, -1.0), None), name="h")
        for step in range(steps):
            if draw.random() < 0.35:
                s.set_content(draw.choice(contents))
            cell, t = draw.choice([f, g, h]), draw.choice([0.5, 1.5, 2.5, 3.5])
            got, expected = answer(cell, t), naive_answer(cell, t)
            if not same_answer(got, expected):
                raise MismatchError(f"seed {seed}, step {step}: {cell.name} at {t}: got {got}, expected {expected}")
            engine.check([f, g, h])
