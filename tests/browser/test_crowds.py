"""Many figures on one page, many things in one figure."""

from pathlib import Path

import pytest
from readers import Read

import reactive4d as r4

COUNT = 24
CONTEXTS = """
  const made = (window.contexts = []);
  for (const kind of [HTMLCanvasElement, OffscreenCanvas]) {
    const { getContext } = kind.prototype;
    kind.prototype.getContext = function (type, ...rest) {
      const context = getContext.call(this, type, ...rest);
      if (/webgl/.test(type) && !made.includes(context)) made.push(context);
      return context;
    };
  }
"""


@pytest.fixture(scope="module")
def crowd(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A page of 24 figures, each of its own scene."""
    scenes = {}
    for i in range(COUNT):
        ball = r4.Sphere(radius=0.5, color=["crimson", "gold", "teal", "navy"][i % 4])
        ball.translate(r4.vec(0, 0, (i + 1) * r4.time))
        scenes[f"figure{i}"] = r4.Scene({f"ball{i}": ball})
    text = "\n\n".join(["# A crowd", *[f"![Figure {i}.](figure{i})" for i in range(COUNT)]])
    path = tmp_path_factory.mktemp("crowd") / "crowd.html"
    r4.Page(text, **scenes).bake(path, times=(0, 1), limit=40_000_000)
    return path


def test_twenty_four_figures_share_one_context(crowd: Path, read: Read):
    """All live, all are drawn when they come into view, none is lost; the browser would take the oldest of 17 away."""
    reader = read(crowd, before=CONTEXTS)
    for i in range(COUNT):
        figure = reader.figure(i)
        figure.element.scroll_into_view_if_needed()
        figure.element.locator("canvas").first.wait_for(state="visible")
        figure.go(time=0.5)
        assert figure.shown()["nodes"][f"ball{i}"]["matrix"][11] == pytest.approx((i + 1) / 2)
    assert reader.ask("() => contexts.filter((context) => !context.isContextLost()).length") == 1
    assert reader.ask("() => contexts.length") == 1


def test_what_is_out_of_view_is_not_drawn(crowd: Path, read: Read):
    """A figure below the fold keeps its poster until it comes into view."""
    reader = read(crowd, size=(800, 600))
    reader.figure(0).element.locator("canvas").first.wait_for(state="visible")
    last = reader.figure(COUNT - 1)
    assert last.ask("(figure) => figure.shadowRoot.querySelector('[data-live]') === null")
    assert last.element.locator("img.r4d-poster").count() == 1


def test_a_thousand_rivets_are_one_batch(tmp_path: Path, read: Read):
    """One mesh on the card, one draw for all of them, a name for each."""
    rivet = r4.Cylinder(radius=0.1, height=0.1)
    rivets = {}
    for i in range(1000):
        copy = rivets[f"rivet{i}"] = rivet.extend()
        copy.translate((i % 40, i // 40, 0))
    rivet.rotate(r4.time * 90, axis="x")
    path = tmp_path / "rivets.html"
    r4.Scene(rivets).bake(path, times=(0, 1))
    figure = read(path).figure()
    figure.rest()
    assert figure.ask("(figure) => figure.life.view.batches") == 1
    shown = figure.shown()["nodes"]
    assert len(shown) == 1000
    x, y = figure.place([20.0, 12.0, 0.0])
    box = figure.element.locator("canvas").first.bounding_box()
    hit = figure.ask("(figure, at) => figure.life.view.pick(...at)", [x - box["x"], y - box["y"]])
    assert hit["name"] == f"rivet{12 * 40 + 20}"
