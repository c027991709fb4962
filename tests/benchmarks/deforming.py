"""Large meshes through animated deformations: our blocks of float32 against the same formulas in plain NumPy."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from .clocks import alternate
from .reports import Section, Target, duration, ratio
from .runs import Run

__all__ = ["NAMES", "cloud", "deforming", "ours", "plain"]

POINTS = 1_000_000
NAMES = ("taper", "twist", "bend", "wave")  # The stack, from below.


def cloud(count: int) -> Any:
    """Points of a bar 4 m high, float32."""
    draw = np.random.default_rng(1)
    points = draw.uniform((-0.5, -0.5, -2.0), (0.5, 0.5, 2.0), (count, 3)).astype(np.float32)
    points.flags.writeable = False
    return points


def plain(points: Any, names: Sequence[str], t: float) -> Any:
    """The deformations of these names at a time, as one writes them down: (V, 3) float64 to (V, 3) float64."""
    for name in names:
        points = _PLAIN[name](points, t)
    return points


def _taper(points: Any, t: float) -> Any:
    x, y, z = points.T
    factor = 1.0 + (0.5 + 0.1 * t) * z / (z.max() - z.min())
    return np.stack([x * factor, y * factor, z], axis=1)


def _twist(points: Any, t: float) -> Any:
    x, y, z = points.T
    angle = (1.0 + 0.1 * t) * z / (z.max() - z.min())
    sine, cosine = np.sin(angle), np.cos(angle)
    return np.stack([x * cosine - y * sine, x * sine + y * cosine, z], axis=1)


def _bend(points: Any, t: float) -> Any:
    x, y, z = points.T
    rate = (1.2 + 0.1 * t) / (z.max() - z.min())
    radius = 1.0 / rate
    return np.stack([radius - (radius - x) * np.cos(rate * z), y, (radius - x) * np.sin(rate * z)], axis=1)


def _wave(points: Any, t: float) -> Any:
    x, y, z = points.T
    height = 0.1 * np.exp(-0.2 * np.abs(x)) * np.sin(2.0 * np.pi * x / 0.7 - 3.0 * t)
    return np.stack([x, y, z + height], axis=1)


_PLAIN: dict[str, Callable[[Any, float], Any]] = {"taper": _taper, "twist": _twist, "bend": _bend, "wave": _wave}


def ours(points: Any, names: Sequence[str], t: float) -> Any:
    """The same by the library: (V, 3) float32 to (V, 3) float32."""
    from reactive4d.geometry.deformations.bends import Bend
    from reactive4d.geometry.deformations.stacks import deform
    from reactive4d.geometry.deformations.tapers import Taper
    from reactive4d.geometry.deformations.twists import Twist
    from reactive4d.geometry.deformations.waves import Wave

    steps = {
        "taper": Taper(0.5 + 0.1 * t),
        "twist": Twist(1.0 + 0.1 * t),
        "bend": Bend(1.2 + 0.1 * t),
        "wave": Wave(0.1, 0.7, 3.0 * t, decay=0.2),
    }
    return deform(points, [steps[name] for name in names])


def deforming(run: Run) -> Section:
    """Every deformation alone, and all four as a stack, at another time with every call."""
    count = POINTS // 10 if run.quick else POINTS
    single = cloud(count)
    double = single.astype(np.float64)
    stacks = {"all four": NAMES, **{f"{name} alone": (name,) for name in NAMES}}

    def calls(function: Callable[[Any, Sequence[str], float], Any], points: Any, names: Sequence[str]) -> Any:
        t = 0.0

        def run_it(repetitions: int) -> None:
            nonlocal t
            for _ in range(repetitions):
                t += 0.01
                function(points, names, t)

        return run_it

    timings = alternate(
        {
            f"{who}: {title}": calls(function, points, names)
            for title, names in stacks.items()
            for who, function, points in (("plain", plain, double), ("ours", ours, single))
        },
        rounds=2 * run.rounds + 1,
        seconds=run.seconds,
    )
    section = Section(
        "deforming",
        f"{count:,} points through animated deformations",
        ("what", "NumPy, float64", "here, float32", "times as fast"),
    )
    for title in stacks:
        theirs, here = timings[f"plain: {title}"].median, timings[f"ours: {title}"].median
        section.rows.append((title, duration(theirs), duration(here), ratio(theirs / here)))
        section.figures[title] = {"plain": theirs, "ours": here}
    four = section.figures["all four"]
    claim = f"four deformations of {count:,} points against plain NumPy"
    section.targets.append(Target(claim, 7, four["plain"] / four["ours"], "times", at_least=True))
    section.notes.append("Both measure how far the points reach along the axis, and make a new array every time.")
    return section
