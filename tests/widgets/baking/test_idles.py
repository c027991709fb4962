"""What says the same at all baked values of a parameter, and between them, is said once."""

from typing import Any

import numpy as np
import param

import reactive4d as r4
from reactive4d_widgets.plans import planned
from reactive4d_widgets.tables import Table, tabulated


class Vase(r4.Illustration):
    """Turned from a path through a point that a reader moves: its triangles are found out from the path."""

    belly = param.Number(0.5, bounds=(0.3, 1.0))

    def build(self) -> r4.Scene:
        """One point of three follows the parameter."""
        points = [r4.Point((0.3, 0, 0)), r4.Point(r4.vec(self.signals.belly, 0, 1)), r4.Point((0.3, 0, 2))]
        return r4.Scene(vase=r4.Revolution(r4.Path(points, samples=8), segments=12, smooth=True))


class Faceted(r4.Illustration):
    """A cylinder that has more sides for some values of a parameter."""

    size = param.Number(0.0, bounds=(0.0, 1.0))

    def build(self) -> r4.Scene:
        """More of them between 0.4 and 0.6."""
        size = self.signals.size
        return r4.Scene(one=r4.Cylinder(0.5 + size, 1, segments=r4.where(abs(size - 0.5) < 0.1, 24, 12)))


def baked(thing: Any, **parameters: Any) -> Table:
    """What a page would hold of it."""
    return tabulated(planned(thing, parameters=parameters))


def wheres(table: Table, channel: str) -> list[dict[str, Any]]:
    """For which values of parameters a channel is told."""
    return [segment["where"] for segment in table.segments if segment["channel"] == channel]


def grade(table: Table) -> str:
    """Of the only parameter."""
    return table.manifest["parameters"][0]["grade"]


def test_triangles_that_stay_the_same_are_told_once_and_the_points_go_between_them():
    """
    A vase follows its path, and the path a point; what is made of triangles reads all that.

        belly --> point --> path --> points, topology
    """
    table = baked(Vase(), belly=[0.3, 0.5, 1.0])
    assert wheres(table, "vase#topology") == [{}]
    assert wheres(table, "vase#points") == [{"belly": 0.3}, {"belly": 0.5}, {"belly": 1.0}]
    assert grade(table) == "free"


def test_triangles_that_differ_are_told_for_each_value():
    """Nothing is said between values where the triangles are others."""
    table = baked(Faceted(), size=[0.0, 0.5, 1.0])
    assert [where["size"] for where in wheres(table, "one#topology")] == [0.0, 0.5, 1.0]
    assert grade(table) == "stops"


def test_triangles_that_differ_between_two_values_alone_are_noticed():
    """At 0 and 1 they are the same; at the middle, which nobody baked, they are not."""
    table = baked(Faceted(), size=[0.0, 1.0])
    assert [where["size"] for where in wheres(table, "one#topology")] == [0.0, 1.0]
    assert grade(table) == "stops"
    calm = baked(Faceted(), size=np.array([0.0, 0.2]))
    assert wheres(calm, "one#topology") == [{}]
    assert grade(calm) == "free"
