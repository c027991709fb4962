"""Openings: a model is served from the command line until somebody presses ctrl-C."""

import webbrowser
from collections.abc import Callable, Iterator
from typing import Any

from reactive4d.devices import device
from reactive4d_apps.phrases import paragraph

__all__ = ["opened"]


def opened(
    thing: Any,
    *,
    port: int = 0,
    host: str = "127.0.0.1",
    browser: Callable[[str], bool] | None = webbrowser.open,
    width: int = 80,
) -> Iterator[str]:
    """Serve what can be shown, and tell where it is.

    Args:
        thing: a scene, an illustration or its class, or a page.
        port: 0 for any that is free.
        host: to which it is bound.
        browser: what opens an address; None to open none.
        width: of the terminal, in characters.

    Returns:
        The lines. The next one after the address comes when the server has ended.
    """
    with device("serve")(thing, port=port, host=host, block=False) as server:
        yield server.address
        if server.is_public:
            said = f"Bound to {host}: whoever reaches this machine and has the address can read and drive it."
        else:
            said = "Only this machine reaches it."
        yield from paragraph(f"{said} The address is good until the server ends: press ctrl-C.", width)
        if browser is not None:
            browser(server.address)
        server.wait()
    yield "Ended."
