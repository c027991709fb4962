"""Timing by turns: every contender runs a little, again and again, so that a busy machine disturbs all alike.

It is the processor's time of this process that counts: what others do on the machine meanwhile is not in it.
"""

import gc
import statistics
import timeit
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from time import process_time

__all__ = ["UNROLLED", "Timing", "alternate", "empty_call", "per_call", "stopwatch"]

UNROLLED = 50  # So often a statement is written out, so that no loop is counted.


@dataclass(frozen=True)
class Timing:
    """Seconds of processor for one repetition: the median of the rounds and the least of them."""

    median: float
    least: float
    repetitions: int


def alternate(
    runs: Mapping[str, Callable[[int], object]], *, rounds: int, seconds: float, warm_up: int = 2
) -> dict[str, Timing]:
    """Time every run by turns, and say for each what one repetition takes.

    Args:
        runs: a function of the number of repetitions, by name.
        rounds: how often each has its turn; the order turns round every time.
        seconds: about how long one turn may take; what is slower has one repetition a turn.
        warm_up: repetitions before anything counts.

    What was built before is moved out of the collector's sight, so that nobody pays for the graphs of the others;
    the collector stays on, so that everybody pays for their own litter.
    """
    repetitions = {}
    for name, run in runs.items():
        run(warm_up)
        once = stopwatch(lambda run=run: run(1))
        trial = max(1, min(10_000, int(seconds / 10 / max(once, 1e-9))))
        each = stopwatch(lambda run=run, trial=trial: run(trial)) / trial
        repetitions[name] = max(1, min(1_000_000, int(seconds / max(each, 1e-9))))
    gc.collect()
    gc.freeze()
    taken: dict[str, list[float]] = {name: [] for name in runs}
    try:
        for turn in range(rounds):
            names = list(runs) if turn % 2 == 0 else list(runs)[::-1]
            for name in names:
                gc.collect()
                run, count = runs[name], repetitions[name]
                start = process_time()
                run(count)
                taken[name].append((process_time() - start) / count)
    finally:
        gc.unfreeze()
    return {name: Timing(statistics.median(all_), min(all_), repetitions[name]) for name, all_ in taken.items()}


def stopwatch(function: Callable[[], object]) -> float:
    """Seconds of processor that one call takes."""
    start = process_time()
    function()
    return process_time() - start


def per_call(statement: str, names: Mapping[str, object]) -> Callable[[int], object]:
    """A run for `alternate` whose repetition is the statement `UNROLLED` times; `#` in it is the place, from 0."""
    written_out = ";".join([statement.replace("#", str(index)) for index in range(UNROLLED)])
    return timeit.Timer(written_out, globals=dict(names)).timeit


class Empty:
    """Has the yardstick: a Python method that does nothing."""

    __slots__ = ()

    def method(self) -> None: ...


def empty_call() -> Callable[[int], object]:
    """The yardstick as a run: calls of an empty Python method."""
    return per_call("o.method()", {"o": Empty()})
