"""Contracts that every impedance keeps, in every representation it acts on; a new file is under them unnamed.

B is that of `exact`; a free body under a law is moved by scipy's integrator.
"""

import functools

import numpy as np
import pytest
from scipy.integrate import cumulative_simpson
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.buffers import different_calls
from support.in_contact import GAINS, IMPEDANCES, TOUCH
from support.springs import STILL, B_at, command, free_body, margin, seen
from support.states import of_scipy, rotations, vector

from bench.law.contender import bind
from bench.law.contenders.registry import contenders
from bench.law.inputs import Gains
from bench.law.so3 import IDENTITY

REGULAR = 0.3
GOALS = list(ScipyRotation.random(12, rng=np.random.default_rng(41)))


def goals(one) -> list[ScipyRotation]:
    """Return the goals at which its coordinates are far from singular."""
    return [goal for goal in GOALS if margin(one, goal, goal) > REGULAR]


SPRINGS = [one for one in IMPEDANCES if goals(one)]
# a law on R_d^T R can tell base frames apart only by mistake; coordinates of R are measured in one
FRAMELESS = [one for one in IMPEDANCES if one.representation is None or one.impedance.relative]


@pytest.mark.parametrize("impedance", contenders("impedances").values())
def test_impedance_has_a_law_or_one_in_coordinates(impedance):
    assert (impedance.law is None) != (impedance.law_in is None)
    assert impedance.law_in is not None or not impedance.relative


# A step of 1e-4 leaves h^2/6 = 2e-9 of a law's third derivatives, of up to 1/margin^3 = 40, and EPS pi/h = 7e-12 by
# rounding.
STEP = 1e-4
SLOPE = 1e-7


def slope(of_step) -> np.ndarray:
    """Central differences along the three axes, as columns."""
    return np.array([(of_step(STEP * axis) - of_step(-STEP * axis)) / (2.0 * STEP) for axis in np.eye(3)]).T


def spring_of(one, goal):
    return slope(lambda h: command(one, ScipyRotation.from_rotvec(h) * goal, STILL, STILL, goal))


@pytest.mark.parametrize("one", SPRINGS)
def test_spring_at_the_goal_is_kp_damper_kv_and_stiffness_kp_times_the_inertia_in_coordinates_by_B(one):
    """Moment per angle at rest is measured: (du/dm)^-1 du/dphi; in coordinates it is kp m_o B^-T B^-1."""
    for goal in goals(one):
        # R_d^T R of the goal itself differs from the identity by EPS or two, and B from rounding by 1/margin
        assert np.abs(command(one, goal, STILL, STILL, goal)).max() <= 8 * EPS * GAINS.kp / REGULAR
        damping = slope(lambda omega, goal=goal: command(one, goal, omega, STILL, goal))
        np.testing.assert_allclose(spring_of(one, goal), -GAINS.kp * np.eye(3), rtol=0.0, atol=SLOPE * GAINS.kp)
        np.testing.assert_allclose(damping, -GAINS.kv * np.eye(3), rtol=0.0, atol=SLOPE * GAINS.kv)
        mobility = slope(lambda m, goal=goal: command(one, goal, STILL, m, goal))
        measured = -np.linalg.solve(mobility, spring_of(one, goal))
        back = np.linalg.inv(B_at(one, goal, goal))
        wanted = GAINS.kp * TOUCH.m_o * back.T @ back
        np.testing.assert_allclose(measured, wanted, rtol=0.0, atol=10 * SLOPE * np.linalg.norm(wanted, 2))


def anywhere(one, count: int = 60):
    """(R, omega, m, R_d) where its coordinates are regular."""
    draw = np.random.default_rng(42)
    while count:
        turn, goal = ScipyRotation.random(2, rng=draw)
        omega, m = draw.normal(scale=5.0, size=3), draw.normal(size=3)
        if margin(one, turn, goal) > REGULAR:
            count -= 1
            yield turn, omega, m, goal


def size(turn, omega, m) -> float:
    """No term of a command is larger: B^-1 and its derivative are 1/REGULAR and its square at most."""
    linear = GAINS.kp * 4.0 * np.pi + (GAINS.kv + np.linalg.norm(omega)) * np.linalg.norm(omega)
    return (linear + 16.0 * np.linalg.norm(m) / TOUCH.m_o) / REGULAR**2


@pytest.mark.parametrize("one", IMPEDANCES)
def test_moment_turns_the_hand_linearly_and_with_positive_power(one):
    """u(m) - u(0) = M m with M symmetric and positive definite, B B^T/m_o: no moment turns the hand against it."""
    for turn, omega, m, goal in anywhere(one):
        free = command(one, turn, omega, STILL, goal)
        M = np.array([command(one, turn, omega, axis, goal) - free for axis in np.eye(3)]).T
        allowed = 50 * EPS * size(turn, omega, m)
        np.testing.assert_allclose(command(one, turn, omega, m, goal) - free, M @ m, rtol=0.0, atol=allowed)
        np.testing.assert_allclose(M, M.T, rtol=0.0, atol=allowed)
        assert np.linalg.eigvalsh(M).min() > 0.0


@pytest.mark.parametrize("one", FRAMELESS)
def test_command_is_the_same_in_every_base_frame_unless_the_coordinates_are_the_base_frames(one):
    """u(QR, Q omega, Q m, QR_d) = Q u(R, omega, m, R_d)."""
    for Q, (turn, omega, m, goal) in zip(GOALS * 5, anywhere(one), strict=True):
        seen = command(one, turn, omega, m, goal)
        turned = command(one, Q * turn, Q.apply(omega), Q.apply(m), Q * goal)
        np.testing.assert_allclose(turned, Q.apply(seen), rtol=0.0, atol=50 * EPS * size(turn, omega, m))


def stored(one, turn, omega, goal) -> float:
    """Energy [J] of spring and motion: in its coordinates; without, by the spring's work on the shortest way."""
    moving = 0.5 * squared_rate(one, turn, omega, goal)
    if one.representation is not None:
        at, to = (one.representation.chart(of_scipy(seen(one, R, goal))).E for R in (turn, goal))
        away = np.subtract(at, to)
        return float(TOUCH.m_o * (moving + 0.5 * GAINS.kp * np.dot(away, away)))
    vectored = (turn * goal.inv()).as_rotvec()
    nodes, weights = np.polynomial.legendre.leggauss(12)
    ways = [ScipyRotation.from_rotvec(0.5 * (1.0 + node) * vectored) * goal for node in nodes]
    pulls = [-command(one, way, STILL, STILL, goal) @ vectored for way in ways]
    return float(TOUCH.m_o * (0.5 * np.dot(pulls, weights) + moving))


def squared_rate(one, turn, omega, goal) -> float:
    """|omega|^2, or |Edot|^2 in coordinates [1/s^2]."""
    if one.representation is None:
        return float(np.dot(omega, omega))
    rate = goal.inv().apply(omega) if one.impedance.relative else omega
    E_dot = one.representation.rates(one.representation.chart(of_scipy(seen(one, turn, goal))), vector(rate))
    return float(np.dot(E_dot, E_dot))


@pytest.mark.parametrize("one", SPRINGS)
def test_energy_balance_closes(one):
    """What surroundings have done is stored or damped at all times: no push takes work out of a hand at its goal.

    From a turned and spinning hand, which its damper alone would bring to rest.
    """
    draw, law, goal = np.random.default_rng(47), bind(one.impedance, one.representation), goals(one)[0]
    turn, spin = ScipyRotation.from_rotvec((0.2, -0.3, 0.1)) * goal, np.array((0.5, 1.0, -0.8))
    # six tones a component, up to 5 Hz
    size, frequency, phase = draw.normal(scale=0.1, size=(3, 6)), draw.uniform(1.0, 30.0, (3, 6)), draw.uniform(0, 6, 6)

    def moment(t):
        return (size * np.sin(frequency * t + phase)).sum(axis=1)

    times, turns, omega, work = free_body(law, turn, spin, goal, 1.5, moment, 1501)
    damping = [squared_rate(one, turn, w, goal) for turn, w in zip(turns, omega, strict=True)]
    damped = TOUCH.m_o * GAINS.kv * cumulative_simpson(damping, x=times, initial=0.0)
    for k in range(100, len(times), 200):
        # scipy's integrator errs by 1e-9, Simpson's rule at 1 ms by 1e-9 too; 0.01 to 0.1 J are done
        left = stored(one, turns[k], omega[k], goal) + damped[k]
        assert left == pytest.approx(stored(one, turn, spin, goal) + work[k], abs=1e-7)
    assert work[-1] > 1e-3


@functools.cache
def calls() -> list[tuple]:
    """R, omega, m, R_d, gains, inertia at every orientation of interest."""
    draw, every = np.random.default_rng(44), rotations()
    return [
        (
            R,
            *(vector(draw.normal(scale=5.0, size=3)) for _ in range(2)),
            R_d,
            Gains(*map(np.float64, draw.uniform(1.0, 200.0, 2))),
            np.float64(draw.uniform(0.1, 1.0)),
        )
        for R in every
        for R_d in (IDENTITY, every[draw.integers(len(every))])
    ]


@pytest.mark.parametrize("one", IMPEDANCES)
def test_counted_and_compiled_commands_are_the_plain_one_bit_for_bit(one):
    law = bind(one.impedance, one.representation)
    assert different_calls(law, calls()) == []
    with np.errstate(all="ignore"):
        assert np.isfinite([law(*given) for given in calls()]).all(axis=1).mean() > 0.5
