"""Selections: the points on which the changes after it act."""

from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.model.changes import Change
from reactive4d.model.forms import Made, Stage
from reactive4d.model.settings import Flag, Reference, Vector
from reactive4d.model.steps import step
from reactive4d.signals.facade import Signal

__all__ = ["Select", "Selected", "Selecting"]

Array = NDArray[Any]


class Selecting(Change):
    """A change that selects points. Its function `select` answers (V,) truth values; it may want `points`.

    >>> import reactive4d as r4
    >>> class Top(r4.Selecting):
    ...     above = r4.Float(0.0)
    ...
    ...     @staticmethod
    ...     def select(above, points):
    ...         return points[:, 2] > above
    >>> box = r4.Box()
    >>> _ = box.apply(Top())
    >>> box.selection.at(0.0).sum()
    np.int64(12)
    """

    __slots__ = ()

    lane = "shape"
    operation = "select"
    replaces: ClassVar[tuple[str, ...]] = ()


class Select(Selecting):
    """Select the points in a box, or inside of an object; deformations after it act on these alone.

    >>> import reactive4d as r4
    >>> box = r4.Box(segments=(1, 1, 2))
    >>> _ = box.apply(r4.Select(lower=(-1, -1, 0.1), upper=(1, 1, 1)))
    >>> _ = box.apply(r4.XForm(offset=(0, 0, 1)))
    >>> box.bounds.at(0.0)[:, 2]
    array([-0.5,  1.5])
    """

    __slots__ = ()

    positional = 0
    lower = Vector(unit="m", doc="the lowest corner of the box; without limit if it is not given")
    upper = Vector(unit="m", doc="the highest corner of the box; without limit if it is not given")
    volume = Reference(channel="inside", doc="a solid; its inside, in world space")
    is_inverted = Flag(False, doc="whether it selects all the others instead")

    @staticmethod
    def select(lower: Any, upper: Any, volume: Any, is_inverted: bool, points: Array) -> Array:
        """(V,)."""
        chosen = np.ones(len(points), np.bool_)
        if lower is not None:
            chosen &= (points >= lower).all(axis=1)
        if upper is not None:
            chosen &= (points <= upper).all(axis=1)
        if volume is not None:
            chosen &= volume(points)
        return ~chosen if is_inverted else chosen


class Selected(Made):
    """The same points, some of which are selected."""

    __slots__ = ()

    def make(self, name: str) -> Signal[Any] | None:
        """Points, origin and the selection are its own."""
        if name == "points":
            return self.placed()
        if name == "origin":
            return self.position()
        if name != "selection":
            return self.below.part(name)
        change = self.entry.change
        act, wanted = step(type(change))
        position = self.position() if "position" in wanted else None
        inputs = [change.values, self.placed(), *([] if position is None else [position])]

        def select(values: Any, points: Array, *at: Any) -> Array:
            given = {"points": points, "position": at[0] if at else np.zeros(3)}
            return freeze(np.array(act(values, given), dtype=np.bool_))

        return Stage(self, name, select, *inputs)
