"""Signals built in Python are written as expressions that make the same signals again."""

import math
from collections.abc import Callable
from random import Random
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import reactive4d as r4
from reactive4d.scefo.expressions import evaluate
from reactive4d.scefo.parsing import parse
from reactive4d.scefo.trees import Define, Parameter, Path, Script
from reactive4d.scefo.unparsing import NotWritableError, unparse, unparse_all
from reactive4d.scefo.writing import expression_text, write
from reactive4d.signals import warps
from reactive4d.signals.facade import Signal

SPEED = r4.Variable(0.75, name="speed")
WHERE = r4.keys({0: (1.0, 0.0, 2.0), 2: (0.0, -3.0, 1.5)}, name="where")
COUNT = r4.Parameter("count", 3, bounds=(1, 9), doc="how many")
NAMES: dict[str, Any] = {"speed": SPEED, "ball.position": WHERE, "count": COUNT}


def name_of(x: Any) -> Path | None:
    """The paths of what has a name."""
    return next((Path(tuple(name.split("."))) for name, signal in NAMES.items() if signal is x), None)


def resolve(path: Path) -> Any:
    """What has a name."""
    return NAMES[str(path)]


def read(text: str, names: Callable[[Path], Any] = resolve) -> Any:
    """What an expression means."""
    statement: Any = parse(f"signal (x) {text};").statements[0]
    return evaluate(statement.value, names)


def same(a: Any, b: Any) -> bool:
    """Whether two answers are the same, bit for bit and type for type."""
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()
    return type(a) is type(b) and (a == b or (a != a and b != b)) and repr(a) == repr(b)


def written(signal: Any) -> str:
    """The text of a signal."""
    return expression_text(unparse(signal, name_of))


def round_trip(signal: Any, times: list[float]) -> None:
    """Written and read again a signal answers the same at all times."""
    text = written(signal)
    again = read(f"({text})")
    for t in times:
        try:
            expected = signal.at(t)
        except Exception as error:  # noqa: BLE001  whatever it answers
            with pytest.raises(type(error)):
                again.at(t)
        else:
            assert same(expected, again.at(t)), text
            assert signal.valid(t) == again.valid(t), text
    assert written(again) == text


TIMES = [0.0, -0.25, 0.5, 1.0, 1.7, 2.0, 3.3, 7.0, 1e6, math.inf, -math.inf]
T = r4.time
A = r4.vec(T, 1, T * T)

SIGNALS: dict[str, Any] = {
    "time": T,
    "2 * abs(sin(3.141592653589793 * time))": 2 * np.abs(np.sin(np.pi * T)),
    "time * 2 + 1 - time": T * 2 + 1 - T,
    "time - (1 - time)": T - (1 - T),
    "time / 2 * 3 % 0.7": T / 2 * 3 % 0.7,
    "(time + 1) ^ 2 ^ time": (T + 1) ** (2**T),
    "-time ^ 2": -(T**2),
    "(-time) ^ 2": (-T) ** 2,
    "+time": +T,
    "floordiv(time, 0.3)": T // 0.3,
    "speed * time": SPEED * T,
    "ball.position[2] + count": WHERE[2] + COUNT,
    "ball.position[1:]": WHERE[1:],
    "ball.position[..., -1]": WHERE[..., -1],
    "vec(time, 1, time * time)": A,
    "{1.0, 2.0, 3.0} + vec(time, 1, time * time)": np.array([1.0, 2, 3]) + A,
    "matmul({{1.0, 0.0, 0.0}, {0.0, 2.0, 0.0}}, ball.position)": np.array([[1.0, 0, 0], [0, 2, 0]]) @ WHERE,
    'ball.position * array("int64", {1, 2, 3})': WHERE * np.array([1, 2, 3]),
    'ball.position * array("float32", 0.10000000149011612)': WHERE * np.array(0.1, dtype=np.float32),
    "time < 1 and not time >= 0.5 or speed == 2": ((T < 1) & ~(T >= 0.5)) | r4.equal(SPEED, 2),
    "xor(time < 1, time <= 0.5)": (T < 1) ^ (T <= 0.5),
    "equal_each(ball.position, 0.0)": np.equal(WHERE, 0.0),
    'where(time > 1, "red", "blue")': r4.where(T > 1, "red", "blue"),
    "where(time > 1, ball.position, {0.0, 0.0, 0.0})": r4.where(T > 1, WHERE, (0, 0, 0)),
    'where(time > 1, {"a", "b"}, none)': r4.where(T > 1, ("a", "b"), None),
    "min(max(time, 0.0), 1.0)": np.minimum(np.maximum(T, 0.0), 1.0),
    "clip(time, 0, 1)": np.clip(T, 0, 1),
    "round(time, 1)": np.round(T, 1),
    "length(ball.position)": np.linalg.norm(WHERE),
    "cross(ball.position, vec(time, 1, time * time))": np.cross(WHERE, A),  # pyright: ignore
    "dot(ball.position, {1.0, 2.0, 3.0})": np.dot(WHERE, np.array([1.0, 2.0, 3.0])),  # pyright: ignore
    "arctan2(time, 2) + hypot(time, 3) + log(exp(time))": np.arctan2(T, 2) + np.hypot(T, 3) + np.log(np.exp(T)),
    "sign(floor(time) - ceil(time / 2))": np.sign(np.floor(T) - np.ceil(T / 2)),
    "time < inf": math.inf > T,
    "delay(ball.position, 1.0)": WHERE.delay(1),
    "delay(ball.position, speed)": WHERE.delay(SPEED),
    "delay(sin(time), -0.1)": np.sin(T).delay(-0.1),
    "stretch(time, 2.0)": T.stretch(2),
    "stretch(time, 4.0, 3.0)": T.stretch(4, about=3),
    "stretch(time, speed, 1)": warps.stretch(T, SPEED, about=1),
    "reverse(time, 0.0, 4.0)": T.reverse(1, 3),
    "repeat(time, 1.5, 0.5)": T.repeat(1.5, start=0.5),
    "repeat(time, speed, 0.0)": warps.repeat(T, SPEED),
    "hold(time, 0.5, none)": T.hold(before=0.5),
    "hold(time, none, speed)": warps.hold(T, None, SPEED),
    "creep(time, 0.0, 4.0, 2.0)": warps.creep(T, 0, 4),
    "creep(time, 0, 4, speed)": warps.creep(T, 0, 4, speed=SPEED),
    "slow_in_out(time, 0.0, 4.0, 2.0, 3.0)": warps.slow_in_out(T, 0, 4, slow_out=3),
    "discrete(time, 12.0)": warps.discrete(T, 12),
    "warp(ball.position, time * time)": WHERE.warp(T * T),
    "derivative(ball.position)": WHERE.derivative(),
    "derivative(derivative(ball.position))": WHERE.derivative().derivative(),
    "derivative(speed)": SPEED.derivative(),
    "integral(speed, 0.5)": SPEED.integral(0.5),
    "integral(ball.position, 1.0)": WHERE.integral(1),
    "cos(time)": np.sin(T).derivative(),
    "derivative(creep(time, 0.0, 4.0, 2.0))": warps.creep(T, 0, 4).derivative(),
    "integral(min(time, 1), 0.0)": np.minimum(T, 1).integral(),
    "variable(3.0)": (3 * T).derivative(),
    'variable({"a", 1, none, true})': r4.Variable(("a", 1, None, True)),
    "variable(time)": r4.Variable(T),
}


@pytest.mark.parametrize("text", SIGNALS)
def test_what_python_builds_can_be_written(text: str) -> None:
    """F082: the text is what one would write, and means the same signal."""
    signal = SIGNALS[text]

    assert written(signal) == text
    round_trip(signal, [t for t in TIMES if "integral" not in text or abs(t) < 100])


KEYS: dict[str, Any] = {
    "keys(<0, 1.0>, <2, 3.0>)": r4.keys({0: 1.0, 2: 3.0}),
    "keys(<0, 1>, <2, 3> by step before cycle after linear)": r4.keys(
        {0: 1, 2: 3}, interpolation="step", before="cycle", after="linear"
    ),
    "keys(<0, {0.0, 1.0}>, <2, {3.0, 4.0}> ease in_out)": r4.keys({0: (0.0, 1.0), 2: (3.0, 4.0)}, ease="in_out"),
    'keys(<0, "red">, <2, "gold">)': r4.keys({0: "red", 2: "gold"}),
    'keys(<0, "red">, <2, "ready">)': r4.keys({0: "red", 2: "ready"}),
    "keys(<0, {1.0, 0.0, 0.0}>, <2, {0.0, 1.0, 0.0}> as color)": r4.keys(
        {0: (1.0, 0.0, 0.0), 2: (0.0, 1.0, 0.0)}, kind="color"
    ),
    "keys(<0, true>, <1.5, false>)": r4.keys({0: True, 1.5: False}),
    "keys(<0, quaternion(1.0, 0.0, 0.0, 0.0)>, <1, quaternion(0.0, 1.0, 0.0, 0.0)>)": r4.keys(
        {0: r4.Rotation(), 1: r4.Rotation.from_axis_angle("x", 180)}
    ),
    "keys(<0, quaternion(1.0, 0.0, 0.0, 0.0)>, <1, quaternion(0.0, 1.0, 0.0, 0.0)> by tcb)": r4.keys(
        {0: r4.Rotation(), 1: r4.Rotation.from_axis_angle("x", 180)}, interpolation="tcb"
    ),
    "keys(<0, 0.0>, <1, 2.0 ease out_bounce>, <3, 1.0> by catmull_rom ease in)": r4.keys(
        {0: 0.0, 1: r4.Key(2.0, ease="out_bounce"), 3: 1.0}, interpolation="catmull_rom", ease="in"
    ),
    "keys(<0, 0.0 right = {0.5, 1.0}>, <1, 2.0 left = {-0.25, -1.0}> by bezier)": r4.keys(
        {0: r4.Key(0.0, right=(0.5, 1.0)), 1: r4.Key(2.0, left=(-0.25, -1.0))}, interpolation="bezier"
    ),
    "keys(<0, 0.0>, <1, 2.0 tension = 0.5 continuity = -0.5 bias = 1.0>, <2, 0.0> by tcb)": r4.keys(
        {0: 0.0, 1: r4.Key(2.0, tension=0.5, continuity=-0.5, bias=1), 2: 0.0}, interpolation="tcb"
    ),
    "keys(<0, 0.0>, <1, 2.0>, <2, 0.0>, <4, 1.0> by bspline(2) after oscillate)": r4.keys(
        {0: 0.0, 1: 2.0, 2: 0.0, 4: 1.0}, interpolation="bspline", degree=2, after="oscillate"
    ),
    "keys(<0, speed>, <2, time * 2>)": r4.keys({0: SPEED, 2: T * 2}),
    "keys(<0, speed>, <2, 5.0> by step)": r4.keys({0: SPEED, 2: 5.0}, interpolation="step"),
    "keys(<0, ball.position>, <2, vec(time, 1, time * time)> ease in_out as vector)": r4.keys(
        {0: WHERE, 2: A}, kind="vector", ease="in_out"
    ),
    'keys(<0, none>, <1, {1, "-", {2}}>)': r4.keys({0: None, 1: (1, "-", (2,))}),
}


@pytest.mark.parametrize("text", KEYS)
def test_keys_can_be_written(text: str) -> None:
    """F083, F084: interpolation, ease, extrapolation, handles and live values."""
    assert written(KEYS[text]) == text
    round_trip(KEYS[text], TIMES)
    assert read(text).curve.same(KEYS[text].curve) or "speed" in text or "time" in text


def random_signal(random: Random, depth: int = 4) -> Any:
    """Numbers, built of operators and functions at random."""
    if not depth or random.random() < 0.1:
        leaves = [T, SPEED, COUNT, WHERE[random.randint(0, 2)], T, r4.keys({0: 0.0, 2: random.random()})]
        return random.choice(leaves)

    def number() -> Any:
        return random.choice([random.uniform(-3, 3), random.randint(-3, 3)])

    def part() -> Any:
        return random_signal(random, depth - 1)

    a, b = part(), random.choice([part, part, number])()
    binary: list[Callable[[Any, Any], Any]] = [
        lambda x, y: x + y, lambda x, y: y - x, lambda x, y: x * y, lambda x, y: x / y, lambda x, y: x % y,
        lambda x, y: y // x, lambda x, y: np.hypot(x, y), lambda x, y: np.minimum(y, x), np.maximum, np.arctan2,
    ]  # fmt: skip
    unary: list[Callable[[Any], Any]] = [
        np.sin, np.exp, np.abs, lambda x: -x, np.sqrt, np.floor, lambda x: x**2, lambda x: x.delay(0.3),
        lambda x: x.repeat(1.3), lambda x: x.stretch(random.choice([2, 3, 0.7, -1.1]), about=random.random()),
        lambda x: x.warp(T * 0.5), lambda x: x.hold(before=-1, after=5), lambda x: warps.discrete(x, 10),
    ]  # fmt: skip
    kind = random.randint(0, 4)
    if kind == 0:
        return r4.where(a < b, part(), number())
    if kind == 1:
        return r4.vec(a, number(), part())[random.randint(0, 2)]
    return random.choice(binary)(a, b) if kind < 4 else random.choice(unary)(a)


@given(st.integers(0, 2**32), st.lists(st.floats(-100, 100), min_size=5, max_size=5))
def test_any_algebra_is_written_and_read_back_bit_for_bit(seed: int, times: list[float]) -> None:
    """Signal, text, signal: the same answers at random times, which hold as long."""
    signal = random_signal(Random(seed))
    if not isinstance(signal, Signal):
        return
    round_trip(signal, times)
    again = read(f"({written(signal)})")
    assert same(signal.at(np.array(times)), again.at(np.array(times)))


def test_edits_reach_a_signal_that_was_read() -> None:
    """It declares what it reads: what one sets is followed."""
    x = r4.Variable(1.0, name="x")
    y = read("sin(time) * x + x", lambda path: x)

    assert y.at(0.0) == 1.0
    x.value = r4.keys({0: 5.0, 1: 7.0})
    assert y.at(0.0) == 5.0


# -- what is shared ----------------------------------------------------------------------------------------------------


def test_what_is_shared_is_written_once_under_a_name() -> None:
    """Keys that two signals read stay one: an edit reaches both."""
    swing = r4.keys({0: 0.0, 2: 30.0})
    names = iter(["swing", "length", "x"])
    length = r4.Parameter("length", 1.0, bounds=(0.2, 2.0), doc="of the rod [m]")
    speed = r4.Variable(2.0, name="speed")

    made = unparse_all([swing * length, swing * speed, np.sin(T)], lambda x: None, lambda x: next(names))

    assert write(Script(made.definitions)) == (
        "signal (swing) <0, 0.0>, <2, 30.0>;\n"
        'parameter (length) 1.0 bounds = {0.2, 2.0} doc = "of the rod [m]";\n'
        "variable (x) 2.0;\n"
    )
    assert [expression_text(x) for x in made.expressions] == ["swing * length", "swing * x", "sin(time)"]
    assert [(signal, name) for signal, name in made.names] == [(swing, "swing"), (length, "length"), (speed, "x")]


def test_a_graph_whose_text_would_double_at_each_level_is_written_with_names() -> None:
    """X + x, 60 times over: 60 short statements instead of 2 ** 60 terms."""
    x: Any = T
    for _ in range(60):
        x = x + x
    count = iter(range(1000))

    made = unparse_all([x], lambda x: None, lambda x: f"x{next(count)}")

    assert len(made.definitions) == 59
    names: dict[str, Any] = {}
    for statement in made.definitions:
        assert isinstance(statement, Define)
        names[statement.name.text] = evaluate(statement.value, lambda path: names[str(path)])
    again = evaluate(made.expressions[0], lambda path: names[str(path)])
    assert again.at(3.0) == 3.0 * 2.0**60
    with pytest.raises(NotWritableError, match="more than"):
        unparse(x, name_of)


def test_a_chain_of_any_depth_is_written_with_names() -> None:
    """sin(sin(sin(…))), 1,000 times: a name now and then."""
    x: Any = T
    for _ in range(1000):
        x = np.sin(x)
    count = iter(range(1000))

    made = unparse_all([x], lambda x: None, lambda x: f"x{next(count)}")

    text = write(Script((*made.definitions, Define("signal", made_name("last"), made.expressions[0]))))
    names: dict[str, Any] = {}
    for statement in parse(text).statements:
        assert isinstance(statement, Define)
        names[statement.name.text] = evaluate(statement.value, lambda path: names[str(path)])
    assert names["last"].at(1.5) == x.at(1.5)
    with pytest.raises(NotWritableError, match="nested too deep"):
        unparse(x, name_of)


def made_name(text: str) -> Any:
    """A name in a tree."""
    from reactive4d.scefo.trees import Name

    return Name(text)


def test_a_sum_of_many_terms_is_one_expression() -> None:
    """What stands side by side is not deep."""
    x: Any = T
    for i in range(500):
        x = x + i

    round_trip(x, [0.0, 2.5])


def test_a_definition_is_taken_apart_though_it_has_a_name() -> None:
    """`signal (speed) …;` tells what is behind the name."""
    assert expression_text(unparse(SPEED, name_of)) == "speed"
    assert expression_text(unparse(SPEED, name_of, is_definition=True)) == "variable(0.75)"


def test_a_parameter_is_a_statement() -> None:
    """Its default, bounds and meaning are kept; where its name is taken, its own name is told."""
    made = unparse_all([COUNT + T], lambda x: None, lambda x: "count2")

    assert made.definitions == tuple(
        parse('parameter (count2) 3 bounds = {1, 9} doc = "how many" name = "count";').statements
    )
    assert isinstance(made.definitions[0], Parameter)


# -- what cannot be written --------------------------------------------------------------------------------------------


@r4.signal
def sway(t: float) -> float:
    """A function of time."""
    return t


OPAQUE: list[tuple[Any, str]] = [
    (sway + 1, "the Python function sway cannot"),
    (T.map(lambda t: t), "the Python function <lambda> cannot"),
    (r4.lift(math.gamma)(T), "the Python function gamma cannot"),
    (r4.keys({0: 0.0, 1: 1.0}, ease=math.sin), "the Python function sin cannot"),
    (np.sort(A), "the Python function sort cannot"),  # pyright: ignore
    (np.linalg.norm(A, axis=0), "the Python function norm cannot"),  # pyright: ignore
    (np.frompyfunc(math.sin, 1, 1)(T), "the Python function"),
    (T + math.nan, "the number nan cannot"),
    (A + np.array([math.nan, 0, 0]), "the number nan cannot"),
    (r4.where(T < 1, object(), None), "the value <object object at"),
    (T * 2**2000, "the number 1148"),
    (r4.Parameter("p", 1.0), "the parameter p has no name"),
    (T * (1 + 2j), "the value (1+2j) cannot"),
]


@pytest.mark.parametrize(("signal", "message"), OPAQUE, ids=[message for _, message in OPAQUE])
def test_what_no_script_can_say_is_named(signal: Any, message: str) -> None:
    """An opaque function, a value without a name: the error says which."""
    with pytest.raises(NotWritableError) as caught:
        unparse(signal, lambda x: None)
    assert str(caught.value).startswith(message)
