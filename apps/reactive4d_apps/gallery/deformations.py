"""Figures about deformations: bars that are tapered, twisted and bent, a lattice to drag, a dolphin in a wave."""

from typing import Any

import numpy as np
import param

import reactive4d as r4
from reactive4d.geometry import lattices

__all__ = ["Bars", "Dolphin", "Lattice"]


class Bars(r4.Illustration):
    """Three bars of one size: one is tapered, one twisted, one bent (Barr 1984)."""

    taper = param.Number(-0.6, bounds=(-0.8, 0.8), doc="by how much of itself the top grows")
    twist = param.Number(120.0, bounds=(0, 240), doc="from bottom to top [deg]")
    bend = param.Number(60.0, bounds=(0, 120), doc="from bottom to top [deg]")

    def build(self) -> r4.Scene:
        """Deformations move points, so the bars have some to move: 24 along their length."""
        p = self.signals
        bars = {name: r4.Box((0.7, 0.7, 3), segments=(3, 3, 24)) for name in ("taper", "twist", "bend")}
        bars["taper"].apply(r4.Taper(p.taper))
        bars["twist"].apply(r4.Twist(p.twist))
        bars["bend"].apply(r4.Bend(p.bend))
        labels: dict[str, r4.Object] = {}
        for i, (name, color) in enumerate(zip(bars, ("steelblue", "seagreen", "darkorange"), strict=True)):
            bars[name].translate((2.2 * i, 0, 1.5))
            bars[name].color = color
            labels[f"{name}?"] = r4.Label(name, at=(2.2 * i, -0.6, -0.35), height=15)
        camera = r4.Camera((2.6, -12, 4), (2.3, 0, 1.4), fov=26)
        return r4.Scene({**bars, **labels, "camera": camera})


class Lattice(r4.Illustration):
    """A ball in jelly: a lattice of control points, two of which a reader drags."""

    x = param.Number(0.9, bounds=(0.2, 1.6), precedence=-1, doc="of the upper corner, to the right [m]")
    z = param.Number(1.1, bounds=(0.2, 1.6), precedence=-1, doc="of the upper corner, upwards [m]")
    low = param.Number(-0.5, bounds=(-1.5, 0.4), precedence=-1, doc="of the lower corner, upwards [m]")

    def build(self) -> r4.Scene:
        """All points rest but the front ones at two corners."""
        p = self.signals
        rest = lattices.lattice((-0.6, -0.6, -0.6), (0.6, 0.6, 0.6), (3, 2, 3))
        points: Any = rest.tolist()
        for j in range(2):
            points[2][j][2] = r4.vec(p.x, rest[2, j, 2, 1], p.z)
            points[0][j][0] = r4.vec(-0.6, rest[0, j, 0, 1], p.low)
        ball = r4.Sphere(0.55, color="steelblue")
        ball.apply(r4.FreeForm(net(points), lower=(-0.6, -0.6, -0.6), upper=(0.6, 0.6, 0.6)))
        parts: dict[str, r4.Object] = {"ball": ball}
        for i, j, k in np.ndindex(3, 2, 3):
            is_free = (i, k) in ((2, 2), (0, 0))
            color = "crimson" if is_free else "gray"
            dot = parts[f"point{i}{j}{k}"] = r4.Sphere(0.05, segments=12, rings=6, color=color)
            dot.translate(points[i][j][k])
            for to in ((i + 1, j, k), (i, j + 1, k), (i, j, k + 1)):
                if to[0] < 3 and to[1] < 2 and to[2] < 3:
                    end = points[to[0]][to[1]][to[2]]
                    parts[f"line{i}{j}{k}{to}"] = r4.Path(
                        [points[i][j][k], end], interpolation="linear", samples=1, color="gray"
                    )
        parts["camera"] = r4.Camera((1.6, -5.2, 1.6), (0.25, 0, 0.1), fov=34)
        scene = r4.Scene(parts)
        for j, which in enumerate(("in front", "behind")):
            scene.handle(parts[f"point2{j}2"], x=p.x, z=p.z, label=f"the upper corner {which}")
            scene.handle(parts[f"point0{j}0"], z=p.low, label=f"the lower corner {which}")
        scene.signals["solved"] = abs(p.x - 0.6) + abs(p.z - 0.6) + abs(p.low + 0.6) < 0.12
        return scene


def net(points: Any) -> Any:
    """(3, 2, 3, 3), the control points as one signal."""
    flat = [place for plane in points for row in plane for place in row]
    return r4.lift(lambda *places: np.reshape(places, (3, 2, 3, 3)))(*flat)


class Dolphin(r4.Illustration):
    """A dolphin swims through a wave: the wave is a place in the world, and bends whatever comes by."""

    times = (0, 4)

    def build(self) -> r4.Scene:
        """Water and dolphin share one change, so the dolphin rides on what the water does."""
        wave = r4.Wave(0.5, wavelength=4, decay=0.15, center=(0, 0, 0))
        water = r4.Plane((14, 5), segments=(70, 1), color="lightskyblue")
        water.opacity = 0.6
        dolphin = swimmer()
        dolphin.translate(r4.keys({0: (-5, 0, 0.1), 4: (5, 0, 0.1)}))
        for thing in (water, dolphin):
            thing.apply(wave)
        return r4.Scene(dolphin=dolphin, water=water, camera=r4.Camera((0, -15, 5.5), (0, 0, 0), fov=32))


def swimmer() -> r4.Object:
    """A dolphin that looks along +x: a body of revolution, a back fin and a tail."""
    profile = [(0, 1.5), (0.07, 1.45), (0.1, 1.2), (0.3, 0.95), (0.42, 0.3), (0.34, -0.4), (0.12, -1.2), (0, -1.35)]
    body = r4.Revolution(r4.Path([(r, 0, z) for r, z in profile], samples=32), smooth=True, segments=20)
    body.rotate(90, axis="y")
    back = r4.Prism([(0.35, 0.25), (-0.35, 0.25), (-0.45, 0.85)], 0.08, segments=2)
    back.translate((0, 0, -0.04))
    back.rotate(90, axis="x")
    tail = r4.Prism([(-1.0, 0), (-1.5, 0.5), (-1.7, 0.5), (-1.4, 0), (-1.7, -0.5), (-1.5, -0.5)], 0.08, segments=2)
    tail.translate((0, 0, -0.04))
    parts = [body, back, tail]
    for part in parts:
        part.color = "slategray"
    return body | back | tail
