"""Algebra: operators, NumPy's functions and `lift` make signals that hold as long as what they read."""

import copy
import math
import operator
import pickle
from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d.engine import engine
from reactive4d.errors import EvaluationError, ShapeError

t = r4.time
VECTOR = r4.vec(t, 1, 2)
BINARY = ["add", "sub", "mul", "truediv", "floordiv", "mod", "pow", "lt", "le", "gt", "ge"]


def hints(caught: Any) -> str:
    """The notes of a caught exception."""
    return " ".join(getattr(caught.value, "__notes__", []))


@pytest.mark.parametrize("name", BINARY)
@pytest.mark.parametrize("other", [2, 2.5, np.float32(2.0), np.int64(3), True, r4.Variable(1.5), np.array([1.0, 4.0])])
def test_operators_do_what_they_do_with_values(name: str, other: Any) -> None:
    """On either side: numbers, NumPy's numbers and arrays, other signals."""
    function = getattr(operator, name)
    value = other.at(3.0) if isinstance(other, r4.Signal) else other
    for made, wanted in ((function(t, other), function(3.0, value)), (function(other, t), function(value, 3.0))):
        assert isinstance(made, r4.Signal)
        assert np.allclose(made.at(3.0), wanted, rtol=1e-15)


def test_one_and_two_sided_operators() -> None:
    """-x, +x, abs, and, or, xor, not, round, matrix products."""
    x = r4.Variable(-1.5)
    assert ((-x).at(0), (+x).at(0), abs(x).at(0), round(x).at(0), round(x * 1.11, 1).at(0)) == (
        1.5,
        -1.5,
        1.5,
        -2,
        -1.7,
    )
    a, b = x < 0, x > 0
    assert [s.at(0) for s in (a & b, a | b, a ^ b, ~a, True & a, False | b)] == [False, True, True, False, True, False]
    assert (np.eye(3)[:2] @ VECTOR).at(5).tolist() == [5, 1]
    assert (VECTOR @ VECTOR).at(2) == 9


def test_numbers_follow_ieee() -> None:
    """Nothing raises and nothing warns: neither alone nor in arrays, neither one by one nor together."""
    zero = r4.Variable(0.0)
    assert (1 / zero).at(0) == math.inf
    assert math.isnan((zero / zero).at(0))
    assert math.isnan(((zero - 8) ** 0.5).at(0))
    assert (10.0 ** (zero + 400)).at(0) == math.inf
    assert np.log(zero).at(0) == -math.inf
    huge = r4.vec(1e308, t, 0) * 1e10
    assert huge.at(1.0)[0] == huge.at([1.0])[0, 0] == math.inf
    assert np.isnan((huge - huge).at(1.0)[0])


def test_truth_values_count_as_one() -> None:
    """And are no numbers of eight bits."""
    assert ((t < 3) + (t < 5)).at(0) == 2
    assert np.sin(t < 3).at(0) == math.sin(1)


def test_numpys_functions_are_signals() -> None:
    """Ufuncs of one and two arguments, and other functions with sequences and named arguments."""
    assert np.hypot(t, 4).at(3) == 5
    assert np.cross(VECTOR, [0, 0, 1]).at(3).tolist() == [1, -3, 0]
    assert np.linalg.norm(VECTOR).at(2) == 3
    assert np.concatenate([VECTOR, [7], VECTOR]).at(0).tolist() == [0, 1, 2, 7, 0, 1, 2]
    assert np.stack([t, t + 1]).at(1).tolist() == [1, 2]
    assert np.clip(t, a_min=0, a_max=t - 1).at(5) == 4
    assert np.where(t < 3, 1, 2).at(5) == 2
    assert np.sum(VECTOR, axis=0).at(4) == 7
    assert (np.array([1.0, 2.0]) * t).at(2).tolist() == [2, 4]
    assert np.float64(2) * t is not None
    assert (np.float64(2) * t).at(4) == 8


def test_answers_hold_where_their_operands_do() -> None:
    """The intersection of where they hold."""
    a = r4.keys({0: 1.0, 2: 2.0}, interpolation="step")
    b = r4.keys({1: 1.0, 5: 2.0}, interpolation="step")
    span = (a * b + 3).valid(3.0)
    assert (span.start, span.stop) == (2.0, 5.0)


def test_components() -> None:
    """By number, slice or tuple; of anything that has some."""
    assert VECTOR[0].at(4) == 4
    assert VECTOR[-1].at(4) == 2
    assert VECTOR[1:].at(4).tolist() == [1, 2]
    assert r4.Variable([[1, 2], [3, 4]])[0, 1].at(0) == 2
    assert r4.Variable(("a", ("b", 2.0)))[1][0].at(0) == "b"


@pytest.mark.parametrize("index", ["x", 1.0, None, True, [0, 1], t])
def test_no_index_of_a_component(index: Any) -> None:
    """Refused at once."""
    with pytest.raises(TypeError, match="index of a component"):
        VECTOR[index]


def test_a_number_has_no_components() -> None:
    """The error shows the number."""
    with pytest.raises(TypeError, match=r"1\.0 has no component 0"):
        t[0].at(1.0)


@pytest.mark.parametrize(
    ("misuse", "what", "advice"),
    [
        (lambda: bool(t < 3), "is not true or false", "where"),
        (lambda: 0 < t < 3, "is not true or false", "&"),
        (lambda: max(t, t), "is not true or false", "np.maximum"),
        (lambda: [*VECTOR], "no components before", r"s\[0\]"),
        (lambda: math.sin(t), "a number only at some time", "np.sin"),  # type: ignore[arg-type]
        (lambda: int(t), "a number only at some time", "int"),  # type: ignore[call-overload]
        (lambda: f"{t:.2f}", "cannot be formatted", "map"),
        (lambda: np.array([t, t]), "does not fit into an array", "vec"),
        (lambda: np.asarray(t), "does not fit into an array", "vec"),
        (lambda: copy.copy(t + 1), "cannot be copied", "Variable"),
        (lambda: copy.deepcopy(r4.Variable(1.0)), "cannot be copied", "Variable"),
        (lambda: pickle.dumps(r4.keys({0: 1.0})), "cannot be copied or pickled", "keys"),
        (lambda: np.add(t, 1, out=np.zeros(1)), "np.add", "lift"),
        (lambda: np.add.reduce(VECTOR), "np.add", "lift"),
        (lambda: np.modf(t), "np.modf", "lift"),
        (lambda: operator.iadd(np.zeros(3), t), "np.add", "lift"),
        (lambda: t + ["a", "b"], "expected numbers", "vec"),
        (lambda: t + ["1"], "expected numbers", "vec"),
        (lambda: r4.vec("a", "b"), "expected numbers or signals", "one by one"),
        (lambda: r4.vec([1, 2], 3), "expected numbers or signals", "one by one"),
        (lambda: r4.vec(math.nan, t), "nan", "one by one"),
    ],
)
def test_misuse_says_what_to_do(misuse: Any, what: str, advice: str) -> None:
    """What is wrong, and as a hint what to write instead."""
    with pytest.raises((TypeError, ShapeError), match=what) as caught:
        misuse()
    assert advice.replace("\\", "") in hints(caught)


def test_in_place_operators_make_a_new_signal() -> None:
    """The name means another signal then; the old one is as it was."""
    x = y = r4.Variable(1.0)
    x += 1
    assert x is not y
    assert (x.at(0), y.at(0)) == (2, 1)


def test_equality_is_identity_and_equal_is_a_signal() -> None:
    """Signals are members of sets; `equal` compares as a whole, `np.equal` number by number."""
    assert t == t
    assert (t == 3) is False
    assert len({t, t, VECTOR}) == 2
    assert r4.equal(VECTOR, [2, 1, 2]).at(2) is True
    assert r4.equal(VECTOR, [2, 1]).at(2) is False
    assert r4.equal(r4.Variable("a"), "a").at(0) is True
    assert r4.equal(t, "a").at(0) is False
    assert np.equal(VECTOR, [2, 0, 2]).at(2).tolist() == [True, False, True]


def test_shapes_that_do_not_fit_are_a_shape_error() -> None:
    """With both shapes and the way that it came up."""
    with pytest.raises(ShapeError, match=r"\(3,\) and \(2,\)") as caught:
        ((VECTOR + [1, 2]) * 2).at(1.0)
    assert "while evaluating" in hints(caught)
    with pytest.raises(ShapeError, match="expected a number for each component"):
        r4.vec(VECTOR, 1).at(0.0)


def test_names_tell_what_is_calculated() -> None:
    """As one would write it, as far as that is short."""
    x, y = r4.Variable(1.0, name="x"), r4.Variable(2.0, name="y")
    assert (x * 2 + y).name == "(x * 2 + y)"
    assert (x / (y * 2)).name == "x / (y * 2)"
    assert (-(x * y)).name == "-(x * y)"
    assert ((x**y) ** 2).name == "(x ** y) ** 2"
    assert (x * y * 2).name == "x * y * 2"
    assert (x * y)[0].name == "(x * y)[0]"
    assert np.sin(x).name == "sin(x)"
    assert r4.where(x < 3, y, 0).name == "where((x < 3), y, 0)"


def test_a_constant_without_dimensions_has_a_name_as_well() -> None:
    """NumPy's scalars come as arrays of no dimension."""
    x = r4.Variable(1.0, name="x")
    assert (x * np.array(0.5)).name == "x * 0.5"


def test_names_of_large_signals_stay_short() -> None:
    """However deep, wide or long what they are made of is."""
    deep: Any = t
    for _ in range(200):
        deep = deep + deep
    late: Any = t
    for _ in range(500):
        late = late.delay(1.0)
    wide = r4.vec(*[t] * 1000)
    for signal in (deep, late, wide, r4.Variable("x") + "a" * 10_000, late * 2):
        assert len(signal.name) < 200
        assert len(repr(signal)) < 250


def test_lift_applies_a_function_of_values() -> None:
    """With constants and named arguments, which may be signals too; it holds where its arguments do."""
    text = r4.lift(lambda x, *, digits, unit="m": f"{x:.{digits}f} {unit}")
    assert text(t, digits=r4.Variable(1)).at(2) == "2.0 m"
    assert text(3.0, digits=1, unit="s").at(0) == "3.0 s"
    held = r4.lift(len)(r4.keys({0: "a", 4: "abc"}))
    assert (held.valid(1).start, held.valid(1).stop) == (-math.inf, 4)


def test_lift_is_sealed() -> None:
    """What the function reads by itself could not be known; it is refused, one by one and together."""
    x = r4.Variable(1.0, name="x")
    for read in (x.now, lambda: x.at(0.0)):
        peeking = r4.lift(lambda value, read=read: value + read())(t)
        with pytest.raises(EvaluationError, match="inside of a function of values"):
            peeking.at(1.0)
        with pytest.raises(EvaluationError, match="inside of a function of values"):
            peeking.at([1.0, 2.0])
    sneaky = np.frompyfunc(lambda value: value + x.at(0.0), 1, 1)(t)
    with pytest.raises(EvaluationError):
        sneaky.at(1.0)


def test_a_function_that_answers_later_is_refused() -> None:
    """Generators, coroutines, signals and what is no function at all."""

    async def later() -> float:
        return 1.0

    def bit_by_bit() -> Any:
        yield 1.0

    for function in (later, bit_by_bit, 3, t):
        with pytest.raises(TypeError, match="lift"):
            r4.lift(function)  # type: ignore[arg-type]
    for answer in (lambda x: (y for y in [x]), lambda x: t + 1):
        with pytest.raises(TypeError, match="the answer is a"):
            t.map(answer).at(0.0)


def test_depth_is_no_limit() -> None:
    """100,000 operations, one on another, are asked, edited and asked again."""
    x = r4.Variable(0.0)
    s: Any = x
    for _ in range(100_000):
        s = s + 1.0
    assert s.at(0.0) == 100_000
    x.value = 5.0
    assert s.at(0.0) == 100_005
    assert engine.naive(x + 1, 0.0) == 6
