"""Figures about changes: an object is a list of them, and the list stays editable."""

from typing import Any

import numpy as np
import param

import reactive4d as r4

__all__ = ["Between", "Gate", "Order", "Stack"]


ORDERS: list[str] = ["bend, then twist", "twist, then bend"]


class Stack(r4.Illustration):
    """A tube with a bend and a twist, and the list of both, whose order and switches a reader changes."""

    order: "param.Selector[Any]" = param.Selector(default=ORDERS[0], objects=ORDERS)
    bend = param.Number(90.0, bounds=(0, 120), doc="angle of the bend [deg]")
    twist = param.Number(120.0, bounds=(0, 240), doc="angle of the twist [deg]")
    bends = param.Boolean(True, doc="whether the bend acts")
    twists = param.Boolean(True, doc="whether the twist acts")

    def build(self) -> r4.Scene:
        """The bend stands in the list twice, before the twist and after it; at most one of the two acts."""
        p = self.signals
        is_first = r4.equal(p.order, ORDERS[0])
        tube = r4.Tube(0.45, 0.32, 4, segments=6, stacks=24, color="steelblue")
        tube.apply(r4.Bend(p.bend, enabled=np.logical_and(p.bends, is_first)))
        tube.apply(r4.Twist(p.twist, enabled=p.twists))
        tube.apply(r4.Bend(p.bend, enabled=np.logical_and(p.bends, np.logical_not(is_first))))

        places = {"tube": 0.0, "bend": r4.where(is_first, 1.0, 2.0), "twist": r4.where(is_first, 2.0, 1.0)}
        strengths = {"tube": 1.0, "bend": r4.where(p.bends, 1.0, 0.25), "twist": r4.where(p.twists, 1.0, 0.25)}
        colors = {"tube": "steelblue", "bend": "darkorange", "twist": "seagreen"}
        listed = cards(places, colors, strengths, x=3.4)
        return r4.Scene({"camera": r4.Camera((1.5, -9.5, 3), (1.6, 0, 0), fov=32), "tube": tube, **listed})


PLACES: list[str] = ["between them", "at the end"]


class Between(r4.Illustration):
    """A tube with a bend, a move and a twist: what the move does depends on what stands after it."""

    offset = param.Number(0.8, bounds=(0, 1.2), doc="how far the tube is moved [m]")
    place: "param.Selector[Any]" = param.Selector(default=PLACES[0], objects=PLACES, doc="where the move stands")
    bends = param.Boolean(False, doc="whether the bend acts")

    def build(self) -> r4.Scene:
        """The move stands in the list twice, before the twist and after it; one of the two acts."""
        p = self.signals
        is_between = r4.equal(p.place, PLACES[0])
        tube = r4.Tube(0.34, 0.22, 4, segments=8, stacks=48, color="steelblue")
        tube.apply(r4.Bend(70, enabled=p.bends))
        tube.apply(r4.XForm(offset=r4.vec(p.offset, 0, 0), enabled=is_between))
        tube.apply(r4.Twist(360, center=(0, 0, 0)))
        tube.apply(r4.XForm(offset=r4.vec(p.offset, 0, 0), enabled=np.logical_not(is_between)))

        post = r4.Line((0, 0, -2.5), (0, 0, 2.7), color="gray")
        way = r4.Line((0, 0, 0), (1, 0, 0), color="crimson")
        way.scale(r4.vec(p.offset, 1, 1))
        way.translate((0, 0, 2.5))
        grip = r4.Sphere(0.1, segments=24, rings=12, color="crimson")
        grip.translate(r4.vec(p.offset, 0, 2.5))
        places = {"tube": 0, "bend": 1, "move": r4.where(is_between, 2, 3), "twist": r4.where(is_between, 3, 2)}
        colors = {"tube": "steelblue", "bend": "darkorange", "move": "crimson", "twist": "seagreen"}
        strengths = {"bend": r4.where(p.bends, 1.0, 0.25)}
        listed = cards(places, colors, strengths, x=3.4)
        camera = r4.Camera((1.5, -12.5, 3), (1.5, 0, 0.1), fov=27)
        scene = r4.Scene({"camera": camera, "tube": tube, "post": post, "way": way, "grip": grip, **listed})
        scene.handle(grip, x=p.offset, label="the move")
        return scene


def cards(
    places: dict[str, Any], colors: dict[str, str], strengths: dict[str, Any], *, x: float
) -> dict[str, r4.Object]:
    """A list of changes, one card above the other; what does not act is pale."""
    made: dict[str, r4.Object] = {}
    for name, place in places.items():
        card = made[f"{name} card"] = r4.Box((1.7, 0.2, 0.6), color=colors[name])
        card.opacity = strengths.get(name, 1.0)
        text = made[f"{name} text"] = r4.Label(name, height=15)
        for each in (card, text):
            each.translate(r4.vec(x, 0, 0.8 * place - 0.8))
    return made


class Gate(r4.Illustration):
    """A bend that acts from 2 s to 4 s, and a move that goes on."""

    times = (0, 6)

    def build(self) -> r4.Scene:
        """Whether a change acts is a signal like all others; pale ones show where the bar is at 0, 3 and 6 s."""
        acts = r4.keys({0: 0, 2: 1, 4: 0}, interpolation="step")
        bar = r4.Box((0.5, 0.5, 3), segments=(1, 1, 24))
        bend = bar.apply(r4.Bend(80))
        bend.enabled = acts
        way = r4.keys({0: (-2, 0, 1.5), 6: (2, 0, 1.5)})
        bar.translate(way)
        bar.color = r4.where(acts > 0, r4.color("darkorange"), r4.color("steelblue"))

        pale: dict[str, r4.Object] = {}
        for t in (0, 3, 6):
            one = pale[f"at {t} s"] = r4.Box((0.48, 0.48, 2.98), segments=(1, 1, 24), color="lightgray")
            one.apply(r4.Bend(80, enabled=bool(acts.at(t))))
            one.translate(way.at(t))
            one.opacity = 0.35
        return r4.Scene({"camera": r4.Camera((0, -11, 4), (0.2, 0, 1.4), fov=30), "bar": bar, **pale})


class Order(r4.Illustration):
    """Move and turn, or turn and move: the same two changes, in both orders."""

    angle = param.Number(60.0, bounds=(0, 360), doc="by which both turn [deg]")
    length = param.Number(2.0, bounds=(0, 2.5), doc="by which both move [m]")

    def build(self) -> r4.Scene:
        """The orange one is turned about the origin after it was moved, so it is carried round."""
        p = self.signals
        start = r4.Polyhedron("tetrahedron", 0.3, color="gray")
        turned, moved = (r4.Box((0.9, 0.45, 0.3), color=color) for color in ("steelblue", "darkorange"))
        turned.rotate(p.angle)
        turned.translate(r4.vec(p.length, 0, 0))
        moved.translate(r4.vec(p.length, 0, 0))
        moved.rotate(p.angle)
        circle = r4.Circle(1, segments=96, color="gray")
        circle.scale(p.length)
        camera = r4.Camera((2, -9, 6), (0, 0, 0), fov=30)
        scene = r4.Scene(camera=camera, turned=turned, moved=moved, start=start, circle=circle)
        scene.signals["gap"] = 2 * p.length * abs(np.sin(np.radians(p.angle / 2)))
        scene.signals["solved"] = abs(scene.signals["gap"] - 2 * p.length) < 0.02
        return scene
