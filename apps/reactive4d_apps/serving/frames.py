"""Frames: a message on a web socket: JSON as a text, or JSON with bytes beside it as one binary frame.

A binary frame is the length of its JSON (4 bytes, little-endian), the JSON, and then the bytes. The JSON has one more
field, `buffers`, the length of each part; `{"buffer": k}` in it stands for part k.
"""

import json
import struct
from typing import Any, NoReturn

from reactive4d.errors import Reactive4dError

__all__ = ["FrameError", "Sealed", "packed", "unpacked"]

_LENGTH = struct.Struct("<I")


class FrameError(Reactive4dError):
    """What came is no message; the text may be told to whoever sent it."""


class Sealed(dict[str, Any]):
    """A message that somebody else packed; what has to be known of it stands in it.

    >>> packed(Sealed('{"type":"answer"}', type="answer"))
    '{"type":"answer"}'
    """

    def __init__(self, data: str | bytes, **known: Any) -> None:
        super().__init__(known)
        self.data = data


def packed(message: dict[str, Any], buffers: list[bytes] | None = None) -> str | bytes:
    r"""What is sent.

    Raises:
        ValueError: there is an infinity or NaN in it.

    >>> packed({"type": "reopen"})
    '{"type":"reopen"}'
    >>> packed({"data": {"buffer": 0}}, [b"ab"])
    b'#\x00\x00\x00{"data":{"buffer":0},"buffers":[2]}ab'
    """
    if isinstance(message, Sealed):
        return message.data
    if not buffers:
        return _text(message)
    head = _text({**message, "buffers": [len(part) for part in buffers]}).encode()
    return b"".join([_LENGTH.pack(len(head)), head, *buffers])


def _text(message: dict[str, Any]) -> str:
    return json.dumps(message, separators=(",", ":"), ensure_ascii=False, allow_nan=False)


def unpacked(text: str) -> dict[str, Any]:
    """What a reader sent.

    Raises:
        FrameError: it is no JSON, has numbers that are none, or is no object.

    >>> unpacked('{"t": NaN}')
    Traceback (most recent call last):
    ...
    reactive4d_apps.serving.frames.FrameError: no JSON: NaN
    """
    try:
        found = json.loads(text, parse_constant=_refuse)
    except RecursionError:
        raise FrameError("no JSON: nested too deeply") from None
    except ValueError as error:
        raise FrameError(f"no JSON: {getattr(error, 'msg', 'a number that is too long')}") from None
    if not isinstance(found, dict):
        raise FrameError("expected an object")
    return found  # pyright: ignore[reportUnknownVariableType]


def _refuse(word: str) -> NoReturn:
    raise FrameError(f"no JSON: {word}")
