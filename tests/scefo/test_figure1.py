"""The first script in the paper on BAGS: as it is printed, mended, and moving."""

from importlib.resources import as_file, files
from pathlib import Path
from random import Random

import numpy as np
import pytest

import reactive4d as r4

PRINTED = Path(__file__).with_name("figure1_as_printed.scefo").read_text(encoding="utf-8")
SCENES = files("reactive4d.scefo") / "scenes"
MENDED = PRINTED.replace(">;\nset_parameter", ">,\nset_parameter").replace(
    "translate <0, {LASH_SURF_COLOR, {1,0,1}}>", "translate <0, {0, -8, 1}>"
)


def read(text: str) -> r4.Scene:
    """A script in the folder of the package's scenes."""
    with as_file(SCENES) as folder:
        return r4.loads(text, file="figure1.scefo", folder=folder)


def stored(name: str) -> r4.Scene:
    """A scene of the package."""
    with as_file(SCENES) as folder:
        return r4.Scene.load(folder / f"{name}.scefo")


def test_the_printed_script_is_refused_at_its_semicolon() -> None:
    """F085: the first slip: with line, column, what was expected, and what to do."""
    with pytest.raises(r4.ScriptError, match="',' instead of ';' at 12:57") as caught:
        read(PRINTED)

    assert (caught.value.file, caught.value.line, caught.value.column) == ("figure1.scefo", 13, 1)
    assert caught.value.expected[1:] == ("',' instead of ';' at 12:57",)


def test_the_printed_script_is_refused_at_its_colour() -> None:
    """F085: the second slip, once the first one is mended: a colour is no offset."""
    with pytest.raises(r4.ScriptError, match=r"expected 3 numbers, got \{LASH_SURF_COLOR") as caught:
        read(PRINTED.replace(">;\nset_parameter", ">,\nset_parameter"))

    assert (caught.value.line, caught.value.column, caught.value.expected) == (11, 31, ("3 numbers",))
    assert caught.value.__notes__[-1].endswith("^")


def test_mended_it_is_the_scene_of_the_paper() -> None:
    """F085, F072: the egg is another sphere, the cube is turned in its place, the light has its colour and type."""
    scene = read(MENDED)
    frame = scene.at(0.0)

    assert list(scene) == ["sphere", "cube", "light", "camera", "egg"]
    np.testing.assert_allclose(frame["egg"].mesh.points, frame["sphere"].mesh.points + np.float32([1, 1, 1]), atol=1e-6)
    np.testing.assert_allclose(scene["cube"].position.at(0.0), (-2, 1, 0), atol=1e-12)
    np.testing.assert_allclose(scene["cube"].matrix.at(0.0)[:2, 0], (0.5**0.5, 0.5**0.5))
    assert frame["light"].color.tolist() == [1.0, 0.0, 1.0, 1.0]
    assert scene["light"].parameters["light_type"].at(0.0) == "directional"
    assert {node.kind for node in frame.values()} == {"model"}


@pytest.mark.parametrize("name", ["figure1", "figure1_moving"])
def test_the_scenes_of_the_package_are_written_as_they_were_read(name: str) -> None:
    """F086: loads and dumps are the identity on them, comments and classic values included."""
    text = (SCENES / f"{name}.scefo").read_text(encoding="utf-8")

    assert r4.dumps(stored(name)) == text
    assert r4.dumps(read(text)) == text


def test_what_is_read_as_a_surface_becomes_a_light_and_a_camera() -> None:
    """F078: by chrep; their meshes are not drawn any more."""
    frame = stored("figure1").at(0.0)

    assert [node.kind for node in frame.values()] == ["model", "model", "light", "camera", "model"]
    assert frame["light"].drawn["light_type"] == "directional"
    np.testing.assert_allclose(-frame["light"].matrix[:3, 2], (0, np.sin(np.pi / 3), -0.5))
    np.testing.assert_allclose(frame["camera"].matrix[:3, 3], (0, -8, 1))
    np.testing.assert_allclose(-frame["camera"].matrix[:3, 2], (0, 1, 0), atol=1e-12)


def test_the_moving_one_agrees_at_the_beginning_and_moves_then() -> None:
    """Egg, camera and light move by their points at 2 s and 4 s; the egg's answer holds from 2 s on."""
    still, moving = stored("figure1"), stored("figure1_moving")
    for name in still:
        np.testing.assert_array_equal(still[name].matrix.at(0.0), moving[name].matrix.at(0.0))

    np.testing.assert_array_equal(moving["egg"].position.at([0.0, 1.0, 2.0, 4.0])[:, 2], [1, 1.75, 2.5, 2.5])
    assert str(moving["egg"].position.valid(3.0)) == "[2, inf)"
    assert str(moving["cube"].position.valid(3.0)) == "(-inf, inf)"
    np.testing.assert_allclose(moving["camera"].position.at(4.0), (8, 0, 1), atol=1e-12)
    np.testing.assert_allclose(moving["light"].paint.at(3.0), (1, 0.5, 0.5, 1), atol=0.25)


def test_a_new_writing_of_it_is_the_same_scene() -> None:
    """Without its memory it is written in other words, which are read back to the same answers."""
    scene = stored("figure1_moving")
    scene.remembered = None
    text = r4.dumps(scene)
    again = read(text)
    random = Random(0)

    assert "/*" not in text
    assert list(again) == list(scene)
    for t in [random.uniform(-1, 6) for _ in range(8)]:
        for name, node in scene.at(t).items():
            other = again.at(t)[name]
            assert (node.kind, node.matrix.tobytes(), node.color.tobytes()) == (
                other.kind, other.matrix.tobytes(), other.color.tobytes()
            )  # fmt: skip
