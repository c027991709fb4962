"""Sweeps: what a grid of points costs against the least that it could, by itself and shared out to two processes."""

from collections.abc import Callable
from time import process_time
from typing import Any

import numpy as np

import reactive4d as r4
from reactive4d.engine import engine

from .reports import Section, Target, duration, ratio
from .runs import Run

__all__ = ["bored", "chain", "plainly", "sweeping"]

CELLS, VALUES, TIMES = 10, 32, 501


def sweeping(run: Run) -> Section:
    """All that is asked of sweeps."""
    r4.sweep(r4.Scene(), over={"time": [0.0]}, measure={"m": r4.time}, progress=False)  # xarray is imported
    section = Section("sweeps", f"Sweeps of {VALUES} × {TIMES} points", ("what", "measured", "against", "ratio"))
    for part in (_last_cell, _machinery, _workers):
        part(run, section)
        engine.forget()
    return section


# -- one parameter, read at the end only -------------------------------------------------------------------------------


def _work(rounds: int) -> Callable[..., float]:
    """A function of numbers that takes a while."""

    def work(x: float, y: float = 0.0) -> float:
        for _ in range(rounds):
            x = 0.999 * x + 0.001
        return x + y

    return work


def chain(work: Callable[..., float]) -> Any:
    """Ten cells, each of which reads the one before, and the last a parameter as well."""
    lifted = r4.lift(work)
    cell = lifted(r4.time)
    for _ in range(CELLS - 2):
        cell = lifted(cell)
    return lifted(cell, r4.Parameter("bench_gain", 1.0))


def plainly(work: Callable[..., float], gains: list[float], times: list[float]) -> list[list[float]]:
    """One run of the ten, and the last one again for every other value, by plain calls."""
    rows: list[list[float]] = []
    for t in times:
        x = t
        for _ in range(CELLS - 1):
            x = work(x)
        rows.append([work(x, gain) for gain in gains])
    return rows


def _last_cell(run: Run, section: Section) -> None:
    """Ten functions of Python's one after the other, of some 70 µs each, of which the last reads the parameter."""
    values, times = (8 if run.quick else VALUES), np.linspace(0.0, 10.0, TIMES)
    work = _work(2500)
    gains = np.linspace(0.0, 1.0, values)

    def ours() -> float:
        measure = chain(work)
        over = {"bench_gain": gains, "time": times}
        return _timed(lambda: r4.sweep(r4.Scene(), over=over, measure={"m": measure}, progress=False))

    def least() -> float:
        return _timed(lambda: plainly(work, gains.tolist(), times.tolist()))

    taken, bare = _median(3, ours, least)
    section.rows.append(
        (f"{CELLS} functions, the last reads the parameter", duration(taken), duration(bare), ratio(taken / bare))
    )
    section.figures["last cell"] = {"ours": taken, "least": bare}
    claim = f"{values} × {TIMES} points, the last of {CELLS} cells reads the parameter, against plain calls"
    section.targets.append(Target(claim, 1.5, taken / bare, "times"))


# -- what is not the model ---------------------------------------------------------------------------------------------


def _machinery(run: Run, section: Section) -> None:
    """A measure of NumPy's, against NumPy on the same grid; and one parameter after another without time."""
    times, values = np.linspace(0.0, 10.0, TIMES), np.linspace(0.5, 2.0, VALUES)
    length, angle = r4.Parameter("bench_length", 1.0), r4.Parameter("bench_angle", 20.0)
    swing = angle * np.cos(np.sqrt(9.81 / length) * r4.time)
    grids: dict[str, dict[str, Any]] = {
        "parameter × time": {"bench_length": values, "time": times},
        "parameter × parameter": {"bench_length": np.linspace(0.5, 2.0, TIMES), "bench_angle": values},
    }
    for name, over in grids.items():
        points = VALUES * TIMES

        def ours(over: Any = over) -> float:
            engine.forget()
            return _timed(lambda: r4.sweep(r4.Scene(), over=over, measure={"m": swing}, progress=False))

        def bare(over: Any = over) -> float:
            def plain() -> Any:
                first, second = np.meshgrid(*over.values(), indexing="ij")
                if "time" in over:
                    return 20.0 * np.cos(np.sqrt(9.81 / first) * second)
                return second * np.cos(np.sqrt(9.81 / first) * 0.0)

            return _timed(plain)

        taken, least = _median(run.rounds, ours, bare)
        each = (taken - least) / points
        section.rows.append(
            (f"machinery, {name}", f"{duration(each)} a point", duration(least / points), ratio(taken / least))
        )
        section.figures[f"machinery, {name}"] = each
        section.targets.append(Target(f"machinery for a vectorised signal, {name}", 20, each / 1e-6, "µs a point"))


# -- processes ---------------------------------------------------------------------------------------------------------


def bored(triangles: int) -> r4.Scene:
    """A ball of so many triangles with a hole of as many, which a parameter moves."""
    rings = max(8, round((triangles / 4) ** 0.5))
    ball, hole = (r4.Sphere(r, segments=2 * rings, rings=rings) for r in (1.0, 0.7))
    hole.translate(r4.vec(r4.Parameter("bench_shift", 0.5), 0.1, 0.05))
    return r4.Scene(part=ball - hole)


def _workers(run: Run, section: Section) -> None:
    """Independent heavy points, by one process and by two: the processor's time of each point, and the clock's."""
    triangles, points = (4_000, 16) if run.quick else (20_000, 120)
    seconds: dict[int, list[Any]] = {1: [], 2: []}
    for _ in range(1 if run.quick else 3):
        for workers, taken in seconds.items():
            found = r4.sweep(
                lambda: bored(triangles),
                over={"bench_shift": np.linspace(0.3, 0.9, points)},
                measure={"volume": "part.volume"},
                workers=workers,
                progress=False,
            )
            taken.append((found.attrs["cpu_seconds"] / points, found.attrs["seconds"]))
    cpu = {workers: min(each for each, _ in taken) for workers, taken in seconds.items()}
    clock = {workers: min(whole for _, whole in taken) for workers, taken in seconds.items()}
    title = f"{points} booleans of {triangles:,} triangles by two processes"
    section.rows.append((f"{title}, CPU a point", duration(cpu[2]), duration(cpu[1]), ratio(cpu[2] / cpu[1])))
    section.rows.append(
        (f"{title}, until all is done", duration(clock[2]), duration(clock[1]), ratio(clock[2] / clock[1]))
    )
    section.figures["workers"] = {"cpu": cpu, "clock": clock}
    section.targets.append(Target("CPU a point with two processes against one", 1.15, cpu[2] / cpu[1], "times"))
    section.notes.append(
        "The time until all is done includes that of starting the processes, which import the library."
    )


# -- timing ------------------------------------------------------------------------------------------------------------


def _timed(function: Callable[[], Any]) -> float:
    start = process_time()
    function()
    return process_time() - start


def _median(rounds: int, *contenders: Callable[[], float]) -> list[float]:
    """What each takes, by turns, after a first turn that does not count."""
    taken: list[list[float]] = [[] for _ in contenders]
    for turn in range(rounds + 1):
        for times, contender in zip(taken, contenders, strict=True):
            seconds = contender()
            if turn:
                times.append(seconds)
    return [float(np.median(times)) for times in taken]
