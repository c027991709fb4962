"""Accessors: what datasets and plotters of PyVista can do with us, as `mesh.reactive4d` and `plotter.reactive4d`.

PyVista imports this module when somebody asks for either the first time; to be imported is to be registered.
"""

from pathlib import Path
from typing import Any

import pyvista

from reactive4d.model.guests import from_pyvista
from reactive4d.model.objects import Object
from reactive4d.model.scenes import Scene
from reactive4d_widgets.backends import handle
from reactive4d_widgets.plotters import staged

__all__ = ["OfDataset", "OfPlotter"]

NAME = "reactive4d"


class OfDataset:
    """What a dataset can do with us: `mesh.reactive4d`.

    >>> import pyvista as pv
    >>> import reactive4d as r4
    >>> cone = pv.Cone().reactive4d.object(color="tomato")
    >>> _ = cone.rotate(90 * r4.time)
    >>> r4.Scene(cone=cone).at(1.0)["cone"].matrix.round(3)[:2, :2].tolist()
    [[0.0, -1.0], [1.0, 0.0]]
    """

    def __init__(self, dataset: Any) -> None:
        self._dataset = dataset

    def object(self, **options: Any) -> Object:
        """It as an object.

        Args:
            **options: as `reactive4d.from_pyvista` takes them: scalars, cmap, clim, color, opacity.

        Raises:
            ShapeError: it has nothing to draw, or is broken.
        """
        return from_pyvista(self._dataset, **options)


class OfPlotter:
    """What a plotter can do with us: `plotter.reactive4d`.

    >>> import pyvista as pv
    >>> plotter = pv.Plotter(off_screen=True)
    >>> _ = plotter.add_mesh(pv.Cone(), color="tomato", name="cone")
    >>> plotter.reactive4d.scene.at(0.0)["cone"].kind
    'model'
    >>> plotter.close()
    """

    def __init__(self, plotter: Any) -> None:
        self._plotter = plotter

    @property
    def scene(self) -> Scene:
        """What stands in the active subplot by now, as a scene of its own: it can be moved, baked and served."""
        renderers = list(self._plotter.renderers)
        return staged(self._plotter)[renderers.index(self._plotter.renderer)].scene

    def show(self, **options: Any) -> Any:
        """Put it into the cell that runs, as `pv.set_jupyter_backend("reactive4d")` does.

        Args:
            **options: `live`, `title`, and how the figure is shown.
        """
        cell = handle(self._plotter, **options)
        cell._ipython_display_()  # pyright: ignore[reportPrivateUsage]
        return cell

    def bake(self, path: str | Path, **options: Any) -> Any:
        """Write the active subplot as one page that needs no server.

        Args:
            path: of the file, .html.
            **options: as `Scene.bake` takes them.
        """
        renderers = list(self._plotter.renderers)
        found = staged(self._plotter)[renderers.index(self._plotter.renderer)]
        return found.scene.bake(path, **{**options, "options": {**found.options, **(options.get("options") or {})}})


def _register() -> None:
    pv: Any = pyvista
    for target in (pv.DataSet, pv.MultiBlock):
        pv.register_dataset_accessor(NAME, target)(OfDataset)
    pv.register_plotter_component(NAME)(OfPlotter)


_register()
