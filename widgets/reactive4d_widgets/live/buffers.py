"""Buffers: the bytes of arrays, beside a message or in base 64 within it."""

import base64
from typing import Any

__all__ = ["embedded", "parted"]

Message = dict[str, Any]


def parted(message: Message) -> tuple[Message, list[bytes]]:
    """A message without bytes, and the bytes: where they were stands which of them they are.

    >>> parted({"type": "blobs", "blobs": [{"shape": [1], "data": b"abcd"}]})
    ({'type': 'blobs', 'blobs': [{'shape': [1], 'data': {'buffer': 0}}]}, [b'abcd'])
    """
    buffers: list[bytes] = []
    blobs: list[Message] = []
    for chunk in message.get("blobs", ()):
        if isinstance(chunk["data"], bytes):
            blobs.append({**chunk, "data": {"buffer": len(buffers)}})
            buffers.append(chunk["data"])
        else:
            blobs.append(chunk)
    return ({**message, "blobs": blobs} if buffers else message), buffers


def embedded(message: Message) -> Message:
    """A message whose bytes are base 64, for wires that carry texts only.

    >>> embedded({"type": "blobs", "blobs": [{"shape": [1], "data": b"abcd"}]})
    {'type': 'blobs', 'blobs': [{'shape': [1], 'data': 'YWJjZA=='}]}
    """
    if "blobs" not in message:
        return message
    return {**message, "blobs": [{**chunk, "data": _text(chunk["data"])} for chunk in message["blobs"]]}


def _text(data: str | bytes) -> str:
    return data if isinstance(data, str) else base64.b64encode(data).decode("ascii")
