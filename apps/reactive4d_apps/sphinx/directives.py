"""Directives: `illustration`, `exercise` and `solution`, as authors write them."""

from pathlib import Path
from typing import Any, ClassVar

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.util.docutils import SphinxDirective

from reactive4d_apps.sphinx.elements import Check, Fold, Illustration

__all__ = ["ExerciseDirective", "IllustrationDirective", "SolutionDirective"]

CODE = ("none", "above", "below", "beside", "fold")
SIZES = ("text", "wide", "full")


def _code(argument: str) -> str:
    return directives.choice(argument, CODE)


def _size(argument: str) -> str:
    return directives.choice(argument, SIZES)


def first_line(directive: SphinxDirective) -> int:
    """The line of the page in which the content of a directive begins.

    MyST counts from the directive, reStructuredText from the page.
    """
    offset = directive.content_offset
    is_markdown = type(directive.state).__module__.startswith("myst_parser")
    return (directive.lineno if is_markdown else 0) + offset + 1


class IllustrationDirective(SphinxDirective):
    """A figure that a reader drives. What it shows and where it opens is found out when the page was read."""

    optional_arguments = 1
    final_argument_whitespace = True
    has_content = True
    option_spec: ClassVar[Any] = {
        "name": directives.unchanged_required,
        "caption": directives.unchanged_required,
        "times": directives.unchanged_required,
        "parameters": directives.unchanged_required,
        "point": directives.unchanged_required,
        "options": directives.unchanged_required,
        "height": directives.positive_int,
        "size": _size,
        "follow": directives.unchanged_required,
        "alt": directives.unchanged_required,
        "code": _code,
        "editable": directives.flag,
        "after": directives.unchanged_required,
        "depends": directives.unchanged_required,
        "class": directives.class_option,
    }

    def run(self) -> list[nodes.Node]:
        """The figure, still without what it shows."""
        given = self.options
        figure = nodes.figure("")
        self.set_source_info(figure)
        live = Illustration("", **{key: given.get(key) for key in self.option_spec if key not in ("class", "caption")})
        self.set_source_info(live)
        place = self.arguments[0].strip() if self.arguments else ""
        live["editable"] = "editable" in given
        live["place"] = self._path(place) if place.endswith(".scefo") else place
        live["besides"] = [self._path(word) for word in (given.get("depends") or "").split()]
        live["code_at"] = given.get("code") or ("none" if place else "above")
        live["program"] = "" if place else "\n".join(self.content)
        live["program_line"] = first_line(self)
        live["page"] = str(self.env.doc2path(self.env.docname))
        figure += live
        figure["classes"] += ["r4d", f"r4d-{given.get('size', 'wide')}", *given.get("class", [])]
        caption = self._caption(place)
        if caption:
            figure += nodes.caption("", "", *caption)
        return [figure]

    def _path(self, word: str) -> str:
        relative, absolute = self.env.relfn2path(word)
        self.env.note_dependency(relative)
        return str(Path(absolute))

    def _caption(self, place: str) -> list[nodes.Node]:
        text = self.options.get("caption")
        line = self.lineno
        if text is None and place:
            text, line = "\n".join(self.content), first_line(self)
        if not text or not text.strip():
            return []
        found, messages = self.state.inline_text(text, line)
        return [*found, *messages]


class ExerciseDirective(SphinxDirective):
    """Something to try, in a box of its own; with `check` it says whether it is done."""

    optional_arguments = 1
    final_argument_whitespace = True
    has_content = True
    option_spec: ClassVar[Any] = {"check": directives.unchanged_required, "name": directives.unchanged_required}

    def run(self) -> list[nodes.Node]:
        """The box."""
        self.assert_has_content()
        box = nodes.admonition("", classes=["exercise"])
        self.set_source_info(box)
        self.add_name(box)
        count = self.env.new_serialno("r4d-exercise") + 1
        title = nodes.title("", f"Exercise {count}")
        if self.arguments:
            words, messages = self.state.inline_text(self.arguments[0], self.lineno)
            title += [nodes.Text(". "), *words, *messages]
        box += title
        self.state.nested_parse(self.content, self.content_offset, box)
        if "check" in self.options:
            check = Check("", "", check=self.options["check"])
            self.set_source_info(check)
            box += check
        return [box]


class SolutionDirective(SphinxDirective):
    """What is folded until a reader wants it."""

    optional_arguments = 1
    final_argument_whitespace = True
    has_content = True

    def run(self) -> list[nodes.Node]:
        """The fold."""
        self.assert_has_content()
        fold = Fold("", title=self.arguments[0] if self.arguments else "Solution", kind="solution")
        self.set_source_info(fold)
        self.state.nested_parse(self.content, self.content_offset, fold)
        return [fold]
