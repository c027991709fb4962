"""What an edit touches, and what it refuses."""

import math
from typing import Any

import pytest

from reactive4d.errors import ShapeError, TimeError, UnknownNameError
from reactive4d.signals.curves import Curve, Key
from reactive4d.signals.rotations import Rotation

INF = math.inf
VALUES = [3.0, 1.0, 4.0, 1.5, 9.0, 2.0, 6.0, 5.0]


def _curve(**settings: Any) -> Curve:
    return Curve(dict(enumerate(VALUES)), **settings)


@pytest.mark.parametrize(
    ("interpolation", "span"),
    [
        ("step", (3, 4)),
        ("linear", (2, 4)),
        ("hermite", (2, 4)),
        ("bezier", (2, 4)),
        ("catmull_rom", (1, 5)),
        ("catmull_rom_chordal", (1, 5)),
        ("tcb", (1, 5)),
    ],
)
def test_setting_a_value_touches_the_support_of_its_basis_function(interpolation: str, span: tuple[int, int]) -> None:
    """Step to the next key, linear from neighbour to neighbour, Catmull-Rom two neighbours each side."""
    curve = _curve(interpolation=interpolation)
    assert curve.difference(curve.with_point(3, 7.0)) == [span]


@pytest.mark.parametrize("degree", [1, 2, 3, 4])
def test_setting_a_value_of_a_bspline_touches_degree_and_one_spans(degree: int) -> None:
    """The knots from one before to degree after its own."""
    curve = Curve(dict(enumerate(range(20))), interpolation="bspline", degree=degree)
    breaks = curve.breaks
    [(lo, hi)] = curve.difference(curve.with_point(10, 70.0))
    assert breaks.index(hi) - breaks.index(lo) == degree + 1
    assert lo < 10 < hi


def test_inserting_touches_what_lies_between_its_neighbours() -> None:
    """Linear."""
    curve = _curve()
    assert curve.difference(curve.with_point(3.5, 7.0)) == [(3, 4)]


def test_deleting_touches_what_lay_between_its_neighbours() -> None:
    """Linear, and step."""
    assert _curve().difference(_curve().without_point(3)) == [(2, 4)]
    assert _curve(interpolation="step").difference(_curve(interpolation="step").without_point(3)) == [(3, 4)]


def test_moving_touches_both_neighbourhoods_and_nothing_between_them() -> None:
    """A key that jumps far leaves the middle alone."""
    curve = _curve()
    assert curve.difference(curve.moved(1, 5.5)) == [(0, 2), (5, 6)]


def test_moving_a_step_touches_only_the_time_between() -> None:
    """Before and after, the values are what they were."""
    curve = Curve({0: "a", 2: "b", 4: "c"})
    assert curve.difference(curve.moved(2, 3)) == [(2, 3)]


def test_the_last_key_reaches_to_infinity_and_the_first_from_there() -> None:
    """Held extrapolation is part of the support."""
    curve = _curve()
    assert curve.difference(curve.with_point(7, 0.0)) == [(6, INF)]
    assert curve.difference(curve.with_point(0, 0.0)) == [(-INF, 1)]


def test_moving_the_first_key_leaves_what_is_held_before_it() -> None:
    """The value before is the same."""
    curve = _curve()
    assert curve.difference(curve.moved(0, -1)) == [(-1, 1)]


def test_a_repeated_curve_changes_everywhere_outside_too() -> None:
    """An edit comes back in every cycle."""
    curve = _curve(after="cycle")
    assert curve.difference(curve.with_point(3, 0.0)) == [(2, 4), (7, INF)]
    assert curve.difference(_curve(after="cycle_offset")) == [(7, INF)]


def test_a_straight_extrapolation_changes_with_its_span() -> None:
    """Only an edit of one of the last two keys reaches outside."""
    curve = _curve(after="linear")
    assert curve.difference(curve.with_point(6, 0.0)) == [(5, INF)]
    assert curve.difference(curve.with_point(5, 0.0)) == [(4, 6)]


def test_assigning_new_keys_touches_only_the_spans_that_differ() -> None:
    """A new curve of mostly the same keys is nearly the same curve."""
    other = dict(enumerate(VALUES)) | {5: 2.5}
    assert _curve().difference(Curve(other)) == [(4, 6)]
    assert _curve().difference(Curve(dict(enumerate(VALUES)))) == []


def test_an_ease_touches_its_span_only() -> None:
    """The ease of a key acts up to the next."""
    curve = _curve()
    assert curve.difference(curve.with_point(3, Key(1.5, ease="in"))) == [(3, 4)]


def test_values_of_another_kind_differ_everywhere() -> None:
    """Whatever they are."""
    assert Curve({0: 1.0}).difference(Curve({0: "one"})) == [(-INF, INF)]


def test_setting_what_is_there_is_no_edit() -> None:
    """The same curve comes back."""
    curve = _curve()
    assert curve.with_point(3, 1.5) is curve
    assert curve.moved(3, 3) is curve


def test_a_bare_value_keeps_what_its_key_says_besides() -> None:
    """Handles, ease and tension stay; a Key replaces them."""
    curve = Curve({0: Key(1.0, tension=0.5), 1: 2.0}, interpolation="tcb")
    assert curve.with_point(0, 3.0).keys[0].tension == 0.5
    assert curve.with_point(0, Key(3.0)).keys[0].tension == 0.0


def test_a_dragged_key_of_a_long_curve_is_compared_near_itself_only() -> None:
    """Pieces far from an edit are not worked out."""
    curve = Curve({t: float(t % 7) for t in range(1000)}, interpolation="catmull_rom")
    other = curve.with_point(500, 99.0)
    assert curve.difference(other) == [(498, 502)]
    assert sum(piece is not None for piece in other._pieces) < 15  # pyright: ignore[reportPrivateUsage]


@pytest.mark.parametrize(
    ("make", "error", "message", "advice"),
    [
        (lambda: Curve({}), TimeError, "at least one key", "keys({0: value})"),
        (lambda: Curve({math.nan: 1.0}), TimeError, "cannot stand at nan", "before= and after="),
        (lambda: Curve({math.inf: 1.0}), TimeError, "cannot stand at inf", "before= and after="),
        (lambda: Curve({"1": 1.0}), TimeError, "time of a key", "maps times to values"),
        (lambda: Curve([(1, 1.0), (1.0, 2.0)]), TimeError, "two keys at 1.0 s", "a jump needs two times"),
        (lambda: Curve(5), ShapeError, "expected a mapping", "keys({"),
        (lambda: Curve({0: math.nan}), ShapeError, "the key at 0.0 s: nan", "0 / 0"),
        (lambda: Curve({0: (1.0, math.nan)}), ShapeError, "the key at 0.0 s: nan", "0 / 0"),
        (lambda: Curve({0: 1.0, 1: INF}), ShapeError, "the key at 1.0 s: inf is not finite", "step"),
        (
            lambda: Curve({0: (0, 0, 0), 1: (1, 2)}),
            ShapeError,
            "1.0 s: expected 3 numbers, got an array of shape (2,)",
            None,
        ),
        (lambda: Curve({0: 1.0, 1: (1, 2)}), ShapeError, "of several kinds: 1.0 at 0.0 s is a number", "kind='held'"),
        (lambda: Curve({0: "red", 1: (1, 0, 0)}), ShapeError, "several kinds", "kind='color'"),
        (lambda: Curve({0: 1.0}, kind="rotation"), ShapeError, "expected a Rotation, got 1.0", "from_axis_angle"),
        (lambda: Curve({0: 1.0}, interpolation="liner"), UnknownNameError, "unknown interpolation 'liner'", "'linear'"),
        (lambda: Curve({0: 1.0}, before="cylce"), UnknownNameError, "unknown extrapolation 'cylce'", "'cycle'"),
        (lambda: Curve({0: 1.0}, ease="inout"), UnknownNameError, "unknown easing 'inout'", "'in_out'"),
        (lambda: Curve({0: 1.0}, kind="colour"), UnknownNameError, "unknown kind of values 'colour'", "'color'"),
        (
            lambda: Curve({0: 1.0}, interpolation="slerp"),
            ShapeError,
            "'slerp' is not for values of kind 'number'",
            "linear",
        ),
        (lambda: Curve({0: "on"}, interpolation="linear"), ShapeError, "not for values of kind 'held'", "step"),
        (lambda: Curve({0: "on"}, after="linear"), ShapeError, "extrapolation 'linear' is not for", "hold, cycle"),
        (lambda: Curve({0: "on"}, ease="in"), ShapeError, "an ease has no effect on 'step'", "handles"),
        (lambda: Curve({0: Key(1.0, tension=1)}), ShapeError, "tension, continuity and bias have no effect", "'tcb'"),
        (lambda: Curve({0: Key(1.0, left=(-1, 0))}), ShapeError, "handles have no effect on 'linear'", "'bezier'"),
        (
            lambda: Curve({0: 1.0}, interpolation="bspline", degree=0),
            ShapeError,
            "degree: expected a whole number",
            None,
        ),
        (lambda: Key(1.0, left=(1, 0)), ShapeError, "points the wrong way", "offsets from the key"),
        (lambda: Key(1.0, right=3), ShapeError, "expected a pair (dt, dv)", None),
        (lambda: Key(1.0, tension=math.nan), ShapeError, "Key.tension: expected a finite number", None),
        (lambda: _curve().without_point(2.5), TimeError, "no key at 2.5 s", "stands at 2.0 s"),
        (lambda: Curve({0: 1.0}).without_point(0), TimeError, "the only one", "set another one first"),
        (lambda: _curve().moved(2, 3), TimeError, "a key at 3.0 s already", "delete it first"),
        (lambda: _curve().with_point(2, "red"), ShapeError, "the key at 2.0 s: expected a number, got 'red'", None),
        (lambda: Curve({0: Rotation()}).with_point(1, (1, 0, 0, 0)), ShapeError, "expected a Rotation", "Rotation((w"),
    ],
)
def test_bad_input_is_refused_at_the_border(
    make: Any, error: type[Exception], message: str, advice: str | None
) -> None:
    """With the value, what was expected, and what to do."""
    with pytest.raises(error) as caught:
        make()
    assert message in str(caught.value)
    if advice is not None:
        assert any(advice in note for note in caught.value.__notes__)
