r"""Prose: Markdown with numbers, links, words, figures and formulas in it, made HTML.

`{length:.2f}` is a number, `[text](#length=2&t=1)` a link to a point, `[the bob](#bob)` a word that highlights an
object, `![caption](pendulum)` a figure, `$x^2$` a formula. Each name belongs to the figure that it names,
`{pendulum.length}`, else to the last one before it that knows the name, else to the first one that does. Braces that
mean nothing of the kind are written `\{`. HTML in the text is text.
"""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from typing import Any
from urllib.parse import unquote

from markdown_it.token import Token

from reactive4d.errors import Reactive4dError, ShapeError, UnknownNameError, hint, unknown
from reactive4d_widgets.marks import made, marks, plain

__all__ = ["Cast", "Written", "written"]

_FOLLOW = re.compile(r"follow\s+([^\W\d][\w-]*)")


@dataclass(frozen=True, slots=True)
class Cast:
    """What the prose may name of a figure.

    Attributes:
        name: the figure's.
        numbers: parameters and values: from a format to how it reads where the page opens.
        parameters: the names of those that are driven.
        nodes: names of objects.
        block: from a caption (HTML) to the figure as HTML.
    """

    name: str
    numbers: Mapping[str, Callable[[str], str]]
    parameters: frozenset[str]
    nodes: frozenset[str]
    block: Callable[[str], str]


@dataclass(slots=True)
class Written:
    """Prose as HTML.

    Attributes:
        html: of the body.
        title: the text of the first heading of the first rank; None without one.
        placed: the names of the figures that stand in it.
        follows: which of them follows which.
        links: the figures and the points that links go to, as text.
    """

    html: str
    title: str | None = None
    placed: list[str] = field(default_factory=list[str])
    follows: dict[str, str] = field(default_factory=dict[str, str])
    links: list[tuple[str, str]] = field(default_factory=list[tuple[str, str]])


def written(text: str, casts: Iterable[Cast]) -> Written:
    r"""Make HTML of a page's prose.

    Args:
        text: Markdown.
        casts: the figures.

    Raises:
        UnknownNameError: it names what no figure knows.
        ShapeError: a figure stands in the middle of a sentence, or stands twice; a formula is none.

    >>> print(written("# A ball\n\n2 < 3 & \\{x}", []).html)
    <h1 id="a-ball">A ball</h1>
    <p>2 &lt; 3 &amp; {x}</p>
    """
    composer = _Composer({cast.name: cast for cast in casts})
    return composer.compose(text)


class _Composer:
    """Reads one text."""

    def __init__(self, casts: Mapping[str, Cast]) -> None:
        self.casts = casts
        self.order: list[str] = []  # figures that were placed so far
        self.follows: dict[str, str] = {}
        self.links: list[tuple[str, str]] = []
        self.slugs: set[str] = set()  # names of headings
        self.markdown = marks()

    def compose(self, text: str) -> Written:
        env: dict[str, Any] = {}
        tokens = self.markdown.parse(text, env)
        made = Written("")
        for i, token in enumerate(tokens):
            if token.type == "heading_open":
                content = tokens[i + 1]
                title = plain(content.children or [])
                token.attrSet("id", self._slug(title))
                if token.tag == "h1" and made.title is None:
                    made.title = title
        made_of: list[Token] = []
        i = 0
        while i < len(tokens):
            token = tokens[i]
            figure = self._alone(tokens, i)
            if figure is not None:
                made_of.append(self._figure(figure, env))
                i += 3
                continue
            if token.type == "inline":
                token.children = self._inline(token.children or [])
            made_of.append(token)
            i += 1
        made.html = self.markdown.renderer.render(made_of, self.markdown.options, env).rstrip("\n")
        made.placed, made.follows, made.links = list(self.order), self.follows, self.links
        return made

    def _slug(self, title: str) -> str:
        """A name for a heading, each once."""
        base = re.sub(r"[^\w]+", "-", title.lower()).strip("-") or "section"
        slug, count = base, 1
        while slug in self.slugs:
            count += 1
            slug = f"{base}-{count}"
        self.slugs.add(slug)
        return slug

    # -- figures ---------------------------------------------------------------------------------------------------

    def _alone(self, tokens: Sequence[Token], i: int) -> Token | None:
        """The image that is all of a paragraph, if it names a figure."""
        if tokens[i].type != "paragraph_open" or i + 2 >= len(tokens):
            return None
        inside = [part for part in tokens[i + 1].children or [] if part.type != "text" or part.content.strip()]
        if len(inside) != 1 or inside[0].type != "image":
            return None
        return inside[0] if self._is_figure(inside[0]) else None

    def _is_figure(self, image: Token) -> bool:
        source = unquote(str(image.attrGet("src") or ""))
        if source in self.casts:
            return True
        if source.startswith("data:image/"):
            return False
        raise unknown(source, self.casts, what="figure")

    def _figure(self, image: Token, env: dict[str, Any]) -> Token:
        name = unquote(str(image.attrGet("src")))
        if name in self.order:
            error = ShapeError(f"the figure {name!r} stands twice on the page")
            raise hint(error, f'give it another name: Page(text, {name}=…, again=…), ![](again "follow {name}")')
        self.order.append(name)
        title = str(image.attrGet("title") or "")
        follow = _FOLLOW.fullmatch(title.strip())
        if title.strip() and follow is None:
            error = ShapeError(f'![…]({name} "{title}"): expected "follow …"')
            raise hint(error, 'as in ![…](twin "follow pendulum")')
        if follow is not None and follow[1] not in self.casts:
            raise unknown(follow[1], self.casts, what="figure")
        if follow is not None:
            self.follows[name] = follow[1]
        caption = self.markdown.renderer.render(self._inline(image.children or []), self.markdown.options, env)
        return made("figure", self.casts[name].block(caption) + "\n")

    # -- what stands in a sentence ---------------------------------------------------------------------------------

    def _inline(self, tokens: Sequence[Token]) -> list[Token]:
        parts: list[Token] = []
        closing: list[Token | None] = []
        for token in tokens:
            if token.type == "number":
                parts.append(made("number", self._number(token)))
            elif token.type == "image" and self._is_figure(token):
                error = ShapeError(f"the figure {token.attrGet('src')!r} stands in the middle of a sentence")
                raise hint(error, "give it a paragraph of its own")
            elif token.type == "link_open":
                pair = self._link(str(token.attrGet("href") or ""))
                if pair is None and not str(token.attrGet("href") or "").startswith("#"):
                    token.attrSet("rel", "noopener noreferrer")
                parts.append(token if pair is None else made("opening", pair[0]))
                closing.append(None if pair is None else made("closing", pair[1]))
            elif token.type == "link_close":
                parts.append(closing.pop() or token)
            else:
                parts.append(token)
        return parts

    def _number(self, token: Token) -> str:
        name, spec = token.meta["name"], token.meta["spec"]
        cast, name = self._owner(name, lambda cast: cast.numbers, what="parameter or value")
        try:
            shown = cast.numbers[name](spec)
        except ValueError as error:
            raise hint(ShapeError(f"{{{name}:{spec}}}: {error}"), "a format as in f-strings: {length:.2f}") from None
        form = f' format="{escape(spec)}"' if spec else ""
        return f'<r4d-number figure="{escape(cast.name)}" name="{escape(name)}"{form}>{escape(shown)}</r4d-number>'

    def _link(self, address: str) -> tuple[str, str] | None:
        """What stands for a link to a point, or for a word that is about an object; None for any other link."""
        if not address.startswith("#") or len(address) == 1:
            return None
        inside = unquote(address[1:])
        if "=" in inside:
            cast, point = self._point(address[1:])
            self.links.append((cast.name, point))
            return f'<r4d-link figure="{escape(cast.name)}" point="{escape(point)}">', "</r4d-link>"
        try:
            cast, node = self._owner(inside, lambda cast: dict.fromkeys(cast.nodes), what="object")
        except UnknownNameError:
            if inside in self.slugs:
                return None
            raise
        return f'<r4d-word figure="{escape(cast.name)}" node="{escape(node)}">', "</r4d-word>"

    def _point(self, text: str) -> tuple[Cast, str]:
        """The figure of a link, and the point without its name."""
        owner: Cast | None = None
        bare: list[str] = []
        for piece in text.split("&"):
            key, _, value = piece.partition("=")
            key = unquote(key)
            if "." in key and key.split(".", 1)[0] in self.casts:
                name, key = key.split(".", 1)
                if owner is not None and owner.name != name:
                    raise hint(ShapeError(f"#{text}: a link goes to a point of one figure"), "make two links of it")
                owner = self.casts[name]
            bare.append(f"{key}={value}")
        keys = [piece.partition("=")[0] for piece in bare]
        wanted = [key for key in keys if key not in ("t", "cam")]
        if owner is None:
            if wanted:
                owner, _ = self._owner(wanted[0], lambda cast: dict.fromkeys(cast.parameters), what="parameter")
            else:
                owner = self._nearest(lambda cast: True)
        if owner is None:
            raise hint(ShapeError(f"#{text}: there is no figure"), "place one: ![caption](name)")
        for key in wanted:
            if key not in owner.parameters:
                raise unknown(key, owner.parameters, what="parameter")
        return owner, "&".join(bare)

    def _owner(self, name: str, known: Callable[[Cast], Mapping[str, Any]], *, what: str) -> tuple[Cast, str]:
        """The figure to which a name belongs, and the name without the figure's."""
        first, dot, rest = name.partition(".")
        if dot and first in self.casts:
            cast = self.casts[first]
            if rest not in known(cast):
                raise unknown(rest, known(cast), what=what)
            return cast, rest
        found = self._nearest(lambda cast: name in known(cast))
        if found is None:
            error: Reactive4dError = unknown(name, [n for cast in self.casts.values() for n in known(cast)], what=what)
            raise hint(error, "braces and links that mean something else: \\{ and \\[") if what != "object" else error
        return found, name

    def _nearest(self, fits: Callable[[Cast], bool]) -> Cast | None:
        """The last figure before here that fits, else the first of all that does."""
        names = [*reversed(self.order), *self.casts]
        return next((self.casts[name] for name in names if fits(self.casts[name])), None)
