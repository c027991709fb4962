"""Charts: who asks whom, as boxes in rows: what is asked stands above who asks it, the picture at the bottom.

Rows are filled from the bottom, at most three boxes each, so that a chart is no wider than a phone. The boxes of a row
have the order in which the fewest arrows cross. A long arrow passes the rows between through gaps of its own.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import permutations
from typing import Any

from reactive4d.engine.frames import LOCK
from reactive4d.engine.graphs import between
from reactive4d.model.scenes import Scene

__all__ = ["chart", "rows_of"]

WIDEST = 3  # boxes in a row
GAP = 0.2  # how wide the gap is through which a long arrow goes, in boxes with the space round them
STRAIGHT = 8.0  # how much more a gap minds the next gap than a box
SWEEPS = 6
MOST_TRIED = 120  # orders of a row

Arrows = Sequence[tuple[int, int]]


def chart(scene: Scene) -> dict[str, Any]:
    """The cells of a scene as boxes with arrows.

    Args:
        scene: has been asked, so that it is known who asks whom.

    Returns:
        `boxes`, each {name, at: [x, y]}; `arrows`, each [from, to, [x, y], …]: indices of two boxes, and the gaps
        through which it goes. x counts boxes from the left, y rows from the top.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere()
    >>> _ = ball.translate(r4.vec(0, 0, r4.time))
    >>> scene = r4.Scene(ball=ball)
    >>> scene.cells = {"place": ball.matrix, "picture": scene.frame}
    >>> frame = scene.at(0.0)
    >>> chart(scene)
    {'boxes': [{'name': 'place', 'at': [0.5, 0]}, {'name': 'picture', 'at': [0.5, 1]}], 'arrows': [[0, 1]]}
    """
    names = list(scene.cells)
    with LOCK:
        links = between(list(scene.cells.values()))
    arrows = [(below, above) for above, below in links if below != above]
    rows = rows_of(len(names), arrows)
    found = _Board(rows, arrows)
    return {
        "boxes": [{"name": name, "at": found.at(i)} for i, name in enumerate(names)],
        "arrows": [[a, b, *[found.at(gap) for gap in found.gaps.get((a, b), ())]] for a, b in arrows],
    }


def rows_of(count: int, arrows: Arrows) -> list[list[int]]:
    """Boxes in rows from top to bottom: each above all that ask it, at most three in a row, in as few rows as may be.

    Args:
        count: of the boxes.
        arrows: (asked, asking); a box that asks itself through others stands where it comes.

    >>> rows_of(4, [(0, 1), (0, 2), (1, 3), (2, 3)])
    [[0], [1, 2], [3]]
    """
    above: list[set[int]] = [set() for _ in range(count)]  # whom each asks
    below: list[set[int]] = [set() for _ in range(count)]  # who asks it
    for asked, asking in arrows:
        above[asking].add(asked)
        below[asked].add(asking)
    depth = [0] * count  # how many rows have to stand above it
    for _ in range(count):
        for i in range(count):
            depth[i] = min(max([depth[j] + 1 for j in above[i]], default=0), count)
    rows: list[list[int]] = []
    left = set(range(count))
    while left:
        free = [i for i in left if not below[i] & left] or sorted(left)[:1]
        # The one with the most above it first: it decides how many rows there are.
        row = sorted(sorted(free, key=lambda i: (-depth[i], i))[:WIDEST])
        rows.append(row)
        left -= set(row)
    return rows[::-1]


@dataclass
class _Board:
    """Where the boxes stand.

    Attributes:
        gaps: for each long arrow the gaps through which it goes; a gap is a negative number.
    """

    rows: list[list[int]]
    arrows: Arrows
    gaps: dict[tuple[int, int], list[int]] = field(default_factory=dict[tuple[int, int], list[int]])

    def __post_init__(self) -> None:
        self._row = {i: y for y, row in enumerate(self.rows) for i in row}
        self._near: dict[int, list[int]] = {}
        steps = [(a, b) for a, b in self.arrows if self._row[a] < self._row[b]]
        for a, b in steps:
            chain = [a]
            for y in range(self._row[a] + 1, self._row[b]):
                gap = -1 - sum(map(len, self.gaps.values()))
                self.gaps.setdefault((a, b), []).append(gap)
                self.rows[y].append(gap)
                self._row[gap] = y
                chain.append(gap)
            for i, j in zip(chain, [*chain[1:], b], strict=True):
                self._near.setdefault(i, []).append(j)
                self._near.setdefault(j, []).append(i)
        self._untangle()
        self._x = self._placed()

    def at(self, i: int) -> list[float]:
        """Where a box or a gap is: its middle, in boxes from the left, and its row."""
        return [self._x[i], self._row[i]]

    def _others(self, i: int, y: int) -> list[int]:
        return [j for j in self._near.get(i, ()) if self._row[j] == y]

    # -- order -------------------------------------------------------------------------------------------------------

    def _untangle(self) -> None:
        """The order within the rows: from row to row and back, that in which the fewest arrows cross."""
        for sweep in range(SWEEPS):
            order = range(len(self.rows)) if sweep % 2 == 0 else range(len(self.rows) - 1, -1, -1)
            for y in order:
                self.rows[y] = min(self._tries(y), key=lambda row, y=y: self._crossings(y, row))

    def _tries(self, y: int) -> list[list[int]]:
        """Orders of a row that are worth a try, that in which it is the first of them."""
        row = self.rows[y]
        place = {i: k for other in self.rows for k, i in enumerate(other)}
        near = {i: [place[j] / len(self.rows[self._row[j]]) for j in self._near.get(i, ())] for i in row}
        middle = sorted(row, key=lambda i: sum(near[i]) / len(near[i]) if near[i] else 0.5)
        return [row, middle, *[list(p) for p, _ in zip(permutations(row), range(MOST_TRIED), strict=False)]]

    def _crossings(self, y: int, row: list[int]) -> tuple[int, int]:
        """How many arrows cross above and below a row; and how far they go aside."""
        place = {i: k for k, i in enumerate(row)}
        crossed, aside = 0, 0
        for other in (y - 1, y + 1):
            if not 0 <= other < len(self.rows):
                continue
            theirs = {j: k for k, j in enumerate(self.rows[other])}
            pairs = [(place[i], theirs[j]) for i in row for j in self._others(i, other)]
            for n, (a, b) in enumerate(pairs):
                crossed += sum((a - c) * (b - d) < 0 for c, d in pairs[:n])
                aside += abs((2 * a + 1) * len(theirs) - (2 * b + 1) * len(row))
        return crossed, aside

    # -- places ------------------------------------------------------------------------------------------------------

    def _placed(self) -> dict[int, float]:
        """Each in the middle between those it is joined to, as far as its neighbours leave room."""
        x: dict[int, float] = {}
        for row in self.rows:
            at = -sum(map(_width, row)) / 2
            for i in row:
                x[i] = at + _width(i) / 2
                at += _width(i)
        most = max(sum(map(_width, row)) for row in self.rows)
        for sweep in range(SWEEPS):
            for row in self.rows if sweep % 2 else self.rows[::-1]:
                wish = {i: self._wish(i, x) for i in row}
                x.update(_apart(row, wish, most / 2))
        left = min(x[i] - _width(i) / 2 for i in x)
        return {i: round(at - left, 3) for i, at in x.items()}

    def _wish(self, i: int, x: Mapping[int, float]) -> float:
        """Where it wishes to be: a gap above all where the gaps of the same arrow are, so that it goes straight."""
        near = [(STRAIGHT if i < 0 and j < 0 else 1.0, x[j]) for j in self._near.get(i, ())]
        weight = sum(w for w, _ in near)
        return sum(w * at for w, at in near) / weight if near else x[i]


def _width(i: int) -> float:
    return 1.0 if i >= 0 else GAP


def _apart(row: Sequence[int], wish: Mapping[int, float], end: float) -> dict[int, float]:
    """As near to where each wishes to be as can be, in this order, from -end to end."""
    lows: list[float] = []
    at = -end
    for i in row:
        lows.append(max(at + _width(i) / 2, wish[i]))
        at = lows[-1] + _width(i) / 2
    highs: list[float] = []
    at = end
    for i in row[::-1]:
        highs.append(min(at - _width(i) / 2, wish[i]))
        at = highs[-1] - _width(i) / 2
    highs.reverse()
    made: dict[int, float] = {}
    at = -end
    rest = sum(map(_width, row))
    for i, low, high in zip(row, lows, highs, strict=True):
        half = _width(i) / 2
        made[i] = min(max((low + high) / 2, at + half), end - rest + half)
        at = made[i] + half
        rest -= 2 * half
    return made
