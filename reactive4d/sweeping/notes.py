"""Notes: what the store of a sweep says of itself, so that another call knows whether it may go on with it."""

import hashlib
import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np

from reactive4d.errors import Reactive4dError, hint
from reactive4d.sweeping.grids import Grid

__all__ = ["FORMAT", "NOTES", "compare", "digest", "group_at", "noted"]

FORMAT: Final = "reactive4d.sweep/1"
NOTES: Final = "reactive4d_sweep"  # the attribute of the store


def noted(path: Path) -> dict[str, Any] | None:
    """What an earlier sweep noted in a store; None where there is none.

    Raises:
        Reactive4dError: there is something else.
    """
    if not path.exists() or (path.is_dir() and not any(path.iterdir())):
        return None
    try:
        group = group_at(path, "r")
        found: Any = dict(group.attrs).get(NOTES)
    except Exception as error:
        raise hint(Reactive4dError(f"{path} is no Zarr store: {error}"), "give the checkpoint another name") from error
    if not dict(group.attrs) and not list(group.members()):
        return None  # it was killed at once
    if found is None or found.get("format") != FORMAT:
        raise hint(Reactive4dError(f"{path} holds no sweep of this kind"), "give the checkpoint another name")
    if "status" not in group:
        shutil.rmtree(path)  # it was killed before it had begun
        return None
    return dict(found)


def group_at(path: Path, mode: str) -> Any:
    """The Zarr group of a folder, opened as `mode` says; it is made if it may be written and is not there."""
    import zarr

    open_group: Any = zarr.open_group  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]
    if mode != "r":
        path.parent.mkdir(parents=True, exist_ok=True)
        return open_group(str(path), mode=mode, zarr_format=3)
    return open_group(str(path), mode=mode)


def compare(found: Mapping[str, Any], told: Mapping[str, Any], path: Path) -> None:
    """Raise if a store holds another sweep.

    Args:
        found: what the store says.
        told: what it would say of this sweep.
        path: of the store.

    Raises:
        Reactive4dError: they differ.
    """
    for name in ("dimensions", "shape", "measures", "key"):
        if found[name] != told[name]:
            shown = "with other values" if name == "key" else f"with the {name} {found[name]!r}, not {told[name]!r}"
            error = Reactive4dError(f"{path} holds another sweep, {shown}")
            raise hint(error, "give the checkpoint another name, or delete it to begin anew")


def digest(grid: Grid, measures: Sequence[str]) -> str:
    """What tells a sweep from others, but for the model."""
    found = hashlib.sha256()
    for dimension in grid.labelled().dimensions:
        for name, column in dimension.columns.items():
            values: list[Any] = column.tolist() if isinstance(column, np.ndarray) else list(column)
            found.update(f"{dimension.name}|{name}|{values!r}\n".encode())
    found.update(f"{dict(grid.labelled().fixed)!r}|{grid.time!r}|{measures!r}".encode())
    return found.hexdigest()[:32]
