"""The command line: `reactive4d`."""

import argparse
import importlib.metadata
import sys
from collections.abc import Sequence

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return its exit status: 0 when it worked, 2 when the words were wrong.

    Args:
        arguments: the words after the program's name; by default those that the shell gave.

    Returns:
        The exit status.
    """
    parser = _parser()
    parser.parse_args(arguments)
    parser.print_help()
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="reactive4d", description="Models that can be asked for any instant.")
    version = importlib.metadata.version("reactive4d")
    parser.add_argument("--version", action="version", version=f"reactive4d {version}")
    return parser


if __name__ == "__main__":
    sys.exit(main())
