"""Copies: a reader's private copy of a figure, as the server sees it: a process that answers, or has ended."""

import contextlib
import json
import logging
import os
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from reactive4d_apps.serving.copyists import BYTES, ERROR, LENGTH, MEMORY, NOTHING
from reactive4d_apps.serving.frames import Sealed
from reactive4d_apps.serving.limits import Limits
from reactive4d_apps.serving.lines import GoneError

__all__ = ["Copy", "Original"]

LOG = logging.getLogger("reactive4d.serving")
STARTING = 60.0  # seconds; what is imported first may lie on a slow disk
# Linear algebra in one thread; little memory that is only reserved; nothing else of what the server was told.
SURROUNDINGS = {
    "LANG": "C.UTF-8",
    "MALLOC_ARENA_MAX": "1",
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    "MPLCONFIGDIR": tempfile.gettempdir(),  # it has to be there; nothing is ever written to it
}
KEPT = ("LD_LIBRARY_PATH", "DYLD_LIBRARY_PATH")


@dataclass(frozen=True, slots=True, kw_only=True)
class Original:
    """What a copy is a copy of.

    Attributes:
        name: of the figure.
        script: as it is shown first.
        folder: in which its files lie; None if it reads none.
        files: which those are: whole names.
        title: of the figure.
        times: of the figure: None, or seconds.
        options: how it is shown at first.
        values: of parameters, where it opens.
    """

    name: str
    script: str
    folder: str | None = None
    files: tuple[str, ...] = ()
    title: str | None = None
    times: tuple[float, ...] | None = None
    options: dict[str, Any] | None = None
    values: dict[str, Any] | None = None


class Copy:
    """Answers one reader, from a process of its own that begins with their first message.

    Args:
        original: what it is a copy of.
        limits: what is bounded.

    >>> copy = Copy(Original(name="ball", script=""), Limits())
    >>> reply, _ = copy.receive({"id": 1, "type": "script", "text": "object (ball) sphere;"})
    >>> reply.data
    '{"id":1,"type":"edited"}'
    >>> copy.close()
    """

    def __init__(self, original: Original, limits: Limits) -> None:
        self.original = original
        self.limits = limits
        self._process: subprocess.Popen[bytes] | None = None
        self._line: socket.socket | None = None
        self._is_closed = False
        self._lock = threading.Lock()

    @property
    def process(self) -> int | None:
        """The number of its process, if it has begun."""
        return None if self._process is None else self._process.pid

    def receive(self, message: Any, /) -> tuple[dict[str, Any] | None, list[bytes]]:
        """The reply to a message, as it travels.

        Raises:
            GoneError: it is no more.
        """
        line = self._begun()
        until = time.monotonic() + self.limits.copy_thinking
        try:
            self._send(line, message)
            return self._reply(line, until, message), []
        except TimeoutError:
            raise self._ended(f"it had no answer within {self.limits.copy_thinking:g} s") from None
        except (OSError, ValueError):
            raise self._ended() from None

    def over(self, silent: float) -> str | None:
        """Why it should be no more, if it was not asked anything for so many seconds; None if it may go on."""
        with self._lock:
            process = None if self._is_closed else self._process
        if process is not None and process.poll() is not None and silent > 0.0:
            return _why(process.returncode, self.limits)
        return f"nobody asked it for anything for {silent:.3g} s" if silent > self.limits.copy_idle else None

    def close(self) -> None:
        """End it, with all that it may have begun; nobody waits for that."""
        with self._lock:
            self._is_closed = True
            process, line = self._process, self._line
        if line is not None:
            with contextlib.suppress(OSError):
                line.shutdown(socket.SHUT_RDWR)
            line.close()
        if process is not None:
            _kill(process)
            threading.Thread(target=process.wait, name="reactive4d-copy-end", daemon=True).start()

    # -- its process -----------------------------------------------------------------------------------------------

    def _begun(self) -> socket.socket:
        with self._lock:
            if self._is_closed:
                raise GoneError("it has ended")
            if self._line is not None:
                return self._line
            ours, theirs = socket.socketpair()
            code = (
                f"import sys; sys.path.extend(path for path in {_paths()!r} if path not in sys.path); "
                f"from reactive4d_apps.serving.copyists import main; main({theirs.fileno()})"
            )
            kept = {name: os.environ[name] for name in KEPT if name in os.environ}
            complaints = tempfile.TemporaryFile()  # noqa: SIM115 - it is open as long as the process may not start
            with theirs:
                self._process = subprocess.Popen(
                    [sys.executable, "-I", "-W", "ignore", "-c", code],
                    stdin=subprocess.DEVNULL,
                    stdout=subprocess.DEVNULL,
                    stderr=complaints,
                    env={**SURROUNDINGS, **kept},
                    cwd="/",
                    pass_fds=[theirs.fileno()],
                    start_new_session=True,
                )
            self._line = ours
        try:
            self._send(ours, self._orders())
            self._reply(ours, time.monotonic() + STARTING, {})
        except (OSError, ValueError):
            complaints.seek(0)
            LOG.error("a private copy did not start: %s", complaints.read()[-2_000:].decode(errors="replace"))
            raise self._ended("it did not start") from None
        finally:
            complaints.close()
        return ours

    def _orders(self) -> dict[str, Any]:
        one, limits = self.original, self.limits
        return {
            "name": one.name,
            "title": one.title,
            "times": None if one.times is None else [*one.times],
            "options": one.options,
            "values": one.values,
            "folder": one.folder,
            "files": [*one.files],
            "letters": limits.script,
            "memory": limits.copy_memory,
            "computing": limits.copy_computing,
            "seconds": limits.copy_thinking,
        }

    def _send(self, line: socket.socket, message: Any) -> None:
        data = json.dumps(message).encode()
        line.settimeout(self.limits.copy_thinking)
        line.sendall(LENGTH.pack(len(data)) + data)

    def _reply(self, line: socket.socket, until: float, message: Any) -> dict[str, Any] | None:
        head = _taken(line, LENGTH.size + 1, until)
        (length,), kind = LENGTH.unpack(head[:-1]), head[-1]
        if length > self.limits.copy_memory:
            raise ValueError("an answer that is too large")
        data = _taken(line, length, until)
        if kind == NOTHING:
            return None
        if kind == ERROR:
            return Sealed(data.decode(), type="error", text=json.loads(data).get("text"))
        return Sealed(data if kind == BYTES else data.decode(), type=message.get("type"))

    def _ended(self, reason: str | None = None) -> GoneError:
        """End it, and say why it did."""
        with self._lock:
            was_closed, process = self._is_closed, self._process
        status: int | None = None
        if process is not None and reason is None:
            with contextlib.suppress(subprocess.TimeoutExpired):
                status = process.wait(1.0)  # it is going; with which status is known in a moment
        self.close()
        if was_closed:
            return GoneError("it has ended")
        return GoneError(reason or _why(status, self.limits))


def _why(status: int | None, limits: Limits) -> str:
    """What a status says to somebody who does not know what that is.

    >>> _why(MEMORY, Limits(copy_memory=2**29)), _why(-signal.SIGFPE, Limits())
    ('it needed more than 512 MB of memory', 'it broke (SIGFPE)')
    """
    # What is written in C ends by a signal where there is no memory left.
    if status in (MEMORY, -signal.SIGABRT, -signal.SIGBUS, -signal.SIGSEGV):
        return f"it needed more than {limits.copy_memory // 2**20} MB of memory"
    if status == -signal.SIGKILL:
        return "the system ended it"
    if status == -signal.SIGXCPU:
        return f"it computed for more than {limits.copy_computing:g} s"
    if status == -signal.SIGALRM:
        return f"it had no answer within {limits.copy_thinking:g} s"
    name = signal.Signals(-status).name if status is not None and -status in {*signal.Signals} else f"status {status}"
    return f"it broke ({name})"


def _kill(process: "subprocess.Popen[bytes]") -> None:
    with contextlib.suppress(OSError):
        os.killpg(process.pid, signal.SIGKILL)  # its group bears its number
    with contextlib.suppress(OSError):
        process.kill()


def _taken(line: socket.socket, count: int, until: float) -> bytes:
    parts = bytearray()
    while len(parts) < count:
        left = until - time.monotonic()
        if left <= 0.0:
            raise TimeoutError
        line.settimeout(left)
        part = line.recv(min(count - len(parts), 2**20))
        if not part:
            raise ConnectionError("it has ended")
        parts += part
    return bytes(parts)


def _paths() -> list[str]:
    """Where this program finds what it imports, but for wherever it happens to stand."""
    return [str(Path(place).resolve()) for place in sys.path if place]
