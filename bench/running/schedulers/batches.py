"""Units put together into chunks that take a worker 10 to 60 s, by what units usually cost.

A chunk of less is carried about more than worked on; of one that is lost with its worker, more is done again.
"""

from collections.abc import Sequence

from bench.experiments.contact_plan import ContactUnit
from bench.experiments.plan import AnyUnit
from bench.experiments.robustness_plan import RobustnessUnit

CHUNK_S = 25.0
"""Seconds of a chunk: a unit may take 2.4 times what it usually does, or 0.4 of it, and stay within 10 to 60 s."""

ROUNDS = 4
"""Chunks that each worker has at least, so that none waits long for the last one of another."""

MOST_EPISODES = 50_000
"""Of a chunk: 10 MB of rows, which the worker and then the client hold."""

EPISODE_S = {"ideal-rk4": 4e-4, "ideal-held": 2e-4, "native": 3e-3, "reference": 0.06}
ARM_EPISODE_S = {"native": 0.01, "reference": 0.3}
TRIAL_S = 0.025
TROUBLED_S = 6e-4
"""CPU seconds an episode: on the free body, on an arm, in contact, in trouble. Medians over six units of each kind of
the default suite on a core of 2026, to one digit (of the reference engine on arms, which it does not run, a guess); in
contact from 0.0035 (probed) to 0.06 (a peg). A factor of two does not matter. Compiling comes on top, once."""


def seconds(unit: AnyUnit) -> float:
    """What a unit usually takes a worker."""
    if isinstance(unit, ContactUnit):
        return unit.count * TRIAL_S
    if isinstance(unit, RobustnessUnit):
        return unit.count * TROUBLED_S
    return unit.count * (ARM_EPISODE_S if unit.arm else EPISODE_S)[unit.engine]


def portions(units: Sequence[AnyUnit], workers: int) -> list[tuple[AnyUnit, ...]]:
    """The units in their order, cut into chunks of at most CHUNK_S, or one unit that takes more by itself.

    Args:
        workers: that are there; of little work each gets ROUNDS chunks all the same.
    """
    most_s = min(CHUNK_S, sum(map(seconds, units)) / (ROUNDS * max(1, workers)))
    chunks: list[list[AnyUnit]] = []
    room_s, room = 0.0, 0
    for unit in units:
        if seconds(unit) > room_s or unit.count > room:
            chunks.append([])
            room_s, room = most_s, MOST_EPISODES
        chunks[-1].append(unit)
        room_s, room = room_s - seconds(unit), room - unit.count
    return list(map(tuple, chunks))
