"""Copyists: a process of its own that holds a reader's private copy: a script, the scene of it, and who answers of it.

It reads orders from the socket that it was started with, and answers each of them: 4 bytes of length and JSON come; 4
bytes of length, one byte that says what follows, and that go. Nothing that arrives is ever run as Python.
"""

import contextlib
import json
import os
import signal
import socket
import struct
import sys
from typing import Any

__all__ = ["BYTES", "ERROR", "LENGTH", "MEMORY", "NOTHING", "TEXT", "main"]

LENGTH = struct.Struct("<I")
TEXT, BYTES, NOTHING, ERROR = 0, 1, 2, 3  # what an answer is
MEMORY = 71  # the status with which it ends where memory does not suffice
GRACE = 5.0  # seconds beyond those that whoever started it waits


def main(number: int) -> None:
    """Answer until nobody asks any more.

    Args:
        number: of the socket.
    """
    line = socket.socket(fileno=number)
    with contextlib.suppress(OSError):
        os.nice(10)  # whoever answers everybody goes first
    said = _heard(line)
    if said is None:
        return
    desk = _desk(said)
    try:
        _tell(line, TEXT, b"{}")
        while (order := _heard(line)) is not None:
            signal.setitimer(signal.ITIMER_REAL, said["seconds"] + GRACE)
            kind, data = _answered(desk, order)
            _tell(line, kind, data)
            signal.setitimer(signal.ITIMER_REAL, 0.0)
    except MemoryError:
        os._exit(MEMORY)
    except ConnectionError:
        os._exit(0)  # nobody is there any more, and nothing is to be put away


def _desk(said: dict[str, Any]) -> Any:
    """Get ready, and then be confined."""
    from reactive4d_apps.serving.confinements import confine
    from reactive4d_apps.serving.desks import Desk

    desk = Desk(said)
    desk.prepare()
    confine(memory=said["memory"], seconds=said["computing"], folder=said["folder"], files=said["files"])
    return desk


def _answered(desk: Any, order: dict[str, Any]) -> tuple[int, bytes]:
    """A mistake of ours is an answer: the copy goes on."""
    try:
        return desk.answered(order)
    except MemoryError:
        raise
    except Exception as error:  # noqa: BLE001
        text = f"this went wrong in your copy: {type(error).__name__}"
        return ERROR, json.dumps({"id": order.get("id"), "type": "error", "text": text}).encode()


def _heard(line: socket.socket) -> Any:
    head = _taken(line, LENGTH.size)
    data = None if head is None else _taken(line, LENGTH.unpack(head)[0])
    return None if data is None else json.loads(data)


def _taken(line: socket.socket, count: int) -> bytes | None:
    parts = bytearray()
    while len(parts) < count:
        part = line.recv(min(count - len(parts), 2**20))
        if not part:
            return None
        parts += part
    return bytes(parts)


def _tell(line: socket.socket, kind: int, data: bytes) -> None:
    line.sendall(LENGTH.pack(len(data)) + bytes([kind]))
    line.sendall(data)


if __name__ == "__main__":
    main(int(sys.argv[1]))
