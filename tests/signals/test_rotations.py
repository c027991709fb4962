"""Rotations: a group, the same one that SciPy has, and the shortest way between two of its elements."""

import copy
import math
import pickle
import sys
from itertools import permutations
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.spatial import transform

from reactive4d.errors import ShapeError, UnknownNameError
from reactive4d.signals.rotations import (
    Rotation,
    canonical_quaternions,
    multiply_quaternions,
    quaternion_matrices,
    slerp,
    slerp_quaternions,
)

components = st.floats(-1, 1)
vectors = st.tuples(components, components, components).filter(lambda v: math.hypot(*v) > 1e-3)
quaternions = st.tuples(components, components, components, components).filter(lambda q: math.hypot(*q) > 1e-3)
quarter_turns = st.lists(st.tuples(st.sampled_from("xyz"), st.integers(-8, 8)), max_size=4)
rotations = quaternions.map(Rotation) | quarter_turns.map(
    lambda turns: math.prod((Rotation.from_axis_angle(axis, 90 * n) for axis, n in turns), start=Rotation())
)
shares = st.floats(0, 1)
CLOSE = 1e-12


def scipy_of(rotation: Rotation) -> transform.Rotation:
    """The same rotation as SciPy has it."""
    return transform.Rotation.from_quat(rotation.as_quaternion()[[1, 2, 3, 0]])


def close(a: Rotation, b: Rotation) -> bool:
    """The same but for rounding."""
    return bool(np.abs(a.as_matrix() - b.as_matrix()).max() < CLOSE)


def apart(a: Rotation, b: Rotation) -> float:
    """The angle between two rotations, degrees."""
    return (a.inverse() * b).as_axis_angle()[1]


@given(rotations, rotations, rotations)
def test_rotations_are_a_group(a: Rotation, b: Rotation, c: Rotation) -> None:
    """Associative; the identity is neutral to the last bit; an inverse undoes."""
    one = Rotation()
    assert close((a * b) * c, a * (b * c))
    assert a * one == a == one * a
    assert close(a * a.inverse(), one)
    assert close(a.inverse() * a, one)
    assert a.inverse().inverse() == a
    assert close((a * b).inverse(), b.inverse() * a.inverse())


@given(rotations, rotations, st.lists(vectors, max_size=4))
def test_applying_is_an_action_of_the_group(a: Rotation, b: Rotation, points: list[tuple[float, float, float]]) -> None:
    """`a * b` does b first; lengths stay, and a row is rotated as it is alone."""
    p = np.array(points).reshape(-1, 3)
    assert (a * b).apply(p) == pytest.approx(a.apply(b.apply(p)), abs=CLOSE)
    assert np.linalg.norm(a.apply(p), axis=1) == pytest.approx(np.linalg.norm(p, axis=1))
    assert a.apply(p) == pytest.approx(np.array([a.apply(row) for row in p]).reshape(-1, 3), abs=CLOSE)
    assert a.apply(p).shape == p.shape


@given(rotations, rotations, vectors)
def test_scipy_agrees(a: Rotation, b: Rotation, v: tuple[float, float, float]) -> None:
    """Composition, inverse, matrix and action are those of scipy.spatial.transform."""
    assert a.as_matrix() == pytest.approx(scipy_of(a).as_matrix(), abs=CLOSE)
    assert (a * b).as_matrix() == pytest.approx((scipy_of(a) * scipy_of(b)).as_matrix(), abs=CLOSE)
    assert a.inverse().as_matrix() == pytest.approx(scipy_of(a).inv().as_matrix(), abs=CLOSE)
    assert a.apply(v) == pytest.approx(scipy_of(a).apply(v), abs=CLOSE)
    axis, angle = a.as_axis_angle()
    assert np.radians(angle) == pytest.approx(scipy_of(a).magnitude(), abs=1e-7)
    assert axis * np.radians(angle) == pytest.approx(as_near(scipy_of(a).as_rotvec(), axis), abs=1e-7)


def as_near(vector: Any, axis: Any) -> Any:
    """Of half a turn about an axis and about the opposite one, which are the same, the one that is meant."""
    return -vector if abs(np.linalg.norm(vector) - np.pi) < 1e-6 and vector @ axis < 0 else vector


@given(vectors, st.floats(-1000, 1000))
def test_axis_and_angle_are_those_of_scipy(axis: tuple[float, float, float], angle: float) -> None:
    """Degrees, counter-clockwise, whatever the length of the axis."""
    expected = transform.Rotation.from_rotvec(np.radians(angle) * np.array(axis) / np.linalg.norm(axis))
    assert Rotation.from_axis_angle(axis, angle).as_matrix() == pytest.approx(expected.as_matrix(), abs=1e-11)


@given(st.sampled_from(["x", "y", "z"]), st.floats(-1e6, 1e6))
def test_axes_may_be_named(axis: str, angle: float) -> None:
    """A letter stands for the vector."""
    vector = np.eye(3)["xyz".index(axis)]
    assert Rotation.from_axis_angle(axis, angle) == Rotation.from_axis_angle(vector, angle)


ORDERS = ["".join(p) for n in (1, 2, 3) for p in permutations("xyz", n)] + ["xyx", "xzx", "yxy", "yzy", "zxz", "zyz"]


@pytest.mark.parametrize("order", ORDERS + [order.upper() for order in ORDERS])
@given(angles=st.tuples(*[st.floats(-360, 360)] * 3))
def test_euler_angles_are_those_of_scipy(order: str, angles: tuple[float, float, float]) -> None:
    """Small letters turn about the axes of space, capitals about those that turn along."""
    some = angles[: len(order)]
    expected = transform.Rotation.from_euler(order, some, degrees=True).as_matrix()
    assert Rotation.from_euler(order, some).as_matrix() == pytest.approx(np.reshape(expected, (3, 3)), abs=CLOSE)


@given(rotations)
def test_a_rotation_survives_its_matrix_its_quaternion_and_its_axis(a: Rotation) -> None:
    """The quaternion to the last bit, the others but for rounding."""
    assert Rotation(a.as_quaternion()) == a == Rotation.from_quaternion(-a.as_quaternion())
    assert close(Rotation(-2 * a.as_quaternion()), a)
    assert close(Rotation.from_matrix(a.as_matrix()), a)
    assert close(Rotation.from_matrix(a.as_matrix().astype(np.float32)), a) or np.allclose(
        Rotation.from_matrix(a.as_matrix().astype(np.float32)).as_matrix(), a.as_matrix(), atol=1e-6
    )
    axis, angle = a.as_axis_angle()
    assert close(Rotation.from_axis_angle(axis, angle), a)
    assert np.linalg.norm(axis) == pytest.approx(1)
    assert 0 <= angle <= 180


@given(quarter_turns)
def test_quarter_turns_are_exact(turns: list[tuple[str, int]]) -> None:
    """Their matrices hold 0, 1 and -1 and nothing else."""
    made = math.prod((Rotation.from_axis_angle(axis, 90 * n) for axis, n in turns), start=Rotation())
    once = [Rotation.from_axis_angle(axis, 90 * n) for axis, n in turns]
    assert all(set(turn.as_matrix().ravel().tolist()) <= {0.0, 1.0, -1.0} for turn in once)
    assert made.as_matrix() == pytest.approx(np.round(made.as_matrix()), abs=CLOSE)


@given(vectors, vectors)
def test_a_direction_is_carried_to_another_by_the_shortest_turn(
    a: tuple[float, float, float], b: tuple[float, float, float]
) -> None:
    """Lengths do not matter, and the angle is the one between the two."""
    start, end = np.array(a) / np.linalg.norm(a), np.array(b) / np.linalg.norm(b)
    turn = Rotation.from_vectors(a, b)
    assert turn.apply(start) == pytest.approx(end, abs=CLOSE)
    between = 2 * math.degrees(math.atan2(np.linalg.norm(start - end), np.linalg.norm(start + end)))
    assert turn.as_axis_angle()[1] == pytest.approx(between, abs=1e-6)


@given(vectors, vectors, st.floats(-20, -1))
def test_nearly_opposite_directions_are_carried_as_exactly(
    a: tuple[float, float, float], noise: tuple[float, float, float], exponent: float
) -> None:
    """Where the axis is ill-defined the end is not."""
    start = np.array(a) / np.linalg.norm(a)
    end = -start + 10**exponent * np.array(noise)
    assume(np.linalg.norm(end) > 0.1)
    end /= np.linalg.norm(end)
    assert Rotation.from_vectors(start, end).apply(start) == pytest.approx(end, abs=CLOSE)
    assert Rotation.from_vectors(start, -start).apply(start) == pytest.approx(-start, abs=CLOSE)


@given(rotations, rotations, shares)
def test_the_way_is_the_shortest_and_run_through_evenly(a: Rotation, b: Rotation, u: float) -> None:
    """At u, a share u of the angle lies behind and the rest before; the ends are exact."""
    angle = apart(a, b)
    there = slerp(a, b, u)
    assert apart(a, there) == pytest.approx(u * angle, abs=1e-6)
    assert apart(there, b) == pytest.approx((1 - u) * angle, abs=1e-6)
    assert slerp(a, b, 0.0) == a
    assert slerp(a, b, 1.0) == b
    assert slerp(a, a, u) == a
    assert close(slerp(a, b, u), slerp(b, a, 1 - u))


@given(rotations, rotations, shares)
def test_scipy_goes_the_same_way(a: Rotation, b: Rotation, u: float) -> None:
    """Except half a turn apart, where both ways are equally short."""
    assume(apart(a, b) < 179.9)
    way = transform.Slerp([0, 1], transform.Rotation.concatenate([scipy_of(a), scipy_of(b)]))
    assert slerp(a, b, u).as_matrix() == pytest.approx(way(u).as_matrix(), abs=1e-11)


@given(rotations, rotations, rotations, st.floats(-0.5, 1.5))
def test_the_way_does_not_depend_on_the_axes(a: Rotation, b: Rotation, c: Rotation, u: float) -> None:
    """Turning both ends turns what lies between, from either side."""
    assume(apart(a, b) < 179.9)
    assert close(slerp(c * a, c * b, u), c * slerp(a, b, u))
    assert close(slerp(a * c, b * c, u), slerp(a, b, u) * c)


@given(st.lists(st.tuples(rotations, rotations, st.floats(-0.5, 1.5) | st.sampled_from([0.0, 1.0])), min_size=1))
def test_many_at_once_are_as_one_by_one(ways: list[tuple[Rotation, Rotation, float]]) -> None:
    """To 1e-12, the ends to the last bit, also half a turn apart."""
    a, b = (np.array([way[k].as_quaternion() for way in ways]) for k in (0, 1))
    u = np.array([way[2] for way in ways])
    together = slerp_quaternions(a, b, u)
    alone = np.array([slerp(*way).as_quaternion() for way in ways])
    assert quaternion_matrices(together) == pytest.approx(quaternion_matrices(alone), abs=CLOSE)
    ends = (u == 0) | (u == 1)
    assert (together[ends] == alone[ends]).all()
    first = ways[0]
    for one, many in zip([slerp(first[0], first[1], x) for x in u.tolist()], slerp(first[0], first[1], u), strict=True):
        assert close(one, many)


@given(st.lists(st.tuples(rotations, rotations), min_size=1))
def test_kernels_do_what_rotations_do(pairs: list[tuple[Rotation, Rotation]]) -> None:
    """Products, canonical signs and matrices, in any leading shape."""
    a, b = (np.array([pair[k].as_quaternion() for pair in pairs])[:, None] for k in (0, 1))
    product = canonical_quaternions(multiply_quaternions(a, b))
    expected = np.array([(x * y).as_matrix() for x, y in pairs])[:, None]
    assert quaternion_matrices(product) == pytest.approx(expected, abs=CLOSE)
    assert (quaternion_matrices(a)[:, 0] == np.array([x.as_matrix() for x, _ in pairs])).all()
    assert (canonical_quaternions(-a) == a).all()
    assert multiply_quaternions(a, b[:, 0]).shape == (len(pairs), len(pairs), 4)


def test_half_a_turn_apart_rounding_does_not_choose_the_way() -> None:
    """
    A key at 0 and one at 180 degrees: the way leads over 90, though the half turn came about with an error.

        0 --> 90 --> 180
    """
    for half in (Rotation.from_axis_angle("z", 180), Rotation((-1e-17, 0, 0, 1)), Rotation((1e-17, 0, 0, 1))):
        assert apart(slerp(Rotation(), half, 0.5), Rotation.from_axis_angle("z", 90)) < 1e-6
        assert apart(slerp(Rotation(), half, [0.5])[0], Rotation.from_axis_angle("z", 90)) < 1e-6


def test_a_tiny_turn_is_interpolated_too() -> None:
    """Down to the last bits: no threshold below which the way is something else."""
    for angle in (1e-3, 1e-8, 1e-12):
        there = slerp(Rotation(), Rotation.from_axis_angle("x", angle), 0.25)
        assert there.as_axis_angle()[1] == pytest.approx(angle / 4, rel=1e-9)


def test_equal_rotations_have_equal_bytes() -> None:
    """Q and -q, -0.0 and 0.0, whole turns: one value, one hash."""
    assert Rotation((-0.5, 0.5, -0.5, 0.5)) == Rotation((0.5, -0.5, 0.5, -0.5))
    half = Rotation((0, -1, -0.0, 0))
    assert half.as_quaternion().tobytes() == np.array([0.0, 1, 0, 0]).tobytes()
    assert half == half.inverse()
    assert Rotation.from_axis_angle("y", 30) == Rotation.from_axis_angle("y", 750)
    assert len({Rotation(), Rotation((-1, 0, 0, 0)), Rotation((3, 0, 0, -0.0))}) == 1
    assert Rotation() != Rotation.from_axis_angle("x", 1e-6)
    assert Rotation() != "identity"


@pytest.mark.parametrize("scale", [5e-324, 1e-300, 1e-160, 1.0, 1e160, 1.7e308])
def test_quaternions_and_axes_of_any_length_will_do(scale: float) -> None:
    """They are normalized, and no square overflows or vanishes."""
    quaternion = Rotation((scale, scale, 0, 0))
    assert close(quaternion, Rotation.from_axis_angle("x", 90))
    assert close(Rotation.from_axis_angle((scale, scale, 0), 30), Rotation.from_axis_angle((1, 1, 0), 30))
    assert close(Rotation.from_vectors((scale, 0, 0), (0, scale, 0)), Rotation.from_axis_angle("z", 90))
    assert close(
        Rotation.from_vectors((scale, 0, 0), (-scale, 0, 0)) * Rotation.from_vectors((1, 0, 0), (-1, 0, 0)), Rotation()
    )


def test_a_long_chain_stays_a_rotation() -> None:
    """A million degrees in steps of one: the length of the quaternion does not drift."""
    step, turned = Rotation.from_axis_angle((1, 2, 3), 1.0), Rotation()
    for _ in range(3600):
        turned = step * turned
    assert abs(np.linalg.norm(turned.as_quaternion()) - 1) < 1e-14
    assert apart(turned, Rotation()) < 1e-9


def test_nothing_can_be_changed() -> None:
    """No attribute can be set, and the arrays that are answered are the asker's own."""
    turn = Rotation.from_axis_angle("z", 90)
    before = hash(turn)
    for name in ("_wxyz", "nbytes", "other"):
        with pytest.raises(AttributeError):
            setattr(turn, name, 5)
    with pytest.raises(AttributeError):
        del turn._wxyz
    turn.as_quaternion()[:] = 0
    turn.as_matrix()[:] = 0
    turn.as_axis_angle()[0][:] = 0
    given_array = np.array([1.0, 0, 0, 0])
    made = Rotation(given_array)
    given_array[:] = 7
    assert hash(turn) == before
    assert turn == Rotation.from_axis_angle("z", 90)
    assert made == Rotation()
    assert pickle.loads(pickle.dumps(turn)) == copy.deepcopy(turn) == copy.copy(turn) == turn


def test_its_size_is_what_it_takes() -> None:
    """Measured on its parts, the object's own header left out."""
    turn = Rotation((1, 2, 3, 4))
    parts = sys.getsizeof(turn._wxyz) + sum(map(sys.getsizeof, turn._wxyz))
    assert turn.nbytes == pytest.approx(parts, rel=0.2)


def test_a_rotation_says_what_it_does() -> None:
    """Angle and axis, without the noise of rounding."""
    assert repr(Rotation()) == "Rotation(identity)"
    assert repr(Rotation.from_axis_angle("x", 30)) == "Rotation(30° about (1, 0, 0))"
    assert repr(Rotation.from_euler("xyz", (90, 90, 0))) == "Rotation(120° about (0.57735, 0.57735, -0.57735))"


NOT_VECTORS = [
    (1, 2),
    (1, 2, 3, 4, 5),
    [[1, 2, 3]],
    3,
    None,
    "abc",
    (1, "2", 3),
    ((1, 2), 3, 4),
    (1j, 0, 0),
    (True,) * 3,
]
NOT_FINITE = [math.nan, math.inf, -math.inf]


@pytest.mark.parametrize("bad", [*NOT_VECTORS, *[(1, x, 0) for x in NOT_FINITE], (0, 0, 0), (0, -0.0, 0)])
def test_what_is_no_direction_is_refused(bad: Any) -> None:
    """Wrong shapes, other types, NaN, and the zero vector."""
    with pytest.raises(UnknownNameError if isinstance(bad, str) else ShapeError, match="axis"):
        Rotation.from_axis_angle(bad, 30)
    with pytest.raises(ShapeError, match="start"):
        Rotation.from_vectors(bad, (1, 0, 0))
    with pytest.raises(ShapeError, match="end"):
        Rotation.from_vectors((1, 0, 0), bad)


@pytest.mark.parametrize("bad", [*NOT_VECTORS, *[(1, x, 0, 0) for x in NOT_FINITE], (0, 0, 0, 0), (1, 0, 0)])
def test_what_is_no_quaternion_is_refused(bad: Any) -> None:
    """Four finite numbers, not all of them 0; every other length is normalized."""
    with pytest.raises(ShapeError, match="quaternion"):
        Rotation(bad)


@pytest.mark.parametrize("bad", [*NOT_FINITE, None, "30", (30,), 1j, 10**400])
def test_what_is_no_angle_is_refused(bad: Any) -> None:
    """One finite number of degrees."""
    with pytest.raises(ShapeError, match="angle"):
        Rotation.from_axis_angle("x", bad)
    with pytest.raises(ShapeError, match="angle"):
        Rotation.from_euler("xy", (0, bad))


@pytest.mark.parametrize("bad", ["", "xxy", "xY", "abc", "xyzx", None, 3, "x y"])
def test_an_order_that_is_none_is_refused(bad: Any) -> None:
    """The note says what the letters mean."""
    with pytest.raises(ShapeError, match="order") as caught:
        Rotation.from_euler(bad, (1, 2, 3))
    assert "capitals" in caught.value.__notes__[0]


@pytest.mark.parametrize("angles", [(1, 2), (1, 2, 3, 4), 5, [[1, 2, 3]]])
def test_as_many_angles_as_axes(angles: Any) -> None:
    """Neither fewer nor more."""
    with pytest.raises(ShapeError, match="angles: expected 3 numbers"):
        Rotation.from_euler("xyz", angles)


@pytest.mark.parametrize(
    ("bad", "why"),
    [
        (np.eye(4), "shape"),
        (np.eye(3) * 2, "orthonormal"),
        (np.diag([1.0, 1.0, -1.0]), "mirror"),
        (np.full((3, 3), np.nan), "orthonormal"),
        ([[1, 0, 0], [0, 1, 0]], "shape"),
        ([[1, 0, 0], [0, 1]], "numbers"),
        (np.array([[1, 0.01, 0], [0, 1, 0], [0, 0, 1]]), "orthonormal"),
    ],
)
def test_a_matrix_that_is_no_rotation_is_refused(bad: Any, why: str) -> None:
    """Scaled, sheared, mirrored, of another shape, not numbers."""
    with pytest.raises(ShapeError, match=why):
        Rotation.from_matrix(bad)


@pytest.mark.parametrize("bad", [np.zeros(2), np.zeros((2, 4)), np.zeros((1, 2, 3)), 5, "xyz", [(1, 2, 3), (1, 2)]])
def test_points_of_another_shape_are_refused(bad: Any) -> None:
    """(N, 3) or (3,), and numbers."""
    with pytest.raises(ShapeError, match="points"):
        Rotation().apply(bad)


@pytest.mark.parametrize("bad", [*NOT_FINITE, None, "0.5", [[0.5]], [0.5, math.nan]])
def test_a_share_that_is_no_number_is_refused(bad: Any) -> None:
    """Also among many."""
    with pytest.raises(ShapeError, match="u: expected"):
        slerp(Rotation(), Rotation(), bad)


def test_only_rotations_are_composed() -> None:
    """A factor of another type is an error of type, as for Python's own values."""
    for other in (2, np.eye(3), (1, 0, 0, 0)):
        with pytest.raises(TypeError):
            Rotation() * other  # type: ignore[operator]
        with pytest.raises(TypeError):
            other * Rotation()  # type: ignore[operator]
        assert (Rotation() == other) is False
    with pytest.raises(ShapeError, match="expected two rotations"):
        slerp(Rotation(), (1, 0, 0, 0), 0.5)  # type: ignore[call-overload]
