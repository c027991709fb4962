"""The rows of the feature list about changes that move: transforms, deformations, and what makes solids of shapes."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import reactive4d as r4
from reactive4d.geometry import lattices

t = r4.time
PI = math.pi
numbers = st.floats(-5.0, 5.0)
vectors = st.tuples(numbers, numbers, numbers)
axes = vectors.filter(lambda v: math.hypot(*v) > 0.1)
angles = st.floats(-400.0, 400.0)


def near(value: Any, answer: Any, within: float = 1e-9) -> bool:
    """Whether all numbers are as near as that."""
    return bool(np.allclose(value, answer, rtol=0, atol=within))


def carried(change: r4.Change, point: Any) -> Any:
    """Where a change takes a point."""
    obj = r4.Point(point)
    obj.apply(change)
    return obj.position.at(0)


def own(obj: r4.Object, at: float = 0) -> float:
    """The volume of its mesh."""
    return r4.Model(obj.mesh.at(at)).volume.at(0)


def bar(height: float = 2.0, segments: int = 32) -> r4.Object:
    """A slender bar about the z axis, its middle at the origin."""
    return r4.Box((0.2, 0.1, height), segments=(2, 2, segments))


# -- transforms --------------------------------------------------------------------------------------------------------


@given(st.lists(vectors, min_size=1, max_size=5))
def test_translate(offsets: list[Any]) -> None:
    """F060: translate: offsets add up, in any order; and their derivative is the velocity."""
    ball = r4.Sphere()
    for offset in offsets:
        ball.translate(offset)
    assert near(ball.position.at(0), np.sum(offsets, axis=0))
    moving = r4.Sphere()
    moving.translate(r4.vec(*[c * t for c in offsets[0]]))
    assert near(moving.velocity.at(3), offsets[0], 1e-6)
    assert near(moving.position.at(3), 3 * np.array(offsets[0]))


@given(angles, angles, axes, vectors, vectors)
def test_rotate(a: float, b: float, axis: Any, center: Any, point: Any) -> None:
    """F061: rotate about an arbitrary point and axis: the axis stays, angles add up, distances are kept."""
    on_axis = np.add(center, 1.7 * np.array(axis))
    assert near(carried(r4.Rotate(a, axis=axis, center=center), on_axis), on_axis, 1e-8)
    both = r4.Point(point)
    both.rotate(a, axis=axis, center=center)
    both.rotate(b, axis=axis, center=center)
    assert near(both.position.at(0), carried(r4.Rotate(a + b, axis=axis, center=center), point), 1e-8)
    matrix = both.matrix.at(0)[:3, :3]
    assert near(matrix @ matrix.T, np.eye(3))
    assert np.linalg.det(matrix) == pytest.approx(1)
    assert near(carried(r4.Rotate(360, axis=axis, center=center), point), point, 1e-8)


def test_rotate_is_counter_clockwise_in_degrees() -> None:
    """F061: `rotate <t,{{point},{axis},angle}>`: 90 degrees about z through (1, 0, 0) take the origin to (1, -1, 0)."""
    assert near(carried(r4.Rotate(90, axis="z", center=(1, 0, 0)), (0, 0, 0)), (1, -1, 0))
    assert near(carried(r4.Rotate(90, axis="x"), (0, 1, 0)), (0, 0, 1))
    assert near(carried(r4.Orient(r4.Rotation.from_axis_angle("z", 90), center=(1, 0, 0)), (0, 0, 0)), (1, -1, 0))


@given(numbers, vectors, vectors)
def test_scale(factor: float, factors: Any, center: Any) -> None:
    """F062: scale: uniform (1 number) and non-uniform (list of 3) by type of value: volumes by the product."""
    box, other = r4.Box((1, 2, 3)), r4.Box((1, 2, 3))
    box.scale(factor, center=center)
    other.scale(factors, center=center)
    assert box.volume.at(0) == pytest.approx(6 * abs(factor) ** 3, abs=1e-9)
    assert other.volume.at(0) == pytest.approx(6 * abs(math.prod(factors)), abs=1e-9)
    assert box.area.at(0) == pytest.approx(22 * factor**2, abs=1e-9)
    assert near(carried(r4.Scale(factors, center=center), center), center)
    assert near(box.position.at(0), (1 - factor) * np.array(center), 1e-8)


def test_the_value_of_a_scale_may_be_one_number_and_then_three() -> None:
    """F062: by type of value, at every time anew: one expression answers a number, the other three."""
    box = r4.Box()
    box.scale(r4.where(t < 1, 2.0, 3.0))
    assert (box.volume.at(0), box.volume.at(1)) == (8, 27)
    change = box.changes[0]
    change.factor = (1, 1, 5)
    assert box.volume.at(0) == 5
    change.factor = r4.keys({0: (1, 1, 1), 2: (3, 1, 1)})
    assert box.volume.at(1) == 2


@given(vectors, axes, vectors, vectors)
def test_shear(amount: Any, axis: Any, center: Any, point: Any) -> None:
    """F063: shear: sheets across the axis slide in proportion to their height; the volume is kept."""
    box = r4.Box((1, 2, 3))
    box.apply(r4.Shear(amount, axis=axis, center=center))
    assert box.volume.at(0) == pytest.approx(6)
    assert own(box) == pytest.approx(6, rel=1e-3)
    along = np.array(axis) / math.hypot(*axis)
    height = along @ np.subtract(point, center)
    sideways = np.array(amount) - (along @ np.array(amount)) * along
    assert near(carried(r4.Shear(amount, axis=axis, center=center), point), point + height * sideways, 1e-8)


@given(axes, vectors, vectors)
def test_mirror(normal: Any, center: Any, point: Any) -> None:
    """F064: mirror / reflect: twice is nothing, the plane stays, faces still turn outwards."""
    mirror = r4.Mirror(normal, center=center)
    twice = r4.Point(point)
    twice.apply(mirror)
    twice.apply(mirror)
    assert near(twice.position.at(0), point, 1e-8)
    reflected = carried(mirror, point)
    assert near((reflected + point - 2 * np.array(center)) @ np.array(normal), 0, 1e-7)
    cone = r4.Cone(1, 2, segments=6)
    volume = own(cone)
    cone.apply(mirror)
    assert own(cone) == pytest.approx(volume, rel=1e-3)
    assert cone.volume.at(0) == pytest.approx(PI * 2 / 3)


@given(st.lists(numbers, min_size=12, max_size=12))
def test_matrix(rows: list[float]) -> None:
    """F065: arbitrary 4×4 matrix: points and volume as linear algebra says; two of them multiply from the left."""
    matrix = np.array([*rows, 0, 0, 0, 1]).reshape(4, 4)
    box = r4.Box()
    box.apply(r4.Matrix(matrix))
    assert near(box.matrix.at(0), matrix)
    assert box.volume.at(0) == pytest.approx(abs(np.linalg.det(matrix[:3, :3])), abs=1e-9)
    box.apply(r4.Matrix(matrix))
    assert near(box.matrix.at(0), matrix @ matrix)


@pytest.mark.parametrize("value", [np.zeros((4, 4)), np.eye(3), "x", np.eye(4) * 2, [[1, 2], [3, 4]]])
def test_a_matrix_that_is_not_affine_is_refused(value: Any) -> None:
    """F065: its last row must be (0, 0, 0, 1): else it is refused, at the latest when it is asked."""
    box = r4.Box()
    with pytest.raises(r4.ShapeError, match=r"Matrix\.value"):
        box.apply(r4.Matrix(value)).values.at(0), box.matrix.at(0)


@given(axes, vectors)
def test_look_at(way: Any, place: Any) -> None:
    """F050, F065: look-at: the object turns about its own position until its forward axis points to the target."""
    for forward, axis in {"-z": (0, 0, -1), "x": (1, 0, 0), "y": (0, 1, 0)}.items():
        cone = r4.Cone()
        cone.rotate(33, axis=(1, 1, 0))
        cone.translate(place)
        cone.apply(r4.LookAt(np.add(place, way), forward=forward))
        assert near(cone.position.at(0), place)
        gaze = cone.matrix.at(0)[:3, :3] @ axis
        assert near(gaze, np.array(way) / math.hypot(*way), 1e-6)
        assert np.linalg.det(cone.matrix.at(0)[:3, :3]) == pytest.approx(1)


def test_a_transform_moves_the_matrix_and_not_the_points() -> None:
    """F060–F065: a static mesh that only moves keeps its points: they hold for ever, the matrix for an instant."""
    changes = [
        r4.Translate(r4.vec(t, 0, 0)), r4.Rotate(10 * t), r4.Orient(r4.Rotation.from_axis_angle("z", 5)),
        r4.Scale(1 + t), r4.Shear(r4.vec(t, 0, 0)), r4.Mirror("x"), r4.Matrix(np.eye(4)), r4.LookAt(r4.vec(t, 9, 9)),
    ]  # fmt: skip
    box = r4.Box()
    points = box.points.at(0)
    for change in changes:
        box.apply(change)
        assert box.points.at(1) is points
        assert box.points.valid(1) == r4.FOREVER
    assert box.matrix.valid(1).stop - box.matrix.valid(1).start < 1e-12


# -- bend --------------------------------------------------------------------------------------------------------------


@given(st.floats(-350, 350).filter(lambda a: abs(a) > 1), st.floats(0, 360))
@settings(max_examples=30)
def test_a_bend_keeps_the_length_of_the_centre_line(angle: float, direction: float) -> None:
    """F066, F280: bend: an arc of the old length, in the plane of its direction; the ends turn by the angle."""
    line = r4.Line((0, 0, -1), (0, 0, 1), segments=200)
    line.apply(r4.Bend(angle, direction=direction))
    points = line.outline.at(0)
    steps = np.diff(points, axis=0)
    assert np.linalg.norm(steps, axis=1).sum() == pytest.approx(2, rel=1e-3)
    first, last = steps[0] / np.linalg.norm(steps[0]), steps[-1] / np.linalg.norm(steps[-1])
    # The last pieces stand for the tangents in their middles: 199 of 200 parts of the way apart.
    assert math.degrees(math.acos(np.clip(first @ last, -1, 1))) == pytest.approx(
        _between(abs(angle) * 199 / 200), abs=0.1
    )
    assert near(points[100], (0, 0, 0), 1e-6)
    across = np.array([-math.sin(math.radians(direction)), math.cos(math.radians(direction)), 0])
    assert near(points @ across, 0, 1e-5)
    towards = points @ (math.cos(math.radians(direction)), math.sin(math.radians(direction)), 0)
    assert (np.sign(angle) * towards >= -1e-5).all()


def _between(angle: float) -> float:
    """The angle between two directions that far apart, from 0 to 180."""
    return 180 - abs(180 - angle % 360)


def test_a_bend_goes_on_straight_beyond_its_limits() -> None:
    """F280: limits (upper, lower): between them it is bent, beyond them it is as straight and as thick as before."""
    rod = bar(4, 64)
    rod.apply(r4.Bend(90, lower=-0.5, upper=0.5))
    before, after = r4.Box((0.2, 0.1, 4), segments=(2, 2, 64)).points.at(0), rod.points.at(0).astype(float)
    for side, sign in ((before[:, 2] > 0.5, 1), (before[:, 2] < -0.5, -1)):
        # A rigid motion: distances are kept.
        old, new = before[side].astype(float), after[side]
        assert near(np.linalg.norm(new - new[0], axis=1), np.linalg.norm(old - old[0], axis=1), 1e-5)
        turned = np.array([math.sin(sign * PI / 4), 0, math.cos(PI / 4)])
        way = new[old[:, 2].argmax()] - new[old[:, 2].argmin()]
        width = old[old[:, 2].argmax()] - old[old[:, 2].argmin()]
        if near(width[:2], 0):
            assert near(way / np.linalg.norm(way), turned, 1e-4)
    assert own(rod) == pytest.approx(0.2 * 0.1 * 4, rel=1e-3)


@pytest.mark.parametrize("axis", ["x", "y", "z"])
def test_a_bend_has_an_axis_and_a_centre(axis: str) -> None:
    """F280: axis, centre/gizmo transform: about any axis, and about a centre that stays."""
    i = "xyz".index(axis)
    size = np.full(3, 0.1)
    size[i] = 2
    counts = np.ones(3, int)
    counts[i] = 16
    rod = r4.Box(size, segments=tuple(counts))
    end = np.eye(3)[i]
    rod.apply(r4.Bend(90, axis=axis, center=-end))
    low = rod.points.at(0)[r4.Box(size, segments=tuple(counts)).points.at(0)[:, i] == -1].mean(axis=0)
    assert near(low, -end, 1e-5)
    assert rod.bounds.at(0)[1][i] < 1  # its other end has come down
    assert near(carried(r4.Bend(90, axis=axis, center=(1, 2, 3), lower=-1, upper=1), (1, 2, 3)), (1, 2, 3), 1e-6)


def test_a_gizmo_is_an_object_that_moves() -> None:
    """F280: gizmo transform: with `space` the bend is another object's, which moves, turns and scales it."""
    gizmo = r4.Object()
    rod, plain = bar(), bar()
    bend = rod.apply(r4.Bend(90, lower=-1, upper=1, space=gizmo))
    plain.apply(r4.Bend(90, lower=-1, upper=1, center=(0, 0, 0)))
    assert near(rod.points.at(0), plain.points.at(0), 1e-6)
    gizmo.rotate(90, axis="z")
    turned = bar()
    turned.apply(r4.Bend(90, direction=90, lower=-1, upper=1, center=(0, 0, 0)))
    assert near(rod.points.at(0), turned.points.at(0), 1e-5)
    gizmo.translate(r4.vec(0, 0, 10 * t))
    assert not near(rod.points.at(0), rod.points.at(0.05), 1e-3)
    assert near(rod.points.at(3), rod.points.at(4), 1e-3) is False  # beyond the limit it is turned as a whole
    bend.space = None
    assert np.array_equal(rod.points.at(3), rod.points.at(4))


def test_an_angle_of_nothing_changes_nothing() -> None:
    """F066–F069: at 0 each deformation leaves the very points, and a zero in the middle of keys is passed through."""
    for change in (r4.Bend(0), r4.Twist(0), r4.Taper(0), r4.Skew(0), r4.Wave(0), r4.Ripple(0), r4.XForm()):
        rod = bar()
        before = rod.points.at(0)
        rod.apply(change)
        assert np.array_equal(rod.points.at(0), before)
    line = r4.Line((0, 0, -1), (0, 0, 1), segments=16)
    before = line.points.at(0)
    line.apply(r4.Bend(r4.keys({0: -90.0, 2: 90.0})))
    assert near(line.points.at(0) * (-1, 1, 1), line.points.at(2), 1e-5)
    assert np.array_equal(line.points.at(1), before)


# -- twist, taper, skew ------------------------------------------------------------------------------------------------


@given(st.floats(-360, 360), st.floats(-1.0, 1.0), vectors)
@settings(max_examples=25)
def test_a_twist(angle: float, bias: float, center: Any) -> None:
    """F067, F285: twist: keeps volume and heights, turns the ends by the angle, bias relative to the pivot."""
    column = r4.Box((1, 0.6, 2), segments=(4, 4, 24))
    before = column.points.at(0).astype(float)
    column.apply(r4.Twist(angle, bias=bias, center=(*center[:2], 0.0)))
    after = column.points.at(0).astype(float)
    assert near(after[:, 2], before[:, 2], 1e-6)
    old, new = before[:, :2] - center[:2], after[:, :2] - center[:2]
    assert near(np.linalg.norm(new, axis=1), np.linalg.norm(old, axis=1), 1e-4)
    far = (np.abs(before[:, 2]) == 1) & (np.linalg.norm(old, axis=1) > 0.05)
    turned = (new[far] @ (1, 1j)) / (old[far] @ (1, 1j))
    expected = np.radians(angle) / 2 * np.sign(before[far, 2])
    assert near(turned, np.exp(1j * expected), 1e-3)


def test_a_twist_keeps_the_volume() -> None:
    """F067: the finer the mesh, the nearer: its volume tends to the box's."""
    columns = [r4.Box((1, 1, 2), segments=(n, n, 4 * n)) for n in (4, 16)]
    for column in columns:
        column.apply(r4.Twist(90))
    errors = [abs(own(column) - 2) for column in columns]
    assert errors[1] < errors[0] / 4 + 1e-6
    assert errors[1] < 0.01


@pytest.mark.parametrize("bias", [-10, -3, 3, 10])
@pytest.mark.parametrize("height", [1e-3, 1e4])
def test_a_bias_holds_at_every_size(bias: float, height: float) -> None:
    """F285: bias relative to the pivot: whatever the size, the ends turn as without it, and all stays finite."""
    column = r4.Box((1, 1, height), segments=(1, 1, 8))
    plain = column.extend()
    column.apply(r4.Twist(90, bias=bias, enabled=True))
    biased = column.points.at(0)
    column.changes[0].bias = 0.0
    even = plain.points.at(0)
    ends = np.isclose(np.abs(even[:, 2]), height / 2)
    assert np.isfinite(biased).all()
    assert near(biased[ends], even[ends], 1e-5)
    assert not near(biased, even, 1e-2)


@pytest.mark.parametrize("axis", ["x", "y", "z", (1, 1, 0)])
def test_a_twist_turns_about_any_axis(axis: Any) -> None:
    """F285: angle on any of 3 axes: points on the axis stay, and the ends part by the angle."""
    way = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}.get(axis, axis)
    way = np.array(way) / np.linalg.norm(way)
    for height in (-3, 0.2, 1):
        twist = r4.Twist(90, axis=axis, lower=-1, upper=1, center=(0, 0, 0))
        assert near(carried(twist, height * way), height * way, 1e-6)
    side = np.cross(way, (0.3, 0.5, 0.7))
    twist = r4.Twist(90, axis=axis, lower=-1, upper=1, center=(0, 0, 0))
    low, high = carried(twist, side - way), carried(twist, side + way)
    assert (low + way) @ (high - way) == pytest.approx(0, abs=1e-5)
    # Beyond the limits all turns as the limit does.
    assert near(carried(twist, side + 5 * way) - 4 * way, high, 1e-5)


@given(st.floats(-0.9, 3.0), st.floats(-0.3, 0.5))
@settings(max_examples=25)
def test_the_volume_of_a_taper(amount: float, curve: float) -> None:
    """F068, F284: taper (amount, curve): the volume is the base times the integral of the factor's square."""
    box = r4.Box((1, 1, 2), segments=(1, 1, 64))
    box.apply(r4.Taper(amount, curve=curve, center=(0, 0, -1)))
    a, c = amount, curve
    factor = 1 + a + a * a / 3 + 4 * c / 3 + 2 * a * c / 3 + 8 * c * c / 15
    assert own(box) == pytest.approx(2 * factor, rel=5e-3, abs=5e-3)


def test_a_taper_has_primary_effect_and_symmetry() -> None:
    """F284: two sets of axes (primary, effect, symmetry), limits: which axis, which coordinate, which sides."""

    def box() -> r4.Object:
        return r4.Box((1, 1, 2), segments=(1, 1, 4))

    half = box()
    half.apply(r4.Taper(1.0, effect="x", center=(0, 0, -1)))
    assert near(half.bounds.at(0), [[-1, -0.5, -1], [1, 0.5, 1]], 1e-5)
    sides = box()
    sides.apply(r4.Taper(1.0, is_symmetric=True))
    top, middle = (np.abs(sides.points.at(0)[np.isclose(sides.points.at(0)[:, 2], z)]).max(axis=0) for z in (1, 0))
    assert near(top[:2], 0.75, 1e-5)
    assert near(middle[:2], 0.5, 1e-5)
    assert near(np.abs(sides.bounds.at(0)[0]), sides.bounds.at(0)[1], 1e-6)
    lying = r4.Box((2, 1, 1), segments=(4, 1, 1))
    lying.apply(r4.Taper(1.0, axis="x", effect="z", center=(-1, 0, 0)))
    assert near(lying.bounds.at(0), [[-1, -0.5, -1], [1, 0.5, 1]], 1e-5)
    limited = box()
    limited.apply(r4.Taper(1.0, lower=0, upper=0.5))
    assert near(limited.bounds.at(0)[1], (1, 1, 1), 1e-5)
    assert near(carried(r4.Taper(1.0, lower=0, upper=0.5, center=(0, 0, 0)), (1, 0, 7)), (2, 0, 7), 1e-6)


@given(numbers, st.floats(0, 360))
@settings(max_examples=25)
def test_a_skew(amount: float, direction: float) -> None:
    """F283: skew: amount, direction, axis, limits: the ends part by the amount; the volume is kept."""
    box = r4.Box((1, 1, 2), segments=(1, 1, 4))
    box.apply(r4.Skew(amount, direction=direction))
    assert own(box) == pytest.approx(2, rel=1e-4)
    points = box.points.at(0)
    top, bottom = (points[np.isclose(points[:, 2], z)].mean(axis=0) for z in (1, -1))
    way = (math.cos(math.radians(direction)), math.sin(math.radians(direction)))
    assert near((top - bottom)[:2], amount * np.array(way), 1e-4)
    limited = r4.Skew(amount, direction=direction, lower=0, upper=1, center=(0, 0, 0))
    assert near(carried(limited, (0, 0, 9))[:2], amount * np.array(way), 1e-6)
    assert near(carried(limited, (0, 0, -9)), (0, 0, -9), 1e-6)
    other = r4.Skew(amount, axis="x", lower=0, upper=1, center=(0, 0, 0))
    assert near(carried(other, (1, 0, 0)), (1, amount, 0), 1e-6)


# -- waves -------------------------------------------------------------------------------------------------------------


@given(st.floats(0.1, 3.0), st.floats(0.5, 4.0), st.floats(-360, 360), st.floats(0.0, 2.0))
@settings(max_examples=30)
def test_a_wave(amplitude: float, wavelength: float, phase: float, decay: float) -> None:
    """F069, F282: wave: size, phase, decay: z = a exp(-d |x|) sin(2π x / l - phase), straight along y."""
    sheet = r4.Plane((4, 2), segments=(16, 2))
    sheet.apply(r4.Wave(amplitude, wavelength=wavelength, phase=phase, decay=decay))
    x, _, z = sheet.points.at(0).astype(float).T
    expected = amplitude * np.exp(-decay * np.abs(x)) * np.sin(2 * PI * x / wavelength - math.radians(phase))
    assert near(z, expected, 2e-5 * amplitude)
    assert sheet.bounds.at(0)[1, 0] == 2


@given(st.floats(0.1, 3.0), st.floats(0.5, 4.0), st.floats(-360, 360), st.floats(0.0, 2.0))
@settings(max_examples=30)
def test_a_ripple(amplitude: float, wavelength: float, phase: float, decay: float) -> None:
    """F281: ripple: wave size (amplitude 1/2, wave length, phase, decay): rings about the axis; two amplitudes."""
    pond = r4.Plane((4, 4), segments=(8, 8))
    change = pond.apply(r4.Ripple(amplitude, wavelength=wavelength, phase=phase, decay=decay))
    x, y, z = pond.points.at(0).astype(float).T
    r = np.hypot(x, y)
    swing = np.exp(-decay * r) * np.sin(2 * PI * r / wavelength - math.radians(phase))
    assert near(z, amplitude * swing, 2e-5 * amplitude)
    change.second = 0.0
    first, other = np.isclose(y, 0) & (r > 0.1), np.isclose(x, 0) & (r > 0.1)
    along, across = pond.points.at(0)[first, 2], pond.points.at(0)[other, 2]
    assert near(along, amplitude * swing[first], 2e-5 * amplitude)
    assert near(across, 0, 2e-5 * amplitude)


@pytest.mark.parametrize("make", [r4.Wave, r4.Ripple])
def test_waves_run_forward_and_have_world_space_twins(make: Any) -> None:
    """F281, F282: phase 360 is phase 0; the twin in world space stays while the object moves through it."""
    sheet = r4.Plane((4, 4), segments=(16, 16))
    sheet.apply(make(0.2, wavelength=1.5, phase=360 * t))
    assert near(sheet.points.at(0), sheet.points.at(1), 1e-5)
    assert not near(sheet.points.at(0), sheet.points.at(0.4), 1e-2)
    water = r4.Object()
    boat = r4.Plane((1, 1), segments=(8, 8))
    boat.translate(r4.vec(t, 0, 0))
    own_wave = boat.apply(make(0.2, wavelength=1.5))
    assert near(boat.points.at(0)[:, 2], boat.points.at(0.4)[:, 2], 1e-5)
    own_wave.space = water
    assert not near(boat.points.at(0)[:, 2], boat.points.at(0.4)[:, 2], 1e-2)
    if make is r4.Wave:
        assert near(boat.points.at(0)[:, 2], boat.points.at(1.5)[:, 2], 1e-5)
    water.translate(r4.vec(t, 0, 0))
    assert near(boat.points.at(0)[:, 2], boat.points.at(0.4)[:, 2], 1e-5)


# -- free-form deformations --------------------------------------------------------------------------------------------


@given(st.tuples(st.integers(2, 5), st.integers(2, 5), st.integers(2, 5)))
@settings(max_examples=20)
def test_a_resting_lattice_changes_nothing(size: Any) -> None:
    """F070: free-form deformation: with the lattice at rest it is the identity, of any size (Bernstein polynomials)."""
    ball = r4.Sphere(0.5, segments=8, rings=6)
    before = ball.points.at(0)
    rest = lattices.lattice((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5), size)
    ffd = ball.apply(r4.FreeForm(rest))
    assert near(ball.points.at(0), before, 1e-6)
    # An affine motion of the lattice is one of space.
    ffd.points = rest @ np.array([[1, 0.2, 0], [0, 1.5, 0.3], [0, 0, 0.7]]) + (1, 2, 3)
    assert near(ball.points.at(0), before @ np.array([[1, 0.2, 0], [0, 1.5, 0.3], [0, 0, 0.7]]) + (1, 2, 3), 1e-5)


@given(st.tuples(st.floats(0, 1), st.floats(0, 1), st.floats(0, 1)), vectors)
@settings(max_examples=30)
def test_a_lattice_point_moves_space_by_its_bernstein_weight(place: Any, way: Any) -> None:
    """F070: Sederberg-Parry lattice: one point moved by v moves a point (s, t, u) by B(s) B(t) B(u) v."""
    points = lattices.lattice((0, 0, 0), (1, 1, 1), (3, 4, 2))
    moved = points.copy()
    moved[1, 2, 1] += way
    s, v, u = place
    weight = 2 * s * (1 - s) * 3 * v * v * (1 - v) * u
    found = carried(r4.FreeForm(moved, lower=(0, 0, 0), upper=(1, 1, 1)), place)
    assert near(found, np.add(place, weight * np.array(way)), 1e-6)


def test_points_of_a_lattice_move() -> None:
    """F070: points that move: objects and signals among the numbers of a lattice."""
    handle = r4.Point((0.5, 0.5, 0.5))
    handle.translate(r4.keys({0: (0, 0, 0), 1: (0, 0, 1)}))
    rest = lattices.lattice((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5), (2, 2, 2)).tolist()
    rest[1][1][1] = handle
    rest[0][0][1] = r4.vec(-0.5, -0.5, 0.5 + t)
    box = r4.Box()
    box.apply(r4.FreeForm(rest))
    assert box.bounds.at(0)[1, 2] == 0.5
    assert box.bounds.at(1)[1, 2] == pytest.approx(1.5)
    assert sorted(box.points.at(0.5)[:, 2].tolist())[-6:] == pytest.approx([1.0] * 6)
    assert box.topology.valid(0.5) == r4.FOREVER


# -- XForm, LinkedXForm, normals ---------------------------------------------------------------------------------------


@given(vectors, angles, st.floats(0.2, 3.0))
def test_an_xform(offset: Any, angle: float, factor: float) -> None:
    """F289: XForm: transform evaluated as a modifier: the points move, and the matrix begins anew after them."""
    box, plain = r4.Box((1, 2, 3)), r4.Box((1, 2, 3))
    box.apply(r4.XForm(offset=offset, angle=angle, factor=factor))
    plain.scale(factor)
    plain.rotate(angle)
    plain.translate(offset)
    assert near(box.mesh.at(0).points, plain.mesh.at(0).points, 1e-5)
    assert near(box.matrix.at(0), np.eye(4))
    assert near(box.position.at(0), plain.position.at(0), 1e-6)
    assert box.methods.at(0)["intersect"].startswith("mesh by xform")


def test_an_xform_on_the_selected_part() -> None:
    """F289, F291: on all or the selected part: only what was selected before it in the list moves."""
    box = r4.Box(segments=(1, 1, 2))
    box.apply(r4.Select(lower=(-1, -1, 0.1), upper=(1, 1, 1)))
    lift = box.apply(r4.XForm(offset=(0, 0, 1)))
    assert near(box.bounds.at(0)[:, 2], (-0.5, 1.5), 1e-6)
    assert own(box) == pytest.approx(2)
    lift.angle = 90
    assert near(box.bounds.at(0)[:, 2], (-0.5, 1.5), 1e-6)
    box.changes.remove(box.changes[0])
    assert near(box.bounds.at(0)[:, 2], (0.5, 1.5), 1e-6)


def test_a_linked_xform() -> None:
    """F290: LinkedXForm: with another object's coordinate system: what is linked moves as it does, and knows when."""
    arm, hand = r4.Box(), r4.Sphere()
    hand.translate((1, 0, 0))
    hand.apply(r4.LinkedXForm(arm))
    arm.rotate(r4.keys({0: 0, 1: 90}))
    arm.translate((0, 0, 5))
    assert near(hand.position.at(1), (0, 1, 5), 1e-9)
    assert hand.matrix.valid(2).stop == math.inf
    hand.changes[1].target = None
    assert near(hand.position.at(1), (1, 0, 0))


@pytest.mark.parametrize(
    "change",
    [
        lambda: r4.Bend(70, direction=20),
        lambda: r4.Twist(60),
        lambda: r4.Taper(-0.5, curve=0.2),
        lambda: r4.Skew(0.5),
        lambda: r4.Wave(0.1, wavelength=2),
        lambda: r4.Ripple(0.1, wavelength=2),
    ],
    ids=["bend", "twist", "taper", "skew", "wave", "ripple"],
)
def test_normals_of_what_was_deformed_are_those_of_a_fine_mesh(change: Callable[[], r4.Change]) -> None:
    """F018, F066–F069: normals follow the deformed surface: those of a coarse mesh agree with a finer one's."""
    coarse, fine = r4.Sphere(1, segments=24, rings=12), r4.Sphere(1, segments=96, rings=48)
    for ball in (coarse, fine):
        ball.apply(change())
    places, normals = fine.points.at(0), fine.normals.at(0)
    for place, normal in zip(coarse.points.at(0)[30:-30:7], coarse.normals.at(0)[30:-30:7], strict=True):
        nearest = np.linalg.norm(places - place, axis=1).argmin()
        assert normals[nearest] @ normal > 0.98


def test_deformations_see_the_points_as_transforms_before_them_left_them() -> None:
    """F005, F066: the order counts: to move and bend is not to bend and move, when the centre is the world's."""
    first, second = bar(), bar()
    first.translate((1, 0, 0))
    first.apply(r4.Bend(90, center=(0, 0, 0)))
    second.apply(r4.Bend(90, center=(0, 0, 0)))
    second.translate((1, 0, 0))
    assert not near(first.mesh.at(0).points, second.mesh.at(0).points, 0.1)
    # About the object's own position, which is the default, a translation before or after is the same.
    third, fourth = bar(), bar()
    third.translate((1, 0, 0))
    third.apply(r4.Bend(90))
    fourth.apply(r4.Bend(90))
    fourth.translate((1, 0, 0))
    assert near(third.mesh.at(0).points, fourth.mesh.at(0).points, 1e-5)
    assert near(third.position.at(0), (1, 0, 0), 1e-6)


# -- solids of shapes --------------------------------------------------------------------------------------------------


@given(st.floats(0.1, 5.0), st.integers(1, 6))
@settings(max_examples=25)
def test_extrude(amount: float, segments: int) -> None:
    """F293: extrude: shape swept along a line (amount, segments, caps, mapping coords): the prism's volume."""
    star = r4.Star(1, inner=0.5, tips=6)
    prism = r4.Prism(r4.Star(1, inner=0.5, tips=6), amount)
    change = star.apply(r4.Extrude(amount, segments=segments))
    assert star.volume.at(0) == pytest.approx(prism.volume.at(0), rel=1e-4)
    assert star.area.at(0) == pytest.approx(prism.area.at(0), rel=1e-4)
    assert star.solid.at(0) is not None
    uv = star.uv.at(0)
    assert uv.shape == (len(star.points.at(0)), 2)
    assert 0 <= uv.min() <= uv.max() <= 1
    change.caps = False
    with pytest.raises(r4.ShapeError, match="not a closed surface"):
        star.solid.at(0)
    change.enabled = False
    assert star.topology.at(0) is None


def test_extrude_acts_where_the_shape_lies_and_goes_on_being_changed() -> None:
    """F293: from where the outline lies; the solid is moved, bent and combined like others; the amount is keyed."""
    disc = r4.Circle(1, segments=24)
    disc.translate((5, 0, 2))
    extrude = disc.apply(r4.Extrude(r4.keys({0: 1.0, 2: 3.0}), segments=8))
    assert near(disc.bounds.at(1)[:, 2], (2, 4), 1e-5)
    assert near(disc.position.at(0), (5, 0, 2))
    disc.translate((0, 1, 0))
    assert near(disc.bounds.at(0).mean(axis=0), (5, 1, 2.5), 1e-5)
    assert disc.volume.at(2) == pytest.approx(3 * disc.volume.at(0), rel=1e-5)
    assert (disc - r4.Box(100)).volume.at(0) == 0
    disc.apply(r4.Twist(45))
    assert disc.volume.at(0) == pytest.approx(24 / 2 * math.sin(2 * PI / 24), rel=1e-2)
    extrude.amount = -1
    assert near(disc.bounds.at(0)[:, 2], (1, 2), 1e-4)
    # The outline of a letter or of an n-gon, too, that is one of the others' extension.
    copy = disc.extend()
    assert copy.volume.at(0) == disc.volume.at(0)
    copy.radius = 2
    assert copy.volume.at(0) == pytest.approx(4 * disc.volume.at(0), rel=1e-3)


@given(st.floats(0.5, 4.0), st.floats(20, 360))
@settings(max_examples=25)
def test_lathe(away: float, degrees: float) -> None:
    """F294: lathe: shape revolved about an axis (degrees, segments, weld, caps, mapping coords): by Pappus."""
    ring = r4.Rectangle((0.4, 0.6))
    ring.rotate(90, axis="x")
    ring.translate((away, 0, 0))
    ring.apply(r4.Lathe(angle=degrees, segments=64))
    assert ring.solid.at(0) is not None
    way = math.radians(degrees) * away
    assert ring.volume.at(0) == pytest.approx(0.4 * 0.6 * way, rel=1e-2)
    caps = 0.0 if degrees > 359.999 else 2 * 0.4 * 0.6
    assert ring.area.at(0) == pytest.approx(2 * (0.4 + 0.6) * way + caps, rel=1e-2)
    assert 0 <= ring.uv.at(0).min() <= ring.uv.at(0).max() <= 1
    assert np.array_equal(ring.points.at(0)[ring.weld.at(0)], ring.points.at(0))


def test_lathe_about_any_axis_through_any_point() -> None:
    """F294: axis and centre: a circle turned about an axis in its plane is a torus."""
    torus = r4.Torus(2, 0.5)
    ring = r4.Circle(0.5, segments=64)
    ring.apply(r4.Lathe(axis="y", center=(2, 0, 0), segments=64))
    assert ring.volume.at(0) == pytest.approx(torus.volume.at(0), rel=1e-2)
    assert near(ring.center_of_mass.at(0), (2, 0, 0), 1e-4)


# -- every change, its attributes as keys and as parameters ------------------------------------------------------------

CHANGES: dict[str, Callable[[], r4.Change]] = {
    "translate": lambda: r4.Translate((1, 2, 3)),
    "rotate": lambda: r4.Rotate(30, axis=(1, 2, 3), center=(0.5, 0, 0)),
    "scale": lambda: r4.Scale((1, 2, 0.5), center=(0.5, 0, 0)),
    "shear": lambda: r4.Shear((0.5, 0.2, 0), axis="z", center=(0.5, 0, 0)),
    "mirror": lambda: r4.Mirror((1, 2, 3), center=(0.5, 0, 0)),
    "look_at": lambda: r4.LookAt((3, 2, 1), up=(0, 0.2, 1)),
    "bend": lambda: r4.Bend(40, direction=20, center=(0.1, 0, 0), lower=-0.6, upper=0.7),
    "twist": lambda: r4.Twist(40, bias=0.5, center=(0.1, 0, 0), lower=-0.6, upper=0.7),
    "taper": lambda: r4.Taper(0.5, curve=0.3, center=(0.1, 0, 0), lower=-0.6, upper=0.7),
    "skew": lambda: r4.Skew(0.5, direction=20, center=(0.1, 0, 0), lower=-0.6, upper=0.7),
    "wave": lambda: r4.Wave(0.2, wavelength=1.5, phase=20, second=0.1, decay=0.3, direction=20, center=(0.1, 0, 0)),
    "ripple": lambda: r4.Ripple(0.2, wavelength=1.5, phase=20, second=0.1, decay=0.3, direction=20, center=(0.1, 0, 0)),
    "ffd": lambda: r4.FreeForm(lattices.lattice((-1, -1, -1), (1, 1.5, 2), (2, 3, 2)), lower=(-2, -1, -1)),
    "xform": lambda: r4.XForm(offset=(1, 0, 0), angle=20, factor=(1, 2, 1), center=(0.1, 0, 0)),
}  # fmt: skip
MOVING = [
    (name, setting.name)
    for name, make in CHANGES.items()
    for setting in type(make()).settings
    if isinstance(setting, r4.Float | r4.Vector)
]


def _seen(change: r4.Change, at: float, **given: Any) -> Any:
    box = r4.Box((1, 1.2, 2), segments=(2, 2, 4))
    box.apply(change)
    return box.mesh.at(at, **given).points


@pytest.mark.parametrize(("name", "attribute"), MOVING)
def test_every_number_of_every_change_is_animated_by_keys_and_by_parameters(name: str, attribute: str) -> None:
    """F001, F060–F070: each attribute may be keys, a reader's parameter or an expression: as the constant would act."""
    start: Any = CHANGES[name]().source(attribute)
    stop = start * 1.2 + 0.01
    constant = CHANGES[name]()
    constant.assign(attribute, (start + stop) / 2)
    expected = _seen(constant, 0)
    keyed, led, computed = CHANGES[name](), CHANGES[name](), CHANGES[name]()
    keyed.assign(attribute, r4.keys({0: start, 2: stop}))
    share = r4.Parameter("share", 0.0)
    led.assign(attribute, r4.lift(lambda u: start + u * (stop - start))(share))
    computed.assign(attribute, r4.lift(lambda at: start + at / 2 * (stop - start))(t))
    for change, at, given_ in ((keyed, 1.0, {}), (led, 0.0, {"share": 0.5}), (computed, 1.0, {})):
        assert near(_seen(change, at, **given_), expected, 1e-5)
    if not (name == "xform" and attribute == "axis"):
        moved = np.abs(_seen(keyed, 0) - _seen(keyed, 2)).max()
        assert moved > 1e-6 or attribute in ("axis", "normal", "up")  # their lengths do not count


@pytest.mark.parametrize("name", CHANGES)
def test_attributes_that_are_absent_have_defaults(name: str) -> None:
    """F007: a change with what it needs and no more acts as one that is given all its defaults."""
    change = CHANGES[name]()
    kind = type(change)
    needed = {s.name: change.source(s.name) for s in kind.settings[: kind.positional]}
    if kind is r4.FreeForm:
        needed["points"] = change.source("points")
    defaults = {s.name: s.default for s in kind.settings if s.default is not None and s.name not in needed}
    assert near(_seen(kind(**needed), 0), _seen(kind(**needed, **defaults), 0), 0)


@pytest.mark.parametrize("name", CHANGES)
def test_what_a_change_does_not_know_is_refused(name: str) -> None:
    """F007: a change refuses attributes that it does not have, with the nearest one; and values that are none."""
    change = CHANGES[name]()
    first = change.settings[0].name
    with pytest.raises(r4.UnknownNameError, match="centre"):
        type(change)(**{first: change.source(first), "centre": (0, 0, 0)})
    for value in ("sideways", object(), math.nan, [1, 2, 3, 4, 5]):
        with pytest.raises(r4.ShapeError, match=f"{type(change).__name__}.{first}"):
            change.assign(first, value)
    assert near(_seen(change, 0), _seen(CHANGES[name](), 0), 0)


@pytest.mark.parametrize("name", [n for n in CHANGES if n not in ("ffd",)])
@pytest.mark.parametrize("number", [0.0, 1e-9, -1e-9, 1e4, -1e4])
def test_every_change_at_its_extremes(name: str, number: float) -> None:
    """F060–F070: at nothing, nearly nothing and very much: finite points, or an error that says what is wrong."""
    change = CHANGES[name]()
    for setting in change.settings:
        if not isinstance(setting, r4.Float | r4.Vector):
            continue
        changed = CHANGES[name]()
        start: Any = changed.source(setting.name)
        try:
            changed.assign(setting.name, number if isinstance(start, float) else np.full(np.shape(start), number))
            points = _seen(changed, 0)
        except r4.Reactive4dError:
            continue
        assert np.isfinite(points).all()


def test_limits_the_wrong_way_round_are_refused() -> None:
    """F280–F285: a lower limit that is not below the upper one is refused, with both numbers."""
    for change in (r4.Bend(30, lower=1, upper=-1), r4.Twist(30, lower=1, upper=1), r4.Skew(1, lower=2, upper=1)):
        rod = bar()
        rod.apply(change)
        with pytest.raises(r4.ShapeError, match="lower"):
            rod.points.at(0)
        assert rod.topology.at(0) is not None
