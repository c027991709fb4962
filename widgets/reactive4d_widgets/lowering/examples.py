"""Tracks of every kind, to be played at awkward times: what the conformance vectors are made of."""

import random
from collections.abc import Iterator
from itertools import pairwise
from typing import Any, TypeAlias

import numpy as np

from reactive4d.signals.colors import color, srgb_to_blended
from reactive4d.signals.rotations import Rotation
from reactive4d_widgets.lowering.numerals import Array, coarse, fine
from reactive4d_widgets.lowering.specimens import lowered_matrices, lowered_tracks

__all__ = ["matrices", "tracks"]

Example: TypeAlias = tuple[str, dict[str, Any], list[dict[str, Any]]]
_NOTHING: list[dict[str, Any]] = [{}]
_TIME = ["time"]


def tracks() -> Iterator[Example]:
    """Names, tracks of numbers, vectors, colours, rotations and held values, and parameters to play them with."""
    yield from _held()
    yield from _polynomials()
    yield from _rotations()
    yield from _colors()
    yield from _elsewhere()
    yield from _expressions()
    yield from lowered_tracks()


def matrices() -> Iterator[Example]:
    """The same for products of factors."""
    for i, factors in enumerate(_factor_lists()):
        name = "+".join(factor["op"] for factor in factors) or "nothing"
        yield f"product {i} {name}", {"kind": "product", "factors": factors}, _NOTHING
    along = {"op": "translate", "offset": expr(["vec", ["param", "x"], _TIME, 0])}
    yield "product of a parameter", {"kind": "product", "factors": [along]}, [{"x": 0.5}, {"x": -2.0}]
    yield from lowered_matrices()


def expr(tree: Any) -> dict[str, Any]:
    """A tree as a track."""
    return {"kind": "expr", "tree": tree}


def const(value: Any) -> dict[str, Any]:
    """A constant as a track."""
    return {"kind": "const", "value": value}


def poly(times: list[float], coefficients: Any, shape: list[int], end: Any = None) -> dict[str, Any]:
    """A piecewise polynomial from its coefficients (piece, power, …)."""
    array = np.array(coefficients, dtype=np.float64)
    made: dict[str, Any] = {"kind": "poly", "times": fine(times), "coefficients": fine(array)}
    made |= {"degree": array.shape[1] - 1, "shape": shape}
    return made if end is None else made | {"end": fine(np.atleast_1d(end))}


def _held() -> Iterator[Example]:
    for i, value in enumerate((0, -0.0, 2.5, 1e300, True, False, "mesh", "ü – “x” \u2028", None, [1, 2, 3], [])):
        yield f"const {i}", const(value), _NOTHING
    yield "stepped strings", {"kind": "stepped", "times": [0, 1.5], "values": ["mesh", "none"]}, _NOTHING
    yield "stepped numbers", {"kind": "stepped", "times": fine([-1.0, 0.1, 0.3]), "values": [1, 2, 0.1]}, _NOTHING
    yield "stepped truth", {"kind": "stepped", "times": [2], "values": [True]}, _NOTHING
    values = [[0, 0, 0], [1, 2, 3]]
    yield "stepped vectors", {"kind": "stepped", "times": [0, 1e-300], "values": values}, _NOTHING
    yield "ref", {"kind": "ref", "ref": "0123456789abcdef0123456789abcdef"}, _NOTHING
    refs = ["00000000000000000000000000000001", "00000000000000000000000000000002", "00000000000000000000000000000003"]
    yield "samples held", {"kind": "samples", "start": 1, "step": 0.1, "refs": refs, "blend": False}, _NOTHING


def _polynomials() -> Iterator[Example]:
    chance = random.Random(4)
    for degree in range(4):
        for count, shape in ((1, []), (2, []), (5, [3]), (3, [1]), (40, [3])):
            times = np.cumsum([chance.choice((0.1, 0.25, 1 / 3, 2.0)) for _ in range(count + 1)]).tolist()
            width = shape[0] if shape else 1
            coefficients = np.array([chance.uniform(-2, 2) for _ in range(count * (degree + 1) * width)])
            rows = coefficients.reshape(count, degree + 1, *shape)
            yield f"poly of degree {degree}, {count} pieces, shape {shape}", poly(times, rows, shape), _NOTHING
            end = [chance.uniform(-2, 2) for _ in range(width)]
            yield (
                f"the same of degree {degree}, {count} pieces, {shape}, with an end",
                poly(times, rows, shape, end),
                _NOTHING,
            )
    fitted = {"kind": "poly", "times": [0, 1], "coefficients": coarse(np.arange(40) / 7.0), "degree": 3, "shape": [10]}
    yield "poly of float32", fitted, _NOTHING
    yield "poly far from zero", poly([1e6, 1e6 + 0.125, 1e6 + 1], [[1, 1e-3], [2, 1e9]], [], 7.0), _NOTHING
    yield "poly before zero", poly([-3, -0.5, 0.0], [[1, 2], [-1, 0.1]], [], -0.0), _NOTHING


def _rotations() -> Iterator[Example]:
    chance = random.Random(7)

    def turn() -> list[float]:
        return Rotation([chance.gauss(0, 1) for _ in range(4)]).as_quaternion().tolist()

    yield "one rotation", slerp([1.0], [turn()]), _NOTHING
    for count in (2, 3, 9):
        times = np.cumsum([chance.choice((0.1, 0.5, 1 / 3)) for _ in range(count)]).tolist()
        yield f"slerp of {count}", slerp(times, [turn() for _ in times]), _NOTHING
        eases = [[0.0, 0.0, 3 / (b - a) ** 2, -2 / (b - a) ** 3] for a, b in pairwise(times)]
        yield f"eased slerp of {count}", slerp(times, [turn() for _ in times], eases), _NOTHING
    beyond = slerp([0.0, 1.0], [turn(), turn()], [[-0.5, 2.0, 0.0, 0.0]])
    yield "slerp that overshoots", beyond, _NOTHING
    z = [Rotation.from_axis_angle("z", angle).as_quaternion().tolist() for angle in (10, 350, 170, 350)]
    yield "slerp over the pole", slerp([0.0, 1.0, 2.0, 3.0], z), _NOTHING
    yield "slerp of half a turn", slerp([0.0, 1.0], [[1, 0, 0, 0], [0, 0, 0, 1]]), _NOTHING
    yield "slerp that stands", slerp([0.0, 1.0], [turn()] * 2), _NOTHING


def slerp(times: list[float], rotations: Any, fractions: Any = None) -> dict[str, Any]:
    """Turns from key to key, quaternions wxyz; the fractions are cubics of seconds."""
    told = None if fractions is None else fine(np.array(fractions))
    return {"kind": "slerp", "times": fine(times), "rotations": fine(np.array(rotations)), "fractions": told}


def _colors() -> Iterator[Example]:
    for a, b in (("red", "blue"), ("#ff000080", "transparent"), ("white", "black"), ("gold", "#00f")):
        start, stop = srgb_to_blended(color(a)), srgb_to_blended(color(b))
        inner = poly([0.0, 2.0], [[start, (stop - start) / 2.0]], [4], stop)
        yield f"oklab from {a} to {b}", {"kind": "oklab", "track": inner}, _NOTHING
    beyond = poly([0.0, 1.0], [[[1.2, 0.3, -0.4, 1.0], [0.5, 1.0, 1.0, -1.0]]], [4])
    yield "oklab of what no screen shows", {"kind": "oklab", "track": beyond}, _NOTHING
    huge = poly([0.0, 1.0], [[[1e-3, 2e-4, -1e-4, 1e-3], [0, 0, 0, -1e-3]]], [4], [0, 0, 0, 1e-9])
    yield "oklab that fades", {"kind": "oklab", "track": huge}, _NOTHING


def _elsewhere() -> Iterator[Example]:
    ramp = poly([0.0, 1.0, 3.0], [[0, 1], [1, -0.25]], [], 0.5)
    pair = poly([0.0, 1.0], [[[0, 1], [2, 3]]], [2], [2, 4])
    halves = [expr(["*", 2, _TIME]), const(5), ramp]
    yield "cases", {"kind": "cases", "times": [None, 0, 0.5, None], "tracks": halves}, _NOTHING
    yield "cases with ends", {"kind": "cases", "times": [0, 1, 2, 3], "tracks": halves}, _NOTHING
    yield "cases of one", {"kind": "cases", "times": [None, None], "tracks": [ramp]}, _NOTHING
    inner = {"kind": "cases", "times": [None, 2, None], "tracks": [ramp, const(-1)]}
    yield "cases of cases", {"kind": "cases", "times": [None, 1, None], "tracks": [const(9), inner]}, _NOTHING
    yield "repeat", {"kind": "repeat", "period": 3, "start": 0, "offset": None, "track": ramp}, _NOTHING
    yield (
        "repeat with an offset",
        {"kind": "repeat", "period": 0.1, "start": 0.3, "offset": [2], "track": ramp},
        _NOTHING,
    )
    climbing = {"kind": "repeat", "period": 1, "start": 0.25, "offset": [2, -4], "track": pair}
    yield "repeat of vectors", climbing, _NOTHING
    yield "repeat of an expression", {"kind": "repeat", "period": 0.7, "start": -0.2, "track": expr(_TIME)}, _NOTHING
    ease = ["-", ["*", 3, ["square", _TIME]], ["*", 2, ["**", _TIME, 3]]]
    share = poly([0.0, 2.0, 3.0], [[0, 0.5], [0, 1.0]], [])
    yield "at as a let", expr(["at", ease, ["track", share]]), _NOTHING
    yield "at in at", expr(["at", ["at", ["+", _TIME, 1], ["*", _TIME, 2]], ["-", _TIME, 3]]), _NOTHING
    yield "a track at another time", expr(["at", ["track", ramp], ["%", _TIME, 0.75]]), _NOTHING
    yield "index of a track", expr(["+", ["index", ["track", pair], 1], ["index", ["track", pair], 0]]), _NOTHING


_NUMBERS = (0.0, -0.0, 0.5, -0.5, 1.0, -1.0, 2.5, -2.5, 3.0, 1e-300, 1e300, 7.25, -7.25, 0.1)


def _expressions() -> Iterator[Example]:
    one = [
        *("neg", "abs", "sqrt", "sin", "cos", "tan", "arcsin", "arccos", "arctan", "exp", "log", "log2", "log10"),
        *("sinh", "cosh", "tanh", "floor", "ceil", "round", "sign"),
    ]
    two = [
        *("+", "-", "*", "/", "**", "%", "//", "min", "max", "arctan2", "hypot", "<", "<=", ">", ">=", "==", "!="),
        *("and", "or"),
    ]
    for name in (*one, "square", "radians", "degrees", "not"):
        given = [{"x": x} for x in _NUMBERS[: 13 if name not in ("sin", "cos", "tan") else 10]]
        yield f"expression {name}", expr([name, ["param", "x"]]), given[::2] + given[1::2]
        vector = expr([name, ["vec", _TIME, 0.25, ["neg", _TIME]]])
        yield f"expression {name} of a vector", vector, _NOTHING
    pairs = [{"x": x, "y": y} for x in (7.25, -7.25, 0.0, 1.0, -1.0, -8.0) for y in (2.0, -2.0, 0.1, 0.0, 1 / 3, 1e300)]
    for name in two:
        yield f"expression {name}", expr([name, ["param", "x"], ["param", "y"]]), pairs
        vector = expr([name, ["vec", 1, -2, 3.5], ["vec", _TIME, 0.5, 2]])
        yield f"expression {name} of vectors", vector, _NOTHING
        yield f"expression {name} of a vector and a number", expr([name, ["vec", 1, -2, 3.5], _TIME]), _NOTHING
    infinite = ["/", 1, 0]
    yield "expression ** of what is no number", expr(["**", 1, ["-", infinite, infinite]]), _NOTHING
    yield "expression ** to the infinite", expr(["**", -1, infinite]), _NOTHING
    yield "expression min of what is no number", expr(["min", 1, ["/", 0, 0]]), _NOTHING
    yield (
        "expression % of the infinite",
        expr(["vec", ["%", -5, infinite], ["%", 5, infinite], ["%", infinite, 5]]),
        _NOTHING,
    )
    yield "expression clip", expr(["clip", _TIME, -1, 2]), _NOTHING
    yield "expression clip of a vector", expr(["clip", ["vec", _TIME, 5, -5], -1, ["vec", 0, 1, 2]]), _NOTHING
    yield "expression where", expr(["where", ["<", _TIME, 1], _TIME, ["neg", _TIME]]), _NOTHING
    choice = ["where", ["<", ["vec", _TIME, 0, 2], 1], ["vec", 1, 2, 3], _TIME]
    yield "expression where by element", expr(choice), _NOTHING
    mode = ["where", ["==", ["param", "mode"], "fast"], "hare", "snail"]
    yield "expression of strings", expr(mode), [{"mode": "fast"}, {"mode": "slow"}]
    codes = [{"tint": code} for code in ("#ff8000", "#f80", "#0F08", "#12345678", "red", "#ff80000")]
    yield "expression rgba", expr(["rgba", ["param", "tint"]]), codes
    yield (
        "expression of truth",
        expr(["+", ["param", "on"], ["*", 2, ["not", ["param", "on"]]]]),
        [
            {"on": True},
            {"on": False},
        ],
    )
    yield "expression of a pair", expr(["*", ["index", ["param", "xy"], 1], ["param", "xy"]]), [{"xy": [3, -4]}]
    moving = ["vec", _TIME, ["sin", _TIME], 2]
    yield "expression norm", expr(["norm", moving]), _NOTHING
    yield "expression dot", expr(["dot", moving, ["vec", 1, 2, 3]]), _NOTHING
    yield "expression cross", expr(["cross", moving, ["vec", 1, 2, 3]]), _NOTHING
    swing = ["*", ["param", "angle"], ["cos", ["*", ["sqrt", ["/", 9.81, ["param", "length"]]], _TIME]]]
    yield "a pendulum", expr(swing), [{"angle": 20, "length": 1}, {"angle": -45, "length": 0.2}]


def _factor_lists() -> Iterator[list[dict[str, Any]]]:
    chance = random.Random(11)

    def vector(scale: float = 1.0) -> list[float]:
        return [round(chance.uniform(-scale, scale), 3) for _ in range(3)]

    def moving() -> dict[str, Any]:
        a, b = np.array(vector(2.0)), np.array(vector(2.0))
        return poly([0.0, 2.0], [[a, (b - a) / 2.0]], [3], b)

    def turns() -> dict[str, Any]:
        found = [Rotation([chance.gauss(0, 1) for _ in range(4)]).as_quaternion().tolist() for _ in range(3)]
        return slerp([0.0, 1.0, 3.0], found)

    def placed(linear: Array) -> list[float]:
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = linear, vector()
        return matrix.ravel().tolist()

    yield []
    yield [{"op": "translate", "offset": moving()}]
    yield [{"op": "rotate", "angle": expr(["*", 90, _TIME]), "axis": const([0, 0, 1]), "center": const([0, 0, 0])}]
    yield [{"op": "rotate", "angle": const(30), "axis": moving(), "center": moving()}]
    yield [{"op": "rotate", "angle": const(-450), "axis": const([1, 2, -2])}]
    yield [{"op": "orient", "rotation": turns(), "center": const([1, 0, 0])}]
    yield [{"op": "orient", "rotation": const([2, 0, 0, 2])}]
    yield [{"op": "scale", "factor": expr(["+", 1, ["square", _TIME]]), "center": moving()}]
    yield [{"op": "scale", "factor": const([1, -2, 0])}]
    yield [{"op": "matrix", "matrix": const(placed(np.array([[1, 2, 0], [0, 1, 0.5], [0, 0, 2.0]])))}]
    stretch = expr(["vec", ["+", 1, ["square", _TIME]], 0.25, 0, 2, -0.5, 1])
    yield [{"op": "trs", "translation": moving(), "rotation": turns(), "stretch": stretch}]
    yield [{"op": "trs", "translation": moving(), "rotation": const([0, 3, 0, 4]), "stretch": None}]
    yield [{"op": "look", "eye": moving(), "target": const([0, 0, 9]), "up": const([0, 0, 1])}]
    yield [{"op": "look", "eye": const([0, 0, 5]), "target": const([0, 0, 0]), "up": const([0, 0, 2])}]
    yield [{"op": "look", "eye": const([0, 5, 0]), "target": const([0, 0, 0]), "up": const([0, 1, 0])}]
    skewed = {"op": "matrix", "matrix": const(placed(np.array([[1, 0.3, 0], [0.2, 2, 0], [0, 0.1, 1.5]])))}
    mirrored = {"op": "scale", "factor": const([2, 3, -4])}
    for forward in (None, "x", "-x", "y", "-y", "z", "-z"):
        aim: dict[str, Any] = {"op": "aim", "target": const([4, 5, 6]), "up": const([0, 0, 1])}
        aim = aim if forward is None else aim | {"forward": forward}
        yield [{"op": "translate", "offset": moving()}, aim]
        yield [skewed, {"op": "rotate", "angle": expr(["*", 50, _TIME]), "axis": const([1, 1, 0])}, aim]
        yield [mirrored, aim, {"op": "translate", "offset": const([1, 2, 3])}]
    around = {"op": "rotate", "angle": expr(["*", 20, _TIME]), "axis": const([0, 1, 0]), "center": const([1, 1, 1])}
    yield [{"op": "translate", "offset": moving()}, around, {"op": "scale", "factor": const(0.5)}]
    inner = {"kind": "product", "factors": [around, {"op": "translate", "offset": const([0, 0, 2])}]}
    yield [{"op": "translate", "offset": moving()}, {"op": "matrix", "matrix": inner}]
