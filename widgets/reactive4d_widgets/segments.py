"""Segments: what a channel is over a time, for some values of parameters."""

import math
from dataclasses import dataclass, field
from typing import Any

__all__ = ["Segment", "is_timeless"]

MOVING = frozenset({"poly", "slerp", "stepped", "cases", "repeat", "samples"})


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


def is_timeless(segment: Segment) -> bool:
    """Whether a channel says the same at all times, for these values of parameters.

    >>> is_timeless(Segment("ball#visible", -math.inf, math.inf, {}, {"kind": "const", "value": True}))
    True
    >>> tree = ["*", 2, ["time"]]
    >>> is_timeless(Segment("#values.x", -math.inf, math.inf, {}, {"kind": "expr", "tree": tree}))
    False
    """
    return segment.lo == -math.inf and segment.hi == math.inf and _stands_still(segment.track)


def _stands_still(track: Any) -> bool:
    """Whether no track in it moves, and no tree in it reads the time."""
    if isinstance(track, list):
        parts: list[Any] = track  # pyright: ignore[reportUnknownVariableType]
        return parts[:1] not in (["time"], ["at"]) and all(map(_stands_still, parts))
    if not isinstance(track, dict):
        return True
    known: dict[str, Any] = track  # pyright: ignore[reportUnknownVariableType]
    if known.get("kind") == "const":
        return True
    return known.get("kind") not in MOVING and all(map(_stands_still, known.values()))
