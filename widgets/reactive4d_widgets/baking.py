"""Baking: a scene, an illustration or a page becomes one file that needs no server.

Everything that the page can show is asked beforehand, each cell once, and written down beside the viewer.
"""

import os
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from reactive4d.errors import ShapeError, UnknownNameError, hint, unknown
from reactive4d.geometry.files import put
from reactive4d.illustrations import Figure, Page
from reactive4d.illustrations import subject as subject_of
from reactive4d.illustrations.controls import listed
from reactive4d.model.scenes import Scene
from reactive4d_widgets.bundles import packed, styles
from reactive4d_widgets.coverings import Coverer
from reactive4d_widgets.estimates import estimated, refuse_if_too_large, too_large
from reactive4d_widgets.figures import Shown, checked_options
from reactive4d_widgets.layouts import laid_out, lead
from reactive4d_widgets.notes import notes
from reactive4d_widgets.pages import document, refuse_wrong_words
from reactive4d_widgets.plans import Plan, planned
from reactive4d_widgets.progress import Bar, bar
from reactive4d_widgets.proofs import proofread
from reactive4d_widgets.reports import Report
from reactive4d_widgets.tables import tabulated

__all__ = ["LIMIT", "Report", "bake"]

LIMIT = 20_000_000
POSTER = 60_000  # bytes of a picture, about
ENDINGS = (".html", ".htm")


def bake(
    subject: Any,
    path: str | os.PathLike[str],
    *,
    times: Any = None,
    text: str = "",
    title: str | None = None,
    limit: float = LIMIT,
    progress: bool = True,
    lang: str = "en",
    theme: str = "auto",
    options: Mapping[str, Any] | None = None,
    parameters: Mapping[str, Any] | None = None,
    **values: Any,
) -> Report:
    """Write a page that needs no server: figure, player, controls, and the text around them.

    Args:
        subject: a scene, an illustration or its class, or a Page of several.
        path: of the file, .html; an old one stays until the new one is whole.
        times: None for the subject's own, (start, stop), or evenly spaced times, seconds; 30 ticks per second.
        text: Markdown; see docs/pages.md for what it may say. The figure stands above it unless it places it itself.
        title: of the page; otherwise its first heading, or what the subject is called; a plain scene is called by the
            words of the file's name.
        limit: bytes; a larger page is refused, mostly before it is asked for.
        progress: whether a bar is shown, where there is a terminal.
        lang: of the text, as in HTML.
        theme: "light", "dark", or "auto": as the reader's system is.
        options: how figures are shown at first: theme, height, loop, autoplay, edges, shading, ground, axes, grid,
            shadows, playing.
        parameters: values by name, for parameters that are called like one of these arguments.
        **values: for each parameter one value, or several: those at which a reader may stop.

    Returns:
        A report.

    Raises:
        PageTooLargeError: it would be larger than the limit, with a table of what takes the bytes.
        UnknownNameError: a parameter, an option, or something in the text that nobody knows.
        ParameterError: a value that its parameter does not admit.
        TimeError: times that are none.
        ShapeError: something else that is not what it should be.
        Reactive4dError: the scene is empty, or the viewer was not built.
        OSError: the file cannot be written; an old one stays.

    >>> import tempfile
    >>> import numpy as np
    >>> import reactive4d as r4
    >>> ball = r4.Sphere()
    >>> _ = ball.translate(r4.vec(0, 0, np.abs(np.sin(r4.time))))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     report = bake(r4.Scene(ball=ball), f"{folder}/ball.html", times=(0, 2), text="# A *ball*")
    ...     report.size == report.path.stat().st_size
    True
    """
    target = _target(path)
    page = subject if isinstance(subject, Page) else None
    prose = page.text if page is not None and not text else text
    refuse_wrong_words(prose, title, lang)
    checked_options({"theme": theme}, {})
    if options is not None and not isinstance(options, Mapping):  # pyright: ignore[reportUnnecessaryIsInstance]
        raise hint(ShapeError(f"options: expected them by name, got {options!r}"), 'options={"grid": True}')
    if not isinstance(limit, int | float) or limit != limit:  # pyright: ignore[reportUnnecessaryIsInstance]
        raise hint(ShapeError(f"limit: expected a number of bytes, got {limit!r}"), "limit=50e6, or np.inf")
    packed()  # whoever lacks the viewer is told at once
    styles()
    called = _words_of(target) if type(subject) is Scene else None
    figures = {subject_of(subject).name: Figure(subject, title=called)} if page is None else dict(page.figures)
    given = {**values, **(parameters or {})}
    _refuse_strangers(figures, given)
    orders = {name: _order(name, figure, given, times, options) for name, figure in figures.items()}
    plans = {name: order.plan for name, order in orders.items()}
    proofread(prose, plans, {name: figure.follow for name, figure in figures.items()})
    with bar(shown=progress, title=target.name) as told:
        shown = _Kitchen(limit, told).cook(orders.values())
    return _served(shown, prose, target, title=title, limit=limit, lang=lang, theme=theme)


def _target(path: str | os.PathLike[str]) -> Path:
    target = Path(path)
    if not target.name:
        raise hint(UnknownNameError(f"{os.fspath(path)!r}: a page is a file"), "'page.html'")
    if target.suffix.lower() not in ENDINGS:
        raise hint(
            UnknownNameError(f"{target.name!r}: a page is no {target.suffix or 'file without an ending'}"),
            f"{target.with_suffix('.html').name!r}; render writes pictures",
        )
    if not target.parent.is_dir():
        raise hint(FileNotFoundError(2, "no such folder", str(target.parent)), "make it first, or choose another")
    if target.is_dir():
        raise IsADirectoryError(21, "this is a folder", str(target))
    return target


def _words_of(path: Path) -> str | None:
    """The words of a file's name, the first of them with a capital."""
    words = " ".join(re.findall(r"[^\W_]+", path.stem))
    return words[:1].upper() + words[1:] or None


def _known(thing: Any) -> set[str]:
    return {control.name for control in subject_of(thing).controls}


def _refuse_strangers(figures: Mapping[str, Figure], given: Mapping[str, Any]) -> None:
    """Each parameter must be known to some figure."""
    if not figures:
        raise hint(ShapeError("a page without a figure"), 'Page("…", pendulum=Pendulum())')
    known = {name for figure in figures.values() for name in _known(figure.thing)}
    for name in given:
        if name not in known:
            raise unknown(name, known, what="parameter")


@dataclass(frozen=True, slots=True)
class _Order:
    """A figure of a page, and what is to be asked for it.

    Attributes:
        name: how it is called on the page.
        figure: what it shows.
        plan: what is to be asked.
        options: how it is shown at first.
    """

    name: str
    figure: Figure
    plan: Plan
    options: Mapping[str, Any]


def _order(
    name: str, figure: Figure, given: Mapping[str, Any], times: Any, options: Mapping[str, Any] | None
) -> _Order:
    own = dict(figure.options)
    looks: dict[str, Any] = {**(options or {}), **(own.pop("options", None) or {})}
    plan = planned(
        figure.thing,
        times=times if figure.times is None else figure.times,
        parameters=lambda known: {**{n: v for n, v in given.items() if n in known}, **own},
    )
    return _Order(name, figure, plan, checked_options(looks, plan.controls))


class _Kitchen:
    """Makes the tables of figures, one after the other."""

    def __init__(self, limit: float, told: Bar) -> None:
        self.limit = limit
        self.told = told
        self.spent = 0  # bytes

    def cook(self, orders: Collection[_Order]) -> list[Shown]:
        """The figures with their tables; those that can share one do."""
        self.spent = len(packed()[0]) + POSTER * len(orders)
        done: list[Shown] = []
        for order in orders:
            shown = self._figure(order, done)
            if shown.source == shown.name:
                self.spent += sum(shown.table.sizes.values())
            done.append(shown)
        return done

    def _figure(self, order: _Order, done: list[Shown]) -> Shown:
        name, figure, plan = order.name, order.figure, order.plan
        for other in done:
            if _can_share(plan, order.options, other):
                return Shown(name, figure.title, figure.thing, plan, other.table, other.source, figure.follow)
        plan.asker.advance = self.told.advance
        table = tabulated(
            plan,
            name=name,
            title=figure.title,
            options=order.options,
            begun=self.told.begin,
            survey=self._survey,
        )
        return Shown(name, figure.title, figure.thing, plan, table, name, figure.follow)

    def _survey(self, plan: Plan, coverer: Coverer) -> None:
        """Refuse what will be too large, and say how much is to come."""
        shares = estimated(plan, coverer)
        refuse_if_too_large(shares, self.limit, besides=self.spent)
        self.told.expect(sum(share.asks for share in shares) + 3 * len(plan.channels))


def _can_share(plan: Plan, options: Mapping[str, Any], other: Shown) -> bool:
    """Whether a figure can be shown from another one's table, opened at another point."""
    known = other.plan
    if (
        plan.subject.scene is not known.subject.scene
        or plan.span != known.span
        or plan.asker.stops != known.asker.stops
        or options != other.table.manifest["options"]
        or other.source != other.name
    ):
        return False
    for entry in other.table.manifest["parameters"]:
        name = entry["name"]
        wish = plan.controls[name].encode(plan.opens[name])
        here = other.table.manifest["point"]["parameters"][name]
        if entry["grade"] == "fixed" and listed(wish) != here:
            return False
        if entry["grade"] == "stops" and listed(wish) not in entry["stops"]:
            return False
    return True


def _served(
    shown: list[Shown], text: str, target: Path, *, title: str | None, limit: float, lang: str, theme: str
) -> Report:
    """Write the file."""
    lead(shown, text)
    if theme == "dark":
        for figure in shown:
            figure.background = theme
    for figure in shown:  # the player of a leader moves those that follow it
        times, leader = figure.table.manifest["times"], figure.leader
        while leader is not None and not times["still"]:
            leader.table.manifest["times"]["still"], leader = False, leader.leader
    layout = laid_out(shown, text, title=title)
    data = {figure.name: figure.table.to_json() for figure in shown if figure.source == figure.name}
    content = document(layout.body, data, title=layout.title, lang=lang, theme=theme).encode("utf-8")
    sizes = {
        f"{figure.name}/{channel}": size
        for figure in shown
        if figure.source == figure.name
        for channel, size in figure.table.sizes.items()
    }
    if len(content) > limit:
        raise too_large(len(content), limit, [(channel, "", size) for channel, size in sizes.items()])
    put(target, content)
    problems = tuple(problem for f in shown if f.source == f.name for problem in f.table.problems)
    asks = sum(figure.table.asks for figure in shown if figure.source == figure.name)
    largest = dict(sorted(sizes.items(), key=lambda item: -item[1]))
    return Report(target, len(content), asks, largest, problems, notes(shown, layout.prose.links))
