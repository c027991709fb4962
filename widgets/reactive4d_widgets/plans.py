"""Plans: what is to be asked for a page: the channels of all nodes, over which time, for which values of parameters."""

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from functools import cached_property
from typing import Any

from reactive4d.arrays import ARRAY
from reactive4d.errors import ParameterError, Reactive4dError, ShapeError, hint, unknown
from reactive4d.illustrations import Control, Subject, subject
from reactive4d.model.reaches import key_times
from reactive4d_widgets.channels import values_of
from reactive4d_widgets.rosters import roster
from reactive4d_widgets.seats import Channel, Seat
from reactive4d_widgets.spans import Span, span_of
from reactive4d_widgets.sweeps import Asker

__all__ = ["Plan", "planned"]

MOST_STOPS = 1000
LONGEST = 1000  # letters of a name


class Plan:
    """What is to be asked, and who asks.

    Attributes:
        subject: what is to be shown.
        span: over which time.
        asker: who asks, and for which values of the parameters.
        seats: the nodes.
        values: the channels of named values.
        controls: how a reader drives the parameters, by name.
        opens: the values of the parameters at which the page is to open, where it can.
    """

    def __init__(
        self,
        shown: Subject,
        span: Span,
        *,
        base: Mapping[str, Any],
        stops: Mapping[str, tuple[Any, ...]],
        opens: Mapping[str, Any],
    ) -> None:
        self.subject = shown
        self.span = span
        self.opens = dict(opens)
        self.controls: dict[str, Control] = {control.name: control for control in shown.controls}
        self.asker = Asker(span, base, stops)
        self.seats: list[Seat] = roster(dict(shown.scene), self.asker.said)
        self.values: list[Channel] = values_of(shown.scene.signals)

    @property
    def channels(self) -> list[Channel]:
        """All channels, in the order of the nodes."""
        return [channel for seat in self.seats for channel in seat.channels.values()] + self.values

    @cached_property
    def keys(self) -> tuple[float, ...]:
        """The times of all keys, in their order."""
        return key_times(self.subject.scene)

    @property
    def linear(self) -> frozenset[str]:
        """The parameters that have values between their values."""
        return frozenset(name for name, control in self.controls.items() if control.kind == "number")


def planned(
    shown: Any,
    *,
    times: Any = None,
    parameters: Mapping[str, Any] | Callable[[Collection[str]], Mapping[str, Any]] | None = None,
) -> Plan:
    """The plan of a scene or an illustration.

    Args:
        shown: a Scene, an Illustration or its class.
        times: None for its own span, (start, stop), or evenly spaced times.
        parameters: by name, either one value, or several, for all of which the page is made; or a function that makes
            these of the names of all parameters.

    Raises:
        TimeError: times that are neither.
        UnknownNameError: a parameter that nobody knows.
        ParameterError: a value that its parameter does not admit.
        ShapeError: a name of more than a thousand letters, or one that a value shares with a parameter.
        Reactive4dError: the scene is empty.

    >>> import reactive4d as r4
    >>> plan = planned(r4.Scene(ball=r4.Sphere()), times=(0, 2))
    >>> plan.span.count, [seat.name for seat in plan.seats]
    (60, ['ball'])
    """
    found = subject(shown)
    if not len(found.scene):
        raise hint(Reactive4dError("the scene is empty"), 'name an object in it: scene["ball"] = r4.Sphere()')
    span = span_of(times, found.times)
    controls = {control.name: control for control in found.controls}
    opens = {name: _opening(control, found.point.parameters) for name, control in controls.items()}
    base = dict(opens)
    stops: dict[str, tuple[Any, ...]] = {}
    given = parameters(controls) if callable(parameters) else parameters
    for name, value in (given or {}).items():
        control = controls.get(name)
        if control is None:
            raise unknown(name, controls, what="parameter")
        values = _values(control, value)
        base[name] = min(values, key=lambda one, wish=opens[name]: _distance(one, wish))
        if len(values) > 1:
            stops[name] = tuple(values)
        if len(values) == 1 or (control.kind == "number" and not values[0] <= opens[name] <= values[-1]):
            opens[name] = base[name]
    plan = Plan(found, span, base=base, stops=stops, opens=opens)
    _refuse_wrong_names(plan)
    return plan


def _refuse_wrong_names(plan: Plan) -> None:
    """What a viewer takes for a mistake is told before it is asked for."""
    named = {
        "object": [seat.name for seat in plan.seats],
        "value": [channel.what.removeprefix("values.") for channel in plan.values],
        "parameter": list(plan.controls),
        "handle": [handle["label"] for handle in plan.subject.handles],
        "scene": [plan.subject.title],
    }
    for name in named["value"]:
        if name in plan.controls:
            error = ShapeError(f"a value and a parameter are both called {name!r}")
            raise hint(error, f"give the value another name in scene.signals: what {{{name}}} means has to be plain")
    for what, names in named.items():
        for name in names:
            count = len(name.encode("utf-16-le", "surrogatepass")) // 2  # as JavaScript counts
            if count > LONGEST:
                error = ShapeError(f"the name of the {what} {name[:40]!r}… has {count} letters")
                raise hint(error, f"at most {LONGEST}; of a member of groups, the names of the groups count, too")


def _opening(control: Control, wires: Mapping[str, Any]) -> Any:
    return control.decode(wires.get(control.name, control.default))


def _values(control: Control, given: Any) -> list[Any]:
    """The values that an author gave, as the parameter understands them; numbers in their order, each once."""
    if control.constant:
        raise ParameterError(f"{control.name}: it is the same for all readers, and takes no values")
    if isinstance(given, Iterator):  # it can be gone through only once
        given = list(given)  # pyright: ignore[reportUnknownVariableType,reportUnknownArgumentType]
    several = list(given) if is_several(control, given) else [given]
    if not several:
        error = ParameterError(f"{control.name}: expected one value or more, got {given!r}")
        raise hint(error, f"{control.name}=[{control.default!r}]; leave it out to keep the value with which it opens")
    if len(several) > MOST_STOPS:
        raise ParameterError(f"{control.name}: {len(several)} values are too many, at most {MOST_STOPS}")
    kept: dict[str, Any] = {}
    for value in several:
        value = value.item() if hasattr(value, "item") and not getattr(value, "ndim", 0) else value
        if isinstance(value, ARRAY):
            value = tuple(value.tolist())
        wire = control.encode(_plain(value) if isinstance(value, float) else value)
        kept[repr(wire)] = control.decode(wire)
    values = list(kept.values())
    return sorted(values) if control.kind in ("number", "integer") else values


def _plain(number: float) -> float:
    """0.3 for 0.30000000000000004: what evenly spaced values are meant to be."""
    rounded = float(f"{number:.12g}")
    return rounded if abs(rounded - number) <= 4.0 * math.ulp(number) else number


def is_several(control: Control, given: Any) -> bool:
    """Whether these are several values, and not one that consists of several numbers, or of letters."""
    if isinstance(given, str | bytes | Mapping) or not isinstance(given, Iterable) or getattr(given, "ndim", 1) == 0:  # pyright: ignore
        return False
    parts: list[Any] = list(given)  # pyright: ignore
    if control.kind in ("range", "xy"):
        return not all(isinstance(part, int | float) or not getattr(part, "ndim", 1) for part in parts)
    return control.kind != "select" or not any(choice is given for choice in control.choices)


def _distance(value: Any, other: Any) -> float:
    """How far two values of a parameter are from each other; only numbers are near each other."""
    if isinstance(value, int | float) and isinstance(other, int | float):
        return abs(value - other)
    return 0.0 if value == other else 1.0
