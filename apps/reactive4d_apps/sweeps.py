"""The command `reactive4d sweep`: measures of a model over a grid of parameters and times, into a file."""

import argparse
import re
import sys
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from reactive4d.errors import ParameterError, ShapeError, UnknownNameError, hint
from reactive4d_apps.phrases import paragraph
from reactive4d_apps.words import values_of

__all__ = ["add_command", "swept"]

ENDINGS = (".zarr", ".csv", ".png")


def add_command(commands: Any) -> None:
    """Add the command to those of the command line."""
    about = "ask for measures of a model at all points of a grid"
    parser: argparse.ArgumentParser = commands.add_parser(
        "sweep",
        help=about,
        description=f"{about.capitalize()} of parameters and times.",
        epilog="example: reactive4d sweep lab.py:Pendulum length=0.5:2:16 angle=10,45 time=0:10:501 "
        "--measure bob.position[2] --out sweep.zarr",
    )
    about = "a script; or a scene or an illustration in a module or a file, which runs"
    parser.add_argument("subject", metavar="file.scefo|module:Class|file.py:Class", help=about)
    about = "a parameter, or time: one value, values between commas, start:stop:count; start:stop with --latin"
    parser.add_argument("over", nargs="+", metavar="name=values", help=about)
    about = "what is asked: a path in the scene, bob.position, or height=bob.position[2]; can be given several times"
    parser.add_argument("--measure", action="append", default=[], metavar="[name=]path", help=about)
    about = (
        "sweep.zarr: a store, in which a sweep that was stopped goes on; table.csv: a line for each point; "
        "sheet.png: a picture of each point on one sheet (without it the result is printed)"
    )
    parser.add_argument("-o", "--out", type=Path, metavar="FILE", help=about)
    about = "draw so many points from the ranges, one in each part of each"
    parser.add_argument("--latin", type=_count, metavar="N", help=about)
    about = "processes that do it"
    parser.add_argument("--workers", type=_count, metavar="N", help=about)
    about = "the address of a Dask scheduler whose workers do it"
    parser.add_argument("--client", metavar="ADDRESS", help=about)
    about = "stop at the first error, instead of leaving its point out"
    parser.add_argument("--strict", action="store_true", help=about)


def swept(words: argparse.Namespace, *, width: int) -> Iterator[str]:
    """Do what the command says, and tell of it line by line.

    Args:
        words: of the command line.
        width: of the terminal, columns.

    Raises:
        UnknownNameError: there is no such parameter, object, or kind of file.
        ParameterError: a value that a parameter does not take, or cannot be read.
        ShapeError: there is nothing to measure.
    """
    from reactive4d.sweeping import SweepWarning, contact_sheet, sweep
    from reactive4d_apps.places import found

    ending = "" if words.out is None else words.out.suffix
    if ending not in ("", *ENDINGS):
        raise hint(UnknownNameError(f"{words.out}: unknown kind of file"), f"known are {', '.join(ENDINGS)}")
    over = _over(words.over, words.latin)
    measure = _measures(words.measure)
    if words.subject.partition(":")[0].endswith(".py"):
        sys.path.insert(0, str(Path(words.subject.partition(":")[0]).resolve().parent))  # for workers as well
    subject = found(words.subject)
    if ending == ".png":
        sheet = contact_sheet(subject, over=over, workers=words.workers, path=words.out)
        yield f"{words.out}: {sheet.size[0]} × {sheet.size[1]} pixels"
        return
    if not measure:
        raise hint(ShapeError("sweep: nothing to measure"), "--measure bob.position, or --out sheet.png for pictures")
    with warnings.catch_warnings(), _client(words.client) as client:
        warnings.simplefilter("ignore", SweepWarning)  # it is printed
        result = sweep(
            subject,
            over=over,
            measure=measure,
            errors="raise" if words.strict else "keep",
            workers=words.workers,
            client=client,
            checkpoint=words.out if ending == ".zarr" else None,
        )
        if ending == ".csv":
            result.to_dataframe().to_csv(words.out)
    yield from _told(result, words.out, width)


def _told(result: Any, out: Path | None, width: int) -> Iterator[str]:
    told = result.attrs
    if told["visited"]:
        done = f"{told['visited']:,} points in {told['seconds']:.3g} s, {told['hits']:.0%} from memory"
    else:
        done = f"all {told['points']:,} points were there already"
    yield f"{told['title']}: {done}"
    if told["failed"]:
        yield from paragraph(told["summary"], width)
    yield from str(result).splitlines() if out is None else [str(out)]


def _over(words: list[str], latin: int | None) -> dict[str, Any]:
    """What the words say of parameters and times."""
    from reactive4d.sweeping import latin_hypercube

    over: dict[str, Any] = {}
    ranges: dict[str, Any] = {}
    for word in words:
        name, equals, text = word.partition("=")
        if not equals or not name.isidentifier() or not text:
            error = ParameterError(f"{word!r}: expected name=values")
            raise hint(error, "length=0.5:2:16, angle=10,45 or time=3")
        if name in over or name in ranges:
            raise ParameterError(f"{name} is given twice")
        values = values_of(name, text)
        if isinstance(values, tuple):
            ranges[name] = values
        else:
            over[name] = values
    if ranges and latin is None:
        name = next(iter(ranges))
        raise hint(
            ParameterError(f"{name}: how many values?"), f"{name}=start:stop:count, or --latin 64 for all of them"
        )
    if latin is not None and not ranges:
        raise hint(ParameterError("--latin: no ranges to draw from"), "length=0.5:2 is one")
    return over if latin is None else {"sample": latin_hypercube(latin, **ranges), **over}


def _measures(words: list[str]) -> dict[str, str]:
    """Paths by name."""
    measures: dict[str, str] = {}
    for word in words:
        name, equals, path = word.partition("=")
        if not equals:
            name, path = re.sub(r"\W+", "_", word).strip("_"), word
        if name in measures:
            raise hint(ShapeError(f"two measures are called {name!r}"), f"name them: --measure other={path}")
        measures[name] = path
    return measures


def _count(word: str) -> int:
    try:
        number = int(word)
    except ValueError:
        number = 0
    if number < 1:
        raise argparse.ArgumentTypeError(f"expected a number above 0, got {word!r}")
    return number


def _client(address: str | None) -> Any:
    if address is None:
        from contextlib import nullcontext

        return nullcontext(None)
    from distributed import Client

    return Client(address)
