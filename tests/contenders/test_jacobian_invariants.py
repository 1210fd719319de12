"""What holds between the Jacobians and the inverses: MuJoCo's J and Jdot, det J_E, the two ways to J_E, J^T Lambda."""

import numpy as np
import pytest
from support.bits import EPS
from support.buffers import buffer, poses, scratch, serial_arm
from support.filling import AWAY, ON_COORDINATES, ROUNDING, converted, filled, named, rows_of
from support.states import as_rotation

from bench.contenders.registry import inverse, jacobian, known_representations, representation
from bench.law.chain import bias_acceleration, twist
from tasks.rotations import columns

A = np.array([1.0, -2.0, 0.5, 0.3, 1.5, -0.7])
EULER = [one for one in known_representations().values() if one.differentiate is not None]


@pytest.mark.parametrize("n", [6, 7])
def test_geometric_jacobian_is_mujocos(n):
    for arm, chain in poses(n, 60):
        allowed = ROUNDING * np.abs(arm.jacobian).max()
        given = filled((jacobian("geometric"), None), chain)[:6, :n]
        np.testing.assert_allclose(given, arm.jacobian, rtol=0.0, atol=allowed)


@pytest.mark.parametrize("n", [6, 7])
def test_body_jacobian_is_mujocos_turned_into_the_tools_frame(n):
    for arm, chain in poses(n, 60):
        back = np.array(chain.R)  # rows are the columns of R: R^T
        expected = np.kron(np.eye(2), back) @ arm.jacobian
        given = filled((jacobian("geometric-body"), None), chain)[:6, :n]
        np.testing.assert_allclose(given, expected, rtol=0.0, atol=ROUNDING * np.abs(arm.jacobian).max())


@pytest.mark.parametrize("pair", ON_COORDINATES, ids=named)
def test_analytic_columns_are_finite_differences_of_the_coordinates(pair):
    coordinates, h, n = pair[1], 1e-5, 6
    arm, draw = serial_arm(n), np.random.default_rng(12)
    for _ in range(20):
        q = draw.uniform(-np.pi, np.pi, n)
        margin = coordinates.margin(arm.move(q, np.zeros(n)).R)
        if margin < 3 * AWAY:
            continue
        J = filled(pair, arm.move(q, np.zeros(n)))[: rows_of(coordinates), :n]
        for i in range(n):
            after, before = (
                placed(arm.move(q + sign * h * np.eye(n)[i], np.zeros(n)), coordinates) for sign in (1, -1)
            )
            change = wrapped(coordinates, after - before)
            # h^2/6 times third derivatives, of order 1/margin^3 at most 10 times; EPS of the coordinates over h
            allowed = 10.0 * h * h / margin**3 + 20 * EPS / (h * margin)
            np.testing.assert_allclose(change / (2.0 * h), J[:, i], rtol=0.0, atol=allowed)


def placed(chain, coordinates):
    return np.array([*chain.p, *coordinates.chart(chain.R).E])


def wrapped(coordinates, change):
    """The small change that is meant: of angles modulo a turn, of a quaternion the same side of its double cover."""
    angular = change[3:]
    if len(angular) < 4:
        if coordinates in EULER:
            angular = (angular + np.pi) % (2.0 * np.pi) - np.pi
        return np.array([*change[:3], *angular])
    return change


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


def test_determinant_of_the_zyx_euler_jacobian_is_minus_that_of_J_over_cos_beta():
    """det B^-1 = -1 / cos(beta) (Murphy 1988, 2.9): the order alpha, beta, gamma is z, y, x."""
    zyx = representation("zyx-euler")
    for arm, chain in poses(6, 100):
        margin = zyx.margin(chain.R)
        if margin > 0.01:
            J_E = filled((jacobian("analytic"), zyx), chain)[:6, :6]
            given, expected = np.linalg.det(J_E), -np.linalg.det(arm.jacobian) / margin
            # a determinant errs by n EPS times the product of the row lengths, the angular rows being up to 1/margin
            # longer; the rows themselves by ROUNDING
            scale = np.prod(np.linalg.norm(J_E, axis=1))
            assert abs(given - expected) <= 6 * ROUNDING * scale / margin


@pytest.mark.parametrize("n", [6, 7])
@pytest.mark.parametrize("coordinates", EULER, ids=lambda one: one.name)
def test_both_derivations_of_the_euler_jacobian_agree_away_from_the_pole(coordinates, n):
    one, other = ((jacobian(word), coordinates) for word in ("analytic", "analytic-differentiated"))
    for _, chain in poses(n, 80):
        margin = coordinates.margin(chain.R)
        if margin > AWAY:
            agree(one, other, chain, n, margin)


@pytest.mark.parametrize("coordinates", EULER, ids=lambda one: one.name)
@pytest.mark.parametrize("k", range(1, 7))
def test_both_derivations_agree_as_near_to_the_pole_as_rounding_lets_them(coordinates, k):
    one, other = ((jacobian(word), coordinates) for word in ("analytic", "analytic-differentiated"))
    middle = 0.0 if coordinates.name == "zyz-euler" else np.pi / 2
    for _, chain in poses(6, 20):
        alpha, _, gamma = coordinates.chart(chain.R).E
        R = coordinates.to_matrix((alpha, np.float64(middle + 10.0**-k), gamma))
        near = chain._replace(R=as_rotation(R))
        agree(one, other, near, 6, coordinates.margin(near.R))


def agree(one, other, chain, n, margin):
    """J_E and the drift of both. An element of R near the pole is of size `margin` and errs by EPS, so it errs by
    EPS / margin of itself; J_E is up to 1 / margin, the drift up to speed^2 / margin^2.
    """
    J, J_other = (filled(pair, chain)[:6, :n] for pair in (one, other))
    reach = np.abs(J[:3]).max() + 1.0
    np.testing.assert_allclose(J, J_other, rtol=0.0, atol=ROUNDING * reach / margin**2)
    bias = bias_acceleration(chain)
    drift, drift_other = (converted(pair, chain, bias) for pair in (one, other))
    speed = np.abs(chain.qdot).sum()
    np.testing.assert_allclose(drift, drift_other, rtol=0.0, atol=ROUNDING * reach * speed**2 / margin**3)


def test_quaternion_jacobian_has_rank_six_and_does_not_see_the_quaternion_itself():
    quaternion = representation("quaternion")
    for n in (6, 7):
        for arm, chain in poses(n, 40):
            J = filled((jacobian("analytic"), quaternion), chain)[:7, :n]
            q = np.array([0.0, 0.0, 0.0, *quaternion.chart(chain.R).E])
            assert np.abs(J.T @ q).max() <= ROUNDING * np.abs(arm.jacobian).max()
            assert np.linalg.matrix_rank(J, tol=ROUNDING * np.linalg.norm(J)) <= 6


def test_inertia_times_the_inverse_is_the_transpose_times_lambda_on_six_joints():
    """D J^-1 a = J^T Lambda a: with a square J, Lambda = J^-T D J^-1 (Khatib 1987)."""
    for arm, _ in poses(6, 100):
        J, D = arm.jacobian, arm.inertia
        x = {}
        for word in ("solve", "dynamically-consistent"):
            x[word] = np.full(7, np.nan)
            inverse(word).resolve(buffer(J), buffer(A), buffer(D), x[word], 6, 6, scratch())
        expected = D @ x["solve"][:6]
        # factors of J D^-1 J^T: 8 n (3 n + 1) EPS times its condition, at most that of J squared times that of D
        allowed = 8 * 6 * 19 * EPS * np.linalg.cond(J) ** 2 * np.linalg.cond(D) * np.linalg.norm(expected)
        assert np.linalg.norm(x["dynamically-consistent"][:6] - expected) <= allowed


def test_frames_of_the_geometric_jacobian_give_the_same_joint_accelerations():
    for arm, chain in poses(6, 60):
        x = {}
        for word in ("geometric", "geometric-body"):
            pair, x[word] = (jacobian(word), None), np.full(7, np.nan)
            J, a = filled(pair, chain), converted(pair, chain, tuple(A))
            inverse("solve").resolve(J, buffer(a), buffer(arm.inertia), x[word], 6, 6, scratch())
        # two backward errors of 6 n^3 EPS (test_linalg.py) times the condition
        allowed = 2 * 6 * 6**3 * EPS * np.linalg.cond(arm.jacobian) * np.linalg.norm(x["geometric"][:6])
        assert np.linalg.norm(x["geometric"][:6] - x["geometric-body"][:6]) <= allowed


def test_exact_pole_gives_numbers_that_are_not_finite_in_both_derivations():
    for coordinates in EULER:
        quat_wxyz = (0.6, 0.0, 0.0, 0.8) if coordinates.name == "zyz-euler" else (0.5**0.5, 0.0, 0.5**0.5, 0.0)
        [(_, chain)] = poses(6, 1)
        on_pole = chain._replace(R=as_rotation(columns(quat_wxyz)))
        assert coordinates.margin(on_pole.R) == 0.0
        for word in ("analytic", "analytic-differentiated"):
            assert not np.isfinite(filled((jacobian(word), coordinates), on_pole)[:6, :6]).all(), (word, coordinates)
