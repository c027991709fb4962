"""Contact sheets: the pictures of a sweep as one, with what was moved written beside them."""

import math
import tempfile
import warnings
from collections.abc import Callable, Mapping, Sequence
from importlib.util import find_spec
from itertools import product
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError, hint
from reactive4d.sweeping.grids import Grid, grid_of
from reactive4d.sweeping.pictures import Picture
from reactive4d.sweeping.reports import Listener
from reactive4d.sweeping.subjects import Subject, subject_of
from reactive4d.sweeping.sweeps import SweepWarning, sweep

__all__ = ["contact_sheet"]

MOST_PIXELS: Final = 1 << 26
GAP: Final = 6
DIRECTION: Final = (0.45, -0.8, 0.42)  # from which a scene is seen
FOV: Final = 30.0
THEMES: Final = {"light": ("#ffffff", "#222222"), "dark": ("#16181d", "#dddddd")}


def contact_sheet(
    subject: Any,
    /,
    *,
    over: Mapping[str, Any],
    where: Callable[..., Any] | None = None,
    size: tuple[int, int] = (240, 180),
    columns: int | None = None,
    path: str | Path | None = None,
    workers: int | None = None,
    progress: bool | Listener = True,
    **options: Any,
) -> Any:
    """The pictures of a sweep as one labelled picture.

    The last dimension goes from left to right, the others from top to bottom; a single one is broken into lines. All
    pictures are seen from one place, unless the scene has a camera of its own.

    Args:
        subject: an Illustration, a Scene, or a function that builds a scene, as for `sweep`.
        over: the values by parameter or "time", as for `sweep`.
        where: which points to draw; the others stay empty.
        size: of each picture, pixels.
        columns: how many pictures stand in a line, where there is one dimension.
        path: a file to write the sheet into as well.
        workers: how many processes draw.
        progress: as for `sweep`.
        **options: what else the device for stills takes: `camera`, `background`, `edges`, `shadows`.

    Returns:
        A `PIL.Image.Image`.

    Raises:
        ShapeError: it would be too large.
        Exception: what `sweep` raises for `over` and `where`.

    >>> import reactive4d as r4
    >>> ball = r4.Scene(ball=r4.Sphere(r4.Parameter("ball_radius", 0.5)))
    >>> contact_sheet(ball, over={"ball_radius": [0.3, 0.5]}, size=(60, 40), shadows=False).size
    (138, 68)
    """
    about = subject_of(subject)
    about = about.knowing([about.scene.frame])
    grid = grid_of(over, where, levers=about.levers, is_closed=about.is_closed)
    layout = _Layout(grid, size, columns, background=str(options.get("background", "light")))
    if "camera" not in options:
        camera = _camera(about, grid, size[0] / size[1])
        options = options if camera is None else {**options, "camera": camera}
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore", SweepWarning)  # what went wrong is written where the picture would be
        found = sweep(
            subject,
            over=over,
            where=where,
            measure={"picture": Picture(size, options)},
            files=folder,
            workers=workers,
            progress=progress,
        )
        names = [dimension.name for dimension in grid.dimensions]
        paths = found["picture"].transpose(*names).values
        texts = found["error"].transpose(*names).values if "error" in found else np.full(grid.shape, "", object)
        sheet = layout.sheet(paths, texts)
    if path is not None:
        sheet.save(str(path))
    return sheet


class _Layout:
    """Where everything stands on a sheet."""

    def __init__(self, grid: Grid, size: tuple[int, int], columns: int | None, *, background: str) -> None:
        self.grid = grid
        self.size = width, height = size
        self.paper, self.ink = THEMES.get(background, (background, "#222222"))
        shape = grid.shape
        self.is_wrapped = len(shape) < 2
        if self.is_wrapped:
            count = grid.size
            self.columns = min(count, columns or math.ceil(math.sqrt(count * height / width * 4 / 3)))
            self.rows = -(-count // self.columns)
        else:
            self.columns, self.rows = shape[-1], math.prod(shape[:-1])
        self.font = _font(max(11, round(height / 14)))
        self.line = round(1.5 * self.font.size)
        heads = [self._label(index, range(len(shape) - 1)) for index in np.ndindex(*shape[:-1])]
        told = [] if self.is_wrapped else heads
        self.left = max([round(self.font.getlength(text)) + 2 * GAP for text in told], default=GAP)
        self.top = self.line if not self.is_wrapped else GAP
        self.step = width + GAP, height + GAP + (self.line if self.is_wrapped else 0)
        self.full = self.left + self.columns * self.step[0], self.top + self.rows * self.step[1]
        if self.full[0] * self.full[1] > MOST_PIXELS:
            told = f"{self.columns} × {self.rows} pictures of {width} × {height} pixels"
            raise hint(ShapeError(f"contact_sheet: {told} are too many"), "fewer values, or size=(120, 90)")

    def sheet(self, paths: NDArray[Any], texts: NDArray[Any]) -> Any:
        """The sheet, of pictures in files and of what went wrong."""
        from PIL import Image, ImageDraw

        sheet: Any = Image.new("RGB", self.full, self.paper)
        pen: Any = ImageDraw.Draw(sheet)
        for number, index in enumerate(np.ndindex(*self.grid.shape)):
            row, column = divmod(number, self.columns)
            x, y = self.left + column * self.step[0], self.top + row * self.step[1]
            if paths[index]:
                with Image.open(str(paths[index])) as picture:
                    sheet.paste(picture.convert("RGB"), (x, y))
            elif texts[index]:
                pen.rectangle((x, y, x + self.size[0] - 1, y + self.size[1] - 1), outline=self.ink)
                pen.multiline_text((x + GAP, y + GAP), self._broken(str(texts[index])), fill=self.ink, font=self.font)
            if self.is_wrapped:
                text = self._label(index, range(len(self.grid.shape)))
                place = x + self.size[0] / 2, y + self.size[1] + GAP
                pen.text(place, text, fill=self.ink, font=self.font, anchor="ma")
            elif row == 0:
                text = self._label(index, [len(self.grid.shape) - 1])
                pen.text((x + self.size[0] / 2, self.line / 2), text, fill=self.ink, font=self.font, anchor="mm")
            if column == 0 and not self.is_wrapped:
                text = self._label(index, range(len(self.grid.shape) - 1))
                pen.text((self.left - GAP, y + self.size[1] / 2), text, fill=self.ink, font=self.font, anchor="rm")
        return sheet

    def _label(self, index: Sequence[int], dimensions: Sequence[int]) -> str:
        """What stands beside a picture: the values along some dimensions."""
        told: list[str] = []
        for d in dimensions:
            for name, column in self.grid.dimensions[d].columns.items():
                lever = self.grid.levers.get(name)
                value = column[index[d]] if lever is None else lever.shown(column[index[d]])
                unit = "s" if lever is None else lever.unit
                text = f"{value:.4g}" if isinstance(value, float | np.floating) else str(value)
                told.append(f"{name} = {text} {unit}".rstrip())
        return ", ".join(told)

    def _broken(self, text: str) -> str:
        from textwrap import fill

        return fill(text, max(8, int(1.8 * self.size[0] / self.font.size)))


def _font(height: int) -> Any:
    """A font with more than English letters."""
    from PIL import ImageFont

    home = find_spec("matplotlib")
    for folder in (home.submodule_search_locations or []) if home is not None else []:
        path = Path(folder) / "mpl-data" / "fonts" / "ttf" / "DejaVuSans.ttf"
        if path.exists():
            return ImageFont.truetype(str(path), height)
    return ImageFont.load_default(height)


def _camera(about: Subject, grid: Grid, aspect: float) -> dict[str, Any] | None:
    """From where all that is drawn is seen; None if the scene says so itself, or nothing is to be seen."""
    corners: list[Any] = []
    for index in product(*[range(size) for size in grid.shape]):
        mask = grid.mask([(i, i + 1) for i in index])
        if mask is not None and not mask.all():
            continue
        t, given = grid.point(index)
        try:
            frame = about.scene.at(t, **{**about.values, **given})
        except Exception:  # noqa: BLE001  it is told in the place of the picture
            continue
        for node in frame.values():
            if node.visible and node.primitive == "camera":
                return None
            points = getattr(node.drawn, "points", None) if node.visible else None
            if points is not None and len(points):
                world = np.asarray(points) @ node.matrix[:3, :3].T + node.matrix[:3, 3]
                corners += [world.min(axis=0), world.max(axis=0)]
    if not corners:
        return None
    low, high = np.min(corners, axis=0), np.max(corners, axis=0)
    radius = max(float(np.linalg.norm(high - low)) / 2, 1e-6)
    half = math.radians(FOV / 2)
    distance = 1.05 * radius / math.sin(min(half, math.atan(math.tan(half) * aspect)))
    middle, direction = (low + high) / 2, np.array(DIRECTION) / np.linalg.norm(DIRECTION)
    return {"position": tuple((middle + distance * direction).tolist()), "target": tuple(middle.tolist()), "fov": FOV}
