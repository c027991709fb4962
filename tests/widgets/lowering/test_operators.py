"""Operators and functions of signals: each as the tree that it is."""

import math

import numpy as np
import pytest

import reactive4d as r4
from reactive4d.scefo.functions import FUNCTIONS
from reactive4d_widgets.lowering import lower

from .conftest import around

A = r4.Parameter("a", 1.5)
B = r4.Parameter("b", -0.5)
PAIRS = [(a, b) for a in (2.5, -2.5, 0.0, 1.0, -1.0, 7.0) for b in (2.0, -2.0, 0.1, 0.0, 1 / 3)]
ONE = [
    np.negative, np.positive, np.absolute, np.fabs, np.sqrt, np.cbrt, np.square, np.reciprocal, np.sin, np.cos, np.tan,
    np.arcsin, np.arccos, np.arctan, np.sinh, np.cosh, np.tanh, np.arcsinh, np.arccosh, np.arctanh, np.exp, np.exp2,
    np.expm1, np.log, np.log2, np.log10, np.log1p, np.radians, np.degrees, np.floor, np.ceil, np.rint, np.trunc,
    np.sign,
]  # fmt: skip
TWO = [
    np.add, np.subtract, np.multiply, np.true_divide, np.floor_divide, np.mod, np.fmod, np.power, np.float_power,
    np.arctan2, np.hypot, np.minimum, np.maximum, np.fmin, np.fmax, np.heaviside, np.equal, np.not_equal, np.less,
    np.less_equal, np.greater, np.greater_equal, np.logical_and, np.logical_or, np.logical_xor,
]  # fmt: skip


@pytest.mark.parametrize("function", ONE, ids=lambda f: f.__name__)
def test_functions_of_one_number_agree(agree, function):
    """At numbers of either sign, at zero, and where there is no answer."""
    for a, _ in PAIRS:
        agree(function(A), (0.0,), a=a)
    agree(function(r4.vec(r4.time, 0.5, -0.25)), (0.0, 0.3, -2.0, 1.0))


@pytest.mark.parametrize("function", TWO, ids=lambda f: f.__name__)
def test_functions_of_two_numbers_agree(agree, function):
    """The remainder has the divisor's sign, and dividing by zero gives what NumPy gives."""
    signal = function(A, B)
    for a, b in PAIRS:
        agree(signal, (0.0,), a=a, b=b)


@pytest.mark.parametrize("function", [np.add, np.multiply, np.mod, np.maximum, np.arctan2, np.power])
def test_numbers_are_spread_over_vectors(agree, function):
    """On either side."""
    vector = r4.vec(r4.time, 2.0, 0.5)

    for signal in (function(vector, 1.5), function(1.5, vector), function(vector, vector), function(vector, A)):
        agree(signal, (-2.0, 0.25, 1.0), a=2.0)


def test_python_s_operators_agree(agree):
    """Arithmetic, comparison, logic, indexing."""
    t = r4.time
    for signal in (
        2 * t + 1, 1 - t / 3, t**2 - 2**t, t % 2 - 7 % (t + 10), t // 0.3, -abs(t) + (+t), (t < 1) & ~(t > 0.5),
        (t <= 0) | (t >= 2), (t < 1) ^ (t < 2), r4.where(t < 1, t, 5 - t), round(t), round(t, 2), round(10 * t, -1),
        (t > 1) * 3 + (t > 2),
    ):  # fmt: skip
        agree(signal, [*around((0.0, 0.5, 1.0, 2.0)), -1.7, 0.3, 1.25, 2.5, 3.14159])


def test_components_are_taken_as_numpy_takes_them(agree):
    """By a number from either end, by a slice, of matrices by two."""
    vector = r4.keys({0: (1, 2, 3), 2: (4, 6, 8)})
    matrix = r4.keys({0: np.arange(9.0).reshape(3, 3), 2: np.eye(3)})

    for signal in (
        vector[0],
        vector[-1],
        vector[1:],
        vector[::-1],
        matrix[1, 2],
        matrix[0],
        matrix[:2, 1],
        matrix[-1, :],
    ):
        agree(signal, (-1.0, 0.5, 1.7, 3.0), exactly_at=(0.0, 2.0))


def test_a_component_of_keys_takes_only_its_own_numbers(agree):
    """The others are not sent."""
    vector = r4.keys({float(t): (t, 2 * t, 3 * t) for t in range(20)})

    assert len(str(agree(vector[1], (0.5, 3.3)))) < 0.6 * len(str(lower(vector)))


def test_vectors_have_products(agree):
    """Length, scalar product, vector product, product with a matrix."""
    a, b = r4.vec(r4.time, 2, 0.5), r4.vec(1, r4.time, -1)
    turn = r4.Rotation.from_axis_angle((1, 2, 3), 40).as_matrix()

    for signal in (
        np.linalg.norm(a), np.dot(a, b), a @ b, np.cross(a, b), turn @ a, np.dot(turn, a), np.sum(a), np.mean(a),
        np.clip(a, -0.5, 0.5), np.clip(r4.time, 0, None), np.clip(r4.time, None, 1), a / np.linalg.norm(a),
        r4.equal(a, b), r4.equal(r4.vec(r4.time, 1), np.array([0.5, 1.0])), np.where(a > 0.6, a, b),
    ):  # fmt: skip
        agree(signal, (-2.0, 0.5, 1.0, 3.0))


def test_strings_are_compared_and_chosen(agree):
    """What a reader chooses decides."""
    mode = r4.Parameter("mode", "slow")
    signal = r4.where(r4.equal(mode, "fast"), r4.where(r4.time < 1, "hare", "wolf"), "snail")

    for value in ("fast", "slow"):
        agree(signal, (0.0, 1.0, 2.0), mode=value)


def test_a_choice_in_time_is_a_choice(agree):
    """A condition that is known leaves only what it chooses."""
    assert lower(r4.where(r4.Variable(True), r4.time, r4.signal(lambda t: t))) == {"kind": "expr", "tree": ["time"]}
    agree(r4.where(r4.time < 1, r4.vec(1, 2, 3), r4.vec(4, 5, 6)), (0.0, 1.0))


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
def test_functions_of_scripts_agree_or_are_left_alone(agree, name):
    """Whatever a script can call is either the same when it is played, or not lowered at all."""
    function = FUNCTIONS[name]
    time, vector = r4.time * 0.25, r4.vec(r4.time, 0.5, 0.25)
    special = {
        "rotation": ("z", 100 * r4.time),
        "quaternion": (np.cos(r4.time), np.sin(r4.time), 0, 0),
        "color": (0.5, 0.5 + 0.5 * np.sin(r4.time), 0.25),
        "normalize": (vector,), "length": (vector,), "cross": (vector, (1, 2, 3)), "dot": (vector, (1.0, 2.0, 3.0)),
        "matmul": (np.eye(3), vector), "where": (time < 0.1, time, 1.0), "item": (vector, 2), "reverse": (time, 0, 4),
        "array": ("float64", (1, 2)), "hold": (time, 0, 1), "creep": (time, 0, 1), "slow_in_out": (time, 0, 1),
        "delay": (time, 0.5), "stretch": (time, 2), "repeat": (time, 1.5), "discrete": (time, 10), "round": (time,),
        "warp": (time, time * time), "affine": (time, 2.0, 1.0), "clip": (time, 0, 1), "integral": (time,),
    }  # fmt: skip
    signal = function.make(*special.get(name, (time, 0.3)[: function.least]))
    if isinstance(signal, r4.Signal) and lower(signal) is not None:
        agree(signal, (-1.5, 0.2, 0.5, 1.0, 3.3), tolerance=1e-9)
    else:
        assert name in {"array", "copysign", "isfinite", "isinf", "isnan", "nextafter", "signbit"}


def test_functions_with_options_are_no_operators():
    """What an option asks for, trees do not know."""
    vector = r4.vec(r4.time, 2, 3)

    for signal in (np.linalg.norm(vector, ord=1), np.sum(vector, axis=0), np.round(vector, decimals=1)):
        assert lower(signal) is None


def test_a_function_of_constants_alone_is_a_constant(agree):
    """It is asked once; so is a function of a parameter that is fixed."""
    length = r4.Parameter("length", 2.0)
    signal = r4.lift(lambda x: f"{x:g} m")(length)

    assert lower(signal) is None
    assert lower(signal, {"length": 3.0}) == {"kind": "const", "value": "3 m"}
    assert lower(r4.lift(math.hypot)(3.0, 4.0)) == {"kind": "const", "value": 5.0}
    assert lower(r4.time * length, {"length": 3.0}) == {"kind": "expr", "tree": ["*", ["time"], 3.0]}


def test_a_function_that_stands_still_piece_by_piece_is_held(agree):
    """Its boxes tell how long."""
    steps = r4.keys({0: 1.0, 2: 3.0, 5: 2.0}, interpolation="step")
    signal = r4.lift(lambda x: f"{x:g}")(steps)

    track = agree(signal, [*around((0, 2, 5)), -9.0, 9.0])
    assert track["kind"] == "cases"


@pytest.mark.parametrize(
    "signal",
    [r4.time.map(math.sin), r4.signal(lambda t: t * t), r4.time * r4.signal(lambda t: t), np.nextafter(r4.time, 1.0)],
)
def test_functions_of_python_are_not_lowered(signal):
    """Nobody knows what they do."""
    assert lower(signal) is None


def test_whatever_raises_is_not_lowered():
    """An error is an answer, and must not be hidden."""
    assert lower(r4.lift(lambda x: 1 / x)(r4.Variable(0))) is None
    assert lower(r4.keys({0: (1, 2, 3), 1: (2, 3, 4)})[5]) is None


def test_shapes_that_numpy_would_stretch_are_left_alone():
    """Rows over matrices are not what trees do."""
    matrix = r4.keys({0: np.eye(3), 1: np.ones((3, 3))})

    assert lower(matrix + r4.vec(1, 2, r4.time)) is None
    assert lower(matrix @ matrix) is None
