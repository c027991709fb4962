"""Ateliers: where pictures are drawn for readers who cannot draw them: in windows that nobody sees, all in one thread.

VTK's windows belong to the thread that made them. There are only so many of them; who wants one more takes that of
whoever has not wanted a picture for the longest time, who gets another one when they come back.
"""

import threading
from collections import OrderedDict
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

__all__ = ["Atelier"]

T = TypeVar("T")


class Atelier:
    """Windows, each for one reader at one size.

    Args:
        most: windows at one time.

    Attributes:
        made: how many windows were ever made.

    >>> class Window:
    ...     def close(self) -> None: ...
    >>> atelier = Atelier(2)
    >>> me, you = object(), object()
    >>> _ = [atelier.draw((who, "small"), Window, lambda window: window) for who in (me, you, me)]
    >>> atelier.made, atelier.windows
    (2, 2)
    >>> atelier.leave(me)
    >>> atelier.leave(you)
    """

    def __init__(self, most: int) -> None:
        self.most = most
        self.made = 0
        self._open: OrderedDict[tuple[Any, ...], Any] = OrderedDict()
        self._guard = threading.Lock()
        self._thread: ThreadPoolExecutor | None = None

    @property
    def windows(self) -> int:
        """How many are open."""
        return len(self._open)

    def draw(self, key: tuple[Any, ...], make: Callable[[], Any], work: Callable[[Any], T]) -> T:
        """Do something with a window, when it is its turn.

        Args:
            key: whose window, and which one: the first is its reader.
            make: makes it, if there is none.
            work: is given the window.

        Raises:
            Exception: whatever these raise.
        """
        with self._guard:
            if self._thread is None:
                self._thread = ThreadPoolExecutor(1, "reactive4d-atelier")
            done = self._thread.submit(self._work, key, make, work)
        return done.result()

    def _work(self, key: tuple[Any, ...], make: Callable[[], Any], work: Callable[[Any], T]) -> T:
        window = self._open.get(key)
        if window is None:
            while len(self._open) >= self.most:
                self._open.popitem(last=False)[1].close()
            window = self._open[key] = make()
            self.made += 1
        self._open.move_to_end(key)
        return work(window)

    def leave(self, reader: Any) -> None:
        """A reader has gone: their windows are closed, and with the last of them the thread."""
        with self._guard:
            thread = self._thread
            if thread is None:
                return
            thread.submit(self._close, reader)
            thread.submit(self._rest)

    def _close(self, reader: Any) -> None:
        for key in [key for key in self._open if key[0] is reader]:
            self._open.pop(key).close()

    def _rest(self) -> None:
        with self._guard:
            if not self._open and self._thread is not None:
                self._thread.shutdown(wait=False)
                self._thread = None
