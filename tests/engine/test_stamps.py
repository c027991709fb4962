"""The stamps of a source: a piecewise constant map from time to number, against a list of numbers."""

import math
from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st
from models import INF

from reactive4d.engine.stamps import Stamps, assigned, piece

quarters = st.integers(-8, 8).map(lambda n: n / 4)
ends = quarters | st.sampled_from([-INF, INF])
numbers = st.integers(1, 5)
edits = st.lists(st.tuples(ends, ends, numbers), max_size=12)
PROBES = [-INF, *(n / 8 for n in range(-20, 21)), 1e300]


def stamped(history: list[tuple[float, float, int]]) -> tuple[Stamps, dict[float, int]]:
    """The stamps after some edits, and what the probes should say."""
    stamps: Stamps = 0
    model = dict.fromkeys(PROBES, 0)
    for a, b, number in history:
        lo, hi = min(a, b), max(a, b)
        if lo < hi:
            stamps = assigned(stamps, lo, hi, number)
            model |= {t: number for t in PROBES if lo <= t < hi}
    return stamps, model


@given(edits)
def test_every_time_has_the_stamp_of_the_last_edit_that_touched_it(history: list[tuple[float, float, int]]) -> None:
    """And `piece` tells a span round it that has that stamp throughout."""
    stamps, model = stamped(history)
    for t in PROBES:
        lo, hi, number = piece(stamps, t)
        assert lo <= t < hi
        assert number == model[t]
        assert all(model[s] == number for s in PROBES if lo <= s < hi)


@given(edits)
def test_stamps_are_kept_in_the_fewest_pieces(history: list[tuple[float, float, int]]) -> None:
    """Neighbours differ; one stamp for all times is just a number; the first piece starts at -inf."""
    stamps, _ = stamped(history)
    if isinstance(stamps, int):
        return
    starts, values = stamps
    assert starts[0] == -INF
    assert all(a < b for a, b in pairwise(starts))
    assert len(values) == len(starts) > 1
    assert all(a != b for a, b in pairwise(values))


@given(edits, edits, ends, ends)
def test_old_stamps_are_brought_back_over_one_span(
    history: list[tuple[float, float, int]], later: list[tuple[float, float, int]], a: float, b: float
) -> None:
    """What an undo does: inside the span everything as it was, outside as it is."""
    lo, hi = min(a, b), max(a, b)
    if lo == hi:
        return
    old, old_model = stamped(history)
    new, new_model = stamped([*history, *later])
    mixed = assigned(new, lo, hi, old)
    for t in PROBES:
        expected = old_model[t] if lo <= t < hi else new_model[t]
        assert piece(mixed, t)[2] == expected
        assert piece(mixed, t)[0] <= t < piece(mixed, t)[1]


def test_an_instant_has_a_stamp_of_its_own() -> None:
    """The smallest of edits."""
    after = math.nextafter(1.0, INF)
    stamps = assigned(1, 1.0, after, 2)
    assert piece(stamps, 1.0) == (1.0, after, 2)
    assert piece(stamps, math.nextafter(1.0, -INF)) == (-INF, 1.0, 1)
    assert piece(stamps, after) == (after, INF, 1)
