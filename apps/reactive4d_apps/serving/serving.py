"""Serving: a scene, an illustration or a page is put before many readers, each of whom drives it for themselves."""

import inspect
import sys
from collections.abc import Collection, Mapping
from functools import partial
from typing import Any

from reactive4d.errors import unknown
from reactive4d.illustrations import Figure, Illustration, Page
from reactive4d.illustrations import subject as subject_of
from reactive4d_apps.serving.ateliers import Atelier
from reactive4d_apps.serving.documents import document, files
from reactive4d_apps.serving.exhibits import Exhibit
from reactive4d_apps.serving.halls import Hall
from reactive4d_apps.serving.limits import Limits
from reactive4d_apps.serving.scripts import originals_of
from reactive4d_apps.serving.servers import Server
from reactive4d_widgets.figures import checked_options
from reactive4d_widgets.pages import refuse_wrong_words
from reactive4d_widgets.proofs import proofread

__all__ = ["serve"]

PICTURES = ("auto", "always", "never")


def serve(
    subject: Any,
    /,
    *,
    port: int = 0,
    host: str = "127.0.0.1",
    block: bool | None = None,
    times: Any = None,
    text: str | None = None,
    title: str | None = None,
    lang: str = "en",
    theme: str = "auto",
    editable: bool = False,
    options: Mapping[str, Any] | None = None,
    parameters: Mapping[str, Any] | None = None,
    origins: Collection[str] = (),
    limits: Limits | None = None,
    pictures: str = "auto",
    **values: Any,
) -> Server:
    """Serve a page whose figures ask the model, for any number of readers.

    Each has a point of their own: what one of them does, the others do not see. The model and what is remembered of it
    are one; an edit of it is seen by all.

    Args:
        subject: a scene, an illustration or its class, or a Page of several.
        port: on which it listens; 0 for any that is free.
        host: to which it is bound: by default this machine alone can reach it.
        block: whether to wait until ctrl-C; by default where nobody could type anything else meanwhile.
        times: None for the subject's own, (start, stop), or evenly spaced times, seconds.
        text: Markdown, as for `bake`; by default what the illustration's class says of itself.
        title: of the page; otherwise its first heading, or what the subject is called.
        lang: of the text, as in HTML.
        theme: "light", "dark", or "auto": as the reader's system is.
        editable: whether readers may edit the scenes as scripts, each in a private copy that nobody else sees.
        options: how figures are shown at first: theme, height, loop, autoplay, edges, shading, ground, axes, grid,
            shadows, playing.
        parameters: values by name, for parameters that are called like one of these arguments.
        origins: of further sites whose pages may speak to the server, such as that of a proxy.
        limits: how much one reader may take.
        pictures: whether the server draws for its readers: "auto" for those whose browser cannot, and for all where a
            scene is too large to be sent; "always", or "never".
        **values: of parameters, with which it opens.

    Returns:
        The server: its `address`, and `close()`.

    Raises:
        UnknownNameError: a parameter, an option, or something in the text that nobody knows.
        ShapeError: something else that is not what it should be, such as a formula in the text.
        ParameterError: a value that its parameter does not admit.
        NotWritableError: a scene is to be editable that no script can say.
        Reactive4dError: the port is taken, the scene is empty, the viewer was not built, or nothing can be edited.

    >>> import reactive4d as r4
    >>> with serve(r4.Scene(ball=r4.Sphere()), block=False) as server:
    ...     print(server.address)
    http://127.0.0.1:.../.../
    """
    given = {**values, **(parameters or {})}
    page = subject if isinstance(subject, Page) else None
    figures = {subject_of(subject).name: Figure(subject)} if page is None else dict(page.figures)
    known = {control.name for figure in figures.values() for control in subject_of(figure.thing).controls}
    for name in given:
        if name not in known:
            raise unknown(name, known, what="parameter")
    prose = text if text is not None else page.text if page is not None else _said_of(subject)
    refuse_wrong_words(prose, title, lang)
    checked_options({"theme": theme}, {})
    if pictures not in PICTURES:
        raise unknown(pictures, PICTURES, what="way to draw pictures")
    bounds = limits or Limits()
    atelier = Atelier(bounds.windows)
    more: dict[str, Any] = {"pictures": pictures, "atelier": atelier, "limits": bounds}
    exhibits = {
        name: Exhibit(name, figure, times=times, values=given, options=options, **more)
        for name, figure in figures.items()
    }
    plans = {name: exhibit.model.plan for name, exhibit in exhibits.items()}
    proofread(prose, plans, {name: figure.follow for name, figure in figures.items()})
    originals = originals_of(exhibits) if editable else {}
    openings = {
        name: partial(exhibit.opening, originals[name].script if name in originals else None)
        for name, exhibit in exhibits.items()
    }
    hall = Hall(
        lambda: document(openings, prose, title=title, lang=lang, theme=theme),
        files(),
        {name: exhibit.open for name, exhibit in exhibits.items()},
        originals=originals,
        host=host,
        origins=origins,
        limits=limits,
    )
    server = Server(hall, host=host, port=port)
    if (not _is_interactive()) if block is None else block:
        server.wait()
    return server


def _said_of(subject: Any) -> str:
    """What the class of an illustration says of itself; nothing of a scene."""
    cls = subject if isinstance(subject, type) else type(subject)
    if not issubclass(cls, Illustration) or cls is Illustration:
        return ""
    return inspect.cleandoc(cls.__doc__ or "")


def _is_interactive() -> bool:
    """Whether somebody types, line by line: then they want to go on."""
    return hasattr(sys, "ps1") or bool(sys.flags.interactive)
