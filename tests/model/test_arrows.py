"""Arrows: from one point to another, or of a length in a direction."""

import math
from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d.geometry import arrows, meshes


def tip_and_foot(arrow: r4.Arrow, t: float = 0.0) -> tuple[list[float], list[float]]:
    """Where its tip and its foot are, found in the mesh: on the axis, at the two ends."""
    mesh = arrow.mesh.at(t)
    local = arrow.points.at(t)
    return mesh.points[local[:, 2].argmax()].tolist(), mesh.points[local[:, 2].argmin()].tolist()


@pytest.mark.parametrize("start", [(0, 0, 0), (1, -2, 3)])
@pytest.mark.parametrize(
    "way", [(0, 0, 2), (0, 0, -2), (3, 0, 0), (0, -4, 0), (1, 1, 1), (1e-9, 0, -1), (-1e-13, 1e-14, -5)]
)
def test_an_arrow_goes_from_one_point_to_another(start: Any, way: Any):
    """Whatever the direction, straight down too; its matrix is rigid."""
    stop = np.add(start, way)
    arrow = r4.Arrow(start, stop)
    tip, foot = tip_and_foot(arrow)
    assert np.allclose(tip, stop, atol=1e-5)
    assert np.allclose(foot, start, atol=0.04 * math.dist(start, stop) + 1e-5)
    matrix = arrow.matrix.at(0.0)
    assert np.allclose(matrix[:3, :3].T @ matrix[:3, :3], np.eye(3), atol=1e-12)
    assert np.linalg.det(matrix[:3, :3]) == pytest.approx(1.0)
    assert arrow.position.at(0.0).tolist() == list(start)


def test_an_arrow_has_a_length_in_a_direction():
    """The direction's own length does not count; unless told otherwise it stands up, one metre tall."""
    assert np.allclose(tip_and_foot(r4.Arrow())[0], (0, 0, 1))
    assert np.allclose(tip_and_foot(r4.Arrow((1, 0, 0), direction=(0, 7, 0), length=3))[0], (1, 3, 0), atol=1e-6)
    assert np.allclose(tip_and_foot(r4.Arrow(direction="x", length=2))[0], (2, 0, 0), atol=1e-6)


def test_an_arrow_is_one_closed_solid():
    """Shaft and head together: its volume is that of both, and it takes part in booleans."""
    arrow = r4.Arrow(stop=(0, 0, 2), radius=0.1, segments=200)
    mesh = arrow.surface.at(0.0)
    assert meshes.is_closed(mesh)
    assert meshes.is_manifold(mesh)
    shaft, head, neck, tip = arrows.proportions(2.0, 0.1)
    assert 0 < shaft < head < neck < tip == 2.0
    exact = math.pi * (shaft**2 * neck + head**2 * (tip - neck) / 3)
    assert arrow.volume.at(0.0) == pytest.approx(exact)
    assert meshes.volume(mesh) == pytest.approx(exact, rel=1e-3)
    assert (arrow - r4.Box(1.0)).volume.at(0.0) == pytest.approx(exact - math.pi * shaft**2 * 0.5, rel=5e-3)
    normals = meshes.normals(mesh)
    outward = np.einsum("ij,ij->i", normals[:, :2], mesh.points[:, :2])
    assert (outward[np.hypot(*mesh.points.T[:2]) > 1e-6] > -1e-4).all()


def test_the_head_keeps_its_shape_when_the_arrow_is_short():
    """With a given thickness, an arrow becomes thinner before its head would be longer than itself."""
    for size in (0.001, 0.1, 1.0, 100.0):
        shaft, head, neck, tip = arrows.proportions(size, 0.05)
        assert shaft <= 0.05
        assert neck >= size / 4
        assert (head / shaft, (tip - neck) / shaft) == pytest.approx((2.5, 8.0))
    assert arrows.proportions(10.0, 0.05).shaft == 0.05
    assert arrows.proportions(10.0).shaft == pytest.approx(0.3)


def test_an_arrow_follows_what_it_points_at():
    """Live at both ends; where it has no length, it is there and has no volume."""
    ball = r4.Sphere()
    ball.translate(r4.vec(0, r4.time, 1))
    speed = r4.Arrow(ball.position, ball.position + 2 * ball.velocity, color="orange")
    scene = r4.Scene(ball=ball, speed=speed)
    for t in (0.0, 3.0, -1.0):
        tip, foot = tip_and_foot(speed, t)
        assert np.allclose(tip, (0, t + 2, 1), atol=1e-5)
        assert np.allclose(foot[1], t, atol=1e-5)
        assert scene.at(t)["speed"].primitive == "mesh"
    shrinking = r4.Arrow(stop=r4.vec(0, 0, 1 - r4.time))
    assert shrinking.volume.at(1.0) == 0.0
    assert np.isfinite(shrinking.mesh.at(1.0).points).all()
    assert tip_and_foot(shrinking, 3.0)[0] == pytest.approx([0, 0, -2])


def test_turning_an_arrow_changes_its_matrix_alone():
    """A hand of a clock is one mesh at all times."""
    hand = r4.Arrow(direction=r4.vec(np.sin(r4.time), np.cos(r4.time), 0), length=2)
    with r4.log() as events:
        points = {hand.points.at(float(t)).tobytes() for t in range(5)}
    assert len(points) == 1
    assert sum(event.kind == "evaluated" and event.name.endswith(".points") for event in events) <= 2
    assert hand.points.valid(0.0) == r4.FOREVER
    assert hand.matrix.at(1.0).tolist() != hand.matrix.at(2.0).tolist()


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: r4.Arrow((0, 0, 0), (1, 0, 0), length=2), "was given twice"),
        (lambda: r4.Arrow((0, 0)), "Arrow.start: expected 3 numbers"),
        (lambda: r4.Arrow(direction=(0, 0, 0)), "has no direction"),
        (lambda: r4.Arrow(length=-1), "Arrow.length: expected a number of at least 0"),
        (lambda: r4.Arrow(to=(1, 0, 0)), "unknown setting of Arrow 'to'"),
        (lambda: r4.Arrow(radius="thick"), "Arrow.radius: expected a number"),
    ],
)
def test_what_is_no_arrow_is_refused(make: Any, says: str):
    """At the border, by name."""
    with pytest.raises((r4.Reactive4dError, TypeError), match=says):
        make()


def test_an_arrow_is_written_and_read():
    """It is a kind like all others, in scripts too."""
    scene = r4.Scene(up=r4.Arrow((1, 0, 0), r4.keys({0: (1, 0, 1), 2: (1, 0, 3)}), color="teal"))
    again = r4.loads(r4.dumps(scene))
    assert np.array_equal(again["up"].mesh.at(1.0).points, scene["up"].mesh.at(1.0).points)
