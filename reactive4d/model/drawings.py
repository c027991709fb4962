"""What is drawn of an object that has no surface: lines through points, and points alone."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze

__all__ = ["Lines", "Points", "strokes"]


class Lines:
    """Lines through points: what is drawn of a path.

    Attributes:
        points: (N, 3) float32, in local space.
        lines: (K, 2) int32, which two points each straight piece joins; None where each point is joined to the next.
        colors: (N, 4) float32, sRGB and alpha of each point; None where all are of the object's own.

    >>> import reactive4d as r4
    >>> frame = r4.Scene(way=r4.Path([(0, 0, 0), (1, 0, 0)], samples=8), ring=r4.Circle(segments=3)).at(0.0)
    >>> frame["way"].drawn, frame["way"].drawn.lines
    (Lines(9 points), None)
    >>> frame["ring"].drawn.lines.tolist()
    [[0, 1], [1, 2], [2, 0]]
    """

    __slots__ = ("colors", "lines", "points")

    compares_exactly = True

    def __init__(
        self,
        points: NDArray[np.float32],
        lines: NDArray[np.int32] | None = None,
        colors: NDArray[np.float32] | None = None,
    ) -> None:
        self.points = points
        self.lines = lines
        self.colors = colors

    @property
    def nbytes(self) -> int:
        """How many bytes the arrays take together."""
        return sum(array.nbytes for array in (self.points, self.lines, self.colors) if array is not None)

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Lines)
            and _same(self.points, other.points)
            and _same(self.lines, other.lines)
            and _same(self.colors, other.colors)
        )

    def __hash__(self) -> int:
        return hash(self.points.tobytes())

    def __repr__(self) -> str:
        return f"Lines({len(self.points)} points)"


class Points:
    """Points alone: what is drawn of a point, and of a mesh without faces.

    Attributes:
        points: (N, 3) float32, in local space.
        colors: (N, 4) float32, sRGB and alpha of each point; None where all are of the object's own.

    >>> import reactive4d as r4
    >>> r4.Scene(p=r4.Point((1, 2, 3))).at(0.0)["p"].drawn
    Points(1 point)
    """

    __slots__ = ("colors", "points")

    compares_exactly = True

    def __init__(self, points: NDArray[np.float32], colors: NDArray[np.float32] | None = None) -> None:
        self.points = points
        self.colors = colors

    @property
    def nbytes(self) -> int:
        """How many bytes the arrays take together."""
        return self.points.nbytes + (0 if self.colors is None else self.colors.nbytes)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Points) and _same(self.points, other.points) and _same(self.colors, other.colors)

    def __hash__(self) -> int:
        return hash(self.points.tobytes())

    def __repr__(self) -> str:
        return f"Points({len(self.points)} point{'' if len(self.points) == 1 else 's'})"


def _same(a: Any, b: Any) -> bool:
    return a is b or (a is not None and b is not None and a.shape == b.shape and a.tobytes() == b.tobytes())


def strokes(lines: Any, count: int) -> NDArray[np.int32] | None:
    """The straight pieces of lines: (K, 2) of so many points, or None where each point is joined to the next.

    Args:
        lines: (n,) or (m, n) whole numbers: which points each line runs through.
        count: how many points there are.

    >>> strokes([0, 1, 2], 3) is None, strokes([[0, 1], [2, 3]], 4).tolist()
    (True, [[0, 1], [2, 3]])
    """
    runs = np.atleast_2d(np.asarray(lines, dtype=np.int32))
    if len(runs) == 1 and runs.shape[1] == count and (runs[0] == np.arange(count)).all():
        return None
    return freeze(np.stack([runs[:, :-1], runs[:, 1:]], axis=2).reshape(-1, 2).astype(np.int32))
