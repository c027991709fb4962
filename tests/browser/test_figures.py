"""What a reader does with a figure, in a real browser: the player, the controls, handles, numbers, links, undo."""

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import param
import pytest
from readers import Read, Reader

import reactive4d as r4

TEXT = """# A pendulum

It hangs on a rod of {length:.2f}, is let go at {angle}, and [the bob](#bob) swings {height:.3f} high. Look at
[two metres](#length=2&t=1.2), or at [half a metre](#length=0.5&angle=45). It is {damped}, and of {material}.

![Figure 1. Drag the bob.](pendulum)

It may be seen twice.

![Figure 2. The same.](twin "follow pendulum")
"""
LIVES = """() => {
    const figures = [...document.querySelectorAll("r4d-figure")];
    return figures.every((figure) => figure.snapshot)
        && figures[0].shadowRoot.querySelector("[data-live], .message:not([hidden])") !== null;
}"""
AXE = Path(os.environ.get("R4D_AXE") or Path(__file__).parents[2] / "widgets/js/node_modules/axe-core/axe.min.js")


class Pendulum(r4.Illustration):
    """A pendulum with all that a reader can set."""

    length = param.Number(1.0, bounds=(0.2, 2.0), doc="length of the rod [m]")
    angle = param.Number(20.0, bounds=(-90, 90), doc="starting angle [deg]")
    turn = param.Number(0.0, bounds=(-180, 180), doc="of the dial [deg]")
    teeth = param.Integer(12, bounds=(3, 40))
    damped = param.Boolean(False)
    material = param.Selector(default="brass", objects=["brass", "iron"])
    hue = param.Color("#c82838")
    window = param.Range((2.0, 6.0), bounds=(0.0, 10.0))
    place = param.XYCoordinates((0.5, -0.8))
    times = (0.0, 6.0)

    def build(self) -> r4.Scene:
        """A bob on a rod, a marker in the plane, a dial."""
        p = self.signals
        swing = p.angle * np.cos(np.sqrt(9.81 / p.length) * r4.time)
        bob = r4.Sphere(0.12, color=p.hue)
        bob.translate(r4.vec(0, 0, -p.length))
        bob.rotate(swing, axis="y")
        rod = r4.Box(size=(0.03, 0.03, 1.0), color="gray")
        rod.translate((0, 0, -0.5))
        rod.scale(r4.vec(1, 1, p.length))
        rod.rotate(swing, axis="y")
        marker = r4.Box(size=(0.1, 0.1, 0.1), color="steelblue")
        marker.translate(r4.vec(p.place[0], p.place[1], -1.5))
        dial = r4.Box(size=(0.5, 0.05, 0.1), color="gray")
        dial.rotate(p.turn, axis="y")
        dial.translate((1.5, 0, 0))
        height = p.length * (1 - np.cos(np.radians(swing)))
        scene = r4.Scene(bob=bob, marker=marker, dial=dial, rod=rod)
        scene.signals["height"] = height
        scene.handle(bob, z=p.length, label="length")
        scene.handle(marker, xy=p.place, label="place")
        scene.handle(dial, angle=p.turn, label="turn")
        return scene


class Shelf(r4.Illustration):
    """A book that stands where only Python knows."""

    reach = param.Number(0.0, bounds=(0, 4))

    def build(self) -> r4.Scene:
        """Neither a track nor an expression says where it is."""
        book = r4.Box(size=(0.2, 0.6, 0.8))
        book.translate(r4.vec(r4.lift(lambda x: x + 0.1 * (round(x) % 2))(self.signals.reach), 0, 0))
        scene = r4.Scene(book=book, end=r4.Box(size=(0.1, 0.1, 0.1)))
        scene.handle(book, x=self.signals.reach)
        return scene


@pytest.fixture(scope="module")
def pendulum(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page."""
    path = tmp_path_factory.mktemp("pages") / "pendulum.html"
    thing = Pendulum()
    r4.Page(TEXT, pendulum=thing, twin=thing).bake(str(path), progress=False)
    return path


@pytest.fixture
def opened(read: Read, pendulum: Path) -> Callable[..., Reader]:
    """The page in the hands of a reader, once both figures have been drawn."""

    def opening(**options: Any) -> Reader:
        reader = read(pendulum, **options)
        while options.get("clock") and not reader.ask(
            LIVES
        ):  # its timers wait for us, and what waits for frames as well
            reader.pass_time(0.1)
            reader.page.wait_for_timeout(50)
        if not options.get("clock"):
            reader.until(LIVES)
        return reader

    return opening


def point(reader: Reader) -> dict[str, Any]:
    """Where the reader is: parameters by name, and the time as `t`."""
    return reader.ask(
        "() => { const { time, parameters, camera } = document.querySelector('r4d-figure').reader.point;"
        " return { t: time, camera, ...parameters } }"
    )


def control(reader: Reader, role: str, name: str) -> Any:
    """One of the first figure's."""
    return reader.page.locator("r4d-figure").first.get_by_role(role, name=name, exact=True)


def number(reader: Reader, name: str) -> Any:
    """A number in the prose."""
    return reader.page.locator(f"r4d-number[name={name}]").locator("span, select").first


def middle(locator: Any) -> tuple[float, float]:
    """The middle of an element on the screen."""
    box = locator.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def dragged(reader: Reader, locator: Any, right: float, down: float) -> tuple[float, float]:
    """Take an element and pull it, in small moves; where the pointer ends."""
    locator.scroll_into_view_if_needed()
    x, y = middle(locator)
    mouse = reader.page.mouse
    mouse.move(x, y)
    mouse.down()
    mouse.move(x + right, y + down, steps=10)
    mouse.up()
    return x + right, y + down


def test_time_goes_by_keys_from_step_to_step_and_from_mark_to_mark(opened: Callable[..., Reader]):
    """The slider says where it stands in words; keys in a row are one step of undo."""
    reader = opened()
    slider = control(reader, "slider", "Time")
    slider.press("ArrowRight")
    assert point(reader)["t"] == pytest.approx(0.05)
    slider.press("End")
    assert point(reader)["t"] == 6.0
    assert slider.get_attribute("aria-valuetext") == "6.00\u202fs"
    slider.press("Control+z")
    assert point(reader)["t"] == 0.0
    slider.press("Control+Shift+z")
    assert point(reader)["t"] == 6.0
    control(reader, "button", "Previous mark").click()
    assert point(reader)["t"] == 0.0


def test_time_plays_and_so_does_any_number(opened: Callable[..., Reader]):
    """Space on the picture plays time; the button beside a number plays that, while time stands."""
    reader = opened(clock=True)
    reader.page.locator("r4d-figure canvas").first.focus()
    reader.page.keyboard.press("Space")
    reader.pass_time(1.0)
    reader.page.keyboard.press("Space")
    time = point(reader)["t"]
    assert time == pytest.approx(1.0, abs=0.1)
    control(reader, "button", "Play Length").click()
    reader.pass_time(1.0)
    control(reader, "button", "Pause Length").click()
    assert point(reader)["length"] == pytest.approx(1.0 + 1.8 / 6, abs=0.05)
    assert point(reader)["t"] == time


def test_where_nothing_changes_with_time_there_is_no_time(read: Read, tmp_path: Path):
    """No slider, and nothing that plays, unless a parameter is to play; then the player plays that."""

    class Pile(r4.Illustration):
        height = param.Number(1.0, bounds=(0.5, 2.0))

        def build(self) -> r4.Scene:
            box = r4.Box()
            box.translate(r4.vec(0, 0, self.signals.height))
            return r4.Scene(box=box)

    page = r4.Page("![](idle)\n\n![](plays)", idle=Pile, plays=r4.Figure(Pile, options={"playing": "height"}))
    reader = read(page.bake(tmp_path / "pile.html", progress=False).path)
    idle, plays = reader.figure(0), reader.figure(1)
    for figure in (idle, plays):
        assert not figure.control("slider", "Time").is_visible()
        assert not figure.control("button", "Next mark").is_visible()
        assert figure.control("slider", "Height").is_visible()
    assert not idle.control("button", "Play").is_visible()
    idle.element.locator("canvas").first.focus()
    reader.page.keyboard.press("Space")
    plays.control("button", "Play").click()
    reader.until("() => document.querySelectorAll('r4d-figure')[1].reader.point.parameters.height > 1.1")
    plays.control("button", "Pause").click()
    assert (idle.point()["time"], plays.point()["time"], idle.point()["parameters"]) == (0.0, 0.0, {"height": 1.0})


def test_a_page_stands_still_for_whoever_wants_no_motion(opened: Callable[..., Reader]):
    """It opens paused, and plays when it is told to."""
    reader = opened(still=True, clock=True)
    reader.pass_time(1.0)
    assert point(reader)["t"] == 0.0


def test_a_number_is_typed_as_people_write_it_and_kept_within_bounds(opened: Callable[..., Reader]):
    """A comma is a point; what is too much becomes the most; what is no number changes nothing."""
    reader = opened()
    field = control(reader, "spinbutton", "Length, as a number")
    for typed, length in (("1,5", 1.5), ("99 m", 2.0), ("long", 2.0)):
        field.fill(typed)
        field.press("Enter")
        assert point(reader)["length"] == length


def test_every_kind_of_parameter_has_its_control(opened: Callable[..., Reader]):
    """Switch, list, colour, range, plane; whole numbers stay whole."""
    reader = opened()
    control(reader, "switch", "Damped").check()
    control(reader, "combobox", "Material").select_option("iron")
    reader.page.locator("r4d-figure input[type=color]").first.fill("#0072b2")
    control(reader, "slider", "Window, from").press("ArrowRight")
    control(reader, "slider", "Window, to").press("Home")
    control(reader, "slider", "Place").press("ArrowUp")
    control(reader, "slider", "Teeth").press("PageUp")
    now = point(reader)
    assert (now["damped"], now["material"], now["hue"], now["teeth"]) == (True, "iron", "#0072b2", 22)
    assert now["window"] == [2.1, 2.1]
    assert now["place"][0] == 0.5
    assert now["place"][1] > -0.8
    assert number(reader, "damped").inner_text() == "on"


def test_a_drag_of_a_slider_is_one_step_of_undo(opened: Callable[..., Reader]):
    """However many values it goes through."""
    reader = opened()
    slider = control(reader, "slider", "Angle")
    dragged(reader, slider, 20, 0)
    assert point(reader)["angle"] != 20
    reader.page.keyboard.press("Control+z")
    assert point(reader)["angle"] == 20


@pytest.mark.parametrize(
    ("label", "right", "down", "moved"),
    [("length", 15, 40, "length"), ("place", 40, 25, "place"), ("turn", -60, 40, "turn")],
)
def test_a_handle_is_under_the_pointer_that_pulls_it(
    opened: Callable[..., Reader], label: str, right: float, down: float, moved: str
):
    """On a line, in a plane, round a dial: as near as its parameters let it come."""
    reader = opened(size=(1280, 1000))
    before = point(reader)
    handle = reader.page.locator(f"r4d-figure .handle[aria-label={label}]").first
    handle.scroll_into_view_if_needed()
    start = middle(handle)
    goal = dragged(reader, handle, right, down)
    assert point(reader)[moved] != before[moved]
    x, y = middle(handle)
    left = np.hypot(goal[0] - x, goal[1] - y)
    assert left < (2 if label == "place" else 0.8 * np.hypot(goal[0] - start[0], goal[1] - start[1]))
    assert {key for key, value in point(reader).items() if value != before[key]} == {moved}
    now = point(reader)[moved]
    handle.press("ArrowLeft")
    assert point(reader)[moved] != now


def test_a_handle_of_a_baked_parameter_goes_from_stop_to_stop(read: Read, tmp_path: Path):
    """Where the node stands at stops that nobody has asked for is asked for when the handle is taken."""
    path = tmp_path / "shelf.html"
    Shelf().bake(str(path), times=(0.0, 1.0), progress=False, reach=[0.0, 1.0, 2.0, 4.0])
    reader = read(path)
    reader.until(LIVES)
    handle = reader.page.locator("r4d-figure .handle").first
    handle.focus()
    reader.until("() => document.querySelector('r4d-figure').reader.session.evaluate('book#matrix', 0, { reach: 2 })")
    span = reader.ask(
        "() => { const { view } = document.querySelector('r4d-figure').life;"
        " return view.project([2, 0, 0]).x - view.project([0, 0, 0]).x }"
    )
    dragged(reader, handle, span, 0)
    assert point(reader)["reach"] == 2.0
    handle.press("ArrowRight")
    assert point(reader)["reach"] == 4.0


def test_a_number_in_the_text_is_dragged_typed_and_stepped(opened: Callable[..., Reader]):
    """It is a spin button; what it says is in the text."""
    reader = opened()
    spin = number(reader, "length")
    assert spin.get_attribute("role") == "spinbutton"
    dragged(reader, spin, -40, 0)
    assert point(reader)["length"] == pytest.approx(0.7)
    spin.press("ArrowUp")
    assert point(reader)["length"] == pytest.approx(0.71)
    spin.press("End")
    assert (spin.get_attribute("aria-valuenow"), spin.inner_text()) == ("2", "2.00\u202fm")
    spin.press("Enter")
    reader.page.keyboard.type("1.25")
    reader.page.keyboard.press("Enter")
    assert point(reader)["length"] == 1.25
    spin.dblclick()
    reader.page.keyboard.type("0.5")
    reader.page.keyboard.press("Escape")
    assert point(reader)["length"] == 1.25


def test_a_value_in_the_text_follows_the_picture(opened: Callable[..., Reader]):
    """It is read, not set."""
    reader = opened()
    value = number(reader, "height")
    assert value.inner_text() == "0.060"
    control(reader, "slider", "Angle").press("End")
    reader.page.wait_for_function("(e) => e.innerText === '1.000'", arg=value.element_handle())
    assert value.get_attribute("role") is None


def test_a_link_goes_to_a_point_and_the_back_button_returns(opened: Callable[..., Reader]):
    """What the link does not name stays; back and forward go through the reader's points."""
    reader = opened()
    control(reader, "slider", "Teeth").press("ArrowRight")
    reader.page.get_by_role("link", name="two metres").click()
    reader.page.get_by_role("link", name="half a metre").click()
    now = point(reader)
    assert (now["length"], now["angle"], now["t"], now["teeth"]) == (0.5, 45, 1.2, 13)
    reader.page.go_back()
    reader.until("() => document.querySelector('r4d-figure').reader.point.parameters.length === 2")
    assert point(reader)["angle"] == 20
    reader.page.go_back()
    reader.until("() => document.querySelector('r4d-figure').reader.point.parameters.length === 1")
    assert (point(reader)["t"], point(reader)["teeth"]) == (0.0, 13)
    reader.page.go_forward()
    reader.until("() => document.querySelector('r4d-figure').reader.point.parameters.length === 2")


def test_an_address_opens_a_figure_at_its_point(opened: Callable[..., Reader]):
    """Time, parameters and camera; bounds hold, and nonsense is passed over."""
    reader = opened(point="pendulum.t=1.5&pendulum.length=77&pendulum.cam=0,-6,1,0,0,-1&pendulum.__proto__=1")
    now = point(reader)
    assert (now["t"], now["length"], now["angle"]) == (1.5, 2.0, 20)
    assert now["camera"]["position"] == [0, -6, 1]
    reader.ask("() => { location.hash = '#pendulum.t=3' }")
    reader.until("() => document.querySelector('r4d-figure').reader.point.time === 3")
    assert (point(reader)["length"], point(reader)["camera"]) == (1.0, None)


def test_a_figure_that_follows_shares_the_point(opened: Callable[..., Reader]):
    """In both directions; it has no player of its own."""
    reader = opened()
    control(reader, "slider", "Time").press("End")
    reader.ask("() => document.querySelectorAll('r4d-figure')[1].reader.change({ parameters: { length: 0.5 } })")
    assert (point(reader)["length"], point(reader)["t"]) == (0.5, 6.0)
    twin = reader.page.locator("r4d-figure").nth(1)
    assert not twin.get_by_role("slider", name="Time").is_visible()
    assert twin.locator(".control").count() == 0


def test_a_word_marks_its_object_as_long_as_it_is_pointed_at_or_kept(opened: Callable[..., Reader]):
    """By the pointer, by the focus, by a tap."""
    reader = opened()
    reader.ask(
        "() => { window.marked = []; const { view } = document.querySelector('r4d-figure').life;"
        " const was = view.highlight.bind(view); view.highlight = (name) => { marked.push(name); was(name) } }"
    )
    word = reader.page.get_by_role("button", name="the bob")
    word.hover()
    reader.page.mouse.move(2, 2)
    word.click()
    assert word.get_attribute("aria-pressed") == "true"
    word.press("Escape")
    assert reader.ask("() => marked.filter((name, i) => name !== marked[i - 1])") == ["bob", None, "bob", None]


def test_the_reader_has_a_camera_of_their_own_until_they_go_back(opened: Callable[..., Reader]):
    """Turning the picture is a step of undo; a button goes back to the scene's camera."""
    reader = opened(still=True)
    reader.page.locator("r4d-figure canvas").first.focus()
    reader.page.keyboard.press("ArrowLeft")
    assert point(reader)["camera"] is not None
    reader.page.keyboard.press("Control+z")
    assert point(reader)["camera"] is None
    reader.page.keyboard.press("ArrowLeft")
    control(reader, "button", "Back to the scene\u2019s camera").click()
    assert point(reader)["camera"] is None


def test_the_menu_draws_otherwise_copies_a_link_and_resets(opened: Callable[..., Reader]):
    """The link opens where the reader is; Escape closes the menu and gives the focus back."""
    reader = opened()
    control(reader, "slider", "Length").press("End")
    control(reader, "button", "Settings").click()
    for choice in ("Wire", "Edges", "Dark"):
        reader.page.locator("r4d-figure").first.get_by_label(choice).check()
    options = reader.ask("() => document.querySelector('r4d-figure').life.view.options")
    assert (options["shading"], options["edges"], options["theme"]) == ("wire", True, "dark")
    control(reader, "button", "Copy link").click()
    reader.page.locator("r4d-figure .note").first.get_by_text("The link is copied.").wait_for()
    assert "pendulum.length=2" in reader.ask("() => navigator.clipboard.readText()")
    control(reader, "button", "Reset").click()
    assert point(reader)["length"] == 1.0
    reader.page.keyboard.press("Escape")
    assert not reader.page.locator("r4d-figure .menu").first.is_visible()


def test_what_is_pointed_at_is_named_and_what_is_chosen_stays_named(opened: Callable[..., Reader]):
    """By the pointer, or from the menu by keys; Escape chooses nothing."""
    reader = opened(size=(1280, 1000))
    label = reader.page.locator("r4d-figure .hover").first
    control(reader, "button", "Settings").click()
    control(reader, "combobox", "Find an object").select_option("dial")
    assert label.inner_text().startswith("dial (1.50, 0.00, 0.00)")
    canvas = reader.page.locator("r4d-figure canvas").first
    canvas.press("Escape")
    assert not label.is_visible()
    seen = reader.ask("() => document.querySelector('r4d-figure').life.view.project([1.5, 0, 0])")
    box = canvas.bounding_box()
    reader.page.mouse.move(box["x"] + seen["x"], box["y"] + seen["y"])
    label.wait_for()
    assert label.inner_text().startswith("dial (")


def test_a_picture_says_what_it_shows_and_the_reader_is_told_where_they_arrived(opened: Callable[..., Reader]):
    """An image with a text of its time; nothing is spoken before the reader acts, nor while it plays."""
    reader = opened()
    canvas = reader.page.locator("r4d-figure canvas").first
    assert canvas.get_attribute("role") == "img"
    assert canvas.get_attribute("aria-label").startswith("At 0.00\u202fs: ")
    spoken = reader.page.locator("r4d-figure .spoken").first
    assert spoken.inner_text() == ""
    control(reader, "slider", "Time").press("End")
    reader.page.wait_for_function("(e) => e.innerText.startsWith('6.00')", arg=spoken.element_handle())
    assert canvas.get_attribute("aria-label").startswith("At 6.00\u202fs: ")


def test_a_lost_picture_is_a_poster_until_it_comes_back(opened: Callable[..., Reader]):
    """And a sentence says so."""
    reader = opened()
    poster = reader.page.locator(".r4d-poster").first
    assert not poster.is_visible()
    reader.ask("() => document.querySelector('r4d-figure').stage.lose()")
    reader.page.locator("r4d-figure .message").first.get_by_text("comes back").wait_for()
    assert poster.is_visible()
    reader.ask("() => document.querySelector('r4d-figure').stage.restore()")
    poster.wait_for(state="hidden")
    reader.complaints.clear()  # three.js says that the context was lost


def test_without_webgl_there_is_a_poster_and_the_numbers_still_follow(opened: Callable[..., Reader]):
    """Whatever does not draw is read all the same."""
    reader = opened(
        before="for (const C of [OffscreenCanvas, HTMLCanvasElement]) { const was = C.prototype.getContext;"
        " C.prototype.getContext = function (kind, ...more) {"
        " return kind === '2d' ? was.call(this, kind, ...more) : null } }"
    )
    assert reader.page.locator(".r4d-poster").first.is_visible()
    control(reader, "slider", "Angle").press("End")
    reader.until("() => document.querySelector('r4d-number[name=height]').shadowRoot.textContent.endsWith('1.000')")
    reader.complaints.clear()  # three.js says that there is no context


def test_paper_has_the_picture_and_the_numbers_and_no_controls(opened: Callable[..., Reader]):
    """Dark surroundings become light ones."""
    reader = opened(dark=True)
    reader.page.emulate_media(media="print")
    reader.ask("() => { dispatchEvent(new Event('beforeprint')) }")
    figure = reader.page.locator("r4d-figure").first
    assert figure.locator(".still").is_visible()
    assert not figure.locator(".player, .controls, canvas").first.is_visible()
    assert number(reader, "length").inner_text() == "1.00\u202fm"
    assert reader.ask("() => document.querySelector('r4d-figure').life.view.options.theme") == "light"


def test_a_figure_without_data_says_so_and_the_others_live(pendulum: Path, tmp_path: Path, read: Read):
    """Never a blank page."""
    text = pendulum.read_text(encoding="utf-8").replace('id="r4d-data-pendulum"', 'id="r4d-data-lost"')
    path = tmp_path / "page.html"
    path.write_text(text, encoding="utf-8")
    reader = read(path)
    alert = reader.page.locator("r4d-figure .failure").first
    alert.wait_for()
    assert alert.inner_text() == "This figure cannot be shown. The page holds no data named \u201cpendulum\u201d."
    assert reader.page.locator(".r4d-poster").first.is_visible()
    assert number(reader, "length").count() == 0  # the plain text that it came with


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.parametrize("width", [1280, 390])
def test_axe_finds_nothing_serious(opened: Callable[..., Reader], width: int, dark: bool):
    """With the menu open; and nothing is wider than the screen."""
    if not AXE.exists():
        said = f"there is no axe-core at {AXE}: npm ci in widgets/js, or R4D_AXE"
        pytest.fail(said) if os.environ.get("CI") else pytest.skip(said)
    reader = opened(size=(width, 900), dark=dark, touch=width < 500)
    control(reader, "button", "Settings").click()
    reader.ask("(code) => { (0, eval)(code) }", AXE.read_text(encoding="utf-8"))
    found = reader.ask("() => axe.run(document, { resultTypes: ['violations'] })")
    assert [(one["id"], one["impact"], one["nodes"][0]["html"]) for one in found["violations"]] == []
    assert reader.ask("() => document.documentElement.scrollWidth <= innerWidth")
