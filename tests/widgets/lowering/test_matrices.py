"""Matrices of objects: products of factors, of which each says what its transform says."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import reactive4d as r4
from reactive4d_widgets.lowering import lower, lower_matrix, play, sized

T = r4.time
TIMES = [*np.linspace(-1.0, 6.0, 29).tolist(), 0.0, 1.0, 2.0, 3.0]
TURN = r4.keys({0: r4.Rotation(), 2: r4.Rotation.from_axis_angle((1, 2, 3), 130), 5: r4.Rotation()})
WAY = r4.vec(np.sin(T), T, 2)


def operations(track):
    """What the factors of a product do."""
    return [factor["op"] for factor in track["factors"]]


def assert_agrees(obj, *, above=(), times=TIMES, **given):
    """The product is the object's matrix, within the groups above it."""
    track = lower_matrix(obj, above=above)
    assert track is not None
    for t in times:
        matrix = obj.matrix.at(t, **given)
        for group in above:
            matrix = group.matrix.at(t, **given) @ matrix
        np.testing.assert_allclose(play(track, t, given), matrix.ravel(), rtol=0.0, atol=1e-9)
    return track


TRANSFORMS = {
    "translate": r4.Translate(WAY),
    "rotate": r4.Rotate(90 * T, axis=(1, 1, 0), center=(1, 0, 0)),
    "rotate about what moves": r4.Rotate(30, axis=WAY, center=WAY),
    "orient": r4.Orient(TURN, center=(0, 1, 0)),
    "scale": r4.Scale(1 + T * T),
    "scale by three": r4.Scale(r4.vec(1, 2, 1 + T * T), center=WAY),
    "matrix": r4.Matrix(np.diag([1.0, -2.0, 3.0, 1.0])),
    "moving matrix": r4.Matrix(r4.keys({0: np.eye(4), 2: np.diag([1.0, -2.0, 3.0, 1.0])})),
    "mirror": r4.Mirror((1, 2, 0), center=(0, 0, 1)),
    "shear": r4.Shear((1, 0.5, 0), axis="z", center=(0, 0, 1)),
    "moving shear": r4.Shear(WAY, axis=(0, 1, 1)),
    "look at": r4.LookAt(WAY + (9, 0, 0)),
}


@pytest.mark.parametrize("name", TRANSFORMS)
def test_every_transform_is_a_factor(name):
    """Alone, and between others."""
    alone, among = r4.Box(), r4.Box()
    alone.apply(TRANSFORMS[name])
    among.scale((1, 2, 3))
    among.rotate(40 * T, axis="x")
    among.apply(TRANSFORMS[name])
    among.translate((1, 0, 2))

    assert_agrees(alone)
    assert len(operations(assert_agrees(among))) == 4


@pytest.mark.parametrize("forward", ["x", "-x", "y", "-y", "z", "-z"])
def test_any_axis_may_look(forward):
    """After what turned and stretched the object before."""
    eye = r4.Box()
    eye.apply(r4.Shear((0.5, 0, 0)))
    eye.rotate(50 * T, axis=(1, 1, 0))
    eye.translate((0, 0, T))
    eye.apply(r4.LookAt((4, 5, 6), forward=forward))

    track = assert_agrees(eye)
    assert track["factors"][-1].get("forward", "-z") == forward


def test_a_placement_is_the_first_factor():
    """Of cameras, labels, points."""
    camera = r4.Camera(position=WAY, target=(0, 0, T), up=(0, 1, 1))
    camera.rotate(10 * T)
    label = r4.Label("north", at=WAY)
    point = r4.Point(WAY)

    assert operations(assert_agrees(camera)) == ["look", "rotate"]
    assert operations(assert_agrees(label)) == ["translate"]
    assert operations(assert_agrees(point)) == ["translate"]


def test_what_does_not_move_is_a_constant():
    """However many factors it has."""
    box = r4.Box()
    box.translate((1, 2, 3))
    box.rotate(30, axis="x")
    box.apply(r4.LookAt((5, 5, 5)))

    assert assert_agrees(box)["kind"] == "const"
    assert lower_matrix(r4.Box()) == {"kind": "const", "value": np.eye(4).ravel().tolist()}


def test_parameters_stay_parameters():
    """For every value of theirs the product is right."""
    length, angle = r4.Parameter("length", 1.0), r4.Parameter("angle", 20.0)
    bob = r4.Sphere()
    bob.translate(r4.vec(0, 0, -length))
    bob.rotate(angle * np.cos(np.sqrt(9.81 / length) * T), axis="y")

    for values in ({"length": 1.0, "angle": 20.0}, {"length": 0.3, "angle": -75.0}):
        track = assert_agrees(bob, **values)
    assert "length" in str(track)
    assert "length" not in str(lower_matrix(bob, {"length": 0.3}))


def test_extensions_obey_their_prototype():
    """Its changes are merged by their places."""
    rivet = r4.Cylinder()
    copy = rivet.extend()
    copy.rotate(45 * T, axis="x")
    rivet.translate((0, 0, T))
    rivet.changes.insert(0, r4.Scale((1, 1, 2)))

    assert operations(assert_agrees(copy)) == ["scale", "rotate", "translate"]


def test_only_what_comes_after_the_last_deformation_counts():
    """What came before it is in the points."""
    box = r4.Box()
    box.translate((1, 0, T))
    box.apply(r4.Bend(30, axis="x"))
    box.rotate(45 * T, axis="x")

    assert operations(assert_agrees(box)) == ["rotate"]


def test_groups_act_on_their_members():
    """Their factors follow; what looks asks where it has come to in its own list."""
    ball = r4.Sphere()
    ball.translate(WAY)
    inner = r4.Group(ball=ball)
    inner.rotate(30 * T)
    outer = r4.Group(inner=inner)
    outer.translate((0, 0, 1))
    outer.apply(r4.LookAt(WAY + (0, 9, 0)))

    assert operations(assert_agrees(ball, above=(inner,))) == ["translate", "rotate"]
    assert operations(assert_agrees(ball, above=(inner, outer))) == ["translate", "rotate", "matrix"]


def test_a_linked_object_lends_its_product():
    """It is a product within the product."""
    arm, hand = r4.Box(), r4.Sphere()
    hand.translate((1, 0, 0))
    hand.apply(r4.LinkedXForm(arm))
    arm.rotate(r4.keys({0: 0, 1: 90}))
    arm.apply(r4.LookAt((5, T, 5)))
    alone = r4.Sphere()
    alone.apply(r4.LinkedXForm(None))
    alone.translate(WAY)

    assert operations(assert_agrees(hand)) == ["translate", "matrix"]
    assert_agrees(alone)


@pytest.mark.parametrize(
    "enabled",
    [r4.keys({0: 0, 2: 1, 4: 0}, interpolation="step"), T < 2, (T > 1) & (T < 3), False, r4.lift(lambda x: x)(T > 2)],
    ids=["steps", "before", "between", "never", "opaque"],
)
def test_a_change_may_act_for_a_while(enabled):
    """From one time to the next each list has a product of its own."""
    ball = r4.Sphere()
    ball.translate((1, 0, 0))
    ball.rotate(90 * T, enabled=enabled)
    group = r4.Group(ball=ball)
    group.translate(WAY, enabled=T > 0.5)

    assert_agrees(ball, above=(group,), times=[*TIMES, *np.nextafter([0.5, 1, 2, 3, 4], 9.0).tolist()])


def test_a_list_that_changes_without_end_is_not_lowered():
    """Nor one of which nobody knows when it changes."""
    for enabled in (np.floor(T / 3) % 2, r4.signal(lambda t: t > 2), r4.Parameter("on", True)):
        ball = r4.Sphere()
        ball.rotate(90 * T, enabled=enabled)
        assert lower_matrix(ball) is None


def test_a_transform_of_one_s_own_is_not_lowered():
    """Unless it is the same at all times."""

    class Hop(r4.Transform):
        height = r4.Float(1.0, unit="m")

        @staticmethod
        def matrix(height):
            return [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, abs(height)], [0, 0, 0, 1]]

    still, moving = r4.Sphere(), r4.Sphere()
    still.apply(Hop(-2.0))
    still.translate(WAY)
    moving.apply(Hop(T))

    assert operations(assert_agrees(still)) == ["matrix", "translate"]
    assert lower_matrix(moving) is None


@pytest.mark.parametrize(
    "change",
    [
        r4.Translate(r4.signal(lambda t: np.array([t, 0.0, 0.0]))),
        r4.Mirror(WAY),
        r4.Shear((1, 0, 0), axis=WAY),
        r4.Orient(r4.keys({0: r4.Rotation(), 1: r4.Rotation.from_axis_angle("x", 90)}, interpolation="catmull_rom")),
        r4.LookAt(r4.signal(lambda t: np.array([t, 5.0, 0.0]))),
        r4.LinkedXForm(r4.signal(lambda t: None)),
    ],
    ids=lambda change: type(change).__name__,
)
def test_settings_that_are_not_lowered_leave_the_matrix_to_be_fitted(change):
    """There is no exact product then."""
    box = r4.Box()
    box.apply(change)

    assert lower_matrix(box) is None
    assert lower(box.matrix) is None


def test_what_stands_still_piece_by_piece_is_exact():
    """Whichever object is followed, and wherever it looks with."""
    box, other = r4.Box(), r4.Sphere()
    other.translate((1, 2, 3))
    box.apply(r4.LinkedXForm(r4.keys({0: r4.Box(), 1: other}, kind="held")))

    assert_agrees(box)


def test_what_a_kind_understands_in_its_own_way_is_no_factor():
    """A label turns on the screen."""
    label = r4.Label("north", at=(1, 0, 0))
    label.rotate(30)
    turning = r4.Label("north", at=(1, 0, 0))
    turning.rotate(30 * T)

    assert_agrees(label)
    assert lower_matrix(turning) is None


def test_looking_after_a_deformation_is_not_lowered():
    """It would turn about where the deformation carried the origin."""
    box = r4.Box()
    box.translate((1, 0, 0))
    box.apply(r4.Bend(30, axis="x"))
    box.apply(r4.LookAt(WAY))

    assert lower_matrix(box) is None


moves = st.one_of(
    st.builds(r4.Translate, st.sampled_from([WAY, (1, 2, 3), r4.keys({0: (0, 0, 0), 2: (1, 1, 1)})])),
    st.builds(r4.Rotate, st.sampled_from([90 * T, 30, r4.keys({0: 0, 2: 90})]), axis=st.sampled_from(["x", (1, 2, 3)])),
    st.builds(r4.Scale, st.sampled_from([2.0, 1 + T * T, (1, -2, 3)]), center=st.sampled_from([(0, 0, 0), (1, 1, 1)])),
    st.builds(r4.Shear, st.sampled_from([(1, 0, 0), WAY]), axis=st.sampled_from(["x", "z"])),
    st.builds(r4.LookAt, st.sampled_from([(9, 9, 9), WAY + (20, 0, 0)]), forward=st.sampled_from(["x", "-z", "y"])),
    st.builds(r4.Orient, st.just(TURN)),
    st.builds(r4.Mirror, st.sampled_from(["x", (1, 1, 0)])),
)


@given(own=st.lists(moves, max_size=4), groups=st.lists(st.lists(moves, max_size=2), max_size=2))
def test_random_lists_of_transforms_agree(own, groups):
    """In groups of groups."""
    obj = r4.Box()
    obj.changes.extend(own)
    above = []
    for changes in groups:
        group = r4.Group([above[-1] if above else obj])
        group.changes.extend(changes)
        above.append(group)

    assert_agrees(obj, above=tuple(above), times=(-0.7, 0.0, 0.4, 1.9, 2.0, 3.3))


class TestPositions:
    """Where objects are, as others ask them."""

    @pytest.mark.parametrize("name", ["translate", "rotate", "orient", "scale", "scale by three", "matrix", "mirror"])
    def test_a_position_is_carried_through_the_list(self, agree, name):
        """As far as the factors are known to move points."""
        ball = r4.Sphere()
        ball.translate(r4.vec(1, T, 0))
        ball.apply(TRANSFORMS[name])
        ball.translate((0, 0, 1))

        agree(ball.position, TIMES, tolerance=1e-8)

    def test_cameras_stand_at_their_eyes(self, agree):
        """And go on from there."""
        camera = r4.Camera(position=WAY, target=(0, 0, 0))
        camera.rotate(20 * T, axis="z")

        agree(camera.position, TIMES)

    def test_looking_and_linking_move_points_as_well(self, agree):
        """What looks stays where it is; what is linked goes along."""
        arm, hand = r4.Box(), r4.Sphere()
        arm.rotate(30 * T)
        hand.translate((1, 0, 0))
        hand.apply(r4.LookAt((5, 5, 5)))
        hand.apply(r4.LinkedXForm(arm))

        agree(hand.position, TIMES)
        arm.apply(r4.LookAt((5, 5, 5)))
        assert lower(hand.position) is None

    def test_a_deformation_carries_the_origin_along(self, agree):
        """Where it stands still that is known."""
        box = r4.Box(size=(1, 1, 4))
        box.translate((0, 0, 2))
        box.apply(r4.Bend(30, axis="x"))
        box.translate(WAY)

        agree(box.position, TIMES, tolerance=1e-6)

    def test_others_follow(self, agree):
        """A shadow shrinks as the ball rises; a camera turns from the bee to the fly."""
        ball, bee, fly = r4.Sphere(), r4.Sphere(), r4.Sphere()
        ball.translate(r4.vec(0, 0, 2 * np.abs(np.sin(np.pi * T))))
        bee.translate(r4.vec(2 * np.cos(T), 2 * np.sin(T), 1))
        fly.translate(r4.vec(np.sin(3 * T), 3, 1 + np.cos(2 * T)))
        shadow = r4.Cylinder(radius=0.25, height=0.01)
        shadow.scale(1 - ball.position[2] / 4)
        camera = r4.Camera(position=(6, -6, 3), target=r4.keys({2: bee.position, 3: fly.position}))

        assert_agrees(shadow)
        assert_agrees(camera)
        agree(camera.target, TIMES)

    def test_positions_that_vary_in_list(self, agree):
        """A change that acts for a while."""
        ball = r4.Sphere()
        ball.translate((1, 0, 0))
        ball.rotate(90 * T, enabled=T < 2)

        agree(ball.position, TIMES)


def test_objects_that_follow_objects_are_lowered_as_far_as_is_sane(agree):
    """A short chain is a sum; a long one is left to be fitted, and not to the interpreter's stack."""
    first = r4.Sphere()
    first.translate(r4.vec(T, 0, 0))
    chain = [first]
    for _ in range(300):
        follower = r4.Sphere()
        follower.translate(chain[-1].position + (0, 0, 1))
        chain.append(follower)

    agree(chain[8].position, TIMES)
    assert lower(chain[-1].position) is None


def test_a_rigid_motion_costs_nothing_per_frame():
    """A product of keyed motion is as small as its keys."""
    ball = r4.Sphere()
    ball.translate(r4.keys({float(t): (t, t % 3, 0) for t in range(100)}))
    ball.apply(r4.Orient(r4.keys({float(t): r4.Rotation.from_axis_angle("z", 50 * t) for t in range(100)})))

    track = lower_matrix(ball)
    assert track is not None
    assert sized(track) <= 200 * 200
