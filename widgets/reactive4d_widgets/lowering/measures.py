"""How far two values are apart, and how values follow one another: numbers, and rotations as quaternions."""

from dataclasses import dataclass

import numpy as np

from reactive4d_widgets.lowering.numerals import Array

__all__ = ["Measure", "Numbers", "Turns"]


@dataclass(frozen=True, slots=True)
class Measure:
    """A kind of values, and how far off they may be.

    Attributes:
        tolerance: largest error, in the unit of the values.
    """

    tolerance: float

    def aligned(self, values: Array) -> Array:
        """(n, c) values in the order of time, so that neighbours are near."""
        return values

    def error(self, a: Array, b: Array) -> float:
        """How far (n, c) values are from others at most."""
        return float(np.abs(a - b).max(initial=0.0))

    def steps(self, values: Array) -> Array:
        """(n - 1,) how far each of (n, c) values is from the one before."""
        return np.abs(np.diff(values, axis=0)).max(axis=1)


@dataclass(frozen=True, slots=True)
class Numbers(Measure):
    """Numbers, each by itself."""


@dataclass(frozen=True, slots=True)
class Turns(Measure):
    """Rotations as quaternions (n, 4) of any length but 0; the tolerance is an angle, radians."""

    def aligned(self, values: Array) -> Array:
        """Each with the sign that is nearer to the one before: q and -q are one rotation."""
        flips = np.sign(np.sum(values[1:] * values[:-1], axis=1))
        signs = np.cumprod(np.concatenate([[1.0], np.where(flips == 0.0, 1.0, flips)]))
        return values * signs[:, None]

    def error(self, a: Array, b: Array) -> float:
        """The largest angle between two of them."""
        return float(_angles(a, b).max(initial=0.0))

    def steps(self, values: Array) -> Array:
        """The angle from each to the next."""
        return _angles(values[:-1], values[1:])


def _angles(a: Array, b: Array) -> Array:
    a = a / np.maximum(np.linalg.norm(a, axis=1, keepdims=True), 1e-300)
    b = b / np.maximum(np.linalg.norm(b, axis=1, keepdims=True), 1e-300)
    # Of small angles the cosine tells nothing.
    apart = np.minimum(np.linalg.norm(a - b, axis=1), np.linalg.norm(a + b, axis=1))
    return 4.0 * np.arcsin(np.minimum(0.5 * apart, 1.0))
