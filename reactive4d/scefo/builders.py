"""From what the parser found to the tree: one method for each rule of the grammar, called by the rule's name."""

from dataclasses import replace
from typing import Any, Final

from reactive4d.scefo.drafts import (
    Draft,
    DraftedOperation,
    Option,
    gathered,
    operations_of,
    taken_from_last,
)
from reactive4d.scefo.notes import behind
from reactive4d.scefo.precedences import arithmetic, logic
from reactive4d.scefo.refusals import wrong
from reactive4d.scefo.tokens import Token
from reactive4d.scefo.trees import (
    NO_NOTES,
    Attribute,
    Boolean,
    Call,
    Change,
    Constant,
    Create,
    Curve,
    Define,
    Expression,
    Index,
    Items,
    Name,
    Notes,
    Nothing,
    Number,
    Parameter,
    Path,
    Point,
    Read,
    Record,
    Script,
    Show,
    Slice,
    Statement,
    Template,
    Text,
    Use,
)

__all__ = ["Builder"]

_KEY_SETTINGS: Final = ("left", "right", "tension", "continuity", "bias")


class Builder:
    """The methods that lark calls, each with the list of what its rule is made of."""

    # -- statements ------------------------------------------------------------------------------------------------

    def start(self, parts: list[Statement]) -> Script:
        """All statements."""
        return Script(tuple(parts))

    def read(self, parts: list[Any]) -> Statement:
        """`read ("file") name settings;`."""
        first, is_hidden, (file, name, body) = _opened(parts)
        _, settings, notes = _valued(first, None, body)
        return Read(self.text([file]), name, settings, is_hidden=is_hidden, notes=notes, at=first.at)

    def create(self, parts: list[Any]) -> Statement:
        """`object (name) kind settings;`."""
        first, is_hidden, (name, kind, body) = _opened(parts)
        _, settings, notes = _valued(first, None, body)
        return Create(name, kind, settings, is_hidden=is_hidden, notes=notes, at=first.at)

    def template(self, parts: list[Any]) -> Statement:
        """`template (name) prototype settings;`."""
        first, is_hidden, (name, value, body) = _opened(parts)
        prototype, settings, notes = _valued(first, value, body)
        return Template(name, prototype, settings, is_hidden=is_hidden, notes=notes, at=first.at)

    def define(self, parts: list[Any]) -> Statement:
        """`signal (name) value;`, `variable (name) value;`."""
        first, name, value, body = parts
        content, settings, notes = _valued(first, value, body)
        if settings:
            raise wrong(f"a {first.text} has a value and no attributes", settings[0].at, expected=("';'",))
        return Define(first.text, name, content, notes=notes, at=first.at)

    def parameter(self, parts: list[Any]) -> Statement:
        """`parameter (name) default settings;`."""
        first, name, value, body = parts
        default, settings, notes = _valued(first, value, body)
        return Parameter(name, default, settings, notes=notes, at=first.at)

    def show(self, parts: list[Any]) -> Statement:
        """`show (name) object;`."""
        first, name, target = parts
        return Show(name, target, notes=_notes(first), at=first.at)

    def change(self, parts: list[Any]) -> Statement:
        """`change (objects) operations;`."""
        first, *targets, operations = parts
        found: list[Any] = operations_of(operations)
        notes = _notes(first, taken_from_last(found))
        return Change(tuple([x for x in targets if x is not None]), tuple(found), notes=notes, at=first.at)

    # -- their parts -----------------------------------------------------------------------------------------------

    def name(self, parts: list[Token]) -> Name:
        """The name of an object or a signal."""
        return Name(parts[0].value, at=parts[0].at)

    def dotted(self, parts: list[Token]) -> Name:
        """The name of a kind or of a change."""
        return Name(".".join([part.value for part in parts]), at=parts[0].at)

    def label(self, parts: list[Token]) -> Token:
        """The name of one change."""
        return parts[0]

    def body(self, parts: list[Any]) -> list[Any]:
        """Attributes, options, further keys, and the commas before these."""
        return parts

    def operations(self, parts: list[Any]) -> list[Any]:
        """The same with operations."""
        return parts

    def operation(self, parts: list[Any]) -> DraftedOperation:
        """An operator and its values."""
        label, operator, value, *rest = parts
        first = operator[0] if label is None else label
        made = DraftedOperation(None if label is None else self.name([label]), self.dotted(operator), NO_NOTES)
        if value is not None:
            made.drafts.append(Draft(None, value))
        gathered(made.drafts, rest)
        made.notes = _notes(first)
        return made

    def operator(self, parts: list[Token]) -> list[Token]:
        """The name of a change, as tokens."""
        return parts

    def use(self, parts: list[Token]) -> Use:
        """A change that has a name, once more."""
        first, name = parts
        return Use(Name(name.value, at=name.at), notes=_notes(first), at=first.at)

    def attribute(self, parts: list[Any]) -> Draft:
        """A value under a name."""
        token, value = parts
        return Draft(Name(token.value, at=token.at), value, _notes(token))

    def by(self, parts: list[Any]) -> Option:
        """An interpolation, and perhaps a degree."""
        token, name, degree = parts
        if degree is None:
            return Option(token, {"interpolation": name.value})
        if type(degree.value) is not int:
            raise wrong("the degree of a curve is a whole number", degree.at, expected=("a whole number",))
        return Option(token, {"interpolation": name.value, "degree": degree.value})

    def option(self, parts: list[Token]) -> Option:
        """An ease, an extrapolation, or the kind of the values."""
        word, name = parts
        return Option(word, {"kind" if word.text == "as" else word.text: name.value})

    # -- keys ------------------------------------------------------------------------------------------------------

    def point(self, parts: list[Any]) -> Point:
        """A key."""
        first, moment, value, *settings, _ = parts
        told: dict[str, Any] = {}
        for name, setting in settings:
            if name.text not in (*_KEY_SETTINGS, "ease"):
                expected = ("ease", *_KEY_SETTINGS)
                raise wrong(f"a key has no {name.text!r}, but {', '.join(expected)}", name.at, expected=expected)
            if name.text in told:
                raise wrong(f"{name.text!r} is said twice", name.at)
            told[name.text] = setting
        return Point(moment, value, **told, notes=_notes(first), at=first.at)

    def moment(self, parts: list[Any]) -> float:
        """The time of a key."""
        sign, token = parts
        number = float("inf") if token.type == "INF" else float(token.value)
        return -number if sign is not None else number

    def setting(self, parts: list[Any]) -> tuple[Token, Expression]:
        """What a key says besides its value."""
        return parts[0], parts[1]

    def ease(self, parts: list[Token]) -> tuple[Token, str]:
        """How the span behind a key is run through."""
        return parts[0], parts[1].value

    def keys(self, parts: list[Any]) -> Curve:
        """Keys inside of an expression; their comments belong to what is around."""
        first, point, *rest = parts
        draft = Draft(None, _bare(point))
        first.comments.release(first.index)
        for part in rest:
            if isinstance(part, Option):
                draft.say(part)
            else:
                draft.points.append(_bare(part))
        return Curve(tuple(draft.points), **draft.options, at=first.at)

    # -- expressions -----------------------------------------------------------------------------------------------

    def number(self, parts: list[Token]) -> Number:
        """A number, or infinity."""
        token = parts[0]
        return Number(float("inf") if token.type == "INF" else token.value, at=token.at)

    def text(self, parts: list[Token]) -> Text:
        """A string."""
        return Text(parts[0].value, at=parts[0].at)

    def boolean(self, parts: list[Token]) -> Boolean:
        """A truth value."""
        return Boolean(parts[0].type == "TRUE", at=parts[0].at)

    def nothing(self, parts: list[Token]) -> Nothing:
        """Nothing."""
        return Nothing(at=parts[0].at)

    def constant(self, parts: list[Token]) -> Constant:
        """`time` or `pi`."""
        return Constant(parts[0].text, at=parts[0].at)

    def path(self, parts: list[Token]) -> Path:
        """Names joined by dots."""
        return Path(tuple([part.value for part in parts]), at=parts[0].at)

    def call(self, parts: list[Any]) -> Call:
        """A function of values."""
        name, *arguments = parts
        return Call(name.value, () if arguments in ([], [None]) else tuple(arguments), at=name.at)

    def items(self, parts: list[Any]) -> Items:
        """A list."""
        first, *items = parts
        return Items(() if items in ([], [None]) else tuple(items), at=first.at)

    def record(self, parts: list[Any]) -> Record:
        """Values by name."""
        first, *entries = parts
        names: set[str] = set()
        for name, _ in entries:
            if name.text in names:
                raise wrong(f"{name.text!r} stands twice in one list", name.at)
            names.add(name.text)
        return Record(tuple([(name.text, value) for name, value in entries]), at=first.at)

    def entry(self, parts: list[Any]) -> tuple[Name, Expression]:
        """A value by its name."""
        return self.name(parts), parts[1]

    def arithmetic(self, parts: list[Any]) -> Expression:
        """A row of operands with signs and operators."""
        return arithmetic(parts)

    def logic(self, parts: list[Any]) -> Expression:
        """A row of comparisons and conditions."""
        return logic(parts)

    def component(self, parts: list[Any]) -> Index:
        """A component."""
        value, *indices = parts
        return Index(value, tuple(indices), at=value.at)

    def index(self, parts: list[int]) -> int:
        """The number of a component."""
        return parts[0]

    def slice(self, parts: list[int | None]) -> Slice:
        """Several components."""
        return Slice(*parts)

    def ellipsis(self, parts: list[Token]) -> str:
        """All axes between."""
        return parts[0].text

    def integer(self, parts: list[Any]) -> int:
        """A whole number in an index."""
        sign, token = parts
        if type(token.value) is not int:
            raise wrong("an index is a whole number", token.at, expected=("a whole number",))
        return token.value if sign is None else -token.value


def _notes(first: Token, inner: tuple[str, ...] = ()) -> Notes:
    """The comments of what begins with a token and has just ended."""
    return first.comments.of(first.index, inner) if first.comments.texts else NO_NOTES


def _opened(parts: list[Any]) -> tuple[Token, bool, list[Any]]:
    """The first token of a statement, whether that hides an object, and what comes behind the keyword."""
    is_hidden = parts[0].type == "HIDDEN"
    return parts[0], is_hidden, parts[1 + is_hidden :]


def _valued(first: Token, value: Any, body: list[Any]) -> tuple[Any, tuple[Attribute, ...], Notes]:
    """The value of a statement, its attributes, and its comments with those of the value."""
    drafts = [] if value is None else [Draft(None, value)]
    gathered(drafts, body)
    attributes = [draft.finished() for draft in drafts]
    after = taken_from_last(attributes)
    if value is None:
        return None, tuple(attributes), _notes(first, after)
    content, *rest = attributes
    return content.value, tuple(rest), _notes(first, behind(content.notes.before, content.notes.behind, after))


def _bare(point: Point) -> Point:
    """A key without its comments."""
    if not any(point.notes):
        return point
    return replace(point, notes=NO_NOTES)
