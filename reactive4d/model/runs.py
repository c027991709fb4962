"""Runs of transforms: each collapses into one matrix, and objects that have a run in common share it."""

from typing import Any
from weakref import WeakValueDictionary

import numpy as np

from reactive4d.engine import Formula
from reactive4d.engine.frames import LOCK
from reactive4d.engine.links import link
from reactive4d.errors import ShapeError
from reactive4d.model.attributes import Merge
from reactive4d.model.places import Entry
from reactive4d.model.steps import Step, step
from reactive4d.model.tables import Table
from reactive4d.signals.facade import Signal

__all__ = ["Product", "Run", "run_of"]

Array = np.ndarray[Any, np.dtype[np.float64]]


class Product:
    """A run as an answer: signals do not answer signals."""

    __slots__ = ("run",)

    def __init__(self, run: "Signal[Array]") -> None:
        self.run = run


class Run(Signal[Array], Formula):
    """The matrix of some transforms after those of another run, all by the same owner.

    Its inputs are the matrix below, if there is one; where the object's origin is before the first transform, if it is
    not the origin and somebody wants to know; and of every change what its values are made of, so that nothing is
    remembered in between.
    """

    __slots__ = ("below", "entries", "origin", "plan", "product", "steps", "takes_origin")

    def __init__(
        self, below: Signal[Array] | None, entries: tuple[Entry, ...], origin: Signal[Array] | None, kind: Table | None
    ) -> None:
        self.product = Product(self)
        self.below = below
        self.entries = entries
        self.origin = origin
        replaced = kind.changes if kind is not None else {}
        made = [step(type(e.change), replaced.get(type(e.change).script)) for e in entries]
        self.steps: list[tuple[Step, bool, type]] = [
            (s, bool(wanted), type(e.change)) for (s, wanted), e in zip(made, entries, strict=True)
        ]
        self.takes_origin = origin is not None and any("position" in wanted for _, wanted in made)
        self.plan: tuple[tuple[int, Merge | None], ...] = ()
        super().__init__(self._product, name="", engine=entries[0].change.values.engine)
        values = tuple([entry.change.values for entry in entries])
        with LOCK:
            for one in values:
                one.follow(self)
            self.rewire()

    def rewire(self) -> None:
        """Read what the changes are made of by now; the lock is held."""
        inputs: list[Any] = [] if self.below is None else [self.below]
        if self.takes_origin:
            inputs.append(self.origin)
        plan: list[tuple[int, Merge | None]] = []
        for entry in self.entries:
            values = entry.change.values
            parts = values.inputs or (values,)
            inputs.extend(parts)
            plan.append((len(parts), values.merge))
        # What is assigned to a change concerns it, though it reads past the change: so the engine lets go of that link.
        link(self, tuple([entry.change.values for entry in self.entries]))
        self.plan = tuple(plan)
        self.inputs = tuple(inputs)
        self.sole = None
        if self.segments or self.shelves is not None:
            link(self, self.inputs)

    @property
    def name(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """The owner's name and what the transforms are called."""
        names = ", ".join([entry.change.name for entry in self.entries[:3]])
        return f"{self.entries[0].owner.name}.({names}{', …' if len(self.entries) > 3 else ''})"

    @name.setter
    def name(self, value: str) -> None:
        pass

    def _product(self, *values: Any) -> Array:
        matrix: Any = None
        origin: Any = None
        i = 0
        if self.below is not None:
            matrix, i = values[0], 1
        if self.takes_origin:
            origin, i = values[i], i + 1
        for (act, wants, change), (count, merge) in zip(self.steps, self.plan, strict=True):
            value = values[i] if merge is None else merge(values[i + 1 : i + count])
            i += count
            factor = act(value, _given(matrix, origin) if wants else _NOTHING)
            if type(factor) is not np.ndarray or factor.shape != (4, 4):
                factor = _as_matrix(factor, change)
            matrix = factor if matrix is None else factor @ matrix
        return matrix


_NOTHING: dict[str, Any] = {}
_UNMOVED: Array = np.eye(4)
_UNMOVED.flags.writeable = False
_ZERO: Array = np.zeros(3)
_ZERO.flags.writeable = False


def _given(matrix: Array | None, origin: Array | None) -> dict[str, Any]:
    if matrix is None:
        return {"before": _UNMOVED, "position": _ZERO if origin is None else origin}
    position = matrix[:3, 3] if origin is None else matrix[:3, :3] @ origin + matrix[:3, 3]
    return {"before": matrix, "position": position}


def _as_matrix(value: Any, change: type) -> Array:
    try:
        matrix = np.array(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise ShapeError(f"{change.__name__}.matrix: expected 4 rows of 4 finite numbers, got {value!r}") from None
    if matrix.shape != (4, 4) or not np.isfinite(matrix).all():
        raise ShapeError(f"{change.__name__}.matrix: expected 4 rows of 4 finite numbers, got shape {matrix.shape}")
    return matrix


# By the identities of what they are made of: a run keeps all of it alive, and nobody here keeps a run alive.
_runs: WeakValueDictionary[tuple[int, ...], Run] = WeakValueDictionary()


def run_of(
    entries: tuple[Entry, ...],
    *,
    below: Signal[Array] | None = None,
    origin: Signal[Array] | None = None,
    table: Table | None = None,
) -> "Run | Signal[Array] | None":
    """The matrix of the transforms of these entries, after `below`; None for the identity.

    What lies before the first change of another owner is a run of its own, so that extensions share what they inherit.
    """
    table = table if table is not None and table.changes else None
    start = 0
    while start < len(entries):
        stop = start + 1
        owner = entries[start].owner
        while stop < len(entries) and entries[stop].owner is owner:
            stop += 1
        own = entries[start:stop]
        key = (id(below), *map(id, own), id(origin), id(table))
        run = _runs.get(key)
        if run is None:
            run = _runs.setdefault(key, Run(below, own, origin, table))
        below = run
        start = stop
    return below
