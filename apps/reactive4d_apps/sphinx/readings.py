"""Readings: when a page was read, its figures are baked, and its numbers, links and words find the figure they mean."""

import os
import re
import traceback
from dataclasses import replace
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.transforms import SphinxTransform
from sphinx.util import logging

from reactive4d.errors import Reactive4dError, ShapeError, hint, unknown
from reactive4d.illustrations import Bookmark, subject
from reactive4d_apps.scripts import script_of
from reactive4d_apps.sphinx.bakings import SIZE, Baking, Pantry, Still, Wish, opening
from reactive4d_apps.sphinx.casts import Cast, Company
from reactive4d_apps.sphinx.elements import Check, Either, Fold, Illustration, Link, Number, Script, Word
from reactive4d_apps.sphinx.programs import Coded, Placed, Program, kept
from reactive4d_apps.sphinx.sources import digest_of
from reactive4d_apps.sphinx.wordings import named, times_of
from reactive4d_widgets.tables import compact

__all__ = ["Readings", "pantry_of", "site_of", "told"]

LOG = logging.getLogger("reactive4d.sphinx")
_NAME = re.compile(r"[^\W\d][\w-]*")


def pantry_of(app: Any) -> Pantry:
    """Where the figures of a site are kept between builds."""
    known = getattr(app, "_r4d_pantry", None)
    if known is None:
        folder = app.config.illustration_cache
        known = Pantry(Path(app.confdir, folder) if folder else Path(app.doctreedir).parent / "illustrations")
        app._r4d_pantry = known
    return known


def site_of(env: Any) -> dict[str, dict[str, dict[str, Any]]]:
    """What a site has to carry: by page, and by the name of the line to a figure's model."""
    if not hasattr(env, "r4d_site"):
        env.r4d_site = dict[str, Any]()
    found: dict[str, dict[str, dict[str, Any]]] = env.r4d_site
    return found


def told(error: BaseException) -> str:
    """An error in one line, with what helps."""
    notes = [note for note in getattr(error, "__notes__", ()) if note]
    kind = "" if isinstance(error, Reactive4dError) else type(error).__name__
    said = ": ".join(part for part in (kind, str(error)) if part)
    return " ".join((f"{said} ({'; '.join(notes)})" if notes else said).split())


class Readings(SphinxTransform):
    """Bakes the figures of a page, and resolves what its text says of them."""

    default_priority = 205  # before what has no name is given one, and before images are collected

    def apply(self, **options: Any) -> None:
        """Go through the page, from top to bottom."""
        self.company = Company()
        self.programs: dict[str, Program] = {}
        self.wishes: dict[str, Wish] = {}
        self.failed = False
        marks = [node for node in self.document.findall(nodes.Element) if isinstance(node, Illustration)]
        for node in marks:
            self._figure(node)
        self._leaders(marks)
        for node in list(self.document.findall(nodes.Element)):
            if isinstance(node, Illustration):
                if node.get("name") in self.company.casts:
                    self.company.passed.append(node["name"])
            elif isinstance(node, Number | Link | Word | Check | Either):
                self._resolve(node)

    def _warn(self, words: str, where: Any) -> None:
        self.env.note_reread()  # what is wrong is said again until it is mended
        LOG.warning("%s", words, location=where, type="illustration")

    # -- figures ---------------------------------------------------------------------------------------------------

    def _figure(self, node: Illustration) -> None:
        figure = node.parent
        assert isinstance(figure, nodes.figure)
        program = None
        try:
            program = self._program(node)
            for path in program.files:
                self.env.note_dependency(os.path.relpath(path, self.env.srcdir))
            self._bake(node, figure, program)
        except RecursionError:
            raise
        except Exception as error:  # noqa: BLE001 - the border: whatever an author's program does wrong
            self.failed = True
            self._warn(told(error), self._where(node, error, program))
            figure.parent.replace(figure, nodes.container("", nodes.paragraph("", told(error)), classes=["r4d-failed"]))

    def _where(self, node: Illustration, error: BaseException, program: Program | None) -> Any:
        """The line of the page where a program in it fails; else that of the figure."""
        if isinstance(program, Coded):
            lines = [
                frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == program.place
            ]
            if isinstance(error, SyntaxError) and error.filename == program.place:
                lines.append(error.lineno)
            if lines:
                return f"{program.place}:{lines[-1]}"
        return node

    def _program(self, node: Illustration) -> Program:
        besides = tuple(Path(path) for path in node["besides"])
        if node["place"]:
            if node["after"]:
                raise ShapeError(":after: goes on from a program in the page; this figure has a place of its own")
            return Placed(node["place"], besides)
        if not node["program"].strip():
            raise hint(
                ShapeError("illustration: nothing is to be shown"), "a module:Class, a script, or a program in it"
            )
        before = None
        if node["after"]:
            before = self.programs.get(node["after"])
            if not isinstance(before, Coded):
                raise unknown(node["after"], self.programs, what="program of this page to go on from")
        return Coded(node["program"], node["page"], node["program_line"], besides, before)

    def _bake(self, node: Illustration, figure: nodes.figure, program: Program) -> None:
        options = named(node["options"], what="options") if node["options"] else {}
        if node["height"]:
            options["height"] = node["height"]
        wish = Wish(
            program,
            times=times_of(node["times"]) if node["times"] else None,
            parameters=named(node["parameters"], what="parameters") if node["parameters"] else {},
            options=options,
        )
        pantry = pantry_of(self.app)
        baking = pantry.baking(wish, limit=self.config.illustration_limit * 1e6)
        for problem in baking.problems:
            self._warn(problem, node)
        for note in baking.notes:
            LOG.info("%s: %s", self.env.docname, note)
        thing = program.thing()
        name = self._name(node, thing)
        point = opening(baking, thing, node["point"])
        cast = Cast(name, baking, point, thing)
        if node["point"]:
            cast.holds(node["point"])
        still = pantry.still(wish, baking, point, drawn=self.config.illustration_pictures)
        self.company.casts[name] = cast
        self.programs[name] = program
        self.wishes[name] = wish
        self._write(node, cast, wish, still)
        figure["names"].append(nodes.fully_normalize_name(name))
        self.document.note_explicit_target(figure, figure)
        self._code(node, figure, program)

    def _name(self, node: Illustration, thing: Any) -> str:
        wanted = node["name"]
        if wanted:
            if not _NAME.fullmatch(wanted):
                raise hint(ShapeError(f"{wanted!r} is not a name for a figure"), "letters, digits, _ and -")
            if wanted in self.company.casts:
                raise hint(ShapeError(f"the figure {wanted!r} stands twice on the page"), "give it another name")
            return wanted
        base = name = subject(thing).name
        count = 1
        while name in self.company.casts:
            count += 1
            name = f"{base}-{count}"
        return name

    def _write(self, node: Illustration, cast: Cast, wish: Wish, still: Still) -> None:
        """What the page has to know of it, and what the site has to carry."""
        baking = cast.baking
        source, digest = data_of(baking)
        line = digest_of(f"{self.env.docname}\n{cast.name}", [])
        node["said"] = node["alt"]
        node["name"], node["source"], node["line_name"] = cast.name, source, line
        node["title"] = str(baking.manifest["title"])
        node["height"] = wish.options.get("height")
        node["size"] = list(SIZE)
        site = site_of(self.env).setdefault(self.env.docname, {})
        site[line] = {
            "page": self.env.docname,
            "name": cast.name,
            "source": source,
            "key": baking.key,
            "digest": digest,
            "pictures": [],
            "program": kept(wish.program, Path(self.env.srcdir)),
            "times": wish.times,
            "parameters": dict(wish.parameters),
            "options": dict(wish.options),
            "title": node["title"],
            "editable": node["editable"],
        }
        self._still(node, still)

    def _still(self, node: Illustration, still: Still) -> None:
        node["alt"] = node["said"] or still.text
        node["picture"], node["dark"] = still.light.name, still.dark.name
        node["uri"] = os.path.relpath(still.printed, self.env.srcdir)
        self.env.images.add_file(self.env.docname, node["uri"])
        pictures = dict.fromkeys((still.light.name, still.dark.name))
        site_of(self.env)[self.env.docname][node["line_name"]]["pictures"] = [*pictures]

    def _code(self, node: Illustration, figure: nodes.figure, program: Program) -> None:
        where = node["code_at"]
        if where == "none" and not node["editable"]:
            return
        text = script_of(program.thing()) if node["editable"] else program.text
        language = "scefo" if node["editable"] else program.language
        listing = nodes.literal_block(text, text, language=language)
        listing.source, listing.line = node.source, node.line
        block = Script("", listing, figure=node["name"]) if node["editable"] else listing
        where = "below" if where == "none" else where
        parent = figure.parent
        at = parent.index(figure)
        if where == "above":
            parent.insert(at, block)
        elif where == "beside":
            parent.replace(figure, nodes.container("", block, figure, classes=["r4d-beside"]))
        elif where == "below":
            parent.insert(at + 1, block)
        else:
            parent.insert(at + 1, Fold("", block, title="The program", kind="program"))

    def _leaders(self, marks: list[Illustration]) -> None:
        """A figure that follows another opens where that one does."""
        for node in marks:
            wanted = node.get("follow")
            cast = self.company.casts.get(node.get("name") or "")
            if not wanted or cast is None:
                continue
            leader = self.company.casts.get(wanted)
            if leader is None or leader is cast:
                error = unknown(
                    wanted, [name for name in self.company.casts if name != cast.name], what="figure to follow"
                )
                self._warn(told(error), node)
                node["follow"] = None
                continue
            shared = {n: w for n, w in leader.point["parameters"].items() if n in cast.parameters}
            span = cast.baking.manifest["times"]
            time = min(max(leader.point["time"], span["start"]), span["stop"])
            point = {**cast.point, "time": time, "parameters": {**cast.point["parameters"], **shared}}
            self.company.casts[cast.name] = replace(cast, point=point)
            node["point"] = Bookmark(time, point["parameters"]).to_link()
            drawn = self.config.illustration_pictures
            self._still(node, pantry_of(self.app).still(self.wishes[cast.name], cast.baking, point, drawn=drawn))

    # -- what stands in a sentence -----------------------------------------------------------------------------------

    def _resolve(self, node: Any) -> None:
        try:
            if isinstance(node, Number):
                cast, name = self.company.owner(node["wish"], node["kind"])
                node["figure"], node["name"] = cast.name, name
                node += nodes.Text(cast.number(name, node["spec"]))
            elif isinstance(node, Word):
                cast, name = self.company.owner(node["wish"], "word")
                node["figure"], node["node"] = cast.name, name
            elif isinstance(node, Check):
                cast, name = self.company.owner(node["check"], "value")
                node["figure"], node["name"] = cast.name, name
            elif isinstance(node, Either):
                node["figure"] = self.company.nearest("{live}").name
            else:
                cast, point = self.company.point(node["wish"])
                node["figure"], node["point"] = cast.name, point
        except Reactive4dError as error:
            # Where a figure failed, what is said of it fails as well; once is enough.
            if not self.failed:
                self._warn(told(error), node)
            words = [nodes.Text(node.astext() or str(node.get("wish", "")))]
            node.parent.replace(node, [] if isinstance(node, Check) else words)


def data_of(baking: Baking) -> tuple[str, str]:
    """The name of the file that carries a figure's data, and the digest in it.

    Two figures that say the same have one file.
    """
    digest = digest_of(compact(baking.table), [])
    return f"{digest}.js", digest
