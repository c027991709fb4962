"""The rows of the feature list about objects that are made of others: solids combined, groups, paths, sweeps, blobs."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import reactive4d as r4

t = r4.time
PI = math.pi


def evaluated(events: Any) -> list[str]:
    """What was computed, by name."""
    return sorted(event.name for event in events if event.kind == "evaluated")


def colours(obj: r4.Object, at: float = 0) -> set[tuple[float, ...]]:
    """The colours of an object's faces."""
    return {tuple(row) for row in obj.mesh.at(at).attributes["colors"].round(2).tolist()}


RED, BLUE, GREEN, WHITE = (1, 0, 0, 1), (0, 0, 1, 1), (0, 0.5, 0, 1), (1, 1, 1, 1)
places = st.tuples(*[st.floats(-1.2, 1.2)] * 3)
bodies = st.sampled_from(
    [
        lambda: r4.Box((1, 1.5, 2), color="red"),
        lambda: r4.Sphere(0.8, segments=12, rings=8, color="blue"),
        lambda: r4.Cylinder(0.6, 2, segments=12, color="green"),
        lambda: r4.Torus(0.7, 0.3, segments=12, sides=8, color="white"),
    ]
)
placed = st.tuples(bodies, places, st.floats(-180, 180))


def put(body: Any) -> r4.Object:
    """A body that was turned and moved."""
    make, place, angle = body
    obj = make()
    obj.rotate(angle, axis=(1, 2, 3))
    obj.translate(place)
    return obj


def own(obj: r4.Object) -> float:
    """The volume of its mesh: closed forms are not those of the polyhedra that booleans combine."""
    return r4.Model(obj.mesh.at(0)).volume.at(0)


# -- booleans ----------------------------------------------------------------------------------------------------------


@given(placed, placed)
@settings(max_examples=25)
def test_the_sum_rule_of_booleans(first: Any, second: Any) -> None:
    """F032: union/intersection/difference: |A ∪ B| + |A ∩ B| = |A| + |B|, and A is its difference and intersection."""
    a, b = put(first), put(second)
    union, common, rest = ((a | b).volume.at(0), (a & b).volume.at(0), (a - b).volume.at(0))
    assert union + common == pytest.approx(own(a) + own(b), rel=1e-4)
    assert rest + common == pytest.approx(own(a), rel=1e-4)
    assert (b & a).volume.at(0) == pytest.approx(common, rel=1e-4, abs=1e-6)
    assert max(own(a), own(b)) * 0.9999 <= union <= (own(a) + own(b)) * 1.0001


@given(placed, placed, placed)
@settings(max_examples=15)
def test_the_laws_of_de_morgan(first: Any, second: Any, third: Any) -> None:
    """F032: trees nest: A - (B ∪ C) = (A - B) - C = (A - B) ∩ (A - C), and so on, in volume and centre of mass."""
    a, b, c = put(first), put(second), put(third)
    left, right = a - (b | c), (a - b) & (a - c)
    chain = r4.Combination([a, "-", b, "-", c])
    assert left.volume.at(0) == pytest.approx(right.volume.at(0), rel=1e-3, abs=1e-4)
    assert left.volume.at(0) == pytest.approx(chain.volume.at(0), rel=1e-3, abs=1e-4)
    if left.volume.at(0) > 0.05:
        assert np.allclose(left.center_of_mass.at(0), right.center_of_mass.at(0), atol=1e-2)


@pytest.mark.parametrize(
    ("operation", "volume"),
    [("union", 14), ("intersection", 2), ("difference", 6), ("|", 14), ("&", 2), ("-", 6), ("+", 14), ("*", 2)],
)
def test_a_tree_is_a_nested_list_with_names_of_operations(operation: str, volume: float) -> None:
    """F032: CSG: value = tree `[objA, op, objB]` nested; op names union/intersection/difference."""
    a, b = r4.Box((2, 2, 2)), r4.Box((5, 2, 1))
    b.translate((1, 1, 0))
    volumes = {"union": 8 + 10 - 2}
    solid = r4.Combination([a, operation, b])
    common = 2 * 1 * 1  # x from -1 to 1, y from 0 to 1, z from -1/2 to 1/2
    volumes = {14: 8 + 10 - common, 2: common, 6: 8 - common}
    assert solid.volume.at(0) == pytest.approx(volumes[volume])
    assert r4.Combination([[a], operation, [[b], "-", r4.Sphere(0.01)]]).volume.at(0) == pytest.approx(
        volumes[volume], rel=1e-4
    )


@pytest.mark.parametrize(
    "tree", [[], ["-"], [r4.Box(), "-"], [r4.Box(), "~", r4.Box()], [r4.Box(), r4.Box()], "box", 3, [3, "-", r4.Box()]]
)
def test_a_tree_that_is_none_is_refused(tree: Any) -> None:
    """F032: what is no tree is refused at once, with what one looks like."""
    with pytest.raises(r4.ShapeError, match=r"tree|operation") as failed:
        r4.Combination(tree)
    assert failed.value.__notes__


def test_a_tree_varies_with_time() -> None:
    """F032: tree itself time-varying: until 2 s a hole is cut, from then on a knob is added."""
    block, other = r4.Box((2, 2, 2)), r4.Box((1, 1, 4))
    part = r4.Combination(r4.keys({0: (block, "-", other), 2: (block, "|", other)}))
    assert part.volume.at(0) == pytest.approx(8 - 2)
    assert part.volume.at(1.999) == pytest.approx(8 - 2)
    assert part.volume.at(2) == pytest.approx(8 + 2)
    assert part.volume.valid(1).stop == 2
    part.tree = [block, "&", other]
    assert part.volume.at(2) == pytest.approx(2)


def test_operands_are_asked_for_their_surfaces_at_the_time_in_question() -> None:
    """F032: asks components for their b-rep at the given time: a hole that grows and wanders out of the block."""
    block, hole = r4.Box((2, 2, 2)), r4.Box()
    hole.size = r4.vec(1, 1, 1 + t)
    hole.translate(r4.where(t < 5, r4.vec(0, 0, 0), r4.vec(9, 0, 0)))
    rest = block - hole
    for at in (0.0, 0.5, 1.0, 4.0, 5.0):
        expected = 8 if at >= 5 else 8 - min(1 + at, 2)
        assert rest.volume.at(at) == pytest.approx(expected)


def test_a_moving_operand_is_imported_once() -> None:
    """F032: moving an operand rigidly re-imports nothing: its solid is evaluated once for all times."""
    block, ball = r4.Box((2, 2, 2)), r4.Sphere(0.6, segments=12, rings=8)
    ball.translate(r4.vec(t, 0, 0))
    rest = block - ball
    with r4.log() as events:
        for at in (0.0, 0.2, 0.4):
            rest.volume.at(at)
    counts = {name: evaluated(events).count(name) for name in ("box.imported", "sphere.imported", "box.matrix")}
    assert counts == {"box.imported": 1, "sphere.imported": 1, "box.matrix": 1}
    assert r4.stats([rest.volume])["evaluations"] == 3


def test_what_shares_a_surface_is_imported_once() -> None:
    """F032, F009: a plate with sixteen holes whose drills extend one drill: one import, also of what was deformed."""
    plate, drill = r4.Box((8, 8, 1)), r4.Cylinder(0.3, 2, segments=12)
    drill.name = "drill"
    drill.apply(r4.XForm(angle=15))
    drills = [drill.extend() for _ in range(16)]
    for i, one in enumerate(drills):
        one.translate((2 * (i % 4) - 3, 2 * (i // 4) - 3, 0))
    rest = plate - r4.Group(drills)
    with r4.log() as events:
        hole = 12 / 2 * math.sin(2 * PI / 12) * 0.3**2
        assert rest.volume.at(0) == pytest.approx(64 - 16 * hole, rel=1e-3)
    assert [name for name in evaluated(events) if "imported" in name] == ["box.imported", "drill.xform.imported"]


def test_a_group_is_an_operand_like_a_union() -> None:
    """F032, F033: members that overlap are one solid for booleans; that one of them moves imports none of them anew."""
    a, b = r4.Box((2, 2, 2)), r4.Box((2, 2, 2))
    b.translate(r4.vec(t, 0, 0))
    group = r4.Group([a, b])
    whole = group | r4.Box(0.1)
    with r4.log() as events:
        volumes = [whole.volume.at(at) for at in (0, 1, 2, 3)]
    assert volumes == pytest.approx([8, 12, 16, 16], rel=1e-5)
    assert sum("imported" in name for name in evaluated(events)) == 3
    assert (group & r4.Box((9, 9, 1))).volume.at(1) == pytest.approx(6, rel=1e-5)
    group.translate((0, 0, 5))
    assert (group & r4.Box((9, 9, 1))).volume.at(1) == 0


def test_faces_keep_their_operands_paint() -> None:
    """F032, F079: aggregates keep their operands' paint: faces of the hole have the colour of what cut it."""
    block, hole = r4.Box((2, 2, 2), color="red"), r4.Cylinder(0.5, 4, segments=12, color="blue")
    part = block - hole
    assert colours(part) == {RED, BLUE}
    mesh = part.mesh.at(0)
    blue = mesh.faces[(mesh.attributes["colors"] == BLUE).all(axis=1)]
    assert np.linalg.norm(mesh.points[blue][..., :2], axis=-1).max() < 0.5 + 1e-5
    hole.apply(r4.Color("white", enabled=r4.keys({0: 0, 2: 1}, interpolation="step")))
    assert colours(part, 1) == {RED, BLUE}
    assert colours(part, 2) == {RED, WHITE}
    ball = r4.Sphere(0.3, segments=8, rings=6, color="green")
    ball.translate((1, 1, 1))
    assert colours(part - ball) == {RED, BLUE, GREEN}
    part.apply(r4.Twist(30))
    assert colours(part) == {RED, BLUE}
    assert colours(part | ball) == {RED, BLUE, GREEN}  # what was deformed keeps its colours, too


def test_that_a_colour_fades_is_no_reason_to_combine_anew() -> None:
    """F032: paint is a channel of its own: no solid is made again because an operand's colour moves."""
    a, b = r4.Box((2, 2, 2)), r4.Box((1, 1, 3))
    group = r4.Group(a=r4.Box(0.5, color="blue"), b=b)
    b.color = r4.keys({0: "red", 10: "green"})
    part = a - group
    part.mesh.at(0)
    with r4.log() as events:
        for at in (1.0, 2.0, 3.0):
            part.mesh.at(at)
    names = evaluated(events)
    assert [name for name in names if name.endswith("solid")] == []
    assert names.count("csg.colors") == 3


def test_a_combination_is_changed_like_every_object() -> None:
    """F032: what is done to the combination acts afterwards: moved, deformed, extended, combined again."""
    a, b = r4.Box((2, 2, 2)), r4.Box((1, 1, 4))
    part = a - b
    part.scale((1, 1, 2))
    assert part.volume.at(0) == pytest.approx(12)
    copy = part.extend()
    copy.translate((10, 0, 0))
    assert copy.volume.at(0) == pytest.approx(12)
    assert copy.points.at(0) is part.points.at(0)
    assert (part | copy).volume.at(0) == pytest.approx(24)
    part.apply(r4.Skew(1.0))
    assert part.volume.at(0) == pytest.approx(12)
    copy.tree = [a, "&", b]
    assert copy.volume.at(0) == pytest.approx(4)


def test_empty_results_are_empty_meshes() -> None:
    """F032: what leaves nothing is an empty solid of volume 0, and goes on being combined."""
    a, b = r4.Box(), r4.Box(2)
    nothing = a - b
    assert (nothing.volume.at(0), nothing.area.at(0), len(nothing.mesh.at(0).faces)) == (0, 0, 0)
    assert (nothing | a).volume.at(0) == pytest.approx(1)
    assert (nothing & a).volume.at(0) == 0
    assert not nothing.contains((0, 0, 0)).at(0).any()
    assert np.isinf(nothing.intersect((0, 0, 5), (0, 0, -1)).at(0).distance).all()
    with pytest.raises(r4.EvaluationError, match="no points"):
        nothing.bounds.at(0)


def test_what_is_made_of_nothing_is_empty() -> None:
    """F032, F033: a combination without a tree, a hull, a group without members: empty, and operands like others."""
    box = r4.Box()
    for make in (r4.Combination, r4.Group, r4.Hull, r4.Model, lambda: r4.Lettering(" ")):
        obj = make()
        assert (obj.volume.at(0), len(obj.mesh.at(0).faces)) == (0, 0)
        assert (box | obj).volume.at(0) == pytest.approx(1)
        assert (box - obj).volume.at(0) == pytest.approx(1)
        assert colours(r4.Group([box, obj])) == colours(box | obj)
    thing = r4.Sphere()
    thing.apply(r4.Become("csg"))
    assert thing.volume.at(0) == 0


def test_a_hull_is_painted_as_one() -> None:
    """F033, F079: the faces of a hull are its own, and keep its paint in booleans and groups."""
    hull = r4.Hull([r4.Box(), r4.Box()], color="blue")
    assert colours(r4.Box(3, color="red") - hull) == {RED, BLUE}
    assert colours(r4.Group([r4.Box(3, color="red"), hull])) == {RED, BLUE}
    hull.apply(r4.Twist(20))
    assert colours(r4.Box(3, color="red") - hull) == {RED, BLUE}


def test_a_combination_of_what_is_open_says_so() -> None:
    """F032: an operand that is no solid is refused by name when it is asked for."""
    with pytest.raises(r4.ShapeError, match="not a closed surface") as failed:
        (r4.Box() - r4.Plane()).volume.at(0)
    assert "plane.solid" in "".join(failed.value.__notes__)


def test_a_tree_that_contains_itself_is_refused() -> None:
    """F012, F032: a combination that is an operand of itself is a circle, named with its path."""
    a = r4.Box()
    part = a | r4.Sphere(segments=8)
    part.tree = [a, "-", part]
    with pytest.raises(r4.CycleError, match="csg"):
        part.volume.at(0)
    part.tree = [a, "-", r4.Box((0.5, 0.5, 2))]
    assert part.volume.at(0) == pytest.approx(0.75)


def test_carving() -> None:
    """F041, F073: volumes; volumetric carving (sculpting): a chisel takes away what it passes through."""
    marble = r4.Box((4, 2, 2), color="white")
    chisel = r4.Box((0.5, 3, 0.5), color="red")
    chisel.translate(r4.keys({0: (-3, 0, 1), 4: (3, 0, 1)}))
    strokes = [chisel.extend() for _ in range(3)]
    depths = (0.0, -0.5, -1.0)
    for stroke, depth in zip(strokes, depths, strict=True):
        stroke.translate((0, 0, depth))
    # What one stroke takes away by a time is the hull of where it began and where it is.
    swept = []
    for stroke in strokes:
        begun, now = r4.Box((0.5, 3, 0.5)), stroke
        begun.translate((-3, 0, 1 + depths[len(swept)]))
        swept.append(r4.Hull([begun, now]))
    sculpture = r4.Combination([marble, "-", swept[0], "-", swept[1], "-", swept[2]])
    before = sculpture.volume.at(0)
    assert before == pytest.approx(16)
    done = [sculpture.volume.at(at) for at in (1.0, 2.0, 3.0, 4.0)]
    assert done == sorted(done, reverse=True)
    # All three channels are cut through: 4 m long and 2 m wide; the upper one lies half above the block.
    assert done[-1] == pytest.approx(16 - 4 * 2 * (0.25 + 0.5 + 0.5))
    assert sculpture.volume.at(0) == pytest.approx(16)


# -- groups ------------------------------------------------------------------------------------------------------------


@given(st.lists(placed, min_size=1, max_size=4))
@settings(max_examples=20)
def test_a_group_is_its_members_together(members: Any) -> None:
    """F033: group / hierarchical collection, treated as one object: areas, volumes and first moments add up."""
    parts = [put(member) for member in members]
    group = r4.Group(parts)
    volumes = np.array([own(part) for part in parts])
    assert group.volume.at(0) == pytest.approx(volumes.sum(), rel=1e-4)
    assert group.area.at(0) == pytest.approx(sum(r4.Model(p.mesh.at(0)).area.at(0) for p in parts), rel=1e-4)
    moments = [volume * part.center_of_mass.at(0) for volume, part in zip(volumes, parts, strict=True)]
    assert np.allclose(group.center_of_mass.at(0), sum(moments) / volumes.sum(), atol=1e-2)
    low, high = group.bounds.at(0)
    assert np.allclose(low, np.min([part.bounds.at(0)[0] for part in parts], axis=0), atol=1e-5)
    assert np.allclose(high, np.max([part.bounds.at(0)[1] for part in parts], axis=0), atol=1e-5)


def test_groups_of_groups() -> None:
    """F033: a hierarchy: the car's matrix carries the axle's carries the wheel's; members do not know of it."""
    wheel = r4.Cylinder(0.3, 0.2, segments=12, color="blue")
    wheel.translate((1, 0, 0))
    axle = r4.Group(wheel=wheel)
    axle.rotate(90)
    car = r4.Group(axle=axle, body=r4.Box(color="red"))
    car.translate(r4.vec(t, 0, 0))
    frame = r4.Scene(car=car).at(2.0)
    assert set(frame) == {"car", "car/axle", "car/axle/wheel", "car/body"}
    assert np.allclose(frame["car/axle/wheel"].matrix[:3, 3], (2, 1, 0))
    assert wheel.position.at(2).tolist() == [1, 0, 0]
    assert colours(car) == {RED, BLUE}
    assert colours(car - r4.Sphere(0.6, segments=8, rings=6, color="green")) == {RED, BLUE, GREEN}


def test_a_group_holds_what_has_no_surface_too() -> None:
    """F033: lamps, cameras and paths are members; the group's surface is that of those that have one."""
    room = r4.Group(
        box=r4.Box(), lamp=r4.Light("point"), eye=r4.Camera(), way=r4.Path(), hidden=r4.Box(5, visible=False)
    )
    assert room.volume.at(0) == pytest.approx(1)
    assert set(r4.Scene(room=room).at(0)) == {"room", *(f"room/{n}" for n in ("box", "lamp", "eye", "way", "hidden"))}
    assert r4.Group().volume.at(0) == 0
    assert r4.Group().mesh.at(0).faces.shape == (0, 3)


def test_what_is_done_to_the_group_is_done_to_it_as_a_whole() -> None:
    """F033: a bend of the group bends all of it about one axis, and none of its members alone."""
    left, right = r4.Box((0.2, 0.2, 1), segments=(1, 1, 4)), r4.Box((0.2, 0.2, 1), segments=(1, 1, 4))
    left.translate((0, 0, -0.5))
    right.translate((0, 0, 0.5))
    pair = r4.Group([left, right])
    bend = pair.apply(r4.Bend(90))
    one = r4.Box((0.2, 0.2, 2), segments=(1, 1, 8))
    one.apply(r4.Bend(90))
    assert np.allclose(pair.bounds.at(0), one.bounds.at(0), atol=1e-5)
    assert np.allclose(left.bounds.at(0)[1], (0.1, 0.1, 0), atol=1e-6)
    bend.enabled = False
    assert np.allclose(pair.bounds.at(0)[1], (0.1, 0.1, 1), atol=1e-6)


def test_members_come_and_go() -> None:
    """F033, F079: the list of members is a value like others: it varies with time."""
    a, b = r4.Box(), r4.Box()
    b.translate((2, 0, 0))
    group = r4.Group()
    group.members = r4.keys({0: (a,), 2: (a, b)}, interpolation="step")
    assert [group.volume.at(at) for at in (0, 1.9, 2)] == [1, 1, 2]
    assert list(r4.Scene(g=group).at(2)) == ["g", "g/member0", "g/member1"]


@given(st.lists(places, min_size=4, max_size=12))
@settings(max_examples=20)
def test_a_hull_contains_its_members(centers: Any) -> None:
    """F033: the smallest convex solid round others: all their points are in it, and it is the hull of its own hull."""
    hull = r4.Hull([r4.Point(place) for place in centers])
    volume = hull.volume.at(0)
    assert r4.Hull([hull]).volume.at(0) == pytest.approx(volume, rel=1e-4, abs=1e-9)
    if volume > 1e-3:
        middle = np.mean(centers, axis=0)
        inside = middle + 0.999 * (np.array(centers) - middle)
        assert hull.contains(inside).at(0).all()


# -- paths -------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", r4.Path.interpolation.options)
def test_a_path_tells_its_places_and_directions(kind: str) -> None:
    """F034: spline path built from point objects used as control points; gives position and tangent at parameter."""
    spots = [(0, 0, 0), (1, 2, 0), (3, 2, 1), (4, 0, 2), (6, 1, 0), (7, 3, 1), (8, 3, 3)]
    points = [r4.Point(at) for at in spots]
    path = r4.Path(points, interpolation=kind)
    path.translate((0, 0, 10))
    assert np.allclose(path.along(0).at(0), np.add(spots[0], (0, 0, 10)))
    assert np.allclose(path.along(1).at(0), np.add(spots[-1], (0, 0, 10)))
    for u in (0.13, 0.51, 0.87):
        step = 1e-6
        way = path.along(u + step).at(0) - path.along(u - step).at(0)
        tangent = path.tangent_along(u).at(0)
        assert np.linalg.norm(tangent) == pytest.approx(1)
        assert np.allclose(tangent, way / np.linalg.norm(way), atol=1e-5)
    car = r4.Box()
    car.translate(path.along(t / 10))
    assert np.allclose(car.position.at(5), path.along(0.5).at(0))


def test_a_path_follows_each_of_its_points() -> None:
    """F034: points may move: a keyed one, one that follows another object, one that is a signal, one that is fixed."""
    keyed, leader = r4.Point(), r4.Sphere()
    keyed.translate(r4.keys({0: (0, 0, 0), 2: (0, 2, 0)}))
    leader.translate(r4.vec(1, t, 0))
    path = r4.Path([keyed, leader, r4.vec(2, 2 * t, 0), (3, 0, 0)], interpolation="linear", samples=3)
    assert path.controls.at(1).tolist() == [[0, 1, 0], [1, 1, 0], [2, 2, 0], [3, 0, 0]]
    assert path.along(1 / 3).at(2).tolist() == [1, 2, 0]
    assert path.bounds.at(2)[1].tolist() == [3, 4, 0]


def test_a_bent_path_is_followed_where_it_was_bent() -> None:
    """F034: deformations act on paths as on all shapes, and whoever runs along one follows."""
    path = r4.Line((0, 0, 0), (0, 0, 2), segments=64)
    path.apply(r4.Bend(180, center=(0, 0, 0), lower=0, upper=2))
    radius = 2 / PI
    assert np.allclose(path.along(1).at(0), (2 * radius, 0, 0), atol=1e-3)
    assert np.allclose(path.along(0.5).at(0), (radius, 0, radius), atol=1e-3)


# -- patches, revolutions, prisms, ducts, blobs ------------------------------------------------------------------------


def test_a_bicubic_patch() -> None:
    """F035: spline patch; bicubic patch mesh: corners are control points, and it lies in their hull."""
    net = np.zeros((4, 4, 3))
    net[..., 0], net[..., 1] = np.meshgrid(np.arange(4.0), np.arange(4.0))
    net[1:3, 1:3, 2] = 3.0
    patch = r4.Patch(net, segments=(8, 8))
    points = patch.points.at(0)
    assert len(patch.topology.at(0)) == 2 * 8 * 8
    for corner in net[[0, 0, -1, -1], [0, -1, 0, -1]]:
        assert (points == corner.astype(np.float32)).all(axis=1).any()
    # In the middle a tensor product of Bernstein polynomials at 1/2: (1, 3, 3, 1) / 8.
    weights = np.array([1, 3, 3, 1]) / 8
    middle = np.einsum("i,j,ijk->k", weights, weights, net)
    assert np.abs(points - middle).sum(axis=1).min() < 1e-6
    assert points[:, 2].max() <= 3


@pytest.mark.parametrize("kind", r4.Patch.interpolation.options)
def test_a_patch_moves_with_its_control_points(kind: str) -> None:
    """F035: patch grids of any size; the control points move, the topology holds."""
    net = np.zeros((5, 7, 3))
    net[..., 0], net[..., 1] = np.meshgrid(np.arange(7.0), np.arange(5.0))
    if kind == "bezier":
        net = net[:4]
    lifted = r4.lift(lambda z: net + z * np.array([0, 0, 1.0]))(t)
    patch = r4.Patch(lifted, interpolation=kind, segments=(3, 3))
    assert np.allclose(patch.points.at(2) - patch.points.at(0), (0, 0, 2), atol=1e-5)
    assert patch.topology.valid(0) == r4.FOREVER
    assert patch.area.at(0) == pytest.approx(patch.area.at(2), rel=1e-5)
    assert patch.area.at(0) == pytest.approx(24 if kind != "bezier" else 18, rel=1e-4)


def test_control_points_of_a_patch_are_objects() -> None:
    """F025, F035: points are control points of patches, too: where one moves the patch follows, its topology holds."""
    corner, leader = r4.Point((0, 0, 0)), r4.Sphere()
    corner.translate(r4.vec(0, 0, t))
    leader.translate(r4.vec(1, 1, 2 * t))
    patch = r4.Patch([[corner, (1, 0, 0)], [(0, 1, 0), leader]], interpolation="linear", segments=(1, 1))
    assert sorted(patch.points.at(3)[:, 2].tolist()) == [0, 0, 3, 6]
    assert patch.topology.valid(3) == r4.FOREVER
    with pytest.raises(r4.ShapeError, match=r"Patch\.net"):
        r4.Patch([[corner, (1, 0, 0)], [(0, 1, 0)]])
    with pytest.raises(r4.ShapeError, match=r"Patch\.net"):
        r4.Patch([corner, (1, 0, 0)])
    with pytest.raises(r4.ShapeError, match=r"Patch\.net"):
        r4.Patch([[corner, (1, 0)], [(0, 1, 0), leader]])


polygons = st.lists(st.floats(0.3, 2.0), min_size=3, max_size=9)


@given(polygons, st.floats(2.1, 5.0))
@settings(max_examples=30)
def test_pappus(radii: list[float], away: float) -> None:
    """F036: object of revolution: by Pappus volume and area are those of the profile times its centroid's way."""
    angles = np.arange(len(radii)) * 2 * PI / len(radii)
    profile = np.column_stack([np.array(radii) * np.cos(angles) + away, np.array(radii) * np.sin(angles)])
    ring = r4.Revolution(profile, closed=True, segments=64)
    after = np.roll(profile, -1, axis=0)
    cross = profile[:, 0] * after[:, 1] - profile[:, 1] * after[:, 0]
    area = cross.sum() / 2
    center = ((profile + after) * cross[:, None]).sum(axis=0) / (6 * area)
    sides = np.linalg.norm(after - profile, axis=1)
    middle = ((profile + after) / 2 * sides[:, None]).sum(axis=0) / sides.sum()
    assert ring.volume.at(0) == pytest.approx(2 * PI * center[0] * area)
    assert ring.area.at(0) == pytest.approx(2 * PI * middle[0] * sides.sum())
    x, y, u, v = *profile.T, *after.T
    moment = (cross * (x * v + 2 * x * y + 2 * u * v + u * y)).sum() / 24  # of r z over the section
    assert ring.center_of_mass.at(0) == pytest.approx([0, 0, moment / (center[0] * area)], abs=1e-9)
    part = r4.Revolution(profile, closed=True, angle=90)
    assert part.volume.at(0) == pytest.approx(ring.volume.at(0) / 4)
    assert own(ring) == pytest.approx(ring.volume.at(0), rel=2e-2)


def test_a_revolution_is_made_of_a_group_of_paths() -> None:
    """F036: object of revolution / lathe from small groups of spline paths: end to end they are one profile."""
    base = r4.Path([(0, 0, 0), (1, 0, 0)], interpolation="linear", samples=2)
    side = r4.Path([(1, 0, 0), (1, 0, 2)], interpolation="linear", samples=2)
    lid = r4.Path([(1, 0, 2), (0, 0, 2)], interpolation="linear", samples=2)
    profile = r4.Group(base=base, side=side, lid=lid)
    drum = r4.Revolution(profile, segments=24)
    assert drum.volume.at(0) == pytest.approx(r4.Cylinder(1, 2).volume.at(0))
    assert len(profile.outline.at(0)) == 3 + 2 + 2
    profile.scale((2, 1, 1))
    assert drum.volume.at(0) == pytest.approx(r4.Cylinder(2, 2).volume.at(0))


@given(st.floats(0.2, 3.0), st.floats(0.1, 5.0))
def test_prisms(radius: float, height: float) -> None:
    """F037: prism; extruded object: the outline's area times the height, its centroid half-way up."""
    star = r4.Star(radius, inner=radius / 2, tips=7)
    prism = r4.Prism(star, height)
    area = 7 * radius * radius / 2 * math.sin(PI / 7)
    assert prism.volume.at(0) == pytest.approx(area * height, rel=1e-5)
    side = math.hypot(radius / 2 * math.sin(PI / 7), radius - radius / 2 * math.cos(PI / 7))
    assert prism.area.at(0) == pytest.approx(2 * area + 14 * side * height, rel=1e-5)
    assert np.allclose(prism.center_of_mass.at(0), (0, 0, height / 2), atol=1e-5 * max(radius, height))
    assert r4.Prism(star, -height).volume.at(0) == pytest.approx(area * height, rel=1e-5)


def test_a_generalised_cylinder() -> None:
    """F038: generalised cylinder: one outline along any path; its volume the area times the way of its centroid."""
    section = r4.Circle(0.3, segments=24)
    area = own(r4.Prism(section, 1.0))
    path = r4.Path([(0, 0, 0), (2, 0, 0), (2, 2, 1), (0, 3, 2)], samples=200)
    tube = r4.Duct([section], path=path)
    line = path.outline.at(0)
    length = np.linalg.norm(np.diff(line, axis=0), axis=1).sum()
    assert tube.volume.at(0) == pytest.approx(area * length, rel=2e-3)
    ring = r4.Duct([section], path=r4.Circle(2, segments=200), closed=True)
    assert ring.volume.at(0) == pytest.approx(area * 2 * PI * 2, rel=1e-3)


def test_a_duct_has_different_sections() -> None:
    """F039: **duct**: several, different cross-sections interpolated and extruded along an arbitrary spline path."""
    path = r4.Line((0, 0, 0), (0, 0, 3), segments=1)
    frustum = r4.Duct([r4.Rectangle((2, 2)), r4.Rectangle((1, 1))], path=path)
    assert frustum.volume.at(0) == pytest.approx((4 + 2 + 1) * 3 / 3)
    mixed = r4.Duct([r4.Circle(0.5, segments=12), r4.Star(0.5), r4.Ngon(0.4, sides=5)], path=path)
    assert mixed.solid.at(0) is not None
    assert 0.1 < mixed.volume.at(0) < PI / 4 * 3
    # Where a section stands is a setting; and a section may move.
    wide = r4.Rectangle((2, 2))
    wide.size = r4.keys({0: (2, 2), 1: (1, 1)})
    moving = r4.Duct([wide, r4.Rectangle((1, 1))], path=path)
    assert moving.volume.at(1) == pytest.approx(3)
    assert moving.volume.at(0) == pytest.approx(7)
    turned = r4.Duct([r4.Rectangle((1, 1))], path=r4.Line((0, 0, 0), (0, 0, 3), segments=48), twist=90)
    assert turned.volume.at(0) == pytest.approx(3, rel=2e-2)


def test_a_duct_does_not_turn_about_its_path_of_its_own() -> None:
    """F039: rotation-minimising frames: along a plane curve the section keeps its side out of the plane."""
    path = r4.Circle(2, segments=64)
    band = r4.Duct([r4.Rectangle((0.2, 1.0))], path=path, closed=True)
    low, high = band.bounds.at(0)
    flat = min(high[2] - low[2], 1.0)
    assert flat == pytest.approx(1.0, abs=1e-3) or flat == pytest.approx(0.2, abs=1e-3)


def test_a_lone_blob_is_a_ball() -> None:
    """F040: implicit surface; **blobby** surface (Wyvill soft objects): alone it is a ball of half its reach."""
    blob = r4.Blob([(1, 2, 3)], radii=2.0, resolution=48)
    assert np.allclose(blob.center_of_mass.at(0), (1, 2, 3), atol=0.01)
    assert blob.volume.at(0) == pytest.approx(4 / 3 * PI, rel=0.01)
    assert np.allclose(np.linalg.norm(blob.points.at(0) - (1, 2, 3), axis=1), 1, atol=0.01)


def test_blobs_blend_as_they_approach() -> None:
    """F040: blending the surfaces of the aggregate's members: two balls that move become one body, and part again."""
    a, b = r4.Point(), r4.Point()
    a.translate(r4.vec(-t, 0, 0))
    b.translate(r4.vec(t, 0, 0))
    blob = r4.Blob([a, b], radii=1.0, resolution=40)
    parts = [_pieces(blob.mesh.at(at)) for at in (0.2, 0.45, 1.5)]
    assert parts == [1, 1, 2]
    alone = r4.Blob([(0, 0, 0)], radii=1.0, resolution=40).volume.at(0)
    assert blob.volume.at(0.45) > 2 * alone  # between them it bulges
    assert blob.volume.at(1.5) == pytest.approx(2 * alone, rel=0.05)
    dented = r4.Blob([(0, 0, 0), (0.6, 0, 0)], radii=1.0, strengths=(1, -0.8), resolution=40)
    assert dented.volume.at(0) < alone


def _pieces(mesh: r4.Mesh) -> int:
    """In how many pieces a mesh is."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    weld = mesh.attributes.get("weld", np.arange(len(mesh.points)))
    edges = weld[mesh.faces[:, [0, 1, 1, 2]]].reshape(-1, 2)
    links = coo_array((np.ones(len(edges)), edges.T), shape=[len(mesh.points)] * 2)
    _, labels = connected_components(links, directed=False)
    return len(np.unique(labels[edges[:, 0]]))


# -- dependency through aggregates -------------------------------------------------------------------------------------


def test_one_point_moves_and_all_that_is_made_of_it_follows() -> None:
    """
    F044: dependency through aggregates: move a point -> path -> object of revolution -> CSG all change, nothing else.

        point --> path --> vase --> part --> volume
                           foot (still) ----^
    """
    points = [r4.Point(at) for at in ((0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1))]
    slide = points[2].translate((0, 0, 0))
    path = r4.Path(points, interpolation="linear", samples=3)
    vase = r4.Revolution(path, segments=16)
    foot = r4.Box((4, 4, 0.5))
    for name, obj in {"path": path, "vase": vase, "foot": foot}.items():
        obj.name = name
    for i, point in enumerate(points):
        point.name = f"p{i}"
    part = vase - foot
    part.name = "part"
    before = part.volume.at(0)
    assert before == pytest.approx(16 / 2 * math.sin(2 * PI / 16) * 0.75, rel=1e-5)
    with r4.log() as events:
        slide.offset = (1, 0, 0)
        after = part.volume.at(0)
    # A cone's frustum from radius 1 at the bottom to radius 2 at the top, of which the lowest quarter is cut away.
    frustum = (2**2 + 2 * 1.25 + 1.25**2) / 3 * 0.75
    assert after == pytest.approx(16 / 2 * math.sin(2 * PI / 16) * frustum, rel=1e-5)
    assert evaluated(events) == [
        "_rows(p0.position, p1.position, p2.position, p3.position)",
        *("p2.(translate)", "p2.matrix", "p2.position"),
        *("part.solid", "part.volume", "part.volume"),
        *("path.controls", "path.outline", "path.points", "path.points"),
        *("vase.faces", "vase.imported", "vase.points", "vase.profile", "vase.solid", "vase.surface"),
        *("vase.uv", "vase.weld"),
    ]
    # Moved back, all of it is a hit.
    with r4.log() as events:
        slide.offset = (0, 0, 0)
        assert part.volume.at(0) == before
    assert evaluated(events) == []


def test_everything_derived_from_one_root() -> None:
    """F044: extreme: every object derived from one root; a root's edit reaches them all, a leaf's edit only itself."""
    root = r4.Box(0.1)
    rows = [root.extend() for _ in range(5)]
    leaves = [[row.extend() for _ in range(5)] for row in rows]
    for i, row in enumerate(rows):
        row.translate((i, 0, 0))
        for j, leaf in enumerate(leaves[i]):
            leaf.translate((0, j, 0))
    all_leaves = [leaf for row in leaves for leaf in row]
    assert len({id(leaf.points.at(0)) for leaf in all_leaves}) == 1
    root.size = 0.2
    with r4.log() as events:
        assert all(leaf.bounds.at(0)[1, 2] == np.float32(0.1) for leaf in all_leaves)
    assert evaluated(events).count("box.points") <= 1 + len(all_leaves) + len(rows) + 1
    assert sum(event.kind == "evaluated" and event.name == "box.size" for event in events) <= 1
    leaves[0][0].translate((0, 0, 1))
    with r4.log() as events:
        found = [leaf.position.at(0)[2] for leaf in all_leaves]
    assert sum(found) == 1
    assert evaluated(events).count("box.position") <= 25
    root.translate((0, 0, 5))
    assert all(leaf.position.at(0)[2] >= 5 for leaf in all_leaves)


@pytest.mark.parametrize(
    ("aggregate", "setting"),
    [
        (r4.Group([r4.Box()]), "members"),
        (r4.Hull([r4.Box()]), "members"),
        (r4.Path([r4.Point(), (1, 0, 0)]), "controls"),
        (r4.Duct([r4.Circle()]), "sections"),
        (r4.Revolution(r4.Path()), "profile"),
        (r4.Prism(r4.Circle()), "outline_of"),
        (r4.Blob([r4.Point()]), "centers"),
        (r4.Combination([r4.Box(), "|", r4.Sphere()]), "tree"),
    ],
    ids=lambda x: type(x).__name__ if isinstance(x, r4.Object) else "",
)
def test_what_an_aggregate_is_made_of_is_a_setting(aggregate: r4.Object, setting: str) -> None:
    """F079: aggregate definition messages: members, path points, duct sections, CSG tree, blob members."""
    assert setting in aggregate.parameters
    copy = aggregate.extend()
    # An object that becomes an aggregate takes its definition from its parameters.
    other = r4.Object()
    other.parameters[setting] = aggregate.parameters[setting].source
    other.apply(r4.Become(type(aggregate)))
    for obj in (copy, other):
        if aggregate.topology.at(0) is None:
            assert np.array_equal(obj.outline.at(0), aggregate.outline.at(0))
        else:
            assert np.array_equal(obj.mesh.at(0).points, aggregate.mesh.at(0).points)
