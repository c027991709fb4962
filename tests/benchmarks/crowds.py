"""Crowds: many readers of a served figure, in a process of their own, who ask whenever they are let.

python -m tests.benchmarks.crowds ADDRESS READERS

It reads `go`, `rest`, `kill N` and `end` from its input, answers each with a line, and at the end says what it saw.
"""

import asyncio
import json
import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "serving"))

from clients import Client, client

PAUSE = 0.5  # seconds between two asks of one reader
TIMES, LENGTHS = 40, 10


class Crowd:
    """Readers, each at points of their own out of a grid of them."""

    def __init__(self, address: str) -> None:
        self.address = address
        self.going = asyncio.Event()
        self.killed: set[int] = set()
        self.sockets: dict[int, Client] = {}
        self.answers = 0
        self.lost = 0
        self.points: set[tuple[float, float]] = set()
        self.ended = False

    async def read(self, number: int) -> None:
        """Be one reader until the end, or until they are killed."""
        try:
            async with client(self.address, "crowded") as reader:
                self.sockets[number] = reader
                await reader.open()
                k = 0
                while not self.ended:
                    await self.going.wait()
                    k += 1
                    t = (7 * k + 3 * number) % TIMES / 10
                    length = 0.5 + (k + number) % LENGTHS / 10
                    answer = await reader.ask(t, "bob#points", "bob#matrix", length=length)
                    self.points.add((t, length))
                    self.answers += answer["type"] == "answer"
                    self.lost += answer["type"] != "answer"
                    await asyncio.sleep(PAUSE)
        except Exception:  # noqa: BLE001 - whoever was not killed has lost something
            if number not in self.killed:
                self.lost += 1

    def kill(self, count: int) -> None:
        """Cut some connections in the middle of whatever they do."""
        for number in range(count):
            self.killed.add(number)
            self.sockets[number].socket._response.connection.transport.abort()  # type: ignore[union-attr]

    def told(self) -> dict[str, Any]:
        """What was seen."""
        return {"answers": self.answers, "lost": self.lost, "points": len(self.points), "killed": len(self.killed)}


async def gathered(address: str, readers: int) -> None:
    """Do what the input says."""
    crowd = Crowd(address)
    tasks = [asyncio.create_task(crowd.read(number)) for number in range(readers)]
    while len(crowd.sockets) < readers:
        await asyncio.sleep(0.02)
    print("here", flush=True)
    while True:
        word, _, count = (await asyncio.to_thread(sys.stdin.readline)).strip().partition(" ")
        if word == "go":
            crowd.going.set()
        elif word == "rest":
            crowd.going.clear()
        elif word == "kill":
            crowd.kill(int(count))
        else:
            break
        print("done", flush=True)
    crowd.ended = True
    crowd.going.set()
    await asyncio.gather(*tasks)
    print(json.dumps(crowd.told()), flush=True)


if __name__ == "__main__":
    asyncio.run(gathered(sys.argv[1], int(sys.argv[2])))
