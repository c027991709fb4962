"""Real signals and objects, lowered: what a viewer meets in pages, for the conformance vectors."""

from collections.abc import Iterator
from itertools import product
from typing import Any, TypeAlias

import numpy as np

from reactive4d.model.kinds.boxes import Box
from reactive4d.model.kinds.spheres import Sphere
from reactive4d.model.kinds.views import Camera
from reactive4d.model.transforms import LookAt, Orient, Scale, Shear
from reactive4d.signals import warps
from reactive4d.signals.algebra import vec
from reactive4d.signals.choices import where
from reactive4d.signals.easings import EASINGS
from reactive4d.signals.keys import Keys, keys
from reactive4d.signals.rotations import Rotation
from reactive4d.signals.sources import Parameter, time
from reactive4d_widgets.lowering.exact import lower, lower_matrix
from reactive4d_widgets.lowering.fits import fit, fit_rotation
from reactive4d_widgets.lowering.numerals import Array

__all__ = ["lowered_matrices", "lowered_tracks"]

Specimen: TypeAlias = tuple[str, dict[str, Any], list[dict[str, Any]]]
_NOTHING: list[dict[str, Any]] = [{}]
_TIMES = (-0.5, 0.25, 1.0, 2.5)
_OUTSIDE: Any = ("hold", "linear", "cycle", "cycle_offset", "oscillate")


def lowered_tracks() -> Iterator[Specimen]:
    """Names, tracks of signals, and parameters to play them with."""
    for name, signal in _keyed():
        yield name, _made(lower(signal)), _NOTHING
    for name, signal, given in _calculated():
        yield name, _made(lower(signal)), given
    yield "fitted wave", _made(_fitted(_waving)), _NOTHING
    turning = fit_rotation(_turning, 0.0, 3.0)
    assert turning is not None
    yield "fitted turns", turning.track, _NOTHING


def _made(found: dict[str, Any] | None) -> dict[str, Any]:
    assert found is not None
    return found


def _fitted(function: Any) -> dict[str, Any] | None:
    made = fit(function, 0.0, 3.0, tolerance=1e-3)
    return None if made is None else made.track


def _waving(times: Array) -> Array:
    return np.stack([np.sin(times), np.cos(3 * times)], axis=1)


def _turning(times: Array) -> Array:
    turns = [Rotation.from_axis_angle((1, 2, t), 90 * t).as_quaternion() for t in times.tolist()]
    return np.array(turns)


def _along(values: Any, **settings: Any) -> Keys[Any]:
    return keys(dict(zip(_TIMES, values, strict=True)), **settings)


def _keyed() -> Iterator[tuple[str, Any]]:
    numbers = (0.5, 2.0, -1.0, 1.5)
    vectors = ((0.1, 0, 1), (2, 0.7, 1), (3, 2, 0), (0, 0, 0.9))
    colors = ("red", "#00f8", "#00f8", "gold")
    turns = [Rotation.from_axis_angle((1, i, 2), 80 * i) for i in range(4)]
    for interpolation in ("step", "linear", "catmull_rom", "catmull_rom_centripetal", "tcb", "hermite", "bspline"):
        yield f"keys of numbers, {interpolation}", _along(numbers, interpolation=interpolation)
        yield f"keys of vectors, {interpolation}", _along(vectors, interpolation=interpolation)
    for interpolation in ("step", "linear", "catmull_rom"):
        yield f"keys of colours, {interpolation}", _along(colors, interpolation=interpolation)
    for ease in EASINGS:
        yield f"eased {ease}", _along(numbers, ease=ease)
    for ease in ("in_sine", "in_out_back", "out_bounce", "in_elastic"):
        yield f"eased cubics {ease}", _along(vectors, ease=ease, interpolation="catmull_rom")
        yield f"eased turns {ease}", _along(turns, ease=ease)
    for before, after in product(_OUTSIDE, repeat=2):
        yield f"before {before}, after {after}", _along(numbers, before=before, after=after)
    for outside in ("hold", "linear", "cycle", "oscillate"):
        yield f"turns outside {outside}", _along(turns, before=outside, after=outside)
    yield "words", _along(("a", "b", "a", "c"), before="cycle", after="oscillate")
    yield "truth", _along((True, False, False, True), kind="held")
    yield "slope of keys", _along(vectors, interpolation="catmull_rom", after="cycle").derivative()
    yield "area of keys", _along(numbers, interpolation="catmull_rom", after="linear").integral(0.5)


def _calculated() -> Iterator[tuple[str, Any, list[dict[str, Any]]]]:
    length: Parameter[float] = Parameter("length", 1.0)
    angle: Parameter[float] = Parameter("angle", 20.0)
    two = [{"length": 1.0, "angle": 20.0}, {"length": 0.3, "angle": -75.0}]
    swing = angle * np.cos(np.sqrt(9.81 / length) * time)
    wave: Any = np.sin(3 * time)
    curve = keys({0: 0.0, 1: 2.0, 3: -1.0}, interpolation="catmull_rom")
    yield "swing", swing, two
    yield "bouncing", 2 * np.abs(np.sin(np.pi * time)), _NOTHING
    yield "chosen", where(time < 1, wave, vec(time, 2)[0]), _NOTHING
    yield "keys of signals", keys({0: wave, 2: time, 3: 1.0}, ease="in_out"), _NOTHING
    yield "keys of places", keys({0: vec(time, 0, 1), 2: (1, 2, 3)}, interpolation="catmull_rom"), _NOTHING
    yield "derivative", (wave * time / (2 + wave)).derivative(), _NOTHING
    for name, warped in (
        ("delay", curve.delay(0.75)),
        ("stretch", curve.stretch(-1.7, about=0.5)),
        ("repeat", curve.repeat(1.3, start=-0.5)),
        ("hold", curve.hold(0.25, 2.5)),
        ("creep", warps.creep(curve, 0, 2, speed=3.0)),
        ("slow in and out", warps.slow_in_out(curve, 0, 3, slow_in=1.5, slow_out=4.0)),
        ("frames", warps.discrete(curve, 12.5)),
        ("warp", curve.warp(2 * wave)),
    ):
        yield f"warped by {name}", warped, _NOTHING
    yield "delayed by a reader", curve.delay(length), two


def lowered_matrices() -> Iterator[Specimen]:
    """The same for matrices of objects."""
    length: Parameter[float] = Parameter("length", 1.0)
    turn = keys({0: Rotation(), 2: Rotation.from_axis_angle((1, 2, 3), 130)}, ease="in_out")
    ball, eye, camera, box = Sphere(), Box(), Camera(position=vec(time, 5, 2), target=(0, 0, time)), Box()
    ball.translate(vec(0, 0, -length))
    ball.rotate(20 * np.cos(np.sqrt(9.81 / length) * time), axis="y")
    eye.apply(Shear((0.5, 0, 0)))
    eye.translate((0, 0, time))
    eye.apply(LookAt(ball.position, forward="y"))
    camera.rotate(keys({0: 0, 2: 90}, ease="in_out_sine"))
    box.apply(Orient(turn, center=(0, 1, 0)))
    box.apply(Scale(keys({0: 1.0, 2: 3.0}), center=vec(time, 1, 1)))
    box.translate((1, 0, 0), enabled=time < 1)
    two = [{"length": 1.0}, {"length": 0.3}]
    for name, obj, given in (("ball", ball, two), ("eye", eye, two), ("camera", camera, _NOTHING)):
        yield f"matrix of a {name}", _made(lower_matrix(obj)), given
    yield "matrix of a box for a while", _made(lower_matrix(box)), _NOTHING
