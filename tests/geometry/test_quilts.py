"""Quilts: patches that are sewn along the edges they share."""

import math

import numpy as np
import pytest

from reactive4d.errors import ShapeError
from reactive4d.geometry import meshes, quilts
from reactive4d.geometry.solids import from_mesh


def cushion():
    """Six patches over the sides of a cube, sewn along all twelve edges; (N, 3) and (6, 4, 4)."""
    step = np.linspace(-1, 1, 4)
    controls, seen, quilt = [], {}, []
    for axis in range(3):
        for sign in (-1.0, 1.0):
            patch = np.zeros((4, 4), int)
            for i in range(4):
                for j in range(4):
                    p = [0.0] * 3
                    p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = sign, step[j], step[i]
                    key = tuple(round(x, 6) for x in p)
                    patch[i, j] = seen.setdefault(key, len(controls))
                    if patch[i, j] == len(controls):
                        controls.append(p)
            quilt.append(patch if sign > 0 else patch[:, ::-1])
    return np.array(controls), np.array(quilt)


@pytest.mark.parametrize("segments", [1, 2, 5])
def test_a_quilt_is_sewn_along_shared_edges(segments):
    """A cube of six patches is a closed surface, whatever the directions in which neighbours read their edge."""
    controls, quilt = cushion()
    cube = quilts.mesh(controls, quilt, segments=segments)
    assert meshes.is_closed(cube)
    assert meshes.volume(cube) == pytest.approx(8, rel=1e-5)
    assert cube.points[cube.attributes["weld"]].tobytes() == cube.points.tobytes()
    bent = quilts.mesh(controls + np.sin(controls[:, ::-1] * 2) * 0.2, quilt, segments=segments)
    assert meshes.is_closed(bent)
    assert bent.points[bent.attributes["weld"]].tobytes() == bent.points.tobytes()
    np.testing.assert_array_equal(bent.faces, cube.faces)


def test_an_edge_of_one_point_closes_a_quilt():
    """Four patches that meet in two poles, each with two edges of one point, enclose a solid."""
    controls, quilt = [(0, 0, -1.0), (0, 0, 1.0)], []
    ring = {}
    for quarter in range(4):
        patch = np.zeros((4, 4), int)
        patch[3] = 1
        for i in (1, 2):
            for j in range(4):
                key = (i, (quarter * 3 + j) % 12)
                if key not in ring:
                    ring[key] = len(controls)
                    angle = key[1] * math.tau / 12
                    controls.append((math.cos(angle), math.sin(angle), -0.5 if i == 1 else 0.5))
                patch[i, j] = ring[key]
        quilt.append(patch)
    ball = quilts.mesh(controls, quilt, segments=6)
    assert meshes.is_closed(ball)
    assert meshes.volume(ball) > 0
    assert from_mesh(ball).manifold.genus() == 0


def test_what_is_no_quilt_is_refused():
    """Indices that name no point, and shapes that are no patches."""
    controls, quilt = cushion()
    with pytest.raises(ShapeError, match="patches: expected indices from 0 to 9, got"):
        quilts.mesh(controls[:10], quilt)
    with pytest.raises(ShapeError, match="at least 0, got -1"):
        quilts.mesh(controls, quilt * 0 - 1)
    with pytest.raises(ShapeError, match=r"\(P, 4, 4\)"):
        quilts.mesh(controls, quilt[0])
    with pytest.raises(ShapeError, match="segments"):
        quilts.mesh(controls, quilt, segments=0)
    with pytest.raises(ShapeError, match="controls"):
        quilts.mesh(controls * math.inf, quilt)
