"""How answers are told on a terminal: numbers, places, colours, and how long they hold."""

import math
import textwrap
from collections.abc import Iterable, Sequence
from typing import Any

from reactive4d.signals.colors import COLOR_NAMES
from reactive4d_apps.tables import stacked, table

__all__ = ["colored", "fitting", "held", "paragraph", "placed", "seconds", "sized"]

# Of several names the last one: cyan and magenta, but gray.
_NAMES = {code: name for name, code in sorted(COLOR_NAMES.items()) if "grey" not in name}


def placed(numbers: Iterable[float]) -> str:
    """A place or a direction.

    >>> placed((1.0, -0.001, 2.25))
    '1.00 0.00 2.25'
    """
    return " ".join([f"{round(float(x), 2) + 0.0:.2f}" for x in numbers])


def colored(rgba: Iterable[float]) -> str:
    """A colour by its name in CSS, or by its code; with how opaque it is, where light goes through.

    >>> colored((1, 1, 0, 1)), colored((0.2, 0.4, 0.6, 0.5))
    ('yellow', '#336699 50 %')
    """
    *rgb, alpha = [float(x) for x in rgba]
    code = "#" + "".join([f"{round(255 * x):02x}" for x in rgb])
    return _NAMES.get(code, code) + (f" {alpha:.0%}".replace("%", " %") if alpha < 1.0 else "")


def held(interval: Any) -> str:
    """How long an answer holds, in words where an end is open.

    >>> import reactive4d as r4
    >>> keys = r4.keys({2: 1.0, 4: 3.0})
    >>> held(keys.valid(1.0)), held(keys.valid(3.0)), held(keys.valid(9.0)), held(r4.FOREVER)
    ('until 2 s', 'an instant', 'from 4 s', 'always')
    """
    start, stop = interval.start, interval.stop
    if stop == math.nextafter(start, math.inf):
        return "an instant"
    if start == -math.inf:
        return "always" if stop == math.inf else f"until {stop:.4g} s"
    return f"from {start:.4g} s" if stop == math.inf else f"{start:.4g} to {stop:.4g} s"


def seconds(t: float) -> str:
    """A time.

    >>> seconds(2.5)
    '2.5 s'
    """
    return f"{t:g} s"


def sized(count: int) -> str:
    """A number of bytes.

    >>> sized(312), sized(812_345), sized(1_234_567)
    ('312 bytes', '812 KB', '1.2 MB')
    """
    if count < 1000:
        return f"{count} bytes"
    return f"{count / 1000:.0f} KB" if count < 1_000_000 else f"{count / 1_000_000:.1f} MB"


def paragraph(text: str, width: int) -> list[str]:
    """A sentence in lines of at most `width`."""
    return textwrap.wrap(text, max(width, 20))


def fitting(head: Sequence[str], rows: Sequence[Sequence[str]], width: int, *, left: int = 1) -> list[str]:
    """A table where it fits, one column after the other where it does not."""
    lines = table(head, rows, left=left)
    return lines if max(map(len, lines)) <= width else stacked(head, rows)
