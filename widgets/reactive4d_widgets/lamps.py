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
from reactive4d.signals.colors import color, srgb_to_linear
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
        shadows: whether things throw shadows in it.
    """

    color: Array
    towards: Array
    position: Array | None = None
    angle: float | None = None
    reach: float | None = None
    shadows: bool = False


# A studio that goes round with the eye, as if one turned the things on a table: to the right, upwards, to the eye.
KEY, KEY_INTENSITY = (-0.62, 1.0, 0.62), 0.62
FILL, FILL_INTENSITY = (0.9, 0.25, 0.7), 0.14
SKY = {"intensity": 0.44, "above": "#ffffff", "below": "#8f8a84"}
# What the lights of a scene do not reach is not black.
FAINT_SKY = {"intensity": 0.16, "above": "#ffffff", "below": "#9a968f"}


def light_of(nodes: Iterable[Node], view: View) -> tuple[Sky, tuple[Lamp, ...]]:
    """The light in a frame: its visible lights and, unless one of them is ambient, a faint sky; or a studio's.

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
    if not lights:
        return _studio(view)
    around = np.zeros(3)
    is_ambient = False
    lamps: list[Lamp] = []
    for node in lights:
        settings: Any = node.drawn
        strength = srgb_to_linear(node.color[:3]) * float(settings["intensity"])
        if settings["light_type"] == "ambient":
            is_ambient = True
            around = around + strength
        else:
            lamps.append(_lamp(node, strength))
    up = np.array((0.0, 0.0, 1.0))
    return Sky(around, around, up) if is_ambient else _sky(FAINT_SKY, up), tuple(lamps)


def _studio(view: View) -> tuple[Sky, tuple[Lamp, ...]]:
    right, up = view.matrix[:3, 0], _unit(np.array(view.up))
    front = np.cross(right, up)
    lamps: list[Lamp] = []
    for (x, y, z), intensity in ((KEY, KEY_INTENSITY), (FILL, FILL_INTENSITY)):
        towards = -_unit(x * right + y * up + z * front)
        lamps.append(Lamp(np.full(3, intensity), towards, shadows=not lamps))  # in the key's light alone
    return _sky(SKY, up), tuple(lamps)


def _sky(sky: Any, up: Array) -> Sky:
    above, below = [srgb_to_linear(color(sky[side])[:3]) * sky["intensity"] for side in ("above", "below")]
    return Sky(above, below, up)


def _lamp(node: Node, strength: Array) -> Lamp:
    settings: Any = node.drawn
    towards = _unit(-node.matrix[:3, 2])
    if settings["light_type"] in ("directional", "distant"):
        return Lamp(strength, towards, shadows=bool(settings["shadows"]))
    reach = settings["reach"]
    return Lamp(
        strength,
        towards,
        position=node.matrix[:3, 3],
        angle=math.radians(float(settings["angle"])) / 2.0 if settings["light_type"] == "spot" else None,
        reach=float(reach) if reach else None,
        shadows=bool(settings["shadows"]),
    )


def _unit(vector: Array) -> Array:
    return vector / np.linalg.norm(vector)
