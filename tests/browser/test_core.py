"""What the viewer calculates, in the browser: the same claims that hold in Node, of the bundle that is in the wheel."""

import base64
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from reactive4d_widgets.chunks import decode, encode, extent
from reactive4d_widgets.conformance import vectors

STATIC = Path(__file__).parents[2] / "widgets" / "reactive4d_widgets" / "static"
IMPORT = """async ([source, argument]) => {
    globalThis.imported ??= (() => {
        const bytes = Uint8Array.from(atob(source), (c) => c.charCodeAt(0));
        return import(URL.createObjectURL(new Blob([bytes], { type: "text/javascript" })));
    })();
    const viewer = await globalThis.imported;
    return RUN;
}"""


@pytest.fixture
def run(read: Callable[..., Any], tmp_path: Path) -> Callable[[str, Any], Any]:
    """Run an expression over the `viewer` (all that the bundle exports) and an `argument`, on an empty page."""
    page = tmp_path / "empty.html"
    page.write_text('<!doctype html><html lang="en"><title>empty</title></html>', encoding="utf-8")
    source = base64.b64encode((STATIC / "r4d.mjs").read_bytes()).decode("ascii")
    reader = read(page)

    def ran(expression: str, argument: Any) -> Any:
        return reader.page.evaluate(IMPORT.replace("RUN", expression), [source, argument])

    return ran


def test_the_browser_agrees_with_python_on_all_tracks_and_matrices(run: Callable[[str, Any], Any]) -> None:
    """1e-9 of their size for tracks, 1e-6 for matrices, exactly at keys."""
    written = json.loads(json.dumps(vectors()))
    assert len(written["tracks"]) > 100
    assert run("viewer.conform(argument)", written) == []


UNPACK = "viewer.decodeChunk(argument).then((made) => [...made.values()].map(({ ref, array }) => [ref, [...array]]))"


def test_the_browser_unpacks_what_python_packed_to_the_last_bit(run: Callable[[str, Any], Any]) -> None:
    """Floats as they were, floats of 16 bits, indices."""
    arrays = [np.sin(np.arange(300, dtype=np.float32) + k).reshape(100, 3) for k in range(3)]
    for chunk in (encode(arrays), encode(arrays, bounds=extent(arrays)), encode([np.arange(7, dtype=np.uint32)])):
        expected = [[ref, array.ravel().tolist()] for ref, array in decode(chunk).items()]
        assert run(UNPACK, chunk) == expected
