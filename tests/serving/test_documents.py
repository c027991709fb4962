"""The page that is served is laid out as a baked one is, and refuses the same."""

from collections.abc import Callable
from urllib.error import HTTPError
from urllib.request import urlopen

import pytest

import reactive4d as r4
from reactive4d_apps.serving import Server


def test_figures_that_follow_each_other_are_no_page(served: Callable[..., Server], caplog: pytest.LogCaptureFixture):
    """Neither is there for the other to follow; the log says which one it is, as baking does."""
    ball, box = r4.Scene(ball=r4.Sphere()), r4.Scene(box=r4.Box())
    server = served(r4.Page("", one=r4.Figure(ball, follow="two"), two=r4.Figure(box, follow="one")))
    with pytest.raises(HTTPError, match="500"):
        urlopen(server.address)
    assert "the figure 'one' follows itself" in caplog.text
