"""Plotters: what stands in a plotter of PyVista, as a scene: its meshes as they are coloured, its camera, its lamps.

VTK itself says which colour each point or each cell has, so a colour map, its limits, a logarithm, categories and
numbers that are none look as they do in PyVista.
"""

import re
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError
from reactive4d.model.guests import from_pyvista
from reactive4d.model.kinds.aggregates import Group
from reactive4d.model.objects import Object
from reactive4d.model.scenes import Scene
from reactive4d.model.transforms import Matrix
from reactive4d_widgets.renderers import Bar, bar_of, camera_of, lamps_of

__all__ = ["Staged", "staged"]

Array = NDArray[Any]
POINTS, WIRES, SURFACE = 0, 1, 2  # as what VTK draws an actor


@dataclass(frozen=True, slots=True)
class Staged:
    """What stands in one renderer of a plotter.

    Attributes:
        scene: all of it.
        options: how a figure shows it at first.
        bars: its scalar bars.
        missing: what a scene cannot have, in words.
    """

    scene: Scene
    options: dict[str, Any]
    bars: tuple[Bar, ...]
    missing: tuple[str, ...]


def staged(plotter: Any) -> list[Staged]:
    """What stands in each renderer of a plotter of PyVista.

    Args:
        plotter: that was not closed yet.

    >>> import pyvista as pv
    >>> plotter = pv.Plotter(off_screen=True)
    >>> _ = plotter.add_mesh(pv.Cone(), color="tomato", name="cone", show_edges=True)
    >>> (found,) = staged(plotter)
    >>> list(found.scene), list(found.scene.at(0.0)["cone"].members)
    (['cone', 'camera'], ['surface', 'edges'])
    >>> plotter.close()
    """
    return [_renderer(plotter, renderer) for renderer in plotter.renderers]


def _renderer(plotter: Any, renderer: Any) -> Staged:
    scene = Scene()
    missing: list[str] = []
    smooth = False
    for name, actor in renderer.actors.items():
        if not actor.GetVisibility():
            continue
        try:
            made = _actor(actor, missing)
        except ShapeError as error:
            missing.append(f"{name}: {error}")
            continue
        if made is not None:
            scene[_name(name, scene)] = made
            smooth = smooth or actor.GetProperty().GetInterpolation() != 0
    lamps = list(lamps_of(renderer))
    for i, lamp in enumerate(lamps):
        scene[_name(f"light{i + 1}", scene)] = lamp
    scene[_name("camera", scene)] = camera_of(renderer)
    # A plotter draws no creases of its own, and no shadows unless it was told to.
    options: dict[str, Any] = {
        "edges": False,
        "shading": "smooth" if smooth else "flat",
        "theme": "light" if sum(renderer.background_color.float_rgb) > 1.5 else "dark",
        "height": int(plotter.window_size[1] / plotter.shape[0])
        if len(plotter.shape) == 2
        else int(plotter.window_size[1]),
        "grid": renderer.cube_axes_actor is not None,
        "shadows": False,
    }
    bars = tuple([bar_of(title, bar) for title, bar in plotter.scalar_bars.items() if bar in renderer.actors.values()])
    return Staged(scene, options, bars, tuple(dict.fromkeys(missing)))


def _name(name: str, scene: Scene) -> str:
    """What an actor is called in a scene; PyVista calls one that nobody named by the address of its mesh."""
    found = re.sub(r"\(Addr=[^)]*\)|[/#]", "", name).strip() or "actor"
    i, one = 2, found
    while one in scene:
        one, i = f"{found}-{i}", i + 1
    return one


# -- actors --------------------------------------------------------------------------------------------------------


def _actor(actor: Any, missing: list[str]) -> Object | None:
    """An actor as an object; None for what has nothing to draw, or what a scene cannot have."""
    if actor.IsA("vtkVolume"):
        missing.append("volumes")
        return None
    if not actor.IsA("vtkActor"):
        if not actor.IsA("vtkScalarBarActor") and not actor.IsA("vtkCubeAxesActor"):
            missing.append("texts and labels")
        return None
    mapper = actor.GetMapper()
    if mapper is None or actor.IsA("vtkCubeAxesActor"):
        return None
    mapper.Update()
    made = _blocks(actor, mapper) if mapper.IsA("vtkCompositePolyDataMapper") else _mesh(actor, mapper, missing)
    matrix = np.array([[actor.GetMatrix().GetElement(i, j) for j in range(4)] for i in range(4)])
    if made is not None and not np.array_equal(matrix, np.eye(4)):
        made.apply(Matrix(matrix))
    return made


def _blocks(actor: Any, mapper: Any) -> Object:
    prop = actor.GetProperty()
    look: dict[str, Any] = {"color": prop.GetColor(), "scalars": False}
    if mapper.GetScalarVisibility() and mapper.array_name:
        table = mapper.lookup_table
        look["scalars"] = mapper.array_name
        if hasattr(table, "values"):
            look["cmap"] = [tuple(row) for row in np.asarray(table.values) / 255.0]
            look["clim"] = tuple(mapper.scalar_range)
    return from_pyvista(mapper.dataset, opacity=prop.GetOpacity(), **look)


def _mesh(actor: Any, mapper: Any, missing: list[str]) -> Object | None:
    import pyvista

    pv: Any = pyvista
    given = mapper.GetInput()
    if given is None or not given.GetNumberOfPoints():
        return None
    data = pv.wrap(given).copy(deep=False)
    prop = actor.GetProperty()
    colors, is_by_points = _mapped(mapper, data)
    uv, texture = data.active_texture_coordinates, _texture(actor) if colors is None else None
    data.clear_data()
    data.set_active_scalars(None)
    if colors is not None:
        (data.point_data if is_by_points else data.cell_data)["paint"] = colors
    look: dict[str, Any] = {"color": prop.GetColor(), "opacity": prop.GetOpacity()}
    scalars: Any = "paint" if colors is not None else False
    style = prop.GetRepresentation()
    is_pictured = style == SURFACE and uv is not None and texture is not None
    if texture is not None and not is_pictured:
        missing.append("pictures on what is no surface, or has no texture coordinates")
    if style == POINTS:
        return from_pyvista(
            pv.PointSet(data.points), scalars=colors if colors is not None and is_by_points else False, **look
        )
    if style == WIRES:
        return from_pyvista(_edges(data), scalars=scalars, **look)
    if is_pictured:
        data.active_texture_coordinates = np.asarray(uv)[:, :2]
        surface = from_pyvista(data, texture=texture, opacity=prop.GetOpacity())
    else:
        surface = from_pyvista(data, scalars=scalars, **look)
    if not prop.GetEdgeVisibility():
        return surface
    edges = _edges(data)
    edges.clear_data()
    if not edges.n_cells:
        return surface
    lines = from_pyvista(edges, scalars=False, color=prop.GetEdgeColor(), opacity=prop.GetOpacity())
    return Group(surface=surface, edges=lines)


def _mapped(mapper: Any, data: Any) -> tuple[Array | None, bool]:
    """The colours that VTK gives, (n, 4) bytes, and whether they are those of points; None where it gives none."""
    if not mapper.GetScalarVisibility():
        return None, True
    before = mapper.GetInterpolateScalarsBeforeMapping()
    mapper.InterpolateScalarsBeforeMappingOff()  # else it makes a picture of the colour map
    try:
        found = mapper.MapScalars(1.0)
    finally:
        mapper.SetInterpolateScalarsBeforeMapping(before)
    if found is None:
        return None, True
    import pyvista

    kit: Any = pyvista
    colors = np.array(kit.convert_array(found), np.uint8)
    if colors.ndim != 2 or len(colors) not in (data.n_points, data.n_cells):
        return None, True
    mode = mapper.GetScalarMode()  # 0 points before cells, 1 and 3 points, 2 and 4 cells
    is_by_points = len(colors) == data.n_points and mode not in (2, 4)
    return colors, is_by_points


def _texture(actor: Any) -> Any:
    """The picture on an actor; None where there is none."""
    found = actor.GetTexture() or actor.GetProperty().GetTexture("albedoTex")
    if found is not None:
        found.Update()
    return None if found is None or found.GetInput() is None else found


def _edges(data: Any) -> Any:
    """The edges of all cells of the surface, as lines."""
    import pyvista
    from vtkmodules.vtkFiltersCore import vtkExtractEdges
    from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter

    kit: Any = pyvista
    found = data
    for make in (vtkDataSetSurfaceFilter, vtkExtractEdges):
        maker: Any = make()
        maker.SetInputData(found)
        maker.Update()
        found = maker.GetOutput()
    return kit.wrap(found)
