"""The laws of 4x4 matrices: groups, distances, volumes, normals, and what looks at what."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from reactive4d.errors import ShapeError
from reactive4d.geometry.transforms import (
    IDENTITY,
    compose,
    decompose,
    direction,
    inverse,
    is_rigid,
    look_at,
    mirroring,
    recompose,
    rotation,
    rotation_about,
    scaling,
    shearing,
    transform_normals,
    transform_points,
    transform_vectors,
    translation,
)

Array = NDArray[Any]

numbers = st.floats(-10.0, 10.0, allow_subnormal=False)
vectors = st.tuples(numbers, numbers, numbers)
directed = vectors.filter(lambda v: math.hypot(*v) > 1e-3)
angles = st.floats(-7.0, 7.0)
factors = st.floats(0.1, 5.0).flatmap(lambda size: st.sampled_from((size, -size)))
quaternions = st.tuples(numbers, numbers, numbers, numbers).filter(lambda q: math.hypot(*q) > 1e-3)


def close(a: Any, b: Any, *, within: float = 1e-9) -> bool:
    """Equal but for rounding."""
    return bool(np.allclose(a, b, rtol=within, atol=within))


def at(matrix: Array, point: Any) -> Array:
    """One point carried along."""
    return (matrix @ (*point, 1.0))[:3]


@st.composite
def matrices(draw: st.DrawFn) -> Array:
    """Invertible affine matrices of all kinds."""
    return compose(
        [
            scaling((draw(factors), draw(factors), draw(factors)), center=draw(vectors)),
            shearing(draw(st.tuples(*[st.floats(-2.0, 2.0)] * 3)), draw(directed)),
            rotation(draw(angles), draw(directed), center=draw(vectors)),
            translation(draw(vectors)),
        ]
    )


@given(angles, angles, directed, vectors)
def test_rotations_about_one_axis_add_up(a: float, b: float, axis: Any, center: Any):
    """Turning by a and then by b about one axis and centre is turning by a + b."""
    both = compose([rotation(a, axis, center=center), rotation(b, axis, center=center)])
    assert close(both, rotation(a + b, axis, center=center))


@given(angles, directed, vectors)
def test_a_rotation_is_rigid_and_keeps_its_axis(angle: float, axis: Any, center: Any):
    """A rotation is rigid, and the points of its axis stay."""
    matrix = rotation(angle, axis, center=center)
    assert is_rigid(matrix)
    for share in (0.0, 1.0, -2.5):
        point = np.add(center, share * np.array(direction(axis)))
        assert close(at(matrix, point), point, within=1e-8)


@given(angles, directed, vectors)
def test_a_quaternion_turns_as_its_axis_and_angle(angle: float, axis: Any, center: Any):
    """(cos a/2, sin a/2 · axis), of any length, turns by a about the axis."""
    x, y, z = direction(axis)
    c, s = 3.0 * math.cos(angle / 2), 3.0 * math.sin(angle / 2)
    assert close(rotation_about((c, s * x, s * y, s * z), center=center), rotation(angle, axis, center=center))


def test_rotations_are_counter_clockwise():
    """A quarter turn takes x to y about z, y to z about x, and z to x about y."""
    quarter = math.pi / 2
    assert close(at(rotation(quarter, "z"), (1, 0, 0)), (0, 1, 0))
    assert close(at(rotation(quarter, "x"), (0, 1, 0)), (0, 0, 1))
    assert close(at(rotation(quarter, "y"), (0, 0, 1)), (1, 0, 0))
    assert close(at(rotation(quarter, "-z"), (1, 0, 0)), (0, -1, 0))


@given(matrices())
def test_an_inverse_undoes(matrix: Array):
    """The inverse is the inverse from both sides."""
    assert close(inverse(matrix) @ matrix, IDENTITY, within=1e-7)
    assert close(matrix @ inverse(matrix), IDENTITY, within=1e-7)


def test_a_singular_matrix_is_refused():
    """What flattens the space has no inverse, and the message says so; what is merely small has one."""
    for matrix in (scaling((1, 0, 1)), scaling(0.0), np.diag((0.0, 0.0, 0.0, 1.0))):
        with pytest.raises(ShapeError, match="singular"):
            inverse(matrix)
        with pytest.raises(ShapeError, match="singular"):
            transform_normals(matrix, np.ones((2, 3), np.float32))
        with pytest.raises(ShapeError, match="singular"):
            decompose(matrix)
    flat = IDENTITY.copy()
    flat[:3, :3] = ((1, 2, 3), (4, 5, 6), (5, 7, 9))
    with pytest.raises(ShapeError, match="singular"):
        inverse(flat)
    assert close(inverse(scaling(1e-100))[0, 0], 1e100)


@given(directed, vectors)
def test_a_mirror_undoes_itself(normal: Any, center: Any):
    """Mirrored twice is where it was; the determinant is -1, and what lies in the plane stays."""
    matrix = mirroring(normal, center=center)
    assert close(matrix @ matrix, IDENTITY, within=1e-8)
    assert close(np.linalg.det(matrix[:3, :3]), -1.0)
    assert close(at(matrix, center), center, within=1e-8)
    assert not is_rigid(matrix)


@given(vectors, directed, vectors)
def test_a_shear_keeps_volume_and_the_plane_through_its_center(amounts: Any, axis: Any, center: Any):
    """A shear has determinant 1, moves no point along its axis, and undoes itself by the opposite amounts."""
    matrix = shearing(amounts, axis, center=center)
    assert close(np.linalg.det(matrix[:3, :3]), 1.0, within=1e-6)
    n = np.array(direction(axis))
    point = np.array((1.0, -2.0, 3.0))
    assert close(n @ at(matrix, point), n @ point, within=1e-7)
    assert close(at(matrix, center), center, within=1e-7)
    back = shearing([-amount for amount in amounts], axis, center=center)
    assert close(back @ matrix, IDENTITY, within=1e-6)


def test_a_scale_multiplies_volume_about_its_center():
    """One number scales evenly, three along the axes; the centre stays."""
    assert close(scaling(2.0, center=(1, 2, 3)), scaling((2, 2, 2), center=(1, 2, 3)))
    assert close(at(scaling((2, 3, 4), center=(1, 2, 3)), (1, 2, 3)), (1, 2, 3))
    assert close(np.linalg.det(scaling((2, 3, 4))), 24.0)
    assert close(scaling(np.float32(2.0)), scaling(2))


@given(st.lists(matrices(), max_size=4))
def test_composing_is_acting_one_after_the_other(steps: list[Array]):
    """The first matrix acts first; of none, nothing happens."""
    point = np.array((0.3, -0.7, 1.1, 1.0))
    expected = point
    for step in steps:
        expected = step @ expected
    assert close(compose(steps) @ point, expected)


@given(matrices())
def test_taken_apart_and_put_together(matrix: Array):
    """A matrix is its translation, rotation, scale and shear; the quaternion has length 1 and w >= 0."""
    offset, quaternion, scale, shear = decompose(matrix)
    assert close(recompose(offset, quaternion, scale=scale, shear=shear), matrix, within=1e-7)
    assert close(np.linalg.norm(quaternion), 1.0)
    assert quaternion[0] >= 0.0
    assert (scale[1:] > 0.0).all()


@given(vectors, quaternions, st.tuples(*[st.floats(0.1, 5.0)] * 3), vectors)
def test_put_together_and_taken_apart(offset: Any, quaternion: Any, scale: Any, shear: Any):
    """Parts are found again, the quaternion up to its sign and length."""
    parts = decompose(recompose(offset, quaternion, scale=scale, shear=shear))
    unit = np.array(quaternion) / math.hypot(*quaternion)
    for got, expected in zip((parts[0], *parts[2:]), (offset, scale, shear), strict=True):
        assert close(got, expected, within=1e-5)
    assert close(abs(parts[1] @ unit), 1.0, within=1e-8)


@given(vectors, directed, directed, st.sampled_from(("x", "-x", "y", "-y", "z", "-z")))
def test_what_looks_at_a_target_points_at_it(position: Any, way: Any, up: Any, forward: str):
    """The chosen local axis points from the position to the target, in a rigid frame whose upper side is up."""
    matrix = look_at(position, np.add(position, way), up, forward=forward)
    assert is_rigid(matrix)
    assert close(matrix[:3, 3], position)
    ahead, upwards = np.array(direction(way)), np.array(direction(up))
    assert close(matrix[:3, :3] @ direction(forward), ahead, within=1e-7)
    if np.linalg.norm(np.cross(ahead, upwards)) > 1e-3:
        above = matrix[:3, :3] @ direction("y" if forward.endswith("z") else "z")
        assert above @ upwards > 0.0
        assert close(above @ np.cross(ahead, upwards), 0.0, within=1e-7)


def test_looking_straight_up_has_an_answer():
    """Along the upward direction itself there is still one rigid frame; at itself nobody can look."""
    for up in ("z", "y", "x", "-z"):
        assert is_rigid(look_at((1, 2, 3), np.add((1, 2, 3), direction(up)), up))
    with pytest.raises(ShapeError, match="no direction"):
        look_at((1, 2, 3), (1, 2, 3))
    with pytest.raises(ShapeError, match="no local axis"):
        look_at((0, 0, 0), (1, 0, 0), forward="up")


def test_directions_are_refused_that_are_none():
    """A vector of length 0 and an unknown name have no direction; a quaternion of length 0 turns nothing."""
    with pytest.raises(ShapeError, match="no direction"):
        rotation(1.0, (0, 0, 0))
    with pytest.raises(ShapeError, match="'w' is no axis"):
        rotation(1.0, "w")
    with pytest.raises(ShapeError, match="no rotation"):
        rotation_about((0, 0, 0, 0))


@given(matrices(), st.integers(0, 40))
def test_points_are_carried_as_by_hand(matrix: Array, count: int):
    """Points go through the matrix, float32 as float32 and float64 exactly; vectors do not feel its translation."""
    points = np.random.default_rng(count).normal(size=(count, 3))
    expected = points @ matrix[:3, :3].T + matrix[:3, 3]
    size = np.abs(matrix).max()
    exact, rounded = transform_points(matrix, points), transform_points(matrix, points.astype(np.float32))
    assert (exact.dtype, rounded.dtype) == (np.float64, np.float32)
    assert np.allclose(exact, expected, rtol=0.0, atol=1e-13 * size)
    assert np.allclose(rounded, expected, rtol=0.0, atol=3e-6 * size)
    assert np.allclose(transform_vectors(matrix, points), points @ matrix[:3, :3].T, rtol=0.0, atol=1e-13 * size)
    assert not exact.flags.writeable


def test_equal_points_stay_bitwise_equal():
    """Wherever a point stands among others, its answer is the same: welded vertices never part."""
    draw = np.random.default_rng(1)
    points = draw.normal(size=(40_003, 3)).astype(np.float32)
    order = draw.permutation(len(points))
    matrix = compose([rotation(0.7, (1, 2, 3)), scaling((1, 2, 3)), translation((1, 2, 3))])
    assert np.array_equal(transform_points(matrix, points[order]), transform_points(matrix, points)[order])
    assert np.array_equal(transform_points(matrix, points[7:8]), transform_points(matrix, points)[7:8])


@given(matrices())
def test_normals_stay_square_to_their_surface(matrix: Array):
    """A normal that was square to two tangents is square to both when all are carried along, outward, of length 1."""
    draw = np.random.default_rng(2)
    a, b = draw.normal(size=(2, 5, 3))
    normals = transform_normals(matrix, np.cross(a, b))
    carried = np.cross(transform_vectors(matrix, a), transform_vectors(matrix, b))
    carried *= np.sign(np.linalg.det(matrix[:3, :3])) / np.linalg.norm(carried, axis=1, keepdims=True)
    assert np.allclose(normals, carried, atol=1e-6)


def test_a_normal_of_length_zero_stays():
    """Where there is no normal none is made up, and nothing is divided by 0."""
    normals = transform_normals(scaling((1, 2, 3)), np.zeros((2, 3), np.float32))
    assert normals.dtype == np.float32
    assert not normals.any()


def test_wrong_shapes_are_named():
    """Points are rows of three."""
    with pytest.raises(ShapeError, match=r"expected \(V, 3\), got an array of shape \(3,\)"):
        transform_points(IDENTITY, np.zeros(3))


def test_matrices_are_frozen():
    """What is made here can be shared: nobody can change it."""
    made = [
        translation((1, 2, 3)),
        rotation(1.0),
        rotation_about((1, 0, 0, 0)),
        scaling(2.0),
        shearing((1, 0, 0)),
        mirroring("x"),
        look_at((0, 0, 0), (1, 0, 0)),
        compose([translation((1, 0, 0)), scaling(2.0)]),
        inverse(scaling(2.0)),
        recompose(),
        *decompose(IDENTITY),
        IDENTITY,
    ]
    assert not any(matrix.flags.writeable for matrix in made)
    assert all(matrix.dtype == np.float64 for matrix in made)
