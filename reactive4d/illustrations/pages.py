"""Pages: prose with figures in it, as one document."""

import os
import re
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from reactive4d.devices import device
from reactive4d.errors import ShapeError, hint
from reactive4d.illustrations.subjects import subject

__all__ = ["Figure", "Page"]

LONGEST = 100  # letters of a name
_NAME = re.compile(r"[^\W\d][\w-]*")


class Figure:
    """A figure of a page, where there is more to say of it than what it shows.

    Args:
        thing: a scene, an illustration or its class.
        times: None for its own, (start, stop), or evenly spaced times, seconds.
        follow: the name of another figure of the page, with which it shares time and parameters.
        title: how it is called; otherwise as its class is.
        **options: values of parameters, and how it is shown at first, as for `bake`.

    Raises:
        ShapeError: nothing that can be shown, or a title or a leader that is no text.

    >>> import reactive4d as r4
    >>> Figure(r4.Scene(ball=r4.Sphere()), times=(0, 2))
    <Figure of a Scene>
    """

    def __init__(
        self, thing: Any, /, *, times: Any = None, follow: str | None = None, title: str | None = None, **options: Any
    ) -> None:
        subject(thing)
        for key, value in {"follow": follow, "title": title}.items():
            if value is not None and not isinstance(value, str):  # pyright: ignore[reportUnnecessaryIsInstance]
                raise ShapeError(f"Figure: {key}: expected a text, got {value!r}")
        self.thing = thing
        self.times = times
        self.follow = follow
        self.title = title
        self.options: Mapping[str, Any] = MappingProxyType(options)

    def __repr__(self) -> str:
        return f"<Figure of a {(self.thing if isinstance(self.thing, type) else type(self.thing)).__name__}>"


class Page:
    """Prose with figures in it: a document that a device writes or shows.

    The prose is Markdown. `![caption](pendulum)` places a figure; `{length}` and `{length:.2f}` are numbers that a
    reader drives or reads; `[the bob](#bob)` highlights an object; `[a long one](#length=2&t=1)` is a link to a point.
    Where there are several figures, `{pendulum.length}` and `#pendulum.length=2` say which.

    Args:
        text: the prose.
        **figures: by name: a scene, an illustration, its class, or a `Figure`.

    Raises:
        ShapeError: a figure that cannot be shown, or a name that is none.

    >>> import reactive4d as r4
    >>> r4.Page("# A ball", ball=r4.Scene(ball=r4.Sphere()))
    <Page of ball>
    """

    def __init__(self, text: str = "", /, **figures: Any) -> None:
        if not isinstance(text, str):  # pyright: ignore[reportUnnecessaryIsInstance]
            raise hint(ShapeError(f"Page: expected a text, got {text!r}"), 'Page("…", pendulum=Pendulum())')
        for name in figures:
            if not _NAME.fullmatch(name) or len(name) > LONGEST:
                error = ShapeError(f"{name[:80]!r} is not a name for a figure")
                raise hint(error, f"letters, digits, _ and -; at most {LONGEST} of them")
        self.text = text
        self.figures: Mapping[str, Figure] = MappingProxyType(
            {name: figure if isinstance(figure, Figure) else Figure(figure) for name, figure in figures.items()}
        )

    def bake(self, path: str | os.PathLike[str], **options: Any) -> Any:
        """Write it into one file that needs no server.

        Args:
            path: of the file, .html.
            **options: as for one figure; times and values of parameters go to all figures that know them.
        """
        return device("bake")(self, path, **options)

    def __repr__(self) -> str:
        return f"<Page of {', '.join(self.figures) or 'nothing'}>"
