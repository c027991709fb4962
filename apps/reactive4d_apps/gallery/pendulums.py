"""Figures of chapter nine: an illustration in a dozen lines, a kind and a change of one's own."""

import numpy as np
import param
from numpy.typing import NDArray

import reactive4d as r4
from reactive4d.geometry import prisms

__all__ = ["Bounce", "Gears", "Pendulum"]


class Pendulum(r4.Illustration):
    """A pendulum of adjustable length."""

    length = param.Number(0.6, bounds=(0.2, 1.5), doc="length of the rod [m]")
    angle = param.Number(20.0, bounds=(-90, 90), doc="starting angle [deg]")

    def build(self) -> r4.Scene:
        """Describe the model once; the signals carry every later change."""
        p = self.signals
        swing = p.angle * np.cos(np.sqrt(9.81 / p.length) * r4.time)

        rod = r4.Cylinder(0.02, 1, color="gray")
        rod.translate((0, 0, -0.5))
        rod.scale(r4.vec(1, 1, p.length))
        bob = r4.Sphere(0.1, color="crimson")
        bob.translate(r4.vec(0, 0, -p.length))
        for part in (rod, bob):
            part.rotate(swing, axis="y")

        ceiling = r4.Box((0.8, 0.3, 0.06), color="gray")
        ceiling.translate((0, 0, 0.03))

        camera = r4.Camera((0, -5, -0.3), (0, 0, -0.75), fov=24)
        scene = r4.Scene(rod=rod, bob=bob, ceiling=ceiling, camera=camera)
        period = 2 * np.pi * np.sqrt(p.length / 9.81)
        scene.signals["period"] = period
        scene.signals["solved"] = abs(period - 2) < 0.01
        return scene


class Gear(r4.Object):
    """A gear in z = 0: a kind of one's own. What it is made of follows from its settings."""

    radius = r4.Float(1.0, low=0.0, unit="m", doc="to the middle of the teeth")
    teeth = r4.Integer(12, low=4, doc="how many")
    height = r4.Float(0.3, low=0.0, unit="m", doc="along z")

    table = r4.Table(surface=lambda radius, teeth, height: prisms.mesh(outline(radius, teeth), amount=height))


def outline(radius: float, teeth: int) -> NDArray[np.float64]:
    """(4 * teeth, 2): for every tooth two points at its foot and two at its tip."""
    turns = (np.arange(4 * teeth) + 0.5) / (4 * teeth) * 2 * np.pi
    reach = radius + np.tile((-1, 1, 1, -1), teeth) * 1.6 * radius / teeth
    return np.stack([reach * np.cos(turns), reach * np.sin(turns)], axis=-1)


class Gears(r4.Illustration):
    """Two gears of a kind of one's own; the second turns as the first one makes it."""

    times = (0, 12)
    teeth = param.Integer(12, bounds=(8, 20), doc="of the first gear")

    def build(self) -> r4.Scene:
        """The radii are in proportion to the numbers of teeth, so that the teeth are equally large."""
        n = self.signals.teeth
        first = Gear(radius=0.1 * n, teeth=n, color="steelblue")
        second = Gear(radius=1.6, teeth=16, color="darkorange")
        first.rotate(30 * r4.time)
        second.rotate(180 + 180 / 16 - 30 * r4.time * n / 16)
        second.translate(r4.vec(0.1 * n + 1.6, 0, 0))
        camera = r4.Camera((1.3, -4.5, 6.5), (1.3, 0, 0), fov=38)
        return r4.Scene(first=first, second=second, camera=camera)


class Squash(r4.Deformation):
    """Make flat, and as much wider as keeps the volume: a change of one's own."""

    share = r4.Float(1.0, low=0.01, doc="of the height that is left")

    @staticmethod
    def deform(share: float, points: NDArray[np.float64], position: NDArray[np.float64]) -> NDArray[np.float64]:
        """About the object's place."""
        wider = 1 / np.sqrt(share)
        return (points - position) * (wider, wider, share) + position


class Bounce(r4.Illustration):
    """A ball that is flat when it touches the ground."""

    times = (0, 2)
    softness = param.Number(0.5, bounds=(0, 0.6), doc="which share of its height it loses on the ground")

    def build(self) -> r4.Scene:
        """The lower it is, the flatter."""
        height = 2 * abs(np.sin(np.pi * r4.time))
        ball = r4.Sphere(0.5, color="crimson")
        squash = ball.apply(Squash(1.0))
        squash.share = 1 - self.signals.softness * np.clip(1 - 4 * height, 0, 1)
        ball.translate(r4.vec(0, 0, height + 0.5 * squash.share))
        ground = r4.Box((3, 3, 0.1), color="lightgray")
        ground.translate((0, 0, -0.05))
        scene = r4.Scene(ball=ball, ground=ground)
        scene.signals["volume"] = ball.volume
        return scene
