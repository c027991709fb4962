"""What holds for every curve, whatever its kind, interpolation and keys."""

import math
import pickle
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from reactive4d.arrays import same
from reactive4d.signals.colors import color
from reactive4d.signals.curves import EXTRAPOLATIONS, INTERPOLATIONS, Curve, Key
from reactive4d.signals.rotations import Rotation

TIMES = st.integers(-8, 24).map(lambda n: n / 4)
FEW = st.sampled_from([0.0, 1.0, -2.5, 3.0])
NUMBERS = st.one_of(FEW, st.floats(-100, 100))
EASES = st.sampled_from(["linear", "in", "in_out", "out_back", "out_elastic"])
UNIT = st.floats(-1, 1)
VALUES: dict[str, Any] = {
    "number": NUMBERS,
    "vector": st.tuples(NUMBERS, FEW, FEW),
    "color": st.sampled_from(["red", "gold", "navy", "white"]),
    "rotation": st.builds(Rotation.from_axis_angle, st.sampled_from("xyz"), st.sampled_from([0, 30, 90, 120, 200])),
    "held": st.sampled_from(["a", "b", None, True]),
}


@st.composite
def _keys_for(draw: st.DrawFn, kind: str, interpolation: str) -> Any:
    rule = INTERPOLATIONS[interpolation]
    value = draw(VALUES[kind])
    told: dict[str, Any] = {}
    if rule.eased and draw(st.booleans()):
        told["ease"] = draw(EASES)
    if rule.handles and draw(st.booleans()):
        told["left"] = (draw(st.floats(-3, -0.1)), draw(VALUES[kind]))
    if rule.handles and draw(st.booleans()):
        told["right"] = (draw(st.floats(0.1, 3)), draw(VALUES[kind]))
    if rule.tensions:
        told |= {"tension": draw(UNIT), "continuity": draw(UNIT), "bias": draw(UNIT)}
    return Key(value, **told) if told else value


@st.composite
def _curves(draw: st.DrawFn, *, kinds: tuple[str, ...] = tuple(VALUES), least: int = 1) -> Curve:
    kind = draw(st.sampled_from(kinds))
    names = sorted(name for name, rule in INTERPOLATIONS.items() if kind in rule.kinds)
    interpolation = draw(st.sampled_from(names))
    times = draw(st.lists(TIMES, min_size=least, max_size=7, unique=True))
    outside = [
        name for name in EXTRAPOLATIONS if kind not in ("held", "color") or name not in ("linear", "cycle_offset")
    ]
    return Curve(
        {t: draw(_keys_for(kind, interpolation)) for t in times},
        kind=kind,
        interpolation=interpolation,
        before=draw(st.sampled_from(outside)),
        after=draw(st.sampled_from(outside)),
        degree=draw(st.integers(1, 5)),
    )


@st.composite
def _edited(draw: st.DrawFn, curve: Curve) -> Curve:
    value = _keys_for(curve.space.kind, curve.interpolation)
    verb = draw(st.sampled_from(["insert", "set", "delete", "move", "assign"]))
    try:
        match verb:
            case "insert":
                return curve.with_point(draw(TIMES), draw(value))
            case "set":
                return curve.with_point(draw(st.sampled_from(curve.times)), draw(value))
            case "delete":
                return curve.without_point(draw(st.sampled_from(curve.times)))
            case "move":
                return curve.moved(draw(st.sampled_from(curve.times)), draw(TIMES))
            case _:
                other = dict(zip(curve.times, curve.keys, strict=True))
                other[draw(TIMES)] = draw(value)
                kind, interpolation, _, ease, before, after = curve.settings
                return Curve(
                    other,
                    kind=kind,
                    interpolation=interpolation,
                    ease=ease,
                    before=before,
                    after=after,
                    degree=curve.degree,
                )
    except ValueError:
        assume(False)
        raise


def _is_same(curve: Curve, a: Any, b: Any) -> bool:
    return a == b if isinstance(a, Rotation) else same(a, b)


def _difference(a: Any, b: Any) -> float:
    if isinstance(a, Rotation):
        return float(np.linalg.norm(a.as_matrix() - b.as_matrix()))
    return float(np.abs(np.subtract(a, b)).max())


def _scale(curve: Curve, *more: Any) -> float:
    if curve.space.kind == "rotation":
        return 1.0
    values = [
        np.abs(piece.controls).max() for i in range(len(curve.breaks) + 1) if len((piece := curve.piece(i)).controls)
    ]
    return max(1.0, *values, *(float(np.abs(value).max()) for value in more))


def _asked(curve: Curve) -> list[float]:
    """Times in, at, next to, and far from the keys."""
    span = max(curve.times[-1] - curve.times[0], 1.0)
    at = [t + k * span for t in curve.times for k in (-3, -2, -1, 0, 1, 2, 3)]
    near = [math.nextafter(t, side) for t in at for side in (-math.inf, math.inf)]
    return sorted({*at, *near, *np.linspace(curve.times[0] - 3.3 * span, curve.times[-1] + 3.3 * span, 97).tolist()})


@given(_curves(), st.data())
def test_an_answer_holds_wherever_it_says(curve: Curve, data: st.DataObject) -> None:
    """Every time inside of the span that came with an answer has that very answer."""
    t = data.draw(st.sampled_from(_asked(curve)))
    lo, hi, value = curve.sample(t)
    assert lo <= t < hi
    inside = [lo, t, math.nextafter(hi, -math.inf)]
    low, high = max(lo, -1e6), min(hi, 1e6)
    inside += [low + (high - low) * data.draw(st.floats(0, 1)) for _ in range(8)]
    for u in inside:
        if lo <= u < hi and math.isfinite(u):
            assert _is_same(curve, curve.at(u), value), u


@given(_curves())
def test_many_at_once_agree_with_one_by_one(curve: Curve) -> None:
    """To 1e-12 of the scale of the values; exactly where the value is held."""
    times = _asked(curve)
    many = curve.sample_many(np.array(times))
    assert len(many) == len(times)
    for t, value in zip(times, many, strict=True):
        lo, hi, one = curve.sample(t)
        if curve.space.kind == "held" or hi > math.nextafter(lo, math.inf):
            assert (one == value) if curve.space.kind in ("rotation", "held") else np.array_equal(one, value)
        else:
            assert _difference(one, value) <= 1e-12 * _scale(curve, one), t


@given(_curves())
def test_the_keys_are_met_exactly(curve: Curve) -> None:
    """At the time of a key the answer is the key's value; a B-spline meets the first and the last."""
    ends = curve.interpolation == "bspline"
    for t, key in list(zip(curve.times, curve.values, strict=True))[:: max(1, len(curve.times) - 1) if ends else 1]:
        assert _is_same(curve, curve.at(t), curve.answer(key))


@given(st.data())
@settings(max_examples=300)
def test_a_difference_misses_nothing(data: st.DataObject) -> None:
    """Outside of the spans that an edit names, every answer is the same to the last bit."""
    curve = data.draw(_curves())
    other = data.draw(_edited(curve))
    spans = curve.difference(other)
    assert all(lo < hi for lo, hi in spans)
    assert all(a[1] < b[0] for a, b in pairwise(spans))
    assert spans == other.difference(curve)
    for t in sorted({*_asked(curve), *_asked(other)}):
        if not any(lo <= t < hi for lo, hi in spans):
            assert _is_same(curve, curve.at(t), other.at(t)), t


@given(_curves())
def test_a_curve_survives_pickling(curve: Curve) -> None:
    """A curve that was sent to another process says the same."""
    other = pickle.loads(pickle.dumps(curve))
    assert other.same(curve)
    assert other.difference(curve) == []


@given(_curves(kinds=("number", "vector")), st.data())
def test_a_time_that_is_infinite_has_an_answer(curve: Curve, data: st.DataObject) -> None:
    """At minus and plus infinity a curve answers with its extrapolation, never with NaN."""
    for t in (-math.inf, math.inf):
        value = curve.at(t)
        assert not np.isnan(value).any()
        assert np.array_equal(curve.sample_many(np.array([t]))[0], value)


def test_colours_are_met_to_the_last_bit() -> None:
    """A colour is answered at its key as it was given, not as it comes back from the space of mixing."""
    curve = Curve({0: "crimson", 1: "navy", 2: "navy"})
    assert np.array_equal(curve.at(0.0), color("crimson"))
    assert np.array_equal(curve.at(1.5), color("navy"))


def test_a_curve_cannot_be_changed() -> None:
    """A curve is a value."""
    curve = Curve({0: 1.0})
    with pytest.raises(AttributeError, match="cannot be changed"):
        curve.before = "cycle"


def test_a_key_that_is_an_end_no_longer_is_told() -> None:
    """A B-spline meets its ends to the last bit and comes near the other keys: so both of these instants differ."""
    one = Curve({0.25: "red", 0.5: "gold"}, interpolation="bspline", degree=1)
    other = one.with_point(0.0, "red")
    assert one.difference(other) == other.difference(one) == [(0.0, 5e-324), (0.25, math.nextafter(0.25, 1.0))]
