"""What the trees of expressions mean: the reference for those who play them.

NumPy's meaning throughout: dividing by zero gives inf or nan, the remainder has the divisor's sign, halves are rounded to
even. Arrays are flat; numbers are spread over them; truth values count as 0 and 1.
"""

from collections.abc import Callable, Mapping
from typing import Any, Final, TypeAlias

import numpy as np

__all__ = ["calculate"]

# Plays a track at a time.
Player: TypeAlias = Callable[[Any, float], Any]


def _number(x: Any) -> Any:
    """A truth value as a number; numbers, arrays and strings as they are."""
    if isinstance(x, bool | np.bool_):
        return float(x)
    return x.astype(np.float64) if isinstance(x, np.ndarray) else x


def _plain(x: Any) -> Any:
    """NumPy's scalars as Python's."""
    return x.item() if isinstance(x, np.generic) else x


def _is_true(x: Any) -> Any:
    return x != 0.0 if isinstance(x, np.ndarray | float | int) else bool(x)


def _where(condition: Any, yes: Any, no: Any) -> Any:
    if isinstance(condition, np.ndarray):
        return np.where(condition != 0.0, _number(yes), _number(no))
    return yes if _is_true(condition) else no


def _compare(numpy: Any, python: Callable[[Any, Any], bool]) -> Callable[[Any, Any], Any]:
    def compare(a: Any, b: Any) -> Any:
        if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
            return numpy(a, b)
        return python(a, b)

    return compare


def _cross(a: Any, b: Any) -> Any:
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


_NUMERIC: Final[dict[str, Callable[..., Any]]] = {
    "+": np.add,
    "-": np.subtract,
    "*": np.multiply,
    "/": np.true_divide,
    "**": np.float_power,
    "%": np.mod,
    "//": np.floor_divide,
    "neg": np.negative,
    "abs": np.absolute,
    "sqrt": np.sqrt,
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "arcsin": np.arcsin,
    "arccos": np.arccos,
    "arctan": np.arctan,
    "exp": np.exp,
    "log": np.log,
    "log2": np.log2,
    "log10": np.log10,
    "sinh": np.sinh,
    "cosh": np.cosh,
    "tanh": np.tanh,
    "floor": np.floor,
    "ceil": np.ceil,
    "round": np.rint,
    "sign": np.sign,
    "square": np.square,
    "radians": np.radians,
    "degrees": np.degrees,
    "min": np.minimum,
    "max": np.maximum,
    "arctan2": np.arctan2,
    "hypot": np.hypot,
    "clip": lambda x, low, high: np.minimum(np.maximum(x, low), high),
    "norm": lambda a: np.sqrt(np.dot(a, a)),
    "dot": np.dot,
    "cross": _cross,
    "vec": lambda *parts: np.array(parts, dtype=np.float64),
}
_LOGICAL: Final[dict[str, Callable[..., Any]]] = {
    "<": _compare(np.less, lambda a, b: a < b),
    "<=": _compare(np.less_equal, lambda a, b: a <= b),
    ">": _compare(np.greater, lambda a, b: a > b),
    ">=": _compare(np.greater_equal, lambda a, b: a >= b),
    "==": _compare(np.equal, lambda a, b: a == b),
    "!=": _compare(np.not_equal, lambda a, b: a != b),
    "not": lambda a: np.logical_not(_is_true(a)),
    "and": lambda a, b: np.logical_and(_is_true(a), _is_true(b)),
    "or": lambda a, b: np.logical_or(_is_true(a), _is_true(b)),
    "where": _where,
    "index": lambda a, i: a[int(i)],
}


def calculate(tree: Any, t: float, parameters: Mapping[str, Any], play: Player) -> Any:
    """The value of a tree at a time.

    Args:
        tree: as it travels.
        t: seconds.
        parameters: values of all that are named in it; several numbers as a list.
        play: plays the tracks in it.

    Raises:
        ValueError: an operator that nobody knows.
        KeyError: a parameter that was not given.

    >>> calculate(["%", ["time"], 2], 5.5, {}, lambda track, t: None)
    1.5
    """
    if not isinstance(tree, list):
        return float(tree) if type(tree) is int else tree
    name, operands = tree[0], tree[1:]  # pyright: ignore[reportUnknownVariableType]
    if name == "time":
        return t
    if name == "param":
        value = parameters[tree[1]]
        return np.array(value, dtype=np.float64) if isinstance(value, list | tuple | np.ndarray) else value
    if name == "track":
        return play(tree[1], t)
    if name == "at":
        return calculate(tree[1], float(calculate(tree[2], t, parameters, play)), parameters, play)
    values: list[Any] = [calculate(x, t, parameters, play) for x in operands]  # pyright: ignore[reportUnknownVariableType]
    with np.errstate(all="ignore"):
        if name in _NUMERIC:
            return _plain(_NUMERIC[name](*map(_number, values)))
        if name in _LOGICAL:
            return _plain(_LOGICAL[name](*values))
    raise ValueError(f"{name!r} is no operator")
