"""Meshes in files: OFF, OBJ, PLY, STL and GLB.

A file is read into one mesh. Polygons are cut into triangles. Points at the same place are welded where the faces are
not closed without; so an STL file, whose triangles have corners of their own, encloses a solid. Nothing but the file
itself is read, whatever it may name.
"""

import os
import tempfile
from collections.abc import Callable, Generator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Final

import numpy as np

from reactive4d.errors import ShapeError, hint, unknown
from reactive4d.geometry import grids, meshes
from reactive4d.geometry.formats import glb, obj, off, ply, stl
from reactive4d.geometry.meshes import Mesh

__all__ = ["KINDS", "LARGEST", "drafted", "dump", "dumps", "load", "loads", "located", "put"]

_READERS: Final[dict[str, Callable[[bytes], Mesh]]] = {
    "off": off.read,
    "obj": obj.read,
    "ply": ply.read,
    "stl": stl.read,
    "glb": glb.read,
}
_WRITERS: Final[dict[str, Callable[[Mesh], bytes]]] = {
    "off": off.write,
    "obj": obj.write,
    "ply": ply.write,
    "stl": stl.write,
    "glb": glb.write,
}
KINDS: Final[tuple[str, ...]] = tuple(_READERS)
LARGEST: Final = 1 << 28  # bytes of a file


def load(path: str | Path, *, folder: str | Path | None = None) -> Mesh:
    """The mesh in a file; what kind it is of tells the end of its name.

    Args:
        path: of the file.
        folder: if given, relative paths begin there, and a file that lies outside of it (also by way of a link) is
            refused.

    Raises:
        ShapeError: the file cannot be read, is too large, lies outside of the folder or is damaged: with its name, and
            the line where it is known.
        UnknownNameError: there is no such kind of file.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     dump(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]), Path(folder) / "one.off")
    ...     load("one.off", folder=folder)
    Mesh(3 points, 1 face)
    """
    place = located(path, folder=folder)
    try:
        content = place.read_bytes()
    except OSError as error:
        raise ShapeError(f"{path}: cannot be read: {error}") from error
    return loads(content, _kind(place), name=str(path))


def located(path: str | Path, *, folder: str | Path | None = None) -> Path:
    """Where the file of a mesh lies, if it could be read: it is there, of a kind that is known, and not too large.

    Args:
        path: of the file.
        folder: as for `load`.

    Raises:
        ShapeError: there is no such file, it is too large, or lies outside of the folder.
        UnknownNameError: there is no such kind of file.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     dump(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]), Path(folder) / "one.off")
    ...     located("one.off", folder=folder).name
    'one.off'
    """
    place = Path(path)
    try:
        if folder is not None:
            home = Path(folder).resolve()
            place = (home / place).resolve()
            if not place.is_relative_to(home):
                raise hint(ShapeError(f"{path}: lies outside of the folder {home}"), "copy the file into the folder")
        if not place.is_file():
            raise ShapeError(f"{path}: there is no such file")
        if place.stat().st_size > LARGEST:
            raise ShapeError(f"{path}: expected at most {LARGEST} bytes, got {place.stat().st_size}")
    except (OSError, RuntimeError, ValueError) as error:  # a name with a null is a ValueError, a loop a RuntimeError
        if isinstance(error, ShapeError):
            raise
        raise ShapeError(f"{path}: cannot be read: {error}") from error
    _kind(place)
    return place


def loads(content: bytes, kind: str, *, name: str = "") -> Mesh:
    r"""The mesh in the bytes of a file.

    Args:
        content: of the file.
        kind: one of `KINDS`.
        name: what errors call the file.

    Raises:
        ShapeError: the content is too large or damaged.
        UnknownNameError: there is no such kind of file.

    >>> loads(b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7", "off", name="bad.off")
    Traceback (most recent call last):
    ...
    reactive4d.errors.ShapeError: bad.off: line 6: expected indices from 0 to 2, got 7
    """
    if kind not in _READERS:
        raise unknown(kind, KINDS, what="kind of file")
    try:
        if len(content) > LARGEST:
            raise ShapeError(f"expected at most {LARGEST} bytes, got {len(content)}")
        with np.errstate(all="ignore"):  # damaged numbers may be too large to multiply; what counts is checked
            return _welded(_READERS[kind](content))
    except ShapeError as error:
        raise ShapeError(f"{name or kind}: {error}") from error


def dump(mesh: Mesh, path: str | Path) -> None:
    """Write a mesh into a file of the kind that the end of its name tells; an old file stays until the new is whole.

    OFF keeps the colours of faces; PLY and GLB uv, normals and colours of points; OBJ uv and normals; STL the faces.

    Raises:
        UnknownNameError: there is no such kind of file.
        OSError: the file cannot be written.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     dump(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]), Path(folder) / "one.stl")
    ...     [file.name for file in Path(folder).iterdir()]
    ['one.stl']
    """
    put(path, dumps(mesh, _kind(Path(path))))


def put(path: str | Path, content: bytes) -> None:
    """Write a file; an old one stays until the new one is whole.

    Raises:
        OSError: it cannot be written.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     put(Path(folder) / "two.txt", b"2")
    ...     (Path(folder) / "two.txt").read_bytes()
    b'2'
    """
    with drafted(path) as file:
        file.write(content)


@contextmanager
def drafted(path: str | Path) -> Generator[IO[bytes]]:
    """A file to be written to; it takes the place of an old one when the block is done, and is gone if that fails.

    Raises:
        OSError: it cannot be written.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with drafted(f"{folder}/two.txt") as file:
    ...         _ = file.write(b"2")
    ...     (Path(folder) / "two.txt").read_bytes()
    b'2'
    """
    place = Path(path)
    handle, draft = tempfile.mkstemp(prefix=f".{place.name}.", dir=place.parent)
    os.close(handle)
    try:
        with Path(draft).open("w+b") as file:
            yield file
            file.flush()
            os.fsync(file.fileno())
        # mkstemp makes files for their owner alone; a saved file may be read by others, or as the old one could.
        Path(draft).chmod(place.stat().st_mode & 0o777 if place.exists() else 0o644)
        Path(draft).replace(place)
    except BaseException:
        Path(draft).unlink(missing_ok=True)
        raise


def dumps(mesh: Mesh, kind: str) -> bytes:
    """The bytes of a file with a mesh.

    Raises:
        UnknownNameError: there is no such kind of file.

    >>> dumps(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]), "off")[:3]
    b'OFF'
    """
    if kind not in _WRITERS:
        raise unknown(kind, KINDS, what="kind of file")
    return _WRITERS[kind](mesh)


def _kind(path: Path) -> str:
    kind = path.suffix.lower().removeprefix(".")
    if kind not in _READERS:
        raise hint(unknown(kind, KINDS, what="kind of file"), f"the name of {path.name!r} ends with the kind")
    return kind


def _welded(mesh: Mesh) -> Mesh:
    """With a weld map by place where the faces need one to be closed."""
    if meshes.is_closed(mesh):
        return mesh
    weld = grids.by_place(mesh.points)
    if len(weld) == 0 or (weld[1:] > weld[:-1]).all():
        return mesh
    return mesh.with_attributes(weld=weld)
