"""Locks: one program at a time works in a folder; who is killed holds it no longer."""

import os
import sys
from pathlib import Path

__all__ = ["Lock"]


class Lock:
    """A file that at most one program holds; the system takes it from a program that ends.

    Args:
        path: of the file; its folder is there.

    Attributes:
        handle: of the file, which a program that was started may hold as well.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with Lock(Path(folder) / "lock") as first, Lock(Path(folder) / "lock") as second:
    ...         first.take(), second.take()
    (True, False)
    """

    def __init__(self, path: Path) -> None:
        self.handle = os.open(path, os.O_RDWR | os.O_CREAT, 0o644)

    def take(self) -> bool:
        """Try to hold it; whether it is held now. It does not wait; where files cannot be held, nobody has to."""
        try:
            if sys.platform == "win32":
                import msvcrt

                os.lseek(self.handle, 0, os.SEEK_SET)
                msvcrt.locking(self.handle, msvcrt.LK_NBLCK, 1)
            else:
                import fcntl

                fcntl.flock(self.handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except (BlockingIOError, PermissionError):
            return False
        except OSError:  # some drives of a network know no locks
            return True
        return True

    def close(self) -> None:
        """Hold it no longer."""
        os.close(self.handle)

    def __enter__(self) -> "Lock":
        return self

    def __exit__(self, *error: object) -> None:
        self.close()
