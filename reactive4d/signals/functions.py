"""Python functions as signals."""

import inspect
import math
from collections.abc import Callable
from typing import Any, TypeVar, overload

from reactive4d.engine import Computed
from reactive4d.engine.frames import here
from reactive4d.errors import hint
from reactive4d.signals.facade import Signal

__all__ = ["Function", "finished", "signal"]

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
        TypeError: it is no function, takes more than one argument, or is a generator or a coroutine.

    >>> import reactive4d as r4
    >>> @signal
    ... def sway(t: float) -> float:
    ...     return 10 * t if t < 5 else 0.0
    >>> sway.at(2.0)
    20.0
    """
    name = finished(function, "signal")
    try:
        parameters = inspect.signature(function).parameters.values()
    except ValueError:
        raise TypeError(f"signal: {name} does not tell its arguments; write a function that calls it") from None
    wanted = [p for p in parameters if p.default is p.empty and p.kind not in (p.VAR_POSITIONAL, p.VAR_KEYWORD)]
    if len(wanted) > 1 or any(p.kind is p.KEYWORD_ONLY for p in wanted):
        names = ", ".join([p.name for p in wanted])
        error = TypeError(f"signal: {name} takes {names}; expected no argument, or one, the time")
        raise hint(error, "lift(f)(a, b) is for functions of values")
    if wanted and wanted[0].name in ("self", "cls"):
        error = TypeError(f"signal: {name} is a method: it would be given the time as {wanted[0].name!r}")
        raise hint(error, "make the signal in __init__: self.height = signal(self.compute_height)")
    return Function(function if not wanted else _of_time(function), name=name)


def finished(function: Any, what: str) -> str:
    """The name of a function that answers when it is called.

    Raises:
        TypeError: it is no function, or one that answers bit by bit (a generator) or later (a coroutine).
    """
    if not callable(function) or isinstance(function, Signal):
        raise TypeError(f"{what}: expected a function, got {function!r}")
    name = str(getattr(function, "__name__", what))
    if inspect.iscoroutinefunction(function) or inspect.isasyncgenfunction(function):
        error = TypeError(f"{what}: {name} is asynchronous, and would answer a coroutine")
        raise hint(error, "await outside, and set a Variable to what comes")
    if inspect.isgeneratorfunction(function):
        error = TypeError(f"{what}: {name} is a generator, which answers only once")
        raise hint(error, "return a tuple of what it yields")
    return name


def _of_time(function: Callable[[float], Any]) -> Callable[[], Any]:
    def rule() -> Any:
        frame = here.me.frame
        assert frame is not None
        t = frame.t
        frame.handed = t
        frame.lo, frame.hi = max(frame.lo, t), min(frame.hi, math.nextafter(t, math.inf))
        return function(t)

    return rule
