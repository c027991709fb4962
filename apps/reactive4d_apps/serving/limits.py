"""Limits: how much one reader may take of a server that all share."""

from dataclasses import dataclass

__all__ = ["Limits"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """What is bounded, and where.

    Attributes:
        readers: figures that are open at one time, all readers together; further ones are turned away.
        asks: of one reader that are under way; a further one is refused.
        message: bytes of one message of a reader; a larger one ends the connection before it has arrived.
        rate: what a reader may send in a second, in messages; a large one counts as several.
        burst: what a reader may send at once; beyond, nothing is read of them until they may send again.
        faults: messages that are none, until the connection is ended.
        thinking: seconds after which a reader is told that there is no answer yet.
        sending: seconds within which a reader must take what is sent to them; else the connection is ended.
        pulse: seconds between two signs of life that are asked of a silent reader.
        threads: in which is evaluated.

    >>> Limits(readers=10).asks
    2
    """

    readers: int = 256
    asks: int = 2
    message: int = 2 * 2**20
    rate: float = 200.0
    burst: float = 400.0
    faults: int = 20
    thinking: float = 30.0
    sending: float = 20.0
    pulse: float = 20.0
    threads: int = 4
