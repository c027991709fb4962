"""What is written again and again in nearly the same words takes a fraction of the bytes, and nothing is lost."""

import base64
import json
import math
import zlib
from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d_widgets.packings import compact, packed, unpacked
from reactive4d_widgets.plans import planned
from reactive4d_widgets.tables import tabulated


def boxes(count: int) -> r4.Scene:
    """Boxes that stand still, each somewhere else."""
    chance = np.random.default_rng(7)
    things = {f"box{i}": r4.Box(color="teal") for i in range(count)}
    for box in things.values():
        box.rotate(float(chance.uniform(0, 360)), axis="z")
        box.translate(tuple(chance.uniform(-50, 50, 3).tolist()))
    return r4.Scene(things)


def test_a_box_that_stands_still_takes_two_hundred_bytes_at_most() -> None:
    """With its name in the manifest; its place is told with all its digits."""
    sizes = [len(tabulated(planned(boxes(count), times=(0, 1))).to_json()) for count in (50, 250)]
    assert (sizes[1] - sizes[0]) / 200 <= 200


def test_what_is_unpacked_is_what_was_packed(bake: Any) -> None:
    """Every number of it, and what the page says at a point."""
    scene = boxes(40)
    baked = bake(scene, times=(0, 1))
    travelling = json.loads(baked.text)["segments"]
    assert travelling["bytes"] == len(compact(baked.table.segments).encode("utf-8"))
    assert unpacked(travelling) == baked.table.segments == baked.segments
    shown = np.array(baked.played.at("box7#matrix", 0.5)).reshape(4, 4)
    assert (shown == scene.at(0.5)["box7"].matrix).all()


def test_short_lists_stay_for_people_to_read() -> None:
    """And those that would not become shorter."""
    short: list[Any] = [{"channel": "a#color"}]
    digits = np.random.default_rng(3).integers(0, 256, 9000).astype(np.uint8).tobytes()
    dense = [base64.b64encode(digits).decode("ascii")]
    assert packed(short) is short
    assert packed(dense) is dense


def test_letters_of_any_language_are_counted_in_bytes() -> None:
    """As they travel."""
    words = [{"text": f"Ähre {i}"} for i in range(500)]
    made = packed(words)
    assert made["bytes"] == len(compact(words)) + 500
    assert unpacked(made) == words


def squeezed(data: bytes) -> str:
    """Deflated, in base 64."""
    squeezer = zlib.compressobj(9, zlib.DEFLATED, -15)
    return base64.b64encode(squeezer.compress(data) + squeezer.flush()).decode("ascii")


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ({"bytes": 3, "data": squeezed(b"[1]]")}, "expected 3 bytes, got more"),
        ({"bytes": 5, "data": squeezed(b"[1]")}, "expected 5 bytes, got 3"),
        ({"bytes": 2**40, "data": ""}, "expected at most"),
        ({"bytes": -1, "data": ""}, "expected at most"),
        ({"bytes": 2, "data": squeezed(b"{}")}, "expected a list, got dict"),
        ({"bytes": 2, "data": squeezed(b"[1")}, "no packed list"),
        ({"bytes": 3, "data": "%"}, "no packed list"),
        ({"bytes": math.inf, "data": ""}, "no packed list"),
        ({"data": ""}, "no packed list"),
        (None, "no packed list"),
    ],
)
def test_what_is_damaged_is_refused(value: Any, message: str) -> None:
    """And nothing unpacks to more than it says."""
    with pytest.raises(r4.ShapeError, match=message):
        unpacked(value)
