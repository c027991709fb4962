"""The round quadric: ellipsoid, paraboloid, hyperboloid, cone or cylinder by the radii at its bottom, middle and top.

The squared radius is a quadratic of the height, which three radii fix. With height h these are, for instance: (0, r, 0)
an ellipsoid, and a sphere where h = 2 r; (r, r, r) a cylinder; (r, r/2, 0) a cone; (r, r/sqrt 2, 0) a paraboloid;
(r, w, r) with a narrower waist w a hyperboloid of one sheet. Scaling and shearing make all other elliptic ones of them,
and `forms` has the rays of quadrics that are general.
"""

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError
from reactive4d.geometry import rounds
from reactive4d.geometry.forms import between, meet
from reactive4d.geometry.rays import Lines, columns
from reactive4d.geometry.sizes import count, length, lengths

__all__ = [
    "area",
    "center_of_mass",
    "contains",
    "faces",
    "inertia",
    "intersect",
    "matrix",
    "points",
    "uv",
    "volume",
    "weld",
]

Floats: TypeAlias = NDArray[np.float64]

_RADII = (0.5, 0.25, 0.5)

# The double exponential rule on [0, 1]: places and weights that crowd at both ends.
_STEPS = np.linspace(-3.2, 3.2, 129)
_SHARES = 1.0 / (1.0 + np.exp(-np.pi * np.sinh(_STEPS)))
_WEIGHTS = np.pi * 0.05 * np.cosh(_STEPS) * _SHARES * (1.0 - _SHARES)


def faces(segments: Any = 32, stacks: Any = 16) -> NDArray[np.int32]:
    """Triangles of the bottom, the side and the top, (F, 3) int32.

    Args:
        segments: round the z axis, 3 or more.
        stacks: along the z axis, 1 or more.

    Raises:
        ShapeError: a count is too small, or no whole number.

    >>> faces(8, 2).shape
    (48, 3)
    """
    return rounds.faces(*can(segments, stacks))


def points(
    radii: ArrayLike = _RADII, height: Any = 1.0, segments: Any = 32, *, stacks: Any = 16
) -> NDArray[np.float32]:
    """The vertices, (V, 3) float32; the rows of the side crowd toward both ends like the parallels of a globe.

    Args:
        radii: at the bottom, half-way up and at the top, metres.
        height: along z, centred at the origin, metres.
        segments: round the z axis, 3 or more.
        stacks: along the z axis, 1 or more.

    Raises:
        ShapeError: a size is negative or not finite, a count is too small, or no quadric has these radii.

    >>> points((0, 1, 0), 2.0, 8, stacks=4).shape
    (81, 3)
    """
    bottom, _, top = _radii(radii)
    tall = length(height, "height")
    runs, _, round_ = can(segments, stacks)
    level = -np.cos(np.pi * np.arange(len(runs[1])) / (len(runs[1]) - 1))
    level[np.abs(level) < 1e-15] = 0.0
    c0, c1, c2 = _coefficients(radii)
    radius = np.sqrt(np.maximum(c0 + level * (c1 + level * c2), 0.0))
    radius[0], radius[-1] = bottom, top
    z = level * (tall / 2.0)
    ends = [0.0, bottom], [top, 0.0]
    return rounds.points(np.r_[ends[0], radius, ends[1]], np.r_[z[[0, 0]], z, z[[-1, -1]]], round_)


def uv(segments: Any = 32, stacks: Any = 16) -> NDArray[np.float32]:
    """Texture coordinates, (V, 2): the side unrolled, bottom and top as discs."""
    return rounds.uv(*can(segments, stacks), discs=(0, 2))


def weld(segments: Any = 32, stacks: Any = 16) -> NDArray[np.int32]:
    """For each vertex the lowest index of one at the same place, (V,)."""
    return rounds.weld(*can(segments, stacks))


def volume(radii: ArrayLike = _RADII, height: Any = 1.0) -> float:
    """Its content, m³: Simpson's rule is exact for it.

    >>> round(volume((0, 1, 0), 2.0), 6)  # a sphere
    4.18879
    """
    bottom, middle, top = _radii(radii)
    return np.pi / 6.0 * length(height, "height") * (bottom**2 + 4.0 * middle**2 + top**2)


def area(radii: ArrayLike = _RADII, height: Any = 1.0) -> float:
    """Its surface, m²; the side is integrated numerically, to about 1e-12 of it (Takahasi and Mori 1974).

    >>> round(area((0, 1, 0), 2.0), 6)  # a sphere
    12.566371
    """
    bottom, _, top = _radii(radii)
    half = length(height, "height") / 2.0
    c0, c1, c2 = _coefficients(radii)

    # At the waist the side may have an edge: there the strips are cut in two.
    waist = min(max(-c1 / (2.0 * c2), -1.0), 1.0) if c2 != 0.0 else 1.0
    side = 0.0
    for low, high in ((-1.0, waist), (waist, 1.0)):
        level = low + (high - low) * _SHARES
        square = np.maximum(c0 + level * (c1 + level * c2), 0.0)
        strips = np.sqrt(square * half * half + (c1 / 2.0 + c2 * level) ** 2)
        side += (high - low) * float(_WEIGHTS @ strips)
    return 2.0 * np.pi * side + np.pi * (bottom**2 + top**2)


def center_of_mass(radii: ArrayLike = _RADII, height: Any = 1.0) -> Floats:
    """On the axis, (3,); of one without content half-way up.

    >>> center_of_mass((1, 0.5, 0), 4.0).tolist()  # a cone
    [0.0, 0.0, -1.0]
    """
    c0, c1, c2 = _coefficients(radii)
    content = c0 + c2 / 3.0
    z = length(height, "height") / 2.0 * (c1 / 3.0) / content if content > 0.0 else 0.0
    return freeze(np.array([0.0, 0.0, z]))


def inertia(radii: ArrayLike = _RADII, height: Any = 1.0) -> Floats:
    """Inertia about the centre of mass for density 1, (3, 3): the sum of discs."""
    c0, c1, c2 = _coefficients(radii)
    half = length(height, "height") / 2.0
    # Integrals of f² and z² f over the height, f the squared radius.
    quartic = 2.0 * half * (c0 * c0 + (c1 * c1 + 2.0 * c0 * c2) / 3.0 + c2 * c2 / 5.0)
    spread = 2.0 * half**3 * (c0 / 3.0 + c2 / 5.0)
    round_ = np.pi / 2.0 * quartic
    z = float(center_of_mass(radii, height)[2])
    tilt = round_ / 2.0 + np.pi * spread - volume(radii, height) * z * z
    return freeze(np.diag([tilt, tilt, round_]))


def contains(points: ArrayLike, *, radii: ArrayLike = _RADII, height: Any = 1.0) -> NDArray[np.bool_]:
    """Whether points lie inside or on the surface, (N,).

    >>> contains([(0, 0, 0.5), (0.4, 0, 0)]).tolist()
    [True, False]
    """
    x, y, z = columns(points)
    half = length(height, "height") / 2.0
    c0, c1, c2 = _coefficients(radii)
    level = z / half if half > 0.0 else 0.0 * z
    return freeze((np.abs(z) <= half) & (x * x + y * y <= c0 + level * (c1 + level * c2)))


def intersect(
    origins: ArrayLike, directions: ArrayLike, *, radii: ArrayLike = _RADII, height: Any = 1.0
) -> tuple[Floats, Floats]:
    """Where rays first meet the surface: distance (N,) along the direction, inf where missed, and normal (N, 3).

    Raises:
        ShapeError: a ray or a size is not sound.

    >>> intersect([(3, 0, 0)], [(-1, 0, 0)])[0].tolist()
    [2.75]
    """
    lines = Lines.of(origins, directions)
    half = length(height, "height") / 2.0
    return lines.answer(*meet(lines, matrix(radii, height), between(lines, -half, half)))


def matrix(radii: ArrayLike = _RADII, height: Any = 1.0) -> Floats:
    """The symmetric Q, (4, 4), with (x, y, z, 1) Q (x, y, z, 1) = 0 on the side.

    >>> matrix((1, 1, 1), 1.0).diagonal().tolist()
    [1.0, 1.0, 0.0, -1.0]
    """
    c0, c1, c2 = _coefficients(radii)
    half = length(height, "height") / 2.0
    if half == 0.0:  # flat: between its two ends there is no height to tell the radii apart
        half, c1, c2 = 1.0, 0.0, 0.0
    q = np.diag([1.0, 1.0, -c2 / half**2, -c0])
    q[2, 3] = q[3, 2] = -c1 / (2.0 * half)
    return freeze(q + 0.0)


def can(segments: Any, stacks: Any) -> tuple[rounds.Runs, rounds.Poles, int]:
    """The runs of a bottom, a side and a top, its two poles, and the segments."""
    high = count(stacks, "stacks") + 1
    runs = ((0, 1), tuple(range(1, high + 1)), (high, high + 1))
    return rounds.profile(runs, (0, high + 1), count(segments, "segments", least=3))


def _radii(radii: ArrayLike) -> tuple[float, float, float]:
    bottom, middle, top = lengths(radii, "radii")
    if middle < abs(bottom - top) / 2.0:
        raise ShapeError(
            f"radii: expected a middle radius of at least {abs(bottom - top) / 2.0:g}, half the difference of bottom "
            f"and top, got {middle:g}"
        )
    return bottom, middle, top


def _coefficients(radii: ArrayLike) -> tuple[float, float, float]:
    """The squared radius by powers of the level, which is -1 at the bottom and 1 at the top."""
    bottom, middle, top = (radius * radius for radius in _radii(radii))
    return middle, (top - bottom) / 2.0, (top + bottom) / 2.0 - middle
