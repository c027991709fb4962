"""What a reader may do with a parameter: any value, the baked ones, or none; and the sentence that says why."""

from typing import Any

import numpy as np
import param
import pytest

import reactive4d as r4
from reactive4d.errors import ParameterError, UnknownNameError


class Pendulum(r4.Illustration):
    """A pendulum of adjustable length."""

    length = param.Number(1.0, bounds=(0.2, 2.0), doc="length of the rod [m]")
    angle = param.Number(20.0, bounds=(-90, 90), doc="starting angle [deg]")

    def build(self) -> r4.Scene:
        """A rod and a bob."""
        p = self.signals
        swing = p.angle * np.cos(np.sqrt(9.81 / p.length) * r4.time)
        rod = r4.Cylinder(radius=0.02, height=p.length)
        bob = r4.Sphere(radius=0.1, color="crimson")
        rod.translate(r4.vec(0, 0, -p.length / 2))
        bob.translate(r4.vec(0, 0, -p.length))
        for part in (rod, bob):
            part.rotate(swing, axis="y")
        return r4.Scene(rod=rod, bob=bob)


class Various(r4.Illustration):
    """One parameter of each kind."""

    width = param.Number(1.0, bounds=(0.5, 2.0))
    height = param.Number(1.0, bounds=(0.5, 2.0))
    bend = param.Number(30.0, bounds=(0, 90))
    sides = param.Integer(3, bounds=(3, 6))
    shown = param.Boolean(True)
    mode = param.Selector(default="slow", objects=["slow", "fast"])
    tint = param.Color("#ff0000")
    span = param.Range((0.2, 0.8), bounds=(0, 1))
    place = param.XYCoordinates((0.0, 0.0))
    unused = param.Number(0.0)
    fixed = param.Number(1.0, constant=True)

    def build(self) -> r4.Scene:
        """Things that each read some of them."""
        p = self.signals
        box = r4.Box(size=r4.vec(p.width, 1, p.height), color=p.tint)
        box.translate(r4.vec(p.place[0], p.place[1], 0))
        ball = r4.Sphere(radius=0.2, visible=p.shown)
        ball.translate(r4.vec(r4.where(r4.equal(p.mode, "fast"), 2 * r4.time, r4.time), 2, 0))
        bar = r4.Box(size=(0.2, 0.2, 3), segments=(1, 1, 20))
        bar.apply(r4.Bend(p.bend))
        bar.translate(r4.vec(3, 0, p.span[0]))
        star = r4.Ngon(sides=p.sides)
        return r4.Scene(box=box, ball=ball, bar=bar, star=star)


def test_what_is_evaluated_in_the_viewer_is_free(bake: Any) -> None:
    """The angle is only read by motions that are expressions."""
    baked = bake(Pendulum, times=(0, 5))
    entry = baked.parameter("angle")
    assert (entry["grade"], entry["stops"], entry["bounds"]) == ("free", None, [-90, 90])
    for angle in (-80.0, 33.3):
        baked.check(1.7, between=True, angle=angle)


def test_what_was_not_given_is_fixed_and_says_why(bake: Any) -> None:
    """The rod's shape reads the length."""
    entry = bake(Pendulum, times=(0, 5)).parameter("length")
    assert entry["grade"] == "fixed"
    assert entry["why"] == (
        "This page holds length = 1\u202fm only; for other values the shape of rod would need a live kernel."
    )


def test_what_was_checked_between_its_stops_is_free(bake: Any) -> None:
    """A rod that grows does so in a straight line; its swing is an expression."""
    baked = bake(Pendulum, times=(0, 5), length=np.linspace(0.2, 2.0, 4))
    entry = baked.parameter("length")
    assert (entry["grade"], entry["bounds"]) == ("free", [0.2, 2.0])
    assert entry["stops"] == pytest.approx([0.2, 0.8, 1.4, 2.0])
    for length in (0.2, 0.5, 1.1, 1.93):
        baked.check(2.0, length=length)


def test_a_reader_stays_within_what_was_baked(bake: Any) -> None:
    """Beyond the last stop nothing is known: the bounds become the stops'."""
    baked = bake(Pendulum, times=(0, 5), length=[0.5, 1.5])
    assert baked.parameter("length")["bounds"] == [0.5, 1.5]
    assert baked.manifest["point"]["parameters"]["length"] == 1.0


def test_what_is_wrong_between_its_stops_stops_at_them(bake: Any) -> None:
    """A bend does not go in a straight line."""
    baked = bake(Various, times=(0, 1), bend=[0, 30, 60, 90])
    entry = baked.parameter("bend")
    assert (entry["grade"], entry["stops"]) == ("stops", [0.0, 30.0, 60.0, 90.0])
    assert all("blend" not in segment for segment in baked.of("bar#points"))
    for bend in (0.0, 60.0):
        baked.check(1.0, bend=bend)
    assert not baked.played.knows("bar#points", 0.0, baked.wires({"bend": 45.0}))


def test_what_bends_is_free_where_its_values_stand_close_enough(bake: Any) -> None:
    """From one value to the next it is as good as straight, for the eye."""
    baked = bake(Various, times=(0, 1), bend=np.linspace(0, 90, 9))
    assert baked.parameter("bend")["grade"] == "free"
    size = np.linalg.norm(np.subtract(*baked.manifest["bounds"]))
    wires = baked.wires({"bend": 40.0})
    assert baked.played.knows("bar#points", 1.0, wires)
    truth = Various().scene["bar"].points.at(1.0, bend=40.0)
    assert np.abs(baked.played.at("bar#points", 1.0, wires) - truth).max() < 5e-4 * size


def test_a_value_that_stays_the_same_but_for_rounding_does_not_stop_anything(bake: Any) -> None:
    """The volume of what is twisted is nearly the same for all angles."""

    class Twisted(r4.Illustration):
        angle = param.Number(0.0, bounds=(0, 30))

        def build(self) -> r4.Scene:
            bar = r4.Box((0.1, 0.1, 1), segments=(1, 1, 12))
            bar.apply(r4.Twist(self.signals.angle))
            scene = r4.Scene(bar=bar)
            scene.signals["nearly"] = 1.5 + 1e-7 * np.sin(self.signals.angle * bar.volume)
            return scene

    assert bake(Twisted, times=(0, 1), angle=np.linspace(0, 30, 4)).parameter("angle")["grade"] == "free"


def test_the_swing_of_a_pendulum_is_not_blended(bake: Any) -> None:
    """The poses at neighbouring lengths have nothing in common: where it is not an expression, it stops."""

    class Opaque(r4.Illustration):
        length = param.Number(1.0, bounds=(0.2, 2.0))

        def build(self) -> r4.Scene:
            swing = r4.lift(lambda length, t: 60 * np.cos(np.sqrt(9.81 / length) * t))(self.signals.length, r4.time)
            bob = r4.Sphere(radius=0.1)
            bob.translate((0, 0, -1))
            bob.rotate(swing, axis="y")
            return r4.Scene(bob=bob)

    baked = bake(Opaque, times=(0, 5), length=np.linspace(0.2, 2.0, 7))
    assert baked.parameter("length")["grade"] == "stops"
    assert len(baked.of("bob#matrix")) == 7
    for length in (0.2, 1.1, 2.0):
        baked.check(3.3, between=True, length=length)


def test_two_parameters_are_blended_together_if_that_is_right(bake: Any) -> None:
    """A box grows along two axes; six shapes are enough."""
    baked = bake(Various, times=(0, 1), width=[0.5, 1, 2], height=[0.5, 2])
    assert [baked.parameter(name)["grade"] for name in ("width", "height")] == ["free", "free"]
    assert len(baked.of("box#points")) == 6
    baked.check(0.0, width=0.7, height=1.3)


def test_two_parameters_that_are_multiplied_twice_are_not_both_blended(bake: Any) -> None:
    """Right along each alone, but wrong in the middle of a cell of both."""

    class Product(r4.Illustration):
        a = param.Number(1.0, bounds=(0.0, 2.0))
        b = param.Number(1.0, bounds=(0.0, 2.0))

        def build(self) -> r4.Scene:
            # |a - b| is straight along each side of a cell, and has a fold across it.
            height = r4.lift(lambda a, b: 1 + abs(a - b))(self.signals.a, self.signals.b)
            return r4.Scene(box=r4.Box(size=r4.vec(1, 1, height)))

    baked = bake(Product, times=(0, 1), a=[0, 1, 2], b=[0, 1, 2])
    grades = [baked.parameter(name)["grade"] for name in ("a", "b")]
    assert grades != ["free", "free"]
    for a in (0.0, 1.0, 2.0):
        for b in (0.0, 1.0, 2.0):
            baked.check(0.0, a=a, b=b)


def test_every_kind_of_parameter_has_a_grade(bake: Any) -> None:
    """Without baked values: expressions are free, shapes are fixed, constants stay."""
    baked = bake(Various, times=(0, 1))
    grades = {entry["name"]: entry["grade"] for entry in baked.manifest["parameters"]}
    fixed = {name for name, grade in grades.items() if grade == "fixed"}
    assert fixed == {"width", "height", "bend", "sides", "fixed"}
    baked.check(1.0, shown=False, mode="fast", place=(2.0, -1.0), span=(0.5, 0.6))


def test_whole_numbers_stop(bake: Any) -> None:
    """There is nothing between a triangle and a square."""
    baked = bake(Various, times=(0, 1), sides=range(3, 7))
    entry = baked.parameter("sides")
    assert (entry["grade"], entry["stops"]) == ("stops", [3, 4, 5, 6])
    for sides in (3, 6):
        baked.check(0.0, sides=sides)


def test_choices_truth_values_and_colours_can_be_baked(bake: Any) -> None:
    """Where they are no expressions."""

    class Opaque(r4.Illustration):
        mode = param.Selector(default="a", objects={"A": "a", "B": "b"})
        large = param.Boolean(False)

        def build(self) -> r4.Scene:
            p = self.signals
            size = r4.lift(lambda mode, large: (1.0 if mode == "a" else 2.0) * (3 if large else 1))(p.mode, p.large)
            return r4.Scene(ball=r4.Sphere(radius=size))

    baked = bake(Opaque, times=(0, 1), mode=["a", "b"], large=[False, True])
    assert [baked.parameter(name)["stops"] for name in ("mode", "large")] == [["a", "b"], [False, True]]
    for mode in "ab":
        for large in (False, True):
            baked.check(0.0, mode=mode, large=large)


def test_one_value_fixes_a_parameter_or_opens_it_there(bake: Any) -> None:
    """Fixed where it cannot move, else that is where the page opens."""
    baked = bake(Pendulum, times=(0, 1), length=1.5, angle=45)
    assert baked.parameter("length")["grade"] == "fixed"
    assert baked.parameter("angle")["grade"] == "free"
    assert baked.manifest["point"]["parameters"] == {"length": 1.5, "angle": 45.0}


def test_a_readers_own_values_are_where_the_page_opens(bake: Any) -> None:
    """At the nearest stop, where it stops."""
    assert bake(Pendulum(angle=33), times=(0, 1)).manifest["point"]["parameters"]["angle"] == 33.0
    baked = bake(Various(bend=40), times=(0, 1), bend=[0, 30, 60])
    assert baked.manifest["point"]["parameters"]["bend"] == 30.0


def test_values_are_sorted_and_each_is_asked_once(bake: Any) -> None:
    """In whatever order they are given."""
    assert bake(Various, times=(0, 1), bend=[60, 0, 60.0, 30]).parameter("bend")["stops"] == [0.0, 30.0, 60.0]


@pytest.mark.parametrize(
    ("values", "error", "message"),
    [
        ({"lenght": [1]}, UnknownNameError, "unknown parameter 'lenght'"),
        ({"length": [5.0]}, ParameterError, "Number parameter 'Pendulum.length' must be at most 2.0, not 5.0"),
        ({"length": "long"}, ParameterError, "length"),
        ({"length": []}, ParameterError, "expected one value or more"),
        ({"length": np.linspace(0.2, 2.0, 2000)}, ParameterError, "2000 values are too many"),
        ({"length": [None]}, ParameterError, "length"),
        ({"length": [float("nan")]}, ParameterError, "length"),
    ],
)
def test_bad_values_are_refused(values: Any, error: type[Exception], message: str, bake: Any) -> None:
    """With param's own message, where it has one."""
    with pytest.raises(error, match=message):
        bake(Pendulum, times=(0, 1), **values)


def test_a_near_name_is_told(bake: Any) -> None:
    """And what is the same for all readers takes no values."""
    with pytest.raises(UnknownNameError) as caught:
        bake(Pendulum, lenght=1)
    assert caught.value.__notes__ == ["hint: did you mean 'length'?"]
    with pytest.raises(ParameterError, match="the same for all readers"):
        bake(Various, fixed=[1, 2])
