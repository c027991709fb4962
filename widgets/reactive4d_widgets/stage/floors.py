"""Floors: the soft shadow on the ground below the things, where they stand or hover.

It is looked at from below: the nearer a thing is, the darker; narrowly where things touch the floor, widely where they
are above it. The numbers are those of the browser's viewer.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d_widgets.stage.shades import Eye

__all__ = ["SIZE", "Floor", "floor_dark", "floor_of"]

Array = NDArray[np.float64]
SIZE = 256  # pixels of what is seen from below
MARGIN = 1.7
WIDE, NARROW = 0.075, 0.02  # how far the blurs reach, in shares of it


@dataclass(frozen=True, slots=True)
class Floor:
    """A square below all things.

    Attributes:
        center: (3,), metres.
        half: metres from its middle to its edge.
        reach: up to which heights things darken it, widely and narrowly.
    """

    center: Array
    half: float
    reach: tuple[float, float]

    @property
    def eye(self) -> Eye:
        """Who looks up from it: right is right, and +y is upwards as it is on a map that one looks at from below."""
        matrix = np.array([[1.0, 0, 0, 0], [0, -1.0, 0, 0], [0, 0, -1.0, 0], [0, 0, 0, 1.0]])
        matrix[:3, 3] = self.center - (0.0, 0.0, self.depth)
        return Eye(matrix, self.half, 0.0, 0.5 * self.depth, self.depth + 1.2 * self.reach[0])

    @property
    def depth(self) -> float:
        """How far below the floor the eye is, metres."""
        return 0.1 * self.half


def floor_of(low: Array, high: Array) -> Floor | None:
    """The floor below what lies in a box, over all times; None where there is nothing."""
    wide, tall = float(max(high[:2] - low[:2])), float(high[2] - low[2])
    size = max(wide, 0.5 * tall)
    if size <= 0.0:
        return None
    reach = 1.1 * max(size, tall), 0.16 * max(0.5 * size, min(size, tall))
    center = np.array([(low[0] + high[0]) / 2.0, (low[1] + high[1]) / 2.0, low[2]])
    return Floor(center, 0.5 * MARGIN * size, reach)


def floor_dark(floor: Floor, depths: Array) -> Array:
    """(S, S), how dark the floor is, from 0 to 1; the first row is the lowest y.

    Args:
        floor: whose eye took the picture of distances.
        depths: (S, S), metres ahead of that eye, NaN where there is nothing.
    """
    from scipy import ndimage  # pyright: ignore[reportMissingTypeStubs]

    filters: Any = ndimage
    heights = np.where(np.isnan(depths), np.inf, depths - floor.depth)
    layers: list[Any] = []
    for reach, blur in zip(floor.reach, (WIDE, NARROW), strict=True):
        layer: Any = np.clip(1.0 - heights / reach, 0.0, 1.0) ** 2
        step = blur * SIZE
        offsets = np.arange(-round(step), round(step) + 1)
        weights = np.exp(-2.2 * (offsets / step) ** 2)
        for axis in (0, 1):
            layer = filters.correlate1d(layer, weights / weights.sum(), axis=axis, mode="constant")
        layers.append(layer)
    return np.clip(0.55 * layers[0] + 0.5 * layers[1], 0.0, 1.0)
