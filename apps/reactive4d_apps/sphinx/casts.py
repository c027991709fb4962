"""Casts: what the text of a book may name of a figure: numbers, values, objects, points."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from reactive4d.errors import ParameterError, ShapeError, hint, unknown
from reactive4d.illustrations import Bookmark
from reactive4d.illustrations.controls import listed
from reactive4d_apps.sphinx.bakings import Baking
from reactive4d_widgets.figures import formatted, worded

__all__ = ["Cast", "Company"]


@dataclass(frozen=True)
class Cast:
    """A figure, as the text knows it.

    Attributes:
        name: on its page.
        baking: what it says.
        point: where it opens.
        thing: what it shows.
    """

    name: str
    baking: Baking
    point: Mapping[str, Any]
    thing: Any

    @property
    def parameters(self) -> Mapping[str, Mapping[str, Any]]:
        """What a reader drives, by name."""
        return {entry["name"]: entry for entry in self.baking.manifest["parameters"]}

    @property
    def values(self) -> Mapping[str, Mapping[str, Any]]:
        """What a reader reads, by name."""
        return {entry["name"]: entry for entry in self.baking.manifest["values"]}

    @property
    def nodes(self) -> frozenset[str]:
        """Objects and groups."""
        names: set[str] = set()
        for node in self.baking.manifest["nodes"]:
            parts = node["name"].split("/")
            names.update("/".join(parts[: i + 1]) for i in range(len(parts)))
        return frozenset(names)

    def number(self, name: str, spec: str) -> str:
        """A parameter or a value, as it reads where the figure opens.

        Raises:
            ShapeError: the format is none.
        """
        try:
            if name in self.parameters:
                return worded(self.point["parameters"][name], spec, self.parameters[name])
            entry = self.values[name]
            return formatted(self._played(f"#values.{name}"), spec or entry["format"], entry["unit"])
        except (ValueError, TypeError) as error:
            raise hint(ShapeError(f"{name}:{spec}: {error}"), "a format as in f-strings: length:.2f") from None

    def holds(self, text: str) -> None:
        """Make sure that a link arrives.

        Raises:
            UnknownNameError: it names a parameter that is not there.
            ParameterError: the page holds no such value.
        """
        wanted = Bookmark.from_link(text, self.thing, strict=True)
        named = {part.partition("=")[0] for part in text.split("&")}
        for name, value in wanted.parameters.items():
            entry, wire = self.parameters.get(name), listed(value)
            if entry is None or name not in named:
                continue
            opens = self.baking.manifest["point"]["parameters"][name]
            held = [opens] if entry["grade"] == "fixed" else entry["stops"] if entry["grade"] == "stops" else None
            if held is not None and wire not in held:
                raise ParameterError(f"the page holds no {name} = {wire}, only {', '.join(map(str, held))}")

    def _played(self, channel: str) -> Any:
        t, wires = self.point["time"], self.point["parameters"]
        try:
            return self.baking.playback.at(channel, t, wires) if self.baking.playback.knows(channel, t, wires) else None
        except RuntimeError:
            return None


class Company:
    """The figures of a page, in their order, as whoever stands at some place of the text means them."""

    def __init__(self) -> None:
        self.casts: dict[str, Cast] = {}
        self.passed: list[str] = []  # figures that stand before this place

    def owner(self, name: str, kind: str) -> tuple[Cast, str]:
        """The figure to which a name belongs, and the name without the figure's.

        Args:
            name: `length` or `pendulum.length`.
            kind: "number", "value", "word" or "jump".

        Raises:
            UnknownNameError: no figure of the page knows it.
        """
        first, dot, rest = name.partition(".")
        what = {"number": "parameter", "value": "value", "word": "object", "jump": "parameter"}[kind]
        if dot and first in self.casts:
            cast = self.casts[first]
            if rest not in _known(cast, kind):
                raise unknown(rest, _known(cast, kind), what=what)
            return cast, rest
        for candidate in [*reversed(self.passed), *self.casts]:
            if name in _known(self.casts[candidate], kind):
                return self.casts[candidate], name
        raise unknown(name, [one for cast in self.casts.values() for one in _known(cast, kind)], what=what)

    def nearest(self, text: str) -> Cast:
        """The last figure before this place, else the first of the page.

        Args:
            text: what is said of it, for the message.

        Raises:
            ShapeError: the page has none.
        """
        name = next(iter([*reversed(self.passed), *self.casts]), None)
        if name is None:
            raise hint(ShapeError(f"{text!r}: the page has no figure"), "write it on a page with one")
        return self.casts[name]

    def point(self, text: str) -> tuple[Cast, str]:
        """The figure of a link, and the point without its name.

        Raises:
            UnknownNameError: there is no such figure, or no such parameter of it.
            ShapeError: the link is none, or goes to two figures.
        """
        pieces = [piece for piece in text.strip().lstrip("#").split("&") if piece]
        if not pieces or any("=" not in piece for piece in pieces):
            raise hint(ShapeError(f"{text!r} is no point"), "t=1.2&length=1.5, or figure.t=1.2")
        owner: Cast | None = None
        bare: list[str] = []
        for piece in pieces:
            key, _, value = piece.partition("=")
            first, dot, rest = key.partition(".")
            if dot:
                if first not in self.casts:
                    raise unknown(first, self.casts, what="figure")
                if owner is not None and owner.name != first:
                    raise hint(ShapeError(f"{text!r}: a link goes to a point of one figure"), "make two links of it")
                owner, key = self.casts[first], rest
            bare.append(f"{key}={value}")
        wanted = [piece.partition("=")[0] for piece in bare if not piece.startswith(("t=", "cam="))]
        if owner is None and wanted:
            owner, _ = self.owner(wanted[0], "jump")
        elif owner is None:
            owner = self.nearest(text)
        for name in wanted:
            if name not in owner.parameters:
                raise unknown(name, owner.parameters, what="parameter")
        link = "&".join(bare)
        owner.holds(link)
        return owner, link


def _known(cast: Cast, kind: str) -> Any:
    return {"number": cast.parameters, "jump": cast.parameters, "value": cast.values, "word": cast.nodes}[kind]
