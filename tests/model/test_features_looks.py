"""The rows of the feature list about changes that move nothing: paint, textures, parameters, notes and messages."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import reactive4d as r4

t = r4.time
RED, BLUE = [1, 0, 0, 1], [0, 0, 1, 1]


def steps(points: dict[float, Any]) -> Any:
    """Keys that hold their values."""
    return r4.keys(points, interpolation="step")


# -- paint -------------------------------------------------------------------------------------------------------------


def test_colour() -> None:
    """F071: colour: a setting, and changes on top of it, in the order of the list; each may vary or be switched off."""
    ball = r4.Sphere(color="red")
    blue = ball.apply(r4.Color("blue", enabled=steps({0: 0, 2: 1, 4: 0})))
    assert [ball.paint.at(at).tolist() for at in (1, 2, 4)] == [RED, BLUE, RED]
    ball.apply(r4.Color(r4.keys({0: "red", 10: "blue"})))
    assert ball.paint.at(5)[[0, 2]].tolist() == pytest.approx([0.5, 0.5], abs=0.25)
    ball.changes.move(ball.changes[1], before=blue)
    assert ball.paint.at(3).tolist() == BLUE
    assert ball.color.at(3).tolist() == RED  # the setting itself is what it was


@pytest.mark.parametrize("value", ["red", "#ff0000", "#f00", (1, 0, 0), (1.0, 0.0, 0.0, 1.0), np.array([1, 0, 0])])
def test_colours_are_written_in_many_ways(value: Any) -> None:
    """F071: CSS names, hexadecimal codes, three or four numbers."""
    assert r4.Box(color=value).paint.at(0).tolist() == RED
    box = r4.Box()
    box.apply(r4.Color(value))
    assert box.paint.at(0).tolist() == RED


@given(st.floats(0, 1), st.floats(0, 1), st.floats(0, 1))
def test_transparency(setting: float, change: float, alpha: float) -> None:
    """F071: transparency: the setting's, the colour's and the last change's opacity multiply."""
    ball = r4.Sphere(color=(1, 0, 0, alpha), opacity=setting)
    assert ball.paint.at(0)[3] == pytest.approx(alpha * setting)
    ball.apply(r4.Opacity(0.123))
    ball.apply(r4.Opacity(change))
    assert ball.paint.at(0)[3] == pytest.approx(alpha * setting * change)
    assert r4.Scene(ball=ball).at(0)["ball"].opacity == pytest.approx(alpha * setting * change)


def test_shading_values() -> None:
    """F071: shading / reflectance model, bumpiness, and others dependent on the lighting model (`shade_val`)."""
    ball = r4.Sphere(color="red")
    ball.apply(r4.Shade(specular=0.5, shininess=20, bumpiness=0.1))
    ball.apply(r4.Shade(specular=r4.keys({0: 0.0, 2: 1.0}), roughness=0.3))
    look = ball.look.at(1)
    assert {name: look[name] for name in ("specular", "shininess", "bumpiness", "roughness")} == {
        "specular": 0.5,
        "shininess": 20,
        "bumpiness": 0.1,
        "roughness": 0.3,
    }
    assert "ambient" not in look  # what nobody gave is the renderer's choice
    ball.apply(r4.Shade(surface_color="blue"))
    assert ball.paint.at(0).tolist() == BLUE
    assert r4.Shade.script == "shade_val"


@pytest.mark.parametrize(
    ("name", "value"),
    [("specular", -0.1), ("metalness", 1.5), ("roughness", "rough"), ("shininess", float("nan")), ("surface_color", 7)],
)
def test_shading_values_have_ranges(name: str, value: Any) -> None:
    """F071: a shading value beyond its range is refused, by its name."""
    with pytest.raises(r4.ShapeError, match=rf"Shade\.{name}"):
        r4.Shade(**{name: value})


def test_a_users_own_lighting_model() -> None:
    """F071: others dependent on the lighting model: a user's change sets what its renderer understands."""

    class Glow(r4.Coloring):
        watts = r4.Float(low=0)

        @staticmethod
        def paint(color: Any, watts: float) -> dict[str, Any]:
            return {"emission": watts, "color": color * (0.5, 0.5, 0.5, 1)}

    ball = r4.Sphere(color="white")
    ball.apply(Glow(100 * t))
    assert ball.look.at(2)["emission"] == 200
    assert ball.paint.at(2).tolist() == [0.5, 0.5, 0.5, 1]


def test_textures() -> None:
    """F071: texture map: a picture by its path, laid on by coordinates from a plane, a cylinder or a sphere."""
    ball = r4.Sphere(1, segments=16, rings=8)
    ball.apply(r4.Texture("earth.png"))
    assert ball.look.at(0)["texture"] == "earth.png"
    own = ball.uv.at(0)
    mapping = ball.apply(r4.MapTexture("spherical"))
    uv, points = ball.uv.at(0), ball.points.at(0).astype(float)
    assert np.allclose(uv[:, 1], 0.5 + np.arcsin(np.clip(points[:, 2], -1, 1)) / np.pi, atol=1e-4)
    mapping.projection = "planar"
    uv = ball.uv.at(0)
    assert np.allclose(uv, points[:, :2] / 2 + 0.5, atol=1e-4)
    mapping.repeat, mapping.offset = (2, 3), (0.5, 0)
    assert np.allclose(ball.uv.at(0), uv * (2, 3) + (0.5, 0), atol=1e-4)
    mapping.axis = "x"
    assert ball.uv.at(0)[:, 1].max() == pytest.approx(3)
    mapping.enabled = False
    assert ball.uv.at(0) is own


def test_paint_does_not_touch_the_surface() -> None:
    """F071: paint is a channel of its own: a colour that moves leaves points, faces and texture coordinates alone."""
    box = r4.Box(color=r4.keys({0: "red", 5: "blue"}))
    before = box.mesh.at(0)
    box.apply(r4.Shade(specular=t))
    with r4.log() as events:
        assert all(box.mesh.at(at) is before for at in (0, 1, 2))
        box.look.at(1)
    assert {event.name.split(".")[1] for event in events if event.kind == "evaluated" and "." in event.name} <= {
        "color",
        "look",
        "paint",
        "(shade_val)",
        "values",
    }


# -- parameters --------------------------------------------------------------------------------------------------------


def test_set_parameter() -> None:
    """F072: `set_parameter` name-value parameters: those of the kind, and any others, constants, keys or references."""
    ball = r4.Sphere()
    ball.parameters["radius"] = 2.0
    ball.parameters["tolerance"] = 1e-6
    ball.parameters["coefficients"] = [1, [2, 3], "x²"]
    ball.parameters["friend"] = r4.Box()
    ball.parameters["heat"] = r4.keys({0: 0.0, 2: 10.0})
    assert ball.radius.at(0) == 2
    assert ball.parameters["tolerance"].at(0) == 1e-6
    assert ball.parameters["coefficients"].at(0) == (1, (2, 3), "x²")
    assert isinstance(ball.parameters["friend"].at(0), r4.Box)
    assert ball.parameters["heat"].at(1) == 5
    assert {"radius", "segments", "tolerance", "heat"} <= set(ball.parameters)
    del ball.parameters["radius"]
    assert ball.radius.at(0) == 0.5
    with pytest.raises(KeyError, match="tolerence"):
        ball.parameters["tolerence"]
    with pytest.raises(r4.ShapeError, match="is not a name"):
        ball.parameters["two words"] = 1


def test_a_parameter_waits_for_the_kind_that_knows_it() -> None:
    """F072, F007: superquadric exponents sent to a sphere are ignored until it becomes a superquadric, and after."""
    ball = r4.Sphere()
    ball.parameters["exponents"] = (0.2, 0.2)
    ball.apply(r4.Become(r4.Superquadric, enabled=steps({0: 0, 2: 1, 4: 0})))
    volumes = [ball.volume.at(at) for at in (1, 2, 4)]
    assert volumes[0] == volumes[2] == pytest.approx(r4.Sphere().volume.at(0))
    assert volumes[1] == pytest.approx(r4.Superquadric(exponents=(0.2, 0.2)).volume.at(0))
    copy = ball.extend()
    assert copy.volume.at(2) == volumes[1]
    copy.parameters["exponents"] = (1, 1)
    assert copy.volume.at(2) == pytest.approx(r4.Superquadric().volume.at(0))


# -- what is stored in the list ----------------------------------------------------------------------------------------


class Price(r4.Note):
    """What an object costs."""

    euros = r4.Float(low=0)

    @staticmethod
    def note(euros: float) -> dict[str, float]:
        """By its name."""
        return {"price": euros}


def test_notes_store_anything_in_the_list() -> None:
    """F076: change operators that merely **store arbitrary data in the state**: in order, inherited, for a while."""
    from reactive4d.model.notes import Store

    vase = r4.Cylinder()
    mesh = vase.mesh.at(0)
    vase.apply(Store(["made by", ("Euphronios", -510)]))
    price = vase.apply(Price(r4.keys({0: 10.0, 2: 30.0})))
    copy = vase.extend()
    copy.apply(Store(r4.Box))
    assert vase.notes.at(1) == (("made by", ("Euphronios", -510)), {"price": 20.0})
    assert copy.notes.at(0) == (*vase.notes.at(0), r4.Box)
    price.enabled = t < 1
    assert len(vase.notes.at(0.5)) == 2
    assert len(vase.notes.at(1)) == 1
    assert vase.mesh.at(0) is mesh  # whoever asks for the surface does not hear of notes


def test_a_note_may_refer_to_others() -> None:
    """F076: used for caches, dependency lists, references: what is stored may be alive."""
    from reactive4d.model.notes import Store

    fly, desk = r4.Sphere(), r4.Box()
    fly.translate(r4.vec(t, 0, 0))
    desk.apply(Store(fly.position))
    assert desk.notes.at(3)[0].tolist() == [3, 0, 0]
    assert r4.Object().notes.at(0) == ()


def test_messages_are_remembered_by_sender_and_receiver() -> None:
    """F077: message-passing: recipient gets a change; **sender gets a change remembering what it sent to whom**."""
    sun, flower = r4.Sphere(), r4.Cone()
    sun.translate(r4.vec(10 * r4.lift(np.cos)(t), 10 * r4.lift(np.sin)(t), 0))
    look = sun.send(r4.LookAt(sun.position, forward="z"), to=flower)
    assert list(flower.changes) == [look]
    assert sun.notes.at(0) == ((flower, look),)
    assert len(sun.changes) == 2
    for at in (0.0, 1.0):
        way = sun.position.at(at)
        assert np.allclose(flower.matrix.at(at)[:3, :3] @ (0, 0, 1), way / np.linalg.norm(way))
    # Who was sent something hears of the sender's edits.
    sun.changes[0].offset = (0, 5, 0)
    assert np.allclose(flower.matrix.at(0)[:3, :3] @ (0, 0, 1), (0, 1, 0))
    sun.withdraw(look)
    assert list(flower.changes) == []
    assert sun.notes.at(0) == ()
    assert np.array_equal(flower.matrix.at(0), np.eye(4))
    with pytest.raises(ValueError, match="was not sent"):
        sun.withdraw(look)


def test_a_message_that_cannot_be_delivered_leaves_no_trace() -> None:
    """F077: sending is one edit: either both lists have it or none."""
    sun = r4.Sphere()
    with pytest.raises(TypeError, match="expected a change"):
        sun.send("hello", to=r4.Box())  # type: ignore[type-var]
    with pytest.raises((r4.Reactive4dError, AttributeError)):
        sun.send(r4.Translate((1, 0, 0)), to="box")  # type: ignore[arg-type]
    assert list(sun.changes) == []
    assert sun.notes.at(0) == ()


# -- kinds and prototypes as changes -----------------------------------------------------------------------------------


def test_chrep_is_a_change() -> None:
    """F078: chrep as change operator: in the list, by name or class, edited, reordered and switched like others."""
    obj = r4.Object()
    first = obj.apply(r4.Become("sphere"))
    second = obj.apply(r4.Become(r4.Box, enabled=t >= 2))
    assert [obj.kind.at(at) for at in (0, 2)] == [r4.Sphere, r4.Box]
    assert r4.Become.script == "chrep"
    first.kind = steps({0: "torus", 1: r4.Cone})
    assert [obj.kind.at(at) for at in (0, 1, 2)] == [r4.Torus, r4.Cone, r4.Box]
    obj.changes.move(first, after=second)
    assert obj.kind.at(2) is r4.Cone
    with pytest.raises(r4.UnknownNameError, match="spere") as failed:
        obj.apply(r4.Become("spere"))
    assert "sphere" in "".join(failed.value.__notes__)
    assert len(obj.changes) == 2


def test_a_prototype_is_given_like_a_change() -> None:
    """F078: template/prototype: a value that is set, varies with time, and is taken away again."""
    small, large = r4.Box(1), r4.Sphere(2)
    obj = r4.Object()
    obj.translate((0, 0, 1))
    obj.prototype = steps({0: small, 2: large})
    assert [obj.kind.at(at) for at in (1, 2)] == [r4.Box, r4.Sphere]
    assert [round(obj.volume.at(at), 3) for at in (1, 2)] == [1, 33.510]
    assert obj.position.at(2).tolist() == [0, 0, 1]
    obj.prototype = None
    assert obj.kind.at(0) is r4.Object
