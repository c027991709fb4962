"""Prototypes and extensions: one order of all changes, whoever's they are."""

import math
from typing import Any

import numpy as np
import pytest

import reactive4d as r4


def evaluated(events: Any, part: str = "") -> list[str]:
    """What was computed, by name."""
    return sorted(event.name for event in events if event.kind == "evaluated" and part in event.name)


def test_an_extension_receives_the_entire_state() -> None:
    """F009: later changes to the prototype show up in all extensions; changes to the extension affect it only."""
    egg = r4.Sphere(radius=2, color="ivory")
    egg.scale((1, 1, 1.5))
    sphere = egg.extend()
    other = egg.extend()
    assert sphere.bounds.at(0).tolist() == egg.bounds.at(0).tolist()
    assert np.array_equal(sphere.paint.at(0), r4.color("ivory"))
    egg.translate((1, 0, 0))
    egg.color = "red"
    assert sphere.position.at(0).tolist() == [1, 0, 0]
    assert np.array_equal(sphere.paint.at(0), r4.color("red"))
    sphere.translate((0, 5, 0))
    sphere.color = "blue"
    sphere.radius = 1
    assert egg.position.at(0).tolist() == other.position.at(0).tolist() == [1, 0, 0]
    assert sphere.position.at(0).tolist() == [1, 5, 0]
    assert np.array_equal(other.paint.at(0), r4.color("red"))
    assert other.volume.at(0) == egg.volume.at(0) == pytest.approx(8 * sphere.volume.at(0))
    del sphere.color, sphere.radius
    assert np.array_equal(sphere.paint.at(0), r4.color("red"))
    assert sphere.volume.at(0) == egg.volume.at(0)


def test_the_rivets_of_figure_2() -> None:
    """
    F011: "Each rivet is transformed independently, spun around, scaled, bent, etc. We can now translate *every* rivet
    in the scene by translating the prototype rivet. This change will occur in world space if we apply it *after* the
    changes to the new rivets." Light arrows are performed before extending the prototype, dark ones after: the light
    ones are turned and scaled with each rivet, the dark one is not.
    """
    rivet = r4.Cylinder(radius=0.1, height=0.4)
    light = rivet.translate((1, 0, 0))
    rivets = [rivet.extend() for _ in range(4)]
    for i, one in enumerate(rivets):
        one.rotate(90 * i, axis="z")
        one.scale(1 + i)
    dark = rivet.translate((0, 0, 10))
    for i, one in enumerate(rivets):
        turned = [math.cos(math.pi / 2 * i), math.sin(math.pi / 2 * i), 0]
        assert np.allclose(one.position.at(0), (1 + i) * np.array(turned) + [0, 0, 10])
    # Later edits of either one are seen by all, each in its own way.
    light.offset = (2, 0, 0)
    dark.offset = r4.vec(0, 0, r4.time)
    assert np.allclose(rivets[1].position.at(3), [0, 4, 3])
    assert np.allclose(rivets[2].position.at(3), [-6, 0, 3])
    assert np.allclose(rivet.position.at(3), [2, 0, 3])
    # A change inserted before acts before: the rivets are stretched along their own axes, not along the world's.
    rivet.changes.insert(0, r4.Scale((1, 1, 2)))
    assert np.allclose(rivets[3].bounds.at(0)[:, 2], [-1.6, 1.6])
    assert [type(change).__name__ for change in rivets[0].changes] == [
        "Scale", "Translate", "Rotate", "Scale", "Translate",
    ]  # fmt: skip


def test_inserting_means_right_after_the_entry_before() -> None:
    """Places: at i right after entry i - 1 of that list, at 0 right after the creation of the oldest prototype."""
    first = r4.Sphere()
    a = first.translate((1, 0, 0))
    second = first.extend()
    b = second.rotate(90)
    c = first.translate((0, 0, 1))
    assert list(second.changes) == [a, b, c]
    mine = r4.Scale(2)
    second.changes.insert(0, mine)
    assert list(second.changes) == [mine, a, b, c]
    assert list(first.changes) == [a, c]
    late = r4.Scale(3)
    first.changes.insert(1, late)  # right after a, so before b
    assert list(second.changes) == [mine, a, late, b, c]
    second.changes.move(mine, after=c)
    assert list(second.changes) == [a, late, b, c, mine]
    second.changes.move(mine, before=late)
    assert list(second.changes) == [a, mine, late, b, c]
    assert [second.changes.owner(change) is first for change in second.changes] == [True, False, True, False, True]


@pytest.mark.parametrize(
    "edit",
    [
        lambda obj, change: obj.changes.remove(change),
        lambda obj, change: obj.changes.move(change, after=obj.changes[-1]),
        lambda obj, change: obj.changes.__setitem__(0, r4.Scale(2)),
        lambda obj, change: obj.changes.__delitem__(0),
        lambda obj, change: obj.changes.clear(),
        lambda obj, change: obj.changes.reverse(),
    ],
)
def test_what_is_inherited_is_edited_where_it_stands(edit: Any) -> None:
    """Deleting or moving an inherited entry is an error that names the owner, and nothing is changed."""
    rivet = r4.Cylinder()
    rivet.name = "rivet"
    inherited = rivet.translate((1, 0, 0))
    copy = rivet.extend()
    own = copy.rotate(90)
    with pytest.raises(r4.Reactive4dError, match="rivet"):
        edit(copy, inherited)
    assert list(copy.changes) == [inherited, own]
    assert list(rivet.changes) == [inherited]


def test_extensions_share_what_they_have_in_common() -> None:
    """A thousand rivets have one set of points and triangles, and a thousand matrices."""
    rivet = r4.Cylinder(radius=0.1, height=0.2, segments=8)
    rivet.name = "rivet"
    rivet.apply(r4.Taper(-0.5))
    rivet.rotate(30)
    rivets = [rivet.extend() for _ in range(1000)]
    for i, one in enumerate(rivets):
        one.name = f"rivet{i}"
        one.translate((i, 0, 0))
    with r4.log() as events:
        meshes = [one.surface.at(0) for one in rivets]
        matrices = [one.matrix.at(0) for one in rivets]
    assert len({id(mesh.points) for mesh in meshes}) == 1
    assert len({id(mesh.faces) for mesh in meshes}) == 1
    assert len({matrix.tobytes() for matrix in matrices}) == 1000
    assert evaluated(events, "taper.points") == ["rivet.taper.points"]
    assert evaluated(events, "rivet.(rotate)") == ["rivet.(rotate)"]
    # One of its own: the others go on sharing.
    rivets[7].radius = 0.3
    rivets[8].color = "red"
    with r4.log() as events:
        assert len({id(one.points.at(0)) for one in rivets}) == 2
    assert evaluated(events, "taper.points") == ["rivet.taper.points"]
    assert rivets[8].points.at(0) is rivet.points.at(0)


def test_a_colour_of_ones_own_is_no_news_to_the_shape() -> None:
    """What an extension sets touches the channels that read it."""
    ball = r4.Sphere(segments=6, rings=3)
    copy = ball.extend()
    copy.name = "copy"
    copy.mesh.at(0)
    copy.paint.at(0)
    with r4.log() as events:
        copy.color = "red"
    assert {event.name for event in events if event.kind == "marked"} == {"copy.color", "copy.paint"}


def test_a_setting_of_an_extension_goes_back_to_the_prototypes() -> None:
    """`del` goes back to what is inherited: a constant, keys, or the kind's default; `.source` reads it back."""
    ball = r4.Sphere(radius=r4.keys({0: 1, 2: 3}))
    copy = ball.extend()
    assert copy.radius.source is ball.radius.source
    assert (copy.radius.is_set, ball.radius.is_set) == (False, True)
    copy.radius = 5
    assert (copy.radius.source, copy.radius.at(1)) == (5, 5)
    del copy.radius
    assert copy.radius.at(1) == 2
    del ball.radius
    assert copy.radius.at(1) == 0.5
    ball.parameters["flavour"] = "mint"
    assert copy.parameters["flavour"].at(0) == "mint"
    assert "flavour" in copy.parameters


def test_the_car_whose_model_year_switches() -> None:
    """F010: the prototype relation may vary with time: one object "car", whose prototypes switch over time."""
    model1990 = r4.Box(size=(4, 2, 1), color="maroon")
    model1991 = r4.Box(size=(5, 2, 1), color="navy")
    model1991.translate((0, 0, 0.5))
    car = r4.Object()
    car.name = "car"
    car.prototype = r4.keys({0: model1990, 10: model1991}, kind="held")
    car.translate(r4.vec(r4.time, 0, 0))
    assert [car.volume.at(t) for t in (0, 9.9, 10)] == [8, 8, 10]
    assert car.kind.at(5) is r4.Box
    assert np.array_equal(car.paint.at(12), r4.color("navy"))
    assert car.position.at(12).tolist() == [12, 0, 0.5]
    assert car.surface.valid(3).stop == 10
    assert [type(change).__name__ for change in car.changes.at(12)] == ["Translate", "Translate"]
    with pytest.raises(r4.Reactive4dError, match="varies") as raised:
        len(car.changes)
    assert any("changes.at" in note for note in raised.value.__notes__)
    # Its own changes are edited all the same.
    own = car.rotate(90)
    car.changes.remove(own)
    assert car.position.at(12).tolist() == [12, 0, 0.5]
    model1991.size = (6, 2, 1)
    assert [car.volume.at(t) for t in (0, 10)] == [8, 12]
    # The switch itself is edited: only where the years differ something is marked.
    with r4.log() as events:
        car.prototype.source.move(10, 11)
    assert all(event.lo >= 10 and event.hi <= 11 for event in events)
    assert [car.volume.at(t) for t in (10, 11)] == [8, 12]


def test_a_prototype_is_given_and_taken_at_any_moment() -> None:
    """F001: the prototype link varies: with time, and while one works."""
    ball, box = r4.Sphere(radius=2), r4.Box(size=(3, 3, 3))
    ball.translate((1, 0, 0))
    thing = r4.Object()
    own = thing.scale(2)
    assert thing.kind.at(0) is r4.Object
    thing.prototype = ball
    assert (thing.kind.at(0), thing.position.at(0).tolist()) == (r4.Sphere, [2, 0, 0])
    assert list(thing.changes) == [ball.changes[0], own]  # by their places: the ball was moved first
    thing.prototype = box
    assert thing.volume.at(0) == pytest.approx(27 * 8)
    thing.prototype = None
    assert list(thing.changes) == [own]
    assert thing.kind.at(0) is r4.Object


def test_circular_prototypes_are_refused_with_the_path() -> None:
    """F012: circular extension (A <- B <- C <- A) is refused with a clear error; nothing is changed."""
    a = r4.Sphere()
    b, c = a.extend(), None
    c = b.extend()
    for name, obj in (("a", a), ("b", b), ("c", c)):
        obj.name = name
    for other in (a, b, c):
        with pytest.raises(r4.CycleError, match=r"a -> (.* -> )?a"):
            a.prototype = other
    assert a.prototype.at(0) is None
    assert c.kind.at(0) is r4.Sphere
    # Where the prototype varies the circle is found when one asks, at the times when there is one.
    a.prototype = r4.keys({0: r4.Box(), 5: c}, kind="held")
    assert c.kind.at(0) is r4.Box
    with pytest.raises(r4.CycleError, match="reads itself"):
        c.kind.at(6)
    a.prototype = None
    assert c.kind.at(6) is r4.Sphere


@pytest.mark.parametrize("value", ["ball", 3, r4.Sphere, r4.Translate((1, 0, 0))])
def test_what_is_no_object_is_no_prototype(value: Any) -> None:
    """At the border: a clear error, and everything as it was."""
    ball = r4.Sphere()
    with pytest.raises(r4.ShapeError, match="expected an object"):
        ball.prototype = value
    assert ball.prototype.at(0) is None
    ball.prototype = r4.lift(lambda t: "no object")(r4.time)
    with pytest.raises(r4.ShapeError, match="expected an object"):
        ball.position.at(0)


def test_a_chain_of_a_thousand_prototypes() -> None:
    """Chains of prototypes 1,000 deep answer, and hear of an edit at their root; who stands aside does not."""
    root = r4.Sphere(segments=4, rings=2)
    move = root.translate((1, 0, 0))
    chain: list[Any] = [root]
    for _ in range(1000):
        chain.append(chain[-1].extend())
    top = chain[-1]
    assert top.position.at(0).tolist() == [1, 0, 0]
    assert top.points.at(0) is root.points.at(0)
    assert top.radius.at(0) == 0.5
    assert len(top.changes) == 1
    move.offset = (2, 0, 0)
    root.radius = 2
    chain[500].rotate(180)
    assert np.allclose(top.position.at(0), [-2, 0, 0])
    assert top.radius.at(0) == 2
    assert chain[499].position.at(0).tolist() == [2, 0, 0]
    assert top.mesh.at(0).points.shape == root.mesh.at(0).points.shape


def test_of_many_chains_only_the_one_that_moves_is_computed() -> None:
    """Of 20 chains of 50 extensions with one moving root only that chain's matrices are evaluated, each once."""
    chains: list[list[Any]] = []
    for i in range(20):
        root = r4.Sphere()
        root.name = f"root{i}"
        root.translate(r4.vec(r4.time, 0, 0) if i == 7 else (i, 0, 0))
        chain = [root]
        for j in range(50):
            chain.append(chain[-1].extend())
            chain[-1].name = f"c{i}.{j}"
            chain[-1].rotate(10)
        chains.append(chain)
    for t in (0.0, 1.0):
        with r4.log() as events:
            for chain in chains:
                for obj in chain:
                    obj.matrix.at(t)
    found = evaluated(events, ".matrix")
    assert len(found) == len(set(found)) == 51
    assert all(name.startswith(("c7.", "root7.")) for name in found)
    assert len(evaluated(events, "(rotate)")) == 50  # the runs below them
