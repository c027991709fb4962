"""Subjects: what a device has to know of a scene or an illustration, as data."""

import json
import math
from typing import Any

import numpy as np
import param
import pytest

import reactive4d as r4
from reactive4d.illustrations import subject

length = r4.Parameter("subjects_length", 1.0, bounds=(0.2, 2.0), doc="length of the rod [m]")
count = r4.Parameter("subjects_count", 3, bounds=(1, math.inf))
is_on = r4.Parameter("subjects_is_on", True)
paint = r4.Parameter("subjects_paint", "#369")
word = r4.Parameter("subjects_word", "gold")
place = r4.Parameter("subjects_place", (1.0, 2.0), bounds=(-5, 5))
triple = r4.Parameter("subjects_triple", (1.0, 2.0, 3.0))


def plain() -> r4.Scene:
    """A scene that reads one parameter of each kind."""
    ball = r4.Sphere(length, color=paint, visible=is_on, segments=2 + count)
    ball.translate(r4.vec(place[0], place[1], triple[2]))
    return r4.Scene(ball=ball, label=r4.Label(word))


def test_a_plain_scene_is_described():
    """Its parameters are found, with their bounds; what has no control stays at its default."""
    about = subject(plain())
    told = {control.name.removeprefix("subjects_"): control for control in about.controls}
    assert {name: control.kind for name, control in told.items()} == {
        "length": "number",
        "count": "integer",
        "is_on": "boolean",
        "paint": "color",
        "word": "select",
        "place": "xy",
    }
    assert (about.name, about.title, about.doc, about.times) == ("scene", "Scene", "", (0.0, 10.0))
    assert told["length"].description() == {
        "name": "subjects_length",
        "kind": "number",
        "label": "Subjects length",
        "doc": "length of the rod",
        "unit": "m",
        "default": 1.0,
        "bounds": [0.2, 2.0],
        "soft": None,
        "step": None,
        "options": None,
        "labels": None,
        "stops": None,
        "grade": "free",
        "why": "",
        "hidden": False,
        "optional": False,
    }
    assert (told["count"].bounds, told["count"].step) == ((1, None), 1)
    assert (told["paint"].default, told["word"].options, told["place"].bounds) == ("#336699", ("gold",), (-5, 5))
    assert json.loads(json.dumps([control.description() for control in about.controls]))
    assert about.values["subjects_place"] == (1.0, 2.0)
    assert about.scene.at(0.0, **about.values)["ball"].color.tolist() == pytest.approx([0.2, 0.4, 0.6, 1.0])


def test_a_plain_scene_is_moved_to_another_point():
    """Within the bounds, or refused; a link does as much."""
    about = subject(plain())
    moved = about.moved({"subjects_length": 2, "subjects_paint": "#F00"})
    assert moved.values["subjects_length"] == 2.0
    assert moved.point.parameters["subjects_paint"] == "#ff0000"
    assert about.settled({"subjects_length": 99, "other": 1, "subjects_count": "x"}, strict=False) == {
        **about.point.parameters,
        "subjects_length": 2.0,
    }
    with pytest.raises(r4.ParameterError, match="not within"):
        about.moved({"subjects_length": 99})
    with pytest.raises(r4.UnknownNameError, match="unknown parameter 'subjects_lenght'"):
        about.moved({"subjects_lenght": 1})
    point = r4.Bookmark.from_link("subjects_length=9&subjects_place=9,-1&subjects_is_on=false&t=3", about.scene)
    assert (point.time, point.parameters["subjects_place"]) == (3.0, (5, -1))
    assert point.parameters["subjects_is_on"] is False
    again = r4.Bookmark.from_link(point.to_link(), about.scene, strict=True)
    assert again == point


class TallPole2D(r4.Illustration):
    """A pole, which
    may be tall.

    And more.
    """

    height = param.Number(1.0, bounds=(0, None), softbounds=(0, 4), inclusive_bounds=(False, True), doc="height")
    turns = param.Integer(2, bounds=(0, 5), inclusive_bounds=(False, False))
    _seed = param.Integer(0)
    late = param.Number(0.0, precedence=2)
    early = param.Number(0.0, precedence=1, label="The first", constant=True)

    def build(self) -> r4.Scene:
        """One pole."""
        p = self.signals
        pole = r4.Cylinder(0.1, p.height * length)
        pole.translate(r4.vec(p.late, p.early, 0))
        scene = r4.Scene(pole=pole)
        scene.handle(pole, x=p.late, z="height")
        scene.handle(pole, angle="turns", label="turn")
        return scene


def test_an_illustration_is_described():
    """By its class, its docstring, its parameters in their order, and those that the scene reads besides."""
    for about in (subject(TallPole2D()), subject(TallPole2D)):
        assert (about.name, about.title, about.doc) == ("tall-pole-2d", "Tall pole 2d", "A pole, which may be tall.")
        assert [c.name for c in about.controls] == ["height", "turns", "_seed", "early", "late", "subjects_length"]
        height, turns, seed, early = about.controls[:4]
        assert height.bounds == (5e-324, None)
        assert height.soft == (0, 4)
        assert (turns.bounds, turns.step) == ((1, 4), 1)
        assert (seed.hidden, early.constant, early.label) == (True, True, "The first")
        assert (early.description()["grade"], early.description()["why"]) == ("fixed", "it is constant")
    reader = TallPole2D(height=2.0)
    reader.point = r4.Bookmark(4.0, {"height": 3.0}, ((0, -9, 0), (0, 0, 0)))
    about = subject(reader)
    assert (about.point.time, about.values["height"], about.values["subjects_length"]) == (4.0, 3.0, 1.0)
    assert about.thing is reader
    moved = about.moved({"height": 4.0, "subjects_length": 1.5})
    assert (moved.values["height"], moved.values["subjects_length"], reader.height) == (4.0, 1.5, 3.0)
    assert moved.point.camera == about.point.camera
    assert reader.at(0.0, subjects_length=2.0)["pole"].drawn.points[:, 2].max() == pytest.approx(3.0)


def test_handles_are_described_for_a_page():
    """The node, the parameters, along which axes; labels are for the ear."""
    assert subject(TallPole2D()).handles == (
        {"node": "pole", "parameters": ["late", "height"], "axes": ["x", "z"], "label": "pole", "kind": "plane"},
        {"node": "pole", "parameters": ["turns"], "axes": [], "label": "turn", "kind": "circle"},
    )


@pytest.mark.parametrize(
    ("bound", "error", "says"),
    [
        ({"x": "subjects_lenght"}, r4.UnknownNameError, "unknown parameter of the handle ball: 'subjects_lenght'"),
        ({"x": "subjects_place"}, r4.ShapeError, "moves subjects_place, a parameter of the kind xy"),
        ({"xy": "subjects_length"}, r4.ShapeError, "moves subjects_length, a parameter of the kind number"),
        ({"angle": "subjects_is_on"}, r4.ShapeError, "moves subjects_is_on, a parameter of the kind boolean"),
    ],
)
def test_a_handle_is_checked_when_the_scene_is_shown(bound: Any, error: type[Exception], says: str):
    """Against the parameters that there are then."""
    scene = plain()
    scene.handle(scene["ball"], **bound)
    with pytest.raises(error, match=says):
        subject(scene)


def test_a_handle_of_a_scene_without_parameters_says_what_is_missing():
    """There is nothing that it could move, whatever it names."""
    scene = r4.Scene(ball=r4.Sphere())
    scene.handle(scene["ball"], x="px")
    with pytest.raises(r4.UnknownNameError, match="unknown parameter of the handle ball: 'px'") as refused:
        subject(scene)
    assert "the scene has no parameters" in refused.value.__notes__[0]


@pytest.mark.parametrize("thing", [None, 3, r4.Sphere(), "scene", int, plain])
def test_what_cannot_be_shown_is_refused(thing: Any):
    """With what can."""
    with pytest.raises(r4.ShapeError, match="expected a scene or an illustration"):
        subject(thing)


@pytest.mark.parametrize("name", ["t", "cam", "time"])
def test_the_time_and_the_camera_are_no_parameters(name: str):
    """A link could not say which of the two is meant; neither of a scene nor of an illustration."""
    with pytest.raises(r4.ParameterError, match=f"a parameter called '{name}'|'t' is not a name for a parameter"):
        subject(r4.Scene(ball=r4.Sphere(r4.Parameter(name, 1.0))))
    with pytest.raises(r4.ParameterError, match=f"Taken.{name} cannot be a parameter"):
        type("Taken", (r4.Illustration,), {name: param.Number(1.0)})


def test_another_parameter_of_the_same_name_is_refused():
    """An illustration's own and one that the scene reads besides cannot both be `size`."""
    other = r4.Parameter("subjects_size", 1.0)

    class Twice(r4.Illustration):
        subjects_size = param.Number(1.0)

        def build(self) -> r4.Scene:
            return r4.Scene(ball=r4.Sphere(other))

    with pytest.raises(r4.ParameterError, match="two different parameters that are both called 'subjects_size'"):
        subject(Twice())


def test_choices_travel_as_themselves_or_by_name():
    """As themselves if JSON has them all, and they can be told apart as texts; else by names that are unique."""
    solids = [r4.Sphere(), r4.Sphere()]

    class Chosen(r4.Illustration):
        plain = param.Selector(objects=["a", 2, 0.5, True, None])
        named = param.Selector(objects={"small": 1, "large": 2})
        alike = param.Selector(objects=[3, "3"])
        solid = param.Selector(objects={"one": solids[0], "two": solids[1]})
        bare = param.Selector(objects=solids)
        infinite = param.Selector(objects=[1.0, math.inf])

        def build(self) -> r4.Scene:
            return r4.Scene(ball=r4.Sphere())

    reader = Chosen()
    told = {control.name: (control.options, control.labels) for control in reader.controls}
    assert told["plain"] == (("a", 2, 0.5, True, None), ("a", "2", "0.5", "True", "None"))
    assert told["named"] == ((1, 2), ("small", "large"))
    assert told["alike"] == (("3", "3 (2)"), ("3", "3 (2)"))
    assert told["solid"] == (("one", "two"), ("one", "two"))
    assert told["bare"] == (("sphere", "sphere (2)"), ("sphere", "sphere (2)"))
    assert told["infinite"][0] == ("1.0", "inf")
    for name, (options, _) in told.items():
        control = next(c for c in reader.controls if c.name == name)
        for option in options or ():
            value = control.decode(option)
            assert control.encode(value) == option
            assert control.read(control.text(option)) == option
            setattr(reader, name, value)
            assert r4.Bookmark.from_link(reader.point.to_link(), Chosen(), strict=True) == reader.point
    with pytest.raises(r4.ParameterError):
        reader.controls[3].decode("three")


@pytest.mark.parametrize(
    ("wire", "admitted"),
    [(-1, 0.2), (99, 2.0), (1, 1.0), (math.inf, 2.0), (-math.inf, 0.2), (10**400, 2.0), (np.float32(1.5), 1.5)],
)
def test_numbers_from_outside_are_moved_into_their_bounds(wire: Any, admitted: float):
    """However far out they are."""
    control = subject(plain()).control("subjects_length")
    assert control.admit(wire) == admitted
    assert type(control.admit(wire)) is float


@pytest.mark.parametrize("wire", ["1", None, [1], {}, math.nan])
def test_what_is_no_number_is_refused(wire: Any):
    """Nothing is guessed."""
    with pytest.raises(r4.ParameterError):
        subject(plain()).control("subjects_length").admit(wire)
