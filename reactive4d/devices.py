"""Devices: what puts a scene before a reader: writes a page, draws a picture, opens a window.

A device is a function whose first argument is what it is to show. Those that come along lie in packages above the core,
which imports each of them when it is first wanted. Another one can be put in its place while the program runs, and the
scene does not notice.
"""

from collections.abc import Callable
from functools import wraps
from importlib import import_module
from pathlib import Path
from types import MethodType
from typing import Any, TypeAlias, TypeVar, cast

from reactive4d.errors import Reactive4dError, hint, unknown

__all__ = ["Device", "Showable", "device", "exchange", "names"]

Device: TypeAlias = Callable[..., Any]
F = TypeVar("F", bound=Callable[..., Any])

_devices: dict[str, Device | str] = {
    "bake": "reactive4d_widgets.baking:bake",  # one page that needs no server
    "display": "reactive4d_widgets.cells:display",  # the last line of a cell of a notebook
    "render": "reactive4d_widgets.rendering:render",  # a still, a film, or a model of one instant
    "serve": "reactive4d_apps.serving:serve",  # a page for many readers
    "show": "reactive4d_widgets.showing:show",  # a window, or a cell of a notebook
    "to_pyvista": "reactive4d_widgets.blocks:blocks",  # PyVista's own data, to go on with
}

# Those that need more than the package does.
_HINTS = {"serve": "pip install 'reactive4d[trame]'"}


def names() -> tuple[str, ...]:
    """The names of all devices.

    >>> names()
    ('bake', 'display', 'render', 'serve', 'show', 'to_pyvista')
    """
    return tuple(sorted(_devices))


def device(name: str) -> Device:
    """The device of that name.

    Raises:
        UnknownNameError: there is none.
        Reactive4dError: there is one, but it cannot be imported here.

    >>> device("rendre")
    Traceback (most recent call last):
    ...
    reactive4d.errors.UnknownNameError: unknown device 'rendre'
    hint: did you mean 'render'?
    """
    found = _devices.get(name)
    if found is None:
        raise unknown(name, _devices, what="device")
    if isinstance(found, str):
        module, _, function = found.partition(":")
        try:
            found = getattr(import_module(module), function)
        except (ImportError, AttributeError) as error:
            refusal = Reactive4dError(f"the device {name!r} cannot be used here: {error}")
            told = f"it is {function} of {module}, which comes with reactive4d and needs what it needs"
            raise hint(refusal, _HINTS.get(name, told)) from error
    assert callable(found)
    return found


def exchange(name: str, other: Device | str) -> Device | str:
    """Put another device in the place of one, or a new one where there is none; the one before is returned.

    Args:
        name: how it is called: `scene.render(…)` calls "render".
        other: a function, or where to import it from when it is wanted: "package.module:function".

    Returns:
        What was there before, as it can be given back; of a new one itself.

    Raises:
        TypeError: it is neither.

    >>> import reactive4d as r4
    >>> before = exchange("render", lambda scene, path, **options: f"{len(scene)} objects in {path}")
    >>> r4.Scene(ball=r4.Sphere()).render("ball.png")
    '1 objects in ball.png'
    >>> _ = exchange("render", before)
    """
    if not callable(other) and not (isinstance(other, str) and other.count(":") == 1):  # pyright: ignore[reportUnnecessaryIsInstance]
        error = TypeError(f"device {name!r}: expected a function, got {other!r}")
        raise hint(error, "or where to import it from, as in 'package.module:function'")
    before = _devices.get(name, other)
    _devices[name] = other
    return before


class _Way:
    """A method that says what to do where somebody calls it on the class."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self._function = function
        self.__doc__ = function.__doc__

    def __get__(self, one: Any, owner: type[Any]) -> Callable[..., Any]:
        if one is not None:
            return MethodType(self._function, one)
        name = self._function.__name__

        @wraps(self._function)
        def called(*given: Any, **options: Any) -> Any:
            if given and isinstance(given[0], owner):
                return self._function(*given, **options)
            error = Reactive4dError(f"{owner.__name__}.{name}: called on the class, and it is for what is made of it")
            raise hint(error, f"with brackets: {owner.__name__}().{name}(…)")

        return called


def _way(function: F) -> F:
    return cast("F", _Way(function))


class Showable:
    """Whatever can be put before a reader: each way is a device.

    >>> import reactive4d as r4
    >>> issubclass(r4.Scene, Showable) and issubclass(r4.Illustration, Showable)
    True
    """

    __slots__ = ()

    def _ipython_display_(self) -> None:
        """As the last line of a cell it is shown; where there is no notebook, it is told as anything else."""
        if not device("display")(self):
            raise NotImplementedError

    def _display_(self) -> Any:
        """What marimo shows where a cell ends with it."""
        return self.show()

    @_way
    def show(self, **options: Any) -> Any:
        """Put it before a reader: in a window, or in a cell of a notebook."""
        return device("show")(self, **options)

    @_way
    def bake(self, path: str | Path, **options: Any) -> Any:
        """Write one page that needs no server: figure, player, controls.

        Args:
            path: of the file, .html.
            **options: `times`, seconds; a parameter's values by its name; `text`, `title`, `limit` and so on.
        """
        return device("bake")(self, path, **options)

    @_way
    def render(self, path: str | Path, **options: Any) -> Any:
        """Write what a reader sees: a still picture, a film, or a model of one instant.

        Args:
            path: of the file: .png; .mp4 (it needs `reactive4d[films]`), .gif, .webp; .glb.
            **options: `t` of one instant, seconds, or `times` and `rate` of a film; `size`, pixels; a parameter's value
                by its name, in a film also one for each picture.
        """
        return device("render")(self, path, **options)

    @_way
    def serve(self, *, port: int = 0, host: str = "127.0.0.1", **options: Any) -> Any:
        """Serve a page to many readers, each of whom is at a point of their own; it needs `reactive4d[trame]`.

        Args:
            port: 0 for any that is free.
            host: by default it can be reached from this machine alone.
            **options: `block`, whether to wait until ctrl-C; `text`, `title`, `times` and so on; a parameter's value
                by its name.
        """
        return device("serve")(self, port=port, host=host, **options)

    @_way
    def to_pyvista(self, t: float | None = None, **options: Any) -> Any:
        """What is drawn at one instant, as a `MultiBlock` of PyVista.

        Args:
            t: seconds; by default where the illustration's reader is, of a scene its beginning.
            **options: `space`, "world" or "local"; a parameter's value by its name.
        """
        return device("to_pyvista")(self, t, **options)
