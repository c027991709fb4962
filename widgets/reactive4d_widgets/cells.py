"""Cells: whether this program runs in a notebook, and what it puts there if so."""

import sys
from importlib.util import find_spec
from typing import Any

__all__ = ["display", "in_notebook"]


def in_notebook() -> bool:
    """Whether this program runs in the kernel of a notebook.

    >>> in_notebook()
    False
    """
    found = sys.modules.get("IPython")  # a kernel has imported it
    shell: Any = None if found is None else found.get_ipython()
    return shell is not None and getattr(shell, "kernel", None) is not None


def display(thing: Any, /) -> bool:
    """Put a figure that is the last line of a cell into it.

    Returns:
        Whether there is a notebook with widgets to put it into.

    >>> import reactive4d as r4
    >>> display(r4.Scene(ball=r4.Sphere()))
    False
    """
    if not in_notebook() or find_spec("anywidget") is None:
        return False
    from reactive4d_widgets.jupyter import FigureWidget

    FigureWidget(thing).present()
    return True
