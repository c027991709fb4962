"""Curves of control points: what each kind passes through, and the laws of their bases."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive4d.errors import ShapeError, UnknownNameError
from reactive4d.geometry import curves

small = settings(max_examples=30)


@st.composite
def families(draw):
    """A kind with a count of points that fits it."""
    kind = draw(st.sampled_from(curves.KINDS))
    closed = draw(st.booleans())
    degree = draw(st.integers(1, 4))
    count = degree * draw(st.integers(1, 4)) + (not closed) if kind == "bezier" else draw(st.integers(3, 9))
    if closed and count < 3:
        count = degree * 3
    return count, {"kind": kind, "closed": closed, "degree": degree}


parameters = st.lists(st.floats(0, 1), min_size=1, max_size=8)


@small
@given(families(), parameters)
def test_weights_sum_to_one_and_those_of_derivatives_to_zero(family, u):
    """So a curve moves with its points: every affine map of the points maps the curve."""
    count, options = family
    np.testing.assert_allclose(curves.basis(u, count, **options).sum(axis=1), 1, atol=1e-12)
    for order in (1, 2):
        scale = (count * 4) ** order
        sums = curves.basis(u, count, order=order, **options).sum(axis=1)
        np.testing.assert_allclose(sums / scale, 0, atol=1e-12)


@small
@given(families(), st.floats(0.01, 0.99))
def test_derivatives_are_the_slopes_of_the_positions(family, u):
    """Central differences beside u agree, away from the joints between spans."""
    count, options = family
    pieces = curves.spans(count, **options)
    h = 1e-5 / pieces
    if abs(u * pieces - round(u * pieces)) < 1e-3:
        return
    controls = np.random.default_rng(count).normal(size=(count, 3))
    slope = (curves.position(controls, u + h, **options) - curves.position(controls, u - h, **options)) / (2 * h)
    np.testing.assert_allclose(curves.derivative(controls, u, **options), slope, rtol=1e-5, atol=1e-4)


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("kind", ["linear", "catmull_rom"])
def test_interpolating_kinds_pass_through_their_points(kind, closed):
    """Point i is met at i / spans."""
    controls = np.random.default_rng(1).normal(size=(6, 3))
    u = np.arange(6) / (6 if closed else 5)
    np.testing.assert_allclose(curves.position(controls, u, kind=kind, closed=closed), controls, atol=1e-12)


@pytest.mark.parametrize("kind", curves.KINDS)
def test_open_curves_begin_and_end_at_their_ends(kind):
    """The first and the last control point belong to every open curve, and parameters beyond are held there."""
    controls = np.random.default_rng(2).normal(size=(7, 3))
    ends = curves.position(controls, [-1.0, 0.0, 1.0, 2.0], kind=kind)
    np.testing.assert_allclose(ends, controls[[0, 0, -1, -1]], atol=1e-12)


@pytest.mark.parametrize("kind", curves.KINDS)
def test_closed_curves_return(kind):
    """Position and (but for corners) tangent at 1 are those at 0, to the last bit of the sampled line."""
    controls = np.random.default_rng(3).normal(size=(6, 3))
    at = curves.position(controls, [0.0, 1.0, 0.25, 1.25, -0.75], kind=kind, closed=True)
    assert at[0].tobytes() == at[1].tobytes()
    np.testing.assert_allclose(at[2:5], at[[2, 2, 2]], atol=1e-12)
    line = curves.polyline(controls, 10, kind=kind, closed=True)
    assert line[0].tobytes() == line[-1].tobytes()
    assert line.dtype == np.float32


def test_catmull_rom_and_bsplines_are_smooth():
    """Catmull-Rom has one continuous derivative at its joints, a cubic B-spline two; closed ones at 0 as well."""
    controls = np.random.default_rng(4).normal(size=(5, 3))
    e = 1e-9
    for kind, orders in (("catmull_rom", (1,)), ("bspline", (1, 2))):
        for order in orders:
            joints = np.arange(5) / 5
            before = curves.derivative(controls, joints - e, kind=kind, closed=True, order=order)
            after = curves.derivative(controls, joints + e, kind=kind, closed=True, order=order)
            np.testing.assert_allclose(before, after, rtol=1e-5, atol=1e-4)


def test_a_bspline_keeps_inside_of_the_hull_of_its_points():
    """Its weights are never negative; nor are those of Bézier curves."""
    u = np.linspace(0, 1, 97)
    for kind in ("bspline", "bezier", "linear"):
        for closed in (False, True):
            assert curves.basis(u, 6 if closed else 7, kind=kind, closed=closed).min() >= -1e-15


def test_a_bezier_curve_of_full_degree_is_de_casteljau_s():
    """Repeated halving of the polygon gives the same point (de Casteljau)."""
    controls = np.random.default_rng(5).normal(size=(6, 3))
    u, points = 0.3, controls
    while len(points) > 1:
        points = (1 - u) * points[:-1] + u * points[1:]
    np.testing.assert_allclose(curves.position(controls, u, kind="bezier", degree=5), points[0], atol=1e-14)


def test_a_bspline_agrees_with_scipy_s_design_matrix():
    """The cached basis is that of the clamped uniform knots."""
    from scipy.interpolate import BSpline

    u = np.linspace(0, 1, 23)
    knots = np.r_[[0] * 3, np.linspace(0, 1, 5), [1] * 3]
    expected = BSpline.design_matrix(u, knots, 3).toarray()
    np.testing.assert_allclose(curves.basis(u, 7, kind="bspline"), expected, atol=1e-14)


def test_uniform_points_on_a_line_are_passed_at_uniform_speed():
    """All interpolating kinds reproduce straight motion, ends included."""
    controls = np.arange(5.0)[:, None] * [1.0, -2.0, 0.5]
    u = np.linspace(0, 1, 33)
    for kind in ("linear", "catmull_rom"):
        np.testing.assert_allclose(curves.position(controls, u, kind=kind), u[:, None] * controls[-1], atol=1e-12)


def test_the_basis_is_computed_once():
    """Asked with the same counts it is the same array, whatever the points are."""
    assert curves.sampled_basis(5, 16, kind="bspline") is curves.sampled_basis(5, 16, kind="bspline")
    assert not curves.sampled_basis(5, 16).flags.writeable


def test_tangents_are_unit_vectors_along_the_curve():
    """A circle's tangent is across its radius."""
    angle = np.arange(12) * math.pi / 6
    controls = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    u = np.arange(12) / 12
    t = curves.tangent(controls, u, closed=True)
    np.testing.assert_allclose(np.linalg.norm(t, axis=1), 1)
    np.testing.assert_allclose(np.einsum("ij,ij->i", t, controls), 0, atol=1e-12)
    assert curves.tangent(controls, 0.0, closed=True).shape == (3,)


def test_where_the_derivative_vanishes_the_tangent_is_taken_from_beside():
    """Bézier ends whose handles lie on the end point still have a direction; a curve of one point has none."""
    controls = [(0, 0, 0), (0, 0, 0), (1, 0, 0), (2, 1, 0)]
    np.testing.assert_allclose(curves.tangent(controls, 0.0, kind="bezier"), (1, 0, 0), atol=1e-2)
    with pytest.raises(ShapeError, match=r"no direction at u = 0.5: it stands still"):
        curves.tangent([(1, 2, 3)] * 4, 0.5)


def test_lengths_have_closed_forms():
    """A polygon's length is that of its sides; a parabola's has a formula; a straight spline is its chord."""
    assert curves.length([(0, 0), (1, 0), (1, 1), (0, 1)], kind="linear", closed=True) == pytest.approx(4)
    parabola = [(0, 0), (0.5, 0), (1, 1)]  # y = x²
    exact = math.sqrt(5) / 2 + math.asinh(2) / 4
    assert curves.length(parabola, kind="bezier", degree=2) == pytest.approx(exact, rel=1e-9)
    for kind in curves.KINDS:
        assert curves.length([(0, 0, 0), (1, 1, 0), (2, 2, 0), (3, 3, 0)], kind=kind) == pytest.approx(18**0.5)


@pytest.mark.parametrize("kind", curves.KINDS)
@pytest.mark.parametrize("closed", [False, True])
def test_equal_fractions_of_the_length_are_equally_far_apart(kind, closed):
    """The lengths between the parameters, measured on a fine chain, agree; and the parameters grow."""
    controls = np.random.default_rng(6).normal(size=(6 if closed else 7, 3))
    u = curves.parameters(controls, np.linspace(0, 1, 9), kind=kind, closed=closed)
    assert u[0] == 0
    assert u[-1] == pytest.approx(1)
    assert (np.diff(u) > 0).all()
    fine = []
    for a, b in itertools.pairwise(u):
        chain = curves.position(controls, np.linspace(a, min(b, 1 - 1e-12), 400), kind=kind, closed=closed)
        fine.append(np.linalg.norm(np.diff(chain, axis=0), axis=1).sum())
    np.testing.assert_allclose(fine, sum(fine) / 8, rtol=2e-3)


def test_a_curve_without_length_answers_with_the_fractions():
    """Nothing is divided by nothing."""
    assert curves.parameters([(1, 1)] * 3, [0, 0.25, 1]).tolist() == [0, 0.25, 1]
    assert curves.length([(1, 1)] * 3) == pytest.approx(0, abs=1e-14)


def test_few_points_lower_the_degree():
    """Two points are a straight line for every kind, three at most a parabola."""
    for kind in curves.KINDS:
        np.testing.assert_allclose(curves.position([(0, 0, 0), (2, 4, 6)], 0.5, kind=kind), (1, 2, 3))
    assert curves.spans(3, kind="bezier") == curves.spans(3, kind="bspline") == 1


def test_what_makes_no_curve_is_refused():
    """Too few points, unknown kinds, wrong degrees, parameters and shapes are named."""
    with pytest.raises(ShapeError, match="at least 2 points of a curve, got 1"):
        curves.position([(0, 0, 0)], 0.5)
    with pytest.raises(ShapeError, match="at least 3 points of a closed curve, got 2"):
        curves.position([(0, 0, 0), (1, 0, 0)], 0.5, closed=True)
    with pytest.raises(ShapeError, match="6 points make no whole number of Bézier curves of degree 3") as caught:
        curves.position(np.zeros((6, 3)), 0.5, kind="bezier")
    assert caught.value.__notes__ == ["hint: give 4 or 7 points"]
    with pytest.raises(UnknownNameError, match="catmul"):
        curves.position(np.zeros((6, 3)), 0.5, kind="catmul_rom")
    with pytest.raises(ShapeError, match="degree: expected 1 to 16, got 0"):
        curves.position(np.zeros((6, 3)), 0.5, kind="bspline", degree=0)
    with pytest.raises(ShapeError, match=r"u: expected finite numbers of shape \(S,\), got \[nan\]"):
        curves.position(np.zeros((6, 3)), math.nan)
    with pytest.raises(ShapeError, match="u: expected a number or shape"):
        curves.position(np.zeros((6, 3)), [[0.5]])
    with pytest.raises(ShapeError, match="point 1 is"):
        curves.position([(0, 0, 0), (0, math.inf, 0)], 0.5)
    with pytest.raises(ShapeError, match=r"shape \(N, D\)"):
        curves.position([1, 2, 3], 0.5)
    with pytest.raises(ShapeError, match="samples: expected at least 1, got 0"):
        curves.polyline(np.zeros((6, 3)), 0)
    with pytest.raises(ShapeError, match="order: expected 0, 1 or 2, got 3"):
        curves.basis([0.5], 4, order=3)
    with pytest.raises(ShapeError, match="fractions"):
        curves.parameters([(0, 0), (1, 1)], [math.nan])
