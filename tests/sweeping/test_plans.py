"""Plans walk through every point once, in nested loops; spans share places out; orders cost the least."""

import itertools
import math
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from reactive4d.sweeping.orders import Reader, best_order, cost, readers_of
from reactive4d.sweeping.plans import Plan, plan_of
from reactive4d.sweeping.spans import Spans

SHAPES = st.lists(st.integers(1, 5), min_size=0, max_size=4)


@st.composite
def plans(draw: Any) -> Plan:
    """Any grid, any order, blocks of any size."""
    shape = tuple(draw(SHAPES))
    order = tuple(draw(st.permutations(range(len(shape)))))
    return plan_of(shape, order, draw(st.integers(1, 700)))


@given(plans(), st.integers(1, 50))
def test_tiles_cover_every_point_once_in_the_order_of_the_loops(plan: Plan, limit: int) -> None:
    """A tile has at most so many points, and lies in one block."""
    seen: list[tuple[int, ...]] = []
    place = 0
    while place < plan.size:
        ranges, end = plan.tile(place, plan.size, limit)
        assert 1 <= end - place <= limit
        blocks = {plan.span(p)[1] for p in range(place, end)}
        assert len(blocks) == 1
        inside = list(itertools.product(*[range(*ranges[d]) for d in plan.order]))
        assert len(inside) == end - place
        seen += inside
        place = end
    assert seen == list(itertools.product(*[range(plan.shape[d]) for d in plan.order]))


@given(plans())
def test_a_place_and_its_index_lead_to_each_other(plan: Plan) -> None:
    """And a block is a run of places."""
    for place in range(plan.size):
        assert plan.place(plan.index(place)) == place
        ranges, start, stop = plan.span(place)
        assert start <= place < stop
        assert stop - start == math.prod([hi - lo for lo, hi in ranges])
        assert all(lo <= i < hi for i, (lo, hi) in zip(plan.index(place), ranges, strict=True))


@given(st.lists(st.integers(0, 40), min_size=1, max_size=4), st.integers(1, 5), st.randoms())
def test_every_place_is_given_to_somebody_once(sizes: list[int], lanes: int, chance: Any) -> None:
    """Whoever takes and gives back whatever, in any order."""
    gaps: list[tuple[int, int]] = []
    place = 0
    for size in sizes:
        gaps.append((place, place + size))
        place += size + 3
    spans = Spans([gap for gap in gaps if gap[0] < gap[1]], lanes)
    seen: list[int] = []
    while True:
        lane = chance.randrange(lanes)
        taken = spans.take(lane)
        if taken is None:
            break
        stop = chance.randint(taken[0] + 1, taken[1])
        seen += range(taken[0], stop)
        spans.give_back(lane, stop, taken[1])
    assert sorted(seen) == [p for gap in gaps for p in range(*gap)]


def test_neighbours_stay_together() -> None:
    """Each of two lanes takes its own half, from its beginning."""
    spans = Spans([(0, 100)], 2)
    assert [spans.take(lane) for lane in (0, 1, 0, 1)] == [(0, 25), (50, 75), (25, 38), (75, 88)]


@given(st.lists(st.tuples(st.sets(st.integers(0, 3)), st.floats(1e-6, 10.0)), max_size=6), st.integers(1, 9))
def test_no_order_costs_less_than_the_best(readers: list[tuple[set[int], float]], size: int) -> None:
    """But for a tenth, for which the order that was given is not left."""
    shape = (size, 3, 2, 7)
    told = [Reader(frozenset(dimensions), seconds) for dimensions, seconds in readers]
    merged: dict[frozenset[int], float] = {}
    for reader in told:
        merged[reader.dimensions] = merged.get(reader.dimensions, 0.0) + reader.seconds
    best = cost(best_order(shape, told), shape, merged)
    assert all(0.9 * best <= 1.001 * cost(order, shape, merged) for order in itertools.permutations(range(4)))


def test_what_only_cheap_cells_read_goes_inside() -> None:
    """A dear cell reads a, a cheap one a and b: b is the inner loop, whichever was named first."""
    dear, cheap = Reader(frozenset({1}), 1.0), Reader(frozenset({0, 1}), 1e-3)
    assert best_order((100, 10), [dear, cheap]) == (1, 0)
    assert best_order((100, 10), [Reader(frozenset({0}), 1.0), cheap]) == (0, 1)


def test_with_nothing_to_choose_time_is_the_innermost_loop() -> None:
    """So that what needs its own past is asked forwards."""
    assert best_order((3, 4, 5), [Reader(frozenset({0, 1, 2}), 1.0)], time=0) == (1, 2, 0)


def test_what_cells_read_is_derived_from_what_they_were_asked() -> None:
    """Parameters directly and through others, and time where the answer does not hold for ever."""
    import reactive4d as r4

    a, b = r4.Parameter("a", 1.0), r4.Parameter("b", 1.0)
    fa = r4.lift(lambda x: x + 1)(a)
    measure = r4.lift(lambda x, y, z: x + y + z)(fa, b, r4.keys({0: 0.0, 1: 1.0}))
    measure.at(0.5)
    found = readers_of([measure], {"a": 0, "b": 1}, time=2)
    assert sorted([sorted(reader.dimensions) for reader in found]) == [[0], [0, 1, 2]]
