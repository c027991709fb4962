"""Kinds and changes in a reference: what autodoc tells of classes whose settings stand in their bodies."""

import re

from writers import Book

FLAGS = '''
import reactive4d as r4


class Flag(r4.Deformation):
    """Hang down.

    >>> 1 + 1
    2
    """

    positional = 1
    sag = r4.Float(unit="m", doc="at the free end")
    along = r4.Vector((1, 0, 0), doc="from the pole")
    wet = r4.Flag(False, doc="whether it rains")

    @staticmethod
    def deform(sag, along, wet, points, position):
        """What the rule calls."""
        return points

    def dry(self):
        """Wait."""
'''
PAGE = """# Flags

```{eval-rst}
.. autoclass:: flags.Flag
   :members:
```
"""


def test_a_reference_tells_the_settings_of_a_change(book: Book):
    """How it is made, and each with its unit and its default before the example; not what its rule calls."""
    (book.folder / "flags.py").write_text(FLAGS, encoding="utf-8")
    build = book.build(PAGE, strict=True)
    assert build.ok, build.complaints
    text = re.sub(r"\s+", " ", re.sub(r"<[^>]+>", "", book.html()))
    assert "flags.Flag(sag, *, along=(1, 0, 0), wet=False)" in text
    for line in ("sag – at the free end [m]", "along – from the pole; by default (1, 0, 0)", "wet – whether it rains"):
        assert line in text
        assert text.index(line) < text.index("1 + 1")
    assert "What the rule calls." not in text
    assert "Wait." in text
