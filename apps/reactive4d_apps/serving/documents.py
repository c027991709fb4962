"""Documents: the page that is served: prose and figures as in a baked page, but the figures ask."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
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


@dataclass(slots=True)
class Editable(Shown):
    """A figure with the script below it that its reader may edit.

    Attributes:
        script: the text.
    """

    script: str = ""

    def html(self, caption: str, alt: str | None) -> str:
        """The figure as it stands in a page, and its script."""
        pre = f"<pre>\n{escape(self.script, quote=False)}</pre>"
        return f'{Shown.html(self, caption, alt)}\n<r4d-script figure="{escape(self.name)}">{pre}</r4d-script>'


class Opening:
    """A figure as it is where it opens: enough for the text around it and for its picture.

    Args:
        name: how it is called on its page.
        figure: what it shows, and how.
        plan: of its model.
        manifest: of its model.
        segments: what its values are where it opens.
        script: that its reader may edit; None if there is none.
    """

    def __init__(
        self,
        name: str,
        figure: Figure,
        plan: Plan,
        manifest: dict[str, Any],
        segments: list[dict[str, Any]],
        script: str | None = None,
    ) -> None:
        said = (name, figure.title, figure.thing, plan, Table(manifest, segments, []), name, figure.follow)
        self.shown = Shown(*said) if script is None else Editable(*said, script=script)


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
