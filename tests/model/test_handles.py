"""Handles: what a reader may take hold of, as a scene keeps it."""

from typing import Any

import pytest

import reactive4d as r4

px, py = r4.Parameter("handles_px", 0.0), r4.Parameter("handles_py", 0.0)

pair = r4.Parameter("handles_pair", (0.0, 1.0))
switch, word = r4.Parameter("handles_switch", False), r4.Parameter("handles_word", "red")


def scene() -> r4.Scene:
    """A ball, and a group with a tyre in it."""
    ball = r4.Sphere()
    ball.translate(r4.vec(px, py, 0))
    return r4.Scene(ball=ball, car=r4.Group(axle=r4.Group(tyre=r4.Cylinder())))


@pytest.mark.parametrize(
    ("bound", "kind", "parameters", "axes"),
    [
        ({"x": "px"}, "axis", ("px",), ("x",)),
        ({"z": "height"}, "axis", ("height",), ("z",)),
        ({"x": "px", "z": "pz"}, "plane", ("px", "pz"), ("x", "z")),
        ({"z": "pz", "y": "py"}, "plane", ("py", "pz"), ("y", "z")),
        ({"xy": "place"}, "plane", ("place",), ("x", "y")),
        ({"angle": "turn"}, "circle", ("turn",), ()),
        ({"x": px}, "axis", ("handles_px",), ("x",)),
        ({"xy": pair}, "plane", ("handles_pair",), ("x", "y")),
    ],
)
def test_a_handle_is_a_line_a_plane_or_a_circle(bound: Any, kind: str, parameters: Any, axes: Any):
    """By what it is bound to: parameters by name, or themselves."""
    it = scene()
    made = it.handle(it["ball"], **bound)
    assert (made.kind, made.parameters, made.axes, made.label) == (kind, parameters, axes, "ball")
    assert it.handles == (made,)
    assert made.object is it["ball"]


def test_an_object_may_have_several_handles_each_once():
    """Said twice is said once; labels tell them apart."""
    it = scene()
    it.handle(it["ball"], x="px")
    it.handle(it["ball"], angle="turn", label="turn the ball")
    it.handle(it["ball"], x="px")
    assert [handle.label for handle in it.handles] == ["turn the ball", "ball"]


def test_a_member_of_a_group_has_its_path_for_a_name():
    """As its node has in the frame."""
    it = scene()
    tyre: Any = it["car"].members.at(0.0)[0][1].members.at(0.0)[0][1]
    assert it.handle(tyre, angle="turn").label == "car/axle/tyre"


@pytest.mark.parametrize(
    ("bound", "says"),
    [
        ({}, "nothing makes neither"),
        ({"x": "a", "y": "b", "z": "c"}, "x, y, z makes neither"),
        ({"x": "a", "xy": "b"}, "x, xy makes neither"),
        ({"angle": "a", "z": "b"}, "z, angle makes neither"),
        ({"xy": "a", "angle": "b"}, "xy, angle makes neither"),
        ({"x": "a", "y": "a"}, "'a' was given twice"),
        ({"x": 3}, "x: expected the name of a parameter, got 3"),
        ({"x": "not a name"}, "x: expected the name of a parameter"),
        ({"x": px * 2}, "x: expected the name of a parameter"),
        ({"x": True}, "x: expected the name of a parameter, got True"),
        ({"x": "px", "label": 3}, "label: expected a text, got 3"),
        ({"xy": 3}, "xy: expected the name of a parameter, got 3"),
        ({"xy": px}, "xy: expected a parameter that is two numbers, got handles_px, which is 0.0"),
        ({"x": pair}, r"x: expected a parameter that is a number, got handles_pair, which is \(0.0, 1.0\)"),
        ({"z": switch}, "z: expected a parameter that is a number, got handles_switch, which is False"),
        ({"angle": word}, "angle: expected a parameter that is a number, got handles_word, which is 'red'"),
    ],
)
def test_what_makes_no_handle_is_refused(bound: Any, says: str):
    """And the scene keeps none of it."""
    it = scene()
    with pytest.raises(r4.ShapeError, match=says):
        it.handle(it["ball"], **bound)
    assert it.handles == ()


def test_only_what_is_in_the_scene_has_a_handle():
    """An object that the scene does not name, or something that is no object."""
    it = scene()
    with pytest.raises(r4.ShapeError, match="sphere is not in the scene") as refused:
        it.handle(r4.Sphere(), x="px")
    assert "name it there first" in refused.value.__notes__[0]
    with pytest.raises(r4.ShapeError, match="expected an object, got 'ball'"):
        it.handle("ball", x="px")  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
