"""Formats of scene files: what reads and writes them lies above the model, and is entered here when it is imported."""

from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Protocol

from reactive4d.errors import hint, unknown

if TYPE_CHECKING:
    from reactive4d.model.scenes import Scene

__all__ = ["FORMATS", "Format", "format_of"]


class Format(Protocol):
    """How scenes are read from files and written into them."""

    def load(self, path: Path, scene: "Scene", /) -> None:
        """Read a file into a scene that is still empty."""
        ...

    def save(self, path: Path, scene: "Scene", /) -> None:
        """Write a scene into a file."""
        ...


FORMATS: Final[dict[str, Format]] = {}
"""Formats by the end of a file's name."""


def format_of(path: Any) -> Format:
    """The format that the end of a file's name tells.

    Raises:
        UnknownNameError: nobody knows it.

    >>> import reactive4d as r4
    >>> type(format_of("scenes/garden.scefo")).__name__
    'ScriptFormat'
    """
    end = Path(path).suffix.lower()
    found = FORMATS.get(end)
    if found is None:
        raise hint(unknown(end, FORMATS, what="format of scenes"), f"the name of {Path(path).name!r} ends with it")
    return found
