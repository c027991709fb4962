"""Lines: the connection to one reader of one figure.

What a reader sends is read as fast as they may send, and no faster; what they ask is worked out in threads; what they
do not take in time is not kept for them. Nothing of it waits for another reader.
"""

import asyncio
import contextlib
import logging
import time
from collections.abc import Callable
from typing import Any, Protocol

from aiohttp import WSCloseCode, WSMsgType, web

from reactive4d_apps.serving.buckets import Bucket
from reactive4d_apps.serving.frames import FrameError, packed, unpacked
from reactive4d_apps.serving.limits import Limits
from reactive4d_apps.serving.workers import SlowError, Turns

__all__ = ["ASKED", "EDITED", "ENDED", "Answers", "GoneError", "Line"]

LOG = logging.getLogger("reactive4d.serving")
EDITED = frozenset({"open", "ask", "need", "script"})
ASKED = frozenset({"open", "ask", "need", "picture"})
ENDED = 4001  # the code with which a connection ends whose private copy is no more
SILENT = frozenset({"dropped"})
MOST_SPANS = 10_000  # of news that wait; beyond, the reader opens again
LOOK = 0.25  # seconds between two looks at whoever answers
PIECE = 16_384  # bytes; a message counts as one, and one more for each of these


class GoneError(Exception):
    """Whoever answered does so no more; the text says why, for their reader."""


class Answers(Protocol):
    """Who answers one reader, as `reactive4d_widgets.live.Reader` does."""

    def receive(self, message: Any, /) -> tuple[dict[str, Any] | None, list[bytes]]:
        """The reply to a message, with the bytes that travel beside it; never an exception for what was sent.

        Raises:
            GoneError: there will be no answer any more.
        """
        ...

    def close(self) -> None:
        """Nobody reads any more."""
        ...


class Line:
    """One connection.

    Args:
        socket: that is open.
        answers: who answers, made of what is to be called with news, from whatever thread.
        turns: where is worked.
        limits: what is bounded.
        name: how the log calls it.
        abort: cuts the connection, whatever is still to be sent.
        hold: called with whether nothing is to be read from the connection for now.
        asked: the kinds of messages that are answered.
        over: why the connection should end, given for how many seconds nothing was heard; None: never.

    Attributes:
        heard: how many messages were read.
    """

    def __init__(
        self,
        socket: web.WebSocketResponse,
        answers: Callable[[Callable[[dict[str, Any]], None]], Answers],
        turns: Turns,
        limits: Limits,
        name: str,
        abort: Callable[[], None],
        *,
        hold: Callable[[bool], None],
        asked: frozenset[str] = ASKED,
        over: Callable[[float], str | None] | None = None,
    ) -> None:
        self.socket = socket
        self._abort = abort
        self._hold = hold
        self.turns = turns
        self.limits = limits
        self.name = name
        self.asked = asked
        self._over = over
        self._heard_at = time.monotonic()
        self._loop = asyncio.get_running_loop()
        self._bucket = Bucket(limits.rate, limits.burst)
        self._lines_of_log = Bucket(0.2, 30.0)
        self._sending = asyncio.Lock()
        self._working: set[asyncio.Task[None]] = set()
        self.heard = 0
        self._faults = 0
        self._asked = 0
        self._wished = 0
        self._room = asyncio.Semaphore(2 * (limits.asks + 1))  # of answers that are computed or sent
        self._news: dict[str, Any] | None = None
        self._has_news = asyncio.Event()
        self._answers = answers(self._tell)

    async def run(self) -> None:
        """Serve the reader until they go, or have to."""
        herald = asyncio.create_task(self._herald())
        watch = asyncio.create_task(self._watch())
        try:
            async for message in self.socket:
                if not await self._hear(message.type, message.data):
                    break
        finally:
            for task in (herald, watch, *self._working):
                task.cancel()
            self._answers.close()

    # -- what comes ------------------------------------------------------------------------------------------------

    async def _hear(self, kind: WSMsgType, data: Any) -> bool:
        """Take one message; False when it was one too many."""
        await self._take_turn(1 + len(data or "") // PIECE)
        self.heard += 1
        if kind in (WSMsgType.PING, WSMsgType.PONG):
            return kind is WSMsgType.PONG or await self._echo(data)
        self._heard_at = time.monotonic()
        try:
            if kind is not WSMsgType.TEXT:
                raise FrameError("expected a text")
            message = unpacked(data)
            word = message.get("type")
        except FrameError as error:
            return await self._refuse(None, str(error))
        if isinstance(word, str) and word in SILENT:
            await self._quietly(message)
            return True
        if not (isinstance(word, str) and word in self.asked):
            told = f"an unknown message, {word[:40]!r}" if isinstance(word, str) else "a message without a type"
            return await self._refuse(_number(message), told)
        # A picture is wished for beside what is asked, and one at a time.
        under_way, most = (self._wished, 1) if word == "picture" else (self._asked, self.limits.asks)
        if under_way >= most:
            what = "asks" if word != "picture" else "picture"
            return await self._refuse(_number(message), f"more than {most} {what} at one time")
        # Who asks again as soon as the answer begins to arrive does nothing wrong; but who takes none has to wait.
        await self._room.acquire()
        self._count(word, 1)
        task = asyncio.create_task(self._reply(message))
        self._working.add(task)
        task.add_done_callback(self._working.discard)
        return True

    async def _take_turn(self, cost: float) -> None:
        """Wait until they may send that much. Meanwhile nothing is read: what has no length would fill no queue."""
        wait = self._bucket.take(cost)
        if wait:
            self._hold(True)
            try:
                await asyncio.sleep(wait)
            finally:
                self._hold(False)

    async def _echo(self, data: bytes) -> bool:
        """A sign of life, which was asked for; False if they do not take it."""
        try:
            async with asyncio.timeout(self.limits.sending):
                await self.socket.pong(data)
        except (TimeoutError, ConnectionError, RuntimeError):
            self._abort()
            return False
        return True

    def _count(self, word: Any, step: int) -> None:
        """One more is under way, or one less."""
        if word == "picture":
            self._wished += step
        else:
            self._asked += step

    async def _refuse(self, number: int | None, reason: str) -> bool:
        """Say what was wrong, to the reader and to the log; False if it was wrong too often."""
        self._faults += 1
        self._warn(f"refused {reason}")
        await self._send({"id": number, "type": "error", "text": f"refused: {reason}"})
        if self._faults < self.limits.faults:
            return True
        LOG.warning("%s: ended after %d faults", self.name, self._faults)
        await self.end(WSCloseCode.POLICY_VIOLATION, b"too many faults")
        return False

    def _warn(self, text: str) -> None:
        """Note it down; who lies without end fills no log."""
        if self._lines_of_log.has(1.0):
            LOG.warning("%s: %s", self.name, text.replace("\n", " "))

    async def _quietly(self, message: dict[str, Any]) -> None:
        try:
            await self.turns.run(lambda: self._answers.receive(message), self.limits.thinking)
        except SlowError:
            self._warn("has to wait")
        except GoneError as error:
            await self.go(str(error))
        except Exception:  # a mistake of ours must not end what others have
            LOG.exception("%s: not noted", self.name)

    async def _reply(self, message: dict[str, Any]) -> None:
        number = _number(message)
        try:
            reply, buffers = await self.turns.run(lambda: self._answers.receive(message), self.limits.thinking)
        except SlowError as error:
            self._warn(str(error))
            reply, buffers = {"id": number, "type": "error", "text": str(error)}, []
        except GoneError as error:
            await self.go(str(error))
            return
        except Exception:  # a mistake of ours must not end what others have
            LOG.exception("%s: no answer", self.name)
            reply, buffers = {"id": number, "type": "error", "text": "this went wrong on the server; see its log"}, []
        if reply is not None and reply.get("type") == "error":
            self._warn(str(reply.get("text"))[:200])
        self._count(message.get("type"), -1)
        if reply is not None:
            await self._send(reply, buffers)
        self._room.release()

    # -- what goes -------------------------------------------------------------------------------------------------

    async def _send(self, message: dict[str, Any] | None, buffers: list[bytes] | None = None) -> None:
        """Send what is new, and this message, to this reader, who has a while to take it; who does not is gone."""
        data = () if message is None else (packed(message, buffers),)
        try:
            async with asyncio.timeout(self.limits.sending), self._sending:
                # Who hears of a revision gets answers of it afterwards.
                news, self._news = self._news, None
                for part in data if news is None else (packed(news), *data):
                    if not self.socket.closed:
                        await (self.socket.send_str(part) if isinstance(part, str) else self.socket.send_bytes(part))
        except TimeoutError:
            LOG.warning("%s: ended, takes nothing for %g s", self.name, self.limits.sending)
            self._abort()
        except (ConnectionError, RuntimeError):
            self._abort()  # gone meanwhile

    def _tell(self, news: dict[str, Any]) -> None:
        """Take note of news; any thread, the model's own included."""
        with contextlib.suppress(RuntimeError):  # the server has ended
            self._loop.call_soon_threadsafe(self._take, news)

    def _take(self, news: dict[str, Any]) -> None:
        """What was not sent yet and what is new become one message, so that nothing piles up."""
        known = self._news
        if known is not None and known.get("type") == news.get("type") == "stale":
            spans = {tuple(span): None for span in (*known["spans"], *news["spans"])}
            news = {**news, "spans": list(spans)} if len(spans) <= MOST_SPANS else {"type": "reopen"}
        elif known is not None and known.get("type") == "reopen":
            news = known
        self._news = news
        self._has_news.set()

    async def _herald(self) -> None:
        """Send news where no reply takes them along; what comes while something is being sent is told together."""
        while True:
            await self._has_news.wait()
            self._has_news.clear()
            await self._send(None)

    async def _watch(self) -> None:
        """End what nobody uses, and what has ended by itself."""
        while self._over is not None:
            await asyncio.sleep(LOOK)
            silent = 0.0 if self._working else time.monotonic() - self._heard_at
            if (reason := self._over(silent)) is not None:
                await self.go(reason)
                return

    # -- the end ---------------------------------------------------------------------------------------------------

    async def go(self, reason: str) -> None:
        """End, since whoever answered is no more; the reader is told why."""
        LOG.warning("%s: ended, %s", self.name, reason)
        await self.end(ENDED, reason.encode()[:120])

    async def end(self, code: int, reason: bytes) -> None:
        """Say good-bye, but do not wait for an answer."""
        try:
            async with asyncio.timeout(1.0):
                await self.socket.close(code=code, message=reason)
        except TimeoutError:
            self._abort()


def _number(message: Any) -> int | None:
    found: Any = message.get("id") if isinstance(message, dict) else None  # pyright: ignore
    return found if isinstance(found, int) and not isinstance(found, bool) and abs(found) < 2**53 else None
