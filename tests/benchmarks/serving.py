"""Fifty readers of one served model for a minute: what they cost, and that nothing is lost when ten are killed.

python -m tests.benchmarks.serving [seconds]
"""

import asyncio
import statistics
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "serving"))

from clients import client

READERS, KILLED = 50, 10
MODEL = f"{Path(__file__).parents[1] / 'serving' / 'clients.py'}:Pendulum"


def resident(process: int) -> float:
    """MB of memory that a process has."""
    status = Path(f"/proc/{process}/status").read_text()
    return int(status.partition("VmRSS:")[2].split()[0]) / 1024


async def read(address: str, number: int, until: float, pause: float) -> tuple[int, list[float]]:
    """Ask at points of one's own until then; how often there was no answer, and the seconds of each."""
    lost, taken = 0, list[float]()
    async with client(address) as reader:
        await reader.open()
        k = 0
        while time.monotonic() < until:
            k += 1
            begun = time.monotonic()
            answer = await reader.ask((number + k * 0.1) % 10.0, "bob#matrix", "bob#points", length=0.5 + k % 10 / 10)
            taken.append(time.monotonic() - begun)
            lost += answer["type"] != "answer"
            if number < KILLED and time.monotonic() > until - 5.0:
                reader.socket._response.connection.transport.abort()  # type: ignore[union-attr]
                break
            await asyncio.sleep(pause)
    return lost, taken


async def measured(address: str, process: int, seconds: float) -> None:
    """Print what it costs, alone and with all."""
    _, alone = await read(address, KILLED, time.monotonic() + 5.0, 0.02)
    before = resident(process)
    until = time.monotonic() + seconds
    crowd = [read(address, number, until, 0.5) for number in range(READERS)]
    watched = read(address, READERS, until, 0.02)
    found = await asyncio.gather(watched, *crowd)
    each = (resident(process) - before) / READERS
    among = found[0][1]
    print(f"answers {sum(len(taken) for _, taken in found)}, lost {sum(lost for lost, _ in found)}")
    print(f"memory for each reader {each:.2f} MB (at most 1)")
    print(f"alone {statistics.median(alone) * 1e3:.1f} ms, among {READERS} {statistics.median(among) * 1e3:.1f}")


def main() -> None:
    """Serve in a process of its own, and measure from outside."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 60.0
    command = [sys.executable, "-m", "reactive4d", "serve", MODEL, "--no-open"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, encoding="utf-8") as run:
        assert run.stdout is not None
        try:
            asyncio.run(measured(run.stdout.readline().strip(), run.pid, seconds))
        finally:
            run.terminate()


if __name__ == "__main__":
    main()
