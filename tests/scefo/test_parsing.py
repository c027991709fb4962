"""From text to tree, and to errors that say where and what was expected."""

import pickle
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path as File
from typing import Any

import pytest

from reactive4d.errors import Reactive4dError, ScriptError
from reactive4d.scefo.expressions import evaluate
from reactive4d.scefo.parsing import MOST_LETTERS, parse, source
from reactive4d.scefo.trees import (
    MOST_NESTED,
    Attribute,
    Change,
    Curve,
    Define,
    Items,
    Name,
    Number,
    Operation,
    Path,
    Point,
    Script,
    Template,
    Text,
    Use,
)
from reactive4d.scefo.writing import write

PRINTED = File(__file__).with_name("figure1_as_printed.scefo")


def value(text: str) -> Any:
    """The tree of an expression."""
    statement: Any = parse(f"signal (x) {text};").statements[0]
    return statement.value


def refused(text: str) -> ScriptError:
    """The error that a text ends in."""
    with pytest.raises(ScriptError) as caught:
        parse(text)
    return caught.value


# -- figure 1 of the paper ---------------------------------------------------------------------------------------------


def test_figure_1_as_printed_is_refused_where_a_semicolon_stands_for_a_comma() -> None:
    """
    F085: `change (light) shade_val <…>;` is followed by `set_parameter <…>`, which changes an object: there should
    have been a comma. The statement that begins so is refused, and the semicolon is named.
    """
    with pytest.raises(ScriptError) as caught:
        parse(source(PRINTED), file="figure1.scefo")

    error = caught.value
    assert (error.file, error.line, error.column) == ("figure1.scefo", 13, 1)
    assert error.expected[-1] == "',' instead of ';' at 12:57"
    assert str(error).startswith("figure1.scefo:13:1: expected a statement (read, object, template, change,")
    assert str(error).endswith("or ',' instead of ';' at 12:57, got 'set_parameter'")
    assert '  set_parameter <0, {"light_type", "directional"}>,\n  ^' in error.__notes__


def test_figure_1_with_its_semicolon_mended_says_what_the_paper_says() -> None:
    """F085: objects read from files, one made from another, changes as keys, lists and comments."""
    script = parse(source(PRINTED).replace("};\nset", "},\nset").replace(">;\nset", ">,\nset"))

    words = [type(statement).__name__ for statement in script.statements]
    assert words == ["Read"] * 4 + ["Template"] + ["Change"] * 4
    egg: Any = script.statements[4]
    assert egg == Template(Name("egg"), Path(("sphere",)), notes=egg.notes)
    assert egg.notes.behind == ("/* making an object from another one */",)
    light: Any = script.statements[-1]
    assert [operation.operator.text for operation in light.operations] == ["shade_val", "set_parameter", "rotate"]
    assert light.operations[1].attributes == (
        Attribute(None, Curve((Point(0, Items((Text("light_type"), Text("directional")))),))),
    )
    assert script.statements[5].notes.before == (
        "/* values to change operators are of the form: < time, value > */",
        "/* values can be atomic values or lists {enclosed in braces} */",
    )


def test_the_value_of_a_change_knows_its_place() -> None:
    """A colour where a translation belongs is a matter of meaning: who finds it can tell line and column."""
    script: Any = parse(source(PRINTED).replace(">;\nset", ">,\nset"))

    curve = script.statements[7].operations[0].attributes[0].value

    assert curve.points[0].at == (11, 27)
    assert curve.points[0].value.at == (11, 31)
    assert curve.points[0].value.items[0].at == (11, 32)


# -- what the language says --------------------------------------------------------------------------------------------


def test_a_change_has_named_attributes_each_with_its_own_curve() -> None:
    """F083: the interpolation is chosen for each attribute."""
    script = parse('change (a) bend angle = <0, 0>, <2, 90> by catmull_rom after cycle axis = "x", twist 3;')

    angle = Curve((Point(0, Number(0)), Point(2, Number(90))), interpolation="catmull_rom", after="cycle")
    bend = Operation(Name("bend"), (Attribute(Name("angle"), angle), Attribute(Name("axis"), Text("x"))))
    twist = Operation(Name("twist"), (Attribute(None, Number(3)),))
    assert script == Script((Change((Path(("a",)),), (bend, twist)),))


def test_a_change_with_a_name_can_be_used_again() -> None:
    """One change shared by several objects: at once, or by its name."""
    script: Any = parse("change (a, b.c) knee: bend 30; change (d) use knee, mirror;")

    assert script.statements[0].targets == (Path(("a",)), Path(("b", "c")))
    assert script.statements[0].operations[0].label == Name("knee")
    assert script.statements[1].operations == (Use(Name("knee")), Operation(Name("mirror")))


def test_a_key_says_more_than_its_value() -> None:
    """Handles, tension and ease stand inside of the key."""
    curve: Any = parse("signal (x) <-1.5, 2 ease in_out left = {-0.5, 1} tension = -0.5> by tcb;").statements[0]

    assert curve.value.points == (
        Point(-1.5, Number(2), ease="in_out", left=Items((Number(-0.5), Number(1))), tension=Number(-0.5)),
    )


@pytest.mark.parametrize(
    ("text", "same"),
    [
        ("a + b * c", "a + (b * c)"),
        ("a - b * c", "a - (b * c)"),
        ("-a ^ 2", "-(a ^ 2)"),
        ("a ^ b ^ c", "a ^ (b ^ c)"),
        ("2 ^ -a", "2 ^ (-a)"),
        ("a < b and not c or d", "((a < b) and (not c)) or d"),
        ("-a[0]", "-(a[0])"),
    ],
)
def test_operators_bind_as_in_mathematics(text: str, same: str) -> None:
    """Powers before signs before products before sums before comparisons before not, and, or."""
    assert value(f"({text})") == value(f"({same})")


def test_names_are_any_text_in_backquotes() -> None:
    """Words of the language, spaces and dots included."""
    script: Any = parse("object (`left arm`) `my.kind`; signal (x) `time`.`a.b`;")

    assert script.statements[0].name == Name("left arm")
    assert script.statements[1].value == Path(("time", "a.b"))


def test_words_of_statements_are_words_only_where_a_statement_begins() -> None:
    """An object may be called `change` without more ado."""
    script: Any = parse("object (change) read; change (change) template 2;")

    assert script.statements[0].kind == Name("read")
    assert script.statements[1].operations == (Operation(Name("template"), (Attribute(None, Number(2)),)),)


def test_an_empty_text_is_an_empty_script() -> None:
    """So is one of blanks and comments, and a byte order mark is none of the text."""
    assert parse("") == parse(" \n\t") == parse("\ufeff") == Script()
    assert parse("// nothing").after == ("// nothing",)


def test_lines_end_in_any_way() -> None:
    """Windows' line ends and those of old Macs are line ends, in places as well."""
    for end in ("\n", "\r\n", "\r"):
        assert refused(f"object (a) sphere;{end}object (b);").line == 2


# -- errors ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "line", "column", "message"),
    [
        ("change (a) translate <0, 1;", 1, 27, "expected '>', 'ease' or a name, got ';'"),
        ("change (a) translate <0 1>;", 1, 25, "expected ',', got '1'"),
        ("change (a) translate <x, 1>;", 1, 23, "expected 'inf' or a number, got 'x'"),
        ("change (a)\n  scale 2", 2, 10, "expected ',', ';' or a name, got the end"),
        ("change a scale 2;", 1, 8, "expected '(', got 'a'"),
        ("change (a) bend angle 30;", 1, 23, "expected ',', ';', '(', '=' or a name, got '30'"),
        ("object (time) sphere;", 1, 9, "expected a name, got 'time'"),
        ("read (sphere.off) a;", 1, 7, "expected a string, got 'sphere'"),
        ("x", 1, 1, "expected a statement"),
        ("signal (a) 1;;", 1, 14, "expected a statement"),
        ("signal (a) {1, 2;", 1, 17, "expected ',' or '}', got ';'"),
        ("signal (a) 1 +;", 1, 15, "expected a value, got ';'"),
        ("signal (a) a < b;", 1, 14, "expected ',', ';' or a name, got '<'"),
        ('signal (a) "x;\n', 1, 12, "a string that is not closed on its line"),
        ('signal (a) "\\q";', 1, 13, "\\q means nothing in a string"),
        ('signal (a) "\\U00110000";', 1, 13, "\\U00110000 means nothing in a string"),
        ("signal (a) 'x';", 1, 12, '"\'" means nothing here'),
        ("/* x", 1, 1, "a comment that is never closed"),
        ("signal (a) 1..2;", 1, 12, "1..2 is no number"),
        ("signal (a) 12abc;", 1, 12, "12abc is no number"),
        ("signal (a) 1e999;", 1, 12, "1e999 is too large for a number"),
        (f"signal (a) {'9' * 400};", 1, 12, "a number of 400 digits"),
        ("signal (a) nan;", 1, 12, "nan is no value"),
        ("signal (a) x[1.5];", 1, 14, "an index is a whole number"),
        ("signal (a) {b: 1, b: 2};", 1, 19, "'b' stands twice in one list"),
        ("signal (a) <0, 1 speed = 2>;", 1, 18, "a key has no 'speed', but ease, left"),
        ("signal (a) <0, 1 bias = 2 bias = 2>;", 1, 27, "'bias' is said twice"),
        ("signal (a) <0, 1> by step by linear;", 1, 27, "'by' is said twice"),
        ("signal (a) 1 by linear;", 1, 14, "'by' is said of keys <time, value>, and here are none"),
        ("signal (a) 1 b = 2;", 1, 14, "a signal has a value and no attributes"),
        ("signal (a) <0, 1> by linear, <1, 2>;", 1, 30, "a key behind the end of the keys"),
        ("change (a) scale 2, <1, 2>;", 1, 21, "a key behind a value without keys"),
        ("object (a) sphere, <0, 1>;", 1, 20, "expected a name before keys"),
        ("change (a) use b, <0, 1>;", 1, 19, "a change that is used once more takes no values"),
        ("signal (a) <0, 1> by bspline(2.0);", 1, 30, "the degree of a curve is a whole number"),
        ("signal (a) (a < b < c);", 1, 19, "a second comparison, '<'"),
        ("hidden change (a) b;", 1, 8, "expected 'object', 'read' or 'template', got 'change'"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(text: str, line: int, column: int, message: str) -> None:
    """Line, column, and what was expected; with the line itself below."""
    error = refused(text)

    assert (error.line, error.column) == (line, column)
    assert message in str(error)
    assert any(note.endswith("^") for note in error.__notes__)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("change (a) bend angle 30;", "an attribute is written angle = value"),
        ("object (time) sphere;", "as a name it is written `time`"),
        ("signal (a) 'x';", 'strings stand in "double quotes"'),
        ("signal (a) a < b;", "(a < b)"),
        ("signal (a) a | b;", "'and', 'or' and 'not'"),
    ],
)
def test_common_mistakes_come_with_advice(text: str, words: str) -> None:
    """What to write instead stands in a note."""
    assert any(words in note for note in refused(text).__notes__)


def test_a_long_line_is_shown_round_the_place() -> None:
    """The caret stands under the place, of however long a line."""
    error = refused(f"signal (a) {'x + ' * 200}+;")

    shown, caret = error.__notes__[-1].split("\n")
    assert len(shown) <= 102
    assert shown[caret.index("^")] == ";"


def test_the_error_is_one_of_ours_and_can_be_sent_to_another_process() -> None:
    """A ScriptError is a Reactive4dError, and is pickled whole."""
    error = refused("x")
    assert error.__context__ is None  # where Dask is loaded, it would be pickled too

    again = pickle.loads(pickle.dumps(error))
    assert isinstance(error, Reactive4dError)
    assert (str(again), again.line, again.column, again.expected) == (str(error), 1, 1, error.expected)


# -- limits ------------------------------------------------------------------------------------------------------------

DEEP = 5 * MOST_NESTED


@pytest.mark.parametrize(
    "text",
    [
        "(" * DEEP + "x" + ")" * DEEP,
        "{" * DEEP + "}" * DEEP,
        "f(" * DEEP + ")" * DEEP,
        "{a: " * DEEP + "x" + "}" * DEEP,
        "-" * DEEP + "x",
        "(" + "not " * DEEP + "x)",
        "x" + " ^ x" * DEEP,
        "x" + "[0]" * DEEP,
        "keys(<0, " * DEEP + "x" + ">)" * DEEP,
        "(" * 100_000,
        "{-" * 100_000,
        "-" * 100_000,
    ],
)
def test_what_is_nested_too_deep_is_refused(text: str) -> None:
    """Brackets, signs, powers, indices and keys inside of one another: never a RecursionError."""
    assert f"more than {MOST_NESTED}" in str(refused(f"signal (a) {text};"))


@pytest.mark.parametrize("text", ["{", "(-", "max(1, ", "{a: ", "keys(<0, "])
def test_what_is_nested_as_deep_as_allowed_can_be_used(text: str) -> None:
    """It is read, written, compared, hashed, pickled and evaluated, and the stack is not full."""
    ends = {"{": "}", "(-": ")", "max(1, ": ")", "{a: ": "}", "keys(<0, ": ">)"}
    script = parse(f"signal (a) {text * (MOST_NESTED - 1)}x{ends[text] * (MOST_NESTED - 1)};")

    assert parse(write(script)) == script
    assert hash(script) == hash(pickle.loads(pickle.dumps(script)))
    assert evaluate(script.statements[0].value, lambda path: 1.0) is not None  # pyright: ignore


def test_scripts_are_read_by_several_threads_at_once() -> None:
    """Nothing of one reading is left for another."""
    texts = [f"// {i}\nobject (a{i}) sphere; // {i}\n" * 50 for i in range(8)]

    with ThreadPoolExecutor(4) as pool:
        scripts = list(pool.map(parse, texts))

    assert [write(script) for script in scripts] == texts


def test_what_stands_side_by_side_has_no_limit() -> None:
    """A sum of 10,000 terms is not deep, and neither is a list."""
    assert len(value(" + ".join(["x"] * 10_000)).operands) == 10_000
    assert len(value("{" + ", ".join(["-x ^ 2"] * 10_000) + "}").items) == 10_000


def test_a_text_that_is_too_large_is_not_even_looked_at() -> None:
    """10 million characters are the limit."""
    assert "at most 10000000" in str(refused(" " * (MOST_LETTERS + 1)))


def test_a_file_is_text_in_utf_8(tmp_path: File) -> None:
    """A byte that is none is told with its place."""
    path = tmp_path / "a.scefo"
    path.write_bytes(b"// \xc3\xa4\n/* \xff */")

    with pytest.raises(ScriptError, match="byte 0xff") as caught:
        source(path)
    assert (caught.value.line, caught.value.column) == (2, 4)
    path.write_bytes("signal (ä) 1;".encode())
    assert parse(source(path)).statements[0] == Define("signal", Name("ä"), Number(1))


def test_lark_is_loaded_with_the_first_script_only() -> None:
    """Whoever reads no script pays for no parser."""
    code = "import sys, reactive4d, reactive4d.scefo.parsing; assert 'lark' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
