"""Whatever is done to whatever: random kinds, changed at random, are finite or say what is wrong, and never crash."""

import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

import reactive4d as r4
from reactive4d.geometry import lattices

t = r4.time
CHANNELS = (
    *("mesh", "volume", "area", "center_of_mass", "inertia", "bounds", "normals", "uv", "outline"),
    *("matrix", "position", "methods", "look", "paint", "notes", "solid"),
)
KINDS: list[Callable[[], r4.Object]] = [
    *(r4.Box, r4.Plane, r4.Polyhedron, r4.Path, r4.Line, r4.Rectangle, r4.Ngon, r4.Star, r4.Prism, r4.Duct),
    *(r4.Group, r4.Hull, r4.Model, r4.Combination, r4.Camera, r4.Light, r4.Label, r4.Point, r4.Object),
    lambda: r4.Sphere(segments=6, rings=4),
    lambda: r4.Cylinder(segments=6),
    lambda: r4.Cone(segments=6),
    lambda: r4.Torus(segments=6, sides=5),
    lambda: r4.Tube(segments=6),
    lambda: r4.Quadric(segments=6, stacks=3),
    lambda: r4.Superquadric(segments=6, rings=4, toroidal=0.5, size=0.2),
    lambda: r4.Teapot(segments=1),
    lambda: r4.Revolution(segments=5),
    lambda: r4.Patch(segments=2),
    lambda: r4.Blob(resolution=6),
    lambda: r4.Lettering("i", segments=1),
    lambda: r4.Helix(segments=6),
    lambda: r4.Circle(segments=6),
    lambda: r4.Box() - r4.Sphere(0.6, segments=6, rings=4),
    lambda: r4.Group(a=r4.Box(), b=r4.Light(), c=r4.Cone(segments=5)),
]
some = st.sampled_from([0.0, 1e-9, 0.5, -0.7, 1.0, 30.0, -400.0])
three = st.tuples(some, some, some)
ways = st.sampled_from(["x", "y", "z", (1, 2, 3)])
numbers = st.one_of(some, st.sampled_from([t, r4.keys({0: 0.0, 2: 1.0})]))
changes = st.one_of(
    st.builds(r4.Translate, three),
    st.builds(lambda a, w, c: r4.Rotate(a, axis=w, center=c), numbers, ways, three),
    st.builds(r4.Scale, st.one_of(some, three)),
    st.builds(lambda v, w: r4.Shear(v, axis=w), three, ways),
    st.builds(r4.Mirror, ways),
    st.builds(r4.LookAt, three),
    st.builds(lambda a, d, w: r4.Bend(a, direction=d, axis=w), numbers, some, ways),
    st.builds(lambda a, w: r4.Twist(a, axis=w, bias=1.0), numbers, ways),
    st.builds(lambda a, w: r4.Taper(a, axis=w, curve=0.3, is_symmetric=True), numbers, ways),
    st.builds(lambda a, w: r4.Skew(a, axis=w, lower=-0.2), numbers, ways),
    st.builds(lambda a, w: r4.Wave(a, axis=w, wavelength=0.7), numbers, ways),
    st.builds(lambda a, w: r4.Ripple(a, axis=w, decay=2.0), numbers, ways),
    st.builds(lambda v: r4.FreeForm(lattices.lattice((-1, -1, -1), (1, 1, 1), (2, 3, 2)) * v), three),
    st.builds(lambda o, a, f: r4.XForm(offset=o, angle=a, factor=f), three, numbers, three),
    st.builds(lambda make: r4.LinkedXForm(make()), st.sampled_from(KINDS)),
    st.builds(r4.Extrude, numbers),
    st.builds(
        lambda a, w: r4.Lathe(a, axis=w, center=(2, 2, 0), segments=5), st.sampled_from([0.0, 90.0, 360.0]), ways
    ),
    st.builds(lambda make: r4.Become(type(make())), st.sampled_from(KINDS)),
    st.builds(lambda w: r4.MapTexture("spherical", axis=w), st.sampled_from(["x", "y", "z"])),
    st.builds(r4.Color, st.just("red")),
)
orders = st.tuples(st.sampled_from(KINDS), st.lists(st.tuples(changes, st.booleans()), max_size=4), st.booleans())


def made(order: Any) -> r4.Object:
    """An object with its changes, some of which act from 1 s on; or an extension of such a one."""
    make, todo, extended = order
    obj = make()
    for change, later in todo:
        if later:
            change.enabled = t >= 1
        obj.apply(change)
    return obj.extend() if extended else obj


def is_sound(value: Any) -> bool:
    """Whether all numbers in an answer are finite."""
    if isinstance(value, r4.Mesh):
        return all(map(is_sound, (value.points, *value.attributes.values())))
    return not isinstance(value, np.ndarray | float) or bool(np.isfinite(value).all())


def answers(obj: r4.Object) -> None:
    """Ask for all that one can ask for; it is finite, or the library says what is wrong."""
    questions: list[Any] = [getattr(obj, name) for name in CHANNELS]
    questions += [obj.intersect((0.1, 0.2, 5), (0, 0, -1)), obj.contains((0, 0, 0)), r4.Scene(it=obj).frame]
    for at in (0.0, 2.0):
        for question in questions:
            try:
                assert is_sound(question.at(at)), question.name
            except r4.Reactive4dError as error:
                assert len(str(error)) > 10, question.name  # noqa: PT017


@given(orders)
@settings(max_examples=100)
def test_a_kind_whatever_is_done_to_it(order: Any) -> None:
    """F001, F020–F079: any kind with any changes, at any time: every answer is finite, or an error of ours."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        answers(made(order))


@given(orders, orders, st.sampled_from(["|", "&", "-"]))
@settings(max_examples=60)
def test_an_aggregate_whatever_it_is_made_of(first: Any, second: Any, operation: str) -> None:
    """F032, F033: combinations, groups and hulls of any such objects: finite, or an error of ours."""
    a, b = made(first), made(second)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for aggregate in (r4.Combination([a, operation, b]), r4.Group([a, b]), r4.Hull([a, b])):
            answers(aggregate)
