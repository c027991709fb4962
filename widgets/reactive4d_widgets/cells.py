"""Cells: whether this program runs in a notebook, and what it puts there if so."""

import sys
from importlib.util import find_spec
from typing import Any

from reactive4d.errors import Reactive4dError, hint
from reactive4d_widgets.figures import OPTIONS

__all__ = ["display", "in_marimo", "in_notebook", "show"]


def in_notebook() -> bool:
    """Whether this program runs in the kernel of a notebook.

    >>> in_notebook()
    False
    """
    found = sys.modules.get("IPython")  # a kernel has imported it
    shell: Any = None if found is None else found.get_ipython()
    return shell is not None and getattr(shell, "kernel", None) is not None


def in_marimo() -> bool:
    """Whether this program is a notebook of marimo's.

    >>> in_marimo()
    False
    """
    found: Any = sys.modules.get("marimo")
    return found is not None and bool(getattr(found, "running_in_notebook", bool)())


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


def show(thing: Any, /, **options: Any) -> Any:
    """Put a figure into the cell that runs.

    Args:
        thing: a Scene, an Illustration or its class.
        **options: `times`, `title`, `save`, and how the figure is shown at first: theme, height, loop, grid …

    Returns:
        The widget: `widget.time` and `widget.params` can be set and linked.

    Raises:
        UnknownNameError: an option that nobody knows.
    """
    from reactive4d_widgets.jupyter import FigureWidget

    looks = {name: options.pop(name) for name in OPTIONS if name in options}
    strangers = set(options) - {"times", "title", "save", "options"}
    if strangers:
        error = Reactive4dError(f"show: {', '.join(sorted(strangers))}: not in a notebook")
        raise hint(error, "times, title, save, theme, height, loop, autoplay, grid …; bake writes a page")
    made = FigureWidget(
        thing,
        times=options.get("times"),
        title=options.get("title"),
        options={**looks, **(options.get("options") or {})},
        save=options.get("save"),
    )
    if not in_marimo():  # which shows what a cell ends with, and nothing else
        made.present()
        made.is_fresh = True
    return made
