"""Heralds: one thread that tells readers of edits, so that whoever edits never waits for them.

Edits that follow each other closely are told together.
"""

import contextlib
import threading
from typing import Any
from weakref import WeakSet

from reactive4d.engine.engines import engine

__all__ = ["Herald", "herald"]

PAUSE = 0.005  # seconds in which further edits may come
CALM = 0.25  # seconds without an edit, after which it is found out whether the times are others
IDLE = 10.0  # seconds after which a thread ends that has nothing to do


class Herald:
    """Tells the readers of models what became stale.

    >>> Herald().is_awake
    False
    """

    def __init__(self) -> None:
        self._models: WeakSet[Any] = WeakSet()
        self._heard = threading.Event()
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None
        self._is_listening = False
        self._rests = False

    @property
    def is_awake(self) -> bool:
        """Whether its thread runs."""
        return self._thread is not None

    def announce(self, model: Any) -> None:
        """Tell the readers of one more model."""
        with self._lock:
            self._models.add(model)
            is_first, self._is_listening = not self._is_listening, True
        if is_first:
            engine.listen(self._heard_of)

    def _heard_of(self) -> None:
        """Something was edited; the engine's lock is held, so nothing but this is done here."""
        if not self._models:
            return
        self._heard.set()
        if self._thread is None:
            self._wake()

    def rest(self) -> None:
        """Tell nothing unasked from now on, and start no thread: for who edits nothing, or may have no threads."""
        with self._lock:
            self._is_listening = self._rests = True

    def wake(self) -> None:
        """Tell now, on the herald's own thread."""
        self._heard.set()
        self._wake()

    def _wake(self) -> None:
        with self._lock:
            if self._thread is None and not self._rests:
                self._thread = threading.Thread(target=self._run, name="reactive4d-herald", daemon=True)
                self._thread.start()

    def _run(self) -> None:
        pause = threading.Event()
        is_calm = True
        while True:
            if not self._heard.wait(IDLE if is_calm else CALM):
                if not is_calm:
                    is_calm = True
                    self._let("follow_keys")
                    continue
                with self._lock:
                    if not self._heard.is_set():
                        self._thread = None
                        return
            pause.wait(PAUSE)
            self._heard.clear()
            is_calm = False
            self.tell()

    def tell(self) -> None:
        """Tell all readers of all models, on the thread that asks."""
        self._let("refresh")

    def _let(self, look: str) -> None:
        """Let each model look at what was edited, and tell its readers."""
        for model in list(self._models):
            # What goes wrong with one model is told to whoever asks it; the others go on.
            with contextlib.suppress(Exception):
                getattr(model, look)()
            for reader in model.readers:
                with contextlib.suppress(Exception):
                    reader.flush()


herald = Herald()
