"""What goes wrong in a model is told on the page, where and why, and the rest goes on."""

from pathlib import Path

import pytest
from readers import Read

import reactive4d as r4


def half(t: float) -> float:
    """A radius that cannot be reckoned after one second."""
    if t >= 1.0:
        raise ValueError("the ball burst")
    return 0.5


@pytest.fixture(scope="module")
def broken(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A page of two balls, one of which bursts at 1 s."""
    scene = r4.Scene(ball=r4.Sphere(radius=r4.signal(half)), other=r4.Sphere(radius=0.2, color="teal"))
    path = tmp_path_factory.mktemp("broken") / "broken.html"
    report = scene.bake(path, times=(0, 2))
    assert "the ball burst" in str(report)
    return path


def test_an_error_of_a_cell_is_shown_where_and_why(broken: Path, read: Read):
    """The node is absent while its error lasts, the figure says which and why, the other ball stays."""
    figure = read(broken).figure()
    assert figure.shown()["problems"] == []
    figure.go(time=1.5)
    shown = figure.shown()
    assert [problem["channel"].partition("#")[0] for problem in shown["problems"]] == ["ball"] * len(shown["problems"])
    assert any("the ball burst" in problem["text"] for problem in shown["problems"])
    assert shown["nodes"]["ball"]["drawn"] == "none"
    assert shown["nodes"]["other"]["drawn"] == "mesh"
    said = figure.element.get_by_text("the ball burst")
    assert said.is_visible()
    assert "ball" in said.inner_text().partition("burst")[0]
    figure.go(time=0.5)
    assert figure.shown()["problems"] == []
    assert said.count() == 0


def test_a_browser_that_cannot_unpack_keeps_the_poster(broken: Path, read: Read):
    """Without DecompressionStream there is a still picture and a sentence, not a blank page."""
    reader = read(broken, before="delete window.DecompressionStream")
    note = reader.page.get_by_text("This picture stays still")
    note.wait_for()
    assert reader.page.locator("img.r4d-poster").first.is_visible()
    assert any("DecompressionStream" in complaint for complaint in reader.complaints)
    reader.complaints.clear()
