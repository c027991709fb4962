"""How far something that runs steadily stays what it is: the ends are exact, to the last float.

First the floats about where a change is expected are tried, else the floating point numbers themselves are bisected.
`stays(t)` must be true on one interval round the asked time and false outside of it, as far as it is searched.
"""

import math
import struct
from collections.abc import Callable, Iterable

__all__ = ["end", "start"]

INF = math.inf
_LARGEST = math.nextafter(INF, 0.0)


def _key(x: float) -> int:
    """Floats in their order, as whole numbers without gaps."""
    (n,) = struct.unpack("<q", struct.pack("<d", x))
    return n if n >= 0 else -(n & 0x7FFFFFFFFFFFFFFF)


def _float(n: int) -> float:
    (x,) = struct.unpack("<d", struct.pack("<q", n if n >= 0 else -n | -0x8000000000000000))
    return x


def end(stays: Callable[[float], bool], t: float, hi: float, crossings: Iterable[float] = ()) -> float:
    """The first time after `t` at which it is no longer what it is at `t`, at most `hi`."""
    after = math.nextafter(t, INF)
    if after >= hi or not stays(after):
        return min(after, hi)
    last = math.nextafter(hi, -INF) if hi < INF else _LARGEST
    for crossing in sorted(crossings):
        if t < crossing < last:
            good = _near(stays, crossing, t, last)
            if good is not None:
                return good
    if stays(last):
        return hi
    good, bad = _key(after), _key(last)
    while bad - good > 1:
        middle = (good + bad) // 2
        if stays(_float(middle)):
            good = middle
        else:
            bad = middle
    return _float(bad)


def _near(stays: Callable[[float], bool], crossing: float, t: float, last: float) -> float | None:
    """The change, if it lies within a few floats of where it should: the first time at which it is another."""
    key = _key(crossing)
    low = max(_float(key - 3), math.nextafter(t, INF))
    if low > last or not stays(low):
        return None
    for n in range(_key(low) + 1, key + 4):
        at = _float(n)
        if at > last:
            return None
        if not stays(at):
            return at
    return None


def start(stays: Callable[[float], bool], t: float, lo: float, crossings: Iterable[float] = ()) -> float:
    """The earliest time, at least `lo`, from which it is what it is at `t`."""
    # The end, where time runs the other way.
    hi = math.nextafter(-lo, INF)
    found = end(lambda x: stays(-x), -t, hi, [-crossing for crossing in crossings])
    if found < hi:
        return math.nextafter(-found, INF) + 0.0
    return lo if lo > -INF or stays(lo) else -_LARGEST  # an end is never infinite itself, a beginning may be
