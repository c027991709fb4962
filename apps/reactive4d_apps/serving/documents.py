"""Documents: the page that is served: prose and figures as in a baked page, but the figures ask."""

from collections.abc import Callable, Mapping
from html import escape
from typing import Any

from reactive4d.illustrations import Figure
from reactive4d_widgets.bundles import STATIC, packed, styles
from reactive4d_widgets.figures import Shown
from reactive4d_widgets.layouts import laid_out, lead
from reactive4d_widgets.pages import framed
from reactive4d_widgets.plans import Plan
from reactive4d_widgets.tables import Table

__all__ = ["Opening", "document", "files"]

START = b'import { serve } from "./r4d.mjs";\nserve(document);\n'


class Opening:
    """A figure as it is where it opens: enough for the text around it and for its picture.

    Args:
        name: how it is called on its page.
        figure: what it shows, and how.
        plan: of its model.
        manifest: of its model.
        segments: what its values and its alternative text are where it opens.
    """

    def __init__(
        self, name: str, figure: Figure, plan: Plan, manifest: dict[str, Any], segments: list[dict[str, Any]]
    ) -> None:
        table = Table(manifest, segments, [])
        self.shown = Shown(name, figure.title, figure.thing, plan, table, name, figure.follow)


def files() -> dict[str, tuple[str, bytes]]:
    """What a page asks for: the viewer, the styles, and the line that starts it.

    Raises:
        Reactive4dError: the viewer was not built, or is not what was built.
    """
    packed()
    return {
        "r4d.mjs": ("text/javascript", (STATIC / "r4d.mjs").read_bytes()),
        "page.css": ("text/css", styles().encode()),
        "start.mjs": ("text/javascript", START),
    }


def document(
    openings: Mapping[str, Callable[[], Opening]], text: str, *, title: str | None, lang: str, theme: str
) -> str:
    """The page.

    Args:
        openings: the figures, by name.
        text: Markdown.
        title: of the page; otherwise its first heading, or what the first figure is called.
        lang: of the text, as in HTML.
        theme: "light", "dark" or "auto".

    Raises:
        UnknownNameError: the text names what no figure knows.
        ShapeError: a figure follows itself.
    """
    shown = [opened().shown for opened in openings.values()]
    lead(shown, text)
    layout = laid_out(shown, text, title=title)
    head = [
        '<meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        '<link rel="icon" href="data:,">',
        '<link rel="stylesheet" href="page.css">',
        f"<title>{escape(layout.title)}</title>",
        '<script type="module" src="start.mjs"></script>',
    ]
    return framed(layout.body, head=head, lang=lang, theme=theme)
