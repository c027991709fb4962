"""The reactive engine: cells that remember every answer with the interval and the parameters for which it holds."""

from reactive4d.engine.cells import Axis, Cell, Computed, Formula, Source, moment, narrow, sealed
from reactive4d.engine.engines import Engine, engine
from reactive4d.engine.events import Event
from reactive4d.engine.graphs import Graph
from reactive4d.engine.maps import Affine, Fixed, TimeMap

__all__ = [
    "Affine",
    "Axis",
    "Cell",
    "Computed",
    "Engine",
    "Event",
    "Fixed",
    "Formula",
    "Graph",
    "Source",
    "TimeMap",
    "engine",
    "moment",
    "narrow",
    "sealed",
]
