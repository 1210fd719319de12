"""The law with a bounded command: its bound, how near it comes to it, its energy, and the spin it is switched on at."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation as ScipyRotation
from support.states import of_scipy, vector

from bench.law.contenders.regulators.bounded_command import law
from bench.law.inputs import Gains, Goal

GAINS = Gains(kp=70.0, kv=13.0)


def command(R, omega):
    return np.array(law(of_scipy(R), vector(omega), Goal(), GAINS))


def test_command_never_exceeds_twice_kp_and_comes_near_it():
    draw = np.random.default_rng(6)
    sizes = np.geomspace(1e-3, 1e6, 400)
    away = draw.normal(size=(400, 3))
    for R, size, k in zip(ScipyRotation.random(400, rng=draw), sizes, away, strict=True):
        assert np.linalg.norm(command(R, size * k)) <= 2.0 * GAINS.kp * (1.0 + 1e-14)
    worst = command(ScipyRotation.from_rotvec((np.pi / 2.0, 0.0, 0.0)), (1e6, 0.0, 0.0))
    assert np.linalg.norm(worst) == pytest.approx(2.0 * GAINS.kp, rel=1e-6)


def test_damper_never_exceeds_kp_nor_kv_times_the_rate():
    for size in np.geomspace(1e-6, 1e4, 60):
        u = command(ScipyRotation.identity(), (0.0, size, 0.0))
        assert -min(GAINS.kp, GAINS.kv * size) <= u[1] < 0.0


@pytest.mark.parametrize("spin", [0.0, 10.0, 60.0])
def test_energy_falls_by_the_dampers_power_from_any_spin(spin):
    """V = Kp (1 - cos theta) + omega^2/2; scipy integrates Kv omega^2/sqrt(1 + omega^2/w^2) beside the motion."""
    first = ScipyRotation.from_rotvec((1.5, -1.0, 0.7))
    axis = np.array((2.0, -1.0, 2.0)) / 3.0

    def rate(_, y):
        v, w, omega = y[:3], y[3], y[4:7]
        size = np.linalg.norm(y[:4])
        u = command(ScipyRotation.from_quat(y[:4] / size), omega)
        lost = GAINS.kv * omega @ omega / np.hypot(1.0, np.linalg.norm(omega) * GAINS.kv / GAINS.kp)
        return np.concatenate((0.5 * (w * omega + np.cross(omega, v)), [-0.5 * omega @ v], u, [lost]))

    begun = np.concatenate((first.as_quat(), spin * axis, [0.0]))
    found = solve_ivp(rate, (0.0, 4.0), begun, "DOP853", np.linspace(0.0, 4.0, 60), rtol=1e-11, atol=1e-11)
    theta = ScipyRotation.from_quat(found.y[:4].T).magnitude()
    V = GAINS.kp * (1.0 - np.cos(theta)) + 0.5 * np.sum(found.y[4:7] ** 2, axis=0)
    np.testing.assert_allclose(V + found.y[7], V[0], rtol=1e-8)
    assert V[-1] < 1e-6 * V[0]
