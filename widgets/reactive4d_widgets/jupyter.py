"""Notebooks: a figure in a cell, as a widget: its time and its parameters are traits that others may be linked to.

A cell gets two outputs: what a notebook keeps of the figure, which is all that there is of it without a kernel, and the
widget, which hides that as long as it lives. Of the model nothing is kept in the widget but a point; answers travel as
messages.
"""

import threading
import uuid
import weakref
from collections import OrderedDict
from collections.abc import Callable, Mapping
from functools import partial
from importlib import import_module
from typing import Any

import anywidget
import traitlets

from reactive4d.illustrations import Bookmark, Illustration, subject
from reactive4d.illustrations.controls import listed
from reactive4d.illustrations.settling import settle
from reactive4d_widgets.figures import checked_options
from reactive4d_widgets.keepsakes import kept, limit_of, placeholder
from reactive4d_widgets.live import Reader
from reactive4d_widgets.loaders import LOADER, bundle
from reactive4d_widgets.reruns import noted, running

__all__ = ["FigureWidget"]

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
        is_fresh: whether it was shown just now, and need not be shown as the result of its cell.

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
        self.is_fresh = False
        self._is_retired = False
        self._watch: Callable[[], None] | None = None
        super().__init__(
            time=about.point.time,
            params={name: listed(wire) for name, wire in about.point.parameters.items()},
            _viewer=bundle()[1],
            _poster=uuid.uuid4().hex,
        )
        me: Any = self
        me.on_msg(self._heard)
        self.observe(self._params_were_set, "params")
        self._follow()

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
                if self._is_retired:
                    self.close()

    def retire(self) -> None:
        """The cell that showed it is run again: it ends with its last view."""
        with self._guard:
            self._is_retired = True
            if not self._views:
                self.close()

    @property
    def views(self) -> int:
        """How many views are open."""
        return len(self._views)

    def close(self) -> None:
        """Show it no more; it can be presented again."""
        if not hasattr(self, "_guard"):  # it was refused before it was made
            return
        with self._guard:
            for reader in self._views.values():
                reader.close()
            self._views.clear()
            self._held = None
            end, self._watch = self._watch, None
        if end is not None:
            end()
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

    def _follow(self) -> None:
        """Follow the parameters of an illustration for as long as this is open."""
        thing = self._thing()
        if isinstance(thing, Illustration) and self._watch is None:
            names = [control.name for control in thing.controls]
            self._watch = _Watch(thing, names, self._parameters_were_set).end

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
        if self.is_fresh:  # the result of `show`, which has displayed it already
            self.is_fresh = False
            return
        self.present()

    def present(self) -> None:
        """Put it into the cell that runs: what the notebook keeps of it, and the widget.

        What is kept takes its place first and is made last, when the widget has begun to live.
        """
        put: Any = import_module("IPython.display").display
        thing = self._thing()
        name = self._poster
        me: Any = super()
        if self.comm is None:  # it was closed
            me.open()
            self._follow()
            self._parameters_were_set()
        self._is_retired = False
        noted(self, running())
        place: Any = None
        if thing is not None:
            place = put(placeholder(name, subject(thing).title), raw=True, display_id=True)
        found: Any = me._repr_mimebundle_()
        if found:
            view: Any = found[0] if isinstance(found, tuple) else found  # pyright: ignore[reportUnknownVariableType]
            put({**view, "text/plain": ""}, raw=True)  # where no widget runs, what is kept says enough
        if place is not None:
            place.update(kept(thing, save=self._save, **self._settings).outputs(name), raw=True)


def _wire(value: Any) -> Any:
    pair: Any = value
    return tuple(pair) if isinstance(value, list) else pair


class _Watch:
    """Calls a method when parameters of an illustration are set, for as long as its object is there."""

    def __init__(self, thing: Any, names: list[str], method: Any) -> None:
        self._method = weakref.WeakMethod(method)
        # The illustration has the watcher, which has this; `end` is held by the widget, and keeps nothing alive.
        watcher = thing.param.watch(self, names)
        self.end = partial(_end, weakref.ref(thing), weakref.ref(self))
        self.watcher = watcher

    def __call__(self, *events: Any) -> None:
        found = self._method()
        if found is not None:
            found()


def _end(thing: Any, watch: Any) -> None:
    found, watching = thing(), watch()
    if found is not None and watching is not None:
        found.param.unwatch(watching.watcher)
