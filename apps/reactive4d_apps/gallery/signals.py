"""Figures about signals: values that can be asked for any time, and for how long each answer holds."""

from itertools import pairwise
from typing import Any

import numpy as np
import param

import reactive4d as r4

__all__ = ["Lift", "Stale"]


class Lift(r4.Illustration):
    """A lift that follows five keys, and the interval over which its present answer holds."""

    times = (0, 10)

    def build(self) -> r4.Scene:
        """The graph of the height, the lift beside it, and below a bar: as long as the answer holds."""
        height = r4.keys({0: 0, 2: 0, 4: 2, 7: 2, 9: 0.5, 10: 0.5})
        car = r4.Box((1, 1, 0.8), color="seagreen")
        car.translate(r4.vec(-1.8, 0, height + 0.4))
        shaft = r4.Box((0.08, 0.08, 3.2), color="gray")
        shaft.translate((-1.8, 0.6, 1.6))

        begins, ends = answers(height, 10.0)
        bar = r4.Box((1, 0.3, 0.3), color="steelblue")
        bar.scale(r4.vec(ends - begins + 0.06, 1, 1))
        bar.translate(r4.vec((begins + ends) / 2, 0, -0.8))

        dot = r4.Sphere(0.16, color="seagreen")
        dot.translate(r4.vec(r4.time, 0, height))
        now = r4.Line((0, 0, 0), (0, 0, 1), color="seagreen")
        now.scale(r4.vec(1, 1, height + 0.7))
        now.translate(r4.vec(r4.time, 0, -0.7))
        curve = r4.Path([(t, 0, height.at(t)) for t in height.points], interpolation="linear", color="steelblue")
        camera = r4.Camera((3.7, -16, 3.5), (3.7, 0, 1), fov=38)
        scene = r4.Scene(camera=camera, car=car, shaft=shaft, curve=curve, dot=dot, now=now, bar=bar, **axes(10))
        scene.signals["height"] = height
        scene.signals["begins"], scene.signals["ends"] = begins, ends
        return scene


def answers(signal: r4.Keys[Any], stop: float) -> tuple[r4.Keys[Any], r4.Keys[Any]]:
    """From when to when each answer holds, as two signals: the keys are asked once between every two of them."""
    begins: dict[float, Any] = {}
    ends: dict[float, Any] = {}
    for before, after in pairwise(signal.points):
        valid = signal.valid((before + after) / 2)
        instant = (r4.time, r4.time)
        begins[before], ends[before] = instant if valid.is_instant else (max(valid.start, 0.0), min(valid.stop, stop))
    return r4.keys(begins, interpolation="step"), r4.keys(ends, interpolation="step")


def axes(stop: int) -> dict[str, r4.Object]:
    """A line of time with a label at every second second."""
    made: dict[str, r4.Object] = {"axis": r4.Line((0, 0, 0), (stop, 0, 0), color="gray")}
    for t in range(0, stop + 1, 2):
        made[f"second{t}"] = r4.Label(f"{t} s", at=(t, 0, -0.28), height=13)
    return made


class Stale(r4.Illustration):
    """Four answers of a signal that were remembered, and which of them an edit of a key makes stale."""

    times = (0, 8)

    left = param.Number(1.0, bounds=(0, 3), precedence=-1, doc="value of the key at 2 s [m]")
    middle = param.Number(2.5, bounds=(0, 3), doc="value of the key at 4 s [m]")
    right = param.Number(0.5, bounds=(0, 3), precedence=-1, doc="value of the key at 6 s [m]")

    def build(self) -> r4.Scene:
        """Five keys, three of them to drag; for each span between two of them a line, and a tile of the strip."""
        p = self.signals
        remembered = (0.5, 1.0, 2.5, 0.5, 1.5)
        values: tuple[Any, ...] = (0.5, p.left, p.middle, p.right, 1.5)
        height = r4.keys(dict(zip((0, 2, 4, 6, 8), values, strict=True)))
        edited = [abs(value - old) > 0.005 for value, old in zip(values, remembered, strict=True)]

        parts: dict[str, r4.Object] = {"camera": r4.Camera((3.1, -16, 3), (3.1, 0, 0.8), fov=30)}
        for i in range(4):
            stale = np.logical_or(edited[i], edited[i + 1])
            color = r4.where(stale, r4.color("darkorange"), r4.color("steelblue"))
            line = parts[f"line{i}"] = r4.Box((2, 0.05, 0.07), color=color)
            line.apply(r4.Shear(r4.vec(0, 0, (values[i + 1] - values[i]) / 2), axis="x"))
            line.translate(r4.vec(2 * i + 1, 0, (values[i] + values[i + 1]) / 2))
            tile = parts[f"tile{i}"] = r4.Box((1.9, 0.3, 0.3), color=color)
            tile.translate((2 * i + 1, 0, -0.9))
            parts[f"says{i}"] = r4.Label(r4.where(stale, "stale", "holds"), at=(2 * i + 1, 0, -1.35), height=14)
        for i, value in enumerate(values):
            key = parts[f"key{i}"] = r4.Sphere(0.17 if 0 < i < 4 else 0.09, color="crimson" if 0 < i < 4 else "gray")
            key.translate(r4.vec(2 * i, 0, value))
        car = parts["car"] = r4.Box((0.9, 0.9, 0.7), color="seagreen")
        car.translate(r4.vec(-1.3, 0, height))
        dot = parts["dot"] = r4.Sphere(0.13, color="seagreen")
        dot.translate(r4.vec(r4.time, -0.1, height))

        scene = r4.Scene({**parts, **axes(8)})
        for i, name in ((1, p.left), (2, p.middle), (3, p.right)):
            scene.handle(parts[f"key{i}"], z=name, label=f"the key at {2 * i} s")
        scene.signals["at3"] = (p.left + p.middle) / 2
        scene.signals["solved"] = abs(p.left + p.middle - 4) < 0.06
        return scene
