"""Easings: ends, families, agreement of their three forms."""

import copy
import math
import pickle
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from reactive4d.errors import ShapeError, UnknownNameError
from reactive4d.signals import easings
from reactive4d.signals.easings import EASINGS, Easing, easing

FAMILIES = sorted({name.removeprefix("in_out") for name in EASINGS if name.startswith("in_out")})
SWINGING = ("back", "elastic")  # go beyond 0 and 1 on their way
VERTICAL = {"in_circ": [1], "out_circ": [0], "in_out_circ": [0.5]}
shares = st.floats(0, 1)
grid = np.linspace(0, 1, 4001)


def css_bezier(x1: float, y1: float, x2: float, y2: float) -> np.ndarray[Any, Any]:
    """The timing function of CSS with these handles, on the grid."""
    s = np.linspace(0, 1, 20001)
    x, y = (3 * (1 - s) ** 2 * s * a + 3 * (1 - s) * s**2 * b + s**3 for a, b in ((x1, x2), (y1, y2)))
    return np.interp(grid, x, y)


def test_the_names_are_those_of_the_type() -> None:
    """What a type checker accepts is what is there, and nothing else."""
    assert set(EASINGS) == set(easings._NAMED)
    assert len(EASINGS) == 34


@pytest.mark.parametrize("name", EASINGS)
def test_ends_are_exact_and_stay(name: str) -> None:
    """0 to 0 and 1 to 1, in both forms; before and after nothing moves, at infinity either."""
    ease = easing(name)
    us = [-math.inf, -1.0, -0.0, 0.0, 1.0, 1.5, math.inf]
    assert [ease(u) for u in us] == [0, 0, 0, 0, 1, 1, 1]
    assert ease(np.array(us)).tolist() == [0, 0, 0, 0, 1, 1, 1]
    assert ease.slope is not None
    assert ease.slope(-0.5) == ease.slope(1.5) == 0


@pytest.mark.parametrize("name", EASINGS)
@given(u=shares)
def test_the_form_for_floats_and_the_form_for_arrays_agree(name: str, u: float) -> None:
    """To 1e-12, whatever the shape of the array."""
    ease = easing(name)
    assert isinstance(ease(u), float)
    assert ease(np.array([[u], [0.5]])) == pytest.approx(np.array([[ease(u)], [ease(0.5)]]), abs=1e-12)
    assert ease(np.array(u)).shape == ()
    assert type(ease(np.float64(u))) is float
    assert ease(np.array([0, 0.5, 1], dtype=np.float32)).dtype == np.float64
    assert ease(np.array([0, 1, 2])).tolist() == [0, 1, 1]


@pytest.mark.parametrize("name", EASINGS)
def test_there_is_no_jump(name: str) -> None:
    """Not even at the ends: a step of 1/4000 never moves by more than the steepest part of a circle does."""
    assert np.abs(np.diff(easing(name)(grid))).max() <= math.sqrt(2 / 4000)
    assert easing(name)(1e-9) == pytest.approx(0, abs=1e-4)
    assert easing(name)(1 - 1e-9) == pytest.approx(1, abs=1e-4)


@pytest.mark.parametrize("family", FAMILIES)
@given(u=shares)
def test_out_is_in_played_backwards_and_in_out_is_both_at_half_their_size(family: str, u: float) -> None:
    """The rule of the families, and the symmetry that follows."""
    into, out, both = (easing(f"{prefix}{family}") for prefix in ("in", "out", "in_out"))
    assert out(u) == pytest.approx(1 - into(1 - u), abs=1e-12)
    assert both(u / 2) == pytest.approx(into(u) / 2, abs=1e-12)
    assert both(0.5 + u / 2) == pytest.approx(0.5 + out(u) / 2, abs=1e-7)
    assert both(u) + both(1 - u) == pytest.approx(1, abs=1e-12)


@pytest.mark.parametrize("name", EASINGS)
@given(u=st.floats(0.001, 0.999))
def test_the_slope_is_the_derivative(name: str, u: float) -> None:
    """By central differences; not where a bounce has its corners and a circle is vertical."""
    ease = easing(name)
    h = 1e-6
    avoid = corners(name) if "bounce" in name else VERTICAL.get(name, [])
    assume(all(abs(u - c) > 0.01 for c in avoid))
    assert ease.slope is not None
    assert ease.slope(u) == pytest.approx((ease(u + h) - ease(u - h)) / (2 * h), abs=1e-3, rel=1e-4)


def corners(name: str) -> list[float]:
    """Where a bounce touches the ground."""
    out = [1 / 2.75, 2 / 2.75, 2.5 / 2.75]
    into = [1 - c for c in out]
    return {"in": into, "out": out}.get(
        name.removesuffix("_bounce"), [c / 2 for c in into] + [0.5 + c / 2 for c in out] + [0.5]
    )


def test_a_circle_is_vertical_at_its_end() -> None:
    """Its slope there is infinite, and no division by zero."""
    for name, (u,) in VERTICAL.items():
        assert easing(name).slope(u) == math.inf  # type: ignore[misc]


@pytest.mark.parametrize("name", [n for n in EASINGS if not n.endswith((*SWINGING, "bounce"))])
def test_most_easings_only_ever_advance(name: str) -> None:
    """Monotone, and so within 0 and 1."""
    assert (np.diff(easing(name)(grid)) >= 0).all()


def test_back_goes_a_tenth_too_far_and_elastic_swings() -> None:
    """What these two are for; a bounce never goes beyond."""
    assert easing("in_back")(grid).min() == pytest.approx(-0.1, abs=1e-5)
    assert easing("out_back")(grid).max() == pytest.approx(1.1, abs=1e-5)
    assert easing("out_elastic")(grid).max() > 1.3
    bounce = easing("out_bounce")(grid)
    assert bounce.min() >= 0
    assert bounce.max() <= 1
    assert sum(easing("out_bounce")(c) == pytest.approx(1) for c in corners("out_bounce")) == 3


def test_the_plain_names_are_halves_of_the_smooth_cubic() -> None:
    """in_out is 3u² - 2u³; in leaves with the slope 3/2 and no curvature."""
    assert easing("in_out")(grid) == pytest.approx(3 * grid**2 - 2 * grid**3, abs=1e-12)
    assert easing("in").slope is not None
    assert [easing("in").slope(u) for u in (0, 1)] == [0, 1.5]  # type: ignore[misc]
    assert easing("in").slope(1 - 1e-6) == pytest.approx(1.5, abs=1e-11)  # type: ignore[misc]


@pytest.mark.parametrize(
    ("name", "handles"),
    [("in", (0.42, 0, 1, 1)), ("out", (0, 0, 0.58, 1)), ("in_out", (0.42, 0, 0.58, 1))],
)
def test_the_plain_names_look_like_those_of_css(name: str, handles: tuple[float, float, float, float]) -> None:
    """Nobody who knows ease-in, ease-out and ease-in-out sees a difference."""
    assert np.abs(easing(name)(grid) - css_bezier(*handles)).max() < 0.03


@pytest.mark.parametrize(
    ("name", "u", "value"),
    [
        ("in_sine", 0.5, 1 - math.sqrt(0.5)),
        ("in_quad", 0.3, 0.09),
        ("in_out_cubic", 0.25, 0.0625),
        ("out_quart", 0.5, 0.9375),
        ("in_quint", 0.5, 0.03125),
        ("in_expo", 0.5, 31 / 1023),
        ("in_circ", 0.6, 0.2),
        ("in_back", 0.5, -0.0876975),
        ("in_elastic", 0.7, 127 / 1023),
        ("out_bounce", 0.5, 0.765625),
        ("out_bounce", 1.5 / 2.75, 0.75),
    ],
)
def test_known_values(name: str, u: float, value: float) -> None:
    """Worked out by hand from the formulas of Penner."""
    assert easing(name)(u) == pytest.approx(value, abs=1e-12)


def test_nan_stays_nan() -> None:
    """A NaN that gets this far stays visible."""
    for name in EASINGS:
        assert math.isnan(easing(name)(math.nan))
        assert math.isnan(easing(name)(np.array([math.nan]))[0])
        assert math.isnan(easing(name).slope(math.nan))  # type: ignore[misc]


def test_a_name_is_resolved_to_one_value() -> None:
    """The same name is the same object, also after a copy, and an easing is its own easing."""
    ease = easing("in_out_back")
    assert easing("in_out_back") is ease
    assert easing(ease) is ease
    assert copy.deepcopy(ease) is ease
    assert pickle.loads(pickle.dumps(ease)) is ease
    assert repr(ease) == "easing('in_out_back')"
    assert len({easing(name) for name in EASINGS}) == len(EASINGS)


def square(u: float) -> float:
    """A user's easing."""
    return u * u


def test_a_function_becomes_an_easing() -> None:
    """Called with floats, one by one, strictly between 0 and 1; the ends are ours."""
    seen: list[float] = []

    def wrong_at_the_ends(u: float) -> float:
        seen.append(u)
        return 0.25 + u / 2

    ease = easing(wrong_at_the_ends)
    assert isinstance(ease, Easing)
    assert [ease(u) for u in (-1, 0, 0.5, 1, 2)] == [0, 0, 0.5, 1, 1]
    assert ease(np.array([[0.0, 0.5, 1.0]])).tolist() == [[0, 0.5, 1]]
    assert seen == [0.5, 0.5]
    assert all(type(u) is float for u in seen)
    assert math.isnan(ease(math.nan))
    assert ease.slope is None
    assert easing(square) == easing(square) != easing(wrong_at_the_ends)
    assert repr(easing(square)) == "easing(square)"
    assert pickle.loads(pickle.dumps(easing(square))) == easing(square)
    assert easing(lambda u: np.float32(u))(0.5) == 0.5


def test_an_unknown_name_is_refused_with_the_nearest_one() -> None:
    """The note says what may have been meant."""
    with pytest.raises(UnknownNameError, match="unknown easing 'in_outt'") as caught:
        easing("in_outt")
    assert caught.value.__notes__ == ["hint: did you mean 'in_out'?"]


@pytest.mark.parametrize("bad", [None, 3, 0.5, ("in",), math.nan])
def test_what_is_neither_name_nor_function_is_refused(bad: Any) -> None:
    """At once, and not when it is first used."""
    with pytest.raises(ShapeError, match="expected the name of an easing or a function"):
        easing(bad)


@pytest.mark.parametrize("answer", [math.nan, math.inf, "0.5", None, 1j, [0.5], 10**400])
def test_a_function_that_answers_no_number_is_named(answer: Any) -> None:
    """The message says which function, what it answered, and for what."""
    with pytest.raises(ShapeError, match=r"easing .*answered .* for 0\.5, expected a finite number"):
        easing(lambda u: answer)(0.5)
