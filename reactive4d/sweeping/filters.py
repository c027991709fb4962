"""Filters: which points of a grid are visited."""

import inspect
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from typing import Any

from reactive4d.errors import ShapeError, hint, unknown

__all__ = ["Where", "where_of"]


@dataclass(frozen=True)
class Where:
    """Which points are visited: a function of the values of some of the parameters."""

    function: Callable[..., Any]
    names: tuple[str, ...]

    def __call__(self, values: Mapping[str, Any]) -> bool:
        """Whether a point is visited."""
        given = {name: values[name] for name in self.names}
        try:
            answer = self.function(**given)
        except Exception as error:
            error.add_note(f"in where({', '.join([f'{name}={value!r}' for name, value in given.items()])})")
            raise
        try:
            return bool(answer)
        except (TypeError, ValueError):
            error = ShapeError(f"where: expected True or False, got {answer!r}")
            raise hint(error, "it is called for one point at a time") from None


def where_of(function: Callable[..., Any] | None, known: Collection[str]) -> Where | None:
    """Which points are visited, by a function; None for all.

    Args:
        function: of the values of some parameters, by their names.
        known: the names of what is moved or given.

    Raises:
        TypeError: it is no function.
        UnknownNameError: it wants something that is neither moved nor given.
    """
    if function is None:
        return None
    if not callable(function):
        error = TypeError(f"where: expected a function of parameters, got {function!r}")
        raise hint(error, "where=lambda length, angle: length * angle < 50")
    try:
        arguments = inspect.signature(function).parameters.values()
    except ValueError:
        raise TypeError("where: this function does not tell its arguments; write one that calls it") from None
    names: list[str] = []
    for argument in arguments:
        if argument.kind is argument.VAR_KEYWORD:
            names = [*known]
            break
        if argument.name in known and argument.kind is not argument.POSITIONAL_ONLY:
            names.append(argument.name)
        elif argument.default is argument.empty and argument.kind is not argument.VAR_POSITIONAL:
            raise unknown(argument.name, known, what="argument of where")
    return Where(function, tuple(names))
