"""What a type checker knows: `pyright tests/model/test_typing.py` checks the claims that a run cannot."""

from typing import assert_type

import numpy as np
import pytest
from numpy.typing import NDArray

import reactive4d as r4
from reactive4d.model.attributes import Attribute, Part
from reactive4d.model.gates import Gate

Array = NDArray[np.float64]


class Squash(r4.Deformation):
    amount = r4.Float(1.0, low=0.0)

    @staticmethod
    def deform(amount: float, points: NDArray[np.float32]) -> NDArray[np.float32]:
        return points * np.float32(amount)


class Pyramid(r4.Object):
    width = r4.Float(1.0, low=0.0)
    height = r4.Float(1.0, low=0.0)
    table = r4.Table(
        points=lambda width, height: [(0, 0, 0), (width, 0, 0), (0, width, 0), (0, 0, height)],
        faces=lambda: [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)],
        volume=lambda width, height: width**2 * height / 6,
    )


def test_settings_are_declarations_on_the_class_and_signals_on_the_object():
    """A setting is its declaration on the class and a signal on an object."""
    ball, box = r4.Sphere(radius=2), r4.Box()
    assert assert_type(r4.Sphere.radius, r4.Float).name == "radius"
    assert isinstance(assert_type(ball.radius, Attribute[float]), Attribute)
    assert assert_type(ball.radius.at(0.0), float) == 2.0
    assert assert_type(box.size.at(0.0), Array).shape == (3,)
    assert assert_type(ball.extend(), r4.Sphere).radius.at(0.0) == 2.0


def test_what_is_read_is_a_signal_after_an_assignment_too():
    """What is read is a signal, also right after a constant was assigned."""
    ball, box, light = r4.Sphere(), r4.Box(), r4.Light("spot")
    ball.radius = 3
    assert assert_type(ball.radius, Attribute[float]).at(0.0) == 3.0
    ball.radius = r4.time * 2
    assert assert_type(ball.radius, Attribute[float]).at(2.0) == 4.0
    ball.radius = r4.keys({0: 0.0, 2: 3.0})
    ball.color = "red"
    assert assert_type(ball.color, Attribute[Array]).at(0.0)[0] == 1.0
    ball.visible = r4.keys({0: 0, 2: 1}, interpolation="step")
    assert assert_type(ball.visible.at(2.0), bool)
    box.size = (1, r4.time, 2)
    box.size = np.ones(3)
    box.size = 2
    assert assert_type(box.size, Attribute[Array]).at(0.0).tolist() == [2.0, 2.0, 2.0]
    light.light_type = "point"
    assert assert_type(light.light_type.at(0.0), str) == "point"


def test_attributes_of_changes_are_parts_and_gates():
    """The attributes of a change are signals of their types, and `enabled` is a gate."""
    ball = r4.Sphere()
    bend = assert_type(ball.apply(r4.Bend(60, axis="x")), r4.Bend)
    bend.angle = 30
    assert assert_type(bend.angle, Part[float]).at(0.0) == 30.0
    bend.enabled = r4.keys({0: 0, 2: 1}, interpolation="step")
    assert isinstance(assert_type(bend.enabled, Gate), Gate)
    assert assert_type(bend.enabled.at(2.0), bool)
    squash = ball.apply(Squash(0.5))
    assert assert_type(squash.amount, Part[float]).at(0.0) == 0.5


def test_tables_take_lambdas_and_functions():
    """A table takes lambdas, whose arguments are anything, and functions."""
    pyramid = Pyramid(width=3)
    pyramid.height = 2
    assert assert_type(pyramid.height, Attribute[float]).at(0.0) == 2.0
    assert assert_type(pyramid.volume.at(0.0), float) == 3.0
    assert assert_type((pyramid | r4.Box()).mesh.at(0.0), r4.Mesh).faces.shape[1] == 3


def test_what_cannot_be_meant_is_refused_by_checkers_too():
    """What a run refuses a checker refuses, too."""
    ball, bend, light = r4.Sphere(), r4.Bend(60), r4.Light()
    with pytest.raises(r4.ShapeError):
        ball.radius = "big"  # pyright: ignore[reportAttributeAccessIssue]
    with pytest.raises(r4.ShapeError):
        bend.angle = "big"  # pyright: ignore[reportAttributeAccessIssue]
    with pytest.raises(r4.ShapeError):
        light.light_type = 3  # pyright: ignore[reportAttributeAccessIssue]
    with pytest.raises(r4.ShapeError):
        ball.visible = "yes"  # pyright: ignore[reportAttributeAccessIssue]
