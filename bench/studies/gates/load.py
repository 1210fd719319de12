"""Busy neighbours: processes that compute, or move memory, in bursts."""

import contextlib
import random
import subprocess
import sys
from collections.abc import Iterator

COMPUTE = """
import os, random, time
asked_by = os.getppid()
draw = random.Random({seed})
while os.getppid() == asked_by:
    end = time.monotonic() + draw.uniform(0.05, 1.0)
    while time.monotonic() < end:
        sum(i * i for i in range(1000))
    time.sleep(draw.uniform(0.0, 0.5))
"""

MOVE = """
import os, random, time
import numpy as np
asked_by = os.getppid()
draw = random.Random({seed})
one, other = np.ones((2, 4_000_000))
while os.getppid() == asked_by:
    end = time.monotonic() + draw.uniform(0.05, 1.0)
    while time.monotonic() < end:
        one[:] = other
    time.sleep(draw.uniform(0.0, 0.5))
"""
"""32 MB to and fro: more than any cache that these processors share."""

MOST = {"compute": 2, "move": 1}
"""Neighbours of each kind."""


@contextlib.contextmanager
def neighbours(seed: int) -> Iterator[dict[str, int]]:
    """From none to MOST processes for as long as the block lasts; how many there are of each kind.

    They have the least claim to a core, or they would take most of the study's hours.
    """
    draw = random.Random(seed)
    counts = {kind: draw.randint(0, most) for kind, most in MOST.items()}
    programs = [COMPUTE] * counts["compute"] + [MOVE] * counts["move"]
    started = [
        subprocess.Popen(
            ["nice", "-n", "19", sys.executable, "-c", program.format(seed=seed + at)], start_new_session=True
        )
        for at, program in enumerate(programs)
    ]
    try:
        yield counts
    finally:
        for process in started:
            process.kill()
            process.wait()
