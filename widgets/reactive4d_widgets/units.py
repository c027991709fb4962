"""Units: a number with its unit, as the viewer writes it, too."""

__all__ = ["with_unit"]

DEGREES = frozenset({"deg", "degree", "degrees"})


def with_unit(text: str, unit: str) -> str:
    r"""A number's text with its unit behind it: a sign for an angle stands close, all others after a narrow space.

    >>> with_unit("20", "deg"), with_unit("1.00", "m"), with_unit("3", "")
    ('20°', '1.00\u202fm', '3')
    """
    sign = "°" if unit in DEGREES else unit
    return f"{text}{sign}" if sign[:1] in "°%′″" else f"{text}\u202f{sign}"
