"""Channels: what is computed for an answer, what is shared, and what is not touched at all."""

import math
from typing import Any

import numpy as np
import pytest

import reactive4d as r4


def evaluated(events: Any, part: str = "") -> list[str]:
    """What was computed, by name."""
    return sorted(event.name for event in events if event.kind == "evaluated" and part in event.name)


def test_any_quantity_at_any_time() -> None:
    """
    F018: position, CTM, boundary representation, UV map, tangent, colour, normals, ray intersection, velocity,
    acceleration, bounding box, parameters: at any time, or serially as a movie.
    """
    ball = r4.Sphere(radius=0.5, color=r4.keys({0: "red", 4: "blue"}))
    ball.translate(r4.vec(r4.time, r4.time**2, 0))
    for t in (3.0, -1.0, 0.0, 2.5):
        assert np.allclose(ball.position.at(t), [t, t * t, 0])
        assert np.allclose(ball.matrix.at(t)[:3, 3], [t, t * t, 0])
        assert np.allclose(ball.velocity.at(t), [1, 2 * t, 0])
        assert np.allclose(ball.acceleration.at(t), [0, 2, 0])
        assert np.allclose(ball.bounds.at(t), np.array([[-0.5] * 3, [0.5] * 3]) + [t, t * t, 0], atol=1e-6)
        mesh = ball.mesh.at(t)
        assert mesh.points.shape == ball.normals.at(t).shape
        assert mesh.faces.shape[1] == 3
        assert mesh.attributes["uv"].shape == (len(mesh.points), 2)
        assert np.allclose(ball.intersect([(t, t * t, 9)], [(0, 0, -1)]).at(t).distance, 8.5)
        assert ball.contains([(t, t * t, 0.4), (t + 1, t * t, 0)]).at(t).tolist() == [True, False]
        assert np.allclose(ball.center_of_mass.at(t), [t, t * t, 0])
        assert ball.radius.at(t) == 0.5
    assert np.allclose(ball.position.at(np.arange(5.0))[:, 1], np.arange(5.0) ** 2)
    path = r4.Path([(0, 0, 0), (1, 0, 0), (2, 0, 0)])
    assert np.allclose(path.tangent_along(0.3).at(0), [1, 0, 0])


def test_other_inquiries_than_pictures_are_possible() -> None:
    """F017: the model is abstract: a kind may answer how something sounds, at any time and from the same memo."""

    class Bell(r4.Object):
        pitch = r4.Float(440.0)

        @property
        def sound(self) -> Any:
            return self.channel("sound", lambda bell: np.sin(bell.pitch.now() * np.linspace(0, 1, 8)))

    bell = Bell(pitch=r4.keys({0: 440, 1: 880}, interpolation="step"))
    first = bell.sound.at(0)
    assert bell.sound.at(0.5) is first
    assert bell.sound.at(2)[1] != first[1]
    bell.pitch = 100
    assert np.allclose(bell.sound.at(0), np.sin(100 * np.linspace(0, 1, 8)))


def test_a_static_deformed_mesh_that_only_moves_is_never_deformed_again() -> None:
    """F103: the points are in object space, the movement is a matrix: thirty frames deform once."""
    bar = r4.Box(size=(0.2, 0.2, 2), segments=(2, 2, 16))
    bar.name = "bar"
    bar.apply(r4.Bend(60))
    bar.apply(r4.Twist(30))
    bar.translate(r4.vec(r4.time, 0, 0))
    with r4.log() as events:
        surfaces = {id(bar.surface.at(frame / 30)) for frame in range(30)}
        matrices = [bar.matrix.at(frame / 30) for frame in range(30)]
    assert len(surfaces) == 1
    assert len(evaluated(events, "bar.bend.points")) == len(evaluated(events, "bar.twist.points")) == 1
    assert len(evaluated(events, "bar.surface")) == 1
    assert matrices[15][0, 3] == 0.5
    assert bar.points.valid(0) == bar.topology.valid(0) == r4.FOREVER


@pytest.mark.parametrize("change", [r4.Translate((1, 0, 0)), r4.Rotate(30), r4.Scale(2), r4.Mirror("x")])
def test_a_transform_does_not_touch_the_mesh_in_object_space(change: Any) -> None:
    """F103, F092: a b-rep cache is not invalidated, provided that a transformation matrix is applied separately."""
    ball = r4.Sphere(segments=8, rings=4)
    ball.name = "ball"
    ball.translate(r4.vec(r4.time, 0, 0))
    surface = ball.surface.at(0)
    with r4.log() as events:
        ball.apply(change)
        assert ball.surface.at(0) is surface
        ball.matrix.at(0)
    assert not [event for event in events if event.name in ("ball.surface", "ball.points") and event.kind != "reused"]
    assert evaluated(events, "ball.matrix") == ["ball.matrix"]


def test_four_tyres_share_one_surface() -> None:
    """F106: intra-frame coherence: four tyres, alike up to transforms, share one spline surface, evaluated once."""
    profile = r4.Path([(0.25, 0, -0.1), (0.4, 0, -0.1), (0.4, 0, 0.1), (0.25, 0, 0.1)], closed=True)
    tyre = r4.Revolution(profile, closed=True)
    tyre.name = "tyre"
    car = r4.Group()
    tyres = {f"tyre{i}": tyre.extend() for i in range(4)}
    for i, (name, one) in enumerate(tyres.items()):
        one.name = name
        one.rotate(90, axis="x")
        one.translate((2 * (i % 2), i // 2, 0))
    car.members = tyres
    car.translate(r4.vec(r4.time, 0, 0))
    scene = r4.Scene(car=car)
    with r4.log() as events:
        frames = [scene.at(frame / 25) for frame in range(10)]
    assert evaluated(events, "tyre.surface") == ["tyre.surface"]
    assert len([name for name in evaluated(events) if name.endswith(".surface") and name != "tyre.surface"]) == 4
    drawn = [frame[f"car/tyre{i}"].drawn for frame in frames for i in range(4)]
    assert len({id(mesh.points) for mesh in drawn}) == len({id(mesh.faces) for mesh in drawn}) == 1
    assert [frames[5][f"car/tyre{i}"].matrix[0, 3] for i in range(4)] == pytest.approx([0.2, 2.2, 0.2, 2.2])
    # Inter-frame: a new profile is turned once more, for all four.
    tyre.segments = 12
    with r4.log() as events:
        scene.at(0.2)
        scene.at(0.24)
    assert evaluated(events, "tyre.surface") == ["tyre.surface"]


def test_only_the_channels_that_are_asked_for_are_evaluated() -> None:
    """F110, F268: only what the request needs: a bounding box needs no uv and no normals, a matrix no points."""
    bar = r4.Box(size=(0.2, 0.2, 2), segments=(1, 1, 4))
    bar.name = "bar"
    bar.apply(r4.Bend(30))
    bar.apply(r4.MapTexture("planar"))
    bar.apply(r4.Color("red"))
    bar.translate((1, 0, 0))
    needs = {
        "paint": set(), "kind": set(), "matrix": set(), "topology": {"bar.faces"}, "bounds": {"bar.points"},
        "uv": {"bar.points"}, "mesh": {"bar.points", "bar.faces", "bar.uv"},
    }  # fmt: skip
    seen: set[str] = set()
    for name, wanted in needs.items():
        with r4.log() as events:
            getattr(bar, name).at(0)
        seen |= set(evaluated(events))
        parts = {"bar.points", "bar.faces", "bar.uv", "bar.paint", "bar.normals"}
        assert seen & parts >= wanted & parts - {"bar.uv"}
        if name in ("paint", "kind", "matrix"):
            assert not seen & {"bar.points", "bar.faces", "bar.bend.points", "bar.weld"}
        if name == "topology":
            assert not seen & {"bar.points", "bar.bend.points"}
        if name == "bounds":
            assert not seen & {"bar.uv", "bar.normals"}


def test_each_channel_has_its_own_validity() -> None:
    """F111: validity per element and per channel; the result's is the intersection along the list."""
    ball = r4.Sphere(
        radius=r4.keys({0: 1, 10: 2}, interpolation="step"), color=r4.keys({0: "red", 4: "blue"}, interpolation="step")
    )
    ball.scale(r4.keys({0: 1.0, 6: 2.0}, interpolation="step"))
    ball.translate(r4.keys({0: (0, 0, 0), 2: (1, 0, 0)}, interpolation="step"))
    names = ("topology", "points", "matrix", "paint", "mesh", "kind")
    spans = {name: getattr(ball, name).valid(1) for name in names}
    found = {name: (span.start, span.stop) for name, span in spans.items()}
    inf = math.inf
    assert found == {
        "topology": (-inf, inf), "points": (-inf, 10), "matrix": (-inf, 2), "paint": (-inf, 4), "mesh": (-inf, 2),
        "kind": (-inf, inf),
    }  # fmt: skip


def test_asking_again_with_nothing_changed_evaluates_nothing() -> None:
    """F114: the cached representation is returned without evaluating anything; the very same object."""
    bar = r4.Box(size=(0.2, 0.2, 2), segments=(1, 1, 4))
    bar.apply(r4.Twist(r4.keys({0: 0, 1: 90})))
    bar.translate((1, 0, 0))
    channels = ("mesh", "bounds", "normals", "volume", "methods", "paint", "look")
    first = [getattr(bar, name).at(0.5) for name in channels]
    with r4.log() as events:
        again = [getattr(bar, name).at(0.5) for name in channels]
    assert all(a is b for a, b in zip(first, again, strict=True))
    assert {event.kind for event in events} == {"reused"}


def test_an_answer_that_is_the_same_stops_there() -> None:
    """A change whose edit makes no difference is computed, and nobody after it."""
    ball = r4.Sphere()
    ball.name = "ball"
    turn = ball.rotate(30)
    ball.mesh.at(0)
    with r4.log() as events:
        turn.angle = 390 - 360 + 0.0
        ball.mesh.at(0)
    assert evaluated(events) == []
    level = ball.translate(r4.lift(lambda v: (0.0, 0.0, max(v, 0.0)))(v := r4.Variable(-1.0)))
    assert level.enabled.at(0) is True
    ball.mesh.at(0)
    with r4.log() as events:
        v.value = -2.0
        ball.mesh.at(0)
    assert not [name for name in evaluated(events) if name in ("ball.mesh", "ball.matrix")]


def test_arrays_that_leave_an_object_cannot_be_changed() -> None:
    """Arrays leaving a cell are frozen; what one hands in is copied."""
    offset = np.array([1.0, 0.0, 0.0])
    ball = r4.Sphere(segments=6, rings=3)
    ball.translate(offset)
    offset[0] = 5
    assert ball.position.at(0).tolist() == [1, 0, 0]
    for name in ("position", "matrix", "points", "topology", "uv", "bounds", "normals", "paint"):
        array = getattr(ball, name).at(0)
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 7
    assert ball.points.at(0).dtype == ball.uv.at(0).dtype == ball.normals.at(0).dtype == np.float32
    assert ball.topology.at(0).dtype == np.int32
    assert ball.points.at(0).flags.c_contiguous
    mesh = ball.mesh.at(0)
    with pytest.raises((AttributeError, TypeError)):
        mesh.points = mesh.points


def test_channels_are_read_only() -> None:
    """What one asks cannot be set."""
    ball = r4.Sphere()
    for name in ("position", "matrix", "mesh", "volume", "kind", "paint", "points"):
        with pytest.raises(AttributeError):
            setattr(ball, name, getattr(ball, name))


def test_the_position_is_carried_through_deformations_and_the_matrix_begins_after_them() -> None:
    """
    `matrix` is the product of the transforms after the last deformation; `position` is the origin carried through the
    whole list; `points` lie between the two, and `mesh` puts them together.
    """
    bar = r4.Box(size=(0.1, 0.1, 2), segments=(1, 1, 16))
    bar.translate((0, 0, 1))
    bar.apply(r4.Bend(90, center=(0, 0, 0), lower=0, upper=2))
    bar.rotate(90, axis="z")
    assert np.allclose(bar.matrix.at(0)[:3, 3], 0)
    radius = 2 / (math.pi / 2)
    turned = [0, radius * (1 - math.cos(math.pi / 4)), radius * math.sin(math.pi / 4)]
    assert np.allclose(bar.position.at(0), turned, atol=1e-6)
    points, matrix = bar.points.at(0), bar.matrix.at(0)
    assert np.allclose(bar.mesh.at(0).points, points @ matrix[:3, :3].T + matrix[:3, 3], atol=1e-6)
    assert np.allclose(bar.center_of_mass.at(0)[0], 0, atol=1e-6)


def test_a_reader_s_parameter_reaches_every_channel() -> None:
    """F002: the reader changes parameters of a running model; answers for several readers stand side by side."""
    share = r4.Parameter("channels_share", 0.5, bounds=(0.0, 1.0))
    ball = r4.Sphere(radius=1 + share)
    ball.translate(r4.vec(10 * share, 0, 0), enabled=share > 0.2)
    for value in (0.0, 1.0, 0.0, 0.5):
        assert ball.position.at(0, channels_share=value)[0] == (10 * value if value > 0.2 else 0)
        assert ball.volume.at(0, channels_share=value) == pytest.approx(4 / 3 * math.pi * (1 + value) ** 3)
    assert ball.position.at(0)[0] == 5
    ball.mesh.at(0, channels_share=1.0)
    with r4.log() as events:
        ball.mesh.at(3, channels_share=1.0)
    assert evaluated(events) == []
    with pytest.raises(r4.ParameterError):
        ball.position.at(0, channels_share=2.0)
