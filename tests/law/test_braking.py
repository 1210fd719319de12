"""Laws that know the bound of their motor: the rate that can be braked, commands by scipy, motions under a bound."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation as ScipyRotation
from support.states import directions, of_scipy, vector

from bench.law.braking import shifted_root
from bench.law.contenders.registry import find_contender
from bench.law.contenders.regulators.braking_feedforward import split_gains
from bench.law.inputs import AT_REST, Goal, Tuning

SHARE = 0.7
GAINS = Tuning(kp=100.0, kv=20.0, bound=10.0)
"""The paper's gains with the tenth of kp as the bound of the command [rad/s^2]."""

BRAKED, LESSER = ("braking-cascade", "braking-cascade-memory"), ("wie-bailey-heiberg", "wie-bailey-heiberg-memory")
HELD = ("braking-cascade-memory", "wie-bailey-heiberg-memory", "braking-feedforward")


def command(word, phi, omega, gains):
    """Return u at the rotation vector phi to the goal; of a law with memory, on the side of that vector."""
    one = find_contender(word)
    R = of_scipy(ScipyRotation.from_rotvec(-np.asarray(phi)))
    if one.regulator.memory is None:
        return np.array(one.law(R, vector(omega), Goal(), gains))
    theta = np.linalg.norm(phi)
    side = (math.cos(theta / 2.0), *(math.sin(theta / 2.0) * np.asarray(phi) / theta))
    return np.array(one.law(R, vector(omega), Goal(), gains, vector(side))[0])


def braked_rate(theta, gains):
    """Return c by the formula of the source, written a second time."""
    p, a = gains.kp / gains.kv, SHARE * gains.bound
    knee = a / p**2
    return p * theta if theta <= knee else math.sqrt(2.0 * a * (theta - knee / 2.0))


def lesser_rate(theta, gains):
    """Return min(2 (Kp/Kv) sin(theta/2), sqrt(4 a sin(theta/2)))."""
    eps = math.sin(theta / 2.0)
    return min(2.0 * gains.kp / gains.kv * eps, math.sqrt(4.0 * SHARE * gains.bound * eps))


RATES = dict.fromkeys(BRAKED, braked_rate) | dict.fromkeys(LESSER, lesser_rate)


def draw_states(count, seed, farthest):
    """Return (theta, k, omega, gains), drawn: angles to `farthest`, gains and bounds over two decades."""
    draw = np.random.default_rng(seed)
    angles = draw.uniform(1e-3, farthest, count)
    rates = draw.normal(scale=3.0, size=(count, 3))
    for theta, k, omega in zip(angles, directions(count, seed), rates, strict=True):
        kp = 10.0 ** draw.uniform(0.5, 2.5)
        gains = Tuning(kp, draw.uniform(0.8, 4.0) * math.sqrt(kp), kp * 10.0 ** draw.uniform(-1.5, 0.5))
        yield theta, k, omega, gains


def test_rate_and_its_slope_meet_at_the_knee_and_never_need_more_than_the_bound():
    p, a = 5.0, 7.0
    knee = a / p**2
    for side in (1.0 - 1e-12, 1.0 + 1e-12):
        assert shifted_root(knee * side, p, a) == pytest.approx((a / p, p), rel=1e-9)
    for theta in np.linspace(0.01, 4.0, 200):
        rate, slope = shifted_root(theta, p, a)
        step = 1e-6
        difference = (shifted_root(theta + step, p, a)[0] - shifted_root(theta - step, p, a)[0]) / (2.0 * step)
        assert slope == pytest.approx(difference, rel=1e-5)
        assert rate * slope <= a * (1.0 + 1e-12)
    assert shifted_root(2.0, p, math.inf) == (2.0 * p, p)


@pytest.mark.parametrize("word", RATES)
def test_command_is_that_of_the_formula(word):
    farthest = 3.9 if word.endswith("memory") else 3.1
    beyond = 0
    for theta, k, omega, gains in draw_states(300, 3, farthest):
        rate = RATES[word](theta, gains)
        beyond += rate < 0.99 * min(gains.kp / gains.kv * theta, 2.0 * gains.kp / gains.kv * math.sin(theta / 2.0))
        expected = gains.kv * (rate * k - omega)
        np.testing.assert_allclose(command(word, theta * k, omega, gains), expected, rtol=0.0, atol=1e-9 * gains.kp)
    assert 50 < beyond < 290


@pytest.mark.parametrize("word", [*BRAKED, *LESSER, "braking-feedforward"])
def test_without_a_bound_a_law_is_one_that_knows_none(word):
    older = {
        "braking-cascade": "rotation-vector",
        "braking-cascade-memory": "rotation-vector-memory",
        "braking-feedforward": "rotation-vector-memory",
        "wie-bailey-heiberg": "quaternion-shortest",
        "wie-bailey-heiberg-memory": "hybrid",
    }[word]
    for theta, k, _, gains in draw_states(100, 4, 3.1):
        free = gains._replace(bound=math.inf)
        np.testing.assert_allclose(
            command(word, theta * k, AT_REST, free), command(older, theta * k, AT_REST, free), rtol=1e-12
        )


def commanded_rate(R, gains, p):
    """Return c k of a scipy rotation, on its nearer side."""
    phi = -R.as_rotvec()
    theta = float(np.linalg.norm(phi))
    a = SHARE * gains.bound
    return shifted_root(theta, p, a)[0] * phi / theta


def test_feedforward_is_the_derivative_of_the_commanded_rate():
    """Compare it with differences of c k along a turn that goes on for 1e-6 s at the rate omega."""
    step = 1e-6
    for theta, k, omega, gains in draw_states(200, 5, 3.0):
        c0, g = split_gains(gains.kp, gains.kv)
        p = gains.kp / c0
        if abs(theta - SHARE * gains.bound / p**2) < 1e-3:
            continue  # the second derivative jumps at the knee
        R = ScipyRotation.from_rotvec(-theta * k)
        later, earlier = (
            commanded_rate(ScipyRotation.from_rotvec(sign * step * omega) * R, gains, p) for sign in (1.0, -1.0)
        )
        derivative = (later - earlier) / (2.0 * step)
        expected = c0 * (commanded_rate(R, gains, p) - omega) + g * derivative
        u = command("braking-feedforward", theta * k, omega, gains)
        np.testing.assert_allclose(u, expected, rtol=0.0, atol=1e-6 * gains.kp)


@pytest.mark.parametrize(("kp", "kv"), [(100.0, 14.0), (100.0, 20.0), (100.0, 31.0)])
def test_feedforward_keeps_the_gains_near_the_goal(kp, kv):
    c0, g = split_gains(kp, kv)
    p = kp / c0
    assert c0 + g * p == pytest.approx(kv, rel=1e-12)
    assert 0.0 < g <= 1.0
    assert (g == 1.0) == (kv * kv >= 4.0 * kp)


def motion(word, theta, omega, gains):
    """Return angle to the goal [rad] over time under a bound of the norm: a free body by scipy, the law each ms."""
    one = find_contender(word)
    memory, angles = one.regulator.memory, []
    R, rate = ScipyRotation.from_rotvec((theta, 0.0, 0.0)), np.array(omega, dtype=float)

    def spin(_, state, u):
        w, v, omega = state[0], state[1:4], state[4:]
        return np.concatenate(([-0.5 * v @ omega], 0.5 * (w * omega + np.cross(omega, v)), u))

    for _ in range(2500):
        angles.append(R.magnitude())
        given = (of_scipy(R), vector(rate), Goal(), gains)
        if memory is None:
            u = np.array(one.law(*given))
        else:
            u, memory = one.law(*given, memory)
        u = np.array(u) * min(1.0, gains.bound / max(np.linalg.norm(u), 1e-12))
        first = np.concatenate((R.as_quat(scalar_first=True), rate))
        last = solve_ivp(spin, (0.0, 1e-3), first, "RK45", args=(u,), rtol=1e-9, atol=1e-12).y[:, -1]
        R, rate = ScipyRotation.from_quat(last[:4], scalar_first=True), last[4:]
    return np.array(angles)


def settling_and_overshoot(angles):
    """Return when the angle is below 2 % of the first for good [s], and its maximum after 1 degree [deg]."""
    late = np.flatnonzero(angles > 0.02 * angles[0])[-1] + 1
    near = np.flatnonzero(angles < math.radians(1.0))[0]
    return 1e-3 * late, math.degrees(angles[near:].max())


@pytest.mark.slow
@pytest.mark.parametrize("word", HELD)
def test_turn_of_120_degrees_under_a_bound_ends_near_the_least_time_and_without_overshoot(word):
    """The least time is 0.795 s in the band of 2 % (`bench.findings.theory.time_optimal` has the closed form)."""
    least = (1.0 - 0.02**0.5 / (1.0 + 0.02) ** 0.5) * 2.0 * math.sqrt(1.02 * math.radians(120.0) / GAINS.bound)
    settling, overshoot = settling_and_overshoot(motion(word, math.radians(120.0), AT_REST, GAINS))
    assert least == pytest.approx(0.795, abs=1e-3)
    assert least < settling < 1.3 * least
    assert overshoot < 2.0


@pytest.mark.slow
def test_law_that_knows_no_bound_passes_the_goal_where_the_cascade_does_not():
    """A referee's own simulation: 1.246 s and 10.5 degrees of overshoot of 2 Kp eps - Kv omega, cut to the bound."""
    settling, overshoot = settling_and_overshoot(motion("hybrid", math.radians(120.0), AT_REST, GAINS))
    assert settling == pytest.approx(1.246, abs=0.01)
    assert overshoot == pytest.approx(10.5, abs=0.3)
