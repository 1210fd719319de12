"""Velocity and acceleration of a chain's tool against MuJoCo: its Jacobians, its sensors, its derivative of J."""

import numpy as np
import pytest
from support.bits import EPS
from support.buffers import different_calls, poses

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
def test_twist_and_bias_are_mujocos_jacobian_and_its_derivative_times_the_rates_and_its_sensors(n):
    for arm, chain in poses(n, COUNT):
        allowed = n * PER_JOINT * n * size(arm.jacobian) * size(chain.qdot)
        np.testing.assert_allclose(flat(chain), arm.jacobian @ chain.qdot, rtol=0.0, atol=allowed)
        np.testing.assert_allclose(flat(chain), arm.data.sensordata, rtol=0.0, atol=allowed)
        allowed = n * PER_JOINT * (n * size(chain.qdot)) ** 2 * size(arm.jacobian)
        np.testing.assert_allclose(bias_acceleration(chain), arm.bias, rtol=0.0, atol=allowed)


@pytest.mark.parametrize("kernel", [twist, bias_acceleration])
@pytest.mark.parametrize("n", [2, 6, 7])
def test_counted_and_compiled_kernels_give_the_bits_of_the_plain_one(kernel, n):
    assert different_calls(kernel, [(chain,) for _, chain in poses(n, 20)]) == []
