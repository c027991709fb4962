"""Curves of what is not known yet: a key's value may be anything that can be asked later.

Every interpolation but those that look at distances is a weighted sum of its keys, with weights that depend on time
alone. So a curve can be worked out on *mixtures*: sums of opaque terms with numbers as weights. A term without weight
is not in the mixture, and need not be asked.
"""

from collections.abc import Callable, Mapping
from typing import Any, final

import numpy as np

from reactive4d.arrays import same
from reactive4d.errors import ShapeError
from reactive4d.signals.curves import bernstein
from reactive4d.signals.curves.spaces import Space

__all__ = ["Known", "Mixture", "Mixtures"]


@final
class Known:
    """A term whose value is known: a point of the space of the other values, and the answer where it stands alone."""

    __slots__ = ("answer", "point")

    def __init__(self, point: Any, answer: Any) -> None:
        self.point = point
        self.answer = answer

    def __repr__(self) -> str:
        return repr(self.answer)


@final
class Mixture:
    """Terms and how much each counts. Immutable.

    >>> a, b = Mixture({"a": 1.0}), Mixture({"b": 1.0})
    >>> 0.25 * a + 0.75 * (b - a) + 0.5 * a
    Mixture({'b': 0.75})
    """

    __slots__ = ("terms",)
    __array_ufunc__ = None  # a NumPy number times a mixture is a mixture

    def __init__(self, terms: Mapping[Any, float]) -> None:
        self.terms = {term: float(weight) for term, weight in terms.items() if weight != 0.0}

    def _plus(self, other: "Mixture", sign: float) -> "Mixture":
        terms = dict(self.terms)
        for term, weight in other.terms.items():
            terms[term] = terms.get(term, 0.0) + sign * weight
        return Mixture(terms)

    def __add__(self, other: "Mixture") -> "Mixture":
        return self._plus(other, 1.0)

    def __sub__(self, other: "Mixture") -> "Mixture":
        return self._plus(other, -1.0)

    def __mul__(self, factor: float) -> "Mixture":
        return Mixture({term: weight * factor for term, weight in self.terms.items()})

    __rmul__ = __mul__

    def __truediv__(self, divisor: float) -> "Mixture":
        return Mixture({term: weight / divisor for term, weight in self.terms.items()})

    def __neg__(self) -> "Mixture":
        return self * -1.0

    def __bool__(self) -> bool:
        return bool(self.terms)

    def __repr__(self) -> str:
        return f"Mixture({self.terms!r})"


@final
class Mixtures(Space):
    """The space of the mixtures of values that are known, which live in `inner`, and of some that are not."""

    __slots__ = ("inner", "unknowns")

    def __init__(self, inner: Space | None, unknowns: type) -> None:
        self.inner = inner
        self.unknowns = unknowns

    @property
    def kind(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """The kind of the known values; a vector will do for what is not told."""
        return "vector" if self.inner is None else self.inner.kind

    def point(self, value: Any) -> Mixture:
        """One term."""
        if isinstance(value, self.unknowns):
            return Mixture({value: 1.0})
        assert self.inner is not None
        point = self.inner.point(value)
        return Mixture({Known(point, self.inner.exact(value, point)): 1.0})

    def offset(self, value: Any) -> Mixture:
        """A handle's `dv`, which is to be known."""
        if isinstance(value, self.unknowns):
            raise ShapeError(f"a handle is a number or a vector, got {value!r}")
        point = np.asarray(value, dtype=np.float64) if self.inner is None else self.inner.offset(value)
        return Mixture({Known(point, point): 1.0}) if np.any(point) else Mixture({})

    def same(self, a: Any, b: Any) -> bool:
        """Whether two mixtures have the same terms with the same weights."""
        if len(a.terms) != len(b.terms):
            return False
        pairs = zip(a.terms.items(), b.terms.items(), strict=True)
        return all(same(p, q) and self._same_terms(x, y) for (x, p), (y, q) in pairs)

    def _same_terms(self, x: Any, y: Any) -> bool:
        if x is y:
            return True
        return (
            isinstance(x, Known) and isinstance(y, Known) and (self.inner is None or self.inner.same(x.point, y.point))
        )

    def between(self, controls: tuple[Any, ...]) -> Callable[[float], Mixture]:
        """The polynomial with these controls, as a mixture of their terms."""
        degree = len(controls) - 1

        def at(u: float) -> Mixture:
            terms: dict[Any, float] = {}
            for weight, control in zip(bernstein.weights(degree, u).tolist(), controls, strict=True):
                for term, share in control.terms.items():
                    terms[term] = terms.get(term, 0.0) + weight * share
            return Mixture(terms)

        return at
