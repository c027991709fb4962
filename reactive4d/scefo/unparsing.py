"""From signals back to expressions: what was built of operators and known functions is written as it was built.

A signal knows what it does and of what it is made; only a function of Python's is opaque, and is named in the error.
"""

import inspect
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Final, TypeAlias

import numpy as np

from reactive4d.arrays import ARRAY
from reactive4d.engine import Affine
from reactive4d.errors import Reactive4dError, ScriptError, ShapeError, hint
from reactive4d.model.channels import Channel, Question
from reactive4d.scefo.functions import LIST, NAMED
from reactive4d.scefo.operators import MOST_BITS, WRITTEN_BETWEEN, is_live
from reactive4d.scefo.trees import (
    Attribute,
    Binary,
    Boolean,
    Call,
    Chain,
    Constant,
    Curve,
    Define,
    Expression,
    Index,
    Items,
    Name,
    Nothing,
    Number,
    Parameter,
    Path,
    Point,
    Record,
    Slice,
    Statement,
    Text,
    Unary,
)
from reactive4d.signals import sources, warps
from reactive4d.signals.algebra import Operation
from reactive4d.signals.choices import Choice
from reactive4d.signals.curves.curve import Curve as Line
from reactive4d.signals.curves.kinds import space_of
from reactive4d.signals.curves.mixtures import Mixtures
from reactive4d.signals.easings import easing
from reactive4d.signals.facade import Signal
from reactive4d.signals.keys import Keys
from reactive4d.signals.maps import Creep, Discrete, Hold, Repeat, SlowInOut
from reactive4d.signals.numerical import Difference, Quadrature
from reactive4d.signals.reflections import KeyArea, KeySlope, Reflected
from reactive4d.signals.rotations import Rotation
from reactive4d.signals.sources import Time, Variable
from reactive4d.signals.trees import is_a
from reactive4d.signals.warps import Follow, Warped

__all__ = ["NameOf", "NotWritableError", "Unparsed", "Unparsing", "parts_of", "unparse", "unparse_all"]

# From a signal, an object or a value of the model to how a script calls it; None where it has no name.
NameOf: TypeAlias = Callable[[Any], Expression | None]
MOST_NODES: Final = 1_000_000  # of all expressions together
_DEEP: Final = 40  # where expressions are nested deeper, a part of them is named


class NotWritableError(Reactive4dError):
    """Something that no script can say: a function of Python's, or a value without a name.

    >>> import reactive4d as r4
    >>> try:
    ...     unparse(r4.time.map(lambda t: t + 1), lambda x: None)
    ... except NotWritableError as error:
    ...     print(error)
    the Python function <lambda> cannot be written in a script
    """


@dataclass(frozen=True, slots=True)
class Unparsed:
    """Expressions, and the statements that define what they share, each before its first use.

    Attributes:
        expressions: one for each signal or value that was given.
        definitions: of signals, variables and parameters.
        names: of what is defined, in the same order.
    """

    expressions: tuple[Expression, ...]
    definitions: tuple[Statement, ...]
    names: tuple[tuple[Signal[Any], str], ...]


def unparse(x: Any, name_of: NameOf, *, is_definition: bool = False) -> Expression:
    """A signal or a value as an expression.

    Args:
        x: a signal, or a constant: a number, a string, an array, a rotation, a tuple, an object that has a name.
        name_of: the paths of signals and objects that have one.
        is_definition: whether `x` itself is to be taken apart, though it has a name.

    Raises:
        NotWritableError: a Python function, an object or a parameter without a name, a number that is none; or parts
            that are nested so deep, or shared so often, that they need names: `unparse_all` gives them.

    >>> import numpy as np
    >>> import reactive4d as r4
    >>> from reactive4d.scefo.writing import expression_text
    >>> expression_text(unparse(2 * np.abs(np.sin(np.pi * r4.time)), lambda x: None))
    '2 * abs(sin(3.141592653589793 * time))'
    """
    return Unparsing(name_of, None, x if is_definition else None).of(x)


def unparse_all(roots: Sequence[Any], name_of: NameOf, new_name: Callable[[Signal[Any]], str]) -> Unparsed:
    """Signals and values as expressions; what they share, and what is nested deep, is defined under names of its own.

    Args:
        roots: signals and constants.
        name_of: the paths of signals and objects that have one.
        new_name: a name that is not yet used, for a signal that gets a definition; asked once for each of them.

    Raises:
        NotWritableError: as `unparse`.

    >>> import reactive4d as r4
    >>> from reactive4d.scefo.trees import Script
    >>> from reactive4d.scefo.writing import expression_text, write
    >>> speed = r4.keys({0: 1.0, 2: 3.0})
    >>> made = unparse_all([speed * 2, speed + 1], lambda x: None, lambda x: "speed")
    >>> print(write(Script(made.definitions)), *map(expression_text, made.expressions))
    signal (speed) <0, 1.0>, <2, 3.0>;
     speed * 2 speed + 1
    """
    unparsing = Unparsing(name_of, new_name, None)
    unparsing.count(roots)
    expressions = tuple([unparsing.of(root) for root in roots])
    return Unparsed(expressions, tuple(unparsing.definitions), tuple(unparsing.names))


class Unparsing:
    """Signals on their way to expressions; each is written once.

    Args:
        name_of: how what has a name is called.
        new_name: a name for a signal that gets a definition; None where there shall be none.
        root: a signal that is to be taken apart, though it has a name.

    Attributes:
        definitions: those that became necessary so far, each before its first use.
    """

    __slots__ = ("counts", "definitions", "done", "name_of", "names", "new_name", "nodes", "root", "sizes")

    def __init__(self, name_of: NameOf, new_name: Callable[[Signal[Any]], str] | None, root: Any) -> None:
        self.name_of = name_of
        self.new_name = new_name
        self.root = root
        self.done: dict[int, Expression] = {}
        self.sizes: dict[int, int] = {}
        self.counts: dict[int, int] = {}
        self.definitions: list[Statement] = []
        self.names: list[tuple[Signal[Any], str]] = []
        self.nodes = 0

    def count(self, roots: Sequence[Any], *, is_named: Callable[[Any], bool] | None = None) -> None:
        """Count how often each signal is used by all that will be written: what is shared is defined.

        Args:
            roots: all that will be written.
            is_named: whether a signal has a name; by default one asks for it.
        """
        is_named = is_named or (lambda x: self.name_of(x) is not None)
        todo = list(_signals(list(roots)))
        for x in todo:
            self.counts[id(x)] = self.counts.get(id(x), 0) + 1
        seen: set[int] = set()
        while todo:
            x = todo.pop()
            if id(x) in seen or is_named(x):
                continue
            seen.add(id(x))
            for part in _signals(parts_of(x)):
                self.counts[id(part)] = self.counts.get(id(part), 0) + 1
                todo.append(part)

    def of(self, x: Any) -> Expression:
        """The expression of a signal or a value."""
        todo = [*_signals(x)][::-1]
        while todo:
            y = todo[-1]
            if id(y) in self.done:
                todo.pop()
                continue
            path = None if y is self.root else self.name_of(y)
            missing = [part for part in _signals(parts_of(y)) if id(part) not in self.done] if path is None else []
            if missing:
                todo.extend(reversed(missing))
                continue
            self.done[id(y)] = path if path is not None else self.written(y)
            self.sizes[id(y)] = 1 if path is not None or isinstance(self.done[id(y)], Path) else self.size(y)
            todo.pop()
        return self.part(x)

    def size(self, x: Any) -> int:
        """How many parts the expression of a signal has."""
        size = 1 + sum(self.sizes[id(part)] for part in _signals(parts_of(x)))
        if size > MOST_NODES:
            raise NotWritableError(f"{x.name} has more than {MOST_NODES} parts")
        return size

    def written(self, x: Any) -> Expression:
        """A signal whose parts are written: its expression, or the name under which it is defined."""
        try:
            if is_a(x, sources.Parameter):
                return self.parameter(x)
            write = next((write for kind, write in _WRITERS.items() if is_a(x, kind)), None)
            if write is None:
                raise _opaque(x)
            expression = write(self, x)
        except ScriptError:
            raise hint(NotWritableError(f"{x.name} is nested too deep"), "name a part of it") from None
        if self.new_name is None or is_a(x, Time):
            return expression
        is_shared = self.counts.get(id(x), 0) > 1
        if is_a(x, Variable):
            if is_shared or x.name.isidentifier():
                return self.defined("variable", x, self.part(x.source))
        elif is_shared or expression.depth >= _DEEP:
            return self.defined("signal", x, expression)
        return expression

    def defined(self, word: str, x: Any, content: Expression) -> Path:
        """The name of a signal that has a statement of its own."""
        assert self.new_name is not None
        name = self.new_name(x)
        self.definitions.append(Define(word, Name(name), content))
        self.names.append((x, name))
        return Path((name,))

    def parameter(self, x: Any) -> Path:
        """The name of a parameter, which has a statement of its own."""
        if self.new_name is None:
            raise hint(
                NotWritableError(f"the parameter {x.name} has no name in the script"), f"parameter ({x.name}) …;"
            )
        name = self.new_name(x)
        settings: list[Attribute] = []
        if x.bounds is not None:
            settings.append(Attribute(Name("bounds"), self.literal(tuple(x.bounds))))
        if x.doc:
            settings.append(Attribute(Name("doc"), Text(x.doc)))
        if name != x.name:
            settings.append(Attribute(Name("name"), Text(x.name)))
        self.definitions.append(Parameter(Name(name), self.literal(x.default), tuple(settings)))
        self.names.append((x, name))
        return Path((name,))

    # -- constants -------------------------------------------------------------------------------------------------

    def part(self, x: Any) -> Expression:
        """A part of something: a signal that is written already, or a constant."""
        return self.done[id(x)] if is_live(x) else self.literal(x)

    def literal(self, x: Any) -> Expression:
        """A constant."""
        value: Any = x.item() if is_a(x, np.generic) else x
        kind: Any = type(value)  # pyright: ignore[reportUnknownVariableType]
        write = _LITERALS.get(kind)
        if write is not None:
            return write(self, value)
        path = self.name_of(value)
        if path is None:
            raise NotWritableError(f"the value {_shown(value)} cannot be written in a script")
        return path

    def number(self, x: Any) -> Expression:
        """A number that is one, and no longer than a script may have it."""
        if x != x or (type(x) is int and x.bit_length() > MOST_BITS):
            raise NotWritableError(f"the number {_shown(x)} cannot be written in a script")
        return Number(x)

    def record(self, x: Any) -> Expression:
        """Values by name."""
        if not all(isinstance(name, str) for name in x):
            raise NotWritableError(f"{_shown(x)} cannot be written in a script: its names are not strings")
        return Record(tuple([(name, self.part(value)) for name, value in x.items()]))

    def items(self, x: Any) -> Expression:
        """A list."""
        return Items(tuple([self.part(item) for item in x]))

    def rotation(self, x: Rotation) -> Expression:
        """A rotation, to the last bit."""
        return Call("quaternion", tuple([Number(n) for n in x.as_quaternion().tolist()]))

    def array(self, x: Any, *, is_flat: bool = False) -> Expression:
        """An array: as a list where a list is read as this array."""
        if x.dtype.kind not in "biuf" or (x.size == 0 and x.ndim != 1):
            raise NotWritableError(f"the array {_shown(x)} cannot be written in a script")
        items = self.literal(_tuples(x.tolist()))
        if x.dtype == np.float64 and x.ndim and (x.ndim == 1 or not is_flat):
            return items
        return Call("array", (Text(x.dtype.name), items))

    # -- signals, by their classes ---------------------------------------------------------------------------------

    def time(self, x: Any) -> Expression:
        """Time itself."""
        del x
        return Constant("time")

    def operation(self, x: Any) -> Expression:
        """An operator, applied."""
        operator = x.operator
        parts = [self.part(part) for part in x.operands]
        if operator.name == "getitem":
            return Index(parts[0], _indices(operator.symbol))
        sign = WRITTEN_BETWEEN.get(operator)
        if sign is not None:
            return _joined(sign, parts)
        if operator is LIST:
            return Items(tuple(parts))
        name = NAMED.get(operator) or _name_of_function(operator)
        if name is None:
            raise _opaque_function(operator.name)
        return Call(name, tuple(parts))

    def choice(self, x: Any) -> Expression:
        """One of two."""
        branches = [
            self.array(part, is_flat=True) if isinstance(part, ARRAY) else self.part(part) for part in (x.yes, x.no)
        ]
        return Call("where", (self.part(x.condition), *branches))

    def warped(self, x: Any) -> Expression:
        """A signal at other times."""
        name, parameters = _warp(x.time_map)
        return Call(name, (self.part(x.original), *[self.part(n) for n in parameters]))

    def follow(self, x: Any) -> Expression:
        """A signal at times that other signals tell."""
        if x.make.__module__ != warps.__name__:
            raise _opaque_function(x.kind_of_map)
        return Call(x.kind_of_map, (self.part(x.original), *[self.part(n) for n in x.parameters]))

    def variable(self, x: Any) -> Expression:
        """A signal that one sets, with what it is set to."""
        return Call("variable", (self.part(x.source),))

    def question(self, x: Any) -> Expression:
        """What an object is asked about something."""
        return Call(x.question, (self.part(x.object), *[self.part(argument) for argument in x.arguments]))

    def key_slope(self, x: Any) -> Expression:
        """The derivative of keys."""
        expression = self.part(x.original)
        for _ in range(x.order):
            expression = Call("derivative", (expression,))
        return expression

    def derivative(self, x: Any) -> Expression:
        """The derivative of what is not known better."""
        return Call("derivative", (self.part(x.original),))

    def integral(self, x: Any) -> Expression:
        """The integral of what is not known better."""
        return Call("integral", (self.part(x.original), Number(x.start)))

    def reflected(self, x: Any) -> Expression:
        """The derivative or the integral of a signal that one sets."""
        if x.make.__module__ == "reactive4d.signals.derivatives":
            return self.derivative(x)
        start = inspect.getclosurevars(x.make).nonlocals.get("start")
        if x.make.__module__ != "reactive4d.signals.integrals" or not isinstance(start, float):
            raise _opaque(x)
        return Call("integral", (self.part(x.original), Number(start)))

    def keys(self, x: Any) -> Expression:
        """Keys."""
        curve: Line = x.curve
        points = [self.point(t, key) for t, key in zip(curve.times, curve.keys, strict=True)]
        known = [(t, key.value) for t, key in zip(curve.times, curve.keys, strict=True) if not is_live(key.value)]
        inner = curve.space.inner if isinstance(curve.space, Mixtures) else curve.space
        kind = None if inner is None else inner.kind
        found = _kind_found(known)
        default = {"held": "step", "rotation": "slerp"}.get(curve.space.kind, "linear")
        is_said = curve.interpolation != default or curve.degree != 3
        return Curve(
            tuple(points),
            interpolation=curve.interpolation if is_said else None,
            degree=curve.degree if curve.degree != 3 else None,
            ease=_ease(curve.ease) if curve.ease is not easing("linear") else None,
            before=curve.before if curve.before != "hold" else None,
            after=curve.after if curve.after != "hold" else None,
            kind=kind if kind != found else None,
        )

    def point(self, t: float, key: Any) -> Point:
        """A key."""
        told: dict[str, Any] = {} if key.ease is None else {"ease": _ease(key.ease)}
        for name in ("left", "right"):
            if getattr(key, name) is not None:
                told[name] = self.literal(getattr(key, name))
        for name in ("tension", "continuity", "bias"):
            if getattr(key, name):
                told[name] = Number(getattr(key, name))
        return Point(t, self.part(key.value), **told)


_LITERALS: Final[Mapping[Any, Callable[[Unparsing, Any], Expression]]] = MappingProxyType(
    {
        type(None): lambda _, x: Nothing(),
        bool: lambda _, x: Boolean(x),
        int: Unparsing.number,
        float: Unparsing.number,
        str: lambda _, x: Text(x),
        tuple: Unparsing.items,
        list: Unparsing.items,
        dict: Unparsing.record,
        ARRAY: Unparsing.array,
        Rotation: Unparsing.rotation,
    }
)
_WRITERS: Final[Mapping[type, Callable[[Unparsing, Any], Expression]]] = MappingProxyType(
    {
        Time: Unparsing.time,
        Operation: Unparsing.operation,
        Choice: Unparsing.choice,
        Warped: Unparsing.warped,
        Follow: Unparsing.follow,
        Variable: Unparsing.variable,
        Question: Unparsing.question,
        Keys: Unparsing.keys,
        KeySlope: Unparsing.key_slope,
        KeyArea: Unparsing.integral,
        Difference: Unparsing.derivative,
        Quadrature: Unparsing.integral,
        Reflected: Unparsing.reflected,
    }
)


def _kind_found(known: list[tuple[float, Any]]) -> str | None:
    """The kind of values that keys have where nobody tells it."""
    try:
        return space_of([t for t, _ in known], [value for _, value in known]).kind if known else None
    except ShapeError:
        return None


def parts_of(x: Any) -> tuple[Any, ...]:
    """What a signal is made of: signals and constants; nothing where that is not known."""
    if is_a(x, Operation):
        return x.operands
    if is_a(x, Choice):
        return (x.condition, x.yes, x.no)
    if is_a(x, Follow):
        return (x.original, *x.parameters)
    if is_a(x, Warped, KeySlope, KeyArea, Difference, Quadrature, Reflected):
        return (x.original,)
    if is_a(x, Keys):
        return tuple([key.value for key in x.curve.keys])
    if is_a(x, Variable):
        return (x.source,)
    return (x.object, *x.arguments) if is_a(x, Question) else ()


def _signals(x: Any) -> Iterator[Any]:
    """The signals in something: itself, or those in nested lists and records."""
    if is_live(x):
        yield x
    elif type(x) in (tuple, list, dict):
        inner: Any = x.values() if type(x) is dict else x  # pyright: ignore[reportUnknownVariableType]
        for part in inner:
            yield from _signals(part)


def _joined(sign: str, parts: list[Expression]) -> Expression:
    """An operator between its operands, or before its only one."""
    if len(parts) == 1:
        return Unary(sign, parts[0])
    if sign not in _RANKS:
        return Binary(sign, *parts)
    left, right = parts
    if isinstance(left, Chain) and _RANKS[left.operators[0]] == _RANKS[sign]:
        return Chain((*left.operands, right), (*left.operators, sign))
    return Chain((left, right), (sign,))


_RANKS: Final = {"+": 1, "-": 1, "*": 2, "/": 2, "%": 2, "and": 3, "or": 4}


def _indices(index: Any) -> tuple[int | Slice | str, ...]:
    """What stands in brackets."""
    return tuple([_index(i) for i in (index if type(index) is tuple else (index,))])  # pyright: ignore


def _index(i: Any) -> int | Slice | str:
    if type(i) is slice:
        ends: list[Any] = [i.start, i.stop, i.step]
        if not all(end is None or isinstance(end, int | np.integer) for end in ends):
            raise NotWritableError(f"the slice {i!r} cannot be written in a script")
        return Slice(*[None if end is None else int(end) for end in ends])
    return "..." if i is Ellipsis else int(i)


def _warp(time_map: Any) -> tuple[str, tuple[Any, ...]]:
    """The function that makes a map of time, and its values."""
    if isinstance(time_map, Affine):
        scale, offset = time_map.scale, time_map.offset
        if scale == 1.0:
            return "delay", (-offset,)
        if scale == -1.0:
            return "reverse", (0.0, offset)
        factor = 1.0 / scale
        for about in (offset / (1.0 - scale), round(offset / (1.0 - scale), 9)):
            if Affine(1.0 / factor, about - about / factor) == time_map:
                return "stretch", (factor, about) if about else (factor,)
        return "affine", (scale, offset)
    if isinstance(time_map, Repeat):
        return "repeat", (time_map.period, time_map.start)
    if isinstance(time_map, Hold):
        ends = (time_map.before, time_map.after)
        return "hold", tuple([None if np.isinf(end) else end for end in ends])
    if isinstance(time_map, Creep):
        return "creep", (time_map.start, time_map.stop, time_map.speed)
    if isinstance(time_map, SlowInOut):
        return "slow_in_out", (time_map.start, time_map.stop, time_map.slow_in, time_map.slow_out)
    if isinstance(time_map, Discrete):
        return "discrete", (time_map.fps,)
    raise NotWritableError(f"the map of time {time_map!r} cannot be written in a script")


def _name_of_function(operator: Any) -> str | None:
    """The name of a NumPy function without options."""
    name = _FUNCTIONS.get(operator.symbol) if callable(operator.symbol) else None
    if name is None:
        return None
    options = inspect.getclosurevars(operator.one).nonlocals.get("numpy")
    return name if options is not None and not inspect.getclosurevars(options).nonlocals.get("options", True) else None


_FUNCTIONS: Final[dict[Any, str]] = {np.dot: "dot"}


def _ease(ease: Any) -> str:
    """The name of an easing."""
    made = easing(ease)
    if made.function is not None:
        raise _opaque_function(made.name)
    return made.name


def _opaque(x: Any) -> NotWritableError:
    if is_a(x, Channel):
        return NotWritableError(f"the signal {x.name} cannot be asked for in a script")
    return _opaque_function(x.name or type(x).__name__)


def _opaque_function(name: str) -> NotWritableError:
    error = NotWritableError(f"the Python function {name} cannot be written in a script")
    return hint(error, "operators, NumPy's elementary functions, where, vec and warps of signals can")


def _tuples(x: Any) -> Any:
    """Lists of lists as tuples of tuples."""
    return tuple([_tuples(item) for item in x]) if type(x) is list else x  # pyright: ignore[reportUnknownVariableType]


def _shown(x: Any) -> str:
    text = " ".join(repr(x).split())
    return text if len(text) <= 60 else f"{text[:59]}…"
