"""Workers: a sweep done by processes of this machine.

A worker is a fresh interpreter that is told by a pipe what to do and answers by another. It ends when its pipe is
closed, so none is left behind when the sweep's process ends, whatever ends it. One that dies is replaced, and what it
had not answered is done again; a point at which workers die again and again is an error at that point.
"""

import pickle
import queue
import subprocess
import sys
import threading
from collections.abc import Generator, Sequence
from contextlib import suppress
from typing import Any, Final

import numpy as np

from reactive4d.errors import Reactive4dError, hint
from reactive4d.sweeping.jobs import Part
from reactive4d.sweeping.parcels import read, write
from reactive4d.sweeping.plans import Plan
from reactive4d.sweeping.spans import Span, Spans
from reactive4d.sweeping.values import Encoded

__all__ = ["WorkerError", "failed_part", "workers"]

PIECE: Final = 1.0  # seconds of work that a worker is given at a time, about
MOST_DEATHS = 3  # at one point, before it is taken for the point's fault


class WorkerError(Reactive4dError):
    """A worker process died while it visited a point."""


class _Worker:
    """One process, and what it is doing."""

    def __init__(self, lane: int, parcel: bytes, told: "queue.Queue[tuple[_Worker, Any]]") -> None:
        self.lane = lane
        self.span: Span | None = None
        self.limit = 0
        code = f"import sys; sys.path[:] = {sys.path!r}; from reactive4d.sweeping.labour import main; main()"
        self.process = subprocess.Popen([sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self._told = told
        self._write(parcel)
        self._ear = threading.Thread(target=self._listen, daemon=True)
        self._ear.start()

    def _write(self, message: Any) -> None:
        assert self.process.stdin is not None
        with suppress(OSError):  # it has died, as whoever listens is told
            write(self.process.stdin, message)

    def visit(self, span: Span, limit: int) -> None:
        """Let it visit some places."""
        self.span, self.limit = span, limit
        self._write((*span, PIECE, limit))

    def _listen(self) -> None:
        assert self.process.stdout is not None
        try:
            while True:
                self._told.put((self, read(self.process.stdout)))
        except (OSError, EOFError, pickle.UnpicklingError):  # it has died, perhaps in the middle of a word
            self._told.put((self, None))

    def close(self) -> None:
        """End it at once."""
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self._ear.join()  # nobody reads from a pipe that is closed
        for pipe in (self.process.stdin, self.process.stdout):
            if pipe is not None:
                with suppress(OSError):
                    pipe.close()


def workers(parcel: bytes, plan: Plan, gaps: Sequence[Span], count: int) -> Generator[Part]:
    """Visit places by so many processes; their parts come as they are finished.

    Args:
        parcel: the job, packed.
        plan: how the places are visited.
        gaps: the places.
        count: how many processes.

    Raises:
        Reactive4dError: the job cannot be done elsewhere.
    """
    told: queue.Queue[tuple[_Worker, Any]] = queue.Queue()
    spans = Spans(gaps, count)
    deaths: dict[int, int] = {}
    crew: dict[int, _Worker] = {}
    try:
        for lane in range(count):
            span = spans.take(lane)
            if span is not None:
                crew[lane] = _Worker(lane, parcel, told)
                crew[lane].visit(span, 0)
        while crew:
            worker, message = told.get()
            if crew.get(worker.lane) is not worker:
                continue
            lane = worker.lane
            assert worker.span is not None
            if isinstance(message, Part):
                worker.span = (message.stop, worker.span[1])
                yield message
                continue
            if isinstance(message, Exception):
                raise message
            careful = worker.limit
            if message is None:  # it died
                worker.close()
                place = worker.span[0]
                deaths[place] = deaths.get(place, 0) + 1
                careful = 1 if deaths[place] > 1 or worker.limit == 1 else 0
                if deaths[place] >= MOST_DEATHS and worker.limit == 1:
                    yield failed_part(plan, place, f"the worker died, {_cause(worker.process.returncode)}")
                    worker.span = (place + 1, worker.span[1])
            rest = worker.span
            if careful and rest[0] < rest[1]:
                again: Span | None = rest
            else:
                spans.give_back(lane, *rest)
                again = spans.take(lane)
            if again is None:
                worker.close()
                del crew[lane]
                continue
            if message is None:
                crew[lane] = worker = _Worker(lane, parcel, told)
            worker.visit(again, careful)
    finally:
        for worker in crew.values():
            worker.close()


def failed_part(plan: Plan, place: int, why: str) -> Part:
    """A single point at which there is an error instead of an answer."""
    ranges, stop = plan.tile(place, place + 1, 1)
    error = hint(WorkerError(why), "visit the point in this process to see why: without workers or client")
    answers = {"": Encoded(None, np.zeros([1] * len(plan.shape)), {0: error})}
    return Part(ranges, place, stop, answers, None, 0, 0, 0.0)


def _cause(code: int | None) -> str:
    if code is None or code >= 0:
        return f"exit status {code}"
    import signal

    try:
        return f"killed by {signal.Signals(-code).name}"
    except ValueError:
        return f"killed by signal {-code}"
