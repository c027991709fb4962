"""Films: pictures of a scene at one instant after the other, as MP4, GIF or WebP."""

import math
import os
from collections.abc import Callable, Generator, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from reactive4d.errors import ShapeError, hint
from reactive4d.geometry.files import drafted
from reactive4d.illustrations import subject as subject_of
from reactive4d.illustrations.subjects import Subject
from reactive4d.model.frames import Frame
from reactive4d_widgets.encoders import ENCODERS, check_encoder
from reactive4d_widgets.progress import bar
from reactive4d_widgets.reels import Moment, reel_of
from reactive4d_widgets.shots import Shot
from reactive4d_widgets.stills import sized, theme_of
from reactive4d_widgets.views import instants

__all__ = ["RATE", "SIZE", "film"]

RATE = 25.0
SIZE = (960, 720)
GLANCES = 33  # pictures that are looked at before, to know from where all of it is seen

Told = Callable[[int, int], Any]


def film(
    subject: Any,
    path: str | os.PathLike[str],
    *,
    times: Any = None,
    t: float | None = None,
    rate: float = RATE,
    size: tuple[int, int] = SIZE,
    camera: Any = None,
    background: str = "light",
    edges: bool = True,
    shadows: bool = True,
    loop: bool = True,
    progress: bool | Told = True,
    parameters: Mapping[str, Any] | None = None,
    **values: Any,
) -> None:
    """Write a film.

    Args:
        subject: a scene, an illustration or its class.
        path: of the file: .mp4 (H.264, needs `reactive4d[films]`), .gif or .webp. An old file stays until the new one
            is whole.
        times: None for the subject's own; (start, stop), seconds; or a time for each picture, in any order.
        t: the one time of all pictures, while a parameter plays.
        rate: pictures per second.
        size: width and height, pixels; those of an .mp4 are even.
        camera: as for a still; one that moves is followed.
        background: "light", "dark", or a colour.
        edges: whether creases and borders are drawn as lines.
        shadows: whether things throw soft shadows.
        loop: whether a .gif or a .webp begins again at its end.
        progress: whether a bar is shown, where there is a terminal; or a function that is told, after each picture,
            how many there are already and how many there will be.
        parameters: values by name, for parameters that are called like one of these arguments.
        **values: a reader's values; several for a parameter that plays, one for each picture.

    Raises:
        UnknownNameError: there is no such format, parameter or camera.
        TimeError: times that are none, or too many.
        ParameterError: a value that its parameter does not admit.
        ShapeError: a size or a rate that is none, or that the format does not know.
        Reactive4dError: the format needs a library that is not there.
        EvaluationError: there is no OpenGL on this machine.
        OSError: the file cannot be written; an old one stays.

    >>> import tempfile
    >>> import reactive4d as r4
    >>> ball = r4.Sphere(color="crimson")
    >>> _ = ball.translate(r4.vec(r4.time, 0, 0))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     film(r4.Scene(ball=ball), f"{folder}/ball.gif", times=(0, 1), rate=4, size=(160, 120))
    ...     Path(f"{folder}/ball.gif").read_bytes()[:6]
    b'GIF89a'
    """
    from reactive4d_widgets.stage import Stage

    target = Path(path)
    width, height = sized(size)
    speed = _rate(rate)
    check_encoder(target, size=(width, height), rate=speed)
    theme = theme_of(background)
    about = subject_of(subject)
    reel = reel_of(about, times=times, t=t, rate=speed, parameters={**values, **(parameters or {})})
    glances = _glances(about, reel)
    shot = Shot(
        (_frame(about, moment) for moment in glances), aspect=width / height, camera=camera, place=about.point.camera
    )
    encode = ENCODERS[target.suffix.lower()]
    with (
        drafted(target) as file,
        _watched(progress, target.name, len(reel)) as told,
        Stage(size=(width, height), theme=theme, edges=edges, shadows=shadows) as stage,
    ):

        def picture(moment: Moment) -> Any:
            frame = _frame(about, moment)
            return stage.drawn(frame, shot.view(frame), bounds=shot.bounds)

        def pictures() -> Iterator[Any]:
            for i, moment in enumerate(reel):
                drawn = picture(moment)
                told(i + 1, len(reel))
                yield drawn

        def few(most: int) -> list[Any]:
            return [picture(moment) for moment in _few(reel, most)]

        encode(
            file,
            pictures(),
            few,
            count=len(reel),
            rate=speed,
            loop=loop,
        )


def _frame(subject: Subject, moment: Moment) -> Frame:
    return subject.scene.at(moment.t, **moment.values)


def _glances(subject: Subject, reel: list[Moment]) -> list[Moment]:
    """At what one looks before: some pictures, and where time plays, all of the scene's time as for a still."""
    found = _few(reel, GLANCES)
    if reel[0].t == reel[-1].t:
        return found
    return [*found, *[Moment(t, reel[0].values) for t in instants(*subject.times)]]


def _few(reel: list[Moment], most: int) -> list[Moment]:
    """So many at most, spread over all of them."""
    if len(reel) <= most:
        return reel
    return [reel[round(i)] for i in np.linspace(0, len(reel) - 1, most)]


def _rate(rate: Any) -> float:
    try:
        found = float(rate)
    except (TypeError, ValueError):
        found = math.nan
    if not 0.01 <= found <= 1000.0:
        raise hint(ShapeError(f"rate: expected pictures per second, got {rate!r}"), "rate=25; from 0.01 to 1000")
    return found


@contextmanager
def _watched(progress: Any, title: str, total: int) -> Generator[Told]:
    """Whom to tell how far it is."""
    if callable(progress):
        yield progress
        return
    if not isinstance(progress, bool):
        raise hint(
            ShapeError(f"progress: expected True, False or a function, got {progress!r}"),
            "progress=lambda done, total: …",
        )
    with bar(shown=progress, title=title) as shown:
        shown.expect(total)
        yield lambda done, total: shown.advance()
