"""Pictures: what VTK draws of a composition, without a window. No other module makes VTK's types."""

from collections.abc import Generator, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np
import pyvista as pv
from numpy.typing import NDArray
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkWindowToImageFilter

from reactive4d_widgets.compositions import Composition, Strokes, Surface
from reactive4d_widgets.displays import drawable
from reactive4d_widgets.shadows import Eye
from reactive4d_widgets.views import View

__all__ = ["Picture", "distances", "picture"]

Pixels = NDArray[np.uint8]
PEELS = 12  # layers of what is seen through, from the front to the back


@dataclass(frozen=True, slots=True)
class Picture:
    """What was drawn.

    Attributes:
        colors: (H, W, 4), sRGB from 0 to 1, multiplied by the fourth: how much of what is behind is hidden.
        depths: (H, W), metres ahead of the eye of the nearest surface that lets no light through; NaN where none is.
    """

    colors: NDArray[np.float32]
    depths: NDArray[np.float32]


def picture(
    composition: Composition,
    view: View,
    *,
    size: tuple[int, int],
    shader: str | None,
    finer: int = 1,
    stroke: float = 2.0,
    dot: float = 8.0,
    crease: float = 0.0,
) -> Picture:
    """Draw a composition, but for its labels.

    Args:
        composition: what is drawn.
        view: from where.
        size: width and height, pixels.
        shader: how surfaces are lit; None shows their plain colours.
        finer: how many pixels are drawn for one, along each edge: what is drawn larger and made smaller has smooth
            edges, lines too, on every card.
        stroke: how wide lines are, pixels.
        dot: how wide points are, pixels.
        crease: how wide the edges of surfaces are, pixels; 0 leaves them out.

    Raises:
        EvaluationError: there is no OpenGL on this machine.
    """
    stroke, dot, crease = finer * stroke, finer * dot, finer * crease
    with _drawn_on((finer * size[0], finer * size[1])) as plotter:
        plotter.add_light(pv.Light(light_type="headlight"))  # a lit surface is one on which some lamp of VTK's shines
        for actor in _actors(composition, shader, view=view, stroke=stroke, dot=dot, crease=crease):
            plotter.add_actor(actor, reset_camera=False, render=False)
        if composition.clear is not None:
            plotter.renderer.SetUseDepthPeeling(True)
            plotter.renderer.SetMaximumNumberOfPeels(PEELS)
            plotter.renderer.SetOcclusionRatio(0.0)
        near, far = _range(composition, view)
        _stand(plotter, view.matrix, view.fov, (near, far))
        found = plotter.screenshot(return_img=True, transparent_background=True)
        colors: Any = sum(part.astype(np.float32) for part in _parts(found, finer))
        share = _nearest(_parts(_depth_buffer(plotter), finer))
        depths = near * far / (far - share * (far - near))
        return Picture(colors / np.float32(255 * finer * finer), np.where(share < 1.0, depths, np.float32(np.nan)))


def distances(composition: Composition, eye: Eye, size: int) -> NDArray[np.float64]:
    """(S, S), metres ahead of an eye of the nearest surface, NaN where there is none; what is clear does not count.

    Args:
        composition: what there is.
        eye: from where.
        size: of the picture, pixels.

    Raises:
        EvaluationError: there is no OpenGL on this machine.
    """
    with _drawn_on((size, size)) as plotter:
        if composition.opaque is not None:
            plotter.add_actor(_surface(composition.opaque, None), reset_camera=False, render=False)
        _stand(plotter, eye.matrix, eye.fov, (eye.near, eye.far))
        if eye.half is not None:
            plotter.camera.parallel_projection = True
            plotter.camera.parallel_scale = eye.half
        plotter.screenshot(return_img=True)
        share = _depth_buffer(plotter).astype(np.float64)
        near, far = eye.near, eye.far
        depths = near + share * (far - near) if eye.half is not None else near * far / (far - share * (far - near))
        return np.where(share < 1.0, depths, np.nan)


@contextmanager
def _drawn_on(size: tuple[int, int]) -> Generator[Any]:
    """Something to draw on, while the block runs."""
    with drawable():
        plotter: Any = pv.Plotter(off_screen=True, window_size=list(size), lighting="none", theme=pv.themes.Theme())
    try:
        # Peeling wants one sample for a pixel; what is smooth is made so by drawing larger than wanted.
        plotter.render_window.SetMultiSamples(0)
        plotter.render_window.AlphaBitPlanesOn()
        plotter.background_color = (0.0, 0.0, 0.0)
        yield plotter
    finally:
        plotter.close()


def _stand(plotter: Any, matrix: Any, fov: float, span: tuple[float, float]) -> None:
    camera = plotter.camera
    eye = matrix[:3, 3]
    camera.position, camera.focal_point, camera.up = tuple(eye), tuple(eye - matrix[:3, 2]), tuple(matrix[:3, 1])
    if fov:
        camera.view_angle = fov
    camera.clipping_range = span


def _parts(pixels: Any, finer: int) -> list[Any]:
    """The first pixels of all that become one, the second ones, and so on."""
    return [pixels[i::finer, j::finer] for i in range(finer) for j in range(finer)]


def _nearest(parts: list[Any]) -> Any:
    least = parts[0]
    for part in parts[1:]:
        least = np.minimum(least, part)
    return least


def _depth_buffer(plotter: Any) -> NDArray[np.float32]:
    """(H, W), from 0 at the nearest that can be seen to 1 at the farthest."""
    reader: Any = vtkWindowToImageFilter()
    reader.SetInput(plotter.render_window)
    reader.SetInputBufferTypeToZBuffer()
    reader.ReadFrontBufferOff()
    reader.ShouldRerenderOff()
    reader.Update()
    found: Any = pv.ImageData(reader.GetOutput())
    width, height = plotter.window_size
    shares: NDArray[np.float32] = np.array(found.active_scalars, np.float32).reshape(height, width)[::-1]
    return shares


def _actors(
    composition: Composition, shader: str | None, *, view: View, stroke: float, dot: float, crease: float
) -> Iterator[Any]:
    if composition.opaque is not None:
        yield _surface(composition.opaque, shader)
    if composition.clear is not None:
        actor = _surface(composition.clear, shader)
        actor.ForceTranslucentOn()
        yield actor
    if composition.creases is not None and crease:
        actor = _strokes(_nearer(composition.creases, view))
        actor.GetProperty().SetLineWidth(crease)
        yield actor
    if composition.lines is not None:
        actor = _strokes(composition.lines)
        actor.GetProperty().SetLineWidth(stroke)
        yield actor
    if composition.dots is not None:
        actor = _strokes(composition.dots)
        actor.GetProperty().SetPointSize(dot)
        actor.GetProperty().RenderPointsAsSpheresOn()
        yield actor


def _actor(data: Any, colors: Pixels) -> Any:
    data.point_data["colors"] = colors
    data.point_data.active_scalars_name = "colors"
    mapper: Any = vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.SetColorModeToDirectScalars()
    actor: Any = vtkActor()
    actor.SetMapper(mapper)
    return actor


def _surface(surface: Surface, shader: str | None) -> Any:
    data: Any = pv.PolyData()
    data.points, data.regular_faces = surface.points, surface.faces
    data.point_data["normals"] = surface.normals
    data.point_data.active_normals_name = "normals"
    actor = _actor(data, surface.colors)
    if shader is None:
        actor.GetProperty().LightingOff()
    else:
        # With it VTK hands the shader where a pixel is; of what it makes of that itself nothing remains.
        actor.GetProperty().SetInterpolationToPBR()
        actor.GetShaderProperty().AddFragmentShaderReplacement("//VTK::Light::Impl", True, shader, False)
    return actor


def _strokes(strokes: Strokes) -> Any:
    data: Any = pv.PolyData()
    data.points = strokes.points
    count, width = strokes.lines.shape
    cells = np.concatenate([np.full((count, 1), width), strokes.lines], axis=1).ravel()
    if width == 1:
        data.verts = cells
    else:
        data.lines = cells
    actor = _actor(data, strokes.colors)
    actor.GetProperty().LightingOff()
    return actor


def _range(composition: Composition, view: View) -> tuple[float, float]:
    """Between which distances there is something; the narrower they are, the better near and far can be told apart."""
    parts = [composition.opaque, composition.clear, composition.lines, composition.dots]
    ahead = -view.matrix[:3, 2]
    depths = [(part.points - np.asarray(view.position)) @ ahead for part in parts if part is not None]
    nearest = min([float(depth.min()) for depth in depths], default=view.near)
    farthest = max([float(depth.max()) for depth in depths], default=view.far)
    near = max(view.near, 0.9 * nearest, 1e-4 * farthest)
    return near, max(min(view.far, 1.1 * farthest), 2.0 * near)


def _nearer(strokes: Strokes, view: View) -> Strokes:
    """A little towards the eye, so that surfaces do not hide their own edges."""
    ways = np.asarray(view.position, np.float64) - strokes.points
    return Strokes((strokes.points + 0.002 * ways).astype(np.float32), strokes.colors, strokes.lines)
