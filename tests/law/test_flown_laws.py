"""Laws of flight controllers and a bounded law: the formulas of their sources, by scipy."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support import bodies
from support.states import directions, of_scipy, vector

from bench.law.contenders.registry import regulator
from bench.law.inputs import PAPERS_GAINS, Gains, Goal, Tuning, reads_limits

GAINS = Gains(kp=37.0, kv=9.0)
P = GAINS.kp / GAINS.kv
SOFT = Gains(kp=4.0 * P * P, kv=4.0 * P)
"""Critically damped, with the same P."""
HOME = ScipyRotation.identity()


def command(name, R, omega, R_d=HOME, gains=GAINS):
    """Return u of scipy's rotations."""
    return np.array(regulator(name).law(of_scipy(R), vector(omega), Goal(of_scipy(R_d)), gains))


def drawn_states(seed, spin):
    """Yield 400 orientations, goals and angular velocities [rad/s]."""
    draw = np.random.default_rng(seed)
    turns, goals = (ScipyRotation.random(400, rng=draw) for _ in range(2))
    yield from zip(turns, goals, draw.normal(scale=spin, size=(400, 3)), strict=True)


def error_in_body(R, R_d):
    """Return 2 eps of the shorter turn from R to R_d, body frame."""
    return 2.0 * (R.inv() * R_d).as_quat(canonical=True)[:3]


def hold_to(name, rate_body, R, omega, R_d):
    """Hold u to Kv (R omega_c - omega), to 1e-10 of the rates."""
    expected = GAINS.kv * (R.apply(rate_body) - omega)
    allowed = 1e-10 * GAINS.kv * (P + np.linalg.norm(omega))
    np.testing.assert_allclose(command(name, R, omega, R_d), expected, rtol=0.0, atol=allowed)


PX4_LIMITS = np.radians((220.0, 220.0, 200.0)) / (4.0, 4.0, 2.8)
"""MC_ROLLRATE_MAX, MC_PITCHRATE_MAX and MC_YAWRATE_MAX over MC_ROLL_P, MC_PITCH_P and MC_YAW_P."""


def px4_rate(R, R_d):
    """Return PX4's wanted rate over P, by rotations of the z axis and about it."""
    z, z_d = R.as_matrix()[:, 2], R_d.as_matrix()[:, 2]
    normal = np.cross(z, z_d)
    size = np.linalg.norm(normal)
    least = ScipyRotation.from_rotvec(math.atan2(size, z @ z_d) * normal / size)
    yaw = ((least * R).inv() * R_d).as_rotvec()
    np.testing.assert_allclose(yaw[:2], 0.0, atol=1e-11)
    return error_in_body(R, least * R * ScipyRotation.from_rotvec(0.4 * yaw)) / (1.0, 1.0, 0.4)


def test_px4_turns_the_z_axis_by_the_least_turn_and_weighs_the_yaw_that_is_left():
    cuts = np.zeros(3)
    for R, R_d, omega in drawn_states(3, 2.0):
        rate = px4_rate(R, R_d)
        cuts += np.abs(rate) > PX4_LIMITS
        hold_to("px4", P * np.clip(rate, -PX4_LIMITS, PX4_LIMITS), R, omega, R_d)
    assert (cuts > 50).all()
    assert (cuts < 350).all()


@pytest.mark.parametrize(
    ("tilt_deg", "is_whole"), [(179.3, False), (179.45, False), (179.55, True), (179.9, True)]
)
def test_px4_uses_the_whole_turn_where_the_z_axes_are_opposite(tilt_deg, is_whole):
    yaws = np.linspace(-2.5, 2.5, 20)
    for R, azimuth, yaw in zip(ScipyRotation.random(20, rng=5), np.arange(20.0), yaws, strict=True):
        axis = np.array((math.cos(azimuth), math.sin(azimuth), 0.0))
        tilted = R * ScipyRotation.from_rotvec(math.radians(tilt_deg) * axis)
        R_d = tilted * ScipyRotation.from_rotvec((0.0, 0.0, yaw))
        rate = error_in_body(R, R_d) / (1.0, 1.0, 0.4) if is_whole else px4_rate(R, R_d)
        hold_to("px4", P * np.clip(rate, -PX4_LIMITS, PX4_LIMITS), R, np.zeros(3), R_d)


@pytest.mark.parametrize(("name", "share"), [("px4", 0.4), ("quaternion-shortest", 1.0)])
def test_px4_tilts_nearer_to_the_least_turn_of_the_z_axis_than_the_whole_turn_does(name, share):
    """The least turn is about x; the wanted rate is off it by a share of half the yaw."""
    for yaw in np.linspace(-2.0, 2.0, 9):
        R_d = ScipyRotation.from_rotvec((0.5, 0.0, 0.0)) * ScipyRotation.from_rotvec(
            (0.0, 0.0, yaw)
        )
        x, y, _ = command(name, HOME, np.zeros(3), R_d)
        assert math.atan2(y, x) == pytest.approx(-share * yaw / 2.0, abs=1e-12)
        assert math.hypot(x, y) == pytest.approx(2.0 * GAINS.kp * math.sin(0.25), rel=1e-12)


def test_px4_pulls_a_large_yaw_no_less_than_the_quaternion_does():
    """The weight divides what it multiplies; only the limit of the rate holds the yaw back."""
    for yaw in np.linspace(0.1, 3.1, 31):
        R_d = ScipyRotation.from_rotvec((0.0, 0.0, yaw))
        pull = command("px4", HOME, np.zeros(3), R_d)[2]
        expected = min(2.0 * math.sin(0.2 * yaw) / 0.4, math.radians(200.0) / 2.8)
        assert pull == pytest.approx(GAINS.kp * expected, rel=1e-12)
        assert pull >= min(2.0 * math.sin(0.5 * yaw), 1.24) * GAINS.kp


def brescianini_rate(R, R_d, omega):
    """Return the wanted rate [rad/s], and on which body axes the spin rule acts."""
    rate, spin = P * error_in_body(R, R_d), R.inv().apply(omega)
    goes_on = (np.sign(rate) == -np.sign(spin)) & (
        np.abs(spin) > P * np.array((12.0, 12.0, 5.0)) / 4.0
    )
    return np.where(goes_on, np.sign(spin) * P * np.array((30.0, 30.0, 10.0)) / 4.0, rate), goes_on


def test_brescianini_follows_the_quaternion_unless_a_fast_spin_opposes_it():
    acted = np.zeros(3)
    for R, R_d, omega in drawn_states(4, 4.0 * P):
        rate, goes_on = brescianini_rate(R, R_d, omega)
        acted += goes_on
        hold_to("brescianini", rate, R, omega, R_d)
        assert (
            np.abs(rate) <= P * np.array((7.5, 7.5, 2.5)) * (1.0 + 1e-12)
        ).all()  # the firmware's limit
    assert (acted > 60).all()
    assert (acted < 340).all()


@pytest.mark.parametrize(("axis", "spin"), [(0, 4.0), (1, -4.0), (2, 2.0)])
def test_brescianini_lets_a_fast_spin_go_on_around_and_then_settles(axis, spin):
    """From the goal, with a spin over the threshold: once around; the quaternion brakes at once."""
    along, times = np.eye(3)[axis], np.linspace(0.0, 3.0, 601)
    swept = {}
    for name in ("brescianini", "quaternion-shortest"):
        path = bodies.path(
            lambda _, R, omega, __, name=name: (command(name, R, omega), ()),
            HOME,
            spin * P * along,
            times,
            method="RK45",
            rtol=1e-6,
            atol=1e-8,
        )
        swept[name] = abs(np.trapezoid(path[1] @ along, times))
        assert path[0][-1].magnitude() < 0.01
    assert swept["brescianini"] == pytest.approx(2.0 * math.pi, abs=0.02)
    assert swept["quaternion-shortest"] == pytest.approx(0.0, abs=0.02)


def test_brescianini_can_hold_a_body_in_a_spin_for_ever():
    """It turns about z at the greatest rate and never passes 180°; the quaternion alone settles."""
    start = ScipyRotation.from_quat((0.57, -0.67, 0.42, 0.22))
    omega, times = (
        start.apply(P / 5.0 * np.array((-7.3, 3.7, 12.5))),
        np.linspace(0.0, 40.0 / P, 401),
    )
    ends = {}
    for name in ("brescianini", "quaternion-shortest"):
        R, rates, _ = bodies.path(
            lambda _, R, omega, __, name=name: (command(name, R, omega, gains=SOFT), ()),
            start,
            omega,
            times,
            method="RK45",
            rtol=1e-6,
            atol=1e-8,
        )
        ends[name] = R[-100:].magnitude(), R[-100:].inv().apply(rates[-100:])[:, 2]
    angles, about_z = ends["brescianini"]
    assert angles.min() > 1.0
    np.testing.assert_allclose(about_z, 2.5 * P, rtol=1e-3)
    assert ends["quaternion-shortest"][0].max() < 0.01


@pytest.mark.parametrize("axis", range(3))
def test_brescianini_from_rest_is_the_shortest_quaternion(axis):
    start, times = ScipyRotation.from_rotvec(3.14 * np.eye(3)[axis]), np.linspace(0.0, 1.5, 31)
    angles = []
    for name in ("brescianini", "quaternion-shortest"):
        path = bodies.path(
            lambda _, R, omega, __, name=name: (command(name, R, omega, gains=PAPERS_GAINS), ()),
            start,
            bodies.REST,
            times,
        )
        angles.append(path[0].magnitude())
    np.testing.assert_allclose(*angles, rtol=0.0, atol=1e-8)


@pytest.mark.parametrize("bound", [0.1, 3.7, 500.0])
def test_boskovic_is_the_formula_of_its_source_on_the_whole_vector(bound):
    """u = u_max s/(|s| + k^2 delta), s = k^2 eps - omega, k^2 = 2 Kp/Kv, delta = u_max/(2 Kp)."""
    gain, delta = 2.0 * P, bound / (2.0 * GAINS.kp)
    for R, R_d, omega in drawn_states(6, 5.0):
        s = 0.5 * gain * R.apply(error_in_body(R, R_d)) - omega
        expected = bound * s / (np.linalg.norm(s) + gain * delta)
        u = command("boskovic", R, omega, R_d, Tuning(*GAINS, bound=bound))
        np.testing.assert_allclose(u, expected, rtol=0.0, atol=1e-11 * bound)


def test_boskovic_stays_below_the_bound_at_every_spin_and_comes_near_to_it():
    gains = Tuning(*GAINS, bound=10.0)
    spins = np.geomspace(1e-3, 1e6, 400)
    sizes = []
    for R, size, k in zip(ScipyRotation.random(400, rng=6), spins, directions(400, 7), strict=True):
        sizes.append(np.linalg.norm(command("boskovic", R, size * k, gains=gains)))
    assert max(sizes) <= 10.0 * (1.0 + 1e-15)
    assert max(sizes) > 9.999


def test_boskovic_commands_half_of_the_bound_where_the_law_without_it_commands_the_bound():
    R, omega = ScipyRotation.from_rotvec((0.4, -1.0, 0.7)), np.array((1.0, 2.0, -0.5))
    free = command("boskovic", R, omega, gains=Tuning(*GAINS))
    half = command("boskovic", R, omega, gains=Tuning(*GAINS, bound=float(np.linalg.norm(free))))
    np.testing.assert_allclose(half, 0.5 * free, rtol=1e-14)


def test_boskovic_without_a_bound_is_the_shortest_quaternion():
    for R, R_d, omega in drawn_states(9, 5.0):
        u = command("boskovic", R, omega, R_d, Tuning(*GAINS))
        np.testing.assert_array_equal(u, command("quaternion-shortest", R, omega, R_d))


def test_boskovic_alone_of_these_reads_a_limit_of_its_motors():
    assert [
        name for name in ("px4", "brescianini", "boskovic") if reads_limits(regulator(name).law)
    ] == ["boskovic"]
