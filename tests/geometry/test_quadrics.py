"""Three radii make spheres, spheroids, cylinders, cones, paraboloids and hyperboloids, with their closed forms."""

import math

import numpy as np
import pytest

from reactive4d.errors import ShapeError
from reactive4d.geometry import cones, cylinders, quadrics, spheres


def prolate(a: float, c: float) -> float:
    """The area of a spheroid of half axes a, a and c > a."""
    e = math.sqrt(1 - (a / c) ** 2)
    return 2 * math.pi * a * a * (1 + c / (a * e) * math.asin(e))


def oblate(a: float, c: float) -> float:
    """The area of a spheroid of half axes a, a and c < a."""
    e = math.sqrt(1 - (c / a) ** 2)
    return 2 * math.pi * a * a * (1 + (1 - e * e) / e * math.atanh(e))


@pytest.mark.parametrize(
    ("radii", "height", "expected"),
    [
        ((0.0, 0.7, 0.0), 1.4, spheres.area(0.7)),
        ((0.0, 0.7, 0.0), 4.0, prolate(0.7, 2.0)),
        ((0.0, 2.0, 0.0), 1.0, oblate(2.0, 0.5)),
        ((0.6, 0.6, 0.6), 1.5, cylinders.area(0.6, 1.5)),
        ((0.9, 0.6, 0.3), 1.5, cones.area(0.9, 0.3, 1.5)),
        ((0.9, 0.45, 0.0), 1.5, cones.area(0.9, 0.0, 1.5)),
        ((0.5, 0.0, 0.5), 1.0, 2 * cones.area(0.5, 0.0, 0.5)),  # two cones point to point
        # A paraboloid z = x² + y² up to 1, with its disc.
        ((0.0, math.sqrt(0.5), 1.0), 1.0, math.pi / 6 * (5 * math.sqrt(5) - 1) + math.pi),
    ],
)
def test_areas(radii, height, expected):
    """The known ones, to 1e-11."""
    assert quadrics.area(radii, height) == pytest.approx(expected, rel=1e-11)


def test_volumes_and_centres():
    """A sphere, a cone, a paraboloid (half of its cylinder, centre two thirds up) and a hyperboloid."""
    assert quadrics.volume((0, 0.7, 0), 1.4) == pytest.approx(spheres.volume(0.7))
    assert quadrics.volume((0.9, 0.45, 0), 2.0) == pytest.approx(cones.volume(0.9, 0.0, 2.0))
    assert quadrics.volume((0, math.sqrt(0.5), 1), 1.0) == pytest.approx(math.pi / 2)
    assert quadrics.center_of_mass((0, math.sqrt(0.5), 1), 1.0) == pytest.approx([0, 0, 2 / 3 - 1 / 2])
    # x² + y² = 1 + z² from -1 to 1
    assert quadrics.volume((math.sqrt(2), 1, math.sqrt(2)), 2.0) == pytest.approx(math.pi * 8 / 3)


def test_inertia_of_a_sphere_a_cylinder_and_a_cone():
    """2/5 r²; r²/2 and r²/4 + h²/12; 3/10 r² and 3/20 r² + 3/80 h²."""
    assert quadrics.inertia((0, 0.7, 0), 1.4) == pytest.approx(spheres.inertia(0.7))
    r, h = 0.6, 1.5
    expected = cylinders.volume(r, h) * np.diag([r * r / 4 + h * h / 12] * 2 + [r * r / 2])
    assert cylinders.inertia(r, h) == pytest.approx(expected)
    expected = cones.volume(r, 0.0, h) * np.diag([3 / 20 * r * r + 3 / 80 * h * h] * 2 + [3 / 10 * r * r])
    assert cones.inertia(r, 0.0, h) == pytest.approx(expected)


@pytest.mark.parametrize("radii", [(0.6, 0.2, 0.4), (0.0, 1.0, 0.0), (0.3, 0.7, 0.5)])
def test_the_form_is_zero_on_every_vertex_of_the_side(radii):
    """So the mesh is inscribed in the quadric."""
    points = quadrics.points(radii, 1.5, 12, stacks=6).astype(float)
    side = points[2 * 13 : -2 * 13]
    h = np.column_stack([side, np.ones(len(side))])
    assert np.einsum("ni,ij,nj->n", h, quadrics.matrix(radii, 1.5), h) == pytest.approx(0.0, abs=1e-6)


def test_rays_through_the_waist_of_a_double_cone():
    """Along the axis and past its point, from above to below and across."""
    starts, ways = [(0.1, 0, 2), (1, 0, 0.25), (0, 0, 2)], [(0, 0, -1), (-1, 0, 0), (0, 0, -1)]
    distance, normal = quadrics.intersect(starts, ways, radii=(0.5, 0.0, 0.5), height=1.0)
    assert distance.tolist() == pytest.approx([1.5, 0.75, 1.5])
    assert normal[1] == pytest.approx([math.sqrt(0.5), 0, -math.sqrt(0.5)])


def test_radii_of_no_quadric_are_refused():
    """The side would end before it reaches the other end."""
    with pytest.raises(ShapeError, match=r"radii: expected a middle radius of at least 0.5, half the difference"):
        quadrics.points((1.0, 0.4, 0.0))
