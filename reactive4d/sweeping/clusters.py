"""Clusters: a sweep done by the workers of a Dask client, on this machine or on many.

Dask replaces workers that die and does again what they were doing. If that fails again and again, half of the places
are tried, and half of these, until the point is found; there it is an error.
"""

import hashlib
import sys
from collections.abc import Generator, Sequence
from typing import Any

from reactive4d.errors import Reactive4dError, hint
from reactive4d.sweeping.jobs import Part
from reactive4d.sweeping.labour import visited
from reactive4d.sweeping.plans import Plan
from reactive4d.sweeping.spans import Span, Spans
from reactive4d.sweeping.workers import PIECE, failed_part

__all__ = ["cluster", "threads_of"]

PATIENCE = 30.0  # seconds in which the first worker must come


def threads_of(client: Any) -> int:
    """How many tasks the workers of a client run at once.

    Raises:
        TypeError: it is no client.
        Reactive4dError: it has no workers.
    """
    if not all(hasattr(client, name) for name in ("submit", "nthreads", "wait_for_workers")):
        error = TypeError(f"client: expected a dask.distributed.Client, got {client!r}")
        raise hint(error, "workers=4 uses processes of this machine, without Dask")
    if not client.nthreads():
        wish = client.submit(int, pure=False)  # a cluster that adapts begins workers when there is work
        try:
            client.wait_for_workers(1, timeout=PATIENCE)
        except TimeoutError:
            error = Reactive4dError(f"the client has no workers, and got none in {PATIENCE:g} s")
            raise hint(error, "cluster.scale(4), or workers=4 for processes of this machine without Dask") from None
        finally:
            wish.cancel()
    return max(1, sum(client.nthreads().values()))


def cluster(client: Any, parcel: bytes, plan: Plan, gaps: Sequence[Span]) -> Generator[Part]:
    """Visit places by the workers of a client; their parts come as they are finished.

    Args:
        client: a `dask.distributed.Client`.
        parcel: the job, packed.
        plan: how the places are visited.
        gaps: the places.
    """
    from distributed import KilledWorker, as_completed

    lanes = threads_of(client)
    spans = Spans(gaps, lanes)
    key = hashlib.sha256(parcel).hexdigest()[:16]
    running: dict[Any, tuple[int, Span]] = {}
    doubtful: list[list[Span]] = [[] for _ in range(lanes)]  # where workers died

    def submit(lane: int) -> list[Any]:
        span = doubtful[lane].pop() if doubtful[lane] else spans.take(lane)
        if span is None:
            return []
        future = client.submit(visited, parcel, key, span, PIECE, list(sys.path), pure=False)
        running[future] = lane, span
        return [future]

    done: Any = as_completed([future for lane in range(lanes) for future in submit(lane)])
    try:
        for future in done:
            lane, (start, stop) = running.pop(future)
            try:
                parts, place = future.result()
            except KilledWorker:
                parts, place = [], start
                if stop - start == 1:
                    parts, place = [failed_part(plan, start, "the worker died again and again")], stop
                else:
                    middle = (start + stop) // 2
                    doubtful[lane] += [(middle, stop), (start, middle)]
                    place = stop
            yield from parts
            if place < stop:
                if doubtful[lane]:
                    doubtful[lane].append((place, stop))
                else:
                    spans.give_back(lane, place, stop)
            for again in submit(lane):
                done.add(again)
    finally:
        if running:
            client.cancel(list(running))
