"""Axes: the parameters of an illustration as signals."""

import copy
from typing import Any, TypeVar, final

import param

from reactive4d.engine import Axis
from reactive4d.errors import ParameterError
from reactive4d.illustrations.kinds import admitted, choices_of, declared, kind_of, refused_kind
from reactive4d.signals.sources import Parameter

__all__ = ["Driven"]

T = TypeVar("T")


@final
class Driven(Parameter[T]):
    """A parameter of an illustration as an axis: what it admits is what the class declares, or what a reader was given.

    All readers of a class share the axis. Some of them may have other bounds than the class declares: then the axis
    admits theirs as well, and each reader's own are checked before it asks.
    """

    __slots__ = ("_owner", "_wider")

    def __init__(self, owner: type[param.Parameterized], name: str) -> None:
        self._owner = owner
        self._wider: Any = None  # the parameter as it would be declared to admit what some readers' own admit
        self.name = name
        parameter = self.declared
        if kind_of(parameter) is None:
            raise refused_kind(parameter)
        self.doc = str(parameter.doc or "")
        self.bounds = getattr(parameter, "bounds", None)
        Axis.__init__(self, name, parameter.default)

    @property
    def declared(self) -> Any:
        """The parameter as the class declares it."""
        return declared(self._owner)[self.name]

    def widen(self, own: Any) -> None:
        """Admit also what one reader's own parameter admits."""
        parameter = self.declared
        if own is parameter:
            return
        wider = parameter if self._wider is None else self._wider
        bounds, choices = _hull(wider, own), _more(wider, own)
        if bounds != getattr(wider, "bounds", None) or choices is not None:
            wider = copy.copy(parameter)
            wider.watchers = {}
            if choices is None:
                wider.bounds, wider.inclusive_bounds = bounds, (True, True)
            else:
                wider.objects = choices
            self._wider = wider

    def admit(self, value: Any) -> Any:
        """The value as the parameter understands it.

        Raises:
            ParameterError: in the words of param.
        """
        try:
            return admitted(self.declared, value)
        except ParameterError:
            if self._wider is None:
                raise
        return admitted(self._wider, value)


def _hull(a: Any, b: Any) -> tuple[Any, Any] | None:
    """The least bounds that hold those of both."""
    first, second = getattr(a, "bounds", None), getattr(b, "bounds", None)
    if first is None or second is None:
        return None
    low, high = (
        None if any(end is None for end in ends) else least(ends)
        for least, ends in ((min, (first[0], second[0])), (max, (first[1], second[1])))
    )
    return (low, high)


def _more(a: Any, b: Any) -> dict[str, Any] | None:
    """The choices of both, if the second has some that the first has not."""
    if not hasattr(a, "objects"):
        return None
    known, others = choices_of(a), choices_of(b)
    new = {name: one for name, one in others.items() if one not in known.values()}
    return (
        {**known, **{name if name not in known else f"{name} (2)": one for name, one in new.items()}} if new else None
    )
