"""Wordings: what an author says in the options of a directive, as Python would, but without running anything."""

import ast
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from reactive4d.errors import ShapeError, hint

__all__ = ["named", "times_of"]

_CALLS: Mapping[str, Callable[..., Any]] = {"linspace": np.linspace, "arange": np.arange}
MOST = 100_000  # values


def named(text: str, *, what: str) -> dict[str, Any]:
    """Values by name, written as the arguments of a call.

    Args:
        text: literals, and `linspace` and `arange` of numbers.
        what: how an error calls it.

    Raises:
        ShapeError: it is something else.

    >>> named("length=linspace(0, 2, 3), mode=['bend', 'twist'], angle=-45", what="parameters")
    {'length': [0.0, 1.0, 2.0], 'mode': ['bend', 'twist'], 'angle': -45}
    """
    try:
        call = ast.parse(f"f({text}\n)", mode="eval").body
    except SyntaxError:
        call = None
    if not isinstance(call, ast.Call) or call.args or any(one.arg is None for one in call.keywords):
        raise hint(ShapeError(f"{what}: {text!r} are no values by name"), "length=linspace(0.2, 2, 7), angle=45")
    return {str(one.arg): _value(one.value, f"{what}: {one.arg}") for one in call.keywords}


def times_of(text: str) -> Any:
    """(start, stop), or evenly spaced times.

    Raises:
        ShapeError: it is neither.

    >>> times_of("0, 4"), times_of("linspace(0, 1, 3)")
    ((0, 4), [0.0, 0.5, 1.0])
    """
    try:
        found = ast.parse(text.strip(), mode="eval").body
    except SyntaxError:
        raise hint(ShapeError(f"times: {text!r} are no times"), "0, 4 or linspace(0, 4, 61)") from None
    return _value(found, "times")


def _value(node: ast.expr, what: str) -> Any:
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in _CALLS and not node.keywords:
        numbers = [_value(one, what) for one in node.args]
        if not all(isinstance(one, int | float) for one in numbers):
            raise ShapeError(f"{what}: {ast.unparse(node)}: expected numbers")
        try:
            made = _CALLS[node.func.id](*numbers)
        except (TypeError, ValueError, MemoryError) as error:
            raise ShapeError(f"{what}: {ast.unparse(node)}: {error}") from None
        if len(made) > MOST:
            raise ShapeError(f"{what}: {ast.unparse(node)}: {len(made)} values are too many, at most {MOST}")
        return made.tolist()
    try:
        return ast.literal_eval(node)
    except ValueError:
        error = ShapeError(f"{what}: {ast.unparse(node)!r} is no value")
        raise hint(error, "numbers, texts, lists of them, linspace(…), arange(…)") from None
