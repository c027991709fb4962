"""Passes: deformations that move together go over the points in one pass; what holds still below is remembered.

A pass answers what its deformations would one after the other, to the bit. So which of them it takes together may be
decided by whatever is known when somebody asks, and no answer depends on it.
"""

from functools import partial
from math import nan
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.engine import Cell
from reactive4d.engine.asks import read
from reactive4d.engine.frames import LOCK, Task, here
from reactive4d.engine.peeks import peek
from reactive4d.geometry.deformations.stacks import Maker, carried, deform_each, origin_after
from reactive4d.model.steps import step
from reactive4d.signals.facade import Signal

if TYPE_CHECKING:
    from reactive4d.geometry.deformations.steps import Step as Deforming
    from reactive4d.model.forms import Deformed

__all__ = ["Passed"]

Array = NDArray[Any]
_ORIGIN: NDArray[np.float64] = np.zeros(3)
_ORIGIN.flags.writeable = False
_BRIEF = 0.1  # Seconds: what holds for less is moving, as whoever plays an animation sees it.


class Passed(Signal[Array]):
    """The points that a stepped deformation leaves, or where it leaves the origin."""

    __slots__ = ("asked", "form", "forms", "part")

    def __init__(self, form: "Deformed", part: str) -> None:
        self.form = form
        self.part = part
        self.forms = form.together()
        self.asked = nan  # for which time it was evaluated last
        super().__init__(name="")

    @property
    def name(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """The form's name and the part's: `tube.bend.points`."""
        return f"{self.form.name}.{self.part}"

    @name.setter
    def name(self, value: str) -> None:
        pass

    def rule(self) -> Array:
        """In one pass from the highest form on that does not move, or from the one below."""
        task = here.me.frame
        assert task is not None
        first = self._first(task)
        if first < len(self.forms) - 1:
            try:
                return _together(self.part, self.forms[first:])
            except Exception:  # noqa: BLE001  one by one, so that the error comes from the form to which it belongs
                return _alone(self.part, self.form)
        return _alone(self.part, self.form)

    def _first(self, task: Task) -> int:
        """The place of the lowest form that is to be evaluated here, instead of being asked for its points."""
        forms, last = self.forms, len(self.forms) - 1
        if task.naive is not None or not last:
            return last
        # Asked again for the time for which it was asked last, something is being edited while the clock stands: each
        # form shall remember its points, since the next edit may be one of the top form alone.
        asked, self.asked = self.asked, task.t
        if asked == task.t:
            return last
        for place in range(last, 0, -1):
            points = forms[place - 1].parts.get("points")
            if points is not None and _is_known(points, task):
                return place
        if _moves(forms[0].placed(), task):
            return 0
        for place, form in enumerate(forms):
            if _moves(form.entry.change.values, task):
                return place
        return last


def _is_known(cell: Cell, task: Task) -> bool:
    """Whether an answer is remembered at the task's point; nothing is read by it."""
    with LOCK:
        return peek(cell.engine, cell, task.t, task.point) is not None


def _moves(cell: Cell, task: Task) -> bool:
    """Whether an answer is another one soon before or after; nothing is read by it, only brought up to date."""
    hit = read(cell, task, task.t, task.point)
    return hit[1] - hit[0] < _BRIEF


def _together(part: str, forms: "list[Deformed]") -> Array:
    lowest = forms[0]
    points = lowest.placed().now()
    makers: list[Maker] = []
    for form in forms:
        act, _ = step(type(form.entry.change))
        makers.append(partial(_made, act, form.entry.change.values.now()))
    origin = lowest.position()
    go = deform_each if part == "points" else origin_after
    return go(points, makers, _ORIGIN if origin is None else origin.now())


def _made(act: Any, values: Any, origin: NDArray[np.float64]) -> "Deforming":
    return act(values, {"position": origin})


def _alone(part: str, form: "Deformed") -> Array:
    act, wanted = step(type(form.entry.change))
    before = form.position() if part == "origin" or "position" in wanted else None
    points = form.placed().now() if part == "points" else None
    values = form.entry.change.values.now()
    extent = form.need("extent").now()
    origin = _ORIGIN if before is None else before.now()
    made = _made(act, values, origin)
    return carried(made, origin, extent) if points is None else made.map(points, extent)
