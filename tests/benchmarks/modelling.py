"""Objects as lists of changes: matrices, stacks of deformations, frames of large scenes, booleans, and building."""

import gc
import math
import random
import tracemalloc
from bisect import bisect_right
from collections.abc import Callable
from time import process_time
from typing import Any

import numpy as np

import reactive4d as r4
from reactive4d.geometry import solids
from reactive4d.geometry.deformations.stacks import deform
from reactive4d.geometry.deformations.waves import Wave

from .clocks import alternate
from .deforming import NAMES, POINTS, cloud, plain
from .reports import Section, Target, duration, ratio
from .runs import Run

__all__ = ["chains", "modelling", "moving", "scene_of", "stack"]

Rows = list[tuple[list[float], list[Any]]]


def modelling(run: Run) -> Section:
    """All that is asked of the model."""
    section = Section("modelling", "Objects as lists of changes", ("what", "measured", "against", "ratio"))
    budget = r4.budget
    for part in (_stacks, _matrices, _chains, _frames, _solids, _building):
        try:
            part(run, section)
        finally:
            r4.budget = budget
        gc.unfreeze()  # what a part has built is of no use to the next
        gc.collect()
    return section


# -- deformations ------------------------------------------------------------------------------------------------------


def stack(points: Any, *, animated: tuple[str, ...] = NAMES) -> r4.Object:
    """The stack of the benchmark of the kernels, as changes of an object; those that are not animated stand still."""
    mesh = r4.Mesh(points, np.zeros((0, 3), np.int32))
    bar = r4.Model(mesh)
    t = r4.time

    def moves(name: str) -> Any:
        return t if name in animated else 0.0

    bar.apply(r4.Taper(0.5 + 0.1 * moves("taper")))
    bar.apply(r4.Twist((1.0 + 0.1 * moves("twist")) * 180 / math.pi))
    bar.apply(r4.Bend((1.2 + 0.1 * moves("bend")) * 180 / math.pi))
    bar.apply(r4.Wave(0.1, wavelength=0.7, phase=3.0 * moves("wave") * 180 / math.pi, decay=0.2))
    return bar


def _ask(signal: Any, step: float = 0.01) -> Callable[[int], None]:
    """Ask at another time with every call."""
    t = 0.0

    def run_it(repetitions: int) -> None:
        nonlocal t
        for _ in range(repetitions):
            t += step
            signal.at(t)

    return run_it


def _stacks(run: Run, section: Section) -> None:
    count = POINTS // 10 if run.quick else POINTS
    single = cloud(count)
    double = single.astype(np.float64)
    # As when a film is rendered: what was shown is forgotten, since as many large answers cannot be remembered anyway.
    r4.budget = 5 * single.nbytes
    all_four, top = stack(single), stack(single, animated=("wave",))
    below = stack(single, animated=())
    below.changes.remove(below.changes[3])
    under = below.points.at(0.0)
    t = 0.0

    def by_hand(repetitions: int) -> None:
        nonlocal t
        for _ in range(repetitions):
            t += 0.01
            plain(double, NAMES, t)

    def wave(repetitions: int) -> None:
        nonlocal t
        for _ in range(repetitions):
            t += 0.01
            deform(under, [Wave(0.1, 0.7, 3.0 * t, decay=0.2)])

    timings = alternate(
        {"plain": by_hand, "four": _ask(all_four.points), "top": _ask(top.points), "wave": wave},
        rounds=2 * run.rounds + 1,
        seconds=run.seconds,
    )
    seconds = {name: timing.median for name, timing in timings.items()}
    times = seconds["plain"] / seconds["four"]
    section.rows.append(
        (
            f"four animated deformations of {count:,} points",
            duration(seconds["four"]),
            duration(seconds["plain"]),
            ratio(times),
        )
    )
    share = seconds["top"] / seconds["wave"]
    section.rows.append(
        (
            "only the top one animated, against its kernel",
            duration(seconds["top"]),
            duration(seconds["wave"]),
            ratio(share),
        )
    )
    section.targets.append(
        Target(f"a stack of four on {count:,} points against plain NumPy", 7, times, "times", at_least=True)
    )
    section.targets.append(Target("only the top change animated against its kernel alone", 1.3, share, "times"))
    section.figures["stacks"] = seconds


# -- matrices ----------------------------------------------------------------------------------------------------------


def moving(count: int, keys: int = 6) -> tuple[list[r4.Object], list[tuple[Any, Any, Any]]]:
    """Objects with three keyed curves each, and the keys as plain lists."""
    draw = random.Random(1)
    objects: list[r4.Object] = []
    curves: list[tuple[Any, Any, Any]] = []
    times = [0.5 * i for i in range(keys)]
    for _ in range(count):
        offsets = [(draw.random(), draw.random(), draw.random()) for _ in times]
        angles = [360.0 * draw.random() for _ in times]
        factors = [1.0 + draw.random() for _ in times]
        obj = r4.Sphere()
        obj.scale(r4.keys(dict(zip(times, factors, strict=True))))
        obj.rotate(r4.keys(dict(zip(times, angles, strict=True))))
        obj.translate(r4.keys(dict(zip(times, offsets, strict=True))))
        objects.append(obj)
        curves.append(((times, offsets), (times, angles), (times, factors)))
    return objects, curves


def _between(times: list[float], values: list[Any], t: float) -> Any:
    i = min(max(bisect_right(times, t) - 1, 0), len(times) - 2)
    share = (t - times[i]) / (times[i + 1] - times[i])
    a, b = values[i], values[i + 1]
    if isinstance(a, tuple):
        return tuple([x + (y - x) * share for x, y in zip(a, b, strict=True)])
    return a + (b - a) * share


def by_hand(curves: list[tuple[Any, Any, Any]], t: float) -> list[Any]:
    """The world matrices as one writes them down."""
    matrices: list[Any] = []
    for offsets, angles, factors in curves:
        s, angle, (x, y, z) = _between(*factors, t), math.radians(_between(*angles, t)), _between(*offsets, t)
        c, n = math.cos(angle), math.sin(angle)
        scale = np.array([[s, 0, 0, 0], [0, s, 0, 0], [0, 0, s, 0], [0, 0, 0, 1.0]])
        turn = np.array([[c, -n, 0, 0], [n, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])
        shift = np.array([[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1.0]])
        matrices.append(shift @ (turn @ scale))
    return matrices


def _matrices(run: Run, section: Section) -> None:
    count = 100 if run.quick else 1000
    objects, curves = moving(count)
    matrices = [obj.matrix for obj in objects]
    clock = {"ours": 0.0, "plain": 0.0}

    def ours(repetitions: int) -> None:
        for _ in range(repetitions):
            clock["ours"] += 0.0013
            for matrix in matrices:
                matrix.at(clock["ours"])

    def hand(repetitions: int) -> None:
        for _ in range(repetitions):
            clock["plain"] += 0.0013
            by_hand(curves, clock["plain"])

    def again(repetitions: int) -> None:
        for _ in range(repetitions):
            for matrix in matrices:
                matrix.at(0.0013)

    timings = alternate({"ours": ours, "plain": hand, "replay": again}, rounds=2 * run.rounds + 1, seconds=run.seconds)
    here, there = timings["ours"].median / count, timings["plain"].median / count
    replay = timings["replay"].median / count
    section.rows.append(
        (
            f"a matrix of three keyed curves ({count:,} objects, all moving)",
            duration(here),
            duration(there),
            ratio(here / there),
        )
    )
    section.rows.append(("the same, replayed", duration(replay), "", ""))
    section.targets.append(Target("matrices of a frame against bare arithmetic", 5, here / there, "times"))
    section.targets.append(Target("a matrix replayed", 1.0, replay * 1e6, "µs"))
    section.figures["matrices"] = {"ours": here, "plain": there, "replay": replay}


def chains(count: int, length: int) -> list[list[r4.Object]]:
    """Chains of extensions, each with a translation of its own; the root of the first chain moves."""
    made: list[list[r4.Object]] = []
    for i in range(count):
        root = r4.Sphere()
        root.translate(r4.keys({0: (0, 0, 0), 5: (1, 1, 1)}) if i == 0 else (0, 0, i))
        chain: list[r4.Object] = [root]
        for _ in range(length - 1):
            chain.append(chain[-1].extend())
            chain[-1].translate((1, 0, 0))
        made.append(chain)
    return made


def _chains(run: Run, section: Section) -> None:
    count, length = (10, 100) if run.quick else (100, 100)
    made = chains(count, length)
    matrices = [obj.matrix for chain in made for obj in chain]
    for matrix in matrices:
        matrix.at(0.0)
    with r4.log() as events:
        for matrix in matrices:
            matrix.at(0.1)
    names = {matrix.name for matrix in matrices}
    evaluated = sum(event.kind == "evaluated" and event.name in names for event in events)
    clock = 0.2

    def frame(repetitions: int) -> None:
        nonlocal clock
        for _ in range(repetitions):
            clock += 0.0013
            for matrix in matrices[:length]:
                matrix.at(clock)

    timing = alternate({"frame": frame}, rounds=2 * run.rounds + 1, seconds=run.seconds)["frame"].median / length
    section.rows.append((f"a matrix in a chain of {length} extensions with a moving root", duration(timing), "", ""))
    section.targets.append(
        Target(f"matrices evaluated of {len(matrices):,} when one of {count} roots moves", length, evaluated)
    )
    section.targets.append(Target("each of them", 30.0, timing * 1e6, "µs"))
    section.figures["chains"] = {"evaluated": evaluated, "seconds": timing}


# -- frames ------------------------------------------------------------------------------------------------------------


def scene_of(count: int) -> tuple[r4.Scene, list[r4.Object]]:
    """A scene of boxes."""
    boxes: list[r4.Object] = []
    for i in range(count):
        box = r4.Box()
        box.translate((i, 0, 0))
        boxes.append(box)
    return r4.Scene({f"box{i}": box for i, box in enumerate(boxes)}), boxes


def _frames(run: Run, section: Section) -> None:
    sizes = (100, 1000 if run.quick else 10_000)
    runs: dict[str, Callable[[int], None]] = {}
    for size in sizes:
        scene, boxes = scene_of(size)
        scene.at(0.0)
        runs[str(size)] = _editing(scene, boxes[size // 2])
    timings = alternate(runs, rounds=2 * run.rounds + 1, seconds=run.seconds)
    small, large = timings[str(sizes[0])].median, timings[str(sizes[1])].median
    section.rows.append(
        (
            f"edit and next frame, one of {sizes[1]:,} objects, against one of {sizes[0]}",
            duration(large),
            duration(small),
            ratio(large / small),
        )
    )
    section.targets.append(
        Target(f"edit and next frame with {sizes[1]:,} objects against {sizes[0]}", 3, large / small, "times")
    )
    section.figures["frames"] = {"small": small, "large": large}


def _editing(scene: r4.Scene, box: r4.Object) -> Callable[[int], None]:
    change = box.changes[0]
    shift = 0.0

    def run_it(repetitions: int) -> None:
        nonlocal shift
        for _ in range(repetitions):
            shift += 0.001
            change.offset = (shift, 0.0, 0.0)
            scene.at(0.0)

    return run_it


# -- solids ------------------------------------------------------------------------------------------------------------


def _solids(run: Run, section: Section) -> None:
    segments, rings = (64, 32) if run.quick else (320, 160)
    a, b = r4.Sphere(1.0, segments=segments, rings=rings), r4.Sphere(0.7, segments=segments, rings=rings)
    b.translate(r4.vec(0.6 + 0.01 * r4.time, 0.1, 0.05))
    part = a - b
    triangles = len(a.topology.at(0.0))
    left, right = a.solid.at(0.0), b.solid.at(0.0)
    r4.budget = 60_000_000
    t = 0.0

    def bare(repetitions: int) -> None:
        nonlocal t
        for _ in range(repetitions):
            t += 0.01
            (left.manifold - right.manifold.translate((0.6 + 0.01 * t, 0.1, 0.05))).to_mesh()

    timings = alternate({"ours": _ask(part.surface), "bare": bare}, rounds=2 * run.rounds + 1, seconds=run.seconds)
    imports = 0
    original = solids.from_mesh

    def counted(mesh: Any) -> Any:
        nonlocal imports
        imports += 1
        return original(mesh)

    solids.from_mesh = counted
    try:
        part.surface.at(1e6)
    finally:
        solids.from_mesh = original
    here, there = timings["ours"].median, timings["bare"].median
    section.rows.append(
        (
            f"two spheres of {triangles:,} triangles subtracted, against manifold3d alone",
            duration(here),
            duration(there),
            ratio(here / there),
        )
    )
    section.targets.append(
        Target(f"two spheres of {triangles:,} triangles subtracted against manifold3d", 1.15, here / there, "times")
    )
    section.targets.append(Target("imports when an operand moves", 0, imports))
    section.figures["solids"] = {"ours": here, "bare": there, "imports": imports}


# -- building ----------------------------------------------------------------------------------------------------------


def build(count: int) -> list[r4.Object]:
    """Objects with three changes each."""
    made: list[r4.Object] = []
    for i in range(count):
        obj = r4.Sphere(radius=0.1)
        obj.translate((i, 0, 0))
        obj.rotate(i)
        obj.scale(2.0)
        made.append(obj)
    return made


def _building(run: Run, section: Section) -> None:
    count = 1000 if run.quick else 10_000
    build(100)
    seconds: list[float] = []
    for _ in range(3):
        gc.collect()
        start = process_time()
        scene = r4.Scene({f"ball{i}": obj for i, obj in enumerate(build(count))})
        seconds.append(process_time() - start)
        del scene
    gc.collect()
    tracemalloc.start()
    scene = r4.Scene({f"ball{i}": obj for i, obj in enumerate(build(count))})
    gc.collect()
    size = tracemalloc.get_traced_memory()[0]
    tracemalloc.stop()
    del scene
    taken = sorted(seconds)[1]
    section.rows.append(
        (f"building a scene of {count:,} objects with three changes each", duration(taken), f"{size / 1e6:.0f} MB", "")
    )
    section.targets.append(Target(f"building {count:,} objects", 2.0 * count / 10_000, taken, "s"))
    section.targets.append(Target(f"memory of {count:,} objects", 100.0 * count / 10_000, size / 1e6, "MB"))
    section.figures["building"] = {"seconds": taken, "bytes": size}
