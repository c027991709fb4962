"""Easings: how far along a change is at a given share of its time.

An **easing** takes the unit interval to the line, 0 to 0 and 1 to 1 exactly, without a jump; before 0 it stays 0 and
after 1 it stays 1. Each comes in three forms that agree: for a float (`math`), for an array (NumPy), and as a slope,
its derivative.

One base curve makes a family of three::

    in_X(u)     = f(u)                            starts slowly
    out_X(u)    = 1 - f(1 - u)                    ends slowly
    in_out_X(u) = f(2u) / 2            u < 1/2    both: in and out at half their size
                  1 - f(2 - 2u) / 2    u ≥ 1/2

The plain names "in", "out", "in_out" are the family of f(u) = (3u² - u³) / 2, the first half of the smooth cubic
3u² - 2u³ (smoothstep), which is their "in_out". These curves lie within 0.03 of the ease-in, ease-out and ease-in-out
of CSS; "in" ends, and "out" starts, with the slope 3/2 and no curvature, so that it joins a straight movement.

The others are Penner's curves (2002), with two differences: expo and elastic have the envelope (2^10u - 1) / 1023,
which begins at 0 where Penner's begins with a jump of 0.001; and back and elastic keep the rule above for in_out.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import reduce
from numbers import Real
from typing import Any, Literal, TypeAlias, cast, final, get_args, overload

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError, hint, unknown

__all__ = ["EASINGS", "Ease", "EaseName", "Easing", "easing"]

Array: TypeAlias = NDArray[np.float64]

# fmt: off
EaseName: TypeAlias = Literal[
    "linear", "in", "out", "in_out",
    "in_sine", "out_sine", "in_out_sine",
    "in_quad", "out_quad", "in_out_quad",
    "in_cubic", "out_cubic", "in_out_cubic",
    "in_quart", "out_quart", "in_out_quart",
    "in_quint", "out_quint", "in_out_quint",
    "in_expo", "out_expo", "in_out_expo",
    "in_circ", "out_circ", "in_out_circ",
    "in_back", "out_back", "in_out_back",
    "in_elastic", "out_elastic", "in_out_elastic",
    "in_bounce", "out_bounce", "in_out_bounce",
]
# fmt: on
Ease: TypeAlias = EaseName | Callable[[float], float]


@final
@dataclass(frozen=True, slots=True, repr=False)
class Easing:
    """An easing as a value: called with a float it answers a float, with an array an array of the same shape.

    >>> ease = easing("in_out")
    >>> ease(0.25), ease(np.array([0.0, 0.25, 1.0]))
    (0.15625, array([0.     , 0.15625, 1.     ]))
    """

    name: str
    scalar: Callable[[float], float] = field(compare=False)  # for one float, without the choice that a call makes
    array: Callable[[Array], Array] = field(compare=False)  # for an array of any shape
    slope: Callable[[float], float] | None = field(compare=False)  # derivative, 0 outside of [0, 1]; None: not known
    function: Callable[[float], float] | None = None  # what the user gave

    @overload
    def __call__(self, u: float) -> float: ...
    @overload
    def __call__(self, u: Array) -> Array: ...
    def __call__(self, u: float | Array) -> float | Array:
        """How far along at `u`: a float for a float, an array of float64 for an array of any shape."""
        return self.array(u) if isinstance(u, np.ndarray) else self.scalar(float(u))

    def __repr__(self) -> str:
        return f"easing({self.name!r})" if self.function is None else f"easing({self.name})"

    def __reduce__(self) -> tuple[Any, ...]:
        return easing, (self.name if self.function is None else self.function,)


def easing(ease: Ease | Easing | str) -> Easing:
    """The easing of that name, or one made of a function of a float.

    Args:
        ease: one of `EASINGS`, or a function that is called for 0 < u < 1 only, one float at a time: at the ends an
            easing is exactly 0 and 1, whatever the function says. An `Easing` is answered as it is.

    Raises:
        UnknownNameError: nobody knows the name.
        ShapeError: neither a name nor a function; later, where the function answers no finite number.

    >>> easing("in")(0.5), easing("in_cubic")(0.5), easing(lambda u: u**4)(0.5)
    (0.3125, 0.125, 0.0625)
    """
    if isinstance(ease, Easing):
        return ease
    if isinstance(ease, str):
        found = _NAMED.get(ease)
        if found is None:
            raise unknown(ease, EASINGS, what="easing")
        return found
    if not callable(ease):
        error = ShapeError(f"expected the name of an easing or a function of a float, got {ease!r}")
        raise hint(error, 'ease="in_out", or ease=lambda u: u * u')
    return _made_of(ease)


def _made_of(function: Callable[[float], float]) -> Easing:
    name = getattr(function, "__qualname__", None) or repr(function)

    def scalar(u: float) -> float:
        if not 0.0 < u < 1.0:
            return _end(u)
        answer: Any = function(u)
        try:
            share = float(answer) if isinstance(answer, Real) else math.nan
        except OverflowError:
            share = math.inf
        if not math.isfinite(share):
            raise ShapeError(f"the easing {name} answered {answer!r} for {u!r}, expected a finite number")
        return share

    def array(us: Array) -> Array:
        return np.array([scalar(u) for u in us.ravel().tolist()], dtype=np.float64).reshape(us.shape)

    return Easing(name, scalar, array, None, function)


def _end(u: float) -> float:
    """An easing outside of the open unit interval; NaN stays NaN."""
    return u if u != u else float(u >= 1.0)


# Each curve is written once, for 0 ≤ u ≤ 1, and `m` is either `math` or NumPy.
_Curve: TypeAlias = Callable[[Any, Any], Any]
_Slope: TypeAlias = Callable[[float], float]


def _smooth(u: Any, _: Any) -> Any:
    return u * u * (1.5 - 0.5 * u)


def _smooth_slope(u: float) -> float:
    return u * (3.0 - 1.5 * u)


def _power(exponent: int) -> tuple[_Curve, _Slope]:
    return lambda u, _: u**exponent, lambda u: exponent * u ** (exponent - 1)


def _sine(u: Any, m: Any) -> Any:
    return 2.0 * m.sin(u * (math.pi / 4)) ** 2  # 1 - cos(uπ/2), without its cancellation


def _sine_slope(u: float) -> float:
    return (math.pi / 2) * math.sin(u * (math.pi / 2))


_DOUBLINGS = 10 * math.log(2)


def _expo(u: Any, m: Any) -> Any:
    return m.expm1(u * _DOUBLINGS) / 1023.0


def _expo_slope(u: float) -> float:
    return _DOUBLINGS / 1023.0 * math.exp(u * _DOUBLINGS)


def _circ(u: Any, m: Any) -> Any:
    return u * u / (1.0 + m.sqrt(1.0 - u * u))  # 1 - √(1 - u²), without its cancellation


def _circ_slope(u: float) -> float:
    return u / math.sqrt(1.0 - u * u) if u < 1.0 else math.inf


_DRAW = 1.70158  # draws back by a tenth of the way (Penner)


def _back(u: Any, _: Any) -> Any:
    return u * u * ((_DRAW + 1.0) * u - _DRAW)


def _back_slope(u: float) -> float:
    return u * (3.0 * (_DRAW + 1.0) * u - 2.0 * _DRAW)


_SWING = 20 * math.pi / 3  # radians: three swings and a third


def _elastic(u: Any, m: Any) -> Any:
    return _expo(u, m) * m.cos(_SWING * (1.0 - u))


def _elastic_slope(u: float) -> float:
    phase = _SWING * (1.0 - u)
    return _expo_slope(u) * math.cos(phase) + _expo(u, math) * _SWING * math.sin(phase)


# The arches of a ball that bounces, told backwards from the first fall: (middle, height there). Its unit of time is the
# first fall, its unit of length the depth of that. Each arch is the highest parabola where it is above the ground.
_ARCHES = ((0.0, 1.0), (1.5, 0.25), (2.25, 0.0625), (2.625, 0.015625))


def _bounce(u: Any, m: Any) -> Any:
    rest = 2.75 * (1.0 - u)
    heights = [height - (rest - middle) * (rest - middle) for middle, height in _ARCHES]
    return max(heights) if m is math else reduce(np.maximum, heights)


def _bounce_slope(u: float) -> float:
    rest = 2.75 * (1.0 - u)
    _, middle = max((height - (rest - middle) ** 2, middle) for middle, height in _ARCHES)
    return 5.5 * (rest - middle)


def _easing(name: str, curve: _Curve, slope: _Slope) -> Easing:
    """The three forms of a curve, completed outside of the unit interval."""

    def scalar(u: float) -> float:
        return curve(u, math) if 0.0 < u < 1.0 else _end(u)

    def array(us: Array) -> Array:
        inside = curve(np.clip(us, 0.0, 1.0, dtype=np.float64), np)
        return np.where(us <= 0.0, 0.0, np.where(us >= 1.0, 1.0, inside))

    def inner_slope(u: float) -> float:
        return slope(u) if 0.0 <= u <= 1.0 else u * 0.0

    return Easing(name, scalar, array, inner_slope)


def _family(suffix: str, f: _Curve, slope: _Slope) -> list[Easing]:
    """What `in`, `out` and `in_out` make of a base curve."""

    def out(u: Any, m: Any) -> Any:
        return 1.0 - f(1.0 - u, m)

    def both(u: Any, m: Any) -> Any:
        if m is math:
            return 0.5 * f(2.0 * u, m) if u < 0.5 else 1.0 - 0.5 * f(2.0 - 2.0 * u, m)
        half = 0.5 * f(2.0 * np.minimum(u, 1.0 - u), m)
        return cast(Any, np.where(u < 0.5, half, 1.0 - half))

    return [
        _easing(f"in{suffix}", f, slope),
        _easing(f"out{suffix}", out, lambda u: slope(1.0 - u)),
        _easing(f"in_out{suffix}", both, lambda u: slope(2.0 * min(u, 1.0 - u))),
    ]


_NAMED: dict[str, Easing] = {
    made.name: made
    for made in (
        _easing("linear", lambda u, _: u, lambda u: 1.0),
        *_family("", _smooth, _smooth_slope),
        *_family("_sine", _sine, _sine_slope),
        *_family("_quad", *_power(2)),
        *_family("_cubic", *_power(3)),
        *_family("_quart", *_power(4)),
        *_family("_quint", *_power(5)),
        *_family("_expo", _expo, _expo_slope),
        *_family("_circ", _circ, _circ_slope),
        *_family("_back", _back, _back_slope),
        *_family("_elastic", _elastic, _elastic_slope),
        *_family("_bounce", _bounce, _bounce_slope),
    )
}

EASINGS: tuple[EaseName, ...] = get_args(EaseName)
"""All names, in the order of their families."""
