"""Trees of signals, rewritten from the leaves up without the interpreter's stack: what calculus does with algebra."""

from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

import numpy as np

from reactive4d.signals.algebra import Operation
from reactive4d.signals.choices import Choice
from reactive4d.signals.facade import Signal
from reactive4d.signals.sources import Parameter, Variable
from reactive4d.signals.warps import Follow, Warped

__all__ = [
    "Rewrite",
    "constant_or",
    "is_a",
    "is_unvarying",
    "is_zero",
    "minus",
    "over",
    "parts_of",
    "plus",
    "rewrite",
    "times",
    "zero",
]

# From a signal and what became of its parts to what becomes of it: a signal, or a constant.
Rewrite: TypeAlias = Callable[[Any, Sequence[Any]], Any]


def is_a(x: Any, *kinds: type) -> bool:
    """Whether something is of one of these kinds, without the type checker's opinion on what it is then."""
    return isinstance(x, kinds)


def parts_of(x: Any) -> tuple[Any, ...]:
    """What a signal is made of, constants included; nothing, if that is not known."""
    if is_a(x, Operation):
        return x.operands
    if is_a(x, Choice):
        return (x.yes, x.no)
    if is_a(x, Warped):
        return (x.original,)
    if is_a(x, Follow):
        return (x.original, *x.parameters)
    return ()


def rewrite(root: Any, rule: Rewrite, *, parts: Callable[[Any], tuple[Any, ...]] = parts_of) -> Any:
    """Apply a rule to a tree, every shared part once; `parts` says how far a signal is taken apart."""
    done: dict[int, Any] = {}
    todo: list[Any] = [root]
    while todo:
        x = todo[-1]
        if id(x) in done:
            todo.pop()
            continue
        found = parts(x)
        missing = [part for part in found if id(part) not in done]
        if missing:
            todo.extend(missing)
            continue
        done[id(x)] = rule(x, [done[id(part)] for part in found])
        todo.pop()
    return done[id(root)]


def zero(constant: Any) -> Any:
    """The zero that is as large as a constant."""
    return np.zeros(constant.shape) if is_a(constant, np.ndarray) else 0.0


def is_unvarying(x: Any) -> bool:
    """Whether something is surely the same at all times."""
    return isinstance(x, Parameter) or not isinstance(x, Signal)


def constant_or(x: Any, name: str) -> Signal[Any]:
    """A signal as it is; a constant as a signal."""
    return x if is_a(x, Signal) else Variable(float(x) if type(x) is int else x, name=name)


def is_zero(x: Any) -> bool:
    """Whether something is surely zero at all times: a constant, not a signal that happens to be."""
    return type(x) is float and x == 0.0


def plus(a: Any, b: Any) -> Any:
    """A sum without what is surely zero."""
    return b if is_zero(a) else a if is_zero(b) else a + b


def minus(a: Any, b: Any) -> Any:
    """A difference without what is surely zero."""
    return a if is_zero(b) else -b if is_zero(a) else a - b


def times(a: Any, b: Any) -> Any:
    """A product, nothing if a factor is surely zero, and without a factor that is surely one."""
    if is_zero(a) or is_zero(b):
        return 0.0
    return b if type(a) is float and a == 1.0 else a if type(b) is float and b == 1.0 else a * b


def over(a: Any, b: Any) -> Any:
    """A quotient, nothing if the dividend is surely zero."""
    return 0.0 if is_zero(a) else a / b
