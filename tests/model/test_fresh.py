"""What a newcomer tries first and last: odd members, odd counts, copies, prototypes of another kind."""

import copy
import pickle
from typing import Any

import pytest

import reactive4d as r4


@pytest.mark.parametrize("kind", [r4.Group, r4.Hull])
@pytest.mark.parametrize("members", [3, 1.5, True, r4.Box, r4.Twist(3), r4.Box()])
def test_members_that_are_no_list_are_refused(kind: Any, members: Any):
    """A number, a class or a single object in place of a list of objects is a ShapeError, not a foreign exception."""
    with pytest.raises(r4.ShapeError, match="members: expected"):
        kind(members)


@pytest.mark.parametrize("segments", [10**9, (10**9, 1)])
def test_a_patch_of_endless_segments_is_refused(segments: Any):
    """Counts that no mesh can have are refused where they are set."""
    with pytest.raises(r4.ShapeError, match=r"Patch\.segments: expected numbers of at most"):
        r4.Patch(segments=segments)


@pytest.mark.parametrize("channel", ["points", "topology", "uv", "mesh"])
def test_a_patch_of_too_many_points_is_refused_before_it_takes_memory(channel: str):
    """Counts that together would take gigabytes are refused, whichever channel is asked."""
    sheet = r4.Patch(segments=16_384)
    with pytest.raises(r4.ShapeError, match="the segment counts make"):
        getattr(sheet, channel).at(0.0)


def test_a_setting_that_the_prototype_does_not_know_is_the_default():
    """A box that extends a sphere has the size of a box until it is set, at all times, also in `source`."""
    box = r4.Box()
    box.prototype = r4.Sphere(radius=2)
    assert box.size.at(0.0).tolist() == [1.0, 1.0, 1.0]
    assert box.size.source.tolist() == [1.0, 1.0, 1.0]
    assert box.volume.at(0.0) == pytest.approx(33.510321638)
    ball = r4.Sphere()
    ball.prototype = r4.keys({0: r4.Box(), 2: r4.Sphere(radius=2)}, interpolation="step")
    assert (ball.radius.at(1.0), ball.radius.at(2.0)) == (0.5, 2.0)
    first: Any = box.prototype_content
    first.parameters["size"] = (1, 2, 3)
    assert box.size.at(0.0).tolist() == [1.0, 2.0, 3.0]


@pytest.mark.parametrize("make", [r4.Box, lambda: r4.Twist(30), lambda: r4.Scene(a=r4.Box())])
def test_what_has_an_identity_is_not_copied(make: Any):
    """A copy would share its insides with the original and change with it: refused, with what to do instead."""
    for attempt in (copy.copy, copy.deepcopy, pickle.dumps):
        with pytest.raises(TypeError, match="cannot be copied or pickled") as caught:
            attempt(make())
        assert "hint" in caught.value.__notes__[0]


def test_a_blob_as_large_as_floats_go_is_refused():
    """Radii whose differences overflow are a ShapeError."""
    with pytest.raises(r4.ShapeError):
        r4.Blob(radii=1e308).mesh.at(0.0)


def test_a_whole_number_beyond_floats_is_refused():
    """Python's whole numbers have no end; what no float holds is refused like infinity."""
    with pytest.raises(r4.ShapeError, match=r"Sphere\.radius: expected a number of at least 0"):
        r4.Sphere(radius=10**400)
    with pytest.raises(r4.ShapeError, match=r"Box\.size: expected"):
        r4.Box(size=(1, 1, 10**400))


def test_a_change_moved_before_itself_stays():
    """Moving a change right before or after itself changes nothing."""
    box = r4.Box()
    twist, bend = box.apply(r4.Twist(3)), box.apply(r4.Bend(3))
    box.changes.move(twist, before=twist)
    box.changes.move(twist, after=twist)
    assert list(box.changes) == [twist, bend]


def test_the_class_of_an_object_is_no_object():
    """A class in place of an object is refused at the border."""
    with pytest.raises(r4.ShapeError, match="expected an object"):
        r4.LinkedXForm(r4.Box)


def test_a_setting_may_be_given_under_its_own_name() -> None:
    """What the constructor calls position is the setting eye: either will do, both are one too many."""
    assert r4.Camera(eye=(1, 2, 3)).eye.at(0.0).tolist() == [1.0, 2.0, 3.0]
    assert r4.Light(light_type="spot").light_type.at(0.0) == "spot"
    assert r4.Label("here", anchor=(1, 0, 0)).position.at(0.0).tolist() == [1.0, 0.0, 0.0]
    assert r4.Prism(outline_of=[(0, 0), (1, 0), (0, 1)]).volume.at(0.0) == pytest.approx(0.5)
    assert r4.Duct([r4.Circle(0.1)], along_path=[(0, 0, 0), (0, 0, 1)]).volume.at(0.0) > 0
    with pytest.raises(TypeError, match="eye was given twice"):
        r4.Camera((0, 0, 0), eye=(1, 2, 3))


def test_places_do_not_grow_when_the_last_two_take_turns() -> None:
    """What is moved behind the last change comes to the end, like what is appended."""
    box = r4.Box()
    twist, bend = box.apply(r4.Twist(3)), box.apply(r4.Bend(3))
    for _ in range(50):
        box.changes.move(twist, after=bend)
        box.changes.move(bend, after=twist)
    assert list(box.changes) == [twist, bend]
    assert all(len(entry.place) == 1 for entry in box.changes.entries)
