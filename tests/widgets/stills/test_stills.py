"""Stills show what the scene says: where things are, what colour they have, how they are lit."""

import io
from pathlib import Path
from typing import Any

import numpy as np
import param
import pytest
from PIL import Image

import reactive4d as r4
from reactive4d_widgets.captions import places
from reactive4d_widgets.stills import pictured, poster, render, seen
from reactive4d_widgets.views import View

pytestmark = pytest.mark.usefixtures("opengl")

SIZE = (320, 240)
FRONT = {"position": (0, -8, 0), "target": (0, 0, 0)}
CRIMSON = np.array((220, 20, 60))


def drawn(scene: Any, **options: Any) -> Any:
    """(240, 320, 3), the picture as numbers from 0 to 255."""
    options = {"size": SIZE, **options}
    return np.asarray(Image.open(io.BytesIO(poster(scene, **options)))).astype(np.int64)


def around(picture: Any, x: float, y: float, *, size: int = 3) -> Any:
    """(3,), the mean colour round a pixel."""
    x, y = round(x), round(y)
    return picture[y - size : y + size + 1, x - size : x + size + 1].mean(axis=(0, 1))


def inked(picture: Any) -> Any:
    """(240, 320), where something is drawn."""
    return np.abs(picture - picture[0, 0]).max(axis=2) > 12


def place_of(scene: r4.Scene, name: str, t: float, **options: Any) -> Any:
    """(2,), the pixel at which an object's position is seen."""
    frame, view, _ = seen(scene, t, aspect=SIZE[0] / SIZE[1], **options)
    return places(frame[name].matrix[None, :3, 3], view, SIZE)[0, :2]


def moving() -> r4.Scene:
    """A ball that goes to the right and upwards, and a box that stays."""
    ball = r4.Sphere(radius=0.5, color="crimson")
    ball.translate(r4.keys({0: (-2, 0, 0), 4: (2, 0, 2)}))
    box = r4.Box(color="steelblue")
    box.translate((0, 0, -1))
    return r4.Scene(ball=ball, box=box)


@pytest.mark.parametrize("t", [0.0, 1.0, 4.0])
def test_a_thing_is_seen_where_it_is(t: float):
    """Where the view says that the ball's middle is, the picture is red; where it was, it is not."""
    scene = moving()
    picture = drawn(scene, t=t)
    red, green, blue = around(picture, *place_of(scene, "ball", t))
    assert red > 2 * green
    assert red > 2 * blue
    elsewhere = around(picture, *place_of(scene, "ball", 4.0 - t if t != 2 else 0.0))
    assert t == 1.0 or elsewhere.min() > 200


def test_the_view_holds_the_scene_over_its_times():
    """Whenever one asks, everything is in the picture, and nobody steps back for it."""
    scene = moving()
    pictures = [inked(drawn(scene, t=t)) for t in (0.0, 2.0, 4.0)]
    for ink in pictures:
        assert ink[1:-1, 1:-1].sum() == ink.sum()
    boxes = [np.asarray(around(drawn(scene, t=t), *place_of(scene, "box", t))) for t in (0.0, 4.0)]
    assert np.abs(boxes[0] - boxes[1]).max() < 3
    rows, columns = np.logical_or.reduce(pictures).nonzero()
    assert max(np.ptp(rows) / SIZE[1], np.ptp(columns) / SIZE[0]) > 0.8


def test_plain_colours_are_those_of_the_scene():
    """A surface that all light reaches has its colour: the light is reckoned in linear numbers, and written as sRGB."""
    box = r4.Box(color="crimson")
    lit = r4.Scene(box=box, light=r4.Light("ambient", color="white"))
    assert np.abs(around(drawn(lit, camera=FRONT), 160, 120) - CRIMSON).max() <= 1
    half = r4.Scene(box=box, light=r4.Light("ambient", color="white", intensity=0.5))
    dimmed = r4.Scene(box=r4.Box(color=linear_half(CRIMSON)), light=r4.Light("ambient", color="white"))
    assert np.abs(around(drawn(half, camera=FRONT) - drawn(dimmed, camera=FRONT), 160, 120)).max() <= 1


def linear_half(color: Any) -> tuple[float, ...]:
    """A colour of half the light."""
    from reactive4d.signals.colors import linear_to_srgb, srgb_to_linear

    return tuple(linear_to_srgb(srgb_to_linear(color / 255) / 2).tolist())


def test_lights_of_the_scene_are_those_that_shine():
    """A red lamp on a white wall makes it red; a directional light of intensity 1 lights what faces it fully."""
    wall = r4.Box(size=(4, 0.1, 4), color="white")
    lamp = r4.Light("directional", color="red")
    lamp.rotate(90, axis="x")  # it shines downwards by itself; now along +y
    red, green, blue = around(drawn(r4.Scene(wall=wall, lamp=lamp), camera=FRONT), 160, 120)
    assert red == 255
    assert max(green, blue) < 150
    lamp.color = "white"
    assert around(drawn(r4.Scene(wall=wall, lamp=lamp), camera=FRONT), 160, 120).tolist() == [255, 255, 255]


def test_a_spot_lights_its_cone_and_nothing_else():
    """In the middle it is bright, outside of the cone it is not, and neither beyond its reach."""
    wall = r4.Box(size=(8, 0.1, 8), color="white")
    spot = r4.Light("spot", color="white", angle=20)
    spot.rotate(90, axis="x")
    spot.translate((0, -4, 0))
    scene = r4.Scene(wall=wall, spot=spot)
    picture = drawn(scene, camera=FRONT)
    assert around(picture, 160, 120).min() > 250
    assert around(picture, 160, 120 - 60).max() < 160
    near = r4.Light("spot", color="white", angle=20, reach=2.0)
    near.rotate(90, axis="x")
    near.translate((0, -4, 0))
    assert around(drawn(r4.Scene(wall=wall, spot=near), camera=FRONT), 160, 120).max() < 160


def test_what_is_clear_shows_what_is_behind_it():
    """Several clear layers, in whichever order they are named."""
    back = r4.Box(size=(1, 1, 1), color="blue")
    back.translate((0, 3, 0))
    front = r4.Box(size=(2, 0.1, 2), color="red", opacity=0.5)
    middle = r4.Box(size=(2, 0.1, 2), color="lime", opacity=0.5)
    middle.translate((0, 1, 0))
    light = r4.Light("ambient", color="white")
    one = around(drawn(r4.Scene(f=front, m=middle, b=back, l=light), camera=FRONT), 160, 120)
    other = around(drawn(r4.Scene(m=middle, b=back, f=front, l=light), camera=FRONT), 160, 120)
    assert np.abs(one - other).max() <= 1
    # Each plate has two sides, and lets a quarter through.
    assert np.abs(one - (191.25, 47.8, 15.9)).max() <= 2


def test_what_is_invisible_is_not_drawn():
    """Neither a thing that is switched off nor one whose group is."""
    ball = r4.Sphere(visible=r4.time < 1)
    pair = r4.Group(left=r4.Sphere(), visible=False)
    scene = r4.Scene(ball=ball, pair=pair)
    assert inked(drawn(scene, t=0.0, camera=FRONT)).any()
    assert not inked(drawn(scene, t=1.0, camera=FRONT)).any()


def test_nothing_to_draw_is_paper():
    """A scene without things, and one with lights and cameras alone."""
    for scene in (r4.Scene(), r4.Scene(light=r4.Light()), r4.Scene(group=r4.Group())):
        assert not inked(drawn(scene)).any()


def test_a_mirrored_thing_is_lit_from_outside():
    """Its normals point outward as before: it looks as if it had been made that way."""
    box, mirrored = r4.Box(color="tan"), r4.Box(color="tan")
    mirrored.scale((-1, 1, 1))
    one, other = [drawn(r4.Scene(box=each), edges=False) for each in (box, mirrored)]
    assert np.abs(one - other).max() <= 2


def test_a_flattened_thing_is_drawn():
    """A factor of 0 leaves a plate, with normals that are none."""
    ball = r4.Sphere(color="tan")
    ball.scale((1, 1, 0))
    assert inked(drawn(r4.Scene(ball=ball))).sum() > 1000


def test_faces_keep_the_paint_of_their_operand():
    """The wall of a drilled hole has the drill's colour."""
    part = r4.Box(size=(2, 2, 1), color="blue") - r4.Cylinder(radius=0.6, height=3, color="red")
    scene = r4.Scene(part=part, light=r4.Light("ambient", color="white"))
    picture = drawn(scene, camera={"position": (0, -1.5, 6), "target": (0, 0, 0)})
    red, green, blue = np.moveaxis(picture, 2, 0)
    assert (red > 4 * (green + blue + 1)).sum() > 100
    assert (blue > 4 * (green + red + 1)).sum() > 1000


def test_lines_and_points_are_drawn():
    """Unlit, in their own colours, about as wide as told."""
    line = r4.Path([(-1, 0, 0), (1, 0, 0)], color="red")
    picture = drawn(r4.Scene(line=line), camera=FRONT)
    red = (picture[:, 160] == (255, 0, 0)).all(axis=1).sum()
    assert 1 <= red <= 3
    dot = drawn(r4.Scene(dot=r4.Point((0, 0, 0), color="navy")), camera=FRONT)
    assert around(dot, 160, 120, size=1).tolist() == [0, 0, 128]
    assert 30 <= inked(dot).sum() <= 90


def test_a_label_stands_at_its_point():
    """Written in its colour round the pixel where its place is seen, whatever stands before it."""
    label = r4.Label("HH", at=(1, 0, 1), color="red", height=32)
    wall = r4.Box(size=(6, 0.1, 6), color="white")
    wall.translate((0, -1, 0))
    ink = inked(drawn(r4.Scene(label=label), camera=FRONT))
    x, y = place_of(r4.Scene(label=label), "label", 0.0, camera=FRONT)
    rows, columns = ink.nonzero()
    assert abs(rows.mean() - y) < 3
    assert abs(columns.mean() - x) < 3
    assert np.ptp(columns) > np.ptp(rows)
    label.rotate(90, axis="y", center=(1, 0, 1))  # turns the text by nothing: it is about the line of sight of the page
    hidden = drawn(r4.Scene(label=label, wall=wall), camera=FRONT)
    assert ((hidden[..., 0] > 200) & (hidden[..., 1] < 90)).any()


@pytest.mark.parametrize("background", ["light", "dark"])
def test_a_label_can_be_read_whatever_is_behind_it(background: str):
    """Where its own colour could not be, as that of a label without one, it is written in ink."""
    scenes = [r4.Scene(label=r4.Label("HH", height=32, **color)) for color in ({}, {"color": "red"})]
    plain, red = [drawn(scene, camera=FRONT, background=background) for scene in scenes]
    assert np.abs(plain - plain[0, 0]).max() > 180
    assert np.abs(red - (255, 0, 0)).max(axis=2).min() < 30


def test_a_picture_that_is_shown_smaller_has_larger_letters():
    """As many pixels for each of theirs as one says."""
    scene = r4.Scene(label=r4.Label("HH", height=32, color="black"))
    pictures = [pictured(scene, size=SIZE, camera=FRONT, ratio=ratio) for ratio in (2, 1)]
    large, small = [inked(np.asarray(picture).astype(np.int64)) for picture in pictures]
    heights = [np.ptp(ink.nonzero()[0]) for ink in (large, small)]
    assert heights[0] == pytest.approx(2 * heights[1], rel=0.15)


def test_a_label_behind_the_eye_or_without_text_is_not_written():
    """And one at the edge is cut."""
    behind = r4.Label("behind", at=(0, -20, 0), color="black")
    empty = r4.Label("", color="black")
    assert not inked(drawn(r4.Scene(a=behind, b=empty), camera=FRONT)).any()
    edge = r4.Label("a long line of text", at=(-2.8, 0, 0), color="black", height=32)
    assert inked(drawn(r4.Scene(a=edge), camera=FRONT))[:, 0].any()


def test_edges_are_drawn_where_they_are_wanted():
    """A box has twelve, a ball none."""
    box, ball = r4.Scene(it=r4.Box(color="white")), r4.Scene(it=r4.Sphere(color="white"))
    assert np.abs(drawn(ball) - drawn(ball, edges=False)).max() == 0
    assert (np.abs(drawn(box) - drawn(box, edges=False)).max(axis=2) > 25).sum() > 200


def test_the_first_camera_that_is_on_is_looked_through():
    """Another one by its name; one's own place goes before both."""
    ball = r4.Sphere(color="red")
    near = r4.Camera(position=(0, -4, 0), visible=r4.time < 1)
    far = r4.Camera(position=(0, -16, 0))
    scene = r4.Scene(ball=ball, near=near, far=far)
    sizes = [inked(drawn(scene, t=t, camera=c)).sum() for t, c in ((0, None), (1, None), (0, "far"), (0, FRONT))]
    assert sizes[0] > 10 * sizes[1]
    assert sizes[1] == sizes[2]
    assert sizes[1] < sizes[3] < sizes[0]


def test_a_camera_that_moves_is_followed():
    """The picture is taken from where its changes took it."""
    camera = r4.Camera(position=(0, -8, 0))
    camera.rotate(90)
    ball = r4.Sphere(color="red")
    ball.translate((0, 1, 0))  # to the right of what a camera at +x sees
    ink = inked(drawn(r4.Scene(ball=ball, camera=camera)))
    assert ink[:, 160:].sum() > 2 * ink[:, :160].sum()


class Pole(r4.Illustration):
    """A pole of some height."""

    height = param.Number(1.0, bounds=(0.5, 3.0))

    def build(self) -> r4.Scene:
        """A cylinder."""
        return r4.Scene(pole=r4.Cylinder(0.2, self.signals.height, color="red"))


def test_an_illustration_is_drawn_with_its_readers_values():
    """Those of the class by default, those of the reader, and those that are named here."""
    heights = []
    for subject, values in ((Pole, {}), (Pole(height=2.0), {}), (Pole(height=2.0), {"height": 3.0})):
        rows = inked(drawn(subject, camera=FRONT, **values)).nonzero()[0]
        heights.append(np.ptp(rows))
    assert heights[0] < heights[1] < heights[2]
    with pytest.raises(r4.Reactive4dError, match="height"):
        poster(Pole, height=9.0)
    with pytest.raises(r4.UnknownNameError, match="heigth"):
        poster(Pole, heigth=1.0)


def test_texts_and_lines_grow_with_the_picture():
    """A picture of twice the size shows the same, finer."""
    scene = r4.Scene(label=r4.Label("text", color="black", height=40), ring=r4.Circle(radius=2, color="black"))
    small, large = [inked(drawn(scene, size=size, camera=FRONT)).mean() for size in ((800, 600), (1600, 1200))]
    assert large == pytest.approx(small, rel=0.15)


def test_a_picture_is_the_same_every_time(tmp_path: Path):
    """Byte for byte, as a file and as a poster."""
    scene = moving()
    render(scene, tmp_path / "a.png", t=1.0, size=SIZE)
    assert (tmp_path / "a.png").read_bytes() == poster(scene, t=1.0, size=SIZE)


@pytest.mark.parametrize("size", [(1, 1), (7, 300), (333, 77)])
def test_a_picture_has_the_size_that_was_asked_for(size: tuple[int, int]):
    """Odd and tiny ones as well."""
    assert drawn(moving(), size=size).shape == (size[1], size[0], 3)


def test_a_picture_is_small():
    """Posters travel in pages."""
    assert len(poster(moving())) < 60_000


def test_surroundings_are_light_dark_or_of_a_colour():
    """The paper's colour, exactly."""
    corners = [drawn(r4.Scene(), background=paper)[0, 0].tolist() for paper in ("light", "dark", "teal")]
    assert sum(corners[0]) > 700
    assert sum(corners[1]) < 100
    assert corners[2] == [0, 128, 128]
    with pytest.raises(r4.UnknownNameError, match="tael"):
        poster(r4.Scene(), background="tael")


def lit_ball(**options: Any) -> Any:
    """A ball above a table, lit from above."""
    table, ball = r4.Box(size=(6, 6, 0.2), color="white"), r4.Sphere(radius=0.5, color="white")
    ball.translate((0, 0, 2))
    lamp = r4.Light("directional", color="white", shadows=True)
    view = {"position": (0, -9, 9), "target": (0, 0, 0)}
    scene = r4.Scene(table=table, ball=ball, lamp=lamp)
    return drawn(scene, camera=view, **options), places(
        np.array([[0.0, 0.0, 0.1], [1.5, 0.0, 0.1]]), View(**view), SIZE
    )


def test_a_lamp_with_shadows_throws_them():
    """Below the ball the table is dark, beside it light; without shadows there is none."""
    picture, (below, beside) = lit_ball()
    assert around(picture, *below[:2], size=1).max() < 150
    assert around(picture, *beside[:2], size=1).min() > 240
    plain, _ = lit_ball(shadows=False)
    assert around(plain, *below[:2], size=1).min() > 240


def test_no_surface_lies_in_its_own_shadow():
    """What nothing stands before is as light as without shadows, also where the light comes aslant."""
    ball = r4.Scene(ball=r4.Sphere(color="tan", segments=64, rings=32))
    view = {"position": (0, -6, 0), "target": (0, 0, 0)}
    with_shadows, without = drawn(ball, camera=view), drawn(ball, camera=view, shadows=False)
    above_the_floor = slice(0, 150)
    assert np.abs(with_shadows - without)[above_the_floor].max() <= 4


def test_the_floor_below_a_thing_is_dark():
    """Where it stands; far from it the paper is white, and from below there is no floor."""
    box = r4.Scene(box=r4.Box(color="tan"))
    above = {"position": (0, -6, 4), "target": (0, 0, 0)}
    x, y = places(np.array([[0.0, -0.55, -0.5]]), View(**above), SIZE)[0, :2]
    assert 120 < around(drawn(box, camera=above), x, y, size=1).mean() < 250
    assert drawn(box, camera=above)[0, 0].tolist() == [255, 255, 255]
    below = {"position": (0, -6, -4), "target": (0, 0, 0)}
    difference = np.abs(drawn(box, camera=below) - drawn(box, camera=below, shadows=False))
    assert difference[:40].max() == 0


class Sized(r4.Illustration):
    """A ball whose parameters are called like arguments."""

    size = param.Number(1.0, bounds=(0.5, 3.0))
    camera = param.Number(0.0, bounds=(-1.0, 1.0))

    def build(self) -> r4.Scene:
        """A ball."""
        return r4.Scene(ball=r4.Sphere(self.signals.size / 2 + 0 * self.signals.camera, color="red"))


def test_parameters_may_be_called_like_arguments():
    """They are given by name in a mapping."""
    small, large = [inked(drawn(Sized, camera=FRONT, parameters={"size": size})).sum() for size in (1.0, 2.0)]
    assert large > 2 * small
