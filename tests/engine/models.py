"""Small test doubles for the engine: sources with keys, a clock, and readers of its log."""

import math
import threading
from bisect import bisect_right
from collections.abc import Callable
from typing import Any

from reactive4d import arrays
from reactive4d.engine import Cell, Computed, Engine, Event, Formula, Source

__all__ = [
    "INF",
    "Background",
    "Case",
    "Clock",
    "Counted",
    "Gate",
    "LinearSource",
    "StepSource",
    "answer",
    "evaluated",
    "make_engine",
    "marked",
    "naive_answer",
    "outcome",
    "same_answer",
    "told",
]

INF = math.inf

Keys = tuple[tuple[float, Any], ...]


def make_engine(**options: Any) -> Engine:
    """An engine of its own, with the product's idea of what is equal and how large it is."""
    return Engine(same=arrays.same, measure=arrays.measure, freeze=arrays.freeze, **options)


class Clock(Source):
    """The time: another answer at every instant, and never edited."""

    unchanging = True

    def __init__(self, *, name: str = "time", engine: Engine) -> None:
        super().__init__(None, name=name, engine=engine)

    def sample(self, t: float) -> tuple[float, float, Any]:
        return t, math.nextafter(t, INF), t


class KeySource(Source):
    """Keys in time, sorted; the first one holds before itself."""

    content: Keys

    def move(self, old: float, new: float) -> None:
        """Give the key at `old` another time; a key that stands there already goes."""
        keys = dict(self.content)
        value = keys.pop(old)
        self.set_content(tuple(sorted({**keys, new: value}.items())))

    def put(self, t: float, value: Any) -> None:
        """Insert a key, or give the one at `t` another value."""
        self.set_content(tuple(sorted({**dict(self.content), t: value}.items())))

    def drop(self, t: float) -> None:
        """Delete the key at `t`."""
        self.set_content(tuple(key for key in self.content if key[0] != t))


def _span(keys: Keys, t: float) -> tuple[float, float, int]:
    i = bisect_right([key for key, _ in keys], t) - 1
    lo = keys[i][0] if i > 0 else -INF
    hi = keys[i + 1][0] if i + 1 < len(keys) else INF
    return lo, hi, max(i, 0)


class StepSource(KeySource):
    """Each key holds up to the next one."""

    def sample(self, t: float) -> tuple[float, float, Any]:
        lo, hi, i = _span(self.content, t)
        return lo, hi, self.content[i][1]

    def difference(self, old: Any, new: Any) -> list[tuple[float, float]]:
        same = self.engine.same
        borders = sorted({-INF, *(t for t, _ in old), *(t for t, _ in new)})
        spans: list[tuple[float, float]] = []
        for lo, hi in zip(borders, [*borders[1:], INF], strict=True):
            if not same(old[_span(old, lo)[2]][1], new[_span(new, lo)[2]][1]):
                if spans and spans[-1][1] == lo:
                    spans[-1] = (spans[-1][0], hi)
                else:
                    spans.append((lo, hi))
        return spans


class LinearSource(KeySource):
    """Moves straight from key to key; holds before the first and after the last one, and between equal neighbours."""

    def sample(self, t: float) -> tuple[float, float, Any]:
        keys = self.content
        if t < keys[0][0]:
            return -INF, keys[0][0], keys[0][1]
        if t >= keys[-1][0]:
            return keys[-1][0], INF, keys[-1][1]
        i = bisect_right([key for key, _ in keys], t) - 1
        (a, x), (b, y) = keys[i], keys[i + 1]
        if self.engine.same(x, y):
            return a, b, x
        return t, math.nextafter(t, INF), x + (y - x) * ((t - a) / (b - a))

    def difference(self, old: Any, new: Any) -> list[tuple[float, float]]:
        """From the last key that both have before the first difference, to the first that both have after the last."""
        if len(old) == len(new) and all(
            s == t and self.engine.same(x, y) for (s, x), (t, y) in zip(old, new, strict=True)
        ):
            return []
        head = 0
        while head < min(len(old), len(new)) and self._equal(old[head], new[head]):
            head += 1
        tail = 0
        while tail < min(len(old), len(new)) - head and self._equal(old[-1 - tail], new[-1 - tail]):
            tail += 1
        lo = old[head - 1][0] if head else -INF
        hi = old[len(old) - tail][0] if tail else INF
        return [(lo, hi)]

    def _equal(self, a: tuple[float, Any], b: tuple[float, Any]) -> bool:
        return a[0] == b[0] and self.engine.same(a[1], b[1])


class Counted:
    """A function that counts how often it runs."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self.function = function
        self.count = 0

    def __call__(self, *values: Any) -> Any:
        self.count += 1
        return self.function(*values)

    def taken(self) -> int:
        """How often it ran since this was asked last."""
        count, self.count = self.count, 0
        return count


Answer = tuple[str, Any]


def outcome(ask: Callable[[], Any]) -> Answer:
    """What an ask comes to: ("value", answer), or ("error", (type, message))."""
    try:
        return "value", ask()
    except Exception as error:  # noqa: BLE001  errors are answers
        return "error", (type(error), str(error))


def answer(cell: Cell, t: float, **parameters: Any) -> Answer:
    """What the engine says."""
    return outcome(lambda: cell.at(t, **parameters))


def naive_answer(cell: Cell, t: float, **parameters: Any) -> Answer:
    """What the evaluator says that remembers nothing."""
    return outcome(lambda: cell.engine.naive(cell, t, **parameters))


def same_answer(a: Answer, b: Answer) -> bool:
    """Bit for bit; errors by type and message."""
    return a[0] == b[0] and (arrays.same(a[1], b[1]) if a[0] == "value" else a[1] == b[1])


def told(log: list[Event], *kinds: str) -> list[str]:
    """What was done, as "marked x [1, 3)", of these kinds, or of all; the log is emptied."""
    lines = [str(event) for event in log if not kinds or event.kind in kinds]
    log.clear()
    return lines


def marked(log: list[Event]) -> list[str]:
    """What was marked, sorted, as "x [1, 3)"; the log is emptied."""
    return sorted(line.removeprefix("marked ") for line in told(log, "marked"))


def evaluated(log: list[Event]) -> list[str]:
    """The names of what was evaluated, in order; the log is emptied."""
    names = [event.name for event in log if event.kind == "evaluated"]
    log.clear()
    return names


class Case:
    """A small graph under test, asked through one of the two evaluators."""

    def __init__(self, *, remembers: bool = True, **options: Any) -> None:
        self.remembers = remembers
        self.engine = make_engine(**options)
        self.counters: dict[Cell, Counted] = {}

    def ask(self, cell: Cell, t: float = 0.0, **parameters: Any) -> Any:
        """The answer, by the evaluator of this case."""
        return cell.at(t, **parameters) if self.remembers else self.engine.naive(cell, t, **parameters)

    def source(self, content: Any, name: str = "s") -> Source:
        """A constant that can be set."""
        return Source(content, name=name, engine=self.engine)

    def steps(self, keys: dict[float, Any], name: str = "s") -> StepSource:
        """Step keys."""
        return StepSource(tuple(sorted(keys.items())), name=name, engine=self.engine)

    def formula(self, name: str, function: Callable[..., Any], *inputs: Cell, **options: Any) -> Formula:
        """A counted formula."""
        counter = Counted(function)
        cell = Formula(counter, *inputs, name=name, engine=self.engine, **options)
        self.counters[cell] = counter
        return cell

    def rule(self, name: str, rule: Callable[[], Any]) -> Computed:
        """A counted opaque rule."""
        counter = Counted(rule)
        cell = Computed(counter, name=name, engine=self.engine)
        self.counters[cell] = counter
        return cell

    def ran(self) -> dict[str, int]:
        """How often each rule ran since this was asked last, without those that did not."""
        counts = {cell.name: counter.taken() for cell, counter in self.counters.items()}
        return {name: count for name, count in counts.items() if count}

    def expect(self, **counts: int) -> None:
        """Assert how often each rule ran: exactly so where answers are remembered, at least so where they are not."""
        ran = self.ran()
        if self.remembers:
            assert ran == {name: count for name, count in counts.items() if count}
            self.engine.check(self.counters)
        else:
            assert all(ran.get(name, 0) >= count for name, count in counts.items())


PATIENCE = 60.0  # seconds after which a thread is taken to wait for ever


class Background:
    """Something that runs on a thread of its own."""

    def __init__(self, work: Callable[[], Any]) -> None:
        self.work = work
        self.value: Any = None
        self.error: BaseException | None = None
        self.thread = threading.Thread(target=self._run, daemon=True)
        self.thread.start()

    def _run(self) -> None:
        try:
            self.value = self.work()
        except BaseException as error:  # noqa: BLE001  raised again by `result`
            self.error = error

    @property
    def done(self) -> bool:
        """Whether it has ended."""
        return not self.thread.is_alive()

    def result(self) -> Any:
        """What came of it; fails if it does not end."""
        self.thread.join(PATIENCE)
        assert self.done, "a thread waits for ever"
        if self.error is not None:
            raise self.error
        return self.value

    def wait_until(self, condition: Callable[[], Any]) -> None:
        """Wait for a condition that this thread, still at work, will bring about."""
        for _ in range(int(PATIENCE * 1000)):
            if condition():
                return
            assert not self.done, f"ended before: {self.error or self.value!r}"
            self.thread.join(0.001)
        raise AssertionError("the condition never came")


class Gate:
    """A place in a rule where a thread stops until it is let through."""

    def __init__(self) -> None:
        self.reached = threading.Event()
        self.opened = threading.Event()

    def pass_through(self) -> None:
        """Say that one is here, and wait."""
        self.reached.set()
        assert self.opened.wait(PATIENCE), "the gate was never opened"

    def wait(self) -> None:
        """Wait until somebody stands at the gate."""
        assert self.reached.wait(PATIENCE), "nobody came to the gate"

    def open(self) -> None:
        """Let everybody through, now and later."""
        self.opened.set()
