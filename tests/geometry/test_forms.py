"""General quadrics: their rays are those of moved spheres, of cones, saddles and pairs of sheets."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from reactive4d.errors import ShapeError
from reactive4d.geometry import cylinders, forms, quadrics, rays, spheres

SADDLE = np.array([[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 0, 0.5], [0, 0, 0.5, 0]])
SHEETS = np.diag([1.0, 1.0, -1.0, 0.25])  # of two sheets: z² >= x² + y² + 1/4
MATRICES = {"saddle": SADDLE, "two sheets": SHEETS, "all of it": np.diag([0, 0, 0, -1.0]), "outside": -SHEETS}


@given(st.integers(0, 10_000))
@settings(max_examples=20)
def test_a_moved_sphere_is_met_where_the_sphere_is_met_by_moved_rays(seed):
    """Under any affine map, the distance stays and the normal stays square to the surface."""
    draw = np.random.default_rng(seed)
    m = np.eye(4)
    m[:3] += 0.3 * draw.normal(size=(3, 4))
    assume(abs(np.linalg.det(m)) > 0.1)
    back = np.linalg.inv(m)
    q = back.T @ np.diag([1.0, 1.0, 1.0, -1.0]) @ back
    origins = draw.normal(size=(200, 3)) * 3
    directions = draw.uniform(-0.5, 0.5, size=(200, 3)) @ m[:3, :3].T + m[:3, 3] - origins
    distance, normal = forms.intersect(origins, directions, matrix=(q + q.T) / 2, size=(1e3, 1e3, 1e3))
    turned = origins @ back[:3, :3].T + back[:3, 3], directions @ back[:3, :3].T
    expected, square = spheres.intersect(*turned, radius=1.0)
    both = np.isfinite(distance) & np.isfinite(expected)
    assert (np.isfinite(distance) != np.isfinite(expected)).sum() <= 1
    assert both.sum() > 190
    assert np.median(np.abs(distance[both] - expected[both])) < 1e-9
    outward = square @ back[:3, :3]
    facing = np.einsum("ij,ij->i", normal, outward)[both] / np.linalg.norm(outward[both], axis=1)
    assert np.median(facing) > 1 - 1e-9
    assert (facing > 0.99).mean() > 0.95


@pytest.mark.parametrize("matrix", MATRICES.values(), ids=MATRICES.keys())
def test_hits_lie_on_the_boundary_and_nothing_lies_before_them(matrix):
    """A little inward is inside, a little outward is outside, and up to there nothing changes sides."""
    same = {"matrix": matrix, "size": (2.0, 2.0, 2.0)}
    draw = np.random.default_rng(8)
    origins, directions = draw.normal(size=(2, 3000, 3)) * 1.2
    found = forms.intersect(origins, directions, **same)
    met = np.isfinite(found[0])
    assert 0.1 < met.mean() < 0.95
    point, normal = rays.hits(origins, directions, found).point[met], found[1][met]
    assert forms.contains(point - 1e-7 * normal, **same).mean() > 0.999
    assert forms.contains(point + 1e-7 * normal, **same).mean() < 0.001
    inside = forms.contains(origins, **same)
    assert met[inside].all()
    reach = np.where(met, found[0], 3.0)
    for share in np.linspace(0.001, 0.999, 40):
        there = forms.contains(origins + (share * reach)[:, None] * directions, **same)
        assert (there == inside).mean() > 0.999


def test_the_round_quadrics_are_forms():
    """The matrix of a cylinder in a box as high as it is."""
    draw = np.random.default_rng(9)
    origins, directions = draw.normal(size=(2, 1000, 3))
    q = quadrics.matrix((0.5, 0.5, 0.5), 1.2)
    ours = forms.intersect(origins, directions, matrix=q, size=(5.0, 5.0, 1.2))
    theirs = cylinders.intersect(origins, directions, radius=0.5, height=1.2)
    assert np.array_equal(ours[0], theirs[0])
    assert np.array_equal(ours[1], theirs[1])


@pytest.mark.parametrize(
    ("coefficients", "inside"),
    [
        ((1.0, 0.0, -4.0), [(-2, 2)]),
        ((-1.0, 0.0, 4.0), [(-math.inf, -2), (2, math.inf)]),
        ((1.0, 0.0, 1.0), []),
        ((-1.0, 0.0, -1.0), [(-math.inf, math.inf)]),
        ((0.0, 1.0, -6.0), [(-math.inf, 3)]),
        ((0.0, -1.0, -6.0), [(-3, math.inf)]),
        ((0.0, 0.0, -1.0), [(-math.inf, math.inf)]),
        ((0.0, 0.0, 0.0), [(-math.inf, math.inf)]),
        ((0.0, 0.0, 1.0), []),
        ((2.0, 0.0, 0.0), [(0, 0)]),
        ((1.0, -3.0, 9.0), [(3, 3)]),
        ((1e-300, -0.5, 1.0), [(1, 1e300)]),
    ],
)
def test_spans_of_a_quadratic(coefficients, inside):
    """Where a t² + 2 b t + c is at most 0: nowhere, once, twice, or everywhere."""
    both = forms.spans(*(np.array([x]) for x in coefficients))
    found = [(low[0], high[0]) for low, high in both if low[0] <= high[0]]
    assert len(found) == len(inside)
    for span, expected in zip(found, inside, strict=True):
        assert span == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    ("matrix", "message"),
    [
        (np.eye(3), r"matrix: expected \(4, 4\) finite numbers"),
        (np.full((4, 4), np.nan), r"matrix: expected \(4, 4\) finite numbers"),
        (np.arange(16.0).reshape(4, 4), "matrix: expected a symmetric matrix"),
        ("round", r"matrix: expected \(4, 4\) numbers, got 'round'"),
    ],
)
def test_matrices_that_are_no_quadric_are_refused(matrix, message):
    """By both functions."""
    with pytest.raises(ShapeError, match=message):
        forms.contains([(0, 0, 0)], matrix=matrix, size=(1, 1, 1))
    with pytest.raises(ShapeError, match=message):
        forms.intersect([(0, 0, 0)], [(0, 0, 1)], matrix=matrix, size=(1, 1, 1))
