"""The law that brakes late: its equation by scipy, the side it keeps, what a lying sensor does to it."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.driving import settings
from support.states import of_scipy, vector

import tasks
from bench.engines.episode import OUTCOME, SETTLING_TICK
from bench.engines.metrics.registry import metrics_of
from bench.engines.simulate_bodies import run_disturbed as run
from bench.law.contenders.registry import find_contender
from bench.law.contenders.regulators.late_braking import law
from bench.law.inputs import Gains, Goal
from bench.law.so3 import IDENTITY
from tasks.condition import Condition
from tasks.verdict import SETTLED

GAINS = Gains(kp=70.0, kv=13.0)
SIXTH = math.pi / 3.0
NONE_YET = (1.0, 0.0, 0.0, 0.0)
LOOSE = 1e-11 * GAINS.kp
TURNS = [*np.eye(3), *-np.eye(3), (0.6, 0.8, 0.0), (0.0, 0.6, -0.8), (1 / 3, 2 / 3, 2 / 3), (-2 / 3, 1 / 3, 2 / 3)]
"""Axes of every kind: along the base's, within a plane of theirs, and neither."""


def command(E, omega, memory):
    """(u, memory) where the turn from R to the identity is E, a scipy rotation."""
    u, after = law(of_scipy(E.inv()), vector(omega), Goal(IDENTITY), GAINS, tuple(map(np.float64, memory)))
    return np.array(u), after


def turn(theta, k):
    return ScipyRotation.from_rotvec(theta * np.asarray(k))


def lift(E, near):
    """scipy's quaternion (eta, eps) of E, the one of the two that is nearer to another."""
    q = E.as_quat(scalar_first=True)
    return q if q @ near >= 0.0 else -q


def written_out(q, omega):
    """The law's equation on a quaternion (eta, eps) that knows its side."""
    eta, eps = q[0], q[1:]
    pull = GAINS.kp * (1.0 + eta**2) + 0.8 * GAINS.kv * max(0.0, eps @ omega)
    return pull * eps - GAINS.kv * np.asarray(omega)


def test_command_is_the_equation_on_the_side_it_is_on_to_240_degrees_and_on_the_other_beyond():
    for k, omega in zip(TURNS, np.random.default_rng(2).normal(scale=8.0, size=(len(TURNS), 3)), strict=True):
        q, memory = np.array(NONE_YET), NONE_YET
        for theta in np.radians(np.arange(1.0, 240.0, 2.0)):
            q = lift(turn(theta, k), q)
            u, memory = command(turn(theta, k), omega, memory)
            np.testing.assert_allclose(u, written_out(q, omega), rtol=0.0, atol=LOOSE)
        beyond = turn(np.radians(241.0), k)
        u, memory = command(beyond, omega, memory)
        np.testing.assert_allclose(u, written_out(-lift(beyond, q), omega), rtol=0.0, atol=LOOSE)


HALF_TURNS = [start for start in tasks.start_set("half-turn") if start.id.endswith("exact")]


def judged(beyond):
    """Whether each exact half turn is left for good where the sensor lies by `beyond` near it, and when [s]."""
    chosen = settings(horizon_s=2.0)
    one = find_contender("late-braking")
    rows = run(one, HALF_TURNS, Condition(worst_attitude_error=beyond), chosen, metrics_of(on_arm=False), 0)
    return rows[:, OUTCOME] == SETTLED, rows[:, SETTLING_TICK] * chosen.dt_s


@pytest.mark.parametrize("beyond", [0.0, 0.01, 0.3, 1.0])
def test_sensor_that_lies_by_less_than_60_degrees_does_not_hold_it_at_a_half_turn(beyond):
    settled, times = judged(beyond)
    assert settled.all()
    assert times.max() < 0.7  # the linear one takes 0.58 s


def test_sensor_that_lies_by_more_than_60_degrees_holds_it():
    settled, _ = judged(SIXTH + 0.05)
    assert not settled.any()
