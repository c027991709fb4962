"""What is refused, and in which words; and what goes wrong at some points."""

from typing import Any

import numpy as np
import param
import pytest

import reactive4d as r4
from reactive4d.sweeping import SweepWarning, latin_hypercube, random, zipped

x = r4.Parameter("fail_x", 1.0, bounds=(0.0, 4.0))


class Rod(r4.Illustration):
    """A rod."""

    length = param.Number(1.0, bounds=(0.2, 2.0))
    count = param.Integer(1)
    mass = param.Number(2.0, constant=True)
    mode = param.Selector(objects=["slow", "fast"])

    def build(self) -> r4.Scene:
        """One cylinder."""
        return r4.Scene(rod=r4.Cylinder(0.1, self.signals.length))


def refused(over: Any = None, measure: Any = None, subject: Any = Rod, **options: Any) -> str:
    """The error of a sweep with its hints."""
    over = {"length": [1.0]} if over is None else over
    measure = {"m": "rod.volume"} if measure is None else measure
    with pytest.raises(Exception) as caught:  # noqa: PT011  its words are what is tested
        r4.sweep(subject, over=over, measure=measure, **{"progress": False, **options})
    return "\n".join([type(caught.value).__name__ + ": " + str(caught.value), *getattr(caught.value, "__notes__", ())])


@pytest.mark.parametrize(
    ("over", "says"),
    [
        ({"lenght": [1.0]}, ["unknown parameter 'lenght'", "did you mean 'length'", "'count', 'length'"]),
        ({}, ["over: expected values by parameter, got {}", "over={"]),
        ([1, 2], ["expected values by parameter"]),
        ({"length": []}, ["length: no values"]),
        ({"length": np.array([])}, ["length: no values"]),
        ({"time": []}, ["time: no values"]),
        ({"length": [1.0, 3.0]}, ["length", "at most 2.0, not 3.0", "2. of the 2 values"]),
        ({"length": [float("nan")]}, ["length", "nan"]),
        ({"length": "long"}, ["length", "numeric"]),
        ({"count": [1, 1.5]}, ["count", "integer"]),
        ({"mode": ["slow", "fats"]}, ["mode", "fats"]),
        ({"mass": [1.0]}, ["mass is constant"]),
        ({"time": [0.0, float("nan")]}, ["TimeError", "nan is not a time"]),
        ({"time": "soon"}, ["TimeError", "soon"]),
        ({"time": [[0.0]]}, ["TimeError", "(1, 1)"]),
        ({"case": zipped(length=[1.0], lenght=[2.0])}, ["unknown parameter 'lenght'"]),
        ({"length": [1.0], "case": zipped(length=[1.0])}, ["length is moved twice"]),
        ({"time": 1.0, "case": zipped(time=[1.0])}, ["time is moved twice"]),
        ({"length": zipped(length=[1.0], count=[1])}, ["'length' is no name for the dimension"]),
        ({"i": random(3, length=(3.0, 1.0))}, ["length: expected (lowest, highest)"]),
        ({"i": latin_hypercube(3, count=None)}, ["count: expected (lowest, highest)", "got None"]),
    ],
)
def test_points_that_cannot_be(over: Any, says: list[str]) -> None:
    """Unknown names, no values, values that the parameter does not take, one parameter in two places."""
    told = refused(over)
    assert all(part in told for part in says), told


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: zipped(), "zipped: no parameters"),
        (lambda: zipped(a=[1], b=[1, 2]), "1 of a, 2 of b"),
        (lambda: random(0, a=(0, 1)), "expected a number of points, got 0"),
        (lambda: latin_hypercube(5), "no parameters"),
    ],
)
def test_designs_that_cannot_be(make: Any, says: str) -> None:
    """They are refused where they are made."""
    with pytest.raises(r4.ParameterError, match=says):
        make()


@pytest.mark.parametrize(
    ("measure", "says"),
    [
        ({}, ["measure: expected what to ask for by name"]),
        (["rod.volume"], ["measure: expected what to ask for by name"]),
        ({"m": 3}, ["measure 'm': expected a signal, got 3", "a path"]),
        ({"m": lambda scene: scene["rod"].volume.at(0)}, ["expected a signal, got 0.0", "without .at(t)"]),
        ({"m": lambda scene: scene["rod"]}, ["expected a signal, got the object rod", "rod.volume"]),
        ({"m": lambda scene: scene["rdo"].volume}, ["'rdo'", "did you mean 'rod'", "while making the measure 'm'"]),
        ({"m": "rdo.volume"}, ["unknown object 'rdo'", "did you mean 'rod'"]),
        ({"m": "rod.volmue"}, ["unknown attribute of rod 'volmue'", "did you mean 'volume'"]),
        ({"m": "rod.apply"}, ["unknown attribute of rod 'apply'"]),
        ({"m": "rod..volume"}, ["is not a path"]),
        ({"length": "rod.volume"}, ["the name 'length' is taken"]),
        ({"error": "rod.volume"}, ["the name 'error' is taken"]),
        ({"m": lambda scene: r4.lift(lambda t: {"a": t})(r4.time)}, ["{'a': 0.0}, a dict cannot be stored"]),
        ({"m": lambda scene: scene["rod"].mesh}, ["nobody said where", "files="]),
    ],
)
def test_measures_that_are_none(measure: Any, says: list[str]) -> None:
    """No signals, no objects, no names, nothing that could be stored."""
    told = refused(measure=measure)
    assert all(part in told for part in says), told


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"where": 3}, ["where: expected a function"]),
        ({"where": lambda lenght: True}, ["unknown argument of where 'lenght'", "'length'"]),
        ({"where": lambda length: np.array([True, False])}, ["expected True or False", "one point at a time"]),
        ({"where": lambda length: 1 / 0}, ["ZeroDivisionError", "in where(length=1.0)"]),
        ({"errors": "ignore"}, ["errors: expected 'keep' or 'raise'"]),
        ({"workers": 0}, ["workers: expected a number of processes, got 0"]),
        ({"workers": 2, "client": object()}, ["expected one of them"]),
        ({"client": "tcp://localhost:8786"}, ["client: expected a dask.distributed.Client"]),
        ({"progress": "yes"}, ["progress: expected True, False or a function"]),
    ],
)
def test_options_that_cannot_be(options: Any, says: list[str]) -> None:
    """Each is refused with its value, and before anything is computed."""
    told = refused(**options)
    assert all(part in told for part in says), told


@pytest.mark.parametrize("subject", [3, "scene", r4.Scene, r4.Sphere, [Rod]])
def test_subjects_that_are_none(subject: Any) -> None:
    """An illustration, a scene, or a function that makes one."""
    assert "expected an Illustration, a Scene, or a function" in refused(subject=subject)


def test_a_function_must_answer_a_scene() -> None:
    """It is called once."""
    assert "answered 3, expected a Scene" in refused(subject=lambda: 3)


def test_in_a_scene_any_parameter_will_do_that_is_there() -> None:
    """What a Python function reads is seen only when it runs; a name that nobody has is refused."""
    hidden = r4.signal(lambda: 2 * x.now())
    found = r4.sweep(r4.Scene(), over={"fail_x": [1.0, 2.0]}, measure={"m": hidden}, progress=False)
    assert found["m"].values.tolist() == [2.0, 4.0]
    told = refused({"fial_x": [1.0]}, {"m": hidden}, r4.Scene())
    assert "unknown parameter 'fial_x'" in told
    assert "not within" in refused({"fail_x": [9.0]}, {"m": x}, r4.Scene())


# -- at some points ------------------------------------------------------------------------------------------------


def broken(value: float) -> float:
    """Raises for large values."""
    if value > 2:
        raise ValueError(f"{value:g} is too much")
    return value


def test_an_error_at_a_point_leaves_it_out_and_is_told() -> None:
    """The point is missing, the dataset has the message, a summary says how many and which."""
    measures = {"m": r4.lift(broken)(x) * r4.time, "other": x + r4.time}
    over = {"fail_x": [1.0, 3.0, 4.0], "time": [0.0, 1.0]}
    with pytest.warns(SweepWarning) as warned:
        found = r4.sweep(r4.Scene(), over=over, measure=measures, progress=False)
    assert np.array_equal(found["m"].isnull(), [[False, False], [True, True], [True, True]])
    assert not found["other"].isnull().any()
    assert found["error"].sel(fail_x=3.0, time=1.0).item() == "m: ValueError: 3 is too much"
    assert found["error"].sel(fail_x=1.0, time=1.0).item() == ""
    assert found.attrs["failed"] == 4
    assert str(warned[0].message) == found.attrs["summary"]
    assert found.attrs["summary"] == (
        "4 of 6 points failed; m: ValueError: 3 is too much (2 points: fail_x=3, time=0 to 1); "
        "m: ValueError: 4 is too much (2 points: fail_x=4, time=0 to 1)"
    )
    assert warned[0].filename == __file__


def test_an_error_can_stop_the_sweep() -> None:
    """It is the error itself, with the point in its notes."""
    over = {"fail_x": [1.0, 3.0, 4.0], "time": [0.0, 1.0]}
    with pytest.raises(ValueError, match="3 is too much") as caught:
        r4.sweep(r4.Scene(), over=over, measure={"m": r4.lift(broken)(x)}, errors="raise", progress=False)
    assert "while measuring m at fail_x=3.0, time=0.0" in caught.value.__notes__


def test_a_sweep_whose_points_all_fail_is_still_one() -> None:
    """All is missing."""
    with pytest.warns(SweepWarning, match="2 of 2 points failed"):
        found = r4.sweep(r4.Scene(), over={"fail_x": [3.0, 4.0]}, measure={"m": r4.lift(broken)(x)}, progress=False)
    assert found["m"].isnull().all()


def test_points_fail_where_the_answer_is_of_another_kind() -> None:
    """A vector where numbers are expected, a string, something that cannot be stored."""
    odd = r4.lift(lambda v: {1.0: 1.5, 2.0: "two", 3.0: np.zeros(3), 4.0: object()}[v])(x)
    with pytest.warns(SweepWarning, match="3 of 4 points failed"):
        found = r4.sweep(r4.Scene(), over={"fail_x": [1.0, 2.0, 3.0, 4.0]}, measure={"m": odd}, progress=False)
    assert np.array_equal(found["m"], [1.5, np.nan, np.nan, np.nan], equal_nan=True)
    told = found["error"].values.tolist()
    assert told[1] == "m: ShapeError: m: expected a number, as before, got a string"
    assert "array of numbers of shape (3,)" in told[2]
    assert "cannot be stored" in told[3]


def test_an_interrupt_goes_through() -> None:
    """It is no error of a point."""

    def interrupted(value: float) -> float:
        if value > 2:
            raise KeyboardInterrupt
        return value

    with pytest.raises(KeyboardInterrupt):
        r4.sweep(r4.Scene(), over={"fail_x": [1.0, 2.0, 3.0]}, measure={"m": r4.lift(interrupted)(x)}, progress=False)


def test_a_sweep_inside_of_an_evaluation_is_refused() -> None:
    """What it finds could not be known to depend on anything."""

    @r4.signal
    def nested() -> float:
        return r4.sweep(r4.Scene(), over={"fail_x": [1.0]}, measure={"m": x}, progress=False)["m"].item()

    with pytest.raises(r4.errors.EvaluationError, match="inside of the evaluation of nested"):
        nested.at(0.0)
