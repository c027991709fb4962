"""Stores: where the answers of a sweep are gathered, in memory."""

import os
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final, Protocol

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError, hint
from reactive4d.sweeping.grids import Grid
from reactive4d.sweeping.jobs import Part
from reactive4d.sweeping.plans import Ranges
from reactive4d.sweeping.values import MISSING, Encoded, Kind, empty, widened

__all__ = ["DONE", "FAILED", "LEFT_OUT", "OPEN", "Errors", "Folder", "MemoryStore", "Store", "region", "said", "series"]

# What a point is.
OPEN: Final = 0
DONE: Final = 1
LEFT_OUT: Final = 2
FAILED: Final = 3


class Store(Protocol):
    """Where answers are gathered."""

    kinds: dict[str, Kind]

    def gaps(self) -> list[tuple[int, int]]:
        """The runs of places that are still to be visited."""
        ...

    def put(self, part: Part) -> int:
        """Add a part; how many of its points failed."""
        ...


class Folder:
    """Where meshes and pictures are written."""

    def __init__(self, path: str | Path | None) -> None:
        self.path = None if path is None else Path(path)

    def put(self, name: str, encoded: Encoded) -> Encoded:
        """Write the files of some answers; the same answers with paths in the places of names.

        Raises:
            ShapeError: nobody said where files go.
        """
        if encoded.kind is None or not encoded.kind.is_filed:
            return encoded
        if self.path is None:
            error = ShapeError(f"{name}: the answers are files ({encoded.kind}), and nobody said where these go")
            raise hint(error, 'sweep(…, files="folder"), or checkpoint="sweep.zarr", which has a folder beside it')
        self.path.mkdir(parents=True, exist_ok=True)
        for file, content in encoded.files.items():
            if not (self.path / file).exists():
                write_whole(self.path / file, content)
        named = np.array([str(self.path / file) if file else "" for file in encoded.data.flat], object)
        return Encoded(encoded.kind, named.reshape(encoded.data.shape), encoded.failed)


def write_whole(path: Path, content: bytes) -> None:
    """Write a file that is there whole, or not at all."""
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        Path(temporary).replace(path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


class Errors:
    """What went wrong, by point: a number for each text, 0 where nothing did."""

    def __init__(self, shape: Sequence[int]) -> None:
        self.shape = tuple(shape)
        self.codes: NDArray[np.int32] | None = None
        self.texts: list[str] = []
        self._known: dict[str, int] = {}

    def code(self, text: str) -> int:
        """The number of a text."""
        found = self._known.get(text)
        if found is None:
            self.texts.append(text)
            found = self._known[text] = len(self.texts)
        return found

    def put(self, where: tuple[slice, ...], codes: NDArray[np.int32]) -> None:
        """Set the numbers of a part."""
        if self.codes is None:
            self.codes = np.zeros(self.shape, np.int32)
        self.codes[where] = codes

    def text(self, codes: NDArray[np.int32]) -> NDArray[Any]:
        """The texts of some numbers, "" where nothing went wrong."""
        return np.array(["", *self.texts], object)[codes]


def said(error: Exception) -> str:
    """An error in one line."""
    try:
        message = str(error)
    except Exception:  # noqa: BLE001  the user's own `__str__`
        message = ""
    return f"{type(error).__name__}: {message}" if message else type(error).__name__


def region(ranges: Ranges, origin: Sequence[int] | None = None) -> tuple[slice, ...]:
    """Ranges as an index; counted from some other place, if that is given."""
    base = [0] * len(ranges) if origin is None else origin
    return tuple([slice(lo - first, hi - first) for (lo, hi), first in zip(ranges, base, strict=True)])


def failures(part: Part, errors: Errors) -> NDArray[np.int32] | None:
    """What went wrong in a part, by point; None if nothing did."""
    if not any(encoded.failed for encoded in part.answers.values()):
        return None
    shape = [hi - lo for lo, hi in part.ranges]
    texts = np.full(shape, "", object)
    for name, encoded in part.answers.items():
        if encoded.failed:
            own = np.full(encoded.data.shape[: len(shape)], "", object)
            for i, error in encoded.failed.items():
                own.reshape(-1)[i] = f"{name}: {said(error)}" if name else said(error)
            wide = np.broadcast_to(own, shape)
            both = (texts != "") & (wide != "")
            texts = np.where(both, texts + "\n" + wide, np.where(wide != "", wide, texts))
    if part.mask is not None:
        texts = np.where(part.mask, texts, "")
    codes = np.zeros(shape, np.int32)
    codes.reshape(-1)[:] = [errors.code(text) if text else 0 for text in texts.reshape(-1).tolist()]
    return codes


def series(data: NDArray[Any] | None, old: Kind | None, new: Kind, shape: Sequence[int]) -> NDArray[Any]:
    """The array in which a measure is gathered, of another kind if need be; what is missing stays missing."""
    if data is None or old is None:
        return empty(new, shape)
    if data.dtype == new.dtype:
        return data
    wide = empty(new, shape)
    known = ~np.isnan(data) if old.sort in ("float", "complex") else data != MISSING[old.sort]
    wide[known] = data[known]
    return wide


class MemoryStore:
    """The answers in arrays of NumPy's.

    Args:
        grid: the points.
        size: how many there are.
        folder: where files go.
    """

    def __init__(self, grid: Grid, folder: Folder) -> None:
        self.grid = grid
        self.folder = folder
        self.kinds: dict[str, Kind] = {}
        self.data: dict[str, NDArray[Any]] = {}
        self.errors = Errors(grid.shape)
        self.status = np.zeros(grid.shape, np.int8)

    def gaps(self) -> list[tuple[int, int]]:
        """All places."""
        return [(0, self.grid.size)]

    def put(self, part: Part) -> int:
        """Add a part; how many of its points failed."""
        where = region(part.ranges)
        for name, given in list(part.answers.items()):
            encoded, kind = agreed(name, self.folder.put(name, given), self.kinds.get(name))
            part.answers[name] = encoded
            if encoded.kind is not None and kind is not None:
                self.data[name] = series(self.data.get(name), self.kinds.get(name), kind, self.grid.shape)
                self.kinds[name] = kind
                copied(encoded, kind, self.data[name][(*where, ...)], part.mask)
        self.status[where] = DONE if part.mask is None else np.where(part.mask, DONE, LEFT_OUT)
        codes = failures(part, self.errors)
        if codes is None:
            return 0
        self.errors.put(where, codes)
        self.status[where] = np.where(codes > 0, FAILED, self.status[where])
        return int((codes > 0).sum())


def agreed(name: str, encoded: Encoded, kind: Kind | None, *, is_firm: bool = False) -> tuple[Encoded, Kind | None]:
    """Answers, and the kind that holds them and those before; where there is none, they are errors.

    Args:
        name: of the measure.
        encoded: the answers.
        kind: of those before, if there are any.
        is_firm: whether what is stored cannot become another kind.
    """
    if encoded.kind is None or kind is None:
        return encoded, encoded.kind or kind
    wide = widened(kind, encoded.kind)
    if wide is not None and not (is_firm and wide.dtype != kind.dtype):
        return encoded, wide
    error = ShapeError(f"{name}: expected a {kind}, as before, got a {encoded.kind}")
    hint(error, "a measure answers values of one kind and shape everywhere")
    count = int(np.prod(encoded.data.shape[: encoded.data.ndim - len(encoded.kind.shape)]))
    shape = encoded.data.shape[: encoded.data.ndim - len(encoded.kind.shape)]
    return Encoded(None, np.zeros(shape), dict.fromkeys(range(count), error)), kind


def copied(encoded: Encoded, kind: Kind, target: NDArray[Any], mask: NDArray[np.bool_] | None) -> None:
    """Write the answers of a part into an array, where they are visited."""
    assert encoded.kind is not None
    data = series(encoded.data, encoded.kind, kind, encoded.data.shape[: encoded.data.ndim - len(kind.shape)])
    if mask is None:
        target[...] = data
    else:
        wide = np.broadcast_to(data, target.shape)
        target[mask] = wide[mask]
