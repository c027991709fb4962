"""The stamps of a source: for every time, a number that names what the source says there.

Two moments at which a source has the same stamp at `t` are two moments at which it says the same at `t`. Stamps are
compared for equality, never for age, so a source that gets an old content back gets the old stamps back with it.
"""

from bisect import bisect_left, bisect_right

__all__ = ["Stamps", "assigned", "piece"]

INF = float("inf")

# One stamp for all times, or (starts, stamps): the first start is -inf.
Stamps = int | tuple[tuple[float, ...], tuple[int, ...]]


def piece(stamps: Stamps, t: float) -> tuple[float, float, int]:
    """The span round `t` that has one stamp: (lo, hi, stamp)."""
    if isinstance(stamps, int):
        return -INF, INF, stamps
    starts, values = stamps
    i = bisect_right(starts, t) - 1
    return starts[i], starts[i + 1] if i + 1 < len(starts) else INF, values[i]


def assigned(stamps: Stamps, lo: float, hi: float, new: Stamps) -> Stamps:
    """The stamps with those of `new` over [lo, hi)."""
    if lo == -INF and hi == INF:
        return new
    starts, values = ((-INF,), (stamps,)) if isinstance(stamps, int) else stamps
    news, numbers = ((-INF,), (new,)) if isinstance(new, int) else new
    first, last = bisect_left(starts, lo), bisect_left(starts, hi)
    a, b = bisect_right(news, lo) - 1, bisect_left(news, hi)
    inner = (lo, *news[a + 1 : b])
    after = () if hi == INF or (last < len(starts) and starts[last] == hi) else (hi,)
    tail = () if not after else (values[last - 1],)
    return _merged(
        starts[:first] + inner + after + starts[last:],
        values[:first] + numbers[a:b] + tail + values[last:],
    )


def _merged(starts: tuple[float, ...], values: tuple[int, ...]) -> Stamps:
    kept = [i for i in range(len(starts)) if i == 0 or values[i] != values[i - 1]]
    if len(kept) == 1:
        return values[0]
    return tuple(starts[i] for i in kept), tuple(values[i] for i in kept)
