"""Notebooks: a figure in a cell, as a widget: its time and its parameters are traits that others may be linked to.

A cell gets two outputs: what a notebook keeps of the figure, which is all that there is of it without a kernel, and the
widget, which hides that as long as it lives. Of the model nothing is kept in the widget but a point; answers travel as
messages.
"""

import threading
import uuid
import weakref
from collections import OrderedDict
from collections.abc import Mapping
from importlib import import_module
from typing import Any

import anywidget
import traitlets

from reactive4d.errors import Reactive4dError, hint
from reactive4d.illustrations import Bookmark, Illustration, subject
from reactive4d.illustrations.controls import listed
from reactive4d.illustrations.settling import settle
from reactive4d_widgets.figures import OPTIONS, checked_options
from reactive4d_widgets.keepsakes import kept, limit_of, placeholder
from reactive4d_widgets.live import Reader
from reactive4d_widgets.loaders import LOADER, bundle

__all__ = ["FigureWidget", "show"]

MOST_VIEWS = 16


class FigureWidget(anywidget.AnyWidget):
    """A figure in a notebook.

    Args:
        thing: a Scene, an Illustration or its class.
        times: None for its own, (start, stop), or evenly spaced times.
        title: for a person to read.
        options: how the figure is shown at first.
        save: what a notebook keeps of it: None for what is quick to save, True for what moves, whatever it takes, False
            for a picture only, or a number of bytes.

    Attributes:
        time: where the reader is, seconds; can be set, and linked.
        params: the values of the parameters, as they travel; of an illustration those of `fig.param`, both ways.

    >>> import param
    >>> import reactive4d as r4
    >>> class Pole(r4.Illustration):
    ...     height = param.Number(1.0, bounds=(0, 3))
    ...
    ...     def build(self):
    ...         return r4.Scene(pole=r4.Cylinder(0.1, self.signals.height))
    >>> pole = Pole()
    >>> widget = FigureWidget(pole)
    >>> widget.params = {"height": 2.0}
    >>> pole.height
    2.0
    >>> pole.height = 3.0
    >>> widget.params
    {'height': 3.0}
    """

    _esm = LOADER
    time: Any = traitlets.Float(0.0).tag(sync=True)
    params: Any = traitlets.Dict().tag(sync=True)
    _viewer: Any = traitlets.Unicode("").tag(sync=True)
    _poster: Any = traitlets.Unicode("").tag(sync=True)

    def __init__(
        self,
        thing: Any,
        *,
        times: Any = None,
        title: str | None = None,
        options: Mapping[str, Any] | None = None,
        save: Any = None,
    ) -> None:
        limit_of(save)  # what is none is told at once
        about = subject(thing)
        made: Any = about.thing
        self._thing: Any = weakref.ref(made)
        self._held: Any = made  # while it has views, or had none yet; cells that ran again leave nothing large behind
        self._settings: dict[str, Any] = {"times": times, "title": title}
        self._settings["options"] = checked_options(options, {control.name: control for control in about.controls})
        self._save = save
        self._views: OrderedDict[str, Reader] = OrderedDict()
        self._guard = threading.RLock()
        self._is_settling = False
        self._is_fresh = False
        super().__init__(
            time=about.point.time,
            params={name: listed(wire) for name, wire in about.point.parameters.items()},
            _viewer=bundle()[1],
            _poster=uuid.uuid4().hex,
        )
        me: Any = self
        me.on_msg(self._heard)
        self.observe(self._params_were_set, "params")
        if isinstance(made, Illustration):
            names = [control.name for control in made.controls]
            watcher: Any = made.param
            watcher.watch(_Watch(self._parameters_were_set), names)

    # -- messages ----------------------------------------------------------------------------------------------------

    def _heard(self, _: Any, content: Any, buffers: Any) -> None:
        """A view says something; on whatever thread."""
        del buffers
        if not isinstance(content, dict):
            return
        fields: dict[str, Any] = content  # pyright: ignore[reportUnknownVariableType]
        if fields.get("type") == "bundle":
            data, digest = bundle()
            self._say({"type": "bundle", "hash": digest}, [data])
            return
        name = fields.get("view")
        if not isinstance(name, str) or not 0 < len(name) <= 100:
            return
        if fields.get("type") == "close":
            self._leave(name)
            return
        reader = self._reader(name)
        if reader is None:
            self._say({"type": "error", "id": fields.get("id"), "view": name, "text": "the model is gone"})
            return
        reply, parts = reader.receive(fields)
        if reply is not None:
            self._say({**reply, "view": name}, parts)

    def _say(self, message: dict[str, Any], buffers: list[bytes] | None = None) -> None:
        me: Any = self
        me.send(message, buffers)

    def _reader(self, name: str) -> Reader | None:
        with self._guard:
            found = self._views.get(name)
            if found is not None:
                self._views.move_to_end(name)
                return found
            thing = self._thing()
            if thing is None:
                return None
            self._held = thing
            found = Reader(thing, send=lambda message: self._say({**message, "view": name}), **self._settings)
            self._views[name] = found
            while len(self._views) > MOST_VIEWS:
                self._views.popitem(last=False)[1].close()
            return found

    def _leave(self, name: str) -> None:
        with self._guard:
            reader = self._views.pop(name, None)
            if reader is not None:
                reader.close()
            if not self._views:
                self._held = None

    @property
    def views(self) -> int:
        """How many views are open."""
        return len(self._views)

    def close(self) -> None:
        """Show it no more."""
        with self._guard:
            for reader in self._views.values():
                reader.close()
            self._views.clear()
            self._held = None
        super().close()

    # -- parameters --------------------------------------------------------------------------------------------------

    def _params_were_set(self, change: Any) -> None:
        """By a view, by a widget that is linked, or by hand: what cannot be is moved to the nearest that can."""
        thing = self._thing()
        if self._is_settling or thing is None:
            return
        given: dict[str, Any] = {str(name): _wire(value) for name, value in dict(change["new"]).items()}
        with self._guard:
            self._is_settling = True
            try:
                if isinstance(thing, Illustration):
                    settle(thing, given, strict=False)
                    wires = dict(subject(thing).point.parameters)
                else:
                    before = dict(change["old"]) if isinstance(change["old"], dict) else {}  # pyright: ignore
                    wires = subject(thing).settled({**before, **given}, strict=False)
                self.params = {name: listed(wire) for name, wire in wires.items()}
            finally:
                self._is_settling = False

    def _parameters_were_set(self) -> None:
        """By hand, of the illustration."""
        thing = self._thing()
        if self._is_settling or thing is None:
            return
        with self._guard:
            self._is_settling = True
            try:
                wires = subject(thing).point.parameters
                self.params = {name: listed(wire) for name, wire in wires.items()}
            finally:
                self._is_settling = False

    @property
    def point(self) -> Bookmark:
        """Where the reader is."""
        return Bookmark(self.time, {name: _wire(value) for name, value in self.params.items()})

    # -- display -----------------------------------------------------------------------------------------------------

    def _ipython_display_(self) -> None:
        if self._is_fresh:  # the result of `show`, which has displayed it already
            self._is_fresh = False
            return
        self.present()

    def present(self) -> None:
        """Put it into the cell that runs: what the notebook keeps of it, and the widget.

        What is kept takes its place first and is made last, when the widget has begun to live.
        """
        put: Any = import_module("IPython.display").display
        thing = self._thing()
        name = self._poster
        place: Any = None
        if thing is not None:
            place = put(placeholder(name, subject(thing).title), raw=True, display_id=True)
        me: Any = super()
        found: Any = me._repr_mimebundle_()
        if found:
            put(found[0] if isinstance(found, tuple) else found, raw=True)
        if place is not None:
            place.update(kept(thing, save=self._save, **self._settings).outputs(name), raw=True)


def _wire(value: Any) -> Any:
    pair: Any = value
    return tuple(pair) if isinstance(value, list) else pair


class _Watch:
    """Calls a method for as long as its object is there."""

    def __init__(self, method: Any) -> None:
        self._method = weakref.WeakMethod(method)

    def __call__(self, *events: Any) -> None:
        found = self._method()
        if found is not None:
            found()


def show(thing: Any, /, **options: Any) -> FigureWidget:
    """Put a figure into the cell that runs.

    Args:
        thing: a Scene, an Illustration or its class.
        **options: `times`, `title`, `save`, and how the figure is shown at first: theme, height, loop, grid …

    Returns:
        The widget: `widget.time` and `widget.params` can be set and linked.

    Raises:
        UnknownNameError: an option that nobody knows.
    """
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
    made.present()
    made._is_fresh = True  # pyright: ignore[reportPrivateUsage]
    return made
