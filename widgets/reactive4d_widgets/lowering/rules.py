"""The rules by which operators are lowered: from what an operator does to a function of terms."""

from collections.abc import Callable
from typing import Any, Final, TypeAlias

import numpy as np

from reactive4d.geometry.transforms import direction
from reactive4d.signals import kernels
from reactive4d_widgets.lowering.elementary import common, gather, number_by_number, vector
from reactive4d_widgets.lowering.terms import (
    HELD,
    NUMBER,
    ROTATION,
    NotExactError,
    Term,
    applied,
    component,
    constant,
)

__all__ = ["BY_NAME", "BY_SYMBOL", "WITHOUT", "WITH_OPTIONS"]

Rule: TypeAlias = Callable[..., Term]
OfOne: TypeAlias = Callable[[Term], Term]


def _same(name: str) -> Rule:
    """An operator of one or two operands that trees have under this name."""

    def rule(*parts: Term) -> Term:
        return number_by_number(name, *parts)

    return rule


def _n(value: float) -> Term:
    return constant(value)


def _add(a: Term, b: Term) -> Term:
    return number_by_number("+", a, b)


def _times(a: Term, b: Term) -> Term:
    return number_by_number("*", a, b)


def _over(a: Term, b: Term) -> Term:
    return number_by_number("/", a, b)


def _power(a: Term, b: float) -> Term:
    return number_by_number("**", a, _n(b))


def _one(name: str, a: Term) -> Term:
    return number_by_number(name, a)


def _signed(function: OfOne) -> OfOne:
    """An odd function, from what it is of positive numbers."""

    def rule(a: Term) -> Term:
        return _times(_one("sign", a), function(_one("abs", a)))

    return rule


def _exactly_one(a: Term, b: Term) -> Term:
    return number_by_number("!=", _is_not(a), _is_not(b))


def _is_zero(a: Term) -> Term:
    return number_by_number("==", a, _n(0.0))


def _is_not(a: Term) -> Term:
    return number_by_number("!=", a, _n(0.0))


def _asinh(a: Term) -> Term:
    return _one("log", _add(a, _one("sqrt", _add(_one("square", a), _n(1.0)))))


def _acosh(a: Term) -> Term:
    return _one("log", _add(a, _one("sqrt", _add(_one("square", a), _n(-1.0)))))


def _atanh(a: Term) -> Term:
    return _times(_n(0.5), _one("log", _over(_add(_n(1.0), a), number_by_number("-", _n(1.0), a))))


def _fmod(a: Term, b: Term) -> Term:
    return _times(_one("sign", a), number_by_number("%", _one("abs", a), _one("abs", b)))


def _trunc(a: Term) -> Term:
    return _times(_one("sign", a), _one("floor", _one("abs", a)))


def _round(a: Term, digits: Term | None = None) -> Term:
    if digits is None:
        return _one("round", a)
    if not digits.is_constant or digits.value != int(digits.value) or abs(digits.value) > 20:
        raise NotExactError("rounded to digits that vary")
    scale = _n(10.0 ** abs(digits.value))
    if digits.value >= 0:
        return _over(_one("round", _times(a, scale)), scale)
    return _times(_one("round", _over(a, scale)), scale)


def _heaviside(a: Term, at_zero: Term) -> Term:
    return applied(
        "where",
        number_by_number("<", a, _n(0.0)),
        _n(0.0),
        applied("where", _is_zero(a), at_zero, _n(1.0), shape=common((a, at_zero))),
        shape=common((a, at_zero)),
    )


def _clip(a: Term, low: Term, high: Term) -> Term:
    if low.is_constant and low.value is None:
        return number_by_number("min", a, high)
    if high.is_constant and high.value is None:
        return number_by_number("max", a, low)
    return number_by_number("clip", a, low, high)


def _norm(a: Term) -> Term:
    if not isinstance(a.shape, tuple) or len(a.shape) != 1:
        raise NotExactError("the norm of what is no vector")
    return applied("norm", a, shape=NUMBER)


def _cross(a: Term, b: Term) -> Term:
    if a.shape != (3,) or b.shape != (3,):
        raise NotExactError("the vector product of what is not in space")
    return applied("cross", a, b, shape=(3,))


def _dot(a: Term, b: Term) -> Term:
    if a.shape == NUMBER or b.shape == NUMBER:
        return _times(a, b)
    return _matmul(a, b)


def _matmul(a: Term, b: Term) -> Term:
    if not isinstance(a.shape, tuple) or not isinstance(b.shape, tuple) or len(b.shape) != 1:
        raise NotExactError("a product of matrices")
    if a.shape == b.shape:
        return applied("dot", a, b, shape=NUMBER)
    if len(a.shape) == 2 and a.shape[1] == b.shape[0]:
        return vector([applied("dot", gather(a, i), b, shape=NUMBER) for i in range(a.shape[0])])
    raise NotExactError("a product of shapes that do not fit")


def _sum(a: Term) -> Term:
    if not a.is_array:
        raise NotExactError("the sum of a number")
    return applied("dot", a, constant(np.ones(a.width)), shape=NUMBER)


def _mean(a: Term) -> Term:
    return _over(_sum(a), _n(float(a.width)))


def _equal(a: Term, b: Term) -> Term:
    """Whether two values are equal as a whole."""
    if a.shape != b.shape:
        raise NotExactError("whether different shapes are equal")
    if a.shape in (NUMBER, HELD):
        return applied("==", a, b, shape=NUMBER)
    if a.shape == ROTATION or a.width > 16:
        raise NotExactError("whether large values are equal")
    pairs = [applied("==", component(a, i), component(b, i), shape=NUMBER) for i in range(a.width)]
    while len(pairs) > 1:
        pairs = [applied("and", *pairs[:2], shape=NUMBER), *pairs[2:]]
    return pairs[0]


def _item(a: Term, number: Term) -> Term:
    """A component, counted from 1."""
    if not number.is_constant:
        raise NotExactError("a component whose number varies")
    return gather(a, int(number.value) - 1)


def _normalize(a: Term) -> Term:
    return _over(a, _norm(a))


def _rotation(axis: Term, angle: Term) -> Term:
    """A rotation about a fixed axis."""
    if not axis.is_constant or angle.shape != NUMBER:
        raise NotExactError("a rotation about an axis that moves")
    half = _one("radians", _times(angle, _n(0.5)))
    sine = _one("sin", half)
    made = vector([_one("cos", half), *[_times(_n(c), sine) for c in direction(axis.value)]])
    return Term(made.tree, ROTATION, made.nodes, made.depth)


def _quaternion(*parts: Term) -> Term:
    made = vector(parts)
    return Term(made.tree, ROTATION, made.nodes, made.depth)


def _color(*parts: Term) -> Term:
    if len(parts) == 1:
        raise NotExactError("a colour by a name that varies")
    return vector([*parts, *[_n(1.0)][: 4 - len(parts)]])


# What trees have, by NumPy's name of it.
_PLAIN: Final[dict[Any, str]] = {
    np.add: "+",
    np.subtract: "-",
    np.multiply: "*",
    np.true_divide: "/",
    np.floor_divide: "//",
    np.mod: "%",
    np.power: "**",
    np.float_power: "**",
    np.negative: "neg",
    np.absolute: "abs",
    np.fabs: "abs",
    np.sqrt: "sqrt",
    np.square: "square",
    np.sin: "sin",
    np.cos: "cos",
    np.tan: "tan",
    np.arcsin: "arcsin",
    np.arccos: "arccos",
    np.arctan: "arctan",
    np.arctan2: "arctan2",
    np.sinh: "sinh",
    np.cosh: "cosh",
    np.tanh: "tanh",
    np.exp: "exp",
    np.log: "log",
    np.log2: "log2",
    np.log10: "log10",
    np.hypot: "hypot",
    np.radians: "radians",
    np.deg2rad: "radians",
    np.degrees: "degrees",
    np.rad2deg: "degrees",
    np.floor: "floor",
    np.ceil: "ceil",
    np.rint: "round",
    np.sign: "sign",
    np.minimum: "min",
    np.maximum: "max",
    np.equal: "==",
    np.not_equal: "!=",
    np.less: "<",
    np.less_equal: "<=",
    np.greater: ">",
    np.greater_equal: ">=",
    np.logical_and: "and",
    np.logical_or: "or",
    np.logical_not: "not",
    "lt": "<",
    "le": "<=",
    "gt": ">",
    "ge": ">=",
    "not": "not",
    "and": "and",
    "or": "or",
}
_OF_ONE: Final[dict[Any, OfOne]] = {
    np.positive: lambda a: a,
    np.cbrt: _signed(lambda a: _power(a, 1.0 / 3.0)),
    np.exp2: lambda a: number_by_number("**", _n(2.0), a),
    np.expm1: lambda a: number_by_number("-", _one("exp", a), _n(1.0)),
    np.log1p: lambda a: _one("log", _add(a, _n(1.0))),
    np.reciprocal: lambda a: _over(_n(1.0), a),
    np.arcsinh: _signed(_asinh),
    np.arccosh: _acosh,
    np.arctanh: _atanh,
    np.trunc: _trunc,
    np.linalg.norm: _norm,
    np.sum: _sum,
    np.mean: _mean,
}
BY_SYMBOL: Final[dict[Any, Rule]] = {
    **{symbol: _same(name) for symbol, name in _PLAIN.items()},
    **_OF_ONE,
    np.fmod: _fmod,
    np.fmin: _same("min"),
    np.fmax: _same("max"),
    np.heaviside: _heaviside,
    np.logical_xor: _exactly_one,
    "xor": _exactly_one,
    np.matmul: _matmul,
    np.dot: _dot,
    np.cross: _cross,
    np.clip: _clip,
    np.round: _round,
    "equal": _equal,
}
WITH_OPTIONS: Final = (np.dot, np.cross, np.clip, np.linalg.norm, np.round, np.sum, np.mean)
WITHOUT: Final = frozenset([kernels.function(f, {}) for f in (np.cross, np.clip, np.linalg.norm, np.round, np.around)])
# Functions of scripts that are no functions of NumPy's.
BY_NAME: Final[dict[str, Rule]] = {
    "item": _item,
    "normalize": _normalize,
    "rotation": _rotation,
    "quaternion": _quaternion,
    "color": _color,
}
