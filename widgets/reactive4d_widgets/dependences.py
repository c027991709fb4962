"""Parameters that depend on others: bounds that move, and what is held, as expressions that a page can play.

Why a bound moves is Python's: a watcher of the illustration moves it. So it is tried what happens when each parameter
is set to a few of its values. What comes out as a straight line of a number, or as a choice by a switch or a list, is
told to the page, and so is a sum of such; it is tried once more at other points before it is believed. What is neither
stays as it is where the figure opens.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from reactive4d.errors import ParameterError
from reactive4d.illustrations.controls import Control, Wire
from reactive4d.illustrations.illustration import Illustration
from reactive4d.illustrations.subjects import Subject
from reactive4d_widgets.lowering import play

__all__ = ["dependences"]

TRIED = 5  # values of each number
CHECKED = 8  # other points at which an expression must hold
CLOSE = 1e-9  # as a share of the bound
Tree = Any


class Sides(NamedTuple):
    """What may move: the lower and the upper bound, None where it is open, and whether the parameter is held."""

    low: Any
    high: Any
    held: bool


def dependences(subject: Subject) -> dict[str, dict[str, Any]]:
    """What the bounds and the constancy of each parameter are, where others have a say, as a manifest's `depends`.

    Args:
        subject: whatever is to be shown; its reader stays where it is.

    Returns:
        by the name of the parameter, `bounds`, two trees with None for an open side, and `constant`, a tree; only what
        really varies.

    >>> import param
    >>> import reactive4d as r4
    >>> from reactive4d.illustrations import subject
    >>> class Rod(r4.Illustration):
    ...     length = param.Number(2.0, bounds=(1, 4))
    ...     bead = param.Number(0.5, bounds=(0, 2))
    ...
    ...     @param.depends("length", watch=True)
    ...     def _stay_on_the_rod(self):
    ...         self.param.bead.bounds = (0, self.length)
    ...
    ...     def build(self):
    ...         bead = r4.Sphere(0.1)
    ...         bead.translate(r4.vec(self.signals.bead, 0, self.signals.length))
    ...         return r4.Scene(bead=bead)
    >>> dependences(subject(Rod))
    {'bead': {'bounds': [0, ['param', 'length']]}}
    """
    if not isinstance(subject.thing, Illustration):
        return {}
    base = _sides(subject)
    tried = {control.name: _tried(subject, control) for control in subject.controls}
    points = list(_points(subject, tried))
    found: dict[str, dict[str, Any]] = {}
    for name, own in base.items():
        causes = {cause: trials for cause, trials in tried.items() if cause != name}
        made = [_tree(own[k], {c: {v: s[name][k] for v, s in trials.items()} for c, trials in causes.items()})
                for k in range(3)]  # fmt: skip
        told = {"bounds": made[:2], "constant": made[2]}
        varies = {"bounds": any(type(tree) is list for tree in made[:2]), "constant": type(made[2]) is list}
        kept = {what: told[what] for what in told if varies[what] and _holds(name, what, told[what], points)}
        if kept:
            found[name] = kept
    return found


def _sides(subject: Subject) -> dict[str, Sides]:
    return {c.name: Sides(*(c.bounds or (None, None)), c.constant) for c in subject.controls}


def _tried(subject: Subject, control: Control) -> dict[Wire, dict[str, Sides]]:
    """What all parameters may be, by the values of one."""
    found: dict[Wire, dict[str, Sides]] = {}
    for value in _values(control):
        moved = _moved(subject, {control.name: value}) or _made_room(subject, control.name, value)
        if moved is not None:
            found[value] = _sides(moved)
    return found


def _made_room(subject: Subject, name: str, value: Wire) -> Subject | None:
    """The subject at a value that moves the bounds of another parameter away from where that is."""
    for other in subject.controls:
        for end in _values(other)[:: max(len(_values(other)) - 1, 1)] if other.name != name else ():
            moved = _moved(subject, {name: value, other.name: end})
            if moved is not None:
                return moved
    return None


def _moved(subject: Subject, wires: Mapping[str, Wire]) -> Subject | None:
    """The subject at another point; None where that cannot be had."""
    try:
        moved = subject.moved(wires, strict=False)
    except ParameterError:
        return None
    return moved if all(moved.point.parameters[name] == value for name, value in wires.items()) else None


def _values(control: Control) -> Sequence[Wire]:
    """Some values of a parameter, in their order."""
    if control.kind == "boolean":
        return (False, True)
    if control.kind == "select":
        return control.options or ()
    low, high = control.bounds or (None, None)
    if control.soft is not None:
        low, high = (s if b is None else b for s, b in zip(control.soft, (low, high), strict=True))
    if control.kind not in ("number", "integer") or low is None or high is None:
        return ()
    evenly = [low + (high - low) * k / (TRIED - 1) for k in range(TRIED)]
    return sorted({round(x) for x in evenly}) if control.kind == "integer" else sorted(set(evenly))


def _points(subject: Subject, tried: Mapping[str, Mapping[Wire, Any]]) -> Iterable[tuple[dict[str, Any], Subject]]:
    """Points at which several parameters have other values than where it opens, as far as they can be had."""
    for k in range(CHECKED):
        wires: dict[str, Wire] = {}
        for i, (name, trials) in enumerate(tried.items()):
            values = list(trials)
            if values:
                wires[name] = values[(k * (2 * i + 3) + i) % len(values)]
        moved = _moved(subject, wires)
        if moved is not None:
            yield dict(moved.point.parameters), moved


def _tree(own: Any, by: Mapping[str, Mapping[Wire, Any]]) -> Tree:
    """A side as an expression of what moves it: what it is where it opens, and what each parameter adds to that."""
    moving = {cause: values for cause, values in by.items() if any(x != own for x in values.values())}
    if not moving or own is None or any(x is None for values in moving.values() for x in values.values()):
        return own
    parts = [_part(cause, values) for cause, values in moving.items()]
    total: Tree = parts[0]
    for part in parts[1:]:
        if own is True or own is False:
            total = _op("or", total, part)
        else:
            total = _op("+", total, _op("-", part, own))
    return total


def _op(name: str, *parts: Tree) -> Tree:
    return [name, *parts]


def _part(cause: str, values: Mapping[Wire, Any]) -> Tree:
    """What one parameter makes of a side."""
    pairs = list(values.items())
    (x0, y0), (x1, y1) = pairs[0], pairs[-1]
    x: Tree = ["param", cause]
    if isinstance(x0, bool | str) or isinstance(y0, bool):
        return _chosen(x, pairs)
    slope = _round((y1 - y0) / (x1 - x0))
    start = _round(y0 - slope * x0)
    scaled = x if slope == 1.0 else ["*", slope, x]
    return scaled if start == 0.0 else ["+", start, scaled]


def _round(x: float) -> float:
    return float(f"{x:.12g}")


def _chosen(x: Tree, values: list[tuple[Wire, Any]]) -> Tree:
    tree = values[-1][1]
    for value, side in values[-2::-1]:
        tree = ["where", ["==", x, value], side, tree]
    return tree


def _holds(name: str, what: str, told: Any, points: Iterable[tuple[dict[str, Any], Subject]]) -> bool:
    """Whether expressions answer what Python says at other points."""
    for wires, moved in points:
        sides = _sides(moved)[name]
        pairs = zip(told, sides[:2], strict=True) if what == "bounds" else [(told, sides.held)]
        for tree, side in pairs:
            got = play({"kind": "expr", "tree": tree}, 0.0, wires) if type(tree) is list else tree
            if (got is None) != (side is None):
                return False
            if side is not None and abs(float(got) - float(side)) > CLOSE * max(1.0, abs(float(side))):
                return False
    return True
