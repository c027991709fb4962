"""Galleries: the project's own book, which comes with the package, served live."""

import importlib.metadata
import os
import sys
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import reactive4d_apps
from reactive4d.errors import Reactive4dError, hint
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
    """Where the book is kept once it is built: the user's folder for what can be made again.

    Args:
        environment: by default that of the process.

    >>> work({"XDG_CACHE_HOME": "/somewhere"}).as_posix().startswith("/somewhere/reactive4d/book-")
    True
    """
    known = os.environ if environment is None else environment
    if sys.platform == "win32" and known.get("LOCALAPPDATA"):
        base = Path(known["LOCALAPPDATA"])
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Caches"
    else:
        base = Path(known.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    return base / "reactive4d" / f"book-{importlib.metadata.version('reactive4d')}"


def gallery(
    *,
    port: int = 0,
    host: str = "127.0.0.1",
    browser: Callable[[str], bool] | None = None,
    width: int = 80,
    rounds: int | None = None,
) -> Iterator[str]:
    """Serve the book and tell where it is; the first time it has to be built.

    Args:
        port: 0 for any that is free.
        host: to which the server is bound.
        browser: what opens an address; None to open none.
        width: of the terminal, in characters.
        rounds: how often it looks whether a page was edited; None for as long as nobody presses ctrl-C.

    Returns:
        The lines.

    Raises:
        Reactive4dError: Sphinx is not installed, or the port is taken.
    """
    folder, kept = source(), work()
    if not (kept / "html" / "index.html").is_file():
        yield from paragraph(f"The book is built into {kept}, once; its figures take a minute or two.", width)
    kept.mkdir(parents=True, exist_ok=True)
    yield from opened(folder, port=port, host=host, browser=browser, width=width, rounds=rounds, work=kept)
