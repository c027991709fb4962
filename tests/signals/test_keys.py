"""Keys as a signal: sources that one edits, and keys whose values are signals themselves."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive4d.engine import engine
from reactive4d.errors import CycleError, ShapeError, TimeError
from reactive4d.signals.algebra import vec
from reactive4d.signals.calculus import derivative
from reactive4d.signals.choices import where
from reactive4d.signals.colors import color
from reactive4d.signals.curves import Curve, Key
from reactive4d.signals.functions import signal
from reactive4d.signals.keys import Keys, keys
from reactive4d.signals.rotations import Rotation
from reactive4d.signals.sources import Variable, time
from reactive4d.signals.warps import delay

INF = math.inf


def test_keys_answer_where_their_curve_does() -> None:
    """They are the curve as a signal, and know where an answer holds."""
    k = keys({0: "red", 2: "ready", 5: "done"})
    assert k.at(3) == "ready"
    assert (k.valid(3).start, k.valid(3).stop) == (2, 5)
    assert k.at(np.array([-1.0, 2.0, 9.0])) == ("red", "ready", "done")


def test_points_are_a_mapping_that_one_edits() -> None:
    """Setting, inserting, deleting, moving; the order is that of time."""
    k = keys({3: 1.0, 0: 0.0})
    k.points[1] = 5.0
    k.points[3] = 2.0
    assert list(k.points.items()) == [(0.0, 0.0), (1.0, 5.0), (3.0, 2.0)]
    del k.points[0]
    k.move(1, 4)
    assert dict(k.points) == {3.0: 2.0, 4.0: 5.0}
    assert 4 in k.points
    assert 1 not in k.points
    assert k.at(3.5) == 3.5
    k.points = {0: 7.0}
    assert k.at(3.5) == 7.0


def test_a_key_that_is_not_there_is_a_key_error() -> None:
    """As in every mapping; the note names the nearest one."""
    k = keys({0: 1.0, 2: 3.0})
    with pytest.raises(KeyError) as caught:
        k.points[1.5]
    assert "nearest one stands at 2.0 s" in caught.value.__notes__[0]
    with pytest.raises(KeyError):
        del k.points[1.5]
    with pytest.raises(TimeError):
        k.move(1.5, 3)


def test_bad_edits_change_nothing() -> None:
    """An error at the border leaves the keys as they were."""
    k = keys({0: 1.0, 2: 3.0})
    with pytest.raises(ShapeError):
        k.points[1] = "red"
    with pytest.raises(ShapeError):
        k.points[1] = math.nan
    with pytest.raises(TimeError):
        k.points[math.nan] = 1.0
    with pytest.raises(ShapeError):
        k.points.update({1: 5.0, 2: (1, 2)})
    assert dict(k.points) == {0.0: 1.0, 2.0: 3.0}


def test_setting_several_points_is_one_edit() -> None:
    """And says the spans of all."""
    k = keys(dict.fromkeys(range(6), 0.0), name="k")
    with engine.log() as log:
        k.points.update({1: 1.0, 4: 1.0})
    assert list(map(str, log)) == ["edited k [0, 2)", "edited k [3, 5)"]


def test_an_edit_touches_only_its_neighbourhood() -> None:
    """
    What was remembered elsewhere is not asked again.

        keys --> doubled
    """
    k = keys({0: 0.0, 1: 5.0, 2: 3.0, 3: 8.0, 9: 1.0}, name="k")
    calls: list[float] = []
    doubled = k.map(lambda x: calls.append(x) or 2 * x)
    for t in (0.5, 2.5, 5.0):
        doubled.at(t)
    calls.clear()
    k.points[2] = 4.0
    assert [doubled.at(t) for t in (0.5, 5.0)] == [5.0, 2 * k.at(5.0)]
    assert calls == []
    doubled.at(2.5)
    assert len(calls) == 1


def test_undoing_an_edit_costs_no_evaluation() -> None:
    """The old value brings the old answers back."""
    k = keys({0: 0.0, 1: 5.0, 2: 3.0})
    calls: list[float] = []
    doubled = k.map(lambda x: calls.append(x) or 2 * x)
    before = doubled.at(0.5)
    k.points[1] = 6.0
    doubled.at(0.5)
    k.points[1] = 5.0
    calls.clear()
    assert doubled.at(0.5) == before
    assert calls == []


def test_words_that_change_no_answer_are_kept() -> None:
    """A key on a held span changes nothing one can ask, but it is there."""
    k = keys({0: "a", 4: "b"})
    k.points[2] = "a"
    assert list(k.points) == [0.0, 2.0, 4.0]
    k.change(interpolation="step")
    k.move(2, 3)
    assert list(k.points) == [0.0, 3.0, 4.0]


def test_the_interpolation_can_be_changed() -> None:
    """F083: selectable for each list of keys, at any time."""
    k = keys({0: 0.0, 1: 1.0, 2: 4.0})
    k.change(interpolation="catmull_rom", after="linear")
    assert k.at(1.5) != 2.5
    assert k.at(9.0) > 4.0
    k.change(interpolation="step", after="hold")
    assert k.at(1.5) == 1.0


def test_a_key_says_more_than_its_value() -> None:
    """Handles and ease stay when the value is set; `key` shows them."""
    k = keys({0: Key(0.0, ease="in_quad"), 2: 4.0})
    k.points[0] = 2.0
    assert k.key(0).ease == "in_quad"
    assert k.at(1.0) == 2.5


# Keys whose values are signals: F084.


def test_a_target_glides_from_one_moving_object_to_another() -> None:
    """
    Each control point is evaluated at the asked time, then they are interpolated.

        bee --.
               keys --> target
        fly --'
    """
    bee, fly = vec(time, 0, 0), vec(0, time, 0)
    target = keys({2: bee, 3: fly})
    assert target.at(1.0).tolist() == [1.0, 0.0, 0.0]
    assert target.at(2.5).tolist() == [1.25, 1.25, 0.0]
    assert target.at(7.0).tolist() == [0.0, 7.0, 0.0]
    times = np.array([1.0, 2.5, 7.0])
    assert target.at(times).tolist() == [target.at(t).tolist() for t in times]


def test_only_what_has_a_weight_is_asked() -> None:
    """Outside of two keys the other's signal is not read at all; at a key's own time neither is its neighbour."""
    asked: list[str] = []

    @signal
    def a() -> float:
        asked.append("a")
        return 1.0

    @signal
    def b() -> float:
        asked.append("b")
        return 2.0

    k = keys({2: a, 3: b})
    assert k.at(1.0) == 1.0
    assert k.at(2.0) == 1.0
    assert asked == ["a"]
    assert k.at(2.5) == 1.5
    assert asked == ["a", "b"]


def test_what_holds_outside_of_the_keys_holds_there() -> None:
    """Where the weight of one signal stands, the answer holds as long as that signal."""
    a = keys({0: 1.0, 1: 5.0, 1.5: 5.0}, interpolation="step")
    k = keys({2: a, 3: 9.0})
    assert (k.valid(0.5).start, k.valid(0.5).stop) == (-INF, 1)
    assert (k.valid(1.75).start, k.valid(1.75).stop) == (1, 2)
    assert k.valid(2.5).is_instant
    assert (k.valid(7.0).start, k.valid(7.0).stop) == (3, INF)


def test_the_same_signal_twice_holds_between() -> None:
    """Equal neighbours hold, whatever they are."""
    a = keys({0: 1.0, 5: 2.0}, interpolation="step")
    k = keys({2: a, 3: a, 4: 0.0})
    assert (k.valid(2.5).start, k.valid(2.5).stop) == (-INF, 3)


def test_keys_become_alive_and_come_back() -> None:
    """A value may be set to a signal and back to a constant."""
    v = Variable(10.0)
    k = keys({0: 0.0, 2: 4.0})
    doubled = 2 * k
    assert doubled.at(1.0) == 4.0
    k.points[2] = v
    assert doubled.at(1.0) == 10.0
    v.value = 20.0
    assert doubled.at(1.0) == 20.0
    k.points[2] = 4.0
    assert doubled.at(1.0) == 4.0
    v.value = 30.0
    assert doubled.at(1.0) == 4.0


@pytest.mark.parametrize(
    "interpolation", ["linear", "catmull_rom", "catmull_rom_uniform", "tcb", "bspline", "bezier", "hermite"]
)
@pytest.mark.parametrize("outside", ["hold", "linear", "cycle", "cycle_offset", "oscillate"])
def test_signals_are_interpolated_as_their_values_are(interpolation: str, outside: Any) -> None:
    """Every interpolation is a weighted sum of the control points."""
    values = [3.0, -1.0, 4.0, 1.0, -5.0]
    handles: dict[str, Any] = {}
    if interpolation in ("bezier", "hermite"):
        handles = {"left": (-0.5, 1.0), "right": (0.3, -2.0)}
    if interpolation == "tcb":
        handles = {"tension": 0.3, "bias": -0.4}
    known = keys(
        {t * t: Key(v, **handles) for t, v in enumerate(values)},
        interpolation=interpolation,
        before=outside,
        after=outside,
    )
    alive = keys(
        {t * t: Key(Variable(v) if t % 2 else v, **handles) for t, v in enumerate(values)},
        interpolation=interpolation,
        before=outside,
        after=outside,
    )
    times = np.linspace(-20, 40, 77)
    np.testing.assert_allclose([alive.at(t) for t in times], [known.at(t) for t in times], atol=1e-11)
    np.testing.assert_allclose(alive.at(times), known.at(times), atol=1e-11)


def test_colours_and_rotations_may_be_alive() -> None:
    """They are mixed as their kind is."""
    ripe = Variable("gold")
    assert keys({0: "red", 1: ripe}).at(0.5).tolist() == pytest.approx(keys({0: "red", 1: "gold"}).at(0.5).tolist())
    assert keys({0: "red", 1: ripe}).at(2.0).tolist() == color("gold").tolist()
    turn = Variable(Rotation.from_axis_angle("z", 90))
    assert keys({0: Rotation(), 1: turn}).at(0.5) == keys({0: Rotation(), 1: turn.value}).at(0.5)
    assert keys({0: turn, 1: turn}, interpolation="linear").at(0.5) == turn.value


def test_held_values_may_be_alive() -> None:
    """Strings and objects that signals answer are held for their span."""
    word = keys({0: "now", 1: "then"})
    k = keys({0: "first", 3: word, 5: "last"}, kind="held")
    assert [k.at(t) for t in (2, 4, 6)] == ["first", "then", "last"]
    unknown = keys({0: Variable("up"), 1: Variable("down")})
    assert unknown.at(-1) == "up"
    with pytest.raises(ShapeError, match="nothing lies between 'up' and 'down'"):
        unknown.at(0.5)


def test_a_signal_of_another_kind_is_refused_when_it_is_asked() -> None:
    """With what was expected."""
    k = keys({0: (0, 0, 0), 1: Variable(2.0)})
    with pytest.raises(ShapeError, match="expected 3 numbers"):
        k.at(0.5)


def test_distances_between_signals_are_not_known() -> None:
    """Centripetal and chordal parametrisations look at values, which signals do not have beforehand."""
    with pytest.raises(ShapeError, match="some of them alive"):
        keys({0: Variable(1.0), 1: 2.0}, interpolation="catmull_rom_chordal")


def test_keys_that_read_themselves_are_a_cycle() -> None:
    """At one and the same time."""
    k = keys({0: 0.0, 2: 4.0})
    k.points[2] = k + 1
    with pytest.raises(CycleError):
        k.at(1.0)
    k.points[2] = 5.0
    assert k.at(1.0) == 2.5


def test_everything_of_figure_two_can_be_written() -> None:
    """F087: atoms, lists, lists of lists, the second value of a list, functions and references."""
    position = vec(time, 2, 3)
    k = keys(
        {0: 3.1416, 1: "text", 2: np.sin(time), 3: (1.0, 2.0, 3.0), 4: [[1, "a"], [2, "b"]], 5: position}, kind="held"
    )
    assert k.at(0.5) == 3.1416
    assert k.at(1.5) == "text"
    assert k.at(2.5) == math.sin(2.5)
    assert k.at(3.5) == (1.0, 2.0, 3.0)
    assert k[1].at(4.5) == (2, "b")
    assert k.at(6.0).tolist() == [6.0, 2.0, 3.0]


def test_comparisons_know_the_pieces_of_straight_keys() -> None:
    """A linear span crosses a threshold once, and the answer holds up to there."""
    k = keys({0: 0.0, 10: 10.0})
    choice = where(k < 4, "low", "high")
    assert choice.at(1.0) == "low"
    interval = choice.valid(1.0)
    assert interval.stop == pytest.approx(4.0, abs=1e-12)
    assert choice.at(interval.stop) == "high"


@given(
    st.lists(
        st.tuples(st.sampled_from("sidm"), st.integers(0, 8), st.integers(0, 8), st.sampled_from([0.0, 1.0, -2.0])),
        max_size=12,
    )
)
def test_edited_keys_answer_as_new_ones_would(edits: list[tuple[str, int, int, float]]) -> None:
    """After any edits, and with answers remembered from before, nothing differs from keys that were just made."""
    k: Keys[float] = keys({0: 1.0, 4: 2.0, 6: 2.0}, interpolation="catmull_rom")
    shifted = k + 1
    times = np.linspace(-1, 9, 41)
    for verb, t, to, value in edits:
        try:
            if verb == "d":
                del k.points[t]
            elif verb == "m":
                k.move(t, to)
            else:
                k.points[t] = value
        except (KeyError, TimeError):
            pass
        fresh = Curve(dict(k.points), interpolation="catmull_rom")
        assert [shifted.at(x) for x in times] == [fresh.at(x) + 1 for x in times]
        np.testing.assert_allclose(shifted.at(times), fresh.sample_many(times) + 1, atol=1e-13)
    engine.check([k, shifted])


SOURCES = st.sampled_from(["v", "steps", "time", 1.0, 2.0, -1.0])
TIMES = st.integers(0, 8).map(float)


@given(
    st.sampled_from(["step", "linear", "catmull_rom", "bspline"]),
    st.sampled_from(["hold", "linear", "cycle", "oscillate"]),
    st.dictionaries(TIMES, SOURCES, min_size=1, max_size=5),
    st.lists(st.tuples(st.sampled_from(["point", "delete", "move", "v", "steps"]), TIMES, TIMES, SOURCES), max_size=6),
    st.lists(st.floats(-4, 12), min_size=1, max_size=5),
)
def test_remembered_answers_are_those_that_would_be_computed(
    interpolation: str, outside: Any, points: dict[float, Any], edits: list[Any], times: list[float]
) -> None:
    """
    Through any edits, to the last bit, and over every span that is claimed.

        v, steps, time --> keys --> velocity, area, later
    """
    v, steps = Variable(3.0), keys({0: 0.0, 2: 5.0, 4: 5.0, 5: 1.0}, interpolation="step")
    named = {"v": v, "steps": steps, "time": time}

    def value(x: Any) -> Any:
        return named.get(x, x)

    k: Keys[Any] = keys(
        {t: value(x) for t, x in points.items()}, interpolation=interpolation, before=outside, after=outside
    )
    derived = [k * 2, delay(k, 1.5), derivative(k) + 1]
    for edit in [None, *edits]:
        match edit:
            case ("point", t, _, x):
                k.points[t] = value(x)
            case ("delete", t, _, _) if t in k.points and len(k.points) > 1:
                del k.points[t]
            case ("move", t, to, _) if t in k.points and to not in k.points:
                k.move(t, to)
            case ("v", t, _, _):
                v.value = t
            case ("steps", t, to, _):
                steps.points[t] = to
            case _:
                pass
        for x in derived:
            for t in [*times, 0.0, 2.5, 4.0]:
                found = x.at(t)
                assert found == engine.naive(x, t)
                span = x.valid(t)
                for u in (span.start, math.nextafter(span.stop, -INF), (max(span.start, -9) + min(span.stop, 20)) / 2):
                    if span.start <= u < span.stop and abs(u) < INF:
                        assert engine.naive(x, u) == found, (t, u)
    engine.check([k, *derived])


def test_an_edit_of_a_dragged_key_asks_only_what_is_drawn() -> None:
    """A hundred positions of one key, one redraw each: one evaluation each."""
    k = keys(dict.fromkeys(range(100), 0.0))
    calls: list[float] = []
    seen = k.map(lambda x: calls.append(x) or x)
    for t in range(99):
        seen.at(t + 0.5)
    calls.clear()
    for i in range(100):
        k.points[50] = float(i)
        k.points[50] = i + 1.0
        seen.at(50.5)
    assert len(calls) == 100
    calls.clear()
    for t in range(99):
        seen.at(t + 0.5)
    assert len(calls) == 1
