"""Figures about solids and surfaces: the kinds that come along, and solids that combine like sets."""

from collections.abc import Callable

import numpy as np
import param

import reactive4d as r4

__all__ = ["Drill", "Kinds", "Vase"]

PROFILE = [(0.0, -0.5), (0.28, -0.5), (0.4, -0.1), (0.16, 0.25), (0.26, 0.5), (0.0, 0.5)]
BEND = [(-0.4, 0, -0.4), (-0.1, 0, 0.4), (0.3, 0.2, 0.0), (0.4, 0, 0.5)]

KINDS: dict[str, Callable[[], r4.Object]] = {
    "Box": lambda: r4.Box((0.8, 0.8, 0.8)),
    "Sphere": lambda: r4.Sphere(0.5),
    "Cylinder": lambda: r4.Cylinder(0.4, 0.9),
    "Cone": lambda: r4.Cone(0.45, 0.9),
    "Tube": lambda: r4.Tube(0.45, 0.3, 0.8),
    "Torus": lambda: r4.Torus(0.38, 0.14),
    "Quadric": lambda: r4.Quadric((0.45, 0.2, 0.45), 0.9),
    "Superquadric": lambda: r4.Superquadric((0.9, 0.9, 0.9), (0.3, 2.2)),
    "Polyhedron": lambda: r4.Polyhedron("dodecahedron", 0.5),
    "Teapot": lambda: r4.Teapot(0.6, segments=4),
    "Prism": lambda: r4.Prism([(0.5, 0), (0.15, 0.45), (-0.45, 0.3), (-0.3, -0.4), (0.2, -0.35)], 0.7),
    "Revolution": lambda: r4.Revolution(PROFILE, smooth=True),
    "Duct": lambda: r4.Duct([r4.Circle(0.2, segments=16), r4.Rectangle((0.2, 0.3))], path=r4.Path(BEND, samples=24)),
    "Blob": lambda: r4.Blob([(-0.22, 0, -0.15), (0.22, 0, 0.15)], 0.55, resolution=20),
    "Patch": lambda: r4.Patch(sail(), segments=(12, 12)),
    "Lettering": lambda: r4.Lettering("4D", height=0.6, segments=2),
}
COLORS = ("steelblue", "darkorange", "seagreen", "mediumpurple")


def sail() -> np.ndarray:
    """(4, 4, 3), the control points of a patch that is up at two corners and down at the others."""
    u, v = np.meshgrid(np.linspace(-0.5, 0.5, 4), np.linspace(-0.5, 0.5, 4))
    return np.stack([u, v, 2 * u * v], axis=-1)


class Kinds(r4.Illustration):
    """Sixteen kinds of solids and surfaces, each turning in its place."""

    times = (0, 12)

    def build(self) -> r4.Scene:
        """Four rows of four, with their names, which are those of their classes."""
        parts: dict[str, r4.Object] = {}
        for i, (name, make) in enumerate(KINDS.items()):
            place = (2.0 * (i % 4), 0, -1.7 * (i // 4))
            thing = parts[name] = make()
            thing.color = COLORS[i // 4]
            if name == "Lettering":
                thing.rotate(90, axis="x")
            if name == "Teapot":
                thing.translate((0, 0, -0.3))
            thing.rotate(30 * r4.time)
            thing.translate(place)
            label = parts[f"{name}?"] = r4.Label(name, height=11)
            label.translate(np.add(place, (0, 0, -0.8)))
        parts["camera"] = r4.Camera((3, -15, 0), (3, 0, -2.75), fov=28)
        return r4.Scene(parts)


class Drill(r4.Illustration):
    """A drill goes through a block: what is left is the block without the drill, at every time."""

    radius = param.Number(0.4, bounds=(0.2, 0.6), doc="of the drill [m]")

    def build(self) -> r4.Scene:
        """The drill itself is drawn as well, so that one sees where it is."""
        block = r4.Box((3, 2, 1), color="steelblue")
        drill = r4.Cylinder(self.signals.radius, 3, color="darkorange")
        drill.translate(r4.keys({0: (-0.8, 0, 2.2), 2: (-0.8, 0, 0.6), 4: (0.8, 0, 0.6), 6: (0.8, 0, 2.2)}))
        part = block - drill
        shaft = r4.Cylinder(0.12, 3, color="silver")
        shaft.translate(drill.position + (0, 0, 1.2))
        tip = r4.Cylinder(0.2, 0.3, color="silver")
        tip.translate(drill.position + (0, 0, 1.7))
        scene = r4.Scene(part=part, shaft=shaft, tip=tip)
        scene.signals["volume"] = part.volume
        return scene


class Vase(r4.Illustration):
    """One point moves, and with it a path, the vase that is turned from it, and the wine that the vase holds."""

    belly = param.Number(0.7, bounds=(0.3, 1.2), doc="how far the second point is from the axis [m]")
    neck = param.Number(0.3, bounds=(0.15, 0.8), doc="how far the third point is from the axis [m]")

    def build(self) -> r4.Scene:
        """The points are objects, the path follows them, the vase follows the path."""
        p = self.signals
        places = [(0.35, 0, 0), r4.vec(p.belly, 0, 0.7), r4.vec(p.neck, 0, 1.5), (0.45, 0, 2)]
        points = [r4.Point(place) for place in places]
        path = r4.Path(points, samples=24, color="darkorange")
        vase = r4.Revolution(path, smooth=True, segments=40, color="steelblue")
        parts: dict[str, r4.Object] = {"vase": vase, "path": path}
        for i, point in enumerate(points):
            dot = parts[f"dot{i}"] = r4.Sphere(0.06, segments=16, rings=8, color="crimson")
            dot.translate(point.position)
        scene = r4.Scene(parts)
        scene.handle(parts["dot1"], x=p.belly, label="the belly")
        scene.handle(parts["dot2"], x=p.neck, label="the neck")
        scene.signals["solved"] = abs(p.belly - 0.4) + abs(p.neck - 0.4) < 0.06
        return scene
