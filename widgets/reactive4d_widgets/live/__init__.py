"""Live: what answers a reader while the model can still be edited, whatever wire lies between them."""

from reactive4d_widgets.live.models import Model
from reactive4d_widgets.live.readers import Reader

__all__ = ["Model", "Reader"]
