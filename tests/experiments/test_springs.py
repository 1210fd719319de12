"""Rotational springs beside what is not ours: gradients of potentials, the trace form, scipy's rotations."""

import functools

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from bench.contenders.registry import known_springs
from bench.experiments import springs
from bench.experiments.experiment import Settings, Unit, rows_of
from bench.law.scalar import KERNELS

SPRINGS = known_springs()
AXES = Rotation.from_rotvec([0.3, -0.5, 0.7]).as_matrix()
K = AXES @ np.diag([30.0, 10.0, 3.0]) @ AXES.T
each = pytest.mark.parametrize("spring", SPRINGS.values(), ids=SPRINGS)
TURNS = [one for one in Rotation.random(200, rng=np.random.default_rng(3)) if one.magnitude() < 3.0]


@functools.cache
def rows():
    return rows_of(Settings("quick"), Unit("springs", count=1, total=1)).set_index(["spring", "frame"])


def matrix(q):
    return tuple(map(tuple, q))


def quaternion(turn):
    return tuple(turn.as_quat(canonical=True, scalar_first=True).tolist())


@each
def test_functions_are_kernels_of_the_dialect(spring):
    assert spring.moment in KERNELS
    assert spring.potential is None or spring.potential in KERNELS


@pytest.mark.parametrize("name", [name for name, spring in SPRINGS.items() if spring.potential])
def test_moment_is_the_gradient_of_its_potential(name):
    spring = SPRINGS[name]
    h = 1e-5
    for turn in TURNS:
        beside = [[turn * Rotation.from_rotvec(s * h * e) for e in np.eye(3)] for s in (1.0, -1.0)]
        ahead, behind = ([spring.potential(quaternion(one), matrix(K)) for one in side] for side in beside)
        gradient = (np.array(ahead) - np.array(behind)) / (2.0 * h)
        np.testing.assert_allclose(spring.moment(quaternion(turn), matrix(K)), -gradient, atol=1e-6)


def test_energy_of_the_quaternion_is_the_trace_form():
    spring, G = SPRINGS["quaternion-energy"], 0.5 * np.trace(K) * np.eye(3) - K
    for turn in TURNS:
        X = turn.as_matrix()
        assert spring.potential(quaternion(turn), matrix(K)) == pytest.approx(np.trace(G @ (np.eye(3) - X)), rel=1e-12)
        twice = G @ X - X.T @ G
        expected = -np.array([twice[2, 1], twice[0, 2], twice[1, 0]])
        np.testing.assert_allclose(spring.moment(quaternion(turn), matrix(K)), expected, atol=1e-12)


def test_logarithms_are_scipys():
    for turn in TURNS:
        expected = -K @ turn.as_rotvec()
        np.testing.assert_allclose(SPRINGS["logarithm"].moment(quaternion(turn), matrix(K)), expected, atol=1e-12)
        energy = SPRINGS["logarithm-energy"].potential(quaternion(turn), matrix(K))
        assert energy == pytest.approx(0.5 * turn.as_rotvec() @ K @ turn.as_rotvec(), rel=1e-12)


def test_rate_of_a_way_is_scipys():
    phi, rate, h = np.array([0.9, -1.2, 0.4]), np.array([0.3, 0.5, -0.7]), 1e-6
    turned = Rotation.from_rotvec(phi - h * rate).inv() * Rotation.from_rotvec(phi + h * rate)
    np.testing.assert_allclose(springs.right_jacobian(phi) @ rate, turned.as_rotvec() / (2.0 * h), atol=1e-9)


@each
def test_stiffness_felt_is_what_the_file_says(spring):
    for frame in spring.frames:
        found = rows().loc[(spring.name, frame)]
        assert found["felt_least"] == pytest.approx(spring.stiffness, rel=1e-6)
        assert found["felt_most"] == pytest.approx(spring.stiffness, rel=1e-6)


@each
def test_work_is_zero_for_what_has_a_potential_and_no_one_else(spring):
    found = rows().loc[spring.name]
    if spring.potential:
        assert (found["work_share"] < 1e-14).all()
    else:
        assert (found["work_share"] > 0.1).all()
    assert (found["work_share_isotropic"] < 1e-14).all()


def test_twice_as_many_points_change_no_work():
    spring, ways = SPRINGS["logarithm"], np.random.default_rng(1).uniform(-0.7, 0.7, (2, 3, 3))
    moment = springs.in_tool(spring, "tool", K)
    few = springs.compute_work(moment, ways, 30.0)
    assert springs.compute_work(moment, ways, 30.0, points=2 * springs.POINTS) == pytest.approx(few, rel=1e-12)


def test_energy_balance_of_every_spring_closes():
    assert (rows()["balance_share"] < 1e-10).all()
