"""Maps of time: what is pulled back never claims too much, and what an edit touches is never missed."""

import math
import sys
from collections.abc import Iterator
from itertools import islice

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st
from models import INF

from reactive4d.engine import Affine, Fixed
from reactive4d.errors import TimeError

LATEST = sys.float_info.max

scales = st.one_of(
    st.sampled_from([1.0, -1.0, 2.0, 0.5, -0.5, 0.1, 3.0, -3.0, 1e-3, 1e3]),
    st.floats(1e-6, 1e6) | st.floats(-1e6, -1e-6),
)
offsets = st.one_of(st.sampled_from([0.0, 1.0, -1.0, 0.1, 1e9]), st.floats(-1e9, 1e9))
maps = st.builds(Affine, scales, offsets)
times = st.floats(-1e12, 1e12)
ends = times | st.sampled_from([INF, -INF])


def forward(affine: Affine, t: float) -> float:
    """Where a reader reads; the end of time is the largest float."""
    return min(affine.forward(min(t, LATEST)), LATEST)


def holds(lo: float, hi: float, t: float) -> bool:
    """Whether [lo, hi) holds t."""
    return lo <= t < hi


def near(t: float) -> Iterator[float]:
    """A time and its nearest neighbours on both sides."""
    yield t
    for end in (INF, -INF):
        neighbour = t
        for _ in range(6):
            neighbour = math.nextafter(neighbour, end)
            yield neighbour


def inside(lo: float, hi: float) -> list[float]:
    """Times in [lo, hi): its ends and their neighbours, and some between."""
    first, last = max(lo, -LATEST), min(math.nextafter(hi, -INF), LATEST)
    between = [first + (last / 8 - first / 8) * i for i in range(1, 8)]
    candidates = [lo, last, *between, *islice(near(first), 13), *islice(near(last), 13)]
    return [t for t in candidates if holds(lo, hi, t)]


@given(maps, ends, ends, times)
@example(Affine(0.1, 0.3), 0.0, 1.0, 2.0)
@example(Affine(-1.0, 4.0), -INF, 1.0, 3.5)
@example(Affine(1e-6, 1e9), 1e9, math.nextafter(1e9, INF), 0.0)
def test_what_is_pulled_back_never_claims_too_much(affine: Affine, a: float, b: float, t: float) -> None:
    """Every time of the pulled interval reads inside of the interval that was read, and the asked time is in it."""
    at = forward(affine, t)
    lo, hi = min(a, b, at), max(a, b)
    if not holds(lo, hi, at):
        hi = math.nextafter(at, INF)
    start, stop = affine.pull(lo, hi, t)
    assert holds(start, stop, t)
    for s in inside(start, stop):
        assert holds(lo, hi, forward(affine, s)), (start, stop, s)


@given(maps, ends, ends, times)
@example(Affine(0.1, 0.3), 0.0, 1.0, 7.0)
@example(Affine(-3.0, 0.1), 0.0, 1.0, 0.0)
@example(Affine(1.0, -1.0), 2.0, INF, INF)
def test_what_an_edit_touches_is_never_missed(affine: Affine, a: float, b: float, t: float) -> None:
    """Whoever reads inside of the interval is in its preimage: tried at random, and round the ends."""
    lo, hi = min(a, b), max(a, b)
    assume(lo < hi)
    spans = affine.preimage(lo, hi)
    candidates = [t, INF, -INF]
    for end in (lo, hi):
        if math.isfinite(end):
            candidates.extend(near((end - affine.offset) / affine.scale))
    for s in candidates:
        if holds(lo, hi, forward(affine, s)):
            assert any(holds(x, y, min(s, LATEST)) for x, y in spans), s


@given(maps, times, st.floats(1e-3, 1e6))
def test_a_preimage_is_no_larger_than_rounding_makes_it(affine: Affine, lo: float, length: float) -> None:
    """Marks stay where they belong: a preimage is as long as the interval over the scale, but for a few roundings."""
    hi = lo + length
    assume(lo < hi)
    ((start, stop),) = affine.preimage(lo, hi)
    exact = (hi - lo) / abs(affine.scale)
    slack = 64 * (
        math.ulp(max(abs(lo), abs(hi), abs(affine.offset))) / abs(affine.scale) + math.ulp(max(abs(start), 1))
    )
    assert exact - slack <= stop - start <= exact + slack


@given(maps, times, times, times)
def test_what_is_pulled_back_lies_in_the_preimage(affine: Affine, a: float, b: float, t: float) -> None:
    """Validity is never wider than staleness: else an edit could miss a part of what it made stale."""
    at = forward(affine, t)
    lo, hi = min(a, at), max(b, math.nextafter(at, INF))
    start, stop = affine.pull(lo, hi, t)
    ((first, last),) = affine.preimage(lo, hi)
    assert first <= start
    assert stop <= last


@pytest.mark.parametrize("shift", [0.1, -1.0, 1e-9, 1e9])
def test_an_instant_is_pulled_back_to_an_instant(shift: float) -> None:
    """What holds at one moment only, holds for one moment of the reader."""
    affine = Affine(1.0, shift)
    for t in (0.0, 0.3, -7.7):
        at = affine.forward(t)
        assert affine.pull(at, math.nextafter(at, INF), t) == (t, math.nextafter(t, INF))


@pytest.mark.parametrize("affine", [Affine(1.0, -1.0), Affine(-1.0, 4.0), Affine(0.5, 3.0), Affine(-3.0, 0.1)])
def test_for_ever_stays_for_ever(affine: Affine) -> None:
    """Both ways; and half of time stays half of it, mirrored where time runs backwards."""
    assert affine.pull(-INF, INF, 1.0) == (-INF, INF)
    assert affine.preimage(-INF, INF) == [(-INF, INF)]
    lo, hi = affine.pull(-INF, 1e6, 0.0)
    assert (lo == -INF) == (affine.scale > 0.0)
    assert (hi == INF) == (affine.scale < 0.0)


@pytest.mark.parametrize("t", [0.0, 1.5, -INF, INF])
def test_a_fixed_time_is_read_from_everywhere(t: float) -> None:
    """It holds for ever, and is touched everywhere or nowhere."""
    fixed = Fixed(t)
    at = min(t, LATEST)
    assert fixed.forward(123.0) == at
    assert fixed.pull(at, math.nextafter(at, INF), 7.0) == (-INF, INF)
    assert fixed.preimage(-INF, INF) == [(-INF, INF)]
    assert fixed.preimage(at, math.nextafter(at, INF)) == [(-INF, INF)]
    if math.isfinite(t):
        assert fixed.preimage(t + 1.0, t + 2.0) == fixed.preimage(t - 2.0, t) == []


def test_equal_maps_are_one_map() -> None:
    """A link is not made longer by a map that it has already."""
    assert Affine(2.0, 1.0) == Affine(2.0, 1.0)
    assert len({Affine(2.0, 1.0), Affine(2.0, 1.0), Fixed(1.0), Fixed(1.0), Affine(2.0, 0.0)}) == 3


@pytest.mark.parametrize(("scale", "offset"), [(0.0, 1.0), (math.nan, 0.0), (INF, 0.0), (1.0, INF), (1.0, math.nan)])
def test_a_map_without_an_inverse_is_refused(scale: float, offset: float) -> None:
    """The message says what was given, the hint what to use instead."""
    with pytest.raises(TimeError, match="Affine: expected finite numbers, scale not 0") as caught:
        Affine(scale, offset)
    assert caught.value.__notes__ == ["hint: to read at one fixed time use Fixed(t)"]


def test_a_very_slow_map_does_not_claim_minus_infinity() -> None:
    """What lies too far for a float lies outside all the same: -inf is read at -inf."""
    slow = Affine(1e-300, 0.0)
    lo, hi = slow.pull(-1e10, 1e10, 0.0)
    assert lo > -math.inf
    assert -1e10 <= slow.forward(lo) < 1e10
    assert hi == math.inf
