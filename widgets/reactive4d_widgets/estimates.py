"""Estimates: how large a page will be, found out from a few ticks before all are asked."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from reactive4d.errors import PageTooLargeError, hint
from reactive4d_widgets.chunks import encode
from reactive4d_widgets.coverings import Coverer
from reactive4d_widgets.plans import Plan
from reactive4d_widgets.seats import Channel
from reactive4d_widgets.stores import arrays_of_a_chunk, measured, ranges

__all__ = ["Share", "estimated", "refuse_if_too_large", "too_large"]

PROBES = 5
FEW = 4  # ticks that follow each other
NAME = 70  # bytes of a reference, where the array is named and where it is used
ROWS = 12  # of the table
SAMPLE = 96_000  # rows of an array of more that are packed to know what all of them take
PLACES = 8  # from which they come


@dataclass(frozen=True, slots=True)
class Share:
    """What one channel takes.

    Attributes:
        channel: its name.
        cells: for how many combinations of parameter values.
        ticks: at how many ticks of each.
        size: bytes in all.
    """

    channel: str
    cells: int
    ticks: int
    size: int

    @property
    def asks(self) -> int:
        """How often it will be asked."""
        return self.cells * self.ticks


def estimated(plan: Plan, coverer: Coverer) -> list[Share]:
    """What the channels will take that carry arrays; all others take next to nothing."""
    found: list[Share] = []
    seen: set[int] = set()
    for channel in plan.channels:
        if channel.is_array and channel.seat is not None and coverer.is_ever_seen(channel.seat):
            share = _share(plan, coverer, channel, seen)
            if share is not None:
                found.append(share)
    return found


def _share(plan: Plan, coverer: Coverer, channel: Channel, seen: set[int]) -> Share | None:
    asker, span = plan.asker, plan.span
    gate = coverer.gate(channel)
    ticks = [k for k, t in enumerate(span) if gate is None or gate(t)]
    few = [ticks[round(i * (len(ticks) - 1) / (PROBES - 1))] for i in range(PROBES)] if len(ticks) > PROBES else ticks
    reads: dict[str, None] = {}
    still: Any = None
    probes: list[list[Any]] = []
    moving: list[int] = []
    for k in few:
        answer = asker.ask(channel.signal, span.tick(k))
        reads.update(dict.fromkeys(answer.parameters))
        if answer.interval.stop - span.tick(k) < span.step:
            moving.append(k)
        arrays = _arrays(channel, answer.value)
        if arrays is not None:
            still = answer.value if still is None else still
            probes.append(arrays)
        if answer.interval.stop > span.stop:
            break
    cells = math.prod([len(asker.stops[name]) for name in reads if name in asker.stops])
    if still is None:
        return None
    if not moving and cells == 1:
        # Things that stand still may share their arrays; those are counted once.
        if id(still) in seen:
            return None
        seen.add(id(still))
    count = max(1, round(len(ticks) * len(moving) / len(few)))
    if len(moving) > 1 and len(probes) == len(ticks):
        # So few that all of them are known.
        several = _several(probes)
        size = sum(_bytes(probes[i : i + several], probes) for i in range(0, len(probes), several))
    elif moving and count > 1:
        places = [moving[0], moving[len(moving) // 2], moving[-1]]
        size = sum(_series(plan, channel, k, count, probes) for k in places) // len(places)
    else:
        size = _bytes(probes[:1])
    return Share(channel.name, cells, count, cells * size)


def _series(plan: Plan, channel: Channel, k: int, count: int, probes: list[list[Any]]) -> int:
    """What some ticks take, as a few that follow each other tell; each later one takes what the last of them took."""
    several = _several(probes)
    last, few = plan.span.count + 1, min(FEW, several)
    some = range(max(min(k, last - few), 0), last)[:few]
    answers = [plan.asker.ask(channel.signal, plan.span.tick(i)) for i in some]
    values = [arrays for arrays in [_arrays(channel, answer.value) for answer in answers] if arrays is not None]
    if not values:
        return 0
    sizes = [_bytes(values[: i + 1], probes) for i in range(len(values))]
    more = sizes[-1] - sizes[-2] if len(sizes) > 1 else sizes[-1]

    def packed(n: int) -> int:
        return 0 if n == 0 else sizes[n - 1] if n <= len(sizes) else sizes[-1] + more * (n - len(sizes))

    return count // several * packed(several) + packed(count % several)


def _several(probes: list[list[Any]]) -> int:
    """How many of these are packed together."""
    return arrays_of_a_chunk(max([array.nbytes for array in probes[0]], default=0))


def _arrays(channel: Channel, value: Any) -> list[Any] | None:
    """What an answer has to pack; None where there is no answer, or one that is refused."""
    if value is None:
        return None
    if channel.what == "topology":
        return [np.asarray(part, dtype=np.uint32) for part in value[:1] if part is not None] * 2  # faces, and edges
    if channel.what == "paints":
        return [np.asarray(part, dtype=np.float32) for part in value if part is not None]
    points = np.asarray(value, dtype=np.float32)
    return [points] if np.isfinite(points).all() else None


def _bytes(several: list[list[Any]], probes: list[list[Any]] | None = None) -> int:
    """How many bytes some arrays take, packed together if they are of one shape; the probes say between what bounds."""
    size = 0
    for i, alike in enumerate(zip(*several, strict=False)):
        arrays = [array for array in alike if array.size]
        if not arrays:
            continue
        size += NAME * len(arrays)
        part = max(1.0, len(arrays[0]) / SAMPLE)
        if arrays[0].dtype.kind == "f" and all(array.shape == arrays[0].shape for array in arrays):
            some = [_sampled(array) for array in arrays]
            others = [probe[i] for probe in probes or () if i < len(probe) and probe[i].shape == arrays[0].shape]
            chunk = encode(some, refs=[""] * len(arrays), bounds=ranges([*arrays, *others]), smooth=True)
            size += round(part * measured(chunk))
        else:
            size += sum(round(part * measured(encode([_sampled(array)], refs=[""]))) for array in arrays)
    return size


def _sampled(array: Any) -> Any:
    """Some rows of an array of very many: those of a few places, where neighbours stay neighbours."""
    if len(array) <= SAMPLE:
        return array
    run = SAMPLE // PLACES
    starts = np.linspace(0, len(array) - run, PLACES).astype(int)
    return np.concatenate([array[start : start + run] for start in starts])


def refuse_if_too_large(shares: Iterable[Share], limit: float, *, besides: int = 0) -> None:
    """Refuse a page that will be larger than it may.

    Args:
        shares: what the channels will take.
        limit: bytes.
        besides: bytes of all else: the viewer, the text.

    Raises:
        PageTooLargeError: with a table.
    """
    listed = list(shares)
    total = sum(share.size for share in listed) + besides
    if total > limit:
        raise too_large(total, limit, [(s.channel, f"{s.cells} x {s.ticks}", s.size) for s in listed], about="about ")


def too_large(size: int, limit: float, rows: Iterable[tuple[str, str, int]], *, about: str = "") -> PageTooLargeError:
    """The error for a page of this size, with a table of what takes the bytes: channel, cells x ticks, bytes.

    >>> print(too_large(3_000_000, 2_000_000, [("a#points", "1 x 60", 2_900_000), ("b#points", "1 x 1", 900)]))
    the page would take 3.0 MB, more than its limit of 2.0 MB
      channel   cells x ticks    size
      a#points         1 x 60  2.9 MB
      b#points          1 x 1   900 B
    """
    ordered = sorted(rows, key=lambda row: -row[2])
    shown = [("channel", "cells x ticks", "size"), *[(name, count, _told(n)) for name, count, n in ordered[:ROWS]]]
    if len(ordered) > ROWS:
        shown.append((f"{len(ordered) - ROWS} more", "", _told(sum(n for _, _, n in ordered[ROWS:]))))
    widths = [max(len(row[i]) for row in shown) for i in range(3)]
    lines = [f"  {a:<{widths[0]}}  {b:>{widths[1]}}  {c:>{widths[2]}}" for a, b, c in shown]
    message = f"the page would take {about}{_told(size)}, more than its limit of {_told(limit)}"
    error = PageTooLargeError("\n".join([message, *lines]), size=int(size), limit=int(limit))
    return hint(error, "fewer times, fewer values of a parameter, a coarser surface, or a larger `limit` (bytes)")


def _told(size: float) -> str:
    """Bytes for a person to read."""
    if size >= 1e6:
        return f"{size / 1e6:.1f} MB"
    return f"{size / 1e3:.1f} KB" if size >= 1e3 else f"{size:.0f} B"
