"""Attributes: the settings of an object and the values of a change, as signals that one sets."""

from collections.abc import Callable
from operator import itemgetter
from typing import TYPE_CHECKING, Any, TypeVar
from weakref import WeakSet

from reactive4d.engine import Formula
from reactive4d.engine.links import link
from reactive4d.errors import Reactive4dError, hint
from reactive4d.model.settings import Setting, is_signal
from reactive4d.signals.facade import Signal
from reactive4d.signals.settables import Settable, curve_difference
from reactive4d.signals.sources import refuse_reading_itself

if TYPE_CHECKING:
    from reactive4d.model.changes import Change
    from reactive4d.model.objects import Object

__all__ = ["DEFAULT", "INHERITED", "Attribute", "Merge", "Part", "Values"]

T = TypeVar("T")
Merge = Callable[[tuple[Any, ...]], tuple[Any, ...]]


class _Unset:
    """What the content of an attribute is where nothing was assigned."""

    def __init__(self, name: str) -> None:
        self.name = name

    def __repr__(self) -> str:
        return self.name


DEFAULT = _Unset("DEFAULT")
INHERITED = _Unset("INHERITED")


class Attribute(Settable[T]):
    """A setting of an object: a signal that can be set, `obj.name = value`, to a constant or to another signal.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere(radius=r4.keys({0: 1.0, 2: 3.0}))
    >>> ball.radius.at(1.0)
    2.0
    >>> ball.radius.source.points[2.0]
    3.0
    """

    __slots__ = ("object", "setting")

    def __init__(self, obj: "Object", setting: Setting[Any], content: Any) -> None:
        self.object = obj
        self.setting = setting
        super().__init__(content, name="")

    @property
    def name(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """The object's name and its own: `ball.radius`."""
        return f"{self.object.name}.{self.setting.name}"

    @name.setter
    def name(self, value: str) -> None:
        pass

    @property
    def source(self) -> Any:
        """What was assigned: the constant, the keys, the signal. Where nothing was, the default, or the prototype's."""
        content = self.content
        if content is DEFAULT:
            return self.setting.default
        if content is INHERITED:
            prototype = self.object.prototype.at(0.0)
            found = None if prototype is None else prototype.attribute(self.setting.name).source
            return self.setting.default if found is None else found
        return content

    @property
    def is_set(self) -> bool:
        """Whether something was assigned to this very object."""
        return self.content is not DEFAULT and self.content is not INHERITED

    def assign(self, value: Any) -> None:
        """Set it.

        Raises:
            ShapeError: a constant that is not of the setting's type.
            Reactive4dError: a signal that reads this very attribute.
        """
        content = self.setting.admit(value)
        self._refuse_if_fixed()
        if is_signal(content):
            if content is self:
                return
            refuse_reading_itself(self, content)
        self.set_content(content)

    def unassign(self) -> None:
        """Go back to the prototype's, or to the default."""
        self._refuse_if_fixed()
        self.set_content(INHERITED if self.object.has_prototype else DEFAULT)

    def _refuse_if_fixed(self) -> None:
        owner = self.object.fixed_by
        if owner and self.setting.is_structure:
            error = Reactive4dError(f"the objects of {owner} are fixed: {self.name} cannot be set")
            raise hint(error, "name all objects when the scene is made; what is there for a while only has `visible`")

    def refers(self, content: Any) -> bool:
        """What is alive is a reference."""
        return isinstance(content, Signal) or (
            content is not DEFAULT and content is not INHERITED and self.setting.signal(content) is not None
        )

    def difference(self, old: Any, new: Any) -> list[tuple[float, float]]:
        """Keys over keys differ only where their curves do."""
        if old is new:
            return []
        span = curve_difference(old, new)
        return super().difference(old, new) if span is None else span

    def adopt(self) -> None:
        """A constant makes it a source, a signal a formula; what is inherited is found out when it is asked."""
        content = self.content
        live = None if content is DEFAULT or content is INHERITED else self.setting.signal(content)
        if live is not None:
            self._be_formula(live)
            link(self, self.inputs)
        elif content is INHERITED:
            self._be_computed()
        else:
            self._be_source()

    def sample(self, t: float) -> tuple[float, float, Any]:
        """The constant, as kernels take it."""
        content = self.content
        return -INF, INF, self.setting.default_value if content is DEFAULT else self.setting.constant(content)

    def rule(self) -> Any:
        """The prototype's."""
        if self.own is not None:
            self.own.note()
        prototype = self.object.prototype.now()
        found = None if prototype is None else prototype.attribute(self.setting.name).now()
        return self.setting.default_value if found is None else self.setting.check(found)

    def function(self, *values: Any) -> Any:
        """The value of the signal that was set, if it is of the setting's type."""
        return self.setting.check(values[1])


INF = float("inf")


class Values(Settable[Any]):
    """All values of one change, as one tuple: what its attributes are at a time."""

    __slots__ = ("_constants", "_followers", "change", "merge")

    merge: Merge | None  # of what the signals say, the constants between them; None while all are constants

    def __init__(self, change: "Change", content: tuple[Any, ...]) -> None:
        self.change = change
        self._followers: WeakSet[Any] | None = None
        super().__init__(content, name="")

    def follow(self, run: Any) -> None:
        """Let a run that reads what the values are made of know when they are made of something else."""
        if self._followers is None:
            self._followers = WeakSet()
        self._followers.add(run)

    @property
    def name(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """The change's."""
        return self.change.name

    @name.setter
    def name(self, value: str) -> None:
        pass

    def refers(self, content: Any) -> bool:
        """Values of which one is alive refer to it."""
        return any(s.signal(x) is not None for s, x in zip(self.change.settings, content, strict=True))

    def difference(self, old: Any, new: Any) -> list[tuple[float, float]]:
        """Where any of the values differs."""
        spans: list[tuple[float, float]] = []
        for a, b in zip(old, new, strict=True):
            if a is b:
                continue
            span = curve_difference(a, b)
            if span is None:
                if isinstance(a, Signal) or isinstance(b, Signal) or not self.engine.same(a, b):
                    return [(-INF, INF)]
            else:
                spans.extend(span)
        return spans

    def adopt(self) -> None:
        """A source while all values are constants, else a formula of those that are alive."""
        settings = self.change.settings
        contents: Any = self.content
        found = [setting.signal(x) for setting, x in zip(settings, contents, strict=True)]
        signals = [x for x in found if x is not None]
        if signals:
            self._be_live(found)
        else:
            self.merge = None
            self._constants = tuple([s.constant(x) for s, x in zip(settings, contents, strict=True)])
            self._be_source()
        for run in list(self._followers or ()):
            run.rewire()

    def _be_live(self, found: list[Signal[Any] | None]) -> None:
        settings = self.change.settings
        contents: Any = self.content
        fixed = [
            setting.constant(x) if live is None else None
            for setting, x, live in zip(settings, contents, found, strict=True)
        ]
        checks = [(i, settings[i].check) for i, live in enumerate(found) if live is not None]

        def merge(values: tuple[Any, ...]) -> Any:
            merged = fixed.copy()
            for (i, check), value in zip(checks, values, strict=True):
                merged[i] = check(value)
            return tuple(merged)

        self.merge = merge
        self._be_formula(*[x for x in found if x is not None])
        link(self, self.inputs)

    def sample(self, t: float) -> tuple[float, float, Any]:
        """The constants, as kernels take them."""
        return -INF, INF, self._constants

    def function(self, *values: Any) -> Any:
        """The constants, and what the signals say."""
        merge = self.merge
        assert merge is not None
        return merge(values[1:])


class Part(Signal[T], Formula):
    """One attribute of a change, as a signal that can be set."""

    __slots__ = ("change", "setting")

    def __init__(self, change: "Change", setting: Setting[Any], index: int, values: Values) -> None:
        self.change = change
        self.setting = setting
        super().__init__(itemgetter(index), values, name="")

    @property
    def name(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """The change's name and its own: `bend.angle`."""
        return f"{self.change.name}.{self.setting.name}"

    @name.setter
    def name(self, value: str) -> None:
        pass

    @property
    def source(self) -> Any:
        """What was assigned: the constant, the keys, the signal."""
        return self.change.source(self.setting.name)


def refuse_own(change: "Change", name: str, content: Signal[Any]) -> None:
    """Raise if what is assigned to a change reads it."""
    values = change.values_if_made
    if values is None:
        return
    try:
        refuse_reading_itself(values, content)
    except Reactive4dError:
        error = Reactive4dError(f"{change.name}.{name} would read itself")
        raise hint(error, f"use what was assigned before: {change.name}.{name}.source") from None
