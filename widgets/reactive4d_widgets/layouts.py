"""Layouts: how the figures of a page stand in its text, and who follows whom: baked and served pages alike."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from reactive4d_widgets.figures import Shown
from reactive4d_widgets.pages import heading, joined
from reactive4d_widgets.proofs import leaders
from reactive4d_widgets.prose import Written, written

__all__ = ["Layout", "laid_out", "lead"]


@dataclass(frozen=True, slots=True)
class Layout:
    """What stands in the body of a page.

    Attributes:
        title: of the document.
        body: HTML.
        prose: the text of which it was made.
    """

    title: str
    body: str
    prose: Written


def lead(shown: Sequence[Shown], text: str) -> None:
    """Find out who follows whom: a figure may say so itself, or where it stands in the text.

    Raises:
        UnknownNameError: a leader that is not on the page, or a text that names what no figure knows.
        ShapeError: a figure that follows itself, directly or through others.
    """
    known = {figure.name: figure for figure in shown}
    follows = written(text, [replace(figure.cast(), block=str) for figure in shown]).follows
    for figure in shown:
        figure.follow = follows.get(figure.name, figure.follow)
    for name, leader in leaders({figure.name: figure.follow for figure in shown}).items():
        known[name].leader = known[leader]


def laid_out(shown: Sequence[Shown], text: str, *, title: str | None) -> Layout:
    """Put figures into a text, once it is known who leads; one that the text does not place stands below the title.

    Args:
        shown: the figures, in their order.
        text: Markdown.
        title: of the page; otherwise its first heading, or what the first figure is called.

    Raises:
        UnknownNameError: the text names what no figure knows.
    """
    casts = [figure.cast() for figure in shown]
    prose = written(text, casts)
    called = title or prose.title or shown[0].title or shown[0].table.manifest["title"]
    others = [cast.block("") for cast in casts if cast.name not in prose.placed]
    if prose.title is not None and others:
        first, _, rest = prose.html.partition("</h1>")
        body = joined([f"{first}</h1>", *others, rest.lstrip("\n")])
    else:
        body = joined([heading(called) if prose.title is None else "", *others, prose.html])
    return Layout(called, body, prose)
