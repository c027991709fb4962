"""What tests of exchanges with other libraries share."""

import os
import subprocess
import sys
from collections.abc import Callable

import pytest

from reactive4d_widgets.displays import can_draw


@pytest.fixture(scope="session")
def opengl() -> None:
    """For tests that draw: in CI without exception, elsewhere where there is OpenGL."""
    if not can_draw():
        said = "there is no OpenGL here; apt-get install libegl1 libgl1 libegl-mesa0 libgl1-mesa-dri"
        if os.environ.get("CI"):
            pytest.fail(said, pytrace=False)
        pytest.skip(said)


@pytest.fixture(scope="session")
def run_python() -> Callable[[str], str]:
    """Run a program in a fresh interpreter; what it prints."""

    def run(program: str) -> str:
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False, timeout=300)
        assert done.returncode == 0, done.stderr
        return done.stdout.strip()

    return run
