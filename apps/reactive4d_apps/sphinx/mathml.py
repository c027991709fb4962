"""MathML: formulas as the browser sets them by itself, without a script and without a network."""

from typing import Any

from docutils import nodes
from sphinx.util import logging

from reactive4d.errors import Reactive4dError
from reactive4d_widgets.mathematics import mathml

__all__ = ["visit_displayed", "visit_inline"]

LOG = logging.getLogger("reactive4d.sphinx")


def visit_inline(translator: Any, node: nodes.math) -> None:
    """A formula in a sentence."""
    translator.body.append(_formula(node, display=False))
    raise nodes.SkipNode


def visit_displayed(translator: Any, node: nodes.math_block) -> None:
    """A formula of its own, with its number if it has one."""
    translator.body.append(translator.starttag(node, "div", CLASS="math"))
    translator.body.append(_formula(node, display=True))
    if node.get("number"):
        translator.body.append(f'<span class="eqno">({node["number"]})</span>')
    translator.body.append("</div>\n")
    raise nodes.SkipNode


def _formula(node: Any, *, display: bool) -> str:
    try:
        return mathml(node.astext().strip(), display=display)
    except Reactive4dError as error:
        LOG.warning("%s", error, location=node, type="math")
        return f"<code>{nodes.literal('', node.astext()).astext()}</code>"
