"""The reference interpreter: what a track answers at a time. The viewer's own must agree with it.

Each kind of track has one function here. Numbers are floats, several numbers an array (n,), matrices (16,), row by row;
held values are themselves.
"""

import json
import math
from bisect import bisect_right
from collections.abc import Callable, Mapping
from typing import Any, Final, TypeAlias

import numpy as np

from reactive4d.signals.colors import blended_to_srgb
from reactive4d.signals.rotations import canonical_quaternions, slerp_quaternions
from reactive4d.signals.trees import is_a
from reactive4d_widgets.lowering.calculating import calculate
from reactive4d_widgets.lowering.factors import factor_matrix
from reactive4d_widgets.lowering.numerals import Array, array_of

__all__ = ["KINDS", "play", "sized"]

Track: TypeAlias = dict[str, Any]
Resolve: TypeAlias = Callable[[str], Any]
_NOBODY: Final[Mapping[str, Any]] = {}


def sized(track: Any) -> int:
    """How many bytes a track takes as it travels.

    >>> sized({"kind": "const", "value": 1})
    26
    """
    return len(json.dumps(track, separators=(",", ":"), allow_nan=False))


def play(track: Track, t: float, parameters: Mapping[str, Any] = _NOBODY, resolve: Resolve | None = None) -> Any:
    """What a track answers at a time.

    Args:
        track: as it travels.
        t: seconds.
        parameters: values of all that are named in it.
        resolve: the array that a reference stands for; without it a reference answers itself.

    Raises:
        ValueError: a kind that nobody knows.

    >>> play({"kind": "poly", "times": [0, 2], "coefficients": [1, 0.5], "degree": 1, "shape": []}, 1.0)
    1.5
    """
    return _Player(parameters, resolve).play(track, t)


class _Player:
    """Plays tracks for one reader: their parameters, and their arrays."""

    def __init__(self, parameters: Mapping[str, Any], resolve: Resolve | None) -> None:
        self.parameters = parameters
        self.resolve = resolve

    def play(self, track: Track, t: float) -> Any:
        kind = track["kind"]
        method = KINDS.get(kind)
        if method is None:
            raise ValueError(f"{kind!r} is no kind of track")
        return method(self, track, t)

    def const(self, track: Track, t: float) -> Any:
        value = track["value"]
        is_row = is_a(value, list) and value and all(type(x) in (int, float) for x in value)
        return np.array(value, dtype=np.float64) if is_row else value

    def ref(self, track: Track, t: float) -> Any:
        return track["ref"] if self.resolve is None else self.resolve(track["ref"])

    def poly(self, track: Track, t: float) -> Any:
        times = array_of(track["times"])
        shape = track["shape"]
        rows = array_of(track["coefficients"]).reshape(len(times) - 1, track["degree"] + 1, *shape)
        if "end" in track and t >= times[-1]:
            return _scalar(array_of(track["end"]).reshape(shape))
        k = min(max(bisect_right(times, t) - 1, 0), len(rows) - 1)
        s = min(max(t, times[0]), times[-1]) - times[k]
        value = rows[k, -1]
        for row in rows[k, -2::-1]:
            value = value * s + row
        return _scalar(value)

    def slerp(self, track: Track, t: float) -> Any:
        times = array_of(track["times"])
        turns = array_of(track["rotations"]).reshape(-1, 4)
        if t <= times[0] or t >= times[-1]:
            return canonical_quaternions(turns[0 if t <= times[0] else -1])
        k = bisect_right(times, t) - 1
        s = t - times[k]
        if track.get("fractions") is None:
            u = s / (times[k + 1] - times[k])
        else:
            a, b, c, d = array_of(track["fractions"]).reshape(-1, 4)[k].tolist()
            u = a + s * (b + s * (c + s * d))
        return slerp_quaternions(turns[k], turns[k + 1], u)

    def expr(self, track: Track, t: float) -> Any:
        return calculate(track["tree"], t, self.parameters, self.play)

    def cases(self, track: Track, t: float) -> Any:
        times = track["times"]
        inner: Any = times[1:-1] if is_a(times, list) else array_of(times)[1:-1]
        return self.play(track["tracks"][bisect_right(inner, t)], t)

    def repeat(self, track: Track, t: float) -> Any:
        period, start = track["period"], track["start"]
        inner = min(start + float(np.mod(t - start, period)), start + period)
        value = self.play(track["track"], inner)
        if track.get("offset") is None:
            return value
        offset = np.reshape(np.array(track["offset"], dtype=np.float64), np.shape(value))
        return _scalar(value + offset * np.floor_divide(t - start, period))

    def oklab(self, track: Track, t: float) -> Any:
        return blended_to_srgb(np.asarray(self.play(track["track"], t), dtype=np.float64))

    def product(self, track: Track, t: float) -> Any:
        matrix: Array = np.eye(4)
        for factor in track["factors"]:
            values = {
                name: self.play(part, t) if is_a(part, dict) else part
                for name, part in factor.items()
                if name != "op" and part is not None
            }
            matrix = factor_matrix(factor["op"], values, matrix) @ matrix
        return matrix.ravel()

    def samples(self, track: Track, t: float) -> Any:
        refs, x = track["refs"], (t - track["start"]) / track["step"]
        k = min(max(math.floor(x), 0), len(refs) - 1)
        here = refs[k] if self.resolve is None else self.resolve(refs[k])
        if not track.get("blend") or k + 1 == len(refs) or x <= k or self.resolve is None:
            return here
        there = self.resolve(refs[k + 1])
        return here if here.shape != there.shape else here + (there - here) * (x - k)

    def stepped(self, track: Track, t: float) -> Any:
        k = max(bisect_right(array_of(track["times"]), t) - 1, 0)
        return self.const({"value": track["values"][k]}, t)


def _scalar(value: Any) -> Any:
    return float(value) if np.ndim(value) == 0 else value


KINDS: Final[dict[str, Callable[[_Player, Track, float], Any]]] = {
    "const": _Player.const,
    "ref": _Player.ref,
    "poly": _Player.poly,
    "slerp": _Player.slerp,
    "expr": _Player.expr,
    "cases": _Player.cases,
    "repeat": _Player.repeat,
    "oklab": _Player.oklab,
    "product": _Player.product,
    "samples": _Player.samples,
    "stepped": _Player.stepped,
}
