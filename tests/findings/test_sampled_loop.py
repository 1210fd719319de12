"""The sampled linear loop near the goal, against published limits, the simulator, and the laws' own slopes there."""

import math

import numpy as np
import pytest

from bench.engines.episode import OUTCOME, SETTLING_TICK
from bench.engines.episode import Settings as Limits
from bench.engines.plants import perturbed
from bench.engines.simulate_bodies import run_disturbed
from bench.experiments.situations import mapped_laws
from bench.findings.theory.bang_bang import angle_of_share, least_time
from bench.findings.theory.closed_form import linear_settling
from bench.findings.theory.robustness_theory import delay_margin
from bench.findings.theory.sampled_loop import (
    SampledLoop,
    find_limits,
    is_stable,
    mode_time,
    settling_time,
    spectral_radius,
)
from bench.law.contenders.registry import find_contender
from bench.law.inputs import AT_REST, Gains, Goal, Tuning
from bench.law.so3 import IDENTITY, from_quaternion
from tasks.base import Start
from tasks.condition import Condition
from tasks.rotations import about
from tasks.verdict import SETTLED


def at_one(kv: float, delay: float) -> SampledLoop:
    """Return a critically damped loop of period 1."""
    return SampledLoop(kp=0.25 * kv * kv, kv=kv, period=1.0, delay=delay)


@pytest.mark.parametrize(
    ("delay", "limit"),
    # eigenvalues of the sampled double integrator with Kp = Kv^2/4, computed elsewhere
    [
        (0.0, 2.00000),
        (1.0, 0.85232),
        (2.0, 0.51570),
        (3.0, 0.36915),
        (4.0, 0.28736),
        (0.125, 2.9933),
        (0.25, 2.2105),
        (0.5, 1.4170),
    ],
)
def test_limit_of_an_exactly_held_loop_is_the_known_one(delay, limit):
    assert find_limits(at_one(4.0, delay)).kv == pytest.approx(limit, rel=5e-5)


def test_limit_without_delay_is_that_of_jury():
    # Kv T < 2 and Kp T < 2 Kv
    assert find_limits(SampledLoop(kp=1e-6, kv=3.0, period=1.0)).kv_high == pytest.approx(
        2.0, rel=1e-5
    )
    assert find_limits(SampledLoop(kp=1.0, kv=0.1, period=1.0)).kv_low == pytest.approx(
        0.5, rel=1e-6
    )


def test_light_axis_is_the_first_to_be_lost_by_a_high_gain():
    even = find_limits(at_one(4.0, 0.0)).kv
    uneven = find_limits(at_one(4.0, 0.0)._replace(inertia=0.8, unevenness=0.4))
    # about the axis of 0.8 * 0.6 = 0.48 the loop has kv/0.48 and kp/0.48: its damping ratio is higher, Kv T/J < 2
    assert uneven.kv < 0.48 * even * 1.05


def test_limit_of_a_delay_of_many_periods_is_the_margin_of_the_continuous_loop():
    loop = SampledLoop(kp=100.0, kv=20.0, period=1e-4, delay=0.3)
    # half a period of the hold is a delay, too
    assert find_limits(loop).delay + 0.5e-4 == pytest.approx(delay_margin(100.0, 20.0), rel=1e-3)


@pytest.mark.parametrize("zeta", [0.5, 1.0, 2.0])
def test_linear_loop_that_is_sampled_fast_settles_as_the_continuous_one(zeta):
    loop = SampledLoop(kp=100.0, kv=20.0 * zeta, period=1e-4)
    assert settling_time(loop, 5.0) == pytest.approx(linear_settling(100.0, 20.0 * zeta), abs=5e-3)


def test_loop_that_is_hardly_damped_takes_the_time_of_its_envelope():
    loop = SampledLoop(kp=100.0, kv=0.5, period=1e-5)
    # exp(-kv t/2) = 0.02
    assert settling_time(loop, 5.0) == pytest.approx(2.0 * math.log(50.0) / 0.5, rel=0.01)
    assert mode_time(spectral_radius(loop), loop.period) == pytest.approx(15.65, rel=0.01)
    assert settling_time(at_one(4.0, 0.0), 5.0) == math.inf


SIMULATED = [
    # period [s], delay [s], inertia, unevenness, damping ratio; delays are whole steps of the simulator's plant
    (0.02, 0.0, 1.0, 0.0, 1.0),
    (0.02, 0.02, 1.0, 0.0, 1.0),
    (0.02, 0.005, 1.0, 0.0, 1.0),
    (0.02, 0.05, 1.0, 0.0, 0.7),
    (0.02, 0.013, 0.7, 0.4, 1.3),
    (0.001, 0.01, 2.0, 0.2, 0.6),
]


@pytest.mark.parametrize("law", ["mrp-memory", "hybrid", "rotation-matrix"])
@pytest.mark.parametrize(("period", "delay", "inertia", "unevenness", "zeta"), SIMULATED)
def test_body_near_its_goal_settles_below_the_limit_and_not_above(law, period, delay, inertia, unevenness, zeta):
    beyond = SampledLoop(400.0**2, 2.0 * zeta * 400.0, period, delay, inertia, unevenness)
    limit = find_limits(beyond).kv
    assert 1.0 < limit < beyond.kv
    uneven = (1.0 - unevenness, 1.0, 1.0 + unevenness)
    condition = Condition(period_s=period, delay_s=delay, inertia=tuple(inertia * factor for factor in uneven))
    assert perturbed.timing(condition).late * period / perturbed.steps_of(condition) == pytest.approx(delay)
    axes = np.eye(3)
    starts = [Start("", about(tuple(axis), 0.01)) for axis in axes]
    for factor, settles in ((0.94, True), (1.06, False)):
        loop = beyond.with_kv(factor * limit)
        assert is_stable(loop) is settles
        limits = Limits(Gains(loop.kp, loop.kv), 1e-3, 8000, 1)
        rows = run_disturbed(find_contender(law), starts, condition, limits, ())
        has_settled = rows[:, OUTCOME] == SETTLED
        # the weakest axis alone is lost above the limit
        assert has_settled.all() if settles else not has_settled.all()


def test_response_has_the_settling_time_of_the_simulators_small_errors():
    loop = SampledLoop(kp=100.0, kv=14.0, period=0.02, delay=0.03)
    condition = Condition(period_s=0.02, delay_s=0.03)
    limits = Limits(Gains(loop.kp, loop.kv), 1e-3, 5000, 1)
    [row] = run_disturbed(find_contender("hybrid"), [Start("", about((0.0, 0.6, 0.8), 0.01))], condition, limits, ())
    assert settling_time(loop, 5.0) == pytest.approx(row[SETTLING_TICK] * 1e-3, abs=0.02)


@pytest.mark.parametrize("law", [one.name for one in mapped_laws()])
def test_command_of_every_law_of_the_map_has_the_slopes_of_the_linear_loop_at_the_goal(law):
    contender, gains, small = find_contender(law), Tuning(100.0, 14.0), 1e-5
    memory = contender.regulator.memory

    def command(R, omega):
        said = contender.law(R, omega, Goal(IDENTITY), gains, *(() if memory is None else (memory,)))
        return np.array(said if memory is None else said[0])

    weights = contender.regulator.stiffness
    assert (weights == (1.0, 1.0, 1.0)) is (law not in ("synergistic", "weighted-columns"))
    for axis, weight in zip(np.eye(3), weights, strict=True):
        turned = command(from_quaternion(about(tuple(axis), small)), AT_REST)
        turning = command(IDENTITY, tuple(small * axis))
        assert turned == pytest.approx(-weight * gains.kp * small * axis, abs=1e-3 * gains.kp * small)
        assert turning == pytest.approx(-gains.kv * small * axis, abs=1e-3 * gains.kv * small)


def test_least_time_is_known():
    # 120 deg and 179 deg with 10 rad/s^2, rest to rest
    assert least_time(math.radians(120.0), 10.0, 0.0) == pytest.approx(0.915291, abs=1e-6)
    assert least_time(math.radians(179.0), 10.0, 0.0) == pytest.approx(1.117880, abs=1e-6)
    assert least_time(1.0, 10.0) == pytest.approx(0.86853 * 2.0 / math.sqrt(10.0), rel=1e-5)


def test_angle_of_a_share_of_uniform_orientations_is_known():
    # half of all orientations are within 123.8 degrees? (theta - sin theta)/pi = 1/2
    angle = angle_of_share(0.5)
    assert (angle - math.sin(angle)) / math.pi == pytest.approx(0.5, abs=1e-12)
    assert angle_of_share(1.0) == pytest.approx(math.pi)
