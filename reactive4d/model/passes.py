"""Passes: deformations that move together go over the points in one pass; what holds still below is remembered.

A pass answers what its deformations would one after the other, to the bit. So which of them it takes together may be
decided by whatever is known when somebody asks, and no answer depends on it.
"""

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.engine import Cell
from reactive4d.engine.asks import read
from reactive4d.engine.frames import LOCK, Task, here
from reactive4d.engine.peeks import peek
from reactive4d.geometry.deformations.stacks import Maker, Point, carried, deform_each, origin_after
from reactive4d.geometry.transforms import Matrix
from reactive4d.model.steps import Step as Act
from reactive4d.model.steps import step
from reactive4d.signals.facade import Signal

if TYPE_CHECKING:
    from reactive4d.geometry.deformations.steps import Step
    from reactive4d.model.forms import Deformed, Form

__all__ = ["Passed"]

Array = NDArray[Any]
_ORIGIN: Point = np.zeros(3)
_ORIGIN.flags.writeable = False
_BRIEF = 0.1  # Seconds: what holds for less is moving, as whoever plays an animation sees it.


class Passed(Signal[Array]):
    """The points that a stepped deformation leaves, or where it leaves the origin."""

    __slots__ = ("asked", "form", "links", "part")

    def __init__(self, form: "Deformed", part: str) -> None:
        self.form = form
        self.part = part
        self.links = _links(form)
        self.asked: Any = None  # for which time and point it was evaluated last
        super().__init__(name="")

    @property
    def name(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """The form's name and the part's: `tube.bend.points`."""
        return f"{self.form.name}.{self.part}"

    @name.setter
    def name(self, value: str) -> None:
        pass

    def rule(self) -> Array:
        """In one pass from the highest points on that do not move, or from those below."""
        task = here.me.frame
        assert task is not None
        first = self._first(task)
        if first < len(self.links) - 1:
            try:
                return _together(self.part, self.links[first:])
            except Exception:  # noqa: BLE001  one by one, so that the error comes from the form to which it belongs
                return alone(self.part, self.form)
        return alone(self.part, self.form)

    def _first(self, task: Task) -> int:
        """The place of the lowest link that is to act here, instead of being asked for its points."""
        links, last = self.links, len(self.links) - 1
        asked, self.asked = self.asked, (task.t, task.point)
        # Asked again for the time for which it was asked last, something is being edited while the clock stands: each
        # form shall remember its points, since the next edit may be one of the top form alone.
        if not last or asked == self.asked or task.naive is not None:
            return last
        known = next((place for place in range(last, 0, -1) if _is_known(links[place].points_if_made(), task)), 0)
        if _moves(links[known].points(), task):
            return known
        return next((place for place in range(known, last) if _moves(links[place].turns, task)), last)


class _Link:
    """One of the things that act on the points: a deformation, or the run of transforms before it."""

    __slots__ = ("form", "is_run")

    def __init__(self, form: "Deformed", *, is_run: bool) -> None:
        self.form = form
        self.is_run = is_run

    @property
    def turns(self) -> Signal[Any]:
        """What it does at a time: the matrix, or the values of the change."""
        run = self.form.run
        return run if self.is_run and run is not None else self.form.entry.change.values

    def points(self) -> Signal[Any]:
        """The points that it finds."""
        return self.form.below.need("points") if self.is_run else self.form.placed()

    def points_if_made(self) -> Signal[Any] | None:
        """The same, if anybody has wanted them yet."""
        is_placed = self.form.run is not None and not self.is_run
        return self.form.parts.get("placed") if is_placed else self.form.below.parts.get("points")

    def origin(self) -> Signal[Any] | None:
        """Where the object's origin is before it acts; None for (0, 0, 0)."""
        return self.form.below.part("origin") if self.is_run else self.form.position()


def _links(form: "Deformed") -> list[_Link]:
    """What leads to this form one thing after the other, up to where what was inherited begins, or other changes.

    What is inherited is asked for its points, so that extensions share them; where points are selected, each form is.
    """
    if form.part("selection") is not None:
        return [_Link(form, is_run=False)]
    links: list[_Link] = []
    owner = form.entry.owner
    below: Form = form
    while isinstance(below, type(form)) and below.entry.change.is_stepped and below.entry.owner is owner:
        links.append(_Link(below, is_run=False))
        if below.run is not None:
            links.append(_Link(below, is_run=True))
        below = below.below
    return links[::-1]


def _is_known(cell: Cell | None, task: Task) -> bool:
    """Whether an answer is remembered at the task's point; nothing is read by it."""
    if cell is None:
        return False
    with LOCK:
        return peek(cell.engine, cell, task.t, task.point) is not None


def _moves(cell: Cell, task: Task) -> bool:
    """Whether an answer is another one soon before or after; nothing is read by it, only brought up to date."""
    hit = read(cell, task, task.t, task.point)
    return hit[1] - hit[0] < _BRIEF


def _together(part: str, links: list[_Link]) -> Array:
    points = links[0].points().now()
    acts: list[Maker | Matrix] = []
    for link in links:
        turn = link.turns.now()
        acts.append(turn if link.is_run else partial(_made, step(type(link.form.entry.change))[0], turn))
    origin = links[0].origin()
    return (deform_each if part == "points" else origin_after)(points, acts, None if origin is None else origin.now())


def _made(act: Act, values: Any, origin: Point) -> "Step":
    return act(values, {"position": origin})


def alone(part: str, form: "Deformed") -> Array:
    """What one form makes of the points below it, or of the origin; only inside of an evaluation."""
    act, wanted = step(type(form.entry.change))
    before = form.position() if part == "origin" or "position" in wanted else None
    points = form.placed().now() if part == "points" else None
    values = form.entry.change.values.now()
    extent = form.need("extent").now()
    origin = _ORIGIN if before is None else before.now()
    made = _made(act, values, origin)
    return carried(made, origin, extent) if points is None else made.map(points, extent)
