"""Galleries: the project's own book, which comes with the package, served live.

A wheel carries it built. A checkout has its sources only: there it is built when it is first wanted, and can be read
before the pictures that stand for its figures are drawn.
"""

import hashlib
import importlib.metadata
import os
import sys
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import reactive4d_apps
from reactive4d.errors import Reactive4dError, hint
from reactive4d_apps.books.builds import standing
from reactive4d_apps.books.serving import opened
from reactive4d_apps.phrases import paragraph

__all__ = ["gallery", "source", "work"]


def source() -> Path:
    """The folder of the book's pages: in the package, or beside it in a checkout.

    Raises:
        Reactive4dError: they did not come with the package.

    >>> source().joinpath("conf.py").is_file()
    True
    """
    package = Path(str(reactive4d_apps.__file__)).parent
    for folder in (package / "docs", package.parent.parent / "docs"):
        if (folder / "conf.py").is_file():
            return folder
    raise hint(
        Reactive4dError("the book did not come with the package"), "install reactive4d from its wheel or a checkout"
    )


def work(environment: Mapping[str, str] | None = None) -> Path:
    """Where the book is kept if it did not come built: in the user's folder for what can be made again.

    Args:
        environment: by default that of the process.

    >>> work({"XDG_CACHE_HOME": "/somewhere"}).as_posix().startswith("/somewhere/reactive4d/book-")
    True
    """
    known = os.environ if environment is None else environment
    if known.get("XDG_CACHE_HOME"):  # whoever sets it means it, on other systems too
        base = Path(known["XDG_CACHE_HOME"])
    elif sys.platform == "win32" and known.get("LOCALAPPDATA"):
        base = Path(known["LOCALAPPDATA"])
    else:
        base = Path.home() / ("Library/Caches" if sys.platform == "darwin" else ".cache")
    # Two checkouts may have the same version.
    place = hashlib.sha256(str(source()).encode("utf-8")).hexdigest()[:8]
    return base / "reactive4d" / f"book-{importlib.metadata.version('reactive4d')}-{place}"


def gallery(
    *,
    port: int = 0,
    host: str = "127.0.0.1",
    browser: Callable[[str], bool] | None = None,
    stay: bool | None = None,
    width: int = 80,
    rounds: int | None = None,
) -> Iterator[str]:
    """Serve the book and tell where it is; if it did not come built, it is built the first time.

    Args:
        port: 0 for any that is free.
        host: to which the server is bound.
        browser: what opens an address, and says whether it could; None to open none.
        stay: whether to wait until ctrl-C, even where no browser opened the book; by default where somebody sits at a
            terminal who could press it.
        width: of the terminal, in characters.
        rounds: how often it looks whether a page was edited; None for as long as nobody presses ctrl-C.

    Returns:
        The lines.

    Raises:
        Reactive4dError: Sphinx is not installed, or the port is taken.
    """
    folder = source()
    kept = folder / "build"  # as it came, or as `reactive4d book build` made it in a checkout
    if standing(folder, work=kept) is None:
        kept = work()
        if standing(folder, work=kept) is None:
            yield from paragraph(f"The book is built into {kept}, once for these sources.", width)
    if stay is None:
        stay = sys.stdin is not None and sys.stdin.isatty()
    where: dict[str, Any] = {"port": port, "host": host, "browser": browser, "stay": stay}
    yield from opened(folder, **where, width=width, rounds=rounds, work=kept, reading=True)
