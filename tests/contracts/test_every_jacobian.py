"""Contracts that every Jacobian in contenders/jacobians keeps in all representations; a new one is under them."""

import functools

import numpy as np
import pytest
from support.bits import EPS, same_bits
from support.buffers import poses, serial_arm
from support.filling import AWAY, ON_COORDINATES, ON_OMEGA, PAIRS, ROUNDING, converted, filled, named, rows_of
from support.states import rotations

from bench.engines.compiled import compile_on_demand
from bench.law.chain import bias_acceleration, twist
from bench.law.contenders.registry import jacobian


def chains(n):
    """Random poses; and the same hinges under orientations at, near and far from what is singular."""
    found = [chain for _, chain in poses(n, 20)]
    permuting, others = rotations()[:24], rotations()[24::3]
    return found + [found[i % 20]._replace(R=R) for i, R in enumerate((*permuting, *others))]


@pytest.mark.parametrize("n", [6, 7])
@pytest.mark.parametrize("pair", ON_COORDINATES, ids=named)
def test_its_rows_times_the_rates_are_the_tools_velocity_and_the_coordinates_rates(pair, n):
    coordinates = pair[1]
    for arm, chain in poses(n, 40):
        margin = coordinates.margin(chain.R)
        if margin > AWAY:
            pdot, omega = (arm.jacobian @ chain.qdot).reshape(2, 3)
            expected = [*pdot, *coordinates.rates(coordinates.chart(chain.R), tuple(omega))]
            given = filled(pair, chain)[: rows_of(coordinates), :n] @ chain.qdot
            allowed = ROUNDING / margin**2 * n * np.abs(arm.jacobian).max() * np.abs(chain.qdot).max()
            np.testing.assert_allclose(given, expected, rtol=0.0, atol=allowed)


@pytest.mark.parametrize("n", [6, 7])
@pytest.mark.parametrize("pair", ON_OMEGA, ids=named)
def test_its_expression_of_a_motion_is_its_own_product_with_the_rates(pair, n):
    """J qdot is the tool's velocity by MuJoCo, in the frame that `express` puts accelerations in."""
    for arm, chain in poses(n, 40):
        velocity = arm.jacobian @ chain.qdot
        allowed = ROUNDING * n * np.abs(arm.jacobian).max() * np.abs(chain.qdot).max()
        given = filled(pair, chain)[:6, :n] @ chain.qdot
        np.testing.assert_allclose(given, converted(pair, chain, tuple(velocity)), rtol=0.0, atol=allowed)
        assert np.linalg.norm(given) == pytest.approx(np.linalg.norm(velocity), abs=allowed)


@functools.cache
def compiled(pair) -> list:
    """Its kernels, for any number of joints."""
    one, coordinates = pair
    return [compile_on_demand(kernel) for kernel in one.kernels_in(coordinates)]


@pytest.mark.parametrize("n", [6, 7])
@pytest.mark.parametrize("pair", PAIRS, ids=named)
def test_it_writes_its_rows_and_joints_alone_and_counted_and_compiled_kernels_give_the_bits_of_the_plain_ones(pair, n):
    (fill, convert), rows = compiled(pair), rows_of(pair[1])
    for k, chain in enumerate(chains(n)):
        plain = filled(pair, chain)
        assert k >= 20 or np.isfinite(plain[:rows, :n]).all()
        assert np.isnan(plain[rows:]).all()
        assert np.isnan(plain[:, n:]).all()
        assert same_bits(filled(pair, chain, object), plain), chain.R
        assert same_bits(filled(pair, chain, fill=fill), plain), chain.R
        with np.errstate(all="ignore"):
            bias = bias_acceleration(chain)
        plain = converted(pair, chain, bias)
        assert plain.shape == (rows_of(pair[1]),)
        assert same_bits(converted(pair, chain, bias, object), plain), chain.R
        assert same_bits(converted(pair, chain, bias, convert=convert), plain), chain.R


@pytest.mark.parametrize("n", [6, 7])
def test_geometric_jacobian_is_mujocos_and_that_of_the_body_is_turned_into_the_tools_frame(n):
    for arm, chain in poses(n, 60):
        # rows of np.array(R) are the columns of R: R^T
        for word, back in (("geometric", np.eye(3)), ("geometric-body", np.array(chain.R))):
            given = filled((jacobian(word), None), chain)[:6, :n]
            expected = np.kron(np.eye(2), back) @ arm.jacobian
            np.testing.assert_allclose(given, expected, rtol=0.0, atol=ROUNDING * np.abs(arm.jacobian).max())


@pytest.mark.parametrize("pair", ON_COORDINATES, ids=named)
def test_drift_is_the_finite_difference_of_the_rates_at_constant_qdot(pair):
    coordinates, h, n = pair[1], 1e-5, 6
    arm, draw = serial_arm(n), np.random.default_rng(13)
    for _ in range(30):
        q, qdot = draw.uniform(-np.pi, np.pi, n), draw.normal(size=n)
        chain = arm.move(q, qdot)
        margin = coordinates.margin(chain.R)
        if margin < 3 * AWAY:
            continue
        expected = converted(pair, chain, bias_acceleration(chain))
        if rows_of(coordinates) == 7:
            # the part along q that the drift leaves out: q . q = 1 twice differentiated is q . qddot = -|omega|^2 / 4
            omega = np.array(twist(chain)[1])
            expected[3:] -= 0.25 * (omega @ omega) * np.array(coordinates.chart(chain.R).E)
        after, before = (rates_of(arm.move(q + sign * h * qdot, qdot), coordinates) for sign in (1, -1))
        speed = np.abs(qdot).sum()
        allowed = 10.0 * h * h * speed**3 / margin**4 + 100 * EPS * speed / (h * margin**2)
        np.testing.assert_allclose((after - before) / (2.0 * h), expected, rtol=0.0, atol=allowed)


def rates_of(chain, coordinates):
    pdot, omega = twist(chain)
    return np.array([*pdot, *coordinates.rates(coordinates.chart(chain.R), omega)])
