"""Where two curves may answer differently: what an edit touches.

Most edits leave most keys as they are, so the pieces of the common beginning and end are not even looked at: a piece
depends on the keys of its own neighbourhood alone. What remains is compared piece by piece. Two pieces agree where both
hold the same value, or if they are the same polynomial over the same span.
"""

import math
from collections.abc import Iterator
from itertools import compress, count
from operator import is_not
from typing import TYPE_CHECKING, TypeAlias

from reactive4d.signals.curves.extrapolations import FOLDS
from reactive4d.signals.curves.pieces import Piece
from reactive4d.signals.curves.spaces import Space
from reactive4d.signals.easings import Easing

if TYPE_CHECKING:
    from reactive4d.signals.curves.curve import Curve

__all__ = ["difference", "first_difference"]

Span: TypeAlias = tuple[float, float]
INF = math.inf


def difference(old: "Curve", new: "Curve") -> list[Span]:
    """The times at which the two curves may answer differently, as disjoint half-open spans in order.

    Never misses one; what it names beyond need is at most where two ways to compute one value differ in the last bits.

    >>> from reactive4d.signals.curves.curve import Curve
    >>> curve = Curve({0: 0.0, 1: 5.0, 2: 3.0, 3: 4.0})
    >>> difference(curve, curve.with_point(1, 6.0))
    [(0.0, 2.0)]
    """
    if old is new:
        return []
    if old.is_live != new.is_live:
        return [(-INF, INF)]  # the same keys, once known and once not, are computed in different ways
    folding = old.before in FOLDS or old.after in FOLDS or new.before in FOLDS or new.after in FOLDS
    spans: list[Span] = []
    doubtful: list[Span] = []
    for span, a, b in _overlaps(*_pieces(old, new)):
        if not (a.controls or b.controls):
            doubtful.append(span)
        elif not _agree(a, b, old.space, new.space):
            spans.append(span)
    # What repeats the keys is the same only if all of them are.
    if folding and doubtful and (spans or not _same_ends(old, new) or not _same_modes(old, new)):
        spans = sorted(spans + doubtful)
    if "bspline" in (old.interpolation, new.interpolation):
        # A B-spline meets its first and its last key to the last bit, and the others only nearly.
        ends = {old.times[0], old.times[-1]} ^ {new.times[0], new.times[-1]}
        spans = sorted(spans + [(t, math.nextafter(t, INF)) for t in ends if not any(a <= t < b for a, b in spans)])
    return _joined(spans)


def first_difference(old: "Curve", new: "Curve") -> float | None:
    """The break from which on two curves are cut into other pieces; None, if they are made of the same ones.

    What adds up pieces is rounded differently if they are cut differently, even where they answer the same.
    """
    if old is new or old.same(new):
        return None
    if old.is_live != new.is_live:
        return -INF
    for i in range(min(len(old.breaks), len(new.breaks)) + 1):
        a, b = old.piece(i), new.piece(i)
        is_cut_alike = a.lo == b.lo and a.hi == b.hi
        if not is_cut_alike or not a.controls or not b.controls or not _agree(a, b, old.space, new.space):
            return min(a.lo, b.lo)
    return None


def _same_ends(old: "Curve", new: "Curve") -> bool:
    return (
        old.times[0] == new.times[0]
        and old.times[-1] == new.times[-1]
        and old.space.kind == new.space.kind
        and old.space.same(old.values[-1], new.values[-1])
    )


def _same_modes(old: "Curve", new: "Curve") -> bool:
    return old.before == new.before and old.after == new.after


def _joined(spans: list[Span]) -> list[Span]:
    joined: list[Span] = []
    for lo, hi in spans:
        if joined and joined[-1][1] == lo:
            joined[-1] = (joined[-1][0], hi)
        else:
            joined.append((lo, hi))
    return joined


def _pieces(old: "Curve", new: "Curve") -> tuple[list[Piece], list[Piece]]:
    """The pieces that may differ, and both ends."""
    shared_before, shared_after = 0, 0
    reach = old.reach
    if reach is not None and old.settings == new.settings:
        shared_before = max(0, _common(old, new, step=1) - 1 - reach)
        shared_after = max(0, _common(old, new, step=-1) - 1 - reach)
        # Edits in the middle of equal keys may be counted from both ends.
        shared_after = min(shared_after, min(len(old.times), len(new.times)) - 1 - shared_before)
        shared_after = max(0, shared_after)
    found: list[list[Piece]] = []
    for curve in (old, new):
        last = len(curve.breaks)
        inner = range(1 + shared_before, last - shared_after)
        found.append([curve.piece(i) for i in (0, *inner, last)])
    return found[0], found[1]


def _common(old: "Curve", new: "Curve", *, step: int) -> int:
    """How many keys are the same, from the beginning (step 1) or from the end (step -1)."""
    shorter = min(len(old.keys), len(new.keys))
    a, b = old.keys[::step], new.keys[::step]
    found = next(compress(count(), map(is_not, a, b)), shorter)
    s, t = old.times[::step], new.times[::step]
    return next((k for k in range(found) if s[k] != t[k]), found) if s[:found] != t[:found] else found


def _overlaps(before: list[Piece], after: list[Piece]) -> Iterator[tuple[Span, Piece, Piece]]:
    """Every span over which neither of the two changes its piece, with both pieces; no common gaps."""
    i = j = 0
    while i < len(before) and j < len(after):
        a, b = before[i], after[j]
        lo, hi = max(a.lo, b.lo), min(a.hi, b.hi)
        if lo < hi:
            yield (lo, hi), a, b
        if a.hi <= b.hi:
            i += 1
        if b.hi <= a.hi:
            j += 1


def _agree(a: Piece, b: Piece, old: Space, new: Space) -> bool:
    """Whether two pieces answer the same over all of their overlap."""
    if old.kind != new.kind or a.is_held != b.is_held or len(a.controls) != len(b.controls):
        return False
    if not a.is_held and (a.lo != b.lo or a.hi != b.hi or a.clock != b.clock or not _same_ease(a.ease, b.ease)):
        return False
    return all(old.same(x, y) for x, y in zip(a.controls, b.controls, strict=True))


def _same_ease(a: Easing | None, b: Easing | None) -> bool:
    return a is b or (a is not None and b is not None and a.function is not None and a.function is b.function)
