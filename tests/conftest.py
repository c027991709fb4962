"""How many examples Hypothesis tries: `ci` is repeatable and thorough, `quick` repeatable, `dev` random and quick.

`ci` is taken where the environment says CI; `pytest --hypothesis-profile=dev` chooses by name.

What needs a browser or OpenGL is skipped where there is none, and is a failure where a change is judged.
"""

import os
from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import HealthCheck, settings

# Programs are run by the tests of them, in their own folder; they are not looked through for examples.
collect_ignore_glob = ["examples/*"]

# A shared machine may be slow for a moment: no example is judged by its seconds.
settings.register_profile("dev", deadline=None, max_examples=50)
settings.register_profile("quick", deadline=None, max_examples=50, derandomize=True, print_blob=True)
settings.register_profile(
    "ci",
    deadline=None,
    max_examples=300,
    derandomize=True,
    print_blob=True,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("ci" if os.environ.get("CI") else "dev")


def _missing(said: str) -> None:
    """Nobody can skip these tests where a change is judged."""
    if os.environ.get("CI"):
        pytest.fail(said, pytrace=False)
    pytest.skip(said)


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Chromium for the tests of one file, so that nothing of it is left when others run."""
    from reactive4d_apps.browsers import launched, missing

    if missing() is not None:
        _missing(f"there is no {missing()} here; apt-get install chromium; pip install '.[test]'")
    with launched() as started:
        yield started


@pytest.fixture(scope="session")
def opengl() -> None:
    """For tests that draw without a display."""
    from reactive4d_widgets.displays import can_draw

    if not can_draw():
        _missing("there is no OpenGL here; apt-get install libegl1 libgl1 libegl-mesa0 libgl1-mesa-dri")
