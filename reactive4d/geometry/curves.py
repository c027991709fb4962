"""Curves that control points draw: at any parameter a fixed blend of the points, so that a frame is one product.

A curve's parameter u runs from 0 to 1 over the whole curve, each span taking the same share. What blends the points is
the **basis**: a matrix with one row for each parameter and one column for each control point. It depends on how many
points there are, never on where they are; so it is computed once and holds for ever while the points move.

The kinds are `linear`; `catmull_rom`, through the points (Catmull, Rom 1974, uniform); `bezier`, a chain of Bézier
curves that share their ends (with as many points as degree + 1 a single one); and `bspline`, near the points and
smoothest (open ones begin and end at the first and the last point).
"""

import functools
import math
from collections.abc import Callable
from typing import Any, Final, Literal, TypeAlias, cast, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError, hint, unknown

__all__ = [
    "KINDS",
    "Kind",
    "basis",
    "derivative",
    "length",
    "parameters",
    "polyline",
    "position",
    "sampled_basis",
    "spans",
    "tangent",
]

Floats: TypeAlias = NDArray[np.float64]
Kind: TypeAlias = Literal["linear", "catmull_rom", "bezier", "bspline"]
KINDS: Final[tuple[str, ...]] = get_args(Kind)

# Rows: the powers of x from 1 to x³. Columns: the points -1, 0, 1, 2 about a span.
_CATMULL_ROM: Final = np.array([[0, 2, 0, 0], [-1, 0, 1, 0], [2, -5, 4, -1], [-1, 3, -3, 1]]) / 2.0
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)


def spans(count: int, *, kind: Kind = "catmull_rom", degree: int = 3, closed: bool = False) -> int:
    """How many polynomial pieces a curve of `count` control points has.

    Args:
        count: how many control points, at least 2 (closed at least 3).
        kind: one of `KINDS`.
        degree: of Bézier curves and B-splines, 1 to 16; one that the points are too few for is lowered.
        closed: whether the curve returns to its beginning.

    Raises:
        ShapeError: too few points, or points that make no whole number of Bézier curves.
        UnknownNameError: there is no such kind.

    >>> spans(7, kind="bezier"), spans(7, kind="bspline"), spans(7, closed=True)
    (2, 4, 7)
    """
    if kind not in KINDS:
        raise unknown(kind, KINDS, what="kind of curve")
    least = 3 if closed else 2
    if count < least:
        raise ShapeError(f"controls: expected at least {least} points of a{' closed' * closed} curve, got {count}")
    if not 1 <= degree <= 16:
        raise ShapeError(f"degree: expected 1 to 16, got {degree!r}")
    degree = _lowered(count, degree, closed=closed)
    if kind == "bezier":
        pieces, rest = divmod(count if closed else count - 1, degree)
        if rest:
            raise hint(
                ShapeError(f"controls: {count} points make no whole number of Bézier curves of degree {degree}"),
                f"give {pieces * degree + (not closed)} or {(pieces + 1) * degree + (not closed)} points",
            )
        return pieces
    if kind == "bspline":
        return count if closed else count - degree
    return count if closed else count - 1


def basis(
    u: ArrayLike,
    count: int,
    *,
    kind: Kind = "catmull_rom",
    degree: int = 3,
    closed: bool = False,
    order: int = 0,
) -> Floats:
    """The weights of the control points at the parameters u; they sum to 1 (those of a derivative to 0).

    Args:
        u: (S,), from 0 to 1; held at the ends of an open curve, taken modulo 1 on a closed one.
        count: how many control points.
        kind: one of `KINDS`.
        degree: of Bézier curves and B-splines.
        closed: whether the curve returns to its beginning.
        order: 0 the position, 1 and 2 the derivatives by u.

    Returns:
        (S, count), frozen.

    Raises:
        ShapeError: a parameter is not finite, or as `spans`.

    >>> basis([0.25], 3, kind="linear").tolist()
    [[0.5, 0.5, 0.0]]
    """
    at = np.asarray(u, np.float64)
    if at.ndim != 1 or not np.isfinite(at).all():
        raise ShapeError(f"u: expected finite numbers of shape (S,), got {at.tolist() if at.size < 5 else at.shape}")
    if order not in (0, 1, 2):
        raise ShapeError(f"order: expected 0, 1 or 2, got {order!r}")
    pieces = spans(count, kind=kind, degree=degree, closed=closed)
    degree = _lowered(count, degree, closed=closed)
    at = np.mod(at, 1.0) if closed else np.clip(at, 0.0, 1.0)
    if kind == "bspline":
        return freeze(_spline(count, degree, closed)(at * pieces, order) * float(pieces) ** order)
    place: NDArray[np.int64] = np.minimum((at * pieces).astype(np.int64), pieces - 1)
    x: Floats = np.asarray(at * pieces - place, np.float64)
    if kind == "linear":
        weights, step, ahead = _linear(x, order), 1, 0
    elif kind == "catmull_rom":
        weights, step, ahead = _powers(x, 3, order) @ _CATMULL_ROM, 1, 1
    else:
        weights, step, ahead = _bernstein(x, degree, order), degree, 0
    rows = np.zeros((len(at), count + 2 * ahead if not closed else count))
    columns = cast("NDArray[np.int64]", place[:, None] * step + np.arange(int(weights.shape[1])))
    if closed:
        columns = (columns - ahead) % count
    np.add.at(rows, (np.arange(len(at))[:, None], columns), weights)
    if ahead and not closed:  # the points beyond the ends mirror the last but one
        first, last, rows = rows[:, 0], rows[:, -1], rows[:, 1:-1].copy()
        rows[:, 0] += 2 * first
        rows[:, 1] -= first
        rows[:, -1] += 2 * last
        rows[:, -2] -= last
    return freeze(rows * float(pieces) ** order)


@functools.lru_cache(maxsize=256)
def sampled_basis(
    count: int, samples: int, *, kind: Kind = "catmull_rom", degree: int = 3, closed: bool = False, order: int = 0
) -> Floats:
    """The basis at `samples` + 1 parameters from 0 to 1, remembered; the last row of a closed curve is its first.

    >>> sampled_basis(2, 2, kind="linear").tolist()
    [[1.0, 0.0], [0.5, 0.5], [0.0, 1.0]]
    """
    if samples < 1:
        raise ShapeError(f"samples: expected at least 1, got {samples!r}")
    return basis(np.arange(samples + 1) / samples, count, kind=kind, degree=degree, closed=closed, order=order)


def position(
    controls: ArrayLike, u: ArrayLike, *, kind: Kind = "catmull_rom", degree: int = 3, closed: bool = False
) -> Floats:
    """The points of a curve.

    Args:
        controls: (N, D), where D is 3 for points of space.
        u: a parameter from 0 to 1, or (S,) of them.
        kind: one of `KINDS`.
        degree: of Bézier curves and B-splines.
        closed: whether the curve returns to its beginning.

    Returns:
        (D,) for a number, else (S, D); frozen.

    Raises:
        ShapeError: the control points are too few, of another shape or not finite; or a parameter is not finite.

    >>> position([(0, 0, 0), (1, 0, 0), (1, 2, 0)], 0.75, kind="linear").tolist()
    [1.0, 1.0, 0.0]
    """
    return _blend(controls, u, kind, degree, closed, 0)


def derivative(
    controls: ArrayLike,
    u: ArrayLike,
    *,
    kind: Kind = "catmull_rom",
    degree: int = 3,
    closed: bool = False,
    order: int = 1,
) -> Floats:
    """The derivative of the position by u, as `position` otherwise.

    >>> derivative([(0, 0, 0), (1, 0, 0), (1, 2, 0)], 0.75, kind="linear").tolist()
    [0.0, 4.0, 0.0]
    """
    return _blend(controls, u, kind, degree, closed, order)


def tangent(
    controls: ArrayLike, u: ArrayLike, *, kind: Kind = "catmull_rom", degree: int = 3, closed: bool = False
) -> Floats:
    """The direction of a curve: unit vectors, as `position` otherwise.

    Where the derivative vanishes (control points that coincide) it is the direction between the points just beside.

    Raises:
        ShapeError: as `position`, or the curve stands still there.

    >>> tangent([(0, 0, 0), (1, 0, 0), (1, 2, 0)], 0.75, kind="linear").tolist()
    [0.0, 1.0, 0.0]
    """
    at = np.asarray(u, np.float64)
    first = np.atleast_2d(derivative(controls, at, kind=kind, degree=degree, closed=closed)).copy()
    size = float(np.ptp(np.asarray(controls, np.float64), axis=0).max())
    speed = np.linalg.norm(first, axis=1)
    still = speed <= 1e-9 * size
    if still.any():
        beside = np.atleast_1d(at)[still]
        ends = [position(controls, beside + side, kind=kind, degree=degree, closed=closed) for side in (1e-3, -1e-3)]
        first[still] = ends[0] - ends[1]
        speed = np.linalg.norm(first, axis=1)
        if size == 0 or (speed <= 1e-12 * size).any():
            where = float(np.atleast_1d(at)[int(np.argmin(speed))])
            raise hint(
                ShapeError(f"the curve has no direction at u = {where:g}: it stands still there"),
                "move control points that coincide apart",
            )
    return freeze((first / speed[:, None]).reshape(*at.shape, -1))


def polyline(
    controls: ArrayLike, samples: int, *, kind: Kind = "catmull_rom", degree: int = 3, closed: bool = False
) -> NDArray[np.float32]:
    """The curve as a chain of `samples` straight pieces, to be drawn: (samples + 1, D) float32, frozen.

    >>> polyline([(0, 0), (2, 4)], 2, kind="linear").tolist()
    [[0.0, 0.0], [1.0, 2.0], [2.0, 4.0]]
    """
    points = _controls(controls)
    weights = sampled_basis(len(points), samples, kind=kind, degree=degree, closed=closed)
    return freeze((weights @ points).astype(np.float32))


def length(
    controls: ArrayLike, *, kind: Kind = "catmull_rom", degree: int = 3, closed: bool = False, pieces: int = 4
) -> float:
    """The length of a curve, metres: Gauss' quadrature with 8 nodes on `pieces` pieces of each span.

    >>> round(length([(0, 0, 0), (3, 4, 0), (3, 4, 5)], kind="linear"), 12)
    10.0
    """
    return float(_pieces(controls, kind, degree, closed, pieces).sum())


def parameters(
    controls: ArrayLike, fractions: ArrayLike, *, kind: Kind = "catmull_rom", degree: int = 3, closed: bool = False
) -> Floats:
    """The parameters at which a curve has passed the given fractions of its length.

    Args:
        controls: (N, D).
        fractions: (S,), from 0 to 1; held beyond.
        kind: one of `KINDS`.
        degree: of Bézier curves and B-splines.
        closed: whether the curve returns to its beginning.

    Returns:
        (S,), frozen. Where the curve has no length they are the fractions themselves.

    >>> parameters([(0, 0), (1, 0), (10, 0)], [0.5], kind="linear").round(6).tolist()
    [0.722222]
    """
    wanted = np.clip(np.atleast_1d(np.asarray(fractions, np.float64)), 0.0, 1.0)
    if wanted.ndim != 1 or not np.isfinite(wanted).all():
        raise ShapeError(f"fractions: expected finite numbers of shape (S,), got shape {wanted.shape}")
    lengths = _pieces(controls, kind, degree, closed, 8)
    passed = np.concatenate([[0.0], np.cumsum(lengths)])
    points = _controls(controls)
    if passed[-1] <= 1e-12 * np.abs(points).max():  # nothing but rounding
        return freeze(wanted.copy())
    share = 1.0 / len(lengths)
    goal = wanted * passed[-1]
    search = cast("Callable[..., NDArray[np.int64]]", np.searchsorted)
    piece: NDArray[np.int64] = np.clip(search(passed, goal, side="right") - 1, 0, len(lengths) - 1)
    low = np.asarray(piece * share, np.float64)
    high = low + share
    long = np.where(lengths[piece] > 0, lengths[piece], 1.0)
    u: Floats = low + share * (goal - passed[piece]) / long
    options: dict[str, Any] = {"kind": kind, "degree": degree, "closed": closed}
    for _ in range(4):  # Newton, held inside of the piece
        half = (u - low) / 2.0
        nodes = np.minimum(low[:, None] + half[:, None] * (1.0 + _NODES), 1.0)
        slope = basis(nodes.ravel(), len(points), order=1, **options) @ points
        speeds = np.linalg.norm(slope, axis=1).reshape(nodes.shape)
        short = goal - passed[piece] - half * (speeds @ _WEIGHTS)
        speed = np.linalg.norm(basis(u, len(points), order=1, **options) @ points, axis=1)
        step = short / np.where(speed > 1e-12 * passed[-1], speed, np.inf)
        u = np.minimum(np.maximum(u + step, low), high)
    return freeze(u)


def _pieces(controls: ArrayLike, kind: Kind, degree: int, closed: bool, pieces: int) -> Floats:
    """The lengths of equal shares of the parameter, `pieces` of them for each span."""
    points = _controls(controls)
    count = spans(len(points), kind=kind, degree=degree, closed=closed) * pieces
    weights = _gauss_basis(len(points), count, kind, degree, closed)
    speeds = np.linalg.norm(weights @ points, axis=1).reshape(count, -1)
    return speeds @ _WEIGHTS / (2.0 * count)


@functools.lru_cache(maxsize=64)
def _gauss_basis(count: int, pieces: int, kind: Kind, degree: int, closed: bool) -> Floats:
    nodes = (np.arange(pieces)[:, None] + (1.0 + _NODES) / 2.0) / pieces
    return basis(nodes.ravel(), count, kind=kind, degree=degree, closed=closed, order=1)


def _blend(controls: ArrayLike, u: ArrayLike, kind: Kind, degree: int, closed: bool, order: int) -> Floats:
    points = _controls(controls)
    at = np.asarray(u, np.float64)
    if at.ndim > 1:
        raise ShapeError(f"u: expected a number or shape (S,), got {at.shape}")
    weights = basis(np.atleast_1d(at), len(points), kind=kind, degree=degree, closed=closed, order=order)
    return freeze((weights @ points).reshape(*at.shape, points.shape[1]).copy())


def _controls(controls: ArrayLike) -> Floats:
    points = np.asarray(controls, np.float64)
    if points.ndim != 2 or not points.shape[1]:
        raise ShapeError(f"controls: expected points of shape (N, D), got shape {points.shape}")
    if not np.isfinite(points).all():
        row = int(np.argwhere(~np.isfinite(points))[0, 0])
        raise ShapeError(f"controls: expected finite numbers, point {row} is {points[row].tolist()}")
    return points


def _lowered(count: int, degree: int, *, closed: bool) -> int:
    return min(degree, count - (not closed))


@functools.lru_cache(maxsize=64)
def _spline(count: int, degree: int, closed: bool) -> Any:
    """The B-spline with unit vectors for control points, over the parameter 0 to the number of spans."""
    from scipy.interpolate import BSpline  # pyright: ignore[reportMissingTypeStubs]

    spline = cast("Any", BSpline)
    if not closed:
        inner = np.arange(count - degree + 1, dtype=np.float64)
        knots = np.concatenate([np.zeros(degree), inner, np.full(degree, inner[-1])])
        return spline(knots, np.eye(count), degree)
    knots = np.arange(-degree, count + degree + 1, dtype=np.float64)
    # Turned by half of the degree, so that the curve begins nearest to the first point.
    columns = (np.arange(count + degree) - degree // 2) % count
    return spline(knots, np.eye(count)[columns], degree)


def _linear(x: Floats, order: int) -> Floats:
    if order == 0:
        return np.stack([1.0 - x, x], axis=1)
    one = np.full_like(x, float(order == 1))
    return np.stack([-one, one], axis=1)


def _powers(x: Floats, degree: int, order: int) -> Floats:
    """The derivatives of 1, x, x² … as columns."""
    columns = [math.perm(n, order) * x ** (n - order) if n >= order else np.zeros_like(x) for n in range(degree + 1)]
    return np.stack(columns, axis=1)


def _bernstein(x: Floats, degree: int, order: int) -> Floats:
    """Bernstein's polynomials as columns; a derivative is the difference of two of the degree below."""
    if order > degree:
        return np.zeros((len(x), degree + 1))
    if order:
        below = _bernstein(x, degree - 1, order - 1)
        none = np.zeros((len(x), 1))
        return degree * (np.hstack([none, below]) - np.hstack([below, none]))
    return np.stack([math.comb(degree, i) * x**i * (1.0 - x) ** (degree - i) for i in range(degree + 1)], axis=1)
