"""The settings of the project's book, as Sphinx reads them: `reactive4d book build docs`."""

import importlib.metadata
import re
from typing import Any

from pygments.lexers.python import Python3Lexer

project = "reactive4d"
author = "the reactive4d authors"
release = importlib.metadata.version("reactive4d")
language = "en"
extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "reactive4d_apps.sphinx",
]
myst_enable_extensions = ["attrs_inline", "colon_fence", "deflist", "dollarmath", "smartquotes", "tasklist"]
myst_heading_anchors = 3
html_theme = "reactive4d_book"
html_show_search_summary = False
html_show_copyright = False
html_copy_source = False
numfig = True
exclude_patterns = ["build"]

# What a docstring puts between single quotes is a name.
default_role = "literal"
autosummary_generate = False  # a page per term is there, in reference/terms
autodoc_member_order = "bysource"
autodoc_typehints = "none"  # they stand in the signature
autodoc_preserve_defaults = True
napoleon_use_rtype = False
python_use_unqualified_type_names = True
toc_object_entries = False


def _joined(app: Any, what: str, name: str, thing: Any, options: Any, lines: list[str]) -> None:
    """The plural of a name in quotes, which reStructuredText does not know."""
    lines[:] = [re.sub(r"`s\b", r"`\\ s", line) for line in lines]


def setup(app: Any) -> None:
    """Tell Sphinx how the docstrings are written, and how programs look where IPython does not tell it."""
    app.add_lexer("ipython", Python3Lexer)
    app.connect("autodoc-process-docstring", _joined)
