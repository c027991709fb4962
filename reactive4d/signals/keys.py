"""Keys as a signal: control points in time that one edits, with an interpolation between them.

While all values are known, keys are a source: they answer by themselves, and an edit says which span it touches. As
soon as some value is a signal they are computed: the values are asked for at the asked time, and then mixed. A signal
that has no weight at that time is not asked, and the answer holds where the weights and what was asked hold.
"""

import math
import weakref
from bisect import bisect_right
from collections.abc import Callable, Iterator, Mapping, MutableMapping
from typing import Any, TypeVar, final, overload

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.engine import Engine, moment, narrow
from reactive4d.engine.kinds import SOURCE
from reactive4d.errors import ShapeError, hint
from reactive4d.signals.colors import is_color_name
from reactive4d.signals.curves import Curve, Extrapolation, Key, Kind
from reactive4d.signals.curves.controls import key_time
from reactive4d.signals.curves.mixtures import Known, Mixture, Mixtures
from reactive4d.signals.curves.spaces import Colors, Held, Numbers, Rotations, Space, Vectors
from reactive4d.signals.easings import Ease, Easing
from reactive4d.signals.facade import Signal
from reactive4d.signals.lines import Line
from reactive4d.signals.rotations import Rotation, slerp
from reactive4d.signals.settables import Settable

__all__ = ["Keys", "Points", "keys"]

T = TypeVar("T")
INF = math.inf
Array = NDArray[np.float64]


class Keys(Settable[T]):
    """Editable control points: `keys(...).points[2.0] = v`, `del k.points[2.0]`, `k.move(2.0, 3.0)`; made by `keys`.

    What they say is an immutable `curve`; an edit puts another one in its place.

    >>> k = keys({0: 0.0, 2: 10.0})
    >>> k.at(1.0), k.valid(1.0).is_instant, k.valid(5.0)
    (5.0, True, [2, inf))
    >>> k.points[2] = 20
    >>> k.at(1.0), dict(k.points)
    (10.0, {0.0: 0.0, 2.0: 20})
    """

    __slots__ = ("_companions",)

    content: Curve

    def __init__(self, curve: Curve, *, name: str | None = None, engine: Engine | None = None) -> None:
        # Signals that are made of the same curve and edited along with it.
        self._companions: weakref.WeakSet[Settable[Any]] = weakref.WeakSet()
        if engine is None:
            values: list[Any] = [key.value for key in curve.keys]
            engine = next((value.engine for value in values if isinstance(value, Signal)), None)
        super().__init__(curve, name=name or "keys", engine=engine)

    # -- what one edits --------------------------------------------------------------------------------------------

    @property
    def curve(self) -> Curve:
        """What the keys say, as a value."""
        return self.content

    @curve.setter
    def curve(self, curve: Curve) -> None:
        self.set_content(curve if curve.unknowns is Signal else curve.with_settings(unknowns=Signal))

    @property
    def points(self) -> "Points":
        """The times of the keys and their values, in the order of time; a mapping that one edits."""
        return Points(self)

    @points.setter
    def points(self, points: Mapping[Any, Any]) -> None:
        self.set_content(self.content.with_points(points))

    def key(self, t: float) -> Key:
        """The key at `t`, with all that it says besides its value.

        Raises:
            KeyError: there is none.
        """
        return self.points._key(t)  # pyright: ignore[reportPrivateUsage]

    def move(self, t: float, to: float) -> None:
        """Move the key at `t` to the time `to`, past other keys if need be.

        Raises:
            TimeError: there is no key at `t`, or another one at `to`.

        >>> k = keys({0: 0.0, 2: 10.0})
        >>> k.move(2, 4)
        >>> k.at(1.0)
        2.5
        """
        self.set_content(self.content.moved(t, to))

    def change(self, **settings: Any) -> None:
        """Put the same keys under other settings: interpolation, ease, before, after, degree, kind.

        >>> k = keys({0: 0.0, 2: 10.0})
        >>> k.change(interpolation="step")
        >>> k.at(1.0)
        0.0
        """
        self.set_content(self.content.with_settings(**settings))

    def set_content(self, content: Curve) -> None:
        """Put another curve in place of this one; only the spans that differ are touched."""
        companions = list(self._companions)
        if not companions:
            super().set_content(content)
            return
        with self.engine.transaction():
            super().set_content(content)
            for companion in companions:
                companion.set_content(content)

    def accompany(self, companion: Settable[Any]) -> None:
        """Edit a signal that is made of the same curve along with this one, as long as somebody holds it."""
        self._companions.add(companion)

    # -- what the engine asks --------------------------------------------------------------------------------------

    def adopt(self) -> None:
        """Be a source while all values are known, else computed."""
        if self.content.is_live:
            self._be_computed()
        else:
            self._be_source()

    def sample(self, t: float) -> tuple[float, float, Any]:
        """What the curve says."""
        return self.content.sample(t)

    def sample_many(self, ts: Array) -> Any:
        """What the curve says at many times."""
        return self.content.sample_many(ts)

    def _batch(self, times: Any, parameters: dict[str, Any]) -> Any:
        # What `batch` does with a source, without the steps that a plain array of times does not need.
        if type(times) is np.ndarray and times.dtype == np.float64 and times.ndim == 1 and not parameters:
            total = times.dot(times)
            if total == total and self.kind == SOURCE and self.engine.owner is None:
                return freeze(self.content.sample_many(times))
        return super()._batch(times, parameters)

    def difference(self, old: Curve, new: Curve) -> list[tuple[float, float]]:
        """The spans that differ; where only the words do, an instant, so that the new ones are kept."""
        spans = old.difference(new)
        if spans or old is new or old.same(new):
            return spans
        t = next((t for t in (*old.times, *new.times) if (t in old.times) != (t in new.times)), new.times[0])
        return [(t, math.nextafter(t, INF))]

    def rule(self) -> Any:
        """Ask the values that have a weight now, and mix them."""
        assert self.own is not None
        curve: Curve = self.own.note()
        if not curve.is_live:
            return curve.at(moment())
        lo, hi, mixture = curve.sample(moment())
        narrow(lo, hi)
        return mixed(curve.space, [(term, weight, _read(term)) for term, weight in mixture.terms.items()])

    def many(self, ts: Array, ask: Callable[[Any, Array], Any]) -> Any:
        """The answers at many times: each signal is asked once, for the times at which it has a weight."""
        mixtures: list[Mixture] = [self.content.at(t) for t in ts.tolist()]
        where: dict[Any, list[int]] = {}
        for i, mixture in enumerate(mixtures):
            for term in mixture.terms:
                where.setdefault(term, []).append(i)
        values: list[dict[Any, Any]] = [{} for _ in mixtures]
        for term, indices in where.items():
            answers: Any = [term.answer] * len(indices) if isinstance(term, Known) else ask(term, ts[indices])
            for i, answer in zip(indices, answers.tolist() if _is_row(answers) else answers, strict=True):
                values[i][term] = answer
        space = self.content.space
        found = [
            mixed(space, [(term, weight, known[term]) for term, weight in mixture.terms.items()])
            for mixture, known in zip(mixtures, values, strict=True)
        ]
        if all(type(value) is float for value in found):
            return np.array(found)
        if all(type(value) is np.ndarray and value.shape == found[0].shape for value in found):
            return np.stack(found)
        return tuple(found)

    def straight(self, t: float) -> Line | None:
        """How numbers run steadily round `t`, for comparisons; only inside of an evaluation."""
        if self.content.is_live:
            return None
        curve: Curve = self.note()
        if not isinstance(curve.space, Numbers):
            return None
        i = bisect_right(curve.breaks, t)
        piece = curve.piece(i)
        if piece.is_held:
            lo, hi, value = curve.sample(t)
            return Line(lo, hi, _constantly(value), 0.0, 0.0, value)
        if len(piece.controls) != 2 or piece.ease is not None or piece.clock is not None:
            return None
        a, b = piece.controls
        outer = i in (0, len(curve.breaks))
        origin = (curve.times[0] if i == 0 else curve.times[-1]) if outer else piece.lo
        slope = b if outer else (b - a) / (piece.hi - piece.lo)
        if not math.isfinite(slope) or slope == 0.0:
            return None
        return Line(piece.lo, piece.hi, _steadily(a, slope, origin), 0.0, slope, a - slope * origin)


def _constantly(value: float) -> Callable[[float], float]:
    return lambda t: value


def _steadily(a: float, slope: float, origin: float) -> Callable[[float], float]:
    # As the curve itself computes it, to the last bit.
    return lambda t: a + slope * (t - origin)


def _read(term: Any) -> Any:
    return term.answer if isinstance(term, Known) else term.now()


def _is_row(answers: Any) -> bool:
    """Whether these are numbers, one for each time."""
    return type(answers) is np.ndarray and answers.ndim == 1


def mixed(space: Space, parts: list[tuple[Any, float, Any]]) -> Any:
    """What terms with weights and values make together.

    Raises:
        ShapeError: a value that does not go together with the others.
    """
    inner = space.inner if isinstance(space, Mixtures) else space
    if inner is None:
        inner = _space_of_answers([value for _, _, value in parts])
    try:
        points = [term.point if isinstance(term, Known) else inner.point(value) for term, _, value in parts]
    except ShapeError as error:
        raise hint(error, "all values of keys are of one kind; kind= tells which") from None
    if len(parts) == 1 and parts[0][1] == 1.0:
        term, _, value = parts[0]
        return term.answer if isinstance(term, Known) else inner.exact(value, points[0])
    if isinstance(inner, Held):
        raise hint(ShapeError(f"nothing lies between {parts[0][2]!r} and {parts[-1][2]!r}"), "interpolation='step'")
    if isinstance(inner, Rotations):
        return slerp(points[0], points[1], parts[1][1])
    total = sum((point * weight for point, (_, weight, _) in zip(points, parts, strict=True)), start=0.0)
    return inner.answer(total)


def _space_of_answers(values: list[Any]) -> Space:
    """The space of values whose kind nobody told."""
    value = values[0]
    if type(value) is np.ndarray:
        return Vectors(value.shape)
    if isinstance(value, int | float) and not isinstance(value, bool):
        return Numbers()
    if isinstance(value, Rotation):
        return Rotations()
    if all(isinstance(text, str) and is_color_name(text) for text in values):
        return Colors()
    return Held()


@final
class Points(MutableMapping[float, Any]):
    """The keys as a mapping of times to values, in the order of time; setting, adding and deleting edits them.

    A bare value keeps the ease, handles and tension of the key that it replaces; a `Key` replaces all.

    >>> k = keys({0: 0.0, 2: 10.0})
    >>> k.points[1] = 3.0
    >>> del k.points[0]
    >>> k.points
    Points({1.0: 3.0, 2.0: 10.0})
    """

    __slots__ = ("_keys",)

    def __init__(self, keys: Keys[Any]) -> None:
        self._keys = keys

    def _key(self, t: float) -> Key:
        curve = self._keys.content
        t = key_time(t)
        try:
            return curve.keys[curve.times.index(t)]
        except ValueError:
            near = min(curve.times, key=lambda time: abs(time - t))
            raise hint(KeyError(t), f"there is no key at {t!r} s; the nearest one stands at {near!r} s") from None

    def __getitem__(self, t: float) -> Any:
        return self._key(t).value

    def __setitem__(self, t: float, value: Any) -> None:
        self._keys.set_content(self._keys.content.with_point(t, value))

    def __delitem__(self, t: float) -> None:
        self._key(t)
        self._keys.set_content(self._keys.content.without_point(t))

    def __iter__(self) -> Iterator[float]:
        return iter(self._keys.content.times)

    def __len__(self) -> int:
        return len(self._keys.content.times)

    def update(self, points: Any = (), /, **named: Any) -> None:
        """Set several keys at once: one edit."""
        curve = self._keys.content
        times: dict[Any, Any] = dict(points, **named)
        for t, value in times.items():
            curve = curve.with_point(t, value)
        self._keys.set_content(curve)

    def __repr__(self) -> str:
        return f"Points({dict(self)!r})"


@overload
def keys(
    points: Mapping[float, float] | Mapping[int, float],
    *,
    ease: Ease | Easing = ...,
    interpolation: str | None = ...,
    kind: Kind | None = ...,
    before: Extrapolation = ...,
    after: Extrapolation = ...,
    degree: int = ...,
    name: str | None = ...,
) -> Keys[float]: ...
@overload
def keys(
    points: Mapping[Any, tuple[float, ...]] | Mapping[Any, Array] | Mapping[Any, Signal[Array]],
    *,
    ease: Ease | Easing = ...,
    interpolation: str | None = ...,
    kind: Kind | None = ...,
    before: Extrapolation = ...,
    after: Extrapolation = ...,
    degree: int = ...,
    name: str | None = ...,
) -> Keys[Array]: ...
@overload
def keys(
    points: Mapping[Any, Any],
    *,
    ease: Ease | Easing = ...,
    interpolation: str | None = ...,
    kind: Kind | None = ...,
    before: Extrapolation = ...,
    after: Extrapolation = ...,
    degree: int = ...,
    name: str | None = ...,
) -> Keys[Any]: ...
def keys(
    points: Mapping[Any, Any],
    *,
    ease: Ease | Easing = "linear",
    interpolation: str | None = None,
    kind: Kind | None = None,
    before: Extrapolation = "hold",
    after: Extrapolation = "hold",
    degree: int = 3,
    name: str | None = None,
) -> Keys[Any]:
    """A signal of control points: times in seconds, with the values there.

    Args:
        points: times to values, or to `Key`s where a value does not say enough. All values are of one kind: numbers,
            vectors of one shape, `Rotation`s, colours; anything else is held. A value may itself be a signal: it is
            asked at the asked time, and then interpolated.
        ease: how each span is run through, by name or as a function of its share of time; a `Key`'s own comes first.
        interpolation: "step", "linear", "slerp", "hermite", "catmull_rom" (over the key times, or with "_uniform",
            "_centripetal", "_chordal"), "bezier", "bspline", "tcb". Without it: linear; slerp for rotations; step for
            what is held.
        kind: of the values, "number", "vector", "rotation", "color" or "held", where it cannot be found out.
        before: what is before the first key: "hold", "linear", "cycle", "cycle_offset" or "oscillate". A cycle begins
            at a key's time with the first value; the last key itself is met only at its own time.
        after: what is after the last key.
        degree: of a B-spline.
        name: for errors and the graph.

    Returns:
        Keys, which answer floats, arrays, rotations, four sRGB floats, or the objects themselves.

    Raises:
        TimeError: no keys, or a time that is NaN, infinite, or there twice.
        ShapeError: values that do not go together, or not with the interpolation.
        UnknownNameError: an interpolation, extrapolation, kind or ease that nobody knows.

    >>> keys({0: (0, 0, 0), 1: (2, 0, 0)}, ease="in_out").at(0.25)
    array([0.3125, 0.    , 0.    ])
    """
    curve = Curve(
        points,
        interpolation=interpolation,
        kind=kind,
        ease=ease,
        before=before,
        after=after,
        degree=degree,
        unknowns=Signal,
    )
    return Keys(curve, name=name)
