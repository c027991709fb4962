"""What a notebook keeps of a figure: how much of it, and what it says where that is not all."""

import base64
import json
import re
from typing import Any

import pytest

import reactive4d as r4
from reactive4d.errors import ShapeError
from reactive4d_widgets.bundles import packed
from reactive4d_widgets.keepsakes import kept


def test_what_is_kept_is_the_table_of_a_page_with_the_viewer_and_a_picture() -> None:
    """In one output, in all ways that it may be shown."""
    found = kept(r4.Scene(ball=r4.Sphere(color="crimson")), save=True, title="</script>")
    outputs = found.outputs("abc")
    assert base64.b64decode(outputs["image/png"])[:4] == b"\x89PNG"
    table = re.search(r"data-r4d-table>(.*?)</script>", outputs["text/html"])
    assert table is not None
    data = json.loads(table[1])
    assert [node["name"] for node in data["manifest"]["nodes"]] == ["ball"]
    assert data["manifest"]["title"] == "</script>"
    assert outputs["text/html"].count("</script>") == 3
    assert packed()[0] in outputs["text/html"]
    assert outputs["text/plain"].endswith("crimson sphere (ball) at (0.00, 0.00, 0.00).")


def test_what_takes_more_bytes_than_it_may_is_a_picture_and_says_so() -> None:
    """The limit holds for the figure with its viewer."""
    for save in (1000, len(packed()[0]) + 500):
        found = kept(r4.Scene(ball=r4.Sphere()), save=save)
        assert found.table is None
        assert "show(save=" in found.note
        assert "<script" not in found.outputs("abc")["text/html"]
    wish = re.search(r"save=(\de\d)", found.note)
    assert wish is not None
    assert kept(r4.Scene(ball=r4.Sphere()), save=float(wish[1])).table is not None


def test_who_did_not_ask_for_it_does_not_wait_for_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """By default what is slow to save is saved as a picture."""
    monkeypatch.setattr("reactive4d_widgets.keepsakes.PATIENCE", -1.0)
    found = kept(r4.Scene(ball=r4.Sphere()))
    assert found.table is None
    assert "show(save=True)" in found.note
    assert kept(r4.Scene(ball=r4.Sphere()), save=True).table is not None
    plain = kept(r4.Scene(ball=r4.Sphere()), save=False)
    assert (plain.table, plain.note) == (None, "")


@pytest.mark.parametrize("save", ["yes", -1, float("nan"), [1]])
def test_what_is_no_number_of_bytes_is_refused(save: Any) -> None:
    """Before anything is drawn."""
    with pytest.raises(ShapeError, match="save: expected"):
        kept(r4.Scene(ball=r4.Sphere()), save=save)
