r"""Marks: what stands in a page's Markdown: numbers in braces, formulas between dollars, and no HTML."""

import re
from collections.abc import Sequence
from typing import Any

from markdown_it import MarkdownIt
from markdown_it.token import Token
from mdit_py_plugins.dollarmath import dollarmath_plugin

from reactive4d_widgets.mathematics import mathml

__all__ = ["made", "marks", "plain"]

_NUMBER = re.compile(r"\{\s*([^\W\d][\w-]*(?:\.[^\W\d]\w*)?)\s*(?::([^{}\n]*))?\}")


def marks() -> MarkdownIt:
    """Somebody who reads Markdown, and our marks in it.

    >>> marks().render("**$x$** costs $5 and $6.").strip()
    '<p><strong><math><mi>x</mi></math></strong> costs $5 and $6.</p>'
    """
    markdown = MarkdownIt("commonmark", {"html": False, "typographer": True})
    markdown.enable(["table", "strikethrough", "replacements", "smartquotes"])
    # A dollar with a space or a digit at its wrong side is money.
    markdown.use(
        dollarmath_plugin,
        allow_labels=False,
        allow_space=False,
        allow_digits=False,
        allow_blank_lines=False,
        double_inline=True,
    )
    markdown.inline.ruler.after("escape", "number", _number)
    for name in ("math_inline", "math_inline_double", "math_block"):
        markdown.add_render_rule(name, _formula)
    for name in ("number", "figure", "opening", "closing"):
        markdown.add_render_rule(name, _shown)
    return markdown


def _number(state: Any, silent: bool) -> bool:
    """The rule of Markdown for a number in braces."""
    if state.src[state.pos] != "{":
        return False
    found = _NUMBER.match(state.src, state.pos)
    if found is None:
        return False
    if not silent:
        token = state.push("number", "", 0)
        token.meta = {"name": found[1], "spec": (found[2] or "").strip()}
        token.content = found[0]
    state.pos = found.end()
    return True


def _formula(self: Any, tokens: Sequence[Token], i: int, options: Any, env: Any) -> str:
    """A formula; one in lines of its own may be wider than a phone, and scrolls by itself."""
    token = tokens[i]
    made = mathml(token.content.strip(), display=token.type != "math_inline")
    return made if token.type == "math_inline" else f'<span class="r4d-formula" tabindex="0">{made}</span>\n'


def _shown(self: Any, tokens: Sequence[Token], i: int, options: Any, env: Any) -> str:
    """What was made HTML already."""
    return tokens[i].content


def made(kind: str, html: str) -> Token:
    """What was made HTML already, as a part of a text."""
    return Token(kind, "", 0, content=html, block=kind == "figure")


def plain(tokens: Sequence[Token]) -> str:
    """The text of a heading, without marks."""
    return "".join(plain(token.children) if token.children else token.content for token in tokens).strip()
