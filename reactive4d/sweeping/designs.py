"""Designs: several parameters that vary together along one dimension, besides grids.

`zipped` walks through given values side by side; `random` and `latin_hypercube` scatter points over ranges. A design is
a value in `over`, and the name that it stands under is the name of the dimension.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from inspect import signature
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ParameterError, hint

__all__ = ["Design", "latin_hypercube", "random", "zipped"]

LIST: Any = list  # for `isinstance`: by the classes themselves a checker would find unknown items
TUPLE: Any = tuple

# (count, parameters) numbers from 0 to 1, for that many points and parameters.
Draw: TypeAlias = Callable[[int, int], NDArray[np.float64]]


@dataclass(frozen=True)
class Design:
    """Parameters that vary together along one dimension; made by `zipped`, `random` or `latin_hypercube`.

    Attributes:
        count: how many points there are.
        columns: by parameter its values; or, where points are drawn, its range: (lowest, highest), a list to choose
            from, or None for all that the parameter admits.
        draw: how points are drawn; None where the values are given.
    """

    count: int
    columns: Mapping[str, Any]
    draw: Draw | None = None

    def values(self, ranges: Callable[[str], Any]) -> dict[str, list[Any]]:
        """By parameter the values along the dimension.

        Args:
            ranges: what a parameter admits: (lowest, highest), of whole numbers for a whole number, or a list.

        Raises:
            ParameterError: a range that is none.
        """
        if self.draw is None:
            return {name: list(column) for name, column in self.columns.items()}
        points = self.draw(self.count, len(self.columns))
        drawn: dict[str, list[Any]] = {}
        for (name, column), shares in zip(self.columns.items(), points.T, strict=True):
            drawn[name] = _scaled(name, ranges(name) if column is None else column, shares, ranges)
        return drawn


def zipped(**values: Sequence[Any]) -> Design:
    """Values side by side: the first of each parameter, the second of each, and so on.

    Raises:
        ParameterError: there are none, or not equally many of each.

    >>> zipped(length=[0.5, 1.0, 2.0], angle=[10, 20, 40]).count
    3
    """
    if not values:
        raise hint(ParameterError("zipped: no parameters"), "zipped(length=[0.5, 1.0], angle=[10, 20])")
    columns = {name: list(column) for name, column in values.items()}
    counts = {name: len(column) for name, column in columns.items()}
    if len(set(counts.values())) > 1:
        told = ", ".join([f"{count} of {name}" for name, count in counts.items()])
        raise hint(ParameterError(f"zipped: not equally many values: {told}"), "a grid takes them by themselves")
    return Design(next(iter(counts.values())), columns)


def random(count: int, /, *, seed: int = 0, **ranges: Any) -> Design:
    """Points drawn independently and evenly.

    Args:
        count: how many.
        seed: the same seed draws the same points.
        **ranges: by parameter (lowest, highest), a list to choose from, or None for all that the parameter admits.

    Raises:
        ParameterError: there are no parameters, or no points.

    >>> random(100, length=(0.5, 2.0), angle=(10, 45)).count
    100
    """

    def draw(count: int, columns: int) -> NDArray[np.float64]:
        return np.random.default_rng(seed).random((count, columns))

    return Design(_count(count, ranges, "random"), ranges, draw)


def latin_hypercube(count: int, /, *, seed: int = 0, **ranges: Any) -> Design:
    """Points of which each parameter's values lie evenly: one in each of `count` equal parts of its range.

    Args:
        count: how many.
        seed: the same seed draws the same points.
        **ranges: by parameter (lowest, highest), a list to choose from, or None for all that the parameter admits.

    Raises:
        ParameterError: there are no parameters, or no points.

    >>> design = latin_hypercube(4, length=(0.0, 4.0))
    >>> sorted(int(x) for x in design.values(lambda name: None)["length"])
    [0, 1, 2, 3]
    """

    def draw(count: int, columns: int) -> NDArray[np.float64]:
        sampler: Any = import_module("scipy.stats.qmc").LatinHypercube
        # What draws the numbers has changed its name in SciPy.
        name = "rng" if "rng" in signature(sampler).parameters else "seed"
        return np.asarray(sampler(columns, **{name: np.random.default_rng(seed)}).random(count))

    return Design(_count(count, ranges, "latin_hypercube"), ranges, draw)


def _count(count: int, ranges: Mapping[str, Any], what: str) -> int:
    if not isinstance(count, int | np.integer) or isinstance(count, bool) or count < 1:  # pyright: ignore
        raise ParameterError(f"{what}: expected a number of points, got {count!r}")
    if not ranges:
        raise hint(ParameterError(f"{what}: no parameters"), f"{what}(64, length=(0.5, 2.0), angle=(10, 45))")
    return int(count)


def _scaled(name: str, column: Any, shares: NDArray[np.float64], ranges: Callable[[str], Any]) -> list[Any]:
    """Numbers from 0 to 1 as values of a parameter."""
    options: Any = column
    if isinstance(options, LIST):
        if not options:
            raise ParameterError(f"{name}: an empty list to choose from")
        return [options[int(share * len(options))] for share in shares]
    try:
        lowest, highest = column
        low, high = float(lowest), float(highest)
        if not (np.isfinite(low) and np.isfinite(high) and low <= high):
            raise ValueError
    except (TypeError, ValueError):
        error = ParameterError(f"{name}: expected (lowest, highest) to draw from, got {column!r}")
        raise hint(error, "a list of values to choose from, [a, b, c], or None if the parameter has bounds") from None
    admitted = ranges(name)
    if isinstance(admitted, TUPLE) and type(admitted[0]) is int:
        return [min(int(low) + int(share * (int(high) - int(low) + 1)), int(high)) for share in shares]
    return [float(low + share * (high - low)) for share in shares]
