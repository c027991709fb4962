"""Lowering: signals as tracks, which a viewer plays without asking."""

from reactive4d_widgets.lowering.approximate import Lowered, matrix_track, track
from reactive4d_widgets.lowering.exact import lower, lower_matrix, lower_paint, lower_visible
from reactive4d_widgets.lowering.fits import Fitted, fit, fit_rotation
from reactive4d_widgets.lowering.playing import play, sized
from reactive4d_widgets.lowering.rigid import fit_matrix

__all__ = [
    "Fitted",
    "Lowered",
    "fit",
    "fit_matrix",
    "fit_rotation",
    "lower",
    "lower_matrix",
    "lower_paint",
    "lower_visible",
    "matrix_track",
    "play",
    "sized",
    "track",
]
