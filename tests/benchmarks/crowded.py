"""A server whose one figure counts for which points it is evaluated; each line of input is answered by the count.

python -m tests.benchmarks.crowded
"""

import sys
from typing import ClassVar

import numpy as np
import param

import reactive4d as r4
from reactive4d_apps.serving import serve


class Crowded(r4.Illustration):
    """A ball of 2,500 points that trembles as a rule says of which nothing is known."""

    length = param.Number(1.0, bounds=(0.2, 2.0))
    asked: ClassVar[list[tuple[float, float]]] = []

    def build(self) -> r4.Scene:
        @r4.lift
        def tremor(t: float, length: float) -> float:
            Crowded.asked.append((t, length))
            return 40.0 * float(np.sin(3.0 * t) * length)

        bob = r4.Sphere(0.5, segments=49, rings=49, color="steelblue")
        bob.apply(r4.Twist(tremor(r4.time, self.signals.length)))
        return r4.Scene(bob=bob)


def main() -> None:
    """Serve until the input ends."""
    with serve(Crowded, block=False, times=(0.0, 4.0)) as server:
        print(server.address, flush=True)
        for _ in sys.stdin:
            print(len(Crowded.asked), len(set(Crowded.asked)), flush=True)


if __name__ == "__main__":
    main()
