"""Proofs: whether a page's text names only what its figures have; found out before anything is asked of a model."""

from collections.abc import Callable, Mapping
from functools import partial

from reactive4d.errors import ShapeError, hint, unknown
from reactive4d_widgets.plans import Plan
from reactive4d_widgets.prose import Cast, Written, written

__all__ = ["leaders", "proofread"]

NUMERIC = frozenset({"number", "integer", "range", "xy"})


def proofread(text: str, plans: Mapping[str, Plan], follows: Mapping[str, str | None] | None = None) -> Written:
    """Read a page's text as its figures will stand in it, but ask the model nothing.

    Args:
        text: Markdown.
        plans: of the figures, by their names on the page.
        follows: which of them is to follow which, as far as the figures say it themselves.

    Returns:
        The text, with nothing where the figures will stand.

    Raises:
        UnknownNameError: it names a parameter, a value, an object or a figure that is not there.
        ShapeError: a figure stands twice or within a sentence, or follows itself; a formula or a format is none.

    >>> import reactive4d as r4
    >>> from reactive4d_widgets.plans import planned
    >>> plan = planned(r4.Scene(ball=r4.Sphere()))
    >>> proofread("[The ball](#ball) is round.", {"round": plan}).links
    []
    >>> proofread("[The ball](#bal) is round.", {"round": plan})
    Traceback (most recent call last):
    ...
    reactive4d.errors.UnknownNameError: unknown object 'bal'
    hint: did you mean 'ball'?
    """
    found = written(text, [_cast(name, plan) for name, plan in plans.items()])
    leaders({name: found.follows.get(name, (follows or {}).get(name)) for name in plans})
    return found


def leaders(follows: Mapping[str, str | None]) -> dict[str, str]:
    """The figures that follow another one, with that one.

    Args:
        follows: for each figure of a page whom it is to follow.

    Raises:
        UnknownNameError: a leader that is not on the page.
        ShapeError: a figure that follows itself, directly or through others.

    >>> leaders({"a": None, "b": "a"})
    {'b': 'a'}
    """
    found: dict[str, str] = {}
    for name, leader in follows.items():
        if leader is not None:
            if leader not in follows:
                raise unknown(leader, follows, what="figure")
            found[name] = leader
    for name in found:
        first, steps = found.get(name), 0
        while first is not None and steps < len(found):
            first, steps = found.get(first), steps + 1
        if first is not None:
            raise hint(ShapeError(f"the figure {name!r} follows itself"), "one of them has to lead")
    return found


def _cast(name: str, plan: Plan) -> Cast:
    """What the text may name of a figure."""
    numbers: dict[str, Callable[[str], str]] = {
        channel.what.removeprefix("values."): partial(_tried, (0.5, "")) for channel in plan.values
    }
    for control in plan.controls.values():
        numbers[control.name] = partial(_tried, (0.5,) if control.kind in NUMERIC else ())
    return Cast(
        name,
        numbers,
        frozenset(plan.controls),
        frozenset(seat.name for seat in plan.seats),
        lambda caption: "",
    )


def _tried(samples: tuple[float | str, ...], spec: str) -> str:
    """Whether a format is one for any of some values; nothing is known yet of those that will be shown.

    Raises:
        ValueError: for none of them.
    """
    told: ValueError | None = None
    for sample in samples:
        try:
            return format(sample, spec)
        except ValueError as error:
            told = told or error
    if told is not None:
        raise told
    return ""
