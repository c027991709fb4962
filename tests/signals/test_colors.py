"""Colours: what may be written, what it means, and what lies between two of them."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive4d.errors import ShapeError, UnknownNameError
from reactive4d.signals.colors import (
    COLOR_NAMES,
    blended_to_srgb,
    color,
    is_color_name,
    linear_to_srgb,
    mix,
    oklab_to_srgb,
    srgb_to_blended,
    srgb_to_linear,
    srgb_to_oklab,
)

parts = st.floats(0, 1)
opaque = st.tuples(parts, parts, parts).map(color)
colors = st.tuples(parts, parts, parts, parts).map(color) | st.sampled_from(sorted(COLOR_NAMES)).map(color)
bytes_ = st.integers(0, 255)
grid = np.linspace(0, 1, 65)


def hue_in_ipt(srgb: Any) -> Any:
    """The hue, degrees, in a space that was fitted to judgements of hue (Ebner and Fairchild 1998)."""
    xyz = srgb_to_linear(srgb) @ np.array(
        [[0.4124564, 0.2126729, 0.0193339], [0.3575761, 0.7151522, 0.1191920], [0.1804375, 0.0721750, 0.9503041]]
    )
    cones = xyz @ np.array([[0.4002, -0.2280, 0.0], [0.7075, 1.1500, 0.0], [-0.0807, 0.0612, 0.9184]])
    ipt = (
        np.sign(cones)
        * np.abs(cones) ** 0.43
        @ np.array([[0.4000, 4.4550, 0.8056], [0.4000, -4.8510, 0.3572], [0.2000, 0.3960, -1.1628]])
    )
    return np.degrees(np.unwrap(np.arctan2(ipt[..., 2], ipt[..., 1])))


def test_all_names_of_css_are_known() -> None:
    """148 and "transparent", in letters of either case; where X11 differs, CSS holds."""
    assert len(COLOR_NAMES) == 149
    assert all(is_color_name(name) and color(name).shape == (4,) for name in COLOR_NAMES)
    assert (color("RebeccaPurple") == color("#663399")).all()
    assert color("transparent").tolist() == [0, 0, 0, 0]
    assert all((color(name) == color(name.replace("gray", "grey"))).all() for name in COLOR_NAMES)
    assert [COLOR_NAMES[name] for name in ("gray", "green", "maroon", "purple")] == [
        "#808080",
        "#008000",
        "#800000",
        "#800080",
    ]
    # Drafts of CSS had these two wrong, and lists copied from them still have.
    assert (COLOR_NAMES["mediumpurple"], COLOR_NAMES["palevioletred"]) == ("#9370db", "#db7093")


@given(bytes_, bytes_, bytes_, bytes_)
def test_codes_are_read_as_in_css(r: int, g: int, b: int, alpha: int) -> None:
    """Bytes over 255; a short code doubles its digits; letters of either case."""
    assert color(f"#{r:02x}{g:02X}{b:02x}{alpha:02x}").tolist() == [r / 255, g / 255, b / 255, alpha / 255]
    assert color(f"#{r:02x}{g:02x}{b:02x}").tolist() == [r / 255, g / 255, b / 255, 1]
    short = f"#{r % 16:x}{g % 16:x}{b % 16:X}"
    assert color(short).tolist() == [r % 16 / 15, g % 16 / 15, b % 16 / 15, 1]
    assert color(f"{short}{alpha % 16:x}")[3] == alpha % 16 / 15


@given(parts, parts, parts, parts)
def test_numbers_are_taken_as_they_are(r: float, g: float, b: float, alpha: float) -> None:
    """Three or four, as tuple, list or array; without alpha a colour is opaque."""
    assert color((r, g, b)).tolist() == [r, g, b, 1]
    assert color([r, g, b, alpha]).tolist() == color(np.array([r, g, b, alpha])).tolist() == [r, g, b, alpha]
    assert color(color((r, g, b, alpha))).tolist() == [r, g, b, alpha]
    assert color((1, 0, 0)).dtype == np.float64


def test_a_colour_is_frozen_and_its_own() -> None:
    """Neither the answer nor the array that was given can change it."""
    source = np.array([0.5, 0.5, 0.5, 1.0])
    made = color(source)
    source[:] = 0
    assert made.tolist() == [0.5, 0.5, 0.5, 1]
    with pytest.raises(ValueError, match="read-only"):
        made[0] = 1
    assert math.copysign(1, color((-0.0, 0, 0))[0]) == 1


@pytest.mark.parametrize(
    "text", ["golden", "", " red", "red ", "#", "#ff", "#fffff", "#fffffff", "#ggg", "fff", "#١٢٣", "#fff\n"]
)
def test_other_text_names_no_colour(text: str) -> None:
    """The question and the reading agree."""
    assert not is_color_name(text)
    with pytest.raises((UnknownNameError, ShapeError)):
        color(text)


def test_an_unknown_name_is_refused_with_the_nearest_one() -> None:
    """The note says what may have been meant."""
    with pytest.raises(UnknownNameError, match="unknown colour 'crimsom'") as caught:
        color("crimsom")
    assert caught.value.__notes__ == ["hint: did you mean 'crimson'?"]


@pytest.mark.parametrize(
    "bad",
    [None, 5, (1, 0), (1, 0, 0, 1, 0), [[1, 0, 0]], ("red", 0, 0), b"red", (True, False, True), [[1], [1, 2]], 1j],
)
def test_what_is_no_colour_is_refused(bad: Any) -> None:
    """Other shapes and other types."""
    with pytest.raises(ShapeError, match="expected a colour"):
        color(bad)


@pytest.mark.parametrize(
    "bad", [(255, 0, 0), (1.0001, 0, 0), (-0.1, 0, 0), (0, 0, 0, 2), (math.nan, 0, 0), (0, math.inf, 0)]
)
def test_parts_beyond_0_and_1_are_refused(bad: Any) -> None:
    """Bytes most of all, with a hint; NaN too."""
    with pytest.raises(ShapeError, match="between 0 and 1") as caught:
        color(bad)
    assert hasattr(caught.value, "__notes__") == (max(bad) > 1 and math.isfinite(sum(bad)))


@given(st.lists(st.floats(-2, 2), min_size=1, max_size=9))
def test_light_and_back_is_the_same(values: list[float]) -> None:
    """Both curves are one another's inverse, rise, and are odd."""
    x = np.array(values)
    assert linear_to_srgb(srgb_to_linear(x)) == pytest.approx(x, abs=1e-12)
    assert srgb_to_linear(linear_to_srgb(x)) == pytest.approx(x, abs=1e-12)
    assert (srgb_to_linear(-x) == -srgb_to_linear(x)).all()
    assert (np.diff(srgb_to_linear(np.sort(x))) >= 0).all()


@given(st.tuples(parts, parts, parts))
def test_oklab_and_back_is_the_same(rgb: tuple[float, float, float]) -> None:
    """In any leading shape."""
    x = np.array([[rgb, (0.0, 0.5, 1.0)]])
    assert oklab_to_srgb(srgb_to_oklab(x)) == pytest.approx(x, abs=1e-12)


@pytest.mark.parametrize(
    ("name", "lab"),
    [
        ("white", (1, 0, 0)),
        ("black", (0, 0, 0)),
        ("red", (0.62796, 0.22486, 0.12585)),
        ("lime", (0.86644, -0.23389, 0.17950)),
        ("blue", (0.45201, -0.03246, -0.31153)),
    ],
)
def test_known_colours_lie_where_they_should(name: str, lab: tuple[float, float, float]) -> None:
    """The corners of sRGB in OKLab, as CSS Color 4 gives them."""
    assert srgb_to_oklab(color(name)[:3]) == pytest.approx(lab, abs=5e-6)


@given(parts, parts, parts)
def test_greys_stay_grey(a: float, b: float, u: float) -> None:
    """They have no a and no b, and mixtures of them neither."""
    assert srgb_to_oklab(np.full(3, a))[1:] == pytest.approx((0, 0), abs=1e-15)
    between = mix(color((a, a, a)), color((b, b, b)), u)
    assert between[:3] == pytest.approx(np.full(3, between[0]), abs=1e-12)


@given(colors, colors, st.floats(-1, 2))
def test_ends_are_exact_and_what_is_equal_stays(a: Any, b: Any, u: float) -> None:
    """To the last bit, alone and among many."""
    assert (mix(a, b, 0.0) == a).all()
    assert (mix(a, b, 1.0) == b).all()
    assert (mix(a, a, u) == a).all()
    assert (mix(a, b, np.array([0.0, 1.0])) == [a, b]).all()
    assert (mix(a, a, np.array([u])) == a).all()


@given(colors, colors, parts)
def test_the_way_back_is_the_same_way(a: Any, b: Any, u: float) -> None:
    """Mixing is symmetric, and its ends are continuous in what can be seen of them."""
    seen = mix(a, b, u)
    assert seen[3] == pytest.approx(a[3] + (b[3] - a[3]) * u, abs=1e-12)
    assert mix(b, a, 1 - u) * seen[3] == pytest.approx(seen * seen[3], abs=1e-6)
    near = mix(a, b, 1e-9)
    assert near * near[3] == pytest.approx(a * a[3], abs=1e-3)


@given(st.lists(st.tuples(colors, colors, st.floats(-1, 2) | st.sampled_from([0.0, 1.0])), min_size=1))
def test_many_at_once_are_as_one_by_one(ways: list[tuple[Any, Any, float]]) -> None:
    """To 1e-12, in any broadcast shape, and never beyond 0 and 1."""
    a, b = (np.array([way[k] for way in ways]) for k in (0, 1))
    u = np.array([way[2] for way in ways])
    together = mix(a, b, u)
    assert together == pytest.approx(np.array([mix(*way) for way in ways]), abs=1e-12)
    assert ((together >= 0) & (together <= 1)).all()
    crossed = mix(a[:, None], b, u)
    assert crossed.shape == (len(ways), len(ways), 4)
    assert pytest.approx(together, abs=1e-12) == np.diagonal(crossed).T


@given(colors)
def test_the_space_of_blending_has_a_way_back(a: Any) -> None:
    """All that can be seen comes back; what cannot is transparent black; one by one as many at once."""
    back = blended_to_srgb(srgb_to_blended(a))
    assert back == pytest.approx(a if a[3] > 1e-9 else np.zeros(4), abs=1e-9)
    assert blended_to_srgb(srgb_to_blended(a[None])) == pytest.approx(back[None], abs=1e-12)


@given(opaque, opaque, opaque)
def test_sums_in_the_space_of_blending_are_mixtures(a: Any, b: Any, c: Any) -> None:
    """Mixing step by step is one sum, as long as nothing had to be clipped."""
    points = [srgb_to_blended(x) for x in (a, b, c)]
    assert blended_to_srgb(points[0] * 0.75 + points[1] * 0.25) == pytest.approx(mix(a, b, 0.25), abs=1e-12)
    assert blended_to_srgb(sum(points) / 3)[3] == pytest.approx(1)


def test_what_cannot_be_seen_does_not_tint() -> None:
    """
    Red fades to transparent as red, though transparent is written as black; and to transparent white likewise.

        red --> (1, 0, 0, 1/2) --> transparent
    """
    for hidden in ("transparent", "#fff0", "#0f00"):
        assert mix(color("red"), color(hidden), 0.5) == pytest.approx([1, 0, 0, 0.5], abs=1e-6)
        assert mix(color("red"), color(hidden), np.array([0.5])) == pytest.approx(np.array([[1, 0, 0, 0.5]]), abs=1e-6)
    assert mix(color("#f000"), color("#0f00"), 0.5).tolist() == [0, 0, 0, 0]
    # The one that is seen more has more to say.
    weighted = mix(color("#ff0000ff"), color("#0000ff40"), 0.5)
    assert weighted[0] > mix(color("red"), color("blue"), 0.5)[0]


def test_a_tint_keeps_its_hue_where_srgb_does_not() -> None:
    """From white to blue, by an independent measure of hue: 2 degrees in OKLab, 21 in sRGB."""
    way = mix(color("white"), color("blue"), grid[8:])
    drift = np.ptp(hue_in_ipt(way[:, :3]))
    plain = np.ptp(hue_in_ipt(color("white")[:3] + grid[8:, None] * (color("blue") - color("white"))[:3]))
    assert drift < 4
    assert plain > 15


def test_opposite_colours_do_not_meet_in_grey() -> None:
    """Halfway from blue to yellow sRGB has #808080; here some colour is left."""
    middle = mix(color("blue"), color("yellow"), 0.5)
    assert np.ptp(middle[:3]) > 0.3


def test_steps_look_equally_large() -> None:
    """Where nothing is clipped, equal shares are equal distances in OKLab."""
    lab = srgb_to_oklab(mix(color("crimson"), color("gold"), grid)[:, :3])
    steps = np.linalg.norm(np.diff(lab, axis=0), axis=1)
    assert steps == pytest.approx(np.full(64, steps.mean()), rel=1e-9)


@given(colors, colors, st.sampled_from([-1e9, -1e3, -1.0, 2.0, 1e3, 1e9]))
def test_far_beyond_the_ends_it_is_still_a_colour(a: Any, b: Any, u: float) -> None:
    """An ease that overshoots, however far, answers numbers from 0 to 1."""
    for made in (mix(a, b, u), mix(a, b, np.array([u]))[0]):
        assert ((made >= 0) & (made <= 1)).all()


def test_nan_stays_nan() -> None:
    """A NaN that gets this far is not made a colour of."""
    a, b = color("red"), color("#0008")
    assert np.isnan(mix(a, b, math.nan)).all()
    assert np.isnan(mix(a, b, np.array([math.nan]))).all()
