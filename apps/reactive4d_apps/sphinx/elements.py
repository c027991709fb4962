"""Elements: what stands in the tree of a page for figures, numbers, links and words, and how each is written."""

from html import escape
from typing import Any

from docutils import nodes
from sphinx.util.osutil import relative_uri

__all__ = ["Check", "Either", "Fold", "Illustration", "Link", "Number", "Script", "Word", "add_elements"]


class Illustration(nodes.General, nodes.Element):
    """A figure. Where nothing can live it is its still picture."""


class Number(nodes.Inline, nodes.TextElement):
    """A parameter or a value, in a sentence."""


class Link(nodes.Inline, nodes.TextElement):
    """To a point of a figure."""


class Word(nodes.Inline, nodes.TextElement):
    """About an object of a figure."""


class Either(nodes.Inline, nodes.TextElement):
    """Words for a page whose figure asks its model; its text stands wherever there is only what was baked."""


class Check(nodes.General, nodes.TextElement):
    """Whether an exercise is done."""


class Script(nodes.General, nodes.Element):
    """The script of a figure, which a reader may edit where a server is."""


class Fold(nodes.General, nodes.Element):
    """What a reader unfolds; its first child is the title."""


DARK = "screen and (prefers-color-scheme: dark)"
ELSEWHERE = "Where the book is served, a reader can edit this script, in a copy of their own."


def _open(name: str, attributes: dict[str, Any]) -> str:
    said = "".join([f' {key}="{escape(str(value))}"' for key, value in attributes.items() if value])
    return f"<{name}{said}>"


def _live(translator: Any, node: nodes.Element) -> bool:
    """Whether the page that is written can hold what lives; else it gets the text alone."""
    return translator.builder.format == "html" and translator.builder.name != "epub"


def _visit_illustration(translator: Any, node: nodes.Element) -> None:
    builder = translator.builder
    page = builder.get_target_uri(builder.current_docname)
    static = relative_uri(page, "_static/")
    width, height = node["size"]
    dark = {"media": DARK, "srcset": f"{static}r4d/{node['dark']}"}
    picture = {
        "src": f"{static}r4d/{node['picture']}",
        "width": width,
        "height": height,
        "alt": node["alt"],
    }
    attributes = {
        "name": node["name"],
        "title": node["title"],
        "follow": node["follow"],
        "point": node["point"],
        "data-source": f"{static}r4d/{node['source']}" if _live(translator, node) else "",
        "data-line": node["line_name"],
        "style": f"--r4d-height: {node['height']}px" if node["height"] else "",
    }
    poster = f'<picture class="r4d-poster">{_open("source", dark)}{_open("img", picture)}</picture>'
    translator.body.append(f"{_open('r4d-figure', attributes)}{poster}</r4d-figure>\n")
    raise nodes.SkipNode


def _visit_number(translator: Any, node: nodes.Element) -> None:
    attributes = {"figure": node["figure"], "name": node["name"], "format": node["spec"]}
    translator.body.append(_open("r4d-number", attributes))


def _visit_link(translator: Any, node: nodes.Element) -> None:
    translator.body.append(_open("r4d-link", {"figure": node["figure"], "point": node["point"]}))


def _visit_word(translator: Any, node: nodes.Element) -> None:
    translator.body.append(_open("r4d-word", {"figure": node["figure"], "node": node["node"]}))


def _visit_either(translator: Any, node: nodes.Element) -> None:
    # Said even if there are none: then nothing stands where the figure is live.
    attributes = f'{_open("r4d-either", {"figure": node["figure"]})[:-1]} live="{escape(node["live"])}">'
    translator.body.append(attributes)


def _visit_check(translator: Any, node: nodes.Element) -> None:
    translator.body.append(_open("r4d-check", {"figure": node["figure"], "name": node["name"], "class": "r4d-check"}))


def _leaving(name: str) -> Any:
    def depart(translator: Any, node: nodes.Element) -> None:
        translator.body.append(f"</{name}>")

    return depart


def _visit_script(translator: Any, node: nodes.Element) -> None:
    translator.body.append(_open("r4d-script", {"figure": node["figure"]}))


def _depart_script(translator: Any, node: nodes.Element) -> None:
    translator.body.append(f'</r4d-script>\n<p class="r4d-elsewhere">{ELSEWHERE}</p>\n')


def _visit_fold(translator: Any, node: nodes.Element) -> None:
    translator.body.append(f'<details class="{escape(node["kind"])}"><summary>{escape(node["title"])}</summary>\n')


def _pass(translator: Any, node: nodes.Element) -> None:
    """Its text stands for it."""


def _skip(translator: Any, node: nodes.Element) -> None:
    raise nodes.SkipNode


def add_elements(app: Any) -> None:
    """Tell Sphinx how they are written: as elements in HTML, as their text elsewhere."""
    others = ("latex", "text", "man", "texinfo")
    words = {
        Number: (_visit_number, _leaving("r4d-number")),
        Link: (_visit_link, _leaving("r4d-link")),
        Word: (_visit_word, _leaving("r4d-word")),
        Either: (_visit_either, _leaving("r4d-either")),
        Script: (_visit_script, _depart_script),
        Fold: (_visit_fold, _leaving("details")),
    }
    for kind, both in words.items():
        app.add_node(kind, html=both, **dict.fromkeys(others, (_pass, _pass)))
    app.add_node(Check, html=(_visit_check, _leaving("r4d-check")), **dict.fromkeys(others, (_skip, _pass)))
    # Elsewhere a picture takes its place, see `settings.StillPictures`.
    app.add_node(Illustration, html=(_visit_illustration, _pass), **dict.fromkeys(others, (_skip, _pass)))
