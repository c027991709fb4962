"""Models: what a scene shows at one instant as a GLB file, binary glTF 2.0, for other programs to go on with."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from reactive4d.geometry.files import put
from reactive4d.illustrations import subject as subject_of
from reactive4d_widgets.gltf import Writer

__all__ = ["dumped", "model"]


def model(
    subject: Any,
    path: str | os.PathLike[str],
    *,
    t: float = 0.0,
    parameters: Mapping[str, Any] | None = None,
    **values: Any,
) -> None:
    """Write a model of what is seen at one instant.

    It has a node for each object that is seen, those of groups below them, with the names that they have in a frame;
    meshes, lines and points in their colours, cameras, and the lights that stand somewhere or shine from afar. What is
    up along +z in a scene is up along +y in the file, as glTF wants it.

    Args:
        subject: a scene, an illustration or its class.
        path: of the file, .glb; an old one stays until the new one is whole.
        t: seconds.
        parameters: a reader's values by name, for those that are called like one of these arguments.
        **values: a reader's values.

    Raises:
        UnknownNameError: there is no such parameter.
        ParameterError: a value that its parameter does not admit.
        OSError: the file cannot be written.

    >>> import tempfile
    >>> import reactive4d as r4
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     model(r4.Scene(ball=r4.Sphere(color="crimson")), f"{folder}/ball.glb")
    ...     Path(f"{folder}/ball.glb").read_bytes()[:4]
    b'glTF'
    """
    put(Path(path), dumped(subject, t=t, parameters={**values, **(parameters or {})}))


def dumped(subject: Any, *, t: float = 0.0, parameters: Mapping[str, Any] | None = None) -> bytes:
    """The same as bytes."""
    about = subject_of(subject)
    if parameters:
        about = about.moved({name: about.control(name).encode(value) for name, value in parameters.items()})
    frame = about.scene.at(t, **about.values)
    writer = Writer(about.title)
    for name, node in frame.items():
        writer.add(name, node)
    told = {
        name: value for name, value in about.point.parameters.items() if isinstance(value, int | float | str | bool)
    }
    return writer.dumps({"time": frame.time, **({"parameters": told} if told else {})})
