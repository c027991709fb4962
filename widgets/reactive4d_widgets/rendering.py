"""Rendering: what `render` writes, by the end of the file's name: a still, a film, or a model of one instant."""

import os
from pathlib import Path
from typing import Any

from reactive4d.errors import UnknownNameError, hint, unknown
from reactive4d_widgets import films, models, stills

__all__ = ["render"]

WAYS = {
    ".png": stills.render,
    ".mp4": films.film,
    ".gif": films.film,
    ".webp": films.film,
    ".glb": models.model,
}
OTHERS = {
    ".png": "stills are PNG files",
    ".mp4": "films are .mp4, .gif and .webp",
    ".glb": "models of an instant are .glb",
}
OF_FILMS = ("times", "rate", "loop", "progress")
OF_PICTURES = ("size", "camera", "background", "edges", "shadows")
KINDRED = {
    ".png": {".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".svg", ".pdf", ".avif"},
    ".mp4": {".mov", ".webm", ".avi", ".mkv", ".apng", ".mpg", ".m4v", ".ogv"},
    ".glb": {".gltf", ".usd", ".usda", ".usdz", ".obj", ".stl", ".ply", ".fbx", ".vtm", ".vtp"},
}


def render(subject: Any, path: str | os.PathLike[str], **options: Any) -> None:
    """Write what a reader sees: a still (.png), a film (.mp4, .gif, .webp), or a model of one instant (.glb).

    Args:
        subject: a scene, an illustration or its class.
        path: of the file; an old one stays until the new one is whole.
        **options: of `stills.render`, `films.film` and `models.model`; a reader's values by name.

    Raises:
        UnknownNameError: there is no such format.
        TimeError: several times for a still or a model.
        Reactive4dError: whatever else is wrong; see there.
        OSError: the file cannot be written; an old one stays.

    >>> import tempfile
    >>> import reactive4d as r4
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     render(r4.Scene(ball=r4.Sphere(color="crimson")), f"{folder}/ball.png", t=1.0, size=(320, 240))
    ...     sorted(path.name for path in Path(folder).iterdir())
    ['ball.png']
    """
    target = Path(path)
    way = WAYS.get(target.suffix.lower())
    if way is None:
        raise _refusal(target)
    for name in options:
        if way is not films.film and name in OF_FILMS and not _is_parameter(subject, name):
            error = UnknownNameError(f"{target.name}: {name} is of films; this is one instant")
            raise hint(error, f"t=1.5, or a film: {target.with_suffix('.mp4').name}")
        if way is models.model and name in OF_PICTURES and not _is_parameter(subject, name):
            error = UnknownNameError(f"{target.name}: {name} is of pictures; this is a model of what is there")
            raise hint(error, f"a picture: {target.with_suffix('.png').name}")
    way(subject, target, **options)


def _is_parameter(subject: Any, name: str) -> bool:
    from reactive4d.illustrations import subject as subject_of

    return any(control.name == name for control in subject_of(subject).controls)


def _refusal(target: Path) -> UnknownNameError:
    end = target.suffix.lower()
    if not end:
        error = UnknownNameError(f"{target.name}: the name of a file ends with its format")
        return hint(error, ", ".join(WAYS))
    for way, kindred in KINDRED.items():
        if end in kindred:
            name = target.with_suffix(way).name
            return hint(UnknownNameError(f"{target.name}: {end} is not written"), f"{OTHERS[way]}: render({name!r})")
    return unknown(end, WAYS, what="format")
