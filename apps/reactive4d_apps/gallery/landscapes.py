"""Figures of sweeps: measures of a model over a grid of its parameters, as a surface."""

import numpy as np
import param

import reactive4d as r4
from reactive4d_apps.gallery.pendulums import Pendulum

__all__ = ["Landscape"]

LENGTHS, ANGLES = np.linspace(0.2, 1.5, 13), np.linspace(0.0, 90.0, 13)


def rises() -> np.ndarray:
    """(13, 13), how far the bob of the pendulum rises, for every length and every angle, metres."""
    found = r4.sweep(
        Pendulum,
        over={"length": LENGTHS, "angle": ANGLES, "time": 0.0},
        measure={"height": "bob.position[2]"},
        progress=False,
    )
    return (found.height + found.length).values


class Landscape(r4.Illustration):
    """How far a pendulum rises, over its length and the angle from which it is let go."""

    length = param.Number(1.0, bounds=(0.2, 1.5), doc="length of the rod [m]")
    angle = param.Number(60.0, bounds=(0, 90), doc="starting angle [deg]")

    def build(self) -> r4.Scene:
        """The sheet was swept: 169 answers of the model. The ball on it is where the reader is."""
        p = self.signals
        x, y = np.meshgrid(LENGTHS, ANGLES / 45, indexing="ij")
        net = np.stack([x, y, rises()], axis=-1)
        sheet = r4.Patch(net, interpolation="linear", segments=(12, 12), color="steelblue")
        rows = [*net[::3], *net[:, ::3].swapaxes(0, 1)]
        lines = {f"line{i}": r4.Path(row, interpolation="linear", color="white") for i, row in enumerate(rows)}
        rise = p.length * (1 - np.cos(np.radians(p.angle)))
        here = r4.Sphere(0.06, color="crimson")
        here.translate(r4.vec(p.length, p.angle / 45, rise))
        stick = r4.Cylinder(0.012, 1, color="crimson")
        stick.translate((0, 0, 0.5))
        stick.scale(r4.vec(1, 1, rise))
        stick.translate(r4.vec(p.length, p.angle / 45, 0))
        labels = {
            "length": r4.Label("length", at=(0.9, -0.25, 0), height=14),
            "angle": r4.Label("angle", at=(-0.3, 1.2, 0), height=14),
            "rise": r4.Label("rise", at=(1.65, 2.1, 0.8), height=14),
        }
        frame = {
            "to length": r4.Arrow((0, 0, 0), (1.7, 0, 0), radius=0.012, color="gray"),
            "to angle": r4.Arrow((0, 0, 0), (0, 2.2, 0), radius=0.012, color="gray"),
        }
        scene = r4.Scene(
            {"sheet": sheet, **lines, "here": here, "stick": stick, **frame, **{f"{k}?": v for k, v in labels.items()}}
        )
        scene.signals["rise"] = rise
        scene.signals["solved"] = abs(rise - 1) < 0.02
        return scene
