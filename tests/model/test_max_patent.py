"""The two worked examples of US patent 7,233,326: figures 3 to 7, modelling, and figures 8 to 14, caching."""

import math
from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d.geometry.deformations import bends, twists

FRAMES = 30.0  # a second
CHANNELS = ("topology", "points", "uv", "weld", "matrix", "mesh")


def evaluated(events: Any) -> list[str]:
    """What was computed, by name."""
    return sorted(event.name for event in events if event.kind == "evaluated")


# -- figures 3 to 7 ----------------------------------------------------------------------------------------------------


def tube_of_figure_3() -> Any:
    """The tube 300: inner radius, outer radius and height."""
    tube = r4.Tube(radius=0.5, inner=0.3, height=4, segments=12, stacks=16)
    tube.name = "tube"
    return tube


def bent(points: Any, position: Any = (0.0, 0.0, 0.0)) -> Any:
    """The bend of figure 4 by the kernel: "the angle of the bend is ninety degrees and the direction is ninety degrees
    both along the Z axis".
    """
    step = bends.Bend(math.radians(90), math.radians(90), "z", center=np.array(position))
    return step.map(points, step.extent(points))


def twisted(points: Any, position: Any) -> Any:
    """The twist of figure 5 by the kernel."""
    step = twists.Twist(math.radians(120), "z", center=np.array(position))
    return step.map(points, step.extent(points))


def test_the_tube_of_figures_3_to_7() -> None:
    """
    F261, F262, F263, F267: tube -> bend (90°, direction 90°, Z) -> twist -> disable bend -> XForm between.

    "The modifier stack allows a user to easily add modifiers to an object and view not only the results of the new
    modifiers but also view a list of all the modifiers that apply to an object"; "the user can change the values of the
    bend modifier without having to undo the twist modifier first"; "applying a bend before a twist can have a
    significantly different look than applying a twist before the bend"; "disable a particular modifier but keep the
    modifier in the modifier stack"; "the user was able to easily change the order of the twist and bend keep the bend
    disabled and insert an XForm instance between the two modifiers".
    """
    # Figure 3: the stack "only includes the reference to the tube master object and the transform".
    tube = tube_of_figure_3()
    straight = tube.points.at(0)
    assert list(tube.changes) == []
    # Figure 4: a bend.
    bend = tube.apply(r4.Bend(90, direction=90, axis="z"))
    assert np.array_equal(tube.points.at(0), bent(straight))
    # Figure 5: a twist after it.
    twist = tube.apply(r4.Twist(120, axis="z"))
    assert [type(change).__name__ for change in tube.changes] == ["Bend", "Twist"]
    figure5 = tube.points.at(0)
    position = tube.position.at(0)
    assert np.allclose(figure5, twisted(bent(straight), bent(np.zeros((1, 3)))[0]), atol=1e-6)
    assert np.allclose(position, bent(np.zeros((1, 3)))[0])
    # Its values are changed under the twist, and back: a hit.
    bend.angle = 45
    assert not np.array_equal(tube.points.at(0), figure5)
    bend.angle = 90
    with r4.log() as events:
        assert tube.points.at(0) is figure5
    assert evaluated(events) == []
    # Figure 6: the bend is disabled and stays in the stack; what the other tube shows is not changed by it.
    other = tube_of_figure_3()
    other.name = "other"
    own = other.apply(r4.Bend(90, direction=90, axis="z"))
    other.apply(twist)  # shared
    own.enabled = False
    assert [type(change).__name__ for change in other.changes] == ["Bend", "Twist"]
    assert np.allclose(other.points.at(0), twisted(straight, (0, 0, 0)), atol=1e-6)
    assert tube.points.at(0) is figure5
    own.enabled = True
    assert np.array_equal(other.points.at(0), figure5)
    own.enabled = False
    # Figure 7: the order is changed, the bend kept disabled, and an XForm put between the two.
    other.changes.move(twist, before=own)
    xform = r4.XForm(offset=(0, 0, 1), factor=(1, 1, 0.5))
    other.changes.insert(1, xform)
    assert [type(change).__name__ for change in other.changes] == ["Twist", "XForm", "Bend"]
    assert [type(change).__name__ for change in other.changes.at(0)] == ["Twist", "XForm"]
    figure7 = other.points.at(0)
    assert np.allclose(figure7, twisted(straight, (0, 0, 0)) * (1, 1, 0.5) + (0, 0, 1), atol=1e-5)
    own.enabled = True
    assert np.allclose(other.points.at(0), bent(figure7, (0, 0, 1)), atol=1e-5)
    # Bend then twist is not twist then bend.
    tube.changes.move(bend, after=twist)
    assert not np.allclose(tube.points.at(0), figure5, atol=0.1)
    assert tube.topology.valid(0) == r4.FOREVER


def test_only_modifiers_from_the_edited_one_on_are_evaluated_again() -> None:
    """F107, F111: each stage has a cache of its own; the master and what lies below the edit are not asked again."""
    tube = tube_of_figure_3()
    bend, twist = tube.apply(r4.Bend(90)), tube.apply(r4.Twist(r4.keys({0: 0, 2: 60})))
    tube.translate((1, 0, 0))
    for name in CHANNELS:
        getattr(tube, name).at(3)
    with r4.log() as events:
        twist.angle = r4.keys({0: 0, 2: 90})
        for name in CHANNELS:
            getattr(tube, name).at(3)
    found = set(evaluated(events))
    assert "tube.twist.points" in found
    assert not found & {
        "tube.bend.points",
        "tube.faces",
        "tube.uv",
        "tube.weld",
        "tube.form",
        "tube.kind",
        "tube.matrix",
    }
    with r4.log() as events:
        bend.direction = 10
        tube.points.at(3)
    assert "tube.twist.points" in evaluated(events)


def test_two_tubes_share_one_master_and_one_modifier() -> None:
    """F264, F265: one master shared by two derived objects, one modifier shared: an edit changes both; make unique."""
    master = tube_of_figure_3()
    left, right = master.extend(), master.extend()
    left.name, right.name = "left", "right"
    bend = r4.Bend(90)
    left.apply(bend)
    right.translate((3, 0, 0))
    right.apply(bend)
    for one in (left, right):
        one.mesh.at(0)
    with r4.log() as events:
        master.radius = 0.6
        left.mesh.at(0)
        right.mesh.at(0)
    assert evaluated(events).count("tube.points") == 1
    with r4.log() as events:
        bend.angle = 30
        left.mesh.at(0)
        right.mesh.at(0)
    assert {"left.bend.points", "right.bend.points"} <= set(evaluated(events))
    assert "tube.points" not in evaluated(events)
    right.changes[1] = r4.Bend(30)
    bend.angle = 60
    assert not np.allclose(left.points.at(0) + (3, 0, 0), right.points.at(0), atol=0.1)


def test_a_modifier_refuses_what_it_cannot_modify() -> None:
    """F266: modifiers declare which objects they accept (an extrusion: shapes only); refusal otherwise, and why."""
    star, box = r4.Star(tips=5), r4.Box()
    star.apply(r4.Extrude(0.5))
    assert star.volume.at(0) > 0
    wrong = box.apply(r4.Extrude(0.5))
    with pytest.raises(r4.Reactive4dError, match="no outline"):
        box.mesh.at(0)
    camera = r4.Camera()
    camera.apply(r4.Bend(30))
    with pytest.raises(r4.Reactive4dError, match="points"):
        camera.points.at(0)
    wrong.enabled = False
    assert box.volume.at(0) == 1


# -- figures 8 to 14 ---------------------------------------------------------------------------------------------------


def scene_of_figure_8(*, phase: Any) -> tuple[Any, Any, Any]:
    """
    "The bound cylinder 810 is bound to the wave world space modifier 800": it moves until frame twenty; the box 850
    grows until frame thirty.

        cylinder master -> transform -> wave (world space)
    """
    space = r4.Object()
    space.name = "space"
    space.translate((0, 0, 0.25))
    cylinder = r4.Cylinder(radius=0.5, height=2, segments=12, stacks=8)
    cylinder.name = "cylinder"
    cylinder.translate(r4.keys({0: (-3, 0, 0), 20 / FRAMES: (3, 0, 0)}))
    cylinder.apply(r4.Wave(0.2, wavelength=2, phase=phase, space=space))
    box = r4.Box()
    box.name = "box"
    box.scale(r4.keys({0: (1, 1, 1), 20 / FRAMES: (1, 1, 3), 30 / FRAMES: (1, 1, 4)}))
    return cylinder, box, space


def frame(cylinder: Any, box: Any, number: float) -> list[str]:
    """What is computed for one frame."""
    with r4.log() as events:
        for obj in (cylinder, box):
            for name in CHANNELS:
                getattr(obj, name).at(number / FRAMES)
    return evaluated(events)


def test_the_key_frames_of_figures_8_to_11() -> None:
    """F260, F269: object-space changes, a transform, world-space changes: waves depend on where the cylinder is."""
    cylinder, box, space = scene_of_figure_8(phase=0)
    heights = {number: cylinder.mesh.at(number / FRAMES).points[:, 2].copy() for number in (0, 5, 15, 20, 30)}
    assert not np.allclose(heights[0], heights[5], atol=0.05)  # elsewhere in the waves
    assert np.array_equal(heights[20], heights[30])
    assert np.allclose(cylinder.position.at(15 / FRAMES)[0], 1.5)
    assert np.allclose([box.bounds.at(n / FRAMES)[1, 2] for n in (0, 15, 20, 25, 30)], [0.5, 1.25, 1.5, 1.75, 2])
    # The waves are those of the world: what moves with the space moves them.
    space.rotate(90, axis="z")
    assert not np.allclose(cylinder.mesh.at(0).points[:, 2], heights[0], atol=0.05)


def test_topology_holds_for_ever() -> None:
    """F113: "the topology channel validity interval … zero to infinity": computed once, for all frames, both waves."""
    for phase in (0, 360 * r4.time):
        cylinder, box, _ = scene_of_figure_8(phase=phase)
        counts = [frame(cylinder, box, number) for number in range(31)]
        for name in ("cylinder.faces", "cylinder.uv", "cylinder.weld", "box.faces", "box.points"):
            assert sum(name in names for names in counts) == 1
        assert "cylinder.faces" in counts[0]
        assert all("cylinder.faces" not in names for names in counts[1:])
        for name in ("topology", "uv", "weld"):
            assert getattr(cylinder, name).valid(19 / FRAMES) == r4.FOREVER


def test_with_a_wave_that_moves_the_transform_s_points_are_kept_under_it() -> None:
    """
    F112, F113: the transform's intermediate result is valid for long, the next element's, the wave's, is not valid in
    the next frame: so it is cached (1475), and the next frame begins there: from frame 20 on only the wave runs.
    """
    cylinder, box, _ = scene_of_figure_8(phase=360 * r4.time)
    before = [frame(cylinder, box, number) for number in range(20)]
    assert all("cylinder.(translate)" in names for names in before[1:])
    at20, *after = [frame(cylinder, box, number) for number in range(20, 31)]
    assert {"cylinder.wave.placed", "cylinder.wave.points"} <= set(at20)
    of_cylinder = [{name for name in names if name.startswith("cylinder")} for names in after]
    for names in of_cylinder:
        assert "cylinder.wave.points" in names
        assert not names & {"cylinder.wave.placed", "cylinder.(translate)", "cylinder.faces", "cylinder.form"}
    assert sum("cylinder.wave.points" in names for names in after) == 10


def test_with_a_still_wave_everything_holds_from_frame_20_on() -> None:
    """F113: the wave's geometry interval becomes 20 … infinity once the cylinder stops; the box goes on growing."""
    cylinder, box, _ = scene_of_figure_8(phase=0)
    for number in range(21):
        frame(cylinder, box, number)
    for number in range(21, 31):
        names = frame(cylinder, box, number)
        assert not [name for name in names if name.startswith("cylinder")]
        assert "box.matrix" in names
        assert "box.points" not in names
    assert frame(cylinder, box, 31) == frame(cylinder, box, 45) == []
    assert cylinder.points.valid(25 / FRAMES) == r4.Interval(20 / FRAMES, math.inf)


def test_the_patent_s_claim_for_frame_19_contradicts_its_step_1330() -> None:
    """
    F113, corrected. The patent says that at frame 19, with N = 10, the transform's intermediate geometry is cached
    (1475), since the next element is not valid in the next frame. But its own step 1330 asks first whether the present
    element's result holds for the next ten frames, and at frame 19 the transform still moves, until frame 20: so by
    figure 13 nothing is cached there. We do as the steps say and not as the example says: at frame 19 the moved points
    hold for that instant only and are not kept for the next frame; from frame 20 on they are.
    """
    cylinder, box, _ = scene_of_figure_8(phase=360 * r4.time)
    frame(cylinder, box, 18)
    frame(cylinder, box, 19)
    assert cylinder.position.valid(19 / FRAMES).is_instant
    at20 = frame(cylinder, box, 20)
    assert "cylinder.(translate)" in at20  # nothing of frame 19 could be used
    assert "cylinder.wave.placed" in at20
    at21 = frame(cylinder, box, 21)
    assert not {"cylinder.(translate)", "cylinder.wave.placed"} & set(at21)


def test_asking_again_returns_what_is_cached() -> None:
    """F114: "if a derived object is requested … with nothing changed, it need only provide the cached value"."""
    cylinder, box, _ = scene_of_figure_8(phase=360 * r4.time)
    first = cylinder.mesh.at(7 / FRAMES)
    frame(cylinder, box, 7)
    assert frame(cylinder, box, 7) == []
    assert cylinder.mesh.at(7 / FRAMES) is first


def test_a_broadcast_invalidates_only_the_channels_it_affects() -> None:
    """F095, F115: an edit of the wave's space reaches the bound cylinder's geometry, not its topology, nor the box."""
    cylinder, box, space = scene_of_figure_8(phase=0)
    for number in (0, 10, 25):
        frame(cylinder, box, number)
    with r4.log() as events:
        space.changes[0].offset = (0, 0, 1)
    found = {event.name for event in events if event.kind == "marked"}
    assert {"space.matrix", "cylinder.points", "cylinder.mesh"} <= found
    assert not found & {"cylinder.topology", "cylinder.uv", "cylinder.faces", "cylinder.kind"}
    assert not [name for name in found if name.startswith("box")]
    assert evaluated(events) == []  # it is merely marked
