"""Guests: what PyVista has, as objects that can be moved, deformed, coloured, combined and shown.

A dataset becomes a `Model` or a `Wire`, one that has surfaces and lines a `Group` of both, and several blocks a `Group`
with their names. Over time it is a series: with the same cells its points and its numbers move from one dataset to the
next, with other cells one takes the place of another.
"""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any

import numpy as np

from reactive4d.errors import ShapeError, TimeError, UnknownNameError, hint, unknown
from reactive4d.geometry.colormaps import Colormap, colormap, limits
from reactive4d.geometry.datasets import Part, parts_of
from reactive4d.geometry.pictures import pictured
from reactive4d.model.kinds.aggregates import Group
from reactive4d.model.objects import Object
from reactive4d.model.series import Look, varying
from reactive4d.signals.curves.controls import key_time

__all__ = ["from_pyvista"]

KINDS = ("surface", "lines", "points")
INTERPOLATIONS = ("linear", "step")
# What there is at each of the times, or what there is under each name.
Leaf = list[dict[str, Part]]
Tree = Leaf | dict[str, Any]


def from_pyvista(
    mesh: Any,
    /,
    *,
    times: Sequence[float] | None = None,
    scalars: Any = None,
    cmap: Colormap = None,
    clim: Any = None,
    interpolation: str = "linear",
    color: Any = None,
    opacity: Any = None,
    texture: Any = None,
) -> Object:
    """What PyVista has, as an object: a surface, lines, a cloud of points, or a group of them.

    Polygons, strips and the surfaces of volumes become triangles. Points that lie at one place hang together, so that
    closed surfaces are solids and can be combined. What is made stays as it is when the dataset is changed later.

    Args:
        mesh: any dataset of PyVista or VTK, or a `MultiBlock`, which becomes a group of what it has; over time a
            mapping of seconds to such, or a list of them with `times`.
        times: seconds, when each of a list is there.
        scalars: what colours it: an array's name, or an array of numbers or colours with a row for each point or each
            cell. By default the active array, if there is one; False for none.
        cmap: the map of numbers to colours: a name, a list of colours, or a map of Matplotlib's; by default that of
            PyVista's theme.
        clim: which numbers have its first and its last colour; by default the least and the greatest of all.
        interpolation: between two times "linear", where both have the same cells, or "step".
        color: of the object; then nothing is coloured by numbers unless `scalars` is given.
        opacity: of the object, 0 to 1.
        texture: a picture on all surfaces that have texture coordinates, a `pyvista.Texture` or (H, W, 3 or 4) bytes:
            it becomes the colours of their points, of which there are more then, up to a hundred thousand faces.

    Raises:
        ShapeError: it is no dataset, has nothing to draw, points that are not finite, or cells of points that are not
            there; a picture that is none, or has no texture coordinates to lie on, or scalars beside it.
        UnknownNameError: there is no such array, colour map or interpolation.
        TimeError: a time that is none, or two datasets at one time.

    >>> import pyvista as pv
    >>> import reactive4d as r4
    >>> cone = r4.from_pyvista(pv.Cone(), color="tomato")
    >>> _ = cone.apply(r4.Bend(40 * r4.time, axis="x"))
    >>> (cone - r4.Sphere(0.2)).volume.at(0.0) < cone.volume.at(0.0)
    True
    """
    if interpolation not in INTERPOLATIONS:
        raise unknown(interpolation, INTERPOLATIONS, what="interpolation")
    series, when = _series(mesh, times)
    settings = {name: value for name, value in (("color", color), ("opacity", opacity)) if value is not None}
    is_plain = scalars is False or (scalars is None and (color is not None or texture is not None))
    tree = _parsed(series, False if is_plain else scalars, "mesh")
    if texture is not None:
        if not is_plain:
            raise hint(ShapeError("texture: a surface has the colours of a picture or of scalars"), "leave one out")
        _spread(tree, _picture(texture))
    paints = [part.paint for leaf in _leaves(tree) for parts in leaf for part in parts.values()]
    numbers = [paint for paint in paints if paint is not None and paint.ndim == 1]
    low, high = limits(numbers, clim)
    look = Look(colormap(_theme() if cmap is None else cmap), low, high, interpolation, settings)
    return _object(tree, when, look)


def _picture(texture: Any) -> Any:
    """A picture as Pillow has it."""
    import pyvista
    from PIL import Image

    kit: Any = pyvista
    given: Any = None
    if not hasattr(texture, "GetInput"):
        with suppress(ValueError):  # rows of different lengths
            given = np.asarray(texture)
    elif texture.GetInput() is not None and not texture.GetCubeMap():
        given = np.asarray(kit.Texture(texture.GetInput()).to_array())
    if given is not None and given.dtype in (np.uint8, np.uint16) and given.size:
        shades = given if given.dtype == np.uint8 else (given // 257).astype(np.uint8)
        if given.ndim == 2 or given.shape[2:] == (1,):
            return Image.fromarray(shades.reshape(given.shape[:2]))
        if given.shape[2:] in ((2,), (3,), (4,)):
            return Image.fromarray(shades)
    told = type(texture).__name__ if given is None else f"shape {given.shape} of {given.dtype}"
    error = ShapeError(f"texture: expected a picture, (H, W, 3 or 4) bytes, got {told}")
    raise hint(error, "pyvista.read_texture('wood.jpg'), or np.asarray(Image.open('wood.jpg'))")


def _spread(tree: Tree, picture: Any) -> None:
    """Lay a picture on all surfaces that have texture coordinates."""
    found = [(parts, parts["surface"]) for leaf in _leaves(tree) for parts in leaf if "surface" in parts]
    if not any(part.uv is not None for _, part in found):
        error = ShapeError("texture: no surface has texture coordinates, which say what of the picture is where")
        raise hint(error, "mesh.texture_map_to_plane(inplace=True), or texture_map_to_sphere")
    for parts, part in found:
        if part.uv is not None:
            parts["surface"] = pictured(part, picture)


def _theme() -> Any:
    import pyvista

    kit: Any = pyvista
    return kit.global_theme.cmap


def _series(mesh: Any, times: Any) -> tuple[list[Any], list[float]]:
    """The datasets, and when each of them is there."""
    if isinstance(mesh, Mapping):
        if times is not None:
            raise ShapeError("times: a mapping has its times already")
        given: Mapping[Any, Any] = mesh  # pyright: ignore[reportUnknownVariableType]
        times, mesh = list(given), list(given.values())
    if not isinstance(mesh, list | tuple):
        if times is not None:
            raise hint(ShapeError("times: one dataset is there at all times"), "a list of datasets has times")
        return [mesh], [0.0]
    series: list[Any] = list(mesh)  # pyright: ignore[reportUnknownArgumentType]
    if all(one is None for one in series):
        raise hint(ShapeError("mesh: a series without a dataset"), "at least one; None is nothing for a while")
    given_times: list[Any] | None = None if times is None or not np.iterable(times) else list(times)
    if given_times is None or len(given_times) != len(series):
        count = repr(times) if given_times is None else len(given_times)
        raise hint(ShapeError(f"times: expected {len(series)}, one for each dataset, got {count}"), "times=(0, 1, 2)")
    when = [key_time(t) for t in given_times]
    if len(set(when)) != len(when):
        raise TimeError(f"times: two datasets are there at one time, in {when}")
    order = sorted(range(len(when)), key=when.__getitem__)
    return [series[i] for i in order], [when[i] for i in order]


def _is_group(one: Any) -> bool:
    return hasattr(one, "GetNumberOfBlocks")


def _is_nothing(one: Any) -> bool:
    """Whether a block has nothing to draw: readers of files leave such blocks."""
    if _is_group(one):
        return all(_is_nothing(block) for block in one)
    return one is None or getattr(one, "n_points", 1) == 0


def _parsed(series: list[Any], scalars: Any, where: str) -> Tree:
    """What there is of a series; None is nothing."""
    groups = [_is_group(one) for one in series if one is not None]
    if not any(groups):
        is_one = len(series) == 1
        return [parts_of(one, scalars, where=where) if is_one or not _is_nothing(one) else {} for one in series]
    if not all(groups):
        raise ShapeError(f"{where}: some of the series are datasets of several blocks, others of one")
    named: dict[str, list[Any]] = {}
    for k, one in enumerate(series):
        for i, (name, block) in enumerate(_blocks(one)):
            if not _is_nothing(block):
                named.setdefault(_free(name, i, named, k), [None] * len(series))[k] = block
    if not named:
        raise hint(ShapeError(f"{where}: no block has anything to draw"), "None and empty datasets are left out")
    lacking: list[UnknownNameError] = []
    found: dict[str, Any] = {}
    for name, blocks in named.items():
        try:
            found[name] = _parsed(blocks, scalars, f"{where}[{name!r}]")
        except UnknownNameError as error:
            # An array that some blocks have colours those, and leaves the others plain.
            lacking.append(error)
            found[name] = _parsed(blocks, False, f"{where}[{name!r}]")
    if len(lacking) == len(named):
        raise lacking[0]
    return found


def _blocks(one: Any) -> list[tuple[Any, Any]]:
    """Names and blocks; of nothing none."""
    import pyvista

    kit: Any = pyvista
    blocks: Any = kit.MultiBlock() if one is None else kit.wrap(one)
    return [(blocks.get_block_name(i), blocks[i]) for i in range(len(blocks))]


def _free(name: Any, i: int, named: Mapping[str, list[Any]], k: int) -> str:
    """What a block is called as a member of a group: no two alike at one time, and no slash, which leads to members."""
    wanted = str(name).replace("/", "-") if name else f"block{i}"
    found, n = wanted, 2
    while found in named and named[found][k] is not None:
        found, n = f"{wanted}-{n}", n + 1
    return found


def _leaves(tree: Tree) -> list[Leaf]:
    if isinstance(tree, dict):
        return [leaf for below in tree.values() for leaf in _leaves(below)]
    return [tree]


def _object(tree: Tree, when: list[float], look: Look) -> Object:
    if isinstance(tree, dict):
        return Group({name: _object(below, when, look) for name, below in tree.items()})
    names = [name for name in KINDS if any(name in parts for parts in tree)]
    made = {name: varying([parts.get(name) for parts in tree], when, name, look) for name in names}
    return Group(made) if len(made) > 1 else made[names[0]]
