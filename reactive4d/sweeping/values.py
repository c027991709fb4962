"""Values: what measures answer, as arrays that can be stored, and as files where they are too large for that.

Numbers, vectors, matrices and colours are arrays; strings are strings; meshes and pictures are written into files, one
for each content, and stand as their names. Where there is no answer stands nan; the lowest whole number, where answers
are whole; "", where they are strings.
"""

import hashlib
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Final, Literal, Self, TypeAlias

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import ARRAY, SCALAR
from reactive4d.engine import Cell
from reactive4d.errors import ShapeError, hint
from reactive4d.geometry.meshes import Mesh
from reactive4d.signals.kernels import SEQUENCE
from reactive4d.signals.rotations import Rotation
from reactive4d.sweeping.asking import Failed

__all__ = ["MISSING", "Encoded", "Kind", "Sort", "empty", "encode", "widened"]

Sort: TypeAlias = Literal["bool", "int", "float", "complex", "text", "mesh", "picture"]

# Where there is no answer.
MISSING: Final[dict[str, Any]] = {
    "bool": -1,
    "int": np.iinfo(np.int64).min,
    "float": np.nan,
    "complex": complex(np.nan, np.nan),
    "text": "",
    "mesh": "",
    "picture": "",
}
_NUMBERS: Final[tuple[Sort, ...]] = ("bool", "int", "float", "complex")  # each of which holds those before
_LARGE: Final = 1 << 20  # bytes of a mesh or a picture, about
_PNG: Final = b"\x89PNG\r\n\x1a\n"


@dataclass(frozen=True)
class Kind:
    """What a measure answers: numbers of a shape, strings, or what goes into files."""

    sort: Sort
    shape: tuple[int, ...] = ()
    precision: str = "f8"

    @property
    def dtype(self) -> np.dtype[Any]:
        """How it is stored."""
        named = {"bool": "i1", "int": "i8", "float": self.precision, "complex": "c16"}
        return np.dtype(named.get(self.sort, object))

    @property
    def is_filed(self) -> bool:
        """Whether it goes into files."""
        return self.sort in ("mesh", "picture")

    @property
    def nbytes(self) -> int:
        """About how many bytes one answer takes."""
        return _LARGE if self.is_filed else 64 if self.sort == "text" else self.dtype.itemsize * math.prod(self.shape)

    def told(self) -> dict[str, Any]:
        """The kind as plain data."""
        return {"sort": self.sort, "shape": list(self.shape), "precision": self.precision}

    @classmethod
    def of(cls, told: Mapping[str, Any]) -> Self:
        """The kind of plain data."""
        return cls(told["sort"], tuple(told["shape"]), told["precision"])

    def __str__(self) -> str:
        told = {"bool": "truth value", "int": "whole number", "float": "number", "complex": "complex number"}
        told |= {"text": "string", "mesh": "mesh", "picture": "picture"}
        return f"array of {told[self.sort]}s of shape {self.shape}" if self.shape else told[self.sort]


@dataclass(frozen=True)
class Encoded:
    """Answers along some dimensions, ready to be stored.

    Attributes:
        kind: of all of them; None if there is no answer among them.
        data: (N, *kind.shape) numbers or strings.
        failed: by place along the dimensions the error that stands there.
        files: contents by name.
    """

    kind: Kind | None
    data: NDArray[Any]
    failed: dict[int, Exception] = field(default_factory=dict[int, Exception])
    files: dict[str, bytes] = field(default_factory=dict[str, bytes])


def empty(kind: Kind, shape: Sequence[int]) -> NDArray[Any]:
    """An array in which nothing is answered yet."""
    return np.full((*shape, *kind.shape), MISSING[kind.sort], kind.dtype)


def widened(old: Kind, new: Kind) -> Kind | None:
    """The kind that holds both; None if there is none."""
    if old.shape != new.shape:
        return None
    if old.sort in _NUMBERS and new.sort in _NUMBERS:
        sort = max(old.sort, new.sort, key=_NUMBERS.index)
        return replace(old, sort=sort, precision=old.precision if old.precision == new.precision else "f8")
    return old if old.sort == new.sort else None


def encode(rows: Any, kind: Kind | None = None, *, name: str = "measure") -> Encoded:
    """Answers as they are stored.

    Args:
        rows: (N, …) answers, or a sequence of N; None where there is none, `Failed` where there is an error.
        kind: what they are expected to be, if that is known; an answer of another kind is an error.
        name: of the measure, for errors.
    """
    if isinstance(rows, ARRAY) and rows.dtype.kind in "biufc":
        found = _of_array(rows, name)
        if found.kind is None or kind is None or widened(kind, found.kind) is not None:
            return found
    answers: list[Any] = []
    failed: dict[int, Exception] = {}
    files: dict[str, bytes] = {}
    known: dict[int, tuple[Kind, Any]] = {}
    for i, row in enumerate(rows):
        stored: Any = None
        if type(row) is Failed:
            failed[i] = row.error
        elif row is not None:
            try:
                own, stored = known.get(id(row)) or known.setdefault(id(row), _one(row, files, name))
            except TypeError as error:
                failed[i] = error
            else:
                wider = own if kind is None else widened(kind, own)
                if wider is None:
                    failed[i], stored = (
                        hint(
                            ShapeError(f"{name}: expected a {kind}, as before, got a {own}"),
                            "a measure answers values of one kind and shape everywhere",
                        ),
                        None,
                    )
                else:
                    kind = wider
        answers.append(stored)
    if kind is None:
        return Encoded(None, np.zeros(len(answers)), failed)
    data = empty(kind, (len(answers),))
    for i, stored in enumerate(answers):
        if stored is not None:
            data[i] = stored
    return Encoded(kind, data, failed, files)


def _of_array(rows: Any, name: str) -> Encoded:
    kind = rows.dtype.kind
    if kind == "b":
        return Encoded(Kind("bool", rows.shape[1:]), rows.astype("i1"))
    if kind in "iu" and (rows.dtype != np.uint64 or not (rows > np.iinfo(np.int64).max).any()):
        return Encoded(Kind("int", rows.shape[1:]), rows.astype("i8"))
    if kind == "c":
        return Encoded(Kind("complex", rows.shape[1:]), rows.astype("c16"))
    precision = "f4" if rows.dtype == np.float32 else "f8"
    return Encoded(Kind("float", rows.shape[1:], precision), rows.astype(precision))


def _one(given: Any, files: dict[str, bytes], name: str) -> tuple[Kind, Any]:
    """One answer as it is stored."""
    answer: Any = given
    if isinstance(answer, str):
        return Kind("text"), answer
    if isinstance(answer, Rotation):
        answer = answer.as_quaternion()
    if isinstance(answer, Mesh):
        from reactive4d.geometry.files import dumps

        return Kind("mesh"), _filed(dumps(answer, "ply"), "ply", files, name)
    if isinstance(answer, bytes) and answer.startswith(_PNG):
        return Kind("picture"), _filed(answer, "png", files, name)
    if isinstance(answer, SEQUENCE) and answer and all(isinstance(x, int | float | SCALAR) for x in answer):
        answer = np.array(answer)
    if isinstance(answer, bool | int | float | complex | ARRAY | SCALAR):
        try:
            array = np.asarray(answer)
            if array.dtype.kind in "biufc":
                encoded = _of_array(array[np.newaxis], name)
                assert encoded.kind is not None
                return encoded.kind, encoded.data[0]
        except OverflowError:
            pass
    told = f"the signal {answer.name}" if isinstance(answer, Cell) else f"{answer!r}, a {type(answer).__name__}"
    error = TypeError(f"{name}: {told} cannot be stored")
    raise hint(error, "numbers, arrays of numbers, strings, meshes and pictures can: signal.map(…) makes one of it")


def _filed(content: bytes, ending: str, files: dict[str, bytes], name: str) -> str:
    """The name of the file for a content; equal contents share one."""
    file = f"{name}-{hashlib.sha256(content).hexdigest()[:16]}.{ending}"
    files[file] = content
    return file
