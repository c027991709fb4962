"""The stage: what VTK draws of a scene, kept from instant to instant. Nobody else draws with VTK."""

from reactive4d_widgets.stage.stages import Stage

__all__ = ["Stage"]
