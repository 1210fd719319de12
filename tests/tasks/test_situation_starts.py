"""Starts of a situation: independent draws of the Haar measure, the same for every law, others in other situations."""

import math

import numpy as np
import pytest
from scipy.stats import kstest, spearmanr

from tasks.situation import KP, NOMINAL

SPINNING = NOMINAL._replace(spin=1.5)
JUMPING = NOMINAL._replace(jump=0.5)


def quats(starts):
    return np.array([start.quat_wxyz for start in starts])


def angles(quat):
    return 2.0 * np.arccos(np.minimum(np.abs(quat[:, 0]), 1.0))


def haar_cdf(angle):
    # the density of the angle is (1 - cos angle)/pi
    return (angle - np.sin(angle)) / np.pi


@pytest.mark.parametrize("situation", [NOMINAL, SPINNING, JUMPING])
def test_first_starts_do_not_depend_on_how_many_are_drawn(situation):
    assert situation.starts(512, 0) == situation.starts(2048, 0)[:512]


def test_orientations_have_the_haar_measure():
    quat = quats(NOMINAL.starts(4000, 3))
    assert np.linalg.norm(quat, axis=1) == pytest.approx(1.0)
    assert kstest(angles(quat), haar_cdf).pvalue > 0.01
    for axis in (quat[:, 1:] * np.sign(quat[:, :1])).T:
        assert kstest(axis / np.sin(angles(quat) / 2.0), lambda x: (1.0 + x) / 2.0).pvalue > 0.01


def test_starts_are_independent_draws_and_not_spread_evenly():
    # Of spread points far fewer fall short of the expected count in a cell than of independent ones.
    shares = []
    for seed in range(200):
        below = haar_cdf(angles(quats(NOMINAL.starts(256, seed)))) < 0.5
        shares.append(below.sum())
    # binomial: 256 draws of a half have the variance 64
    assert np.var(shares) == pytest.approx(64.0, rel=0.4)


def test_spins_have_the_speed_of_the_situation_and_directions_of_their_own():
    starts = SPINNING.starts(2000, 1)
    omega = np.array([start.omega for start in starts])
    assert np.linalg.norm(omega, axis=1) == pytest.approx(1.5 * math.sqrt(KP))
    assert kstest(omega[:, 2] / (1.5 * math.sqrt(KP)), lambda x: (1.0 + x) / 2.0).pvalue > 0.01
    assert spearmanr(omega[:, 2], quats(starts)[:, 0]).pvalue > 0.01


def test_goals_that_jump_are_a_second_draw():
    starts = JUMPING.starts(2000, 1)
    goals = np.array([start.goal_wxyz for start in starts])
    assert kstest(angles(goals), haar_cdf).pvalue > 0.01
    assert spearmanr(angles(goals), angles(quats(starts))).pvalue > 0.01
    assert all(start.omega == (0.0, 0.0, 0.0) for start in starts)


def test_situations_and_seeds_have_starts_of_their_own():
    assert NOMINAL.starts(4, 0) == NOMINAL.starts(4, 0)
    assert NOMINAL.starts(4, 0) != NOMINAL.starts(4, 1)
    assert NOMINAL.starts(4, 0) != NOMINAL._replace(zeta=0.9).starts(4, 0)
