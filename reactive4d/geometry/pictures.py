"""Pictures on surfaces, as colours of their points: a surface that is coarser than its picture is divided first."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError
from reactive4d.geometry.datasets import Part
from reactive4d.geometry.sizes import singles

__all__ = ["MOST", "pictured"]

MOST = 100_000  # faces
NEAR = 1.0  # pixels of the picture for each face
SLIGHT = 1e-3  # of the picture's width: beyond its edge, but not meant so


def pictured(part: Part, picture: Any, *, where: str = "mesh") -> Part:
    """A surface in the colours of a picture.

    Its faces are cut in four, all of them, until there is about one for each pixel that is seen of the picture, or
    until there would be more than a hundred thousand. The surface stays where it is.

    Args:
        part: triangles with texture coordinates: (0, 0) is the picture's lower left corner, (1, 1) its upper right one.
        picture: of Pillow's; beyond its edges it begins again.
        where: what the surface is called in errors.

    Raises:
        ShapeError: a texture coordinate is not finite.

    >>> from PIL import Image
    >>> corners = np.float32([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
    >>> square = Part(corners, np.int32([(0, 1, 2), (0, 2, 3)]), corners[:, :2])
    >>> found = pictured(square, Image.new("RGB", (4, 4), "red"))
    >>> len(found.cells), found.paint[0].tolist()
    (32, [1.0, 0.0, 0.0, 1.0])
    """
    import trimesh

    kit: Any = trimesh
    assert part.uv is not None
    points, faces, uv = part.points.astype(np.float64), part.cells.astype(np.int64), part.uv.astype(np.float64)
    wrong = ~np.isfinite(uv).all(axis=1)
    if wrong.any():
        row = int(np.flatnonzero(wrong)[0])
        raise ShapeError(f"{where}: texture coordinates: expected finite numbers, got {uv[row].tolist()} at {row}")
    image = _in_bytes(picture).convert("RGBA")
    while 4 * len(faces) <= MOST and _pixels(uv[faces], image.size) > NEAR:
        points, faces, others = kit.remesh.subdivide(points, faces, vertex_attributes={"uv": uv})
        uv = others["uv"]
    # Trimesh begins a picture again, too, but a pixel late each time.
    inside = np.where(np.abs(uv - 0.5) > 0.5 + SLIGHT, uv % 1.0, uv)
    colors = kit.visual.color.uv_to_interpolated_color(inside, image).astype(np.float32) / np.float32(255)
    return Part(singles(points, where), freeze(faces.astype(np.int32)), freeze(uv.astype(np.float32)), freeze(colors))


def _in_bytes(picture: Any) -> Any:
    """A picture whose numbers have 16 bits with the upper 8 of them; Pillow takes all above 255 for white."""
    from PIL import Image

    if not picture.mode.startswith("I"):
        return picture
    return Image.fromarray((np.clip(np.asarray(picture), 0, 65535) // 257).astype(np.uint8))


def _pixels(corners: NDArray[np.float64], size: tuple[int, int]) -> float:
    """How many pixels of a picture each triangle has, on the average."""
    (a, b), (c, d) = np.moveaxis(corners[:, 1:] - corners[:, :1], 0, -1) * np.reshape(size, (2, 1))
    return float(np.abs(a * d - b * c).mean()) / 2.0
