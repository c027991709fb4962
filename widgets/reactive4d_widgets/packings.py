"""Packings: what is written in JSON again and again in nearly the same words, as a page carries it: deflated.

A thing that stands still has nine channels, each a segment of its own, and all but its place are those of its
neighbour: deflated, it takes a tenth.
"""

import base64
import binascii
import json
import zlib
from typing import Any

from reactive4d.errors import ShapeError

__all__ = ["compact", "packed", "unpacked"]

SHORT = 4096  # characters that may as well be read by people
MOST = 2**29  # bytes that nobody unpacks


def compact(value: Any) -> str:
    """JSON without spaces.

    Raises:
        ValueError: there is an infinity or NaN in it.
    """
    return json.dumps(value, separators=(",", ":"), ensure_ascii=False, allow_nan=False)


def packed(value: list[Any]) -> Any:
    """A list as a page carries it: itself if it is short, else how many bytes of JSON it is, and these deflated.

    >>> few = [{"channel": "a#color"}]
    >>> packed(few) is few
    True
    >>> many = [{"channel": f"a{i}#color"} for i in range(1000)]
    >>> made = packed(many)
    >>> made["bytes"], len(made["data"]) < 5000, unpacked(made) == many
    (24891, True, True)
    """
    text = compact(value)
    if len(text) <= SHORT:
        return value
    data = text.encode("utf-8")
    squeezer = zlib.compressobj(9, zlib.DEFLATED, -15)
    squeezed = base64.b64encode(squeezer.compress(data) + squeezer.flush()).decode("ascii")
    return {"bytes": len(data), "data": squeezed} if len(squeezed) < len(text) else value


def unpacked(value: Any) -> list[Any]:
    """The list that `packed` was given.

    Raises:
        ShapeError: it is none.
    """
    if isinstance(value, list):
        return value  # pyright: ignore[reportUnknownVariableType]
    try:
        size, text = int(value["bytes"]), str(value["data"])
        if not 0 <= size <= MOST:
            raise ShapeError(f"bytes: expected at most {MOST}, got {size}")
        data = zlib.decompressobj(-15).decompress(base64.b64decode(text, validate=True), size + 1)
        if len(data) != size:
            raise ShapeError(f"data: expected {size} bytes, got {'more' if len(data) > size else len(data)}")
        found = json.loads(data)
    except (KeyError, TypeError, ValueError, OverflowError, binascii.Error, zlib.error) as error:
        raise ShapeError(f"this is no packed list: {error}") from None
    if not isinstance(found, list):
        raise ShapeError(f"expected a list, got {type(found).__name__}")
    return found  # pyright: ignore[reportUnknownVariableType]
