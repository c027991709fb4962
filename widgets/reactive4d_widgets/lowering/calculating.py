"""What the trees of expressions mean: the reference for those who play them.

NumPy's meaning throughout: dividing by zero gives inf or nan, the remainder has the divisor's sign, halves are rounded
to even. Arrays are flat; numbers are spread over them; truth values count as 0 and 1.
"""

import operator
import re
from collections.abc import Callable, Mapping
from typing import Any, Final, TypeAlias

import numpy as np

from reactive4d.signals.trees import is_a

__all__ = ["LOGICAL", "NUMERIC", "calculate"]

# Plays a track at a time.
Player: TypeAlias = Callable[[Any, float], Any]


def _number(x: Any) -> Any:
    """A truth value as a number; numbers, arrays and strings as they are."""
    if is_a(x, bool, np.bool_):
        return float(x)
    return x.astype(np.float64) if is_a(x, np.ndarray) else x


def _plain(x: Any) -> Any:
    """NumPy's scalars as Python's."""
    return x.item() if is_a(x, np.generic) else x


def _is_true(x: Any) -> Any:
    return x != 0.0 if is_a(x, np.ndarray, float, int) else bool(x)


def _where(condition: Any, yes: Any, no: Any) -> Any:
    if is_a(condition, np.ndarray):
        choose: Any = np.where
        return choose(condition != 0.0, _number(yes), _number(no))
    return yes if _is_true(condition) else no


def _compare(numpy: Any, python: Any) -> Callable[[Any, Any], Any]:
    def compare(a: Any, b: Any) -> Any:
        return numpy(a, b) if is_a(a, np.ndarray) or is_a(b, np.ndarray) else python(a, b)

    return compare


def _clip(x: Any, low: Any, high: Any) -> Any:
    return np.minimum(np.maximum(x, low), high)


def _norm(a: Any) -> Any:
    return np.sqrt(np.dot(a, a))


def _cross(a: Any, b: Any) -> Any:
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def _vec(*parts: Any) -> Any:
    return np.array(parts, dtype=np.float64)


def _rgba(text: Any) -> Any:
    if not is_a(text, str) or _HEX.fullmatch(text) is None:
        return np.full(4, np.nan)
    digits = text[1:] if len(text) > 5 else "".join([digit + digit for digit in text[1:]])
    return np.array([int(digits.ljust(8, "f")[i : i + 2], 16) / 255.0 for i in (0, 2, 4, 6)])


def _index(a: Any, i: Any) -> Any:
    return a[int(i)]


def _not(a: Any) -> Any:
    return np.logical_not(_is_true(a))


def _and(a: Any, b: Any) -> Any:
    return np.logical_and(_is_true(a), _is_true(b))


def _or(a: Any, b: Any) -> Any:
    return np.logical_or(_is_true(a), _is_true(b))


_HEX: Final = re.compile(r"#(?:[0-9a-fA-F]{3,4}|[0-9a-fA-F]{6}|[0-9a-fA-F]{8})")
_op: Any = operator  # its functions have no types
NUMERIC: Final[dict[str, Callable[..., Any]]] = {
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
    "clip": _clip,
    "norm": _norm,
    "dot": np.dot,
    "cross": _cross,
    "vec": _vec,
}
LOGICAL: Final[dict[str, Callable[..., Any]]] = {
    "<": _compare(np.less, _op.lt),
    "<=": _compare(np.less_equal, _op.le),
    ">": _compare(np.greater, _op.gt),
    ">=": _compare(np.greater_equal, _op.ge),
    "==": _compare(np.equal, _op.eq),
    "!=": _compare(np.not_equal, _op.ne),
    "not": _not,
    "and": _and,
    "or": _or,
    "where": _where,
    "index": _index,
    "rgba": _rgba,
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
    if not is_a(tree, list):
        return float(tree) if type(tree) is int else tree
    name, operands = tree[0], tree[1:]
    if name == "time":
        return t
    if name == "param":
        value = parameters[tree[1]]
        return np.array(value, dtype=np.float64) if is_a(value, list, tuple, np.ndarray) else value
    if name == "track":
        return play(tree[1], t)
    if name == "at":
        return calculate(tree[1], float(calculate(tree[2], t, parameters, play)), parameters, play)
    values: list[Any] = [calculate(x, t, parameters, play) for x in operands]
    with np.errstate(all="ignore"):
        if name in NUMERIC:
            return _plain(NUMERIC[name](*map(_number, values)))
        if name in LOGICAL:
            return _plain(LOGICAL[name](*values))
    raise ValueError(f"{name!r} is no operator")
