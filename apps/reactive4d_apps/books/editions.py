"""Editions: of which sources a book was built: a word that is another one when any of them changes.

Only the standard library is needed here: the wheel is made where nothing else is (see hatch_build.py).
"""

import hashlib
import os
from collections.abc import Iterator, Mapping
from pathlib import Path

__all__ = ["SKIPPED", "edition_of", "files_of", "tools_of"]

SKIPPED = frozenset({"build", "__pycache__", "node_modules"})


def files_of(folder: Path) -> Iterator[Path]:
    """The files in a folder and those below it, without what a build writes there and what begins with a dot."""
    for place, folders, names in os.walk(folder):
        folders[:] = sorted(name for name in folders if name not in SKIPPED and not name.startswith("."))
        for name in sorted(names):
            if not name.startswith("."):
                yield Path(place) / name


def edition_of(pages: Path, packages: Mapping[str, Path], version: str) -> str:
    """What a book is made of, in one word: the tools, and the pages.

    Args:
        pages: the folder of the book.
        packages: by their names the folders of what builds it.
        version: of that.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as place:
    ...     before = edition_of(Path(place), {}, "1")
    ...     _ = (Path(place) / "index.md").write_text("# A book")
    ...     after = edition_of(Path(place), {}, "1")
    >>> before != after, tools_of(before) == tools_of(after)
    (True, True)
    """
    # In a wheel the pages lie in one of the packages.
    tools = [
        (f"{name}/{path.relative_to(folder).as_posix()}", path)
        for name, folder in sorted(packages.items())
        for path in files_of(folder)
        if not path.is_relative_to(pages)
    ]
    own = [(path.relative_to(pages).as_posix(), path) for path in files_of(pages)]
    return f"{_digest(version, tools)}-{_digest('', own)}"


def tools_of(edition: str) -> str:
    """The part of an edition that tells of the tools."""
    return edition.partition("-")[0]


def _digest(text: str, named: list[tuple[str, Path]]) -> str:
    total = hashlib.sha256(text.encode("utf-8"))
    for name, path in sorted(named):
        try:
            content = hashlib.sha256(path.read_bytes()).digest()
        except OSError:
            continue  # removed just now
        total.update(b"\0" + name.encode("utf-8") + b"\0" + content)
    return total.hexdigest()[:32]
