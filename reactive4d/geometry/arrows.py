"""The arrow: a shaft and a head as one closed solid, from the origin along +z.

An arrow that is short for its thickness is made thinner, so that it keeps its shape down to a length of 0.
"""

import math
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.geometry import rounds
from reactive4d.geometry.sizes import count, length

__all__ = ["Proportions", "faces", "placement", "points", "proportions", "uv", "volume", "weld"]

Floats: TypeAlias = NDArray[np.float64]

_SLENDER = 0.03  # the shaft's radius by the arrow's length, where no radius is given
_HEAD = 8.0  # the head's length by the shaft's radius
_WIDE = 2.5  # the head's radius by the shaft's
_SHORTEST = 12.0  # the least length of an arrow by its shaft's radius

# Bottom, side, the ring below the head, the head: rows of places from the lowest middle outward and up to the tip.
_RUNS = ((0, 1), (1, 2), (2, 3), (3, 4))
_POLES = (0, 4)


class Proportions(NamedTuple):
    """How an arrow is divided, metres: the radii of shaft and head, and the heights of the head's foot and the tip."""

    shaft: float
    head: float
    neck: float
    tip: float


def proportions(size: Any = 1.0, radius: Any = None) -> Proportions:
    """The proportions of an arrow of some length; the radius of its shaft may be given.

    Raises:
        ShapeError: a size is negative or not finite.

    >>> proportions(1.0)
    Proportions(shaft=0.03, head=0.075, neck=0.76, tip=1.0)
    """
    tip = length(size, "length")
    shaft = _SLENDER * tip if radius is None else min(length(radius, "radius"), tip / _SHORTEST)
    return Proportions(shaft, _WIDE * shaft, tip - _HEAD * shaft, tip)


def points(size: Any = 1.0, radius: Any = None, segments: Any = 32) -> NDArray[np.float32]:
    """The vertices, (V, 3) float32: bottom, side, ring and head have their own.

    Args:
        size: from its foot to its tip, metres.
        radius: of the shaft, metres; by its length if it is None.
        segments: round the z axis, 3 or more.

    Raises:
        ShapeError: a size is negative or not finite, or a count is too small.

    >>> points(2.0, segments=8)[:, 2].max()
    np.float32(2.0)
    """
    shaft, head, neck, tip = proportions(size, radius)
    radii = (0.0, shaft, shaft, shaft, shaft, head, head, 0.0)
    heights = (0.0, 0.0, 0.0, neck, neck, neck, neck, tip)
    return freeze(rounds.points(radii, heights, count(segments, "segments", 3)))


def faces(segments: Any = 32) -> NDArray[np.int32]:
    """Triangles, (F, 3) int32.

    >>> faces(8).shape
    (48, 3)
    """
    return rounds.faces(*_profile(segments))


def uv(segments: Any = 32) -> NDArray[np.float32]:
    """Texture coordinates, (V, 2): shaft and head unrolled, the bottom as a disc."""
    return rounds.uv(*_profile(segments), discs=(0,))


def weld(segments: Any = 32) -> NDArray[np.int32]:
    """For each vertex the lowest index of one at the same place, (V,)."""
    return rounds.weld(*_profile(segments))


def volume(size: Any = 1.0, radius: Any = None) -> float:
    """Its content, m³.

    >>> round(volume(1.0) / (math.pi * 0.03**2), 6)  # 0.76 of shaft, and a third of 0.24 of head, 2.5² as wide
    1.26
    """
    shaft, head, neck, tip = proportions(size, radius)
    return math.pi * (shaft * shaft * neck + head * head * (tip - neck) / 3.0)


def placement(start: Any, vector: Any) -> Floats:
    """The rigid matrix that puts the foot at `start` and the tip along `vector`, turned the shortest way from +z.

    Args:
        start: (3,), metres.
        vector: (3,); where it is (0, 0, 0), nothing is turned.

    >>> (placement((1, 0, 0), (2, 0, 0)) @ (0, 0, 1, 1)).round(9).tolist()
    [2.0, 0.0, 0.0, 1.0]
    """
    matrix = np.eye(4)
    matrix[:3, 3] = start
    x, y, z = (float(part) for part in vector)
    size = math.hypot(x, y, z)
    if size == 0.0:
        return freeze(matrix)
    x, y, z = x / size, y / size, z / size
    beyond = 1.0 + z if z > 0.0 else (x * x + y * y) / (1.0 - z)  # 1 + z, without cancellation
    if beyond == 0.0:  # straight down: half a turn about x
        matrix[1, 1] = matrix[2, 2] = -1.0
        return freeze(matrix)
    # Rodrigues (1840), for the turn that takes +z to (x, y, z).
    share = 1.0 / beyond
    matrix[:3, :3] = (
        (1.0 - share * x * x, -share * x * y, x),
        (-share * x * y, 1.0 - share * y * y, y),
        (-x, -y, z),
    )
    return freeze(matrix)


def _profile(segments: Any) -> tuple[Any, Any, int]:
    return rounds.profile(_RUNS, _POLES, count(segments, "segments", 3))
