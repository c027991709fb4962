"""When two arrays are the same, and what it takes to find out."""

import tracemalloc
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import reactive4d as r4
from reactive4d.arrays import freeze, same

LARGE = 1 << 20
DTYPES = ["f2", "f4", "f8", "c8", "c16", "i1", "i4", "u8", "?", "U3", "S5", "M8[s]", "f4,i1"]


def bits(a: Any, b: Any) -> bool:
    """The definition: equal bytes, or both NaN."""
    return all(
        x.tobytes() == y.tobytes() or (a.dtype.kind in "fc" and bool(np.isnan(x) and np.isnan(y)))
        for x, y in zip(a.reshape(-1), b.reshape(-1), strict=True)
    )


@given(data=st.data(), dtype=st.sampled_from(DTYPES), size=st.integers(0, 400))
def test_arrays_are_the_same_if_their_bytes_are_or_both_are_nan(data: st.DataObject, dtype: str, size: int) -> None:
    """Whatever they hold, of whatever length, and wherever they differ."""
    draw = np.random.default_rng(data.draw(st.integers(0, 99)))
    a = np.frombuffer(draw.bytes(size * np.dtype(dtype).itemsize), dtype) if dtype not in ("U3", "?") else None
    if a is None:
        a = draw.integers(0, 2, size).astype(dtype)
    b = a.copy()
    if size and data.draw(st.booleans()):
        b[data.draw(st.integers(0, size - 1))] = b[data.draw(st.integers(0, size - 1))]
    assert same(a, b) == bits(a, b)


def test_arrays_in_a_tuple_are_answers_too() -> None:
    """Nobody changes them; a view of what somebody else may change is a copy, and all else stays the very same."""
    own = np.zeros(3)

    @r4.signal
    def pair(t: float) -> Any:
        return np.arange(3.0) + t, ("deep", (own[:2], 1.0))

    first, (word, (second, one)) = pair.at(1.0)
    for array in (first, second):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 9.0
    own[0] = 5.0
    assert (word, second.tolist(), one) == ("deep", [0.0, 0.0], 1.0)
    kept = (first, "word", (1, 2.0))
    assert freeze(kept) is kept


@pytest.mark.parametrize("place", [0, 100, 1000, 77_777, LARGE - 1])
@pytest.mark.parametrize("other", [0.5, -0.0, np.nan])
def test_one_number_that_differs_is_found_wherever_it_is(place: int, other: float) -> None:
    """A zero with a sign and a NaN are other numbers than zero."""
    a, b = np.zeros(LARGE), np.zeros(LARGE)
    assert same(a, b)
    b[place] = other
    assert not same(a, b)


@pytest.mark.parametrize("dtype", ["f4", "f8", "c16"])
def test_any_nan_is_any_nan_in_large_arrays(dtype: str) -> None:
    """Whatever its sign and its payload."""
    a = np.ones(LARGE, dtype)
    a[LARGE // 2] = np.nan
    b = a.copy()
    b[LARGE // 2] = -b[LARGE // 2]
    assert a.tobytes() != b.tobytes()
    assert same(a, b)
    b[LARGE // 2 + 1] = -1.0
    assert not same(a, b)


@given(shape=arrays.array_shapes(max_dims=3, max_side=20), order=st.sampled_from(["C", "F", "mixed", "strided"]))
def test_the_order_in_memory_does_not_count(shape: tuple[int, ...], order: str) -> None:
    """Two arrays that are laid out in other ways are compared by place."""
    a = np.arange(float(np.prod(shape))).reshape(shape)
    if order == "strided":
        b = np.repeat(a, 2, axis=-1)[..., ::2]
    else:
        b = np.asfortranarray(a)
    one = np.asfortranarray(a) if order == "F" else a
    assert same(one, b)
    other = b.copy(order="K")
    other[tuple(n - 1 for n in shape)] += 1.0
    assert not same(one, other)


def peak(work: Callable[[], object]) -> int:
    """The most bytes that were taken at once."""
    tracemalloc.start()
    try:
        work()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("layout", [np.ascontiguousarray, np.asfortranarray])
def test_large_arrays_are_not_copied(layout: Callable[[Any], Any]) -> None:
    """Neither if they are the same, nor if they differ."""
    a = layout(np.arange(float(LARGE)).reshape(1024, -1))
    b = a.copy(order="K")
    assert peak(lambda: same(a, b)) < a.nbytes // 8
    b[0, 0] = -1.0
    assert peak(lambda: same(a, b)) < 16_384
