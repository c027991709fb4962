"""Many readers of one model: each at a point of their own, and all told of edits."""

import asyncio
from typing import ClassVar

import numpy as np
from clients import Client, Pendulum, client, matrix_of, run

import reactive4d as r4

TURNED = ["bob#matrix"]


class Fresh(Pendulum):
    """A model of its own, so that edits are seen by nobody else."""


def test_a_figure_is_answered_as_the_model_says(served):
    """The matrix that travels is the one that the scene answers there."""

    async def work():
        async with client(served(Pendulum).address) as reader:
            manifest = await reader.open()
            point = {**manifest["point"]["parameters"], "length": 0.5}
            answer = await reader.ask(1.25, length=0.5)
            return matrix_of(answer, 1.25, point)

    expected = Pendulum(length=0.5).at(1.25)["bob"].matrix
    np.testing.assert_allclose(run(work).reshape(4, 4), expected, atol=1e-6)


def test_two_readers_do_not_see_each_other(served):
    """What one asks is not told to the other one, whose answers are those for their own values."""
    address = served(Pendulum).address

    async def work():
        async with client(address) as one, client(address) as other:
            for reader in (one, other):
                await reader.open()
            for _ in range(5):
                first = await one.ask(1.0, "bob#matrix", length=0.5)
                second = await other.ask(2.0, "bob#matrix", length=2.0)
            point = one.manifest["point"]["parameters"]
            assert one.news == other.news == []
            assert (await one.open())["point"] == (await other.open())["point"]  # where a figure opens is nobody's
            return (
                matrix_of(first, 1.0, {**point, "length": 0.5}),
                matrix_of(second, 2.0, {**point, "length": 2.0}),
            )

    first, second = run(work)
    np.testing.assert_allclose(first.reshape(4, 4), Pendulum(length=0.5).at(1.0)["bob"].matrix, atol=1e-6)
    np.testing.assert_allclose(second.reshape(4, 4), Pendulum(length=2.0).at(2.0)["bob"].matrix, atol=1e-6)


def test_an_edit_of_the_model_is_told_to_all_and_only_what_it_touched(served):
    """Who looks hears which channels are stale; the next answer is of the new revision."""
    address = served(Fresh).address
    scene = Fresh().scene

    async def news(reader: Client):
        while not reader.news:
            reader.news.append(await reader.hear())
        return reader.news.pop(0)

    async def work():
        async with client(address, "fresh") as one, client(address, "fresh") as other:
            for reader in (one, other):
                await reader.open()
                before = await reader.ask(0.0, "bob#color", "bob#matrix")
            scene["bob"].color = "navy"
            for reader in (one, other):
                said = await news(reader)
                assert (said["type"], {span[0] for span in said["spans"]}) == ("stale", {"bob#color"})
                assert said["revision"] > before["revision"]
                answer = await reader.ask(0.0, "bob#color")
                assert answer["revision"] == said["revision"]
                assert answer["segments"][0]["track"]["value"] == [0.0, 0.0, 128 / 255, 1.0]

    run(work)


def test_an_array_is_sent_once_to_each_reader(served):
    """Bytes beside the message; to who has them they are not sent again, until they say that they dropped them."""
    address = served(Pendulum).address

    async def work():
        async with client(address) as one, client(address) as other:
            for reader in (one, other):
                await reader.open()
                answer = await reader.ask(0.0, "bob#points")
                assert len(answer["blobs"]) == 1
                assert isinstance(answer["blobs"][0]["data"], bytes)
                assert (await reader.ask(0.0, "bob#points"))["blobs"] == []
            refs = answer["blobs"][0]["refs"]
            await one.send({"type": "dropped", "refs": refs})
            assert [chunk["refs"] for chunk in (await one.ask(0.0, "bob#points"))["blobs"]] == [refs]
            assert (await other.ask(0.0, "bob#points"))["blobs"] == []
            assert [chunk["refs"] for chunk in (await other.call(type="need", refs=refs))["blobs"]] == [refs]

    run(work)


def test_who_comes_again_goes_on_where_they_were(served):
    """A connection that broke is nobody's loss: the point is the reader's, who asks again with it."""
    address = served(Pendulum).address

    async def work():
        async with client(address) as reader:
            await reader.open()
            first = await reader.ask(1.5, length=0.7)
            reader.socket._response.connection.transport.abort()  # type: ignore[union-attr]
        async with client(address) as again:
            manifest = await again.open()
            second = await again.ask(1.5, length=0.7)
            assert manifest["revision"] == first["revision"]
            assert second["segments"] == first["segments"]

    run(work)


def test_fifty_readers_share_what_is_remembered_and_lose_nothing_when_ten_are_killed(served):
    """Ten are cut off in the middle; the others get every answer; where one was, another one costs nothing."""
    server = served(Shared)
    rounds, killed, before = 6, set(range(0, 50, 5)), len(Shared.asked)

    async def read(number: int) -> int:
        answers = 0
        async with client(server.address, "shared") as reader:
            await reader.open()
            for k in range(rounds):
                if k == rounds // 2 and number in killed:
                    reader.socket._response.connection.transport.abort()  # type: ignore[union-attr]
                    return answers
                t, length = k + (number % 10) / 10, 0.5 + (number % 10) / 10
                answer = await reader.ask(t, "bob#points", length=length)
                assert answer["type"] == "answer", answer
                answers += 1
        return answers

    async def work():
        return await asyncio.gather(*[read(number) for number in range(50)])

    counts = run(work)
    assert [count for i, count in enumerate(counts) if i not in killed] == [rounds] * 40
    assert [count for i, count in enumerate(counts) if i in killed] == [rounds // 2] * 10
    # Ten points in each round, whoever asks, and for each perhaps the two ticks round it: nothing is evaluated twice.
    evaluated = Shared.asked[before:]
    assert 10 * rounds // 2 <= len(set(evaluated)) <= 3 * 10 * rounds
    assert len(evaluated) == len(set(evaluated))


class Shared(Pendulum):
    """Counts for which points it is evaluated."""

    asked: ClassVar[list[tuple[float, float]]] = []

    def build(self):
        @r4.lift
        def wide(t: float, length: float) -> float:
            Shared.asked.append((t, length))
            return 0.1 + 0.01 * t * length

        return r4.Scene(bob=r4.Sphere(radius=wide(r4.time, self.signals.length), segments=8))
