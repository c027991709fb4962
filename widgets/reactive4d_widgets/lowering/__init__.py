"""Lowering: signals as tracks, which a viewer plays without asking."""

from reactive4d_widgets.lowering.exact import lower, lower_matrix, lower_paint, lower_visible
from reactive4d_widgets.lowering.playing import play, sized

__all__ = ["lower", "lower_matrix", "lower_paint", "lower_visible", "play", "sized"]
