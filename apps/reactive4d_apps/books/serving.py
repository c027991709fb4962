"""Serving: a book is served while it is written: figures are live, and pages come anew when they are saved."""

import os
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from reactive4d.errors import Reactive4dError
from reactive4d_apps.books.builds import TREES, Build, made
from reactive4d_apps.phrases import paragraph

__all__ = ["opened", "seen"]

PAUSE = 0.4  # seconds between two looks at the files
SKIPPED = frozenset({"build", "__pycache__", "node_modules"})


def seen(folder: Path, besides: Sequence[Path] = ()) -> dict[Path, tuple[int, int]]:
    """When the files of a book were written, and how large they are.

    Args:
        folder: of its pages; what a build writes there is left out.
        besides: further files.
    """
    found: dict[Path, tuple[int, int]] = {}
    for place, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if name not in SKIPPED and not name.startswith(".")]
        for name in names:
            if not name.startswith("."):
                _note(Path(place) / name, found)
    for path in besides:
        _note(path, found)
    return found


def _note(path: Path, found: dict[Path, tuple[int, int]]) -> None:
    try:
        about = path.stat()
    except OSError:
        return
    found[path] = (about.st_mtime_ns, about.st_size)


def opened(
    folder: Path,
    *,
    port: int = 0,
    host: str = "127.0.0.1",
    browser: Callable[[str], bool] | None = None,
    width: int = 80,
    rounds: int | None = None,
    work: Path | None = None,
) -> Iterator[str]:
    """Serve a book and tell what happens.

    Args:
        folder: of its pages.
        port: 0 for any that is free.
        host: to which the server is bound.
        browser: what opens an address; None to open none.
        width: of the terminal, in characters.
        rounds: how often it looks at the files; None for as long as nobody presses ctrl-C.
        work: the folder of what is kept between builds; by default `build` in that of its pages.

    Returns:
        The lines, as they come.

    Raises:
        UnknownNameError: there is no book.
        Reactive4dError: it cannot be built at all, or the port is taken.
    """
    from reactive4d_apps.books.libraries import Library
    from reactive4d_apps.books.shelves import Shelf, entries_of
    from reactive4d_apps.serving.servers import Server

    files = seen(folder)
    kept = work or folder / "build"
    build = made(folder, work=kept)
    yield from build.complaints
    if not build.ok:
        raise Reactive4dError(f"{folder}: the book was not built")
    trees = kept / TREES
    shelf = Shelf(entries_of(trees), [folder.resolve()])
    library = Library(build.site, shelf.figures, originals=shelf.originals, host=host)
    library.complain(build.complaints)
    files.update(seen(folder, shelf.files))
    with Server(library, host=host, port=port) as server:
        yield server.address
        said = "Pages come anew when they are saved. The address is good until the server ends: press ctrl-C."
        yield from paragraph(said, width)
        if browser is not None:
            browser(server.address)
        try:
            while server.is_running and (rounds is None or rounds > 0):
                rounds = None if rounds is None else rounds - 1
                time.sleep(PAUSE)
                now = seen(folder, shelf.files)
                if now == files:
                    continue
                files = now
                build = made(folder, work=kept)
                if build.ok:
                    shelf.forget()
                    shelf = Shelf(entries_of(trees), [])
                    library.renew(shelf.figures, build.complaints, originals=shelf.originals)
                    files = {**seen(folder, shelf.files), **now}  # what was saved meanwhile is seen the next time
                else:
                    library.complain(build.complaints)
                yield from _said(build)
        except KeyboardInterrupt:
            pass
    yield "Ended."


def _said(build: Build) -> Iterator[str]:
    yield from build.complaints
    yield f"{time.strftime('%H:%M:%S')} {'built anew' if build.ok else 'not built: the pages stay as they are'}"
