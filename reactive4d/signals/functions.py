"""Python functions as signals."""

import inspect
import math
from collections.abc import Callable
from typing import Any, TypeVar, overload

from reactive4d.engine import Computed
from reactive4d.engine.frames import here
from reactive4d.signals.facade import Signal

__all__ = ["Function", "signal"]

T = TypeVar("T")


class Function(Signal[T], Computed):
    """A signal whose rule is a Python function; see `signal`."""

    __slots__ = ()


@overload
def signal(function: Callable[[], T]) -> Function[T]: ...
@overload
def signal(function: Callable[[float], T]) -> Function[T]: ...
def signal(function: Callable[..., Any]) -> Function[Any]:
    """Make a signal of a Python function.

    Without an argument it reads others by `x.now()`, and its answer holds where theirs do. With an argument, the time,
    its answer holds for that instant only; `x.at(t)` with that very `t` reads at the asker's time, any other time is
    read as a fixed one. The function must only read: the same reads must give the same answer.

    Raises:
        TypeError: the function takes more than one argument.

    >>> import reactive4d as r4
    >>> @signal
    ... def sway(t: float) -> float:
    ...     return 10 * t if t < 5 else 0.0
    >>> sway.at(2.0)
    20.0
    """
    wanted = [
        p for p in inspect.signature(function).parameters.values()
        if p.default is p.empty and p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD)
    ]  # fmt: skip
    if len(wanted) > 1:
        raise TypeError(f"signal: {function.__name__} takes {len(wanted)} arguments, expected none or the time")
    name = getattr(function, "__name__", "signal")
    return Function(function if not wanted else _of_time(function), name=name)


def _of_time(function: Callable[[float], Any]) -> Callable[[], Any]:
    def rule() -> Any:
        frame = here.me.frame
        assert frame is not None
        t = frame.t
        frame.handed = t
        frame.lo, frame.hi = max(frame.lo, t), min(frame.hi, math.nextafter(t, math.inf))
        return function(t)

    return rule
