"""Builds: a folder of Markdown becomes a site that opens from the disk."""

import importlib.metadata
import json
import sys
import time
from collections.abc import Generator, Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

import reactive4d
import reactive4d_apps
import reactive4d_widgets
from reactive4d.errors import Reactive4dError, UnknownNameError, hint
from reactive4d.geometry.files import put
from reactive4d_apps.books.editions import edition_of, tools_of
from reactive4d_apps.books.locks import Lock
from reactive4d_apps.books.runs import run
from reactive4d_apps.phrases import paragraph, sized

__all__ = ["EDITION", "FIGURES", "TREES", "Build", "built", "made", "making", "need", "source_of", "standing"]

TREES = "doctrees"
FIGURES = "figures-{}.json"  # among them, for each of Sphinx's builders
EDITION = "edition.txt"  # of what was built whole
DRAFT = " without pictures"
ELSEWHERE = " in "  # another folder than that of what stands
PAUSE = 0.2  # seconds between two looks whether somebody else is done
_PACKAGES = {
    package.__name__: Path(str(package.__file__)).parent
    for package in (reactive4d, reactive4d_apps, reactive4d_widgets)
}


@dataclass(frozen=True)
class Build:
    """What became of a book.

    Attributes:
        source: the folder of its pages.
        site: the folder of what was written.
        ok: whether it was.
        complaints: what Sphinx said: warnings and errors, one after the other, with file and line.
        figures: how many figures it has.
        size: bytes of the site.
        draft: whether the pictures that stand for its figures are still to be drawn.
    """

    source: Path
    site: Path
    ok: bool
    complaints: tuple[str, ...]
    figures: int = 0
    size: int = 0
    draft: bool = False


def need(*modules: str) -> None:
    """Make sure that libraries are installed.

    Raises:
        Reactive4dError: one is not.

    >>> need("json", "no_such_library")
    Traceback (most recent call last):
    ...
    reactive4d.errors.Reactive4dError: no_such_library is not installed
    hint: pip install 'reactive4d[book]'
    """
    for module in modules:
        if find_spec(module) is None:
            raise hint(Reactive4dError(f"{module} is not installed"), "pip install 'reactive4d[book]'")


def source_of(folder: Path) -> Path:
    """The folder of a book's pages.

    Raises:
        UnknownNameError: there is no book.
    """
    if not (folder / "conf.py").is_file():
        error = UnknownNameError(f"{folder}: there is no book (no conf.py)")
        raise hint(error, f"reactive4d book new {folder.name or 'NAME'}")
    return folder


def made(
    folder: Path,
    *,
    out: Path | None = None,
    work: Path | None = None,
    builder: str = "html",
    strict: bool = False,
) -> Build:
    """Build a book, and tell nothing on the way (see `making`)."""
    steps = making(folder, out=out, work=work, builder=builder, strict=strict)
    while True:
        try:
            next(steps)
        except StopIteration as end:
            return end.value


def making(
    folder: Path,
    *,
    out: Path | None = None,
    work: Path | None = None,
    builder: str = "html",
    strict: bool = False,
    hasty: bool = False,
) -> Generator[str, None, Build]:
    """Build a book. If another program does so in the same folder, this one waits until it is done.

    Args:
        folder: of its pages, where conf.py is.
        out: where it is written; by default `html` in the folder of its work.
        work: the folder of what is kept between builds; by default `build` in that of its pages.
        builder: of Sphinx.
        strict: whether a warning is an error.
        hasty: whether the pictures that stand for figures are left to the next build, if all has to be built.

    Returns:
        Lines that tell how far it is; and in the end what became of it.

    Raises:
        UnknownNameError: there is no book.
        Reactive4dError: Sphinx is not installed.
    """
    source = source_of(folder)
    need("sphinx", "myst_parser")
    kept = work or source / "build"
    site, trees = out or kept / builder, kept / TREES
    kept.mkdir(parents=True, exist_ok=True)
    with Lock(kept / "lock") as lock:
        if not lock.take():
            yield f"{source}: another program builds this book; this one waits until it is done."
            while not lock.take():
                time.sleep(PAUSE)
        edition = _edition(source)
        note = kept / EDITION
        place = "" if site == kept / "html" else f"{ELSEWHERE}{site.absolute()}"
        noted = _noted(kept)
        is_anew = tools_of(noted) != tools_of(edition)
        is_elsewhere = noted.partition(ELSEWHERE)[2] != place.removeprefix(ELSEWHERE)
        draft = hasty and is_anew
        words = [sys.executable, "-m", "sphinx", "-b", builder, "-d", str(trees)]
        words += [*(["-W", "--keep-going"] if strict else [])]
        # What other tools built, and what a build left that was broken off, is not built upon.
        words += [*(["--fresh-env"] if is_anew else []), *(["--write-all"] if is_anew or is_elsewhere else [])]
        words += [*(["-D", "illustration_pictures=0"] if draft else []), str(source), str(site)]
        note.unlink(missing_ok=True)
        code, complaints = yield from run(words, source, lock)
        if code == 0 or (strict and code == 1):  # it came to its end; warnings may be errors
            # What stands in the book's own folder still does after a build elsewhere of the same sources.
            put(note, (edition if noted == edition else f"{edition}{DRAFT if draft else ''}{place}").encode())
    if code != 0:
        return Build(source, site, False, complaints)
    size = sum(path.stat().st_size for path in site.rglob("*") if path.is_file())
    return Build(source, site, True, complaints, _count(trees, builder), size, draft)


def standing(folder: Path, *, work: Path) -> Build | None:
    """What was built before, of these very sources and with these very tools; None where there is none.

    Args:
        folder: of the book's pages.
        work: the folder of what was kept.
    """
    site, noted = work / "html", _noted(work)
    if noted.removesuffix(DRAFT) != _edition(folder) or not (site / "index.html").is_file():
        return None
    return Build(folder, site, True, (), _count(work / TREES, "html"), draft=noted.endswith(DRAFT))


def _edition(source: Path) -> str:
    return edition_of(source, _PACKAGES, importlib.metadata.version("reactive4d"))


def _noted(kept: Path) -> str:
    """The edition that was built last, if that build came to its end."""
    try:
        return (kept / EDITION).read_text(encoding="utf-8").strip()
    except OSError:
        return ""


def _count(trees: Path, builder: str) -> int:
    try:
        return len(json.loads((trees / FIGURES.format(builder)).read_text(encoding="utf-8")))
    except OSError:
        return 0


def built(
    folder: Path, *, out: Path | None = None, pdf: bool = False, strict: bool = False, width: int = 80
) -> Iterator[str]:
    """Build a book and tell what became of it.

    Args:
        folder: of its pages.
        out: where the site is written; by default `build/html` in the folder.
        pdf: whether it is printed as well, by Chromium.
        strict: whether a warning is an error.
        width: of the terminal, in characters.

    Returns:
        The lines.

    Raises:
        Reactive4dError: it could not be built, or there is no Chromium to print it.
    """
    build = yield from making(folder, out=out, strict=strict)
    yield from build.complaints
    if not build.ok:
        refused = Reactive4dError(f"{folder}: the book was not built")
        raise hint(refused, "what is wrong stands above") if build.complaints else refused
    count = f"{build.figures} figure{'' if build.figures == 1 else 's'}"
    yield f"{build.site / 'index.html'}: {count}, {build.size / 1e6:.1f} MB in all"
    yield from paragraph("Any browser opens it, from the disk or from any server of files, without a network.", width)
    if pdf:
        from reactive4d_apps.books.printing import printed

        path = printed(folder, out.with_suffix(".pdf") if out else folder / "build" / "book.pdf")
        yield f"{path}: {sized(path.stat().st_size)}"
