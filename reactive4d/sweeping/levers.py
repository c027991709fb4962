"""Levers: what a sweep has to know of each parameter that it moves."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

from reactive4d.engine import Axis, engine
from reactive4d.errors import ParameterError, hint, unknown

__all__ = ["TIME", "Lever", "lever_of", "levers_of", "lookup"]

TIME: Final = "time"


@dataclass(frozen=True)
class Lever:
    """One parameter, as a sweep moves it.

    Attributes:
        name: the parameter's.
        doc: what it means.
        unit: of its numbers.
        check: the value as the parameter understands it; raises ParameterError where it does not.
        default: where it stands if nobody moves it.
        range: (lowest, highest), of whole numbers for a whole number; a list of choices; None where that is open.
        constant: whether it cannot be moved.
        labels: choices that are no plain values, by their names.
    """

    name: str
    doc: str
    unit: str
    check: Callable[[Any], Any]
    default: Any
    range: tuple[float, float] | list[Any] | None = None
    constant: bool = False
    labels: Mapping[str, Any] | None = None

    def admit(self, value: Any) -> Any:
        """A value as the parameter understands it; a choice may be given by its name.

        Raises:
            ParameterError: it does not take it.
        """
        try:
            return self.check(value)
        except ParameterError as error:
            if self.labels is not None and isinstance(value, str) and value in self.labels:
                return self.check(self.labels[value])
            if not str(error).startswith(self.name):
                raise ParameterError(f"{self.name}: {error}") from None
            raise

    def shown(self, value: Any) -> Any:
        """An admitted value as a label: a choice that is no plain value by its name."""
        for label, choice in (self.labels or {}).items():
            if choice is value:
                return label
        return value


def levers_of(controls: Mapping[str, Any]) -> dict[str, Lever]:
    """Levers of an illustration's controls."""
    found: dict[str, Lever] = {}
    for name, control in controls.items():
        bounds, options = control.bounds or control.soft, control.options
        reach: Any = None
        if options is not None:
            reach = list(control.choices)
        elif control.kind == "boolean":
            reach = [False, True]
        elif bounds is not None and None not in bounds and control.kind in ("number", "integer"):
            reach = tuple([int(x) if control.kind == "integer" else float(x) for x in bounds])
        labels = dict(zip(control.labels, control.choices, strict=True)) if options is not None else None
        found[name] = Lever(
            name, control.doc, control.unit, control.check, control.check(control.decode(control.default)), reach,
            control.constant, labels,
        )  # fmt: skip
    return found


def lever_of(axis: Axis) -> Lever:
    """The lever of a parameter of a plain scene."""
    doc, _, unit = str(getattr(axis, "doc", "")).rpartition("[")
    is_told = bool(doc) and unit.endswith("]")
    bounds: Any = getattr(axis, "bounds", None)
    reach: Any = None
    if isinstance(axis.default, bool):
        reach = [False, True]
    elif bounds is not None and all(abs(x) != float("inf") for x in bounds):
        reach = tuple([int(x) if isinstance(axis.default, int) else float(x) for x in bounds])
    return Lever(
        axis.name,
        doc.strip() if is_told else str(getattr(axis, "doc", "")).strip(),
        unit[:-1].strip() if is_told else "",
        axis.admit,
        axis.default,
        reach,
    )


def _any_of(axes: Sequence[Axis]) -> Callable[[Any], Any]:
    """What one of several parameters of a name takes."""

    def check(value: Any) -> Any:
        for axis in axes[:-1]:
            try:
                return axis.admit(value)
            except ParameterError:
                continue
        return axes[-1].admit(value)

    return check


def lookup(name: str, known: Mapping[str, Lever], *, is_closed: bool) -> Lever:
    """The lever of a name.

    Args:
        name: the parameter's.
        known: those that the model is known to have.
        is_closed: whether it has no others; else any parameter of that name will do, since what a Python function
            reads is seen only when it runs.

    Raises:
        UnknownNameError: there is none.
        ParameterError: it is constant.
    """
    found = known.get(name)
    if found is None and not is_closed:
        live = list(engine.axes.get(name, ()))
        if live:
            return replace(lever_of(live[0]), check=_any_of(live))
    if found is None:
        names = [*known, TIME]
        error = unknown(name, names, what="parameter")
        if "did you mean" in error.__notes__[0]:
            error.add_note(f"there are {', '.join(map(repr, sorted(names)))}")
        raise error
    if found.constant:
        raise hint(ParameterError(f"{name} is constant, {found.default!r}"), "leave it out of the sweep")
    return found
