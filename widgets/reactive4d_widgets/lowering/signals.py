"""Signals as terms: the walk over a tree of signals, with one method for each class that is known.

What is opaque but stands still piece by piece is lowered as what it says; what is opaque and moves is not lowered.
"""

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, Final

from reactive4d.errors import Reactive4dError
from reactive4d.illustrations.kinds import choices_of, kind_of
from reactive4d.model.attributes import DEFAULT, INHERITED, Attribute, Part
from reactive4d.model.channels import Channel
from reactive4d.model.settings import Setting
from reactive4d.signals import warps
from reactive4d.signals.algebra import Operation
from reactive4d.signals.choices import Choice
from reactive4d.signals.facade import Signal
from reactive4d.signals.keys import Keys
from reactive4d.signals.numerical import Difference, Quadrature
from reactive4d.signals.reflections import KeyArea, KeySlope, Reflected
from reactive4d.signals.settables import Assigned
from reactive4d.signals.sources import Parameter, Time
from reactive4d.signals.trees import is_a
from reactive4d.signals.warps import Follow, Warped
from reactive4d_widgets.lowering.blendings import blended_curve
from reactive4d_widgets.lowering.curves import curve_term
from reactive4d_widgets.lowering.elementary import choose
from reactive4d_widgets.lowering.holding import shape_of
from reactive4d_widgets.lowering.operations import operated
from reactive4d_widgets.lowering.rates import area, difference, slope
from reactive4d_widgets.lowering.settings import conformed
from reactive4d_widgets.lowering.standings import standings
from reactive4d_widgets.lowering.terms import (
    CODE,
    HELD,
    NUMBER,
    NotExactError,
    Shape,
    Term,
    applied,
    cases,
    constant,
    track_of,
    written,
)
from reactive4d_widgets.lowering.warpings import followed_time, mapped_time

__all__ = ["ChannelRule", "Lowering"]

INF: Final = math.inf
MOST_DEEP: Final = 100  # signals within signals
OF_OBJECT: Final = 5  # as many of these a channel of an object counts for

# From an object and who lowers to the term of one of its channels.
ChannelRule = Callable[[Any, "Lowering"], Term]


class Lowering:
    """One lowering: what is shared among the trees of several signals is lowered once.

    Args:
        parameters: of the reader's, those that count as constants, with their values.
        channels: how the channels of objects are lowered, by their labels.
    """

    def __init__(
        self, parameters: Mapping[str, Any] | None = None, channels: Mapping[str, ChannelRule] = MappingProxyType({})
    ) -> None:
        self.parameters = dict(parameters or {})
        self.channels = channels
        self.bounds: dict[str, tuple[float, float]] = {}
        self._done: dict[int, tuple[Any, Term]] = {}
        self._level = 0

    def of(self, x: Any) -> Term:
        """A signal, or a constant, as a term.

        Raises:
            NotExactError: no track says exactly what it says.
        """
        if not is_a(x, Signal):
            return constant(x)
        signal = x
        known = self._done.get(id(signal))
        if known is not None:
            return known[1]
        level = OF_OBJECT if is_a(signal, Channel) else 1
        if self._level + level > MOST_DEEP:
            raise NotExactError(f"{signal.name} is nested too deep")
        self._level += level
        try:
            term = self._lowered(signal)
        except Reactive4dError as error:
            raise NotExactError(f"{signal.name}: {error}") from error
        finally:
            self._level -= level
        self._done[id(signal)] = (signal, term)
        return term

    def _lowered(self, x: Any) -> Term:
        for kind, rule in _RULES:
            if isinstance(x, kind):
                return rule(self, x)
        return self.opaque(x)

    def opaque(self, x: Any) -> Term:
        """A signal of which nothing is known but what it says."""
        found = standings(x, self.parameters)
        parts = [constant(one.value) for one in found]
        if any(part.shape == HELD for part in parts):
            for part in parts:
                track_of(part)  # all of them can be said
        return cases([one.start for one in found[1:]], parts)

    # -- by class --------------------------------------------------------------------------------------------------

    def time(self, x: Any) -> Term:
        """Time itself."""
        del x
        return written(["time"], NUMBER)

    def parameter(self, x: Any) -> Term:
        """What the reader drives."""
        if x.name in self.parameters:
            return constant(x.present(x.admit(self.parameters[x.name])))
        shape = _driven_shape(x)
        if shape == NUMBER and x.bounds is not None:
            low, high = x.bounds
            self.bounds[x.name] = (-INF if low is None else float(low), INF if high is None else float(high))
        return Term(["param", x.name], shape, 2, 2)

    def keys(self, x: Any) -> Term:
        """Keys."""
        curve = x.curve
        return blended_curve(curve, self.of) if curve.is_live else curve_term(curve)

    def assigned(self, x: Any) -> Term:
        """A variable: what it is set to."""
        return self.of(x.content)

    def attribute(self, x: Any) -> Term:
        """A setting of an object: what was assigned, or the prototype's, or the default."""
        content, setting = x.content, x.setting
        if content is DEFAULT:
            return constant(setting.default_value)
        if content is not INHERITED:
            return self.content(setting, content)
        prototype = x.object.prototype_content
        if isinstance(prototype, Signal):
            return self.opaque(x)
        found = None if prototype is None else self.of(prototype.attribute(setting.name))
        if found is None or (found.is_constant and found.value is None):
            return constant(setting.default_value)
        return conformed(found, setting, self.bounds)

    def content(self, setting: Setting[Any], content: Any) -> Term:
        """What was assigned to a setting."""
        live = setting.signal(content)
        if live is None:
            return constant(setting.constant(content))
        return conformed(self.of(live), setting, self.bounds)

    def part(self, x: Any) -> Term:
        """A setting of a change."""
        return self.content(x.setting, x.source)

    def operation(self, x: Any) -> Term:
        """An operator, applied."""
        parts = [self.of(part) for part in x.operands]
        if all(part.is_constant for part in parts):
            return self.opaque(x)
        try:
            return operated(x.operator, parts)
        except NotExactError:
            return self.opaque(x)

    def choice(self, x: Any) -> Term:
        """One of two."""
        condition = self.of(x.condition)
        if condition.is_constant and condition.shape == NUMBER:
            return self.of(x.yes if condition.value else x.no)
        return choose(condition, self.of(x.yes), self.of(x.no))

    def warped(self, x: Any) -> Term:
        """A signal at other times."""
        return self._at(self.of(x.original), mapped_time(x.time_map))

    def follow(self, x: Any) -> Term:
        """A signal at times that other signals tell."""
        if x.make.__module__ != warps.__name__:
            return self.opaque(x)
        original = self.of(x.original)
        return self._at(original, followed_time(x.kind_of_map, [self.of(part) for part in x.parameters]))

    def _at(self, term: Term, time: Term) -> Term:
        return term if term.is_constant else applied("at", term, time, shape=term.shape)

    def key_slope(self, x: Any) -> Term:
        """The derivative of keys."""
        if x.content.is_live:
            return self.of(x.fallback)
        return slope(x.content, x.order)

    def key_area(self, x: Any) -> Term:
        """The integral of keys."""
        return area(x.content, x.start)

    def difference(self, x: Any) -> Term:
        """The derivative of what is not known better."""
        return difference(self.of(x.original))

    def reflected(self, x: Any) -> Term:
        """The derivative or the integral of what one sets: of what it is set to."""
        content = x.original.content
        if isinstance(content, Signal):
            return self.of(x.make(content))
        return self.opaque(x)

    def channel(self, x: Any) -> Term:
        """What an object answers."""
        rule = self.channels.get(x.label)
        return self.opaque(x) if rule is None else rule(x.object, self)


def _driven_shape(x: Any) -> Shape:
    """The shape of a reader's parameter as it travels.

    Raises:
        NotExactError: some of its values travel as something else.
    """
    declared = getattr(x, "declared", None)
    kind = None if declared is None else kind_of(declared)
    if declared is not None and declared.allow_None:
        raise NotExactError(f"the parameter {x.name} may be nothing")
    if kind == "color":
        return CODE
    shape = shape_of(x.present(x.default))
    if kind == "select":
        shapes = {shape_of(value) for value in choices_of(declared).values()}
        if len(shapes) > 1:
            raise NotExactError(f"the parameter {x.name} is of several kinds")
        for value in choices_of(declared).values():
            if not is_a(value, str, bool, int, float):
                raise NotExactError(f"the parameter {x.name} chooses among what does not travel")
    elif shape == HELD and not is_a(x.default, str):
        raise NotExactError(f"the parameter {x.name} does not travel")
    return shape


_RULES: Final[tuple[tuple[type, Callable[[Lowering, Any], Term]], ...]] = (
    (Time, Lowering.time),
    (Parameter, Lowering.parameter),
    (Keys, Lowering.keys),
    (Attribute, Lowering.attribute),
    (Assigned, Lowering.assigned),
    (Part, Lowering.part),
    (Operation, Lowering.operation),
    (Choice, Lowering.choice),
    (Warped, Lowering.warped),
    (Follow, Lowering.follow),
    (KeySlope, Lowering.key_slope),
    (KeyArea, Lowering.key_area),
    (Difference, Lowering.difference),
    (Quadrature, Lowering.opaque),
    (Reflected, Lowering.reflected),
    (Channel, Lowering.channel),
)
