"""Pictures: a measure that draws the scene, by whatever device draws stills."""

import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from reactive4d.devices import device

__all__ = ["Picture"]


@dataclass(frozen=True)
class Picture:
    """A measure that is a still picture of the scene: a PNG file, whose path stands in the dataset.

    A frame that is the same at several points is drawn once.

    Args:
        size: width and height, pixels.
        options: whatever else the device takes: `camera`, `background`, `edges`, `shadows`.

    >>> Picture(size=(320, 240), options={"background": "dark"}).size
    (320, 240)
    """

    size: tuple[int, int] = (640, 480)
    options: Mapping[str, Any] = field(default_factory=dict[str, Any])

    def draw(self, thing: Any, t: float, parameters: Mapping[str, Any]) -> bytes:
        """The picture at one point.

        Args:
            thing: a scene, an illustration or its class.
            t: seconds.
            parameters: a reader's values.
        """
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "picture.png"
            device("render")(thing, path, t=t, size=self.size, parameters=dict(parameters), **self.options)
            return path.read_bytes()
