"""The first page that anybody reads: its pictures are made by the programs beside them."""

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from reactive4d_widgets.displays import can_draw

ROOT = Path(__file__).parent.parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")
PROGRAM = re.findall(r"^```python\n(.*?)^```$", README, flags=re.MULTILINE | re.DOTALL)[0]


@pytest.mark.skipif(not can_draw() and not os.environ.get("CI"), reason="no OpenGL here: apt-get install libegl1")
def test_the_first_picture_is_what_the_first_program_draws(tmp_path: Path):
    """Within what one version of VTK and Mesa differs from another; and the program's page is there as well."""
    subprocess.run([sys.executable, "-W", "error", "-c", PROGRAM], cwd=tmp_path, check=True, stdout=subprocess.PIPE)
    drawn, shown = [
        np.asarray(Image.open(path), np.float64) for path in (tmp_path / "first.png", ROOT / "docs/pictures/first.png")
    ]
    assert drawn.shape == shown.shape
    assert np.abs(drawn - shown).mean() < 2.0
    assert "<r4d-figure" in (tmp_path / "first.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("picture", re.findall(r"!\[.*?\]\((.*?)\)", README))
def test_a_picture_is_there_and_small(picture: str):
    """So that the page is read without waiting."""
    assert (ROOT / picture).stat().st_size < 100_000
