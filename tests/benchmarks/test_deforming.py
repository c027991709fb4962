"""Both contenders of the deformations do the same work."""

import numpy as np
import pytest

from .deforming import NAMES, cloud, ours, plain


@pytest.mark.parametrize("names", [NAMES, NAMES[::-1], *[(name,) for name in NAMES]], ids="+".join)
@pytest.mark.parametrize("t", [0.0, 1.5])
def test_blocks_of_float32_answer_as_plain_numpy(names: tuple[str, ...], t: float):
    """The library answers what the formulas say that one writes down, to the rounding of float32."""
    points = cloud(40_000)  # Two blocks and a half.
    answer = ours(points, names, t)
    assert answer.dtype == np.float32
    assert np.abs(answer - plain(points.astype(np.float64), names, t)).max() < 2e-6
