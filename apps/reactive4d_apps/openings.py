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
    stay: bool = True,
    width: int = 80,
    **options: Any,
) -> Iterator[str]:
    """Serve what can be shown, and tell where it is.

    Args:
        thing: a scene, an illustration or its class, or a page.
        port: 0 for any that is free.
        host: to which it is bound.
        browser: what opens an address, and says whether it could; None to open none.
        stay: whether to wait for readers even if no browser opened the page.
        width: of the terminal, in characters.
        **options: what else `serve` takes.

    Returns:
        The lines. The next one after the address and what it is good for comes when the server has ended.
    """
    with device("serve")(thing, port=port, host=host, block=False, **options) as server:
        yield server.address
        if server.is_public:
            said = f"Bound to {host}: whoever reaches this machine and has the address can read and drive it."
        else:
            said = "Only this machine reaches it."
        is_open = browser is not None and browser(server.address)
        if is_open or stay:
            if browser is not None and not is_open:
                said = f"There is no browser here to open it in. {said}"
            yield from paragraph(f"{said} The address is good until the server ends: press ctrl-C.", width)
            server.wait()
        else:
            told = "nobody sits here who could end the server: so it ends now. With --no-open it goes on."
            yield from paragraph(f"There is no browser here to open it in, and {told}", width)
    yield "Ended."
