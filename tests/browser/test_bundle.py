"""The bundle as it is shipped: what it weighs, and that its interpreter agrees with Python's in a browser as well."""

import gzip
import hashlib
import json
import re
from pathlib import Path

import pytest
from readers import Read, Reader

import reactive4d_widgets
from reactive4d_widgets.conformance import vectors

STATIC = Path(reactive4d_widgets.__file__).parent / "static"


@pytest.fixture
def viewer(read: Read, tmp_path: Path) -> Reader:
    """A page on which nothing stands, with the viewer as `window.viewer`."""
    path = tmp_path / "empty.html"
    path.write_text("<!doctype html><html lang=en><meta charset=utf-8><title>x</title><link rel=icon href=data:,><p>x")
    reader = read(path)
    reader.ask(
        """async (code) => {
          const address = URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
          window.viewer = await import(address);
        }""",
        (STATIC / "r4d.mjs").read_text(encoding="utf-8"),
    )
    return reader


def test_the_bundle_is_the_one_that_was_built():
    """Its hash stands beside it."""
    digest = hashlib.sha256((STATIC / "r4d.mjs").read_bytes()).hexdigest()
    assert (STATIC / "r4d.mjs.sha256").read_text() == f"{digest}  r4d.mjs\n"


def test_the_bundle_is_small():
    """At most 700 KB, 200 KB gzipped."""
    code = (STATIC / "r4d.mjs").read_bytes()
    assert len(code) <= 700_000
    assert len(gzip.compress(code, 9)) <= 200_000


def test_the_bundle_needs_nobody():
    """It imports nothing, asks nobody, and makes no programs of texts."""
    code = (STATIC / "r4d.mjs").read_text(encoding="utf-8")
    assert not re.findall(r"""(?:^|[;}])import\b|\bimport\(|\beval\(|\bnew Function\b|\bfetch\(|XMLHttpRequest""", code)


def test_tracks_play_in_a_browser_as_in_python(viewer: Reader):
    """All conformance vectors: 1e-9 for tracks, 1e-6 for matrices, exactly equal at keys."""
    known = vectors()
    assert len(known["tracks"]) > 100
    # As a text: a driver's own way to pass values does not keep all of them.
    assert viewer.ask("(text) => viewer.conform(JSON.parse(text))", json.dumps(known)) == []
