"""Contracts that every law with a state of its own keeps; a new file is under them unnamed."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bodies import REST, commanded, left, motion
from support.each import each
from support.states import of_scipy, rotations

from bench.law.contenders.registry import contenders
from bench.law.inputs import Gains, Goal

GAINS = Gains(37.0, 11.0)  # not the defaults: a law that has those built in is found out
GOAL = ScipyRotation.from_rotvec((0.4, -0.7, 0.2))
SMALL = 1e-4

one = each(contenders("compensators").values())


def test_nothing_moves_at_the_goal_at_rest(one):
    for R in rotations():
        u, rate = one.law.law(R, REST, Goal(R), GAINS, one.begin(R))
        np.testing.assert_allclose((*u, *rate), 0.0, atol=1e-12)


def test_command_is_the_same_in_every_base_frame(one):
    draw = np.random.default_rng(10)
    for Q, R, R_d, omega in zip(
        *(ScipyRotation.random(20, rng=draw) for _ in range(3)), draw.normal(size=(20, 3)), strict=True
    ):
        seen, _ = commanded(one, R, omega, R_d, GAINS, one.begin(of_scipy(R)))
        turned, _ = commanded(one, Q * R, Q.apply(omega), Q * R_d, GAINS, one.begin(of_scipy(Q * R)))
        np.testing.assert_allclose(turned, Q.apply(seen), atol=1e-11)


def test_angular_velocity_is_read_or_not_as_it_says(one):
    R, state = ScipyRotation.from_rotvec((0.3, 0.1, -0.8)), (0.9, 0.1, -0.3, 0.2)
    still, moving = (commanded(one, R, omega, GOAL, GAINS, state) for omega in (REST, (1.0, -2.0, 3.0)))
    assert one.measures_rate != (np.array_equal(still[0], moving[0]) and np.array_equal(still[1], moving[1]))


def test_small_angles_obey_the_polynomial(one):
    """Fitted to scipy's motion: x''' + c2 x'' + c1 x' + c0 x = 0."""
    times = np.linspace(0.0, 0.5, 2001)
    R, omega, _ = motion(one, ScipyRotation.from_rotvec((0.0, SMALL, 0.0)) * GOAL, GOAL, GAINS, times)
    x, v = left(R, GOAL)[:, 1] / SMALL, -omega[:, 1] / SMALL
    h = times[1]
    a = np.gradient(v, h, edge_order=2)
    jerk = np.gradient(a, h, edge_order=2)
    inside = slice(5, -5)
    fitted, *_ = np.linalg.lstsq(np.column_stack((a, v, x))[inside], -jerk[inside], rcond=None)
    np.testing.assert_allclose(fitted, one.polynomial(*GAINS), rtol=2e-3)


def test_small_angles_die_out_for_all_gains(one):
    for gains in np.random.default_rng(3).uniform(0.1, 300.0, (200, 2)):
        assert np.roots((1.0, *one.polynomial(*gains))).real.max() < 0.0


BOUNDED = [one for one in contenders("compensators").values() if one.bound]


@pytest.mark.parametrize("one", BOUNDED)
def test_bound_is_never_exceeded(one):
    draw, limit = np.random.default_rng(8), one.bound(*GAINS)
    greatest = 0.0
    for R, R_d in zip(rotations(), reversed(rotations()), strict=True):
        for state in draw.normal(size=(5, 4)):
            u, _ = one.law.law(R, tuple(draw.normal(scale=50.0, size=3)), Goal(R_d), GAINS, tuple(state))
            greatest = max(greatest, float(np.linalg.norm(u)))
    assert 0.5 * limit < greatest <= limit * (1.0 + 1e-12)


KP = Gains().kp


def test_filter_begins_with_no_command_of_its_own_and_the_length_of_its_quaternion_does_not_matter():
    """At rest its first command is the spring alone: nothing is felt of where the frame was switched on."""
    one, q = contenders("compensators")["velocity-free"], np.array((0.3, -0.8, 0.1, 0.5))
    drawn = ScipyRotation.random(16, rng=np.random.default_rng(4))
    for R, R_d in zip(drawn[:8], drawn[8:], strict=True):
        u, rate = commanded(one, R, REST, R_d, Gains(), one.begin(of_scipy(R)))
        k = left(R, R_d)
        np.testing.assert_allclose(u, KP * np.sinc(np.linalg.norm(k) / np.pi) * k, atol=1e-11)
        np.testing.assert_allclose(rate, 0.0, atol=1e-13)
        short, long = (commanded(one, R, REST, R_d, Gains(), size * q) for size in (1.0, 3.0))
        np.testing.assert_allclose(short[0], long[0], rtol=1e-13)
        np.testing.assert_allclose(3.0 * short[1], long[1], rtol=1e-12, atol=1e-12)
