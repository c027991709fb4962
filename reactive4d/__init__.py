"""Models that can be asked for any instant: signals, and a memo that knows how long an answer holds."""

from reactive4d.errors import Reactive4dError
from reactive4d.intervals import FOREVER, Interval, IntervalSet
from reactive4d.signals.algebra import equal, lift, vec
from reactive4d.signals.choices import where
from reactive4d.signals.functions import signal
from reactive4d.signals.signal import Signal
from reactive4d.signals.sources import Parameter, Variable, time

__all__ = [
    "FOREVER",
    "Interval",
    "IntervalSet",
    "Parameter",
    "Reactive4dError",
    "Signal",
    "Variable",
    "equal",
    "lift",
    "signal",
    "time",
    "vec",
    "where",
]
