"""Outlines as settings: points in the plane or in space, or an object that has some, such as a path."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.model.settings import Setting, is_signal
from reactive4d.signals.algebra import lift
from reactive4d.signals.facade import Signal
from reactive4d.signals.functions import Function

__all__ = ["Outline", "Outlines"]

Array = NDArray[np.float64]
MOST = 1_000_000


class Outline(Setting[Array]):
    """Points, (N, 2) or (N, 3), or an object whose outline they are, or a signal of either.

    >>> import reactive4d as r4
    >>> class Fence(r4.Object):
    ...     course = r4.Outline(((0, 0), (1, 0)))
    >>> fence = Fence(course=r4.Ngon(1.0, sides=3))
    >>> fence.course.at(0.0).shape
    (3, 3)
    """

    def __init__(self, default: Any = None, *, fewest: int = 2, doc: str = "") -> None:
        self.fewest = fewest
        super().__init__(default, doc=doc, unit="m")

    def admit(self, value: Any) -> Any:
        """An object as it is, points as an array."""
        if is_signal(value) or hasattr(value, "changes") or (value is None and self.is_optional):
            return value
        return self.check(value)

    def signal(self, content: Any) -> Signal[Any] | None:
        """The outline of the object."""
        if is_signal(content):

            def followed() -> Any:
                value: Any = content.now()
                return value.outline.now() if hasattr(value, "changes") else value

            return Function(followed, name=f"{content.name}.outline")
        return content.outline if hasattr(content, "changes") else None

    def check(self, value: Any) -> Any:
        """(N, 2) or (N, 3)."""
        expected = f"at least {self.fewest} points, (N, 2) or (N, 3)"
        try:
            array = np.array(value, dtype=np.float64)
        except (TypeError, ValueError):
            raise self.refused(expected, value) from None
        if array.ndim != 2 or array.shape[1] not in (2, 3) or not self.fewest <= len(array) <= MOST:
            raise self.refused(expected, array)
        if not np.isfinite(array).all():
            raise self.refused(f"{expected}, all finite", value)
        return freeze(array)


class Outlines(Setting[tuple[Array, ...]]):
    """Several outlines: a list of objects with outlines, of points, or of signals.

    >>> import reactive4d as r4
    >>> class Atlas(r4.Object):
    ...     lands = r4.Outlines((((0, 0), (1, 0), (0, 1)),))
    >>> atlas = Atlas(lands=[r4.Ngon(1.0, sides=5), [(0, 0), (1, 0), (1, 1)]])
    >>> [len(land) for land in atlas.lands.at(0.0)]
    [5, 3]
    """

    def __init__(self, default: Any = None, *, fewest: int = 1, doc: str = "") -> None:
        self.fewest = fewest
        self.one = Outline(fewest=3)
        super().__init__(default, doc=doc, unit="m")

    def admit(self, value: Any) -> Any:
        """A tuple of what an outline may be; an object alone is one of them."""
        if is_signal(value):
            return value
        if hasattr(value, "changes"):
            value = (value,)
        if not isinstance(value, list | tuple) or not self.fewest <= len(value) <= 1000:  # pyright: ignore
            raise self.refused(f"a list of at least {self.fewest} outlines", value)
        self.one.name, self.one.owner = self.name, self.owner
        return tuple([self.one.admit(x) for x in value])  # pyright: ignore[reportUnknownVariableType]

    def signal(self, content: Any) -> Signal[Any] | None:
        """All outlines as one signal, a tuple."""
        if is_signal(content):
            return content
        signals = [self.one.signal(x) for x in content]
        if all(x is None for x in signals):
            return None
        return lift(_together)(*[x if s is None else s for x, s in zip(content, signals, strict=True)])

    def check(self, value: Any) -> Any:
        """A tuple of arrays."""
        return tuple([self.one.check(x) for x in value])


def _together(*outlines: Any) -> tuple[Any, ...]:
    return outlines
