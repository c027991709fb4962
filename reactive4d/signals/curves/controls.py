"""A key: a value at a time, and how the curve arrives at it and leaves it."""

import math
from typing import Any, TypeAlias, final

from reactive4d.arrays import same
from reactive4d.errors import ShapeError, TimeError, hint
from reactive4d.signals.easings import Ease, Easing, easing
from reactive4d.signals.rotations import Rotation

__all__ = ["Handle", "Key", "key_time"]

Handle: TypeAlias = tuple[float, Any]


@final
class Key:
    """A control point with handles or tension, where a bare value does not say enough. Immutable.

    Args:
        value: what the curve answers at the key's time: a number, a vector, a Rotation, a colour, any object; or a
            signal of these.
        ease: how the span that starts here is run through; without it, the curve's own ease.
        left: handle on the side of the past, `(dt, dv)` from the key: dt <= 0 seconds, dv in the value's units. A
            Hermite curve takes dv / dt as its tangent, per second; a Bezier curve takes the handle itself.
        right: handle on the side of the future, dt >= 0.
        tension: tightness of a TCB curve at this key; 1 stops it, 0 is Catmull-Rom, -1 swings wide.
        continuity: 0 is smooth, -1 a corner, 1 a corner the other way round.
        bias: 0 takes both neighbours alike, 1 leans on the key before (overshoots), -1 on the key after.

    Raises:
        UnknownNameError: nobody knows the ease.
        ShapeError: a handle is not a pair, or points the wrong way; a tension is no finite number.

    >>> Key(2.0, ease="in_out")
    Key(2.0, ease='in_out')
    """

    __slots__ = ("bias", "continuity", "ease", "left", "right", "tension", "value")

    value: Any
    ease: Ease | Easing | None
    left: Handle | None
    right: Handle | None
    tension: float
    continuity: float
    bias: float

    def __init__(
        self,
        value: Any,
        *,
        ease: Ease | Easing | None = None,
        left: Handle | None = None,
        right: Handle | None = None,
        tension: float = 0.0,
        continuity: float = 0.0,
        bias: float = 0.0,
    ) -> None:
        if isinstance(value, Key):
            raise hint(ShapeError("a Key's value cannot be a Key"), "give the value itself: Key(key.value, ...)")
        put = object.__setattr__
        put(self, "value", value)
        if ease is not None:
            easing(ease)
        put(self, "ease", ease)
        put(self, "left", _handle(left, "left"))
        put(self, "right", _handle(right, "right"))
        put(self, "tension", _finite(tension, "tension"))
        put(self, "continuity", _finite(continuity, "continuity"))
        put(self, "bias", _finite(bias, "bias"))

    def __setattr__(self, name: str, value: Any) -> None:
        raise hint(AttributeError(f"a Key cannot be changed: {name}"), "make another: key.with_value(value)")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"a Key cannot be changed: {name}")

    def __reduce__(self) -> tuple[Any, ...]:
        return _restore, tuple(getattr(self, name) for name in ("value", *_SETTINGS))

    def __repr__(self) -> str:
        told = "".join(
            f", {name}={getattr(self, name)!r}" for name in _SETTINGS if getattr(self, name) not in (None, 0.0)
        )
        return f"Key({self.value!r}{told})"

    def with_value(self, value: Any) -> "Key":
        """The same key with another value.

        >>> Key(2.0, tension=0.5).with_value(3.0)
        Key(3.0, tension=0.5)
        """
        settings: dict[str, Any] = {name: getattr(self, name) for name in _SETTINGS}
        return Key(value, **settings)

    @property
    def is_bare(self) -> bool:
        """Whether the value alone says all."""
        return not (self.ease or self.left or self.right or self.tension or self.continuity or self.bias)

    def same(self, other: "Key") -> bool:
        """Whether two keys cannot be told apart; values are compared as the engine does."""
        if self is other:
            return True
        if any(not same(getattr(self, name), getattr(other, name)) for name in _SETTINGS):
            return False
        # Rotations compare by their bytes, as arrays do.
        a, b = self.value, other.value
        return a == b if isinstance(a, Rotation) and isinstance(b, Rotation) else same(a, b)


_SETTINGS = ("ease", "left", "right", "tension", "continuity", "bias")


def _restore(value: Any, *settings: Any) -> Key:
    return Key(value, **dict(zip(_SETTINGS, settings, strict=True)))


def _finite(value: Any, name: str) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number):
        raise ShapeError(f"Key.{name}: expected a finite number, got {value!r}")
    return number


def _handle(handle: Any, side: str) -> Handle | None:
    if handle is None:
        return None
    if type(handle) not in (tuple, list) or len(handle) != 2:
        raise ShapeError(f"Key.{side}: expected a pair (dt, dv), got {handle!r}")
    dt = _finite(handle[0], f"{side} dt")
    if dt * (-1.0 if side == "left" else 1.0) < 0.0:
        error = ShapeError(f"Key.{side}: dt points the wrong way: {dt!r} s")
        raise hint(error, "handles are offsets from the key: dt <= 0 on the left, dt >= 0 on the right")
    return dt + 0.0, handle[1]


def key_time(value: Any) -> float:
    """A number as the time of a key: a finite float, and never -0.0.

    Raises:
        TimeError: it is NaN or infinite, or no number.

    >>> key_time(2)
    2.0
    """
    try:
        if isinstance(value, str | bytes | bool):
            raise TypeError
        t = float(value) + 0.0
    except (TypeError, ValueError, OverflowError):
        error = TimeError(f"expected the time of a key in seconds, got {value!r}")
        raise hint(error, "keys({0: a, 1.5: b}) maps times to values") from None
    if math.isfinite(t):
        return t
    error = TimeError(f"a key cannot stand at {t!r} s")
    raise hint(error, "before= and after= tell what holds outside of the keys")
