"""Springs beside what is not ours: gradients of potentials, the trace form, logarithms, closed forms of paths."""

import functools

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from bench.experiments import springs
from bench.experiments.experiment import Unit, rows_of
from bench.experiments.request import Request
from bench.law.contenders.registry import contenders

SPRINGS = contenders("springs")
AXES = Rotation.from_rotvec([0.3, -0.5, 0.7]).as_matrix()
K = AXES @ np.diag([30.0, 10.0, 3.0]) @ AXES.T
rotational = pytest.mark.parametrize("spring", springs.SPRINGS)
DRAWN = np.random.default_rng(3)
TURNS = [one for one in Rotation.random(100, rng=DRAWN) if one.magnitude() < 3.0]


@functools.cache
def rows():
    return rows_of(Request("quick"), Unit("springs", count=1, total=1)).set_index(["spring", "frame"])


def asked(turn):
    """The arguments of a spring's functions."""
    return tuple(turn.as_quat(canonical=True, scalar_first=True).tolist()), tuple(map(tuple, K.tolist()))


@pytest.mark.parametrize("name", [name for name, spring in SPRINGS.items() if spring.potential])
def test_moment_is_the_gradient_of_its_potential(name):
    spring, h = SPRINGS[name], 1e-5
    for turn in TURNS:
        ahead, behind = (
            [spring.potential(*asked(turn * Rotation.from_rotvec(s * h * e))) for e in np.eye(3)] for s in (1.0, -1.0)
        )
        gradient = (np.array(behind) - np.array(ahead)) / (2.0 * h)
        np.testing.assert_allclose(spring.moment(*asked(turn)), gradient, atol=1e-5)


def test_energy_of_the_quaternion_is_the_trace_form():
    spring, G = SPRINGS["quaternion-energy"], 0.5 * np.trace(K) * np.eye(3) - K
    for turn in TURNS:
        X = turn.as_matrix()
        assert spring.potential(*asked(turn)) == pytest.approx(np.trace(G @ (np.eye(3) - X)), rel=1e-12)
        twice = G @ X - X.T @ G
        expected = -np.array([twice[2, 1], twice[0, 2], twice[1, 0]])
        np.testing.assert_allclose(spring.moment(*asked(turn)), expected, atol=1e-12)


def test_logarithms_are_scipys():
    plain, energy = SPRINGS["logarithm"], SPRINGS["logarithm-energy"]
    for turn in TURNS:
        phi = turn.as_rotvec()
        np.testing.assert_allclose(plain.moment(*asked(turn)), -K @ phi, atol=1e-12)
        assert energy.potential(*asked(turn)) == pytest.approx(0.5 * phi @ K @ phi, rel=1e-12)


def test_rate_of_a_path_is_scipys():
    phi, rate, h = np.array([0.9, -1.2, 0.4]), np.array([0.3, 0.5, -0.7]), 1e-6
    turned = Rotation.from_rotvec(phi - h * rate).inv() * Rotation.from_rotvec(phi + h * rate)
    np.testing.assert_allclose(springs.right_jacobian(phi) @ rate, turned.as_rotvec() / (2.0 * h), atol=1e-9)


@rotational
def test_stiffness_felt_is_what_the_file_says(spring):
    for frame in spring.frames:
        found = rows().loc[(spring.name, frame)]
        assert found["felt_least"] == pytest.approx(spring.stiffness, rel=1e-6)
        assert found["felt_most"] == pytest.approx(spring.stiffness, rel=1e-6)


@rotational
def test_energy_balance_closes_and_work_is_zero_for_a_potential_or_equal_stiffness_and_no_one_else(spring):
    found = rows().loc[spring.name]
    if spring.potential:
        assert (found["work_share"] < 1e-14).all()
    else:
        assert (found["work_share"] > 0.1).all()
    assert (found["work_share_isotropic"] < 1e-14).all()
    assert (found["balance_share"] < 1e-10).all()


def test_twice_as_many_points_change_no_work():
    spring, paths = SPRINGS["logarithm"], np.random.default_rng(1).uniform(-0.7, 0.7, (2, 3, 3))
    moment = springs.in_tool(spring, "tool", K)
    few = springs.compute_work(moment, paths, 30.0)
    assert springs.compute_work(moment, paths, 30.0, points=2 * springs.POINTS) == pytest.approx(few, rel=1e-12)
