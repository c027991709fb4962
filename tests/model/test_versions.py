"""Versions: what of a node a viewer has to be sent, and what it has already."""

from typing import Any
from unittest import mock

import numpy as np
import pytest

import reactive4d as r4
from reactive4d import references
from reactive4d.references import reference


def differing(before: Any, after: Any) -> list[str]:
    """The channels of two nodes with other versions."""
    assert list(before.versions) == list(after.versions)
    return [channel for channel in before.versions if before.versions[channel] != after.versions[channel]]


def test_a_rigid_move_changes_the_matrix_alone():
    """What only moves costs a viewer nothing but its matrix."""
    ball = r4.Sphere(color="red")
    ball.translate(r4.vec(r4.time, 0, 0))
    ball.rotate(90 * r4.time, axis="y")
    scene = r4.Scene(ball=ball)
    nodes = [scene.at(t)["ball"] for t in (0.0, 1.0, 0.0)]
    assert differing(nodes[0], nodes[1]) == ["matrix"]
    assert differing(nodes[0], nodes[2]) == []
    assert set(nodes[0].versions) == {"drawn", "visible", "color", "matrix", "points", "topology", "paints"}
    assert all(len(version) == 32 and int(version, 16) >= 0 for version in nodes[0].versions.values())


def test_a_deformation_changes_the_points_alone():
    """A bar that bends keeps its faces; so does one that grows."""
    bar = r4.Box(size=(1, 1, 4), segments=(1, 1, 8))
    bar.apply(r4.Bend(10 * r4.time, axis="x"))
    scene = r4.Scene(bar=bar)
    assert differing(scene.at(0.0)["bar"], scene.at(1.0)["bar"]) == ["points"]
    finer = r4.Box(size=(1, 1, 4), segments=(1, 1, 9))
    assert "topology" in differing(scene.at(0.0)["bar"], r4.Scene(bar=finer).at(0.0)["bar"])


def test_each_channel_has_a_version_of_its_own():
    """Colour, opacity, visibility, what is drawn at all: each shows where it belongs."""
    ball = r4.Sphere(color=r4.keys({0: "red", 1: "blue"}), opacity=r4.keys({2: 1.0, 3: 0.5}))
    scene = r4.Scene(ball=ball)
    assert differing(scene.at(0.0)["ball"], scene.at(0.5)["ball"]) == ["color"]
    assert differing(scene.at(2.0)["ball"], scene.at(3.0)["ball"]) == ["color"]
    lamp = r4.Light("point", intensity=r4.keys({0: 1.0, 1: 2.0}))
    text = r4.Label(r4.keys({0: "a", 1: "b"}, interpolation="step", kind="held"))
    eye = r4.Camera(fov=r4.keys({0: 30.0, 1: 40.0}))
    views = r4.Scene(lamp=lamp, text=text, eye=eye)
    for name in views:
        assert differing(views.at(0.0)[name], views.at(1.0)[name]) == ["settings"]
    shown = r4.Sphere(visible=r4.time < 1)
    before, after = (r4.Scene(it=shown).at(t)["it"] for t in (0.0, 2.0))
    assert before.versions["visible"] != after.versions["visible"]
    assert before.versions["drawn"] != after.versions["drawn"]
    assert set(after.versions) == {"drawn", "visible", "color", "matrix"}


def test_equal_versions_mean_equal_content_whoever_made_it():
    """Two spheres of one size are one to a viewer; a colour for each face is none of its points."""
    frame = r4.Scene(a=r4.Sphere(0.3, color="red"), b=r4.Sphere(0.3, color="red"), c=r4.Sphere(0.4)).at(0.0)
    assert differing(frame["a"], frame["b"]) == []
    assert differing(frame["a"], frame["c"]) == ["color", "points"]
    assert frame["a"].versions["points"] == reference(frame["a"].drawn.points)
    part = r4.Scene(it=r4.Box(color=r4.keys({0: "red", 1: "blue"})) - r4.Box(size=(0.5, 0.5, 2)))
    assert differing(part.at(0.0)["it"], part.at(1.0)["it"]) == ["paints"]


def test_a_still_mesh_is_hashed_once():
    """A version is computed when it is asked for; that of a large array once, for all nodes and times that show it."""
    ball = r4.Sphere(segments=64, rings=32)
    ball.translate(r4.vec(r4.time, 0, 0))
    copy = ball.extend()
    scene = r4.Scene(ball=ball, copy=copy, group=r4.Group(a=ball.extend()))
    with mock.patch.object(references, "_digest", wraps=references._digest) as digest:
        frames = [scene.at(t) for t in (0.0, 1.0, 2.0, 1.0)]
        assert digest.call_count == 0
        for frame in frames:
            for name in ("ball", "copy", "group/a"):
                assert len(dict(frame[name].versions)) == 7
        large = [call for call in digest.call_args_list if call.args[0].nbytes >= 1024]
    kinds = sorted({call.args[0].shape for call in large})
    assert len(large) == len(kinds), "points, faces, weld and uv, once each"
    # Of a bar that bends the points are hashed anew, the faces are not.
    bar = r4.Box(size=(1, 1, 4), segments=(8, 8, 16))
    bar.apply(r4.Bend(10 * r4.time, axis="x"))
    bent = r4.Scene(bar=bar)
    dict(bent.at(0.0)["bar"].versions)
    with mock.patch.object(references, "_digest", wraps=references._digest) as digest:
        dict(bent.at(1.0)["bar"].versions)
    assert [call.args[0].shape for call in digest.call_args_list if call.args[0].nbytes >= 1024] == [
        bar.points.at(1.0).shape
    ]


def test_the_memory_of_a_reference_goes_with_its_array():
    """What nobody holds any more is forgotten; what somebody can write to is never remembered."""
    known = len(references._known)
    frozen = np.zeros((200, 3))
    frozen.flags.writeable = False
    first = reference(frozen)
    assert (len(references._known), reference(frozen)) == (known + 1, first)
    view = frozen[:100]
    assert reference(view) == reference(np.zeros((100, 3)))
    del view, frozen
    assert len(references._known) == known
    open_ = np.zeros((200, 3))
    assert reference(open_) == first
    seen = open_[:]
    seen.flags.writeable = False
    reference(seen)
    open_[0] = 1.0
    assert reference(open_) != first
    assert reference(seen) == reference(open_)
    assert len(references._known) == known


def test_a_version_that_does_not_exist_is_a_key_error():
    """A mapping like any other."""
    node = r4.Scene(lamp=r4.Light()).at(0.0)["lamp"]
    with pytest.raises(KeyError):
        node.versions["points"]
    assert len(node.versions) == 5
    assert "settings" in repr(node.versions)


def test_settings_that_cannot_be_told_by_a_text_are_never_equal():
    """A user's lamp that holds something of its own: rather sent again than wrongly kept."""

    class Lantern(r4.Light):
        glass = r4.Held(None)

    lamp = Lantern("point", glass=object())
    node = r4.Scene(lamp=lamp).at(0.0)["lamp"]
    again = r4.Scene(lamp=lamp).at(0.0)["lamp"]
    assert node.primitive == "light"
    assert node.versions["settings"] == node.versions["settings"]
    assert isinstance(again.versions["settings"], str)


def test_every_kind_says_as_what_it_is_drawn():
    """Exactly one of mesh, lines, points, label, light, camera, none."""
    apart = r4.Box() & r4.Box(size=(0.1, 0.1, 0.1))
    far = r4.Box()
    far.translate((9, 0, 0))
    scene = r4.Scene(
        mesh=apart,
        lines=r4.Path([(0, 0, 0), (1, 0, 0)]),
        points=r4.Point(),
        label=r4.Label("a"),
        light=r4.Light(),
        camera=r4.Camera(),
        none=r4.Box() & far,
        group=r4.Group(a=r4.Box()),
        object=r4.Object(),
    )
    drawn = {name: node.primitive for name, node in scene.at(0.0).items()}
    assert drawn == {
        **{name: name for name in ("mesh", "lines", "points", "label", "light", "camera", "none")},
        "group": "none",
        "group/a": "mesh",
        "object": "none",
    }
    with pytest.raises(TypeError, match="a path has no mesh"):
        _ = scene.at(0.0)["lines"].mesh


def test_paths_and_points_are_drawn_where_they_are():
    """A line runs through its points; a ring comes back to the first; several lines stay apart."""
    ring, way = r4.Circle(2.0, segments=6), r4.Path([(0, 0, 0), (1, 0, 0)], samples=4)
    p = r4.Point((1, 2, 3))
    p.translate((0, 0, r4.time))
    frame = r4.Scene(ring=ring, way=way, p=p).at(2.0)
    assert frame["way"].drawn.lines is None
    assert frame["ring"].drawn.lines.tolist() == [[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [5, 0]]
    assert np.allclose(frame["p"].drawn.points @ frame["p"].matrix[:3, :3].T + frame["p"].matrix[:3, 3], [1, 2, 5])

    class Ladder(r4.Object):
        table = r4.Table(
            points=lambda: np.array([(0, 0, 0), (1, 0, 0), (0, 0, 1), (1, 0, 1)], np.float32),
            lines=lambda: [[0, 1], [2, 3]],
        )

    drawn = r4.Scene(it=Ladder()).at(0.0)["it"].drawn
    assert drawn.lines.tolist() == [[0, 1], [2, 3]]
    assert not drawn.lines.flags.writeable
    assert drawn == r4.Scene(it=Ladder()).at(0.0)["it"].drawn
    assert drawn != frame["way"].drawn
    assert (drawn.nbytes, r4.Points(drawn.points).nbytes) == (48 + 16, 48)
    assert r4.Points(drawn.points) == r4.Points(drawn.points.copy()) != drawn


def test_opacity_and_visibility_go_through_groups():
    """What is done to a group is done to its members: they are moved, faded and hidden with it."""
    lamp = r4.Sphere(opacity=0.5)
    car = r4.Group(inner=r4.Group(lamp=lamp), body=r4.Box())
    car.opacity = r4.keys({0: 1.0, 2: 0.0})
    car.visible = r4.time < 3
    scene = r4.Scene(car=car)
    for t, share in ((0.0, 1.0), (1.0, 0.5), (2.0, 0.0)):
        frame = scene.at(t)
        assert frame["car/inner/lamp"].opacity == pytest.approx(0.5 * share)
        assert frame["car/body"].opacity == pytest.approx(share)
        assert all(node.visible for node in frame.values())
    assert lamp.opacity.at(1.0) == 0.5
    hidden = scene.at(4.0)
    assert list(hidden) == list(frame)
    assert not any(node.visible or node.drawn for node in hidden.values())
    inner = r4.Group(a=r4.Box())
    inner.visible = False
    frame = r4.Scene(outer=r4.Group(inner=inner, b=r4.Box())).at(0.0)
    assert {name: node.visible for name, node in frame.items()} == {
        "outer": True,
        "outer/inner": False,
        "outer/inner/a": False,
        "outer/b": True,
    }


def test_what_is_hidden_is_not_computed():
    """Members of an invisible group keep their names, and nobody computes what they look like."""
    blob = r4.Blob([(0, 0, 0)], radii=0.5)
    group = r4.Group(blob=blob)
    group.visible = False
    scene = r4.Scene(group=group)
    with r4.log() as events:
        assert list(scene.at(0.0)) == ["group", "group/blob"]
    assert not [event for event in events if event.kind == "evaluated" and "points" in event.name]


def test_opacity_and_visibility_go_through_prototypes():
    """They are settings like others: the prototype's until set, and its again when deleted."""
    first = r4.Sphere(opacity=r4.keys({0: 0.0, 1: 1.0}), visible=r4.time < 5)
    second = first.extend()
    scene = r4.Scene(first=first, second=second)
    assert scene.at(0.25)["second"].opacity == 0.25
    assert [scene.at(t)["second"].visible for t in (0, 6)] == [True, False]
    second.opacity = 0.5
    second.visible = True
    assert (scene.at(0.25)["second"].opacity, scene.at(6)["second"].visible) == (0.5, True)
    del second.opacity
    del second.visible
    assert (scene.at(0.25)["second"].opacity, scene.at(6)["second"].visible) == (0.25, False)
    with pytest.raises(r4.ShapeError, match="opacity: expected a number from 0 to 1, got 2"):
        first.opacity = 2
