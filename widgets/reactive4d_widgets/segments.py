"""Segments: what a channel is over a time, for some values of parameters."""

from dataclasses import dataclass, field
from typing import Any

__all__ = ["Segment"]


@dataclass(slots=True)
class Segment:
    """What a channel is over a time, for some values of parameters.

    Attributes:
        channel: its name.
        lo, hi: from when to when, without `hi`.
        where: the parameters that were read, with the values that they had.
        track: what it is; None if there is an error instead.
        error: what went wrong.
        blend: parameters between whose baked values a viewer may go in a straight line.
        reads: parameters that the track itself reads, so that it holds for all their values.
    """

    channel: str
    lo: float
    hi: float
    where: dict[str, Any]
    track: dict[str, Any] | None
    error: str | None = None
    blend: tuple[str, ...] = ()
    reads: frozenset[str] = field(default_factory=frozenset[str])
