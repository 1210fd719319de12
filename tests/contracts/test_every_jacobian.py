"""Contracts that every Jacobian in bench/contenders/jacobians keeps in all representations; a new one is under them."""

import functools

import numba
import numpy as np
import pytest
from support.bits import same_bits
from support.buffers import poses
from support.filling import AWAY, ON_COORDINATES, ON_OMEGA, PAIRS, ROUNDING, converted, filled, named, rows_of
from support.states import rotations

from bench.engines.compiled import JIT, register_kernels
from bench.law.chain import bias_acceleration
from bench.law.scalar import KERNELS


def chains(n):
    """Random poses; and the same hinges under orientations at, near and far from what is singular."""
    found = [chain for _, chain in poses(n, 20)]
    permuting, others = rotations()[:24], rotations()[24::3]
    return found + [found[i % 20]._replace(R=R) for i, R in enumerate((*permuting, *others))]


@pytest.mark.parametrize("pair", PAIRS, ids=named)
def test_its_functions_are_kernels(pair):
    one, coordinates = pair
    assert one.takes in ("angular-acceleration", "coordinates")
    assert all(kernel in KERNELS for kernel in one.kernels_in(coordinates))


@pytest.mark.parametrize("n", [6, 7])
@pytest.mark.parametrize("pair", PAIRS, ids=named)
def test_it_writes_its_rows_and_joints_and_no_more(pair, n):
    rows = rows_of(pair[1])
    for _, chain in poses(n, 10):
        J = filled(pair, chain)
        assert np.isfinite(J[:rows, :n]).all()
        assert np.isnan(J[rows:]).all()
        assert np.isnan(J[:, n:]).all()


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
    register_kernels()
    one, coordinates = pair
    return [numba.njit(**JIT)(kernel) for kernel in one.kernels_in(coordinates)]


@pytest.mark.parametrize("n", [6, 7])
@pytest.mark.parametrize("pair", PAIRS, ids=named)
def test_counted_and_compiled_kernels_give_the_bits_of_the_plain_ones(pair, n):
    fill, convert = compiled(pair)
    for chain in chains(n):
        plain = filled(pair, chain)
        assert same_bits(filled(pair, chain, object), plain), chain.R
        assert same_bits(filled(pair, chain, fill=fill), plain), chain.R
        with np.errstate(all="ignore"):
            bias = bias_acceleration(chain)
        plain = converted(pair, chain, bias)
        assert plain.shape == (rows_of(pair[1]),)
        assert same_bits(converted(pair, chain, bias, object), plain), chain.R
        assert same_bits(converted(pair, chain, bias, convert=convert), plain), chain.R
