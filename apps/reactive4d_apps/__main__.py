"""The command line: `reactive4d`."""

import argparse
import importlib.metadata
import math
import os
import shutil
import sys
from collections.abc import Iterable, Sequence

from reactive4d.errors import Reactive4dError
from reactive4d_apps import demo

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
    try:
        _show(demo.story(words.times, wind=words.wind, width=shutil.get_terminal_size().columns))
    except Reactive4dError as error:
        print("reactive4d:", error, *getattr(error, "__notes__", ()), sep="\n  ", file=sys.stderr)
        return 1
    except BrokenPipeError:
        # Whoever read has read enough; what is still in the buffer goes nowhere instead of failing at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="reactive4d", description="Models that can be asked for any instant.")
    version = importlib.metadata.version("reactive4d")
    parser.add_argument("--version", action="version", version=f"reactive4d {version}")
    commands = parser.add_subparsers(dest="command", metavar="command", title="commands")
    about = "ask a small animated model for a few instants"
    shown = commands.add_parser("demo", help=about, description=f"{about.capitalize()} and print what it answers.")
    default = " ".join(f"{t:g}" for t in demo.TIMES)
    shown.add_argument(
        "--times",
        type=_number,
        nargs="+",
        default=demo.TIMES,
        metavar="T",
        help=f"instants, seconds (default {default})",
    )
    shown.add_argument("--wind", type=_number, default=1.0, metavar="W", help="the reader's parameter (default 1)")
    return parser


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
