"""What it costs to ask for what is remembered, counted in calls of an empty Python method."""

import threading
from collections.abc import Callable, Generator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from typing import Any

from reactive4d.engine import Axis, Computed, Engine, Formula, Source

from .clocks import UNROLLED, Timing, alternate, empty_call, per_call
from .contenders import contenders
from .operations import INCREMENT
from .ours import new_engine
from .reports import Section, Target, duration
from .runs import Run
from .timelines import Track

__all__ = ["asking"]

ANSWERS = 240


def asking(run: Run) -> Section:
    """A cached ask in every situation that the targets name, and the peers' cached read."""
    section = Section(
        "asking",
        "A cached ask, in calls of an empty method of the same run",
        ("what is asked", "calls", "time", "at most"),
    )
    engine = new_engine()
    for title, limit, around, statement, names in _situations(engine):

        def measure(statement: str = statement, names: dict[str, Any] = names) -> dict[str, Timing]:
            runs = {"empty": empty_call(), "ask": per_call(statement, names)}
            return alternate(runs, rounds=run.rounds, seconds=run.seconds / 2)

        with around:
            times = measure() if limit else _within_a_rule(engine, measure)
        calls = times["ask"].median / times["empty"].median
        section.rows.append(
            (title, f"{calls:.1f}", duration(times["ask"].median / UNROLLED), f"{limit:g}" if limit else "")
        )
        section.figures[title] = calls
        if limit:
            section.targets.append(Target(f"ask: {title}", limit, calls, "calls"))
    for library in contenders():
        if library.name in ("ours", "declared", "effects"):
            continue
        one = library()
        cell = one.cell(INCREMENT, one.source(1.0))
        names = {"read": one.viewer(cell), "empty": None}
        times = alternate(
            {"empty": empty_call(), "ask": per_call("read()", names)}, rounds=run.rounds, seconds=run.seconds / 2
        )
        calls = times["ask"].median / times["empty"].median
        section.rows.append((f"peer: {library.title}", f"{calls:.1f}", duration(times["ask"].median / UNROLLED), ""))
        section.figures[f"peer: {library.name}"] = calls
    section.notes.append(
        "The targets: 4 calls for a float at default parameters with nothing evaluating and no log open, 12 with "
        "parameters, 8 otherwise. Answers by turns of a cell that has many are held against 8, since the one that is "
        "published is never the one asked for."
    )
    return section


Situation = tuple[str, float, AbstractContextManager[object], str, dict[str, Any]]


def _situations(engine: Engine) -> list[Situation]:
    source = Source(1.0, engine=engine)
    cell = Computed(lambda: source.now() + 1.0, engine=engine)
    formula = Formula(lambda a: a + 1.0, source, engine=engine)
    width = Axis("width", 1.0, engine=engine)
    wide = Computed(lambda: source.now() * width.now(), engine=engine)
    track = Track(
        (tuple(map(float, range(ANSWERS + 1))), tuple(float(i * i) for i in range(ANSWERS + 1))), engine=engine
    )
    moving = Computed(lambda: track.now() + 1.0, engine=engine)
    plain = {"c": cell, "t": 2.0}
    for each in (cell, formula, wide, moving, source):
        each.at(2.0)
    for value in (3.0, 4.0):
        wide.at(2.0, width=value)
    times = {f"t{i}": float(i * 4) for i in range(UNROLLED)}
    for frame in range(ANSWERS):
        moving.at(float(frame))
    moving.at(2.0)
    widths = {"t": 2.0, **{f"w{i}": 3.0 + i % 2 for i in range(UNROLLED)}}
    members = [Computed(lambda: source.now() + 2.0, engine=engine) for _ in range(UNROLLED)]
    reads: dict[str, Any] = {f"r{i}": member.now for i, member in enumerate(members)}
    reads["members"] = members
    for member in members:
        member.at(2.0)
    return [
        ("opaque rule", 4, nullcontext(), "c.at(t)", plain),
        ("declared inputs", 4, nullcontext(), "c.at(t)", {"c": formula, "t": 2.0}),
        ("source", 4, nullcontext(), "c.at(t)", {"c": source, "t": 2.0}),
        ("reads a parameter, asked at its default", 4, nullcontext(), "c.at(t)", {"c": wide, "t": 2.0}),
        (f"one of {ANSWERS} answers, the same again", 4, nullcontext(), "c.at(t)", {"c": moving, "t": 2.0}),
        (f"one of {ANSWERS} answers, by turns", 8, nullcontext(), "c.at(t#)", {"c": moving, **times}),
        ("at a time that is an int", 8, nullcontext(), "c.at(t)", {"c": cell, "t": 2}),
        ("while another thread evaluates", 8, _evaluating(engine), "c.at(t)", plain),
        ("a log is open", 8, engine.log(), "c.at(t)", plain),
        ("inside of one's own transaction", 8, engine.transaction(), "c.at(t)", plain),
        ("a parameter that it does not read", 12, nullcontext(), "c.at(t, width=3.0)", plain),
        ("a parameter that it reads", 12, nullcontext(), "c.at(t, width=3.0)", {"c": wide, "t": 2.0}),
        (
            "a parameter that it reads, two values by turns",
            12,
            nullcontext(),
            "c.at(t, width=w#)",
            {"c": wide, **widths},
        ),
        ("`now()` inside of a rule", 0, nullcontext(), "r#()", reads),
    ]


@contextmanager
def _evaluating(engine: Engine) -> Generator[None]:
    """Another thread is inside of a rule, which waits without using the processor."""
    begun, end = threading.Event(), threading.Event()

    def rule() -> float:
        begun.set()
        end.wait()
        return 1.0

    slow = Computed(rule, engine=engine)
    thread = threading.Thread(target=slow.at, args=(2.0,))
    thread.start()
    begun.wait()
    try:
        yield
    finally:
        end.set()
        thread.join()


def _within_a_rule(engine: Engine, measure: Callable[[], dict[str, Timing]]) -> dict[str, Timing]:
    outer = Computed(measure, engine=engine)
    return outer.at(2.0)
