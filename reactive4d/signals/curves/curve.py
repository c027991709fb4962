"""A curve: keys in the order of time, and all that lies before, between and after them. An immutable value."""

from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Mapping
from typing import Any, Final, final

import numpy as np

from reactive4d.errors import ShapeError, TimeError, hint, unknown
from reactive4d.signals.curves import bsplines
from reactive4d.signals.curves.bernstein import Array
from reactive4d.signals.curves.borders import EASED, check_key, check_together, in_order, kept, point_of_key
from reactive4d.signals.curves.controls import Key, key_time
from reactive4d.signals.curves.interpolations import INTERPOLATIONS, Interpolation, Line
from reactive4d.signals.curves.kinds import space_of
from reactive4d.signals.curves.mixtures import Mixtures
from reactive4d.signals.curves.pieces import STEADY, Piece, Sample
from reactive4d.signals.curves.samplers import sampler
from reactive4d.signals.curves.spaces import Colors, Numbers, Space
from reactive4d.signals.curves.spans import inner_piece, outer_piece
from reactive4d.signals.easings import Ease, Easing, easing

__all__ = ["Curve"]

_DEFAULTS: Final = {"held": "step", "rotation": "slerp"}


@final
class Curve:
    """A value for every time, given by keys.

    Args:
        points: times in seconds, to values or `Key`s; in any order.
        interpolation: how to go from key to key, one of `INTERPOLATIONS`. Without it: linear; slerp for rotations; step
            for held values.
        kind: of the values, one of `KINDS`; without it, found out from all of them.
        ease: how each span is run through, unless its first key says otherwise.
        before: what holds before the first key, one of `EXTRAPOLATIONS`.
        after: what holds after the last one.
        degree: of a B-spline; fewer keys than degree + 1 lower it.
        unknowns: values of this type are not known yet: where there are any, the curve answers with a `Mixture` of its
            keys' values.

    Raises:
        TimeError: no keys; a time that is NaN, infinite, or there twice.
        ShapeError: values that do not go together, or not with the interpolation.
        UnknownNameError: an interpolation, extrapolation, kind or ease that nobody knows.

    >>> curve = Curve({0: 1.0, 2: 3.0})
    >>> curve.at(0.5), curve.at(5.0), curve.sample(5.0)
    (1.5, 3.0, (2.0, inf, 3.0))

    A piece lasts from one *break* to the next: from key to key, or from knot to knot of a B-spline. Piece 0 lies before
    the first break, the last one after the last. Pieces are worked out when they are first asked.
    """

    __slots__ = (
        "_batch",
        "_offset",
        "_pieces",
        "_straight",
        "_table",
        "after",
        "before",
        "breaks",
        "degree",
        "ease",
        "interpolation",
        "keys",
        "knots",
        "line",
        "rule",
        "space",
        "times",
        "unknowns",
        "values",
    )

    times: tuple[float, ...]
    keys: tuple[Key, ...]
    values: tuple[Any, ...]  # the keys' values as points of the space
    space: Space
    interpolation: str
    ease: Easing
    before: str
    after: str
    degree: int
    unknowns: type | None
    rule: Interpolation
    line: Line
    knots: list[float] | None  # of a B-spline
    breaks: tuple[float, ...]  # where one piece ends and the next begins
    _pieces: list[Piece | None]
    _table: list[Any]  # per piece: a sample where it is held, a sampler, or None before it was asked
    _batch: Any
    _straight: tuple[Array, Array] | tuple[()] | None
    _offset: Any

    def __init__(
        self,
        points: Mapping[Any, Any] | Iterable[tuple[Any, Any]],
        *,
        interpolation: str | None = None,
        kind: str | None = None,
        ease: Ease | Easing | None = None,
        before: str = "hold",
        after: str = "hold",
        degree: int = 3,
        unknowns: type | None = None,
    ) -> None:
        times, keys = in_order(points)
        raw = [key.value for key in keys]
        known = [(t, value) for t, value in zip(times, raw, strict=True) if not _is_unknown(value, unknowns)]
        space: Space | None = None
        if known or kind is not None:
            space = space_of([t for t, _ in known], [value for _, value in known], kind=kind)
        if space is None or len(known) < len(raw):
            assert unknowns is not None
            space = Mixtures(space, unknowns)
        name = interpolation or _DEFAULTS.get(space.kind, "linear")
        if name not in INTERPOLATIONS:
            raise unknown(name, INTERPOLATIONS, what="interpolation")
        if type(degree) is not int or degree < 1:
            raise ShapeError(f"degree: expected a whole number, at least 1, got {degree!r}")
        rule = INTERPOLATIONS[name]
        check_together(space, rule, (before, after))
        put = object.__setattr__
        put(self, "space", space)
        put(self, "interpolation", name)
        put(self, "ease", easing("linear" if ease is None else ease))
        put(self, "before", before)
        put(self, "after", after)
        put(self, "degree", degree)
        put(self, "unknowns", unknowns)
        put(self, "rule", rule)
        if not rule.eased and self.ease is not STEADY:
            raise hint(ShapeError(f"an ease has no effect on {name!r}"), EASED)
        self._settle(times, list(map(kept, keys)), [self._point(t, value) for t, value in zip(times, raw, strict=True)])
        for t, key in zip(times, keys, strict=True):
            self._check(t, key)

    def _settle(self, times: list[float], keys: list[Key], values: list[Any]) -> None:
        put = object.__setattr__
        put(self, "times", tuple(times))
        put(self, "keys", tuple(keys))
        put(self, "values", tuple(values))
        put(self, "line", Line(times, values, keys, self.space))
        breaks, knots = times, None
        if self.rule.span is None:
            knots = bsplines.knots(times, self.bspline_degree)
            breaks = sorted(set(knots))
        put(self, "breaks", tuple(breaks))
        put(self, "knots", knots)
        put(self, "_pieces", [None] * (len(breaks) + 1))
        put(self, "_table", [None] * (len(breaks) + 1))
        put(self, "_batch", None)
        put(self, "_straight", None)
        put(self, "_offset", None)

    @property
    def is_live(self) -> bool:
        """Whether some value is not known yet, so that answers are mixtures."""
        return isinstance(self.space, Mixtures)

    @property
    def bspline_degree(self) -> int:
        """The degree that the keys are enough for."""
        return min(self.degree, len(self.times) - 1)

    def _point(self, t: float, value: Any) -> Any:
        return point_of_key(self.space, self.rule, t, value=value)

    def _check(self, t: float, key: Key) -> None:
        check_key(self.space, self.rule, t, key=key)

    # ---- asking ----

    def at(self, t: float) -> Any:
        """The value at one time.

        >>> Curve({0: 0.0, 1: 10.0}, ease="in_out").at(0.5)
        5.0
        """
        return self.sample(t)[2]

    def sample(self, t: float) -> Sample:
        """Where the answer at `t` holds, `[lo, hi)` with `t` in it, and the answer.

        Held and equal neighbours hold together; what moves holds for the instant.

        >>> Curve({0: "red", 2: "ready"}).sample(1.0)
        (-inf, 2.0, 'red')
        """
        found = self._table[bisect_right(self.breaks, t)]
        if found.__class__ is tuple:
            return found
        if found is None:
            found = self._prepare(bisect_right(self.breaks, t))
            if found.__class__ is tuple:
                return found
        return found(t)

    def sample_many(self, ts: Array) -> Any:
        """The values at many times: (N,) or (N, ...); a tuple of N for rotations and held values.

        Agrees with one by one to 1e-12 of the values' scale, exactly where a value is held and at the keys.

        Args:
            ts: (N,) seconds, in any order.

        >>> Curve({0: 0.0, 1: 10.0}).sample_many(np.array([-1.0, 0.25, 2.0])).tolist()
        [0.0, 2.5, 10.0]
        """
        straight = self._straight
        if straight is None:
            straight = self._straighten()
        if straight:
            return np.interp(ts, straight[0], straight[1])
        return self._all().sample_many(ts)

    # ---- editing ----

    def with_point(self, t: float, value: Any) -> "Curve":
        """The same curve with this value at `t`, where there may be a key already.

        A bare value keeps the ease, handles and tension of the key that it replaces; a `Key` replaces all. A curve that
        would say the same is this very curve.

        >>> Curve({0: 1.0, 2: 3.0}).with_point(1, 5.0)
        Curve({0.0: 1.0, 1.0: 5.0, 2.0: 3.0})
        """
        t = key_time(t)
        k = bisect_left(self.times, t)
        there = k < len(self.times) and self.times[k] == t
        old = self.keys[k] if there else None
        key = value if isinstance(value, Key) else old.with_value(value) if old else Key(value)
        if old is not None and key.same(old):
            return self
        if self.is_live or _is_unknown(key.value, self.unknowns):
            return self._restated(dict(zip(self.times, self.keys, strict=True)) | {t: key})
        key, point = kept(key), self._point(t, key.value)
        self._check(t, key)
        times, keys, values = list(self.times), list(self.keys), list(self.values)
        if there:
            keys[k], values[k] = key, point
        else:
            times.insert(k, t)
            keys.insert(k, key)
            values.insert(k, point)
        return self._edited(times, keys, values)

    def without_point(self, t: float) -> "Curve":
        """The same curve without the key at `t`.

        Raises:
            TimeError: there is no key at `t`, or no other.
        """
        k = self._index(t)
        if len(self.times) == 1:
            raise hint(TimeError(f"the key at {t!r} s is the only one"), "a curve needs a key; set another one first")
        times, keys, values = list(self.times), list(self.keys), list(self.values)
        del times[k], keys[k], values[k]
        if self.is_live:
            return self._restated(zip(times, keys, strict=True))
        return self._edited(times, keys, values)

    def with_settings(self, **settings: Any) -> "Curve":
        """The same keys under other settings: interpolation, ease, before, after, degree, kind.

        >>> Curve({0: 1.0, 2: 3.0}).with_settings(interpolation="step").at(1.0)
        1.0
        """
        return self._restated(zip(self.times, self.keys, strict=True), **settings)

    def with_points(self, points: Mapping[Any, Any]) -> "Curve":
        """Other keys under the same settings.

        >>> Curve({0: 1.0, 2: 3.0}, ease="in").with_points({0: 4.0})
        Curve({0.0: 4.0}, ease='in')
        """
        return self._restated(points)

    def _restated(self, points: Mapping[Any, Any] | Iterable[tuple[Any, Any]], **settings: Any) -> "Curve":
        inner = self.space.inner if isinstance(self.space, Mixtures) else self.space
        usual: dict[str, Any] = {name: getattr(self, name) for name in _SETTINGS}
        told: dict[str, Any] = usual | {"kind": inner.kind if inner else None} | settings
        return Curve(points, **told)

    def moved(self, t: float, to: float) -> "Curve":
        """The same curve with the key at `t` moved to the time `to`, past other keys if need be.

        Raises:
            TimeError: there is no key at `t`, or another one at `to`.
        """
        k = self._index(t)
        to = key_time(to)
        if to == self.times[k]:
            return self
        times, keys, values = list(self.times), list(self.keys), list(self.values)
        key, point = keys[k], values[k]
        del times[k], keys[k], values[k]
        j = bisect_left(times, to)
        if j < len(times) and times[j] == to:
            raise hint(TimeError(f"there is a key at {to!r} s already"), "delete it first, or move it away")
        times.insert(j, to)
        keys.insert(j, key)
        values.insert(j, point)
        return self._edited(times, keys, values)

    def _edited(self, times: list[float], keys: list[Key], values: list[Any]) -> "Curve":
        new = object.__new__(Curve)
        for name in ("space", "interpolation", "ease", "before", "after", "degree", "unknowns", "rule"):
            object.__setattr__(new, name, getattr(self, name))
        new._settle(times, keys, values)
        return new

    def _index(self, t: float) -> int:
        k = bisect_left(self.times, t)
        if k < len(self.times) and self.times[k] == t:
            return k
        near = min(self.times, key=lambda time: abs(time - t))
        raise hint(TimeError(f"there is no key at {t!r} s"), f"the nearest one stands at {near!r} s")

    # ---- comparing ----

    def same(self, other: "Curve") -> bool:
        """Whether two curves say the same in the same words; such curves answer the same everywhere."""
        return self is other or (
            self.times == other.times
            and self.settings == other.settings
            and all(a is b or a.same(b) for a, b in zip(self.keys, other.keys, strict=True))
            and all(a is b or self.space.same(a, b) for a, b in zip(self.values, other.values, strict=True))
        )

    @property
    def settings(self) -> tuple[Any, ...]:
        """All but the keys: kind, interpolation, degree, ease, before, after."""
        degree = self.degree if self.rule.span is None else None
        ease = self.ease.function or self.ease
        return self.space.kind, self.interpolation, degree, ease, self.before, self.after

    @property
    def reach(self) -> int | None:
        """How many keys beyond its own two a span depends on, on each side; None where pieces are not spans."""
        return None if self.rule.span is None else self.rule.reach

    def piece(self, i: int) -> Piece:
        """Piece i, between breaks i - 1 and i; held where it holds. Pieces 0 and `len(breaks)` lie outside of the keys.

        Outside, a piece that goes on straight has the end point and the velocity as its controls, and one that repeats
        the keys has none.
        """
        found = self._pieces[i]
        if found is None:
            found = self._pieces[i] = outer_piece(self, i) if i in (0, len(self.breaks)) else inner_piece(self, i)
        return found

    def difference(self, other: "Curve") -> list[tuple[float, float]]:
        """The times at which this curve and another may answer differently: disjoint half-open spans in order."""
        from reactive4d.signals.curves.differences import difference

        return difference(self, other)

    # ---- the pieces ----

    def cycle_offset(self) -> Any:
        """What one cycle adds to the next: the vector from the first value to the last."""
        if self._offset is None:
            object.__setattr__(self, "_offset", self.space.difference(self.values[0], self.values[-1]))
        return self._offset

    # ---- asking, prepared ----

    def _prepare(self, i: int) -> Any:
        """Fill the table at piece i: one sample for a held value and its equal neighbours, else a function."""
        piece = self.piece(i)
        if not piece.is_held:
            made = self._table[i] = sampler(self, i)
            return made
        value = piece.controls[0]
        alike = self.space.same
        start = stop = i
        while start > 0 and (before := self.piece(start - 1)).is_held and alike(before.controls[0], value):
            start -= 1
        while stop < len(self.breaks) and (after := self.piece(stop + 1)).is_held and alike(after.controls[0], value):
            stop += 1
        sample = (self.piece(start).lo, self.piece(stop).hi, self.answer(value))
        for k in range(start, stop + 1):
            self._table[k] = sample
        return sample

    def answer(self, point: Any) -> Any:
        """What the curve answers where it is at a point of its space; at a key exactly the key's value."""
        if isinstance(self.space, Colors):
            for key, value in zip(self.keys, self.values, strict=True):
                if value is point:
                    return self.space.exact(key.value, point)
        return self.space.answer(point)

    def _straighten(self) -> tuple[Array, Array] | tuple[()]:
        """Times and values for NumPy's own linear interpolation, where it is what the curve does."""
        straight: tuple[Array, Array] | tuple[()] = ()
        if (
            isinstance(self.space, Numbers)
            and self.interpolation == "linear"
            and self.before == self.after == "hold"
            and self.ease is STEADY
            and all(key.ease is None or easing(key.ease) is STEADY for key in self.keys)
        ):
            times, values = np.array(self.times), np.array(self.values)
            with np.errstate(over="ignore"):
                if len(times) < 2 or np.isfinite(np.diff(values) / np.diff(times)).all():
                    straight = times, values
        object.__setattr__(self, "_straight", straight)
        return straight

    def _all(self) -> Any:
        if self._batch is None:
            from reactive4d.signals.curves.batches import Batch

            object.__setattr__(self, "_batch", Batch(self))
        return self._batch

    # ---- as a value ----

    def __setattr__(self, name: str, value: Any) -> None:
        raise hint(
            AttributeError(f"a Curve cannot be changed: {name}"), "with_point, without_point and moved make others"
        )

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"a Curve cannot be changed: {name}")

    def __reduce__(self) -> tuple[Any, ...]:
        settings = {name: getattr(self, name) for name in _SETTINGS} | {"kind": self.space.kind}
        return _restore, (self.times, self.keys, settings)

    def __repr__(self) -> str:
        points = ", ".join(
            f"{t!r}: {key.value if key.is_bare else key!r}" for t, key in zip(self.times, self.keys, strict=True)
        )
        usual = _DEFAULTS.get(self.space.kind, "linear")
        told = [f"interpolation={self.interpolation!r}"] if self.interpolation != usual else []
        told += [f"ease={self.ease.name!r}"] if self.ease is not STEADY else []
        told += [
            f"{side}={mode!r}" for side, mode in (("before", self.before), ("after", self.after)) if mode != "hold"
        ]
        return f"Curve({{{points}}}{''.join(', ' + text for text in told)})"


_SETTINGS: Final = ("interpolation", "ease", "before", "after", "degree", "unknowns")


def _restore(times: Any, keys: Any, settings: dict[str, Any]) -> Curve:
    return Curve(zip(times, keys, strict=True), **settings)


def _is_unknown(value: Any, unknowns: type | None) -> bool:
    return unknowns is not None and isinstance(value, unknowns)
