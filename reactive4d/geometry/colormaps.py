"""Colour maps: numbers as colours."""

from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError, hint, unknown

__all__ = ["Colormap", "colored", "colormap", "limits"]

Colormap: TypeAlias = Any
"""A name that Matplotlib knows, a list of colours, or one of Matplotlib's own maps."""

MISSING = (0.663, 0.663, 0.663, 1.0)  # a number that is none: dark grey, as PyVista has it


def colormap(cmap: Colormap) -> Any:
    """A map of Matplotlib's.

    Raises:
        UnknownNameError: there is none of that name.
        ShapeError: it is no map, and no list of colours.

    >>> colormap("viridis").N, colormap(["red", "white", "blue"]).N
    (256, 3)
    """
    import matplotlib
    from matplotlib.colors import Colormap as Known
    from matplotlib.colors import ListedColormap, to_rgba_array

    if isinstance(cmap, Known):
        return cmap
    if isinstance(cmap, str):
        if cmap not in matplotlib.colormaps:
            raise unknown(cmap, list(matplotlib.colormaps), what="colour map")
        return matplotlib.colormaps[cmap]
    try:
        colors = to_rgba_array(list(cmap))
        if not len(colors) or not ((colors >= 0.0) & (colors <= 1.0)).all():
            raise ValueError
        return ListedColormap(colors)
    except (TypeError, ValueError):
        error = ShapeError(f"cmap: expected a colour map, got {cmap!r}")
        raise hint(error, 'its name, such as "viridis", or a list of colours') from None


def limits(arrays: Sequence[NDArray[Any]], clim: Any = None) -> tuple[float, float]:
    """Which numbers have the first and the last colour of a map.

    Args:
        arrays: all numbers, of whatever shape; those that are not finite do not count.
        clim: (low, high), or one number for (-n, n); None for the least and the greatest that there are.

    Raises:
        ShapeError: limits that are none.

    >>> import numpy as np
    >>> limits([np.array([3.0, np.nan]), np.array([1, 2])]), limits([], 2)
    ((1.0, 3.0), (-2.0, 2.0))
    """
    if clim is not None:
        try:
            given: Any = clim if np.iterable(clim) else (-clim, clim)
            low, high = [float(number) for number in given]
        except (TypeError, ValueError, OverflowError):
            low = high = np.nan
        if not (np.isfinite(low) and np.isfinite(high) and low <= high):
            raise hint(ShapeError(f"clim: expected two numbers, the lower one first, got {clim!r}"), "clim=(0, 1)")
        return low, high
    ends = [
        (float(some.min()), float(some.max())) for some in [array[np.isfinite(array)] for array in arrays] if some.size
    ]
    return (min(low for low, _ in ends), max(high for _, high in ends)) if ends else (0.0, 1.0)


def colored(values: ArrayLike, cmap: Any, low: float, high: float) -> NDArray[np.float32]:
    """Numbers as colours, (n, 4) from 0 to 1, frozen; what lies beyond the ends has their colours.

    Args:
        values: (n,); what is not a number is grey.
        cmap: a map of Matplotlib's.
        low: has its first colour.
        high: has its last one.

    >>> colored([0, 5, 9], colormap(["red", "lime", "blue"]), 0, 9).tolist()
    [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]]
    """
    numbers = np.asarray(values, np.float64)
    span = high - low
    with np.errstate(invalid="ignore", over="ignore"):
        shares = (numbers - low) / span if span > 0.0 else np.where(numbers > low, 1.0, numbers * 0.0)
    found: NDArray[np.float32] = np.array(cmap(np.clip(np.nan_to_num(shares), 0.0, 1.0)), np.float32)
    found[np.isnan(numbers)] = MISSING
    return freeze(found)
