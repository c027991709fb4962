"""Waves and ripples: sine waves that lift space along an axis, in straight or in round fronts."""

import math
from dataclasses import KW_ONLY, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError, hint
from reactive4d.geometry.transforms import ORIGIN, Axis, Matrix, Triple

from .frames import space
from .limits import Column, Extent, scalars
from .steps import Kernel, Step

__all__ = ["Ripple", "Wave"]


def _check(wavelength: float) -> None:
    if not wavelength > 0.0:
        raise hint(ShapeError(f"wavelength: {wavelength} is not above 0"), "metres from crest to crest")


class _Swing:
    """amplitude · exp(-decay · |s|) · sin(2π s / wavelength - phase), of a column or with its slope."""

    __slots__ = ("_decay", "_number", "_phase", "decay", "is_damped", "number", "phase")

    def __init__(self, wavelength: float, *, phase: float, decay: float, dtype: Any) -> None:
        self.number = 2.0 * math.pi / wavelength
        self.phase = math.remainder(phase, 2.0 * math.pi)  # While it grows with time, float32 keeps its digits.
        self.decay = decay
        self.is_damped = decay != 0.0
        self._number, self._phase, self._decay = scalars(dtype, self.number, self.phase, -decay)

    def write(self, distance: Column, out: Column, free: Column) -> None:
        """Amplitude 1, to `out`."""
        np.multiply(distance, self._number, out)
        if self.phase:
            np.subtract(out, self._phase, out)
        np.sin(out, out)
        if self.is_damped:
            np.abs(distance, free)
            np.multiply(free, self._decay, free)
            np.exp(free, free)
            np.multiply(out, free, out)

    def slope(self, distance: Column) -> tuple[Column, Column]:
        """The swing of amplitude 1 and its derivative; at 0, where |s| has a kink, that of the undamped wave."""
        angle = self.number * distance - self.phase
        damp = np.exp(-self.decay * np.abs(distance))
        swing = damp * np.sin(angle)
        return swing, self.number * damp * np.cos(angle) - self.decay * np.sign(distance) * swing


@dataclass(frozen=True, slots=True, eq=False)
class Wave(Step):
    """Lifts space along an axis by straight waves that run across it.

    With s metres from the centre along the way of the wave, a point is lifted by
    amplitude · exp(-decay · |s|) · sin(2π s / wavelength - phase).

    Args:
        amplitude: metres, of the wave that runs along local X (x for 'z', y for 'x', z for 'y').
        wavelength: metres.
        phase: radians; the wave moves forward as it grows, by a wavelength in 2π.
        second: metres, of a second wave of the same length, phase and decay that runs along local Y.
        decay: per metre of distance from the centre; 0 does not decay.
        axis: along which points are lifted.
        direction: radians by which the ways of the waves are turned round the axis.
        center: (3,), from where distances are counted.
        frame: in whose space the wave acts, (4, 4); None is that of the points.

    Raises:
        ShapeError: the wavelength is not above 0.

    >>> Wave(0.5, 4.0).map(np.float32([[0, 0, 0], [1, 0, 0], [3, 0, 0]]), (0, 0)).round(4) + 0
    array([[ 0. ,  0. ,  0. ],
           [ 1. ,  0. ,  0.5],
           [ 3. ,  0. , -0.5]], dtype=float32)
    """

    amplitude: float
    wavelength: float
    phase: float = 0.0
    _: KW_ONLY
    second: float = 0.0
    decay: float = 0.0
    axis: Axis = "z"
    direction: float = 0.0
    center: Triple = ORIGIN
    frame: Matrix | None = None

    def __post_init__(self) -> None:
        _check(self.wavelength)

    @property
    def space(self) -> Matrix:
        """Local +Z along the axis, turned by the direction."""
        return space(self.axis, center=self.center, frame=self.frame, turn=self.direction)

    @property
    def keeps(self) -> tuple[bool, bool, bool]:
        """Points are lifted straight."""
        return (True, True, False)

    def _swing(self, dtype: Any) -> _Swing:
        return _Swing(self.wavelength, phase=self.phase, decay=self.decay, dtype=dtype)

    def bind(self, extent: Extent, dtype: Any) -> Kernel | None:
        """The kernel, as `Step.bind` says."""
        if not (self.amplitude or self.second):
            return None
        swing = self._swing(dtype)
        first, second = scalars(dtype, self.amplitude, self.second)

        def lift(x: Column, y: Column, z: Column, free: list[Column]) -> None:
            height = free[0]
            if self.amplitude:
                swing.write(x, height, free[1])
                np.multiply(height, first, height)
                np.add(z, height, z)
            if self.second:
                swing.write(y, height, free[1])
                np.multiply(height, second, height)
                np.add(z, height, z)

        return lift

    def gradient(self, points: NDArray[Any], extent: Extent) -> NDArray[Any]:
        """The local derivative, as `Step.gradient` says."""
        slopes = np.zeros((len(points), 3, 3), points.dtype)
        slopes[:] = np.eye(3)
        swing = self._swing(points.dtype)
        slopes[:, 2, 0] = self.amplitude * swing.slope(points[:, 0])[1]
        slopes[:, 2, 1] = self.second * swing.slope(points[:, 1])[1]
        return slopes


@dataclass(frozen=True, slots=True, eq=False)
class Ripple(Step):
    """Lifts space along an axis by round waves that run outwards from it, as from a stone in a pond.

    With r metres from the axis, a point is lifted by amplitude · exp(-decay · r) · sin(2π r / wavelength - phase).

    Args:
        amplitude: metres, along local X (x for 'z', y for 'x', z for 'y').
        wavelength: metres.
        phase: radians; the wave runs outwards as it grows.
        second: metres, along local Y; in between, with local X = r cos a, it is amplitude cos² a + second sin² a,
            and their mean at r = 0. None is the same as `amplitude`: round.
        decay: per metre of distance from the axis; 0 does not decay.
        axis: from which the wave runs, and along which points are lifted.
        direction: radians by which local X and Y are turned round the axis.
        center: (3,), on the axis.
        frame: in whose space the ripple acts, (4, 4); None is that of the points.

    Raises:
        ShapeError: the wavelength is not above 0.

    >>> Ripple(0.5, 20.0).map(np.float32([[0, 0, 0], [3, 4, 0], [0, 0, 1]]), (0, 0)).round(4) + 0
    array([[0. , 0. , 0. ],
           [3. , 4. , 0.5],
           [0. , 0. , 1. ]], dtype=float32)
    """

    amplitude: float
    wavelength: float
    phase: float = 0.0
    _: KW_ONLY
    second: float | None = None
    decay: float = 0.0
    axis: Axis = "z"
    direction: float = 0.0
    center: Triple = ORIGIN
    frame: Matrix | None = None

    def __post_init__(self) -> None:
        _check(self.wavelength)

    @property
    def space(self) -> Matrix:
        """Local +Z along the axis, turned by the direction."""
        return space(self.axis, center=self.center, frame=self.frame, turn=self.direction)

    @property
    def keeps(self) -> tuple[bool, bool, bool]:
        """Points are lifted straight."""
        return (True, True, False)

    def _swing(self, dtype: Any) -> _Swing:
        return _Swing(self.wavelength, phase=self.phase, decay=self.decay, dtype=dtype)

    def _parts(self) -> tuple[float, float]:
        """The mean of the two amplitudes, and half of their difference."""
        second = self.amplitude if self.second is None else self.second
        return 0.5 * (self.amplitude + second), 0.5 * (self.amplitude - second)

    def bind(self, extent: Extent, dtype: Any) -> Kernel | None:
        """The kernel, as `Step.bind` says."""
        mean_value, half_value = self._parts()
        if not (mean_value or half_value):
            return None
        swing = self._swing(dtype)
        mean, half, tiny = scalars(dtype, mean_value, half_value, np.finfo(dtype).tiny)

        def lift(x: Column, y: Column, z: Column, free: list[Column]) -> None:
            distance, square, height, share = free[:4]
            np.multiply(x, x, distance)
            np.multiply(y, y, square)
            if half_value:
                np.subtract(distance, square, share)
            np.add(distance, square, distance)
            if half_value:
                # cos² a - sin² a, and 0 at r = 0.
                np.add(distance, tiny, square)
                np.divide(share, square, share)
                np.multiply(share, half, share)
                np.add(share, mean, share)
            np.sqrt(distance, distance)
            swing.write(distance, height, square)
            np.multiply(height, share if half_value else mean, height)
            np.add(z, height, z)

        return lift

    def gradient(self, points: NDArray[Any], extent: Extent) -> NDArray[Any]:
        """The local derivative, as `Step.gradient` says."""
        slopes = np.zeros((len(points), 3, 3), points.dtype)
        slopes[:] = np.eye(3)
        mean, half = self._parts()
        x, y, _ = points.T
        distance = np.sqrt(x * x + y * y)
        swing, slope = self._swing(points.dtype).slope(distance)
        apart = np.where(distance > 0.0, distance, 1.0)
        c, s = x / apart, y / apart  # Both 0 on the axis itself: its cone's tip has no slope.
        share = mean + half * (c * c - s * s)
        round_ = -4.0 * half * c * s / apart * swing  # Per metre round the axis, counter-clockwise.
        slopes[:, 2, 0] = share * slope * c - round_ * s
        slopes[:, 2, 1] = share * slope * s + round_ * c
        return slopes
