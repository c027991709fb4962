"""Confinements: what a process that works for a stranger may do: compute for a while, and read some files.

The system keeps most of it: limits, and a filter of calls where it has one. What it does not, Python refuses.
"""

import contextlib
import os
import signal
import sys
from collections.abc import Callable, Collection
from pathlib import Path
from typing import Any

from reactive4d_apps.serving.calls import filtered

__all__ = ["can_confine", "confine"]

FILES = 64  # open at one time
# What nobody does who answers from a scene.
REFUSED = (
    "fcntl.",
    "ftplib.",
    "http.",
    "msvcrt.",
    "os.chdir",
    "os.chmod",
    "os.chown",
    "os.exec",
    "os.fork",
    "os.forkpty",
    "os.kill",
    "os.killpg",
    "os.link",
    "os.mkdir",
    "os.posix_spawn",
    "os.putenv",
    "os.remove",
    "os.rename",
    "os.rmdir",
    "os.spawn",
    "os.startfile",
    "os.symlink",
    "os.system",
    "os.truncate",
    "os.unsetenv",
    "os.utime",
    "pty.",
    "shutil.",
    "smtplib.",
    "socket.",
    "subprocess.",
    "tempfile.",
    "urllib.",
    "webbrowser.",
)
_WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND


def can_confine() -> bool:
    """Whether this system bounds what a process takes: Linux and macOS do, Windows does not.

    >>> can_confine() or sys.platform == "win32"
    True
    """
    return os.name == "posix" and hasattr(os, "killpg")


def confine(*, memory: int, seconds: float, folder: str | None, files: Collection[str]) -> None:
    """From now on this process may do less; there is no way back.

    Args:
        memory: bytes of addresses beyond those that it has by now.
        seconds: of computing; it ends afterwards.
        folder: of which it may read nothing but `files`.
        files: whole names, without links.
    """
    import resource

    def bound(name: str, soft: int, hard: int | None = None) -> None:
        kind = getattr(resource, name, None)
        if kind is not None:
            most = resource.getrlimit(kind)[1]
            first, last = [x if most < 0 else min(x, most) for x in (soft, soft if hard is None else hard)]
            resource.setrlimit(kind, (first, last))

    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    bound("RLIMIT_CORE", 0)
    bound("RLIMIT_FSIZE", 0)
    bound("RLIMIT_NOFILE", FILES)
    bound("RLIMIT_CPU", max(1, round(seconds)), max(1, round(seconds)) + 2)
    with contextlib.suppress(ValueError, OSError):  # macOS knows the name, and keeps no such limit
        bound("RLIMIT_AS", _addresses() + memory)
    filtered()
    sys.addaudithook(_guard(folder, frozenset(files)))


def _addresses() -> int:
    """Bytes of addresses that this process has; a guess where the system does not say."""
    try:
        return int(Path("/proc/self/statm").read_text().split()[0]) * os.sysconf("SC_PAGE_SIZE")
    except OSError:
        return 2**30


def _guard(folder: str | None, files: frozenset[str]) -> Callable[[str, tuple[Any, ...]], None]:
    """What Python calls before it does something that others would notice."""
    home = None if folder is None else str(Path(folder).resolve())
    places = {str(Path(place).resolve()) for place in (*sys.path, sys.prefix, sys.base_prefix) if place}
    # Python's own files may lie below the script's folder, but that may not lie below a place where Python looks.
    deeper = tuple(place for place in places if home is not None and _within(place, home))
    others = tuple(places.difference(deeper))
    within, resolve = _within, os.path.realpath

    def is_ours(place: str) -> bool:
        if any(within(place, one) for one in deeper):
            return True
        return not (home is not None and within(place, home)) and any(within(place, one) for one in others)

    def guard(event: str, values: tuple[Any, ...]) -> None:
        if event == "open":
            path, _, flags = values
            if isinstance(path, int):
                return
            if isinstance(flags, int) and flags & _WRITING:
                raise PermissionError("a private copy writes no files")
            place = resolve(os.fsdecode(path))
            if place not in files and not is_ours(place):
                raise PermissionError(
                    "a private copy reads the files of the script that it is a copy of, and no others"
                )
        elif event.startswith(REFUSED):
            raise PermissionError(f"a private copy may not do that: {event}")

    return guard


def _within(place: str, folder: str) -> bool:
    return place.startswith(folder if folder.endswith(os.sep) else folder + os.sep)
