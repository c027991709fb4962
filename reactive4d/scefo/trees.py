"""Scripts as trees: immutable values that know where in the text they stood, and which comments belong to them.

Trees compare by what they say and by their comments, not by their places. What a tree holds, a text can say: `writing`
writes it, and `parsing` reads the same tree back.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any, ClassVar, Final, NamedTuple, TypeAlias

from reactive4d.errors import ScriptError, ShapeError, hint

__all__ = [
    "MOST_NESTED",
    "NOWHERE",
    "NO_NOTES",
    "Attribute",
    "Binary",
    "Boolean",
    "Call",
    "Chain",
    "Change",
    "Constant",
    "Create",
    "Curve",
    "Define",
    "Expression",
    "Index",
    "Items",
    "Name",
    "Notes",
    "Nothing",
    "Number",
    "Operation",
    "Parameter",
    "Path",
    "Place",
    "Point",
    "Read",
    "Record",
    "Script",
    "Show",
    "Slice",
    "Statement",
    "Template",
    "Text",
    "Unary",
    "Use",
]

MOST_NESTED: Final = 64  # expressions inside of one another


class Place(NamedTuple):
    """Where something stands in a text: line and column, counted from 1; (0, 0) where it stands in none."""

    line: int
    column: int


class Notes(NamedTuple):
    """The comments that belong to something, delimiters included.

    Those of `before` stand on lines of their own before it; an empty one is a blank line (before statements only).
    Those of `behind` follow on its last line; only the last of them may be a `//` comment.
    """

    before: tuple[str, ...] = ()
    behind: tuple[str, ...] = ()


NOWHERE: Final = Place(0, 0)
NO_NOTES: Final = Notes()


def _deepen(tree: Any, parts: Iterable[Any]) -> None:
    """Note how deep a tree is.

    Raises:
        ScriptError: deeper than anybody wants to read.
    """
    depth = 1 + max((part.depth for part in parts), default=0)
    if depth > MOST_NESTED:
        line, column = tree.at
        where = {} if tree.at == NOWHERE else {"line": line, "column": column}
        error = ScriptError(f"nested more than {MOST_NESTED} deep", **where)
        raise hint(error, "name a part of it: signal (name) value;")
    object.__setattr__(tree, "depth", depth)


# -- expressions -------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True, eq=False)
class Number:
    """A number: whole, or floating point; not NaN.

    >>> Number(2) == Number(2.0), Number(2.0) == Number(2.0)
    (False, True)
    """

    value: float
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)
    depth: ClassVar[int] = 0

    def __post_init__(self) -> None:
        if type(self.value) not in (int, float) or math.isnan(self.value):
            raise ShapeError(f"expected a number that can be written, got {self.value!r}")

    def __eq__(self, other: object) -> bool:
        # 2 is not 2.0 and 0.0 not -0.0: a script tells them apart.
        return isinstance(other, Number) and repr(self.value) == repr(other.value)

    def __hash__(self) -> int:
        return hash(repr(self.value))


@dataclass(frozen=True, slots=True)
class Text:
    """A string."""

    value: str
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)
    depth: ClassVar[int] = 0


@dataclass(frozen=True, slots=True)
class Boolean:
    """`true` or `false`."""

    value: bool
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)
    depth: ClassVar[int] = 0


@dataclass(frozen=True, slots=True)
class Nothing:
    """`none`."""

    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)
    depth: ClassVar[int] = 0


@dataclass(frozen=True, slots=True)
class Constant:
    """A word of the language that stands for a value: `time` or `pi`."""

    name: str
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)
    depth: ClassVar[int] = 0


@dataclass(frozen=True, slots=True)
class Path:
    """Names joined by dots: an object, a signal, an attribute or a channel of an object."""

    names: tuple[str, ...]
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)
    depth: ClassVar[int] = 0

    def __str__(self) -> str:
        return ".".join(self.names)


@dataclass(frozen=True, slots=True)
class Call:
    """A function of the language, applied to values."""

    function: str
    arguments: "tuple[Expression, ...]"
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)
    depth: int = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        _deepen(self, self.arguments)


@dataclass(frozen=True, slots=True)
class Items:
    """A list: `{1, 2, 3}`."""

    items: "tuple[Expression, ...]"
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)
    depth: int = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        _deepen(self, self.items)


@dataclass(frozen=True, slots=True)
class Record:
    """Values by name, in order: `{head: ball, body: box}`."""

    entries: "tuple[tuple[str, Expression], ...]"
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)
    depth: int = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        _deepen(self, [value for _, value in self.entries])


@dataclass(frozen=True, slots=True)
class Chain:
    """Operands joined from the left by operators of one rank: `a + b - c`, `a * b / c`, `a and b`.

    The operators, one fewer than the operands, are all of `+ -`, of `* / %`, or all `and`, or all `or`.
    """

    operands: "tuple[Expression, ...]"
    operators: tuple[str, ...]
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)
    depth: int = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        _deepen(self, self.operands)


@dataclass(frozen=True, slots=True)
class Unary:
    """An operator before its operand: `-`, `+` or `not`. A negative number is a `Number`."""

    operator: str
    operand: "Expression"
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)
    depth: int = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        _deepen(self, (self.operand,))


@dataclass(frozen=True, slots=True)
class Binary:
    """A power, or a comparison: `^`, `<`, `<=`, `>`, `>=`, `==`, `!=`."""

    operator: str
    left: "Expression"
    right: "Expression"
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)
    depth: int = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        _deepen(self, (self.left, self.right))


class Slice(NamedTuple):
    """A slice in an index, as in Python: from `start` up to `stop` by `step`."""

    start: int | None = None
    stop: int | None = None
    step: int | None = None


@dataclass(frozen=True, slots=True)
class Index:
    """A component, counted from 0 as in Python: `x[0]`, `x[1:]`, `x[..., 2]`; the ellipsis is "..."."""

    value: "Expression"
    indices: tuple[int | Slice | str, ...]
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)
    depth: int = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        _deepen(self, (self.value,))


@dataclass(frozen=True, slots=True)
class Point:
    """A key: a time, the value there, and what else it says; `left` and `right` are pairs (dt, dv)."""

    time: float
    value: "Expression"
    ease: str | None = field(default=None, kw_only=True)
    left: "Expression | None" = field(default=None, kw_only=True)
    right: "Expression | None" = field(default=None, kw_only=True)
    tension: "Expression | None" = field(default=None, kw_only=True)
    continuity: "Expression | None" = field(default=None, kw_only=True)
    bias: "Expression | None" = field(default=None, kw_only=True)
    notes: Notes = field(default=NO_NOTES, kw_only=True)
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)
    depth: int = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "time", float(self.time))
        if math.isnan(self.time):
            raise ShapeError("a key cannot stand at nan s")
        told = (self.left, self.right, self.tension, self.continuity, self.bias)
        object.__setattr__(self, "depth", max(part.depth for part in (self.value, *told) if part is not None))


@dataclass(frozen=True, slots=True)
class Curve:
    """Keys in time, with how to go from one to the next, and what holds before the first and after the last.

    What is None is not said: the default of `reactive4d.keys` holds.
    """

    points: tuple[Point, ...]
    interpolation: str | None = field(default=None, kw_only=True)
    degree: int | None = field(default=None, kw_only=True)  # said together with an interpolation only
    ease: str | None = field(default=None, kw_only=True)
    before: str | None = field(default=None, kw_only=True)
    after: str | None = field(default=None, kw_only=True)
    kind: str | None = field(default=None, kw_only=True)
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)
    depth: int = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        if not self.points:
            raise ShapeError("a curve has at least one key")
        _deepen(self, self.points)


Expression: TypeAlias = (
    Number | Text | Boolean | Nothing | Constant | Path | Call | Items | Record | Chain | Unary | Binary | Index | Curve
)


# -- statements --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Name:
    """A name that a statement gives or mentions; a kind's or a change's may have dots."""

    text: str
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True, slots=True)
class Attribute:
    """A value under a name, `angle = 30`; a change's first value needs no name."""

    name: Name | None
    value: Expression
    notes: Notes = field(default=NO_NOTES, kw_only=True)
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Operation:
    """A change as it stands in a statement: its operator, its values, and its own name if it has one."""

    operator: Name
    attributes: tuple[Attribute, ...] = ()
    label: Name | None = field(default=None, kw_only=True)
    notes: Notes = field(default=NO_NOTES, kw_only=True)
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Use:
    """A change that has a name, once more: it is shared."""

    name: Name
    notes: Notes = field(default=NO_NOTES, kw_only=True)
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Read:
    """`read ("sphere.off") sphere;`: an object from a file."""

    file: Text
    name: Name
    settings: tuple[Attribute, ...] = ()
    is_hidden: bool = field(default=False, kw_only=True)
    notes: Notes = field(default=NO_NOTES, kw_only=True)
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Create:
    """`object (ball) sphere radius = 2;`: an object of a kind."""

    name: Name
    kind: Name
    settings: tuple[Attribute, ...] = ()
    is_hidden: bool = field(default=False, kw_only=True)
    notes: Notes = field(default=NO_NOTES, kw_only=True)
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Template:
    """`template (egg) sphere;`: an object made from another one, its prototype, which may vary."""

    name: Name
    prototype: Expression
    settings: tuple[Attribute, ...] = ()
    is_hidden: bool = field(default=False, kw_only=True)
    notes: Notes = field(default=NO_NOTES, kw_only=True)
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Show:
    """`show (globe) ball;`: an object put into the scene, under this name."""

    name: Name
    target: Name
    notes: Notes = field(default=NO_NOTES, kw_only=True)
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Change:
    """`change (ball) translate <0, {1, 1, 1}>, scale 2;`: changes for one object, or shared by several."""

    targets: tuple[Path, ...]
    operations: tuple[Operation | Use, ...]
    notes: Notes = field(default=NO_NOTES, kw_only=True)
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Define:
    """`signal (speed) 3 * time;` names an expression; with the word "variable" a signal that one sets."""

    word: str
    name: Name
    value: Expression
    notes: Notes = field(default=NO_NOTES, kw_only=True)
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Parameter:
    """`parameter (length) 1.0 bounds = {0.2, 2.0} doc = "length of the rod [m]";`: what a reader drives."""

    name: Name
    default: Expression
    settings: tuple[Attribute, ...] = ()
    notes: Notes = field(default=NO_NOTES, kw_only=True)
    at: Place = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


Statement: TypeAlias = Read | Create | Template | Show | Change | Define | Parameter


@dataclass(frozen=True, slots=True)
class Script:
    """Statements in order, and the comments after the last of them."""

    statements: tuple[Statement, ...] = ()
    after: tuple[str, ...] = ()
