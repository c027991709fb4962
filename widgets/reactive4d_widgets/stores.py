"""Stores: the arrays of a page, each once, and how they are packed when all are known."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.references import reference
from reactive4d_widgets.chunks import encode, extent

__all__ = ["Store", "arrays_of_a_chunk", "measured", "ranges"]

Array = NDArray[Any]
EXACT = 16_384  # bytes of floats in one channel that are kept to the last bit
COARSEST = 4.0  # 65535ths of the longest side
FINEST = 1.0 / 150.0  # of the distance of two points
MOST_ARRAYS = 64  # in one chunk
MOST_BYTES = 8_000_000


class Store:
    """Arrays by their references, in the groups in which they are packed: one channel's floats, or all indices.

    >>> store = Store()
    >>> ref = store.keep(np.zeros((2, 3), np.float32), "ball#points")
    >>> store.keep(np.zeros((2, 3), np.float32), "cube#points") == ref, len(store.chunks())
    (True, 1)
    """

    def __init__(self) -> None:
        self.arrays: dict[str, Array] = {}
        self.groups: dict[str, list[str]] = {}

    def keep(self, array: Array, group: str) -> str:
        """Keep an array, and answer its reference."""
        array = array.astype(np.uint32 if array.dtype.kind in "iu" else np.float32, copy=False)
        ref = reference(array)
        if ref not in self.arrays:
            self.arrays[ref] = array
            self.groups.setdefault(group, []).append(ref)
        return ref

    def chunks(self, sizes: dict[str, int] | None = None) -> list[dict[str, Any]]:
        """All arrays, packed.

        Args:
            sizes: is told how many bytes each group takes.
        """
        made: list[dict[str, Any]] = []
        for group, refs in self.groups.items():
            packed = list(packed_group([(ref, self.arrays[ref]) for ref in refs]))
            made.extend(packed)
            if sizes is not None:
                sizes[group] = sizes.get(group, 0) + sum(measured(chunk) for chunk in packed)
        return made


def measured(chunk: dict[str, Any]) -> int:
    """About how many bytes a chunk takes as it travels."""
    return len(chunk["data"]) + 35 * len(chunk["refs"]) + 120


def packed_group(named: Sequence[tuple[str, Array]]) -> Iterable[dict[str, Any]]:
    """The chunks of some arrays: those of one shape and type together, in their order, a few at a time."""
    floats = [array for _, array in named if array.dtype.kind == "f"]
    is_coarse = sum(array.nbytes for array in floats) > EXACT
    kinds: dict[Any, list[tuple[str, Array]]] = {}
    for ref, array in named:
        kinds.setdefault((array.dtype.str, array.shape), []).append((ref, array))
    widths: dict[int, Any] = {}
    if is_coarse:
        for width in {array.shape[1] for array in floats}:
            widths[width] = ranges([array for array in floats if array.shape[1] == width])
    for alike in kinds.values():
        first = alike[0][1]
        several = arrays_of_a_chunk(first.nbytes)
        bounds = widths[first.shape[1]] if is_coarse and first.dtype.kind == "f" else None
        for i in range(0, len(alike), several):
            part = alike[i : i + several]
            yield encode([array for _, array in part], refs=[ref for ref, _ in part], bounds=bounds, smooth=True)


def arrays_of_a_chunk(size: int) -> int:
    """How many arrays of a size, bytes, are packed together.

    >>> arrays_of_a_chunk(100), arrays_of_a_chunk(5_000_000)
    (64, 1)
    """
    return max(1, min(MOST_ARRAYS, MOST_BYTES // max(size, 1)))


def ranges(arrays: Sequence[Array]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Between what values the columns of some arrays are packed: wider than they are, where fewer bits will do.

    All columns get steps of one size, so that a flat thing costs no bits for its thickness. Steps are a few 65535ths of
    the longest side, but so small beside the distance of two points that light falls smoothly on what they make.
    """
    low, high = extent(arrays)
    side = float((high - low).max(initial=0.0))
    rows = max(len(array) for array in arrays)
    step = side * min(COARSEST / 65535.0, FINEST / max(rows, 1) ** 0.5)
    return low, np.maximum(high, low + step * 65535.0)
