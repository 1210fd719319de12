"""What each inverse computes, against its formula in numpy.linalg, and the bounds that damping and truncation keep."""

import mujoco
import numpy as np
import pytest
from support.bits import EPS, same_bits
from support.buffers import jacobian_of, state_of
from support.filling import FACTORED, A, accepted, anything, inertia, resolved, well_conditioned

import tasks
from bench.law import linalg
from bench.law.contenders.inverses.damped_least_squares import DAMPING
from bench.law.contenders.inverses.damped_least_squares_variable import (
    EPSILON,
    MAX_DAMPING_SQUARED,
    damp,
    least_eigenvalue,
)
from bench.law.contenders.inverses.truncated_svd import TOLERANCE
from bench.law.contenders.registry import inverse
from bench.law.weighting import GREATEST_GAIN, LENGTH, smaller_gram, solve_gram, weigh


def weighed(J):
    rows = len(J)
    W = np.diag(np.where(np.arange(rows) < 3, 1.0 / LENGTH, 1.0))
    return W @ J, W @ A[:rows]


def damped(J, lambda_squared):
    J_W, a_W = weighed(J)
    return J_W.T @ np.linalg.solve(J_W @ J_W.T + lambda_squared * np.eye(len(J)), a_W)


def truncated(J):
    J_W, a_W = weighed(J)
    U, sigma, V = np.linalg.svd(J_W, full_matrices=False)
    kept = sigma > TOLERANCE
    return V[kept].T @ ((U.T @ a_W)[kept] / sigma[kept])


def operational(J, inverted=lambda squares: 1.0 / squares):
    squares, U = np.linalg.eigh(J @ np.linalg.solve(inertia(J.shape[1]), J.T))
    return J.T @ U @ (inverted(np.maximum(squares, 0.0)) * (U.T @ A[: len(J)]))


def left_out(squares):
    kept = (np.prod(squares) >= 1e-2) | (squares > 1e-2 * squares[-1])
    return np.where(kept, 1.0 / np.where(kept, squares, 1.0), 0.0)


def smoothly_damped(squares):
    weight = np.interp(squares / squares[-1], [1e-5, 1e-4], [0.0, 1.0])
    return 1.0 / (squares + 1e-5 * squares[-1] * (1.0 - 3.0 * weight**2 + 2.0 * weight**3))


OPERATIONAL = {
    "dynamically-consistent": operational,
    "operational-pseudo-inverse": lambda J: operational(J, left_out),
    "operational-clamped": lambda J: operational(J, lambda squares: 1.0 / np.maximum(squares, 1e-4 * squares[-1])),
    "operational-damped": lambda J: operational(J, smoothly_damped),
}


FORMULAS = {
    "solve": lambda J: np.linalg.solve(J, A[: len(J)]),
    "pseudo-inverse": lambda J: np.linalg.pinv(J) @ A[: len(J)],
    "damped-least-squares": lambda J: damped(J, DAMPING**2),
    "damped-least-squares-variable": lambda J: np.linalg.pinv(J) @ A[: len(J)],  # sigma > epsilon here: none
    "truncated-svd": truncated,
    "transpose": lambda J: J.T @ A[: len(J)],
    **OPERATIONAL,
}


@pytest.mark.parametrize("word", FORMULAS)
def test_answer_is_the_formulas_away_from_singularities(word):
    one = inverse(word)
    for rows, n in accepted(one):
        for J in well_conditioned(rows, n):
            expected = FORMULAS[word](J)
            found, _ = resolved(one, J, A[:rows], inertia(n))
            sigma = np.linalg.svd(weighed(J)[0], compute_uv=False)
            # normal equations square the condition, 2 of it from the weights and what D adds for Lambda
            condition = (2.0 * sigma[0] / sigma[5]) ** 2 * (np.linalg.cond(inertia(n)) if word in OPERATIONAL else 1.0)
            assert np.linalg.norm(found - expected) <= FACTORED * condition * np.linalg.norm(expected)


@pytest.mark.parametrize("word", ["damped-least-squares", "truncated-svd"])
def test_answer_is_the_formulas_at_any_rank(word):
    one = inverse(word)
    for rows, n in accepted(one):
        for name, J in anything(rows, n).items():
            sigma = np.linalg.svd(weighed(J)[0], compute_uv=False) if np.isfinite(J).all() else np.ones(1)
            if not np.isfinite(J).all() or sigma[0] > 1e3:
                continue  # of large ones lambda^2 is lost to rounding beside J J^T, and the rest is `solve`'s
            # a singular value within rounding of the tolerance may be kept or not
            assert word != "truncated-svd" or np.abs(sigma - TOLERANCE).min() > 1e-12, name
            found, _ = resolved(one, J, A[:rows], inertia(n))
            condition = (sigma[0] / DAMPING) ** 2 + 1.0
            allowed = FACTORED * condition * GREATEST_GAIN * np.linalg.norm(weighed(J)[1])
            assert np.linalg.norm(found - FORMULAS[word](J)) <= allowed, name


def with_least(least, rows, n, draw):
    """A Jacobian whose weighed form has these singular values: five of order 1, and the least."""
    U, V = (np.linalg.qr(draw.normal(size=(k, k)))[0] for k in (rows, n))
    J = (U[:, :6] * np.array([1.6, 1.3, 1.0, 0.8, 0.7, least])) @ V[:6]
    J[:3] *= LENGTH
    return J


GATED = np.sqrt(TOLERANCE**2 + linalg.cholesky.MARGIN * (1.6**2 + 1.3**2 + 1.0 + 0.8**2 + 0.7**2))
"""The least singular value beside those of `with_least` from which on nothing is looked for that is below TOLERANCE."""

AROUND = [0.0, 1e-6, *(TOLERANCE * x for x in (0.5, 0.999, 1 - 1e-9, 1 + 1e-9, 1.001))]
AROUND += [GATED * x for x in (0.999, 1 - 1e-9, 1 + 1e-9, 1.001, 1.5, 10.0)]


@pytest.mark.parametrize(("rows", "n"), [(6, 6), (6, 7), (7, 6)])
def test_truncated_answer_is_numpys_on_both_sides_of_the_tolerance_and_of_the_gate(rows, n):
    one, draw = inverse("truncated-svd"), np.random.default_rng(13)
    for least in AROUND:
        for _ in range(20):
            J = with_least(least, rows, n, draw)
            J_W, a_W = weighed(J)
            expected = np.linalg.pinv(J_W, rcond=TOLERANCE / np.linalg.norm(J_W, 2)) @ a_W
            x, _ = resolved(one, J, A[:rows], inertia(n))
            # by the rotations EPS times the condition of what is kept; by normal equations times its square
            condition = 1.6 / (least if least > TOLERANCE else 0.7)
            assert np.linalg.norm(x - expected) <= FACTORED * condition**2 * np.linalg.norm(expected), least


@pytest.mark.parametrize(("rows", "n"), [(6, 6), (6, 7), (7, 6)])
def test_variable_damping_has_the_bits_of_the_estimate_wherever_none_is_made(rows, n):
    one, draw = inverse("damped-least-squares-variable"), np.random.default_rng(14)
    found = [with_least(least, rows, n, draw) for least in AROUND for _ in range(20)]
    for J in [*found, *well_conditioned(rows, n)]:
        J_W, a_W, S, V, y = (np.zeros((7, 7)), np.zeros(7), np.zeros((7, 7)), np.zeros((7, 7)), np.zeros(7))
        weigh(J, A, J_W, a_W, rows, n)
        x, size = np.zeros(7), smaller_gram(J_W, S, rows, n)
        damp(S, V, y, x, size)
        solve_gram(J_W, a_W, S, x, rows, n)
        assert same_bits(resolved(one, J, A[:rows], inertia(n))[0], x[:n])


@pytest.mark.parametrize("word", [word for word in OPERATIONAL if word != "dynamically-consistent"])
def test_operational_torque_is_the_rules_beside_singularities(word):
    one, draw = inverse(word), np.random.default_rng(15)
    for least in (0.3, 0.1, 1e-2, 1e-3, 1e-6):
        for _ in range(10):
            J = with_least(least, 6, 6, draw)
            expected = OPERATIONAL[word](J)
            # rounding of Lambda^-1 in the formula over the least eigenvalue that an inverse divides by
            allowed = 1e-15 / max(least**2, 1e-5) * 1e4
            assert np.linalg.norm(resolved(one, J, A[:6], inertia(6))[0] - expected) <= allowed * np.linalg.norm(
                expected
            )


def test_damping_constants_give_the_greatest_gain_and_no_more():
    """Compute the gain over all singular values by its formulas; sigma is known exactly."""
    sigma = np.geomspace(1e-6, 1e3, 200_001)
    constant = sigma / (sigma**2 + DAMPING**2)
    squared = MAX_DAMPING_SQUARED * np.maximum(0.0, 1.0 - (sigma / EPSILON) ** 2)
    variable = sigma / (sigma**2 + squared)
    for gain in (constant, variable):
        # the grid meets the maximum to its step squared, 1e-8; rounding beside it is nothing
        assert gain.max() == pytest.approx(GREATEST_GAIN, rel=1e-6)
        assert gain.max() <= GREATEST_GAIN * (1.0 + 4 * EPS)


@pytest.mark.parametrize("n", [6, 7])
def test_variable_damping_follows_its_formula_where_one_singular_value_is_small(n):
    """One value from epsilon down to 0, the others of order 1: the estimate is exact to rounding there."""
    one, draw = inverse("damped-least-squares-variable"), np.random.default_rng(9)
    for least in (2.0 * EPSILON, 0.9 * EPSILON, 0.5 * EPSILON, 0.1 * EPSILON, 1e-6, 0.0):
        for _ in range(10):
            J = with_least(least, 6, n, draw)
            squared = MAX_DAMPING_SQUARED * max(0.0, 1.0 - (least / EPSILON) ** 2)
            x, _ = resolved(one, J, A[:6], inertia(n))
            expected = damped(J, squared)
            # the estimate converges by (epsilon^2 + lambda_max^2) / 0.49 = 0.005 in each of 4 steps, squared in the
            # quotient: nothing; what is left is rounding times the condition of S + lambda^2 I
            condition = 1.6**2 / (least**2 + squared)
            assert np.linalg.norm(x - expected) <= FACTORED * condition * np.linalg.norm(expected)


@pytest.mark.parametrize("arm_name", tasks.arm_names())
def test_estimated_least_singular_value_is_never_too_small_and_rarely_too_large(arm_name):
    arm = tasks.arm(arm_name)
    model = mujoco.MjModel.from_xml_string(arm.xml)
    draw = np.random.default_rng(11)
    lower, upper = (np.where(np.isfinite(x), x, s * np.pi) for x, s in ((arm.lower, -1.0), (arm.upper, 1.0)))
    excess = []
    for _ in range(1500):
        J = jacobian_of(model, state_of(model, draw.uniform(lower, upper)), "tool")
        J[:3] /= LENGTH
        least = np.linalg.svd(J, compute_uv=False)[5]
        L = J @ J.T + MAX_DAMPING_SQUARED * np.eye(6)
        linalg.factor(L, 6)
        found = least_eigenvalue(L, np.zeros(6), np.zeros(6), 6) - MAX_DAMPING_SQUARED
        # never below, but for the rounding of a solution and of the products
        assert found - least**2 >= -FACTORED * np.linalg.norm(J) ** 2
        if least < EPSILON:
            excess.append((found - least**2) / EPSILON**2)
    # measured: 99 % are within 0.001 of epsilon^2; 1 % of lambda^2 changes no answer visibly
    assert np.mean(np.array(excess) < 0.01) >= 0.97
    assert len(excess) > 20
