"""Contexts: the points that are asked about together, all combinations of what their dimensions have."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.engine import Axis
from reactive4d.signals.kernels import stacked

__all__ = ["TIME", "Context", "Reads", "Varying"]

Array = NDArray[np.float64]

_unravelled: Any = np.unravel_index

# What was read to answer: parameters, and None where the answer holds for a while only.
Reads = frozenset[Axis | None]
TIME: Reads = frozenset([None])


@dataclass(frozen=True)
class Varying:
    """What one parameter is along a dimension: its values, and something that tells these from any others."""

    dimension: int
    values: Any
    mark: Any


@dataclass(frozen=True)
class Context:
    """Points that are asked about together; the dimension of the outermost loop comes first.

    Attributes:
        shape: how many points there are along each dimension.
        moved: the parameters that vary along them.
        given: values of other parameters; those that are not named either have their defaults.
        times: (N,) seconds along the dimension `clock`; a single one if that is None.
        clock: the dimension along which time varies.
        mask: which points are asked about; None for all.
    """

    shape: tuple[int, ...]
    moved: Mapping[str, Varying]
    given: Mapping[str, Any]
    times: Array
    clock: int | None = None
    mask: NDArray[np.bool_] | None = None

    @cached_property
    def is_timed(self) -> bool:
        """Whether there are several times, along a dimension of their own."""
        clock = self.clock
        if clock is None or self.shape[clock] == 1:
            return False
        return all(varying.dimension != clock for varying in self.moved.values())

    @cached_property
    def is_always(self) -> bool:
        """Whether the same points are asked about at all times."""
        mask, clock = self.mask, self.clock
        return mask is None or clock is None or bool((mask == mask.take([0], clock)).all())

    @cached_property
    def span(self) -> tuple[float, float]:
        """The first and the last of the times."""
        return float(self.times.min()), float(self.times.max())

    @cached_property
    def digest(self) -> bytes:
        """What tells the times from any others."""
        return self.times.tobytes()

    def count(self, dimensions: Sequence[int]) -> int:
        """How many combinations there are along some of the dimensions."""
        count = 1
        for dimension in dimensions:
            count *= self.shape[dimension]
        return count

    def of(self, reads: Reads) -> tuple[int, ...]:
        """The dimensions along which answers differ that read these parameters; without time's."""
        found = {self.moved[axis.name].dimension for axis in reads if axis is not None and axis.name in self.moved}
        return tuple(sorted([d for d in found if self.shape[d] > 1]))

    def along(self, axis: Axis) -> tuple[Any, tuple[int, ...]]:
        """The answers of a parameter along its dimension; or one answer, where it stands still."""
        varying = self.moved.get(axis.name)
        if varying is None:
            value = axis.admit(self.given[axis.name]) if axis.name in self.given else axis.default
            return axis.present(value), ()
        values = [axis.present(axis.admit(value)) for value in varying.values]
        return (values[0], ()) if len(values) == 1 else (stacked(values), (varying.dimension,))

    def mark(self, reads: Reads) -> frozenset[Any]:
        """What tells these points from others, for an answer that read no more than this."""
        marks: list[Any] = []
        for axis in reads:
            if axis is None:
                marks.append((None, self.clock, self.digest))
            elif axis.name in self.moved:
                marks.append((axis, self.moved[axis.name].mark))
            else:
                marks.append((axis, self.given.get(axis.name)))
        return frozenset(marks)

    def at(self, index: Sequence[int]) -> tuple[float, dict[str, Any]]:
        """The time and the parameters at an index."""
        given = dict(self.given)
        for name, varying in self.moved.items():
            given[name] = varying.values[index[varying.dimension]]
        return float(self.times[0 if self.clock is None else index[self.clock]]), given

    def alone(self, index: Sequence[int], times: Array) -> "Context":
        """The parameters at an index, at other times: there is one dimension, which is time's."""
        return Context((len(times),), {}, self.at(index)[1], times, 0)

    def indices(self, dimensions: Sequence[int]) -> NDArray[np.intp]:
        """For every combination along some dimensions, the last of them innermost, the first point to ask at.

        Returns:
            (M, D) indices, -1 where no point is asked about.
        """
        sizes = [self.shape[d] for d in dimensions]
        found = np.zeros((self.count(dimensions), len(self.shape)), np.intp)
        inner: tuple[Any, ...] = _unravelled(np.arange(len(found)), sizes) if sizes else ()
        for d, i in zip(dimensions, inner, strict=True):
            found[:, d] = i
        if self.mask is not None:
            others = [d for d in range(len(self.shape)) if d not in dimensions]
            rows = np.transpose(self.mask, [*dimensions, *others]).reshape(len(found), -1)
            first: Any = rows.argmax(axis=1)
            sizes = [self.shape[d] for d in others]
            outer: tuple[Any, ...] = _unravelled(first, sizes) if others else ()
            for d, i in zip(others, outer, strict=True):
                found[:, d] = i
            found[~rows.any(axis=1)] = -1
        return found
