"""Shades: from where a lamp sees what stands in its light, and the map of distances of all of them."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry.transforms import look_at
from reactive4d_widgets.lamps import Lamp

__all__ = ["MOST", "SIZE", "Eye", "eye_of"]

Array = NDArray[np.float64]
SIZE = 1024  # pixels of a lamp's picture
MOST = 8  # lamps that throw shadows: their pictures are one texture, which may be so high


@dataclass(frozen=True, slots=True)
class Eye:
    """Whoever takes a picture of distances.

    Attributes:
        matrix: (4, 4), from the eye's axes to the world: it looks along its -z.
        half: metres from the middle of the picture to its edge, where all rays are parallel; else None.
        fov: degrees, where they are not.
        near: metres.
        far: metres.
    """

    matrix: Array
    half: float | None
    fov: float
    near: float
    far: float

    @property
    def key(self) -> tuple[object, ...]:
        """What two eyes that see the same have in common."""
        return self.matrix.tobytes(), self.half, self.fov, self.near, self.far


def eye_of(lamp: Lamp, low: Array, high: Array) -> Eye | None:
    """What a lamp sees of a box; None for a lamp that shines all round, and for an empty box.

    Args:
        lamp: whose shadows are wanted.
        low: (3,), the lowest coordinates of all that is drawn.
        high: (3,).

    >>> sun = Lamp(np.ones(3), np.array([0.0, 0.0, -1.0]), shadows=True)
    >>> eye_of(sun, -np.ones(3), np.ones(3)).matrix[:3, 3].round(3) + 0.0
    array([0.   , 0.   , 3.464])
    """
    center, radius = (low + high) / 2.0, float(np.linalg.norm(high - low)) / 2.0
    if radius == 0.0:
        return None
    if lamp.position is None:
        place = look_at(tuple(center - 2.0 * radius * lamp.towards), tuple(center), _across(lamp.towards))
        return Eye(place, 1.02 * radius, 0.0, 0.5 * radius, 3.6 * radius)
    if lamp.angle is None:
        return None
    place = look_at(tuple(lamp.position), tuple(lamp.position + lamp.towards), _across(lamp.towards))
    far = float(np.linalg.norm(center - lamp.position)) + radius
    return Eye(place, None, min(2.0 * math.degrees(lamp.angle), 170.0), 0.01 * far, far)


def _across(towards: Array) -> tuple[float, float, float]:
    """Some direction that is not this one."""
    return (0.0, 1.0, 0.0) if abs(towards[2]) > 0.9 else (0.0, 0.0, 1.0)
