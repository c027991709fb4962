"""Workers: what takes long is done in threads beside the loop of events, one thing of one reader at a time."""

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

__all__ = ["SlowError", "Turns", "Workers"]

T = TypeVar("T")


class SlowError(TimeoutError):
    """It takes longer than somebody is ready to wait; it goes on nevertheless."""


class Workers:
    """Threads that all readers share.

    Args:
        threads: how many.
    """

    def __init__(self, threads: int) -> None:
        self._pool = ThreadPoolExecutor(threads, thread_name_prefix="reactive4d-serving")

    def turns(self) -> "Turns":
        """A queue for one reader."""
        return Turns(self._pool)

    def close(self) -> None:
        """Begin nothing any more."""
        self._pool.shutdown(wait=False, cancel_futures=True)


class Turns:
    """One reader's work, which takes at most one thread; whoever comes with more waits for their turn."""

    def __init__(self, pool: ThreadPoolExecutor) -> None:
        self._pool = pool
        self._lock = asyncio.Lock()

    async def run(self, work: Callable[[], T], patience: float) -> T:
        """Do it in a thread.

        Args:
            work: what is done.
            patience: seconds, those of waiting included.

        Raises:
            SlowError: it took longer. It cannot be stopped; until it has ended this reader has no turn.
            Exception: whatever it raises.
        """
        begun = asyncio.Event()
        task = asyncio.ensure_future(self._wait_and_run(work, begun))
        try:
            return await asyncio.wait_for(asyncio.shield(task), patience)
        except TimeoutError:
            if task.done():
                return task.result()
            self._forget(task, begun)
            raise SlowError(f"no answer within {patience:g} s") from None
        except asyncio.CancelledError:
            self._forget(task, begun)
            raise

    async def _wait_and_run(self, work: Callable[[], T], begun: asyncio.Event) -> T:
        async with self._lock:
            begun.set()
            return await asyncio.get_running_loop().run_in_executor(self._pool, work)

    def _forget(self, task: "asyncio.Task[T]", begun: asyncio.Event) -> None:
        """Nobody waits for it any more: what has not begun will not."""
        if not begun.is_set():
            task.cancel()
        task.add_done_callback(_forgotten)


def _forgotten(task: "asyncio.Task[T]") -> None:
    """What it raised is nobody's."""
    if not task.cancelled():
        task.exception()
