"""The command `reactive4d render`: a still, a film, or a model of one instant, into a file."""

import argparse
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from reactive4d.devices import device
from reactive4d.errors import ParameterError, Reactive4dError, ShapeError, TimeError, hint
from reactive4d_apps.phrases import sized
from reactive4d_apps.places import found
from reactive4d_apps.words import values_of

__all__ = ["add_command", "rendered"]


def add_command(commands: Any) -> None:
    """Add the command to those of the command line."""
    about = "write a picture, a film, or a model of one instant"
    parser: argparse.ArgumentParser = commands.add_parser(
        "render",
        help=about,
        description=f"{about.capitalize()}, by the end of the file's name.",
        epilog="example: reactive4d render lab.py:Pendulum swing.mp4 --times 0:10 --rate 30 --size 1280x720 length=1.5",
    )
    about = "a script; or a scene or an illustration in a module or a file, which runs"
    parser.add_argument("subject", metavar="file.scefo|module:Class|file.py:Class", help=about)
    about = "where it is written: .png, .mp4, .gif, .webp or .glb"
    parser.add_argument("output", type=Path, metavar="file", help=about)
    about = "a parameter: one value, or for a film values between commas or start:stop:count, one for each picture"
    parser.add_argument("over", nargs="*", default=[], metavar="name=values", help=about)
    about = "of a film, seconds (default: that of the keys, else 0 to 10)"
    parser.add_argument("--times", metavar="START:STOP", help=about)
    about = "the instant of a picture, of a model, or of a film in which a parameter plays, seconds"
    parser.add_argument("--at", type=float, metavar="T", help=about)
    parser.add_argument("--rate", type=float, metavar="N", help="pictures per second (default 25)")
    parser.add_argument("--size", metavar="WxH", help="pixels, as in 1280x720")
    about = "the name of one in the scene (default: the first that is on)"
    parser.add_argument("--camera", metavar="NAME", help=about)
    parser.add_argument("--background", metavar="COLOR", help="light, dark, or a colour")
    parser.add_argument("--no-edges", dest="edges", action="store_false", help="without creases")
    parser.add_argument("--no-shadows", dest="shadows", action="store_false", help="without shadows: quicker")
    parser.add_argument("--no-loop", dest="loop", action="store_false", help="a .gif or a .webp stops at its end")


def rendered(words: argparse.Namespace) -> Iterator[str]:
    """Do what the command says, and tell where the file is and how large it became.

    Args:
        words: of the command line.

    Raises:
        Reactive4dError: something in the words, or in the model, that is not what it should be.
        OSError: a file that cannot be read or written.
    """
    parameters = _parameters(words.over)
    options: dict[str, Any] = {
        "t": words.at,
        "rate": words.rate,
        "camera": words.camera,
        "background": words.background,
    }
    if words.times is not None:
        options["times"] = _span(words.times)
    if words.size is not None:
        options["size"] = _size(words.size)
    options = {name: value for name, value in options.items() if value is not None}
    options |= {name: False for name in ("edges", "shadows", "loop") if not getattr(words, name)}
    try:
        device("render")(found(words.subject), words.output, parameters=parameters, **options)
    except KeyboardInterrupt:
        raise Reactive4dError(f"{words.output}: stopped before it was whole, and not written") from None
    yield f"{words.output}: {sized(words.output.stat().st_size)}"


def _parameters(words: list[str]) -> dict[str, Any]:
    parameters: dict[str, Any] = {}
    for word in words:
        name, equals, text = word.partition("=")
        if not equals or not name.isidentifier() or not text:
            raise hint(ParameterError(f"{word!r}: expected name=values"), "length=1.5, or length=0.5:2:60 in a film")
        if name in parameters:
            raise ParameterError(f"{name} is given twice")
        parameters[name] = values_of(name, text)
        if isinstance(parameters[name], tuple):
            raise hint(ParameterError(f"{name}: how many values?"), f"{name}=start:stop:count")
    return parameters


def _span(text: str) -> tuple[float, float]:
    try:
        start, stop = [float(part) for part in text.split(":")]
    except ValueError:
        raise hint(TimeError(f"--times: expected START:STOP, got {text!r}"), "--times 0:10") from None
    return start, stop


def _size(text: str) -> tuple[int, int]:
    found = re.fullmatch(r"(\d+)[x×](\d+)", text)
    if found is None:
        raise hint(ShapeError(f"--size: expected WxH, got {text!r}"), "--size 1280x720")
    return int(found[1]), int(found[2])
