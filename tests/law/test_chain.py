"""Velocity and acceleration of a chain's tool against MuJoCo: its Jacobians, its sensors, its derivative of J."""

import numba
import numpy as np
import pytest
from support.bits import EPS, same_bits
from support.buffers import as_floats, of_numbers, poses, serial_arm

from bench.engines.compiled import JIT, register_kernels
from bench.law.chain import bias_acceleration, twist

COUNT = 60
# Sums over n joints of cross products of vectors that are orthonormal or placed to a few EPS themselves: the state
# that MuJoCo hands over has been through n products of quaternions and rotations, each with an error of some EPS.
PER_JOINT = 20 * EPS


def size(numbers) -> float:
    return float(np.abs(numbers).max())


def flat(chain):
    pdot, omega = twist(chain)
    return np.array([*pdot, *omega])


@pytest.mark.parametrize("n", [2, 6, 7])
def test_twist_is_mujocos_jacobian_times_the_rates_and_its_sensors(n):
    for arm, chain in poses(n, COUNT):
        allowed = n * PER_JOINT * n * size(arm.jacobian) * size(chain.qdot)
        np.testing.assert_allclose(flat(chain), arm.jacobian @ chain.qdot, rtol=0.0, atol=allowed)
        np.testing.assert_allclose(flat(chain), arm.data.sensordata, rtol=0.0, atol=allowed)


@pytest.mark.parametrize("n", [2, 6, 7])
def test_bias_acceleration_is_mujocos_derivative_of_the_jacobian_times_the_rates(n):
    for arm, chain in poses(n, COUNT):
        allowed = n * PER_JOINT * (n * size(chain.qdot)) ** 2 * size(arm.jacobian)
        np.testing.assert_allclose(bias_acceleration(chain), arm.bias, rtol=0.0, atol=allowed)


@pytest.mark.parametrize("n", [6, 7])
def test_bias_acceleration_is_the_change_of_the_twist_at_constant_rates(n):
    arm, draw, h = serial_arm(n), np.random.default_rng(7), 1e-4
    for _ in range(20):
        q, qdot = draw.uniform(-np.pi, np.pi, n), draw.normal(size=n)
        after, before = (flat(arm.move(q + sign * h * qdot, qdot)) for sign in (1.0, -1.0))
        expected = bias_acceleration(arm.move(q, qdot))
        speed = np.abs(qdot).sum()
        # central differences: h^2/6 of the third derivative of the pose, speed^3 times a reach below 3 m;
        # and the rounding of two twists over 2 h
        allowed = h * h / 6.0 * 3.0 * speed**3 + n * PER_JOINT * 3.0 * speed / h
        np.testing.assert_allclose((after - before) / (2.0 * h), expected, rtol=0.0, atol=allowed)


@pytest.mark.parametrize("kernel", [twist, bias_acceleration])
@pytest.mark.parametrize("n", [2, 6, 7])
def test_counted_and_compiled_kernels_give_the_bits_of_the_plain_one(kernel, n):
    register_kernels()
    compiled = numba.njit(**JIT)(kernel)
    for _, chain in poses(n, 20):
        plain = np.ravel(kernel(chain))
        assert same_bits(as_floats(kernel(of_numbers(chain, object))).ravel(), plain)
        assert same_bits(np.ravel(compiled(chain)), plain)
