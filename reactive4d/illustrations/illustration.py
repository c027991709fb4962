"""Illustrations: models whose parameters readers drive. A class has one model and one memo, a reader a point."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn

import param

from reactive4d.devices import Showable
from reactive4d.errors import ParameterError, Reactive4dError, ShapeError, hint
from reactive4d.illustrations.bookmarks import TAKEN, Bookmark, Look
from reactive4d.illustrations.builds import Shared, is_out_of_reach, refuse_keeping, refuse_value
from reactive4d.illustrations.controls import Control, control_of
from reactive4d.illustrations.kinds import admitted, declared, kind_of
from reactive4d.illustrations.settling import settle, values_of
from reactive4d.model.frames import Frame
from reactive4d.model.reaches import as_times
from reactive4d.model.scenes import Scene
from reactive4d.signals.facade import Signal
from reactive4d.signals.trees import is_a

__all__ = ["Illustration", "Signals"]


class Signals(Mapping[str, Signal[Any]]):
    """The parameters of an illustration as signals: `self.signals.length`.

    >>> import param
    >>> import reactive4d as r4
    >>> class Pole(r4.Illustration):
    ...     height = param.Number(1.0)
    ...
    ...     def build(self):
    ...         return r4.Scene(pole=r4.Cylinder(0.1, self.signals.height))
    >>> list(Pole().signals), Pole().signals.height.at(0.0, height=2.0)
    (['height'], 2.0)
    """

    __slots__ = ("_shared",)

    _shared: Shared

    def __init__(self, shared: Shared) -> None:
        object.__setattr__(self, "_shared", shared)

    def __getattr__(self, name: str) -> Signal[Any]:
        if name.startswith("__"):
            raise AttributeError(name)
        return self._shared.axis(name)

    def __setattr__(self, name: str, value: Any) -> NoReturn:
        raise hint(AttributeError(f"signals.{name} cannot be set"), f"a reader sets the parameter: fig.{name} = value")

    def __getitem__(self, name: str) -> Signal[Any]:
        try:
            return self._shared.axis(name)
        except AttributeError as error:
            raise hint(KeyError(name), error.__notes__[0].removeprefix("hint: ")) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._shared.axes)

    def __len__(self) -> int:
        return len(self._shared.axes)

    def __dir__(self) -> list[str]:
        return [*self]

    def __repr__(self) -> str:
        return f"<signals of {self._shared.owner.__name__}: {', '.join(self)}>"


class _OfClass:
    """The signals of a class, from the class itself and from any reader."""

    def __get__(self, reader: Any, owner: Any) -> Signals:
        return Signals(owner._shared)

    def __set__(self, reader: Any, value: Any) -> NoReturn:
        raise hint(AttributeError("signals cannot be set"), "a reader sets a parameter: fig.length = value")


class Illustration(Showable, param.Parameterized):
    """A model whose parameters readers drive; `build` describes it once for all of them.

    Parameters are declared with param: Number, Integer, Magnitude, Boolean, Selector, Color, Range and XYCoordinates.
    In `build` they are signals, `self.signals.length`; a reader sets their values, `pendulum.length = 1.5`. All readers
    of a class share its model and its memo: what one has asked for costs the next one nothing.

    A class may say over which `times` it is shown, (start, stop) in seconds; else this follows from its keys.

    >>> import numpy as np
    >>> import param
    >>> import reactive4d as r4
    >>> class Pendulum(r4.Illustration):
    ...     length = param.Number(1.0, bounds=(0.2, 2.0), doc="length of the rod [m]")
    ...
    ...     def build(self):
    ...         length = self.signals.length
    ...         bob = r4.Sphere(0.1, color="crimson")
    ...         bob.translate(r4.vec(0, 0, -length))
    ...         bob.rotate(20 * np.cos(np.sqrt(9.81 / length) * r4.time), axis="y")
    ...         return r4.Scene(bob=bob)
    >>> short, long = Pendulum(length=0.5), Pendulum(length=2.0)
    >>> short.at(0.0)["bob"].matrix[:3, 3].round(3).tolist(), long.at(0.0)["bob"].matrix[:3, 3].round(3).tolist()
    ([-0.171, 0.0, -0.47], [-0.684, 0.0, -1.879])
    >>> short.scene is long.scene
    True
    >>> long.length = 9
    Traceback (most recent call last):
    ...
    ValueError: Number parameter 'Pendulum.length' must be at most 2.0, not 9.
    """

    signals = _OfClass()

    _shared: ClassVar[Shared]
    _time: float | None = None
    _camera: Look | None = None

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        for base in cls.__mro__:
            if base is not Illustration and not issubclass(Illustration, base):
                for name, value in vars(base).items():
                    if isinstance(value, param.Parameter):
                        _refuse_taken(cls, name)
        own = vars(cls).get("times")
        if own is not None and not isinstance(own, property):
            type.__setattr__(cls, "times", as_times(own, f"{cls.__name__}.times"))
        type.__setattr__(cls, "_shared", Shared(cls))

    def __getattribute__(self, name: str) -> Any:
        if name[:1] != "_" and is_out_of_reach(self):
            refuse_value(self, name)
        return super().__getattribute__(name)

    def __setattr__(self, name: str, value: Any) -> None:
        if is_a(value, Signal) and name in (known := declared(type(self))) and kind_of(known[name]) is not None:
            admitted(known[name], value)
        refuse_keeping(self, name)
        super().__setattr__(name, value)

    # -- the model -------------------------------------------------------------------------------------------------

    def build(self) -> Scene:
        """Describe the model, once for all readers of the class; to be written by whoever makes an illustration.

        Raises:
            EvaluationError: a parameter's value is read, which is one reader's; `self.signals` has the parameters.
        """
        error = Reactive4dError(f"{type(self).__name__} has no build()")
        raise hint(error, "def build(self): … return r4.Scene(…)")

    @property
    def scene(self) -> Scene:
        """The model that all readers of the class share: an edit of it is seen by all of them.

        What it is at a point needs a reader's values: `fig.at(t)`, or `fig.scene.at(t, length=2)`. Its objects are
        fixed: one that is there for a while only has `visible`.
        """
        return type(self)._shared.scene(self)

    if TYPE_CHECKING:  # a class says it with a plain attribute: times = (0, 6)
        times: tuple[float, float]
    else:

        @property
        def times(self) -> tuple[float, float]:
            """Over which time it is shown, seconds: what the class says, else what follows from the scene."""
            return self.scene.times

    # -- the reader ------------------------------------------------------------------------------------------------

    def at(self, t: float, /, **parameters: Any) -> Frame:
        """What a viewer needs at a time, with this reader's parameters.

        Args:
            t: seconds.
            **parameters: values for this once; those not named are the reader's.

        Raises:
            ParameterError: a value that this reader cannot have, in the words of param.
            UnknownNameError: there is no parameter of that name.
        """
        scene = self.scene
        own = values_of(self, parameters)
        others = {name: value for name, value in parameters.items() if name not in own}
        return scene.at(t, **own, **others)

    @property
    def controls(self) -> tuple[Control, ...]:
        """How this reader drives each parameter, in their order, as things are now."""
        known = declared(self)
        return tuple([control_of(known[name]) for name in type(self)._shared.axes])

    @property
    def point(self) -> Bookmark:
        """Where this reader is: a time, the values of the parameters, and where they look from; it can be set.

        Setting it sets the parameters that it names, all of them or, where one is refused, none.
        """
        given = {control.name: control.encode(getattr(self, control.name)) for control in self.controls}
        return Bookmark(self.times[0] if self._time is None else self._time, given, self._camera)

    @point.setter
    def point(self, value: Bookmark) -> None:
        if not isinstance(value, Bookmark):  # pyright: ignore[reportUnnecessaryIsInstance]
            error = ShapeError(f"point: expected a Bookmark, got {value!r}")
            raise hint(error, "of a link: r4.Bookmark.from_link(text, fig)")
        settle(self, value.parameters)
        self._time, self._camera = value.time, value.camera


def _refuse_taken(cls: type, name: str) -> None:
    """Raise if a parameter has a name that means something else already."""
    if name in (*TAKEN, "serve") or (name != "name" and hasattr(Illustration, name)):
        error = ParameterError(f"{cls.__name__}.{name} cannot be a parameter: the name has a meaning of its own")
        raise hint(error, f"such as {name}_; what is taken are `t`, `cam`, `time`, and what every illustration has")


type.__setattr__(Illustration, "_shared", Shared(Illustration))
