"""Transforms as changes: angles in degrees, lengths in metres, about the world's axes and, by default, its origin."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError
from reactive4d.geometry import transforms
from reactive4d.model.changes import Transform
from reactive4d.model.settings import Choice, Float, Held, Reference, Vector
from reactive4d.signals.rotations import Rotation

__all__ = ["LookAt", "Matrix", "Mirror", "Orient", "Rotate", "Scale", "Shear", "Translate"]

Array = NDArray[np.float64]


class Translate(Transform):
    """Move by an offset.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere()
    >>> slide = ball.apply(r4.Translate((1, 0, 0)))
    >>> slide.offset = r4.keys({0: (0, 0, 0), 2: (4, 0, 0)})
    >>> ball.position.at(1.0)
    array([2., 0., 0.])
    """

    __slots__ = ()

    offset = Vector(unit="m", doc="how far along x, y and z")

    @staticmethod
    def matrix(offset: Array) -> Array:
        """(4, 4)."""
        return transforms.translation(offset)


class Rotate(Transform):
    """Turn by an angle about an axis through a point.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere()
    >>> _ = ball.translate((1, 0, 0))
    >>> _ = ball.apply(r4.Rotate(90, axis="z"))
    >>> ball.position.at(0.0).round(6) + 0.0
    array([0., 1., 0.])
    """

    __slots__ = ()

    angle = Float(unit="deg", doc="counter-clockwise, seen from the tip of the axis")
    axis = Vector("z", is_direction=True, doc='"x", "y", "z" or a direction')
    center = Vector((0.0, 0.0, 0.0), unit="m", doc="a point on the axis")

    @staticmethod
    def matrix(angle: float, axis: Array, center: Array) -> Array:
        """(4, 4)."""
        return transforms.rotation(math.radians(angle), axis, center=center)


class Orient(Transform):
    """Turn by a `Rotation`, whose keys go the shortest way on the sphere.

    >>> import reactive4d as r4
    >>> box = r4.Box()
    >>> _ = box.apply(r4.Orient(r4.Rotation.from_axis_angle("z", 90)))
    >>> box.matrix.at(0.0)[0].round(6) + 0.0
    array([ 0., -1.,  0.,  0.])
    """

    __slots__ = ()

    rotation = Held(accept=lambda value: _rotation(value), doc="a Rotation")
    center = Vector((0.0, 0.0, 0.0), unit="m", doc="the point that stays")

    @staticmethod
    def matrix(rotation: Any, center: Array) -> Array:
        """(4, 4)."""
        return transforms.rotation_about(_rotation(rotation).as_quaternion(), center=center)


def _rotation(value: Any) -> Rotation:
    if not isinstance(value, Rotation):
        raise ShapeError(f"Orient.rotation: expected a Rotation, got {value!r}")
    return value


class Scale(Transform):
    """Scale by a number, or along x, y and z by three.

    >>> import reactive4d as r4
    >>> box = r4.Box()
    >>> _ = box.apply(r4.Scale((1, 2, 3)))
    >>> box.volume.at(0.0)
    6.0
    """

    __slots__ = ()

    factor = Vector(spreads=True, doc="one number, or three")
    center = Vector((0.0, 0.0, 0.0), unit="m", doc="the point that stays")

    @staticmethod
    def matrix(factor: Array, center: Array) -> Array:
        """(4, 4)."""
        return transforms.scaling(factor, center=center)


class Shear(Transform):
    """Shift points along two axes in proportion to where they are along the third.

    >>> import reactive4d as r4
    >>> box = r4.Box()
    >>> _ = box.apply(r4.Shear((1, 0, 0), axis="z"))
    >>> box.volume.at(0.0)
    1.0
    """

    __slots__ = ()

    amount = Vector(doc="how far, per metre along the axis; what of it lies along the axis does not count")
    axis = Vector("z", is_direction=True, doc="across the sheets that slide")
    center = Vector((0.0, 0.0, 0.0), unit="m", doc="a point that stays")

    @staticmethod
    def matrix(amount: Array, axis: Array, center: Array) -> Array:
        """(4, 4)."""
        return transforms.shearing(amount, axis, center=center)


class Mirror(Transform):
    """Reflect in a plane.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere()
    >>> _ = ball.translate((1, 0, 0))
    >>> _ = ball.apply(r4.Mirror("x"))
    >>> ball.position.at(0.0)
    array([-1.,  0.,  0.])
    """

    __slots__ = ()

    normal = Vector(is_direction=True, doc="of the plane")
    center = Vector((0.0, 0.0, 0.0), unit="m", doc="a point in the plane")

    @staticmethod
    def matrix(normal: Array, center: Array) -> Array:
        """(4, 4)."""
        return transforms.mirroring(normal, center=center)


class Matrix(Transform):
    """Multiply by an arbitrary affine matrix.

    >>> import reactive4d as r4
    >>> import numpy as np
    >>> box = r4.Box()
    >>> _ = box.apply(r4.Matrix(np.diag([1, 1, 4, 1])))
    >>> box.volume.at(0.0)
    4.0
    """

    __slots__ = ()

    value = Vector(size=(4, 4), doc="its last row is (0, 0, 0, 1)")

    @staticmethod
    def matrix(value: Array) -> Array:
        """(4, 4)."""
        if tuple(value[3]) != (0.0, 0.0, 0.0, 1.0):
            raise ShapeError(f"Matrix.value: expected the last row to be (0, 0, 0, 1), got {tuple(value[3].tolist())}")
        return value


class LookAt(Transform):
    """Turn about one's own position until one looks at a target.

    >>> import reactive4d as r4
    >>> fly, eye = r4.Sphere(), r4.Sphere()
    >>> _ = fly.translate(r4.vec(r4.time, 3, 0))
    >>> _ = eye.apply(r4.LookAt(fly.position))
    >>> eye.matrix.at(0.0)[:3, :3] @ (0, 0, -1)
    array([0., 1., 0.])
    """

    __slots__ = ()

    target = Vector(unit="m", doc="where it looks")
    up = Vector("z", is_direction=True, doc="which way is up")
    forward = Choice("-z", options=("x", "-x", "y", "-y", "z", "-z"), doc="the axis of the object that looks")

    @staticmethod
    def matrix(target: Array, up: Array, forward: str, before: Array, position: Array) -> Array:
        """(4, 4), about `position`: it undoes the turns before it, and keeps what they scaled."""
        turn = transforms.look_at(position, target, up, forward=forward)[:3, :3] @ transforms.turned(before[:3, :3]).T
        matrix = np.eye(4)
        matrix[:3, :3] = turn
        matrix[:3, 3] = position - turn @ position
        return matrix


class LinkedXForm(Transform):
    """Move as another object does, in its coordinate system.

    >>> import reactive4d as r4
    >>> arm, hand = r4.Box(), r4.Sphere()
    >>> _ = hand.translate((1, 0, 0))
    >>> _ = hand.apply(r4.LinkedXForm(arm))
    >>> _ = arm.rotate(r4.keys({0: 0, 1: 90}))
    >>> hand.position.at(1.0).round(6) + 0.0
    array([0., 1., 0.])
    """

    __slots__ = ()

    script = "linked_xform"
    target = Reference(channel="matrix", doc="the object whose coordinate system it is")

    @staticmethod
    def matrix(target: Array | None) -> Array:
        """(4, 4)."""
        return transforms.IDENTITY if target is None else target
