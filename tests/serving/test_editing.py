"""A script is edited in the page: the reader sees their copy, marked as such; nobody else does; a reset leads back."""

import os
import signal
from typing import Any

import param
import pytest

import reactive4d as r4
from reactive4d_apps.serving import Limits
from reactive4d_apps.serving.confinements import can_confine

pytestmark = pytest.mark.skipif(not can_confine(), reason="this system bounds no processes")

SCRIPT = 'object (ball) sphere radius = 0.5 color = "red";\nchange (ball) translate <0, {0, 0, 0}>, <4, {4, 0, 0}>;\n'
MATRIX = "() => document.querySelector('r4d-figure').snapshot?.nodes.get('ball')?.matrix[3]"
SHOWS = "(x) => document.querySelector('r4d-figure').snapshot?.nodes.get('ball')?.matrix[3] === x"


def editor(page: Any) -> Any:
    """The field of the script, open."""
    field = page.get_by_role("textbox", name="Script")
    if not field.is_visible():
        page.get_by_text("The script", exact=True).click()
    return field


def status(page: Any) -> Any:
    """What is said of the script."""
    return page.locator("r4d-script [role=status]")


def test_a_copy_is_marked_and_a_reset_leads_back(served, read):
    """The reader's figure shows what their script says, at the same point; another window shows what it showed."""
    server = served(r4.loads(SCRIPT), editable=True)
    own, other = read(server.address, point="t=2"), read(server.address, point="t=2")
    assert other.evaluate(MATRIX) == 2.0
    field = editor(own)
    assert field.input_value() == SCRIPT.strip()
    field.fill(SCRIPT.replace("{4, 0, 0}", "{8, 0, 0}"))
    field.press("Control+Enter")
    own.wait_for_function(SHOWS, arg=4)
    assert status(own).inner_text() == "This is your copy; nobody else sees it."
    assert own.get_by_text("Your copy", exact=True).is_visible()
    assert own.evaluate("document.querySelector('r4d-figure').snapshot.time") == 2.0
    assert other.evaluate(MATRIX) == 2.0
    assert other.get_by_text("Your copy", exact=True).count() == 0
    # Once more, in the same process; then back.
    field.fill(SCRIPT.replace("{4, 0, 0}", "{12, 0, 0}"))
    own.get_by_role("button", name="Show my copy").click()
    own.wait_for_function(SHOWS, arg=6)
    assert len(server.hall.copies) == 1
    own.get_by_role("button", name="Back to what all see").first.click()
    own.wait_for_function(SHOWS, arg=2)
    assert status(own).inner_text() == "This is what all see."
    assert field.input_value() == SCRIPT.strip()
    assert own.get_by_text("Your copy", exact=True).count() == 0


class Jack(r4.Illustration):
    """A jack: {height} high."""

    height = param.Number(1.0, bounds=(0.0, 3.0), doc="[m]")

    def build(self) -> r4.Scene:
        ball = r4.Sphere()
        ball.translate(r4.vec(self.signals.height * r4.time, 0, 0))
        return r4.Scene(ball=ball)


def test_a_copy_of_what_an_illustration_builds_is_driven_by_its_parameters(served, read):
    """It opens where the reader was; its controls drive it, and the numbers of the text follow."""
    page = read(served(Jack, editable=True).address, point="t=2&height=3")
    page.wait_for_function(SHOWS, arg=6)
    field = editor(page)
    field.fill(field.input_value().replace("height * time", "height * time * 10"))
    field.press("Control+Enter")
    page.wait_for_function(SHOWS, arg=60)
    assert page.get_by_text("Your copy", exact=True).is_visible()
    page.evaluate("document.querySelector('r4d-figure').reader.change({ parameters: { height: 2 } })")
    page.wait_for_function(SHOWS, arg=40)
    page.locator("r4d-number").get_by_text("2.00").wait_for()
    page.get_by_role("button", name="Back to what all see").first.click()
    page.wait_for_function(SHOWS, arg=4)


def test_where_there_are_no_keys_none_are_named(served, read):
    """A button shows the copy everywhere; that Ctrl and Enter do is said where there is a keyboard."""
    address = served(r4.loads(SCRIPT), editable=True).address
    for touch, is_said in ((False, True), (True, False)):
        page = read(address, touch=touch, size=(390, 844) if touch else (1000, 900))
        editor(page)
        assert page.get_by_role("button", name="Show my copy").is_visible()
        assert page.get_by_text("Ctrl + Enter").is_visible() == is_said


def test_a_mistake_is_shown_at_its_line_and_column(served, read):
    """The caret goes there; the number of the line is marked; what was shown is shown."""
    page = read(served(r4.loads(SCRIPT), editable=True).address, point="t=2")
    field = editor(page)
    field.fill(SCRIPT.replace("translate", "tranlsate"))
    field.press("Control+Enter")
    page.get_by_role("button", name="Line 2, column 15").wait_for()
    assert "tranlsate" in page.locator("r4d-script .wrong").inner_text()
    assert field.get_attribute("aria-invalid") == "true"
    before = field.evaluate("(field) => field.value.slice(0, field.selectionStart)")
    assert (before.count("\n"), len(before.split("\n")[-1])) == (1, 14)
    assert page.locator("r4d-script .lines [data-wrong]").inner_text() == "2"
    assert page.evaluate(MATRIX) == 2.0
    assert page.get_by_text("Your copy", exact=True).count() == 0


def test_all_of_it_is_done_by_keys(served, read):
    """From the figure to the script, in it, out of it again, to the buttons; tab is no letter there."""
    page = read(served(r4.loads(SCRIPT), editable=True).address)
    page.locator("r4d-script summary").focus()
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    focused = "() => { const { activeElement } = document.activeElement.shadowRoot; return activeElement.textContent }"
    page.keyboard.type("object (extra) box; ")
    page.keyboard.press("Tab")
    assert page.evaluate(focused) == "Show my copy"
    page.keyboard.press("Enter")
    page.wait_for_function("() => document.querySelector('r4d-figure').snapshot?.nodes.has('extra')")
    page.locator("r4d-script button", has_text="Back to what all see").focus()
    page.keyboard.press("Enter")
    page.wait_for_function("() => document.querySelector('r4d-figure').snapshot?.nodes.has('extra') === false")


def test_a_copy_that_dies_leads_back_to_what_all_see(served, read):
    """At the reader's point; it is said why, and the text is still there; they may try again."""
    server = served(r4.loads(SCRIPT), editable=True)
    page = read(server.address, point="t=2")
    text = SCRIPT.replace("{4, 0, 0}", "{8, 0, 0}")
    editor(page).fill(text)
    editor(page).press("Control+Enter")
    page.wait_for_function(SHOWS, arg=4)
    (copy,) = server.hall.copies
    os.kill(copy.process, signal.SIGKILL)
    page.evaluate("document.querySelector('r4d-figure').reader.change({ time: 3 })")
    page.wait_for_function(SHOWS, arg=3)
    status(page).get_by_text("Your copy has ended: the system ended it.").wait_for()
    assert editor(page).input_value() == text.strip() or editor(page).input_value() == text
    assert page.get_by_text("Your copy", exact=True).count() == 0
    editor(page).press("Control+Enter")
    page.wait_for_function(SHOWS, arg=6)


def test_who_finds_no_room_is_told(served, read):
    """The figure stays with what all see."""
    server = served(r4.loads(SCRIPT), editable=True, limits=Limits(copies=1))
    first, second = read(server.address), read(server.address, point="t=2")
    editor(first).press("Control+Enter")
    first.get_by_text("This is your copy").wait_for()
    editor(second).press("Control+Enter")
    status(second).get_by_text("all 1 private copies are taken").wait_for()
    assert second.evaluate(MATRIX) == 2.0
    first.get_by_role("button", name="Back to what all see").first.click()
    first.get_by_text("This is what all see.").wait_for()
    while server.hall.copies:
        first.wait_for_timeout(20)
    editor(second).press("Control+Enter")
    second.get_by_text("This is your copy").wait_for()


def test_a_connection_that_breaks_makes_the_copy_anew(served, read):
    """The text is sent again before anything is asked; the reader stays at their point, in their copy."""
    server = served(r4.loads(SCRIPT), editable=True)
    page = read(server.address, point="t=2")
    editor(page).fill(SCRIPT.replace("{4, 0, 0}", "{8, 0, 0}"))
    editor(page).press("Control+Enter")
    page.wait_for_function(SHOWS, arg=4)
    for line in list(server.hall.lines):
        server._loop.call_soon_threadsafe(line._abort)
    page.evaluate("document.querySelector('r4d-figure').reader.change({ time: 3 })")
    page.wait_for_function(SHOWS, arg=6)
    assert page.get_by_text("Your copy", exact=True).is_visible()


@pytest.mark.parametrize("size", [(1280, 900), (390, 844)])
def test_the_editor_fits_the_window(served, read, size):
    """Nothing sticks out at the side; the field scrolls by itself."""
    page = read(served(r4.loads(SCRIPT + "/* " + "long " * 200 + "*/"), editable=True).address, size=size)
    editor(page)
    assert page.evaluate("document.documentElement.scrollWidth") <= size[0]
    assert editor(page).bounding_box()["width"] > size[0] / 2
