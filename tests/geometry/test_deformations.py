"""What holds for every deformation: identity, types, frames, weights, derivatives, and stacks in blocks."""

import math
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import Any, cast

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from reactive4d.arrays import freeze, same
from reactive4d.errors import ShapeError
from reactive4d.geometry.deformations import stacks
from reactive4d.geometry.deformations.bends import Bend
from reactive4d.geometry.deformations.frames import basis
from reactive4d.geometry.deformations.limits import Extent
from reactive4d.geometry.deformations.normals import deform_with_normals
from reactive4d.geometry.deformations.skews import Skew
from reactive4d.geometry.deformations.stacks import (
    Maker,
    carried,
    deform,
    deform_each,
    measured,
    moved,
    origin_after,
)
from reactive4d.geometry.deformations.steps import Step
from reactive4d.geometry.deformations.tapers import Taper
from reactive4d.geometry.deformations.twists import Twist
from reactive4d.geometry.deformations.waves import Ripple, Wave
from reactive4d.geometry.lattices import FreeForm, lattice
from reactive4d.geometry.transforms import (
    IDENTITY,
    compose,
    inverse,
    rotation,
    scaling,
    transform_points,
    translation,
)

Array = NDArray[Any]

FRAME = compose([rotation(0.4, (1, 2, -1)), scaling((1.0, 1.5, 0.8)), translation((0.1, 0.2, -0.3))])


def dented() -> FreeForm:
    """A lattice of which every control point has moved a little."""
    points = lattice((-3, -3, -3), (3, 3, 3), (3, 4, 2))
    moves = np.random.default_rng(5).normal(scale=0.2, size=points.shape)
    return FreeForm(points + moves, (-3, -3, -3), (3, 3, 3))


STEPS: dict[str, Step] = {
    "bend": Bend(1.3),
    "bend sideways": Bend(-2.0, 0.6, "x", center=(0.1, 0.2, 0.3)),
    "bend a quarter round": Bend(1.0, math.pi / 2, "y"),
    "bend within limits": Bend(1.3, 0.3, lower=-0.4, upper=0.6),
    "bend above": Bend(1.3, lower=0.2, upper=0.9),
    "bend up to a limit": Bend(0.9, upper=0.3),
    "bend in a frame": Bend(1.1, axis=(1, 1, 1), frame=FRAME),
    "twist": Twist(2.0),
    "twist with bias": Twist(-2.0, "x", bias=0.7, center=(0.1, 0.0, 0.2)),
    "twist within limits": Twist(2.0, (1, 2, 3), lower=-0.5, upper=0.25),
    "taper": Taper(-0.6),
    "taper with a curve": Taper(0.5, 0.4, "y", center=(0, 0.3, 0)),
    "taper of one side": Taper(0.5, 0.2, "x", effect="z", lower=-0.5, upper=0.5),
    "taper of both ends": Taper(-0.8, 0.1, is_symmetric=True, upper=0.4),
    "skew": Skew(0.7, 0.4, "-z"),
    "skew within limits": Skew(0.7, axis="x", lower=0.0, upper=0.4),
    "wave": Wave(0.2, 1.5, 0.4),
    "waves that cross and decay": Wave(0.2, 1.5, 100.0, second=-0.1, decay=0.5, axis="x", direction=0.3),
    "ripple": Ripple(0.2, 1.2, 0.4, decay=0.3, center=(3, 0, 0)),
    "ripple of two amplitudes": Ripple(0.2, 1.2, second=0.05, axis="y", frame=FRAME),
    "lattice": dented(),
}
STILL: dict[str, Step] = {
    "bend": Bend(0.0, 0.3, (1, 2, 3), center=(1, 2, 3), frame=FRAME),
    "bend of less than anybody sees": Bend(1e-15),
    "twist": Twist(0.0, "x", bias=1.0, center=(1, 2, 3), frame=FRAME),
    "taper": Taper(0.0, 0.0, "y", lower=0.0),
    "skew": Skew(0.0, 0.3, lower=0.0, upper=1.0),
    "wave": Wave(0.0, 1.0, frame=FRAME),
    "ripple": Ripple(0.0, 1.0, 3.0),
    "lattice": FreeForm(lattice((0, 0, 0), (1, 2, 3), (2, 3, 5)), (0, 0, 0), (1, 2, 3), frame=FRAME),
}
every = pytest.mark.parametrize("step", STEPS.values(), ids=STEPS.keys())


def changed(step: Step, **fields: Any) -> Step:
    """The same step but for some fields."""
    family: Any = step
    return cast(Step, replace(family, **fields))


def cloud(count: int = 500, *, seed: int = 0) -> Array:
    """Points of a box of 2 m about the origin, float32."""
    return np.random.default_rng(seed).uniform(-1.0, 1.0, (count, 3)).astype(np.float32)


@pytest.mark.parametrize("step", STILL.values(), ids=STILL.keys())
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_what_deforms_nothing_leaves_every_bit(step: Step, dtype: Any):
    """A deformation by nothing is the identity, bit for bit, also in a crooked frame."""
    points = cloud().astype(dtype)
    points[0] = (-0.0, 0.0, -0.0)
    assert step.map(points, step.extent(points)).tobytes() == points.tobytes()
    assert deform(points, [step, step]).tobytes() == points.tobytes()


@every
def test_float64_agrees_with_float32(step: Step):
    """The same function carries meshes in float32 and control points in float64, to the rounding of float32."""
    points = cloud()
    exact = points.astype(np.float64)
    extent = step.extent(points)
    assert np.allclose(extent, step.extent(exact), rtol=0.0, atol=1e-6)
    rounded, precise = step.map(points, extent), step.map(exact, extent)
    assert (rounded.dtype, precise.dtype) == (np.float32, np.float64)
    assert np.allclose(rounded, precise, rtol=0.0, atol=2e-6)


@every
def test_answers_are_frozen_and_arguments_stay(step: Step):
    """What is returned cannot be changed, and what was given has not been."""
    points = cloud()
    before = points.tobytes()
    answer = step.map(points, step.extent(points))
    assert not answer.flags.writeable
    assert answer.flags.c_contiguous
    assert answer.base is None
    assert points.tobytes() == before


@every
def test_equal_points_stay_bitwise_equal(step: Step, monkeypatch: pytest.MonkeyPatch):
    """Wherever a point stands among others, and in however many blocks, its answer is the same."""
    points = cloud(1_001)
    extent = step.extent(points)
    answer = step.map(points, extent)
    order = np.random.default_rng(1).permutation(len(points))
    assert np.array_equal(step.map(points[order], extent), answer[order])
    assert np.array_equal(step.map(points[:1], extent), answer[:1])
    monkeypatch.setattr(stacks, "_BLOCK", 100)
    assert np.array_equal(step.map(points, extent), answer)
    assert step.extent(points) == extent


@every
def test_no_points_are_no_trouble(step: Step):
    """Of no points there is no extent, and nothing comes back; of one there is an answer."""
    nothing = np.zeros((0, 3), np.float32)
    assert step.extent(nothing) == (0.0, 0.0)
    assert deform(nothing, [step, step]).shape == (0, 3)
    assert np.isfinite(deform(np.ones((1, 3), np.float32), [step])).all()


@every
def test_weights_mix(step: Step):
    """Weight 0 leaves a point where it is, bit for bit; weight 1 deforms it; in between it is in between."""
    points = cloud()
    extent = step.extent(points)
    whole = step.map(points, extent)
    weights = np.linspace(0.0, 1.0, len(points), dtype=np.float32)
    mixed = step.map(points, extent, weights=weights)
    expected = points + weights[:, None].astype(np.float64) * (whole.astype(np.float64) - points)
    assert np.allclose(mixed, expected, rtol=0.0, atol=1e-6)
    if changed(step, frame=None) == step:
        untouched = step.map(points, extent, weights=np.zeros_like(weights))
        assert np.allclose(untouched, points, rtol=0.0, atol=3e-7)


def test_weight_zero_keeps_every_bit():
    """Where the frame is no more than an exchange of axes, weight 0 changes not a bit."""
    points = cloud()
    for axis in ("x", "y", "z"):
        for step in (Bend(1.0, axis=axis), Twist(1.0, axis), Taper(0.5, axis=axis), Wave(0.1, 1.0, axis=axis)):
            mixed = step.map(points, step.extent(points), weights=np.zeros(len(points), np.float32))
            assert np.array_equal(mixed, points)


@every
def test_the_derivative_is_that_of_the_map(step: Step):
    """The derivative is the limit of differences, everywhere but on the few planes where there is a kink."""
    points = cloud(200).astype(np.float64)
    extent = step.extent(points)
    size = 1e-6
    columns = [
        (step.map(points + size * unit, extent) - step.map(points - size * unit, extent)) / (2.0 * size)
        for unit in np.eye(3)
    ]
    assert np.allclose(step.jacobian(points, extent), np.stack(columns, axis=-1), rtol=1e-6, atol=1e-6)
    weights = np.full(len(points), 0.25, np.float32)
    mixed = np.eye(3) + 0.25 * (step.jacobian(points, extent) - np.eye(3))
    assert np.allclose(step.jacobian(points, extent, weights=weights), mixed)


@every
def test_differences_stand_in_for_a_derivative(step: Step):
    """A family that does not know its derivative has one all the same, which agrees with the exact one."""
    points = cloud(100).astype(np.float64)
    assert np.allclose(Step.gradient(step, points, (-1.0, 1.0)), step.gradient(points, (-1.0, 1.0)), atol=1e-6)


@every
def test_normals_agree_with_a_fine_mesh(step: Step):
    """The normals by the derivative are those of the small triangles of a finely meshed sphere."""
    centers, normals = sphere(400)
    size = 1e-4
    across = np.cross(normals, np.eye(3)[np.abs(normals).argmin(axis=1)])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    along = np.cross(normals, across)
    corners = np.stack([centers + size * (across * math.cos(a) + along * math.sin(a)) for a in (0.0, 2.1, 4.2)], axis=1)
    extent = step.extent(centers)
    moved = step.map(corners.reshape(-1, 3), extent).reshape(-1, 3, 3)
    faces = np.cross(moved[:, 1] - moved[:, 0], moved[:, 2] - moved[:, 0])
    faces /= np.linalg.norm(faces, axis=1, keepdims=True)
    points, turned = deform_with_normals(centers, normals, [step], extents=[extent])
    assert np.allclose(points, step.map(centers, extent))
    assert np.quantile(np.abs(turned - faces).max(axis=1), 0.97) < 1e-3  # The rest lies across a kink.


def sphere(count: int) -> tuple[Array, Array]:
    """Points of a sphere of radius 0.9, evenly spread, and its normals."""
    turn = math.pi * (1.0 + math.sqrt(5.0)) * np.arange(count)
    height = 1.0 - 2.0 * (np.arange(count) + 0.5) / count
    width = np.sqrt(1.0 - height**2)
    normals = np.stack([width * np.cos(turn), width * np.sin(turn), height], axis=1)
    return 0.9 * normals, normals


def test_normals_go_through_a_whole_stack():
    """Matrices and several steps turn normals as they turn the triangles of the surface, also inside out."""
    centers, normals = sphere(200)
    before, after = rotation(0.5, (1, 2, 3)), compose([scaling((1, 2, -1)), translation((5, 0, 0))])
    steps = [Taper(0.5), Twist(1.0), Bend(1.0, axis="x")]
    points, turned = deform_with_normals(centers, normals, steps, before=before, after=after)
    assert np.allclose(points, deform(centers, steps, before=before, after=after))
    extents: list[Extent | None] = []
    moved = deform(centers, [], before=before)
    for step in steps:
        extents.append(step.extent(moved))
        moved = step.map(moved, step.extent(moved))
    across = np.cross(normals, np.eye(3)[np.abs(normals).argmin(axis=1)])
    along = np.cross(normals, across)
    a, b = (
        deform(centers + 1e-5 * side, steps, before=before, after=after, extents=extents) - points
        for side in (across, along)
    )
    faces = np.cross(a, b)
    faces /= np.linalg.norm(faces, axis=1, keepdims=True)
    assert np.allclose(turned, faces, atol=1e-4)


steps_of_all_kinds = st.lists(st.sampled_from([*STEPS.values(), *STILL.values()]), max_size=5)


@given(steps_of_all_kinds, st.booleans(), st.booleans(), st.booleans(), st.sampled_from([np.float32, np.float64]))
def test_a_stack_is_its_steps_one_after_the_other(
    steps: list[Step], moved: bool, placed: bool, chosen: bool, dtype: Any
):
    """Fused in blocks, with extents found on the way, a stack answers as its steps do one by one, to the bit."""
    points = cloud(300).astype(dtype)
    before, after = (FRAME if moved else None), (inverse(FRAME) if placed else None)
    weights = np.linspace(0.0, 1.0, len(points), dtype=np.float32) if chosen else None
    expected = points if before is None else transform_points(before, points)
    for step in steps:
        expected = step.map(expected, step.extent(expected), weights=weights)
    if after is not None:
        expected = transform_points(after, expected)
    answer = deform(points, steps, before=before, after=after, weights=weights)
    assert answer.tobytes() == expected.tobytes()


def centered(step: Step) -> Maker:
    """The step about the origin, wherever this is when it acts."""
    if isinstance(step, FreeForm):
        return lambda origin: step
    return lambda origin: changed(step, center=origin)


MATRICES = (FRAME, translation((0.1, 0.2, 0.3)), scaling((1, -2, 0.5)), basis("y"), scaling((1, 0, 1)), IDENTITY)


@given(
    st.lists(st.sampled_from([*STEPS.values(), *STILL.values(), *MATRICES]), max_size=6),
    st.sampled_from([None, (0.0, 0.0, 0.0), (0.3, -0.2, 0.5)]),
    st.sampled_from([0, 1, 500]),
    st.floats(width=32),
)
def test_steps_that_are_made_on_the_way_are_those_made_beforehand(
    acts: list[Step | Array], start: tuple[float, float, float] | None, count: int, stray: float
):
    """Made when it is known where the origin is, to where all below carries it, steps answer to the bit as alone."""
    points = cloud(count)
    points[:1, 1] = stray
    begin = None if start is None else np.array(start)
    made = [centered(act) if isinstance(act, Step) else act for act in acts]
    expected, origin = points, begin
    with np.errstate(all="ignore"):
        for act in made:
            if not callable(act):
                expected, origin = transform_points(act, expected), moved(act, origin)
                continue
            at = np.zeros(3) if origin is None else origin
            step = act(at)
            extent = step.extent(expected)
            expected, origin = step.map(expected, extent), carried(step, at, extent)
        answer, end = deform_each(points, made, begin), origin_after(points, made, begin)
    assert answer.tobytes() == expected.tobytes()
    assert end.tobytes() == (np.zeros(3) if origin is None else origin).tobytes()
    assert not answer.flags.writeable


def test_extents_are_followed_where_they_can_be(monkeypatch: pytest.MonkeyPatch):
    """A stack along one axis looks at its points once, wherever its centres are, until something moves them along."""
    looks: list[int] = []
    look = stacks._Gauge.add  # pyright: ignore[reportPrivateUsage]

    def counted(*arguments: Any) -> None:
        looks.append(len(arguments))
        look(*arguments)

    monkeypatch.setattr(stacks._Gauge, "add", counted)  # pyright: ignore[reportPrivateUsage]
    points = cloud()
    for axis, other in (("z", "x"), ("-y", "z")):
        along = [Taper(0.5, axis=axis, center=(0, 0.1, 0.2)), Twist(1.0, axis), Skew(1.0, 0.3, axis, center=(1, 1, 1))]
        for steps, count in ((along, 1), ([*along, Bend(1.0, axis=axis), Bend(1.0, axis=other)], 2)):
            looks.clear()
            deform(points, steps)
            assert len(looks) == count


@given(st.lists(st.sampled_from(list(STEPS.values())), min_size=1, max_size=4))
def test_extents_that_are_given_are_not_measured(steps: list[Step]):
    """A stack with the extents of its steps answers as one that measures them itself."""
    points = cloud(300).astype(np.float64)
    extents: list[Extent | None] = []
    moved: Array = points
    for step in steps:
        extents.append(step.extent(moved))
        moved = step.map(moved, step.extent(moved))
    assert np.array_equal(deform(points, steps, extents=extents), moved)
    assert np.array_equal(deform(points, steps), moved)


@every
def test_what_a_step_keeps_it_keeps(step: Step):
    """Coordinates of which a step says that it keeps them are kept, to the bit in its own frame."""
    points = cloud()
    local = changed(step, frame=None)
    kernel = local.bind((-1.0, 1.0), np.dtype(np.float32))
    assert kernel is not None
    columns = [column.copy() for column in points.T]
    kernel(columns[0], columns[1], columns[2], [np.empty(len(points), np.float32) for _ in range(6)])
    for column, before, is_kept in zip(columns, points.T, local.keeps, strict=True):
        assert np.array_equal(column, before) == is_kept


@every
def test_a_frame_is_the_space_of_another_object(step: Step):
    """In a frame, a step does what it does without, seen from that frame."""
    points = cloud().astype(np.float64)
    bare, framed = changed(step, frame=None), changed(step, frame=FRAME)
    inside = transform_points(inverse(FRAME), points)
    expected = transform_points(FRAME, bare.map(inside, bare.extent(inside)))
    assert np.allclose(framed.extent(points), bare.extent(inside))
    assert np.allclose(framed.map(points, framed.extent(points)), expected, atol=1e-12)


@pytest.mark.parametrize("axis", ["x", "y", "-z", "-x", (1.0, 2.0, 3.0), (-1.0, 0.1, 0.0)])
def test_an_axis_is_a_turned_z(axis: Any):
    """Along another axis a deformation does what it does along z, all being turned."""
    turn = basis(axis)
    points = cloud().astype(np.float64)
    for along in (Bend(1.2, 0.3), Twist(1.2), Taper(0.4), Skew(0.5), Wave(0.2, 1.3), Ripple(0.2, 1.3)):
        turned = changed(along, axis=axis)
        inside = transform_points(inverse(turn), points)
        expected = transform_points(turn, along.map(inside, along.extent(inside)))
        assert np.allclose(turned.map(points, turned.extent(points)), expected, atol=1e-12)


def test_bases_are_right_handed_and_change_places_of_axes():
    """The frame of a coordinate axis is an exchange of coordinates; every frame is a rotation."""
    assert np.array_equal(basis("z"), np.eye(4))
    assert np.array_equal(basis("x")[:3, :3], ((0, 0, 1), (1, 0, 0), (0, 1, 0)))
    assert np.array_equal(basis("y")[:3, :3], ((0, 1, 0), (0, 0, 1), (1, 0, 0)))
    for axis in ("-x", "-y", "-z", (1, 2, 3), (1, 1, 1), (-3, 2, 1)):
        turn = basis(axis)[:3, :3]
        assert np.allclose(turn @ turn.T, np.eye(3), atol=1e-15)
        assert np.linalg.det(turn) > 0.0


def test_the_order_of_steps_matters():
    """Bending and then twisting is not twisting and then bending."""
    points = cloud()
    bend, twist = Bend(1.5), Twist(1.5, "x")
    apart = np.abs(deform(points, [bend, twist]) - deform(points, [twist, bend]))
    assert apart.max() > 0.5


def test_blocks_do_not_show(monkeypatch: pytest.MonkeyPatch):
    """Steps that wait for all points between them answer the same, to the bit, in one block or in many."""
    points = cloud(1_001)
    steps = [STEPS[name] for name in ("bend", "twist", "lattice", "bend sideways", "wave")]
    weights = np.linspace(0.0, 1.0, len(points), dtype=np.float32)
    whole = [deform(points, steps, before=FRAME, weights=chosen) for chosen in (None, weights)]
    monkeypatch.setattr(stacks, "_BLOCK", 100)
    parts = [deform(points, steps, before=FRAME, weights=chosen) for chosen in (None, weights)]
    assert np.array_equal(whole, parts)


def test_a_stack_that_moves_nothing_gives_the_points_back():
    """Frozen points that nothing moves come back as they are, without a copy; others as a frozen copy."""
    points = freeze(cloud())
    assert deform(points, [Bend(0.0)]) is points
    assert transform_points(IDENTITY, points) is points
    loose = cloud()
    assert deform(loose, []) is not loose
    assert not deform(loose, []).flags.writeable


def test_threads_do_not_disturb_each_other():
    """Several threads may deform at once: none works in the memory of another."""
    points = cloud(60_000)
    steps = [STEPS[name] for name in ("taper", "bend within limits", "twist", "lattice")]
    expected = deform(points, steps)
    with ThreadPoolExecutor(4) as pool:
        answers = [future.result() for future in [pool.submit(deform, points, steps) for _ in range(8)]]
    assert all(np.array_equal(answer, expected) for answer in answers)


@every
def test_steps_are_the_same_by_their_fields(step: Step):
    """Two steps with equal fields are one value to the engine; with another frame they are not."""
    twin = changed(step)
    assert step == twin
    assert hash(step) == hash(twin)
    assert same(step, twin)
    assert step != changed(step, frame=scaling(2.0))
    assert step != "a step"


def test_extents_are_measured_as_by_hand():
    """The extent along the axis is from the centre, in the step's own frame; what needs none has none."""
    points = cloud()
    assert np.allclose(Bend(1.0).extent(points), (points[:, 2].min(), points[:, 2].max()))
    assert np.allclose(Bend(1.0, axis="-z").extent(points), (-points[:, 2].max(), -points[:, 2].min()))
    lifted = Twist(1.0, "y", center=(9, 2, 9)).extent(points)
    assert np.allclose(lifted, (points[:, 1].min() - 2.0, points[:, 1].max() - 2.0))
    along = points @ (np.array((1.0, 2.0, 3.0)) / math.sqrt(14.0))
    assert np.allclose(Twist(1.0, (1, 2, 3)).extent(points), (along.min(), along.max()), atol=1e-6)
    for still in (Bend(0.0), Bend(1.0, lower=0.0, upper=1.0), Wave(1.0, 1.0), Ripple(1.0, 1.0), dented()):
        assert still.extent(points) == (0.0, 0.0)
        assert not still.needs_extent
    assert measured(points, [0.0, 0.0, 0.0, 3.0]) == (3.0, 3.0)


def test_flat_points_have_nothing_to_bend_along():
    """Where the points have no extent along the axis nothing happens."""
    flat = cloud()
    flat[:, 2] = 0.5
    for step in (Bend(1.0), Twist(1.0), Taper(1.0), Skew(1.0)):
        assert np.array_equal(step.map(flat, step.extent(flat)), flat)


def test_wrong_shapes_and_limits_are_named():
    """Points are rows of three, there is a weight for each, limits have something between them, waves a length."""
    with pytest.raises(ShapeError, match=r"points: expected \(V, 3\), got an array of shape \(3,\)"):
        deform(np.zeros(3), [])
    with pytest.raises(ShapeError, match=r"weights: expected \(2,\), got an array of shape \(3,\)"):
        deform(np.zeros((2, 3)), [Twist(1.0)], weights=np.ones(3, np.float32))
    for family in (Bend, Twist, Taper, Skew):
        with pytest.raises(ShapeError, match=r"limits: 1.0 is not below 1.0"):
            family(1.0, lower=1.0, upper=1.0)
    for family in (Wave, Ripple):
        with pytest.raises(ShapeError, match=r"wavelength: 0.0 is not above 0"):
            family(1.0, 0.0)
    with pytest.raises(ShapeError, match="singular"):
        Twist(1.0, frame=scaling((1, 0, 1))).map(cloud(), (0.0, 1.0))
    with pytest.raises(ValueError, match="argument"):
        deform(cloud(), [Twist(1.0)], extents=[])


def test_a_flattening_matrix_may_come_before_and_after():
    """Matrices around a stack need no inverse."""
    points = cloud()
    flat, one = scaling((1, 0, 1)), np.zeros((4, 4))
    one[:3, 0] = one[3, 3] = 1.0
    for matrix in (flat, one):
        expected = transform_points(matrix, points)
        assert np.allclose(expected, points @ matrix[:3, :3].T, atol=1e-6)
        assert np.array_equal(deform(points, [], before=matrix), expected)
        twisted = Twist(1.0).map(expected, Twist(1.0).extent(expected))
        assert np.allclose(deform(points, [Twist(1.0)], before=matrix), twisted, atol=1e-6)
        assert np.allclose(
            deform(points, [Twist(1.0)], after=matrix),
            transform_points(matrix, deform(points, [Twist(1.0)])),
            atol=1e-6,
        )


def test_integers_and_strided_rows_are_points_too():
    """Points may be any numbers in any memory; what is not float32 is worked on in float64."""
    points = cloud(64)
    spread = np.zeros((128, 6), np.float32)
    spread[::2, ::2] = points
    twist = Twist(1.0)
    assert np.array_equal(deform(spread[::2, ::2], [twist]), deform(points, [twist]))
    whole = np.arange(12).reshape(4, 3)
    assert np.array_equal(deform(whole, [twist]), deform(whole.astype(np.float64), [twist]))
