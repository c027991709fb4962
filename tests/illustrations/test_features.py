"""The rows of the feature list that illustrations reach, each shown with the public API."""

from typing import Any

import numpy as np
import param
import pytest

import reactive4d as r4
from reactive4d import devices
from reactive4d.illustrations import subject


class Workshop(r4.Illustration):
    """A lamp, a camera that watches a ball, and a dial for the wind."""

    wind = param.Number(0.0, bounds=(-1.0, 1.0), doc="from the left [m/s]")
    lamp = param.Selector(objects=["ambient", "directional", "point", "spot"], default="point")
    glow = param.Color("#ffeecc")
    watches = param.Boolean(True)

    def build(self) -> r4.Scene:
        """The ball drifts with the wind and falls; a weather cock and a speed arrow tell of it."""
        p = self.signals
        ball = r4.Sphere(0.2, color="crimson")
        ball.translate(r4.vec(p.wind * r4.time, 0.0, r4.keys({0: 3.0, 2: 0.2}, ease="in")))
        speed = r4.Arrow(ball.position, ball.position + ball.velocity, color="teal")
        lamp = r4.Light(p.lamp, color=p.glow, intensity=r4.keys({0: 1.0, 2: 2.0}))
        lamp.translate((0, 0, 4))
        camera = r4.Camera((0, -8, 2), r4.where(p.watches, ball.position, (0.0, 0.0, 1.0)), fov=30)
        scene = r4.Scene(ball=ball, speed=speed, lamp=lamp, camera=camera)
        scene.signals["height"] = ball.position[2]
        scene.handle(ball, x=p.wind)
        return scene


def test_a_reader_changes_parameters_of_a_running_model():
    """
    F002: interactive illustration: reader changes parameters of a running model (not a canned movie); model is
    independent of the tools used to interact with it.
    """
    reader = Workshop()
    seen = []
    for t in (0.0, 1.0, 2.0):
        reader.wind += 0.25  # between two pictures
        seen.append(reader.at(t)["ball"].matrix[0, 3])
    assert seen == [0.0, 0.5, 1.5]
    # Backwards, at any other value, and by another tool: a link instead of an assignment.
    reader.point = r4.Bookmark.from_link("wind=-1", reader)
    assert reader.at(1.5)["ball"].matrix[0, 3] == -1.5
    assert reader.scene is Workshop().scene
    assert Workshop().at(1.5)["ball"].matrix[0, 3] == 0.0


def test_an_object_offers_what_a_reader_may_do_with_it():
    """
    F016: "interaction is a property of each object": each object offers a UI for its special information (sliders for
    initial conditions); here the parameters as controls, and handles on objects.
    """
    about = subject(Workshop)
    told = {control.name: control.description() for control in about.controls}
    assert [told[name]["kind"] for name in ("wind", "lamp", "glow", "watches")] == [
        "number",
        "select",
        "color",
        "boolean",
    ]
    wind = told["wind"]
    assert (wind["bounds"], wind["unit"], wind["doc"], wind["default"]) == ([-1.0, 1.0], "m/s", "from the left", 0.0)
    assert told["lamp"]["options"] == ["ambient", "directional", "point", "spot"]
    assert [handle["node"] for handle in about.handles] == ["ball"]
    assert about.handles[0]["parameters"] == ["wind"]


def test_any_object_of_an_illustration_can_be_asked_for_any_quantity_at_any_time():
    """
    F018: inquiry protocol: ask any object for any quantity at any time t (random access) or serially as a movie:
    position, CTM, boundary representation, colour, velocity, bounding box, parameters; at a reader's point.
    """
    ball = Workshop().scene["ball"]
    for t in (1.5, 0.5, 1.0):
        assert ball.position.at(t, wind=0.5)[0] == 0.5 * t
        assert ball.velocity.at(t, wind=0.5)[0] == pytest.approx(0.5)
        assert np.allclose(ball.matrix.at(t, wind=0.5)[:3, 3], ball.position.at(t, wind=0.5))
        assert np.allclose(ball.bounds.at(t, wind=0.5).mean(axis=0), ball.position.at(t, wind=0.5), atol=1e-5)
    movie = ball.position.at(np.linspace(0, 2, 21), wind=1.0)
    assert np.allclose(movie[:, 0], np.linspace(0, 2, 21))
    assert ball.volume.at(1.0, wind=0.5) == pytest.approx(4 / 3 * np.pi * 0.2**3)
    assert ball.surface.valid(0.0, wind=0.5) == r4.FOREVER
    assert Workshop().scene.signals["height"].at(0.0) == 3.0


def test_a_camera_of_an_illustration_tracks_what_a_reader_moves():
    """F050: camera as object (position, look-at by reference; tracks another object)."""
    reader = Workshop(wind=1.0)
    for t in (0.0, 1.0, 2.0):
        frame = reader.at(t)
        assert frame["camera"].primitive == "camera"
        gaze = -frame["camera"].matrix[:3, 2]
        way = frame["ball"].matrix[:3, 3] - frame["camera"].matrix[:3, 3]
        assert np.allclose(gaze, way / np.linalg.norm(way))
    assert np.allclose(reader.at(2.0)["camera"].drawn["target"], (2.0, 0.0, 0.2))
    reader.watches = False
    assert reader.at(2.0)["camera"].drawn["target"].tolist() == [0.0, 0.0, 1.0]


@pytest.mark.parametrize("kind", ["ambient", "directional", "point", "spot"])
def test_a_reader_chooses_the_light(kind: str):
    """F051: lights as objects: ambient, directional ("light_type", "directional"), distant, point, spot."""
    node = Workshop(lamp=kind, glow="yellow").at(1.0)["lamp"]
    assert (node.primitive, node.drawn["light_type"], node.drawn["intensity"]) == ("light", kind, 1.5)
    assert node.color.tolist() == [1.0, 1.0, 0.0, 1.0]
    assert node.matrix[:3, 3].tolist() == [0.0, 0.0, 4.0]


def test_the_profile_tells_what_readers_save_each_other():
    """F109: instrumentation: profile showing time saved vs memory; here of what many readers of one model ask."""
    ball = Workshop().scene["ball"]
    readers = [Workshop(wind=0.5) for _ in range(20)]
    with r4.log() as events:
        for reader in readers:
            reader.at(1.25)
    evaluated = [event for event in events if event.kind == "evaluated"]
    assert len([event for event in evaluated if event.name == "scene"]) == 1
    profile = r4.stats(ball.surface)["cells"][ball.surface.name]
    assert profile["evaluations"] == 1
    assert profile["bytes"] > 0
    assert profile["seconds"] >= 0


def test_devices_are_exchanged_without_touching_the_scene():
    """
    F161: rendering layer of interchangeable virtual rendering devices, exchangeable at run time without touching the
    application.
    """

    def counting(thing: Any, path: str, *, t: float = 0.0, **parameters: Any) -> dict[str, str]:
        """A device that writes down as what each object would be drawn."""
        about = subject(thing)
        frame = about.scene.at(t, **{**about.values, **parameters})
        return {name: node.primitive for name, node in frame.items() if node.visible}

    def outlining(thing: Any, path: str, **options: Any) -> list[list[float]]:
        """Another one, which wants boxes alone."""
        return [
            obj.bounds.at(0.0).ravel().tolist() for obj in subject(thing).scene.values() if isinstance(obj, r4.Sphere)
        ]

    reader = Workshop()
    stamps = r4.stats()["evaluations"], reader.scene["ball"].position.valid(0.0)
    before = devices.exchange("render", counting)
    try:
        assert reader.render("a.png", t=1.0, wind=0.5) == {
            "ball": "mesh",
            "speed": "mesh",
            "lamp": "light",
            "camera": "camera",
        }
        devices.exchange("render", outlining)
        assert reader.render("a.png") == [pytest.approx([-0.2, -0.2, 2.8, 0.2, 0.2, 3.2])]
        assert reader.scene.render("a.png") == reader.render("a.png")
    finally:
        devices.exchange("render", before)
    assert stamps[1] == reader.scene["ball"].position.valid(0.0)
    assert devices.device("render") is not outlining


def test_what_a_model_controller_makes_is_made():
    """
    F232: model controller: owns roots, time runs, external events, redraw management; default camera, controller and
    pool made by the framework. Whoever describes a model says nothing of these, and gets them.
    """

    class Bare(r4.Illustration):
        size = param.Number(1.0, bounds=(0, 3))

        def build(self) -> r4.Scene:
            return r4.Scene(ball=r4.Sphere(self.signals.size * r4.keys({0: 0.5, 4: 1.0})))

    about = subject(Bare)
    assert list(about.scene) == ["ball"]  # the roots, owned by the class
    assert about.times == (0.0, 4.0)  # over which time runs
    assert about.point.to_link() == "t=0&size=1"  # where it begins, for every reader
    assert about.point.camera is None  # a viewer's default, until a reader looks elsewhere
    # A redraw is due where an answer no longer holds: at no other time has a viewer to ask.
    frame = about.scene.frame
    assert frame.valid(1.0).is_instant
    assert frame.valid(5.0).stop == np.inf
    with r4.log() as events:
        about.scene.at(7.0)
        about.scene.at(9.0)
    assert sum(event.kind == "evaluated" and event.name == "scene" for event in events) <= 1


def test_the_representation_depends_on_the_request():
    """
    F268: request kinds: bounding box, wireframe, lit wireframe, facets, smooth + highlights; representation depends on
    the request: each asks for the channels that it needs, and only these are evaluated.
    """

    class Bar(r4.Illustration):
        bend = param.Number(30.0)

        def build(self) -> r4.Scene:
            bar = r4.Box(size=(0.2, 0.2, 2), segments=(1, 1, 8), color="tan")
            bar.name = "bar"
            bar.apply(r4.Bend(self.signals.bend))
            bar.apply(r4.Shade(specular=0.8, shininess=40))
            return r4.Scene(bar=bar)

    bar = Bar().scene["bar"]
    wanted: dict[str, tuple[Any, set[str]]] = {
        "bounding box": (bar.bounds, {"points"}),
        "wireframe": (r4.lift(lambda points, faces: points[faces])(bar.points, bar.topology), {"points", "faces"}),
        "facets": (r4.lift(lambda mesh, paint: (mesh, paint))(bar.mesh, bar.paint), {"points", "faces", "uv", "weld"}),
        "smooth and highlights": (r4.lift(lambda n, look: n * look["specular"])(bar.normals, bar.look), {"points"}),
    }
    for i, (request, (signal, parts)) in enumerate(wanted.items()):
        with r4.log() as events:
            signal.at(0.0, bend=30.0 + i)
        evaluated = {event.name.rpartition(".")[2] for event in events if event.kind == "evaluated"}
        made = evaluated & {"points", "faces", "uv", "weld"}
        assert made <= parts | {"points"}, request
