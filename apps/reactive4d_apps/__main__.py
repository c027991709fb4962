"""The command line: `reactive4d`."""

import argparse
import importlib.metadata
import math
import os
import shutil
import sys
import webbrowser
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import reactive4d as r4
from reactive4d.errors import Reactive4dError
from reactive4d_apps import renders, stories, sweeps
from reactive4d_apps.books import commands as books
from reactive4d_apps.demos import demonstrated, served
from reactive4d_apps.openings import opened
from reactive4d_apps.pages import baked
from reactive4d_apps.places import found
from reactive4d_apps.shows import answers_of, show
from reactive4d_widgets.displays import has_screen

__all__ = ["main"]

LIMIT = 20.0  # MB
INTERRUPTED = 130  # as shells say it


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return its exit status: 0 when it worked, 1 when the model or the machine refused.

    Ctrl-C while it works is 130; what serves until ctrl-C has worked.

    Args:
        arguments: the words after the program's name; by default those that the shell gave.

    Returns:
        The exit status.

    Raises:
        SystemExit: with status 2 when the words make no sense; what is wrong with them has been said.
    """
    parser = _parser()
    words, more = parser.parse_known_args(arguments)
    # Parameters may stand after options as well, which argparse does not know of commands.
    if more and (words.command != "render" or any(word.startswith("-") for word in more)):
        parser.error(f"unrecognized arguments: {' '.join(more)}")
    if more:
        words.over += more
    if words.command is None:
        parser.print_help()
        return 0
    try:
        for line in _told(words, shutil.get_terminal_size().columns):
            _say(line)
    except Reactive4dError as error:
        print("reactive4d:", error, *getattr(error, "__notes__", ()), sep="\n  ", file=sys.stderr)
        return 1
    except BrokenPipeError:
        # Whoever read has read enough; what is still in the buffer goes nowhere instead of failing at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except OSError as error:
        said = f"{error.filename}: {error.strerror}" if error.filename else str(error)
        print(f"reactive4d: {said}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("reactive4d: ended by ctrl-C", file=sys.stderr)
        return INTERRUPTED
    return 0


def _told(words: argparse.Namespace, width: int) -> Iterator[str]:
    """Do what a command says, and tell of it line by line."""
    if words.command == "demo":
        if words.output is not None:
            yield from demonstrated(words.output, check=words.check, width=width)
            return
        browser, stay = (_browser(), None) if words.open else (None, True)
        yield from served(check=words.check, port=words.port, host=words.host, browser=browser, stay=stay, width=width)
    elif words.command == "bake":
        scene = r4.Scene.load(words.script)
        place = words.output or Path(words.script).with_suffix(".html").name
        yield from baked(scene, place, times=words.times, title=words.title, limit=words.limit, width=width)
    elif words.command == "serve" and words.place == "gallery":
        from reactive4d_apps.books.galleries import gallery

        browser, stay = (_browser(), None) if words.open else (None, True)
        yield from gallery(port=words.port, host=words.host, browser=browser, stay=stay, width=width)
    elif words.command == "serve":
        browser = _browser() if words.open else None
        where = {"port": words.port, "host": words.host, "editable": words.editable}
        yield from opened(found(words.place), browser=browser, width=width, **where)
    elif words.command == "book":
        yield from books.told(words, browser=_browser(), width=width)
    elif words.command == "sweep":
        yield from sweeps.swept(words, width=width)
    elif words.command == "render":
        yield from renders.rendered(words)
    elif words.script is None:
        yield from stories.story(words.at or stories.TIMES, width=width)
    else:
        yield from show(answers_of(r4.Scene.load(words.script)), words.at or (0.0,), width=width)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="reactive4d", description="Models that can be asked for any instant.")
    version = importlib.metadata.version("reactive4d")
    parser.add_argument("--version", action="version", version=f"reactive4d {version}")
    commands = parser.add_subparsers(dest="command", metavar="command", title="commands")

    about = "serve a small animated scene, and open its page"
    demo = commands.add_parser("demo", help=about, description=f"{about.capitalize()} in a browser, if there is one.")
    about = "write a page that needs no server instead, and open that"
    demo.add_argument("-o", "--output", type=Path, metavar="page.html", help=about)
    about = "draw a picture of the page instead of opening it, and end"
    demo.add_argument("--check", action="store_true", help=about)
    _add_server(demo)

    about = "make a page of a script that needs no server"
    bake = commands.add_parser("bake", help=about, description=f"{about.capitalize()}.")
    bake.add_argument("script", metavar="script.scefo", help="a script; see docs/scefo.md")
    about = "where the page is written (default: the script's name, here)"
    bake.add_argument("-o", "--output", type=Path, metavar="page.html", help=about)
    about = "the span that the page covers, seconds (default: that of the keys, else 0 to 10)"
    bake.add_argument("--times", type=_number, nargs=2, metavar=("START", "STOP"), help=about)
    bake.add_argument("--title", metavar="TEXT", help="what stands above the figure")
    about = f"a larger page is refused (default {LIMIT:g})"
    bake.add_argument("--limit", type=_positive, default=LIMIT, metavar="MB", help=about)

    about = "serve a page of a script or a class to any number of readers"
    serve = commands.add_parser("serve", help=about, description=f"{about.capitalize()}, until ctrl-C.")
    about = "a script; or a scene, an illustration or a page in a module or a file, which runs; or gallery: the book"
    serve.add_argument("place", metavar="file.scefo|module:Class|file.py:Class|gallery", help=about)
    about = "let readers edit the script, each in a copy that nobody else sees"
    serve.add_argument("--editable", action="store_true", help=about)
    _add_server(serve)

    sweeps.add_command(commands)
    books.add_command(commands)
    renders.add_command(commands)

    about = "print what the scene of a script shows at some instants"
    shown = commands.add_parser("show", help=about, description=f"{about.capitalize()}.")
    about = "a script; without one the demo's, with what it costs to ask"
    shown.add_argument("script", nargs="?", metavar="script.scefo", help=about)
    default = " ".join(f"{t:g}" for t in stories.TIMES)
    about = f"instants, seconds (default 0; {default} without a script)"
    shown.add_argument("--at", "--times", type=_number, nargs="+", metavar="T", help=about)
    return parser


def _add_server(parser: argparse.ArgumentParser) -> None:
    about = "on which it listens (default: any that is free)"
    parser.add_argument("--port", type=int, default=0, metavar="N", help=about)
    about = "to which it is bound (default 127.0.0.1: only this machine reaches it)"
    parser.add_argument("--host", default="127.0.0.1", metavar="ADDRESS", help=about)
    about = "do not open a browser"
    parser.add_argument("--no-open", dest="open", action="store_false", help=about)


def _browser() -> Callable[[str], bool]:
    """What opens an address; where nothing could be seen, nothing does."""
    return webbrowser.open if has_screen() else _nobody


def _nobody(address: str) -> bool:
    return False


def _number(word: str) -> float:
    try:
        number = float(word)
    except ValueError:
        number = math.nan
    if math.isnan(number):
        raise argparse.ArgumentTypeError(f"expected a number, got {word!r}")
    return number


def _positive(word: str) -> float:
    number = _number(word)
    if number <= 0.0:
        raise argparse.ArgumentTypeError(f"expected a number above 0, got {word!r}")
    return number


def _say(line: str) -> None:
    try:
        line.encode(sys.stdout.encoding or "ascii")
    except UnicodeEncodeError:
        line = line.replace("─", "-").encode("ascii", "replace").decode()
    print(line, flush=True)


if __name__ == "__main__":
    sys.exit(main())
