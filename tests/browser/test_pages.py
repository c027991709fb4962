"""Pages from the disk show at any time what their scenes say, without asking anybody."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from programs import NAMES, Program
from readers import Read

from reactive4d.geometry.meshes import Mesh
from reactive4d.model.drawings import Lines, Points

PageOf = Callable[[str], Program]
UNSEEN = {"camera", "light"}


def same(shown: Any, frame: Any, figure: Any) -> None:
    """What is shown is what the frame says: matrices, colours, points."""
    size = max(1.0, *[float(np.abs(node.matrix[:3, 3]).max()) for node in frame.values()])
    assert list(shown["nodes"]) == list(frame)
    for name, node in frame.items():
        found = shown["nodes"][name]
        assert found["drawn"] == node.primitive, name
        if node.primitive == "none":
            continue
        # What can only be asked is fitted to 1e-4 of the size of the scene, and turns to 1e-3 of a radian.
        assert np.allclose(np.reshape(found["matrix"], (4, 4)), node.matrix, atol=1e-3 * size), name
        if node.primitive == "camera":
            continue
        assert np.allclose(found["color"], node.color, atol=1.5 / 255), name
        if isinstance(node.drawn, Mesh | Lines | Points):
            points = figure.points(name)
            assert points.shape == node.drawn.points.shape, name
            extent = float(np.ptp(node.drawn.points, axis=0).max())
            assert np.abs(points - node.drawn.points).max() <= 1e-3 * extent, name


@pytest.mark.parametrize("name", NAMES)
def test_a_page_shows_what_its_scene_says(name: str, read: Read, page_of: PageOf):
    """At its first instant, at its last, and at ticks between, in any order."""
    program = page_of(name)
    figure = read(program.page).figure()
    start, stop = figure.ask("(figure) => [figure.life.manifest.times.start, figure.life.manifest.times.stop]")
    ticks = [start + round(30 * (stop - start) * share) / 30 for share in (0.0, 1.0, 0.6, 0.25)]
    for t in ticks:
        figure.go(time=t)
        shown = figure.shown()
        assert shown["problems"] == []
        same(shown, program.scene.at(t, **program.values), figure)
        assert len(figure.element.locator("canvas").first.get_attribute("aria-label")) > 10


@pytest.mark.parametrize("name", NAMES)
def test_a_page_draws_what_it_shows(name: str, read: Read, page_of: PageOf):
    """Something else than paper; and it comes from the card, not from the poster."""
    figure = read(page_of(name).page).figure()
    figure.element.scroll_into_view_if_needed()
    figure.rest()
    assert figure.ask("(figure) => figure.life.view.triangles") > 0
    picture = figure.element.locator("canvas").first
    assert picture.is_visible()
    inked = figure.ask(
        """(figure) => {
          const canvas = figure.shadowRoot.querySelector("canvas");
          const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
          copy.drawImage(canvas, 0, 0);
          const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
          let count = 0;
          for (let i = 0; i < data.length; i += 4) {
            const least = Math.min(data[i], data[i + 1], data[i + 2]);
            const most = Math.max(data[i], data[i + 1], data[i + 2]);
            count += data[i + 3] > 0 && (least < 200 || most - least > 24);
          }
          return count;
        }"""
    )
    assert inked > 100


@pytest.mark.parametrize("name", ["demo", "ex10_illustration"])
def test_a_second_visit_asks_nobody(name: str, read: Read, page_of: PageOf):
    """What was shown once is shown again without an ask to the transport."""
    figure = read(page_of(name).page).figure()
    times = [0.5, 1.0, 2.0, 3.5]
    for t in times:
        figure.go(time=t)
    figure.ask(
        """(figure) => {
          window.asks = 0;
          const { ask } = figure.transport;
          figure.transport.ask = (...wish) => { window.asks++; return ask.apply(figure.transport, wish); };
        }"""
    )
    for t in reversed(times):
        figure.go(time=t)
    assert figure.reader.ask("() => window.asks") == 0


def test_one_page_works_from_any_folder(read: Read, page_of: PageOf, tmp_path: Any):
    """Nothing lies beside it: a copy under another name opens as well."""
    copy = tmp_path / "a copy with spaces & ümlauts #1.html"
    copy.write_bytes(page_of("demo").page.read_bytes())
    assert list(read(copy).figure().shown()["nodes"]) == list(page_of("demo").scene)
