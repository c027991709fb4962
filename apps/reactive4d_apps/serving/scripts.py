"""Scripts: of which figures of a page a reader may have a private copy, and what each copy needs."""

import logging
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

import reactive4d as r4
from reactive4d.errors import Reactive4dError, ShapeError, hint
from reactive4d.geometry.files import located
from reactive4d.illustrations import subject
from reactive4d.model.reaches import span
from reactive4d.scefo.collecting import Collection
from reactive4d.scefo.reading import FOLDER, SOURCE, reads_files
from reactive4d_apps.scripts import script_of
from reactive4d_apps.serving.confinements import can_confine
from reactive4d_apps.serving.copies import Original
from reactive4d_apps.serving.exhibits import Exhibit

__all__ = ["original", "originals_of"]

LOG = logging.getLogger("reactive4d.serving")


def originals_of(exhibits: Mapping[str, Exhibit]) -> dict[str, Original]:
    """The scripts of the figures of a page. An illustration whose scene no script can say is left out.

    Raises:
        ShapeError: nothing is left.
        NotWritableError: there are things in a scene that no script can say.
        Reactive4dError: this system sets no limits to what a process takes.
    """
    if not can_confine():
        raise Reactive4dError("nothing can be edited here: this system sets no limits to what a private copy takes")
    found: dict[str, Original] = {}
    reason = "there is no figure"
    for name, one in exhibits.items():
        try:
            found[name] = original(one)
        except (r4.NotWritableError, ShapeError) as error:
            if isinstance(one.figure.thing, r4.Scene):
                raise
            reason = f"{name} is a program, and what it builds no script can say: {error}"
            LOG.info("%s", reason)
    if not found:
        raise hint(ShapeError(f"nothing can be edited here: {reason}"), "Scene.load reads a scene from a script")
    return found


def original(exhibit: Exhibit) -> Original:
    r"""The script of a figure's scene, and what it needs.

    Raises:
        NotWritableError: there are things in the scene that no script can say.
        ShapeError: it reads files of several folders, or has a choice among its parameters.

    >>> made = original(Exhibit("ball", r4.Figure(r4.loads("object (ball) sphere; /* round */"))))
    >>> made.script
    'object (ball) sphere; /* round */'
    """
    about = subject(exhibit.figure.thing)
    folder, files = _files(about.scene)
    times = exhibit.times
    if times is None and about.times != span(about.scene):
        times = about.times  # which no script says; what follows from its keys, follows from the reader's too
    return Original(
        name=exhibit.name,
        script=script_of(exhibit.figure.thing, folder=folder),
        folder=folder,
        files=files,
        title=exhibit.figure.title,
        times=None if times is None else tuple(float(t) for t in np.asarray(times, np.float64)),
        options=exhibit.options,
        values={**about.point.parameters, **exhibit.point},
    )


def _files(scene: r4.Scene) -> tuple[str | None, tuple[str, ...]]:
    """The folder in which a scene reads files, and which."""
    found: dict[str, str] = {}
    for obj in Collection(scene).objects:
        if not reads_files(obj):
            continue
        source: Any = obj.attribute(SOURCE).at(0.0)
        folder: Any = obj.attribute(FOLDER).at(0.0)
        if isinstance(source, str) and source:
            place = located(source, folder=folder).resolve()
            found[str(place)] = str((place.parent if folder is None else Path(folder)).resolve())
    homes = sorted(set(found.values()))
    if len(homes) > 1:
        raise hint(ShapeError(f"its script would read files of {len(homes)} folders"), "put them into one folder")
    return (homes[0] if homes else None), tuple(found)
