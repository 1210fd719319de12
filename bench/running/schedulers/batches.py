"""Units put together into chunks that take a worker 10 to 60 s, by what units usually cost.

A chunk of less is carried about more than worked on; of one that is lost with its worker, more is done again.
"""

from collections.abc import Sequence

from bench.experiments.experiment import Unit, experiment_of

CHUNK_S = 25.0
"""Seconds of a chunk: a unit may take 2.4 times what it usually does, or 0.4 of it, and stay within 10 to 60 s."""

ROUNDS = 4
"""Chunks that each worker has at least, so that none waits long for the last one of another."""

MOST_EPISODES = 50_000
"""Of a chunk: 10 MB of rows, which the worker and then the client hold."""


def seconds(unit: Unit) -> float:
    """What a unit usually takes a worker."""
    return experiment_of(unit).cost_s(unit)


def in_batches(units: Sequence[Unit], workers: int) -> list[tuple[Unit, ...]]:
    """Cut the units, in their order, into chunks of at most CHUNK_S, or of one unit that takes longer.

    Args:
        workers: that are there; of little work each gets ROUNDS chunks all the same.
    """
    most_s = min(CHUNK_S, sum(map(seconds, units)) / (ROUNDS * max(1, workers)))
    chunks: list[list[Unit]] = []
    room_s, room = 0.0, 0
    for unit in units:
        if seconds(unit) > room_s or unit.episodes > room:
            chunks.append([])
            room_s, room = most_s, MOST_EPISODES
        chunks[-1].append(unit)
        room_s, room = room_s - seconds(unit), room - unit.episodes
    return list(map(tuple, chunks))
