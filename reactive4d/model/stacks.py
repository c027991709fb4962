"""What the list of changes comes to at a time: the kind, the form, the matrix. Each function is a channel's rule.

They are called inside of an evaluation, and read the lists, the prototypes and the kinds that they need.
"""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry import transforms
from reactive4d.model.forms import Base, Deformed, Form, Made, Reshaped, interned
from reactive4d.model.hulls import controls_of, refined
from reactive4d.model.lanes import Items, acting, before, merged
from reactive4d.model.places import Place
from reactive4d.model.runs import Product, Run, run_of
from reactive4d.model.selections import Selected, Selecting

if TYPE_CHECKING:
    from reactive4d.model.changes import Change, Lane
    from reactive4d.model.objects import Object

__all__ = [
    "UNSHAPED",
    "base_of",
    "entries",
    "entries_before",
    "form_of",
    "kind_of",
    "maker",
    "matrix_of",
    "position_of",
    "product_of",
    "understood",
]

Array = NDArray[np.float64]
UNSHAPED = frozenset({"color", "opacity", "visible"})  # settings that have no say in the form


def entries(obj: "Object", lane: "Lane") -> Items:
    """The entries of one lane, own and inherited, by their places."""
    own = obj.own(lane).now()
    prototype = obj.prototype.now()
    return own if prototype is None else merged(own, prototype.lane(lane).now())


def entries_before(obj: "Object", lane: "Lane", place: Place) -> Items:
    """Those before a place: an edit after it does not concern the asker."""
    bounded = obj.own(lane).before(place)
    own = before(obj.own(lane).now(), place) if bounded is None else bounded.now()
    prototype = obj.prototype.now()
    if prototype is None:
        return own
    inherited = prototype.passing(("changes", lane, place), lambda o: entries_before(o, lane, place)).now()
    return merged(own, inherited)


def understood(obj: "Object", kind: "type[Object]", name: str) -> Any:
    """A setting as another kind than the object's own understands it."""
    wanted = kind.settings[name]
    while name not in obj.names.now():
        prototype = obj.prototype.now()
        if prototype is None:
            return wanted.default_value
        obj = prototype
    content = wanted.admit(obj.attribute(name).now())
    alive = wanted.signal(content)  # an outline, say, of an object that the setting names
    return wanted.constant(content) if alive is None else wanted.check(alive.now())


def kind_of(obj: "Object") -> "type[Object]":
    """The last kind that it became, else its prototype's, or its own."""
    became = acting(entries(obj, "kind"))
    if became:
        return became[-1].change.values.now()[0]
    prototype = obj.prototype.now()
    return type(obj) if prototype is None else prototype.kind.now()


def base_of(obj: "Object", kind: "type[Object]") -> Base:
    """The form that a kind makes of the settings of an object, or of its prototype where they are the same."""
    prototype = obj.prototype.now()
    if prototype is not None and not any(name in kind.settings for name in obj.names.now()):
        return prototype.channel(f"base@{id(kind)}", lambda o: base_of(o, kind)).now()
    bases = obj._bases  # pyright: ignore[reportPrivateUsage]
    base = bases.get(kind)
    return base if base is not None else bases.setdefault(kind, Base(obj, kind))


def form_of(obj: "Object") -> Form:
    """The kind's own form, and what the changes of its shape make of it one after the other."""
    kind = obj.kind.now()
    form: Form = base_of(obj, kind)
    shaping = acting(entries(obj, "surface")) + acting(entries(obj, "shape"))
    if not shaping:
        return form
    shaping = tuple(sorted(shaping, key=lambda entry: entry.place))
    moving = acting(entries_before(obj, "transform", shaping[-1].place))
    placement = form.part("placement")
    by_hull = kind.hull != "" and obj.parameter(kind, "deforms").now() == "hull"
    if by_hull:
        form = controls_of(form)
    done = 0
    for entry in shaping:
        start = done
        while done < len(moving) and moving[done].place < entry.place:
            done += 1
        run = run_of(moving[start:done], below=placement, origin=form.part("origin"), table=kind.kind_table)
        placement = None
        form = interned(maker(entry.change), form, run, entry)
    return refined(form) if by_hull else form


def maker(change: "Change") -> type[Made]:
    """What kind of form a change makes."""
    if change.lane == "surface":
        return Reshaped
    return Selected if isinstance(change, Selecting) else Deformed


def product_of(obj: "Object") -> Product | None:
    """The transforms after the last change of the shape; None where there are none."""
    form = obj.form.now()
    moving = acting(entries(obj, "transform"))
    last = form.place
    if last is not None:
        moving = tuple([entry for entry in moving if entry.place > last])
    kind = form.base.kind
    run = run_of(
        moving,
        below=form.part("placement") if last is None else None,
        origin=form.part("origin"),
        table=kind.kind_table,
    )
    return None if run is None else run.product if isinstance(run, Run) else form.base.placed(run)


def matrix_of(obj: "Object") -> Array:
    """Their matrix."""
    product = obj.run.now()
    return transforms.IDENTITY if product is None else product.run.now()


def position_of(obj: "Object") -> Array:
    """Where the object's origin is, carried through the whole list."""
    form = obj.form.now()
    origin = form.part("origin")
    matrix = obj.matrix.now()
    if origin is None:
        return matrix[:3, 3].copy()
    return matrix[:3, :3] @ origin.now() + matrix[:3, 3]
