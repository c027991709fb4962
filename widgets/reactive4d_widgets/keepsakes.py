"""Keepsakes: what a notebook keeps of a figure for the days without a kernel: a picture, and the figure's own table.

Both stand in one output of the cell, in HTML: the picture, and beside it the table, the viewer and a few lines that
bring them to life where scripts may run: in a notebook that is trusted, and in the page that nbconvert writes. Where
they may not, the picture is there.
"""

import base64
import math
import time
from collections.abc import Mapping
from dataclasses import dataclass
from html import escape
from typing import Any

from reactive4d.errors import PageTooLargeError, Reactive4dError, ShapeError, hint
from reactive4d.illustrations import subject
from reactive4d_widgets.bundles import packed
from reactive4d_widgets.coverings import Coverer
from reactive4d_widgets.displays import can_draw
from reactive4d_widgets.estimates import estimated, refuse_if_too_large
from reactive4d_widgets.live import Model
from reactive4d_widgets.loaders import KEEPER
from reactive4d_widgets.pages import inert
from reactive4d_widgets.plans import Plan, planned
from reactive4d_widgets.stills import poster
from reactive4d_widgets.tables import tabulated

__all__ = ["LIMIT", "Keepsake", "kept", "limit_of", "placeholder"]

LIMIT = 2_000_000  # bytes
PATIENCE = 5.0  # seconds, of whoever did not say that the figure is to be saved
SIZE = (960, 600)
Outputs = dict[str, Any]


class _TooSlowError(Exception):
    """Nobody said that it is worth waiting for."""


def limit_of(save: Any) -> tuple[float, float]:
    """How many bytes a notebook keeps of a figure, and how many seconds that may take.

    Args:
        save: None for what is quick, True for whatever it takes, False for a picture only, or a number of bytes.

    Raises:
        ShapeError: it is something else.

    >>> limit_of(None), limit_of(False), limit_of(5e6)
    ((2000000, 5.0), (0, 0.0), (5000000.0, inf))
    """
    if save is None:
        return LIMIT, PATIENCE
    if isinstance(save, bool):
        return (LIMIT, float("inf")) if save else (0, 0.0)
    if not isinstance(save, int | float) or not save >= 0:
        raise hint(ShapeError(f"save: expected True, False or a number of bytes, got {save!r}"), "save=5e6")
    return save, float("inf")


@dataclass(frozen=True, slots=True)
class Keepsake:
    """What is kept of a figure.

    Attributes:
        plain: the figure in words.
        picture: PNG; None where none can be drawn.
        table: JSON of what the figure's viewer needs; None where it is not kept.
        note: a sentence for who sees the picture only; empty where there is nothing to say.
    """

    plain: str
    picture: bytes | None
    table: str | None
    note: str = ""

    def outputs(self, name: str) -> Outputs:
        """As an output of a cell, in all ways that it may be shown.

        Args:
            name: by which the widget finds it, to hide it.
        """
        made: Outputs = {"text/plain": self.plain}
        if self.picture is not None:
            made["image/png"] = base64.b64encode(self.picture).decode("ascii")
        if self.picture is not None or self.table is not None:
            made["text/html"] = self._html(name)
        return made

    def _html(self, name: str) -> str:
        image = f'<p class="r4d-alt">{escape(self.plain)}</p>'
        if self.picture is not None:
            source = base64.b64encode(self.picture).decode("ascii")
            style = f'width="{SIZE[0]}" style="max-width: 100%; height: auto"'
            image = f'<img alt="{escape(self.plain)}" {style} src="data:image/png;base64,{source}">'
        parts = [image]
        if self.note:
            parts.append(f"<p><small>{escape(self.note)}</small></p>")
        if self.table is not None:
            code, digest = packed()
            parts.append(f'<script type="application/json" data-r4d-table>{inert(self.table)}</script>')
            parts.append(f'<script type="text/plain" data-r4d-bundle="{digest}">{code}</script>')
            parts.append(f'<script>{KEEPER}("{escape(name)}");</script>')
        return f'<div data-r4d-poster="{escape(name)}">{"".join(parts)}</div>'


def placeholder(name: str, plain: str) -> Outputs:
    """What stands where the keepsake will, until it is made."""
    return {"text/plain": plain, "text/html": f'<div data-r4d-poster="{escape(name)}"></div>'}


def kept(
    thing: Any,
    *,
    save: Any = None,
    times: Any = None,
    title: str | None = None,
    options: Mapping[str, Any] | None = None,
) -> Keepsake:
    """What a notebook keeps of a figure, where it opens.

    Args:
        thing: what is shown.
        save: as `limit_of` has it.
        times: None for its own, (start, stop), or evenly spaced times.
        title: for a person to read.
        options: how the figure is shown at first.

    >>> import reactive4d as r4
    >>> found = kept(r4.Scene(ball=r4.Sphere(color="crimson")), save=True)
    >>> found.plain, found.table[:12], found.note
    ('Scene: A crimson sphere (ball) at (0.00, 0.00, 0.00).', '{"manifest":', '')
    """
    about = subject(thing)
    plain = f"{title or about.title}: {_alt(thing) or title or about.title}"
    picture: bytes | None = None
    if can_draw():
        try:
            picture = poster(about.thing, t=about.point.time, size=SIZE, parameters=about.values)
        except Reactive4dError:
            picture = None
    limit, patience = limit_of(save)
    if not limit:
        return Keepsake(plain, picture, None)
    table, note = _table(thing, limit, patience, {"times": times, "title": title, "options": options})
    return Keepsake(plain, picture, table, note)


def _table(thing: Any, limit: float, patience: float, settings: dict[str, Any]) -> tuple[str | None, str]:
    """The table, or why there is none."""
    until = time.monotonic() + patience

    def look() -> None:
        if time.monotonic() > until:
            raise _TooSlowError

    def survey(plan: Plan, coverer: Coverer) -> None:
        refuse_if_too_large(estimated(plan, coverer), limit, besides=len(packed()[0]))

    try:
        plan = planned(thing, times=settings.pop("times"))
        plan.asker.advance = look
        text = tabulated(plan, **settings, survey=survey).to_json()
    except _TooSlowError:
        return None, "Saved as a picture, since it takes a while to save what moves: show(save=True) takes its time."
    except PageTooLargeError as error:
        return None, _large(error.size, limit)
    except Reactive4dError:
        return None, ""
    size = len(text.encode("utf-8")) + len(packed()[0])
    return (text, "") if size <= limit else (None, _large(size, limit))


def _large(size: int, limit: float) -> str:
    wish = f"{math.ceil(1.1 * size / 1e5)}e5"
    told = f"to keep what moves takes about {size / 1e6:.2g} MB, more than {limit / 1e6:.2g} MB"
    return f"Saved as a picture: {told}; show(save={wish}) would do."


def _alt(thing: Any) -> str:
    """The text in place of the picture, where the figure opens."""
    shown = subject(thing)
    wires = shown.point.parameters
    values = {one.name: one.decode(wires[one.name]) for one in shown.controls if one.name in wires}
    return Model.of(thing).told(shown.point.time, values)
