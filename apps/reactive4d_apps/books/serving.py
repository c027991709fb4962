"""Serving: a book is served while it is written: figures are live, and pages come anew when they are saved."""

import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from reactive4d.errors import Reactive4dError
from reactive4d_apps.books.builds import TREES, Build, made, making, need, standing
from reactive4d_apps.books.editions import files_of
from reactive4d_apps.phrases import paragraph

if TYPE_CHECKING:
    from reactive4d_apps.books.libraries import Library
    from reactive4d_apps.books.shelves import Shelf

__all__ = ["opened", "seen"]

PAUSE = 0.4  # seconds between two looks at the files


def seen(folder: Path, besides: Sequence[Path] = ()) -> dict[Path, tuple[int, int]]:
    """When the files of a book were written, and how large they are.

    Args:
        folder: of its pages; what a build writes there is left out.
        besides: further files.
    """
    found: dict[Path, tuple[int, int]] = {}
    for path in (*files_of(folder), *besides):
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
    stay: bool = True,
    width: int = 80,
    rounds: int | None = None,
    work: Path | None = None,
    reading: bool = False,
) -> Iterator[str]:
    """Serve a book and tell what happens.

    Args:
        folder: of its pages.
        port: 0 for any that is free.
        host: to which the server is bound.
        browser: what opens an address, and says whether it could; None to open none.
        stay: whether to wait for readers even if no browser opened the book.
        width: of the terminal, in characters.
        rounds: how often it looks at the files; None for as long as nobody presses ctrl-C.
        work: the folder of what is kept between builds; by default `build` in that of its pages.
        reading: whether whoever serves it wants to read it, not to write it: then what was built before of the same
            sources is served as it is, and the still pictures of a first build come behind.

    Returns:
        The lines, as they come.

    Raises:
        UnknownNameError: there is no book.
        Reactive4dError: it cannot be built at all, the port is taken, or a library is not installed.
    """
    need("aiohttp", "trame", "sphinx", "myst_parser")
    from reactive4d_apps.books.libraries import Library
    from reactive4d_apps.books.shelves import Shelf, entries_of
    from reactive4d_apps.serving.servers import Server

    files = seen(folder)
    kept = work or folder / "build"
    build = standing(folder, work=kept) if reading else None
    if build is None:
        build = yield from making(folder, work=kept, hasty=reading)
    yield from build.complaints
    if not build.ok:
        raise Reactive4dError(f"{folder}: the book was not built")
    trees = kept / TREES
    shelf = Shelf(entries_of(trees), folder)
    library = Library(build.site, shelf.figures, originals=shelf.originals, host=host)
    library.complain(build.complaints)
    files = {**seen(folder, shelf.files), **files}  # what was saved meanwhile is seen below
    with Server(library, host=host, port=port) as server:
        yield server.address
        is_open = browser is not None and browser(server.address)
        if not is_open and not stay:
            told = "nobody sits here who could end the server: so it ends now. With --no-open it goes on."
            yield from paragraph(f"There is no browser here to open it in, and {told}", width)
            yield "Ended."
            return
        said = "Its figures are live." if reading else "Pages come anew when they are saved."
        said = f"{said} The address is good until the server ends: press ctrl-C."
        if browser is not None and not is_open:
            said = f"There is no browser here to open it in. {said}"
        yield from paragraph(said, width)
        try:
            if build.draft:
                yield from _finished(library, shelf, folder, kept, build)
            while server.is_running and (rounds is None or rounds > 0):
                rounds = None if rounds is None else rounds - 1
                time.sleep(PAUSE)
                now = seen(folder, shelf.files)
                if now == files:
                    continue
                files = now
                build = _anew(folder, kept)
                if build.ok:
                    shelf.forget()
                    shelf = Shelf(entries_of(trees), folder)
                    library.renew(shelf.figures, build.complaints, originals=shelf.originals)
                    files = {**seen(folder, shelf.files), **now}
                else:
                    library.complain(build.complaints)
                yield from _said(build)
        except KeyboardInterrupt:
            pass
    yield "Ended."


def _finished(library: "Library", shelf: "Shelf", folder: Path, work: Path, draft: Build) -> Iterator[str]:
    """Draw the pictures of the figures, while the book is read already; open pages go on as they are."""
    build = _anew(folder, work)
    yield from [line for line in build.complaints if line not in draft.complaints]
    if build.ok:
        library.renew(shelf.figures, build.complaints, originals=shelf.originals, again=False)
        yield "All of the book is built now, with the still pictures of its figures."


def _anew(folder: Path, work: Path) -> Build:
    """Build it again; readers keep what they have where that cannot be done now."""
    try:
        return made(folder, work=work)
    except (Reactive4dError, OSError) as error:
        return Build(folder, work / "html", False, (str(error),))


def _said(build: Build) -> Iterator[str]:
    yield from build.complaints
    yield f"{time.strftime('%H:%M:%S')} {'built anew' if build.ok else 'not built: the pages stay as they are'}"
