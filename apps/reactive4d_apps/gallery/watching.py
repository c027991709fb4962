"""Figures about objects that look at each other: who asks whom, and what an edit of one does to the others."""

from typing import Any

import numpy as np
import param

import reactive4d as r4

__all__ = ["CameraAndCube", "Recording", "Watcher"]


class CameraAndCube(r4.Illustration):
    """A cube on a rail, and a camera on a stand that asks the cube where it is."""

    times = (0, 6)
    away = param.Number(0.0, bounds=(-1.5, 1.5), doc="how far the rail lies from the middle [m]")

    def build(self) -> r4.Scene:
        """The camera's matrix reads the cube's position, and nothing else of it."""
        p = self.signals
        cube = r4.Box((0.7, 0.7, 0.7), color="steelblue")
        cube.translate(r4.vec(p.away + 1.5, r4.keys({0: -2, 3: 2, 6: -2}, ease="in_out"), 0.35))
        rail = r4.Box((0.1, 5, 0.04), color="gray")
        rail.translate(r4.vec(p.away + 1.5, 0, 0.02))

        house, lens = r4.Box((0.4, 0.5, 0.8), color="dimgray"), r4.Cone(0.12, 0.4, top=0.25, color="gray")
        lens.translate((0, 0, -0.55))
        sight = r4.Cylinder(0.015, 1, color="darkorange")
        sight.translate((0, 0, -0.5))
        watching = r4.Group({"house": house, "lens": lens, "sight": sight})
        watching.translate((-2.2, 0, 1.3))
        watching.apply(r4.LookAt(cube.position))
        way = cube.position - watching.position
        sight.scale(r4.vec(1, 1, np.sqrt(way @ way)))
        stand = r4.Cylinder(0.05, 1.3, color="gray")
        stand.translate((-2.2, 0, 0.65))
        scene = r4.Scene(cube=cube, rail=rail, watching=watching, stand=stand)
        scene.handle(cube, x=p.away)
        return scene


WAY: dict[float, Any] = {
    0: (-1.8, -1.0, 1.2),
    2: (-1.0, -1.6, 2.8),
    4: (1.0, -1.2, 2.9),
    6: (1.7, -0.9, 1.6),
    8: (1.9, 0.2, 2.6),
}


def watcher(way: Any) -> tuple[dict[str, r4.Object], r4.Signal[Any]]:
    """A figure in a chair, a fly, eyes that ask the fly where it is, and a lamp that lights while it is above 2 m.

    Returns:
        The objects by name, and whether the fly is above 2 m.
    """
    seat, back = r4.Box((1, 1, 0.12), color="tan"), r4.Box((1, 0.12, 1.3), color="tan")
    seat.translate((0, 0, 0.9))
    back.translate((0, 0.44, 1.5))
    legs = [r4.Box((0.1, 0.1, 0.9), color="tan") for _ in range(4)]
    for i, leg in enumerate(legs):
        leg.translate(((i % 2 - 0.5) * 0.9, (i // 2 - 0.5) * 0.9, 0.45))
    chair = seat | back | legs[0] | legs[1] | legs[2] | legs[3]

    spine = r4.Path([(0, 0.1, 0.9), (0, 0.2, 1.5), (0, 0.1, 2.1)], samples=12)
    body = r4.Duct([r4.Circle(r, segments=16) for r in (0.2, 0.3, 0.1)], path=spine, smooth=True, color="steelblue")
    head = r4.Sphere(0.28, color="burlywood")
    head.translate((0, 0.08, 2.35))
    limbs: dict[str, r4.Object] = {}
    for side, x in (("left", -0.18), ("right", 0.18)):
        bones = [(x, 0.1, 1.05), (x, -0.55, 1.05), (x, -0.62, 0.9), (x, -0.62, 0.05)]
        leg = r4.Duct([r4.Circle(0.11, segments=12)], path=r4.Path(bones, samples=16), smooth=True, color="steelblue")
        limbs[f"{side} leg"] = leg

    wings = {}
    for side, y in (("left wing", 0.09), ("right wing", -0.09)):
        wing = wings[side] = r4.Sphere(0.1, segments=16, rings=8, color="silver")
        wing.scale((0.6, 1.2, 0.1))
        wing.translate((0, y, 0.06))
    trunk = r4.Sphere(0.09, segments=16, rings=8, color="crimson")
    trunk.scale((1.6, 1, 1))
    fly = r4.Group({"trunk": trunk, **wings})
    fly.apply(r4.LookAt(way.derivative(), forward="x"))
    fly.translate(way)

    eyes: dict[str, r4.Object] = {}
    for side, x in (("left eye", -0.12), ("right eye", 0.12)):
        pupil = r4.Sphere(0.06, segments=16, rings=8, color="black")
        pupil.translate((0, 0, -0.065))
        eyes[side] = r4.Group({"ball": r4.Sphere(0.1, segments=16, rings=8, color="white"), "pupil": pupil})
        eyes[side].translate((x, -0.17, 2.4))
        eyes[side].apply(r4.LookAt(fly.position))
    lamp = r4.Sphere(0.15, segments=16, rings=8)
    above = fly.position[2] > 2
    lamp.color = r4.where(above, r4.color("gold"), r4.color("dimgray"))
    lamp.translate((-1.3, 0.4, 2.4))
    pole = r4.Cylinder(0.03, 2.3, color="gray")
    pole.translate((-1.3, 0.4, 1.15))
    parts: dict[str, r4.Object] = {"chair": chair, "body": body, "head": head, **limbs, "fly": fly, **eyes}
    parts |= {"lamp": lamp, "pole": pole}
    return parts, above


class Watcher(r4.Illustration):
    """A figure in its chair watches a fly, whose way a reader bends; beside it, who asks whom."""

    times = (0, 8)
    x = param.Number(
        1.0, bounds=(-1.5, 2.0), precedence=-1, label="the side", doc="where the fly is at 4 s, to the side [m]"
    )
    z = param.Number(
        2.9, bounds=(1.2, 3.2), precedence=-1, label="the height", doc="where the fly is at 4 s, above the floor [m]"
    )

    def build(self) -> r4.Scene:
        """The way is a curve through five points, one of which is where the reader says."""
        p = self.signals
        third = r4.vec(p.x, -1.2, p.z)
        way = r4.keys({**WAY, 4: third}, interpolation="catmull_rom")
        parts, above = watcher(way)
        for i in range(25):
            dot = parts[f"way{i}"] = r4.Sphere(0.025, segments=8, rings=4, color="gray")
            dot.translate(way.warp(r4.Variable(i / 3)))
        held = parts["point"] = r4.Sphere(0.08, segments=16, rings=8, color="darkorange")
        held.translate(third)
        parts["camera"] = r4.Camera((0.9, -8.2, 2.6), (0.05, -0.4, 1.5), fov=27)
        scene = r4.Scene(parts)
        scene.handle(held, x=p.x, z=p.z, label="where the fly is at 4 s")
        scene.signals["solved"] = p.z <= 2
        scene.cells = {
            "your point": third,
            "the way": way,
            "fly's place": parts["fly"].position,
            "left eye": parts["left eye"].matrix,
            "right eye": parts["right eye"].matrix,
            "above 2 m?": above,
            "lamp": parts["lamp"].color,
            "chair": parts["chair"],
            "body": parts["body"],
            "picture": scene.frame,
        }
        return scene


# The boxes of the graph: what the engine calls a cell, what stands on its box, and where that is.
BOXES = {
    "way": ("the way", (0.6, 4.0)),
    "fly.matrix": ("fly's turn", (-1.2, 3.0)),
    "fly.position": ("fly's place", (2.4, 3.0)),
    "left eye.matrix": ("left eye", (0.35, 2.0)),
    "right eye.matrix": ("right eye", (2.4, 2.0)),
    "(fly.position[2] > 2)": ("> 2 m?", (4.45, 2.0)),
    "lamp.color": ("lamp", (4.45, 1.0)),
    "chair.node": ("chair", (-3.2, 2.0)),
    "body.node": ("body", (-3.2, 1.0)),
    "scene": ("picture", (0.35, 0.0)),
}
ARROWS = (
    ("way", "fly.matrix"),
    ("way", "fly.position"),
    ("fly.position", "left eye.matrix"),
    ("fly.position", "right eye.matrix"),
    ("fly.position", "(fly.position[2] > 2)"),
    ("(fly.position[2] > 2)", "lamp.color"),
    ("lamp.color", "scene"),
    ("left eye.matrix", "scene"),
    ("right eye.matrix", "scene"),
    ("fly.matrix", "scene"),
    ("chair.node", "scene"),
    ("body.node", "scene"),
)
COLORS = {
    "edited": "crimson",
    "marked": "darkorange",
    "evaluated": "seagreen",
    "cut off": "mediumpurple",
    "validated": "steelblue",
    "reused": "steelblue",
}


def recorded() -> list[tuple[str, str]]:
    """What the engine did with which cell when the way was edited at 4 s, and the scene asked for 3 s; each once."""
    way = r4.keys(WAY, interpolation="catmull_rom", name="way")
    scene = r4.Scene(watcher(way)[0])
    scene.at(3)
    with r4.log() as events:
        way.points[4] = (0.4, -1.6, 2.5)
        scene.at(3)
    found: dict[str, str] = {}
    steps: list[tuple[str, str]] = []
    for event in events:
        is_news = event.kind != "reused" or found.get(event.name) in (None, "edited", "marked")
        if event.name in BOXES and is_news and found.get(event.name) != event.kind:
            found[event.name] = event.kind
            steps.append((event.kind, event.name))
    return steps


class Recording(r4.Illustration):
    """Who asks whom, and what happened cell by cell when a point of the fly's way was moved."""

    times = (0, 20)

    def build(self) -> r4.Scene:
        """Each step of the recording takes a second; a box keeps the colour of what happened to its cell last."""
        steps = recorded()
        parts: dict[str, r4.Object] = {}
        for name, (text, (x, z)) in BOXES.items():
            happened = {0.0: "asleep"} | {i + 1.0: kind for i, (kind, cell) in enumerate(steps) if cell == name}
            paints = {t: r4.color(COLORS.get(kind, "lightgray")) for t, kind in happened.items()}
            box = parts[text] = r4.Box((1.85, 0.1, 0.55), color=r4.keys(paints, interpolation="step"))
            label = parts[f"{text}?"] = r4.Label(text, height=12)
            for each in (box, label):
                each.translate((x, 0, z))
        for start, stop in ARROWS:
            (x0, z0), (x1, z1) = BOXES[start][1], BOXES[stop][1]
            a, b = np.array((x0, 0.12, z0 - 0.28)), np.array((x1, 0.12, z1 + 0.28))
            parts[f"{start} to {stop}"] = r4.Arrow(a, b, radius=0.025, segments=8, color="gray")
        told = {0.0: "all is remembered"} | {
            i + 1.0: f"{kind}: {BOXES[name][0]}" for i, (kind, name) in enumerate(steps)
        }
        parts["now"] = r4.Label(r4.keys(told, kind="held"), at=(0.6, 0, 4.75), height=17)
        parts["camera"] = r4.Camera((0.6, -19, 2.3), (0.6, 0, 2.3), fov=24)
        return r4.Scene(parts)
