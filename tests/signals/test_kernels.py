"""Operators: for one answer and for many they say the same."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive4d.errors import ShapeError
from reactive4d.signals import kernels
from reactive4d.signals.kernels import OPERATORS, Constant, align, item, numbers, repeated, stacked, ufunc

FLOATS = st.one_of(st.floats(), st.integers(-4, 4).map(float))
WHOLE = st.one_of(st.integers(-5, 5), st.integers(-(2**40), 2**40), st.booleans())
ONE = ["neg", "pos", "abs", "not"]
TWO = [
    "add",
    "sub",
    "mul",
    "truediv",
    "floordiv",
    "mod",
    "pow",
    "and",
    "or",
    "xor",
    "lt",
    "le",
    "gt",
    "ge",
    "eq",
    "equal",
]
UFUNCS = [
    np.sin,
    np.exp,
    np.log,
    np.sqrt,
    np.arcsin,
    np.floor,
    np.rint,
    np.sign,
    np.fabs,
    np.degrees,
    np.cbrt,
    np.square,
]


def close(a: Any, b: Any) -> bool:
    """Equal to 1e-12 of their scale; NaN equals NaN."""
    return bool(np.isclose(float(a), float(b), rtol=1e-12, atol=0.0, equal_nan=True))


@given(st.sampled_from(TWO), st.lists(st.tuples(FLOATS, FLOATS), min_size=1, max_size=4))
def test_two_numbers(name: str, pairs: list[tuple[float, float]]) -> None:
    """For each of the operators: row by row, and with a constant on one side."""
    operator = OPERATORS[name]
    a, b = (np.array(column) for column in zip(*pairs, strict=True))
    together = operator.many([a, b])
    assert all(close(x, operator.one(*pair)) for x, pair in zip(together, pairs, strict=True))
    right = operator.many([a, Constant(pairs[0][1])])
    assert all(close(x, operator.one(y, pairs[0][1])) for x, y in zip(right, a.tolist(), strict=True))


@given(
    st.sampled_from(["add", "sub", "mul", "truediv", "floordiv", "mod", "lt", "equal", "and"]),
    st.lists(st.tuples(WHOLE, WHOLE), min_size=1, max_size=4),
)
def test_two_whole_numbers_or_truth_values(name: str, pairs: list[tuple[Any, Any]]) -> None:
    """Whole numbers do not overflow and truth values count as one, together as alone."""
    operator = OPERATORS[name]
    columns = [stacked(list(column)) for column in zip(*pairs, strict=True)]
    # What comes from a row of mixed numbers is a number of one kind.
    kept = list(zip(*[column.tolist() for column in columns], strict=True))
    together = operator.many(columns)
    single = [operator.one(*pair) for pair in kept]
    assert all(close(x, y) for x, y in zip(together, single, strict=True))
    expected = stacked(single)
    assert type(together) is type(expected)
    assert getattr(together, "dtype", None) == getattr(expected, "dtype", None)


@given(st.sampled_from([*ONE, *UFUNCS]), FLOATS)
def test_one_number(name: Any, x: float) -> None:
    """Also where the answer is none: the root of a negative number is NaN, too large is infinite."""
    operator = OPERATORS[name] if isinstance(name, str) else ufunc(name)
    assert close(operator.many([np.array([x])])[0], operator.one(x))


@given(st.sampled_from(UFUNCS), st.booleans())
def test_truth_values_are_no_small_numbers(function: Any, x: bool) -> None:
    """NumPy would take them for numbers of eight or sixteen bits."""
    with np.errstate(all="ignore"):
        expected = function(float(x))
        assert close(ufunc(function).one(x), expected)
        assert close(ufunc(function).many([np.array([x])])[0], expected)


def test_numbers_stay_pythons() -> None:
    """For one answer: floats, ints and bools, not NumPy's."""
    for name, values in (("add", (1, 2)), ("truediv", (1, 2)), ("lt", (1.0, 2)), ("pow", (-8, 1 / 3)), ("mod", (5, 0))):
        assert type(OPERATORS[name].one(*values)) in (float, int, bool)
    assert type(ufunc(np.exp2).one(3)) is float


def test_shapes_are_aligned_time_by_time() -> None:
    """(N,) with (N, 3), and (N, 3) with a constant matrix (2, 3)."""
    n = np.arange(4.0)
    v = np.ones((4, 3)) * n[:, None]
    assert OPERATORS["mul"].many([n, v]).shape == (4, 3)
    assert OPERATORS["add"].many([v, Constant(np.ones((2, 3)))]).shape == (4, 2, 3)
    assert [x.shape for x in align([n, v])] == [(4, 1), (4, 3)]


@pytest.mark.parametrize(
    ("a", "b"), [((3, 3), (3,)), ((3,), (3, 2)), ((3,), (3,)), ((2, 3), (3, 4))], ids=["M v", "v M", "v v", "M M"]
)
@pytest.mark.parametrize("constant", [None, 0, 1])
def test_products_of_matrices(a: Any, b: Any, constant: int | None) -> None:
    """Time by time, where either side may be constant."""
    rng = np.random.default_rng(1)
    sides: list[Any] = [rng.normal(size=(5, *a)), rng.normal(size=(5, *b))]
    if constant is not None:
        sides[constant] = Constant(sides[constant][0])
    together = OPERATORS["matmul"].many(sides)
    for i in range(5):
        one = OPERATORS["matmul"].one(*[x.value if isinstance(x, Constant) else x[i] for x in sides])
        assert np.allclose(together[i], one, rtol=1e-13)


def test_an_array_of_float32_is_not_widened_by_numbers() -> None:
    """As for one answer, where a number of Python's has no width."""
    rows = np.ones((3, 2), dtype=np.float32) * np.float32(0.1)
    together = OPERATORS["mul"].many([rows, np.array([0.3, 0.7, 1.1])])
    assert together.dtype == np.float32
    assert np.array_equal(together[1], OPERATORS["mul"].one(rows[1], 0.7))


@pytest.mark.parametrize(
    ("answers", "dtype"),
    [
        ([1.0, 2.0], np.float64), ([1, 2], np.int64), ([True, False], np.bool_), ([1, 2.5], np.float64),
        ([np.float32(1), 2.0], np.float64), ([np.zeros(2), np.ones(2)], np.float64), ([], np.float64),
        (["a", "b"], None), ([None, 1.0], None), ([2**70, 1], None), ([np.zeros(2), np.zeros(3)], None),
    ],
)  # fmt: skip
def test_what_many_answers_become(answers: list[Any], dtype: Any) -> None:
    """One frozen array where they are numbers or arrays of one shape, else a tuple."""
    found = stacked(answers)
    if dtype is None:
        assert type(found) is tuple
    else:
        assert found.dtype == dtype
        assert not found.flags.writeable


def test_one_answer_many_times() -> None:
    """Numbers and arrays as arrays, whole numbers beyond the machine's and anything else as tuples."""
    assert repeated(1.5, 3).tolist() == [1.5] * 3
    assert repeated(np.arange(2.0), 3).shape == (3, 2)
    assert repeated("a", 2) == ("a", "a")
    assert repeated(2**70, 2) == (2**70, 2**70)


@pytest.mark.parametrize("value", [["1"], ["a", 1], [[1, 2], [3]], [1j], [None], np.array(["1"]), [{}]])
def test_what_is_no_row_of_numbers(value: Any) -> None:
    """Is refused, also what could be turned into numbers."""
    with pytest.raises(ShapeError, match="x: expected numbers"):
        numbers(value, "x")
    assert numbers([[1, 2], (3, 4)], "x").tolist() == [[1, 2], [3, 4]]


def test_arrays_take_components_time_by_time() -> None:
    """The first axis is that of time."""
    v = np.arange(12.0).reshape(4, 3)
    assert item(1).many([v]).tolist() == v[:, 1].tolist()
    assert item((slice(1, 3),)).many([v]).shape == (4, 2)
    assert item(1).many([("ab", "cd")]) == ("b", "d")


def test_constants_are_shown_shortly() -> None:
    """As they are written, as far as that is short."""
    assert [kernels.shown(x) for x in (1.0, 2, "a", True)] == ["1", "2", "'a'", "True"]
    assert kernels.shown(np.zeros((2, 5))) == "array(2, 5)"
    assert len(kernels.shown("a" * 1000)) <= 40
    assert math.isnan(OPERATORS["sub"].one(math.inf, math.inf))
