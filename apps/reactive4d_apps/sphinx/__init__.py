"""Figures that a reader drives, in the pages of any Sphinx project that is written in MyST Markdown.

    extensions = ["myst_parser", "reactive4d_apps.sphinx"]
    html_theme = "reactive4d_book"

See docs/books.md. Needs `pip install 'reactive4d[book]'`.
"""

from reactive4d_apps.sphinx.settings import setup

__all__ = ["setup"]
