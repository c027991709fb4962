"""Borders: what comes from a reader is checked before anybody believes it.

A message is a mapping of a few fields. Whatever it is instead, the answer is one sentence, which names the field.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from reactive4d.errors import Reactive4dError

__all__ = ["Ask", "MessageError", "channels_in", "read_ask", "read_id", "read_refs", "read_type"]

MOST_TIMES = 64  # in one ask
MOST_CHANNELS = 100_000
MOST_ASKED = 200_000  # times by channels
MOST_PARAMETERS = 1_000
MOST_REFS = 100_000
LONGEST_NAME = 1_000
LONGEST_TEXT = 10_000
LARGEST = 2**53
DIGITS = frozenset("0123456789abcdef")


class MessageError(Reactive4dError):
    """A message that is none; the text may be told to whoever sent it."""


@dataclass(frozen=True, slots=True)
class Ask:
    """What a reader wants to know.

    Attributes:
        seq: the number of the ask, which its answer bears.
        revision: what the reader knows of.
        parameters: values as they travel, by name; not yet admitted.
        times: seconds, finite.
        channels: their names; whether they exist is another matter.
        plays: whether time runs: then the ticks round a time will do.
    """

    seq: int
    revision: int
    parameters: Mapping[str, Any]
    times: tuple[float, ...]
    channels: tuple[str, ...]
    plays: bool = False


def read_type(message: Any) -> str:
    """What kind of message it is.

    Raises:
        MessageError: it is none.

    >>> read_type({"type": "ask"})
    'ask'
    """
    if not isinstance(message, dict):
        raise MessageError(f"message: expected an object, got {_kind(message)}")
    return _text(message.get("type"), "type")  # pyright: ignore[reportUnknownMemberType, reportUnknownArgumentType]


def read_id(message: Any) -> int | None:
    """The number that the reply bears; None if no reply is wanted, or if it is no number."""
    if not isinstance(message, dict):
        return None
    fields: dict[str, Any] = message  # pyright: ignore[reportUnknownVariableType]
    number = fields.get("id")
    return int(number) if number is not None and _is_whole(number) else None


def read_ask(message: Any) -> Ask:
    """An ask, checked.

    Raises:
        MessageError: a field is missing, too large, or of another type.

    >>> read_ask({"seq": 1, "revision": 1, "parameters": {"length": 2}, "times": [0.5], "channels": ["bob#matrix"]})
    Ask(seq=1, revision=1, parameters={'length': 2}, times=(0.5,), channels=('bob#matrix',), plays=False)
    """
    fields = _object(message, "ask")
    times = tuple([_time(t, f"times[{i}]") for i, t in enumerate(_list(fields.get("times"), "times", MOST_TIMES))])
    channels = channels_in(fields.get("channels"))
    if len(times) * len(channels) > MOST_ASKED:
        raise MessageError(f"ask: {len(times)} times of {len(channels)} channels are too many, at most {MOST_ASKED}")
    parameters = _object(fields.get("parameters"), "parameters")
    if len(parameters) > MOST_PARAMETERS:
        raise MessageError(f"parameters: {len(parameters)} are too many, at most {MOST_PARAMETERS}")
    return Ask(
        seq=_whole(fields.get("seq"), "seq"),
        revision=_whole(fields.get("revision"), "revision"),
        parameters={_text(name, "parameters"): _wire(value, name) for name, value in parameters.items()},
        times=times,
        channels=channels,
        plays=_truth(fields.get("plays", False), "plays"),
    )


def channels_in(value: Any) -> tuple[str, ...]:
    """Names of channels, each once, in their order.

    Raises:
        MessageError: it is no list of names.
    """
    names = [_text(name, f"channels[{i}]") for i, name in enumerate(_list(value, "channels", MOST_CHANNELS))]
    return tuple(dict.fromkeys(names))


def read_refs(message: Any) -> tuple[str, ...]:
    """The references in a message, each once.

    Raises:
        MessageError: one of them is none.

    >>> read_refs({"refs": ["0" * 32]}) == ("0" * 32,)
    True
    """
    refs = _list(_object(message, "message").get("refs"), "refs", MOST_REFS)
    for i, ref in enumerate(refs):
        if not isinstance(ref, str) or len(ref) != 32 or not DIGITS.issuperset(ref):
            raise MessageError(f"refs[{i}]: expected 32 hexadecimal digits, got {_kind(ref)}")
    return tuple(dict.fromkeys(refs))


def _object(value: Any, what: str) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise MessageError(f"{what}: expected an object, got {_kind(value)}")
    return value  # pyright: ignore[reportUnknownVariableType]


def _list(value: Any, what: str, most: int) -> list[Any]:
    if not isinstance(value, list):
        raise MessageError(f"{what}: expected a list, got {_kind(value)}")
    found: list[Any] = value  # pyright: ignore[reportUnknownVariableType]
    if len(found) > most:
        raise MessageError(f"{what}: {len(found)} are too many, at most {most}")
    return found


def _text(value: Any, what: str) -> str:
    if not isinstance(value, str) or not 0 < len(value) <= LONGEST_NAME:
        raise MessageError(f"{what}: expected a name, got {_kind(value)}")
    return value


def _time(value: Any, what: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(_float(value)):
        raise MessageError(f"{what}: expected a finite number of seconds, got {_kind(value)}")
    return float(value) + 0.0


def _float(value: int | float) -> float:
    try:
        return float(value)
    except OverflowError:
        return math.inf


def _is_whole(value: Any) -> bool:
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value <= LARGEST


def _truth(value: Any, what: str) -> bool:
    if not isinstance(value, bool):
        raise MessageError(f"{what}: expected true or false, got {_kind(value)}")
    return value


def _whole(value: Any, what: str) -> int:
    if not _is_whole(value):
        raise MessageError(f"{what}: expected a whole number, got {_kind(value)}")
    return int(value)


def _wire(value: Any, name: str) -> Any:
    """A parameter's value, as far as one can tell without its parameter."""
    if isinstance(value, list):
        parts: list[Any] = value  # pyright: ignore[reportUnknownVariableType]
        if len(parts) == 2 and all(_is_number(part) for part in parts):
            return tuple(parts)
    elif isinstance(value, str):
        if len(value) <= LONGEST_TEXT:
            return value
    elif value is None or isinstance(value, bool) or _is_number(value):
        return value
    raise MessageError(f"parameters.{name}: expected a number, a text, a truth value or a pair, got {_kind(value)}")


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(_float(value))


def _kind(value: Any) -> str:
    """What something is, short; never the thing itself, which may be endless."""
    if value is None:
        return "nothing"
    if isinstance(value, bool | float):
        return str(value).lower()
    if isinstance(value, int):
        return str(value) if abs(value) < LARGEST else "a huge number"
    if isinstance(value, str):
        return f"{value[:40]!r}{'…' if len(value) > 40 else ''}"
    return {"list": "a list", "dict": "an object"}.get(type(value).__name__, f"a {type(value).__name__}")
