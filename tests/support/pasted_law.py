"""Code that a reader pastes, held against the law that is advised."""

from collections.abc import Callable

import numpy as np
from scipy.spatial.transform import Rotation

from bench.findings.selection.regions import find_default
from bench.law.contenders.registry import find_contender
from bench.law.inputs import Gains, Goal
from support.states import as_rotation, vector

WALKS, STEPS = 50, 40


def check_command(command: Callable) -> None:
    """Compare command(R, R_d, omega, q_old, kp, kv) -> (u, q) with the advised law over random states.

    Each walk begins with the memory reset, so that both memories are tested, too.
    """
    generator, law = np.random.default_rng(7), find_contender(find_default()).regulator
    for _ in range(WALKS):
        rotations = Rotation.random(STEPS, rng=generator).as_matrix()
        goal, memory, q_old = rotations[0], law.memory, np.array([0.0, 0.0, 0.0, 1.0])
        for R in rotations:
            omega = generator.normal(size=3) * 9.0
            kp, kv = generator.uniform(1.0, 200.0, 2)
            state = as_rotation(R.T), vector(omega), Goal(as_rotation(goal.T)), Gains(kp, kv)
            wanted, memory = law.law(*state, memory)
            pasted, q_old = command(R, goal, omega, q_old, kp, kv)
            np.testing.assert_allclose(pasted, wanted, rtol=1e-9, atol=1e-7)
