"""The changes that come with the package, as an object obeys them; and what it remembers of that."""

import gc
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import reactive4d as r4
from reactive4d.engine import engine

numbers = st.floats(-3, 3)
points = st.tuples(numbers, numbers, numbers)


def evaluated(events: Any, part: str = "") -> list[str]:
    """What was computed, by name."""
    return sorted(event.name for event in events if event.kind == "evaluated" and part in event.name)


def moved(*changes: Any, at: Any = (0, 0, 0)) -> Any:
    """Where a point goes that obeys some changes."""
    point = r4.Point(at)
    point.changes.extend(changes)
    return point.position.at(0)


# -- transforms --------------------------------------------------------------------------------------------------------


@given(points, points)
@settings(max_examples=20)
def test_translate(offset: Any, at: Any) -> None:
    """F060: translate: every point moves by the offset; two of them add up, in any order."""
    assert np.allclose(moved(r4.Translate(offset), at=at), np.add(at, offset))
    twice = moved(r4.Translate(offset), r4.Translate(at)), moved(r4.Translate(at), r4.Translate(offset))
    assert np.allclose(*twice)


@given(points, points, st.floats(-720, 720), points)
@settings(max_examples=20)
def test_rotate_about_an_arbitrary_point_and_axis(center: Any, axis: Any, angle: float, at: Any) -> None:
    """F061: rotate about an arbitrary point and axis by an angle: distances to both are kept; it is undone."""
    if np.linalg.norm(axis) < 1e-3:
        axis = (0, 0, 1)
    turn = r4.Rotate(angle, axis=axis, center=center)
    found = moved(turn, at=at)
    unit = np.array(axis) / np.linalg.norm(axis)
    before, after = np.subtract(at, center), found - np.array(center)
    assert math.isclose(np.linalg.norm(before), np.linalg.norm(after), abs_tol=1e-9)
    assert math.isclose(before @ unit, after @ unit, abs_tol=1e-9)
    assert np.allclose(moved(turn, r4.Rotate(-angle, axis=axis, center=center), at=at), at)


@pytest.mark.parametrize(("factor", "volume"), [(2, 8), ((2, 1, 1), 2), ((1, 2, 3), 6), (0.5, 0.125), (-1, 1)])
def test_scale_by_one_number_or_by_three(factor: Any, volume: float) -> None:
    """F062: uniform (1 number) and non-uniform (a list of 3) by the type of the value; about any centre."""
    box = r4.Box()
    box.apply(r4.Scale(factor, center=(0.5, 0.5, 0.5)))
    assert box.volume.at(0) == pytest.approx(volume)
    assert r4.Model(box.mesh.at(0)).volume.at(0) == pytest.approx(volume)  # outside stays outside
    assert np.allclose(moved(r4.Scale(factor, center=(1, 2, 3)), at=(1, 2, 3)), (1, 2, 3))


def test_shear() -> None:
    """F063: shear keeps volumes and the sheets across its axis."""
    box = r4.Box((1, 1, 2))
    box.apply(r4.Shear((0.5, 0.25, 0), axis="z"))
    assert box.volume.at(0) == pytest.approx(2)
    assert r4.Model(box.mesh.at(0)).volume.at(0) == pytest.approx(2)
    assert moved(r4.Shear((0.5, 0.25, 0), axis="z"), at=(1, 1, 2)).tolist() == [2, 1.5, 2]


@given(points, points)
@settings(max_examples=20)
def test_mirror(normal: Any, at: Any) -> None:
    """F064: mirror: twice is nothing; what lies in the plane stays; a mirrored solid is still a solid."""
    if np.linalg.norm(normal) < 1e-3:
        normal = (1, 0, 0)
    mirror = r4.Mirror(normal, center=(1, 0, 0))
    assert np.allclose(moved(mirror, mirror, at=at), at)
    assert np.allclose(moved(mirror, at=(1, 0, 0)), (1, 0, 0))
    box = r4.Box()
    box.apply(mirror)
    assert r4.Model(box.mesh.at(0)).volume.at(0) == pytest.approx(1, abs=1e-5)


def test_an_arbitrary_matrix() -> None:
    """F065: an arbitrary 4x4 matrix; one that is not affine is refused when it is asked for."""
    matrix = [[0, -2, 0, 1], [1, 0, 0, 2], [0, 0, 3, 3], [0, 0, 0, 1]]
    assert moved(r4.Matrix(matrix), at=(1, 1, 1)).tolist() == [-1, 3, 6]
    box = r4.Box()
    box.apply(r4.Matrix(matrix))
    assert box.volume.at(0) == pytest.approx(6)
    with pytest.raises(r4.ShapeError, match="last row"):
        moved(r4.Matrix(np.ones((4, 4))))
    with pytest.raises(r4.ShapeError):
        r4.Matrix(np.eye(3))


# -- deformations ------------------------------------------------------------------------------------------------------


def bar(sections: int = 64) -> Any:
    """A bar along z with many sections."""
    return r4.Box((0.5, 0.5, 4), segments=(2, 2, sections))


@pytest.mark.parametrize(
    ("change", "still"),
    [
        (r4.Bend(90), r4.Bend(0)), (r4.Twist(120), r4.Twist(0)), (r4.Taper(-0.5), r4.Taper(0)),
        (r4.Wave(0.2, wavelength=1), r4.Wave(0)), (r4.Ripple(0.2, wavelength=1), r4.Ripple(0)),
        (r4.Skew(1), r4.Skew(0)),
    ],
    ids=lambda change: type(change).__name__,
)  # fmt: skip
def test_a_deformation_deforms_and_its_null_does_nothing(change: Any, still: Any) -> None:
    """F066-F069: bend, twist, taper, wave: each moves points, keeps the topology and closed solids closed."""
    thing, rest = bar(), bar().mesh.at(0)
    thing.apply(change)
    assert not np.allclose(thing.points.at(0), rest.points, atol=0.01)
    assert np.array_equal(thing.topology.at(0), rest.faces)
    assert thing.volume.at(0) == pytest.approx(r4.Model(thing.mesh.at(0)).volume.at(0))
    assert thing.solid.at(0) is not None
    thing.changes[0] = still
    assert np.allclose(thing.points.at(0), rest.points, atol=1e-6)


def test_a_twist_keeps_the_volume_and_a_bend_the_centre_line() -> None:
    """F066, F067: the laws hold through an object, about its own position, wherever it is."""
    lost: list[float] = []
    for sections in (64, 128):
        twisted = bar(sections)
        twisted.translate((3, 2, 1))
        twisted.apply(r4.Twist(90))
        assert np.allclose(twisted.position.at(0), (3, 2, 1))
        lost.append(abs(twisted.volume.at(0) - 1))
    assert lost[1] < lost[0] < 0.005  # what the flat triangles cut off
    bent = bar()
    bent.translate((3, 2, 1))
    bent.apply(r4.Bend(90))
    ends = r4.Path([(0, 0, z) for z in np.linspace(-2, 2, 65)], interpolation="linear", samples=64)
    ends.translate((3, 2, 1))
    ends.apply(r4.Bend(90))
    line = ends.points.at(0)
    assert np.linalg.norm(np.diff(line, axis=0), axis=1).sum() == pytest.approx(4, rel=1e-3)
    assert bent.volume.at(0) == pytest.approx(1, rel=1e-2)


def test_colour_shading_transparency_bumpiness_and_texture() -> None:
    """F071: colour, reflectance, transparency, bumpiness, texture map; later ones win; all vary and are disabled."""
    ball = r4.Sphere(color="red", opacity=0.5)
    ball.apply(r4.Color(r4.keys({0: "red", 2: "blue"})))
    ball.apply(r4.Opacity(0.5))
    shade = ball.apply(r4.Shade(specular=0.25, shininess=r4.time, bumpiness=0.1))
    ball.apply(r4.Texture("wood.png"))
    ball.apply(r4.Shade(specular=0.5))
    look = ball.look.at(2)
    assert {name: look[name] for name in ("specular", "shininess", "bumpiness", "texture")} == {
        "specular": 0.5, "shininess": 2.0, "bumpiness": 0.1, "texture": "wood.png",
    }  # fmt: skip
    assert np.allclose(look["color"], [0, 0, 1, 0.25])
    assert np.array_equal(look["color"], ball.paint.at(2))
    shade.enabled = False
    assert "bumpiness" not in ball.look.at(2)


def test_kind_and_prototype_are_said_like_any_change() -> None:
    """F078: chrep and template: an object is made generic, told what it is, and whose changes it has, at any moment."""
    egg, thing = r4.Sphere(radius=2), r4.Object()
    thing.prototype = egg
    assert thing.volume.at(0) == egg.volume.at(0)
    chrep = thing.apply(r4.Become("box"))
    assert (thing.kind.at(0), egg.kind.at(0)) == (r4.Box, r4.Sphere)
    chrep.enabled = r4.keys({0: 0, 1: 1}, interpolation="step")
    assert [thing.kind.at(t) for t in (0, 1)] == [r4.Sphere, r4.Box]


# -- what is remembered ------------------------------------------------------------------------------------------------


def test_an_answer_of_an_object_holds_over_intervals() -> None:
    """F101: value, time, and the intervals over which it holds; a second inquiry inside returns the previous one."""
    ball = r4.Sphere(radius=r4.keys({0: 1, 2: 2, 6: 3}, interpolation="step"), segments=6, rings=3)
    ball.name = "ball"
    first = ball.points.at(3)
    with r4.log() as events:
        assert all(ball.points.at(t) is first for t in (2, 4, 5.9))
    assert evaluated(events) == []
    assert ball.points.valid(3) == r4.Interval(2, 6)


def test_an_edit_halfway_through_a_remembered_span_splits_it() -> None:
    """F104: the interval is halved, shrunk, split: only the sub-intervals that the edit touches are computed again."""
    ball = r4.Sphere(segments=6, rings=3)
    ball.name = "ball"
    hop = ball.translate(r4.keys(dict.fromkeys(range(0, 11, 2), (0, 0, 0)), interpolation="step"))
    ball.mesh.at(5)
    hop.offset.source.points[4] = (0, 0, 1)
    with r4.log() as events:
        for t in (-9, 0, 3.9, 6, 99):
            assert ball.mesh.at(t).points[:, 2].max() == 0.5
    assert evaluated(events) == []
    assert ball.mesh.at(5).points[:, 2].max() == 1.5
    assert (ball.mesh.valid(0).stop, ball.mesh.valid(5), ball.mesh.valid(9).start) == (4, r4.Interval(4, 6), 6)


def test_an_effect_that_is_slowed_down_holds_longer() -> None:
    """F105: scaling (slow down / speed up an effect by scaling its cache intervals), translation."""
    steps = r4.keys({0: (0, 0, 0), 1: (1, 0, 0), 2: (2, 0, 0)}, interpolation="step")
    for signal, at, lo, hi in ((steps, 1, 1, 2), (steps.stretch(4), 4, 4, 8), (steps.delay(10), 11, 11, 12)):
        ball = r4.Sphere()
        ball.translate(signal)
        assert ball.position.at(at)[0] == 1
        span = ball.matrix.valid(at)
        assert (span.start, span.stop) == pytest.approx((lo, hi), abs=1e-9)


def test_what_does_not_pay_is_forgotten_under_pressure_and_no_answer_changes() -> None:
    """F108, F109: cached while memory allows; the profile tells evaluations, hits and bytes."""
    ball = r4.Sphere(radius=r4.keys({i: 1.0 + i for i in range(30)}, interpolation="step"), segments=64, rings=32)
    gc.collect()
    engine.forget()  # what other tests have left
    budget = r4.budget
    try:
        r4.budget = 400_000
        for _ in range(2):
            assert [round(float(ball.points.at(t)[:, 2].max()), 4) for t in range(30)] == [1.0 + t for t in range(30)]
        assert r4.stats(ball.points)["bytes"] < 400_000
    finally:
        r4.budget = budget
    with r4.log():
        for _ in range(5):
            ball.volume.at(3)
        found = r4.stats(ball.volume)
    assert (found["evaluations"], found["hits"] >= 4) == (1, True)


def test_a_shape_that_is_referenced_many_times_is_kept_once_with_all_its_places() -> None:
    """F116: a shape that is met several times on the way through groups is one item, with a matrix for each."""
    shape = r4.Sphere(segments=6, rings=3)
    shape.name = "shape"
    inner = r4.Group(a=shape)
    inner.translate((1, 0, 0))
    outer = r4.Group(b=shape, inner=inner)
    outer.translate((0, 0, 1))
    scene = r4.Scene(outer=outer, c=shape)
    with r4.log() as events:
        frame = scene.at(0)
    nodes = [frame[name] for name in ("outer/b", "outer/inner/a", "c")]
    assert len({id(node.drawn) for node in nodes}) == 1
    assert [node.matrix[:3, 3].tolist() for node in nodes] == [[0, 0, 1], [1, 0, 1], [0, 0, 0]]
    assert evaluated(events, "shape.surface") == ["shape.surface"]
    shape.radius = 1
    assert scene.at(0)["outer/inner/a"].drawn is scene.at(0)["c"].drawn is shape.surface.at(0)
