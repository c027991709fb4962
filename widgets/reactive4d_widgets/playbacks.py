"""Playbacks: what a table says at a point, as a viewer finds it: for the text of a page, for tests, and for doubts."""

import itertools
import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from reactive4d_widgets.chunks import decode
from reactive4d_widgets.lowering import play
from reactive4d_widgets.packings import unpacked

__all__ = ["Playback"]

MISSING = object()


class Playback:
    """A table that is asked.

    Args:
        data: manifest, segments and chunks, as they stand in a page.

    >>> segment = {"channel": "a#x", "when": [None, 2], "where": {}, "track": {"kind": "const", "value": 3}}
    >>> played = Playback({"manifest": {}, "segments": [segment], "chunks": []})
    >>> played.at("a#x", 1.0), played.knows("a#x", 2.0)
    (3, False)
    """

    def __init__(self, data: Mapping[str, Any]) -> None:
        self.manifest = data["manifest"]
        self.arrays: dict[str, Any] = {}
        for chunk in data["chunks"]:
            self.arrays.update(decode(chunk))
        self.segments: dict[str, list[Mapping[str, Any]]] = {}
        for segment in unpacked(data["segments"]):
            self.segments.setdefault(segment["channel"], []).append(segment)

    def knows(self, channel: str, t: float, parameters: Mapping[str, Any] | None = None) -> bool:
        """Whether anything is said there, be it an error."""
        return self._found(channel, t, parameters or {}) is not MISSING

    def at(self, channel: str, t: float, parameters: Mapping[str, Any] | None = None) -> Any:
        """What a channel is at a point; arrays for references.

        Args:
            channel: its name.
            t: seconds.
            parameters: values of all parameters, as they travel.

        Raises:
            LookupError: nothing is said there.
            RuntimeError: an error is.
        """
        found = self._found(channel, t, parameters or {})
        if found is MISSING:
            raise LookupError(f"{channel} at t = {t} for {dict(parameters or {})}")
        return found

    def _found(self, channel: str, t: float, parameters: Mapping[str, Any]) -> Any:
        covering = [s for s in self.segments.get(channel, ()) if _covers(s["when"], t)]
        for segment in covering:
            if all(name in parameters and _same(parameters[name], value) for name, value in segment["where"].items()):
                return self._played(segment, t, parameters)
        return self._blended(covering, t, parameters)

    def _blended(self, covering: Sequence[Mapping[str, Any]], t: float, parameters: Mapping[str, Any]) -> Any:
        """Between baked values: the mean of the corners, each by how near it is."""
        near: dict[str, list[Mapping[str, Any]]] = {}
        for segment in covering:
            blend = segment.get("blend", ())
            rest = [(name, value) for name, value in segment["where"].items() if name not in blend]
            if blend and all(_same(parameters[name], value) for name, value in rest):
                near.setdefault(json.dumps([sorted(blend), sorted(segment["where"])]), []).append(segment)
        for segments in near.values():
            names = list(segments[0]["blend"])
            sides = [_sides([segment["where"][name] for segment in segments], parameters[name]) for name in names]
            if any(side is None for side in sides):
                continue
            total: Any = 0.0
            for corner in itertools.product(*[side for side in sides if side is not None]):
                ends = dict(zip(names, [value for value, _ in corner], strict=True))
                share = float(np.prod([weight for _, weight in corner]))
                fitting = [s for s in segments if all(_same(s["where"][name], end) for name, end in ends.items())]
                if not fitting:
                    break
                total = total + share * np.asarray(self._played(fitting[0], t, parameters))
            else:
                return total
        return MISSING

    def _played(self, segment: Mapping[str, Any], t: float, parameters: Mapping[str, Any]) -> Any:
        if "error" in segment:
            raise RuntimeError(segment["error"])
        track = segment["track"]
        value = play(track, t, parameters, self.arrays.__getitem__)
        return self._resolved(value) if isinstance(value, dict) else value

    def _resolved(self, named: Any) -> dict[str, Any]:
        return {name: None if ref is None else self.arrays[ref] for name, ref in named.items()}


def _covers(when: Sequence[float | None], t: float) -> bool:
    lo, hi = when
    return (lo is None or lo <= t) and (hi is None or t < hi)


def _same(a: Any, b: Any) -> bool:
    """Equal as JSON: 1 is 1.0, but true is not 1."""
    return json.dumps(_plain(a)) == json.dumps(_plain(b))


def _plain(value: Any) -> Any:
    if isinstance(value, tuple | list):
        return [_plain(part) for part in value]  # pyright: ignore[reportUnknownVariableType]
    return float(value) if isinstance(value, int | float) and not isinstance(value, bool) else value


def _sides(values: Sequence[Any], x: Any) -> list[tuple[float, float]] | None:
    """The baked values on both sides of `x`, with how much each counts; None outside of them."""
    known = sorted(set(values))
    if len(known) == 1 and known[0] == x:
        return [(known[0], 1.0)]
    for a, b in itertools.pairwise(known):
        if a <= x <= b:
            return [(a, (b - x) / (b - a)), (b, (x - a) / (b - a))]
    return None
