"""Grids: the points of a sweep. Every dimension moves one parameter, or several side by side; time is one of them."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from reactive4d.engine import Cell
from reactive4d.errors import ParameterError, TimeError, hint
from reactive4d.signals.kernels import MAPPING, SEQUENCE
from reactive4d.sweeping.designs import Design
from reactive4d.sweeping.filters import Where, where_of
from reactive4d.sweeping.levers import TIME, Lever, lookup

__all__ = ["Column", "Dimension", "Grid", "grid_of"]


TUPLE: Any = tuple  # for `isinstance`: by the class itself a checker would find tuples of unknown items

# Values along a dimension; those of time are an array.
Column: TypeAlias = Sequence[Any] | NDArray[np.float64]


@dataclass(frozen=True)
class Dimension:
    """One dimension: what it moves, by parameter, as many values of each.

    Attributes:
        name: the parameter's, or the name that a design was given.
        columns: the admitted values along the dimension, by parameter; those of `time` are seconds.
    """

    name: str
    columns: Mapping[str, Column]

    @property
    def size(self) -> int:
        """How many points there are along it."""
        return len(next(iter(self.columns.values())))

    @property
    def is_design(self) -> bool:
        """Whether it has a name of its own."""
        return list(self.columns) != [self.name]

    @property
    def is_time(self) -> bool:
        """Whether it moves time and nothing else."""
        return list(self.columns) == [TIME]


@dataclass(frozen=True)
class Grid:
    """The points of a sweep: all combinations of what the dimensions have.

    Attributes:
        dimensions: in the order in which they were given.
        fixed: values of what stands still.
        time: seconds, where time stands still.
        where: which points are visited; None for all.
        levers: of what the dimensions move and what is fixed, without time.
    """

    dimensions: tuple[Dimension, ...]
    fixed: Mapping[str, Any]
    time: float
    where: Where | None
    levers: Mapping[str, Lever] = field(default_factory=dict[str, Lever])

    @property
    def shape(self) -> tuple[int, ...]:
        """How many points there are along each dimension."""
        return tuple([dimension.size for dimension in self.dimensions])

    @property
    def size(self) -> int:
        """How many points there are, those included that `where` leaves out."""
        return math.prod(self.shape)

    def at(self, index: Sequence[int]) -> dict[str, Any]:
        """The values at a point by parameter, time included, for people to read."""
        values: dict[str, Any] = {}
        for dimension, i in zip(self.dimensions, index, strict=True):
            for name, column in dimension.columns.items():
                values[name] = self.levers[name].shown(column[i]) if name in self.levers else float(column[i])
        return values

    def point(self, index: Sequence[int]) -> tuple[float, dict[str, Any]]:
        """The time and the parameters at a point, as signals take them."""
        t, given = self.time, dict(self.fixed)
        for dimension, i in zip(self.dimensions, index, strict=True):
            for name, column in dimension.columns.items():
                if name == TIME:
                    t = float(column[i])
                else:
                    given[name] = column[i]
        return t, given

    def labelled(self) -> "Grid":
        """The same points without the levers: choices that are no plain values by their names, as they can travel."""
        dimensions = [
            Dimension(d.name, {name: self._shown(name, column) for name, column in d.columns.items()})
            for d in self.dimensions
        ]
        fixed = {name: self._shown(name, [value])[0] for name, value in self.fixed.items()}
        return Grid(tuple(dimensions), fixed, self.time, self.where)

    def _shown(self, name: str, column: Column) -> Column:
        labels = self.levers[name].labels if name in self.levers else None
        return column if labels is None else [self.levers[name].shown(value) for value in column]

    def with_levers(self, levers: Mapping[str, Lever]) -> "Grid":
        """The same points, with choices in the places of their names."""
        dimensions = [
            Dimension(d.name, {name: _chosen(levers.get(name), column) for name, column in d.columns.items()})
            for d in self.dimensions
        ]
        fixed = {name: _chosen(levers.get(name), [value])[0] for name, value in self.fixed.items()}
        return Grid(tuple(dimensions), fixed, self.time, self.where, levers)

    def mask(self, ranges: Sequence[tuple[int, int]]) -> NDArray[np.bool_] | None:
        """Which points of a part of the grid are visited; None for all.

        Args:
            ranges: from where to where, along each dimension.
        """
        where = self.where
        if where is None:
            return None
        asked = [any(name in where.names for name in dimension.columns) for dimension in self.dimensions]
        shape = [hi - lo if is_asked else 1 for (lo, hi), is_asked in zip(ranges, asked, strict=True)]
        mask = np.empty(shape, np.bool_)
        values: dict[str, Any] = {**self.fixed, TIME: self.time}
        for index in np.ndindex(*shape):
            for dimension, i, (lo, _), is_asked in zip(self.dimensions, index, ranges, asked, strict=True):
                if is_asked:
                    values.update((name, column[lo + i]) for name, column in dimension.columns.items())
            mask[index] = where(values)
        return np.broadcast_to(mask, [hi - lo for lo, hi in ranges])


def grid_of(
    over: Mapping[str, Any], where: Callable[..., Any] | None, *, levers: Mapping[str, Lever], is_closed: bool
) -> Grid:
    """The grid that `over` describes.

    Args:
        over: values by parameter or "time": several of them make a dimension, one stands still; a design makes a
            dimension of the name that it stands under.
        where: whether to visit a point, from the values of the parameters that its arguments are named like.
        levers: the parameters of the model.
        is_closed: whether it has no others.

    Raises:
        UnknownNameError: there is no such parameter.
        ParameterError: a value that a parameter does not take, no values, or a parameter in two places.
        TimeError: a time that is none.
    """
    if not isinstance(over, Mapping) or not over:  # pyright: ignore[reportUnnecessaryIsInstance]
        error = ParameterError(f"over: expected values by parameter, got {over!r}")
        raise hint(error, 'over={"length": [0.5, 1.0, 2.0], "time": np.linspace(0, 10, 501)}')
    used: dict[str, Lever] = {}
    dimensions: list[Dimension] = []
    fixed: dict[str, Any] = {}
    time, is_still = 0.0, False

    def found(name: str) -> Lever:
        return used.setdefault(name, lookup(name, levers, is_closed=is_closed))

    for name, given in over.items():
        if isinstance(given, Design):
            drawn = given.values(lambda parameter: None if parameter == TIME else found(parameter).range)
            columns: dict[str, Column] = {one: _column(one, values, found) for one, values in drawn.items()}
        elif name == TIME:
            listed, is_one = _times(given)
            if is_one:
                time, is_still = float(listed[0]), True
                continue
            columns = {TIME: listed}
        else:
            lever = found(name)
            is_one, listed = _listed(lever, given)
            if is_one:
                fixed[name] = lever.admit(listed)
                continue
            columns = {name: _column(name, listed, found)}
        if not len(next(iter(columns.values()))):
            raise hint(ParameterError(f"{name}: no values"), "give at least one; leave it out where it stands still")
        dimensions.append(Dimension(name, columns))
    known = {*fixed, TIME, *[name for dimension in dimensions for name in dimension.columns]}
    _refuse_clashes(dimensions, [*fixed, *([TIME] if is_still else [])])
    return Grid(tuple(dimensions), fixed, time, where_of(where, known), used)


def _chosen(lever: Lever | None, column: Column) -> Column:
    return column if lever is None or lever.labels is None else [lever.admit(value) for value in column]


def _column(name: str, values: Sequence[Any], found: Callable[[str], Lever]) -> Column:
    if name == TIME:
        return _times(values)[0]
    lever = found(name)
    column: list[Any] = []
    for i, value in enumerate(values):
        try:
            column.append(lever.admit(value))
        except ParameterError as error:
            if len(values) > 1:
                error.add_note(f"it is the {i + 1}. of the {len(values)} values of {name}")
            raise
    return column


def _times(given: Any) -> tuple[NDArray[np.float64], bool]:
    """(N,) seconds, and whether it was a single one."""
    try:
        times = np.array(given, dtype=np.float64)
    except (TypeError, ValueError):
        raise TimeError(f"time: expected numbers of seconds, got {given!r}") from None
    if times.ndim > 1:
        raise TimeError(f"time: expected (N,) seconds, got an array of shape {times.shape}")
    if np.isnan(times).any():
        raise TimeError("time: nan is not a time")
    ts = np.atleast_1d(np.minimum(times, np.finfo(np.float64).max)) + 0.0
    return ts, times.ndim == 0


def _listed(lever: Lever, given: Any) -> tuple[bool, Any]:
    """Whether one value was given, and it; else the values."""
    has_array = hasattr(given, "__array__") and not isinstance(given, Cell)
    plain: Any = np.asarray(given).tolist() if has_array else given
    if isinstance(plain, MAPPING | Cell | str | bytes) or not hasattr(plain, "__iter__"):
        return True, plain
    values: list[Any] = list(plain)
    parts: Any = lever.default
    is_value = isinstance(plain, TUPLE) and isinstance(parts, TUPLE) and len(plain) == len(parts)
    if is_value and not any(isinstance(value, SEQUENCE) for value in values):
        return True, plain
    return False, values


def _refuse_clashes(dimensions: Sequence[Dimension], fixed: Iterable[str]) -> None:
    """Raise if two places move one parameter, or a dimension is called like a parameter of another one."""
    seen: dict[str, str] = dict.fromkeys(fixed, "a single value")
    for dimension in dimensions:
        for name in dimension.columns:
            if name in seen:
                raise ParameterError(f"{name} is moved twice, by {seen[name]} and by {dimension.name!r}")
            seen[name] = repr(dimension.name)
    for dimension in dimensions:
        if dimension.is_design and (dimension.name in seen or not dimension.name.isidentifier()):
            error = ParameterError(f"{dimension.name!r} is no name for the dimension of a design")
            raise hint(error, "one that is no parameter's: over={'sample': latin_hypercube(…)}")
