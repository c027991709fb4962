"""Warps as trees: at which time a signal is read, for every time at which one asks."""

import math
from collections.abc import Callable, Sequence
from typing import Any, Final

from reactive4d.engine import Affine
from reactive4d.signals.maps import Creep, Discrete, Hold, Repeat, SlowInOut
from reactive4d_widgets.lowering.terms import NUMBER, NotExactError, Term, applied, constant, written

__all__ = ["followed_time", "mapped_time"]

_TIME: Final = written(["time"], NUMBER)


def mapped_time(time_map: Any) -> Term:
    """The time that a fixed map reads.

    Raises:
        NotExactError: a map that is not known.

    >>> mapped_time(Affine(2.0, 1.0)).tree
    ['+', ['*', 2.0, ['time']], 1.0]
    """
    if isinstance(time_map, Affine):
        return _affine(constant(time_map.scale), constant(time_map.offset))
    if isinstance(time_map, Repeat):
        return _repeat(constant(time_map.period), constant(time_map.start))
    if isinstance(time_map, Hold):
        ends = (time_map.before, time_map.after)
        return _hold(*[None if math.isinf(end) else constant(end) for end in ends])
    if isinstance(time_map, Creep):
        return _creep(constant(time_map.start), constant(time_map.stop), constant(time_map.speed))
    if isinstance(time_map, SlowInOut):
        ends = (time_map.start, time_map.stop, time_map.slow_in, time_map.slow_out)
        return _slow_in_out(*map(constant, ends))
    if isinstance(time_map, Discrete):
        return _discrete(constant(time_map.fps))
    raise NotExactError(f"the map of time {time_map!r}")


def followed_time(kind: str, parameters: Sequence[Term]) -> Term:
    """The time that a map reads whose parameters are terms.

    Args:
        kind: "warp", "delay", "stretch" and so on.
        parameters: in the order in which the warp takes them.

    Raises:
        NotExactError: a map that is not known.
    """
    make = _FOLLOWED.get(kind)
    if make is None or any(part.shape != NUMBER and part.value is not None for part in parameters):
        raise NotExactError(f"the map of time {kind}")
    return make(*parameters)


def _of(operator: str, *parts: Term) -> Term:
    return applied(operator, *parts, shape=NUMBER)


def _where(condition: Term, yes: Term, no: Term) -> Term:
    return applied("where", condition, yes, no, shape=NUMBER)


def _affine(scale: Term, offset: Term) -> Term:
    scaled = _TIME if scale.is_constant and scale.value == 1.0 else _of("*", scale, _TIME)
    return scaled if offset.is_constant and offset.value == 0.0 else _of("+", scaled, offset)


def _warp(times: Term) -> Term:
    return times


def _delay(seconds: Term) -> Term:
    return _of("-", _TIME, seconds)


def _stretch(factor: Term, about: Term) -> Term:
    return _affine(_of("/", constant(1.0), factor), _of("-", about, _of("/", about, factor)))


def _reverse(start: Term, stop: Term) -> Term:
    return _of("-", _of("+", start, stop), _TIME)


def _repeat(period: Term, start: Term) -> Term:
    inner = _of("+", start, _of("%", _of("-", _TIME, start), period))
    if not (period.is_constant and start.is_constant):
        stop = _of("+", start, period)
        # Never its end: a float or two before it.
        bit = _of("max", _of("*", _of("abs", stop), constant(2.0**-52)), constant(5e-324))
        return _where(_of("<", inner, stop), inner, _of("-", stop, bit))
    return _of("min", inner, constant(math.nextafter(start.value + period.value, -math.inf)))


def _hold(before: Term | None, after: Term | None) -> Term:
    time = _TIME
    if before is not None and before.value is not None:
        time = _of("max", time, before)
    if after is not None and after.value is not None:
        time = _of("min", time, after)
    return time


def _inside(start: Term, stop: Term, warped: Term) -> Term:
    return _where(_of("and", _of("<", start, _TIME), _of("<", _TIME, stop)), warped, _TIME)


def _creep(start: Term, stop: Term, speed: Term) -> Term:
    length = _difference(stop, start)
    share = _of("**", _of("/", _of("-", _TIME, start), length), speed)
    return _inside(start, stop, _of("min", _of("+", start, _of("*", length, share)), stop))


def _slow_in_out(start: Term, stop: Term, slow_in: Term, slow_out: Term) -> Term:
    half = _half(_difference(stop, start))
    if start.is_constant and half.is_constant:
        middle = constant(start.value + half.value)
    else:
        middle = _of("+", start, half)
    early = _of("**", _of("/", _of("-", _TIME, start), half), slow_in)
    late = _of("**", _of("/", _of("-", stop, _TIME), half), slow_out)
    rising = _of("min", _of("+", start, _of("*", half, early)), middle)
    falling = _of("max", _of("-", stop, _of("*", half, late)), middle)
    return _inside(start, stop, _where(_of("<=", _TIME, middle), rising, falling))


def _difference(a: Term, b: Term) -> Term:
    return constant(a.value - b.value) if a.is_constant and b.is_constant else _of("-", a, b)


def _half(a: Term) -> Term:
    return constant(0.5 * a.value) if a.is_constant else _of("*", constant(0.5), a)


def _discrete(fps: Term) -> Term:
    """By division, so that the time of a frame, however it was rounded, lies in it."""
    frame = _of("floor", _of("*", _TIME, fps))
    after, before = _of("+", frame, constant(1.0)), _of("-", frame, constant(1.0))
    is_late = _of("<=", _of("/", after, fps), _TIME)
    is_early = _of(">", _of("/", frame, fps), _TIME)
    return _of("/", _where(is_late, after, _where(is_early, before, frame)), fps)


_FOLLOWED: Final[dict[str, Callable[..., Term]]] = {
    "warp": _warp,
    "delay": _delay,
    "stretch": _stretch,
    "reverse": _reverse,
    "repeat": _repeat,
    "hold": _hold,
    "creep": _creep,
    "slow_in_out": _slow_in_out,
    "discrete": _discrete,
}
