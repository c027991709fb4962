"""From tree to text: what is written here is read back as the same tree, comments included."""

from collections.abc import Callable, Iterable, Sequence
from typing import Any, Final

from reactive4d.scefo.notes import behind
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
    Expression,
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
    Statement,
    Text,
    Unary,
    Use,
)
from reactive4d.scefo.words import name_text, quoted

__all__ = ["expression_text", "write"]

_WIDTH: Final = 100
_INDENT: Final = "    "
# How tightly operators bind; what stands inside of a tighter one needs parentheses.
_OR, _AND, _NOT, _COMPARISON, _SUM, _PRODUCT, _SIGN, _POWER, _POSTFIX, _ATOM = range(10)
_CHAINS: Final = {"or": _OR, "and": _AND, "+": _SUM, "-": _SUM, "*": _PRODUCT, "/": _PRODUCT, "%": _PRODUCT}


def write(script: Script) -> str:
    """The text of a script, one statement after the other.

    >>> from reactive4d.scefo.parsing import parse
    >>> print(write(parse("change(egg)translate<0,{1,-1,.5}>; // up")), end="")
    change (egg) translate <0, {1, -1, 0.5}>; // up
    """
    lines: list[_Line] = []
    for statement in script.statements:
        before, after = statement.notes
        lines += map(_Line, before)
        lines += _statement(statement)
        lines[-1].text += ";"
        lines[-1].tail += after
    lines += map(_Line, script.after)
    return "".join([f"{' '.join([line.text, *behind(line.tail)])}\n" for line in lines])


class _Line:
    """A line that is being written, and the comments that will stand behind it."""

    __slots__ = ("tail", "text")

    def __init__(self, text: str, tail: tuple[str, ...] = ()) -> None:
        self.text = text
        self.tail = tail


# -- expressions -------------------------------------------------------------------------------------------------------


def expression_text(expression: Expression) -> str:
    """An expression in one line, as it stands in parentheses.

    >>> from reactive4d.scefo.trees import Chain, Number, Path
    >>> expression_text(Chain((Path(("ball", "radius")), Number(2)), ("*",)))
    'ball.radius * 2'
    """
    return _written(expression, _OR)


def _written(x: Expression, level: int) -> str:
    """An expression, in parentheses where something as tight as `level` is wanted."""
    text, own = _WRITERS[type(x)](x)
    return text if own >= level else f"({text})"


def _number(x: Number) -> tuple[str, int]:
    text = repr(x.value)
    return text, _SIGN if text.startswith("-") else _ATOM


def _call(x: Call) -> tuple[str, int]:
    return f"{name_text(x.function)}({_joined(x.arguments)})", _ATOM


def _record(x: Record) -> tuple[str, int]:
    if not x.entries:
        return "{}", _ATOM
    return f"{{{', '.join([f'{name_text(name)}: {_written(value, _OR)}' for name, value in x.entries])}}}", _ATOM


def _chain(x: Chain) -> tuple[str, int]:
    level = _CHAINS[x.operators[0]]
    first, *rest = x.operands
    texts = [_written(first, level + 1)]
    for operator, operand in zip(x.operators, rest, strict=True):
        texts.append(f"{operator} {_written(operand, level + 1)}")
    return " ".join(texts), level


def _unary(x: Unary) -> tuple[str, int]:
    if x.operator == "not":
        return f"not {_written(x.operand, _NOT)}", _NOT
    # A minus before a bare number would be a part of the number.
    operand = f"({_written(x.operand, _OR)})" if isinstance(x.operand, Number) else _written(x.operand, _SIGN)
    return f"{x.operator}{operand}", _SIGN


def _binary(x: Binary) -> tuple[str, int]:
    if x.operator == "^":
        return f"{_written(x.left, _POSTFIX)} ^ {_written(x.right, _SIGN)}", _POWER
    return f"{_written(x.left, _SUM)} {x.operator} {_written(x.right, _SUM)}", _COMPARISON


def _index(x: Index) -> tuple[str, int]:
    return f"{_written(x.value, _POSTFIX)}[{', '.join(map(_index_text, x.indices))}]", _POSTFIX


def _index_text(index: int | Slice | str) -> str:
    if not isinstance(index, Slice):
        return str(index)
    parts = [str(part) if part is not None else "" for part in index]
    return ":".join(parts if parts[2] else parts[:2])


def _keys(x: Curve) -> tuple[str, int]:
    return f"keys({', '.join(map(_point, x.points))}{_options(x)})", _ATOM


def _joined(items: Iterable[Expression]) -> str:
    return ", ".join([_written(item, _OR) for item in items])


_WRITERS: Final[dict[type, Callable[[Any], tuple[str, int]]]] = {
    Number: _number,
    Text: lambda x: (quoted(x.value), _ATOM),
    Boolean: lambda x: ("true" if x.value else "false", _ATOM),
    Nothing: lambda x: ("none", _ATOM),
    Constant: lambda x: (x.name, _ATOM),
    Path: lambda x: (_path(x), _ATOM),
    Call: _call,
    Items: lambda x: (f"{{{_joined(x.items)}}}", _ATOM),
    Record: _record,
    Chain: _chain,
    Unary: _unary,
    Binary: _binary,
    Index: _index,
    Curve: _keys,
}


def _path(x: Path) -> str:
    return ".".join(map(name_text, x.names))


def _moment(t: float) -> str:
    """A time: whole seconds without a point."""
    return str(int(t)) if t.is_integer() and abs(t) < 1e15 and repr(t) != "-0.0" else repr(t)


def _point(x: Point) -> str:
    """A key."""
    parts = [_written(x.value, _SUM)]
    if x.ease is not None:
        parts.append(f"ease {name_text(x.ease)}")
    for name in ("left", "right", "tension", "continuity", "bias"):
        value = getattr(x, name)
        if value is not None:
            parts.append(f"{name} = {_written(value, _SUM)}")
    return f"<{_moment(x.time)}, {' '.join(parts)}>"


def _options(x: Curve) -> str:
    """What is said of keys behind them."""
    text = ""
    if x.interpolation is not None:
        text += f" by {name_text(x.interpolation)}" + (f"({x.degree})" if x.degree is not None else "")
    for word, name in (("ease", x.ease), ("before", x.before), ("after", x.after), ("as", x.kind)):
        if name is not None:
            text += f" {word} {name_text(name)}"
    return text


# -- statements --------------------------------------------------------------------------------------------------------


def _dotted(name: Name) -> str:
    return ".".join(map(name_text, name.text.split(".")))


def _named(name: Name) -> str:
    return name_text(name.text)


def _statement(x: Statement) -> list[_Line]:
    """The lines of a statement, without the semicolon."""
    if isinstance(x, Show):
        return [_Line(f"show ({_named(x.name)}) {_named(x.target)}")]
    if isinstance(x, Change):
        return _change(x)
    if isinstance(x, Define):
        return _valued(f"{x.word} ({_named(x.name)})", x.value, ())
    if isinstance(x, Parameter):
        return _valued(f"parameter ({_named(x.name)})", x.default, x.settings)
    hidden = "hidden " if x.is_hidden else ""
    if isinstance(x, Read):
        return _valued(f"{hidden}read ({quoted(x.file.value)}) {_named(x.name)}", None, x.settings)
    if isinstance(x, Create):
        return _valued(f"{hidden}object ({_named(x.name)}) {_dotted(x.kind)}", None, x.settings)
    return _valued(f"{hidden}template ({_named(x.name)})", x.prototype, x.settings)


def _valued(head: str, value: Expression | None, settings: Sequence[Attribute]) -> list[_Line]:
    """A statement with a value, or with none, and attributes."""
    attributes = [] if value is None else [Attribute(None, value)]
    return _headed(head, [*attributes, *settings], "")


def _change(x: Change) -> list[_Line]:
    head = f"change ({', '.join(map(_path, x.targets))})"
    flat = _flat_operations(x.operations)
    if flat is not None and len(head) + len(flat) + 2 <= _WIDTH:
        return [_Line(f"{head} {flat}")]
    lines = [_Line(head)]
    for i, operation in enumerate(x.operations):
        before, after = operation.notes
        lines += _indented([*map(_Line, before), *_operation(operation)])
        lines[-1].text += "," if i < len(x.operations) - 1 else ""
        lines[-1].tail += after
    return lines


def _flat_operations(operations: Sequence[Operation | Use]) -> str | None:
    """The only operation of a statement, if it fits into one line; several have a line each."""
    if len(operations) != 1:
        return None
    only = operations[0]
    return _flat_operation(only) if only.notes == Notes() else None


def _flat_operation(x: Operation | Use) -> str | None:
    if isinstance(x, Use):
        return f"use {_named(x.name)}"
    texts = [_operator(x)]
    for attribute in x.attributes:
        text = _flat_attribute(attribute)
        if text is None:
            return None
        texts.append(text)
    return " ".join(texts)


def _operator(x: Operation) -> str:
    return (f"{_named(x.label)}: " if x.label is not None else "") + _dotted(x.operator)


def _operation(x: Operation | Use) -> list[_Line]:
    """The lines of an operation."""
    if isinstance(x, Use):
        return [_Line(f"use {_named(x.name)}")]
    return _headed(_operator(x), x.attributes, _INDENT)


def _headed(head: str, attributes: Sequence[Attribute], margin: str) -> list[_Line]:
    """Attributes behind a head: in one line if they fit, else each in its own."""
    flat = [_flat_attribute(attribute) for attribute in attributes]
    known = [text for text in flat if text is not None]
    line = " ".join([head, *known])
    if len(known) == len(flat) and len(margin) + len(line) + 1 <= _WIDTH:
        return [_Line(line)]
    lines = [_Line(head)]
    for i, attribute in enumerate(attributes):
        before, after = attribute.notes
        # The first value stands behind the head, unless a comment comes between them.
        if i == 0 and attribute.name is None and not before:
            lines = _lines(attribute, f"{head} ", margin)
        else:
            lines += _indented([*map(_Line, before), *_lines(attribute, "", margin + _INDENT)])
        lines[-1].tail += after
    return lines


def _flat_attribute(x: Attribute) -> str | None:
    """An attribute without comments in one line."""
    if any(x.notes) or (isinstance(x.value, Curve) and any(any(point.notes) for point in x.value.points)):
        return None
    name = "" if x.name is None else f"{_named(x.name)} = "
    if isinstance(x.value, Curve):
        return f"{name}{', '.join(map(_point, x.value.points))}{_options(x.value)}"
    return name + _written(x.value, _SUM)


def _lines(x: Attribute, head: str, margin: str) -> list[_Line]:
    """An attribute behind a head; keys and lists in lines of their own where they do not fit or have comments."""
    flat = _flat_attribute(Attribute(x.name, x.value))
    if flat is not None and len(margin) + len(head) + len(flat) < _WIDTH:
        return [_Line(head + flat)]
    if not isinstance(x.value, Curve):
        name = "" if x.name is None else f"{_named(x.name)} = "
        first, *rest = _broken(x.value, _SUM, _WIDTH - len(margin) - 1)
        return [_Line(head + name + first), *map(_Line, rest)]
    lines = [_Line(head.rstrip() if x.name is None else f"{head}{_named(x.name)} =")]
    points = x.value.points
    for i, point in enumerate(points):
        before, after = point.notes
        text = _point(point) + ("," if i < len(points) - 1 else _options(x.value))
        lines += _indented([*map(_Line, before), _Line(text, after)])
    return lines


def _broken(x: Expression, level: int, width: int) -> list[str]:
    """An expression in lines that fit into a width, where it has lists that can be broken."""
    flat = _written(x, level)
    if len(flat) <= width:
        return [flat]
    if isinstance(x, Items):
        opening, parts, closing = "{", [_broken(item, _OR, width - len(_INDENT)) for item in x.items], "}"
    elif isinstance(x, Record):
        opening, closing = "{", "}"
        parts = [_prefixed(f"{name_text(name)}: ", _broken(value, _OR, width - 12)) for name, value in x.entries]
    elif isinstance(x, Call):
        opening, closing = f"{name_text(x.function)}(", ")"
        parts = [_broken(argument, _OR, width - len(_INDENT)) for argument in x.arguments]
    else:
        return [flat]
    lines: list[str] = []
    for i, part in enumerate(parts):
        # Short members stand side by side, as many as fit.
        is_beside = i > 0 and len(part) == 1 and len(lines[-1]) + 1 + len(part[0]) < width - len(_INDENT)
        if is_beside and not part[0].startswith("{") and not lines[-1].startswith("}"):
            lines[-1] += f" {part[0]}"
        else:
            lines += part
        lines[-1] += "," if i < len(parts) - 1 else ""
    return [opening, *[_INDENT + line for line in lines], closing]


def _prefixed(text: str, lines: list[str]) -> list[str]:
    return [text + lines[0], *lines[1:]]


def _indented(lines: list[_Line]) -> list[_Line]:
    for line in lines:
        line.text = _INDENT + line.text
    return lines
