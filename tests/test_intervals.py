"""Interval algebra: against `portion` as an oracle, and by its laws."""

import copy
import math
import operator
import pickle
from itertools import pairwise
from typing import Any

import numpy as np
import portion
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from reactive4d import intervals
from reactive4d.errors import TimeError
from reactive4d.intervals import FOREVER, Interval, IntervalSet

INF = math.inf
EVERYTHING = IntervalSet([FOREVER])

# Quarters, so that ends coincide often and arithmetic on them is exact.
quarters = st.integers(-40, 40).map(lambda n: n / 4)
ends = quarters | st.sampled_from([-INF, INF])
pairs = st.tuples(ends, ends).map(lambda pair: (min(pair), max(pair)))
sets = st.lists(pairs, max_size=6).map(IntervalSet)
times = st.floats(allow_nan=False)
probes = quarters | times | st.sampled_from([-INF, INF])
finite = st.floats(allow_nan=False, allow_infinity=False)
moderate = st.floats(-1e100, 1e100)
dyadic = st.integers(-4, 4).map(lambda n: 2.0**n)


def oracle(times: IntervalSet) -> Any:
    """The same set as `portion` writes it."""
    union = portion.empty()
    for piece in times:
        start = -portion.inf if piece.start == -INF else piece.start
        union |= portion.closedopen(start, portion.inf if piece.stop == INF else piece.stop)
    return union


@given(st.lists(pairs, max_size=6))
def test_a_set_is_the_union_of_what_it_is_made_of_kept_in_the_fewest_pieces(pieces: list[tuple[float, float]]) -> None:
    """The canonical form is portion's: sorted, disjoint, not even touching, nothing empty."""
    expected = portion.empty()
    for start, stop in pieces:
        expected |= oracle(IntervalSet([(start, stop)]))
    made = IntervalSet(pieces)
    assert oracle(made) == expected
    assert len(made) == (0 if expected.empty else len(expected))
    parts = list(made)
    assert all(a.stop < b.start for a, b in pairwise(parts))
    assert not any(part.is_empty for part in parts)


@given(sets, sets)
def test_combining_sets_answers_what_portion_answers(a: IntervalSet, b: IntervalSet) -> None:
    """Union, intersection, difference and complement agree with the oracle."""
    assert oracle(a | b) == oracle(a) | oracle(b)
    assert oracle(a & b) == oracle(a) & oracle(b)
    assert oracle(a - b) == oracle(a) - oracle(b)
    assert oracle(a.complement()) == ~oracle(a)


@given(sets, sets, probes)
def test_membership_is_a_homomorphism(a: IntervalSet, b: IntervalSet, t: float) -> None:
    """What holds of sets holds of every single time, infinite ones included."""
    assert (t in (a | b)) == (t in a or t in b)
    assert (t in (a & b)) == (t in a and t in b)
    assert (t in (a - b)) == (t in a and t not in b)
    assert (t in ~a) == (t not in a)
    assert (t in a) == any(t in piece for piece in a)


@given(sets, sets, sets)
def test_sets_are_a_boolean_algebra(a: IntervalSet, b: IntervalSet, c: IntervalSet) -> None:
    """The laws hold as equality of canonical forms, and equal sets hash alike."""
    assert a | b == b | a
    assert a & b == b & a
    assert (a | b) | c == a | (b | c)
    assert (a & b) & c == a & (b & c)
    assert a & (b | c) == (a & b) | (a & c)
    assert a | (b & c) == (a | b) & (a | c)
    assert ~(a | b) == ~a & ~b
    assert ~~a == a
    assert a - b == a & ~b
    assert a | ~a == EVERYTHING
    assert not a & ~a
    assert hash(a | b) == hash(b | a)


@given(sets, pairs)
def test_an_interval_combines_with_a_set_from_either_side(a: IntervalSet, pair: tuple[float, float]) -> None:
    """An interval stands for the set that holds it alone."""
    span = Interval(*pair)
    alone = IntervalSet([span])
    assert (a | span, a & span, a - span) == (a | alone, a & alone, a - alone)
    assert (span | a, span & a, span - a) == (alone | a, alone & a, alone - a)
    assert (span | span, span - span) == (alone, IntervalSet())


@given(sets, sets, quarters, dyadic, quarters, st.booleans())
def test_moving_a_set_respects_every_combination(
    a: IntervalSet, b: IntervalSet, offset: float, factor: float, about: float, mirrored: bool
) -> None:
    """Shifting and scaling, also by negative factors, commute with union, intersection, difference, complement."""
    factor = -factor if mirrored else factor
    for moved in (lambda s: s.shift(offset), lambda s: s.scale(factor, about=about)):
        assert moved(a | b) == moved(a) | moved(b)
        assert moved(a & b) == moved(a) & moved(b)
        assert moved(a - b) == moved(a) - moved(b)
        assert moved(~a) == ~moved(a)


@given(sets, quarters, dyadic, quarters)
def test_moving_back_gives_the_first_set(a: IntervalSet, offset: float, factor: float, about: float) -> None:
    """Shift and scale have inverses where arithmetic is exact, and a mirror is its own."""
    assert a.shift(offset).shift(-offset) == a
    assert a.scale(factor, about=about).scale(1 / factor, about=about) == a
    assert a.scale(-1).scale(-1) == a


@given(pairs, quarters, st.integers(-8, 8), quarters, quarters)
def test_a_time_is_in_an_interval_as_its_image_is_in_the_image(
    pair: tuple[float, float], t: float, factor: int, about: float, offset: float
) -> None:
    """Also at the ends, also mirrored: the end that belongs to the interval belongs to its image."""
    assume(factor)
    span = Interval(*pair)
    assert (t + offset in span.shift(offset)) == (t in span)
    assert (about + (t - about) * factor in span.scale(factor, about=about)) == (t in span)


@given(times, finite, finite, finite)
def test_an_instant_maps_to_the_instant_of_its_image(t: float, offset: float, factor: float, about: float) -> None:
    """Whatever rounding does, one time stays one time (the instant that holds inf holds the largest float too)."""
    assume(abs(t) < INF)
    image = about + (t - about) * factor
    assume(image == image and Interval.instant(t).stop < INF)
    assert Interval.instant(t).shift(offset) == Interval.instant(t + offset)
    assert Interval.instant(t).scale(factor, about=about) == Interval.instant(image if factor else about)


@given(moderate, moderate, finite, st.floats(-1e100, 1e100).filter(bool), st.floats(0, 1))
def test_nothing_is_rounded_away(a: float, b: float, offset: float, factor: float, share: float) -> None:
    """The image of an interval is never empty, and holds the image of each time but for one float at the open end."""
    assume(a != b)
    span = Interval(min(a, b), max(a, b))
    t = min(max(span.start + (span.stop - span.start) * share, span.start), math.nextafter(span.stop, -INF))
    for image, moved in ((t + offset, span.shift(offset)), (t * factor, span.scale(factor))):
        assert not moved.is_empty
        assert image in moved or image in (moved.stop, math.nextafter(moved.start, -INF))


@given(times)
def test_every_time_has_an_instant_that_holds_it(t: float) -> None:
    """Infinite times too; only the largest float shares its instant, with inf."""
    span = Interval.instant(t)
    assert t in span
    assert span.is_instant
    assert not span.is_empty
    assert math.nextafter(t, -INF) not in span or t in (-INF, INF)
    assert math.nextafter(t, INF) not in span or math.nextafter(t, INF) == INF


@given(pairs, pairs, pairs, probes)
def test_intersection_of_intervals_is_a_semilattice(
    a: tuple[float, float], b: tuple[float, float], c: tuple[float, float], t: float
) -> None:
    """Commutative, associative, idempotent, with FOREVER as its neutral element."""
    x, y, z = Interval(*a), Interval(*b), Interval(*c)
    assert x & y == y & x == x.intersection(y)
    assert (x & y) & z == x & (y & z)
    assert x & x == x == x & FOREVER
    assert (t in (x & y)) == (t in x and t in y)
    assert IntervalSet([x]) & y == IntervalSet([x & y])


@given(sets)
def test_the_hull_is_the_smallest_interval_round_a_set(a: IntervalSet) -> None:
    """It holds every piece, and its ends are ends of pieces."""
    pieces = list(a)
    if pieces:
        assert a.hull == Interval(pieces[0].start, pieces[-1].stop)
    else:
        assert a.hull.is_empty
    assert a & a.hull == a
    assert a.length == sum(piece.length for piece in pieces)


def test_neighbours_never_both_hold_and_leave_no_gap() -> None:
    """Half-open: the time where one stops is where the next starts, also after a mirror."""
    before, after = Interval(0, 1), Interval(1, 2)
    assert (1 in before, 1 in after) == (False, True)
    left, right = after.scale(-1), before.scale(-1)
    assert left.stop == right.start
    assert (-1 in left, -1 in right) == (True, False)
    assert IntervalSet([left, right]) == IntervalSet([Interval(0, 2)]).scale(-1)


def test_a_factor_of_zero_leaves_one_instant() -> None:
    """Everything is mapped to the point about which one scales, and nothing to nothing."""
    assert FOREVER.scale(0, about=2) == Interval.instant(2)
    assert Interval(3, 3).scale(0, about=2).is_empty
    assert IntervalSet([(0, 1), (2, INF)]).scale(0) == IntervalSet([Interval.instant(0)])
    assert IntervalSet().scale(0) == IntervalSet()


def test_forever_stays_forever() -> None:
    """No shift and no factor but 0 moves an infinite end."""
    assert FOREVER.shift(1e308) == FOREVER.scale(1e-300, about=-7) == FOREVER.scale(-3) == FOREVER
    assert Interval(3, INF).scale(-1) == Interval(-INF, math.nextafter(-3, INF))


def test_overflow_ends_at_infinity() -> None:
    """An image beyond the largest float lies at inf, and is not lost."""
    assert INF in Interval(1e308, 1.1e308).scale(10)
    assert -INF in Interval(1e308, 1.1e308).scale(-10)
    assert -INF in Interval(-1, 1e308).scale(-10)
    assert INF in Interval.instant(1.7e308).shift(1.7e308)
    assert INF in Interval.instant(INF).scale(0.5)


def test_intervals_are_drawn_as_in_mathematics() -> None:
    """Whole numbers without a point, an infinite start with a round bracket, an empty set as braces."""
    assert repr(Interval(1, 3)) == "[1, 3)"
    assert repr(Interval(-0.5, 1e20)) == "[-0.5, 1e+20)"
    assert repr(FOREVER) == "(-inf, inf)"
    assert repr(Interval(-0.0, INF)) == "[0, inf)"
    assert repr(IntervalSet([(1, 3), (-INF, 0)])) == "{(-inf, 0), [1, 3)}"
    assert repr(IntervalSet()) == "{}"


def test_ends_are_floats() -> None:
    """Integers and NumPy's scalars become floats; -0.0 becomes 0.0, so that equal intervals look equal."""
    span = Interval(np.float32(0.5), np.int64(2))
    assert (type(span.start), type(span.stop)) == (float, float)
    assert math.copysign(1, Interval(-0.0, 1).start) == 1
    assert hash(Interval(0, 1)) == hash(Interval(-0.0, 1.0))


def test_values_do_not_change_and_survive_a_copy() -> None:
    """Nothing can be set; copies and pickles are equal."""
    span, times = Interval(0, 1), IntervalSet([(0, 1), (2, 3)])
    for thing, name in ((span, "start"), (times, "_ends"), (times, "other")):
        with pytest.raises(AttributeError):
            setattr(thing, name, 5.0)
    with pytest.raises(AttributeError):
        del times._ends
    assert pickle.loads(pickle.dumps(span)) == copy.deepcopy(span) == span
    assert pickle.loads(pickle.dumps(times)) == copy.deepcopy(times) == times
    assert {span: 1, times: 2}[Interval(0, 1)] == 1


def test_a_set_is_true_where_it_holds_something() -> None:
    """`if touched:` reads as one would say it."""
    assert IntervalSet([(0, 1)])
    assert not IntervalSet([(1, 1)])


@pytest.mark.parametrize("bad", [math.nan, "1", b"1", None, 1j, [1], 10**400])
def test_what_is_no_time_is_refused(bad: Any) -> None:
    """NaN first of all, and text, even where float() would take it."""
    with pytest.raises(TimeError):
        Interval(bad, 5)
    with pytest.raises(TimeError):
        Interval(0, bad)
    with pytest.raises(TimeError):
        Interval.instant(bad)
    with pytest.raises(TimeError):
        Interval(0, 1).shift(bad)
    with pytest.raises(TimeError):
        IntervalSet().scale(bad)
    with pytest.raises(TimeError):
        IntervalSet([(bad, 5)])


def test_nan_is_in_no_interval_and_asking_so_is_an_error() -> None:
    """A NaN time is a mistake, not a time outside."""
    with pytest.raises(TimeError):
        assert math.nan in FOREVER
    with pytest.raises(TimeError):
        assert math.nan in IntervalSet()


@pytest.mark.parametrize("amount", [INF, -INF])
def test_infinite_movements_are_refused(amount: float) -> None:
    """They have no meaning: inf - inf is not a time."""
    for thing in (Interval(0, 1), IntervalSet([(0, 1)]), IntervalSet()):
        with pytest.raises(TimeError):
            thing.shift(amount)
        with pytest.raises(TimeError):
            thing.scale(amount)
        with pytest.raises(TimeError):
            thing.scale(1, about=amount)


def test_the_wrong_way_round_is_refused_with_the_right_one_as_a_hint() -> None:
    """The message carries both ends, the note the interval that was meant."""
    with pytest.raises(TimeError, match="cannot stop at 1, before it starts at 3") as caught:
        Interval(3, 1)
    assert caught.value.__notes__ == ["hint: did you mean Interval(1, 3)?"]


@pytest.mark.parametrize("bad", [5, (1,), (1, 2, 3), None, "12x"])
def test_a_piece_that_is_no_interval_is_refused(bad: Any) -> None:
    """The message shows what was given."""
    with pytest.raises(TimeError, match="expected an interval or a pair"):
        IntervalSet([bad])


def test_a_lone_interval_is_no_set_of_them() -> None:
    """It has to be put in a list, and the note says so."""
    with pytest.raises(TimeError, match="alone"):
        IntervalSet(Interval(0, 1))  # type: ignore[arg-type]


def test_other_things_do_not_combine() -> None:
    """Operators refuse what is neither an interval nor a set, as Python's own sets do."""
    for thing in (Interval(0, 1), IntervalSet([(0, 1)])):
        for combine in (operator.and_, operator.or_, operator.sub):
            for other in (5, None, (0, 1)):
                with pytest.raises(TypeError):
                    combine(thing, other)
                with pytest.raises(TypeError):
                    combine(other, thing)
    assert IntervalSet() != ()


def test_combining_walks_along_both_sets_once() -> None:
    """
    Counted in comparisons, the work for sets of n pieces each grows as n.

        a  [ )  [ )  [ )  [ )
        b    [ )  [ )  [ )  [ )
    """
    counts = []
    for size in (100, 200):
        a, b = (IntervalSet([(k + start, k + start + 0.3) for k in range(size)]) for start in (0.0, 0.5))
        calls = 0

        def keep(x: bool, y: bool) -> bool:
            nonlocal calls
            calls += 1
            return x or y

        assert len(intervals._combined(a, b, keep)) == 2 * size
        counts.append(calls)
    assert counts == [400, 800]
