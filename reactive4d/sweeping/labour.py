"""What a worker does: visit places, and answer what it found there."""

import os
import pickle
import signal
import sys
import threading
from collections import OrderedDict
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from reactive4d.sweeping.jobs import Part, Visitor
from reactive4d.sweeping.parcels import read, sendable, write

__all__ = ["main", "portable", "visited"]

MOST_HELD = 4  # models that a Dask worker keeps for each of its threads


def main() -> None:
    """The life of a worker process: told by its standard input, answering by its standard output."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # who gave the orders hears of it, and ends this process
    orders = os.fdopen(os.dup(0), "rb")
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what the model prints goes where errors go
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    try:
        parcel = read(orders)
        visitor: Visitor | None = None
        while True:
            start, stop, seconds, limit = read(orders)
            try:
                if visitor is None:
                    visitor = Visitor(pickle.loads(parcel))
                if limit:
                    visitor.limit = visitor.most = limit
                for part in visitor.visit(start, stop, seconds):
                    write(answers, portable(part))
                write(answers, True)
            except Exception as error:  # noqa: BLE001  it is told to whoever gave the order
                write(answers, sendable(error))
    except (EOFError, BrokenPipeError):
        pass


def portable(part: Part) -> Part:
    """A part whose errors can travel."""
    if not any(encoded.failed for encoded in part.answers.values()):
        return part
    known: dict[int, Exception] = {}
    answers = {
        name: replace(e, failed={i: known.setdefault(id(x), sendable(x)) for i, x in e.failed.items()})
        for name, e in part.answers.items()
    }
    return replace(part, answers=answers)


_held: "OrderedDict[tuple[str, int], Visitor]" = OrderedDict()
_lock = threading.Lock()


def visited(
    parcel: bytes, key: str, span: tuple[int, int], seconds: float, path: Sequence[str] = ()
) -> tuple[list[Part], int]:
    """What a worker of Dask's does: visit places, and keep the model for the next time.

    Args:
        parcel: the job, packed.
        key: its name.
        span: from which place to which.
        seconds: after which to stop, about.
        path: where modules are looked for besides.

    Returns:
        The parts, and the place after the last of them.
    """
    own = key, threading.get_ident()
    with _lock:
        visitor = _held.get(own)
    if visitor is None:
        sys.path.extend([folder for folder in path if folder not in sys.path])
        visitor = Visitor(pickle.loads(parcel))
        with _lock:
            _held[own] = visitor
            while len([1 for _, thread in _held if thread == own[1]]) > MOST_HELD:
                del _held[next(other for other in _held if other[1] == own[1])]
    parts: list[Any] = []
    place = span[0]
    for part in visitor.visit(*span, seconds):
        parts.append(portable(part))
        place = part.stop
    return parts, place
