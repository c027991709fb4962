"""Tracks that are exact where that can be and fitted elsewhere: what is asked, and for whom they hold."""

import math

import numpy as np
import pytest

import reactive4d as r4
from reactive4d_widgets.lowering import matrix_track, play, track

T = r4.time
START, STOP = 0.0, 6.0
TIMES = np.linspace(START, STOP, 121).tolist()


def assert_near(obj, made, *, above=(), tolerance=2e-3, **given):
    """The product is as near to the matrix as fits have to be."""
    assert made is not None
    for t in TIMES:
        matrix = obj.matrix.at(t, **given)
        for group in above:
            matrix = group.matrix.at(t, **given) @ matrix
        assert np.abs(play(made.track, t, given) - matrix.ravel()).max() <= tolerance


def operations(made):
    """What the factors do."""
    return [factor["op"] for factor in made.track["factors"]]


@r4.signal
def sway(t: float) -> float:
    """A function of Python's, with a jump."""
    return 10 * math.sin(t) if t < 5 else 0.0


def test_what_is_exact_stays_exact():
    """Nothing is asked for it, and it holds for all parameters."""
    ball = r4.Sphere()
    ball.translate(r4.vec(T, r4.Parameter("width", 1.0), 0))
    made = matrix_track(ball, START, STOP, size=3.0)

    assert made is not None
    assert (made.exact, made.reads, made.asks, made.error) == (True, frozenset(), 0, 0.0)
    found = track(T * 2, START, STOP, tolerance=1e-4)
    assert found is not None
    assert found.exact


def test_one_opaque_setting_is_fitted_alone():
    """The product stays a product: the way is exact, the angle is a curve."""
    ball = r4.Sphere()
    ball.translate(r4.vec(0, 0, 2 * np.abs(np.sin(np.pi * T))))
    ball.rotate(sway, axis="x")
    made = matrix_track(ball, START, STOP, size=3.0)

    assert_near(ball, made)
    assert operations(made) == ["translate", "rotate"]
    assert made.track["factors"][0]["offset"]["kind"] == "expr"
    assert made.track["factors"][1]["angle"]["kind"] == "poly"
    assert not made.exact
    assert made.asks <= 150


def test_a_fit_tells_what_it_read():
    """For other values of these parameters there must be others; the exact factors hold for all."""
    length, width = r4.Parameter("length", 1.0), r4.Parameter("width", 1.0)
    ball = r4.Sphere()
    ball.translate(r4.lift(lambda t, a: (math.sin(a * t), t, 0.0))(T, length))
    ball.scale(1 + width)
    made = matrix_track(ball, START, STOP, size=3.0, parameters={"length": 2.0, "width": 5.0})

    assert_near(ball, made, length=2.0, width=0.5)
    assert made.reads == {"length"}


@pytest.mark.parametrize(
    "change",
    [
        r4.Mirror(r4.vec(np.sin(T), np.cos(T), 0)),
        r4.Shear(r4.vec(T, 0, 0), axis=r4.vec(np.sin(T), 0, 1)),
        r4.Orient(
            r4.keys(
                {
                    0: r4.Rotation(),
                    2: r4.Rotation.from_axis_angle((1, 2, 3), 150),
                    5: r4.Rotation.from_axis_angle("x", 20),
                },
                interpolation="catmull_rom",
            )
        ),
        r4.LookAt(r4.signal(lambda t: np.array([t, 5.0, math.cos(t)]))),
        r4.LookAt((9, 9, 9), forward=r4.keys({0: "x", 3: "y"}, kind="held")),
        r4.Scale(r4.signal(lambda t: 1.0 + t)),
        r4.Matrix(r4.signal(lambda t: np.diag([1.0 + t, 1.0, 1.0, 1.0]))),
    ],
    ids=["mirror", "shear", "orient", "look at", "forward", "scale", "matrix"],
)
def test_every_transform_can_be_fitted(change):
    """As a curve of its setting, or as a translation, a rotation and a stretch."""
    box = r4.Box()
    box.translate((1, T, 0))
    box.apply(change)
    box.rotate(20 * T)
    made = matrix_track(box, START, STOP, size=3.0)

    assert_near(box, made, tolerance=1.5e-2)
    assert not made.exact
    assert operations(made)[-1] == "rotate"


def test_a_transform_of_one_s_own_is_fitted_alone():
    """Whatever it does; what needs the matrix before it is fitted together with that."""

    class Wobble(r4.Transform):
        amount = r4.Float(unit="m")

        @staticmethod
        def matrix(amount):
            matrix = np.eye(4)
            matrix[0, 1], matrix[2, 3] = math.sin(amount), amount
            return matrix

    class Stay(r4.Transform):
        share = r4.Float(1.0)

        @staticmethod
        def matrix(share, position):
            matrix = np.eye(4)
            matrix[:3, 3] = -share * position
            return matrix

    alone, together = r4.Box(), r4.Box()
    alone.translate(r4.vec(T, 0, 0))
    alone.apply(Wobble(T))
    together.translate(r4.vec(T, 0, 0))
    together.apply(Stay(0.5))
    together.rotate(30 * T)

    made = matrix_track(alone, START, STOP, size=3.0)
    assert_near(alone, made, tolerance=3e-3)
    assert operations(made) == ["translate", "trs"]
    made = matrix_track(together, START, STOP, size=3.0)
    assert_near(together, made)
    assert operations(made) == ["trs", "rotate"]


def test_lists_that_vary_unforeseeably_are_fitted_whole():
    """Groups included."""
    ball = r4.Sphere()
    ball.translate((1, 0, 0))
    ball.rotate(90 * T, enabled=r4.signal(lambda t: t < 3.25))
    group = r4.Group(ball=ball)
    group.translate(r4.vec(0, 0, T))
    made = matrix_track(ball, START, STOP, size=3.0, above=(group,))

    assert_near(ball, made, above=(group,))
    assert operations(made) == ["trs"]


def test_what_stands_still_is_asked_once():
    """Its box tells how long it holds, and where it may jump."""
    steps = r4.keys({0: 0.0, 1: 3.0, 2: 3.0, 4: 1.0}, ease=lambda u: u * u)
    made = track(r4.lift(lambda x: x + 1)(steps), -5.0, 5.0, tolerance=1e-3)

    assert made is not None
    assert made.track["times"] == [-5.0, 0.0, 1.0, 2.0, 4.0, 5.0]
    assert made.asks <= 3 + 8 + 16 + 2


def test_key_times_are_borders():
    """So that no corner has to be looked for."""
    corners = r4.keys({0: 0.0, 0.7: 3.0, 2.1: -1.0, 6: 2.0})
    made = track(r4.lift(lambda x: x * x)(corners), START, STOP, tolerance=1e-3)

    assert made is not None
    assert {0.7, 2.1} <= set(made.track["times"])
    assert made.asks <= 80


@pytest.mark.parametrize(
    "signal",
    [
        r4.signal(lambda t: "text"),
        r4.signal(lambda t: 1 / (1 if t < 2 else 0)),
        r4.signal(lambda t: math.sin(1e5 * t)),
        r4.signal(lambda t: np.zeros(3 if t < 1 else 4)),
    ],
    ids=["text", "error", "rough", "shapes"],
)
def test_what_cannot_be_fitted_is_left_to_samples(signal):
    """Errors among them: they are answers, and have to be told."""
    assert track(signal, START, STOP, tolerance=1e-4) is None


def test_a_matrix_that_raises_is_left_to_samples():
    """So that the error is told."""
    ball = r4.Sphere()
    ball.translate(r4.signal(lambda t: (t, 0.0)))

    assert matrix_track(ball, START, STOP, size=1.0) is None


def test_rotations_are_fitted_as_rotations():
    """Signals of them, too."""
    smooth = r4.keys(
        {0: r4.Rotation(), 2: r4.Rotation.from_axis_angle((1, 2, 3), 150), 6: r4.Rotation()}, interpolation="tcb"
    )
    made = track(smooth, START, STOP, tolerance=1e-3)

    assert made is not None
    for t in TIMES:
        q = play(made.track, t)
        assert abs(abs(np.dot(q / np.linalg.norm(q), smooth.at(t).as_quaternion())) - 1.0) < 1e-6


def test_a_linked_object_is_fitted_by_its_own_factors():
    """Those of them that are exact stay exact."""
    arm, hand, odd = r4.Box(), r4.Sphere(), r4.Sphere()
    arm.rotate(sway)
    arm.translate(r4.vec(T, 0, 0))
    hand.translate((1, 0, 0))
    hand.apply(r4.LinkedXForm(arm))
    made = matrix_track(hand, START, STOP, size=3.0)

    assert_near(hand, made)
    assert operations(made) == ["translate", "matrix"]
    assert [factor["op"] for factor in made.track["factors"][1]["matrix"]["factors"]] == ["rotate", "translate"]
    arm.rotate(90, enabled=r4.signal(lambda t: t < 3.25))
    odd.apply(r4.LinkedXForm(arm))
    assert_near(odd, matrix_track(odd, START, STOP, size=3.0))


def test_what_is_rough_everywhere_leaves_the_matrix_to_samples():
    """Each of its factors would be too rough, and so is the whole."""
    ball = r4.Sphere()
    ball.translate(r4.signal(lambda t: np.array([math.sin(1e5 * t), 0.0, 0.0])))

    assert matrix_track(ball, START, STOP, size=1.0) is None
