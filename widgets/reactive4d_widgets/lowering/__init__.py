"""Lowering: signals as tracks, which a viewer plays without asking."""

from reactive4d_widgets.lowering.playing import play, sized

__all__ = ["play", "sized"]
