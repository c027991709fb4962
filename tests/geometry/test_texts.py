"""Text as a solid: closed whatever is written, and as high as it says."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive4d.errors import ShapeError, UnknownNameError
from reactive4d.geometry import meshes, outlines, texts
from reactive4d.geometry.solids import from_mesh
from reactive4d.geometry.solids import volume as enclosed


@pytest.mark.parametrize("font", sorted(texts.FONTS))
def test_every_font_writes_closed_solids(font):
    """Letters with holes, parts that overlap and several lines: a solid of the outline's area times the depth."""
    text = "Object B&8%\nföß (äÅ) @ $2 $3"
    solid = texts.mesh(text, font=font, depth=0.5, height=2.0)
    exact = texts.volume(text, font=font, depth=0.5, height=2.0)
    assert meshes.is_closed(solid)
    assert meshes.volume(solid) == pytest.approx(exact, rel=1e-5)
    assert enclosed(from_mesh(solid)) == pytest.approx(exact, rel=1e-5)


@settings(max_examples=25)
@given(st.text(max_size=12))
def test_whatever_is_written_is_a_solid_or_nothing(text):
    """Control characters, scripts that the font does not know, surrogates and blanks included."""
    solid = texts.mesh(text)
    if len(solid.faces):
        assert meshes.is_closed(solid)
        assert not from_mesh(solid).manifold.is_empty()
    else:
        assert not texts.outline(text)


def test_capital_letters_have_the_height():
    """An H of height 3 stands on the baseline, 3 m high and `depth` thick."""
    low, high = meshes.bounds(texts.mesh("H", height=3.0, depth=0.25))
    np.testing.assert_allclose((low[1], high[1]), (0, 3), atol=1e-6)
    np.testing.assert_allclose((low[2], high[2]), (0, 0.25))
    assert low[0] == pytest.approx(-high[0])


def test_letters_have_their_holes():
    """An O is a ring of genus 1, a B has two holes, an i is two pieces, and 8 has two holes."""
    for text, pieces, holes in (("O", 1, 1), ("B", 1, 2), ("i", 2, 0), ("8", 1, 2), ("IO", 2, 1)):
        parts = from_mesh(texts.mesh(text)).manifold.decompose()
        assert (len(parts), sum(part.genus() for part in parts)) == (pieces, holes)


def test_lines_are_aligned():
    """Left lines begin near x = 0, centered ones have their middle at 0, right ones end at 0; each below the other."""
    for align, at in (("left", 0), ("center", 0.5), ("right", 1)):
        for line in ("H", "HHHH"):
            ink = np.concatenate(texts.outline(line, align=align))[:, 0]
            assert ink.min() + at * np.ptp(ink) == pytest.approx(0, abs=0.2)
    two = np.concatenate(texts.outline("H\nH"))
    assert two[:, 1].max() == pytest.approx(1)
    assert two[:, 1].min() == pytest.approx(-1.6)


def test_size_scales_and_segments_refine():
    """Twice the height is four times the area; more pieces make an O rounder."""
    assert outlines.area(texts.outline("Rg", height=2)) == pytest.approx(4 * outlines.area(texts.outline("Rg")))
    counts = [sum(map(len, texts.outline("O", segments=n))) for n in (1, 2, 8)]
    assert counts[0] < counts[1] < counts[2]


def test_measures_are_those_of_the_mesh():
    """Volume, area, centre of mass and inertia of letters, holes and all."""
    options = {"height": 2.0, "depth": 0.5, "segments": 3}
    mesh = texts.mesh("Bo8", align="left", **options)
    assert texts.volume("Bo8", **options) == pytest.approx(meshes.volume(mesh), rel=1e-4)
    assert texts.area("Bo8", **options) == pytest.approx(meshes.area(mesh), rel=1e-4)
    assert np.allclose(texts.center_of_mass("Bo8", align="left", **options), meshes.center_of_mass(mesh), atol=1e-4)
    assert np.allclose(texts.inertia("Bo8", **options), meshes.inertia(mesh), rtol=1e-3, atol=1e-4)
    assert texts.volume("") == texts.area("") == 0


def test_empty_texts_are_empty():
    """As are blanks and line breaks."""
    for text in ("", "   ", "\n\n", "\t"):
        assert len(texts.mesh(text).points) == 0
        assert texts.volume(text) == 0


def test_unknown_characters_show_as_the_replacement_character():
    """Nothing is left out silently, and nobody is warned."""
    assert outlines.area(texts.outline("\N{CJK UNIFIED IDEOGRAPH-4E2D}")) == pytest.approx(
        outlines.area(texts.outline("\N{REPLACEMENT CHARACTER}"))
    )


def test_the_same_text_is_the_same_mesh():
    """It is remembered."""
    assert texts.mesh("again") is texts.mesh("again")


def test_what_cannot_be_written_is_refused():
    """Heights, fonts, alignments and lengths are named."""
    with pytest.raises(ShapeError, match="height: expected a positive number of metres, got 0"):
        texts.mesh("a", height=0)
    with pytest.raises(ShapeError, match="depth"):
        texts.mesh("a", depth=math.inf)
    with pytest.raises(UnknownNameError, match="unknown font 'sanz'"):
        texts.mesh("a", font="sanz")
    with pytest.raises(UnknownNameError, match="unknown alignment"):
        texts.mesh("a", align="middle")
    with pytest.raises(ShapeError, match="at most 4096 characters, got 5000"):
        texts.mesh("a" * 5000)
    with pytest.raises(ShapeError, match="expected a string, got int"):
        texts.mesh(3)
    with pytest.raises(ShapeError, match="segments"):
        texts.mesh("a", segments=0)
