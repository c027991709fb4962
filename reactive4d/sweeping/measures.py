"""Measures: what is asked at every point, as signals of the model."""

import re
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from reactive4d.engine import Cell
from reactive4d.errors import ShapeError, hint, unknown
from reactive4d.model.objects import Object
from reactive4d.model.scenes import Scene
from reactive4d.signals.facade import Signal
from reactive4d.sweeping.pictures import Picture

__all__ = ["check_measures", "named", "refuse_taken", "signals_of"]

_STEP = re.compile(r"\.(\w+)|\[(-?\d+)\]")
_PATH = re.compile(r"(?P<object>[^.\[\]]+)(?P<steps>(?:\.\w+|\[-?\d+\])*)")


def check_measures(measure: Mapping[str, Any]) -> None:
    """Raise if there are no measures, or one has no name that could be a variable's.

    Raises:
        ShapeError: as it says.
    """
    if not isinstance(measure, Mapping) or not measure:  # pyright: ignore[reportUnnecessaryIsInstance]
        error = ShapeError(f"measure: expected what to ask for by name, got {measure!r}")
        raise hint(error, 'measure={"height": lambda scene: scene["bob"].position[2]}')
    for name in measure:
        if not isinstance(name, str) or not name or "/" in name:  # pyright: ignore[reportUnnecessaryIsInstance]
            raise hint(ShapeError(f"measure: {name!r} is not a name"), "a string without a slash")


def refuse_taken(measure: Iterable[str], taken: Iterable[str]) -> None:
    """Raise if a measure is called like something else in the dataset.

    Args:
        measure: the names of the measures.
        taken: the names of coordinates.

    Raises:
        ShapeError: as it says.
    """
    reserved = {*taken, "error", "status", "time"}
    for name in measure:
        if name in reserved:
            raise hint(ShapeError(f"measure: the name {name!r} is taken"), f"call it {name}_measured, say")


def signals_of(measure: Mapping[str, Any], scene: Scene) -> dict[str, Cell]:
    """The signals that are asked at every point, by the names of the measures.

    Raises:
        TypeError: a measure is no signal, and does not answer one for the scene.
        UnknownNameError: a path that leads nowhere.
    """
    return {name: _signal(name, given, scene) for name, given in measure.items()}


def _signal(name: str, given: Any, scene: Scene) -> Cell:
    found: Any = given
    if isinstance(given, Picture):
        return scene.frame
    if isinstance(given, str):
        found = named(given, scene)
    elif not isinstance(given, Cell) and callable(given):
        found = _called(name, given, scene)
    if isinstance(found, Cell):
        return found
    if isinstance(found, Object):
        error = TypeError(f"measure {name!r}: expected a signal, got the object {found.name}")
        raise hint(error, f"one of its channels: {found.name}.position, {found.name}.volume")
    error = TypeError(f"measure {name!r}: expected a signal, got {found!r}")
    told = "the function is called once, with the scene, and answers a signal: scene['bob'].position, without .at(t)"
    raise hint(error, told if callable(given) else "a signal, a function of the scene, or a path: 'bob.position[2]'")


def _called(name: str, function: Callable[[Scene], Any], scene: Scene) -> Any:
    try:
        return function(scene)
    except Exception as error:
        error.add_note(f"while making the measure {name!r}")
        raise


def named(path: str, scene: Scene) -> Signal[Any]:
    """The signal that a path names: an object's attribute or channel, or a component of it.

    Raises:
        UnknownNameError: there is no such thing.

    >>> import reactive4d as r4
    >>> scene = r4.Scene(ball=r4.Sphere(radius=2))
    >>> named("ball.radius", scene).at(0.0), named("ball.position[2]", scene).at(0.0)
    (2.0, 0.0)
    """
    match = _PATH.fullmatch(path.strip())
    if match is None:
        raise hint(ShapeError(f"{path!r} is not a path"), "an object and what is asked of it: bob.position[2]")
    name = match["object"]
    found: Any = scene.signals.get(name)
    if name in scene:
        found = scene[name]
    elif found is None:
        raise unknown(name, [*scene, *scene.signals], what="object")
    for attribute, index in _STEP.findall(match["steps"]):
        if index:
            found = found[int(index)]
            continue
        part: Any = None if attribute.startswith("_") else getattr(found, attribute, None)
        if part is None or (callable(part) and not isinstance(part, Cell)):
            known = [x for x in dir(found) if not x.startswith("_") and isinstance(getattr(found, x, None), Cell)]
            raise unknown(attribute, known, what=f"attribute of {name}")
        found = part
    return found
