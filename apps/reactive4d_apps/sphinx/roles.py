"""Roles: `number`, `value`, `jump`, `word` and `live`, as authors write them in a sentence."""

import re
from typing import Any

from docutils import nodes
from sphinx.util.docutils import SphinxRole

from reactive4d_apps.sphinx.elements import Either, Link, Number, Word

__all__ = ["ROLES"]

_TITLED = re.compile(r"(?s)(.+?)\s*<([^<>]+)>\s*")

_EITHER = re.compile(r"(?s)\s*([^<>]*?)\s*(?:<([^<>]+)>)?\s*")


class NumberRole(SphinxRole):
    """A parameter to be driven, or a value to be read: `length` or `length:.2f`."""

    def __init__(self, kind: str) -> None:
        super().__init__()
        self.kind = kind

    def run(self) -> tuple[list[nodes.Node], list[Any]]:
        """A place for it; which figure it belongs to is found out when the page was read."""
        name, _, spec = self.text.partition(":")
        node = Number(self.rawtext, "", wish=name.strip(), spec=spec.strip(), kind=self.kind)
        self.set_source_info(node)
        return [node], []


class JumpRole(SphinxRole):
    """A link to a point: `a long one <length=2&t=1>`."""

    def run(self) -> tuple[list[nodes.Node], list[Any]]:
        """The words, and where they lead."""
        found = _TITLED.fullmatch(self.text)
        words, point = (found[1], found[2]) if found else (self.text, self.text)
        node = Link(self.rawtext, words, wish=point)
        self.set_source_info(node)
        return [node], []


class WordRole(SphinxRole):
    """A word that highlights an object: `the bob <bob>` or `bob`."""

    def run(self) -> tuple[list[nodes.Node], list[Any]]:
        """The words, and what they are about."""
        found = _TITLED.fullmatch(self.text)
        words, name = (found[1], found[2]) if found else (self.text.rpartition(".")[2], self.text)
        node = Word(self.rawtext, words, wish=name.strip())
        self.set_source_info(node)
        return [node], []


class LiveRole(SphinxRole):
    """What is said where the figure asks its model, and what elsewhere: `your machine <the machine of the author>`."""

    def run(self) -> tuple[list[nodes.Node], list[Any]]:
        """The words for elsewhere, and those for there; either may be missing."""
        found = _EITHER.fullmatch(self.text)
        live, baked = (found[1], found[2] or "") if found else (self.text, "")
        node = Either(self.rawtext, baked, live=live)
        self.set_source_info(node)
        return [node], []


ROLES = {
    "number": NumberRole("number"),
    "value": NumberRole("value"),
    "jump": JumpRole(),
    "word": WordRole(),
    "live": LiveRole(),
}
