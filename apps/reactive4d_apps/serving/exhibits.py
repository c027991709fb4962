"""Exhibits: one figure as many readers see it: one model, and for each of them a reader of their own."""

from collections.abc import Callable, Mapping
from typing import Any

from reactive4d.illustrations import Figure, subject
from reactive4d_apps.serving.documents import Opening
from reactive4d_apps.serving.lines import Answers
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
    ) -> None:
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

    def open(self, tell: Tell) -> Answers:
        """A reader, who opens the figure."""
        return _Guest(self, tell)

    def opening(self, script: str | None = None) -> Opening:
        """What the page says of it before it lives; with the script that its reader may edit."""
        guest = _Guest(self, None)
        try:
            manifest: Any = guest.said({"type": "open"})["manifest"]
            channels = [*(f"#values.{one['name']}" for one in manifest["values"]), "#alt"]
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
        reply, buffers = self.reader.receive(message)
        if reply is not None and reply.get("type") == "manifest":
            reply["manifest"]["point"]["parameters"].update(self.exhibit.point)
        return reply, buffers

    def said(self, message: dict[str, Any]) -> dict[str, Any]:
        """The same for whoever is in this program."""
        reply, _ = self.receive(message)
        if reply is None or reply["type"] == "error":
            raise RuntimeError(f"no answer: {reply}")
        return reply

    def close(self) -> None:
        self.reader.close()


def _listed(wire: Any) -> Any:
    return [*wire] if isinstance(wire, tuple) else wire  # pyright: ignore[reportUnknownVariableType]
