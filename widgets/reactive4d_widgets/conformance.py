"""Conformance vectors: tracks, and what they answer at awkward times. Every viewer must agree with them.

    python -m reactive4d_widgets.conformance widgets/js/test/fixtures/conformance.json

A number in a value may be "inf", "-inf" or "nan". Where a point is `exact`, the answer is the very float; else it may
differ by 1e-9 of max(1, |value|), of matrices by 1e-6.
"""

import json
import math
import random
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from reactive4d.signals.trees import is_a
from reactive4d_widgets.lowering.examples import matrices, tracks
from reactive4d_widgets.lowering.numerals import array_of
from reactive4d_widgets.lowering.playing import play

__all__ = ["vectors", "write"]

_FAR = (-1e6, -0.0, 1e6)
_MOST_BORDERS = 6
_RANDOM = 3


def vectors() -> dict[str, Any]:
    """All vectors, as they are written.

    >>> sorted(vectors())
    ['matrices', 'tracks']
    """
    return {
        "tracks": [_described(name, track, given) for name, track, given in tracks()],
        "matrices": [_described(name, track, given) for name, track, given in matrices()],
    }


def write(path: Path) -> None:
    """Write all vectors into a file."""
    listed = {
        group: [json.dumps(entry, separators=(",", ":"), allow_nan=False) for entry in entries]
        for group, entries in vectors().items()
    }
    parts = [f'"{group}":[\n' + ",\n".join(lines) + "\n]" for group, lines in listed.items()]
    path.write_text("{" + ",\n".join(parts) + "}\n", encoding="utf-8")


def _described(name: str, track: dict[str, Any], given: list[dict[str, Any]]) -> dict[str, Any]:
    is_moving = len(given) == 1 or '"time"' in json.dumps(track)
    times = list(_times(name, track)) if is_moving else [(0.5, False)]
    points = [
        {"t": t, "parameters": parameters, "value": _told(play(track, t, parameters)), "exact": is_exact}
        for parameters in given
        for t, is_exact in times
    ]
    return {"name": name, "track": track, "points": points}


def _times(name: str, track: dict[str, Any]) -> Iterator[tuple[float, bool]]:
    """Awkward times: borders and their neighbours, far away, the negative zero, and some between; which are exact."""
    borders = sorted(set(_borders(track)))
    chance = random.Random(name)
    if len(borders) > _MOST_BORDERS:
        borders = [borders[0], *sorted(chance.sample(borders[1:-1], _MOST_BORDERS - 2)), borders[-1]]
    low, high = (borders[0], borders[-1]) if borders else (-2.0, 4.0)
    keyed = set(_keys(track))
    is_held = track["kind"] in ("const", "stepped")
    near = [x for t in borders for x in (math.nextafter(t, -math.inf), t, math.nextafter(t, math.inf))]
    between = [round(chance.uniform(low - 1.0, high + 1.0), 6) for _ in range(_RANDOM)]
    for t in (*near, *between, *_FAR):
        yield t, is_held or t in keyed


def _keys(track: dict[str, Any]) -> list[float]:
    """The times at which a track meets its keys to the last bit."""
    return array_of(track["times"]).tolist() if track["kind"] in ("poly", "slerp") else []


def _borders(x: Any) -> Iterator[float]:
    """All times that stand in a track."""
    if is_a(x, dict):
        if "times" in x:
            times: Any = x["times"]
            yield from [t for t in times if t is not None] if is_a(times, list) else array_of(times).tolist()
        if x.get("kind") == "repeat":
            yield from (x["start"] + k * x["period"] for k in (-1, 0, 1, 2))
        for part in x.values():
            yield from _borders(part)
    elif is_a(x, list):
        for part in x:
            yield from _borders(part)


def _told(value: Any) -> Any:
    """A value in JSON; what is not finite in words."""
    if is_a(value, np.ndarray):
        return [_told(x) for x in value.tolist()]
    if isinstance(value, float) and not math.isfinite(value):
        return "nan" if value != value else "inf" if value > 0 else "-inf"
    return value


if __name__ == "__main__":
    write(Path(sys.argv[1]))
