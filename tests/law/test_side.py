"""The kept side of a turn against the rule of Mayhew, Sanfelice and Teel (2011), written again with SciPy.

Theirs has two parts: the quaternion of the error is lifted continuously, and a side h in {1, -1} changes where
h eta < -delta. Here one memory does both. Nothing of `bench.law` is called to build the expected side.
"""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.states import of_scipy

from bench.law.side import DELTA, turn_on_kept_side

TICKS, BODIES, STEP_RAD = 1000, 3, 0.25
"""Ticks of a body that turns at random, bodies, and the turn within a tick about each axis (standard deviation)."""


def lift(quaternion, last):
    """Return the quaternion of an orientation that is on the side of the last one."""
    return quaternion if quaternion @ last >= 0.0 else -quaternion


def walk(seed):
    """Orientations of a body and of its goal, both turning at random."""
    rng = np.random.default_rng(seed)
    body, goal = ScipyRotation.random(2, rng=rng)
    for _ in range(TICKS):
        steps = ScipyRotation.from_rotvec(rng.normal(scale=STEP_RAD, size=(2, 3)))
        body, goal = steps[0] * body, steps[1] * goal
        yield body, goal


@pytest.mark.parametrize("delta", [0.1, DELTA, 0.9])
def test_kept_side_is_the_rule_of_2011_with_the_lift_renewed_in_every_tick(delta):
    changes = 0
    for seed in range(BODIES):
        memory = (1.0, 0.0, 0.0, 0.0)
        lifted, h = np.array([1.0, 0.0, 0.0, 0.0]), 1.0
        for body, goal in walk(seed):
            quaternion = np.roll((goal * body.inv()).as_quat(), 1)
            lifted = lift(quaternion, lifted)
            if h * lifted[0] < -delta:
                h, changes = -h, changes + 1
            w, v, root = turn_on_kept_side(of_scipy(body), of_scipy(goal), memory, delta)
            memory = (w, *v)
            np.testing.assert_allclose(np.array(memory) / (2.0 * root), h * lifted, rtol=0.0, atol=1e-12)
    assert changes >= 10


def test_side_changes_where_the_modified_rodrigues_parameters_have_the_length_that_mrp_memory_states():
    """|sigma| = tan(theta/4) = sqrt((1 + delta)/(1 - delta)) there, and its inverse after the change."""
    beyond = 2.0 * np.pi - 2.0 * np.arccos(DELTA)
    for theta, is_kept in ((beyond - 1e-9, True), (beyond + 1e-9, False)):
        R = ScipyRotation.from_rotvec([0.0, 0.0, -theta])
        near = 0.9 * theta / 2.0
        w, v, root = turn_on_kept_side(
            of_scipy(R), of_scipy(ScipyRotation.identity()), (np.cos(near), 0.0, 0.0, np.sin(near)), DELTA
        )
        length = np.linalg.norm(v) / (w + 2.0 * root)
        expected = np.sqrt((1.0 + DELTA) / (1.0 - DELTA))
        assert length == pytest.approx(expected if is_kept else 1.0 / expected, rel=1e-8)
