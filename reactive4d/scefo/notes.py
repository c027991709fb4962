"""Comments on their way from the text into the tree: each is claimed once, by what it stands beside.

A comment lies between two tokens. Behind a token, on its line, it belongs to the innermost thing that ends there; on a
line of its own, to what begins behind it; anywhere else to what encloses it.
"""

from bisect import bisect_left

from reactive4d.scefo.trees import NO_NOTES, Notes

__all__ = ["Comments", "behind"]


class Comments:
    """The comments of one script, in order, and the token that the parser looks at.

    Args of `add`: `index` tells behind which token a comment stands (-1: before the first), `is_tail` whether on its
    line, `is_separated` whether that token is a comma.
    """

    __slots__ = ("claimed", "here", "indices", "separated", "tails", "texts")

    def __init__(self) -> None:
        self.texts: list[str] = []
        self.indices: list[int] = []
        self.tails: list[bool] = []
        self.separated: list[bool] = []
        self.claimed: list[bool] = []
        self.here = 0

    def add(self, text: str, *, index: int, is_tail: bool = False, is_separated: bool = False) -> None:
        """Note one; "" is a blank line between statements."""
        self.texts.append(text)
        self.indices.append(index)
        self.tails.append(is_tail)
        self.separated.append(is_separated)
        self.claimed.append(False)

    def _claim(self, lo: int, hi: int, *, tails: bool | None = None, heads: bool = False) -> tuple[str, ...]:
        """Those behind the tokens lo … hi - 1 that nobody has claimed."""
        found: list[str] = []
        i = bisect_left(self.indices, lo)
        while i < len(self.indices) and self.indices[i] < hi:
            is_tail = self.tails[i]
            is_meant = (not (is_tail and self.separated[i])) if heads else tails is None or tails is is_tail
            if is_meant and not self.claimed[i]:
                self.claimed[i] = True
                found.append(self.texts[i])
            i += 1
        return tuple(found)

    def tail(self, index: int) -> tuple[str, ...]:
        """Those on the line of a token, behind it."""
        return self._claim(index, index + 1, tails=True) if self.texts else ()

    def rest(self) -> tuple[str, ...]:
        """Those that are left, behind the last statement."""
        return self._claim(self.here - 1, self.here + 1)

    def release(self, lo: int) -> None:
        """Let those behind the token `lo` and all further ones be claimed again."""
        for i in range(bisect_left(self.indices, lo), len(self.indices)):
            self.claimed[i] = False

    def of(self, first: int, inner: tuple[str, ...] = ()) -> Notes:
        """The comments of what begins with the token `first` and ends before the token that the parser looks at.

        `inner` are those of its last part. On the line of a comma a comment belongs to what the comma ends.
        """
        if not self.texts:
            return NO_NOTES
        last = self.here - 1
        before = self._claim(first - 1, first, heads=True)
        return Notes(before, behind(self._claim(first, last), inner, self.tail(last)))


def behind(*groups: tuple[str, ...]) -> tuple[str, ...]:
    """Comments in one line: `//` reaches to its end, so only the last one may begin so."""
    texts = [text for group in groups for text in group if text]
    return (*[_block(text) for text in texts[:-1]], *texts[-1:])


def _block(text: str) -> str:
    return text if text.startswith("/*") else f"/*{text[2:].replace('*/', '* /')} */"
