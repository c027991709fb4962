"""Desks: where a private copy is answered: a script comes, its scene is read, and a reader asks it."""

from typing import Any

import reactive4d as r4
from reactive4d.errors import Reactive4dError, ScriptError
from reactive4d.illustrations import Figure
from reactive4d_apps.serving.copyists import BYTES, ERROR, NOTHING, TEXT
from reactive4d_apps.serving.exhibits import Exhibit
from reactive4d_apps.serving.frames import packed
from reactive4d_apps.serving.lines import Answers
from reactive4d_widgets.live.heralds import herald

__all__ = ["Desk"]

MOST = 20  # problems that are told
LONGEST = 2_000  # letters of one


class Desk:
    r"""Answers one reader from the script that they sent last.

    Args:
        said: what the figure is: its `name`, `title`, `times`, `options` and opening `values` as they travel; the
            `folder` of its files; how many `letters` a script may have.

    >>> import json
    >>> desk = Desk({"name": "ball", "letters": 100})
    >>> json.loads(desk.answered({"id": 1, "type": "script", "text": "object (ball) spere;"})[1])["problems"]
    [{'line': 1, 'column': 15, 'text': "unknown kind 'spere'\nhint: did you mean 'sphere'?...
    >>> desk.answered({"id": 2, "type": "script", "text": "object (ball) sphere;"})[1].decode()
    '{"id":2,"type":"edited"}'
    >>> json.loads(desk.answered({"id": 3, "type": "open"})[1])["manifest"]["nodes"]
    [{'name': 'ball', 'kind': 'sphere'}]
    """

    def __init__(self, said: dict[str, Any]) -> None:
        self.said = said
        self._answers: Answers | None = None
        self._exhibit: Exhibit | None = None  # a model lives as long as somebody holds it

    def prepare(self) -> None:
        """Do once what takes long the first time: the grammar, and what a first answer imports."""
        herald.rest()  # nobody but the reader edits, and who edits opens again
        self.answered({"id": 0, "type": "script", "text": "object (ball) sphere segments = 3;"})
        self.answered({"id": 0, "type": "open"})
        ask: dict[str, Any] = {"seq": 1, "revision": 1, "parameters": {}, "times": [0.0]}
        self.answered({"id": 0, "type": "ask", "channels": ["ball#points", "ball#topology", "ball#matrix"], **ask})
        self._answers = self._exhibit = None

    def answered(self, order: dict[str, Any]) -> tuple[int, bytes]:
        """What an order is answered by: its kind, and what travels."""
        number = order.get("id")
        if order.get("type") == "script":
            problems = self._read(order.get("text"))
            found: dict[str, Any] = {"type": "problems", "problems": problems} if problems else {"type": "edited"}
            return TEXT, _bytes(packed({"id": number, **found}))
        if self._answers is None:
            return ERROR, _bytes(packed({"id": number, "type": "error", "text": "there is no script yet"}))
        reply, buffers = self._answers.receive(order)
        if reply is None:
            return NOTHING, b""
        self._scrub(reply)
        data = packed(reply, buffers)
        kind = ERROR if reply["type"] == "error" else TEXT if isinstance(data, str) else BYTES
        return kind, _bytes(data)

    # -- scripts ---------------------------------------------------------------------------------------------------

    def _read(self, text: Any) -> list[dict[str, Any]]:
        """Take a script; else say what is wrong with it, and keep the one before."""
        most: int = self.said["letters"]
        if not isinstance(text, str):
            return [_problem("expected a text")]
        if len(text) > most:
            return [_problem(f"expected at most {most:,} letters, got {len(text):,}".replace(",", " "))]
        try:
            scene = r4.loads(text, folder=self.said.get("folder"))
            exhibit = self._shown(scene)
            exhibit.model.refresh()
        except ScriptError as error:
            return [_problem(self._told(str(error.args[0]), error), error.line, error.column)]
        except Reactive4dError as error:
            return [_problem(self._told(str(error), error))]
        if self._answers is not None:
            self._answers.close()
        self._exhibit, self._answers = exhibit, exhibit.open(_nobody)
        return []

    def _shown(self, scene: r4.Scene) -> Exhibit:
        """The scene, as the figure of which it is a copy is shown, as far as that fits it."""
        said = self.said
        times = said.get("times")
        figure = Figure(scene, title=said.get("title"), times=tuple(times) if isinstance(times, list) else times)  # pyright: ignore
        try:
            return Exhibit(
                said["name"], figure, values=said.get("values"), options=said.get("options"), pictures="never"
            )
        except Reactive4dError:
            looks: dict[str, Any] = said.get("options") or {}
            options = {key: value for key, value in looks.items() if key != "playing"}
            return Exhibit(said["name"], figure, options=options, pictures="never")

    # -- what nobody has to know -----------------------------------------------------------------------------------

    def _scrub(self, reply: dict[str, Any]) -> None:
        """Errors name files as the script does, and not where they lie on this machine."""
        if "text" in reply:
            reply["text"] = self._scrubbed(str(reply["text"]))
        for segment in reply.get("segments", ()):
            if "error" in segment:
                segment["error"] = self._scrubbed(segment["error"])

    def _told(self, text: str, error: Exception) -> str:
        """An error with its hints; the line itself the reader sees."""
        hints = [note for note in getattr(error, "__notes__", ()) if note.startswith("hint: ")]
        return self._scrubbed("\n".join([text, *hints]))

    def _scrubbed(self, text: str) -> str:
        folder = self.said.get("folder")
        return text[:LONGEST] if not folder else text.replace(folder, "of the script")[:LONGEST]


def _problem(text: str, line: int | None = None, column: int | None = None) -> dict[str, Any]:
    return {"line": line, "column": column, "text": text[:LONGEST]}


def _bytes(data: str | bytes) -> bytes:
    return data.encode() if isinstance(data, str) else data


def _nobody(news: dict[str, Any]) -> None:
    """To whom edits in Python are told: there are none here."""
