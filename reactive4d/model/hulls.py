"""Deforming the control points instead of the surface: inaccurate, but smooth, and much less to do (UGA, 4.1).

A kind whose surface follows control points says which setting holds them, `hull`, and has a setting `deforms` that
chooses: "surface" moves every point of the surface, "hull" the control points alone, of which the surface is made anew.
"""

from typing import Any
from weakref import ref

import numpy as np
from numpy.typing import NDArray

from reactive4d.model.forms import Base, Form, Stage, as_part
from reactive4d.model.places import Place
from reactive4d.signals.facade import Signal

__all__ = ["Controls", "Refined", "controls_of", "refined"]


class Controls(Form):
    """The control points of a kind, as points to be deformed."""

    __slots__ = ("made_of",)

    def __init__(self, made_of: Base) -> None:
        super().__init__()
        self.made_of = made_of

    @property
    def name(self) -> str:
        """The object's, and what they are."""
        return f"{self.made_of.name}.{self.made_of.kind.hull}"

    @property
    def base(self) -> Base:
        """The kind's own form."""
        return self.made_of

    def make(self, name: str) -> Signal[Any] | None:
        """Points alone; float64, as control points are."""
        if name != "points":
            return None
        base = self.made_of
        controls = base.owner.parameter(base.kind, base.kind.hull)
        return Stage(self, name, _listed, controls)


def _listed(net: Any) -> NDArray[np.float64]:
    return np.asarray(net, dtype=np.float64).reshape(-1, 3)


class Refined(Form):
    """The surface that a kind makes of its control points after they were deformed."""

    __slots__ = ("controls",)

    def __init__(self, controls: Form) -> None:
        super().__init__()
        self.controls = controls

    @property
    def name(self) -> str:
        """That of the last deformation."""
        return f"{self.controls.name}.refined"

    @property
    def base(self) -> Base:
        """The kind's own form."""
        return self.controls.base

    @property
    def place(self) -> Place | None:
        """That of the last deformation."""
        return self.controls.place

    def make(self, name: str) -> Signal[Any] | None:
        """What the kind makes of its settings, with other control points."""
        if name == "origin":
            return self.controls.part("origin")
        base = self.base
        method = base.kind.methods_by_name.get(name)
        hull = base.kind.hull
        if method is None or hull not in method.reads:
            return base.part(name)
        kind, owner, reads = base.kind, base.owner, method.reads
        settings = [owner.parameter(kind, read) for read in reads]

        def made(points: Any, *values: Any) -> Any:
            named = dict(zip(reads, values, strict=True))
            named[hull] = points.reshape(named[hull].shape)
            return as_part(name, method.function(**named), kind)

        return Stage(self, name, made, self.controls.need("points"), *settings)


def controls_of(form: Base) -> Controls:
    """The control points of a kind's own form, made once for each."""
    found = form.controls
    if found is None:
        found = form.controls = Controls(form)
    return found


def refined(controls: Form) -> Refined:
    """The surface over deformed control points, made once for each."""
    found = controls.over() if controls.over is not None else None
    if found is None:
        found = Refined(controls)
        controls.over = ref(found)
    return found
