"""Stills: where nothing can live, in LaTeX and the like, a figure is its picture."""

from typing import Any

from docutils import nodes
from sphinx.transforms.post_transforms import SphinxPostTransform

from reactive4d_apps.sphinx.elements import Illustration

__all__ = ["Stills"]


class Stills(SphinxPostTransform):
    """Puts pictures in place of figures, for all builders but those of HTML."""

    default_priority = 8

    def is_supported(self) -> bool:
        """Whether the builder wants pictures."""
        return self.app.builder.format != "html"

    def run(self, **options: Any) -> None:
        """Replace them."""
        for node in list(self.document.findall(Illustration)):
            uri = node["uri"]
            picture = nodes.image("", uri=uri, candidates={"*": uri}, alt=node["alt"], width="100%")
            node.parent.replace(node, picture)
