"""Exhibits: one figure as many readers see it: one model, and for each of them a reader of their own."""

import threading
from collections.abc import Callable, Mapping
from typing import Any

from reactive4d.errors import Reactive4dError
from reactive4d.illustrations import Figure, subject
from reactive4d_apps.serving.ateliers import Atelier
from reactive4d_apps.serving.buckets import Bucket
from reactive4d_apps.serving.documents import Opening
from reactive4d_apps.serving.limits import Limits
from reactive4d_apps.serving.lines import Answers
from reactive4d_apps.serving.pictures import WishError, bare, painted, triangles, wish
from reactive4d_widgets.displays import can_draw
from reactive4d_widgets.figures import checked_options
from reactive4d_widgets.live import Model, Reader

__all__ = ["Exhibit"]

Tell = Callable[[dict[str, Any]], None]


class Exhibit:
    """A figure that can be opened by any number of readers.

    Args:
        name: how it is called on its page.
        figure: what it shows, and how.
        times: for figures that say none of their own.
        values: of parameters where it opens, as the parameters understand them.
        options: how it is shown at first.
        pictures: whether pictures are drawn for readers: "auto" for those who cannot draw, and for all where the scene
            is too large to be sent; "always", or "never".
        atelier: where they are drawn.
        limits: what is bounded.

    Raises:
        UnknownNameError: an option that nobody knows.
        ParameterError: a value that its parameter does not admit.

    >>> import reactive4d as r4
    >>> exhibit = Exhibit("ball", r4.Figure(r4.Scene(ball=r4.Sphere())))
    >>> reader = exhibit.open(print)
    >>> reply, buffers = reader.receive({"id": 1, "type": "open"})
    >>> reply["manifest"]["name"], exhibit.model.revision
    ('ball', 1)
    """

    def __init__(
        self,
        name: str,
        figure: Figure,
        *,
        times: Any = None,
        values: Mapping[str, Any] | None = None,
        options: Mapping[str, Any] | None = None,
        pictures: str = "auto",
        atelier: Atelier | None = None,
        limits: Limits | None = None,
    ) -> None:
        self.limits = limits or Limits()
        self.atelier = atelier or Atelier(self.limits.windows)
        self._pictures = {"auto": None, "always": "always", "never": "never"}[pictures]
        self._guard = threading.Lock()
        own = dict(figure.options)
        looks: dict[str, Any] = {**(options or {}), **(own.pop("options", None) or {})}
        self.name = name
        self.figure = figure
        self.times = times if figure.times is None else figure.times
        self.model = Model.of(figure.thing, times=self.times)
        controls = {control.name: control for control in subject(figure.thing).controls}
        self.options = checked_options(looks, controls)
        given = {**{key: value for key, value in (values or {}).items() if key in controls}, **own}
        self.point = {key: _listed(controls[key].encode(value)) for key, value in given.items()}
        for key, wire in self.point.items():
            controls[key].decode(wire)

    @property
    def pictures(self) -> str:
        """What pictures are drawn for: "instead" for readers who cannot draw, "always" for all, "never" for none."""
        with self._guard:
            if self._pictures != "never" and not can_draw():
                self._pictures = "never"
            if self._pictures is None:
                about = subject(self.figure.thing)
                try:
                    count = triangles(about.scene.at(about.point.time, **about.values))
                except Reactive4dError:
                    count = 0  # what is wrong is told where it is asked for
                self._pictures = "always" if count > self.limits.triangles else "instead"
            return self._pictures

    def open(self, tell: Tell) -> Answers:
        """A reader, who opens the figure."""
        return _Guest(self, tell)

    def opening(self, script: str | None = None) -> Opening:
        """What the page says of it before it lives; with the script that its reader may edit."""
        guest = _Guest(self, None)
        try:
            manifest: Any = guest.said({"type": "open"})["manifest"]
            channels = [f"#values.{one['name']}" for one in manifest["values"]]
            point = manifest["point"]
            ask = {"seq": 1, "revision": manifest["revision"], "times": [point["time"]], "channels": channels}
            answer = guest.said({"type": "ask", "parameters": point["parameters"], **ask})
        finally:
            guest.close()
        return Opening(self.name, self.figure, self.model.plan, manifest, answer["segments"], script)


class _Guest:
    """A reader of an exhibit, who begins where the exhibit says."""

    def __init__(self, exhibit: Exhibit, tell: Tell | None) -> None:
        self.exhibit = exhibit
        self._bucket = Bucket(exhibit.limits.pictures, exhibit.limits.pictures)
        self._holds: tuple[Any, float, float] | None = None  # the box of all, and between which distances one sees
        self.reader = Reader(
            exhibit.figure.thing,
            send=tell,
            model=exhibit.model,
            times=exhibit.times,
            name=exhibit.name,
            title=exhibit.figure.title,
            options=exhibit.options,
        )

    def receive(self, message: Any, /) -> tuple[dict[str, Any] | None, list[bytes]]:
        if isinstance(message, dict) and message.get("type") == "picture":  # pyright: ignore[reportUnknownMemberType]
            return self._drawn(message)  # pyright: ignore[reportUnknownArgumentType]
        reply, buffers = self.reader.receive(message)
        if reply is None:
            return reply, buffers
        if reply.get("type") == "manifest":
            manifest = reply["manifest"]
            manifest["point"]["parameters"].update(self.exhibit.point)
            manifest["pictures"] = self.exhibit.pictures
            self._holds = manifest["bounds"], float(manifest["view"]["near"]), float(manifest["view"]["far"])
        return (bare(reply) if self.exhibit.pictures == "always" else reply), buffers

    def _drawn(self, message: dict[str, Any]) -> tuple[dict[str, Any], list[bytes]]:
        """A picture, for who wishes one."""
        exhibit, number = self.exhibit, message.get("id")
        try:
            if self._holds is None or exhibit.pictures == "never":
                raise WishError("no pictures are drawn here" if self._holds else "open the figure first")
            if not self._bucket.has(1.0):
                raise WishError(f"more than {exhibit.limits.pictures:g} pictures in a second")
            bounds, near, far = self._holds
            wished = wish(message, exhibit.limits, near=near, far=far)
            data = painted(wished, subject(exhibit.figure.thing), bounds, exhibit.atelier, self)
        except (WishError, Reactive4dError) as error:
            return {"id": number, "type": "error", "text": str(error)}, []
        return {"id": number, "type": "picture", "picture": {"buffer": 0}, "size": list(wished.size)}, [data]

    def said(self, message: dict[str, Any]) -> dict[str, Any]:
        """The same for whoever is in this program."""
        reply, _ = self.receive(message)
        if reply is None or reply["type"] == "error":
            raise RuntimeError(f"no answer: {reply}")
        return reply

    def close(self) -> None:
        self.exhibit.atelier.leave(self)
        self.reader.close()


def _listed(wire: Any) -> Any:
    return [*wire] if isinstance(wire, tuple) else wire  # pyright: ignore[reportUnknownVariableType]
