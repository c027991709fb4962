"""A small animated model, asked for a few instants: what it answers, how long that holds, and what it cost to ask.

::

    keys --> ball.height --> echo.height
                        `--> kite.x <-- wind
                        `--> kite.place <-- kite.x
                        `--> lamp
"""

import math
import textwrap
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import reactive4d as r4
from reactive4d_apps.tables import stacked, table

__all__ = ["TIMES", "story"]

TIMES = (0.0, 1.0, 2.5, 3.5, 5.0, 7.0)
LAST_KEY = 6.0


def model() -> tuple[r4.Keys[float], Mapping[str, r4.Signal[Any]]]:
    """A ball that falls, lies for two seconds and rises, and what follows it.

    Returns:
        The keys of the ball's height, which one edits, and the signals by name; metres and seconds.
    """
    height = r4.keys({0: 3.0, 2: 0.5, 4: 0.5, LAST_KEY: 3.0})
    wind: r4.Parameter[float] = r4.Parameter("wind", 1.0, doc="how far the kite is blown, in heights of the ball")
    x = wind * height
    return height, {
        "ball.height": height,
        "echo.height": height.delay(1.0),
        "kite.x": x,
        "kite.place": r4.vec(x, 0.0, height + 1.0),
        "lamp": r4.where(height < 1.0, "on", "off"),
    }


def story(times: Sequence[float] = TIMES, *, wind: float = 1.0, width: int = 80) -> Iterator[str]:
    """Ask the model, edit it, ask again, and tell line by line what happened.

    Args:
        times: the instants, seconds.
        wind: the reader's parameter; the model's default is 1.
        width: of the terminal, in characters.

    Returns:
        The lines, none wider than `width` where the words allow it.
    """
    height, signals = model()

    def ask(label: str, blown: float = wind) -> list[str]:
        evaluated, free = cost(signals.values(), times, wind=blown)
        return [label, str(evaluated), str(free)]

    costs = [ask("ask for all of it"), ask("ask again")]
    answers = [[seconds(t), *(answer(s, t, wind=wind) for s in signals.values())] for t in times]
    height.move(LAST_KEY, LAST_KEY + 1.0)
    costs.append(ask("move the last key"))
    height.move(LAST_KEY + 1.0, LAST_KEY)
    costs += [ask("move it back"), ask("more wind", wind + 1.0), ask("less wind again")]

    asked = len(signals) * len(times)
    yield from paragraph(
        f"{len(signals)} signals asked for {len(times)} instants: what each answers, and how long the answer holds.",
        width,
    )
    yield ""
    yield from fitting(["t", *signals], answers, width)
    yield ""
    yield from paragraph(
        f"What it cost to ask for these {asked} answers: the rules that had to be evaluated, and the answers for "
        "which none had to be.",
        width,
    )
    yield ""
    yield from fitting(["", "evaluated", "for free"], costs, width)


def cost(signals: Iterable[r4.Signal[Any]], times: Sequence[float], *, wind: float) -> tuple[int, int]:
    """How many rules ran to answer for all signals at all times, and how many answers needed none."""
    evaluated = free = 0
    for t in times:
        for signal in signals:
            with r4.log() as events:
                signal.at(t, wind=wind)
            runs = sum(event.kind == "evaluated" for event in events)
            evaluated += runs
            free += not runs
    return evaluated, free


def answer(signal: r4.Signal[Any], t: float, *, wind: float) -> str:
    """What a signal answers, and below it how long that holds."""
    value = signal.at(t, wind=wind)
    interval = signal.valid(t, wind=wind)
    return f"{shown(value)}\n{held(interval.start, interval.stop)}"


def shown(value: Any) -> str:
    """A value in a few characters.

    >>> shown(0.5), shown("off"), shown((1.0, 0.0, 2.25))
    ('0.50', 'off', '1.0 0.0 2.2')
    """
    if isinstance(value, str):
        return value
    if isinstance(value, float):
        return f"{value:.2f}"
    return " ".join(f"{component:.1f}" for component in value)


def held(start: float, stop: float) -> str:
    """How long an answer holds, in words where an end is open.

    >>> held(2.0, 4.0), held(5.0, math.inf), held(-math.inf, math.inf), held(1.0, math.nextafter(1.0, math.inf))
    ('[2, 4)', 'from 5', 'always', 'an instant')
    """
    if stop == math.nextafter(start, math.inf):
        return "an instant"
    if start == -math.inf:
        return "always" if stop == math.inf else f"until {stop:.4g}"
    return f"from {start:.4g}" if stop == math.inf else f"[{start:.4g}, {stop:.4g})"


def seconds(t: float) -> str:
    """A time as the first column shows it.

    >>> seconds(2.5)
    '2.5 s'
    """
    return f"{t:g} s"


def paragraph(text: str, width: int) -> list[str]:
    """A sentence in lines of at most `width`."""
    return textwrap.wrap(text, max(width, 20))


def fitting(head: Sequence[str], rows: Sequence[Sequence[str]], width: int) -> list[str]:
    """A table where it fits, one column after the other where it does not."""
    lines = table(head, rows)
    return lines if max(map(len, lines)) <= width else stacked(head, rows)
