"""Readers without a browser: aiohttp's web sockets, which say what they are told to."""

import asyncio
import contextlib
import json
import struct
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from typing import Any
from urllib.parse import urlsplit

import aiohttp
import numpy as np
import param

import reactive4d as r4

PATIENCE = 120.0  # seconds; what takes longer has got stuck


class Pendulum(r4.Illustration):
    """A pendulum of adjustable length. It is {length} long, and [may be longer](#length=2)."""

    length = param.Number(1.0, bounds=(0.2, 2.0), doc="length of the rod [m]")
    count = param.Integer(3, bounds=(1, 8))
    kind = param.Selector(default="plain", objects=["plain", "fancy"])

    def build(self) -> r4.Scene:
        p = self.signals
        bob = r4.Sphere(radius=0.1, color="crimson", segments=8)
        bob.translate(r4.vec(0, 0, -p.length))
        bob.rotate(20.0 * np.cos(np.sqrt(9.81 / p.length) * r4.time), axis="y")
        return r4.Scene(bob=bob)


def run(work: Callable[[], Awaitable[Any]]) -> Any:
    """Do something with clients, in a loop of its own."""

    async def bounded() -> Any:
        async with asyncio.timeout(PATIENCE):
            return await work()

    return asyncio.run(bounded())


def unpacked(message: aiohttp.WSMessage) -> dict[str, Any]:
    """What the server sent, with the bytes in the place of their numbers."""
    if message.type is aiohttp.WSMsgType.TEXT:
        return json.loads(message.data)
    assert message.type is aiohttp.WSMsgType.BINARY, message
    (length,) = struct.unpack_from("<I", message.data)
    found = json.loads(message.data[4 : 4 + length])
    at = 4 + length
    parts: list[bytes] = []
    for size in found.pop("buffers"):
        parts.append(message.data[at : at + size])
        at += size
    assert at == len(message.data)
    for chunk in found.get("blobs", ()):
        if isinstance(chunk["data"], dict):
            chunk["data"] = parts[chunk["data"]["buffer"]]
    return found


class Client:
    """A reader of one figure."""

    def __init__(self, socket: aiohttp.ClientWebSocketResponse) -> None:
        self.socket = socket
        self.news: list[dict[str, Any]] = []
        self.manifest: dict[str, Any] = {}
        self.revision = 0
        self._number = 0

    async def send(self, message: Any) -> None:
        await self.socket.send_str(message if isinstance(message, str) else json.dumps(message))

    async def hear(self) -> dict[str, Any]:
        return unpacked(await self.socket.receive())

    async def reply(self, number: int | None) -> dict[str, Any]:
        """The reply with that number; news are kept."""
        while True:
            found = await self.hear()
            if "id" in found and found["id"] == number:
                return found
            self.news.append(found)

    async def call(self, **message: Any) -> dict[str, Any]:
        self._number += 1
        await self.send({"id": self._number, **message})
        return await self.reply(self._number)

    async def open(self) -> dict[str, Any]:
        self.manifest = (await self.call(type="open"))["manifest"]
        self.revision = self.manifest["revision"]
        return self.manifest

    async def ask(self, t: float = 0.0, *channels: str, **parameters: Any) -> dict[str, Any]:
        point = {**self.manifest["point"]["parameters"], **parameters}
        asked = list(channels) or ["bob#matrix"]
        self._seq = getattr(self, "_seq", 0) + 1
        return await self.call(
            type="ask", seq=self._seq, revision=self.revision, parameters=point, times=[t], channels=asked
        )

    async def is_ended(self) -> int | None:
        """Wait until the server ends the connection; with which code."""
        while True:
            message = await self.socket.receive()
            if message.type in (aiohttp.WSMsgType.CLOSE, aiohttp.WSMsgType.CLOSED, aiohttp.WSMsgType.ERROR):
                return self.socket.close_code


def origin_of(address: str) -> str:
    """The origin of a page there."""
    parts = urlsplit(address)
    return f"{parts.scheme}://{parts.netloc}"


@asynccontextmanager
async def client(address: str, figure: str = "pendulum", **options: Any) -> AsyncIterator[Client]:
    """Connect to a figure; `origin` None is nobody's."""
    given = options.pop("origin", origin_of(address))
    headers = {**({} if given is None else {"Origin": given}), **options.pop("headers", {})}
    async with (
        aiohttp.ClientSession() as session,
        session.ws_connect(f"{address}live/{figure}", headers=headers, max_msg_size=0, **options) as socket,
    ):
        yield Client(socket)


async def refused(address: str, figure: str = "pendulum", **options: Any) -> int:
    """With which status a connection is refused; 101 if it is not."""
    try:
        async with client(address, figure, **options):
            return 101
    except aiohttp.WSServerHandshakeError as error:
        return error.status


async def got(address: str, **headers: str) -> tuple[int, str]:
    """The answer to a GET, by its status and text."""
    async with aiohttp.ClientSession() as session, session.get(address, headers=headers) as response:
        return response.status, await response.text()


async def got_raw(address: str, path: str, *, host: str | None = None, upgrade: bool = False) -> int:
    """The status of a GET of a path that no library has made tidy; a socket is asked for with all that it needs."""
    place = urlsplit(address).netloc
    lines = [f"GET {path} HTTP/1.1", f"Host: {place if host is None else host}", f"Origin: http://{place}"]
    if upgrade:
        key = "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA=="
        lines += ["Connection: Upgrade", "Upgrade: websocket", "Sec-WebSocket-Version: 13", key]
    name, port = place.rsplit(":", 1)
    reader, writer = await asyncio.open_connection(name, int(port))
    writer.write("\r\n".join([*lines, "", ""]).encode())
    status = int((await reader.readline()).split()[1])
    writer.close()
    with contextlib.suppress(ConnectionError):  # who refuses may be the first to hang up
        await writer.wait_closed()
    return status


def matrix_of(answer: dict[str, Any], t: float, parameters: dict[str, Any]) -> np.ndarray:
    """The matrix that an answer gives of the bob."""
    from reactive4d_widgets.playbacks import Playback

    return np.asarray(
        Playback({"manifest": {}, "segments": answer["segments"], "chunks": []}).at("bob#matrix", t, parameters)
    )
