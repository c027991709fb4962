"""Arrays travel packed, and come out as they went in, or as near as the chunk says."""

import base64
import zlib
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays as any_arrays

from reactive4d.errors import ShapeError
from reactive4d.references import reference
from reactive4d_widgets.chunks import decode, encode, extent

shapes = st.tuples(st.integers(0, 7), st.integers(1, 4))


@given(st.data(), shapes, st.sampled_from([np.float32, np.uint32]), st.integers(1, 4))
def test_raw_keeps_every_bit(data: Any, shape: Any, dtype: Any, count: int) -> None:
    """NaN, infinities and -0.0 as well."""
    arrays = [data.draw(any_arrays(dtype, shape)) for _ in range(count)]
    found = decode(encode(arrays))
    for array in arrays:
        assert found[reference(array)].tobytes() == array.tobytes()


@given(st.data(), shapes, st.integers(1, 4), st.booleans())
def test_u16_is_within_half_a_step_of_its_column(data: Any, shape: Any, count: int, smooth: bool) -> None:
    """However the columns differ in their ranges, and where a column does not vary at all."""
    numbers = st.floats(-1e6, 1e6, width=32)
    arrays = [data.draw(any_arrays(np.float32, shape, elements=numbers)) for _ in range(count)]
    low, high = extent(arrays)
    found = decode(encode(arrays, bounds=(low, high), smooth=smooth))
    for array in arrays:
        off = np.abs(found[reference(array)].astype(np.float64) - array)
        assert (off <= (high - low) / 131070 + np.spacing(np.abs(array)) + 1e-12).all()


def test_the_bytes_are_those_of_the_wire() -> None:
    """One array of two rows and one column, by hand: row by row, low bytes and then high bytes."""
    chunk = encode([np.float32([[0.0], [1.0]]), np.float32([[0.5], [1.0]])], bounds=(np.zeros(1), np.ones(1)))
    data = zlib.decompress(base64.b64decode(chunk["data"]), -15)
    # 0, 65535 and then the differences of 32768, 65535 to them.
    assert data == bytes([0x00, 0xFF, 0x00, 0x00]) + bytes([0x00, 0xFF, 0x80, 0x00])
    raw = encode([np.uint32([1, 0x0203])])
    assert raw["shape"] == [2, 1]
    assert zlib.decompress(base64.b64decode(raw["data"]), -15) == bytes([1, 3, 0, 2, 0, 0, 0, 0])


def test_the_bytes_of_a_smooth_chunk() -> None:
    """By hand: 0, 65535; then 32768, 65535; then again."""
    arrays = [np.float32([[0.0], [1.0]]), np.float32([[0.5], [1.0]]), np.float32([[0.5], [1.0]])]
    chunk = encode(arrays, bounds=(np.zeros(1), np.ones(1)), smooth=True)
    assert chunk["encoding"] == "u16s"
    data = zlib.decompress(base64.b64decode(chunk["data"]), -15)
    # To where it would be: 0, -1; -32768, 0; -32768, 0. Of these to the row before: 0, -1; -32768, -32768; the same.
    assert data == bytes([0x00, 0x01, 0xFF, 0xFF, 0xFF, 0xFF]) + bytes([0x00, 0x00, 0xFF, 0xFF, 0xFF, 0xFF])


def test_a_motion_of_many_points_is_small() -> None:
    """Ten thousand points at sixty ticks, as a wave: under a tenth of what they take as floats."""
    x, y = np.meshgrid(np.linspace(-1, 1, 100), np.linspace(-1, 1, 100))
    waves = [np.stack([x, y, 0.2 * np.sin(4 * x + k / 10)], axis=-1).reshape(-1, 3) for k in range(60)]
    arrays = [wave.astype(np.float32) for wave in waves]
    plain, smooth = (len(encode(arrays, bounds=extent(arrays), smooth=smooth)["data"]) for smooth in (False, True))
    assert smooth < plain < sum(a.nbytes for a in arrays) / 10


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"encoding": "zip"}, "is no encoding"),
        ({"dtype": "u32"}, "is no encoding"),
        ({"shape": [3, 1]}, "expected 6 bytes"),
        ({"shape": [1, 1]}, "expected 2 bytes, got more"),
        ({"lo": [0.0, 0.0]}, "expected 1 numbers each"),
        ({"data": "!"}, "data: "),
        ({"data": base64.b64encode(b"\xff\xff").decode()}, "data: "),
    ],
)
def test_what_does_not_fit_together_is_refused(change: dict[str, Any], message: str) -> None:
    """Nothing is read that was not announced."""
    chunk = encode([np.float32([[0.0], [1.0]])], bounds=(np.zeros(1), np.ones(1)))
    with pytest.raises(ShapeError, match=message):
        decode({**chunk, **change})


@pytest.mark.parametrize(
    "arrays",
    [
        [],
        [np.zeros((2, 3), np.float64)],
        [np.zeros((2, 3), np.float32), np.zeros((3, 3), np.float32)],
        [np.zeros((2, 3, 1), np.float32)],
    ],
)
def test_arrays_that_do_not_go_together_are_refused(arrays: Any) -> None:
    """One chunk, one shape and one of two types."""
    with pytest.raises(ShapeError, match="expected"):
        encode(arrays)


@pytest.mark.parametrize("value", [np.nan, np.inf, 2.0])
def test_u16_takes_nothing_outside_of_its_bounds(value: float) -> None:
    """Else it would come out as something else."""
    with pytest.raises(ShapeError, match="within the bounds"):
        encode([np.full((1, 1), value, np.float32)], bounds=(np.zeros(1), np.ones(1)))
