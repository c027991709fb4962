"""Subjects: what a device has to know of whatever it shows, be it a scene or an illustration."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from reactive4d.errors import ParameterError, ShapeError, UnknownNameError, hint, unknown
from reactive4d.illustrations.bookmarks import TAKEN, Bookmark
from reactive4d.illustrations.controls import Control, control_of_axis
from reactive4d.illustrations.illustration import Illustration
from reactive4d.illustrations.settling import settle, twin
from reactive4d.model.handles import Handle, node_name
from reactive4d.model.reaches import parameters_of
from reactive4d.model.scenes import Scene

__all__ = ["Subject", "subject"]

NO_PARAMETERS = "the scene has no parameters; something in it has to read one, an r4.Parameter or one of self.signals"


@dataclass(frozen=True, slots=True, kw_only=True)
class Subject:
    """What a device shows, as data.

    Attributes:
        thing: the scene or the illustration itself.
        name: as a page calls it: small letters, words joined by hyphens.
        title: for a person to read.
        doc: what its class says of it, the first paragraph.
        scene: the model.
        times: (start, stop), seconds.
        controls: how a reader drives each parameter, as things are at the point.
        handles: what readers can take hold of, as a page knows it.
        point: where a reader begins.

    >>> import reactive4d as r4
    >>> size = r4.Parameter("size", 1.0, bounds=(0.5, 2.0), doc="across [m]")
    >>> about = subject(r4.Scene(ball=r4.Sphere(size / 2)))
    >>> about.name, [control.name for control in about.controls], about.values
    ('scene', ['size'], {'size': 1.0})
    >>> about.settled({"size": 9}, strict=False)
    {'size': 2.0}
    """

    thing: Any
    name: str
    title: str
    doc: str
    scene: Scene
    times: tuple[float, float]
    controls: tuple[Control, ...]
    handles: tuple[dict[str, Any], ...]
    point: Bookmark

    def control(self, name: str) -> Control:
        """The control of one parameter.

        Raises:
            UnknownNameError: there is none.
        """
        for control in self.controls:
            if control.name == name:
                return control
        raise unknown(name, [control.name for control in self.controls], what="parameter")

    @property
    def values(self) -> dict[str, Any]:
        """The values of all parameters at the point, as signals take them: `scene.at(t, **subject.values)`."""
        return {control.name: control.decode(self.point.parameters[control.name]) for control in self.controls}

    def settled(self, wires: Mapping[str, Any], *, strict: bool = True) -> dict[str, Any]:
        """The values of all parameters, as they travel, once these were set.

        Args:
            wires: values by name, as they travel; the others are those of the point.
            strict: whether what cannot be is refused; else it is moved into the bounds, or left out.

        Raises:
            UnknownNameError: strict, and there is no parameter of that name.
            ParameterError: strict, and a value is refused.
        """
        return dict(self.moved(wires, strict=strict).point.parameters)

    def moved(self, wires: Mapping[str, Any], *, strict: bool = True) -> "Subject":
        """The same at another point, where bounds and what is hidden may be others; the reader stays where they are.

        Raises:
            UnknownNameError: strict, and there is no parameter of that name.
            ParameterError: strict, and a value is refused.
        """
        known = {control.name for control in self.controls}
        if strict:
            for name in wires:
                self.control(name)
        own: dict[str, Any] = {name: wire for name, wire in wires.items() if name in known}
        thing = self.thing
        if isinstance(thing, Illustration):
            # Values that came from outside are tried with a reader of their own: the bounds may depend on them.
            thing = twin(thing)
            names = {control.name for control in thing.controls}
            settle(thing, {name: wire for name, wire in own.items() if name in names}, strict=strict)
            own = {name: wire for name, wire in own.items() if name not in names}
        described = subject(thing)
        given = {**self.point.parameters, **described.point.parameters} if thing is not self.thing else {}
        values = {**self.point.parameters, **given}
        for name, wire in own.items():
            control = described.control(name)
            try:
                values[name] = control.encode(control.decode(wire)) if strict else control.admit(wire)
            except ParameterError:
                if strict:
                    raise
        return replace(described, thing=thing, point=Bookmark(self.point.time, values, self.point.camera))


def subject(thing: Any, /) -> Subject:
    """What a device has to know of a scene, an illustration, or a class of illustrations.

    Raises:
        ShapeError: it is none of these, or a handle has parameters that do not fit.
        UnknownNameError: a handle has a parameter that the scene does not know.
        ParameterError: a parameter is called `t`, `time` or `cam`, or like another one.
        Exception: whatever the illustration's build raises.
    """
    if isinstance(thing, type) and issubclass(thing, Illustration):
        thing = thing()
    if isinstance(thing, Illustration):
        name, scene, controls, point = type(thing).__name__, thing.scene, thing.controls, thing.point
        doc = (type(thing).__doc__ or "") if type(thing) is not Illustration else ""
        times = thing.times
    elif isinstance(thing, Scene):
        name, scene, controls, doc, times = type(thing).__name__, thing, (), "", thing.times
        point = Bookmark(times[0])
    else:
        error = ShapeError(f"expected a scene or an illustration, got {thing!r}")
        raise hint(error, "of an object: r4.Scene(it=…)")
    others = [control_of_axis(axis) for axis in parameters_of(scene) if not _is_among(axis, controls, thing)]
    controls = (*controls, *[control for control in others if control is not None])
    for control in controls:
        if control.name in TAKEN:
            error = ParameterError(f"the scene reads a parameter called {control.name!r}, which has another meaning")
            raise hint(error, "in links and for players `t` and `time` are the time, and `cam` is the camera")
    given = {control.name: point.parameters.get(control.name, control.default) for control in controls}
    return Subject(
        thing=thing,
        name="-".join(_words(name)).lower(),
        title=" ".join(_words(name)).capitalize(),
        doc=" ".join(doc.strip().partition("\n\n")[0].split()),
        scene=scene,
        times=times,
        controls=controls,
        handles=tuple([_described(scene, one, controls) for one in scene.handles]),
        point=Bookmark(point.time, given, point.camera),
    )


def _is_among(axis: Any, controls: Iterable[Control], thing: Any) -> bool:
    """Whether an axis below the scene is one of the illustration's own.

    Raises:
        ParameterError: it is another one of the same name.
    """
    if not any(control.name == axis.name for control in controls):
        return False
    if thing.signals[axis.name] is not axis:
        error = ParameterError(f"the scene reads two different parameters that are both called {axis.name!r}")
        raise hint(error, f"one is {type(thing).__name__}'s own; give the other one another name")
    return True


def _words(name: str) -> list[str]:
    return re.findall(r"[0-9]+[A-Z]*(?![a-z])|[A-Z]+(?![a-z])|[A-Z]?[a-z]+", name) or [name]


def _described(scene: Scene, one: Handle, controls: tuple[Control, ...]) -> dict[str, Any]:
    """A handle as a page knows it.

    Raises:
        UnknownNameError: there is no such parameter.
        ShapeError: a parameter is not of the kind that such a handle moves.
    """
    wanted = ("xy",) if len(one.axes) > len(one.parameters) else ("number", "integer")
    for name in one.parameters:
        found = next((control for control in controls if control.name == name), None)
        if found is None:
            what = f"parameter of the handle {one.label}:"
            if not controls:
                raise hint(UnknownNameError(f"unknown {what} {name!r}"), NO_PARAMETERS)
            raise unknown(name, [control.name for control in controls], what=what)
        if found.kind not in wanted:
            error = ShapeError(f"the handle {one.label} moves {name}, a parameter of the kind {found.kind}")
            raise hint(error, f"{' or '.join(wanted)}: x=, y=, z= and angle= take numbers, xy= takes XYCoordinates")
    return {
        "node": node_name(scene, one.object) or "",
        "parameters": list(one.parameters),
        "axes": list(one.axes),
        "label": one.label,
        "kind": one.kind,
    }
