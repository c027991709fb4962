"""Serving: a page whose figures ask a model, for many readers who do not see each other."""

from reactive4d_apps.serving.limits import Limits
from reactive4d_apps.serving.servers import Server
from reactive4d_apps.serving.serving import serve

__all__ = ["Limits", "Server", "serve"]
