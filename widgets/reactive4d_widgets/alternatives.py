"""Alternatives: what a picture shows, as a text, for those who do not see it.

"A crimson sphere (bob) at (0.34, 0.00, -0.94), a light gray cylinder (rod) at (0.17, 0.00, -0.47)." What is alike is
counted, and after a handful of things the rest is only mentioned.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import ARRAY
from reactive4d.signals.colors import color, srgb_to_oklab

__all__ = ["Sight", "color_word", "described"]

Array = NDArray[np.float64]
MOST = 6  # things that are told one by one

# What people call colours, by the CSS colour that is meant.
_WORDS = {
    "black": "black", "dark gray": "#555555", "gray": "gray", "light gray": "lightgray", "white": "white",
    "red": "red", "dark red": "darkred", "crimson": "crimson", "orange": "orange", "dark orange": "#d2691e",
    "brown": "saddlebrown", "tan": "tan", "gold": "gold", "yellow": "yellow", "ivory": "ivory", "olive": "olive",
    "green": "green", "light green": "lightgreen", "bright green": "lime", "teal": "teal", "turquoise": "turquoise",
    "cyan": "cyan", "light blue": "lightblue", "sky blue": "deepskyblue", "steel blue": "steelblue", "blue": "blue",
    "navy": "navy", "violet": "violet", "purple": "purple", "magenta": "magenta", "pink": "pink",
    "gray green": "darkseagreen",
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Sight:
    """One thing that can be seen.

    Attributes:
        name: the node's.
        kind: the script name of its kind.
        drawn: as what it is drawn.
        color: (4,) sRGB; None where it has none.
        place: (3,) where the middle of it is.
        text: of a label.
    """

    name: str
    kind: str
    drawn: str
    color: Array | None
    place: Array
    text: str = ""


def color_word(value: Any) -> str:
    """The everyday word that comes nearest to a colour.

    >>> color_word(color("crimson")), color_word((0.5, 0.5, 0.52, 1.0)), color_word(color("darkgray"))
    ('crimson', 'gray', 'light gray')
    """
    red, green, blue = (round(float(part), 3) for part in value[:3])
    return _nearest(red, green, blue)


@cache
def _known() -> Array:
    return np.array([srgb_to_oklab(color(code)[:3]) for code in _WORDS.values()])


@lru_cache(maxsize=4096)
def _nearest(red: float, green: float, blue: float) -> str:
    # People name the hue; how light it is comes second.
    off = np.linalg.norm((_known() - srgb_to_oklab(np.array([red, green, blue]))) * (0.5, 1.0, 1.0), axis=1)
    return list(_WORDS)[int(off.argmin())]


def described(sights: Sequence[Sight], values: Mapping[str, Any] | None = None, *, size: float = 1.0) -> str:
    """What can be seen, in one sentence.

    Args:
        sights: in the order of the scene.
        values: named values of the scene, which end the sentence.
        size: of the scene, metres, which says how many digits are worth telling.

    >>> ball = Sight("ball", "sphere", "mesh", color("red"), np.array([1.0, 0.0, 0.5]))
    >>> described([ball], {"height": 0.5})
    'A red sphere (ball) at (1.00, 0.00, 0.50); height 0.5.'
    >>> described([])
    'Nothing is to be seen.'
    """
    digits = 0 if size >= 500 else 1 if size >= 20 else 2 if size >= 0.2 else 4
    phrases = _phrases(sights, digits)
    told = ", ".join(phrases) if phrases else "Nothing is to be seen"
    shown = [f"{name} {_number(value)}" for name, value in (values or {}).items() if _is_told(value)]
    return f"{told[:1].upper()}{told[1:]}{'; ' if shown else ''}{', '.join(shown[:MOST])}."


def _phrases(sights: Sequence[Sight], digits: int) -> list[str]:
    alike: dict[tuple[str, str], list[Sight]] = {}
    words: dict[str, str] = {}
    for sight in sights:
        words[sight.name] = "" if sight.color is None or sight.drawn == "label" else color_word(sight.color)
        if sight.drawn not in ("none", "light", "camera"):
            alike.setdefault((words[sight.name], sight.text or _noun(sight)), []).append(sight)
    phrases: list[str] = []
    for (word, _), group in alike.items():
        if len(phrases) == MOST:
            rest = sum(map(len, list(alike.values())[MOST:]))
            phrases.append(f"and {rest} more")
            break
        phrases.append(_phrase(group, word, digits))
    lights = sum(sight.drawn == "light" for sight in sights)
    if lights and phrases:
        phrases.append("lit by a light" if lights == 1 else f"lit by {lights} lights")
    return phrases


def _phrase(group: Sequence[Sight], word: str, digits: int) -> str:
    first = group[0]
    if first.text:
        return f"the label “{first.text}”"
    noun = " ".join(part for part in (word, _noun(first)) if part)
    if len(group) == 1:
        called = first.name.rpartition("/")[2]
        name = "" if called.lower() == _noun(first) else f" ({called})"
        return f"{_article(noun)} {noun}{name} at {_place(first.place, digits)}"
    places = np.array([sight.place for sight in group])
    low, high = places.min(axis=0), places.max(axis=0)
    return f"{len(group)} {noun}s between {_place(low, digits)} and {_place(high, digits)}"


def _noun(sight: Sight) -> str:
    known = {"csg": "solid", "object": "shape", "model": "shape", "ngon": "polygon"}
    return known.get(sight.kind, sight.kind.replace("_", " "))


def _article(noun: str) -> str:
    return "an" if noun[:1] in "aeiou" else "a"


def _place(place: Iterable[float], digits: int) -> str:
    numbers = [f"{round(float(x), digits) + 0.0:.{digits}f}" for x in place]
    return f"({', '.join(numbers)})"


def _is_told(value: Any) -> bool:
    return isinstance(value, int | float | np.number | str) or (isinstance(value, ARRAY) and value.size <= 3)


def _number(value: Any) -> str:
    if isinstance(value, bool | str):
        return str(value).lower() if isinstance(value, bool) else value
    if isinstance(value, ARRAY):
        return f"({', '.join([f'{x:.4g}' for x in value.ravel().tolist()])})"
    return f"{float(value):.4g}"
