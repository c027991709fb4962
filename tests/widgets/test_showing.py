"""Showing: a page in a temporary folder, handed to the browser."""

import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import param
import pytest

import reactive4d as r4
from reactive4d_widgets import showing


class Ball(r4.Illustration):
    """A ball."""

    size = param.Number(1.0, bounds=(0.5, 2.0))
    times = (0, 1)

    def build(self) -> r4.Scene:
        """One ball."""
        return r4.Scene(ball=r4.Sphere(self.signals.size, segments=8, rings=4))


@pytest.fixture
def addresses(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[str]:
    """What is handed to the browser; nothing is opened, and all files lie in a folder of the test."""
    seen: list[str] = []
    monkeypatch.setenv("DISPLAY", ":9")
    monkeypatch.setattr(showing.webbrowser, "open", lambda address: seen.append(address) or True)
    monkeypatch.setattr(showing.tempfile, "tempdir", str(tmp_path))
    return seen


@pytest.mark.parametrize("make", [Ball, lambda: Ball(size=2.0), lambda: r4.Scene(ball=r4.Sphere(segments=8, rings=4))])
def test_whatever_can_be_baked_can_be_shown(make: Any, addresses: list[str]):
    """By its own method; options of the figure and values of parameters go where they belong."""
    thing = make()
    options = {"times": (0, 1), "height": 400, "theme": "dark"}
    shown = thing.show(**options) if not isinstance(thing, type) else showing.show(thing, **options)
    assert addresses == [shown.path.as_uri()]
    text = shown.path.read_text(encoding="utf-8")
    assert '"height":400' in text.replace(" ", "")
    assert '"theme":"dark"' in text.replace(" ", "")
    assert shown.is_open
    assert repr(shown) == str(shown.path)


def test_a_page_of_several_figures_is_shown(addresses: list[str], tmp_path: Path):
    """And a path may be given."""
    page = r4.Page("# Two balls", one=Ball(), two=Ball(size=2.0))
    shown = showing.show(page, path=tmp_path / "two.html", size=[1.0, 2.0])
    assert shown.path == tmp_path / "two.html"
    assert addresses == [shown.path.as_uri()]


def test_without_a_screen_the_page_is_written_all_the_same(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    """And its place is told."""
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(sys, "platform", "linux")
    shown = showing.show(Ball, path=tmp_path / "ball.html")
    assert not shown.is_open
    assert shown.path.is_file()
    assert repr(shown).endswith("ball.html: open it in a browser; there is none here")


def test_what_cannot_be_baked_is_not_shown(addresses: list[str]):
    """The refusal is that of the page's writer; nothing is opened."""
    with pytest.raises(r4.ShapeError, match="expected a scene or an illustration"):
        showing.show(r4.Sphere())
    with pytest.raises(r4.UnknownNameError, match="sise"):
        Ball().show(sise=2.0)
    assert addresses == []


def test_in_marimo_a_figure_is_the_value_of_its_cell(monkeypatch: pytest.MonkeyPatch) -> None:
    """The widget, which marimo shows; nothing is put anywhere else."""
    pytest.importorskip("anywidget")
    monkeypatch.setitem(sys.modules, "marimo", SimpleNamespace(running_in_notebook=lambda: True))
    widget = Ball().show(height=200, save=True)
    assert widget.point.parameters == {"size": 1.0}
    assert type(Ball()._display_()).__name__ == type(widget).__name__
    assert not widget.is_fresh


def test_what_a_notebook_would_keep_is_no_matter_of_a_page(addresses: list[str], tmp_path: Path) -> None:
    """The same program runs in both."""
    assert showing.show(Ball, path=tmp_path / "ball.html", save=5e6).path.exists()
