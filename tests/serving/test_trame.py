"""A figure among the widgets of somebody's own trame application."""

import os
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
from clients import Pendulum, got_raw, run
from trame.app import get_server
from trame.ui.html import DivLayout

from reactive4d.errors import ParameterError, Reactive4dError, ShapeError, UnknownNameError
from reactive4d_apps.trame import FigureView

APP = Path(__file__).parent / "trame_app.py"
POINTS = (
    "() => [...document.querySelectorAll('r4d-figure')].map((f) => [f.snapshot?.time, f.snapshot?.parameters.length])"
)
ALIVE = """() => {
  const figures = [...document.querySelectorAll("r4d-figure")];
  return figures.length === 2 && figures.every((figure) => figure.snapshot);
}"""
SHOWN = """([index, time, length]) => {
  const snapshot = document.querySelectorAll("r4d-figure")[index]?.snapshot;
  return snapshot && snapshot.time === time && snapshot.parameters.length === length;
}"""
MOVE = "([index, patch]) => document.querySelectorAll('r4d-figure')[index].reader.change(patch)"
# Trame's page asks whether somebody launches it, and nobody does.
FORGIVEN = "405 (Method Not Allowed)"


@pytest.fixture
def application() -> Iterator[tuple[str, Any]]:
    """It runs: its address, and what it says."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith("TRAME")}
    with subprocess.Popen(
        [sys.executable, str(APP)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8", env=kept
    ) as program:
        try:
            assert program.stdout is not None
            for line in program.stdout:
                if line.startswith("port "):
                    yield f"http://127.0.0.1:{int(line[5:])}/index.html", program
                    break
            else:
                pytest.fail(program.communicate()[1])
        finally:
            program.kill()


def joined(read: Any, address: str) -> Any:
    """A page of the application with its two figures alive.

    On a busy machine trame's own page may stay at its loader, that of an application without figures as well; then a
    reader loads it again.
    """
    from playwright.sync_api import TimeoutError as TooLate

    page = read(address, forgive=FORGIVEN)
    for _ in range(5):
        with suppress(TooLate):
            page.wait_for_function(ALIVE, timeout=30_000)
            return page
        page.reload()
    raise AssertionError("the application does not show its figures")


def test_a_figure_shares_with_the_application_what_it_is_told_to(application, read):
    """Both ways: a slider of the application moves it, and its reader moves the slider, for all clients and Python."""
    address, program = application
    one, other = (joined(read, address) for _ in range(2))
    for page in (one, other):
        page.wait_for_function(SHOWN, arg=[0, 0.5, 1.5])
        page.wait_for_function(SHOWN, arg=[1, 0, 1])
    one.locator("input[type=range]").first.fill("0.7")
    for page in (one, other):
        page.wait_for_function(SHOWN, arg=[0, 0.5, 0.7])
    one.evaluate(MOVE, [0, {"time": 2, "parameters": {"length": 1.2}}])
    other.wait_for_function(SHOWN, arg=[0, 2, 1.2])
    one.get_by_text("It is 1.2 m long at 2 s.").wait_for()
    assert one.locator("input[type=range]").first.input_value() == "1.2"
    while program.stdout.readline() != "length 1.2\n":
        pass


def test_what_is_not_shared_is_each_readers_own(application, read):
    """The second figure's point goes nowhere: not to the state, not to another window, not to the first figure."""
    address, _ = application
    one, other = (joined(read, address) for _ in range(2))
    for page in (one, other):
        page.wait_for_function(SHOWN, arg=[1, 0, 1])
    one.evaluate(MOVE, [1, {"time": 3, "parameters": {"length": 0.4}}])
    one.wait_for_function(SHOWN, arg=[1, 3, 0.4])
    one.evaluate(MOVE, [0, {"time": 1}])
    other.wait_for_function(SHOWN, arg=[0, 1, 1.5])  # by now, all that was told before has been heard
    assert other.evaluate(POINTS)[1] == [0, 1]
    assert one.evaluate(POINTS)[1] == [3, 0.4]


def test_a_drag_ends_on_its_last_value_for_all(application, read):
    """However often the reader moved: the application has the last one."""
    address, _ = application
    page = joined(read, address)
    page.wait_for_function(SHOWN, arg=[0, 0.5, 1.5])
    for k in range(50):
        page.evaluate(MOVE, [0, {"parameters": {"length": 0.2 + 0.02 * k}}])
    page.evaluate(MOVE, [0, {"parameters": {"length": 1.25}}])
    page.get_by_text("It is 1.25 m long at 0.5 s.").wait_for()
    page.wait_for_function(SHOWN, arg=[0, 0.5, 1.25])


def test_a_figure_that_comes_and_goes_leaves_no_connection(application, read):
    """As the application shows and hides it."""
    page = joined(read, application[0])
    page.wait_for_function(SHOWN, arg=[1, 0, 1])
    page.evaluate(
        "() => { const { close } = WebSocket.prototype; window.gone = 0;"
        " WebSocket.prototype.close = function (...given) { window.gone++; close.apply(this, given) } }"
    )
    page.get_by_role("button", name="More").click()
    page.wait_for_function(SHOWN, arg=[2, 0, 1])
    page.get_by_role("button", name="More").click()
    page.wait_for_function("() => document.querySelectorAll('r4d-figure').length === 2 && window.gone > 0")


def test_the_doors_are_as_elsewhere(application, read):
    """Who does not know the address of the figures gets no file and no socket of them; nobody leaves the table."""
    address, _ = application
    page = joined(read, address)
    page.wait_for_function(SHOWN, arg=[1, 0, 1])
    base = page.evaluate("[...document.scripts].map((one) => one.src).find((src) => src.endsWith('trame.mjs'))")
    path = base.removeprefix(address.removesuffix("index.html")).removesuffix("trame.mjs")

    async def work():
        home = address.removesuffix("/index.html")
        assert await got_raw(home, f"/{path}live/pendulum", upgrade=True) == 101
        assert await got_raw(home, f"/{path}live/nobody", upgrade=True) == 404
        assert await got_raw(home, f"/{path}copy/pendulum", upgrade=True) == 404
        assert await got_raw(home, f"/{path}live/pendulum", host="elsewhere.example", upgrade=True) == 403
        assert await got_raw(home, f"/{'A' * 43}/live/pendulum", upgrade=True) == 404
        assert await got_raw(home, f"/{path}r4d.mjs") == 200
        assert await got_raw(home, f"/{path}../trame_app.py") == 404

    with ThreadPoolExecutor(1) as aside:  # Playwright has this thread's loop
        aside.submit(run, work).result()


def test_figures_have_names_of_their_own_and_variables_first_values():
    """Two of one class can be told apart; a variable that is there keeps its value."""
    server = get_server("two figures")
    server.state.length = 0.5
    with DivLayout(server):
        one = FigureView(Pendulum, parameters={"length": ("length", 1.0), "count": ("count", 4)})
        other = FigureView(Pendulum)
    assert (one.name, other.name) == ("pendulum", "pendulum-2")
    assert (server.state.length, server.state.count) == (0.5, 4)


@pytest.mark.parametrize(
    ("given", "error", "said"),
    [
        ({"parameters": {"lenght": "length"}}, UnknownNameError, "did you mean 'length'?"),
        ({"values": {"lenght": 1.0}}, UnknownNameError, "lenght"),
        ({"values": {"length": 9.0}}, ParameterError, "at most 2"),
        ({"parameters": {"length": "a; alert(1)"}}, ShapeError, "'a; alert(1)' is no name of a variable"),
        ({"time": "t = 1, x"}, ShapeError, "is no name of a variable"),
        ({"options": {"them": "dark"}}, UnknownNameError, "them"),
    ],
)
def test_what_makes_no_sense_is_told_at_once(given, error, said):
    """To whoever writes the layout, and not in the browser."""
    with DivLayout(get_server("senseless")), pytest.raises(error) as found:
        FigureView(Pendulum, **given)
    assert said in " ".join([str(found.value), *getattr(found.value, "__notes__", ())])


def test_the_first_figure_comes_before_the_start():
    """Addresses cannot be added to a server that runs."""

    class Running:
        running = True

        @property
        def root_server(self) -> "Running":
            return self

    from reactive4d_apps.trame import _hall_of

    with pytest.raises(Reactive4dError, match="runs already"):
        _hall_of(Running(), None)
