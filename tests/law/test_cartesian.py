"""The controller (2.2) and (3.7) against MuJoCo's forward dynamics, against numpy, and against each other.

With a perfect model an exact inverse gives the tool the acceleration that was commanded (Murphy 1988, 2.3), whatever
the Jacobian, and the analytic Jacobian the torques of the geometric one with (2.15).
"""

import functools

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.bits import EPS
from support.filling import filled
from support.on_arms import ARMS, GAINS, LAWS, here, named, torques

import tasks
from bench.law.contenders import combinations
from bench.law.contenders.registry import contenders, representation
from bench.law.weighting import GREATEST_GAIN, LENGTH
from tasks.kinematics import kinematics, rotation_vector

over_arms = pytest.mark.parametrize("arm", ARMS)
SEVEN = [arm for arm in ARMS if tasks.arm(arm).joints == 7]

APPROXIMATE = ("damped-least-squares", "transpose")
EXACT = [word for word in contenders("inverses") if word not in APPROXIMATE]
"""The inverses that give J x = a wherever the damped and the truncated one leave J alone."""

WEIGHTS = np.array([1.0 / LENGTH] * 3 + [1.0] * 4)


@functools.cache
def states(arm: str) -> tuple:
    """(q, qdot, goal, p_d): poses around home, moving, towards goals some 50 degrees and a decimetre away."""
    draw, found = np.random.default_rng(5), []
    model, n = kinematics(tasks.arm(arm)), tasks.arm(arm).joints
    for _ in range(12):
        q, qdot = model.arm.home + draw.uniform(-1.0, 1.0, n), draw.normal(size=n)
        p, quat = model.pose(q)
        turned = Rotation.from_rotvec(0.5 * draw.normal(size=3)) * Rotation.from_quat(quat, scalar_first=True)
        found.append((q, qdot, turned.as_quat(scalar_first=True), p + 0.1 * draw.normal(size=3)))
    return tuple(found)


def inverted(one, at) -> np.ndarray:
    """The Jacobian that a contender inverts: the rows its file fills."""
    return filled((one.jacobian, one.representation if on_coordinates(one) else None), at.chain)[: one.rows, : at.n]


def singular_values(J, weights=1.0) -> np.ndarray:
    """The six that a rigid body's motion has; a seventh, of four coordinates on seven joints, is zero."""
    return np.linalg.svd(np.broadcast_to(weights, len(J))[:, None] * J, compute_uv=False)[:6]


def is_exact(one, J) -> bool:
    """Whether J is so far from singular that the inverse neither damps nor truncates."""
    return singular_values(J, WEIGHTS[: len(J)])[-1] > 1.0 / GREATEST_GAIN


def on_coordinates(one) -> bool:
    return one.representation is not None and one.jacobian.takes == "coordinates"


def desired(at, p_d, u, gains=GAINS) -> np.ndarray:
    """(2.1) for the position, and the law's own answer."""
    return np.array([*(gains.kp * (p_d - at.chain.p) - gains.kv * at.xdot[:3]), *u])


def rounding(one, at, J) -> float:
    """Relative error of x from J x = a: n^2 EPS times the condition of what is factored (Higham 2002, 10.1, 20.1).

    That is J for a solution by elimination or singular values, J J^T for the others, J D^-1 J^T for Lambda; another
    EPS cond(D) is of MuJoCo's forward dynamics.
    """
    sigma = singular_values(J)
    condition = sigma[0] / sigma[-1]
    of_D = np.linalg.cond(at.D)
    if one.inverse.name not in ("solve", "truncated-svd"):
        condition *= condition
    if one.inverse.gives == "torque":
        condition *= of_D
    return at.n**2 * EPS * (condition + of_D)


# ---------------------------------------------------------------------------- against MuJoCo


@over_arms
def test_perfect_model_gives_the_tool_the_commanded_acceleration(arm):
    tried = set()
    for one in combinations.every(LAWS, tasks.arm(arm).joints):
        if one.inverse.name in APPROXIMATE:
            continue
        for q, qdot, goal, p_d in states(arm)[:6]:
            at = here(arm, q, qdot)
            J = inverted(one, at)
            if not is_exact(one, J):
                continue
            tried.add(one.inverse.name)
            tau, u = torques(one, at, goal, p_d)
            got = at.acceleration(tau)
            size = np.linalg.norm(at.J, 2) * np.linalg.norm(at.data.qacc) + np.linalg.norm(at.drift)
            if on_coordinates(one):  # B and Bdot of the conversion, each up to 1/margin and 1/margin^2
                size /= one.representation.margin(at.chain.R) ** 2
            np.testing.assert_allclose(
                got, desired(at, p_d, u), rtol=0.0, atol=rounding(one, at, J) * size, err_msg=one.name
            )
    assert tried == set(EXACT) - ({"solve"} if arm in SEVEN else set())


# ---------------------------------------------------------------------------- against numpy


@over_arms
@pytest.mark.parametrize("word", ["pseudo-inverse", "truncated-svd", "dynamically-consistent", "transpose"])
@pytest.mark.parametrize("jacobian", ["geometric", "geometric-body"])
def test_torques_are_the_formula(arm, jacobian, word):
    """tau = D J^+ (a - J z) + D z + fg, a = (u_p, u) - Jdot qdot, z = -Kv/2 qdot on seven joints, else 0.

    With J^T Lambda or J^T in place of D J^+ where the inverse gives torques; J, Jdot, D and fg are MuJoCo's.
    """
    one = named(arm, f"rotation-matrix@{jacobian}+{word}")
    for q, qdot, goal, p_d in states(arm):
        at = here(arm, q, qdot)
        if not is_exact(one, at.J):
            continue
        tau, u = torques(one, at, goal, p_d)
        z = -0.5 * GAINS.kv * qdot if at.n > 6 else np.zeros(at.n)
        a = desired(at, p_d, u) - at.drift - at.J @ z
        if word == "transpose":
            wanted = at.J.T @ a + at.D @ z + at.fg
        elif word == "dynamically-consistent":
            wanted = at.J.T @ np.linalg.solve(at.J @ np.linalg.solve(at.D, at.J.T), a) + at.D @ z + at.fg
        else:
            wanted = at.D @ (np.linalg.pinv(at.J) @ a + z) + at.fg
        atol = rounding(one, at, at.J) * np.linalg.norm(at.D, 2) * np.linalg.norm(np.linalg.pinv(at.J), 2)
        np.testing.assert_allclose(tau, wanted, rtol=0.0, atol=atol * np.linalg.norm(a) + 10 * EPS * np.abs(tau).max())


# ---------------------------------------------------------------------------- (3.7) against (2.2) with (2.15)


@functools.cache
def beside_poles(arm: str) -> tuple:
    """States in the middle of the turns of `pole`, on the Z-Y-X pole and beside it; the arm is regular."""
    draw, found = np.random.default_rng(6), []
    model = kinematics(tasks.arm(arm))
    for start in tasks.start_set("pole", arm=arm)[::2]:
        turn = np.array(rotation_vector(start.goal_wxyz, start.quat_wxyz))
        angle = float(np.linalg.norm(turn))
        q = model.turn(start.q, tuple(turn / angle), angle / 2.0, 40)[-1]
        found.append(
            (q, 0.3 * draw.normal(size=len(q)), start.goal_wxyz, model.pose(q)[0] + 0.01 * draw.normal(size=3))
        )
    return tuple(found)


PAIRS = [
    pytest.param(arm, word, inverse, id=f"{arm}-{word}-{inverse}")
    for arm in ARMS
    for word in contenders("representations")
    for inverse in EXACT
    if all(
        combinations.on((f"feedback-linearized/{word}@{by}+{inverse}",), LAWS, tasks.arm(arm).joints)
        for by in ("analytic", "geometric")
    )
]


@pytest.mark.parametrize(("arm", "word", "inverse"), PAIRS)
def test_analytic_jacobian_gives_the_torques_of_the_geometric_one_with_the_linearized_law(arm, word, inverse):
    """(3.7) equals (2.2) with (2.15), to the rounding of what J_E and its drift are made of."""
    coordinates = representation(word)
    analytic, geometric = (named(arm, f"feedback-linearized/{word}@{by}+{inverse}") for by in ("analytic", "geometric"))
    compared = 0
    for q, qdot, goal, p_d in (*states(arm), *beside_poles(arm)):
        at = here(arm, q, qdot)
        J_E = inverted(analytic, at)
        margin = coordinates.margin(at.chain.R)
        if margin < 1e-5 or not is_exact(geometric, at.J):
            continue
        if not is_exact(analytic, J_E) and inverse in ("truncated-svd", "damped-least-squares-variable"):
            continue
        if singular_values(J_E)[0] > 1e6 * singular_values(J_E)[-1] and inverse != "solve":
            continue  # normal equations have no digits left
        (tau, u), (expected, u_expected) = (torques(one, at, goal, p_d) for one in (analytic, geometric))
        # terms that cancel are up to 1/margin^2 times what is left of them, x up to |J^+| times that, and each
        # inverse adds its own error; a term is kp times an error of pi at most, kv omega, or omega^2
        speed = 1.0 + np.linalg.norm(at.xdot) + np.linalg.norm(qdot)
        terms = GAINS.kp * np.pi + GAINS.kv * speed + speed**2
        relative = EPS / margin**2 + rounding(analytic, at, J_E) + rounding(geometric, at, at.J)
        allowed = 10.0 * relative * np.linalg.norm(at.D, 2) * np.linalg.norm(np.linalg.pinv(at.J), 2) * terms
        np.testing.assert_allclose(tau, expected, rtol=0.0, atol=allowed)
        np.testing.assert_allclose(u, u_expected, rtol=0.0, atol=10.0 * EPS / margin**2 * terms)
        compared += 1
    assert compared >= 6


# ---------------------------------------------------------------------------- seven joints
