"""An application of trame's own; it says at which port it is. Its state is shared by all clients, as trame's is."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from clients import Pendulum
from trame.app import get_server
from trame.ui.html import DivLayout
from trame.widgets import html

from reactive4d_apps.trame import FigureView

server = get_server("trame_app")
with DivLayout(server):
    html.Input(type="range", min=0.2, max=2, step=0.01, v_model_number=("length", 1.5))
    html.P("It is {{ length }} m long at {{ t }} s.")
    FigureView(Pendulum, parameters={"length": "length"}, time=("t", 0.5), style="max-width: 40rem")
    FigureView(Pendulum, title="Another one")
    with html.Div(v_if=("more", False)):
        FigureView(Pendulum)
    html.Button("More", click="more = !more")


@server.state.change("length")
def heard(length: float, **_: object) -> None:
    """What Python hears of it."""
    sys.stdout.write(f"length {length:g}\n")
    sys.stdout.flush()


@server.controller.add("on_server_ready")
def ready(**_: object) -> None:
    """It listens."""
    sys.stdout.write(f"port {server.port}\n")
    sys.stdout.flush()


if __name__ == "__main__":
    server.start(port=0, open_browser=False, show_connection_info=False, timeout=0)
