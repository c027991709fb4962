"""A page is one file, whole or not at all, in which nothing can break out of its place."""

import base64
import gzip
import hashlib
import io
import json
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import param
import pytest
from PIL import Image

import reactive4d as r4
from reactive4d.errors import (
    PageTooLargeError,
    ParameterError,
    Reactive4dError,
    ShapeError,
    TimeError,
    UnknownNameError,
)
from reactive4d_widgets import bundles, figures
from reactive4d_widgets.baking import bake
from reactive4d_widgets.packings import unpacked
from reactive4d_widgets.plans import planned
from reactive4d_widgets.playbacks import Playback

NASTY = 'a "quoted" <b>&amp;</b> </script><script>alert(1)</script> <!-- </title> ü 🙂 \u2028'


class Seen(HTMLParser):
    """What a reader of HTML finds in a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.scripts: list[tuple[dict[str, str | None], str]] = []
        self.title = ""
        self._in: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        self.elements.append((tag, dict(attrs)))
        self._in.append(tag)
        if tag == "script":
            self.scripts.append((dict(attrs), ""))

    def handle_endtag(self, tag: str) -> None:
        if tag in self._in:
            while self._in.pop() != tag:
                pass

    def handle_data(self, data: str) -> None:
        if self._in and self._in[-1] == "script":
            self.scripts[-1] = (self.scripts[-1][0], self.scripts[-1][1] + data)
        if self._in and self._in[-1] == "title":
            self.title += data

    def all(self, tag: str) -> list[dict[str, str | None]]:
        """The attributes of all elements of one kind."""
        return [attributes for name, attributes in self.elements if name == tag]

    def data(self) -> dict[str, Any]:
        """The figures' data by name."""
        found = {
            str(attributes["id"]).removeprefix("r4d-data-"): json.loads(text)
            for attributes, text in self.scripts
            if attributes.get("type") == "application/json"
        }
        return {name: {**data, "segments": unpacked(data["segments"])} for name, data in found.items()}


def seen(path: Path) -> Seen:
    """A page as it is read."""
    return Seen(path.read_text(encoding="utf-8"))


class Swing(r4.Illustration):
    """A bob on a rod."""

    length = param.Number(1.0, bounds=(0.2, 2.0), doc="length of the rod [m]")

    def build(self) -> r4.Scene:
        """A bob whose place is an expression."""
        bob = r4.Sphere(radius=0.1, color="crimson")
        bob.translate(r4.vec(0.2 * np.sin(r4.time), 0, -self.signals.length))
        scene = r4.Scene(bob=bob)
        scene.signals["height"] = 2 - self.signals.length
        return scene


@pytest.fixture(autouse=True)
def no_pictures(monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> None:
    """Posters take time; one test has a real one."""
    if "poster" not in request.node.name:
        monkeypatch.setattr(figures, "can_draw", lambda: False)


@pytest.fixture(autouse=True)
def some_viewer(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """A viewer of one line, so that these tests need no build."""
    folder = tmp_path / "static"
    folder.mkdir()
    (folder / "r4d.mjs").write_text("export const start = () => 1;", encoding="utf-8")
    (folder / "page.css").write_text("p { color: red }", encoding="utf-8")
    monkeypatch.setattr(bundles, "STATIC", folder)
    return folder


def ball() -> r4.Scene:
    """A ball."""
    return r4.Scene(ball=r4.Sphere())


# -- the file --------------------------------------------------------------------------------------------------------


def test_a_page_holds_everything(tmp_path: Path) -> None:
    """Prose, figure, data, viewer; and what was asked for can be read back."""
    report = bake(
        Swing, tmp_path / "page.html", text="# A swing\n\nOf {length:.1f}.\n\n![The bob.](swing)", times=(0, 2)
    )
    page = seen(report.path)
    assert page.title == "A swing"
    assert page.all("html") == [{"lang": "en"}]
    assert page.all("r4d-figure") == [{"name": "swing"}]
    assert page.all("r4d-number") == [{"figure": "swing", "name": "length", "format": ".1f"}]
    assert {"name": "viewport", "content": "width=device-width, initial-scale=1"} in page.all("meta")
    (data,) = page.data().values()
    assert Playback(data).at("#values.height", 1.0, {"length": 0.5}) == 1.5


def test_the_viewer_comes_out_as_it_went_in(tmp_path: Path, some_viewer: Path) -> None:
    """Gzipped, in base 64, with its digest."""
    page = seen(bake(ball(), tmp_path / "page.html").path)
    attributes, text = next((a, t) for a, t in page.scripts if a.get("id") == "r4d-bundle")
    code = gzip.decompress(base64.b64decode(text))
    assert code == (some_viewer / "r4d.mjs").read_bytes()
    assert attributes["data-sha256"] == hashlib.sha256(code).hexdigest()


def test_the_page_allows_itself_no_network_and_no_other_script(tmp_path: Path) -> None:
    """The loader is named by its digest; there is no other script that runs, and no handler in an attribute."""
    page = seen(bake(Swing, tmp_path / "page.html", text="[the bob](#bob) [x](#length=1)").path)
    policy = next(a["content"] for a in page.all("meta") if a.get("http-equiv") == "Content-Security-Policy")
    running = [text for attributes, text in page.scripts if "type" not in attributes]
    assert len(running) == 1
    digest = base64.b64encode(hashlib.sha256(running[0].encode()).digest()).decode()
    assert policy is not None
    assert policy.startswith(f"default-src 'none'; script-src 'sha256-{digest}' blob:; style-src 'unsafe-inline'; ")
    assert "http" not in policy.replace("http-equiv", "")
    assert not [a for _, attributes in page.elements for a in attributes if a.startswith("on")]
    assert not [
        a for _, attributes in page.elements for a in attributes if a == "src" and "data:" not in str(attributes)
    ]


def test_nothing_breaks_out_of_its_place(tmp_path: Path) -> None:
    """Quotes, tags, ends of scripts and strange letters in titles, names, texts, values and errors."""
    label = r4.Label(NASTY)
    failing = r4.Sphere(radius=r4.signal(lambda t: (_ for _ in ()).throw(ValueError(NASTY))))
    scene = r4.Scene({"a <script> & <!--": label, 'quo"ted': failing, "ok": r4.Box()})
    scene.signals["note"] = r4.Variable(NASTY)
    report = bake(scene, tmp_path / "page.html", title=NASTY, text=f"{NASTY} {{note}}\n\n![{NASTY}](scene)")
    page = seen(report.path)
    assert page.title == NASTY
    assert len(page.scripts) == 3
    assert page.all("b") == []
    (data,) = page.data().values()
    assert data["manifest"]["title"] == "Page"
    assert [node["name"] for node in data["manifest"]["nodes"]] == ["a <script> & <!--", 'quo"ted', "ok"]
    played = Playback(data)
    assert played.at("a <script> & <!--#text", 0.0) == NASTY
    assert played.at("#values.note", 0.0) == NASTY
    assert [problem.channel for problem in report.problems] == ['quo"ted#points']


def test_a_title_is_made_of_what_there_is(tmp_path: Path) -> None:
    """What is said, else the first heading, else the subject's own; a text without one gets it as its heading."""
    path = tmp_path / "page.html"
    bake(Swing, path, text="# Heading", title="Said")
    assert (seen(path).title, len(seen(path).all("h1"))) == ("Said", 1)
    bake(Swing, path, text="# Heading")
    assert seen(path).title == "Heading"
    bake(Swing, path, text="no heading")
    assert seen(path).title == "Swing"
    assert "<h1>Swing</h1>" in path.read_text(encoding="utf-8")
    bake(ball(), tmp_path / "a_red-ball.html")
    assert seen(tmp_path / "a_red-ball.html").title == "A red ball"
    bake(ball(), tmp_path / "_.html")
    assert seen(tmp_path / "_.html").title == "Scene"


def test_a_figure_that_the_text_does_not_place_stands_above_it(tmp_path: Path) -> None:
    """Below the title."""
    text = bake(Swing, tmp_path / "page.html", text="# One\n\ntwo").path.read_text(encoding="utf-8")
    assert text.index("<h1") < text.index("<r4d-figure") < text.index("two")


def test_language_and_theme_are_the_authors(tmp_path: Path) -> None:
    """And so is how a figure is shown at first."""
    options = {"grid": True, "shading": "flat", "playing": "length", "height": 300}
    path = bake(Swing, tmp_path / "page.html", lang="de", theme="dark", options=options).path
    assert seen(path).all("html") == [{"lang": "de", "data-theme": "dark"}]
    assert seen(path).data()["swing"]["manifest"]["options"] == options


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"gird": True}, UnknownNameError, "unknown option of a figure 'gird'"),
        ({"shading": "shiny"}, ShapeError, "'shiny' is none of its values"),
        ({"grid": "yes"}, ShapeError, "grid: expected bool"),
        ({"height": True}, ShapeError, "height: expected int"),
        ({"height": -5}, ShapeError, "height: expected pixels, 1 or more, got -5"),
        (["grid"], ShapeError, "options: expected them by name"),
        ({"playing": "width"}, UnknownNameError, "unknown parameter to play 'width'"),
    ],
)
def test_options_that_are_none_are_refused(options: Any, error: type[Exception], message: str, tmp_path: Path) -> None:
    """Before anything is asked."""
    with pytest.raises(error, match=message):
        bake(Swing, tmp_path / "page.html", options=options)
    assert list(tmp_path.glob("*.html")) == []


def test_a_poster_shows_where_the_page_opens(tmp_path: Path) -> None:
    """As a picture in the page, with its text."""
    if not figures.can_draw():
        pytest.skip("there is no OpenGL here: apt-get install libegl1 libgl1 libegl-mesa0 libgl1-mesa-dri")
    (image,) = seen(bake(Swing(length=0.5), tmp_path / "page.html").path).all("img")
    assert image["alt"] == "A crimson sphere (bob) at (0.00, 0.00, -0.50); height 1.5."
    assert image["class"] == "r4d-poster"
    head, _, data = str(image["src"]).partition(",")
    picture = Image.open(io.BytesIO(base64.b64decode(data)))
    assert head == f"data:image/{str(picture.format).lower()};base64"
    assert (str(picture.width), str(picture.height)) == (image["width"], image["height"])
    assert len(data) < 60_000


@pytest.mark.parametrize(
    ("options", "theme", "looks"),
    [
        ({}, "auto", {"edges": True, "shadows": True, "background": "light"}),
        ({"edges": False, "shadows": False}, "auto", {"edges": False, "shadows": False, "background": "light"}),
        ({"theme": "dark"}, "auto", {"edges": True, "shadows": True, "background": "dark"}),
        ({}, "dark", {"edges": True, "shadows": True, "background": "dark"}),
        ({"theme": "light"}, "dark", {"edges": True, "shadows": True, "background": "light"}),
    ],
)
def test_a_poster_looks_as_its_figure_does(
    options: Any, theme: str, looks: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Edges, shadows and surroundings are those that the author wants."""
    made: list[dict[str, Any]] = []

    def drawn(thing: Any, **asked: Any) -> bytes:
        made.append(asked)
        file = io.BytesIO()
        Image.new("RGB", (8, 5)).save(file, "PNG")
        return file.getvalue()

    monkeypatch.setattr(figures, "poster", drawn)
    monkeypatch.setattr(figures, "can_draw", lambda: True)
    bake(ball(), tmp_path / "page.html", options=options, theme=theme)
    assert [{name: one[name] for name in looks} for one in made] == [looks]


def test_without_opengl_a_page_has_no_pictures_but_their_texts(tmp_path: Path) -> None:
    """One pixel stands for each."""
    (image,) = seen(bake(Swing, tmp_path / "page.html").path).all("img")
    assert str(image["alt"]).startswith("A crimson sphere")
    assert len(str(image["src"])) < 200


# -- several figures -------------------------------------------------------------------------------------------------


def test_figures_of_one_class_share_their_data(tmp_path: Path) -> None:
    """A twin names the first as its source, and where it opens; one that follows opens where its leader does."""
    page = r4.Page(
        '![](one)\n\n![](two "follow one")\n\n{two.length}',
        one=Swing(),
        two=r4.Figure(Swing(length=1.5), title="The other"),
        three=ball(),
        four=Swing(length=1.5),
    )
    read = seen(page.bake(tmp_path / "page.html", times=(0, 2), progress=False).path)
    assert sorted(read.data()) == ["one", "three"]
    by_name = {figure["name"]: figure for figure in read.all("r4d-figure")}
    assert by_name["one"] == {"name": "one"}
    assert by_name["two"] == {
        "name": "two", "follow": "one", "source": "one", "point": "t=0&length=1", "title": "The other"
    }  # fmt: skip
    assert by_name["four"] == {"name": "four", "source": "one", "point": "t=0&length=1.5"}
    assert list(by_name) == ["three", "four", "one", "two"]
    assert "1" in re.findall(r"<r4d-number[^>]*>([^<]*)<", (tmp_path / "page.html").read_text(encoding="utf-8"))[0]


def test_figures_that_cannot_share_have_their_own(tmp_path: Path) -> None:
    """Other times are another table."""
    page = r4.Page("", one=r4.Figure(Swing, times=(0, 1)), two=r4.Figure(Swing, times=(0, 2)))
    assert sorted(seen(bake(page, tmp_path / "page.html").path).data()) == ["one", "two"]


def test_a_page_needs_a_figure(tmp_path: Path) -> None:
    """And each parameter somebody who knows it."""
    with pytest.raises(ShapeError, match="without a figure"):
        bake(r4.Page("text"), tmp_path / "page.html")
    with pytest.raises(UnknownNameError, match="unknown parameter 'lenght'"):
        bake(r4.Page("", one=Swing, two=ball()), tmp_path / "page.html", lenght=[1])


# -- what goes wrong -------------------------------------------------------------------------------------------------


def test_an_old_page_stays_until_the_new_one_is_whole(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """And no draft is left."""
    path = tmp_path / "page.html"
    path.write_text("old", encoding="utf-8")
    with pytest.raises(UnknownNameError):
        bake(ball(), path, text="{nobody}")
    assert path.read_text(encoding="utf-8") == "old"

    def refuse(self: Path, target: Any) -> None:
        raise OSError("no space left")

    monkeypatch.setattr(Path, "replace", refuse)
    with pytest.raises(OSError, match="no space left"):
        bake(ball(), path)
    assert path.read_text(encoding="utf-8") == "old"
    assert [entry.name for entry in tmp_path.iterdir() if entry.name != "static"] == ["page.html"]


@pytest.mark.parametrize(
    ("name", "error", "message"),
    [
        ("missing/page.html", FileNotFoundError, "no such folder"),
        ("page.png", UnknownNameError, "a page is no .png"),
        ("page", UnknownNameError, "a page is no file without an ending"),
        ("/", UnknownNameError, "'/': a page is a file"),
    ],
)
def test_a_path_that_cannot_be_is_refused_before_anything_is_asked(
    name: str, error: type[Exception], message: str, tmp_path: Path
) -> None:
    """With what to do."""
    asked = r4.signal(lambda t: pytest.fail("asked"))
    with pytest.raises(error, match=message) as caught:
        bake(r4.Scene(ball=r4.Sphere(radius=asked)), tmp_path / name)
    assert caught.value.__notes__


def test_an_empty_scene_is_refused(tmp_path: Path) -> None:
    """There is nothing to show."""
    with pytest.raises(Reactive4dError, match="the scene is empty"):
        bake(r4.Scene(), tmp_path / "page.html")
    with pytest.raises(TimeError):
        bake(ball(), tmp_path / "page.html", times=(2, 1))
    with pytest.raises(ShapeError):
        bake(3, tmp_path / "page.html")


def test_a_viewer_that_was_not_built_is_missed(tmp_path: Path, some_viewer: Path) -> None:
    """And one that is not what was built is not taken."""
    (some_viewer / "r4d.mjs.sha256").write_text("0" * 64 + "  r4d.mjs\n", encoding="utf-8")
    with pytest.raises(Reactive4dError, match="is not the one that was built"):
        bake(ball(), tmp_path / "page.html")
    (some_viewer / "r4d.mjs").unlink()
    with pytest.raises(Reactive4dError, match="was not built") as caught:
        bake(ball(), tmp_path / "page.html")
    assert caught.value.__notes__ == ["hint: in widgets/js: npm ci && node build.mjs"]


def test_a_page_that_is_too_large_is_refused_with_a_table(tmp_path: Path) -> None:
    """Before it is asked for: a few ticks tell."""
    runs: list[float] = []

    def radius(t: float) -> float:
        runs.append(t)
        return 1 + t

    large = r4.Sphere(radius=r4.signal(radius), segments=200)
    with pytest.raises(PageTooLargeError) as caught:
        bake(r4.Scene(large=large, small=r4.Box()), tmp_path / "page.html", times=(0, 20), limit=300_000)
    lines = str(caught.value).splitlines()
    assert re.fullmatch(r"the page would take about \d+(\.\d)? (K|M)B, more than its limit of 300\.0 KB", lines[0])
    assert lines[1].split() == ["channel", "cells", "x", "ticks", "size"]
    assert lines[2].split()[:4] == ["large#points", "1", "x", "601"]
    assert len({len(line) for line in lines[1:]}) == 1
    assert caught.value.size > caught.value.limit == 300_000
    assert len(runs) < 30
    assert not (tmp_path / "page.html").exists()


def test_what_was_underestimated_is_refused_in_the_end(tmp_path: Path) -> None:
    """The limit is that of the file."""
    with pytest.raises(PageTooLargeError, match="the page would take"):
        bake(ball(), tmp_path / "page.html", text="word " * 50_000, limit=100_000)
    assert not (tmp_path / "page.html").exists()


def test_the_report_says_what_became_of_it(tmp_path: Path) -> None:
    """Bytes, asks, what takes them, and what went wrong."""
    failing = r4.Sphere(radius=r4.signal(lambda t: 1 / 0))
    report = bake(r4.Scene(ball=r4.Sphere(), failing=failing), tmp_path / "page.html", times=(0, 1))
    assert report.size == report.path.stat().st_size
    assert 0 < report.asks < 100
    assert next(iter(report.sizes)).startswith("scene/")
    assert "1 error in the model" in str(report)
    assert "failing#points (from 0 to 1 s): ZeroDivisionError: division by zero" in str(report)


def test_a_parameter_may_be_called_like_an_argument(tmp_path: Path) -> None:
    """Then it is given in `parameters`."""

    class Odd(r4.Illustration):
        limit = param.Number(1.0)

        def build(self) -> r4.Scene:
            return r4.Scene(ball=r4.Sphere(radius=0.5 + self.signals.limit))

    path = bake(Odd, tmp_path / "page.html", parameters={"limit": [1, 2]}).path
    assert seen(path).data()["odd"]["manifest"]["parameters"][0]["stops"] == [1.0, 2.0]


def test_progress_is_shown_on_a_terminal(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """On its error stream, and only if it is wanted."""

    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    monkeypatch.setattr("sys.stderr", shown := Terminal())
    bake(ball(), tmp_path / "page.html", progress=False)
    assert shown.getvalue() == ""
    bake(ball(), tmp_path / "page.html", progress=True)
    assert "page.html" in shown.getvalue()


def test_nothing_is_printed_where_there_is_no_terminal(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """Progress is for those who watch."""
    bake(ball(), tmp_path / "page.html", progress=True)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"text": None}, "text: expected a text, got None"),
        ({"text": "a\ud800"}, "is half a character"),
        ({"title": 3}, "title: expected a text, got 3"),
        ({"lang": b"en"}, "lang: expected a text"),
        ({"theme": "pink"}, "'pink' is none of its values"),
        ({"limit": "20 MB"}, "limit: expected a number of bytes"),
        ({"limit": float("nan")}, "limit: expected a number of bytes"),
    ],
)
def test_what_stands_round_a_figure_is_checked_before_anything_is_asked(
    given: Any, message: str, tmp_path: Path
) -> None:
    """A long bake does not end in a spelling mistake."""
    asked = r4.signal(lambda t: pytest.fail("asked"))
    with pytest.raises(ShapeError, match=message):
        bake(r4.Scene(ball=r4.Sphere(radius=asked)), tmp_path / "page.html", **given)


def test_the_report_tells_the_author_what_readers_cannot_reach(tmp_path: Path) -> None:
    """Parameters without values, and links to points that the page does not hold."""

    class Bump(r4.Illustration):
        size = param.Number(1.0, bounds=(0.5, 2.0))
        bumps = param.Integer(1, bounds=(1, 5))
        place = param.Number(0.0, bounds=(0, 1))

        def build(self) -> r4.Scene:
            p = self.signals
            ball = r4.Sphere(radius=p.size.map(lambda size: size if size < 1 else 1 / size))
            ball.translate(r4.vec(p.bumps.map(lambda n: n % 3), 0, 0))
            box = r4.Box()
            box.translate(r4.vec(0, 0, p.place))
            return r4.Scene(ball=ball, box=box)

    text = "[a](#size=0.5) [b](#size=1.25&place=0.5) [c](#bumps=2) [d](#place=7)"
    report = bake(Bump, tmp_path / "page.html", text=text, times=(0, 1), size=[0.5, 1.0, 2.0])
    assert report.notes == (
        "bump: readers cannot move bumps; values to stop at may be given: bumps=[…]",
        "the link #size=1.25&place=0.5: the page holds no size = 1.25, only 0.5, 1.0, 2.0",
        "the link #bumps=2: the page holds no bumps = 2, only 1",
        "the link #place=7: Number parameter 'Bump.place' must be at most 1, not 7.0.",
    )
    assert all(note in str(report) for note in report.notes)
    assert bake(ball(), tmp_path / "ball.html").notes == ()


def test_a_leader_has_the_time_that_its_followers_need(tmp_path: Path) -> None:
    """Nothing moves in the one, but its player moves the other; one that leads nobody has no time."""
    page = r4.Page("", still=ball(), swing=r4.Figure(Swing, follow="still"), alone=r4.Scene(box=r4.Box()))
    data = seen(page.bake(tmp_path / "page.html", times=(0, 1)).path).data()
    assert [data[name]["manifest"]["times"]["still"] for name in ("still", "swing", "alone")] == [False, False, True]


def test_values_may_come_one_by_one(tmp_path: Path) -> None:
    """From a generator as from a list."""
    plan = planned(Swing, times=(0, 1), parameters={"length": (x / 2 for x in range(1, 4))})
    assert plan.asker.stops == {"length": (0.5, 1.0, 1.5)}
    with pytest.raises(ParameterError, match=r"length: expected one value or more, got \[\]"):
        bake(Swing, tmp_path / "page.html", length=(x for x in ()))


def test_only_what_goes_from_one_bound_to_another_can_play(tmp_path: Path) -> None:
    """Colours, choices, switches, pairs and numbers without an end are refused with those that can."""

    class Many(r4.Illustration):
        size = param.Number(1.0, bounds=(0.5, 2.0))
        count = param.Integer(2, softbounds=(0, 5))
        far = param.Number(1.0)
        half = param.Number(1.0, bounds=(0, None))
        held = param.Number(1.0, bounds=(0, 2), constant=True)
        tint = param.Color("#ff0000")
        mode = param.Selector(objects=["a", "b"])
        on = param.Boolean(False)
        span = param.Range((0.0, 1.0), bounds=(0, 1))

        def build(self) -> r4.Scene:
            return r4.Scene(ball=r4.Sphere(radius=self.signals.size))

    for name in ("far", "half", "held", "tint", "mode", "on", "span"):
        with pytest.raises(ShapeError, match=f"playing: {name} cannot play") as refused:
            bake(Many, tmp_path / "page.html", options={"playing": name})
        assert refused.value.__notes__ == ["hint: what can play: time, size, count"]
    for name in ("time", "size", "count"):
        report = bake(Many, tmp_path / "page.html", times=(0, 1), options={"playing": name})
        assert seen(report.path).data()["many"]["manifest"]["options"] == {"playing": name}


def test_the_report_tells_what_a_page_does_not_draw_or_play(tmp_path: Path) -> None:
    """Gloss and pictures on surfaces, and a parameter that is to play at one value."""

    class Glossy(r4.Illustration):
        size = param.Number(1.0, bounds=(0.5, 2.0))

        def build(self) -> r4.Scene:
            ball = r4.Sphere(radius=self.signals.size.map(lambda size: size**2))
            ball.apply(r4.Shade(specular=0.5))
            ball.apply(r4.Opacity(0.5))
            return r4.Scene(ball=ball, box=r4.Box())

    report = bake(Glossy, tmp_path / "page.html", times=(0, 1), options={"playing": "size"})
    assert report.notes == (
        "glossy: readers cannot move size; values to stop at may be given: size=[…]",
        "glossy: size is to play, but the page holds one value of it",
        "glossy: a page does not draw the Shade of ball; colours and opacity it does",
    )


@pytest.mark.parametrize(("one", "two"), [("one", None), ("two", "one")])
def test_a_figure_does_not_follow_itself(one: str, two: str | None, tmp_path: Path) -> None:
    """Neither straight on nor by way of others."""
    page = r4.Page("", one=r4.Figure(ball(), follow=one), two=r4.Figure(ball(), follow=two))
    with pytest.raises(ShapeError, match="the figure 'one' follows itself"):
        page.bake(tmp_path / "page.html")
    assert list(tmp_path.glob("*.html")) == []
