"""References: objects that ask others, and send to others; who is told of an edit, and what is computed again."""

import math
from typing import Any

import numpy as np
import pytest

import reactive4d as r4


def named(name: str, obj: Any) -> Any:
    """An object with a name, for the log."""
    obj.name = name
    return obj


def evaluated(events: Any) -> list[str]:
    """What was computed, by name."""
    return sorted(event.name for event in events if event.kind == "evaluated")


def marked(events: Any) -> set[str]:
    """What was made questionable, by name."""
    return {event.name for event in events if event.kind == "marked"}


# -- one asks another --------------------------------------------------------------------------------------------------


def test_the_camera_looks_at_the_cube_of_figure_3() -> None:
    """
    F092: moving the cube marks the caches after the move invalid for the move's time interval, not the b-rep cache,
    since a transformation matrix is applied separately; it reaches the reference, tells the camera, which invalidates
    its own.

        keys --> cube.position --> camera.target --> camera.matrix
    """
    cube = named("cube", r4.Box())
    move = cube.translate(r4.keys({t: (0, t, 0) for t in range(6)}))
    camera = named("camera", r4.Camera(position=(10, 0, 0), target=cube.position))
    times = (0.5, 2.5, 4.5)
    for t in times:
        for channel in (cube.mesh, cube.surface, camera.matrix, camera.position):
            channel.at(t)
    with r4.log() as events:
        move.offset.source.points[2] = (0, 7, 0)
    assert {"cube.matrix", "cube.position", "cube.mesh", "camera.matrix"} <= marked(events)
    assert not marked(events) & {"cube.surface", "cube.points", "cube.topology"}
    assert all(event.lo >= 1 and event.hi <= 3 for event in events)
    with r4.log() as events:
        found = {t: camera.matrix.at(t)[:3, :3] @ (0, 0, -1) for t in times}
    assert evaluated(events).count("camera.matrix") == 1
    for t in times:
        to = cube.position.at(t) - (10, 0, 0)
        assert np.allclose(found[t], to / np.linalg.norm(to))


def test_what_one_exports_sets_position_orientation_colour_and_more() -> None:
    """F090, F082: others set position, look-at, colour by what an object exports, or a part of an expression."""
    robot = named("robot", r4.Sphere())
    robot.translate(r4.vec(r4.time, 0, 0))
    robot.apply(r4.Color(r4.keys({0: "red", 4: "blue"})))
    hat, eye, lamp, twin = r4.Cone(), r4.Sphere(), r4.Light("point"), r4.Box()
    hat.translate(robot.position + [0, 0, 1.5])
    eye.translate((0, 5, 0))
    eye.apply(r4.LookAt(robot.position))
    lamp.color = robot.paint
    twin.size = r4.vec(robot.radius, 3 * np.sin(robot.position[0]) ** 2, 1)
    twin.visible = robot.position[0] > 2
    for t in (0.0, 1.0, 3.0):
        assert np.allclose(hat.position.at(t), [t, 0, 1.5])
        to = robot.position.at(t) - (0, 5, 0)
        assert np.allclose(eye.matrix.at(t)[:3, :3] @ (0, 0, -1), to / np.linalg.norm(to))
        assert np.allclose(lamp.color.at(t), robot.paint.at(t))
        assert np.allclose(twin.size.at(t), [0.5, 3 * math.sin(t) ** 2, 1])
        assert twin.visible.at(t) is (t > 2)


def test_a_colour_that_follows_another_object() -> None:
    """F082: colour matching another object: whatever is done to one, changes and settings alike, is seen."""
    leader, follower = named("leader", r4.Sphere(color="red")), named("follower", r4.Sphere())
    follower.color = leader.paint
    assert np.array_equal(follower.paint.at(0), r4.color("red"))
    fade = leader.apply(r4.Color("blue", enabled=r4.keys({0: 0, 2: 1}, interpolation="step")))
    assert np.array_equal(follower.paint.at(1), r4.color("red"))
    assert np.array_equal(follower.paint.at(2), r4.color("blue"))
    with r4.log() as events:
        fade.enabled.source.move(2, 3)
    assert {"leader.paint", "follower.color", "follower.paint"} <= marked(events)
    assert all(event.lo >= 2 and event.hi <= 3 for event in events)
    with r4.log() as events:
        leader.translate((1, 0, 0))
    assert "follower.paint" not in marked(events)


def test_values_of_any_type_may_be_references() -> None:
    """F081: numbers, strings, vectors, functions, object identifiers and lists nested without limit, kept and asked."""
    ball, box = r4.Sphere(), r4.Box()
    tree = (ball, "-", (box, "|", (ball, "&", box)))
    for value in (3.5, "north", (1.0, 2.0, 3.0), len, ball, tree, [1, [2, [3, "x"]]], None):
        box.parameters["payload"] = value
        found = box.parameters["payload"].at(0)
        assert found == value or found == (1, (2, (3, "x")))
    box.parameters["payload"] = r4.keys({0: ball, 2: box}, kind="held")
    assert [box.parameters["payload"].at(t) for t in (0, 2)] == [ball, box]
    assert box.parameters["payload"].at(0).radius.at(0) == 0.5
    second = r4.Variable(tree)[2]
    assert second.at(0)[0] is box


def test_a_reference_may_vary_with_time() -> None:
    """F001: references vary: a camera looks at one and then the other; a hand moves in one system, then another."""
    first, second, camera = named("first", r4.Sphere()), named("second", r4.Sphere()), r4.Camera()
    first.translate(r4.vec(r4.time, 0, 0))
    second.translate((0, 5, 0))
    camera.target = r4.keys({0: first.position, 2: first.position, 4: second.position})
    assert camera.target.at(1).tolist() == [1, 0, 0]
    assert camera.target.at(4).tolist() == [0, 5, 0]
    hand = r4.Box()
    hand.apply(r4.LinkedXForm(r4.keys({0: first, 3: second}, kind="held")))
    assert [hand.position.at(t).tolist() for t in (2, 3)] == [[2, 0, 0], [0, 5, 0]]
    # Whoever is not looked at is not asked.
    camera.matrix.at(9)
    with r4.log() as events:
        first.translate((0, 0, 1))
        camera.matrix.at(9)
    assert "first.position" not in evaluated(events)


def test_linked_xform() -> None:
    """
    F096: object 1 uses the coordinate system of object 2; edit 2 -> 1 is only *marked*; it is recomputed at the next
    request.
    """
    two, one = named("two", r4.Box()), named("one", r4.Sphere())
    turn = two.rotate(0)
    one.translate((1, 0, 0))
    one.apply(r4.LinkedXForm(two))
    one.mesh.at(0)
    one.position.at(0)
    with r4.log() as events:
        turn.angle = 90
    assert {"one.matrix", "one.position", "one.mesh"} <= marked(events)
    assert evaluated(events) == []
    with r4.log() as events:
        assert np.allclose(one.position.at(0), [0, 1, 0])
    assert "one.points" not in evaluated(events)
    two.scale(3)
    assert np.allclose(one.bounds.at(0), [[-1.5, 1.5, -1.5], [1.5, 4.5, 1.5]], atol=0.02)


def test_a_point_of_a_path_of_a_revolution_of_a_combination() -> None:
    """F091: move a point -> path -> object of revolution -> CSG: all change; who is not made of it does not."""
    p = named("p", r4.Point((1, 0, 0.5)))
    path = named("path", r4.Path([(0.5, 0, 0), p, (0.5, 0, 1)], interpolation="linear", samples=2))
    vase = named("vase", r4.Revolution(path, segments=16))
    block, part = named("block", r4.Box((4, 4, 4))), None
    part = named("part", block - vase)
    before = part.volume.at(0)
    vase.mesh.at(0)
    block.mesh.at(0)
    with r4.log() as events:
        p.translate((0.25, 0, 0))
    assert {"path.points", "vase.surface", "part.volume"} <= marked(events)
    assert not [name for name in marked(events) if name.startswith("block")]
    assert part.volume.at(0) < before
    assert vase.bounds.at(0)[1, 0] == pytest.approx(1.25)


def test_cycles_of_references_are_found_with_the_path() -> None:
    """F012: in general cycles in references are detected; the path is named, and the rest of the scene answers."""
    a, b, c = named("a", r4.Sphere()), named("b", r4.Sphere()), named("c", r4.Sphere())
    a.translate(b.position)
    b.translate(c.position)
    close = c.translate(a.position + 1, enabled=r4.keys({0: 0, 2: 1}, interpolation="step"))
    assert a.position.at(0).tolist() == [0, 0, 0]
    with pytest.raises(r4.CycleError, match=r"a\.position.*b\.position.*c\.position|c\.position.*a\.position"):
        a.position.at(3)
    assert a.points.at(3).shape[1] == 3
    close.offset = (1, 0, 0)
    assert a.position.at(3).tolist() == [1, 0, 0]
    # A group that would be its own member.
    group = r4.Group(a=a)
    group.members = {"group": group}
    with pytest.raises(r4.CycleError):
        group.mesh.at(0)


# -- one sends to another ----------------------------------------------------------------------------------------------


def test_who_sends_remembers_what_it_sent_to_whom() -> None:
    """
    F077: "The recipient object receives a new change operator, corresponding to the message. The sending object
    creates a new change operator for itself, so that it can remember who it sent the message to, and what it was."
    """
    sun, flower, other = named("sun", r4.Sphere()), named("flower", r4.Cone()), named("other", r4.Cone())
    sun.translate(r4.vec(r4.time, 0, 5))
    turn = sun.send(r4.LookAt(sun.position, forward="z"), to=flower)
    tint = sun.send(r4.Color("gold"), to=other)
    assert list(flower.changes) == [turn]
    assert flower.changes.owner(turn) is flower
    assert sun.notes.at(0) == ((flower, turn), (other, tint))
    assert len(sun.changes) == 3
    to = sun.position.at(3)
    assert np.allclose(flower.matrix.at(3)[:3, :3] @ (0, 0, 1), to / np.linalg.norm(to))
    # Knowing it, the sender edits what it sent.
    for receiver, change in sun.notes.at(0):
        if receiver is other:
            change.value = "red"
    assert np.array_equal(other.paint.at(0), r4.color("red"))
    # What is stored concerns nobody but who asks for it.
    sun.mesh.at(0)
    with r4.log() as events:
        sun.withdraw(tint)
    assert list(other.changes) == []
    assert sun.notes.at(0) == ((flower, turn),)
    assert not marked(events) & {"sun.mesh", "sun.position", "flower.matrix"}
    with pytest.raises(ValueError, match="not sent"):
        sun.withdraw(tint)


@pytest.mark.parametrize(
    ("change", "to"), [("turn", None), (r4.Scale(2), "flower"), (r4.Scale(2), None), (None, r4.Sphere()), (3, 4)]
)
def test_what_cannot_be_sent_is_refused_and_nothing_is_remembered(change: Any, to: Any) -> None:
    """At the border: a clear error, both lists as they were."""
    sun, flower = r4.Sphere(), r4.Cone()
    with pytest.raises((TypeError, r4.Reactive4dError), match="expected"):
        sun.send(change, to=flower if to is None and isinstance(change, str) else to)
    assert len(sun.changes) == len(flower.changes) == 0
    with pytest.raises(ZeroDivisionError), r4.transaction():  # noqa: PT012
        sun.send(r4.Scale(2), to=flower)
        raise ZeroDivisionError
    assert len(sun.changes) == len(flower.changes) == 0
    assert sun.notes.at(0) == ()


def test_a_list_stores_whatever_others_may_ask_for() -> None:
    """F076: changes that merely store arbitrary data in the state; they vary, are inherited, and act for a while."""

    class Price(r4.Note):
        euros = r4.Float()

        @staticmethod
        def note(euros: float) -> dict[str, float]:
            return {"price": euros}

    vase = r4.Cylinder()
    copy = vase.extend()
    vase.apply(Price(r4.keys({0: 10.0, 2: 30.0})))
    sale = copy.apply(Price(1, enabled=r4.time >= 5))
    assert vase.notes.at(1) == ({"price": 20.0},)
    assert copy.notes.at(5) == ({"price": 30.0}, {"price": 1.0})
    tag = r4.Label(copy.notes.map(lambda notes: f"{notes[-1]['price']:.0f} EUR"))
    assert [tag.text.at(t) for t in (0, 6)] == ["10 EUR", "1 EUR"]
    sale.euros = 2
    assert tag.text.at(6) == "2 EUR"


# -- the figure that watches a fly -------------------------------------------------------------------------------------


class World:
    """
    F093: chair (CSG), figure (ducts on spline paths of points), a fly that asks its path for position and tangent, and
    orients along it; the eyes ask the fly for its position, and track it.

        points --> fly's path --> fly.matrix --> fly.position --> eyes
        points --> spine --> body                                   boxes --> chair
    """

    def __init__(self) -> None:
        self.way = [named(f"way{i}", r4.Point((i, i * (3 - i), 1))) for i in range(4)]
        self.path = named("path", r4.Path(self.way))
        share = np.clip(r4.time / 10, 0, 1)
        place, along = self.path.along(share), self.path.tangent_along(share)
        self.fly = named("fly", r4.Sphere(radius=0.05, segments=6, rings=3))
        self.fly.translate(place)
        self.fly.apply(r4.LookAt(place + along, forward="x"))
        self.eyes = [named(f"eye{i}", r4.Sphere(radius=0.03, segments=6, rings=3)) for i in range(2)]
        for i, eye in enumerate(self.eyes):
            eye.translate((0.1 * i, 2, 1.7))
            eye.apply(r4.LookAt(self.fly.position))
        self.bones = [named(f"bone{i}", r4.Point((0, 2.2, 0.5 * i))) for i in range(3)]
        self.spine = named("spine", r4.Path(self.bones, samples=8))
        belt = named("belt", r4.Circle(0.2, segments=8))
        self.body = named("body", r4.Duct([belt, named("chest", r4.Circle(0.3, segments=8))], path=self.spine))
        seat, back = named("seat", r4.Box((1, 1, 0.1))), named("back", r4.Box((1, 0.1, 1)))
        self.chair = named("chair", seat | back)
        self.scene = r4.Scene(fly=self.fly, eye0=self.eyes[0], eye1=self.eyes[1], body=self.body, chair=self.chair)


def test_the_fly_flies_along_its_path_and_the_eyes_follow() -> None:
    """The fly is where its path is, looks where it goes, and both eyes look at it."""
    world = World()
    for t in (0.0, 3.0, 7.5, 10.0):
        share = t / 10
        assert np.allclose(world.fly.position.at(t), world.path.along(share).at(t))
        turn = world.fly.matrix.at(t)[:3, :3]
        assert np.allclose(turn @ (1, 0, 0), world.path.tangent_along(share).at(t), atol=1e-6)
        for eye in world.eyes:
            to = world.fly.position.at(t) - eye.position.at(t)
            assert np.allclose(eye.matrix.at(t)[:3, :3] @ (0, 0, -1), to / np.linalg.norm(to))


def test_editing_a_point_of_the_fly_s_path_concerns_the_path_the_fly_and_the_eyes() -> None:
    """
    F093: edit one path point -> only path spline, fly CTM, eye orientation and their dependants are recomputed, each
    once; everything else is answered from cache: the chair and the body are not even marked, and no mesh is made
    again.
    """
    world = World()
    for t in (0.0, 5.0):
        world.scene.at(t)
    with r4.log() as events:
        world.way[2].translate((0, 0, 0.5))
    assert evaluated(events) == []
    heard = {name.split(".")[0] for name in marked(events)}
    assert {"way2", "path", "fly", "eye0", "eye1"} <= heard
    assert not heard & {"chair", "seat", "back", "body", "spine", "belt", "bone0", "way0", "way1"}
    with r4.log() as events:
        world.scene.at(5.0)
    found = evaluated(events)
    # Of one name are what the path makes of its points, and what it answers to the fly.
    assert {name for name in found if found.count(name) > 1} <= {"path.tangent_along"}
    assert {"path.controls", "path.along", "path.tangent_along", "fly.matrix", "fly.position"} <= set(found)
    assert {"eye0.matrix", "eye1.matrix"} <= set(found)
    assert not [name for name in found if name.endswith((".surface", ".faces", ".mesh", ".uv"))]
    assert not [name for name in found if name.startswith(("fly.points", "eye0.points", "chair", "body", "spine"))]
    with r4.log() as events:
        world.scene.at(5.0)
    assert evaluated(events) == []


def test_editing_a_point_of_the_figure_s_duct_concerns_its_spline_and_its_duct() -> None:
    """
    F093: a point of the path along which the *figure's duct* runs: its matrix, spline and duct are recomputed; the fly,
    the eyes and the chair are untouched.
    """
    world = World()
    for t in (0.0, 5.0):
        world.scene.at(t)
    before = world.body.points.at(5)
    with r4.log() as events:
        world.bones[1].translate((0.3, 0, 0))
    heard = {name.split(".")[0] for name in marked(events)}
    assert {"bone1", "spine", "body"} <= heard
    assert not heard & {"fly", "path", "eye0", "eye1", "chair", "seat", "back", "bone0", "bone2", "belt", "chest"}
    with r4.log() as events:
        world.scene.at(5.0)
    found = evaluated(events)
    assert len({"bone1.matrix", "bone1.position", "spine.controls", "body.along_path"} & set(found)) == 4
    assert found.count("bone1.matrix") == found.count("spine.controls") == found.count("body.along_path") == 1
    assert not [name for name in found if name.startswith(("fly", "eye", "chair", "path", "belt", "bone0"))]
    assert not np.array_equal(world.body.points.at(5), before)


def test_what_the_path_told_the_eye_is_remembered_too() -> None:
    """F094: generic inquiries (the path's answer) are cached too, not just geometry."""
    world = World()
    place = world.path.along(0.5)
    first = place.at(0)
    with r4.log() as events:
        assert place.at(3) is first
        world.fly.position.at(2)
        world.fly.position.at(2)
    assert evaluated(events).count("fly.position") == 1
    assert place.valid(0) == r4.FOREVER
