"""Runs: Sphinx at work, in a process of its own: how far it is, and what it complains about."""

import os
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Generator, Iterator, Sequence
from pathlib import Path
from typing import IO, Any

from reactive4d_apps.books.locks import Lock

__all__ = ["run"]

STEP = 20  # per cent between two lines
PAUSE = 3.0  # seconds after which there is one nevertheless
_COLORS = re.compile(r"\x1b\[[0-9;]*m")
_PROGRESS = re.compile(r"(reading|writing) \w+\.\.\. \[ *(\d+)%\] *(\S*)")


def run(words: Sequence[str], source: Path, lock: Lock) -> Generator[str, None, tuple[int, tuple[str, ...]]]:
    """Run Sphinx; whoever ends this ends it, too.

    Args:
        words: of its command.
        source: the folder of the book's pages.
        lock: what is held meanwhile; if this process is killed, the one that was started holds it until it ends.

    Returns:
        Lines that tell how far it is; in the end its status, and what it complained about.
    """
    held: dict[str, Any] = {} if sys.platform == "win32" else {"pass_fds": (lock.handle,)}
    with tempfile.TemporaryFile() as wrong:
        process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=wrong, env=_environment(), **held)
        assert process.stdout is not None
        try:
            last = yield from _heard(process.stdout)
            code = process.wait()
        except BaseException:
            process.terminate()
            process.wait()
            raise
        finally:
            process.stdout.close()
        wrong.seek(0)
        complaints = tuple(_complaints(wrong.read().decode("utf-8", "replace"), source))
    return code, complaints or ((last,) if code else ())


def _heard(stream: IO[bytes]) -> Generator[str, None, str]:
    """How far it is; in the end the last line."""
    line, reached, told = "", 0, time.monotonic()
    for raw in stream:
        line = _COLORS.sub("", raw.decode("utf-8", "replace")).strip() or line
        found = _PROGRESS.match(line)
        if found is None:
            continue
        percent, now = int(found[2]), time.monotonic()
        reached = min(reached, percent)  # from reading to writing
        if percent < 100 and (reached + STEP <= percent or told + PAUSE <= now):
            reached, told = percent - percent % STEP, now
            yield f"{found[1].capitalize()} the pages: {percent} % ({found[3]})"
    return line


def _environment() -> dict[str, str]:
    """Sphinx writes plain text in one language, whatever the terminal is; what can be imported here can be there."""
    paths = [path for path in sys.path if path]
    return {
        **os.environ,
        "LC_ALL": "C",  # which every machine has; then Python writes UTF-8 nevertheless
        "NO_COLOR": "1",
        "PYTHONIOENCODING": "utf-8",
        "PYTHONUNBUFFERED": "1",
        "PYTHONPATH": os.pathsep.join(paths),
    }


def _complaints(said: str, source: Path) -> Iterator[str]:
    """What Sphinx complained about, with paths as an author knows them."""
    lines = _COLORS.sub("", said).splitlines()
    own = f"{source.resolve()}{os.sep}"
    for line in lines:
        if line.strip():
            yield line.replace(own, "").rstrip()
