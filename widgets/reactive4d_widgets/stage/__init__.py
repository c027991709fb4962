"""The stage: what VTK draws of a scene, kept from instant to instant. No other package makes VTK's types."""

from reactive4d_widgets.stage.stages import Stage

__all__ = ["Stage"]
