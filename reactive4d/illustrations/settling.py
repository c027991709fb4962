"""Settling: what values a reader has, and how several are set where the bounds of one depend on the value of another.

What is refused at first is tried again after the others were set: their watchers may have moved its bounds. So the
order in which values come, from a link or from a page, does not count.
"""

from collections.abc import Mapping
from typing import Any

from reactive4d.arrays import same
from reactive4d.errors import ParameterError, Reactive4dError, hint, unknown
from reactive4d.illustrations.controls import Control, control_of
from reactive4d.illustrations.kinds import admitted, declared, kind_of

__all__ = ["settle", "twin", "values_of"]

MOST_ROUNDS = 3  # a watcher may set again what was set before it ran
MOVED = ("bounds", "inclusive_bounds", "softbounds", "step", "constant", "precedence", "allow_None")


def values_of(reader: Any, given: Mapping[str, Any], /) -> dict[str, Any]:
    """A reader's values of all parameters that can be driven, as signals take them, by name.

    Args:
        reader: an illustration.
        given: values in place of the reader's, for this once.

    Raises:
        ParameterError: a value that this reader cannot have.
    """
    axes: dict[str, Any] = reader._shared.axes
    mine, known = reader.param.values(), declared(reader)
    found: dict[str, Any] = {}
    for name, axis in axes.items():
        axis.widen(known[name])
        found[name] = _admitted(known[name], mine[name]) if name not in given else admitted(known[name], given[name])
        if name in given and known[name].constant and not same(found[name], admitted(known[name], mine[name])):
            raise hint(ParameterError(f"Constant parameter {name!r} cannot be modified."), f"it is {mine[name]!r}")
    return found


def _admitted(parameter: Any, value: Any) -> Any:
    """A value that a reader has already."""
    try:
        return admitted(parameter, value)
    except ParameterError as error:
        raise hint(error, "where bounds are moved away from a value, set it as well") from None


def settle(reader: Any, wires: Mapping[str, Any], *, strict: bool = True) -> None:
    """Set parameters of a reader, as they travel.

    Args:
        reader: an illustration.
        wires: values by name.
        strict: whether what the reader cannot have is refused; else it is moved into the bounds, or left out.

    Raises:
        UnknownNameError: strict, and there is no parameter of that name.
        ParameterError: strict, and a value is refused; then all is as before.
    """
    known = [name for name, parameter in declared(reader).items() if kind_of(parameter) is not None]
    for name in wires:
        if name not in known and strict:
            raise unknown(name, known, what="parameter")
    wanted = {name: wire for name, wire in wires.items() if name in known}
    before = {control.name: control.encode(getattr(reader, control.name)) for control in _controls(reader, known)}
    problem = _tried(reader, wanted)
    if problem is not None and strict:
        _tried(reader, before)
        raise problem
    for _ in range(0 if problem is None else MOST_ROUNDS):
        for name, wire in wanted.items():
            control = _control(reader, name)
            try:
                _set(reader, control, control.admit(wire))
            except ParameterError:
                continue


def _tried(reader: Any, wanted: Mapping[str, Any]) -> ParameterError | None:
    """Set all of these, in whatever order they are admitted; what one of them was refused for."""
    problem: ParameterError | None = None
    for _ in range(MOST_ROUNDS):
        todo = dict(wanted)
        while todo:
            count = len(todo)
            for name, wire in list(todo.items()):
                try:
                    _set(reader, _control(reader, name), wire)
                    del todo[name]
                except ParameterError as error:
                    problem = error
            if len(todo) == count:
                return problem
        if all(_is_at(reader, _control(reader, name), wire) for name, wire in wanted.items()):
            return None
    names = [name for name, wire in wanted.items() if not _is_at(reader, _control(reader, name), wire)]
    error = ParameterError(f"{type(reader).__name__}: {', '.join(names)} cannot have these values together")
    return hint(error, "a method that watches one parameter sets another one again")


def _set(reader: Any, control: Control, wire: Any) -> None:
    value = control.decode(wire)
    if _is_at(reader, control, wire):
        return
    try:
        setattr(reader, control.name, value)
    except (ValueError, TypeError) as error:
        if isinstance(error, Reactive4dError) and not isinstance(error, ParameterError):
            raise
        raise ParameterError(str(error)) from None


def _is_at(reader: Any, control: Control, wire: Any) -> bool:
    value = reader.param.values()[control.name]
    try:
        return value is control.decode(wire) or control.encode(value) == control.encode(control.decode(wire))
    except ParameterError:
        return False


def _control(reader: Any, name: str) -> Control:
    return control_of(declared(reader)[name])


def _controls(reader: Any, names: list[str]) -> list[Control]:
    return [_control(reader, name) for name in names]


def twin(reader: Any) -> Any:
    """Another reader at the same point and with the same bounds, to try something with.

    Raises:
        Reactive4dError: its class cannot be made without more arguments.
    """
    cls: Any = reader.__class__
    own, known, usual = reader.param.values(), declared(reader), declared(cls)
    fixed = {n: own[n] for n, p in known.items() if p.constant and not p.readonly and n != "name"}
    try:
        made = cls(**fixed)
    except TypeError as error:
        refusal = Reactive4dError(f"{cls.__name__} cannot be made without more arguments: {error}")
        raise hint(refusal, "__init__(self, **parameters) may have others, if all of them have defaults") from error
    for name, parameter in known.items():
        if parameter is not usual[name]:
            _copy(parameter, made.param[name])
    names = [name for name, parameter in known.items() if kind_of(parameter) is not None]
    settle(made, {control.name: control.encode(own[control.name]) for control in _controls(reader, names)})
    return made


def _copy(parameter: Any, other: Any) -> None:
    """Let one reader's parameter be as another one's."""
    for slot in MOVED:
        if hasattr(parameter, slot):
            setattr(other, slot, getattr(parameter, slot))
    if hasattr(parameter, "objects"):
        other.objects = dict(parameter.names) if parameter.names else list(parameter.objects)
