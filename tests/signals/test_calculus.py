"""Derivatives and integrals: against differences and sums, through edits, and where they hold."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive4d.engine import engine
from reactive4d.errors import ShapeError, TimeError
from reactive4d.signals.algebra import vec
from reactive4d.signals.calculus import derivative, integral
from reactive4d.signals.choices import where
from reactive4d.signals.curves import INTERPOLATIONS, Curve, Key
from reactive4d.signals.curves.areas import Area
from reactive4d.signals.curves.slopes import Slope
from reactive4d.signals.facade import Signal
from reactive4d.signals.functions import signal
from reactive4d.signals.keys import keys
from reactive4d.signals.numerical import Difference, Quadrature
from reactive4d.signals.sources import Parameter, Variable, time
from reactive4d.signals.warps import delay, hold, repeat, reverse, stretch, warp

INF = math.inf
H = 1e-5
ASKED = [-7.3, -2.9, -0.4, 0.31, 0.77, 1.9, 2.6, 3.4, 8.8]
SMOOTH = keys({0: 1.0, 1: 3.0, 2.5: 2.0, 4: 2.5}, interpolation="catmull_rom", before="linear", after="linear")
POSITIVE = 3 + np.sin(time)


def _slope(f: Callable[[float], Any], t: float) -> Any:
    return (8 * (f(t + H) - f(t - H)) - (f(t + 2 * H) - f(t - 2 * H))) / (12 * H)


@signal
def _opaque(t: float) -> float:
    return math.sin(3 * t) + t * t


KNOWN: dict[str, Signal[Any]] = {
    "time": time + 0,
    "sum": SMOOTH + np.sin(time) - 2,
    "product": SMOOTH * np.cos(2 * time),
    "quotient": SMOOTH / POSITIVE,
    "inverse": 1 / POSITIVE,
    "power": POSITIVE**3,
    "square": time**2,
    "root": POSITIVE**0.5,
    "power of signals": POSITIVE**SMOOTH,
    "exponential": 2.0 ** (time / 4),
    "negative": -SMOOTH,
    "absolute": abs(SMOOTH - 2.2),
    "modulo": SMOOTH % 0.7,
    "where": where(time < 1, SMOOTH, time * 2),
    "maximum": np.maximum(SMOOTH, POSITIVE),
    "minimum": np.minimum(SMOOTH, 2.0),
    "arctan2": np.arctan2(POSITIVE, SMOOTH + 9),
    "hypot": np.hypot(POSITIVE, SMOOTH),
    "delay": delay(SMOOTH, 0.7),
    "stretch": stretch(SMOOTH, 2.5, about=1),
    "reverse": reverse(SMOOTH, 0, 3),
    "repeat": repeat(SMOOTH, 1.63),
    "hold": hold(SMOOTH, 0.5, 3),
    "warp": warp(SMOOTH, np.sin(time) * 2),
    "live delay": delay(SMOOTH, np.sin(time) / 3),
    "bezier": keys({0: Key(1.0, right=(0.5, 2.0)), 3: Key(2.0, left=(-2.0, 1.0))}, interpolation="bezier"),
    "eased": keys({0: 1.0, 2: 4.0, 3: 0.0}, ease="in_out_sine"),
    "own ease": keys({0: 1.0, 2: 4.0, 3: 0.0}, ease=lambda u: u**3),
    "b-spline": keys({0: 1.0, 1: 3.0, 2.5: 2.0, 4: 2.5, 5: 0.0}, interpolation="bspline"),
    **{
        ufunc.__name__: ufunc(POSITIVE / 5)
        for ufunc in (
            *(np.sin, np.cos, np.tan, np.arcsin, np.arccos, np.arctan, np.sinh, np.cosh, np.tanh, np.arcsinh),
            *(np.arctanh, np.exp, np.exp2, np.expm1, np.log, np.log2, np.log10, np.log1p, np.sqrt, np.cbrt),
            *(np.square, np.reciprocal, np.radians, np.degrees, np.fabs),
        )
    },
    "arccosh": np.arccosh(POSITIVE),
}


def _is_numerical(x: Any) -> bool:
    todo, seen = [x], set[int]()
    while todo:
        x = todo.pop()
        if id(x) not in seen and isinstance(x, Signal):
            seen.add(id(x))
            if isinstance(x, Difference | Quadrature):
                return True
            todo += list(getattr(x, "operands", ()))
    return False


@pytest.mark.parametrize("name", KNOWN)
def test_derivatives_by_rule(name: str) -> None:
    """They are worked out, not measured, and agree with what is measured."""
    x = KNOWN[name]
    slope = derivative(x)
    assert not _is_numerical(slope)
    for t in ASKED:
        assert slope.at(t) == pytest.approx(_slope(x.at, t), abs=2e-8, rel=2e-8), t
    np.testing.assert_allclose(slope.at(np.array(ASKED)), [slope.at(t) for t in ASKED], rtol=1e-12, atol=1e-12)


def test_derivatives_of_vectors() -> None:
    """Componentwise, through arithmetic, components and products."""
    path = keys({0: (0.0, 0.0, 1.0), 1: (1.0, 2.0, 1.0), 3: (0.0, 0.0, 0.0)}, interpolation="tcb")
    x = 2 * path + vec(time, np.sin(time), 1) * path[1] + (1.0, 2.0, 3.0)
    turned = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]) @ path
    for y in (x, turned, x[:2], x / (2 + x[0] ** 2)):
        slope = derivative(y)
        assert not _is_numerical(slope)
        for t in (0.4, 1.6, 2.2):
            np.testing.assert_allclose(slope.at(t), _slope(y.at, t), atol=1e-8)


def test_the_derivative_of_linear_keys_holds() -> None:
    """From key to key; outside of held keys it is zero."""
    k = keys({0: 0.0, 2: 4.0, 3: 4.0, 4: 0.0})
    velocity = derivative(k)
    assert (velocity.at(1.0), velocity.valid(1.0).start, velocity.valid(1.0).stop) == (2.0, 0, 2)
    assert (velocity.at(9.0), velocity.valid(9.0).stop) == (0.0, INF)
    assert velocity.at(2.5) == 0.0
    assert velocity.at(3.0) == -4.0
    np.testing.assert_array_equal(
        velocity.at(np.array([-1.0, 0.0, 1.0, 2.5, 3.0, 4.0])), [0.0, 2.0, 2.0, 0.0, -4.0, 0.0]
    )


def test_derivatives_of_higher_order() -> None:
    """Acceleration is exact for polynomial spans; where an ease bends them it is a difference."""
    k = keys({0: 0.0, 1: 5.0, 3: 2.0, 4: 2.0}, interpolation="catmull_rom")
    velocity, acceleration = derivative(k), derivative(derivative(k))
    eased = keys({0: 0.0, 2: 4.0}, ease="in_out")
    for t in (0.3, 1.2, 2.9):
        assert acceleration.at(t) == pytest.approx(_slope(velocity.at, t), abs=1e-7)
    assert derivative(acceleration).at(0.3) == pytest.approx(_slope(acceleration.at, 0.3), abs=1e-6)
    assert derivative(derivative(eased)).at(0.5) == pytest.approx(3.0, abs=1e-5)
    assert derivative(derivative(k)).at(9.0) == 0.0


@pytest.mark.parametrize("mode", ["hold", "linear", "cycle", "cycle_offset", "oscillate"])
@pytest.mark.parametrize("interpolation", [name for name, rule in INTERPOLATIONS.items() if "number" in rule.kinds])
def test_curves_are_differentiated_and_integrated_everywhere(interpolation: str, mode: str) -> None:
    """The slope of the area is the curve, and the slope is the curve's; outside of the keys as well."""
    told: dict[str, Any] = {"left": (-0.4, 0.3), "right": (0.9, -0.8)} if interpolation in ("hermite", "bezier") else {}
    told |= {"tension": 0.3, "continuity": -0.2} if interpolation == "tcb" else {}
    values = {0.0: 1.0, 1.0: 3.0, 2.5: 2.5, 3.0: -1.0, 4.0: -1.0}
    curve = Curve({t: Key(v, **told) for t, v in values.items()}, interpolation=interpolation, before=mode, after=mode)
    slope, area = Slope(curve), Area(curve, 0.3)
    assert area.sample(0.3)[2] == 0.0
    times = [t for t in np.linspace(-9.03, 12.07, 83).tolist() if min(abs(t % 4 - k) for k in (0, 1, 2.5, 3, 4)) > 1e-3]
    for t in times:
        assert slope.sample(t)[2] == pytest.approx(_slope(curve.at, t), abs=1e-8), t
        assert _slope(lambda x: area.sample(x)[2], t) == pytest.approx(curve.at(t), abs=1e-8), t
        for lo, hi, _ in (slope.sample(t), area.sample(t)):
            assert lo <= t < hi
    np.testing.assert_allclose(slope.sample_many(np.array(times)), [slope.sample(t)[2] for t in times], atol=1e-12)


@given(
    st.lists(st.floats(-9, 13), min_size=1, max_size=5),
    st.sampled_from(["step", "linear", "catmull_rom"]),
    st.sampled_from(["hold", "cycle", "oscillate"]),
)
def test_slopes_and_areas_hold_where_they_say(times: list[float], interpolation: str, mode: str) -> None:
    """Every time of the span that is claimed has that very answer."""
    points = {0.0: 0.0, 1.0: 0.0, 2.5: 0.0, 3.0: 1.0, 4.0: 1.0}
    curve = Curve(points, interpolation=interpolation, before=mode, after=mode)
    for made in (Slope(curve), Area(curve, 2.0)):
        for t in times:
            lo, hi, value = made.sample(t)
            assert lo <= t < hi
            low, high = max(lo, -99.0), min(hi, 99.0)
            for x in (low, t, low + 0.3 * (high - low), math.nextafter(high, -INF)):
                assert made.sample(x)[2] == value, x


INTEGRABLE: dict[str, Signal[Any]] = {
    "constant": Variable(2.0) + 0,
    "time": time + 0,
    "polynomial": (time - 1) ** 3 * 2 - time / 4 + 1,
    "keys": SMOOTH,
    "sum": SMOOTH + 2 * np.sin(3 * time) - np.exp(time / 9) / 2,
    "hyperbolic": np.cosh(time / 3) + np.sinh(1 - time / 3) - np.cos(2 * time + 1),
    "delay": delay(SMOOTH, 0.7),
    "stretch": stretch(SMOOTH, -2.5, about=1),
    "eased": keys({0: 1.0, 2: 4.0, 3: 0.0}, ease="in_out_sine"),
    "parameter": Parameter("calculus_factor", 1.5) * SMOOTH,
}


@pytest.mark.parametrize("name", INTEGRABLE)
@pytest.mark.parametrize("start", [0.0, -1.5])
def test_integrals_by_rule(name: str, start: float) -> None:
    """They are worked out; their slope is the signal, and they are zero at their start."""
    x = INTEGRABLE[name]
    area = integral(x, start)
    assert not _is_numerical(area)
    assert area.at(start) == pytest.approx(0.0, abs=1e-14)
    for t in ASKED:
        assert _slope(area.at, t) == pytest.approx(x.at(t), abs=1e-7), t
    np.testing.assert_allclose(area.at(np.array(ASKED)), [area.at(t) for t in ASKED], rtol=1e-12, atol=1e-12)


def test_integrals_of_vectors() -> None:
    """Componentwise."""
    path = keys({0: (0.0, 0.0, 1.0), 1: (1.0, 2.0, 1.0)})
    area = integral(path * 2 + vec(time, 1, 0))
    assert area.at(1.0).tolist() == [1.5, 3.0, 2.0]
    assert integral(path[1]).at(1.0) == 1.0
    assert integral(path)[1].at(3.0) == 5.0


def test_the_derivative_of_an_integral_is_the_signal() -> None:
    """The very same one, whether it is worked out or measured."""
    assert derivative(integral(SMOOTH)) is SMOOTH
    assert derivative(integral(_opaque)) is _opaque


def test_what_is_not_known_is_measured() -> None:
    """Python functions, and keys whose values are signals."""
    slope, area = derivative(_opaque), integral(_opaque)
    assert _is_numerical(slope)
    assert _is_numerical(area)
    for t in ASKED:
        assert slope.at(t) == pytest.approx(3 * math.cos(3 * t) + 2 * t, abs=1e-10)
        assert area.at(t) == pytest.approx((1 - math.cos(3 * t)) / 3 + t**3 / 3, abs=1e-9)
    alive = keys({0: time * 2, 4: Variable(1.0)})
    assert derivative(alive).at(1.0) == pytest.approx(_slope(alive.at, 1.0), abs=1e-9)
    assert integral(alive).at(4.0) == pytest.approx(2 * 4**2 / 2 - 2 * 4**2 / 3 + 2.0, abs=1e-9)


def test_a_jump_is_integrated() -> None:
    """Adaptively."""
    steps = where(_opaque.map(lambda x: x > 1), 1.0, 0.0)
    edge = next(t for t in np.linspace(0, 1, 100001) if _opaque.at(float(t)) > 1)
    assert integral(steps).at(0.5) == pytest.approx(0.5 - edge, abs=1e-5)


def test_the_derivative_of_what_holds_holds() -> None:
    """Measured, but only at the edges of what is held."""
    held = keys({0: 1.0, 5: 2.0}, interpolation="step").map(lambda x: x * x)
    slope = derivative(held)
    assert slope.at(2.0) == 0.0
    assert slope.valid(2.0).start < 0.1
    assert slope.valid(2.0).stop > 4.9


def test_edits_reach_derivatives_where_they_touch() -> None:
    """
    An edit of a key changes the velocity of its neighbourhood, and only that is computed again.

        keys --> velocity --> doubled
    """
    k = keys({0: 0.0, 1: 1.0, 2: 0.0, 3: 1.0, 4: 0.0})
    calls: list[float] = []
    doubled = derivative(k).map(lambda v: calls.append(v) or 2 * v)
    assert [doubled.at(t) for t in (0.5, 1.5, 2.5, 3.5)] == [2.0, -2.0, 2.0, -2.0]
    calls.clear()
    k.points[3] = 5.0
    assert [doubled.at(t) for t in (0.5, 1.5, 2.5, 3.5)] == [2.0, -2.0, 10.0, -10.0]
    assert calls == [5.0, -5.0]


def test_edits_reach_integrals_from_then_on() -> None:
    """Before the edited span an integral from the beginning is what it was."""
    k = keys({0: 0.0, 1: 1.0, 2: 0.0, 3: 1.0, 4: 0.0})
    calls: list[float] = []
    seen = integral(k).map(lambda v: calls.append(v) or v)
    assert [seen.at(t) for t in (1.0, 3.0, 9.0)] == [0.5, 1.5, 2.0]
    calls.clear()
    k.points[3] = 3.0
    assert [seen.at(t) for t in (1.0, 3.0, 9.0)] == [0.5, 2.5, 4.0]
    assert calls == [2.5, 4.0]
    k.points[3] = time * 0 + 1
    assert seen.at(9.0) == pytest.approx(2.0, abs=1e-9)
    k.points[3] = 1.0
    assert seen.at(9.0) == 2.0


def test_calculus_follows_what_a_variable_is_set_to() -> None:
    """A constant, then a signal, then another one."""
    v = Variable(2.0)
    slope, area = derivative(v), integral(v)
    assert (slope.at(1.0), area.at(3.0)) == (0.0, 6.0)
    v.value = np.sin(time)
    assert (slope.at(0.0), area.at(math.pi)) == (1.0, 2.0)
    v.value = keys({0: 0.0, 1: 4.0})
    assert (slope.at(0.5), area.at(1.0)) == (4.0, 2.0)
    v.value.points[1] = 8.0
    assert (slope.at(0.5), area.at(1.0)) == (8.0, 4.0)
    v.value = 1.0
    assert (slope.at(0.5), area.at(1.0)) == (0.0, 1.0)


def test_deep_trees_need_no_stack() -> None:
    """A sum of ten thousand."""
    x: Signal[Any] = time
    for _ in range(10_000):
        x = x + 1.0
    assert derivative(x).at(0.0) == 1.0
    assert integral(x).at(2.0) == pytest.approx(2.0 + 20_000.0)


def test_shared_parts_are_worked_out_once() -> None:
    """Twenty squares of one another would be a million leaves."""
    x = np.sin(time)
    for _ in range(20):
        x = x * x + 0.1
    assert math.isfinite(derivative(x).at(0.3))


def test_what_cannot_be_differentiated_says_so() -> None:
    """At once where it is known, else when it is asked."""
    with pytest.raises(ShapeError, match="'color' have no derivative"):
        derivative(keys({0: "red"}))
    with pytest.raises(ShapeError, match="'held' have no integral"):
        integral(keys({0: "some", 1: "words"}))
    with pytest.raises(ShapeError, match="expected numbers, got 'x'"):
        derivative(time.map(lambda t: "x")).at(0.0)
    with pytest.raises(TimeError, match="finite start"):
        integral(time, math.inf)
    with pytest.raises(TimeError, match="a million seconds"):
        integral(_opaque).at(1e9)


@given(
    st.sampled_from(["step", "linear", "catmull_rom", "bspline"]),
    st.sampled_from(["hold", "linear", "cycle", "cycle_offset", "oscillate"]),
    st.lists(st.tuples(st.integers(0, 8), st.sampled_from([0.0, 1.0, -2.0])), max_size=6),
    st.lists(st.floats(-4, 12), min_size=1, max_size=5),
    st.sampled_from([-1.0, 0.0, 3.3]),
)
def test_remembered_integrals_are_those_that_would_be_computed(
    interpolation: str, outside: Any, edits: list[tuple[int, float]], times: list[float], start: float
) -> None:
    """
    Through any edits, to the last bit.

        keys --> area, velocity
    """
    k = keys({0: 0.0, 2: 1.0, 5: 1.0}, interpolation=interpolation, before=outside, after=outside)
    derived = [integral(k, start) * 2, derivative(k) * 2]
    for edit in [None, *edits]:
        if edit is not None and edit[0] in k.points and len(k.points) > 1 and edit[1] == 0.0:
            del k.points[edit[0]]
        elif edit is not None:
            k.points[edit[0]] = edit[1]
        for x in derived:
            for t in [*times, 0.0, 2.5, 7.0]:
                found = x.at(t)
                assert found == engine.naive(x, t)
                span = x.valid(t)
                for u in (span.start, math.nextafter(span.stop, -INF), (max(span.start, -9) + min(span.stop, 20)) / 2):
                    if span.start <= u < span.stop and abs(u) < INF:
                        assert engine.naive(x, u) == found, (t, u)
    engine.check(derived)


def test_slopes_hold_up_to_where_a_cycle_turns_over_a_key() -> None:
    """The float before a mirrored key folds onto the key itself, and has the slope of what comes next."""
    slope = Slope(Curve({0.0: 1.0, 1.0: 1.0, 4.0: 2.0}, before="oscillate"))
    _, hi, value = slope.sample(-2.0)
    assert value == pytest.approx(-1 / 3)
    assert slope.sample(math.nextafter(hi, -INF))[2] == value
