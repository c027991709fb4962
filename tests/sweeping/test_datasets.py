"""Datasets: named dimensions, coordinates that say what they are, and every kind of answer in its own form."""

from pathlib import Path
from typing import Any

import numpy as np
import param
import pytest
import xarray

import reactive4d as r4
from reactive4d import devices
from reactive4d.geometry.files import load
from reactive4d.sweeping import Picture, latin_hypercube, random, zipped

a = r4.Parameter("data_a", 1.0, bounds=(0.0, 4.0), doc="how far [m]")
n = r4.Parameter("data_n", 2, bounds=(1, 5))


class Swing(r4.Illustration):
    """A ball on a string."""

    length = param.Number(1.0, bounds=(0.2, 2.0), doc="length of the string [m]")
    turns = param.Integer(1, bounds=(1, 4))
    shape = param.Selector(default=np.sin, objects={"sine": np.sin, "cosine": np.cos})
    tint = param.Color("#ff0000")
    spot = param.XYCoordinates((0.0, 1.0))
    mass = param.Number(2.0, constant=True)

    def build(self) -> r4.Scene:
        """One ball."""
        p = self.signals
        ball = r4.Sphere(0.1, color=p.tint)
        ball.translate(r4.vec(0, 0, -p.length))
        scene = r4.Scene(ball=ball)
        scene.signals["swung"] = r4.lift(lambda f, t: float(f(t)))(p.shape, r4.time)
        scene.signals["spot"] = p.spot
        scene.signals["turns"] = p.turns
        return scene


def one(measure: Any, over: Any = None, **options: Any) -> Any:
    """The one variable of a sweep."""
    points = {"data_a": [1.0, 2.0]} if over is None else over
    return r4.sweep(r4.Scene(), over=points, measure={"m": measure}, progress=False, **options)["m"]


def test_dimensions_and_coordinates_are_those_that_were_given_with_units_and_docs() -> None:
    """In their order, from the parameters of the class; time in seconds."""
    found = r4.sweep(
        Swing,
        over={"time": np.linspace(0, 1, 3), "length": [0.5, 1.0], "turns": 3},
        measure={"height": "ball.position[2]"},
        progress=False,
    )
    assert isinstance(found, xarray.Dataset)
    assert found["height"].dims == ("time", "length")
    assert found["height"].values.tolist() == [[-0.5, -1.0]] * 3
    assert found["length"].attrs == {"long_name": "length of the string", "units": "m"}
    assert found["time"].attrs == {"long_name": "time", "units": "s"}
    assert (found["turns"].dims, found["turns"].item()) == ((), 3)
    assert found.sel(length=0.5, time=0.5)["height"].item() == -0.5


def test_the_attributes_say_how_it_was_made() -> None:
    """What, with what, when, in which order, how long, and how much came from memory."""
    over = {"length": [0.5, 1.0], "time": [0.0, 1.0]}
    found = r4.sweep(Swing, over=over, measure={"height": "ball.position[2]"}, progress=False)
    assert found.attrs["title"] == "Swing over length, time"
    assert found.attrs["comment"] == "A ball on a string."
    assert found.attrs["source"].startswith("reactive4d ")
    assert found.attrs["points"] == 4
    assert set(found.attrs["order"].split(", ")) == {"length", "time"}
    assert 0.0 <= found.attrs["hits"] <= 1.0
    assert found["height"].attrs["signal"] == "ball.position[2]"


@pytest.mark.parametrize(
    ("measure", "kind", "dims"),
    [
        (a, "float64", ()),
        (a > 1.5, "bool", ()),
        (n * 1, "int64", ()),
        (r4.vec(a, 0, 1), "float64", ("axis",)),
        (r4.lift(lambda x: np.eye(4) * x)(a), "float64", ("row", "column")),
        (r4.lift(lambda x: np.full((2, 5), x))(a), "float64", ("m_0", "m_1")),
        (r4.lift(lambda x: (x, 1, 2, 3, 4))(a), "float64", ("m_0",)),
        (r4.lift(lambda x: complex(x, 1))(a), "complex128", ()),
        (r4.lift(lambda x: f"{x:g} m")(a), "object", ()),
        (r4.lift(lambda x: r4.Rotation.from_axis_angle((0, 0, 1), x))(a), "float64", ("m_0",)),
        (r4.lift(lambda x: np.float32([x, x, x, x, x]))(a), "float32", ("m_0",)),
    ],
)
def test_answers_are_stored_in_their_own_form(measure: Any, kind: str, dims: tuple[str, ...]) -> None:
    """Numbers, truth values, whole numbers, vectors, matrices, tuples, strings, rotations."""
    found = one(measure)
    assert str(found.dtype) == kind
    assert found.dims == ("data_a", *dims)
    for i, value in enumerate((1.0, 2.0)):
        wanted = measure.at(0.0, data_a=value)
        wanted = wanted.as_quaternion() if isinstance(wanted, r4.Rotation) else wanted
        assert np.array_equal(found.values[i], wanted)


def test_vectors_have_axes_and_colours_channels() -> None:
    """With names for their places."""
    ball = r4.Sphere(a, color="red")
    measures = {"p": "ball.position", "box": "ball.bounds", "color": "ball.color"}
    found = r4.sweep(r4.Scene(ball=ball), over={"data_a": [1.0]}, measure=measures, progress=False)
    assert found["p"].sel(axis="z").shape == (1,)
    assert found["box"].dims == ("data_a", "box_0", "axis")
    assert found["color"].sel(channel="r").item() == 1.0


def test_parameters_of_all_kinds_can_be_swept() -> None:
    """Choices go by their names, pairs of numbers have a coordinate for each, colours are strings."""
    over = {"shape": ["sine", np.cos], "spot": [(0, 1), (2, 3)], "tint": ["red", "#00ff00"], "turns": range(1, 4)}
    found = r4.sweep(
        Swing, over={**over, "time": 0.5}, measure={"s": "swung", "xy": "spot", "n": "turns"}, progress=False
    )
    assert found["shape"].values.tolist() == ["sine", "cosine"]
    assert found["s"].sel(shape="cosine").values[0, 0, 0] == np.cos(0.5)
    assert found["tint"].values.tolist() == ["#ff0000", "#00ff00"]
    assert (found["spot_0"].values.tolist(), found["spot_1"].values.tolist()) == ([0.0, 2.0], [1.0, 3.0])
    assert found["xy"].isel(shape=0, tint=0, turns=0).values.tolist() == [[0.0, 1.0], [2.0, 3.0]]
    assert found["n"].dtype == np.int64


def test_one_readers_values_are_where_the_others_stand() -> None:
    """What is not swept is as the reader has it."""
    found = r4.sweep(Swing(length=0.7), over={"turns": [1, 2]}, measure={"z": "ball.position[2]"}, progress=False)
    assert found["z"].values.tolist() == [-0.7, -0.7]


def test_missing_whole_numbers_and_truth_values_make_floats() -> None:
    """And missing strings are empty."""
    where: Any = lambda data_a: data_a > 1  # noqa: E731
    assert np.array_equal(one(n * 1, where=where).values, [np.nan, 2.0], equal_nan=True)
    assert np.array_equal(one(a > 0, where=where).values, [np.nan, 1.0], equal_nan=True)
    assert one(r4.lift(str)(a), where=where).values.tolist() == ["", "2.0"]


def test_none_is_no_answer_and_nan_is_one() -> None:
    """Neither is an error."""
    found = r4.sweep(
        r4.Scene(),
        over={"data_a": [1.0, 2.0]},
        measure={"none": r4.lift(lambda x: None if x > 1 else 7)(a), "nan": r4.lift(lambda x: float("nan"))(a)},
        progress=False,
    )
    assert "error" not in found
    assert np.array_equal(found["none"].values, [7.0, np.nan], equal_nan=True)
    assert found["nan"].isnull().all()


def test_a_first_point_left_out_or_failed_does_not_decide_the_kind() -> None:
    """Whole numbers stay whole, vectors vectors, whatever comes first."""
    late = r4.lift(lambda x: None if x < 2 else np.array([x, x, x]))(a)
    found = one(late, over={"data_a": [1.0, 2.0, 3.0]})
    assert found.dims == ("data_a", "axis")
    assert found.values[1].tolist() == [2.0, 2.0, 2.0]
    mixed = one(r4.lift(lambda x: 1 if x < 2 else 2.5)(a), over={"data_a": [1.0, 2.0]})
    assert mixed.values.tolist() == [1.0, 2.5]


def test_meshes_go_into_files_one_for_each_content(tmp_path: Path) -> None:
    """Their paths stand in the dataset."""
    ball = r4.Sphere(a / 2)
    over = {"data_a": [1.0, 2.0], "time": [0.0, 1.0, 2.0]}
    scene = r4.Scene(ball=ball)
    found = r4.sweep(scene, over=over, measure={"it": "ball.mesh"}, files=tmp_path / "out", progress=False)
    paths = found["it"].values
    assert [len(set(row)) for row in paths.tolist()] == [1, 1]
    assert sorted(map(str, (tmp_path / "out").iterdir())) == sorted(set(paths.reshape(-1)))
    assert np.allclose(load(paths[1, 0]).points.max(), 1.0, atol=1e-3)


def test_pictures_are_drawn_once_for_every_frame(tmp_path: Path) -> None:
    """By the device for stills; a frame that stands still is drawn once."""
    drawn: list[tuple[float, dict[str, Any]]] = []

    def render(thing: Any, path: Path, *, t: float, size: tuple[int, int], parameters: Any, edges: bool) -> None:
        drawn.append((t, parameters))
        assert (size, edges) == ((80, 60), True)
        Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + repr(parameters).encode())

    before = devices.exchange("render", render)
    try:
        found = r4.sweep(
            r4.Scene(ball=r4.Sphere(a / 2)),
            over={"data_a": [1.0, 2.0], "time": [0.0, 1.0, 2.0]},
            measure={"picture": Picture(size=(80, 60), options={"edges": True})},
            files=tmp_path,
            progress=False,
        )
    finally:
        devices.exchange("render", before)
    assert [given for _, given in drawn] == [{"data_a": 1.0}, {"data_a": 2.0}]
    assert all(Path(path).read_bytes().startswith(b"\x89PNG") for path in found["picture"].values.reshape(-1))


def test_zipped_parameters_share_a_dimension() -> None:
    """Which is called as it stands in `over`; each of them is a coordinate along it."""
    found = one(a * n, over={"case": zipped(data_a=[1.0, 2.0, 3.0], data_n=[1, 1, 4])})
    assert found.dims == ("case",)
    assert found.values.tolist() == [1.0, 2.0, 12.0]
    assert found["data_n"].dims == ("case",)


def test_designs_draw_the_same_points_again() -> None:
    """From ranges, from lists, and from the bounds of the parameters; whole numbers stay whole."""
    for design in (random, latin_hypercube):
        twice = [one(a * n, over={"i": design(40, seed=3, data_a=None, data_n=None)}) for _ in range(2)]
        assert np.array_equal(twice[0], twice[1])
        assert twice[0]["data_n"].dtype == np.int64
        assert set(twice[0]["data_n"].values) == {1, 2, 3, 4, 5}
        assert twice[0]["data_a"].min() >= 0.0
        assert twice[0]["data_a"].max() <= 4.0
    other = one(a * n, over={"i": random(40, seed=4, data_a=(1, 2), data_n=[1, 3])})
    assert set(other["data_n"].values) == {1, 3}


def test_a_latin_hypercube_has_one_point_in_each_part() -> None:
    """Of the range of every parameter."""
    found = one(a, over={"i": latin_hypercube(16, data_a=(0.0, 4.0))})
    assert sorted((found["data_a"].values * 4).astype(int)) == list(range(16))


def test_a_dataset_can_be_written_and_read_again(tmp_path: Path) -> None:
    """By xarray itself, in Zarr."""
    found = r4.sweep(
        Swing, over={"length": [0.5, 1.0], "shape": ["sine"]}, measure={"p": "ball.position"}, progress=False
    )
    found.to_zarr(tmp_path / "out.zarr", consolidated=False)
    with xarray.open_zarr(tmp_path / "out.zarr", consolidated=False) as again:
        assert np.array_equal(again["p"], found["p"])


def test_values_may_come_from_any_array() -> None:
    """From a dataset, from pandas, from a generator."""
    first = one(a, over={"data_a": [1.0, 2.0]})
    for values in (first["data_a"], first["data_a"].to_index(), (x for x in (1.0, 2.0)), {1.0: "a", 2.0: "b"}.keys()):
        assert one(a, over={"data_a": values}).values.tolist() == [1.0, 2.0]
    assert one(a, over={"data_a": first["data_a"][1]}).item() == 2.0
    with pytest.raises(r4.ParameterError, match="expected a number"):
        one(a, over={"data_a": a})


def test_an_illustration_may_read_parameters_besides_its_own() -> None:
    """They are found below the measures."""

    class Odd(r4.Illustration):
        """Reads a parameter that is not declared in it."""

        b = param.Number(1.0)

        def build(self) -> r4.Scene:
            scene = r4.Scene()
            scene.signals["m"] = self.signals.b * a
            return scene

    found = r4.sweep(Odd, over={"b": [1.0, 2.0], "data_a": [3.0, 4.0]}, measure={"m": "m"}, progress=False)
    assert found["m"].values.tolist() == [[3.0, 4.0], [6.0, 8.0]]
    assert found["data_a"].attrs["units"] == "m"
