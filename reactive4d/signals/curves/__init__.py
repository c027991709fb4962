"""Key-framed curves as immutable values: what they answer, where it holds, and what an edit touches."""

from reactive4d.signals.curves.controls import Key
from reactive4d.signals.curves.curve import Curve
from reactive4d.signals.curves.extrapolations import EXTRAPOLATIONS, Extrapolation
from reactive4d.signals.curves.interpolations import INTERPOLATIONS
from reactive4d.signals.curves.kinds import KINDS, Kind

__all__ = ["EXTRAPOLATIONS", "INTERPOLATIONS", "KINDS", "Curve", "Extrapolation", "Key", "Kind"]
