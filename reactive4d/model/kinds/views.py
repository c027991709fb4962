"""What is not a solid: cameras, lights, labels, points."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry import transforms
from reactive4d.model.objects import Object, called
from reactive4d.model.settings import Choice, Flag, Float, Text, Vector
from reactive4d.model.tables import Table

__all__ = ["Camera", "Label", "Light", "Point"]

Array = NDArray[np.float64]


def _watching(eye: Array, target: Array, up: Array) -> Array:
    return transforms.look_at(eye, target, up)


class Camera(Object):
    """A camera: it stands at `eye` and looks at `target`, along its own -z.

    >>> import reactive4d as r4
    >>> fly = r4.Sphere(radius=0.05)
    >>> _ = fly.translate(r4.vec(0, r4.time, 1))
    >>> camera = r4.Camera(position=(6, 0, 1), target=fly.position)
    >>> camera.target.at(2.0)
    array([0., 2., 1.])
    """

    primitive = "camera"

    eye = Vector((5.0, -5.0, 3.0), unit="m", doc="where it stands")
    target = Vector((0.0, 0.0, 0.0), unit="m", doc="what it looks at")
    up = Vector("z", is_direction=True, doc="which way is up")
    fov = Float(40.0, low=1.0, high=179.0, unit="deg", doc="from the lower to the upper edge of the picture")
    near = Float(0.01, low=0.0, unit="m", doc="what is nearer is not seen")
    far = Float(1000.0, low=0.0, unit="m", doc="what is farther is not seen")

    table = Table(placement=_watching)

    def __init__(
        self, position: Any = None, target: Any = None, *, up: Any = None, fov: Any = None, **settings: Any
    ) -> None:
        super().__init__(target=target, up=up, fov=fov, **called(settings, eye=position))


class Light(Object):
    """A light: from everywhere (ambient), from afar (directional), from a point, or a cone of it (spot).

    It shines along its own -z, so that unturned it shines downwards.

    >>> import reactive4d as r4
    >>> lamp = r4.Light("point", color="white", intensity=2)
    >>> _ = lamp.translate((0, 0, 3))
    >>> lamp.position.at(0.0)
    array([0., 0., 3.])
    """

    primitive = "light"

    light_type = Choice("directional", options=("ambient", "directional", "distant", "point", "spot"), doc="its type")
    intensity = Float(1.0, low=0.0, doc="how strong it is")
    angle = Float(45.0, low=0.0, high=180.0, unit="deg", doc="of the cone of a spot")
    reach = Float(low=0.0, unit="m", doc="how far the light of a point or spot goes; without limit where it is not set")
    shadows = Flag(False, doc="whether things throw shadows in it")

    def __init__(self, kind: Any = None, *, color: Any = None, intensity: Any = None, **settings: Any) -> None:
        super().__init__(color=color, intensity=intensity, **called(settings, light_type=kind))


def _at_anchor(anchor: Array) -> Array:
    return transforms.translation(anchor)


def _at(at: Array) -> Array:
    return transforms.translation(at)


def _turned_on_screen(angle: float, axis: Array, center: Array, before: Array) -> Array:
    """The place turns in space, the text on the screen, by the share of the turn about the line of sight."""
    turn = transforms.rotation(np.radians(angle), axis, center=center)
    roll = transforms.rotation(np.radians(angle), "z")[:3, :3]
    at = turn[:3, :3] @ before[:3, 3] + turn[:3, 3]
    matrix = np.eye(4)
    matrix[:3, :3] = roll
    matrix[:3, 3] = at - roll @ before[:3, 3]
    return matrix


class Label(Object):
    """Text that always faces the reader, at a point of space. Turning it turns the text on the screen.

    Its matrix says where it stands; the first three rows and columns are about the screen's axes.

    >>> import reactive4d as r4
    >>> label = r4.Label("north", at=(0, 1, 0))
    >>> label.position.at(0.0)
    array([0., 1., 0.])
    """

    primitive = "label"

    text = Text("", doc="what it says")
    anchor = Vector((0.0, 0.0, 0.0), unit="m", doc="where it stands")
    height = Float(16.0, low=0.0, unit="px", doc="of a line on the screen")

    table = Table(placement=_at_anchor, changes={"rotate": _turned_on_screen})

    def __init__(self, text: Any = None, *, at: Any = None, **settings: Any) -> None:
        super().__init__(text=text, **called(settings, anchor=at))


class Point(Object):
    """A point: nothing but a place, which others use as a control point.

    >>> import reactive4d as r4
    >>> p = r4.Point((1, 2, 3))
    >>> p.position.at(0.0)
    array([1., 2., 3.])
    """

    at = Vector((0.0, 0.0, 0.0), unit="m", doc="where it is before the changes act")

    table = Table(placement=_at, points=lambda: np.zeros((1, 3), np.float32), faces=lambda: np.zeros((0, 3), np.int32))

    def __init__(self, at: Any = None, **settings: Any) -> None:
        super().__init__(at=at, **settings)
