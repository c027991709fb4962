"""Contact sheets: pictures of all points, in lines and columns, with what was moved beside them."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import reactive4d as r4
from reactive4d import devices
from reactive4d.sweeping import sheets

u, v = r4.Parameter("sheet_u", 1.0, bounds=(0.0, 5.0), doc="how much [m]"), r4.Parameter("sheet_v", 1.0)
COLORS = {1.0: (200, 0, 0), 2.0: (0, 200, 0), 3.0: (0, 0, 200)}


@pytest.fixture
def drawn() -> Iterator[list[dict[str, Any]]]:
    """What was drawn, by a device that fills the picture with a colour for u, darker for larger v."""
    seen: list[dict[str, Any]] = []

    def render(thing: Any, path: Path, *, t: float, size: tuple[int, int], parameters: Any, **options: Any) -> None:
        if parameters["sheet_u"] == 4.0:
            raise ValueError("four is too much")
        seen.append({"t": t, "size": size, **parameters, **options})
        level = 1 / parameters.get("sheet_v", 1.0)
        color = tuple([round(level * part) for part in COLORS[parameters["sheet_u"]]])
        Image.new("RGB", size, color).save(path)

    before = devices.exchange("render", render)
    yield seen
    devices.exchange("render", before)


def ball() -> r4.Scene:
    """A scene that reads both."""
    ball = r4.Sphere(u / 4)
    ball.translate(r4.vec(v, 0, r4.time))
    return r4.Scene(ball=ball)


def test_two_dimensions_are_rows_and_columns(drawn: list[dict[str, Any]], tmp_path: Path) -> None:
    """The last goes from left to right; all are seen from one place."""
    over = {"sheet_u": [1.0, 2.0], "sheet_v": [1.0, 2.0, 4.0]}
    sheet = r4.contact_sheet(ball(), over=over, size=(60, 40), path=tmp_path / "sheet.png", progress=False)
    step = 60 + sheets.GAP, 40 + sheets.GAP
    left, top = sheet.size[0] - 3 * step[0], sheet.size[1] - 2 * step[1]
    assert left > 60  # there are labels
    assert top > 10
    for row, red in enumerate((1.0, 2.0)):
        for column, dark in enumerate((1, 2, 4)):
            middle = left + column * step[0] + 30, top + row * step[1] + 20
            assert sheet.getpixel(middle) == tuple([part // dark for part in COLORS[red]])
    assert len({str(one["camera"]) for one in drawn}) == 1
    assert np.array_equal(np.asarray(Image.open(tmp_path / "sheet.png")), np.asarray(sheet))


def test_one_dimension_is_broken_into_lines(drawn: list[dict[str, Any]]) -> None:
    """As many columns as are wanted."""
    over = {"sheet_u": [1.0, 2.0, 3.0], "sheet_v": 2.0, "time": 3.0}
    sheet = r4.contact_sheet(ball(), over=over, size=(60, 40), columns=2, camera="eye", edges=True, progress=False)
    assert sheet.size[0] == sheets.GAP + 2 * (60 + sheets.GAP)
    assert [one["sheet_u"] for one in drawn] == [1.0, 2.0, 3.0]
    assert {(one["t"], one["camera"], one["edges"]) for one in drawn} == {(3.0, "eye", True)}


def test_what_goes_wrong_is_written_in_its_place(drawn: list[dict[str, Any]]) -> None:
    """And what is left out stays empty."""
    over = {"sheet_u": [1.0, 4.0, 3.0]}
    sheet = r4.contact_sheet(
        ball(), over=over, where=lambda sheet_u: sheet_u != 3, size=(160, 120), columns=3, progress=False
    )
    pixels = np.asarray(sheet)[sheets.GAP : sheets.GAP + 120]
    cells = [pixels[:, sheets.GAP + i * (160 + sheets.GAP) :][:, :160] for i in range(3)]
    assert (cells[0] == COLORS[1.0]).all()
    assert 0.005 < (cells[1] < 128).mean() < 0.5
    assert (cells[2] == 255).all()


def test_the_scenes_own_camera_is_used(drawn: list[dict[str, Any]]) -> None:
    """Then the device is told of none."""
    scene = ball()
    scene["eye"] = r4.Camera((3, -3, 3))
    r4.contact_sheet(scene, over={"sheet_u": [1.0]}, size=(60, 40), progress=False)
    assert "camera" not in drawn[0]


def test_too_many_pictures_are_refused(drawn: list[dict[str, Any]]) -> None:
    """Before one is drawn."""
    with pytest.raises(r4.ShapeError, match="100 × 1000 pictures of 640 × 480 pixels are too many"):
        r4.contact_sheet(
            ball(), over={"time": range(1000), "sheet_v": np.linspace(1, 2, 100)}, size=(640, 480), progress=False
        )
    assert not drawn
