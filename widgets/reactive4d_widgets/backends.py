"""Backends: a plotter of PyVista in a cell, shown by our viewer: `pv.set_jupyter_backend("reactive4d")`."""

import tempfile
import warnings
from collections.abc import Mapping
from html import escape
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from reactive4d.errors import Reactive4dError, hint
from reactive4d_widgets.figures import OPTIONS
from reactive4d_widgets.plotters import Staged, staged
from reactive4d_widgets.renderers import Bar

__all__ = ["Cell", "bar_html", "handle"]

FRAME = '<iframe srcdoc="{page}" style="width: 100%; height: {height}px; border: 0" title="{title}"></iframe>'
BAR = (
    '<figure style="margin: 2px 0 8px; max-width: 420px; font: 12px system-ui, sans-serif">'
    '<figcaption style="text-align: center">{title}</figcaption>'
    '<div style="height: 12px; background: linear-gradient(to right, {stops})"></div>'
    '<div style="display: flex; justify-content: space-between"><span>{low}</span><span>{middle}</span>'
    "<span>{high}</span></div></figure>"
)
STILL = (0.0, 0.0)  # a plotter has no time
AROUND = 130  # pixels of a page below its figure: the player, and what is round it


class Cell:
    """What a plotter becomes in a cell: a figure for each of its subplots, one below the other, and its scalar bars.

    Attributes:
        parts: what stands in each subplot.
        widgets: the figures that were displayed live.
    """

    def __init__(self, parts: list[Staged], options: Mapping[str, Any], *, title: str | None, live: bool) -> None:
        self.parts = parts
        self.widgets: list[Any] = []
        self._options = dict(options)
        self._title = title
        self._live = live

    def _ipython_display_(self) -> None:
        display: Any = import_module("IPython.display")
        for part in self.parts:
            options = {**part.options, **self._options}
            if self._live:
                made: Any = import_module("reactive4d_widgets.jupyter").FigureWidget
                widget = made(part.scene, title=self._title, times=STILL, options=options)
                self.widgets.append(widget)
                widget.present()
            else:
                page = escape(_page(part, options, self._title), quote=True)
                title = escape(self._title or "figure", quote=True)
                frame = FRAME.format(page=page, height=int(options["height"]) + AROUND, title=title)
                display.display({"text/html": frame, "text/plain": title}, raw=True)
            if part.bars:
                plain = "; ".join([f"{bar.title} from {bar.low:.4g} to {bar.high:.4g}" for bar in part.bars])
                display.display({"text/html": "".join(map(bar_html, part.bars)), "text/plain": plain}, raw=True)


def handle(plotter: Any, *, screenshot: Any = None, live: bool = True, title: str | None = None, **options: Any) -> Any:
    """Show a plotter in a cell; PyVista calls it where `pv.set_jupyter_backend("reactive4d")` was said.

    Args:
        plotter: of PyVista.
        screenshot: where to write a picture as well; None for nowhere.
        live: whether the figure speaks with the kernel; else it is baked into the cell, and needs none.
        title: for a person to read.
        **options: how the figure is shown, instead of as the plotter is: theme, height, axes, grid, edges, shading, …

    Returns:
        What the cell displays; where nothing can be shown live, or the plotter has volumes, PyVista's own picture.

    Raises:
        Reactive4dError: an option that nobody knows.

    >>> import pyvista as pv
    >>> plotter = pv.Plotter(off_screen=True)
    >>> _ = plotter.add_mesh(pv.Sphere(), name="ball")
    >>> list(handle(plotter).parts[0].scene)
    ['ball', 'camera']
    >>> plotter.close()
    """
    strangers = options.keys() - OPTIONS
    if strangers:
        error = Reactive4dError(f"reactive4d: {', '.join(sorted(strangers))}: no option of a figure")
        raise hint(error, f"jupyter_kwargs=dict(…) takes live, title, {', '.join(OPTIONS)}")
    if screenshot:
        plotter.screenshot(screenshot)
    parts = staged(plotter)
    missing = sorted({what for part in parts for what in part.missing})
    reason = ""
    if "volumes" in missing:
        reason = "volumes cannot be shown"
    elif live and find_spec("anywidget") is None:
        reason = "widgets need anywidget: pip install 'reactive4d[jupyter]'"
    if reason:
        warnings.warn(f"reactive4d: {reason}; this is a picture of PyVista's", stacklevel=2)
        return import_module("pyvista.jupyter.notebook").show_static_image(plotter, screenshot)
    if missing:
        warnings.warn(f"reactive4d does not show {', '.join(missing)}", stacklevel=2)
    return Cell(parts, options, title=title, live=live)


def _page(part: Staged, options: Mapping[str, Any], title: str | None) -> str:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "page.html"
        part.scene.bake(path, title=title or "Plot", times=STILL, options=options, progress=False)
        return path.read_text(encoding="utf-8")


def bar_html(bar: Bar) -> str:
    """A scalar bar as HTML.

    >>> import numpy as np
    >>> "rgb(0, 0, 255)" in bar_html(Bar("<h>", np.array([(255, 0, 0), (0, 0, 255)]), 0.0, 1.0))
    True
    """
    stops = ", ".join([f"rgb({r}, {g}, {b})" for r, g, b in bar.colors.tolist()])
    numbers = {"low": bar.low, "middle": (bar.low + bar.high) / 2.0, "high": bar.high}
    return BAR.format(
        title=escape(bar.title), stops=stops, **{name: f"{number:.4g}" for name, number in numbers.items()}
    )
