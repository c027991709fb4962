"""Chunks: arrays of one type and shape, packed together as they travel.

Three encodings. **raw** keeps every bit: the arrays one after another, little-endian, all first bytes of their items,
all second bytes, and so on. **u16** keeps floats to within 1/131070 of the range of their column: whole numbers from 0
to 65535, of each array the differences to the array before (of the first: to the row before), all low bytes, all high
bytes. **u16s** is the same for surfaces that deform, where neighbours move alike: of each array the differences to
where it would be if it moved on as before, of these the differences to the row before, and small ones of either sign as
small numbers. All are deflated (RFC 1951) and written in base 64. A fourth, **plain**, is what live kernels send: the
arrays one after another, as they are (`live.vaults` writes it).

A reference names an array as it was before any encoding.
"""

import base64
import binascii
import math
import zlib
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError, hint
from reactive4d.references import reference

__all__ = ["decode", "encode", "extent"]

Array = NDArray[Any]
DTYPES = {"f32": np.dtype("<f4"), "u32": np.dtype("<u4")}
STEPS = 65535.0


def extent(arrays: Sequence[Array]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The lowest and the highest value of each column over several arrays of k columns, (k,) each; 0 if there is none.

    >>> extent([np.float32([[0, 5], [2, 7]]), np.float32([[1, 9], [1, 9]])])
    (array([0., 5.]), array([2., 9.]))
    """
    filled = [array for array in arrays if len(array)]
    if not filled:
        width = arrays[0].shape[1] if arrays else 0
        return np.zeros(width), np.zeros(width)
    low = np.min([array.min(axis=0) for array in filled], axis=0).astype(np.float64)
    high = np.max([array.max(axis=0) for array in filled], axis=0).astype(np.float64)
    return low, high


def encode(
    arrays: Sequence[Array],
    *,
    refs: Sequence[str] | None = None,
    bounds: tuple[Array, Array] | None = None,
    smooth: bool = False,
) -> dict[str, Any]:
    """Pack arrays into a chunk.

    Args:
        arrays: at least one, all (n, k) or all (n,), which travels as (n, 1); of float32, or all of uint32.
        refs: their references, where they are known already.
        bounds: (k,) lowest and (k,) highest values of the columns: then floats are packed as u16; without, as raw.
        smooth: pack them as u16s instead.

    Raises:
        ShapeError: arrays of different shapes or types, of another type, or not finite or out of bounds as u16.

    >>> chunk = encode([np.float32([[0, 1, 2], [3, 4, 5]])])
    >>> chunk["shape"], chunk["encoding"], len(chunk["refs"])
    ([2, 3], 'raw', 1)
    """
    kept = [np.ascontiguousarray(array) for array in arrays]
    if not kept or any(a.shape != kept[0].shape or a.dtype != kept[0].dtype or a.ndim not in (1, 2) for a in kept):
        shown = [(a.shape, str(a.dtype)) for a in kept]
        raise ShapeError(f"expected (n,) or (n, k) arrays of one shape and type, got {shown}")
    names = {np.dtype(dtype.char): name for name, dtype in DTYPES.items()}
    name = names.get(kept[0].dtype)
    if name is None:
        raise ShapeError(f"expected float32 or uint32, got {kept[0].dtype}")
    chunk: dict[str, Any] = {
        "refs": list(refs) if refs is not None else [reference(array) for array in kept],
        "dtype": name,
        "shape": [*kept[0].shape, 1][:2],
    }
    kept = [array.reshape(chunk["shape"]) for array in kept]
    if bounds is None:
        return {**chunk, "encoding": "raw", "data": _packed(_shuffled(kept, DTYPES[name]))}
    if name != "f32":
        raise ShapeError(f"expected float32 to pack as u16, got {kept[0].dtype}")
    low, high = (np.asarray(bound, dtype=np.float64) for bound in bounds)
    steps = _quantised(kept, low, high)
    planes = _packed(_planes(_zigzag(_differences(steps)) if smooth else _deltas(steps)))
    encoding = "u16s" if smooth else "u16"
    return {**chunk, "encoding": encoding, "lo": low.tolist(), "hi": high.tolist(), "data": planes}


def decode(chunk: Mapping[str, Any]) -> dict[str, Array]:
    """The arrays of a chunk by their references, frozen.

    Raises:
        ShapeError: it is no chunk: lengths, shapes or numbers do not fit together.

    >>> array = np.uint32([[0, 1, 2]])
    >>> decode(encode([array]))
    {'92e8414bfc4dae5b08f13bfa81b2a564': array([[0, 1, 2]], dtype=uint32)}
    """
    refs, dtype, encoding = chunk["refs"], DTYPES.get(chunk["dtype"]), chunk["encoding"]
    rows, width = chunk["shape"]
    exact = encoding in ("raw", "plain")
    if dtype is None or not (exact or (encoding in ("u16", "u16s") and chunk["dtype"] == "f32")):
        error = ShapeError(f"{encoding!r} of {chunk['dtype']!r} is no encoding")
        raise hint(error, "raw or plain of f32 or u32, u16 or u16s of f32")
    shape = (len(refs), rows, width)
    if encoding == "plain":
        arrays = _plain(chunk["data"], math.prod(shape) * 4).view(dtype).reshape(shape)
        arrays.setflags(write=False)
        return dict(zip(refs, arrays, strict=True))
    data = _unpacked(chunk["data"], math.prod(shape) * (4 if encoding == "raw" else 2))
    if encoding == "raw":
        arrays = np.ascontiguousarray(data.reshape(4, -1).T).view(dtype).reshape(shape)
    else:
        low, high = (np.array(chunk[end], dtype=np.float64) for end in ("lo", "hi"))
        if low.shape != (width,) or high.shape != (width,):
            raise ShapeError(f"lo, hi: expected {width} numbers each, got {low.shape} and {high.shape}")
        half = data.reshape(2, -1)
        deltas = half[0].astype(np.uint16) + (half[1].astype(np.uint16) << np.uint16(8))
        deltas = deltas.reshape(len(refs), width, rows)
        if encoding == "u16s":
            deltas = np.cumsum(_unzigzag(deltas), axis=2, dtype=np.uint16)
            deltas[1:] = np.cumsum(deltas[1:], axis=0, dtype=np.uint16)
        elif len(refs):
            deltas[0] = np.cumsum(deltas[0], axis=1, dtype=np.uint16)
        steps = np.cumsum(deltas, axis=0, dtype=np.uint16)
        share = np.swapaxes(steps, 1, 2) / STEPS
        arrays = (low + share * (high - low)).astype(dtype)
    arrays.setflags(write=False)
    return dict(zip(refs, arrays, strict=True))


def _shuffled(arrays: Sequence[Array], dtype: np.dtype[Any]) -> bytes:
    whole = np.concatenate([array.astype(dtype, copy=False).reshape(-1) for array in arrays])
    return np.ascontiguousarray(whole.view(np.uint8).reshape(-1, dtype.itemsize).T).tobytes()


def _quantised(arrays: Sequence[Array], low: Array, high: Array) -> NDArray[np.uint16]:
    """(refs, axes, rows) whole numbers."""
    width = arrays[0].shape[1]
    if low.shape != (width,) or high.shape != (width,):
        raise ShapeError(f"bounds: expected {width} numbers each, got {low.shape} and {high.shape}")
    span = high - low
    scale = np.where(span > 0.0, STEPS / np.where(span > 0.0, span, 1.0), 0.0)
    steps = np.empty((len(arrays), width, len(arrays[0])), np.uint16)
    for i, array in enumerate(arrays):
        share = np.rint((array - low) * scale)
        if not ((share >= 0.0) & (share <= STEPS)).all():
            raise ShapeError("expected finite numbers within the bounds")
        steps[i] = share.T
    return steps


def _deltas(steps: NDArray[np.uint16]) -> NDArray[np.uint16]:
    """Of each array to the one before, of the first to the row before."""
    deltas = steps.copy()
    deltas[1:] -= steps[:-1]
    deltas[0, :, 1:] -= steps[0, :, :-1]
    return deltas


def _differences(steps: NDArray[np.uint16]) -> NDArray[np.uint16]:
    """Of each array to where the two before it point, and of these to the row before."""
    off = steps.copy()
    off[1:] -= steps[:-1]
    off[2:] -= steps[1:-1] - steps[:-2]
    differences = off.copy()
    differences[:, :, 1:] -= off[:, :, :-1]
    return differences


def _zigzag(numbers: NDArray[np.uint16]) -> NDArray[np.uint16]:
    """0, -1, 1, -2 become 0, 1, 2, 3."""
    signed = numbers.view(np.int16)
    return ((signed << np.int16(1)) ^ (signed >> np.int16(15))).view(np.uint16)


def _unzigzag(numbers: NDArray[np.uint16]) -> NDArray[np.uint16]:
    return (numbers >> np.uint16(1)) ^ (np.uint16(0) - (numbers & np.uint16(1)))


def _planes(numbers: NDArray[np.uint16]) -> bytes:
    flat = numbers.reshape(-1)
    return (flat & np.uint16(255)).astype(np.uint8).tobytes() + (flat >> np.uint16(8)).astype(np.uint8).tobytes()


def _packed(data: bytes) -> str:
    squeezer = zlib.compressobj(9, zlib.DEFLATED, -15)
    return base64.b64encode(squeezer.compress(data) + squeezer.flush()).decode("ascii")


def _plain(data: str | bytes, size: int) -> NDArray[np.uint8]:
    try:
        found = base64.b64decode(data, validate=True) if isinstance(data, str) else data
    except binascii.Error as error:
        raise ShapeError(f"data: {error}") from None
    if len(found) != size:
        raise ShapeError(f"data: expected {size} bytes, got {len(found)}")
    return np.frombuffer(found, np.uint8)


def _unpacked(text: str, size: int) -> NDArray[np.uint8]:
    """The bytes; never more than expected, whatever the text says."""
    reader = zlib.decompressobj(-15)
    try:
        data = reader.decompress(base64.b64decode(text, validate=True), size + 1)
    except (binascii.Error, zlib.error) as error:
        raise ShapeError(f"data: {error}") from None
    if len(data) != size:
        raise ShapeError(f"data: expected {size} bytes, got {'more' if len(data) > size else len(data)}")
    return np.frombuffer(data, np.uint8)
