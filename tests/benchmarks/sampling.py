"""Many curves at many times at once: `.at(array)` against `np.interp` on the same data."""

from collections.abc import Callable
from typing import Any

import numpy as np

from .clocks import alternate
from .reports import Section, Target, duration, ratio
from .runs import Run

__all__ = ["sampling"]

KEYS, TIMES = 10, 240


def sampling(run: Run) -> Section:
    """Linear keys sampled at 240 times, curve by curve, as somebody does who exports a film."""
    from reactive4d import keys

    count = 100 if run.quick else 1_000
    draw = np.random.default_rng(1)
    key_times = np.sort(draw.uniform(0.0, 10.0, (count, KEYS)), axis=1)
    key_values = draw.normal(size=(count, KEYS))
    curves: list[Any] = [
        keys(dict(zip(times.tolist(), values.tolist(), strict=True)))
        for times, values in zip(key_times, key_values, strict=True)
    ]
    # Every turn asks at other times, so that nothing is answered from memory; and one asks at the same again.
    same = np.linspace(0.0, 10.0, TIMES)
    wanted = np.interp(same, key_times[0], key_values[0])
    assert np.allclose(curves[0].at(same), wanted, rtol=0.0, atol=1e-12)
    next_turn = _turning(same)

    def ours(times: Any) -> None:
        for curve in curves:
            curve.at(times)

    def theirs(times: Any) -> None:
        for x, y in zip(key_times, key_values, strict=True):
            np.interp(times, x, y)

    def repeated(function: Callable[[Any], None], times: Callable[[], Any]) -> Callable[[int], None]:
        def run_it(repetitions: int) -> None:
            for _ in range(repetitions):
                function(times())

        return run_it

    timings = alternate(
        {
            "np.interp": repeated(theirs, next_turn),
            ".at(array), times never asked for before": repeated(ours, next_turn),
            ".at(array), the same times again": repeated(ours, lambda: same),
        },
        rounds=run.rounds,
        seconds=3 * run.seconds,
    )
    section = Section(
        "sampling",
        f"{count:,} linearly keyed curves of {KEYS} keys at {TIMES} times",
        ("what", "all curves", "one curve", "against np.interp"),
    )
    base = timings["np.interp"].median
    for name, timing in timings.items():
        section.rows.append(
            (name, duration(timing.median), duration(timing.median / count), ratio(timing.median / base))
        )
        section.figures[name] = timing.median
    fresh = timings[".at(array), times never asked for before"].median
    section.targets.append(Target(f"sampling {count:,} curves against np.interp", 3, fresh / base, "times"))
    return section


def _turning(times: Any) -> Callable[[], Any]:
    place = 0

    def next_turn() -> Any:
        nonlocal place
        place += 1
        return times + 1e-6 * place

    return next_turn
