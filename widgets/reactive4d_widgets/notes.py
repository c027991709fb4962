"""Notes: what the author of a page should know, and would otherwise see only when a reader tries it."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from reactive4d.errors import Reactive4dError
from reactive4d.illustrations import Bookmark
from reactive4d.illustrations.controls import listed
from reactive4d.model.colorings import Shade, Texture
from reactive4d.model.objects import Object
from reactive4d_widgets.figures import Shown

__all__ = ["notes"]

UNDRAWN = (Shade, Texture)
TIMES = 3


def notes(shown: Iterable[Shown], links: Iterable[tuple[str, str]]) -> tuple[str, ...]:
    """What cannot be reached on a page.

    Args:
        shown: its figures.
        links: the figures and points that its text links to.

    Returns:
        For each figure the parameters that cannot be moved, also where one is to play, the changes of surfaces that no
        page draws, and each link that does not arrive.
    """
    figures = {figure.name: figure for figure in shown}
    own = [figure for figure in figures.values() if figure.source == figure.name]
    return (
        *(note for figure in own for note in _fixed(figure)),
        *(note for figure in own for note in _idle(figure)),
        *(note for figure in own for note in _undrawn(figure)),
        *(note for name, point in dict.fromkeys(links) for note in _missed(figures[name], point)),
    )


def _entries(figure: Shown) -> Mapping[str, Any]:
    return {entry["name"]: entry for entry in figure.table.manifest["parameters"]}


def _fixed(figure: Shown) -> Iterator[str]:
    """The parameters that a page holds one value of, though a reader could drive them."""
    given = figure.plan.subject.point.parameters
    names = [n for n, entry in _entries(figure).items() if entry["grade"] == "fixed" and n in given]
    movable = [name for name in names if figure.plan.controls[name].description()["grade"] != "fixed"]
    if movable:
        told = ", ".join(f"{name}=[\N{HORIZONTAL ELLIPSIS}]" for name in movable)
        yield f"{figure.name}: readers cannot move {', '.join(movable)}; values to stop at may be given: {told}"


def _idle(figure: Shown) -> Iterator[str]:
    """A parameter that is to play, and stays where it is."""
    playing = figure.table.manifest["options"].get("playing", "time")
    if playing != "time" and _entries(figure)[playing]["grade"] == "fixed":
        yield f"{figure.name}: {playing} is to play, but the page holds one value of it"


def _undrawn(figure: Shown) -> Iterator[str]:
    """Changes that the model knows and a page does not draw."""
    found: dict[str, list[str]] = {}
    for seat in figure.plan.seats:
        changes = () if seat.object is None else _changes(figure, seat.object)
        for kind in dict.fromkeys(type(change).__name__ for change in changes if isinstance(change, UNDRAWN)):
            found.setdefault(kind, []).append(seat.name)
    for kind, names in found.items():
        yield f"{figure.name}: a page does not draw the {kind} of {', '.join(names)}; colours and opacity it does"


def _changes(figure: Shown, obj: Object) -> Iterator[Any]:
    """The changes that act on an object at some times of the page."""
    asker = figure.plan.asker
    for t in asker.span.few(TIMES):
        answer = asker.ask(obj.acting, t, {})
        for entry in () if answer.error is not None else answer.value:
            yield entry.change


def _missed(figure: Shown, point: str) -> Iterator[str]:
    """What a link asks for and will not get."""
    try:
        wanted = Bookmark.from_link(point, figure.thing, strict=True)
    except Reactive4dError as error:
        yield f"the link #{point}: {error}"
        return
    entries = _entries(figure)
    opens: Mapping[str, Any] = figure.table.manifest["point"]["parameters"]
    named = {part.partition("=")[0] for part in point.split("&")}
    given: Mapping[str, Any] = wanted.parameters
    for name, value in given.items():
        if name not in named or name not in entries:
            continue
        entry, wire = entries[name], listed(value)
        held = [opens[name]] if entry["grade"] == "fixed" else entry["stops"] if entry["grade"] == "stops" else None
        if held is not None and wire not in held:
            yield f"the link #{point}: the page holds no {name} = {wire}, only {', '.join(map(str, held))}"
