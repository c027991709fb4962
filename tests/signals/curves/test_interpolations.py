"""Every interpolation against an implementation by somebody else, and its defining properties."""

from typing import Any

import numpy as np
import pytest
import splines  # pyright: ignore[reportMissingTypeStubs]
import splines.quaternion  # pyright: ignore[reportMissingTypeStubs]
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import BSpline, CubicHermiteSpline
from scipy.spatial.transform import Rotation as SciPyRotation
from scipy.spatial.transform import Slerp

from reactive4d.signals.colors import color, mix
from reactive4d.signals.curves import Curve, Key, bsplines, clocks
from reactive4d.signals.rotations import Rotation

RANDOM = np.random.default_rng(7)
TIMES = np.sort(RANDOM.uniform(0.0, 10.0, 8))
VALUES = RANDOM.normal(size=(8, 3))
INSIDE = np.sort(RANDOM.uniform(TIMES[0], TIMES[-1], 100))


def _curve(values: Any = VALUES, **settings: Any) -> Curve:
    return Curve(dict(zip(TIMES, values, strict=True)), **settings)


def _both_ways(curve: Curve, expected: Any) -> None:
    np.testing.assert_allclose([curve.at(t) for t in INSIDE], expected, rtol=0, atol=1e-13)
    np.testing.assert_allclose(curve.sample_many(INSIDE), expected, rtol=0, atol=1e-13)


def test_linear_is_numpys() -> None:
    """Linear keys answer as np.interp does."""
    _both_ways(_curve(VALUES[:, 0]), np.interp(INSIDE, TIMES, VALUES[:, 0]))


def test_catmull_rom_over_the_key_times_is_the_nonuniform_one() -> None:
    """Its velocity is continuous however unevenly the keys stand in time."""
    _both_ways(_curve(interpolation="catmull_rom"), splines.CatmullRom(VALUES, TIMES).evaluate(INSIDE))


@pytest.mark.parametrize(("name", "alpha"), [("uniform", 0.0), ("centripetal", 0.5), ("chordal", 1.0)])
def test_the_other_catmull_roms_have_their_shape_from_the_values_alone(name: str, alpha: float) -> None:
    """The path is that of the parametrised spline; the times only say when it is gone through."""
    path = splines.CatmullRom(VALUES, alpha=alpha)
    expected = path.evaluate(np.interp(INSIDE, TIMES, path.grid))
    _both_ways(_curve(interpolation=f"catmull_rom_{name}"), expected)


def test_a_centripetal_path_rests_where_two_keys_are_in_one_place() -> None:
    """Equal neighbours hold, and the path goes on from there."""
    curve = Curve({0: (0, 0), 1: (1, 1), 2: (1, 1), 3: (2, 0)}, interpolation="catmull_rom_centripetal")
    assert curve.sample(1.5)[:2] == (1.0, 2.0)
    assert np.isfinite(curve.sample_many(np.linspace(0, 3, 50))).all()


def test_tcb_is_kochanek_and_bartels() -> None:
    """With tension, continuity and bias per key and keys unevenly spaced."""
    tcb = RANDOM.uniform(-1, 1, size=(8, 3))
    tcb[[0, -1]] = 0.0
    keys = [Key(v, tension=t, continuity=c, bias=b) for v, (t, c, b) in zip(VALUES, tcb, strict=True)]
    _both_ways(
        _curve(keys, interpolation="tcb"), splines.KochanekBartels(VALUES, TIMES, tcb=tcb[1:-1]).evaluate(INSIDE)
    )


def test_tcb_without_settings_is_catmull_rom() -> None:
    """Tension, continuity and bias 0."""
    _both_ways(_curve(interpolation="tcb"), _curve(interpolation="catmull_rom").sample_many(INSIDE))


def test_hermite_takes_the_handles_as_slopes() -> None:
    """A handle (dt, dv) says the slope dv / dt, however long it is."""
    slopes = RANDOM.normal(size=(8, 3))
    keys = [Key(v, left=(-0.5, -0.5 * m), right=(2.0, 2.0 * m)) for v, m in zip(VALUES, slopes, strict=True)]
    _both_ways(_curve(keys, interpolation="hermite"), CubicHermiteSpline(TIMES, VALUES, slopes)(INSIDE))


@pytest.mark.parametrize("name", ["hermite", "bezier"])
def test_a_side_without_a_handle_leaves_straight_for_the_neighbour(name: str) -> None:
    """So that keys without handles are linear."""
    _both_ways(_curve(VALUES[:, 0], interpolation=name), np.interp(INSIDE, TIMES, VALUES[:, 0]))


@pytest.mark.parametrize("degree", [1, 2, 3, 5, 7])
def test_a_bspline_is_scipys_with_the_keys_as_control_points(degree: int) -> None:
    """Clamped, its knots the means of neighbouring key times."""
    knots = bsplines.knots(TIMES.tolist(), degree)
    _both_ways(_curve(interpolation="bspline", degree=degree), BSpline(np.array(knots), VALUES, degree)(INSIDE))


def test_a_bspline_of_degree_one_is_linear() -> None:
    """Its knots are the keys."""
    _both_ways(_curve(VALUES[:, 0], interpolation="bspline", degree=1), np.interp(INSIDE, TIMES, VALUES[:, 0]))


def test_few_keys_lower_the_degree_of_a_bspline() -> None:
    """Two keys make a line whatever degree was wanted."""
    assert Curve({0: 0.0, 2: 4.0}, interpolation="bspline", degree=3).at(0.5) == 1.0


@given(st.tuples(st.floats(0, 1), st.floats(0, 1)), st.floats(0, 1))
def test_a_bezier_clock_is_inverted(clock: tuple[float, float], x: float) -> None:
    """The parameter found is one at which just that much time has passed, for one as for many."""
    u = clocks.parameter(clock, x)
    assert abs(clocks.elapsed(clock, u) - x) <= 4e-15 or clock == clocks.EVEN
    a, b = np.array([clock[0]]), np.array([clock[1]])
    assert clocks.parameters((a, b), np.array([x]))[0] == u


def test_a_bezier_curve_goes_through_its_control_polygon() -> None:
    """Handles are offsets in time and value: the CSS ease-in-out is cubic-bezier(0.42, 0, 0.58, 1)."""
    curve = Curve({0: Key(0.0, right=(0.42, 0.0)), 1: Key(1.0, left=(-0.42, 0.0))}, interpolation="bezier")
    assert curve.at(0.5) == pytest.approx(0.5, abs=1e-15)
    assert curve.at(0.25) == pytest.approx(0.12916193, abs=1e-8)


def test_a_handle_longer_than_its_span_is_shortened() -> None:
    """So that time never runs backwards: only the handle's direction counts beyond the neighbour."""
    long = Curve({0: Key(0.0, right=(5.0, 5.0)), 1: 0.0}, interpolation="bezier")
    fitting = Curve({0: Key(0.0, right=(1.0, 1.0)), 1: 0.0}, interpolation="bezier")
    assert long.at(0.3) == fitting.at(0.3)


def test_an_ease_bends_the_time_of_its_span() -> None:
    """The curve's ease holds for every span, but for those whose first key has one of its own."""
    curve = Curve({0: 0.0, 1: Key(1.0, ease=lambda u: u**4), 2: 2.0}, ease="in_quad")
    assert [curve.at(0.5), curve.at(1.5)] == [0.25, 1.0625]
    assert curve.sample_many(np.array([0.5, 1.5])).tolist() == [0.25, 1.0625]


def test_colours_are_mixed_as_mix_does() -> None:
    """A linear curve of colours is the straight way in the blending space."""
    curve = Curve({0: "red", 2: "navy"})
    np.testing.assert_allclose(curve.at(0.5), mix(color("red"), color("navy"), 0.25), atol=1e-14)


QUATERNIONS = [Rotation(q) for q in np.random.default_rng(3).normal(size=(8, 4))]


def test_rotations_go_the_shortest_way_on_the_sphere() -> None:
    """Slerp, as SciPy's."""
    curve = _curve(QUATERNIONS)
    theirs = Slerp(TIMES, SciPyRotation.from_quat(np.array([q.as_quaternion()[[1, 2, 3, 0]] for q in QUATERNIONS])))
    for t in INSIDE:
        np.testing.assert_allclose(curve.at(t).as_matrix(), theirs(t).as_matrix(), atol=1e-12)


def _unit(q: Rotation) -> Any:
    return splines.quaternion.UnitQuaternion.from_unit_xyzw(q.as_quaternion()[[1, 2, 3, 0]])


@pytest.mark.parametrize("name", ["catmull_rom", "tcb"])
def test_smooth_curves_of_rotations(name: str) -> None:
    """De Casteljau's construction on the sphere, with tangents as angular velocities.

    Turns of less than a third of a circle, which leave no doubt about the shortest way.
    """
    turns = [Rotation.from_axis_angle((0.3 * k, 1.0, np.sin(k)), 12.0 * k) for k in range(8)]
    tcb = np.random.default_rng(5).uniform(-0.5, 0.5, size=(8, 3)) * (name == "tcb")
    tcb[[0, -1]] = 0.0
    keys = [Key(q, tension=t, continuity=c, bias=b) for q, (t, c, b) in zip(turns, tcb, strict=True)]
    curve = _curve(keys, interpolation=name)
    theirs = splines.quaternion.KochanekBartels([_unit(q) for q in turns], TIMES, tcb=tcb[1:-1])
    inner = [t for t in INSIDE if TIMES[1] < t < TIMES[-2]]  # the ends are another convention there
    for t, batched in zip(inner, curve.sample_many(np.array(inner)), strict=True):
        expected = Rotation(theirs.evaluate(t).wxyz).as_matrix()
        np.testing.assert_allclose(curve.at(t).as_matrix(), expected, atol=1e-12)
        np.testing.assert_allclose(batched.as_matrix(), expected, atol=1e-12)
