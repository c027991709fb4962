"""Pages: one HTML file with everything in it: prose, figures, their data, the viewer. Nothing is fetched from anywhere.

The page's own policy forbids all network, and every script but the loader and the viewer that the page itself carries.
"""

import importlib.metadata
import re
from collections.abc import Iterable, Mapping
from html import escape

from reactive4d.errors import ShapeError
from reactive4d_widgets.bundles import LOADER, loader_hash, packed, styles

__all__ = ["document", "framed", "heading", "inert", "joined", "refuse_wrong_words"]

_POLICY = (
    "default-src 'none'; script-src {loader} blob:; style-src 'unsafe-inline'; img-src data: blob:; "
    "base-uri 'none'; form-action 'none'"
)


def inert(json: str) -> str:
    r"""JSON that no reader of HTML takes for the end of its script.

    >>> inert('{"a":"</script><!--"}')
    '{"a":"\\u003c/script>\\u003c!--"}'
    """
    return json.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def document(body: str, data: Mapping[str, str], *, title: str, lang: str = "en", theme: str = "auto") -> str:
    """The whole file.

    Args:
        body: HTML.
        data: for each figure that has its own the JSON of its table.
        title: of the document.
        lang: of the prose, as in HTML.
        theme: "light", "dark", or "auto" for what the reader's system says.

    Raises:
        Reactive4dError: the viewer was not built.
    """
    code, digest = packed()
    version = importlib.metadata.version("reactive4d")
    head = [
        '<meta charset="utf-8">',
        f'<meta http-equiv="Content-Security-Policy" content="{_POLICY.format(loader=loader_hash())}">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        '<meta name="referrer" content="no-referrer">',
        f'<meta name="generator" content="reactive4d {escape(version)}">',
        f"<title>{escape(title)}</title>",
        f"<style>{_unbroken(styles())}</style>",
    ]
    scripts = [
        *(
            f'<script type="application/json" id="r4d-data-{escape(n)}">{inert(json)}</script>'
            for n, json in data.items()
        ),
        f'<script type="text/plain" id="r4d-bundle" data-sha256="{digest}">{code}</script>',
        f"<script>{LOADER}</script>",
    ]
    return framed(body, head=head, scripts=scripts, lang=lang, theme=theme)


def framed(
    body: str, *, head: Iterable[str], scripts: Iterable[str] = (), lang: str = "en", theme: str = "auto"
) -> str:
    """What stands round a body in any document of ours.

    Args:
        body: HTML.
        head: lines for the document's head.
        scripts: lines after the body's text.
        lang: of the prose, as in HTML.
        theme: "light", "dark", or "auto" for what the reader's system says.

    >>> print(framed("<h1>A</h1>", head=["<title>A</title>"], theme="dark"))
    <!doctype html>
    <html lang="en" data-theme="dark">
    <head>
    <title>A</title>
    </head>
    <body>
    <main class="r4d-page">
    <h1>A</h1>
    </main>
    </body>
    </html>
    <BLANKLINE>
    """
    forced = "" if theme == "auto" else f' data-theme="{escape(theme)}"'
    lines = [
        "<!doctype html>",
        f'<html lang="{escape(lang)}"{forced}>',
        "<head>",
        *head,
        "</head>",
        "<body>",
        f'<main class="r4d-page">\n{body}\n</main>',
        *scripts,
        "</body>",
        "</html>",
        "",
    ]
    return "\n".join(lines)


def _unbroken(css: str) -> str:
    """A style sheet that cannot end its element."""
    return re.sub(r"</(?=style)", r"<\\/", css, flags=re.IGNORECASE)


def heading(title: str) -> str:
    """The title as it stands above a text that has none."""
    return f"<h1>{escape(title)}</h1>"


def joined(parts: Iterable[str]) -> str:
    """Parts of a body, one after the other."""
    return "\n".join(part for part in parts if part)


def refuse_wrong_words(text: object, title: object, lang: object) -> None:
    """What stands on a page must be text that a file can hold.

    Raises:
        ShapeError: it is not.

    >>> refuse_wrong_words("# A ball", None, "en")
    """
    for name, words in {"text": text, "title": "" if title is None else title, "lang": lang}.items():
        if not isinstance(words, str):
            raise ShapeError(f"{name}: expected a text, got {words!r}")
        try:
            words.encode("utf-8")
        except UnicodeEncodeError as error:
            raise ShapeError(f"{name}: {words[error.start]!r} is half a character") from None
