"""Builds: a folder of Markdown becomes a site that opens from the disk; Sphinx does it, in a process of its own."""

import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from reactive4d.errors import Reactive4dError, UnknownNameError, hint
from reactive4d_apps.phrases import paragraph, sized

__all__ = ["FIGURES", "TREES", "Build", "built", "made", "source_of"]

TREES = "doctrees"
FIGURES = "figures-{}.json"  # among them, for each of Sphinx's builders
_COLORS = re.compile(r"\x1b\[[0-9;]*m")


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
    """

    source: Path
    site: Path
    ok: bool
    complaints: tuple[str, ...]
    figures: int = 0
    size: int = 0


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
    """Build a book.

    Args:
        folder: of its pages, where conf.py is.
        out: where it is written; by default `html` in the folder of its work.
        work: the folder of what is kept between builds; by default `build` in that of its pages.
        builder: of Sphinx.
        strict: whether a warning is an error.

    Raises:
        UnknownNameError: there is no book.
        Reactive4dError: Sphinx is not installed.
    """
    source = source_of(folder)
    if find_spec("sphinx") is None or find_spec("myst_parser") is None:
        raise hint(Reactive4dError("Sphinx and MyST are not installed"), "pip install 'reactive4d[book]'")
    kept = work or source / "build"
    site, trees = out or kept / builder, kept / TREES
    words = [sys.executable, "-m", "sphinx", "-q", "-b", builder, "-d", str(trees)]
    words += [*(["-W", "--keep-going"] if strict else []), str(source), str(site)]
    run = subprocess.run(words, capture_output=True, text=True, encoding="utf-8", errors="replace", env=_environment())
    complaints = tuple(_complaints(run.stderr, source))
    if run.returncode != 0:
        return Build(source, site, False, complaints or (run.stdout.strip(),))
    try:
        figures = len(json.loads((trees / FIGURES.format(builder)).read_text(encoding="utf-8")))
    except OSError:
        figures = 0
    size = sum(path.stat().st_size for path in site.rglob("*") if path.is_file())
    return Build(source, site, True, complaints, figures, size)


def _environment() -> dict[str, str]:
    """Sphinx writes plain text in one language, whatever the terminal is; what can be imported here can be there."""
    paths = [path for path in sys.path if path]
    return {**os.environ, "NO_COLOR": "1", "PYTHONIOENCODING": "utf-8", "PYTHONPATH": os.pathsep.join(paths)}


def _complaints(said: str, source: Path) -> Iterator[str]:
    """What Sphinx complained about, with paths as an author knows them."""
    lines = _COLORS.sub("", said).splitlines()
    own = f"{source.resolve()}{os.sep}"
    for line in lines:
        if line.strip():
            yield line.replace(own, "").rstrip()


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
    build = made(folder, out=out, strict=strict)
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
