"""Datasets of PyVista, taken apart: triangles, straight lines and points, each with the numbers that colour them.

Polygons and strips are triangulated, of volumes the surface is taken. Nothing here is lazy: what comes out is plain
arrays, and the dataset may be changed afterwards.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError, hint, unknown
from reactive4d.geometry.sizes import singles

__all__ = ["Part", "parts_of", "weld_of"]

Array = NDArray[Any]
PAINT = "reactive4d paint"


@dataclass(frozen=True, slots=True)
class Part:
    """One kind of cells of a dataset.

    Attributes:
        points: (V, 3) float32.
        cells: (F, 3) triangles, (K, 2) straight lines, or (N, 1) points; int32.
        uv: (V, 2) texture coordinates, or None.
        paint: numbers or colours by which it is coloured, with a row for each point or for each cell; or None.
        is_by_points: whether its rows are those of points.
    """

    points: NDArray[np.float32]
    cells: NDArray[np.int32]
    uv: NDArray[np.float32] | None = None
    paint: Array | None = None
    is_by_points: bool = True

    def __len__(self) -> int:
        return len(self.cells)


def parts_of(dataset: Any, scalars: Any = None, *, where: str = "mesh") -> dict[str, Part]:
    """The surface, the lines and the points of a dataset, as far as it has them.

    Args:
        dataset: of PyVista or VTK, not of several blocks.
        scalars: what colours it: the name of an array, an array, None for the active one if there is one, or False.
        where: what it is called in errors.

    Raises:
        ShapeError: it is no dataset, has nothing to draw, a point that is not finite, or a cell of points that are
            not there.
        UnknownNameError: there is no array of that name.

    >>> import pyvista as pv
    >>> found = parts_of(pv.Cube())
    >>> {name: part.cells.shape for name, part in found.items()}
    {'surface': (12, 3)}
    """
    import pyvista

    pv: Any = pyvista
    data = pv.wrap(dataset) if hasattr(dataset, "GetClassName") else dataset
    if not isinstance(data, pv.DataSet):
        raise hint(ShapeError(f"{where}: expected a dataset of PyVista, got {dataset!r}"), "such as pv.Sphere()")
    if not data.n_points:
        raise hint(ShapeError(f"{where}: a {type(data).__name__} without points"), "there is nothing to be seen of it")
    singles(data.points, f"{where}.points")
    _refuse_strays(data, where)
    paint, is_by_points = _paint_of(data, scalars, where)
    bare: Any = data.copy(deep=False)
    bare.clear_point_data()
    bare.clear_cell_data()
    uv = data.active_texture_coordinates if hasattr(data, "active_texture_coordinates") else None
    if uv is not None and uv.ndim == 2 and uv.shape[1] >= 2:
        bare.point_data["uv"] = np.asarray(uv, np.float32)[:, :2]
    if paint is not None:
        (bare.point_data if is_by_points else bare.cell_data)[PAINT] = paint
    found = _cells_of(_triangulated(bare), is_by_points=is_by_points)
    if not found:
        raise hint(ShapeError(f"{where}: a {type(data).__name__} without cells to draw"), "there is nothing to be seen")
    if len(found) == 1:
        return found
    return {name: _compact(part) for name, part in found.items()}


def _refuse_strays(data: Any, where: str) -> None:
    """VTK itself reads beyond its arrays where a cell names a point that is not there."""
    for get in ("GetVerts", "GetLines", "GetPolys", "GetStrips", "GetCells"):
        cells = getattr(data, get, lambda: None)()
        numbers = (
            None
            if cells is None or not hasattr(cells, "GetConnectivityArray")
            else _array(cells.GetConnectivityArray())
        )
        if numbers is not None and numbers.size and not (numbers.min() >= 0 and numbers.max() < data.n_points):
            stray = int(numbers.max() if numbers.max() >= data.n_points else numbers.min())
            raise ShapeError(f"{where}: a cell names the point {stray}, and there are {data.n_points}")


def _array(array: Any) -> Array:
    import vtkmodules.util.numpy_support as bridge  # pyright: ignore[reportMissingTypeStubs]

    support: Any = bridge
    return support.vtk_to_numpy(array)


def _paint_of(data: Any, scalars: Any, where: str) -> tuple[Array | None, bool]:
    """What a dataset is coloured by, (n,) numbers or (n, 3 or 4) colours, and whether its rows are those of points."""
    if scalars is False:
        return None, True
    if scalars is None or isinstance(scalars, str):
        name: Any = data.active_scalars_name if scalars is None else scalars
        if name is None:
            return None, True
        if name not in data.point_data and name not in data.cell_data:
            raise unknown(name, [*data.point_data, *data.cell_data], what=f"array of {where}:")
        is_of_cells = scalars is None and data.active_scalars_info.association.name == "CELL"
        is_by_points = name in data.point_data and not (is_of_cells and name in data.cell_data)
        found = np.asarray((data.point_data if is_by_points else data.cell_data)[name])
    else:
        name = "scalars"
        try:
            found = np.asarray(scalars)
        except ValueError:  # rows of different lengths
            found = np.zeros(())
        if not found.ndim:
            error = ShapeError(f"{where}: scalars: expected the name of an array, or numbers, got {scalars!r}")
            raise hint(error, "scalars=False leaves it of one colour")
        if len(found) not in (data.n_points, data.n_cells):
            error = ShapeError(f"{where}: scalars: expected {data.n_points} rows, one for each point, got {len(found)}")
            raise hint(error, f"or {data.n_cells}, one for each cell")
        is_by_points = len(found) == data.n_points
    if found.dtype.kind not in "fiub":
        raise hint(
            ShapeError(f"{where}: the array {name!r} has no numbers but {found.dtype}"), "scalars=False leaves it"
        )
    if found.ndim > 2 or not found[:1].size:
        error = ShapeError(f"{where}: the array {name!r}: expected numbers or rows of them, got shape {found.shape}")
        raise hint(error, "scalars=False leaves it")
    return _plain(found), is_by_points


def _plain(found: Array) -> Array:
    """Numbers, or colours from 0 to 1."""
    if found.ndim == 1:
        return found.astype(np.float64)
    if found.dtype == np.uint8 and found.shape[1] in (3, 4):
        colors = np.ones((len(found), 4), np.float32)
        colors[:, : found.shape[1]] = found / np.float32(255)
        return colors
    if found.shape[1] == 1:
        return found[:, 0].astype(np.float64)
    with np.errstate(over="ignore"):  # what is too long for a number has the last colour
        return np.linalg.norm(found.astype(np.float64), axis=1)


def _triangulated(bare: Any) -> Any:
    """The surface as triangles, lines of two points, single points."""
    import pyvista
    from vtkmodules.vtkFiltersCore import vtkTriangleFilter
    from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter

    pv: Any = pyvista

    def passed(make: Any, data: Any) -> Any:
        maker = make()
        maker.SetInputData(data)
        maker.Update()
        return pv.wrap(maker.GetOutput())

    if isinstance(bare, pv.PointSet) or not bare.n_cells:
        cloud = pv.PolyData()
        cloud.points = bare.points
        indices = np.arange(int(bare.n_points))
        cloud.verts = np.stack([np.ones_like(indices), indices], axis=1).ravel()
        for name in bare.point_data:
            cloud.point_data[name] = bare.point_data[name]
        return cloud
    surface = bare if isinstance(bare, pv.PolyData) else passed(vtkDataSetSurfaceFilter, bare)
    return passed(vtkTriangleFilter, surface)


def _cells_of(data: Any, *, is_by_points: bool) -> dict[str, Part]:
    points = singles(data.points, "points")
    uv = freeze(np.array(data.point_data["uv"], np.float32)) if "uv" in data.point_data else None
    rows = data.point_data if is_by_points else data.cell_data
    paint = np.array(rows[PAINT]) if PAINT in rows else None
    found: dict[str, Part] = {}
    start = 0
    # In the order in which VTK numbers the cells of its PolyData.
    for name, cells, width in (
        ("points", data.GetVerts(), 1),
        ("lines", data.GetLines(), 2),
        ("surface", data.GetPolys(), 3),
    ):
        count = cells.GetNumberOfCells()
        if count:
            indices = _array(cells.GetConnectivityArray()).astype(np.int32).reshape(-1, width)
            own = paint if paint is None or is_by_points else paint[start : start + count]
            found[name] = Part(points, freeze(indices), uv, own, is_by_points)
        start += count
    return found


def _compact(part: Part) -> Part:
    """The same without the points that none of its cells names."""
    used, cells = np.unique(part.cells, return_inverse=True)
    return replace(
        part,
        points=freeze(part.points[used]),
        cells=freeze(cells.reshape(part.cells.shape).astype(np.int32)),
        uv=None if part.uv is None else freeze(part.uv[used]),
        paint=part.paint[used] if part.paint is not None and part.is_by_points else part.paint,
    )


def weld_of(points: Array) -> NDArray[np.int32] | None:
    """For each point the first one at its place, (V,); None where no two are at one place.

    Args:
        points: (V, n): coordinates, at one time or at several.

    >>> weld_of(np.array([[0, 0, 0], [1, 0, 0], [0, 0, 0]], np.float32)).tolist()
    [0, 1, 0]
    """
    rows = np.ascontiguousarray(points.astype(np.float32) + np.float32(0))  # -0 is 0
    keys = rows.view([("", rows.dtype)] * rows.shape[1]).ravel() if rows.shape[1] else rows.ravel()
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    if len(first) == len(rows):
        return None
    return freeze(first[inverse.reshape(-1)].astype(np.int32))
