"""Showing: a scene or an illustration is put before whoever runs the program, as a page in their browser."""

import os
import tempfile
import webbrowser
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from reactive4d.illustrations import subject
from reactive4d_widgets.baking import bake
from reactive4d_widgets.cells import in_marimo, in_notebook
from reactive4d_widgets.displays import has_screen
from reactive4d_widgets.figures import OPTIONS

__all__ = ["Shown", "show"]


class Shown:
    """A page that was shown: where it is, and whether a browser took it."""

    def __init__(self, path: Path, *, is_open: bool) -> None:
        self.path = path
        self.is_open = is_open

    def __repr__(self) -> str:
        return f"{self.path}{'' if self.is_open else ': open it in a browser; there is none here'}"


def show(
    thing: Any,
    /,
    *,
    path: str | os.PathLike[str] | None = None,
    browser: Callable[[str], bool] | None = None,
    progress: bool = False,
    **options: Any,
) -> Any:
    """Put it before whoever runs the program: in a notebook as a widget, else as a page in the browser.

    Args:
        thing: a scene, an illustration or its class, or a page.
        path: of the file; by default one in a temporary folder, which stays until the system clears it.
        browser: what opens an address, and says whether it could; by default the system's own browser.
        progress: whether a bar is shown while it is baked.
        **options: how the figure is shown at first (theme, height, loop, grid …), and what `bake` takes; in a notebook
            `save`, what is kept of it, see docs/notebooks.md.

    Returns:
        Where the page is; in a notebook the widget.

    Raises:
        Exception: whatever `bake` raises.

    >>> import reactive4d as r4
    >>> seen = []
    >>> shown = show(r4.Scene(ball=r4.Sphere()), browser=lambda address: seen.append(address) or True, times=(0, 1))
    >>> shown.path.name, seen[0].startswith("file:///")
    ('scene.html', True)
    """
    is_page = path is not None or browser is not None or hasattr(thing, "figures")
    if not is_page and (in_notebook() or in_marimo()) and find_spec("anywidget"):
        from reactive4d_widgets.cells import show as show_in_cell

        return show_in_cell(thing, **options)
    name = getattr(thing, "name", "") if hasattr(thing, "figures") else subject(thing).name
    target = Path(tempfile.mkdtemp(prefix="reactive4d-")) / f"{name or 'page'}.html" if path is None else Path(path)
    options.pop("save", None)  # a page keeps all that it shows
    figure = {key: options.pop(key) for key in OPTIONS if key in options}
    bake(thing, target, options={**figure, **(options.pop("options", None) or {})}, progress=progress, **options)
    opens = browser or (webbrowser.open if has_screen() else _nobody)
    return Shown(target, is_open=bool(opens(target.resolve().as_uri())))


def _nobody(address: str) -> bool:
    return False
