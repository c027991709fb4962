"""Superquadrics as functions that are 0 on the surface, negative inside, and grow by 1 from there to twice the size.

An ellipsoid's function is a norm of norms, so it is convex where both exponents are at most 2: Newton's method from
outside then meets the first root, or the place from which the function grows. Otherwise (toroids, pinched stars) the
ray is walked in steps that cannot leap over the surface, or are a 256th of what it crosses of the box around.
"""

from dataclasses import dataclass
from typing import Any, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry.brackets import root
from reactive4d.geometry.forms import within
from reactive4d.geometry.rays import Lines

__all__ = ["Gauge", "meet"]

Floats: TypeAlias = NDArray[np.float64]

_STEPS = 256
_SURE = 1e-12  # of the size: a value that counts as the surface


@final
@dataclass(frozen=True, slots=True)
class Gauge:
    """The function of one superquadric.

    Attributes:
        half: (3,), half extents of the ellipsoid or of the toroid's section, more than 0.
        north: exponent from pole to pole, or of the toroid's section.
        east: exponent round the z axis.
        ring: the toroid's ring radius in section radii, 0 for an ellipsoid.
    """

    half: Floats
    north: float
    east: float
    ring: float

    def value(self, points: Floats) -> Floats:
        """The function at points (3, N)."""
        x, y, z = np.abs(points) / self.half[:, None]
        return _norm(np.abs(_norm(x, y, self.east) - self.ring), z, self.north) - 1.0

    def slope(self, points: Floats) -> tuple[Floats, Floats]:
        """The function (N,) and its gradient (3, N)."""
        x, y, z = np.abs(points) / self.half[:, None]
        around = _norm(x, y, self.east)
        across = np.abs(around - self.ring)
        size = _norm(across, z, self.north)
        by_around = np.copysign(_share(across, size, self.north), around - self.ring)
        gradient = np.stack(
            [
                by_around * _share(x, around, self.east),
                by_around * _share(y, around, self.east),
                _share(z, size, self.north),
            ]
        )
        return size - 1.0, np.copysign(gradient, gradient * points) / self.half[:, None]

    def pace(self, unit: Floats) -> Floats:
        """How fast the function can grow along directions (3, N), per metre; inf where exponents are above 2."""
        if max(self.north, self.east) > 2.0:
            return np.full_like(unit[0], np.inf)
        x, y, z = np.abs(unit) / self.half[:, None]
        return _norm(_norm(x, y, self.east), z, self.north)


def meet(lines: Lines, gauge: Gauge) -> tuple[Floats, Floats]:
    """Where rays first meet the solid: places (N,), inf where they miss, and outward gradients (3, N)."""
    clip = within(lines, gauge.half * np.array([1.0 + gauge.ring, 1.0 + gauge.ring, 1.0]) * (1.0 + 1e-9))
    low, high = np.maximum(clip.enter, lines.start), clip.leave
    place = np.full(len(lines), np.inf)
    tried = np.flatnonzero(low <= high)
    if len(tried):
        convex = gauge.ring == 0.0 and max(gauge.north, gauge.east) <= 2.0
        find = _newton if convex else _walk
        place[tried] = find(lines.some(tried), gauge, low[tried], high[tried])
    gradient = np.zeros((3, len(lines)))
    met = np.flatnonzero(np.isfinite(place))
    gradient[:, met] = gauge.slope(lines.some(met).at(place[met]))[1]
    return place, gradient


def _newton(lines: Lines, gauge: Gauge, low: Floats, high: Floats) -> Floats:
    """The first root of convex functions, by steps that all stay on one side of it."""
    inside = gauge.value(lines.at(low)) <= 0.0
    # From inside the far root is met by coming back from beyond it.
    way = np.where(inside, -1.0, 1.0)
    at, stop = np.where(inside, high, low), np.where(inside, low, high)
    found = np.full(len(lines), np.inf)
    open_ = np.arange(len(lines))
    for _ in range(100):
        if not len(open_):
            break
        some = lines.some(open_)
        value, gradient = gauge.slope(some.at(at[open_]))
        along = (gradient * some.unit).sum(axis=0) * way[open_]
        met = value <= 0.0
        falls = along < 0.0
        step = np.where(falls, -value / np.where(falls, along, -1.0), np.inf)
        close = ~met & falls & (step <= _SURE * (np.abs(at[open_]) + gauge.half.max()) * 0.01)
        met |= close
        after = at[open_] + way[open_] * np.where(np.isfinite(step), step, 0.0)
        found[open_[met]] = at[open_[met]]
        lost = ~met & (~falls | ((after - stop[open_]) * way[open_] > 0.0))
        at[open_] = after
        open_ = open_[~met & ~lost]
    # What is left creeps along a graze.
    if len(open_):
        there = np.abs(gauge.value(lines.some(open_).at(at[open_]))) < 1e-9
        found[open_[there]] = at[open_[there]]
    return np.maximum(found, low)


def _walk(lines: Lines, gauge: Gauge, low: Floats, high: Floats) -> Floats:
    """The first change of sign of any of these functions."""
    least = (high - low) / _STEPS
    pace = gauge.pace(lines.unit)
    at = low.copy()
    value = gauge.value(lines.at(at))
    inside = value <= 0.0
    found = np.full(len(lines), np.inf)
    ends = at.copy()
    crossed = np.zeros(len(lines), np.bool_)
    open_ = np.flatnonzero(low < high)
    for _ in range(_STEPS + 1):
        if not len(open_):
            break
        step = np.maximum(np.abs(value[open_]) / pace[open_], least[open_])
        after = np.minimum(at[open_] + step, high[open_])
        value[open_] = gauge.value(lines.some(open_).at(after))
        changed = (value[open_] <= 0.0) != inside[open_]
        crossed[open_[changed]] = True
        ends[open_] = after
        on = ~changed & (after < high[open_])
        at[open_[on]] = after[on]
        open_ = open_[on]
    met = np.flatnonzero(crossed)
    some = lines.some(met)

    def along(place: Floats, which: Any) -> tuple[Floats, Floats]:
        part = some.some(which)
        value, gradient = gauge.slope(part.at(place))
        return value, (gradient * part.unit).sum(axis=0)

    found[met] = root(along, at[met], ends[met], scale=float(gauge.half.max()))
    return found


def _norm(a: Floats, b: Floats, exponent: float) -> Floats:
    """(a^p + b^p)^(1/p) with p = 2 / exponent, of numbers that are not negative, without overflow."""
    if exponent == 1.0:
        return np.sqrt(a * a + b * b)
    large = np.maximum(a, b)
    share = np.minimum(a, b) / np.where(large > 0.0, large, 1.0)
    with np.errstate(under="ignore"):
        return large * (1.0 + share ** (2.0 / exponent)) ** (exponent / 2.0)


def _share(a: Floats, norm: Floats, exponent: float) -> Floats:
    """The derivative of that norm by a, (a / norm)^(p - 1), at most 1e12 where it has none."""
    share = a / np.where(norm > 0.0, norm, 1.0)
    if exponent == 1.0:
        return share
    power = 2.0 / exponent - 1.0
    if power < 0.0:
        share = np.maximum(share, 1e-12 ** (-1.0 / power))
    with np.errstate(under="ignore"):
        return share**power
