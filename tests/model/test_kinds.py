"""Kinds: what an object is, also for a while only, and what it can be asked for because of that."""

import math
from typing import Any

import numpy as np
import pytest

import reactive4d as r4

ANALYTIC = {
    "sphere": (r4.Sphere, "spheres.intersect of Sphere"),
    "box": (r4.Box, "boxes.intersect of Box"),
    "cylinder": (r4.Cylinder, "cylinders.intersect of Cylinder"),
    "cone": (r4.Cone, "cones.intersect of Cone"),
    "torus": (r4.Torus, "tori.intersect of Torus"),
    "plane": (r4.Plane, "planes.intersect of Plane"),
}
DOWN = ([(0.4, 0.02, 5.0)], [(0.0, 0.0, -1.0)])


def steps(points: dict[float, Any]) -> Any:
    """Keys that hold their values."""
    return r4.keys(points, interpolation="step")


# -- become ------------------------------------------------------------------------------------------------------------


def test_the_sphere_that_turns_into_a_torus_at_two_seconds_and_back() -> None:
    """F006: a chrep assigns the class; several times, at different times: sphere -> torus over time, with one list."""
    ball = r4.Sphere(radius=1)
    ball.translate(r4.vec(r4.time, 0, 0))
    ball.apply(r4.Become(r4.Torus, enabled=steps({0: 0, 2: 1, 4: 0})))
    assert [ball.kind.at(t).__name__ for t in (0, 1.999, 2, 3.999, 4)] == [
        "Sphere",
        "Sphere",
        "Torus",
        "Torus",
        "Sphere",
    ]
    assert ball.volume.at(1) == pytest.approx(4 / 3 * math.pi)
    assert ball.volume.at(3) == pytest.approx(
        2 * math.pi**2 * 1 * 0.2**2
    )  # the radius is kept, the tube's is a default
    assert ball.position.at(3).tolist() == [3, 0, 0]
    assert (ball.topology.valid(3).start, ball.topology.valid(3).stop) == (2, 4)
    assert ball.topology.at(1) is ball.topology.at(0)
    assert ball.methods.at(3)["intersect"] == "tori.intersect of Torus"
    assert ball.methods.at(5)["intersect"] == "spheres.intersect of Sphere"


def test_the_last_become_that_acts_counts_wherever_it_stands() -> None:
    """Other changes act on what the kind makes, whether they stand before or after."""
    first, second = r4.Object(), r4.Object()
    first.apply(r4.Become("box"))
    first.scale(2)
    second.scale(2)
    second.apply(r4.Become("box"))
    assert first.volume.at(0) == pytest.approx(second.volume.at(0)) == pytest.approx(8)
    late = second.apply(r4.Become(r4.Sphere))
    assert second.kind.at(0) is r4.Sphere
    late.enabled = False
    assert second.kind.at(0) is r4.Box
    late.kind = "cone"
    late.enabled = True
    assert second.kind.at(0) is r4.Cone
    late.kind = r4.keys({0: r4.Sphere, 1: r4.Torus}, kind="held")
    assert [second.kind.at(t) for t in (0, 1)] == [r4.Sphere, r4.Torus]


def test_parameters_that_a_kind_does_not_know_are_kept_and_ignored() -> None:
    """F007, F072: unknown named parameters are kept and ignored; kinds give defaults for those that are absent."""
    ball = r4.Sphere(radius=1)
    ball.parameters["tube"] = 0.5
    ball.parameters["light_type"] = "spot"
    ball.parameters["tolerance"] = 1e-6
    before = ball.mesh.at(0)
    assert ball.volume.at(0) == pytest.approx(4 / 3 * math.pi)
    ring = ball.apply(r4.Become(r4.Torus))
    assert ball.volume.at(0) == pytest.approx(2 * math.pi**2 * 0.5**2)
    ball.parameters["tube"] = r4.keys({0: 0.5, 2: 0.25})
    assert ball.volume.at(2) == pytest.approx(2 * math.pi**2 * 0.25**2)
    ring.enabled = False
    assert ball.mesh.at(0) is before
    assert {"tube", "light_type", "tolerance", "radius"} <= set(ball.parameters)
    del ball.parameters["tube"]
    assert "tube" not in ball.parameters
    ring.enabled = True
    assert ball.volume.at(0) == pytest.approx(2 * math.pi**2 * 0.2**2)


def test_a_parameter_that_another_kind_cannot_take_is_an_error_that_says_so() -> None:
    """What a kind knows by that name and cannot use is not ignored: the answer says what is wrong."""
    ball = r4.Sphere()
    ball.parameters["tube"] = "thick"
    assert ball.volume.at(0) > 0
    ball.apply(r4.Become(r4.Torus))
    with pytest.raises(r4.ShapeError, match=r"Torus\.tube: expected a number"):
        ball.volume.at(0)
    ball.parameters["tube"] = 0.1
    assert ball.volume.at(0) == pytest.approx(2 * math.pi**2 * 0.5 * 0.1**2)


def test_the_same_rotate_turns_a_solid_and_the_text_on_the_screen() -> None:
    """
    F008: the receiver decides the semantics: the same `rotate` on a cube rotates the solid, on *screen-aligned text* it
    rotates the text projected onto the screen plane.
    """
    turn = r4.Rotate(90, axis="x")
    cube, label = r4.Box(), r4.Label("north", at=(0, 1, 0))
    cube.translate((0, 1, 0))
    cube.apply(turn)
    label.apply(turn)
    assert np.allclose(cube.matrix.at(0)[:3, :3], [[1, 0, 0], [0, 0, -1], [0, 1, 0]])
    assert np.allclose(label.matrix.at(0)[:3, :3], [[0, -1, 0], [1, 0, 0], [0, 0, 1]])  # about the line of sight
    assert np.allclose(cube.position.at(0), label.position.at(0))
    # The class decides, late: the cube that becomes a label is turned as labels are.
    cube.apply(r4.Become(r4.Label, enabled=r4.time >= 1))
    assert np.allclose(cube.matrix.at(2)[:3, :3], label.matrix.at(0)[:3, :3])
    assert np.allclose(cube.matrix.at(0)[:3, :3], [[1, 0, 0], [0, 0, -1], [0, 1, 0]])


# -- methods -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ANALYTIC)
def test_an_undeformed_primitive_meets_rays_in_closed_form(name: str) -> None:
    """F014: rays, volumes and the like come from the kind's methods while nothing but transforms act."""
    kind, method = ANALYTIC[name]
    thing = kind()
    assert thing.methods.at(0)["intersect"] == method
    thing.translate((0, 0, 1))
    thing.scale((1.2, 1.0, 2.0))
    with r4.log() as events:
        hits = thing.intersect(*DOWN).at(0)
    assert np.isfinite(hits.distance).all()
    assert not [e for e in events if e.kind == "evaluated" and e.name.endswith((".points", ".mesh", ".topology"))]
    mesh = r4.Model(thing.mesh.at(0)).intersect(*DOWN).at(0)
    assert abs(mesh.distance[0] - hits.distance[0]) < 0.05


@pytest.mark.parametrize("name", ANALYTIC)
def test_a_bend_makes_a_mesh_of_it_for_rays_and_taking_it_away_brings_the_method_back(name: str) -> None:
    """
    F013: a bent sphere stops using the analytic ray intersection and uses polygon intersection; earlier inheritance is
    not lost: removing the bend restores the analytic method. `obj.methods` tells, and who put it there.
    """
    kind, method = ANALYTIC[name]
    thing = kind()
    thing.name = "thing"
    before = thing.intersect(*DOWN).at(0)
    bend = thing.apply(r4.Bend(30, axis="x"))
    table = thing.methods.at(0)
    assert table["intersect"] == "mesh by bend of thing"
    assert table["volume"] == "mesh by bend of thing"
    assert table["faces"].endswith(f"of {kind.__name__}")
    bend.enabled = steps({0: 0, 2: 1})
    assert [thing.methods.at(t)["intersect"] for t in (0, 2)] == [method, "mesh by bend of thing"]
    thing.changes.remove(bend)
    assert thing.methods.at(0)["intersect"] == method
    after = thing.intersect(*DOWN).at(0)
    assert after.distance.tobytes() == before.distance.tobytes()
    assert after.normal.tobytes() == before.normal.tobytes()


def test_a_transform_keeps_the_methods_and_a_colour_too() -> None:
    """Reinheritance: only what changes the shape replaces methods."""
    ball = r4.Sphere()
    before = dict(ball.methods.at(0))
    ball.translate((1, 2, 3))
    ball.scale((1, 2, 3))
    ball.apply(r4.Color("red"))
    ball.apply(r4.MapTexture("spherical"))
    assert dict(ball.methods.at(0)) == before


def test_rays_and_points_are_refused_where_they_cannot_be_meant() -> None:
    """At the border: not (N, 3), not finite, of different number, without a direction."""
    ball = r4.Sphere()
    for origins, directions in (
        ([(0, 0)], [(0, 0, 1)]), ([(0, 0, 0)], [(0, 0, math.nan)]), ([(0, 0, 0)] * 2, [(0, 0, 1)]),
        ([(0, 0, 0)], [(0, 0, 0)]), ("here", [(0, 0, 1)]), ([(0, 0, math.inf)], [(0, 0, 1)]),
    ):  # fmt: skip
        with pytest.raises(r4.ShapeError):
            ball.intersect(origins, directions)
    with pytest.raises(r4.ShapeError):
        ball.contains([(0, 0)])
    assert ball.contains([(0, 0, 0), (0, 0, 0.6)]).at(0).tolist() == [True, False]


# -- a user's own ------------------------------------------------------------------------------------------------------


class Roof(r4.Object):
    """A user's own kind, in a dozen lines: what it gives is what differs."""

    width = r4.Float(2.0, low=0.0, unit="m")
    height = r4.Float(1.0, low=0.0, unit="m")

    table = r4.Table(
        points=lambda width, height: [
            (-width / 2, y, 0) for y in (-1, 1)
        ] + [(width / 2, y, 0) for y in (-1, 1)] + [(0, y, height) for y in (-1, 1)],
        faces=lambda: [(0, 1, 3), (0, 3, 2), (0, 2, 4), (1, 5, 3), (0, 4, 5), (0, 5, 1), (2, 3, 5), (2, 5, 4)],
        volume=lambda width, height: width * height,
    )  # fmt: skip


class Hop(r4.Transform):
    """A user's own transform."""

    height = r4.Float(unit="m")

    @staticmethod
    def matrix(height: float) -> Any:
        return [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, height], [0, 0, 0, 1]]


class Squash(r4.Deformation):
    """A user's own deformation."""

    share = r4.Float(0.5, low=0.0)

    @staticmethod
    def deform(share: float, points: Any, position: Any) -> Any:
        return (points - position) * (1, 1, share) + position


class Striped(r4.Coloring):
    """A user's own colouring."""

    @staticmethod
    def paint(color: Any) -> dict[str, Any]:
        return {"color": color * (0.5, 0.5, 0.5, 1.0), "stripes": 7}


def test_a_kind_of_ones_own_works_everywhere_ours_do() -> None:
    """F014, F270: a new class is added by supplying only what differs, and is the equal of ours."""
    roof = Roof(width=4, height=r4.keys({0: 1, 2: 3}))
    roof.name = "roof"
    assert roof.volume.at(0) == 4
    assert roof.volume.at(2) == 12
    assert roof.bounds.at(2)[1].tolist() == [2, 1, 3]
    assert roof.topology.valid(1) == r4.FOREVER
    assert r4.Model(roof.mesh.at(2)).volume.at(0) == pytest.approx(12)
    copy = roof.extend()
    copy.translate((0, 0, 5))
    assert copy.points.at(1) is roof.points.at(1)
    bend = copy.apply(r4.Bend(20))
    assert copy.methods.at(0)["volume"] == "mesh by bend of roof"
    copy.changes.remove(bend)
    ball = r4.Sphere()
    ball.apply(r4.Become(Roof))
    ball.parameters["width"] = 6
    assert ball.volume.at(0) == 6
    ball.changes[0].kind = "roof"
    assert ball.kind.at(0) is Roof
    assert roof.intersect([(0, 0, 9)], [(0, 0, -1)]).at(0).distance.tolist() == pytest.approx([8])
    assert (roof - r4.Box()).volume.at(0) == pytest.approx(3.5, abs=0.1)
    assert r4.Scene(roof=roof).at(0)["roof"].kind == "roof"
    assert "width" in roof.parameters
    with pytest.raises(r4.ShapeError, match=r"Roof\.width"):
        roof.width = -1
    with pytest.raises(r4.UnknownNameError, match="widht"):
        Roof(widht=3)


def test_changes_of_ones_own_work_everywhere_ours_do() -> None:
    """F270: plug-ins add changes: enabled for a while, with keys and signals, in extensions, before and after."""
    ball, copy = r4.Sphere(radius=1), None
    hop = ball.apply(Hop(r4.keys({0: 0.0, 2: 3.0})))
    copy = ball.extend()
    squash = copy.apply(Squash(0.25, enabled=r4.time >= 1))
    ball.apply(Striped())
    assert np.allclose(ball.position.at(1), [0, 0, 1.5])
    assert np.allclose(copy.bounds.at(1)[:, 2], [1.25, 1.75])  # about its own position
    assert np.allclose(copy.bounds.at(0)[:, 2], [-1, 1])
    assert (
        copy.methods.at(1)["points"] == "test_kinds.deform by squash of sphere"
        or "squash" in copy.methods.at(1)["points"]
    )
    assert copy.look.at(0)["stripes"] == 7
    assert np.allclose(copy.paint.at(0)[:3], r4.color("lightgray")[:3] * 0.5)
    hop.height = 1
    squash.share = r4.time
    assert np.allclose(copy.bounds.at(2)[:, 2], [-1, 3])
    with pytest.raises(r4.Reactive4dError, match="needs height"):
        Hop()
    with pytest.raises(r4.ShapeError, match=r"Squash\.share"):
        Squash(-1)


@pytest.mark.parametrize(
    ("make", "match"),
    [
        (lambda: type("A", (r4.Object,), {"table": r4.Table(points=lambda sides: [])}), "sides"),
        (lambda: r4.Table(point=list), "point"),
        (lambda: r4.Table(points=[(0, 0, 0)]), "points"),
        (lambda: type("B", (r4.Object,), {"table": {"points": len}}), "Table"),
    ],
)
def test_a_kind_that_cannot_work_is_refused_when_it_is_defined(make: Any, match: str) -> None:
    """At the border: a method that wants what its kind does not have, or is no method."""
    with pytest.raises(r4.Reactive4dError, match=match):
        make()


def test_a_change_that_wants_what_nobody_gives_is_refused_with_a_hint() -> None:
    """What a change's function may want are its attributes, and what the changes before it left."""

    class Wobble(r4.Transform):
        @staticmethod
        def matrix(wobbles: Any) -> Any:
            return np.eye(4)

    ball = r4.Sphere()
    ball.apply(Wobble())
    with pytest.raises(r4.Reactive4dError, match="wants 'wobbles'") as raised:
        ball.matrix.at(0)
    assert any("before" in note for note in raised.value.__notes__)


@pytest.mark.parametrize(
    ("points", "faces"),
    [([(0, 0)], [(0, 0, 0)]), ("abc", [(0, 0, 0)]), ([(0, 0, 0)], [(0, 1)]), ([(0, 0, 0)], [(0, 0, 9)])],
)
def test_what_a_users_kind_makes_wrong_is_an_error(points: Any, faces: Any) -> None:
    """A method that answers something else than it should: an error, and the rest of the scene works."""

    class Wrong(r4.Object):
        table = r4.Table(points=lambda: points, faces=lambda: faces)

    wrong = Wrong()
    with pytest.raises(r4.Reactive4dError):
        wrong.mesh.at(0)
    assert r4.Sphere().mesh.at(0).points.shape[1] == 3


def test_a_matrix_that_is_none_is_an_error() -> None:
    """A user's transform that answers something else than four rows of four finite numbers."""

    class Lost(r4.Transform):
        value = r4.Held(1)

        @staticmethod
        def matrix(value: Any) -> Any:
            return value

    ball = r4.Sphere()
    lost = ball.apply(Lost())
    for value in (1, "no", [[1, 2], [3, 4]], np.zeros((3, 3))):
        try:
            lost.value = value
        except r4.ShapeError:
            continue
        with pytest.raises(r4.ShapeError, match=r"Lost\.matrix"):
            ball.matrix.at(0)
    lost.value = np.eye(4)
    assert ball.matrix.at(0).tolist() == np.eye(4).tolist()


# -- settings ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "edit",
    [
        lambda b: setattr(b, "radius", -1),
        lambda b: setattr(b, "radius", math.nan),
        lambda b: setattr(b, "radius", math.inf),
        lambda b: setattr(b, "radius", "1"),
        lambda b: setattr(b, "radius", True),
        lambda b: setattr(b, "radius", (1, 2)),
        lambda b: setattr(b, "radius", None),
        lambda b: setattr(b, "segments", 2),
        lambda b: setattr(b, "segments", 3.5),
        lambda b: setattr(b, "segments", math.nan),
        lambda b: setattr(b, "segments", math.inf),
        lambda b: setattr(b, "segments", 10**9),
        lambda b: setattr(b, "color", "bleu"),
        lambda b: setattr(b, "color", (1, 2)),
        lambda b: setattr(b, "opacity", 1.1),
        lambda b: setattr(b, "visible", "yes"),
        lambda b: setattr(b, "visible", None),
        lambda b: setattr(b, "radius", b.radius + 1),
        lambda b: setattr(b, "name", 3),
        lambda b: b.parameters.__setitem__("not a name", 1),
        lambda b: b.parameters.__setitem__(3, 1),
        lambda b: b.parameters.__delitem__("tube"),
        lambda b: b.parameters["tube"],
        lambda b: setattr(b, "position", (1, 0, 0)),
        lambda b: setattr(b, "mesh", None),
        lambda b: r4.Sphere(-1),
        lambda b: r4.Sphere(1, 2),
        lambda b: r4.Sphere(raduis=1),
        lambda b: b.parameters.__setitem__("x", math.nan),
        lambda b: b.position.at(math.nan),
        lambda b: b.position.at("now"),
    ],
)  # fmt: skip
def test_settings_that_cannot_be_meant_are_refused_and_change_nothing(edit: Any) -> None:
    """At the border: a clear error, and everything as it was."""
    ball = r4.Sphere(radius=2, segments=8)
    before = (ball.mesh.at(0), ball.paint.at(0).tolist(), list(ball.parameters), ball.name)
    with pytest.raises((r4.Reactive4dError, KeyError, TypeError, AttributeError)) as raised:
        edit(ball)
    assert str(raised.value)
    after = (ball.mesh.at(0), ball.paint.at(0).tolist(), list(ball.parameters), ball.name)
    assert after[0] is before[0]
    assert after[1:] == before[1:]


def test_a_misspelt_setting_is_not_silently_kept() -> None:
    """`ball.raduis = 2` is refused with the nearest known name; so is an attribute of a change of one's own."""
    ball = r4.Sphere()
    with pytest.raises(AttributeError, match="raduis") as raised:
        ball.raduis = 2
    assert any("radius" in note for note in raised.value.__notes__)
    hop = Hop(1.0)
    with pytest.raises(AttributeError, match="hieght"):
        hop.hieght = 2
    hop.height = 2
    assert hop.height.at(0) == 2


def test_every_setting_says_what_it_is() -> None:
    """Metadata of every attribute (unit, default, doc) is declared once; values read back as they were assigned."""
    for kind in (r4.Sphere, r4.Box, r4.Cylinder, r4.Camera, r4.Light, r4.Label, r4.Path, r4.Duct, r4.Group):
        for name, setting in kind.settings.items():
            assert setting.doc, f"{kind.__name__}.{name}"
            assert setting.name == name
    radius = r4.Sphere.radius
    assert (radius.unit, radius.default, radius.low) == ("m", 0.5, 0.0)
    ball = r4.Sphere(color="crimson", radius=r4.time)
    assert ball.color.source == "crimson"
    assert ball.radius.source is r4.time
    ball.radius = ball.radius.source + 1
    assert ball.radius.at(2) == 3
