"""The command line: `reactive4d`."""

import argparse
import importlib.metadata
import math
import os
import shutil
import sys
from collections.abc import Iterable, Sequence

import reactive4d as r4
from reactive4d.errors import Reactive4dError
from reactive4d_apps import demo
from reactive4d_apps.shows import answers_of, show

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return its exit status: 0 when it worked, 1 when the model refused.

    Args:
        arguments: the words after the program's name; by default those that the shell gave.

    Returns:
        The exit status.

    Raises:
        SystemExit: with status 2 when the words make no sense; what is wrong with them has been said.
    """
    parser = _parser()
    words = parser.parse_args(arguments)
    if words.command is None:
        parser.print_help()
        return 0
    width = shutil.get_terminal_size().columns
    try:
        if words.command == "demo":
            _show(demo.story(words.times, width=width))
        else:
            _show(show(answers_of(r4.Scene.load(words.script)), words.at, width=width))
    except Reactive4dError as error:
        print("reactive4d:", error, *getattr(error, "__notes__", ()), sep="\n  ", file=sys.stderr)
        return 1
    except BrokenPipeError:
        # Whoever read has read enough; what is still in the buffer goes nowhere instead of failing at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except OSError as error:
        print(f"reactive4d: {error.filename}: {error.strerror}", file=sys.stderr)
        return 1
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="reactive4d", description="Models that can be asked for any instant.")
    version = importlib.metadata.version("reactive4d")
    parser.add_argument("--version", action="version", version=f"reactive4d {version}")
    commands = parser.add_subparsers(dest="command", metavar="command", title="commands")
    about = "ask a small animated scene for a few instants"
    shown = commands.add_parser("demo", help=about, description=f"{about.capitalize()} and print what it answers.")
    default = " ".join(f"{t:g}" for t in demo.TIMES)
    _add_times(shown, "--times", demo.TIMES, default)
    about = "print what the scene of a script shows at some instants"
    shown = commands.add_parser("show", help=about, description=f"{about.capitalize()}.")
    shown.add_argument("script", metavar="script.scefo", help="a script; see docs/scefo.md")
    _add_times(shown, "--at", (0.0,), "0")
    return parser


def _add_times(parser: argparse.ArgumentParser, name: str, default: Sequence[float], told: str) -> None:
    about = f"instants, seconds (default {told})"
    parser.add_argument(name, type=_number, nargs="+", default=default, metavar="T", help=about)


def _number(word: str) -> float:
    try:
        number = float(word)
    except ValueError:
        number = math.nan
    if math.isnan(number):
        raise argparse.ArgumentTypeError(f"expected a number, got {word!r}")
    return number


def _show(lines: Iterable[str]) -> None:
    text = "\n".join(lines)
    try:
        text.encode(sys.stdout.encoding or "ascii")
    except UnicodeEncodeError:
        text = text.replace("─", "-")
    print(text, flush=True)


if __name__ == "__main__":
    sys.exit(main())
