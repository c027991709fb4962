"""Subjects: what is swept, an illustration, a scene or a function that makes a scene; and how it travels to workers."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from reactive4d.arrays import same
from reactive4d.engine import Axis, Cell
from reactive4d.errors import Reactive4dError, ShapeError, hint
from reactive4d.illustrations.illustration import Illustration
from reactive4d.illustrations.settling import values_of
from reactive4d.model.scenes import Scene
from reactive4d.sweeping.levers import Lever, lever_of, levers_of
from reactive4d.sweeping.readings import below

__all__ = ["Recipe", "Subject", "subject_of"]


@dataclass(frozen=True)
class Subject:
    """What is swept.

    Attributes:
        name: for labels and errors.
        doc: what it is about.
        scene: the model.
        levers: its parameters, as far as they are known beforehand.
        is_closed: whether it has no others.
        values: where the parameters stand that are not moved; those not named are at their defaults.
        given: what was given to be swept.
    """

    name: str
    doc: str
    scene: Scene
    levers: Mapping[str, Lever]
    is_closed: bool
    values: Mapping[str, Any]
    given: Any

    @property
    def thing(self) -> Any:
        """What devices take: the illustration or its class, or the scene."""
        return self.given if isinstance(self.given, Illustration | type) else self.scene

    def knowing(self, signals: Iterable[Cell]) -> "Subject":
        """The same, with the parameters known that some signals are seen to read."""
        seen = {axis.name: lever_of(axis) for axis in below(signals) if isinstance(axis, Axis)}
        return replace(self, levers={**seen, **self.levers})

    def recipe(self) -> "Recipe":
        """How another process makes the same.

        Raises:
            Reactive4dError: there is no way.
        """
        if not isinstance(self.given, Scene):
            return Recipe(make=self.given)
        from reactive4d.scefo.binding import dumps

        try:
            return Recipe(script=dumps(self.given))
        except Reactive4dError as problem:
            error = Reactive4dError("a scene cannot travel to other processes, unless it can be written as a script")
            error.add_note(f"it cannot: {problem}")
            raise hint(
                error, "give sweep(…) an Illustration, or a function that builds the scene, instead of the scene"
            ) from None


@dataclass(frozen=True)
class Recipe:
    """How another process makes a subject: from a script, or by what was given itself."""

    make: Any = None
    script: str | None = field(default=None, repr=False)

    def subject(self) -> Subject:
        """The subject, made here."""
        if self.script is None:
            return subject_of(self.make)
        from reactive4d.scefo.binding import loads

        return subject_of(loads(self.script))


def subject_of(given: Any) -> Subject:
    """What is to be swept.

    Raises:
        TypeError: it is no illustration, no scene, and no function that makes a scene.
    """
    if isinstance(given, type) and issubclass(given, Illustration):
        return _illustrated(given(), given)
    if isinstance(given, Illustration):
        return _illustrated(given, given)
    if isinstance(given, Scene):
        return _plain(given, given, "scene")
    if isinstance(given, type) or not callable(given):
        error = TypeError(f"sweep: expected an Illustration, a Scene, or a function that makes one, got {given!r}")
        raise hint(error, "sweep(Pendulum, over={…}, measure={…})")
    return _made(given)


def _illustrated(reader: Illustration, given: Any) -> Subject:
    cls = type(reader)
    levers = levers_of({control.name: control for control in reader.controls})
    signals: Any = reader.signals
    own = {name: value for name, value in values_of(reader, {}).items() if not same(value, signals[name].default)}
    doc = "" if cls.__doc__ is Illustration.__doc__ else " ".join((cls.__doc__ or "").partition("\n\n")[0].split())
    return Subject(cls.__name__, doc, reader.scene, levers, True, own, given)


def _made(make: Callable[[], Any]) -> Subject:
    name = str(getattr(make, "__name__", "scene"))
    scene = make()
    if not isinstance(scene, Scene):
        error = ShapeError(f"sweep: {name}() answered {scene!r}, expected a Scene")
        raise hint(error, "end it with: return r4.Scene(…)")
    return _plain(scene, make, name)


def _plain(scene: Scene, given: Any, name: str) -> Subject:
    return Subject(name, "", scene, {}, False, {}, given)
