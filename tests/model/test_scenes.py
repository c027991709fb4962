"""Scenes: named objects, and what a viewer needs of all of them at one time."""

import gc
import weakref
from typing import Any

import numpy as np
import pytest

import reactive4d as r4


def evaluated(events: Any) -> list[str]:
    """What was computed, by name."""
    return sorted(event.name for event in events if event.kind == "evaluated")


def test_a_scene_names_what_it_holds() -> None:
    """A mutable mapping in the order of naming; what has no name yet is named by it."""
    ball, table = r4.Sphere(), r4.Box()
    table.name = "desk"
    scene = r4.Scene(ball=ball, table=table)
    assert (list(scene), ball.name, table.name) == (["ball", "table"], "ball", "desk")
    assert scene["ball"] is ball
    scene["lamp"] = r4.Light()
    assert list(scene) == ["ball", "table", "lamp"]
    del scene["table"]
    assert list(scene) == ["ball", "lamp"]
    assert ("table" in scene, len(scene), "ball" in scene) == (False, 2, True)
    scene["ball"] = table
    assert list(scene) == ["ball", "lamp"]
    assert scene.pop("lamp").name == "lamp"
    scene.update({"x y": ball}, z=r4.Point())
    assert list(scene) == ["ball", "x y", "z"]
    scene.clear()
    assert len(scene.at(0)) == 0


def test_a_frame_shows_every_object_where_it_is() -> None:
    """What is drawn is in local space, with the matrix that takes it to the world's, colour and visibility."""
    ball = r4.Sphere(color="red", opacity=0.5)
    ball.translate(r4.vec(r4.time, 0, 0))
    scene = r4.Scene(ball=ball, path=r4.Path([(0, 0, 0), (1, 1, 1)]), camera=r4.Camera(), sun=r4.Light("directional"))
    frame = scene.at(2.0)
    assert list(frame) == ["ball", "path", "camera", "sun"]
    node = frame["ball"]
    assert (node.kind, node.visible, node.opacity) == ("sphere", True, 0.5)
    assert node.drawn is ball.surface.at(0)
    assert node.matrix[:3, 3].tolist() == [2, 0, 0]
    assert np.array_equal(node.mesh.points, ball.mesh.at(2).points)
    assert isinstance(frame["path"].drawn, r4.Lines)
    assert frame["camera"].drawn["fov"] == 40
    assert frame["sun"].drawn["light_type"] == "directional"
    assert frame.time == 2.0
    ball.visible = r4.time < 1
    assert scene.at(2.0)["ball"].visible is False


def test_members_of_a_group_are_drawn_one_by_one() -> None:
    """A group's members follow it as `car/tyre0`; what is done to the group is done to none of them alone."""
    tyre = r4.Cylinder()
    tyre.translate((0, 0, 1))
    car = r4.Group(tyre0=tyre, inner=r4.Group(lamp=r4.Sphere()))
    car.translate((5, 0, 0))
    frame = r4.Scene(car=car).at(0)
    assert list(frame) == ["car", "car/tyre0", "car/inner", "car/inner/lamp"]
    assert frame["car/tyre0"].matrix[:3, 3].tolist() == [5, 0, 1]
    assert tyre.position.at(0).tolist() == [0, 0, 1]
    car.visible = False
    assert not any(node.visible for node in r4.Scene(car=car).at(0).values())


def test_an_edit_of_one_object_costs_that_object() -> None:
    """Of a hundred objects one is edited: the next frame computes that one's, and what gathers it."""
    balls = {f"b{i}": r4.Sphere(segments=4, rings=2) for i in range(100)}
    for i, ball in enumerate(balls.values()):
        ball.translate((i, 0, 0))
    scene = r4.Scene(balls)
    first = scene.at(0)
    with r4.log() as events:
        balls["b42"].translate((0, 0, 1))
    assert {e.name.split(".")[0] for e in events if e.kind == "marked"} <= {"b42", "scene"}
    with r4.log() as events:
        second = scene.at(0)
    assert {name.split(".")[0] for name in evaluated(events)} <= {"b42", "scene"}
    assert len(evaluated(events)) <= 8
    assert second["b42"].matrix[2, 3] == 1
    assert second["b41"] is first["b41"]
    with r4.log() as events:
        scene.at(5)
    assert evaluated(events) == []


def test_one_object_in_two_scenes_is_computed_once() -> None:
    """A scene owns nothing that another one could not show too."""
    ball = r4.Sphere()
    ball.name = "ball"
    left, right = r4.Scene(ball=ball), r4.Scene(it=ball)
    with r4.log() as events:
        assert left.at(0)["ball"].drawn is right.at(0)["it"].drawn
    assert evaluated(events).count("ball.surface") == 1


@pytest.mark.parametrize(
    "edit",
    [
        lambda s: s.__setitem__("", r4.Sphere()),
        lambda s: s.__setitem__("a/b", r4.Sphere()),
        lambda s: s.__setitem__(3, r4.Sphere()),
        lambda s: s.__setitem__("x", "ball"),
        lambda s: s.__setitem__("x", None),
        lambda s: s.update(x=r4.Sphere(), y=3),
        lambda s: s["bal"],
        lambda s: s.__delitem__("bal"),
        lambda s: r4.Scene(x=1),
        lambda s: s.at(float("nan")),
        lambda s: s.at("now"),
        lambda s: s.at([0.0, 1.0]),
        lambda s: s.at(np.arange(3.0)),
        lambda s: s.at(0, sped=3),
    ],
)
def test_what_cannot_be_shown_is_refused_and_changes_nothing(edit: Any) -> None:
    """At the border: a clear error, and everything as it was."""
    scene = r4.Scene(ball=r4.Sphere())
    with pytest.raises((r4.Reactive4dError, KeyError)) as raised:
        edit(scene)
    assert str(raised.value)
    assert list(scene) == ["ball"]
    assert list(scene.at(0)) == ["ball"]


def test_an_error_names_the_object_that_is_to_blame() -> None:
    """An error in one object is raised with its path, and forgotten by the edit that mends it."""
    ball = r4.Sphere()
    scene = r4.Scene(ball=ball, box=r4.Box())
    ball.radius = r4.time - 5
    with pytest.raises(r4.ShapeError, match=r"Sphere\.radius") as raised:
        scene.at(0)
    assert any("ball" in note for note in raised.value.__notes__)
    assert scene.at(6)["ball"].visible
    ball.radius = 1
    assert scene.at(0)["ball"].visible


def test_an_object_that_nobody_holds_any_more_is_freed() -> None:
    """Contract 12: a scene owns its objects; what is removed leaves no links behind."""
    scene = r4.Scene(camera=r4.Camera())
    prototype, target = r4.Sphere(), r4.Sphere()

    def come_and_go() -> Any:
        ball = prototype.extend()
        ball.translate(target.position)
        ball.apply(r4.Bend(30, enabled=r4.time > 1))
        other = r4.Group(ball=ball)
        scene["ball"] = other
        scene["ball"].extend()
        for t in (0.0, 2.0):
            scene.at(t)
        del scene["ball"]
        return weakref.ref(ball), weakref.ref(other)

    refs = [come_and_go() for _ in range(20)]
    scene.at(0)
    gc.collect()
    # What a scene held lately comes back without a computation: it remembers that for a while.
    assert [(ball(), group()) for ball, group in refs[:-8]] == [(None, None)] * 12
    target.translate((1, 0, 0))
    assert scene.at(0)["camera"].kind == "camera"


def test_a_transaction_is_seen_as_a_whole() -> None:
    """F102: batched edits are one interactive update."""
    ball, box = r4.Sphere(), r4.Box()
    scene = r4.Scene(ball=ball, box=box)
    scene.at(0)
    with pytest.raises(ZeroDivisionError), r4.transaction():  # noqa: PT012
        scene["new"] = r4.Sphere()
        del scene["box"]
        ball.translate((1, 0, 0))
        assert list(scene.at(0)) == ["ball", "new"]
        raise ZeroDivisionError
    frame = scene.at(0)
    assert list(frame) == ["ball", "box"]
    assert frame["ball"].matrix[0, 3] == 0
