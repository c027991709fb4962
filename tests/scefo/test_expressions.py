"""What expressions mean: values and signals, and nothing of Python."""

import math
from contextlib import suppress
from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d.errors import ScriptError
from reactive4d.scefo.expressions import evaluate
from reactive4d.scefo.functions import FUNCTIONS, ScriptFunction
from reactive4d.scefo.parsing import parse
from reactive4d.scefo.trees import Path
from reactive4d.signals.facade import Signal

SPEED = r4.Variable(0.5, name="speed")
HEAD = r4.keys({0: (0.0, 0.0, 1.0), 2: (4.0, 0.0, 1.0)}, name="head")
COUNT = r4.Parameter("count", 2)
WORD = r4.Variable("abc", name="word")
CAMERA = object()
NAMES: dict[str, Any] = {
    "speed": SPEED, "robot.head.position": HEAD, "count": COUNT, "word": WORD, "camera": CAMERA,
    "colours": ("red", "green", "blue"), "offset": (1.0, 2.0, 3.0),
}  # fmt: skip


def resolve(path: Path) -> Any:
    """What has a name."""
    try:
        return NAMES[str(path)]
    except KeyError:
        raise r4.UnknownNameError(f"there is no {path}") from None


def read(text: str, **options: Any) -> Any:
    """What an expression means."""
    statement: Any = parse(f"signal (x) ({text});").statements[0]
    return evaluate(statement.value, resolve, **options)


def at(text: str, t: float) -> Any:
    """The answer of an expression at a time, as a list if it is an array."""
    value = read(text)
    answer = value.at(t) if isinstance(value, Signal) else value
    return answer.tolist() if isinstance(answer, np.ndarray) else answer


def test_the_values_of_figure_2_are_written() -> None:
    """
    F087: the sample values of the UGA paper's figure 2: 3.1416, a string, an object, a function, lists, lists of
    lists, the 2nd value of a list, a value that changes with an object.
    """
    assert read("3.1416") == 3.1416
    assert read('"John Painter"') == "John Painter"
    assert read("camera") is CAMERA
    assert at("sin(3.14 * time)", 1.17) == math.sin(3.14 * 1.17)
    assert read("{1.0, 2.0, 3.0}") == (1.0, 2.0, 3.0)
    assert read('{{1, 2}, {"a", {camera}}}') == ((1, 2), ("a", (CAMERA,)))
    assert read("item(colours, 2)") == "green"
    assert read("robot.head.position") is HEAD


def test_values_are_expressions_over_the_scene() -> None:
    """F082: a function of time, another object's position, a position with an offset, a colour that matches."""
    assert at("sin(3 * time)", 2.0) == math.sin(6.0)
    assert at("robot.head.position + {1, 2, 3}", 1.0) == [3.0, 2.0, 4.0]
    assert at("robot.head.position + offset", 1.0) == [3.0, 2.0, 4.0]
    assert at('where(robot.head.position[0] > 1, item(colours, count), "black")', 1.0) == "green"


def test_a_camera_shifts_its_focus_from_one_moving_object_to_another() -> None:
    """F084: the values of keys are asked at the asked time, and then interpolated."""
    focus = read("keys(<0, robot.head.position>, <2, vec(0, 10 * time, 0)>)")

    assert focus.at(0.5).tolist() == [0.75 * 1.0, 0.25 * 5.0, 0.75 * 1.0]


def test_a_signal_holds_where_what_it_reads_holds() -> None:
    """What comes of an expression declares what it reads."""
    y = read("speed * 2 + keys(<0, 1>, <1, 2> by step)")

    assert y.valid(3.0) == r4.Interval(1.0, math.inf)
    assert y.inputs
    SPEED.value = 1.5
    assert y.at(3.0) == 5.0
    SPEED.value = 0.5


@pytest.mark.parametrize(
    ("text", "t", "answer"),
    [
        ("1 + 2 * 3 - 4 / 8", 0.0, 6.5),
        ("7 % 4 + floordiv(7, 4)", 0.0, 4),
        ("2 ^ 3 ^ 2", 0.0, 512),
        ("-2 ^ 2", 0.0, -4),
        ("(1 < 2 and 2 <= 2 and not 3 > 4)", 0.0, True),
        ("(1 == 1.0 or 1 != 1)", 0.0, True),
        ("time == 2", 2.0, True),
        ("time != 2", 2.0, False),
        ("pi", 0.0, math.pi),
        ("none", 0.0, None),
        ("-inf", 0.0, -math.inf),
        ("1 / 0", 0.0, math.inf),
        ("sqrt(-1) * 0 == 0", 0.0, False),
        ("min(3, time, 1)", 2.0, 1.0),
        ("max(3, time, 1)", 5.0, 5.0),
        ("abs(-3)", 0.0, 3),
        ("round(time, 1)", 0.26, 0.3),
        ("{1, time, 3}", 2.0, [1.0, 2.0, 3.0]),
        ("{{1, 2}, {time, 3}}", 5.0, [[1.0, 2.0], [5.0, 3.0]]),
        ("{robot.head.position, robot.head.position}", 0.0, [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]),
        ("{1, 2, 3}[1]", 0.0, 2),
        ("{1, 2, 3}[1:]", 0.0, (2, 3)),
        ("{{1, 2}, {3, 4}}[..., 1]", 0.0, [2, 4]),
        ("item({time, 2 * time, camera}, count)", 3.0, 6.0),
        ("item(robot.head.position, 3)", 0.0, 1.0),
        ("length({3, 4})", 0.0, 5.0),
        ("normalize({0, time, 0})", 3.0, [0.0, 1.0, 0.0]),
        ("dot({1, 2}, {3, time})", 4.0, 11.0),
        ("cross({1, 0, 0}, {0, 1, 0})", 0.0, [0, 0, 1]),
        ('color("red")', 0.0, [1.0, 0.0, 0.0, 1.0]),
        ("color(time, 0, 0)", 0.5, [0.5, 0.0, 0.0, 1.0]),
        ('rotation("z", 90)', 0.0, r4.Rotation.from_axis_angle("z", 90)),
        ('rotation("z", 90 * time)', 2.0, r4.Rotation.from_axis_angle("z", 180)),
        ("delay(time, 1) + delay(5, 1)", 3.0, 7.0),
        ("stretch(time, 2)", 3.0, 1.5),
        ("reverse(time, 0, 4)", 1.0, 3.0),
        ("repeat(time, 2)", 5.0, 1.0),
        ("hold(time, 1, none)", 0.0, 1.0),
        ("derivative(3 * time)", 7.0, 3.0),
        ("derivative(3)", 7.0, 0.0),
        ("integral(2, 1)", 3.0, 4.0),
        ("integral(time)", 2.0, 2.0),
        ("warp(time, time * time)", 3.0, 9.0),
        ("{a: 1, b: {c: 2}}", 0.0, {"a": 1, "b": {"c": 2}}),
        ('{"radius", time}', 0.0, ("radius", r4.time)),
    ],
)
def test_what_expressions_answer(text: str, t: float, answer: Any) -> None:
    """Arithmetic as in Python, functions as in NumPy."""
    assert at(text, t) == answer


@pytest.mark.parametrize(
    ("text", "column", "message"),
    [
        ("1 + robot.arm", 17, "there is no robot.arm"),
        ("foo(1)", 13, "there is no function 'foo'"),
        ("sin(1, 2)", 13, "sin takes 1 value, got 2"),
        ("hold(time)", 13, "hold takes 2 to 3 values, got 1"),
        ("min(1)", 13, "min takes at least 2 values, got 1"),
        ('1 + "a"', 13, "add: expected numbers"),
        ('"a" * 1000000000', 13, "mul: expected numbers"),
        ("2 * {1, camera}", 13, "arithmetic: expected numbers"),
        ("{1, 2} + {1, 2, 3}", 13, "shapes (2,) and (3,) do not fit"),
        ("item({1, 2}, 3)", 13, "item: expected a number from 1 to 2, got 3"),
        ("item({1, 2}, 0)", 13, "item: expected a number from 1 to 2, got 0"),
        ("{1, 2}[5]", 13, "out of range"),
        ("3[0]", 13, "3 has no component 0"),
        ('color("rot")', 13, "unknown colour 'rot'"),
        ("normalize({0, 0, 0})", 13, "the vector has no length"),
        ("repeat(time, -1)", 13, "expected a period above 0"),
        ("keys(<0, 1>, <0, 2>)", 26, "a second key at 0.0 s"),
        ("keys(<inf, 1>)", 13, "a key cannot stand at inf s"),
        ("keys(<0, 1> by foo)", 13, "unknown interpolation 'foo'"),
        ('keys(<0, 1>, <1, "red">)', 13, "the keys are of several kinds"),
        ('array("object", {1})', 13, "array: expected one of float32"),
    ],
)
def test_what_means_nothing_is_told_with_its_place(text: str, column: int, message: str) -> None:
    """ScriptErrors, with the notes of what was wrong."""
    with pytest.raises(ScriptError) as caught:
        read(text)
    assert (caught.value.line, caught.value.column) == (1, column)
    assert message in str(caught.value)


def test_whole_numbers_cannot_grow_without_end() -> None:
    """9 ^ 9 ^ 9 ^ 9, and a number that is doubled again and again, become floating point numbers at some size."""
    assert read("9 ^ 9 ^ 9 ^ 9") == math.inf
    assert read("-9 ^ 999999999999") == -math.inf
    assert read("2 ^ 100") == 2**100
    assert read("1 ^ 99999999") == 1
    power = read("count ^ count ^ count ^ count ^ count ^ count")
    assert power.at(0.0, count=9) == math.inf
    assert power.at(0.0, count=1) == 1
    x: Any = COUNT
    for _ in range(60):
        x = evaluate(parse("signal (x) y * y;").statements[0].value, lambda path, x=x: x)  # pyright: ignore
    assert x.at(0.0) == math.inf


def test_strings_cannot_grow_without_end() -> None:
    """Arithmetic is for numbers: a string that is doubled 60 times would not fit into any memory."""
    for text in ("word + word", "word * 1000000000", "word * count"):
        with pytest.raises(r4.ShapeError, match="expected numbers"):
            read(text).at(0.0)


@pytest.mark.parametrize(
    "text",
    [
        "__import__", "().__class__", "open(\"/etc/passwd\")", "eval(\"1\")", "robot.__class__.__bases__", "exec(1)",
        "getattr(camera, 1)", "lambda", "sin.__globals__", "camera.__init__", "print(1)", "breakpoint()",
    ],
)  # fmt: skip
def test_nothing_is_run_as_python(text: str) -> None:
    """No names but those that are resolved, and no functions but those of the list."""
    with pytest.raises(ScriptError):
        read(text)


def test_a_function_of_somebody_elses_can_be_called() -> None:
    """Who binds a script may offer more functions."""
    double = ScriptFunction("double", 1, 1, lambda x: x * 2)

    assert read("double(time)", functions={**FUNCTIONS, "double": double}).at(3.0) == 6.0


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_function_answers_or_says_what_it_expects(name: str) -> None:
    """Whatever it is given: a value, a signal, or a ScriptError."""
    for argument in ("0.5", "time", "{0.6, 0.8, 0}", "robot.head.position", '"red"', "none", "camera", "{a: 1}", "{}"):
        text = f"{name}({', '.join([argument] * FUNCTIONS[name].least)})"
        try:
            value = read(text)
        except ScriptError:
            continue
        if isinstance(value, Signal):
            with suppress(r4.Reactive4dError, TypeError, ValueError):
                value.at(0.5)
