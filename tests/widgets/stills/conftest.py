"""Stills are drawn with OpenGL: in CI without exception, elsewhere where there is one."""

import os

import pytest

from reactive4d_widgets.displays import can_draw


@pytest.fixture(scope="session")
def opengl() -> None:
    """For tests that draw."""
    if not can_draw():
        said = "there is no OpenGL here; apt-get install libegl1 libgl1 libegl-mesa0 libgl1-mesa-dri"
        if os.environ.get("CI"):
            pytest.fail(said, pytrace=False)
        pytest.skip(said)
