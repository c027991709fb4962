"""The matrix of an object as a list of factors: one for each transform after its last deformation.

A factor has terms for what the transform's settings are. Whoever makes the list says what becomes of a setting: it is
lowered exactly, or else fitted.
"""

from collections.abc import Callable, Sequence
from typing import Any, Final, NamedTuple

import numpy as np

from reactive4d.geometry import transforms
from reactive4d.model.changes import Change, Transform
from reactive4d.model.forms import Base, Stage
from reactive4d.model.kinds.views import Camera, Label, Point
from reactive4d.model.runs import Run, run_of
from reactive4d.model.settings import Setting
from reactive4d.model.steps import step
from reactive4d.model.tables import Table
from reactive4d.model.transforms import LinkedXForm, LookAt, Matrix, Mirror, Orient, Rotate, Scale, Shear, Translate
from reactive4d.signals.algebra import lift
from reactive4d.signals.facade import Signal
from reactive4d_widgets.lowering.numerals import Array
from reactive4d_widgets.lowering.terms import ROTATION, NotExactError, Term, component, constant, track_of
from reactive4d_widgets.lowering.vectors import is_zero, plus, times

__all__ = ["Factor", "Leaf", "factors_of", "product_track"]

# From a setting, what was assigned to it and what it counts for, to a term: "length", "angle", "share", "rotation" …
Leaf = Callable[[Setting[Any], Any, str], Term]
# From a signal of matrices that no factors are known of to a factor.
Opaque = Callable[[Signal[Any]], "Factor"]
# From an object to its own factors.
Linked = Callable[[Any], "list[Factor]"]


class Factor(NamedTuple):
    """A factor: what is done, with what.

    Attributes:
        operation: as it travels.
        terms: by their names.
        forward: of an aim, the axis that looks.
        inner: the factors of a whole product in place of a matrix.
    """

    operation: str
    terms: dict[str, Term]
    forward: str = ""
    inner: "tuple[Factor, ...] | None" = None

    @property
    def is_constant(self) -> bool:
        """Whether all that it is made of is known."""
        return all(term.is_constant for term in self.parts)

    @property
    def parts(self) -> list[Term]:
        """All terms in it."""
        inner = [part for factor in self.inner or () for part in factor.parts]
        return [*self.terms.values(), *inner]

    @property
    def wire(self) -> dict[str, Any]:
        """As it travels."""
        if self.inner is not None:
            return {"op": "matrix", "matrix": product_track(self.inner)}
        terms = {name: term for name, term in self.terms.items() if name != "center" or not is_zero(term)}
        told: dict[str, Any] = {"op": self.operation, **{name: track_of(term) for name, term in terms.items()}}
        if self.operation == "trs":
            told.setdefault("stretch", None)
        return told | {"forward": self.forward} if self.forward not in ("", "-z") else told


def product_track(factors: Sequence[Factor]) -> dict[str, Any]:
    """Factors as a track: the first one acts first."""
    return {"kind": "product", "factors": [factor.wire for factor in factors]}


class Composing:
    """The factors of runs of transforms, by one way to lower their settings."""

    def __init__(self, table: Table, leaf: Leaf, opaque: Opaque, linked: Linked) -> None:
        self.table = table
        self.leaf = leaf
        self.opaque = opaque
        self.linked = linked

    def of(self, run: Signal[Any] | None) -> list[Factor]:
        """The factors of a run, or of a kind's placement."""
        if run is None:
            return []
        if not isinstance(run, Run):
            return [self.placement(run)]
        found = self.of(run.below)
        for i, entry in enumerate(run.entries):
            factor = self.factor(run, i, entry.change)
            if factor is None:
                # Nothing is known but the matrix up to here.
                found = [self.opaque(self.until(run, i))]
            else:
                found.append(factor)
        return found

    def until(self, run: Run, i: int) -> Signal[Array]:
        """A run up to one of its transforms."""
        shorter = run_of(run.entries[: i + 1], below=run.below, origin=run.origin, table=self.table)
        assert shorter is not None
        return shorter

    def placement(self, stage: Signal[Any]) -> Factor:
        """What a kind's own settings say about where it stands."""
        base = stage.form if isinstance(stage, Stage) else None
        if not isinstance(base, Base) or "placement" not in base.kind.methods_by_name:
            return self.opaque(stage)
        kind, owner = base.kind, base.owner
        method = kind.methods_by_name["placement"]

        def setting(name: str, measure: str) -> Term:
            return self.leaf(kind.settings[name], owner.parameter(kind, name), measure)

        if method is Camera.methods_by_name["placement"]:
            places = {name: setting(name, "length") for name in ("eye", "target")}
            return Factor("look", places | {"up": setting("up", "share")})
        for other, name in ((Label, "anchor"), (Point, "at")):
            if method is other.methods_by_name["placement"]:
                return Factor("translate", {"offset": setting(name, "length")})
        return self.opaque(stage)

    def factor(self, run: Run, i: int, change: Change) -> Factor | None:
        """One transform; None where it depends on more than its own settings, and is none of those that are known."""
        act, wants, cls = run.steps[i]
        plain, wanted = step(cls)
        known: Any = change
        rule = _KNOWN.get(cls) if act is plain else None
        if rule is not None:
            if "position" in wanted and run.origin is not None:
                return None

            def attribute(name: str, measure: str) -> Term:
                index: int = known.indices[name]
                return self.leaf(known.settings[index], known.contents[index], measure)

            found = rule(attribute, change, self.linked)
            if found is not None:
                return found
        if wants:
            return None

        def matrix(values: Any) -> Array:
            return np.asarray(act(values, {}), dtype=np.float64)

        return self.opaque(lift(matrix)(change.values))


Attributes = Callable[[str, str], Term]
Rule = Callable[[Attributes, Any, Linked], Factor | None]


def _translate(of: Attributes, change: Any, linked: Linked) -> Factor:
    return Factor("translate", {"offset": of("offset", "length")})


def _rotate(of: Attributes, change: Any, linked: Linked) -> Factor:
    terms = {"angle": of("angle", "angle"), "axis": of("axis", "share"), "center": of("center", "length")}
    return Factor("rotate", terms)


def _orient(of: Attributes, change: Any, linked: Linked) -> Factor:
    turn = of("rotation", "rotation")
    if turn.shape != ROTATION:
        raise NotExactError("Orient: a rotation that is none")
    return Factor("orient", {"rotation": turn, "center": of("center", "length")})


def _scale(of: Attributes, change: Any, linked: Linked) -> Factor:
    return Factor("scale", {"factor": of("factor", "share"), "center": of("center", "length")})


def _matrix(of: Attributes, change: Any, linked: Linked) -> Factor | None:
    try:
        return Factor("matrix", {"matrix": of("value", "matrix")})
    except NotExactError:
        return None


def _mirror(of: Attributes, change: Any, linked: Linked) -> Factor | None:
    if change.is_live:
        return None
    matrix = transforms.mirroring(of("normal", "share").value, center=of("center", "length").value)
    return Factor("matrix", {"matrix": constant(matrix)})


def _shear(of: Attributes, change: Any, linked: Linked) -> Factor | None:
    """Linear in how much is sheared: a sum of known matrices, each times a component."""
    if any(isinstance(x, Signal) for x in change.contents[1:]):
        return None
    amount, axis, center = of("amount", "share"), of("axis", "share").value, of("center", "length").value
    if amount.is_constant:
        return Factor("matrix", {"matrix": constant(transforms.shearing(amount.value, axis, center=center))})
    total: Term = constant(np.eye(4))
    for i, unit in enumerate(np.eye(3)):
        part = transforms.shearing(unit, axis, center=center) - np.eye(4)
        if part.any():
            total = plus(total, times(component(amount, i), constant(part)))
    return Factor("matrix", {"matrix": total})


def _look_at(of: Attributes, change: Any, linked: Linked) -> Factor | None:
    if isinstance(change.source("forward"), Signal):
        return None
    terms = {"target": of("target", "length"), "up": of("up", "share")}
    return Factor("aim", terms, forward=change.source("forward"))


def _linked(of: Attributes, change: Any, linked: Linked) -> Factor | None:
    target = change.contents[0]
    if target is None:
        return Factor("matrix", {"matrix": constant(np.eye(4))})
    if isinstance(target, Signal):
        return None
    try:
        return Factor("matrix", {}, inner=tuple(linked(target)))
    except NotExactError:
        return None


_KNOWN: Final[dict[type[Transform], Rule]] = {
    Translate: _translate,
    Rotate: _rotate,
    Orient: _orient,
    Scale: _scale,
    Matrix: _matrix,
    Mirror: _mirror,
    Shear: _shear,
    LookAt: _look_at,
    LinkedXForm: _linked,
}


def factors_of(run: Signal[Any] | None, *, table: Table, leaf: Leaf, opaque: Opaque, linked: Linked) -> list[Factor]:
    """The factors of a run of transforms.

    Args:
        run: of an object; None for the identity.
        table: of the object's kind, which may understand a transform in its own way.
        leaf: what becomes of a setting.
        opaque: what becomes of a matrix of which no factors are known.
        linked: the factors of another object.
    """
    return Composing(table, leaf, opaque, linked).of(run)
