"""Vaults: the arrays that readers may ask for again, each once, and how one travels."""

import threading
from collections import OrderedDict
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.references import reference

__all__ = ["Vault", "plain_chunk"]

Array = NDArray[Any]
BUDGET = 512 * 2**20


class Vault:
    """Arrays by their references; those that nobody asked for lately go when there are too many.

    Args:
        budget: bytes.

    >>> vault = Vault()
    >>> ref = vault.keep(np.zeros((2, 3)))
    >>> [chunk["shape"] for chunk in vault.chunks([ref, "0" * 32])]
    [[2, 3]]
    """

    def __init__(self, budget: int = BUDGET) -> None:
        self.budget = budget
        self._arrays: OrderedDict[str, Array] = OrderedDict()
        self._bytes = 0
        self._lock = threading.Lock()

    def keep(self, array: Array) -> str:
        """Keep an array, as floats or indices of 32 bits, and answer its reference."""
        kept = array.astype(np.uint32 if array.dtype.kind in "iu" else np.float32, copy=False)
        kept = kept if kept.ndim == 2 else kept.reshape(len(kept), -1)
        ref = reference(kept)
        with self._lock:
            if ref in self._arrays:
                self._arrays.move_to_end(ref)
                return ref
            self._arrays[ref] = kept
            self._bytes += kept.nbytes
            while self._bytes > self.budget and len(self._arrays) > 1:
                _, gone = self._arrays.popitem(last=False)
                self._bytes -= gone.nbytes
        return ref

    def __contains__(self, ref: str) -> bool:
        return ref in self._arrays

    def __len__(self) -> int:
        return len(self._arrays)

    def chunks(self, refs: Iterable[str]) -> Iterator[dict[str, Any]]:
        """The arrays of these references, as far as they are here, one chunk each."""
        for ref in refs:
            with self._lock:
                array = self._arrays.get(ref)
                if array is not None:
                    self._arrays.move_to_end(ref)
            if array is not None:
                yield plain_chunk(ref, array)


def plain_chunk(ref: str, array: Array) -> dict[str, Any]:
    """An array as it travels from a live kernel: its bytes, neither shuffled nor deflated."""
    kept = np.ascontiguousarray(array, dtype="<f4" if array.dtype.kind == "f" else "<u4")
    name = "f32" if array.dtype.kind == "f" else "u32"
    return {"refs": [ref], "dtype": name, "shape": list(kept.shape), "encoding": "plain", "data": kept.tobytes()}
