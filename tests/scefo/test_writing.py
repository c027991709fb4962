"""What is written is read back as the same tree, and what is read is written with all its comments."""

import itertools
import re
from collections.abc import Callable
from dataclasses import replace
from random import Random
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive4d.scefo import trees
from reactive4d.scefo.parsing import parse
from reactive4d.scefo.trees import (
    Attribute,
    Binary,
    Boolean,
    Call,
    Chain,
    Change,
    Constant,
    Create,
    Curve,
    Define,
    Index,
    Items,
    Name,
    Notes,
    Nothing,
    Number,
    Operation,
    Parameter,
    Path,
    Point,
    Read,
    Record,
    Script,
    Show,
    Slice,
    Template,
    Text,
    Unary,
    Use,
)
from reactive4d.scefo.words import RESERVED, STATEMENTS
from reactive4d.scefo.writing import expression_text, write

# -- every tree there is -----------------------------------------------------------------------------------------------

WORDS = [
    *sorted(RESERVED),
    *sorted(STATEMENTS),
    "ball",
    "x2",
    "größe",
    "a b",
    "",
    "a.b",
    "`",
    "\\",
    "0x",
    "\n",
    "λ\ud800",
]
TEXTS = ["", "red", 'a "quoted"\n\\ text', "\x00\x7f\u2028\ud800", "/* none */ // ;"]
NUMBERS = [0, 1, -2, 10**40, 0.0, -0.0, 0.5, -1e-300, 1e22, 0.1 + 0.2, float("inf"), float("-inf")]
COMMENTS = ["/* one */", "/**/", "/* two\n   lines */", '/* "quoted" // <0, 1>; */']
RANKS = [["+", "-"], ["*", "/", "%"], ["and"], ["or"]]


class Trees:
    """Any tree that the language has, in the form in which it is read."""

    def __init__(self, random: Random) -> None:
        self.random = random

    def name(self) -> str:
        return self.random.choice(WORDS)

    def some(self, make: Callable[[], Any], least: int, most: int) -> tuple[Any, ...]:
        return tuple([make() for _ in range(self.random.randint(least, most))])

    def perhaps(self, make: Callable[[], Any]) -> Any:
        return make() if self.random.random() < 0.3 else None

    def expression(self, depth: int = 4) -> Any:
        kinds: list[Callable[[int], Any]] = [
            lambda _: Number(self.random.choice(NUMBERS)),
            lambda _: Text(self.random.choice(TEXTS)),
            lambda _: Boolean(self.random.random() < 0.5),
            lambda _: Nothing(),
            lambda _: Constant(self.random.choice(["time", "pi"])),
            lambda _: Path(self.some(self.name, 1, 3)),
        ]
        if depth:
            kinds = [*kinds[:2], kinds[-1], *[self.call, self.items, self.record, self.chain, self.unary], self.binary]
            kinds += [self.index, self.curve]
        return self.random.choice(kinds)(depth - 1)

    def call(self, depth: int) -> Call:
        return Call(self.name(), self.some(lambda: self.expression(depth), 0, 3))

    def items(self, depth: int) -> Items:
        return Items(self.some(lambda: self.expression(depth), 0, 3))

    def record(self, depth: int) -> Record:
        names = dict.fromkeys(self.some(self.name, 1, 3))
        return Record(tuple([(name, self.expression(depth)) for name in names]))

    def chain(self, depth: int) -> Chain:
        signs = self.random.choice(RANKS)
        operands = self.some(lambda: self.expression(depth), 2, 4)
        return Chain(operands, tuple([self.random.choice(signs) for _ in operands[1:]]))

    def unary(self, depth: int) -> Any:
        sign, operand = self.random.choice(["-", "+", "not"]), self.expression(depth)
        # A minus before a number that has none is a part of it, in a tree as in a text.
        if sign == "-" and isinstance(operand, Number) and not repr(operand.value).startswith("-"):
            return Number(-operand.value)
        return Unary(sign, operand)

    def binary(self, depth: int) -> Binary:
        sign = self.random.choice(["^", "<", "<=", ">", ">=", "==", "!="])
        return Binary(sign, self.expression(depth), self.expression(depth))

    def index(self, depth: int) -> Index:
        def whole() -> Any:
            return self.random.randint(-3, 3)

        def one() -> Any:
            ends = [self.perhaps(whole) for _ in range(3)]
            return self.random.choice([whole(), "...", Slice(*ends)])

        return Index(self.expression(depth), self.some(one, 1, 3))

    def notes(self) -> Notes:
        if self.random.random() < 0.6:
            return Notes()
        tail = self.some(lambda: self.random.choice(COMMENTS), 0, 2)
        before = self.some(lambda: self.random.choice([*COMMENTS, "// line"]), 0, 2)
        return Notes(before, (*tail, "// to the end of the line") if self.random.random() < 0.3 else tail)

    def curve(self, depth: int, notes: Callable[[], Notes] = Notes) -> Curve:
        def point() -> Point:
            told = {name: self.perhaps(lambda: self.expression(depth)) for name in ("left", "right", "tension", "bias")}
            time = self.random.choice(NUMBERS)
            value = self.expression(depth)
            return Point(time, value, ease=self.perhaps(self.name), **told, notes=notes())

        points = list(self.some(point, 1, 3))
        # Comments at the ends of keys belong to what is around.
        points[0] = replace(points[0], notes=Notes((), points[0].notes.behind))
        points[-1] = replace(points[-1], notes=Notes(points[-1].notes.before, ()))
        told = {name: self.perhaps(self.name) for name in ("interpolation", "ease", "before", "after", "kind")}
        degree = None if told["interpolation"] is None else self.perhaps(lambda: self.random.randint(0, 9))
        return Curve(tuple(points), degree=degree, **told)

    def value(self) -> Any:
        return self.curve(3, self.notes) if self.random.random() < 0.4 else self.expression()

    def attributes(self, *, unnamed: bool = False) -> tuple[Attribute, ...]:
        found: list[Attribute] = []
        if unnamed and self.random.random() < 0.6:
            value = self.value()
            # Comments beside an expression without a name belong to the operation.
            found.append(Attribute(None, value, notes=self.notes() if isinstance(value, Curve) else Notes()))
        found += self.some(lambda: Attribute(Name(self.name()), self.value(), notes=self.notes()), 0, 3)
        if found:
            # Comments behind the last one belong to the whole.
            found[-1] = replace(found[-1], notes=Notes(found[-1].notes.before, ()))
        return tuple(found)

    def dotted(self) -> Name:
        return Name(".".join([name.replace(".", "") for name in self.some(self.name, 1, 2)]))

    def operation(self) -> Any:
        if self.random.random() < 0.2:
            return Use(Name(self.name()), notes=self.notes())
        label = self.perhaps(lambda: Name(self.name()))
        return Operation(self.dotted(), self.attributes(unnamed=True), label=label, notes=self.notes())

    def statement(self) -> Any:
        name, notes, is_hidden = Name(self.name()), self.notes(), self.random.random() < 0.3
        kind = self.random.randint(0, 6)
        if kind == 0:
            file = Text(self.random.choice(TEXTS))
            return Read(file, name, self.attributes(), is_hidden=is_hidden, notes=notes)
        if kind == 1:
            return Create(name, self.dotted(), self.attributes(), is_hidden=is_hidden, notes=notes)
        if kind == 2:
            return Template(name, self.bare(), self.attributes(), is_hidden=is_hidden, notes=notes)
        if kind == 3:
            return Show(name, Name(self.name()), notes=notes)
        if kind == 4:
            found = list(self.some(self.operation, 1, 3))
            found[-1] = replace(found[-1], notes=Notes(found[-1].notes.before, ()))
            return Change(self.some(lambda: Path(self.some(self.name, 1, 2)), 1, 2), tuple(found), notes=notes)
        if kind == 5:
            return Define(self.random.choice(["signal", "variable"]), name, self.bare(), notes=notes)
        return Parameter(name, self.bare(), self.attributes(), notes=notes)

    def bare(self) -> Any:
        """A value; comments at its ends belong to its statement."""
        return self.value()

    def script(self) -> Script:
        found: list[Any] = []
        for i, statement in enumerate(self.some(self.statement, 0, 4)):
            before = self.random.choice([(), ("",), ("", "/* part */", "")]) if i else ()
            notes = statement.notes
            found.append(replace(statement, notes=Notes((*before, *notes.before), notes.behind)))
        after = self.random.choice([(), ("// the end",), ("", "/* the end */") if found else ()])
        return Script(tuple(found), after)


# A tree takes hundreds of choices: one seed for all of them is a hundred times as fast as a draw for each.
trees_at_random = st.integers(0, 2**32).map(lambda seed: Trees(Random(seed)))


@given(trees_at_random)
def test_every_expression_can_be_written_and_read(made: Trees) -> None:
    """An expression that is written and read again is the same."""
    tree = made.expression()

    assert parse(f"signal (x) ({expression_text(tree)});").statements[0].value == tree  # pyright: ignore


@given(trees_at_random)
def test_every_script_can_be_written_and_read(made: Trees) -> None:
    """A script that is written and read again is the same, comments and blank lines included."""
    script = made.script()
    text = write(script)

    assert parse(text) == script
    assert write(parse(text)) == text


def test_places_are_no_part_of_what_a_tree_says() -> None:
    """Trees are compared without their places, but know them."""
    a, b = parse("object (a) sphere;"), parse("\n\n   object (a) sphere;")

    assert a == b
    assert a.statements[0].at == (1, 1)
    assert b.statements[0].at == (3, 4)


# -- comments ----------------------------------------------------------------------------------------------------------

COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
PIECES = [
    "change", "(", "a", ",", "b", ")", "k", ":", "bend", "angle", "=", "<", "0", ",", "1", "+", "2", "ease", "in", ">",
    ",", "<", "2", ",", "{", "x", ",", "f", "(", "3", ")", "}", "tension", "=", "1", ">", "by", "linear", "axis", "=",
    "keys", "(", "<", "0", ",", "1", ">", ",", "<", "1", ",", "2", ">", ")", ",", "use", "k", ",", "move", "<", "0",
    ",", "1", ">", ";", "hidden", "template", "(", "c", ")", "a", "size", "=", "2", ";",
]  # fmt: skip


@pytest.mark.parametrize("gap", range(len(PIECES) + 1))
@pytest.mark.parametrize("shape", [" {} ", "\n{}\n", " {}\n"])
def test_no_comment_is_lost_wherever_it_stands(gap: int, shape: str) -> None:
    """A comment between any two tokens is still there when the script is written, and the script says the same."""
    text = "".join([(shape.format("/* here */") if i == gap else " ") + piece for i, piece in enumerate([*PIECES, ""])])
    script = parse(text)

    again = write(script)

    assert COMMENT.findall(again) == ["/* here */"]
    assert parse(again) == script
    assert COMMENT.sub("", again).split() == COMMENT.sub("", write(parse(" ".join(PIECES)))).split()


def test_all_comments_at_once_are_kept_in_their_order() -> None:
    """Comments everywhere, of both kinds, are all kept."""
    numbers = itertools.count()
    text = "".join([f"{piece} /* {next(numbers)} */ // {next(numbers)}\n" for piece in PIECES])
    script = parse(text)

    again = write(script)

    found = sorted(int(number) for number in re.findall(r"\d+(?= \*/)|(?<=// )\d+$", again, re.MULTILINE))
    assert found == list(range(next(numbers)))
    assert parse(again) == script


def test_a_comment_stays_beside_what_it_is_about() -> None:
    """Comments before and behind statements, changes, attributes and keys stay where they were."""
    text = """\
/* the ball */
object (ball) sphere; // round

// what it does
change (ball)
    /* up and down */
    translate
        <0, {0, 0, 0}>, // start
        // the top
        <1, {0, 0, 2}> by catmull_rom after oscillate, /* for ever */
    scale 2; // large
// the end
"""

    assert write(parse(text)) == text


def test_long_statements_are_broken_where_a_reader_would_break_them() -> None:
    """One line while it fits; then a line for each change, attribute and key."""
    key = "<0, {1000000, 2000000, 3000000}>"

    assert write(parse(f"change (a) translate {key};")) == f"change (a) translate {key};\n"
    assert write(parse(f"change (a) translate {key}, {key}, {key};")) == (
        f"change (a)\n    translate\n        {key},\n        {key},\n        {key};\n"
    )


# -- numbers and strings -----------------------------------------------------------------------------------------------


@given(st.floats(allow_nan=False) | st.integers(-(10**300), 10**300))
def test_numbers_keep_their_last_bit_and_their_type(value: float) -> None:
    """2 is read as a whole number, 2.0 as none, -0.0 as itself."""
    tree: Any = parse(f"signal (x) {expression_text(Number(value))};").statements[0]

    assert repr(tree.value.value) == repr(value)


@given(st.text(alphabet=st.characters(codec=None)))
def test_any_string_can_be_written(text: str) -> None:
    """Quotes, backslashes, control characters and lone surrogates included."""
    tree: Any = parse(f"signal (x) {expression_text(Text(text))};").statements[0]

    assert tree.value.value == text


def test_trees_refuse_what_no_text_can_say() -> None:
    """NaN is no number of a script, and a curve has keys."""
    for make in (lambda: Number(float("nan")), lambda: Point(float("nan"), Number(1)), lambda: Curve(())):
        with pytest.raises(trees.ShapeError):
            make()
