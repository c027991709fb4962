"""Settings: what Sphinx is told of the directives, the roles, the theme, and when a site is written."""

import importlib.metadata
import json
import sys
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.util import logging

from reactive4d.geometry.files import put
from reactive4d_apps.sphinx.bakings import EMPTY
from reactive4d_apps.sphinx.declarations import call, describe, pass_over
from reactive4d_apps.sphinx.directives import ExerciseDirective, IllustrationDirective, SolutionDirective
from reactive4d_apps.sphinx.elements import Illustration, add_elements
from reactive4d_apps.sphinx.mathml import visit_displayed, visit_inline
from reactive4d_apps.sphinx.readings import Readings, pantry_of, site_of
from reactive4d_apps.sphinx.roles import ROLES
from reactive4d_apps.sphinx.scripts import ScriptLexer
from reactive4d_apps.sphinx.sites import figures_file, script_name, write_data, write_viewer
from reactive4d_apps.sphinx.sources import digest_of, engine_digest
from reactive4d_apps.sphinx.stills import Stills

__all__ = ["setup"]

LOG = logging.getLogger("reactive4d.sphinx")
THEME = Path(__file__).parent / "theme"


def setup(app: Any) -> dict[str, Any]:
    """Tell Sphinx.

    Args:
        app: Sphinx's.

    Returns:
        What it wants to know of an extension.
    """
    app.add_config_value("illustration_cache", "", "")
    app.add_config_value("illustration_pictures", True, "", bool)
    app.add_config_value("illustration_limit", 20.0, "env", [float, int])
    add_elements(app)
    app.add_directive("illustration", IllustrationDirective)
    app.add_directive("exercise", ExerciseDirective)
    app.add_directive("solution", SolutionDirective)
    for name, role in ROLES.items():
        app.add_role(name, role)
    app.add_transform(Readings)
    app.add_post_transform(Stills)
    app.add_lexer("scefo", ScriptLexer)
    app.add_html_math_renderer("mathml", (visit_inline, None), (visit_displayed, None))
    app.add_html_theme("reactive4d_book", str(THEME))
    app.setup_extension("sphinx.ext.autodoc")
    app.connect("autodoc-process-docstring", describe, priority=600)  # when another one has read its sections
    app.connect("autodoc-process-signature", call)
    app.connect("autodoc-skip-member", pass_over)
    app.connect("config-inited", _configure)
    app.connect("builder-inited", _begin)
    app.connect("env-get-outdated", _outdated)
    app.connect("env-get-outdated", _edited)
    app.connect("env-purge-doc", _purge)
    app.connect("env-merge-info", _merge)
    app.connect("html-page-context", _page)
    app.connect("build-finished", _finish)
    return {
        "version": importlib.metadata.version("reactive4d"),
        "env_version": 1,
        "parallel_read_safe": False,  # pictures are drawn by one program at a time
        "parallel_write_safe": True,
    }


def _configure(app: Any, config: Any) -> None:
    """Mathematics come with the page, not from elsewhere."""
    if config.html_math_renderer in (None, "mathjax"):
        config.html_math_renderer = "mathml"
    config.numfig_format.setdefault("figure", "Figure %s")


def _begin(app: Any) -> None:
    # What stands beside the pages can be imported by them.
    if str(app.srcdir) not in sys.path:
        sys.path.insert(0, str(app.srcdir))
    if _is_html(app):
        write_viewer(Path(app.outdir) / "_static")


def _outdated(app: Any, env: Any, added: set[str], changed: set[str], removed: set[str]) -> list[str]:
    """Pages with figures to be read anew: with another engine, not written, or with something to be made."""
    folder, done = pantry_of(app).folder, _done(app)
    empty = f"{EMPTY}.webp" if app.config.illustration_pictures else ""
    is_same = getattr(env, "r4d_engine", engine_digest()) == engine_digest()
    env.r4d_engine = engine_digest()
    return [
        page
        for page, entries in site_of(env).items()
        if not is_same
        or any(done.get(line) != json.loads(json.dumps(entry)) for line, entry in entries.items())
        or any(
            empty in entry["pictures"] or not (folder / f"{entry['key']}.json").exists() for entry in entries.values()
        )
    ]


def _edited(app: Any, env: Any, added: set[str], changed: set[str], removed: set[str]) -> list[str]:
    """Pages whose text is another one, however old their files say that it is."""
    before = getattr(env, "r4d_pages", {})
    env.r4d_pages = {page: digest_of("", [Path(env.doc2path(page))]) for page in env.found_docs}
    return [page for page, digest in env.r4d_pages.items() if before.get(page, digest) != digest]


def _done(app: Any) -> dict[str, Any]:
    """The figures of what was written last; a build that was broken off wrote less than it read."""
    try:
        return json.loads(figures_file(Path(app.doctreedir), app.builder.name).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}


def _is_html(app: Any) -> bool:
    return app.builder.format == "html" and app.builder.name != "epub"


def _purge(app: Any, env: Any, page: str) -> None:
    site_of(env).pop(page, None)


def _merge(app: Any, env: Any, pages: Any, other: Any) -> None:
    for page in pages:
        if page in site_of(other):
            site_of(env)[page] = site_of(other)[page]


def _page(app: Any, page: str, template: str, context: dict[str, Any], tree: nodes.document | None) -> None:
    """A page without figures needs no viewer."""
    if _is_html(app) and tree is not None and any(True for _ in tree.findall(Illustration)):
        app.add_js_file(script_name(), loading_method="defer")


def _finish(app: Any, error: BaseException | None) -> None:
    if error is not None:
        return
    entries = {line: entry for page in site_of(app.env).values() for line, entry in page.items()}
    pantry, size = pantry_of(app), 0
    if _is_html(app):
        static = Path(app.outdir) / "_static"
        write_viewer(static)
        size = write_data(static, entries.values(), pantry.folder)
    file = figures_file(Path(app.doctreedir), app.builder.name)
    put(file, json.dumps(entries, indent=1).encode("utf-8"))
    told = "%d figures, %d asked anew, %d pictures drawn; their data take %.1f MB"
    LOG.info(told, len(entries), pantry.asked, pantry.drawn, size / 1e6)
