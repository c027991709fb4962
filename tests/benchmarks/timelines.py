"""A moving source for the benchmarks: numbers at times, straight lines between, held where two neighbours are equal."""

import math
from bisect import bisect_right

from reactive4d.engine import Source

__all__ = ["Track", "with_value"]

Content = tuple[tuple[float, ...], tuple[float, ...]]  # times, values


class Track(Source):
    """Its content is a pair of tuples, the times and the values."""

    def sample(self, t: float) -> tuple[float, float, float]:
        times, values = self.content
        i = bisect_right(times, t)
        if i == 0:
            return -math.inf, times[0], values[0]
        if i == len(times):
            return times[-1], math.inf, values[-1]
        start, stop = times[i - 1], times[i]
        one, other = values[i - 1], values[i]
        if one == other:
            return start, stop, one
        return t, math.nextafter(t, math.inf), one + (other - one) * ((t - start) / (stop - start))

    def difference(self, old: Content, new: Content) -> list[tuple[float, float]]:
        """One span: from the last key before the first that differs to the first key after the last."""
        before = list(zip(*old, strict=True))
        after = list(zip(*new, strict=True))
        if before == after:
            return []
        shorter = min(len(before), len(after))
        head = next((i for i in range(shorter) if before[i] != after[i]), shorter)
        tail = next((i for i in range(shorter - head) if before[-1 - i] != after[-1 - i]), shorter - head)
        start = before[head - 1][0] if head else -math.inf
        stop = before[-tail][0] if tail else math.inf
        return [(start, stop)]


def with_value(content: Content, index: int, value: float) -> Content:
    """The content with another value at one key."""
    times, values = content
    return times, (*values[:index], value, *values[index + 1 :])
