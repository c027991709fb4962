"""Whatever a text is, it ends in a tree or in a ScriptError that points into it."""

import re
from pathlib import Path
from random import Random
from typing import Any

import pytest

import reactive4d as r4
from reactive4d.errors import ScriptError
from reactive4d.scefo import trees
from reactive4d.scefo.expressions import evaluate
from reactive4d.scefo.parsing import parse
from reactive4d.scefo.writing import write

PRINTED = Path(__file__).with_name("figure1_as_printed.scefo").read_text(encoding="utf-8")
PAGE = (Path(__file__).parents[2] / "docs" / "scefo.md").read_text(encoding="utf-8")
TEXTS = [PRINTED, PRINTED.replace(">;\nset", ">,\nset"), *re.findall(r"```scefo\n(.*?)```", PAGE, re.DOTALL)]
PIECES = [
    *"(){}[]<>,;:.=+-*/%^\"`'\\#&|!?@$~\n\t\0\u2028\ud800 ", "/*", "*/", "//", "...", "<=", "==", "change", "object",
    "template", "hidden", "use", "by", "as", "ease", "before", "after", "keys(", "not", "and", "or", "true", "none",
    "time", "inf", "nan", "1e999", "1e5", "-0.0", "99999999999999999999", "0x1", "item(", "where(", "^ 9 ^ 9 ^ 9",
    "<0, 1>", "{}", "{a: 1}", '"\\u0041"', '"\\x"', "x[0]", "x[1:2, ...]", "`", "ä", "é", "\r\n", "((((", "}}}}",
]  # fmt: skip
X = r4.Variable(2.0, name="x")


def mutated(random: Random) -> str:
    """A script with a few faults."""
    text = random.choice(TEXTS)
    for _ in range(random.choice([1, 1, 1, 2, 3, 10])):
        i, j = sorted([random.randint(0, len(text)), random.randint(0, len(text))])
        j = min(j, i + random.choice([1, 1, 2, 8, 30, 500]))
        kind = random.randint(0, 5)
        if kind == 0:
            text = text[:i] + text[j:]
        elif kind == 1:
            text = text[:i] + random.choice(PIECES) + text[i:]
        elif kind == 2:
            text = text[:i] + text[i:j] * random.choice([2, 3, 40]) + text[j:]
        elif kind == 3:
            text = text[:i] + random.choice(PIECES) + text[j:]
        elif kind == 4:
            tokens = re.split(r"(\W)", text)
            a, b = random.randrange(len(tokens)), random.randrange(len(tokens))
            tokens[a], tokens[b] = tokens[b], tokens[a]
            text = "".join(tokens)
        else:
            text = text[:j]
    return text


def expressions(statement: Any) -> list[Any]:
    """The values in a statement."""
    if isinstance(statement, trees.Change):
        operations = [x for x in statement.operations if isinstance(x, trees.Operation)]
        return [attribute.value for operation in operations for attribute in operation.attributes]
    if isinstance(statement, trees.Define):
        return [statement.value]
    settings = [setting.value for setting in getattr(statement, "settings", ())]
    return [*settings, *[getattr(statement, name) for name in ("prototype", "default") if hasattr(statement, name)]]


def is_helpful(error: ScriptError, text: str) -> bool:
    """Whether an error points into the text, and shows the line."""
    lines = re.split("\r\n|\r|\n", text)
    line, column = error.line or 0, error.column or 0
    return (
        error.file == "fuzz.scefo"
        and 1 <= line <= len(lines)
        and 1 <= column <= len(lines[line - 1]) + 1
        and error.__notes__[-1].endswith("^")
    )


def meaning(expression: Any) -> ScriptError | None:
    """What is wrong with an expression, if anything."""
    try:
        evaluate(expression, lambda path: X)
    except ScriptError as error:
        return error
    return None


def check(text: str) -> bool:
    """Whether a text is a script; if not, its error is a good one."""
    try:
        script = parse(text, file="fuzz.scefo")
    except ScriptError as caught:
        error = caught
    else:
        assert parse(write(script)) == script
        wrong = [meaning(expression) for statement in script.statements for expression in expressions(statement)]
        assert all(error is None or error.line for error in wrong)
        return True
    assert is_helpful(error, text), text
    return False


@pytest.mark.parametrize("part", range(10))
def test_mutated_scripts_end_in_a_tree_or_in_a_script_error(part: int) -> None:
    """1,000 scripts with deletions, insertions, repetitions, swaps and cuts: never another exception."""
    random = Random(part)

    good = [check(mutated(random)) for _ in range(100)]

    assert any(good)
    assert not all(good)


def test_every_beginning_of_a_script_ends_so() -> None:
    """A text may stop anywhere."""
    text = "".join(TEXTS[1:4])
    for i in range(0, len(text), 3):
        check(text[:i])


def test_any_soup_of_pieces_ends_so() -> None:
    """Tokens without any order."""
    random = Random(0)
    for _ in range(300):
        check("".join([random.choice(PIECES) for _ in range(random.randint(0, 30))]))
