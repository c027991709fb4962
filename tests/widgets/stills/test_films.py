"""Films show what stills show, as long as their span lasts, in formats that others read."""

from pathlib import Path
from typing import Any

import numpy as np
import param
import pytest
from PIL import Image

import reactive4d as r4
from reactive4d_widgets.films import film
from reactive4d_widgets.stills import render

pytestmark = pytest.mark.usefixtures("opengl")

SIZE = (160, 120)
FRONT = {"position": (0, -8, 0), "target": (0, 0, 0)}
ENDS = ("gif", "webp", "mp4")


def moving() -> r4.Scene:
    """A ball that goes to the right, and a box that stays."""
    ball = r4.Sphere(radius=0.5, color="crimson")
    ball.translate(r4.keys({0: (-2, 0, 1), 2: (2, 0, 1)}))
    return r4.Scene(ball=ball, box=r4.Box(color="steelblue"))


def pictures(path: Path) -> list[Any]:
    """Each (H, W, 3), all pictures of a film."""
    if path.suffix == ".mp4":
        av: Any = pytest.importorskip("av")
        with av.open(str(path)) as container:
            return [frame.to_ndarray(format="rgb24").astype(int) for frame in container.decode(video=0)]
    with Image.open(path) as image:
        found: list[Any] = []
        for i in range(getattr(image, "n_frames", 1)):
            image.seek(i)
            found.append(np.asarray(image.convert("RGB")).astype(int))
        return found


def seconds(path: Path) -> float:
    """How long a film lasts."""
    if path.suffix == ".mp4":
        av: Any = pytest.importorskip("av")
        with av.open(str(path)) as container:
            return container.duration / 1e6
    with Image.open(path) as image:
        total = 0
        for i in range(getattr(image, "n_frames", 1)):
            image.seek(i)
            image.load()
            total += image.info["duration"]
        return total / 1000.0


def red_columns(picture: Any) -> Any:
    """In which columns the ball is."""
    red, green, blue = np.moveaxis(picture, 2, 0)
    return np.flatnonzero(((red > green + 60) & (red > blue + 60)).any(axis=0))


@pytest.mark.parametrize("end", ENDS)
def test_a_film_shows_its_span_from_the_start_to_the_end(end: str, tmp_path: Path):
    """So many pictures per second, of so long: the ball goes on from each to the next."""
    if end == "mp4":
        pytest.importorskip("av")
    path = tmp_path / f"film.{end}"
    moving().render(path, times=(0, 2), rate=5, size=SIZE, camera=FRONT)
    found = pictures(path)
    assert len(found) == 10
    assert {picture.shape for picture in found} == {(120, 160, 3)}
    assert seconds(path) == pytest.approx(2.0)
    middles = [red_columns(picture).mean() for picture in found]
    assert (np.diff(middles) > 1).all()
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("end", ENDS)
def test_a_picture_of_a_film_is_the_still_of_its_instant(end: str, tmp_path: Path):
    """As near as its format allows; and the paper is white all over."""
    if end == "mp4":
        pytest.importorskip("av")
    film(moving(), tmp_path / f"film.{end}", times=[0.0, 0.5, 1.5], size=SIZE, camera=FRONT)
    for t, picture in zip((0.0, 0.5, 1.5), pictures(tmp_path / f"film.{end}"), strict=True):
        render(moving(), tmp_path / "still.png", t=t, size=SIZE, camera=FRONT)
        still = np.asarray(Image.open(tmp_path / "still.png").convert("RGB")).astype(int)
        assert np.abs(picture - still).mean() < 2.0
        assert np.abs(picture[:10] - 255).max() <= 3


def test_durations_add_up_where_a_format_counts_in_hundredths(tmp_path: Path):
    """30 pictures per second are 3.33 hundredths each: the film lasts a second all the same."""
    film(moving(), tmp_path / "film.gif", times=(0, 1), rate=30, size=SIZE)
    assert len(pictures(tmp_path / "film.gif")) == 30
    assert seconds(tmp_path / "film.gif") == pytest.approx(1.0)


@pytest.mark.parametrize("end", ENDS)
@pytest.mark.parametrize("loop", [True, False])
def test_a_film_of_what_rests_lasts_as_long(end: str, loop: bool, tmp_path: Path):
    """Encoders make one picture of many that are alike; it is shown for as long as they would be."""
    if end == "mp4":
        pytest.importorskip("av")
    path = tmp_path / f"film.{end}"
    film(r4.Scene(box=r4.Box()), path, times=(0, 3), rate=5, size=(161 - (end == "mp4"), 120), loop=loop)
    assert seconds(path) == pytest.approx(3.0)
    render(r4.Scene(box=r4.Box()), tmp_path / "still.png", size=(161 - (end == "mp4"), 120))
    still = np.asarray(Image.open(tmp_path / "still.png").convert("RGB")).astype(int)
    assert np.abs(pictures(path)[0] - still).mean() < 2.0
    if end != "mp4":
        with Image.open(path) as image:
            assert image.info.get("loop") in ({0} if loop else {1, None})


@pytest.mark.parametrize("end", ["gif", "webp"])
def test_moving_pictures_begin_again_unless_told_otherwise(end: str, tmp_path: Path):
    """0 is for ever; without a word a GIF is played once."""
    for loop, says in ((True, {0}), (False, {1, None})):
        film(moving(), tmp_path / f"film.{end}", times=(0, 1), rate=3, size=SIZE, loop=loop)
        with Image.open(tmp_path / f"film.{end}") as image:
            assert image.info.get("loop") in says


def test_times_may_run_backwards(tmp_path: Path):
    """One time for each picture, in whichever order."""
    film(moving(), tmp_path / "film.webp", times=np.linspace(2, 0, 4), size=SIZE, camera=FRONT)
    middles = [red_columns(picture).mean() for picture in pictures(tmp_path / "film.webp")]
    assert (np.diff(middles) < -1).all()


def test_without_times_it_is_the_span_of_the_scene(tmp_path: Path):
    """From the first key to the last; what rests all the time makes one picture that lasts."""
    film(moving(), tmp_path / "film.webp", rate=2, size=SIZE)
    assert len(pictures(tmp_path / "film.webp")) == 4
    still = r4.Scene(box=r4.Box())
    still.times = 0, 2
    film(still, tmp_path / "still.gif", rate=2, size=SIZE)
    assert seconds(tmp_path / "still.gif") == pytest.approx(2.0)
    film(still, tmp_path / "still.webp", rate=2, size=SIZE)
    assert len(pictures(tmp_path / "still.webp")) == 1


class Rod(r4.Illustration):
    """A rod of some length, which turns."""

    length = param.Number(1.0, bounds=(0.5, 3.0))
    rate = param.Number(1.0, bounds=(0.5, 3.0))
    hue = param.Selector(default="red", objects=["red", "blue"])

    def build(self) -> r4.Scene:
        """A cylinder."""
        rod = r4.Cylinder(0.2, self.signals.length, color=self.signals.hue)
        rod.rotate(0 * self.signals.rate + r4.time, axis="y")
        return r4.Scene(rod=rod)


def heights(path: Path) -> list[int]:
    """How high what is drawn is in each picture."""
    inked = [np.abs(picture - picture[0, 0]).max(axis=2) > 40 for picture in pictures(path)]
    return [int(np.ptp(ink.nonzero()[0])) for ink in inked]


def test_a_parameter_may_play_instead_of_time(tmp_path: Path):
    """A picture for each value; time stands."""
    film(Rod, tmp_path / "film.webp", length=np.linspace(1, 3, 4), size=SIZE, camera=FRONT, shadows=False)
    assert (np.diff(heights(tmp_path / "film.webp")) > 5).all()
    film(Rod(length=2.0), tmp_path / "film.webp", hue=["red", "blue"], t=90, size=SIZE, camera=FRONT, shadows=False)
    red, blue = [picture.reshape(-1, 3)[picture.sum(axis=2).argmin()] for picture in pictures(tmp_path / "film.webp")]
    assert red[0] > 2 * red[2]
    assert blue[2] > 2 * blue[0]


def test_parameters_and_time_may_play_together(tmp_path: Path):
    """As many values as times, or a span that is spread over them; a parameter may be called like an argument."""
    for times in ([0.0, 45.0, 90.0], (0.0, 135.0)):
        film(Rod, tmp_path / "film.webp", times=times, length=[1, 2, 3], size=SIZE, camera=FRONT, shadows=False)
        first, second, third = heights(tmp_path / "film.webp")
        assert first < second
        assert third < second
    film(Rod, tmp_path / "film.webp", size=SIZE, camera=FRONT, parameters={"rate": [1, 2], "length": [1, 3]})
    first, second = heights(tmp_path / "film.webp")
    assert first < second


def test_a_camera_that_moves_is_followed(tmp_path: Path):
    """It comes nearer; without one the picture stands still, and holds everything at all times."""
    camera = r4.Camera(position=(0, -8, 0))
    camera.translate(r4.vec(0, 3 * r4.time, 0))
    scene = r4.Scene(rod=r4.Cylinder(0.2, 1, color="red"), camera=camera)
    film(scene, tmp_path / "film.webp", times=(0, 1.5), rate=2, size=SIZE, shadows=False)
    assert (np.diff(heights(tmp_path / "film.webp")) > 3).all()
    film(moving(), tmp_path / "film.webp", rate=4, size=SIZE)
    for picture in pictures(tmp_path / "film.webp"):
        columns = red_columns(picture)
        assert columns.min() > 0
        assert columns.max() < 159


def test_whoever_wants_to_know_is_told_how_far_it_is(tmp_path: Path):
    """After each picture: how many there are, of how many."""
    told: list[tuple[int, int]] = []
    film(moving(), tmp_path / "a.webp", times=(0, 1), rate=3, size=SIZE, progress=lambda *known: told.append(known))
    assert told == [(1, 3), (2, 3), (3, 3)]


def test_what_rests_is_asked_once(tmp_path: Path):
    """Whatever does not change is neither computed nor drawn anew for the pictures of a film."""
    asked: list[float] = []

    def size(t: float) -> float:
        asked.append(t)
        return 1.0

    box = r4.Box(size=r4.lift(size)(r4.Variable(1.0)))
    ball = r4.Sphere(radius=0.2)
    ball.translate(r4.vec(r4.time, 0, 0))
    film(r4.Scene(box=box, ball=ball), tmp_path / "film.webp", times=(0, 2), rate=5, size=SIZE)
    assert len(asked) <= 1
