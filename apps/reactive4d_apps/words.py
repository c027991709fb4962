"""Words: what is said of parameters and times on the command line."""

from typing import Any

from reactive4d.errors import ParameterError, hint

__all__ = ["values_of"]


def values_of(name: str, text: str) -> Any:
    """Values between commas as a list, evenly spaced ones as an array, a range as a tuple, a single one as itself.

    Args:
        name: of the parameter.
        text: as in `10,45`, `0:10:501`, `0.5:2` or `3`.

    Raises:
        ParameterError: colons with something else than numbers between them.

    >>> (
    ...     values_of("length", "0.5:2:4").tolist(),
    ...     values_of("angle", "10,45"),
    ...     values_of("t", "0:4"),
    ...     values_of("on", "true"),
    ... )
    ([0.5, 1.0, 1.5, 2.0], [10, 45], (0.0, 4.0), True)
    """
    import numpy as np

    parts = text.split(":")
    if len(parts) > 1:
        try:
            start, stop = float(parts[0]), float(parts[1])
            count = int(parts[2]) if len(parts) == 3 else 0
            if len(parts) > 3 or count < (len(parts) == 3):
                raise ValueError
        except ValueError:
            error = ParameterError(f"{name}: expected start:stop:count, got {text!r}")
            raise hint(error, f"{name}=0:10:501 are 501 values from 0 to 10") from None
        if len(parts) == 2:
            return start, stop
        spaced: Any = np.linspace(start, stop, count)
        return spaced.astype(int).tolist() if _are_whole(spaced, parts) else spaced
    values = [_value(part) for part in text.split(",") if part]
    return values[0] if len(values) == 1 and "," not in text else values


def _are_whole(spaced: Any, parts: list[str]) -> bool:
    return all("." not in part for part in parts) and bool((spaced == spaced.round()).all())


def _value(text: str) -> Any:
    if text in ("true", "false"):
        return text == "true"
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text
