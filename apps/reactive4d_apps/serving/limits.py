"""Limits: how much one reader may take of a server that all share."""

from dataclasses import dataclass

__all__ = ["Limits"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """What is bounded, and where.

    Attributes:
        readers: figures that are open at one time, all readers together; further ones are turned away.
        visitors: connections that have no figure open, together; of more, who is silent for longest is cut.
        silence: seconds after which a connection is cut that has no figure open and asks for nothing.
        asks: of one reader that are under way; a further one is refused.
        message: bytes of one message of a reader; a larger one ends the connection before it has arrived.
        rate: what a reader may send in a second, in messages; a large one counts as several.
        burst: what a reader may send at once; beyond, nothing is read of them until they may send again.
        faults: messages that are none, until the connection is ended.
        thinking: seconds after which a reader is told that there is no answer yet.
        sending: seconds within which a reader must take what is sent to them; else the connection is ended.
        pulse: seconds between two signs of life that are asked of a silent reader.
        threads: in which is evaluated.
        windows: in which pictures are drawn for readers who cannot draw them, all readers together.
        pictures: that one reader may have in a second.
        pixels: of one picture; who wants a larger one gets a smaller one of the same shape.
        triangles: of a scene; a larger one is not sent, but drawn for its readers.
        copies: private copies at one time, all readers together; whoever wants one more is told to wait.
        script: letters of one that a reader sends.
        copy_memory: bytes that a private copy may take beyond what an empty one does.
        copy_thinking: seconds after which a private copy is ended that has no answer.
        copy_computing: seconds that a private copy may compute in all.
        copy_idle: seconds after which a private copy is ended that nobody asks for anything.

    >>> Limits(readers=10).asks
    2
    """

    readers: int = 256
    visitors: int = 256
    silence: float = 20.0
    asks: int = 2
    message: int = 2 * 2**20
    rate: float = 200.0
    burst: float = 400.0
    faults: int = 20
    thinking: float = 30.0
    sending: float = 20.0
    pulse: float = 20.0
    threads: int = 4
    windows: int = 8
    pictures: float = 30.0
    pixels: int = 1600 * 1200
    triangles: int = 2_000_000
    copies: int = 8
    script: int = 200_000
    copy_memory: int = 512 * 2**20
    copy_thinking: float = 10.0
    copy_computing: float = 300.0
    copy_idle: float = 900.0
