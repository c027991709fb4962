"""The command `reactive4d book`: new, build, serve."""

import argparse
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

__all__ = ["add_command", "told"]


def add_command(commands: Any) -> None:
    """Add the command to those of the command line."""
    about = "write a book whose figures live"
    parser: argparse.ArgumentParser = commands.add_parser(
        "book", help=about, description=f"{about.capitalize()}; needs pip install 'reactive4d[book]'."
    )
    verbs = parser.add_subparsers(dest="verb", metavar="new|build|serve", required=True)

    about = "write a small book that builds at once"
    new = verbs.add_parser("new", help=about, description=f"{about.capitalize()}.")
    new.add_argument("folder", type=Path, metavar="NAME", help="the folder that is made")

    about = "make a site of a book, which opens from the disk"
    build = verbs.add_parser("build", help=about, description=f"{about.capitalize()}.")
    _add_folder(build)
    about = "where the site is written (default: build/html in the book's folder)"
    build.add_argument("-o", "--output", type=Path, metavar="FOLDER", help=about)
    build.add_argument("--pdf", action="store_true", help="print it as well, by Chromium")
    build.add_argument("-W", "--strict", action="store_true", help="take warnings for errors")

    about = "serve a book: figures are live, and pages come anew when they are saved"
    serve = verbs.add_parser("serve", help=about, description=f"{about.capitalize()}, until ctrl-C.")
    _add_folder(serve)
    serve.add_argument(
        "--port", type=int, default=0, metavar="N", help="on which it listens (default: any that is free)"
    )
    about = "to which it is bound (default 127.0.0.1: only this machine reaches it)"
    serve.add_argument("--host", default="127.0.0.1", metavar="ADDRESS", help=about)
    serve.add_argument("--no-open", dest="open", action="store_false", help="do not open a browser")


def _add_folder(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "folder", type=Path, nargs="?", default=Path(), metavar="FOLDER", help="where its conf.py is (default: here)"
    )


def told(words: argparse.Namespace, *, browser: Callable[[str], bool], width: int) -> Iterator[str]:
    """Do what the command says, and tell of it line by line.

    Args:
        words: of the command line.
        browser: what opens an address.
        width: of the terminal, in characters.
    """
    if words.verb == "new":
        from reactive4d_apps.books.projects import begun

        yield from begun(words.folder, width=width)
    elif words.verb == "build":
        from reactive4d_apps.books.builds import built

        yield from built(words.folder, out=words.output, pdf=words.pdf, strict=words.strict, width=width)
    else:
        from reactive4d_apps.books.serving import opened

        opening = browser if words.open else None
        yield from opened(words.folder, port=words.port, host=words.host, browser=opening, width=width)
