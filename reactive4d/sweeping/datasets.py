"""Datasets: what a sweep found, as an xarray.Dataset with named dimensions and coordinates that say what they are."""

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from reactive4d.sweeping.grids import Column, Grid
from reactive4d.sweeping.levers import TIME
from reactive4d.sweeping.stores import FAILED, LEFT_OUT, Errors
from reactive4d.sweeping.values import MISSING, Kind

__all__ = ["Extra", "coordinates", "dataset", "extra_dimensions", "opened", "summary"]

MOST_TOLD: Final = 5  # messages that a summary quotes

# Dimensions, values, attributes.
Coordinate = tuple[tuple[str, ...], NDArray[Any], dict[str, Any]]


@dataclass(frozen=True)
class Extra:
    """The dimensions of one answer, and what their places are called, where that is known."""

    names: tuple[str, ...]
    labels: Mapping[str, Sequence[str]]


def extra_dimensions(name: str, kind: Kind, taken: Sequence[str]) -> Extra:
    """What the dimensions of one answer of a measure are called.

    Vectors have an `axis` with x, y and z, matrices have a `row` and a `column`; a measure called something with
    "color" has a `channel` with r, g, b and a.
    """
    shape = kind.shape
    names: tuple[str, ...] = tuple([f"{name}_{i}" for i in range(len(shape))])
    labels: dict[str, Sequence[str]] = {}
    if shape in ((3,), (4,)) and "color" in name and "channel" not in taken:
        names, labels["channel"] = ("channel",), "rgba"[: math.prod(shape)]
    elif shape in ((3,), (2, 3)) and "axis" not in taken:
        names, labels["axis"] = (*names[:-1], "axis"), "xyz"
    elif shape == (4, 4) and not {"row", "column"} & set(taken):
        names = ("row", "column")
    return Extra(names, labels)


def coordinates(grid: Grid) -> dict[str, Coordinate]:
    """The coordinates of a grid by name: values along the dimensions, and what stands still."""
    found: dict[str, Coordinate] = {}
    for dimension in grid.dimensions:
        if dimension.is_design:
            attrs = {"long_name": "number of the point"}
            found[dimension.name] = (dimension.name,), np.arange(dimension.size), attrs
        for name, column in dimension.columns.items():
            found.update(_listed(grid, name, (dimension.name,), column))
    for name, value in grid.fixed.items():
        found.update(_listed(grid, name, (), [value]))
    if not any(TIME in dimension.columns for dimension in grid.dimensions):
        found[TIME] = (), np.array(grid.time), _attrs(grid, TIME)
    return found


def _listed(grid: Grid, name: str, dimensions: tuple[str, ...], column: Column) -> dict[str, Coordinate]:
    attrs = _attrs(grid, name)
    shown = [grid.levers[name].shown(value) for value in column] if name in grid.levers else list(column)
    if shown and all(isinstance(value, tuple) for value in shown):
        # Several numbers each: a coordinate for each of them, beside the numbers of the places.
        rows = np.array(shown, dtype=np.float64)
        found: dict[str, Coordinate] = {}
        if dimensions:
            found[name] = dimensions, np.arange(len(rows)), {"long_name": f"number of the value of {name}"}
        for i in range(rows.shape[1]):
            found[f"{name}_{i}"] = dimensions, rows[:, i] if dimensions else rows[0, i], attrs
        return found
    if all(isinstance(value, bool | int | float | np.generic) for value in shown):
        values = np.array(shown)
    else:
        values = np.array([str(value) for value in shown], dtype=object)
    return {name: (dimensions, values if dimensions else values[0:1].reshape(()), attrs)}


def _attrs(grid: Grid, name: str) -> dict[str, Any]:
    if name == TIME:
        return {"long_name": "time", "units": "s"}
    lever = grid.levers[name]
    attrs = {"long_name": lever.doc or lever.name.replace("_", " ")}
    return {**attrs, "units": lever.unit} if lever.unit else attrs


def summary(grid: Grid, status: NDArray[np.int8], texts: NDArray[Any]) -> str:
    """What went wrong where, in a few sentences; "" if nothing did.

    Args:
        grid: the points.
        status: what each of them is.
        texts: what went wrong at each of them.
    """
    failed = status == FAILED
    total = int(failed.sum())
    if not total:
        return ""
    places = np.argwhere(failed)
    told: dict[str, list[Any]] = {}
    for place, text in zip(places, texts[failed].tolist(), strict=True):
        told.setdefault(text, []).append(place)
    visited = status.size - int((status == LEFT_OUT).sum())
    lines = [f"{total:,} of {visited:,} points failed"]
    for text, group in sorted(told.items(), key=lambda item: -len(item[1]))[:MOST_TOLD]:
        count = "1 point" if len(group) == 1 else f"{len(group):,} points"
        lines.append(f"{text.strip()} ({count}{_where(grid, np.array(group))})")
    if len(told) > MOST_TOLD:
        lines.append(f"and {len(told) - MOST_TOLD:,} other messages")
    return "; ".join(lines)


def _where(grid: Grid, places: NDArray[Any]) -> str:
    """Between which values some points lie."""
    first, last = grid.at(places.min(axis=0).tolist()), grid.at(places.max(axis=0).tolist())
    told = [
        f"{name}={_short(low)}"
        if _short(low) == _short(last[name])
        else f"{name}={_short(low)} to {_short(last[name])}"
        for name, low in first.items()
    ]
    return f": {', '.join(told)}" if told else ""


def _short(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float | np.floating) else str(value)


def dataset(
    grid: Grid,
    kinds: Mapping[str, Kind],
    data: Mapping[str, NDArray[Any]],
    *,
    status: NDArray[np.int8],
    errors: Errors,
    attrs: Mapping[str, Any],
    described: Mapping[str, Mapping[str, Any]],
) -> Any:
    """The dataset of what was gathered in memory.

    Args:
        grid: the points.
        kinds: what the measures answer.
        data: their answers.
        status: what each point is.
        errors: what went wrong.
        attrs: how the dataset was made.
        described: the attributes of each measure, by name; all measures are named here.
    """
    import xarray

    names = [dimension.name for dimension in grid.dimensions]
    coords: dict[str, Any] = dict(coordinates(grid))
    taken = [*coords, *described]
    variables: dict[str, Any] = {}
    for name, about in described.items():
        kind = kinds.get(name)
        if kind is None:
            variables[name] = names, np.full(grid.shape, np.nan), dict(about)
            continue
        extra = extra_dimensions(name, kind, taken)
        for dimension, labels in extra.labels.items():
            coords[dimension] = (dimension,), np.array(list(labels), object)
        variables[name] = [*names, *extra.names], finished(data[name], kind), dict(about)
    if errors.codes is not None:
        about = {"long_name": "what went wrong"}
        variables["error"] = names, errors.text(errors.codes), about
    del status
    return xarray.Dataset(variables, coords=coords, attrs=dict(attrs))


def finished(data: NDArray[Any], kind: Kind) -> NDArray[Any]:
    """Numbers as they were answered; where some are missing, as floats with nan."""
    if kind.sort not in ("int", "bool"):
        return data
    missing = data == MISSING[kind.sort]
    if missing.any():
        return np.where(missing, np.nan, data.astype(np.float64))
    return data.astype(np.bool_) if kind.sort == "bool" else data


def opened(path: Path, kinds: Mapping[str, Kind], *, partial: Collection[str]) -> Any:
    """The dataset of a Zarr store; its answers are read when they are wanted.

    Args:
        path: of the store.
        kinds: what the measures answer, in their order.
        partial: the measures of which answers are missing.
    """
    import xarray

    open_zarr: Any = xarray.open_zarr  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]
    stored: Any = open_zarr(str(path), consolidated=False, decode_times=False)
    found = stored[[*kinds, *(["error"] if "error" in stored else [])]]
    for name, variable in stored.coords.items():
        if variable.dtype.kind in "TU":
            found[name] = variable.dims, variable.values.astype(object), variable.attrs
    for name in found.data_vars:
        if found[name].dtype.kind in "TU":
            found[name] = found[name].astype(object)
    for name, kind in kinds.items():
        variable = found[name]
        if kind.sort in ("int", "bool"):
            if name in partial:
                found[name] = variable.astype(np.float64).where(variable != MISSING[kind.sort], np.nan)
            elif kind.sort == "bool":
                found[name] = variable.astype(np.bool_)
        found[name].attrs.update({key: x for key, x in variable.attrs.items() if key != "missing"})
    return found
