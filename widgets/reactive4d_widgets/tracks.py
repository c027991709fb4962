"""Tracks of channels: exact where a channel can be lowered as it is, else fitted for one cell of a table."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from reactive4d_widgets import lowering
from reactive4d_widgets.seats import Channel
from reactive4d_widgets.spans import Span

__all__ = ["Cell", "Exact", "exact", "fitted", "parameters_in"]

INF = math.inf
PRECISE = 1e-4
SHADE = 1.0 / 255.0

Track = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Exact:
    """A track that is right for ever, and the names of the parameters that it reads."""

    track: Track
    reads: frozenset[str]


@dataclass(frozen=True, slots=True)
class Cell:
    """A track that is right for one combination of parameter values.

    Attributes:
        track: the track.
        reads: the parameters that it was made for.
        free: the parameters that it reads itself.
        lo, hi: from when to when.
        asks: how often signals were asked for it.
    """

    track: Track
    reads: frozenset[str]
    free: frozenset[str]
    lo: float
    hi: float
    asks: int = 0


def exact(channel: Channel) -> Exact | None:
    """The track of a channel that says the same at any time and for all values of the parameters; None if none does."""
    seat = channel.seat
    if seat is None:
        track = lowering.lower(channel.signal)
    elif not seat.is_plain or seat.object is None:
        return None
    elif channel.what == "visible":
        track = lowering.lower_visible(seat.object, above=seat.groups)
    elif channel.what == "matrix":
        track = lowering.lower_matrix(seat.object, above=seat.groups)
    elif channel.what == "color":
        track = lowering.lower_paint(seat.object, above=seat.groups)
    else:
        track = None if channel.source is None else lowering.lower(channel.source)
    return None if track is None else Exact(track, parameters_in(track))


def fitted(channel: Channel, span: Span, parameters: Mapping[str, Any], size: float) -> Cell | None:
    """Curves for a channel that moves, at fixed values of the parameters; None where it is too rough for curves.

    Args:
        channel: its answers are numbers.
        span: the time.
        parameters: all of them.
        size: of the scene, metres.
    """
    seat = channel.seat
    start, stop = span.start, span.stop
    if channel.what != "matrix":
        tolerance = SHADE if channel.what == "color" else _tolerance(channel, span, parameters)
        found = lowering.track(channel.signal, start, stop, tolerance=tolerance, parameters=parameters)
    elif seat is not None and seat.is_plain and seat.object is not None:
        found = lowering.matrix_track(seat.object, start, stop, size=size, parameters=parameters, above=seat.groups)
    else:
        return None
    if found is None:
        return None
    free = parameters_in(found.track) - found.reads
    lo, hi = (-INF, INF) if found.exact else (start, span.end)
    return Cell(found.track, found.reads, free, lo, hi, found.asks)


def _tolerance(channel: Channel, span: Span, parameters: Mapping[str, Any]) -> float:
    """A ten-thousandth of what a channel's numbers come to."""
    values = np.array([np.ravel(channel.signal.at(t, **parameters)) for t in span.few(9)], dtype=np.float64)
    return PRECISE * max(float(np.ptp(values, axis=0).max()), 1e-3 * float(np.abs(values).max()), 1e-9)


def parameters_in(track: Any) -> frozenset[str]:
    """The names of the parameters that a track reads.

    >>> sorted(parameters_in({"kind": "expr", "tree": ["*", ["param", "length"], ["time"]]}))
    ['length']
    """
    found: set[str] = set()
    todo: list[Any] = [track]
    while todo:
        part = todo.pop()
        if isinstance(part, dict):
            todo.extend(part.values())  # pyright: ignore[reportUnknownArgumentType, reportUnknownMemberType]
        elif isinstance(part, list):
            parts: list[Any] = part  # pyright: ignore[reportUnknownVariableType]
            if len(parts) == 2 and parts[0] == "param" and isinstance(parts[1], str):
                found.add(parts[1])
            else:
                todo.extend(parts)
    return frozenset(found)
