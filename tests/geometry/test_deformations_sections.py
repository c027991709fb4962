"""The laws of twist, taper and skew, which move the sections across an axis: volumes, ends and limits."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from reactive4d.errors import ShapeError
from reactive4d.geometry.deformations.skews import Skew
from reactive4d.geometry.deformations.stacks import deform
from reactive4d.geometry.deformations.steps import Step
from reactive4d.geometry.deformations.tapers import Taper
from reactive4d.geometry.deformations.twists import Twist

Array = NDArray[Any]

angles = st.floats(-6.0, 6.0)
amounts = st.floats(-0.9, 2.0)


def box(sides: tuple[float, float, float], cuts: int, *, lower: float = 0.0) -> tuple[Array, Array]:
    """A closed box that stands on z = `lower`, finely meshed: points, and faces outward."""
    steps = np.linspace(-0.5, 0.5, cuts + 1)
    points: list[Array] = []
    faces: list[Array] = []
    a, b = (grid.ravel() for grid in np.meshgrid(steps, steps, indexing="ij"))
    row, column = (grid.ravel() for grid in np.meshgrid(np.arange(cuts), np.arange(cuts), indexing="ij"))
    first = row * (cuts + 1) + column
    quads = np.stack([first, first + cuts + 1, first + cuts + 2, first + 1], axis=1)
    for axis in range(3):
        for side in (0.5, -0.5):
            corners = np.empty((len(a), 3))
            corners[:, axis], corners[:, (axis + 1) % 3], corners[:, (axis + 2) % 3] = side, a, b
            outward = quads if side > 0.0 else quads[:, ::-1]
            faces += [outward[:, (0, 1, 2)] + len(a) * len(points), outward[:, (0, 2, 3)] + len(a) * len(points)]
            points.append(corners)
    solid = np.concatenate(points) * sides + (0.0, 0.0, 0.5 * sides[2] + lower)
    return solid.astype(np.float32), np.concatenate(faces)


def volume(points: Array, faces: Array) -> float:
    """What the faces enclose."""
    a, b, c = points.astype(np.float64)[faces].transpose(1, 0, 2)
    return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6.0


def deformed(step: Step, points: Array) -> Array:
    """Points deformed over their own extent."""
    return step.map(points, step.extent(points))


BOX = box((1.0, 1.5, 2.0), 60, lower=-0.7)


@pytest.mark.parametrize("center", [(0, 0, 0), (0.7, -0.2, 0.1)])
@pytest.mark.parametrize("step", [Twist(2.5), Twist(-1.5, "x", bias=0.5), Twist(3.0, lower=-0.2, upper=0.4), Skew(1.5)])
def test_volume_is_kept(step: Any, center: Any):
    """A twist and a skew keep the volume of a solid, about any axis; its mesh does the better the finer it is."""
    step = type(step)(
        **{name: getattr(step, name) for name in step.__dataclass_fields__ if not name.startswith("_")}
        | {"center": center}
    )
    errors: list[float] = []
    for cuts in (20, 40):
        points, faces = box((1.0, 1.5, 2.0), cuts, lower=-0.7)
        errors.append(abs(volume(deformed(step, points), faces) / 3.0 - 1.0))
    assert errors[1] < 4e-3
    assert errors[1] < 0.35 * errors[0] + 1e-6
    slopes = step.jacobian(BOX[0][::50].astype(np.float64), step.extent(BOX[0]))
    assert np.allclose(np.linalg.det(slopes), 1.0, atol=1e-9)


@given(angles, st.floats(-2.0, 2.0))
def test_the_ends_turn_by_the_angle(angle: float, bias: float):
    """From end to end sections turn by the angle, whatever the bias; distances from the axis are kept."""
    points = np.array([(1.0, 0.0, z) for z in (-0.5, -0.25, 0.0, 0.75, 1.5)])
    answer = deformed(Twist(angle, bias=bias), points)
    turned = np.arctan2(answer[:, 1], answer[:, 0])
    assert np.allclose(np.hypot(answer[:, 0], answer[:, 1]), 1.0)
    assert math.isclose(math.cos(turned[-1] - turned[0]), math.cos(angle), abs_tol=1e-9)
    assert math.isclose(math.sin(turned[-1] - turned[0]), math.sin(angle), abs_tol=1e-9)
    assert np.array_equal(answer[2], points[2])
    wanted = 0.75 * angle * (0.75 / 1.5) ** (2.0**bias)  # Three quarters of the length are above the centre.
    assert math.isclose(math.cos(turned[3]), math.cos(wanted), abs_tol=1e-9)
    assert math.isclose(math.sin(turned[3]), math.sin(wanted), abs_tol=1e-9)


def test_a_twist_is_counter_clockwise_at_the_tip():
    """A positive angle turns what lies towards the tip of the axis counter-clockwise."""
    tip = np.array(((1.0, 0.0, 1.0),))
    assert np.allclose(Twist(math.pi / 2).map(tip, (0.0, 1.0)), ((0.0, 1.0, 1.0),))


@given(amounts, st.floats(0.2, 3.0))
def test_the_volume_of_a_taper_has_a_closed_form(amount: float, height: float):
    """A box of base A tapered from 1 to 1 + a has the volume A h (1 + a + a² / 3); along one side A h (1 + a / 2)."""
    points, faces = box((1.0, 2.0, height), 8)
    wanted = 2.0 * height * (1.0 + amount + amount**2 / 3.0)
    assert math.isclose(volume(deformed(Taper(amount), points), faces), wanted, rel_tol=2e-5)
    wanted = 2.0 * height * (1.0 + amount / 2.0)
    assert math.isclose(volume(deformed(Taper(amount, effect="y"), points), faces), wanted, rel_tol=1e-5)


@given(amounts, st.floats(-0.5, 1.0))
def test_the_volume_of_a_curved_taper_has_one_too(amount: float, curve: float):
    """With a curve c it is A h (1 + a + a²/3 + 4c/3 + 2ac/3 + 8c²/15): the integral of the factor's square."""
    points, faces = box((1.0, 1.0, 2.0), 60)
    wanted = 1.0 + amount + amount**2 / 3.0 + 4.0 * curve / 3.0 + 2.0 * amount * curve / 3.0 + 8.0 * curve**2 / 15.0
    answer = deformed(Taper(amount, curve), points)
    assert math.isclose(volume(answer, faces), 2.0 * wanted, rel_tol=2e-3)


def test_a_curve_leaves_the_ends_and_bulges_the_middle():
    """Half-way between the ends the factor is more by the curve, and at the ends it is what the amount says."""
    points = np.array([(1.0, 1.0, z) for z in (0.0, 1.0, 2.0)])
    assert np.allclose(deformed(Taper(0.5, 0.25), points)[:, 0], (1.0, 1.5, 1.5))


def test_a_symmetric_taper_is_the_same_on_both_sides():
    """Symmetric about the centre, what lies as far above as below is scaled alike."""
    points = np.array([(1.0, 1.0, z) for z in (-1.0, -0.5, 0.0, 0.5, 1.0)])
    scale = deformed(Taper(-0.8, is_symmetric=True), points)[:, 0]
    assert np.allclose(scale, scale[::-1])
    assert np.allclose(scale, (0.6, 0.8, 1.0, 0.8, 0.6))


@pytest.mark.parametrize(("axis", "effect", "scaled"), [("z", "x", 0), ("z", "y", 1), ("x", "z", 2), ("y", "x", 0)])
def test_a_taper_may_scale_one_coordinate(axis: str, effect: str, scaled: int):
    """The effect names the coordinates that are scaled; both is the same as none named."""
    points = BOX[0][::40]
    answer = deformed(Taper(0.5, axis=axis, effect=effect), points)
    for place in range(3):
        assert np.array_equal(answer[:, place], points[:, place]) == (place != scaled)
    both = "".join(letter for letter in "xyz" if letter != axis)
    assert np.array_equal(deformed(Taper(0.5, axis=axis, effect=both), points), deformed(Taper(0.5, axis=axis), points))


@pytest.mark.parametrize(("axis", "effect"), [("z", "z"), ("x", "xy"), ("z", ""), ("y", "w"), ((1, 1, 0), "x")])
def test_an_effect_lies_across_the_axis(axis: Any, effect: str):
    """What does not lie across the axis cannot be scaled by a taper along it."""
    with pytest.raises(ShapeError, match="does not lie across the axis"):
        Taper(0.5, axis=axis, effect=effect)


@pytest.mark.parametrize("family", [Twist, Taper, Skew])
@given(amount=st.floats(-2.0, 2.0), lower=st.floats(-1.0, 0.4), upper=st.floats(0.5, 1.0))
def test_beyond_the_limits_all_is_affine(family: Any, amount: float, lower: float, upper: float):
    """Beyond a limit all points go as the limit's own section goes, by one affine map, without a step between."""
    step = family(amount, lower=lower, upper=upper)
    for limit, way in ((lower, -1.0), (upper, 1.0)):
        points = np.random.default_rng(1).uniform(-1.0, 1.0, (20, 3))
        points[:, 2] = limit + way * np.abs(points[:, 2])
        at = points.copy()
        at[:, 2] = limit
        answer, edge = step.map(points, (0.0, 0.0)), step.map(at, (0.0, 0.0))
        assert np.allclose(answer - points * (0, 0, 1), edge - at * (0, 0, 1), atol=1e-12)
        inside = at - (0.0, 0.0, way * 1e-9)
        assert np.allclose(step.map(inside, (0.0, 0.0)), edge, atol=1e-7)


@given(st.floats(-2.0, 2.0), st.floats(-3.0, 3.0))
def test_a_skew_slides_by_the_amount(amount: float, way: float):
    """The ends part by the amount, in its direction, and everything between evenly."""
    points = np.array([(0.0, 0.0, z) for z in (-1.0, 0.0, 1.0, 3.0)])
    answer = deformed(Skew(amount, way), points)
    expected = points[:, 2:] / 4.0 * amount * (math.cos(way), math.sin(way), 0.0) + points
    assert np.allclose(answer, expected, atol=1e-12)


@given(angles, angles)
def test_twists_about_one_axis_add_up(a: float, b: float):
    """A twist by a and then by b is a twist by a + b: in between, nothing has moved along the axis."""
    points = BOX[0][::100]
    assert np.allclose(deform(points, [Twist(a), Twist(b)]), deform(points, [Twist(a + b)]), atol=1e-5)
