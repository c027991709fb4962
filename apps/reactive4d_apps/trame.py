"""Trame: a figure among the widgets of somebody's own trame application.

Its readers speak to the model over sockets of their own, beside trame's; so each has a point of their own. What the
application binds goes through trame's state, which all its clients share.
"""

import re
from collections.abc import Collection, Mapping
from dataclasses import replace
from typing import Any
from weakref import WeakKeyDictionary

from trame_client.widgets.core import AbstractElement  # pyright: ignore[reportMissingTypeStubs]

from reactive4d.errors import Reactive4dError, ShapeError, hint, unknown
from reactive4d.illustrations import Figure
from reactive4d.illustrations import subject as subject_of
from reactive4d_apps.serving.documents import files
from reactive4d_apps.serving.doors import is_loopback
from reactive4d_apps.serving.exhibits import Exhibit
from reactive4d_apps.serving.halls import Hall
from reactive4d_apps.serving.limits import Limits

__all__ = ["FigureView"]

START = b'import { vue } from "./r4d.mjs";\nglobalThis.reactive4d = vue;\n'
_halls: "WeakKeyDictionary[Any, Hall]" = WeakKeyDictionary()
_variables: "WeakKeyDictionary[Any, dict[str, Any]]" = WeakKeyDictionary()
_NAME = re.compile(r"[A-Za-z_$][\w$]*", re.ASCII)
Bound = str | tuple[str, Any]


class FigureView(AbstractElement):  # pyright: ignore[reportUntypedBaseClass]
    """A figure in a layout of trame, which its readers drive.

    Args:
        thing: a scene, an illustration or its class.
        time: the name of a variable of trame's state that is the figure's time, both ways; or (name, first value).
        parameters: by the names of parameters likewise: {"length": "length"}, {"length": ("length", 1.5)}.
        times: None for its own, (start, stop), or evenly spaced times, seconds.
        title: how the figure is called.
        values: of parameters, with which it opens.
        options: how it is shown at first, as for `bake`.
        origins: of further sites whose pages may speak to the server, such as that of a proxy.
        limits: how much one reader may take; those of the first figure of an application hold for all.
        **attributes: of the element, as for any widget of trame: `style`, `classes`, `v_if` and so on.

    Raises:
        UnknownNameError: a parameter or an option that nobody knows.
        ShapeError: what is to be a variable's name is none.
        Reactive4dError: the server runs already, and there was no figure when it started.

    >>> import reactive4d as r4
    >>> from trame.app import get_server
    >>> from trame.ui.html import DivLayout
    >>> with DivLayout(get_server("an example")) as layout:
    ...     view = FigureView(r4.Scene(ball=r4.Sphere()), time=("t", 0.0))
    >>> layout.server.state.t
    0.0
    """

    def __init__(
        self,
        thing: Any,
        /,
        *,
        time: Bound | None = None,
        parameters: Mapping[str, Bound] | None = None,
        times: Any = None,
        title: str | None = None,
        values: Mapping[str, Any] | None = None,
        options: Mapping[str, Any] | None = None,
        origins: Collection[str] = (),
        limits: Limits | None = None,
        **attributes: Any,
    ) -> None:
        shown = subject_of(thing)
        known = {control.name for control in shown.controls}
        for name in (*(parameters or {}), *(values or {})):
            if name not in known:
                raise unknown(name, known, what="parameter")
        ties = {name: _tied(tie) for name, tie in (parameters or {}).items()}
        clock = None if time is None else _tied(time)
        figure = Figure(thing, times=times, title=title)
        self._exhibit = Exhibit(shown.name, figure, values=values, options=options)
        super().__init__("r4d-view", **attributes)  # pyright: ignore[reportUnknownMemberType]
        server: Any = self.server  # pyright: ignore[reportUnknownMemberType]
        hall = _hall_of(server, limits)
        hall.door = replace(hall.door, origins=frozenset((*hall.door.origins, *origins)))
        self._exhibit.name = _free(self._exhibit.name, hall)
        hall.figures[self._exhibit.name] = self._exhibit.open
        for key, first in (*ties.values(), *([] if clock is None else [clock])):
            if first is not None:
                server.state.setdefault(key, first)
            _variables.setdefault(server.root_server, {})[key] = server.state
        self._write(hall.token, None if clock is None else clock[0], {name: tie[0] for name, tie in ties.items()})

    @property
    def name(self) -> str:
        """How the figure is called among those of the application."""
        return self._exhibit.name

    def _write(self, token: str, time: str | None, parameters: Mapping[str, str]) -> None:
        """What stands in the page's template."""
        element: Any = self
        element._attr_names += ["figure", "base", "time", "parameters"]
        element._event_names += [("update_time", "update:time"), ("update_parameters", "update:parameters")]
        element.figure = self._exhibit.name
        element.base = f"{token}/"
        if time is not None:
            element.time = (time,)
            element.update_time = f"{time} = $event"
        if parameters:
            element.parameters = ("{" + ", ".join([f"'{name}': {key}" for name, key in parameters.items()]) + "}",)
            element.update_parameters = ", ".join(
                [f"('{name}' in $event) && ({key} = $event['{name}'])" for name, key in parameters.items()]
            )


def _tied(tie: Bound) -> tuple[str, Any]:
    """The name of a variable, and its first value."""
    name, first = tie if isinstance(tie, tuple) else (tie, None)
    if _NAME.fullmatch(name) is None:
        raise hint(ShapeError(f"{name!r} is no name of a variable"), "letters, digits and _, as in 'length'")
    return name, first


def _free(name: str, hall: Hall) -> str:
    """A name that no other figure of the application has."""
    found, number = name, 1
    while found in hall.figures:
        number += 1
        found = f"{name}-{number}"
    return found


def _hall_of(server: Any, limits: Limits | None) -> Hall:
    """Where the figures of an application are asked: addresses of its own server."""
    root = server.root_server
    hall = _halls.get(root)
    if hall is not None:
        return hall
    if root.running:
        raise hint(Reactive4dError("the server runs already"), "put the first figure into a layout before it starts")
    needed = {name: file for name, file in files().items() if name == "r4d.mjs"}
    hall = _halls[root] = Hall(_nothing, {**needed, "trame.mjs": ("text/javascript", START)}, {}, limits=limits)
    root.enable_module({"module_scripts": [f"{hall.token}/trame.mjs"], "vue_use": ["reactive4d"]})

    def bind(bound: Any) -> None:
        hall.door = replace(hall.door, local=is_loopback(str(bound.host)))
        hall.attach(bound.app, is_guest=True)
        # What nobody gave a value by now is the figure's to say; but a page's template must find it.
        for name, state in _variables.get(root, {}).items():
            state.setdefault(name, None)

    root.controller.on_server_bind.add(bind)
    return hall


def _nothing() -> str:
    """There is no page of ours."""
    return ""
