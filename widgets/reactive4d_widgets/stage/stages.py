"""Stages: a scene as VTK keeps it, from instant to instant, and the pictures of it."""

from collections.abc import Mapping
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkTexture

from reactive4d.model.frames import Frame
from reactive4d.model.nodes import Node
from reactive4d_widgets.captions import captioned, label_of
from reactive4d_widgets.distances import refuse_far
from reactive4d_widgets.lamps import Lamp, light_of
from reactive4d_widgets.stage import floors
from reactive4d_widgets.stage.bodies import Body, Look
from reactive4d_widgets.stage.grounds import Ground, textured
from reactive4d_widgets.stage.lights import Lights
from reactive4d_widgets.stage.shaders import MAP, NEARER
from reactive4d_widgets.stage.shades import MOST, SIZE, Eye, eye_of
from reactive4d_widgets.stage.windows import Window, stand
from reactive4d_widgets.themes import THEMES, Theme
from reactive4d_widgets.views import View

__all__ = ["Stage"]

Array = NDArray[np.float64]
LARGEST = 8192  # pixels; beyond it cards have no textures
PEELS = 12  # layers of what is seen through, from the front to the back
CLOSER = 0.998  # edges are drawn at this share of their distance


class Stage:
    """A scene as VTK keeps it. Of one instant after the other only what changed is touched.

    Args:
        size: width and height of its pictures, pixels.
        theme: the surroundings.
        edges: whether creases are drawn.
        shadows: whether things throw shadows.
        plain: whether things are shown in their plain colours: without light, edges and smooth borders.
        ratio: how many pixels of the picture are one of a label's height and of a line's width; by default one,
            and more where the picture is higher than 600.

    Attributes:
        touched: what the last picture touched of each object, by its name: "actors" (others are there now), "shape",
            "points", "paints", "matrix", "visible". An object that did not change is not in it.

    Raises:
        EvaluationError: there is no OpenGL on this machine.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere(color="crimson")
    >>> _ = ball.translate(r4.vec(r4.time, 0, 0))
    >>> scene, view = r4.Scene(ball=ball, box=r4.Box()), View((0, -9, 2), (0, 0, 0))
    >>> with Stage(size=(320, 240)) as stage:
    ...     for t in (0.0, 1.0):
    ...         picture = stage.drawn(scene.at(t), view, bounds=[(-1, -1, -1), (2, 1, 1)])
    ...     picture.shape, stage.touched
    ((240, 320, 3), {'ball': ('matrix',)})
    """

    def __init__(
        self,
        *,
        size: tuple[int, int],
        theme: Theme = THEMES["light"],
        edges: bool = True,
        shadows: bool = True,
        plain: bool = False,
        ratio: float | None = None,
    ) -> None:
        width, height = size
        self.size = size
        self.touched: dict[str, tuple[str, ...]] = {}
        self._theme = theme
        self._plain = plain
        self._ratio = max(1.0, height / 600.0) if ratio is None else ratio
        # What is drawn larger and made smaller has smooth edges, lines too, on every card.
        self._finer = 1 if plain or max(width, height) * 2 > LARGEST else 2
        self._shadows = shadows and not plain
        self._window = Window((width * self._finer, height * self._finer), layers=2)
        self._distances = Window((SIZE, SIZE)) if self._shadows else None
        self._lights = None if plain else Lights()
        self._nearer: Any = vtkActor().GetShaderProperty()
        self._nearer.AddVertexShaderReplacement("//VTK::PositionVC::Impl", True, NEARER, False)
        pixel = self._ratio * self._finer
        self._look = Look(
            lights=self._lights,
            nearer=self._nearer,
            stroke=2.0 * pixel,
            dot=8.0 * pixel,
            crease=1.1 * pixel if edges and not plain else 0.0,
            casts=self._shadows,
        )
        self._bodies: dict[str, Body] = {}
        self._cast = 0  # how often something that throws shadows was touched
        self._seen: dict[str, Any] = {"map": None, "floor": None}
        self._map: Any = vtkTexture()
        self._map.SetColorModeToDirectScalars()
        self._map.InterpolateOff()
        self._map.MipmapOff()
        self._map.SetInputData(textured(np.full((1, 1, 4), 255, np.uint8)))
        self._ground = Ground(theme)
        self._equip()

    def _equip(self) -> None:
        back, front = self._window.layers
        back.SetBackground(*self._theme.paper)
        back.AddActor(self._ground.prop)
        headlight: Any = vtkLight()
        headlight.SetLightTypeToHeadlight()
        front.AddLight(headlight)  # a lit surface is one on which some lamp of VTK's shines
        front.SetMaximumNumberOfPeels(PEELS)
        front.SetOcclusionRatio(0.0)

    def drawn(
        self, frame: Frame, view: View, *, bounds: Any, colors: Mapping[str, Any] | None = None
    ) -> NDArray[np.uint8]:
        """(H, W, 3), a picture, sRGB.

        Args:
            frame: of a scene.
            view: from where.
            bounds: (2, 3), the box of all that is drawn, over all times, metres: below it is the floor.
            colors: (4,) numbers from 0 to 1 that nodes have instead of their colour and their paints, by name.
        """
        nodes = dict(frame)
        self._enter(nodes, colors or {})
        box = np.asarray(bounds, np.float64)
        corners = [body.corners for body in self._bodies.values() if body.corners is not None]
        places = np.concatenate(corners) if corners else np.zeros((0, 3))
        near, far = _range(places, view)
        back, front = self._window.layers
        stand(back.GetActiveCamera(), view.matrix, fov=view.fov, near=view.near, far=view.far)
        stand(front.GetActiveCamera(), view.matrix, fov=view.fov, near=near, far=far)
        self._nearer.GetVertexCustomUniforms().SetUniformf(
            "r4Nearer", 2.0 * far * near / (near - far) * (1 / CLOSER - 1)
        )
        front.SetUseDepthPeeling(any(body.clear and body.corners is not None for body in self._bodies.values()))
        if self._lights is not None:
            sky, lamps = light_of(nodes.values(), view)
            eyes = self._eyes(lamps, box)
            self._lights.shine(sky, lamps, view, eyes=eyes, rim=self._theme.rim)
        self._lay(box, view)
        self._window.draw()
        image = self._window.colors()
        image = image if self._finer == 1 else image.reduce(self._finer)
        if not self._plain:
            labels = [label_of(node) for node in nodes.values() if node.visible and node.primitive == "label"]
            image = captioned(image, labels, view, ratio=self._ratio, paper=self._theme.paper)
        return np.asarray(image)

    # -- who is on it ----------------------------------------------------------------------------------------------

    def _enter(self, nodes: Mapping[str, Node], colors: Mapping[str, Any]) -> None:
        """Bring the bodies up to date."""
        self.touched = {}
        gone = [name for name in self._bodies if name not in nodes]
        for name in gone:
            del self._bodies[name]
        others = bool(gone)
        for name, node in nodes.items():
            body = self._bodies.get(name)
            if body is None:
                body = self._bodies[name] = Body(self._look)
                others = True
            threw = body.caster is not None and body.corners is not None and not body.clear
            if node is not body.node:
                refuse_far(name, node)
            touched = body.show(node, colors.get(name))
            if touched:
                self.touched[name] = touched
                throws = body.caster is not None and body.corners is not None and not body.clear
                others = others or "actors" in touched
                if threw != throws or (throws and touched != ("paints",)):
                    self._cast += 1
        if others or list(self._bodies) != list(nodes):
            self._bodies = {name: self._bodies[name] for name in nodes}
            self._line_up()

    def _line_up(self) -> None:
        """All actors, in the order of the frame."""
        self._cast += 1
        front = self._window.layers[1]
        front.RemoveAllViewProps()
        for body in self._bodies.values():
            for prop in body.props:
                front.AddActor(prop)
        if self._distances is not None:
            self._distances.layers[0].RemoveAllViewProps()
            for body in self._bodies.values():
                if body.caster is not None:
                    self._distances.layers[0].AddActor(body.caster.prop)
                    for prop in body.props:
                        prop.GetProperty().SetTexture(MAP, self._map)
                        break

    # -- their shadows ---------------------------------------------------------------------------------------------

    def _eyes(self, lamps: tuple[Lamp, ...], box: Array) -> list[Eye | None]:
        """For each lamp who sees what stands in its light; the map of what they see is drawn."""
        throwing = [body.corners for body in self._bodies.values() if body.corners is not None and not body.clear]
        if self._distances is None or not throwing:
            return [None for _ in lamps]
        places = np.concatenate([*throwing, box])
        low, high = places.min(axis=0), places.max(axis=0)
        eyes = [eye_of(lamp, low, high) if lamp.shadows else None for lamp in lamps]
        seeing = [eye for eye in eyes if eye is not None]
        for extra in seeing[MOST:]:
            eyes[eyes.index(extra)] = None
        seeing = seeing[:MOST]
        key = self._cast, *[eye.key for eye in seeing]
        if seeing and key != self._seen["map"]:
            self._seen["map"] = key
            shares = np.concatenate([self._look_from(eye, SIZE) for eye in seeing])
            digits = np.rint(shares * 16777215.0).astype("<u4")  # three bytes of the four
            self._map.SetInputData(textured(digits.view(np.uint8).reshape(*shares.shape, 4)))
        return eyes

    def _look_from(self, eye: Eye, size: int) -> NDArray[np.float32]:
        """(S, S), from 0 at the nearest that an eye can see to 1 at the farthest; the first row is the lowest."""
        assert self._distances is not None
        layer = self._distances.layers[0]
        layer.SetViewport(0.0, 0.0, size / SIZE, size / SIZE)
        stand(layer.GetActiveCamera(), eye.matrix, fov=eye.fov, near=eye.near, far=eye.far, half=eye.half)
        self._distances.draw()
        return self._distances.shares(size)

    def _lay(self, box: Array, view: View) -> None:
        """The floor, with the shade of all that is above it."""
        throwing = any(body.corners is not None and not body.clear for body in self._bodies.values() if body.caster)
        floor = floors.floor_of(*box) if self._shadows and throwing else None
        if floor is None:
            self._ground.hide()
            return
        key = self._cast, floor.center.tobytes(), floor.half, floor.reach
        if key != self._seen["floor"]:
            self._seen["floor"] = key
            eye = floor.eye
            share = self._look_from(eye, floors.SIZE)[::-1]
            depths = np.where(share < 1.0, eye.near + share * (eye.far - eye.near), np.nan)
            self._ground.darken(floor, floors.floor_dark(floor, depths))
        self._ground.show(view)

    # -- its end ---------------------------------------------------------------------------------------------------

    def close(self) -> None:
        """Give back what it took; no picture can be taken any more."""
        self._bodies.clear()
        self._window.close()
        if self._distances is not None:
            self._distances.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _range(places: Array, view: View) -> tuple[float, float]:
    """Between which distances there is something; the narrower they are, the better near and far can be told apart."""
    depths = (places - np.asarray(view.position)) @ -view.matrix[:3, 2]
    nearest, farthest = (float(depths.min()), float(depths.max())) if len(depths) else (view.near, view.far)
    near = max(view.near, 0.9 * nearest, 1e-4 * farthest)
    return near, max(min(view.far, 1.1 * farthest), 2.0 * near)
