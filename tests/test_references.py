"""A reference stands for the content of an array."""

import hashlib

import numpy as np
import pytest

from reactive4d.references import reference


def test_a_reference_is_half_a_digest_over_type_shape_and_bytes() -> None:
    """As the wire says it."""
    array = np.arange(6, dtype=np.float32).reshape(2, 3)
    wanted = hashlib.sha256(b"<f4|2,3|" + array.tobytes()).hexdigest()[:32]
    assert reference(array) == wanted


def test_type_and_shape_have_a_say() -> None:
    """The same bytes as something else are something else."""
    array = np.zeros((2, 3), np.float32)
    assert len({reference(x) for x in (array, array.reshape(3, 2), array.view(np.int32), array.ravel())}) == 4


def test_how_an_array_lies_in_memory_has_none() -> None:
    """Big-endian, strided or copied: the content is the same."""
    array = np.arange(12, dtype=np.float32).reshape(3, 4)
    wide = np.zeros((3, 8), np.float32)
    wide[:, ::2] = array
    others = (array.astype(">f4"), np.asfortranarray(array), wide[:, ::2], array.copy())
    assert {reference(x) for x in others} == {reference(array)}


def test_objects_have_no_reference() -> None:
    """They have no bytes of their own."""
    with pytest.raises(TypeError, match="object"):
        reference(np.array([None]))
