"""Terms: signals on their way to tracks. A term is a tree, and what is known of its values: their shape, or all of it.

A term whose value is known is folded as soon as it is used. Trees are bounded in nodes and depth; what grows beyond
that is not lowered.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final, TypeAlias

import numpy as np

from reactive4d.signals.rotations import Rotation
from reactive4d.signals.trees import is_a
from reactive4d_widgets.lowering.numerals import Array, array_of, fine

__all__ = [
    "ABSENT",
    "CODE",
    "HELD",
    "NUMBER",
    "ROTATION",
    "NotExactError",
    "Shape",
    "Term",
    "Track",
    "applied",
    "cases",
    "component",
    "constant",
    "head",
    "of_track",
    "polynomials",
    "told",
    "track_in",
    "track_of",
    "written",
]

Track: TypeAlias = dict[str, Any]
# Of an array its own; () of a number or truth value; the others have names.
Shape: TypeAlias = tuple[int, ...] | str

NUMBER: Final[Shape] = ()
ROTATION: Final[Shape] = "rotation"
HELD: Final[Shape] = "held"
CODE: Final[Shape] = "code"  # of a colour, "#rrggbb": what a reader's colour is
ABSENT: Final = object()
# Of the wire 10,000 and 64; tracks that hold others take a few on top.
MOST_NODES: Final = 9_900
MOST_DEPTH: Final = 60
_FEW: Final = 4  # numbers that stand in a tree one by one
_LARGEST: Final = 2**53


class NotExactError(Exception):
    """A signal that no track says exactly."""


@dataclass(frozen=True, slots=True, eq=False)
class Term:
    """A tree and what is known of it.

    Attributes:
        tree: as it travels; arrays are flat in it.
        shape: of its values.
        nodes: how many there are in it, those of tracks inside of it included.
        depth: of the deepest one.
        value: if it is the same at every point, else ABSENT.
    """

    tree: Any
    shape: Shape
    nodes: int = 1
    depth: int = 1
    value: Any = ABSENT

    @property
    def is_constant(self) -> bool:
        """Whether the value is known."""
        return self.value is not ABSENT

    @property
    def is_array(self) -> bool:
        """Whether its values are several numbers."""
        return isinstance(self.shape, tuple) and self.shape != ()

    @property
    def width(self) -> int:
        """How many numbers it has; 1 for a number."""
        if not isinstance(self.shape, tuple):
            raise NotExactError("no numbers")
        return int(np.prod(self.shape, dtype=np.int64))


def head(tree: Any) -> str:
    """The operator of a tree; nothing where it is a leaf."""
    return tree[0] if is_a(tree, list) else ""


def track_in(tree: Any) -> Any:
    """The track that a tree is, or None."""
    return tree[1] if head(tree) == "track" else None


def constant(value: Any) -> Term:
    """A value that is the same at every point.

    Raises:
        NotExactError: numbers that JSON cannot say.

    >>> constant(2.5).tree, constant(np.array([1.0, 2.0])).tree
    (2.5, ['vec', 1.0, 2.0])
    """
    if is_a(value, np.generic):
        value = value.item()
    if isinstance(value, bool):
        return Term(value, NUMBER, value=value)
    if isinstance(value, int | float):
        if not -_LARGEST <= value <= _LARGEST and not np.isfinite(float(value)):
            raise NotExactError(f"{value!r} is no number that travels")
        if value != value:
            raise NotExactError("nan does not travel")
        return Term(value if abs(value) <= _LARGEST else float(value), NUMBER, value=value)
    if isinstance(value, Rotation):
        return Term(_listed(value.as_quaternion()), ROTATION, nodes=5, depth=2, value=value)
    if is_a(value, np.ndarray) and value.dtype.kind in "biuf" and value.ndim:
        array: Array = value.astype(np.float64)
        if not np.isfinite(array).all():
            raise NotExactError("numbers that are not finite do not travel")
        return Term(_listed(array.ravel()), array.shape, nodes=1 + array.size, depth=2, value=value)
    return Term(value if isinstance(value, str) else ABSENT, HELD, value=value)


def _listed(array: Array) -> Any:
    numbers: list[float] = array.tolist()
    return ["vec", *numbers] if len(numbers) <= _FEW else ["track", {"kind": "const", "value": numbers}]


def applied(operator: str, *parts: Term, shape: Shape, extra: Sequence[Any] = ()) -> Term:
    """An operator applied to terms.

    Args:
        operator: as it travels.
        *parts: its operands.
        shape: of the result.
        extra: operands that are no trees, after the others.

    Raises:
        NotExactError: the tree would be too large or too deep.
    """
    if any(part.tree is ABSENT for part in parts):
        raise NotExactError("a value that no tree can say")
    nodes = 1 + sum(part.nodes for part in parts) + len(extra)
    depth = 1 + max([part.depth for part in parts], default=0)
    if nodes > MOST_NODES or depth > MOST_DEPTH:
        raise NotExactError(f"a tree of {nodes} nodes, {depth} deep")
    return Term([operator, *[part.tree for part in parts], *extra], shape, nodes, depth)


def component(term: Term, index: int) -> Term:
    """One number of an array, by its place in the flat array.

    >>> component(constant(np.array([1.0, 2.0])), 1).value
    2.0
    """
    if term.is_constant:
        return constant(np.asarray(term.value).ravel()[index])
    if head(term.tree) == "vec":
        part: Any = term.tree[1 + index]
        if not is_a(part, list):
            return constant(part)
        return Term(part, NUMBER, term.nodes - 1, term.depth - 1)
    track = track_in(term.tree)
    if track is not None and track["kind"] == "poly":
        return _column(track, index)
    return applied("index", term, shape=NUMBER, extra=(index,))


def _column(track: Track, index: int) -> Term:
    """One component of a polynomial, as a polynomial."""
    times = array_of(track["times"])
    rows = array_of(track["coefficients"]).reshape(len(times) - 1, track["degree"] + 1, -1)
    end = array_of(track["end"])[index] if "end" in track else None
    return polynomials(times.tolist(), rows[:, :, index], end=end)


def of_track(track: Track, shape: Shape, *parts: Term) -> Term:
    """A track as a term; `parts` are the terms whose trees stand in it."""
    nodes = 2 + sum(part.nodes + 2 for part in parts)
    depth = 2 + max([part.depth + 2 for part in parts], default=0)
    if nodes > MOST_NODES or depth > MOST_DEPTH:
        raise NotExactError(f"a track with {nodes} nodes, {depth} deep")
    return Term(["track", track], shape, nodes, depth)


def track_of(term: Term) -> Track:
    """A term as a track.

    Raises:
        NotExactError: a constant that JSON cannot say.

    >>> track_of(constant(np.eye(2)))
    {'kind': 'const', 'value': [1.0, 0.0, 0.0, 1.0]}
    """
    if term.is_constant:
        return {"kind": "const", "value": told(term.value)}
    if term.tree is ABSENT:
        raise NotExactError("a value that does not travel")
    return track_in(term.tree) or {"kind": "expr", "tree": term.tree}


def told(value: Any) -> Any:
    """A held value as JSON says it: numbers and arrays, strings, truth values, None, and lists of these.

    Raises:
        NotExactError: anything else.
    """
    if isinstance(value, Rotation):
        return value.as_quaternion().tolist()
    if is_a(value, np.ndarray) and value.dtype.kind in "biuf":
        numbers: list[float] = value.astype(np.float64).ravel().tolist()
        if all(map(np.isfinite, numbers)):
            return numbers
    elif is_a(value, float, int, np.generic):
        plain: Any = value.item() if is_a(value, np.generic) else value
        if isinstance(plain, bool) or np.isfinite(plain):
            return plain
    elif is_a(value, tuple, list):
        return [told(x) for x in value]
    elif value is None or isinstance(value, str):
        return value
    raise NotExactError(f"{value!r} does not travel")


def polynomials(times: Sequence[float], coefficients: Array, *, end: Any = None, shape: Shape = NUMBER) -> Term:
    """A piecewise polynomial as a term.

    Args:
        times: (n + 1,) borders.
        coefficients: (n, degree + 1, c), or (n, degree + 1) for a number.
        end: what it is at the last border.
        shape: of its values.
    """
    if not np.isfinite(coefficients).all() or not (end is None or np.isfinite(end).all()):
        raise NotExactError("a polynomial too steep for floats")
    flat = [] if shape == () else [int(np.prod(np.array(shape)))]
    track: Track = {
        "kind": "poly",
        "times": fine(times),
        "coefficients": fine(coefficients),
        "degree": coefficients.shape[1] - 1,
        "shape": flat,
    }
    if end is not None:
        track["end"] = fine(np.atleast_1d(np.asarray(end, dtype=np.float64)))
    return of_track(track, shape)


def cases(borders: Sequence[float], parts: Sequence[Term]) -> Term:
    """Terms one after the other: the first before the first border, the last from the last border on.

    >>> cases([2.0], [constant(1.0), constant(5.0)]).tree[1]["times"]
    [None, 2.0, None]
    """
    if len(parts) == 1:
        return parts[0]
    if len({part.shape for part in parts}) > 1:
        raise NotExactError("values of several shapes, one after the other")
    track: Track = {"kind": "cases", "times": [None, *borders, None], "tracks": [track_of(part) for part in parts]}
    return of_track(track, parts[0].shape, *parts)


def written(tree: Any, shape: Shape) -> Term:
    """A tree that was written by hand, of plain operators and tracks of numbers."""
    nodes, depth = _measured(tree)
    if nodes > MOST_NODES or depth > MOST_DEPTH:
        raise NotExactError(f"a tree of {nodes} nodes, {depth} deep")
    return Term(tree, shape, nodes, depth)


def _measured(tree: Any) -> tuple[int, int]:
    if not is_a(tree, list):
        return 1, 1
    if tree[0] == "track":
        return 2, 2
    found = [_measured(part) for part in tree[1:]]
    return 1 + sum(nodes for nodes, _ in found), 1 + max([depth for _, depth in found], default=0)
