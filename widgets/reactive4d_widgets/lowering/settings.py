"""Settings: what becomes of a signal that was assigned to an attribute of an object or a change."""

from typing import Any

import numpy as np

from reactive4d.model.settings import Choice, Flag, Float, Held, Paint, Reference, Setting, Text, Vector
from reactive4d.signals.colors import color
from reactive4d.signals.trees import is_a
from reactive4d_widgets.lowering.elementary import vector
from reactive4d_widgets.lowering.numerals import array_of
from reactive4d_widgets.lowering.ranges import Bounds, range_of
from reactive4d_widgets.lowering.terms import (
    CODE,
    HELD,
    NUMBER,
    ROTATION,
    NotExactError,
    Term,
    applied,
    component,
    constant,
    head,
    of_track,
    polynomials,
    track_in,
)

__all__ = ["conformed", "words_of"]

_TRUTHS = ("<", "<=", ">", ">=", "==", "!=", "not", "and", "or")


def conformed(term: Term, setting: Setting[Any], bounds: Bounds) -> Term:
    """A signal's values as a setting takes them.

    Args:
        term: the signal that was assigned.
        setting: where.
        bounds: between which values the reader's parameters lie, by name.

    Raises:
        NotExactError: the setting would refuse some of them, or nobody can say that it takes them all.
    """
    if term.is_constant:
        return constant(setting.constant(setting.check(term.value)))
    if isinstance(setting, Float):
        _expect(term.shape == NUMBER and _is_within(term, setting.low, setting.high, bounds), setting)
        return term
    if isinstance(setting, Flag):
        return _truth(term, setting)
    if isinstance(setting, Vector):
        return _vector(term, setting, bounds)
    if isinstance(setting, Paint):
        return _paint(term, setting, bounds)
    if isinstance(setting, Text | Choice):
        return _words(term, setting)
    plain = isinstance(setting, Held) and (setting.accept is None or term.shape == ROTATION)
    _expect(plain or isinstance(setting, Reference), setting)
    return term


def _words(term: Term, setting: Setting[Any]) -> Term:
    """Strings; where not any will do, all that there may be are tried."""
    _expect(term.shape == HELD, setting)
    words = words_of(term.tree)
    if words is None:
        _expect(isinstance(setting, Text), setting)
    for word in words or ():
        setting.check(word)
    return term


def words_of(tree: Any) -> list[Any] | None:
    """All held values that a tree may answer; None if that is not known.

    >>> words_of(["where", ["<", ["time"], 1], "hare", ["track", {"kind": "stepped", "values": ["wolf", "snail"]}]])
    ['hare', 'wolf', 'snail']
    """
    track = track_in(tree)
    if track is not None and track["kind"] in ("stepped", "const"):
        values: list[Any] = track["values"] if track["kind"] == "stepped" else [track["value"]]
        return values
    parts = tree[2:] if head(tree) == "where" else [tree[1]] if head(tree) == "at" else None
    if track is not None and track["kind"] == "cases":
        parts = [["track", part] for part in track["tracks"]]
    if parts is None:
        return [tree] if is_a(tree, str) else None
    found = [words_of(part) for part in parts]
    return None if None in found else [word for words in found for word in words or ()]


def _expect(condition: bool, setting: Setting[Any]) -> None:
    if not condition:
        raise NotExactError(f"{setting.path} may refuse what is assigned to it")


def _is_within(term: Term, low: float, high: float, bounds: Bounds) -> bool:
    if low == -np.inf and high == np.inf:
        return True
    lowest, highest = range_of(term.tree, bounds)
    return low <= lowest and highest <= high


def _truth(term: Term, setting: Setting[Any]) -> Term:
    _expect(term.shape == NUMBER, setting)
    track = track_in(term.tree)
    if head(term.tree) in _TRUTHS:
        return term
    if track is not None and track["kind"] == "stepped":
        return of_track({**track, "values": [bool(x) for x in track["values"]]}, NUMBER)
    return applied("!=", term, constant(0.0), shape=NUMBER)


def _vector(term: Term, setting: Vector, bounds: Bounds) -> Term:
    if setting.spreads and term.shape == NUMBER:
        term = vector([term] * (setting.shape[0] or 0)) if setting.shape != (3,) else term
        _expect(_is_within(term, setting.low, setting.high, bounds), setting)
        return term
    shape = term.shape
    fits = isinstance(shape, tuple) and len(shape) == len(setting.shape)
    fits = fits and all(n in (None, m) for n, m in zip(setting.shape, shape, strict=True))
    _expect(fits and not setting.is_whole and _is_within(term, setting.low, setting.high, bounds), setting)
    return term


def _paint(term: Term, setting: Setting[Any], bounds: Bounds) -> Term:
    """Four numbers: three get their alpha, and names become colours."""
    track = track_in(term.tree)
    if term.shape == CODE:
        return applied("rgba", term, shape=(4,))
    if term.shape == HELD:
        if track is None or track["kind"] != "stepped":
            raise NotExactError(f"{setting.path}: names that are not known")
        values: list[Any] = track["values"]
        return of_track({**track, "values": [color(x).tolist() for x in values]}, (4,))
    _expect(term.shape in ((3,), (4,)) and _is_within(term, 0.0, 1.0, bounds), setting)
    if term.shape == (4,):
        return term
    if track is not None and track["kind"] == "poly":
        return _opaque(track)
    return vector([*[component(term, i) for i in range(3)], constant(1.0)])


def _opaque(track: Any) -> Term:
    """A polynomial of three components with a fourth one that is 1."""
    times = array_of(track["times"])
    rows = array_of(track["coefficients"]).reshape(len(times) - 1, track["degree"] + 1, 3)
    alpha = np.zeros((*rows.shape[:2], 1))
    alpha[:, 0] = 1.0
    end = [*array_of(track["end"]), 1.0] if "end" in track else None
    return polynomials(times.tolist(), np.concatenate([rows, alpha], axis=2), end=end, shape=(4,))
