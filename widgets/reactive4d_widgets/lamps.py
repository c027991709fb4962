"""Lamps: the light that falls on a scene, its own or, where it has none, a studio's.

The browser's viewer has the same numbers, so that a still and the figure that takes its place look alike.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.model.nodes import Node
from reactive4d.signals.colors import srgb_to_linear
from reactive4d_widgets.views import View

__all__ = ["Lamp", "Sky", "light_of"]

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Sky:
    """Light from everywhere: of one colour from above, of another from below, and mixtures between.

    Attributes:
        above: (3,), linear light; (1, 1, 1) lights a white surface just fully.
        below: (3,).
        up: (3,), where above is.
    """

    above: Array
    below: Array
    up: Array


@dataclass(frozen=True, slots=True)
class Lamp:
    """Light from one place, or from one direction.

    Attributes:
        color: (3,), linear light; (1, 1, 1) lights a white surface that faces it just fully.
        towards: (3,), the unit vector in which it shines.
        position: (3,), where it stands; None where it shines from afar.
        angle: radians, the half of its cone; None where it shines all round.
        reach: metres, how far it goes; None without limit.
    """

    color: Array
    towards: Array
    position: Array | None = None
    angle: float | None = None
    reach: float | None = None


STUDIO_SKY = ((0.55, 0.56, 0.58), (0.34, 0.32, 0.30))
STUDIO_KEY = ((0.72, 0.70, 0.66), (0.45, 0.60, -0.75))
FAINT = 0.4  # of the studio's sky that remains beside the lights of a scene: what they do not reach is not black


def light_of(nodes: Iterable[Node], view: View) -> tuple[Sky, tuple[Lamp, ...]]:
    """The light in a frame: its visible lights and a faint sky; a studio's, where there is none.

    Args:
        nodes: of a frame.
        view: from where it is looked at.

    >>> import reactive4d as r4
    >>> view = View((0, -5, 0), (0, 0, 0))
    >>> sky, lamps = light_of(r4.Scene(lamp=r4.Light("point", color="red")).at(0.0).values(), view)
    >>> lamps[0].color.tolist()
    [1.0, 0.0, 0.0]
    """
    lights = [node for node in nodes if node.primitive == "light" and node.visible]
    sky = np.array(STUDIO_SKY)
    if not lights:
        color, towards = STUDIO_KEY
        key = Lamp(np.array(color), _unit(np.array(towards)))
        return Sky(sky[0], sky[1], np.array((0.0, 0.0, 1.0))), (key,)
    around = np.zeros(3)
    is_ambient = False
    lamps: list[Lamp] = []
    for node in lights:
        settings: Any = node.drawn
        color = srgb_to_linear(node.color[:3]) * node.color[3] * float(settings["intensity"])
        if settings["light_type"] == "ambient":
            is_ambient = True
            around = around + color
        else:
            lamps.append(_lamp(node, color))
    if not is_ambient:
        return Sky(sky[0] * FAINT, sky[1] * FAINT, np.array((0.0, 0.0, 1.0))), tuple(lamps)
    return Sky(around, around, np.array((0.0, 0.0, 1.0))), tuple(lamps)


def _lamp(node: Node, color: Array) -> Lamp:
    settings: Any = node.drawn
    towards = _unit(-node.matrix[:3, 2])
    if settings["light_type"] in ("directional", "distant"):
        return Lamp(color, towards)
    reach = settings["reach"]
    return Lamp(
        color,
        towards,
        position=node.matrix[:3, 3],
        angle=math.radians(float(settings["angle"])) / 2.0 if settings["light_type"] == "spot" else None,
        reach=float(reach) if reach else None,
    )


def _unit(vector: Array) -> Array:
    return vector / np.linalg.norm(vector)
