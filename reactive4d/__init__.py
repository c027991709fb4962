"""Models that can be asked for any instant: signals, and a memo that knows how long an answer holds."""

import sys

from reactive4d import process as _process
from reactive4d.engine.events import Event
from reactive4d.engine.graphs import Graph
from reactive4d.errors import (
    CycleError,
    DepthError,
    EvaluationError,
    ParameterError,
    Reactive4dError,
    ShapeError,
    TimeError,
    UnknownNameError,
)
from reactive4d.intervals import FOREVER, Interval, IntervalSet
from reactive4d.process import explain, graph, log, stats, transaction
from reactive4d.signals.algebra import equal, lift, vec
from reactive4d.signals.choices import where
from reactive4d.signals.colors import color
from reactive4d.signals.curves import Key
from reactive4d.signals.facade import Signal
from reactive4d.signals.functions import signal
from reactive4d.signals.keys import Keys, keys
from reactive4d.signals.rotations import Rotation
from reactive4d.signals.sources import Parameter, Variable, time

__all__ = [
    "FOREVER",
    "CycleError",
    "DepthError",
    "EvaluationError",
    "Event",
    "Graph",
    "Interval",
    "IntervalSet",
    "Key",
    "Keys",
    "Parameter",
    "ParameterError",
    "Reactive4dError",
    "Rotation",
    "ShapeError",
    "Signal",
    "TimeError",
    "UnknownNameError",
    "Variable",
    "color",
    "equal",
    "explain",
    "graph",
    "keys",
    "lift",
    "log",
    "signal",
    "stats",
    "time",
    "transaction",
    "vec",
    "where",
]

budget: int
sys.modules[__name__].__class__ = _process.Budgeted
