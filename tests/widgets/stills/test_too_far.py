"""What is too far away or too large to be drawn is refused in words; nothing is a reason to warn."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d_widgets.plans import planned
from reactive4d_widgets.sights import outline

pytestmark = pytest.mark.usefixtures("opengl")


def moved(x: Any) -> r4.Scene:
    """A ball somewhere."""
    ball = r4.Sphere()
    ball.translate((x, 0, 0))
    return r4.Scene(ball=ball)


def scaled(factor: Any) -> r4.Scene:
    """A box of some size."""
    box = r4.Box()
    box.scale(factor)
    return r4.Scene(ball=box)


def deformed(change: Any) -> r4.Scene:
    """A box out of shape."""
    box = r4.Box()
    box.apply(change)
    return r4.Scene(ball=box)


WAYS = {
    "still": lambda scene, folder: scene.render(folder / "a.png", size=(64, 48)),
    "film": lambda scene, folder: scene.render(folder / "a.gif", times=(0, 1), rate=2, size=(64, 48)),
    "model": lambda scene, folder: scene.render(folder / "a.glb"),
    "blocks": lambda scene, folder: scene.to_pyvista(),
}


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize(
    "make",
    [
        lambda: moved(1e300),
        lambda: scaled(1e160),
        lambda: scaled((1, 1, 1e200)),
        lambda: r4.Scene(ball=r4.Group(inner=moved(1e308)["ball"])),
    ],
)
def test_what_is_farther_away_than_anything_can_be_is_refused(make: Any, way: str, tmp_path: Path):
    """By its name, with what one can do."""
    with pytest.raises(r4.ShapeError, match=r"ball.*matrix: what is drawn lies within 1e\+30 m, got") as caught:
        WAYS[way](make(), tmp_path)
    assert "hides it" in caught.value.__notes__[-1]
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("change", [r4.Twist(1e160), r4.Bend(1e300), r4.Taper(1e300)])
def test_what_is_deformed_beyond_all_numbers_is_refused(change: Any, way: str, tmp_path: Path):
    """As any points that are not finite."""
    with pytest.raises(r4.ShapeError, match=r"points\[0\]: expected finite numbers"):
        WAYS[way](deformed(change), tmp_path)


@pytest.mark.parametrize("x", [1e-300, 1e10, 1e29, 1e30])
def test_what_is_far_away_is_drawn_or_is_too_small_for_that(x: float, tmp_path: Path):
    """Where numbers cannot tell its places apart, that is said."""
    if x < 1e20:
        moved(x).render(tmp_path / "a.png", size=(64, 48))
        assert (tmp_path / "a.png").exists()
    else:
        with pytest.raises(r4.ShapeError, match=r"lies 1e\+(29|30) m from the origin, and is too small for that"):
            moved(x).render(tmp_path / "a.png", size=(64, 48))
    scaled(x).render(tmp_path / "b.png", size=(64, 48))
    assert (tmp_path / "b.png").exists()


def test_a_page_opens_with_what_can_be_drawn(tmp_path: Path):
    """What flies away is on it, and no place from which one could see all of it."""
    ball = r4.Sphere()
    ball.translate(r4.vec(np.exp(1000 * r4.time) - 1.0, 0, 0))
    scene = r4.Scene(ball=ball, box=r4.Box())
    scene.bake(tmp_path / "a.html", times=(0, 0.6))
    assert np.abs(outline(planned(scene, times=(0, 0.6)))).max() < 1e30


def test_a_page_says_what_is_no_longer_finite(tmp_path: Path):
    """Nothing of it is described."""
    deformed(r4.Taper(r4.where(r4.time < 0.5, 2.0, 1e300))).bake(tmp_path / "a.html", times=(0, 1))
    deformed(r4.Taper(1e300)).bake(tmp_path / "b.html", times=(0, 1))
    assert "points[0]: expected finite numbers" in (tmp_path / "b.html").read_text(encoding="utf-8")


def test_lines_that_are_too_long_are_refused():
    """With the point."""
    with pytest.raises(r4.ShapeError, match=r"Wire.source: points\[1\]: expected numbers that float32 holds"):
        r4.Wire(r4.Lines([(0, 0, 0), (1e300, 0, 0)], [(0, 1)]))  # pyright: ignore[reportArgumentType]


def test_large_numbers_are_no_reason_to_warn():
    """Neither where they are set, nor where something is measured."""
    ball = r4.Sphere()
    ball.translate((1e308, 1e308, -1e308))
    assert ball.position.at(0.0).tolist() == [1e308, 1e308, -1e308]
    assert not np.isfinite(ball.bounds.at(0.0)).any()
    box = r4.Box()
    box.scale(1e200)
    assert box.volume.at(0.0) == np.inf
    with pytest.raises(r4.ShapeError, match="the transformed points are too large for float32"):
        box.mesh.at(0.0)
    with pytest.raises(r4.ShapeError, match="the transformed points are too large for float32"):
        box.area.at(0.0)
