"""Contracts that every law of reduced attitude keeps, scipy's motion the oracle; a new file is under them unnamed."""

import functools

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation as ScipyRotation

from bench.contenders.registry import known_pointings, known_regulators
from bench.law.contender import Gains
from bench.law.scalar import KERNELS

GAINS = Gains(kp=37.0, kv=9.0)
A, A_D = np.array((1.0, 0.0, 0.0)), np.array((-0.6, 0.48, 0.64))
TIMES = np.linspace(0.0, 6.0, 121)


@pytest.fixture(params=known_pointings().values(), ids=lambda one: one.name)
def one(request):
    return request.param


def command(one, a, omega, a_d):
    return np.array(one.law(tuple(a), tuple(omega), tuple(a_d), GAINS))


@functools.cache
def motion(name, omega):
    """(a, omega) over TIMES from A: a' = omega x a, omega' = u."""
    one = known_pointings()[name]

    def rate(_, y):
        a = y[:3] / np.linalg.norm(y[:3])
        return np.concatenate((np.cross(y[3:], a), command(one, a, y[3:], A_D)))

    found = solve_ivp(rate, (0.0, TIMES[-1]), (*A, *omega), "DOP853", TIMES, rtol=1e-11, atol=1e-12)
    return found.y[:3].T, found.y[3:].T


def test_fields_say_what_it_is(one):
    assert all((one.title, one.source, one.formula, one.property))
    assert one.law in KERNELS


def test_name_is_no_regulators(one):
    assert one.name not in known_regulators()


def test_command_is_the_same_in_every_base_frame(one):
    draw = np.random.default_rng(2)
    for Q, omega in zip(ScipyRotation.random(20, rng=draw), draw.normal(size=(20, 3)), strict=True):
        seen, turned = command(one, A, omega, A_D), command(one, Q.apply(A), Q.apply(omega), Q.apply(A_D))
        np.testing.assert_allclose(turned, Q.apply(seen), atol=1e-12)


def test_turn_about_the_axis_is_not_commanded(one):
    for a in np.random.default_rng(3).normal(size=(20, 3)):
        a /= np.linalg.norm(a)
        assert command(one, a, (0.0, 0.0, 0.0), A_D) @ a == pytest.approx(0.0, abs=1e-13)


def test_response_from_rest_is_that_of_one_scalar_equation_along_the_great_circle(one):
    a, _ = motion(one.name, (0.0, 0.0, 0.0))
    theta0 = np.arccos(A @ A_D)
    wanted = solve_ivp(
        lambda _, y: (y[1], -GAINS.kp * one.spring(y[0]) - GAINS.kv * y[1]),
        (0.0, TIMES[-1]), (theta0, 0.0), "DOP853", TIMES, rtol=1e-11, atol=1e-12,
    ).y[0]  # fmt: skip
    sine = np.linalg.norm(np.cross(a, A_D), axis=1)
    np.testing.assert_allclose(np.arctan2(sine, a @ A_D), abs(wanted), rtol=0.0, atol=1e-8)
    np.testing.assert_allclose(a @ np.cross(A, A_D), 0.0, atol=1e-9)


def test_spin_about_the_axis_is_kept_or_dies_out_as_it_says(one):
    a, omega = motion(one.name, (7.0, 1.0, -2.0))
    spin = np.sum(a * omega, axis=1)
    if one.keeps_spin:
        np.testing.assert_allclose(spin, 7.0, rtol=1e-9)
    else:
        assert abs(spin[-1]) < 1e-6


def test_energy_never_rises_and_the_axis_arrives(one):
    a, omega = motion(one.name, (7.0, 1.0, -2.0))
    kept = np.sum(a * omega, axis=1) ** 2 if one.keeps_spin else 0.0
    V = GAINS.kp * (1.0 - a @ A_D) + 0.5 * (np.sum(omega * omega, axis=1) - kept)
    assert np.diff(V).max() <= 1e-8 * V[0]
    assert V[-1] < 1e-6 * V[0]
