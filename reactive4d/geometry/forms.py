"""Quadratic forms: solids where a quadratic of x, y and z is at most 0, and their analytic rays.

Along a ray the form is a quadratic of the place, so what lies inside is one span, or two that reach to infinity. A
quadric is cut by a **clip** (a slab, or a box) into something finite.
"""

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError
from reactive4d.geometry.rays import Lines, columns
from reactive4d.geometry.sizes import lengths

__all__ = ["Clip", "between", "contains", "intersect", "meet", "spans", "within"]

Floats: TypeAlias = NDArray[np.float64]
Span: TypeAlias = tuple[Floats, Floats]


class Clip(NamedTuple):
    """What cuts lines: the places where they enter and leave it, (N,), and its outward normals there, (3, N)."""

    enter: Floats
    leave: Floats
    inward: Floats
    outward: Floats


def between(lines: Lines, low: float, high: float) -> Clip:
    """The slab between two heights."""
    up = np.zeros((3, len(lines)))
    up[2] = np.sign(lines.unit[2])
    return Clip(*lines.slab(2, low, high), -up, up)


def within(lines: Lines, half: Floats) -> Clip:
    """The box of these half extents, (3,), round the origin."""
    clip = Clip(np.full(len(lines), -np.inf), np.full(len(lines), np.inf), *np.zeros((2, 3, len(lines))))
    for axis in range(3):
        low, high = lines.slab(axis, -half[axis], half[axis])
        side = np.zeros((3, len(lines)))
        side[axis] = np.sign(lines.unit[axis])
        later, sooner = low > clip.enter, high < clip.leave
        clip = Clip(
            np.where(later, low, clip.enter),
            np.where(sooner, high, clip.leave),
            np.where(later, -side, clip.inward),
            np.where(sooner, side, clip.outward),
        )
    return clip


def spans(a: Floats, b: Floats, c: Floats) -> tuple[Span, Span]:
    """Where a t² + 2 b t + c is at most 0: two spans, of which one or both may be empty (from inf to -inf).

    The roots are found without cancellation (Press and others 2007, section 5.6).
    """
    square = b * b - a * c
    real = square >= 0.0
    q = -(b + np.copysign(np.sqrt(np.where(real, square, 0.0)), b))
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        one, other = q / a, c / q
    # Where a and b are 0 there is no t in it, where q is 0 both roots are.
    constant = (a == 0.0) & (b == 0.0)
    double = (q == 0.0) & ~constant
    one, other = np.where(double, 0.0, one), np.where(double, 0.0, other)
    one = np.where(constant, -np.inf, one)
    other = np.where(constant, np.where(c <= 0.0, np.inf, -np.inf), other)
    low, high = np.minimum(one, other), np.maximum(one, other)
    opens = a < 0.0
    never = np.where(constant, c > 0.0, ~real & ~opens)
    whole = ~real & opens
    first = (
        np.where(never, np.inf, np.where(opens, -np.inf, low)),
        np.where(never, -np.inf, np.where(whole, np.inf, np.where(opens, low, high))),
    )
    split = opens & real
    return first, (np.where(split, high, np.inf), np.where(split, np.inf, -np.inf))


def meet(lines: Lines, matrix: Floats, clip: Clip) -> tuple[Floats, Floats]:
    """Where rays first meet the solid: places (N,), inf where they miss, and outward gradients (3, N)."""
    q, slope, c = matrix[:3, :3], matrix[:3, 3], matrix[3, 3]
    along, near = q @ lines.unit, q @ lines.near
    first, second = spans(
        (lines.unit * along).sum(axis=0),
        (lines.near * along).sum(axis=0) + slope @ lines.unit,
        (lines.near * near).sum(axis=0) + 2.0 * (slope @ lines.near) + c,
    )
    place, entered, cut = _first(lines, first, clip)
    if np.isfinite(second[0]).any():
        later, later_entered, later_cut = _first(lines, second, clip)
        sooner = later < place
        place = np.where(sooner, later, place)
        entered, cut = np.where(sooner, later_entered, entered), np.where(sooner, later_cut, cut)
    gradient = near + np.where(np.isfinite(place), place, 0.0) * along + slope[:, None]
    return place, np.where(cut, np.where(entered, clip.inward, clip.outward), gradient)


def intersect(
    origins: ArrayLike, directions: ArrayLike, *, matrix: ArrayLike, size: ArrayLike
) -> tuple[Floats, Floats]:
    """Where rays first meet a general quadric inside of a box.

    Args:
        origins: (N, 3), metres.
        directions: (N, 3), of any length but 0.
        matrix: (4, 4) symmetric Q; the solid is where (x, y, z, 1) Q (x, y, z, 1) is at most 0.
        size: whole extents of the box round the origin, metres.

    Returns:
        Distance (N,) along the direction, inf where missed, and normal (N, 3).

    Raises:
        ShapeError: a ray, the matrix or the size is not sound.

    >>> import numpy as np
    >>> saddle = np.array([[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 0, 0.5], [0, 0, 0.5, 0]])
    >>> intersect([(0.5, 0, 3)], [(0, 0, -1)], matrix=saddle, size=(2, 2, 2))[0].tolist()
    [3.25]
    """
    lines = Lines.of(origins, directions)
    clip = within(lines, np.array(lengths(size, "size")) / 2.0)
    return lines.answer(*meet(lines, _symmetric(matrix), clip))


def contains(points: ArrayLike, *, matrix: ArrayLike, size: ArrayLike) -> NDArray[np.bool_]:
    """Whether points lie inside or on the surface of a general quadric inside of a box, (N,)."""
    p = columns(points)
    h = np.concatenate([p, np.ones((1, p.shape[1]))])
    half = np.array(lengths(size, "size")) / 2.0
    value = (h * (_symmetric(matrix) @ h)).sum(axis=0)
    return freeze((value <= 0.0) & (np.abs(p) <= half[:, None]).all(axis=0))


def _symmetric(value: ArrayLike) -> Floats:
    try:
        matrix = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise ShapeError(f"matrix: expected (4, 4) numbers, got {value!r}") from None
    if matrix.shape != (4, 4) or not np.isfinite(matrix).all():
        raise ShapeError(f"matrix: expected (4, 4) finite numbers, got the shape {matrix.shape}")
    if not np.array_equal(matrix, matrix.T):
        raise ShapeError("matrix: expected a symmetric matrix")
    return matrix


def _first(lines: Lines, span: Span, clip: Clip) -> tuple[Floats, NDArray[np.bool_], NDArray[np.bool_]]:
    """The first place of one span inside of the clip, whether the ray enters there, and whether the clip is met."""
    enter, leave = np.maximum(span[0], clip.enter), np.minimum(span[1], clip.leave)
    place, entered = lines.first(enter, leave)
    # A ray through the edge meets the clip, whose normal is sure.
    return place, entered, np.where(entered, clip.enter >= span[0], clip.leave <= span[1])
