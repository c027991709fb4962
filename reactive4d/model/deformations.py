"""Deformations as changes: angles in degrees, lengths in metres.

Each acts on the points as the changes before it left them, about the place where the object's origin is then, unless it
is given a `center`. With a `space`, another object, it acts in that object's coordinate system instead: then it is a
world-space change, and its effect depends on where the object is in that space.
"""

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry import lattices, transforms
from reactive4d.geometry.deformations import bends, skews, tapers, twists, waves
from reactive4d.model.changes import Deformation
from reactive4d.model.settings import Choice, Flag, Float, Reference, Vector

if TYPE_CHECKING:
    from reactive4d.geometry.deformations.steps import Step

__all__ = ["Bend", "FreeForm", "Ripple", "Skew", "Stepped", "Taper", "Twist", "Wave", "XForm"]

Array = NDArray[np.float64]
MAY_BE_OPEN = "where the points end, if it is not given"


class Stepped(Deformation):
    """A deformation that is one of the kernels' steps: its function `step` answers it."""

    __slots__ = ()

    operation = "step"
    is_stepped = True


def _axis() -> Any:
    return Vector("z", is_direction=True, doc='"x", "y", "z" or a direction')


def _center() -> Any:
    return Vector(unit="m", doc="the point about which it acts; the object's position if it is not given")


def _limit(which: str) -> Any:
    return Float(unit="m", doc=f"the {which} limit along the axis, from the centre; {MAY_BE_OPEN}")


def _space() -> Any:
    return Reference(channel="matrix", doc="the object in whose coordinate system it acts; the world's if not given")


def _about(center: Array | None, position: Array, space: Array | None) -> dict[str, Any]:
    """The centre and the frame of a step."""
    if space is None:
        return {"center": position if center is None else center}
    return {"center": transforms.ORIGIN if center is None else center, "frame": space}


class Bend(Stepped):
    """Bend, as a bar is bent over a knee (Barr 1984).

    >>> import reactive4d as r4
    >>> bar = r4.Box(size=(0.1, 0.1, 2), segments=(1, 1, 16))
    >>> bend = bar.apply(r4.Bend(90))
    >>> bend.angle = r4.keys({0: 0, 2: 90})
    """

    __slots__ = ()

    positional = 1
    angle = Float(unit="deg", doc="over the whole extent along the axis, or between the limits")
    direction = Float(0.0, unit="deg", doc="round the axis; 0 bends towards +x for the z axis")
    axis = _axis()
    center = _center()
    lower = _limit("lower")
    upper = _limit("upper")
    space = _space()

    @staticmethod
    def step(
        angle: float,
        direction: float,
        axis: Array,
        center: Any,
        lower: Any,
        upper: Any,
        space: Any,
        position: Array,
    ) -> "Step":
        """The kernel's step."""
        about = _about(center, position, space)
        return bends.Bend(math.radians(angle), math.radians(direction), axis, lower=lower, upper=upper, **about)


class Twist(Stepped):
    """Twist about an axis; it keeps the volume (Barr 1984).

    >>> import reactive4d as r4
    >>> column = r4.Box(size=(1, 1, 4), segments=(8, 8, 48))
    >>> _ = column.apply(r4.Twist(r4.keys({0: 0, 4: 180})))
    >>> column.volume.at(0.0), round(column.volume.at(4.0), 1)
    (4.0, 4.0)
    """

    __slots__ = ()

    angle = Float(unit="deg", doc="over the whole extent along the axis, or between the limits")
    axis = _axis()
    bias = Float(0.0, low=-10.0, high=10.0, doc="0 twists evenly, above 0 more towards the ends, below 0 at the centre")
    center = _center()
    lower = _limit("lower")
    upper = _limit("upper")
    space = _space()

    @staticmethod
    def step(
        angle: float, axis: Array, bias: float, center: Any, lower: Any, upper: Any, space: Any, position: Array
    ) -> "Step":
        """The kernel's step."""
        about = _about(center, position, space)
        return twists.Twist(math.radians(angle), axis, bias=bias, lower=lower, upper=upper, **about)


class Taper(Stepped):
    """Make sections along an axis wider or narrower (Barr 1984).

    >>> import reactive4d as r4
    >>> spire = r4.Box(size=(1, 1, 2), segments=(1, 1, 16))
    >>> _ = spire.apply(r4.Taper(-0.5))
    """

    __slots__ = ()

    amount = Float(doc="by how much of itself the section grows over the extent, or between the limits")
    curve = Float(0.0, doc="how much the outline bulges between the ends")
    axis = _axis()
    effect = Choice("both", options=("both", "x", "y", "z"), doc="which coordinate across the axis is scaled")
    is_symmetric = Flag(False, doc="whether it grows from the centre to both sides")
    center = _center()
    lower = _limit("lower")
    upper = _limit("upper")
    space = _space()

    @staticmethod
    def step(
        amount: float,
        curve: float,
        axis: Array,
        effect: str,
        is_symmetric: bool,
        center: Any,
        lower: Any,
        upper: Any,
        space: Any,
        position: Array,
    ) -> "Step":
        """The kernel's step."""
        only = None if effect == "both" else effect
        about = _about(center, position, space)
        return tapers.Taper(
            amount, curve, axis, effect=only, is_symmetric=is_symmetric, lower=lower, upper=upper, **about
        )


class Skew(Stepped):
    """Shift sections along an axis sideways; it keeps the volume.

    >>> import reactive4d as r4
    >>> box = r4.Box(size=(1, 1, 2), segments=(1, 1, 4))
    >>> _ = box.apply(r4.Skew(1.0))
    >>> round(box.volume.at(0.0), 5)
    2.0
    """

    __slots__ = ()

    amount = Float(unit="m", doc="how far over the whole extent along the axis, or between the limits")
    direction = Float(0.0, unit="deg", doc="round the axis; 0 shifts towards +x for the z axis")
    axis = _axis()
    center = _center()
    lower = _limit("lower")
    upper = _limit("upper")
    space = _space()

    @staticmethod
    def step(
        amount: float, direction: float, axis: Array, center: Any, lower: Any, upper: Any, space: Any, position: Array
    ) -> "Step":
        """The kernel's step."""
        about = _about(center, position, space)
        return skews.Skew(amount, math.radians(direction), axis, lower=lower, upper=upper, **about)


class Wave(Stepped):
    """Lift points along an axis by straight waves that run across it.

    >>> import reactive4d as r4
    >>> sheet = r4.Plane(size=(4, 4), segments=(32, 32))
    >>> _ = sheet.apply(r4.Wave(0.1, wavelength=1, phase=360 * r4.time))
    """

    __slots__ = ()

    amplitude = Float(unit="m", doc="of the wave along x (for the z axis)")
    wavelength = Float(1.0, low=1e-9, unit="m", doc="from crest to crest")
    phase = Float(0.0, unit="deg", doc="the wave runs forward as it grows")
    second = Float(0.0, unit="m", doc="the amplitude of a second wave, along y (for the z axis)")
    decay = Float(0.0, low=0.0, unit="1/m", doc="how fast it dies down with the distance")
    axis = _axis()
    direction = Float(0.0, unit="deg", doc="by which the ways of the waves are turned round the axis")
    center = _center()
    space = _space()

    @staticmethod
    def step(
        amplitude: float,
        wavelength: float,
        phase: float,
        second: float,
        decay: float,
        axis: Array,
        direction: float,
        center: Any,
        space: Any,
        position: Array,
    ) -> "Step":
        """The kernel's step."""
        return waves.Wave(
            amplitude,
            wavelength,
            math.radians(phase),
            second=second,
            decay=decay,
            axis=axis,  # pyright: ignore[reportArgumentType]
            direction=math.radians(direction),
            **_about(center, position, space),
        )


class Ripple(Stepped):
    """Lift points along an axis by waves that run in rings about it.

    >>> import reactive4d as r4
    >>> pond = r4.Plane(size=(4, 4), segments=(32, 32))
    >>> _ = pond.apply(r4.Ripple(0.1, wavelength=0.5, phase=360 * r4.time, decay=1))
    """

    __slots__ = ()

    amplitude = Float(unit="m", doc="of the rings")
    wavelength = Float(1.0, low=1e-9, unit="m", doc="from crest to crest")
    phase = Float(0.0, unit="deg", doc="the rings widen as it grows")
    second = Float(unit="m", doc="the amplitude across the first direction; the same if it is not given")
    decay = Float(0.0, low=0.0, unit="1/m", doc="how fast it dies down with the distance")
    axis = _axis()
    direction = Float(0.0, unit="deg", doc="by which the two directions are turned round the axis")
    center = _center()
    space = _space()

    @staticmethod
    def step(
        amplitude: float,
        wavelength: float,
        phase: float,
        second: Any,
        decay: float,
        axis: Array,
        direction: float,
        center: Any,
        space: Any,
        position: Array,
    ) -> "Step":
        """The kernel's step."""
        return waves.Ripple(
            amplitude,
            wavelength,
            math.radians(phase),
            second=second,
            decay=decay,
            axis=axis,  # pyright: ignore[reportArgumentType]
            direction=math.radians(direction),
            **_about(center, position, space),
        )


class FreeForm(Stepped):
    """Deform space by a lattice of control points, of any size (Sederberg and Parry 1986).

    The lattice rests where its points lie evenly in the box from `lower` to `upper`; `lattices.lattice` of the
    geometry gives such points.

    >>> import reactive4d as r4
    >>> from reactive4d.geometry import lattices
    >>> ball = r4.Sphere()
    >>> rest = lattices.lattice((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5), (3, 3, 3))
    >>> ffd = ball.apply(r4.FreeForm(rest, lower=(-0.5, -0.5, -0.5), upper=(0.5, 0.5, 0.5)))
    """

    __slots__ = ()

    script = "ffd"
    points = Vector(size=(None, None, None, 3), unit="m", doc="(L, M, N, 3), the control points")
    lower = Vector((-0.5, -0.5, -0.5), unit="m", doc="the lowest corner of the box at rest")
    upper = Vector((0.5, 0.5, 0.5), unit="m", doc="the highest corner of the box at rest")
    space = _space()

    @staticmethod
    def step(points: Array, lower: Array, upper: Array, space: Any) -> "Step":
        """The kernel's step."""
        return lattices.FreeForm(points, lower, upper, frame=space)  # pyright: ignore[reportArgumentType]


class XForm(Deformation):
    """A transform of the points themselves, all or the selected ones, in the middle of the list.

    Later changes see the points where it put them, and the object's matrix begins anew.

    >>> import reactive4d as r4
    >>> box = r4.Box()
    >>> _ = box.apply(r4.XForm(offset=(0, 0, 1)))
    >>> box.bounds.at(0.0)[:, 2]
    array([0.5, 1.5])
    """

    __slots__ = ()

    script = "xform"
    positional = 0
    offset = Vector((0.0, 0.0, 0.0), unit="m", doc="how far it moves")
    angle = Float(0.0, unit="deg", doc="how far it turns")
    axis = _axis()
    factor = Vector((1.0, 1.0, 1.0), spreads=True, doc="by how much it scales")
    center = _center()

    @staticmethod
    def deform(
        offset: Array, angle: float, axis: Array, factor: Array, center: Any, points: Any, position: Array
    ) -> Any:
        """It scales, turns and moves, in this order."""
        about = position if center is None else center
        matrix = transforms.rotation(math.radians(angle), axis, center=about) @ transforms.scaling(factor, center=about)
        return transforms.transform_points(transforms.translation(offset) @ matrix, points)
