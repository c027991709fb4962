"""Where one asks, besides time: the values that a reader gave to parameters.

A point holds only what was given; a parameter that was not given has its default. Points are kept by the engine, so
that equal ones are one object.
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from reactive4d.engine.links import CellRef, reference

if TYPE_CHECKING:
    from reactive4d.engine.cells import Axis

__all__ = ["Point"]


class Point:
    """The values that a reader gave, by name, and as each parameter understands them."""

    __slots__ = ("given", "values")

    def __init__(self, given: Mapping[str, Any]) -> None:
        self.given = dict(given)
        self.values: dict[CellRef[Axis], Any] = {}  # points are kept, and must not keep parameters alive

    def value(self, axis: "Axis") -> Any:
        """The value of one parameter here."""
        ref = axis.ref or reference(axis)
        try:
            return self.values[ref]
        except KeyError:
            if len(self.values) > 2 * len(self.given) + 16:
                self.values = {other: value for other, value in self.values.items() if other() is not None}
            value = self.values[ref] = axis.admit(self.given[axis.name]) if axis.name in self.given else axis.default
            return value

    def shown(self, axis: "Axis") -> Any:
        """The value of one parameter here, as an answer."""
        return axis.present(self.value(axis))

    def __repr__(self) -> str:
        return ", ".join(f"{name}={value!r}" for name, value in sorted(self.given.items()))
