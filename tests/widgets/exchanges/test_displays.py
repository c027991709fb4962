"""What the environment says of VTK's window is the business of all threads that draw."""

import os
import threading

import pytest

from reactive4d_widgets.displays import CHOICE, drawable

pytestmark = pytest.mark.usefixtures("opengl")


def test_threads_that_draw_at_one_time_leave_the_environment_as_it_was():
    """Whoever ends first takes nothing away from the other one."""
    before = os.environ.get(CHOICE)
    entered, leave = threading.Event(), threading.Event()
    seen: list[str | None] = []

    def other() -> None:
        with drawable():
            entered.set()
            leave.wait(60)
            seen.append(os.environ.get(CHOICE))

    with drawable():
        inside = os.environ.get(CHOICE)
        thread = threading.Thread(target=other)
        thread.start()
        entered.wait(60)
    leave.set()
    thread.join()
    assert seen == [inside]
    assert os.environ.get(CHOICE) == before
