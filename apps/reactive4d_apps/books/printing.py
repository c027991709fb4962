"""Printing: a book as one PDF, by Chromium's print."""

import re
import subprocess
import tempfile
from pathlib import Path

from reactive4d.errors import Reactive4dError, hint
from reactive4d_apps.books.builds import made
from reactive4d_apps.browsers import chromium

__all__ = ["printed"]

PATIENCE = 300  # seconds


def printed(folder: Path, path: Path, *, work: Path | None = None) -> Path:
    """Print a book: all its pages in their order, figures as their still pictures.

    Args:
        folder: of its pages.
        path: of the PDF file.
        work: the folder of what is kept between builds; by default `build` in that of its pages.

    Raises:
        Reactive4dError: there is no Chromium here, or it could not print.
    """
    browser = chromium()
    if browser is None:
        raise hint(Reactive4dError("there is no Chromium here, which prints"), "install Chromium or Google Chrome")
    with tempfile.TemporaryDirectory() as place:
        build = made(folder, out=Path(place) / "book", work=work, builder="singlehtml")
        if not build.ok:
            raise Reactive4dError(f"{folder}: the book was not built")
        page = build.site / "index.html"
        # On paper nothing lives: without scripts figures are what they show first.
        text = page.read_text(encoding="utf-8")
        page.write_text(re.sub(r"<script\b[^>]*>.*?</script>", "", text, flags=re.DOTALL), encoding="utf-8")
        path.parent.mkdir(parents=True, exist_ok=True)
        words = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer", "--no-first-run"]
        words += [
            "--disable-background-networking",
            f"--user-data-dir={place}/profile",
            f"--print-to-pdf={path.resolve()}",
        ]
        try:
            run = subprocess.run([*words, page.as_uri()], capture_output=True, text=True, timeout=PATIENCE, check=False)
        except subprocess.TimeoutExpired:
            raise Reactive4dError(f"Chromium did not print within {PATIENCE} s") from None
        if run.returncode != 0 or not path.is_file():
            raise Reactive4dError(f"Chromium did not print: {run.stderr.strip()[-500:]}")
    return path
