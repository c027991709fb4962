"""Builds: what all readers of one class share: its axes, and the scene that `build()` makes of them, once.

While a build runs, and inside of every evaluation, a reader's own values are out of reach: what is built is for all
readers, and must name the parameter instead, `self.signals.length`.
"""

import sys
import threading
from typing import Any

import param

from reactive4d.engine.frames import here
from reactive4d.errors import EvaluationError, ShapeError, hint, unknown
from reactive4d.illustrations.axes import Driven
from reactive4d.illustrations.kinds import declared, in_order, kind_of, path_of, refused_kind
from reactive4d.model.scenes import Scene
from reactive4d.signals.functions import finished

__all__ = ["Shared", "is_out_of_reach", "refuse_keeping", "refuse_value"]


# One lock for all classes: builds are rare, and two that wait for each other would wait for ever.
_LOCK = threading.RLock()


class _Desk(threading.local):
    """Whose `build()` runs in this thread."""

    reader: Any = None


_desk = _Desk()


class Shared:
    """What all readers of a class share.

    Args:
        owner: the class.
    """

    def __init__(self, owner: type[param.Parameterized]) -> None:
        self.owner = owner
        self._axes: dict[str, Driven[Any]] = {}
        self._scene: Scene | None = None
        self._is_building = False

    @property
    def axes(self) -> dict[str, Driven[Any]]:
        """The axes of all parameters that can be driven, by name."""
        return {name: self.axis(name) for name in in_order(self.owner)}

    def axis(self, name: str) -> Driven[Any]:
        """The axis of one parameter.

        Raises:
            ParameterError: it cannot be driven.
            AttributeError: there is none of that name.
        """
        found = self._axes.get(name)
        if found is not None:
            return found
        parameters = declared(self.owner)
        if name not in parameters:
            known = [other for other, parameter in parameters.items() if kind_of(parameter) is not None]
            near = unknown(name, known, what="parameter")
            error = AttributeError(f"{self.owner.__name__} has no parameter {name!r}")
            if hasattr(self.owner, name) and not callable(getattr(self.owner, name)):
                raise hint(
                    error, f"it is a plain attribute of the class: {name} = param.Number(…) declares a parameter"
                )
            raise hint(error, near.__notes__[0].removeprefix("hint: "))
        if kind_of(parameters[name]) is None:
            raise refused_kind(parameters[name])
        with _LOCK:
            return self._axes.setdefault(name, Driven(self.owner, name))

    def scene(self, reader: Any) -> Scene:
        """The scene, built by the reader who asks first; whoever asks meanwhile waits.

        Raises:
            EvaluationError: the build asks for its own scene, or it is asked for inside of an evaluation.
            ShapeError: the build did not answer a scene.
            Exception: whatever the build raised; the next who asks tries again.
        """
        scene = self._scene
        if scene is not None:
            return scene
        name = self.owner.__name__
        if here.me.frame is not None:
            error = EvaluationError(f"{name} would be built inside of the evaluation of {here.me.frame.cell.name}")
            raise hint(error, "ask for its scene once before")
        with _LOCK:
            if self._scene is None:
                if self._is_building:
                    error = EvaluationError(f"{name}.build() asks for what it is about to build")
                    raise hint(error, "self.scene and self.at are there once it has returned")
                self._scene = self._built(reader)
            return self._scene

    def _built(self, reader: Any) -> Scene:
        name = self.owner.__name__
        before = _desk.reader
        _desk.reader, self._is_building = reader, True
        try:
            finished(reader.build, f"{name}.build")
            scene: Any = reader.build()
        except Exception as error:
            error.add_note(f"while building {name}")
            raise
        finally:
            _desk.reader, self._is_building = before, False
        if not isinstance(scene, Scene):
            raise hint(
                ShapeError(f"{name}.build(): expected a Scene, got {scene!r}"), "end it with: return r4.Scene(rod=rod)"
            )
        scene.fix(name)
        return scene


def is_out_of_reach(reader: Any) -> bool:
    """Whether a reader's own values must not be read here."""
    return _desk.reader is reader or here.me.frame is not None


def refuse_value(reader: Any, name: str) -> None:
    """Raise if a parameter's value is read where it would be one reader's, and what is made of it is for all."""
    parameter = declared(type(reader)).get(name) if name != "name" else None
    if parameter is None or _is_from_param():
        return
    if _desk.reader is reader:
        error = EvaluationError(f"{path_of(parameter)} was read in build(), which runs once for all readers")
    else:
        cell = here.me.frame.cell.name  # pyright: ignore[reportOptionalMemberAccess]
        error = EvaluationError(f"{path_of(parameter)} was read in the evaluation of {cell}, which is for all readers")
    if kind_of(parameter) is None:
        raise hint(
            error, f"the kind {type(parameter).__name__} cannot be driven: what all readers share is no parameter"
        )
    raise hint(error, f"self.signals.{name} is the parameter as a signal")


def refuse_keeping(reader: Any, name: str) -> None:
    """Raise if `build()` keeps something on the reader who happened to ask first."""
    if _desk.reader is reader and not _is_from_param():
        error = EvaluationError(f"{type(reader).__name__}.build() sets self.{name}, which other readers would not have")
        raise hint(error, "objects are found by name, self.scene['bob']; what is needed in build() alone is a variable")


def _is_from_param() -> bool:
    """Whether it is param that reads or sets, as it does to show or copy a reader."""
    frame = sys._getframe(3)  # pyright: ignore[reportPrivateUsage]
    return str(frame.f_globals.get("__name__", "")).partition(".")[0] == "param"
